"""Inclusion of generic models of one structure in another, by the ideal of one fibre, for any two
coefficient maps.

For equal ranks both directions decide the same question, and one of them is often a hundred times
cheaper: they are raced, the step of the least total work first. Work is counted in entries of
matrices, not in seconds, so that the outcome depends on the seed and not on the machine (unless
the time runs out). Further points and primes, in the direction that won, multiply the error bounds
of `bounds` until the wanted one is reached; one bit is paid for the choice of the direction. No
point is passed over: one that contradicts the others makes the decision UNKNOWN, so all points
drawn must mislead before a decision is wrong.

Meaning. Equal ranks: MEMBER means V1 = V2, EXCLUDED means V1 != V2, for the closures of the images
over the complex numbers. Smaller rank of the given model: MEMBER means that V1 lies inside V2,
EXCLUDED that generic points of V1 are not reached by Phi2 (they could be limits of points that
are). Elements may be zero in a solution; an empty fibre is empty with them.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import ceil
from time import process_time

from disting.algebra.certainty import about, residues
from disting.algebra.groebner.elimination import (
    Basis,
    TooLarge,
    basis_steps,
    free_variable,
    solution,
)
from disting.algebra.groebner.modular import Sparse
from disting.errors import ContradictionError, InputError, NotSeenError
from disting.evidence.ideals import Refutation, Solutions
from disting.evidence.kinds import Decision
from disting.fibres.ideals.bounds import LEAST, bits_of, safety_of_empty, safety_of_member
from disting.fibres.ideals.fibre_ideal import (
    BITS,
    FibreIdeal,
    agree,
    fibre_ideal,
    generic_rank,
)
from disting.fibres.ideals.system import CoefficientMap, PolynomialMap, match_maps
from disting.model.question import Membership

OUT_OF_TIME = "out of time"  # begins the reason why nothing was found

# draws for one solution modulo the prime: each square root that it needs halves the chance that
# there is one
SPARE = 32
TWO_ANSWERS = "one random point refutes, another does not"
NO_BOUND = "primes of 64 bits give no useful bound for models of this size"


@dataclass(frozen=True, slots=True)
class Limits:
    """`entries` of one matrix (1 to 10 microseconds each), `safety` wanted bits, `seconds` for the
    whole decision.

    The seconds are those of this process, whatever else the machine does. `long`: whether primes
    longer than a word are taken where words give no useful bound; a run takes ten times as long.
    """

    seconds: float = 60.0
    entries: int = 20_000_000
    safety: int = 100
    long: bool = False


IdealDecision = Decision[Solutions | Refutation]


def _unknown(reason: str) -> IdealDecision:
    return Decision(Membership.UNKNOWN, reason=reason)


class GivenUp(Exception):
    """Reasons for ending a search at its limits, in words."""


@dataclass(slots=True)
class _Run:
    """One direction at one label: the equations, the steps still to do, and the work done and
    announced.
    """

    left_given: bool
    label: str
    ideal: FibreIdeal
    steps: Iterator[Basis | int]
    work: int = 0


@dataclass(frozen=True, slots=True)
class _Question:
    left: PolynomialMap
    right: PolynomialMap
    equal_rank: bool
    limits: Limits
    deadline: float

    @property
    def price(self) -> int:
        """Bits for the choice between two directions."""
        return int(self.equal_rank)

    def sides(self, left_given: bool) -> tuple[PolynomialMap, PolynomialMap]:
        """The model whose point is given, and the one that is searched."""
        return (self.left, self.right) if left_given else (self.right, self.left)

    def run(self, left_given: bool, label: str) -> _Run:
        """The Gröbner basis of the fibre in this direction, at the point of this label, ready
        to be computed step by step.
        """
        sides = self.sides(left_given)
        bits = bits_of(*sides, self.equal_rank)
        ideal = fibre_ideal(*sides, label, self.equal_rank, bits)
        steps = basis_steps(ideal.generators, len(ideal.unknowns), ideal.modulus)
        return _Run(left_given, label, ideal, steps)


def decide(
    model: CoefficientMap,
    other: CoefficientMap,
    *,
    equal_rank: bool,
    seed: str = "disting",
    limits: Limits = Limits(),
    members: bool = True,
) -> IdealDecision:
    """Decide whether generic models of `model` are models of `other`; with `equal_rank` the other
    direction can decide too. Without `members` it is UNKNOWN that they are: only refutations are
    searched.

    Numerators of unequal degrees are compared with zeros where one has no coefficient. Raises
    InputError if the ranks at random points are not as stated, or the given model has the larger
    one.
    """
    if model.degrees[1] != other.degrees[1]:
        return _unknown("the numbers of poles differ")
    return decide_matched(
        *match_maps(model, other), equal_rank=equal_rank, seed=seed, limits=limits, members=members
    )


def decide_matched(
    left: PolynomialMap,
    right: PolynomialMap,
    *,
    equal_rank: bool,
    seed: str = "disting",
    limits: Limits = Limits(),
    members: bool = True,
) -> IdealDecision:
    """The same for two maps whose coordinates can be compared, whatever they are of: several
    transfer functions of one model, for instance. The bounds rest on nothing else.
    """
    _refuse(left, right, equal_rank, seed)
    seed = _of_maps(seed, left, right)
    bits = bits_of(left, right, equal_rank)
    too_long = bits > BITS and not limits.long
    if too_long or safety_of_empty(left, right, equal_rank, bits) < LEAST:
        return _unknown(NO_BOUND)
    question = _Question(left, right, equal_rank, limits, process_time() + limits.seconds)
    try:
        ways = (True, False) if equal_rank else (True,)
        run, basis = _race(question, [question.run(way, _label(seed, 0)) for way in ways])
        if basis.is_one:
            return _exclude(question, run, basis, seed)
        if not members or run.ideal.modulus.bit_length() > BITS:
            return _unknown("a random point has solutions")
        return _member(question, run, basis, seed)
    except GivenUp as why:
        return _unknown(str(why))


def is_empty(
    model: PolynomialMap, other: PolynomialMap, *, equal_rank: bool, label: str, limits: Limits
) -> bool:
    """Return True if the fibre of `other` over the point of `model` that the label denotes is
    empty: one run, in this direction. Raises NotSeenError where the limits end it.
    """
    _refuse(model, other, equal_rank, "verify")
    question = _Question(model, other, equal_rank, limits, process_time() + limits.seconds)
    if safety_of_empty(model, other, equal_rank, bits_of(model, other, equal_rank)) < LEAST:
        raise NotSeenError(NO_BOUND)
    try:
        return _race(question, [question.run(True, label)])[1].is_one
    except GivenUp as why:
        raise NotSeenError(f"the contradiction was not found again ({why})") from None


def _refuse(left: PolynomialMap, right: PolynomialMap, equal_rank: bool, seed: str) -> None:
    ranks = [generic_rank(model, f"rank:{seed}") for model in (left, right)]
    if ranks[0] > ranks[1] or equal_rank != (ranks[0] == ranks[1]):
        raise InputError(f"the ranks are {ranks[0]} and {ranks[1]}")


def labels_of(seed: str, left: PolynomialMap, right: PolynomialMap, count: int) -> tuple[str, ...]:
    """The first labels that a seed draws for two maps, in order."""
    whole = _of_maps(seed, left, right)
    return tuple(_label(whole, number) for number in range(count))


def _of_maps(seed: str, left: PolynomialMap, right: PolynomialMap) -> str:
    return about(f"ideals:{seed}", left.content, right.content)


def _label(seed: str, number: int) -> str:
    return f"{seed}:{number}"


def _race(question: _Question, runs: list[_Run]) -> tuple[_Run, Basis]:
    """The first basis that is found, always doing the step with the least total work; raises
    GivenUp.
    """
    why = "no direction"
    while runs:
        if process_time() > question.deadline:
            raise GivenUp(f"{OUT_OF_TIME} ({question.limits.seconds:g} s)")
        run = min(runs, key=lambda r: r.work)
        try:
            step = next(run.steps)
        except TooLarge as error:
            why, step = str(error), question.limits.entries + 1
        if isinstance(step, Basis):
            return run, step
        run.work += step
        if step > question.limits.entries:
            why = why if why != "no direction" else f"a matrix of {step} entries"
            runs.remove(run)
    raise GivenUp(f"too large: {why}")


def _exclude(question: _Question, run: _Run, basis: Basis, seed: str) -> IdealDecision:
    bits = run.ideal.modulus.bit_length()
    each = safety_of_empty(*question.sides(run.left_given), question.equal_rank, bits)
    labels, degree, reason = [run.label], basis.degree, ""
    try:
        while len(labels) < _count_needed(question, each):
            label = _label(seed, len(labels))
            again, next_basis = _race(question, [question.run(run.left_given, label)])
            if not next_basis.is_one:
                return _unknown(TWO_ANSWERS)
            labels.append(again.label)
            degree = max(degree, next_basis.degree)
    except GivenUp as why:
        reason = str(why)
    evidence = Refutation(run.left_given, tuple(labels), degree, question.equal_rank)
    return Decision(Membership.EXCLUDED, each * len(labels) - question.price, evidence, reason)


def _member(question: _Question, run: _Run, basis: Basis, seed: str) -> IdealDecision:
    each = safety_of_member(*question.sides(run.left_given))
    solutions, reason, wanted = dict[str, tuple[int, ...]](), "", _count_needed(question, each)
    try:
        for number in range(1, SPARE * wanted + 1):
            if basis.is_one:
                return _unknown(TWO_ANSWERS)
            solved = _solution(question, run, basis)
            solutions |= {run.label: solved} if solved else {}
            if len(solutions) == wanted:
                break
            run, basis = _race(question, [question.run(run.left_given, _label(seed, number))])
    except GivenUp as why:
        reason = str(why)
    if not solutions:
        return _unknown(reason or "no solution with coordinates modulo the prime was found")
    evidence = Solutions(run.left_given, tuple(solutions), tuple(solutions.values()))
    return Decision(Membership.MEMBER, each * len(solutions) - question.price, evidence, reason)


def _count_needed(question: _Question, each: int) -> int:
    if each <= question.price:
        raise GivenUp("primes of 64 bits give no bound for models of this size")
    return ceil((question.limits.safety + question.price) / each)


def _solution(question: _Question, run: _Run, basis: Basis) -> tuple[int, ...] | None:
    """All parameters of the searched model, in its order; further unknowns are fixed as long as
    solutions are not finite.

    What is found is put into both coefficient maps; raises ContradictionError where they differ, a
    defect of the program.
    """
    ideal, extra = run.ideal, list[Sparse]()
    values = residues(f"cut:{run.label}", len(ideal.unknowns), ideal.modulus)
    while (at := free_variable(basis)) is not None:
        extra.append(_fix_unknown(at, values[at], len(ideal.unknowns)))
        steps = basis_steps([*ideal.generators, *extra], len(ideal.unknowns), ideal.modulus)
        _, basis = _race(question, [_Run(run.left_given, run.label, ideal, steps)])
        if basis.is_one:
            return None
    if (unknowns := solution(basis, run.label)) is None:
        return None
    model, other = question.sides(run.left_given)
    named = ideal.fixed | dict(zip(ideal.unknowns, unknowns, strict=True))
    solved = tuple(named[name] for name in other.parameters)
    if not agree(model, ideal.point, other, solved, ideal.modulus):
        raise ContradictionError(
            "a solution of the fibre's equations is none of the coefficient maps"
        )
    return solved


def _fix_unknown(at: int, value: int, size: int) -> Sparse:
    return {tuple(int(i == at) for i in range(size)): 1, (0,) * size: -value}
