"""Limits of chains of as many masses, row by row: whether generic models of one chain are limits
of models of another one.

Notation of `disting.fibres.ideals.splits`: x, q, a chain with a gap h is a sum H = R + F, R =
N_R/D_R, F = N_F/D_F, deg D_R = A = q h, x^q divides D_F, deg D_F = B. Let the generic receptance
n/d of the smaller chain, in lowest terms, be a limit of models of the larger one: pairs (N_k :
D_k) of these converge to (n : d), D_k = D_Rk D_Fk, N_k = N_Rk D_Fk + N_Fk D_Rk. (The closure of
the image of a polynomial map is the same in the topologies of Zariski and of the complex numbers.)

Theorem. Then n/d = R + F, where (N_R : D_R) and (N_F : D_F) are limits of the rows' pairs and deg
D_R = A, deg D_F = B.

Proof. Scale D_Rk and D_Fk so that their largest coefficients have the modulus 1, and go over to a
subsequence for which they converge, to D_R and D_F, which are not zero. Then D_k converges to D_R
D_F, not zero, which thus is d up to a factor, and N_k, in the same scale, to n times this factor.
d has the degree A + B: so deg D_R = A, deg D_F = B. d has 0 as a root of order q and simple roots
else, and x^q divides every D_Fk and so D_F: D_R and D_F are coprime. So (u, v) -> u D_F + v D_R is
injective where deg u < A, deg v < B, and so are the maps with D_Fk and D_Rk, with inverses that
converge: N_Rk and N_Fk converge too.

The theorem of `splits` uses nothing of the larger chain but that numerators have at most certain
degrees, which limits keep. So if it applies, the summands of n/d are among its three splits.
Conversely, where in a split both are limits of what the larger chain's rows can be, their
sum is a limit of its models. So `of_closure` looks at each row:

* INSIDE: it is the very same map. FULL: its rank is the number of its coefficients, up to a common
  factor, that do not vanish identically, so its closure is the linear space of all such. MOMENTUM:
  a free damped row has a_2 b_1 = a_3 b_0 (see `meeting`), an irreducible quadric; where the rank
  is one less than in FULL, its closure is this quadric. A rank seen modulo a prime is a lower
  bound of the rank, so nothing of this is left to chance.
* COEFFICIENT: one that vanishes identically in the row and not in what is wanted.
* RESULTANT: see `end_rows` and `inner_rows`. EQUATION: see `row_equations`, found with an error
  bound.
"""

from dataclasses import dataclass, replace

from disting.algebra.certainty import LEAST_SAFETY, joint_safety
from disting.algebra.sampling import about, prime, residues
from disting.behaviour.powers import powers
from disting.evidence.limits import SUPPORTS, WHOLE, Outside, RowLimits, RowsInside, Why
from disting.fibres.ideals import CoefficientMap, normalised
from disting.fibres.ideals.fibre_ideal import evaluated, generic_rank
from disting.fibres.ideals.monodromy import poles_are_inseparable
from disting.fibres.ideals.splits import gap, has_relation, is_plain, power, receptances, splits
from disting.fibres.ideals.system import terms
from disting.model.chain import Chain, Sensor
from disting.model.row import FREE, Row, canonical_rows
from disting.model.structure import Structure
from disting.questions.inclusion.end_rows import end_resultant
from disting.questions.inclusion.inner_rows import inner_resultant
from disting.questions.inclusion.row_equations import equation_safety, label_of, row_equation

# masses of a row whose equations are looked for: those of larger ones have too many monomials
LARGEST_ROW = 3
# label of the points where ranks are seen: they prove what they show, so all pairs may share them
RANKS = "ranks of rows"
TRIALS = 3  # primes and points at which an equation must not vanish
Support = tuple[frozenset[int], frozenset[int]]


@dataclass(frozen=True, slots=True)
class Wanted:
    """A receptance wanted of a row of the larger chain in one split, with the map and the row that
    are there; `name`: "grounded", "free", "whole".
    """

    split: str
    name: str
    receptance: CoefficientMap
    there: CoefficientMap
    row: Row


