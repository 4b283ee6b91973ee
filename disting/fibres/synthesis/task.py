"""Task of a synthesis and its result: an exact receptance, and the models that have it."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from flint import acb, acb_poly, fmpq, fmpq_poly

from disting.behaviour.transfer import plain_receptance
from disting.fibres.synthesis.branch import Receptance
from disting.model.chain import Structure
from disting.model.question import Answer
from disting.model.row import Row

Ball = acb
Exact = fmpq_poly
Point = Mapping[str, fmpq]
SolutionValues = Mapping[str, fmpq | acb]
"""Parameters by name, exact where that is possible."""


class Status(StrEnum):
    """COMPLETE: the solutions listed are all there are. EMPTY: proven that there is none.

    INFINITE: a family; one member per branch is listed, for random values of the free choices.
    DEGENERATE: the point is special, or an element cannot be separated from zero: draw another.
    NOT_COVERED: no method for this structure; the list may be short.
    """

    COMPLETE = "complete"
    EMPTY = "empty"
    INFINITE = "infinite"
    DEGENERATE = "degenerate"
    NOT_COVERED = "not covered"


class Confirmation(StrEnum):
    """Proven property of a listed solution.

    SUBSYSTEM: a Krawczyk step proves that as many coefficient equations as there are parameters
    have exactly one common solution in the box; the other equations hold within their balls.
    BALLS: all equations hold within their balls, no more.
    """

    SUBSYSTEM = "square subsystem"
    BALLS = "balls"


@dataclass(frozen=True, slots=True)
class Solution:
    """Parameter values (balls, complex) by name; `width`: largest relative distance of a
    coefficient from the given one.

    `real`: YES only means that the solution, if it is one, is real: its conjugate is one too, and
    no other listed ball meets it.
    """

    values: dict[str, Ball]
    real: Answer
    positive: Answer
    gauges: int
    width: float
    confirmation: Confirmation = Confirmation.BALLS


@dataclass(frozen=True, slots=True)
class Exclusions:
    """Numbers of branches by the reason for which they ended: refuted (proven), at the boundary (an
    element near zero), not covered.
    """

    refuted: int = 0
    boundary: int = 0
    uncovered: int = 0


@dataclass(frozen=True, slots=True)
class Fibre:
    """All parameter vectors of a structure with a given receptance; `reason` explains the
    status.
    """

    status: Status
    solutions: tuple[Solution, ...] = ()
    precision_bits: int = 0
    tests: Exclusions = Exclusions()
    reason: str = ""

    def __post_init__(self) -> None:
        if self.status is Status.EMPTY and (
            self.solutions or self.tests.boundary or self.tests.uncovered
        ):
            raise ValueError("an empty fibre has no solutions and no open branches")
        if self.status in (Status.COMPLETE, Status.INFINITE) and not self.solutions:
            raise ValueError("a fibre that is not empty lists solutions")

    def __bool__(self) -> bool:
        raise TypeError("a fibre is not true or false; use its status")


@dataclass(frozen=True, slots=True)
class Target:
    """Receptance in lowest terms, numerator over monic denominator, rational coefficients, in s."""

    numerator: Exact
    denominator: Exact

    @property
    def is_even(self) -> bool:
        """True if it is a function of s^2."""
        return not any(c for p in (self.numerator, self.denominator) for c in p.coeffs()[1::2])

    def folded(self, q: int) -> "Target":
        """In x = s^2 for q = 1 (only if even), itself for q = 2."""
        return (
            self
            if q == 2
            else Target(*(fmpq_poly(p.coeffs()[::2]) for p in (self.numerator, self.denominator)))
        )

    @property
    def balls(self) -> Receptance:
        """Coefficients as balls of the current precision."""
        return Receptance(acb_poly(self.numerator), acb_poly(self.denominator))


def target(structure: Structure, point: Point) -> Target:
    """Receptance of a structure at a rational point.

    >>> from disting.model.chain import Chain
    >>> t = target(Chain(1, damped=False).structure, {"m1": fmpq(2)})
    >>> str(t.numerator), str(t.denominator)
    ('1/2', 'x^2')
    """
    unit = fmpq_poly([1])
    values = {name: fmpq_poly([value]) for name, value in point.items()}
    num, den = plain_receptance(structure, values, fmpq_poly([0, 1]), unit)
    common = num.gcd(den)
    num, den = num // common, den // common
    return Target(num / den[den.degree()], den / den[den.degree()])


def fraction(text: str) -> fmpq:
    """A fraction from its text.

    >>> fraction("3/4") + fraction("1")
    7/4
    """
    return fmpq(*map(int, text.split("/")))


def degrees_differ(t: Target, q: int, n_masses: int, whole: Row | None, lag: int = 0) -> bool:
    """Exact proof that no parameters fit: more poles than the chain has, or a chain without a gap
    of another relative degree.

    t is folded already; `whole` is the chain itself if it has no gap; `lag` is the number of its
    poles.
    """
    poles, most = t.denominator.degree(), q * n_masses + lag
    if whole is None or poles != most:
        return bool(poles > most)
    return bool(t.numerator.degree() != whole.numerator_degree_in(q))


def poles_at_zero(t: Target) -> int:
    """Multiplicity of the pole at 0."""
    return next(i for i, c in enumerate(t.denominator.coeffs()) if c)


def rests_differently(t: Target, q: int, free: Row) -> bool:
    """Exact proof that no parameters fit a target of full degree: another multiplicity of the pole
    at 0 than the free row has.

    det A of a free row is s (sum of the b_i) (product of the c_i) + .., so one damper to the
    ground makes the pole simple, and several do unless their sum is zero.
    """
    low = poles_at_zero(t)
    return low < free.poles_at_zero(q) or (len(free.ground_dampers) == 1 and low > 1)


def is_regular(t: Target, q: int, n_masses: int, whole: Row | None, lag: int = 0) -> bool:
    """Return True if the methods apply: q N + lag poles, 1 to q of them zero, the others simple;
    simple zeros too without a gap.
    """
    den, low = t.denominator, poles_at_zero(t)
    if den.degree() != q * n_masses + lag or not 1 <= low <= q:
        return False
    return _squarefree(fmpq_poly(den.coeffs()[low:])) and (
        whole is None or _squarefree(t.numerator)
    )


def _squarefree(p: Exact) -> bool:
    return bool(p.gcd(p.derivative()).degree() == 0) if p.degree() > 0 else True
