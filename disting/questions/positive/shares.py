"""Share of the positive models of one chain that have a positive equivalent in another one: all,
some or none.

Strongest grounds first. Theorems that hold for all pairs of a kind: renaming by symmetry, duality,
Foster (ALWAYS); decay, residues, own poles, signs, swapped rows (NEVER, see `obstacles`); the
arrangement of poles and zeros of each row (ALWAYS or SOMETIMES, see `undamped_rows`). Then a
rational point without any equivalent (NEVER, but for a probability that is bounded). Then random
points: one with a positive equivalent and one without (SOMETIMES).

ALWAYS and NEVER speak of generic positive parameters: of all but those on a proper algebraic
subset. SOMETIMES speaks of two open sets. A word is the same for all models near one where balls
decide it (see `points`), so points of undamped models prove it at any length; damped ones, whose
solutions are listed, are never called SOMETIMES by points.

Foster: undamped, both chains with force and sensor at one place. H = sum r_j/(x + l_j) with l_j >=
0, r_j > 0. Any g of the non-zero poles serve for the grounded row R, the others for F. For a row
R = sum r_j/(x + l_j) with n poles the n - 1 zeros -z_i separate the poles, so 1/R = m x + c - sum
t_i/(x + z_i) with m, t_i > 0. Any a - 1 of the zeros serve for the left side, the others for the
right side, W = sum t_i x/(z_i (x + z_i)), plus 1/R(0) >= 0 on the left (0 at a free end, as it
must be). One step of Cauer's continued fraction takes a spring and a mass off W: 1/W = 1/k + F', k
> 0 the limit of W for x to infinity, and F' is of the same form with one zero less; by recursion
all masses and springs are positive. So every choice gives one positive model: C(N-1, g) C(g-1,
a_minus - 1) C(N-g-1, a_plus - g - 1) in all.
"""

from dataclasses import replace

from disting.algebra.certainty import Certainty, about
from disting.decide import SHARE_CHAINS, first_finding
from disting.errors import InputError
from disting.evidence.decision import Exclusion, Theorem
from disting.evidence.positive import (
    Empirical,
    EmptyFibre,
    Interlacing,
    Points,
    PositiveEvidence,
    PositiveFinding,
    RowWords,
    Share,
)
from disting.fibres.synthesis.decide import member, point_bits, rational_point, safety_of_point
from disting.fibres.synthesis.theorems import are_dual
from disting.model.chain import Chain
from disting.model.question import Answer, Membership, Settings
from disting.model.row import Row
from disting.model.symmetry import canonical
from disting.questions.positive.obstacles import (
    Obstacle,
    distances,
    obstacle,
    only_rows_sum_to_zero,
    rows,
    swap_fails,
)
from disting.questions.positive.points import equivalent, random_point, spell
from disting.questions.positive.undamped_rows import Words, words

TRIES = 100  # random points of undamped models, 1 ms each
DAMPED_TRIES = 10


def positive_finding(
    chain: Chain, other: Chain, settings: Settings | None = None
) -> PositiveFinding:
    """Share of the positive models of `chain` that have a positive equivalent in `other`.

    Raises InputError for chains of different size, damping, sensor quantity or dead time.

    >>> one = Chain(4, meas_plus=2, damped=False)
    >>> other = Chain(4, act_plus=2, meas_plus=3, damped=False)
    >>> positive_finding(one, other).share.value
    'always'
    >>> positive_finding(other, one).share.value
    'sometimes'
    """
    refuse(chain, other)
    chain, other = without_dead_time(chain), without_dead_time(other)
    seed = (settings or Settings()).seed
    finding: PositiveFinding | None = first_finding(SHARE_CHAINS.rows, chain, other, seed)
    if finding is None:
        return PositiveFinding(Share.UNKNOWN, reason="ground dampers and a lag are not covered")
    return finding


def are_plain(chain: Chain, other: Chain, seed: str) -> bool:
    """Return True for chains without ground dampers, lag and dead time."""
    return is_plain(chain) and is_plain(other)


def by_theorem(chain: Chain, other: Chain, seed: str) -> PositiveFinding | None:
    """Symmetry, duality, Foster, Cauer: ALWAYS."""
    named = theorem(chain, other)
    if not named:
        return None
    return PositiveFinding(Share.ALWAYS, Certainty.THEOREM, evidence=Theorem(named))


def by_obstacle(chain: Chain, other: Chain, seed: str) -> PositiveFinding | None:
    """Decay, residues, own poles, signs, swapped rows: NEVER (see `obstacles`)."""
    against = obstacle(chain, other)
    if not against:
        return None
    return PositiveFinding(Share.NEVER, Certainty.THEOREM, evidence=Exclusion(against))


def refuse(chain: Chain, other: Chain) -> None:
    """Raise InputError for chains that cannot be compared here."""
    kinds = [(c.n_masses, c.damped, c.sensor, c.dead_time) for c in (chain, other)]
    if kinds[0] != kinds[1]:
        raise InputError("chains of one size, damping, sensor quantity and dead time are compared")


def without_dead_time(chain: Chain) -> Chain:
    """The rational part. Dead times of equal behaviours are equal (see `questions.same.exact`), so
    the rational parts decide.
    """
    return replace(chain, dead_time=False)


def is_plain(chain: Chain) -> bool:
    """Neither ground dampers nor lag nor dead time."""
    return not (chain.ground_dampers or chain.lag or chain.dead_time)