def of_closure(small: Chain, large: Chain, seed: str) -> tuple[Outside | RowsInside, int] | None:
    """What the rows tell about limits, with the bits of its error bound (0: proven); None if
    nothing.

    >>> end, next_to_end = (Chain(3, 0, 0, 1, 0, mass, damped=True) for mass in (3, 2))
    >>> of_closure(end, next_to_end, "doc")[0].steps[0].why
    <Why.MOMENTUM: 'momentum'>
    """
    given, other = (
        replace(c, sensor=Sensor.POSITION, dead_time=False).structure for c in (small, large)
    )
    if not _alike(given, other):
        return None
    label = about(seed, small)
    found = {
        name: [(p, _shown(p, label)) for p in some]
        for name, some in _by_split(given, other, large).items()
    }
    for told in found.values():
        if told and all(why is not None and why[0] in SUPPORTS for _, why in told):
            return RowsInside(True, tuple(_step(p, why) for p, why in told if why is not None)), 0
    if not _covered(given, other, f"{seed}:{small}:poles"):
        return None
    against = [
        next(((p, why) for p, why in told if why is not None and why[0] not in SUPPORTS), None)
        for told in found.values()
    ]
    if any(one is None for one in against):
        return None
    outside = Outside(True, tuple(_step(*one) for one in against if one is not None))
    return outside, joint_safety(
        _safety(p.row) for p, why in filter(None, against) if why[0] is Why.EQUATION
    )


def confirms_rows(evidence: Outside | RowsInside, small: Chain, large: Chain) -> bool:
    """Whether the steps are those of all rows of one split, or of one row of every split, and
    each of them holds again.
    """
    given, other = (
        replace(c, sensor=Sensor.POSITION, dead_time=False).structure for c in (small, large)
    )
    if not _alike(given, other):
        return False
    possible = {
        (w.split, w.name): w for some in _by_split(given, other, large).values() for w in some
    }
    named = [(step.split, step.part) for step in evidence.steps]
    if len(set(named)) < len(named) or not set(named) <= possible.keys():
        return False
    told, ways = {split for split, _ in named}, [split for split, _ in possible]
    if isinstance(evidence, RowsInside):
        complete = len(told) == 1 and len(named) == sum(split in told for split in ways)
    else:
        complete = told == set(ways) and _covered(given, other, "verify:poles")
    sides = all(
        (step.why in SUPPORTS) == isinstance(evidence, RowsInside) for step in evidence.steps
    )
    return (
        complete
        and sides
        and all(_holds(step, possible[step.split, step.part]) for step in evidence.steps)
    )


def _alike(given: Structure, other: Structure) -> bool:
    """Whether both are plain, of one size and damping."""
    kinds = [(s.n_masses, power(s)) for s in (given, other)]
    return is_plain(given) and is_plain(other) and kinds[0] == kinds[1]


def _covered(given: Structure, other: Structure, label: str) -> bool:
    """Whether no other splits are possible: the theorem of `splits` applies, or the larger chain
    is one row.
    """
    return gap(other) == 0 or (
        has_relation(receptances(other), power(other)) and poles_are_inseparable(given, label)
    )


def _by_split(given: Structure, other: Structure, large: Chain) -> dict[str, list[Wanted]]:
    rows = canonical_rows(large.structure)
    if gap(other) == 0:
        wanted, there = normalised(given), normalised(other)
        return {
            WHOLE: (
                [Wanted(split=WHOLE, name=WHOLE, receptance=wanted, there=there, row=rows[FREE])]
                if wanted.degrees[1] == there.degrees[1]
                else []
            )
        }
    found = {}
    for split in splits(given, gap(other)):
        pairs = zip(split.receptances.named, receptances(other).named, strict=True)
        found[split.name] = [
            Wanted(split=split.name, name=name, receptance=wanted, there=there, row=rows[name])
            for (name, wanted), (_, there) in pairs
        ]
    return found


def _step(wanted: Wanted, shown: tuple[Why, str]) -> RowLimits:
    return RowLimits(wanted.split, wanted.name, *shown)


def _shown(wanted: Wanted, label: str) -> tuple[Why, str] | None:
    """What settles a row, the cheapest first; None if nothing does."""
    named = f"{label}:{label_of(wanted.row)}"
    return next(filter(None, (test(wanted, named) for test in _TESTS)), None)


def _inside(wanted: Wanted, label: str) -> tuple[Why, str] | None:
    return (Why.INSIDE, "") if wanted.receptance == wanted.there else None


