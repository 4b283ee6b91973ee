"""Equivalents that theorems give: symmetries, duality, and Cauer's continued fraction.

In x = s^2 the receptance N/D of a row of masses at its end obeys D/N = m x + 1/(1/k + N'/D'),
N'/D' that of the rest (Cauer's continued fraction): m is the ratio of leading coefficients, k the
limit of P/N, P = D - m x N, and the next receptance is (N - P/k)/P. A free end leaves nothing
after the last mass, a wall nothing after the last spring. No root is taken, so the map is rational
from every chain whose receptance, or that of one of its rows, belongs to one place (force and
sensor together).

Proportional damping: all springs have the same ratio d/k = tau. What holds without dampers then
holds with them.

With K the stiffness matrix and D = tau K, A(s) = M s^2 + (1 + tau s) K = (1 + tau s)(M u + K), u =
s^2/(1 + tau s). So the receptance is H(s) = H0(u)/(1 + tau s), with u in place of s^2 in H0, the
receptance without dampers: two undamped chains have the same receptance exactly if they have with
D = tau K, for every tau. Equivalents of other damping are not found this way.

Symmetries (`disting.model.symmetry`) rename parameters; the duality theorem
(`disting.fibres.synthesis.theorems`) applies where both ports sit at the two sides of the gap. All
are exact in any field, numbers or rational functions, and keep positive parameters positive.
Symmetries, duality, symmetries again: more duality leads back, as only the mirrored form leaves
the gap.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

from flint import fmpq

from disting.algebra.symbols import RationalFunction, coefficients, symbols
from disting.behaviour.transfer import plain_receptance
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Solution, target
from disting.fibres.synthesis.theorems import are_dual, dual
from disting.model.chain import Chain, Ports, Structure
from disting.model.symmetry import forms

Outwards = tuple[
    list[RationalFunction], list[RationalFunction]
]  # masses and springs from the port outwards
DUALITY = "duality of chains with both ports at the gap"


@dataclass(frozen=True, slots=True)
class Expansion:
    """A chain that continued fractions lead to; `values` works out its parameters."""

    chain: Chain
    values: Callable[[], dict[str, RationalFunction]]


def expansions(chain: Chain) -> Iterator[Expansion]:
    """The chains as driven from the end of the whole receptance, of the free row, of the grounded
    row, or of both rows.
    """
    if chain.damped or chain.ground_dampers or chain.lag or chain.dead_time:
        return
    n, g = chain.n_masses, chain.gap
    if chain.collocated:
        plain = replace(chain, gap=0, act_minus=0, act_plus=1, meas_minus=0, meas_plus=1)
        yield Expansion(
            plain,
            lambda: _name_values(plain, *_expand_row(chain, chain.structure.ports, wall=False)),
        )
    if not g:
        return
    for free, grounded in product(
        (chain.act_plus == chain.meas_plus, False), (chain.act_minus == chain.meas_minus, False)
    ):
        if free or grounded:
            yield _by_rows(chain, n, g, free, grounded)


def row_from_end(
    num: list[RationalFunction], den: list[RationalFunction], *, wall: bool
) -> Outwards:
    """Masses and springs from coefficients in x, lowest first, without vanishing leading ones.

    >>> row_from_end([0.5], [3.0, 1.0], wall=True)
    ([2.0], [6.0])
    """
    masses: list[RationalFunction] = []
    springs: list[RationalFunction] = []
    while num:
        masses.append(den[-1] / num[-1])
        rest = [d - masses[-1] * n for d, n in zip(den[1:-1], num[:-1], strict=True)]
        rest = [den[0], *rest]
        if len(num) == 1 and not wall:
            break
        springs.append(rest[-1] / num[-1])
        num, den = [n - p / springs[-1] for n, p in zip(num[:-1], rest[:-1], strict=True)], rest
    return masses, springs


def _by_rows(start: Chain, n: int, g: int, free: bool, grounded: bool) -> Expansion:
    """The chain with one or both rows as driven from the gap, the other one unchanged."""
    chain = replace(start, act_plus=g + 1, meas_plus=g + 1) if free else start
    chain = replace(chain, act_minus=g, meas_minus=g) if grounded else chain

    def values() -> dict[str, RationalFunction]:
        """Masses and springs in terms of those of the given chain."""
        functions = {
            name: RationalFunction(p, p**0) for name, p in _ring(start).items() if name != "s"
        }
        masses, springs = (
            [functions[f"m{i}"] for i in range(1, n + 1)],
            [functions[k] for k in functions if k[0] == "k"],
        )
        if free:
            masses[g:], springs[g:] = _expand_row(
                start, Ports(0, start.act_plus, 0, start.meas_plus), wall=False
            )
        if grounded:
            inner = _expand_row(
                start,
                Ports(start.act_minus, 0, start.meas_minus, 0),
                wall=True,
            )
            masses[:g], springs[:g] = inner[0][::-1], inner[1][::-1]
        return _name_values(chain, masses, springs)

    return Expansion(chain, values)


def _expand_row(chain: Chain, ports: Ports, *, wall: bool) -> Outwards:
    """The row with the receptance of the given chain between these ports."""
    structure: Structure = replace(chain.structure, ports=ports)
    ring = _ring(chain)
    one_of_ring = ring["s"] ** 0
    sides = plain_receptance(structure, ring, ring["s"], one_of_ring)
    num, den = (
        [RationalFunction(c, one_of_ring) for c in coefficients(p, "s")[::2]] for p in sides
    )
    return row_from_end(num, den, wall=wall)


def _ring(chain: Chain) -> dict[str, Any]:
    return symbols(["s", *chain.parameters])


def _name_values(
    chain: Chain, masses: list[RationalFunction], springs: list[RationalFunction]
) -> dict[str, RationalFunction]:
    return dict(zip(chain.parameters, [*masses, *springs], strict=True))


def common_ratio(chain: Chain, point: Mapping[str, fmpq]) -> Any | None:
    """tau = d/k if it is the same for all springs of a damped chain without other dampers."""
    if not chain.damped or chain.ground_dampers or chain.lag or chain.dead_time:
        return None
    ratios = {point[f"d{name[1:]}"] / point[name] for name in chain.parameters if name[0] == "k"}
    return ratios.pop() if len(ratios) == 1 else None


def proportional_solutions(
    chain: Chain, point: Mapping[str, fmpq], other: Chain
) -> tuple[Solution, ...]:
    """The solutions of `other` with proportional damping too, where the given damping is
    proportional.
    """
    tau = common_ratio(chain, point)
    if tau is None or not other.damped or other.ground_dampers or other.lag or other.dead_time:
        return ()
    plain, bare = replace(chain, damped=False), replace(other, damped=False)
    the_fibre = fibre(
        bare, target(plain.structure, {name: point[name] for name in plain.parameters})
    )
    return tuple(
        replace(s, values=_with_dampers(other, s.values, tau)) for s in the_fibre.solutions
    )


def _with_dampers(chain: Chain, values: dict[str, Any], tau: Any) -> dict[str, Any]:
    return {
        name: values[f"k{name[1:]}"] * tau if name[0] == "d" else values[name]
        for name in chain.parameters
    }


@dataclass(frozen=True, slots=True)
class Image:
    """A chain with the same transfer function, its parameters, and the theorems that lead to it
    (none: the chain itself).
    """

    chain: Chain
    values: Mapping[str, Any]
    steps: tuple[str, ...]


def images(chain: Chain, values: Mapping[str, Any]) -> tuple[Image, ...]:
    """All of them, the chain itself first, those by fewer theorems before the others, none twice.

    >>> two = Chain(2, damped=False)
    >>> [str(i.chain) for i in images(two, {"m1": 1.0, "m2": 2.0, "k12": 3.0})][1]
    '2 masses, gap 0, force 2-0, sensor 2-0'
    """
    the_images: list[Image] = []
    for image in (
        *_move_by_symmetries(Image(chain, values, ())),
        *_duals(Image(chain, values, ())),
    ):
        if not any(
            image.chain == own_image.chain and image.values == own_image.values
            for own_image in the_images
        ):
            the_images.append(image)
    return tuple(sorted(the_images, key=lambda image: len(image.steps)))


def dual_chain(chain: Chain) -> Chain | None:
    """The chain that the duality theorem leads to, if it applies.

    >>> dual_chain(Chain(3, damped=True)) == Chain(3, 2, 2, 3, 2, 3, damped=True)
    True
    """
    h = chain.n_masses - 1 - chain.gap
    other = replace(chain, gap=h, act_minus=h, act_plus=h + 1, meas_minus=h, meas_plus=h + 1)
    return other if are_dual(chain, other) else None


def _move_by_symmetries(image: Image) -> Iterator[Image]:
    """The forms of a chain by symmetries."""
    for form in forms(image.chain):
        values = {form.renaming[name]: value for name, value in image.values.items()}
        ordered = {name: values[name] for name in form.chain.parameters}
        yield Image(form.chain, ordered, (*image.steps, *(s.value for s in form.symmetries)))


def _duals(image: Image) -> Iterator[Image]:
    for form in _move_by_symmetries(image):
        other = dual_chain(form.chain)
        if other is not None:
            yield from _move_by_symmetries(
                Image(other, dual(form.chain, form.values), (*form.steps, DUALITY))
            )
