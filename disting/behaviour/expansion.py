"""The transfer function of a chain written out in its parameters: where a person reads it or an
identity is proven; its moment invariants with the rows of their Jacobian, where a rank is proven.

With G = num/den of (24), leading coefficient c of the denominator: coefficient (25) number i is
n_i / c or d_i / c, and Markov parameter (30) number k is g_k / c^(k+1), g_k = c^k n_(m-k) -
sum_(i=1..k) d_(m-i) c^(i-1) g_(k-i), m the denominator's degree.

All G_k but G_0 are functions of the coefficients of G - G_0 (numerator r_i / c^2, r_i = c n_i -
n_m d_i), so their rank is at most that of these coefficients: fewer and shorter polynomials.

Other units of force and of time multiply parameters and invariants by constants, so they leave the
rank alone. In the units in which the first mass and the first spring are one, the Jacobian has two
symbols less.
"""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from flint import fmpz_mpoly

from disting.algebra.determinants import rank
from disting.algebra.notation import Expr, quotient, symbol
from disting.algebra.symbols import coefficients, rename_symbols, symbols
from disting.behaviour.transfer import plain_receptance
from disting.model.chain import Chain, Sensor
from disting.model.names import read_together
from disting.model.structure import Structure
from disting.renamed import renamed

Quotient = tuple[fmpz_mpoly, fmpz_mpoly]

NO_UNITS: Mapping[str | int, int] = MappingProxyType({})


def expand(structure: Structure) -> Quotient:
    """Numerator and denominator of the transfer function (24) without dead time, in lowest terms
    for every chain of the class.

    They are polynomials in s and the parameters with integer coefficients; only powers of s had to
    be cancelled.

    >>> expand(Chain(1, damped=False).structure)
    (1, m1)
    """
    num, den = numerator_and_denominator(structure)
    s = num.context().gens()[0]
    power = min(_valuation(num), _valuation(den))
    return num // s**power, den // s**power


