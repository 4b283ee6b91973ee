"""Sentences about structures outside the candidates that have the responses of the selected one."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import isclose
from typing import Any

import numpy as np

from disting.fit.judge.candidate import Candidate
from disting.fit.judge.look_alikes import (
    LookAlike,
    LookAlikeKind,
    LookAlikes,
    base_text,
    is_on_base,
    look_alikes,
)
from disting.fit.judge.outside import Outside, near_bases
from disting.fit.results.selection import Selection
from disting.fit.search.joint import JointCost
from disting.report.fit.mechanics_words import with_or
from disting.report.fit.words import percent

ROUNDING = 1e-5  # of exact values, computed from fitted ones
RELATIVE = "force and encoder between base and motor"
REDUCED = "m1 is then the reduced mass m1 mb/(m1 + mb)"
A = {
    LookAlikeKind.BRANCH: "a branch",
    LookAlikeKind.ELASTIC_BASE: "an elastic base",
    LookAlikeKind.FREE_BASE: "a base that moves freely",
}
VALUES = {
    LookAlikeKind.BRANCH: "values",
    LookAlikeKind.ELASTIC_BASE: "values",
    LookAlikeKind.FREE_BASE: "values for one of many possible mb",
}


def look_alikes_of(selection: Selection) -> LookAlikes:
    """Look-alikes of the selected structure, none if nothing is selected."""
    if not selection.selected or not selection.explanation.explains or selection.question:
        return LookAlikes(not_looked_for="nothing is selected")
    if isinstance(selection.task.cost, JointCost):
        return LookAlikes(not_looked_for="several responses were fitted together")
    if selection.task.fixed or selection.task.bounds:
        return LookAlikes(not_looked_for="values are given or bounded")
    chain, values = selection.selected.chain, selection.selected.estimate.parameters
    of, near = look_alikes(chain, values), tuple[LookAlike, ...]()
    if of.base_differs:
        omega, rho = selection.judging.parts[0].measured.omega, selection.explanation.scatter.rho
        near = near_bases(chain, values, omega, rho)
    known = {x.kind for x in (*of.found, *near)}
    more = (x for x in selection.outside if x.kind not in known)
    as_well = (LookAlike(x.kind, x.text, x.values, x.apart) for x in more)
    return replace(of, near=(*near, *as_well))


def better_outside(selection: Selection) -> tuple[Outside, ...]:
    """Machines outside the candidates that explain the data better than the described structure."""
    return tuple(x for x in selection.outside if x.is_better)


def better_in_words(selection: Selection) -> str:
    """Those machines, each with its misfit; "" where none is found."""
    return " or ".join(
        f"{_name_kind(x.kind, x.text)} (chi2 {x.chi2:.3g})" for x in better_outside(selection)
    )


def commands_for_outside(selection: Selection) -> Iterator[str]:
    """Commands to fit these machines, or, where none is found, others."""
    found = better_outside(selection)
    if not any(c.chain.gap for c in selection.candidates) and (
        not found or any(x.kind is LookAlikeKind.ELASTIC_BASE for x in found)
    ):
        yield "fit drives on an elastic base too (--base)"
    branches = [x.text for x in found if x.kind is LookAlikeKind.BRANCH]
    for text in branches[:1]:
        yield f'fit the branch beside the chains (--models "{text}" with --masses)'
    if not found:
        yield (
            'fit machines with a branch beside the chains, such as --models "1=2, 1=3; F1; S1"'
            " --ground-damper, or chains of more masses (--masses)"
        )


def look_alike_clause(selection: Selection) -> Iterator[str]:
    """Where other machines than chains have the response of the selected structure, with other
    values, in one clause.
    """
    of = look_alikes_of(selection)
    same, near = (
        with_or([A[kind] for kind in A if any(x.kind is kind for x in each)])
        for each in (of.found, of.near)
    )
    if same:
        within = f", {near} within the scatter" if near else ""
        yield f"{same} would give the same response{within}, with other values (see look-alikes)"
    elif near:
        yield (
            f"{near} would give the same response within the scatter, with other values (see"
            " look-alikes)"
        )


def exchanged(selection: Selection) -> tuple[Candidate, ...]:
    """The selected structure at its other sets of values with exactly the same response."""
    return selection.members[0].exchanged if selection.members else ()


def one_set_of(selection: Selection) -> str:
    """Caveat for values of which there are other sets with the same response, else ""."""
    count = len(exchanged(selection))
    return f"for one of {count + 1} sets with the same response" if count else ""


def is_other(value: float, first: float) -> bool:
    """Return True if a value in another set is not the first one but for rounding."""
    return not isclose(value, first, rel_tol=ROUNDING)


def exchange_clause(selection: Selection) -> Iterator[str]:
    """That other values of the selected structure have exactly the same response; of a drive on an
    elastic base, which resonance is the base's.
    """
    others = exchanged(selection)
    if not others:
        return
    first = selection.members[0]
    sets = [first.candidate.estimate.parameters, *(c.estimate.parameters for c in others)]
    chain = first.candidate.chain
    if is_on_base(chain):
        hertz = with_or([f"{np.sqrt(at['k01'] / at['m1']) / (2 * np.pi):.4g}" for at in sets])
        yield (
            f"{base_text(chain.n_masses - 1)} (mass 1), with its resonance at {hertz} Hz: which one"
            " is the base's is not decided, each choice has other values and exactly this response"
        )
    else:
        yield (
            f"{len(sets)} sets of values of {first.name} have exactly this response: which one is"
            " true is not decided"
        )


def look_alike_sentences(selection: Selection) -> Iterator[str]:
    """One sentence for each look-alike; why none is named; the way to fit an elastic base."""
    yield from (
        f"outside the candidates: {_name_kind(x.kind, x.text)} explains this data better"
        f" (chi2 {x.chi2:.3g}){_values(x.kind, x.values)}"
        for x in better_outside(selection)
    )
    of = look_alikes_of(selection)
    if of.not_looked_for:
        if (
            not selection.explanation.explains
            and _may_have_base(selection)
            and not better_outside(selection)
        ):
            yield (
                "no candidate stands on an elastic base; --base adds those with force and encoder"
                " between base and motor"
            )
        elif selection.selected and selection.selected.chain.gap == 1:
            yield "mass 1 is the base if the force acts between base and motor (mass 2)" + (
                "; d12 is the friction between them" if selection.selected.chain.gap_damper else ""
            )
        elif selection.selected:
            yield f"look-alikes outside the candidates were not looked for: {of.not_looked_for}"
        return
    yield from (f"look-alike: {_sentence(x)}" for x in (*of.found, *of.near))
    if of.lossless:
        yield (
            f"without dampers the branch{'es' if len(of.lossless) > 1 else ''}"
            f" {' and '.join(of.lossless)} would have the same responses: only damping tells"
            " a branch from this chain"
        )
    if not (of.found or of.near):
        yield "no branch of as many masses and no base is proven to have the same responses"
    is_near = any(x.kind is LookAlikeKind.ELASTIC_BASE for x in of.near)
    if of.base_differs and not is_near:
        offer = "; --base fits drives on one" if _may_have_base(selection) else ""
        yield (
            "an elastic base (force and encoder between base and motor) has other responses, and"
            f" none was found within the scatter{offer}"
        )


def _may_have_base(selection: Selection) -> bool:
    return not selection.question and all(c.chain.gap == 0 for c in selection.candidates)


def look_alikes_to_dict(selection: Selection) -> dict[str, Any]:
    """Plain data of the look-alikes, values in SI units."""
    of = look_alikes_of(selection)
    return {
        "not_looked_for": of.not_looked_for,
        "base_differs": of.base_differs,
        "lossless": list(of.lossless),
        "found": [_to_dict(x) for x in of.found],
        "near": [_to_dict(x) | {"apart": x.apart} for x in of.near],
    }


def _to_dict(x: LookAlike) -> dict[str, Any]:
    return {
        "kind": x.kind.value,
        "name": x.text,
        "sentence": _sentence(x),
        "values": dict(x.values) if x.values is not None else None,
    }


def _sentence(x: LookAlike) -> str:
    what = _name_kind(x.kind, x.text)
    if x.kind is not LookAlikeKind.BRANCH:
        what += f" ({RELATIVE})"
    reduced = "" if x.kind is LookAlikeKind.BRANCH else f"; {REDUCED}"
    differ = f"they differ by up to {percent(x.apart)}"
    near = f" within the scatter of this data ({differ})" if x.apart else ""
    return f"{what} has the same responses{near}{reduced}{_values(x.kind, x.values)}"


def _name_kind(kind: LookAlikeKind, text: str) -> str:
    """Such as: a branch 1=2, 1=3; F1; S1."""
    return f"a branch {text}" if kind is LookAlikeKind.BRANCH else text


def _values(kind: LookAlikeKind, values: Mapping[str, float] | None) -> str:
    if values is None:
        return ""
    return f"; {VALUES[kind]}: {', '.join(f'{n} = {x:.5g}' for n, x in values.items())}"
