"""What is said of a list of equivalents: whether it is complete, and if not, why and what helps."""

from collections.abc import Mapping, Sequence
from typing import Any

from flint import fmpq

from disting.fibres.synthesis.result import Fibre, Status
from disting.fibres.synthesis.target import target
from disting.model.chain import Chain

NONE = "none exists, with positive parameters or any others: proven"


def sentence(found: Fibre, count: int, cause: str) -> str:
    """The status in words; `count` parameter vectors are listed, `cause` as from `special`."""
    if found.status is Status.EMPTY:
        return f"{NONE} ({found.reason})"
    if found.status is Status.COMPLETE:
        return (
            "all there are"
            if not found.tests.boundary
            else "all there are, but for any with an element near zero"
        )
    if found.status is Status.INFINITE:
        return "infinitely many: one member of each family is listed, others may have other signs"
    listed = "the list may be incomplete" if count else "nothing can be said"
    if found.status is Status.NOT_COVERED:
        return f"{listed}: {found.reason}"
    if found.tests.boundary:
        return (
            f"{listed}, since an element cannot be told from zero: a structure without it may serve"
        )
    return f"special values: {listed}, since {cause}; change a value slightly"


def under_all(found: Fibre, count: int, is_complete: bool) -> str:
    """What is said of those of a list that keep the responses of all experiments."""
    if found.status is Status.EMPTY:
        return f"{NONE} ({found.reason})"
    if is_complete:
        of = len(found.solutions)
        return "all there are" if count else f"none: all {of} that fit one of them miss another one"
    if found.status is Status.INFINITE:
        return "infinitely many fit each experiment alone; not all of them were put into the others"
    listed = "the list may be incomplete" if count else "nothing can be said"
    return f"{listed}: no experiment alone gives a complete list"


def among(chains: Sequence[Chain]) -> str:
    """What was looked at, in words: how many structures, of which size and kind.

    >>> among([Chain(2, dead_time=True), Chain(2, 1, 1, 2, 1, 2, dead_time=True)])
    'the 2 structures of 2 masses, damped, with a dead time, looked at'
    """
    first = chains[0]
    count = "the structure" if len(chains) == 1 else f"the {len(chains)} structures"
    kind = ["damped" if first.damped else "undamped"]
    kind += ["with a lag"] * first.lag + ["with a dead time"] * first.dead_time
    dampers = {c.ground_dampers for c in chains}
    kind += ["with dampers to the ground"] * (dampers != {()})
    sizes = " or ".join(map(str, sorted({c.n_masses for c in chains})))
    return f"{count} of {sizes} mass{'es' * (sizes != '1')}, {', '.join(kind)}, looked at"


def not_covered(given: Chain, other: Chain) -> str:
    """Why the synthesis does not apply to this pair, or nothing."""
    if other.n_masses > given.n_masses:
        return "a structure with more masses would need poles that cancel, which is not covered"
    if (other.damped or other.ground_dampers) and not given.damped and not given.ground_dampers:
        return "a structure with dampers for a model without any is not covered"
    if other.lag and not given.lag:
        return "a structure with a lag would need a pole that cancels, which is not covered"
    return ""


def special(given: Chain, point: Mapping[str, fmpq]) -> str:
    """What is special about the values of a model whose poles or zeros coincide."""
    if target(given.structure, point).denominator.degree() < 2 * given.n_masses + given.lag:
        return "a vibration mode is not seen by force and sensor (poles and zeros cancel)"
    equal = _equal_ratios(given, point)
    return (
        f"springs have the same ratio k/d ({equal})"
        if equal
        else "poles, zeros or elements coincide"
    )


def _equal_ratios(given: Chain, point: Mapping[str, fmpq]) -> str:
    """Springs of one ratio each, such as k12/d12 = k23/d23."""
    groups: dict[Any, list[str]] = {}
    for name in given.parameters:
        if name[0] == "k" and f"d{name[1:]}" in point:
            groups.setdefault(point[name] / point[f"d{name[1:]}"], []).append(f"{name}/d{name[1:]}")
    return ", ".join(" = ".join(names) for names in groups.values() if len(names) > 1)
