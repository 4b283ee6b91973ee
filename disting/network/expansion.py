"""The transfer functions of a network as quotients of polynomials in s and its values.

    G = s^q c^T P^-1 b = s^q det [[P, b], [-c^T, 0]] / det P

Every value enters P to the first power, so it does both determinants, and a value p that divides
enters them as 1/p: both are multiplied by p. A variable of its own represents s^n of a constant
phase element, called n. Powers of s are counted in steps of s^(1/2) where Warburg elements have
half ones; where inductors have s^-1, P is multiplied by s, or s^2 in halves.
"""

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from flint import fmpz_mpoly

from disting.algebra.determinants import Minors, Times, minors
from disting.errors import InputError
from disting.network.network import Element, Network, Port, edges, parts

Ring = Mapping[str, fmpz_mpoly]
"""Generators by name."""
Sides = tuple[fmpz_mpoly, fmpz_mpoly]
"""Numerator and denominator, not in lowest terms."""


def transfer_functions(
    network: Network, ring: Ring, s: str, times: Times
) -> tuple[tuple[Sides, ...], ...]:
    """Those of a network, outputs x inputs, in a ring with all its parameters, a variable for each
    of its exponents and the variable s, which is s^(1/2) where the network has half powers; `times`
    multiplies, or refuses to. Raises InputError where P cannot be inverted.
    """
    plain = network.grounded
    size = max((i for e in plain.elements for i in e.nodes), default=0)
    step = 1 if network.halves else 2
    lift = max((0, *(-e.kind.halves for e in plain.elements))) // step
    unit = ring[s] ** 0
    scale = plain.ratio_scale
    rows = [[unit - unit] * size for _ in range(size)]
    for e in plain.elements:
        power = ring[s] ** (e.kind.halves // step + lift)
        _add(rows, e, ring, power * ring[e.exponent] if e.exponent else power, scale)
    whole = (1 << size) - 1
    determinant = minors(rows, {0: unit}, times).get(whole, unit - unit)
    if determinant.is_zero():
        raise InputError(
            f"{network.name}: no motion or voltage follows from what enters: {_loose(network)}"
            " nothing that holds it; connect it to the ground or give it a mass"
        )
    gained = 2 * network.order // step + lift
    dividing = [e.value for e in plain.elements if e.kind.divides]
    columns = []
    for port in plain.inputs:
        entering = _vector(port, size, unit)
        above = minors([[*r, b] for r, b in zip(rows, entering, strict=True)], {0: unit}, times)
        columns.append(
            [
                _invert_dividing(
                    _border_minors(above, _vector(out, size, unit), unit - unit, times)
                    * ring[s] ** gained
                    * scale**2,
                    determinant,
                    dividing,
                )
                for out in plain.outputs
            ]
        )
    return tuple(zip(*columns, strict=True))


def _loose(network: Network) -> str:
    """Message about nodes that are not held: only gears could hold them."""
    plain = (replace(e, ratio="") for e in network.elements)
    roots = parts((0, *network.nodes), (edge for e in plain for edge in edges(e)))
    node = next((i for i in network.nodes if roots[i]), None)
    return "a part has" if node is None else f"node {node} hangs on gears alone and has"


def _add(
    rows: list[list[fmpz_mpoly]], e: Element, ring: Ring, power: fmpz_mpoly, scale: int
) -> None:
    """Add the term of an element, times the square of a number that makes it whole."""
    term = power * (ring[e.value] if e.value else 1)
    u, v = ({i: _entry(x, ring, scale) for i, x in side.items()} for side in (e.pulls, e.feels))
    for i, x in u.items():
        for j, y in v.items():
            rows[i - 1][j - 1] += term * x * y


def _entry(x: Fraction | str, ring: Ring, scale: int) -> fmpz_mpoly | int:
    return -ring[x] * scale if isinstance(x, str) else int(x * scale)


def _vector(port: Port, size: int, unit: fmpz_mpoly) -> list[fmpz_mpoly]:
    return [unit * port.ends.get(i, 0) for i in range(1, size + 1)]


def _border_minors(
    above: Minors,
    sensor: list[fmpz_mpoly],
    zero: fmpz_mpoly,
    times: Times,
) -> fmpz_mpoly:
    """c^T adj P b, from the minors of the rows [P, b]."""
    last = [*(-x for x in sensor), zero]
    return minors([last], above, times).get((2 << len(sensor)) - 1, zero)


def _invert_dividing(num: fmpz_mpoly, den: fmpz_mpoly, dividing: list[str]) -> Sides:
    """Both with 1/p for values p that divide, times all of these values."""
    if not dividing:
        return num, den
    context = den.context()
    places = [context.variable_to_index(name) for name in dividing]
    sides = []
    for side in (num, den):
        terms = {}
        for powers, number in side.to_dict().items():
            turned = list(powers)
            for at in places:
                turned[at] = 1 - turned[at]
            terms[tuple(turned)] = number
        sides.append(context.from_dict(terms))
    return sides[0], sides[1]
