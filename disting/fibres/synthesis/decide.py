"""Inclusion of the models of one chain in another: one rational point, and its fibre.

The images of two coefficient maps have irreducible closures V1 and V2. If their ranks are equal, V1
= V2 exactly if a generic point of one lies in the image of the other, in either direction; if the
first rank is smaller, this decides whether V1 lies inside V2.

A rational point p0 is drawn at random. An empty fibre proves that this one model has no equivalent
with non-zero elements, complex or not; that no generic model has one follows unless p0 lies on a
proper subvariety, which has a small probability (Schwartz-Zippel) and a smaller one with every
further seed. A fibre that is not empty is a proof only on the grounds named THEOREM, RENAMING or
CONSTRUCTION; otherwise its members satisfy some equations only within their balls.
"""

from dataclasses import dataclass
from enum import StrEnum
from math import ceil, log2

from flint import fmpq

from disting.algebra.certainty import about, residues
from disting.errors import ContradictionError, InputError
from disting.evidence.decision import FibreAt
from disting.evidence.kinds import Decision
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.methods import cost
from disting.fibres.synthesis.task import Confirmation, Fibre, Status, target
from disting.fibres.synthesis.theorems import are_dual, is_constructed, is_untested
from disting.model.chain import Chain
from disting.model.question import Answer, Membership
from disting.model.row import rows_of
from disting.model.symmetry import canonical

# bits of an error bound that points are made long enough for; LEAST_SAFETY is what must be reached
WANTED = 128
LENGTH = 64  # coordinates have a multiple of so many bits
DRAWS = 3  # special points are drawn again this often


class Direction(StrEnum):
    """Direction of the search: the given model and the searched chain."""

    LEFT_IN_RIGHT = "left in right"
    RIGHT_IN_LEFT = "right in left"


class Grounds(StrEnum):
    """Grounds of a finding.

    REFUTED: every branch is refuted by a ball or a degree; proves that p0 has no equivalent.
    THEOREM: duality, an exact map for all parameters. RENAMING: symmetry, likewise. CONSTRUCTION:
    an undamped solution for p0 is proven to exist. SUBSYSTEM: as many equations as parameters have
    a common solution near by (Krawczyk), the others hold within balls of relative size `width`.
    BALLS: all equations hold within such balls. NONE: nothing is known.
    """

    REFUTED = "refuted"
    THEOREM = "theorem"
    RENAMING = "renaming"
    CONSTRUCTION = "construction"
    SUBSYSTEM = "subsystem"
    BALLS = "balls"
    NONE = "none"


@dataclass(frozen=True, slots=True)
class Exact:
    """Finding of one fibre; `solutions` counts the listed ones (branches), of which so many are
    real and positive.

    `point` holds the rational parameters p0, so that the finding can be checked again alone;
    `width` is the largest relative distance within which a listed solution is known to reproduce a
    coefficient.
    """

    membership: Membership
    direction: Direction
    point: dict[str, fmpq]
    status: Status
    solutions: int
    real: int
    positive: int
    precision_bits: int
    width: float
    grounds: Grounds
    reason: str

    def __bool__(self) -> bool:
        raise TypeError("a finding is not true or false; use its membership")

    @property
    def is_exact(self) -> bool:
        """True if the result holds for the point itself, not only within balls."""
        return self.grounds in (Grounds.REFUTED, Grounds.CONSTRUCTION)

    @property
    def evidence(self) -> FibreAt:
        """Evidence that can be checked again."""
        return FibreAt(
            left_given=self.direction is Direction.LEFT_IN_RIGHT,
            point=tuple((name, str(value)) for name, value in self.point.items()),
            grounds=self.grounds.value,
            solutions=self.solutions,
            real=self.real,
            positive=self.positive,
        )

    def decision(self, safety: int) -> Decision[FibreAt]:
        """Decision on generic models, proven except for an error bound of this number of bits;
        UNKNOWN where solutions are known within balls only.
        """
        if self.is_exact:
            return Decision(self.membership, safety, self.evidence)
        return Decision(Membership.UNKNOWN, reason=self.reason)


def decide(left: Chain, right: Chain, seed: str = "disting") -> Exact:
    """Finding for two chains of equal size and rank: the cheaper direction first, the other if
    that leaves it unknown.
    """
    ways = sorted(
        Direction, key=lambda way: dearest(right if way is Direction.LEFT_IN_RIGHT else left)
    )
    findings = (member(left, right, seed, way) for way in ways)
    first = next(findings)
    return first if first.membership is not Membership.UNKNOWN else _better(first, next(findings))


def member(
    left: Chain, right: Chain, seed: str = "disting", way: Direction = Direction.LEFT_IN_RIGHT
) -> Exact:
    """Finding for one direction: for chains of unequal rank it decides one-sided inclusion."""
    chain, other = (left, right) if way is Direction.LEFT_IN_RIGHT else (right, left)
    for draw in range(DRAWS):
        point = rational_point(
            chain, about(f"synthesis:{seed}:{draw}", chain, other), point_bits(other)
        )
        finding = member_at(left, right, way, point)
        if finding.status is not Status.DEGENERATE:
            break
    return finding