def _coefficient(wanted: Wanted, label: str) -> tuple[Why, str] | None:
    pairs = zip("ba", _support(wanted.receptance), _support(wanted.there), strict=True)
    more = [f"{letter}{i}" for letter, here, there in pairs for i in sorted(here - there)]
    return (Why.COEFFICIENT, more[-1]) if more else None


def _full(wanted: Wanted, label: str) -> tuple[Why, str] | None:
    if _coefficient(wanted, label) is not None:
        return None
    missing = _coordinates(wanted.there) - generic_rank(wanted.there, RANKS)
    if missing == 0:
        return Why.FULL, ""
    return (Why.MOMENTUM, "") if missing == 1 and _keeps_momentum(wanted) else None


def _resultant(wanted: Wanted, label: str) -> tuple[Why, str] | None:
    modulus = prime(label)
    coefficients = _at(wanted.receptance, label, modulus)
    found = (made(wanted.row, *coefficients, modulus) for made in (end_resultant, inner_resultant))
    return (Why.RESULTANT, "") if any(found) else None


def _equation(wanted: Wanted, label: str) -> tuple[Why, str] | None:
    if (
        wanted.row.n_masses > LARGEST_ROW
        or _coefficient(wanted, label) is not None
        or _safety(wanted.row) < LEAST_SAFETY
    ):
        return None
    return (
        (Why.EQUATION, label)
        if all(_does_not_vanish(wanted, f"{label}:{k}") for k in range(TRIALS))
        else None
    )


_TESTS = (_inside, _coefficient, _full, _resultant, _equation)
_OF = {
    Why.INSIDE: _inside,
    Why.FULL: _full,
    Why.MOMENTUM: _full,
    Why.RESULTANT: _resultant,
}


def _holds(step: RowLimits, wanted: Wanted) -> bool:
    """Whether a step holds at fresh points; an equation is found again."""
    if step.why is Why.COEFFICIENT:
        pairs = zip("ba", _support(wanted.receptance), _support(wanted.there), strict=True)
        return any(
            step.detail == f"{letter}{i}" for letter, here, there in pairs for i in here - there
        )
    if step.why is Why.EQUATION:
        return _equation(wanted, step.detail) is not None
    return _OF[step.why](wanted, "verify") == (step.why, step.detail)


def _support(model: CoefficientMap) -> Support:
    """Powers of s whose coefficients do not vanish identically."""
    num, den = (
        frozenset(i for i, c in enumerate(p) if not c.is_zero())
        for p in (model.numerator, model.denominator)
    )
    return num, den


def _coordinates(model: CoefficientMap) -> int:
    """Coefficients up to a common factor that do not vanish identically."""
    return sum(map(len, _support(model))) - 1


def _keeps_momentum(wanted: Wanted) -> bool:
    """Whether a_0 = a_1 = 0 and a_2 b_1 = a_3 b_0 hold in both identically, none of the four
    being zero in what is there.
    """
    for m in (wanted.receptance, wanted.there):
        a, b = (*m.denominator, *m.denominator[:1] * 4), (*m.numerator, m.denominator[0])
        if len(m.denominator) < 4 or not (
            a[0].is_zero() and a[1].is_zero() and a[2] * b[1] == a[3] * b[0]
        ):
            return False
    num, den = _support(wanted.there)
    return {0, 1} <= num and {2, 3} <= den


def _at(model: CoefficientMap, label: str, modulus: int) -> tuple[list[int], list[int]]:
    """Coefficients of numerator and denominator at the point of a label, modulo a prime."""
    point = residues(label, len(model.parameters), modulus)
    num, den = (
        [evaluated(terms(c), point, modulus) for c in p]
        for p in (model.numerator, model.denominator)
    )
    return num, den


def _does_not_vanish(wanted: Wanted, label: str) -> bool:
    """Whether the row's equation of this label does not hold at a random point of what is
    wanted.
    """
    equation = row_equation(wanted.row, label)
    if equation is None:
        return False
    num, den = _at(wanted.receptance, f"{label}:wanted", equation.modulus)
    sides = zip((num, den), powers(wanted.row.structure), strict=True)
    return not equation.holds(
        tuple(p[i] if i < len(p) else 0 for p, kept in sides for i in sorted(kept))
    )


def _safety(row: Row) -> int:
    return TRIALS * equation_safety(row)