def numerator_and_denominator(structure: Structure) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Numerator (times s to the sensor's order) and denominator, common powers of s not
    cancelled; s is the first symbol.
    """
    ring = symbols(["s", *structure.parameters])
    num, den = plain_receptance(structure, ring, ring["s"], ring["s"] ** 0)
    return num * ring["s"] ** structure.sensor_order, den


@renamed(sensor="quantity")
def transfer_function(
    chain: Chain | str, *, damped: bool | None = None, quantity: Sensor | str | None = None
) -> Expr:
    """G(s) from force to sensor as a SymPy expression in s and positive symbols named as the
    parameters.

    The quotient of two polynomials in s, a lag among its poles, times exp(-s Td) where there is a
    dead time. A chain can be named, such as "3:1+b2": `damped` and `quantity` say then how it is
    meant. Raises InputError for a text that names no chain.

    >>> transfer_function("2:1", damped=False)
    (k12 + m2*s**2)/(k12*m1 + k12*m2 + m1*m2*s**2)
    """
    from sympy import exp

    (chain,) = read_together([chain], damped=damped, sensor=quantity)
    num, den = expand(chain.structure)
    rational = quotient(coefficients(num, "s"), coefficients(den, "s"))
    return rational * exp(-symbol("s") * symbol("Td")) if chain.dead_time else rational


def is_renaming(left: Structure, right: Structure, renaming: dict[str, str]) -> bool:
    """Whether renaming the left parameters turns the left transfer function into the right one: an
    exact identity.

    A dead time is a factor of its own, so it can only become the other's dead time.
    """
    if left.dead_time != right.dead_time or (left.dead_time and renaming["Td"] != "Td"):
        return False
    return become(expand(left), expand(right), renaming)


def become(a: Quotient, b: Quotient, renaming: Mapping[str, str]) -> bool:
    """Whether renaming turns one numerator and its denominator into the other ones: an identity."""
    ring = symbols([str(g) for g in b[1].context().gens()])
    num, den = (rename_symbols(p, ring, renaming) for p in a)
    return (num, den) == b or bool(num * b[1] == b[0] * den)


def _valuation(polynomial: fmpz_mpoly) -> int:
    return min((powers[0] for powers in polynomial.monoms()), default=0)


def rank_is_at_most(structure: Structure, labels: Sequence[str], most: int, seconds: float) -> bool:
    """Proof that the Jacobian's rows with these labels (b_i, a_i, G_k; none = all coefficients)
    have no larger generic rank.

    False says nothing. Raises OutOfTimeError after about `seconds`.

    >>> from disting.model.family import Family
    >>> rank_is_at_most(Family(3, damped=True)[7].structure, (), 6, 5.0)
    True
    """
    top, bottom = (coefficients(part, "s") for part in expand(structure))
    names = [name for name in structure.parameters if name != "Td"]
    units: dict[str | int, int] = {
        next(name for name in names if name[0] == kind): 1
        for kind in "mk"
        if any(name[0] == kind for name in names)
    }
    return coefficients_have_rank([(top, bottom)], names, labels, most, seconds, units)


def coefficients_have_rank(
    entries: Sequence[tuple[Sequence[fmpz_mpoly], Sequence[fmpz_mpoly]]],
    names: Sequence[str],
    labels: Sequence[str],
    most: int,
    seconds: float,
    units: Mapping[str | int, int] = NO_UNITS,
) -> bool:
    """Proof that coefficients of transfer functions have a Jacobian of rank `most` at most, in the
    parameters `names`; `units`: parameters that are one without loss of generality.

    `entries`: numerator and denominator of each, coefficients of s^0, s^1, ..; `labels` as in
    `rank_is_at_most`, of a single transfer function. False says nothing. Raises OutOfTimeError.
    """
    if not labels:
        every = [
            (ratio, 1, bottom[-1]) for top, bottom in entries for ratio in (*top, *bottom[:-1])
        ]
        return rank([_row(names, units, *ratio) for ratio in every], seconds) <= most
    ((top, bottom),) = entries
    lead = bottom[-1]
    if all(name[0] == "G" and name != "G0" for name in labels):
        proper = [
            *((r, 2) for r in _strictly_proper(top, bottom)),
            *((d, 1) for d in bottom[:-1]),
        ]
        if rank([_row(names, units, *entry, lead) for entry in proper], seconds) <= most:
            return True
    rows = [_row(names, units, *_invariant(name, top, bottom), lead) for name in labels]
    return rank(rows, seconds) <= most


def _invariant(
    name: str, tops: Sequence[fmpz_mpoly], bottoms: Sequence[fmpz_mpoly]
) -> tuple[fmpz_mpoly, int]:
    """Numerator of an invariant, and the power of the leading coefficient below it."""
    kind, number = name[0], int(name[1:])
    if kind == "G":
        return _markov(number, tops, bottoms), number + 1
    chosen = tops if kind == "b" else bottoms
    return (chosen[number] if number < len(chosen) else 0 * bottoms[0]), 1


def _strictly_proper(tops: Sequence[fmpz_mpoly], bottoms: Sequence[fmpz_mpoly]) -> list[fmpz_mpoly]:
    """r_i of G - G_0."""
    if len(tops) < len(bottoms):
        return [bottoms[-1] * n for n in tops]
    return [bottoms[-1] * n - tops[-1] * d for n, d in zip(tops[:-1], bottoms[:-1], strict=True)]


def _markov(number: int, tops: Sequence[fmpz_mpoly], bottoms: Sequence[fmpz_mpoly]) -> fmpz_mpoly:
    """g_k by the recursion."""
    lead, m, zero = bottoms[-1], len(bottoms) - 1, 0 * bottoms[0]
    parameters: list[fmpz_mpoly] = []
    for k in range(number + 1):
        g = lead**k * (tops[m - k] if 0 <= m - k < len(tops) else zero)
        for i in range(1, min(k, m) + 1):
            g -= bottoms[m - i] * lead ** (i - 1) * parameters[k - i]
        parameters.append(g)
    return parameters[number]


def _row(
    names: Sequence[str],
    units: Mapping[str | int, int],
    top: fmpz_mpoly,
    power: int,
    lead: fmpz_mpoly,
) -> list[fmpz_mpoly]:
    """Gradient of top / lead^power, times lead^(power+1), in the units in which those parameters
    are one.
    """
    unknowns = dict(units)
    value, below = (p.subs(unknowns) for p in (top, lead))
    return [
        top.derivative(name).subs(unknowns) * below
        - power * value * lead.derivative(name).subs(unknowns)
        for name in names
    ]