def member_at(left: Chain, right: Chain, way: Direction, point: dict[str, fmpq]) -> Exact:
    """The same at a given point of the one chain."""
    chain, other = (left, right) if way is Direction.LEFT_IN_RIGHT else (right, left)
    _refuse(chain, other)
    whole = fibre(other, target(chain.structure, point), confirm=not is_untested(other))
    return _finding(whole, way, point, _grounds(chain, other, point, whole))


def rational_point(chain: Chain, label: str, bits: int = 3 * LENGTH) -> dict[str, fmpq]:
    """Random rational parameters determined by the label: numerators and denominators of 2^bits +
    1 to 2^(bits + 1) - 1.

    So values lie between 1/2 and 2, which keeps the balls narrow.
    """
    names, low = chain.parameters, 1 << bits
    numbers = [low + r for r in residues(label, 2 * len(names), low)]
    return {name: fmpq(a, b) for name, a, b in zip(names, numbers[::2], numbers[1::2], strict=True)}


def point_bits(searched: Chain) -> int:
    """Bits of the coordinates of a point whose fibre in `searched` is computed: enough for an error
    of 2^-WANTED.

    >>> grounded = (Chain(n, damped=True, ground_dampers=tuple(range(1, n + 1))) for n in (3, 5, 8))
    >>> [point_bits(chain) for chain in grounded]
    [192, 256, 320]
    """
    return LENGTH * ceil((WANTED + _loss(searched)) / LENGTH)


def safety_of_point(searched: Chain) -> int:
    """Largest b with 2 DRAWS D^(n+1) / 2^B <= 2^-b: one rational point of B = `point_bits` bits
    proves a statement on generic ones.

    n is the number of parameters of the chain that is searched, whatever the given one has; D =
    max(3 N_B + 2, n + 1) bounds the degrees of equal coefficients and of the equation that no
    element is zero.

    Special points lie on a hypersurface of degree D^(n+1) at most (see
    `disting.decide.same.exact`), which a random point meets with a probability of at most that
    degree / 2^B: for any denominators it is one of the numerators, each of 2^B - 1 numbers
    (Schwartz, Zippel). Up to DRAWS points are drawn, and either direction may have been tried.

    >>> safety_of_point(Chain(8, damped=True))
    144
    """
    return point_bits(searched) - _loss(searched)


def _loss(searched: Chain) -> int:
    """Bits of 2 DRAWS D^(n+1), and one for 2^B - 1."""
    n = len(searched.parameters)
    return ceil((n + 1) * log2(max(3 * searched.n_masses + 2, n + 1)) + log2(2 * DRAWS)) + 1


def _refuse(chain: Chain, other: Chain) -> None:
    if chain.n_masses != other.n_masses:
        raise InputError(
            f"chains of equal size are compared, not of {chain.n_masses} and {other.n_masses}"
            " masses"
        )
    if chain.quantity != other.quantity or chain.dead_time:
        raise InputError("chains with the same sensor quantity and without dead time are compared")


def dearest(chain: Chain) -> int:
    """Rank of the dearest method that the chain needs; those without any last."""
    return max(map(cost, rows_of(canonical(chain).chain.structure)))


def _better(first: Exact, second: Exact) -> Exact:
    return first if second.membership is Membership.UNKNOWN else second


def _finding(whole: Fibre, way: Direction, point: dict[str, fmpq], grounds: Grounds) -> Exact:
    real, positive = (
        [getattr(s, name) for s in whole.solutions].count(Answer.YES)
        for name in ("real", "positive")
    )
    width = max((s.width for s in whole.solutions), default=0.0)
    count, bits = len(whole.solutions), whole.precision_bits
    return Exact(
        membership=_MEANING[grounds],
        direction=way,
        point=point,
        status=whole.status,
        solutions=count,
        real=real,
        positive=positive,
        precision_bits=bits,
        width=width,
        grounds=grounds,
        reason=whole.reason,
    )


def _grounds(chain: Chain, other: Chain, point: dict[str, fmpq], whole: Fibre) -> Grounds:
    """The strongest grounds there are; raises ContradictionError where an identity and an empty
    fibre meet.
    """
    same, dual = canonical(chain).chain == canonical(other).chain, are_dual(chain, other)
    if whole.status is Status.EMPTY:
        if same or dual:
            raise ContradictionError(
                f"an empty fibre between chains that are the same: {chain} and {other}"
            )
        return Grounds.REFUTED
    if same or dual:
        return Grounds.RENAMING if same else Grounds.THEOREM
    if not whole.solutions:
        return Grounds.NONE
    if is_untested(other) or is_constructed(chain, point, other):
        return Grounds.CONSTRUCTION
    confirmed = all(s.confirmation is Confirmation.SUBSYSTEM for s in whole.solutions)
    return Grounds.SUBSYSTEM if confirmed else Grounds.BALLS


_MEANING = dict.fromkeys(Grounds, Membership.MEMBER) | {
    Grounds.REFUTED: Membership.EXCLUDED,
    Grounds.NONE: Membership.UNKNOWN,
}