def theorem(chain: Chain, other: Chain) -> str:
    """Name of the theorem by which both are the same over positive parameters, "" if there is none.

    >>> theorem(Chain(3, damped=False), Chain(3, 0, 0, 2, 0, 2, damped=False))
    'Foster'
    >>> theorem(Chain(3, damped=False), Chain(3, 2, 2, 3, 2, 3, damped=False))
    'Cauer'
    """
    mine, theirs = (canonical(c).chain for c in _without_common_factors(chain, other))
    if mine == theirs:
        return "symmetry"
    if not chain.damped and all(is_plain(c) and c.collocated for c in (mine, theirs)):
        return "Cauer" if all(is_continued_fraction(c) for c in (mine, theirs)) else "Foster"
    return "duality" if are_dual(mine, theirs) else ""


def is_continued_fraction(chain: Chain) -> bool:
    """Return True if an undamped collocated chain has one set of positive parameters for each
    function with resonances and antiresonances in turn, special ones too.

    Its only long row is driven at an end. From there its parameters are the terms of Cauer's
    continued fraction, and no resonance has a node there. Two long rows may share a resonance, and
    inside a row a resonance may have a node.
    """
    *grounded, free = rows(chain)
    row = free if not grounded else grounded[0] if free.n_masses == 1 else None
    return row is not None and row.a in (1, row.n_masses)


def _without_common_factors(chain: Chain, other: Chain) -> tuple[Chain, Chain]:
    """Both without the lag and the dead time that both have: equivalents inherit T1 and Td."""
    lag, dead_time = chain.lag and other.lag, chain.dead_time and other.dead_time
    first, second = (
        replace(c, lag=c.lag and not lag, dead_time=c.dead_time and not dead_time)
        for c in (chain, other)
    )
    return first, second


def row_words(chain: Chain, other: Chain) -> tuple[RowWords, ...]:
    """Words that each row of undamped `other` lacks; () where the rows do not correspond or the
    missing words are unknown.
    """
    if chain.gap != other.gap or distances(chain) != distances(other):
        return ()
    pairs = list(zip(rows(chain), rows(other), strict=True))
    compared = tuple(_lacking(a, b) for a, b in pairs)
    is_settled = any(p.lacking for p in compared) or all(_contains_rows(a, b) for a, b in pairs)
    return compared if is_settled else ()


def _lacking(row: Row, other: Row) -> RowWords:
    ports = (row.a, row.b), (other.a, other.b)
    lacking = (
        () if _contains_rows(row, other) else tuple(sorted(_words(row).lower - _words(other).upper))
    )
    return RowWords(row.name, row.n_masses, *ports, lacking)


def _contains_rows(row: Row, other: Row) -> bool:
    """Return True if every positive row of the one type is equivalent to one of the other; mirrored
    ports count as equal (`words`).
    """
    sides = [sorted((s.a - 1, s.n_masses - s.b)) for s in (row, other)]
    return row.distance == 0 or sides[0] == sides[1] or _words(row).upper <= _words(other).lower


def _words(row: Row) -> Words:
    return words(row.n_masses, row.a, row.b)


def by_words(chain: Chain, other: Chain, seed: str) -> PositiveFinding | None:
    """The arrangement of poles and zeros of each row of undamped chains: ALWAYS or SOMETIMES."""
    compared = () if chain.damped else row_words(chain, other)
    if not compared:
        return None
    if not any(p.lacking for p in compared):
        return PositiveFinding(Share.ALWAYS, Certainty.THEOREM, evidence=Interlacing(compared))
    first, empirical = _sample_points(chain, other, seed, TRIES)
    evidence = Interlacing(compared, first.get(Answer.YES, ()), first.get(Answer.NO, ()))
    return PositiveFinding(
        Share.SOMETIMES, Certainty.THEOREM, evidence=evidence, empirical=empirical
    )


def by_points(chain: Chain, other: Chain, seed: str) -> PositiveFinding:
    """Random points: one with a positive equivalent and one without."""
    first, empirical = _sample_points(chain, other, seed, DAMPED_TRIES if chain.damped else TRIES)
    if Answer.YES in first and Answer.NO in first:
        evidence: PositiveEvidence = Points(first[Answer.YES], first[Answer.NO])
        return PositiveFinding(
            Share.SOMETIMES, Certainty.PROVEN, evidence=evidence, empirical=empirical
        )
    return PositiveFinding(
        Share.UNKNOWN, empirical=empirical, reason="no theorem applies; random points are no proof"
    )


def by_swap(chain: Chain, other: Chain, seed: str) -> PositiveFinding | None:
    """Rows that would have to be exchanged, and at one rational point are not: NEVER."""
    point = rational_point(chain, about(f"positivity:{seed}", chain, other), point_bits(other))
    if not (swap_fails(chain, other) and only_rows_sum_to_zero(chain, point, 2 * other.gap)):
        return None
    evidence = Exclusion(Obstacle.SWAPPED, spell(point))
    return PositiveFinding(Share.NEVER, Certainty.PROVEN, evidence=evidence)


def by_empty_fibre(chain: Chain, other: Chain, seed: str) -> PositiveFinding | None:
    """A rational point without any equivalent: NEVER, as surely as the point is generic."""
    finding = member(chain, other, seed)
    if finding.membership is not Membership.EXCLUDED:
        return None
    evidence = EmptyFibre(spell(finding.point))
    return PositiveFinding(Share.NEVER, Certainty.BOUNDED, safety_of_point(other), evidence)


def _sample_points(
    chain: Chain, other: Chain, seed: str, tries: int
) -> tuple[dict[Answer, tuple[tuple[str, str], ...]], Empirical]:
    """The first point of each answer, and how many had which."""
    points = [random_point(chain, f"{seed}:{k}") for k in range(tries)]
    answers = [equivalent(chain, point, other) for point in points]
    first = {answer: spell(points[answers.index(answer)]) for answer in answers}
    return first, Empirical(answers.count(Answer.YES), tries, answers.count(Answer.UNKNOWN))
