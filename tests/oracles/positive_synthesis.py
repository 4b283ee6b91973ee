"""Whether a chain with positive parameters has one given receptance: proven, at a rational point,
or not known.

A second route to `disting.decide.positive`: by the chains that the inverse synthesis finds, not
by the order of poles and zeros.

Damped chains have finitely many solutions, all of which are listed. Undamped ones with force and
sensor apart have families. There poles and zeros of a positive chain are real, and each row is
looked at by itself:

Collocated: finitely many chains. Neighbours, b = a + 1: one chain for each spring kappa > 0
between the ports and each way to share out the roots of D + kappa N = Theta Phi and of N. No
element changes its sign between two values of kappa where D + kappa N has a multiple root: an
element passes zero or infinity only where a root of Theta or Phi meets a zero of N, which is a
zero of D then, but H is in lowest terms. So one kappa between any two neighbours among the
positive zeros of the discriminant stands for all, if these zeros are simple (then a double root is
two real roots on one side). Farther apart: one random member of the family may be positive; that
none is, is not proven.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import pairwise
from typing import TypeVar

from flint import acb, acb_poly, ctx, fmpq

from disting.algebra.certainty import residues
from disting.fibres.synthesis.branch import (
    BOUNDARY,
    Ball,
    Dead,
    Imprecise,
    Leaf,
    Receptance,
    roots,
    shift,
)
from disting.fibres.synthesis.fibre import PRECISIONS, fibre
from disting.fibres.synthesis.methods import synthesise
from disting.fibres.synthesis.poles import Split, pole_splits
from disting.fibres.synthesis.task import Status, Target, is_regular, target
from disting.fibres.synthesis.theorems import exact_rows, is_untested
from disting.fibres.synthesis.undamped_rows import neighbours_at
from disting.model.chain import Chain
from disting.model.question import Answer
from disting.model.row import Row, grounded_and_free
from disting.model.symmetry import canonical

T = TypeVar("T")


def positive_equivalent(given: Chain, point: Mapping[str, fmpq], other: Chain) -> Answer:
    """Whether `other` has positive parameters with the receptance of `given` at this point; YES
    and NO are proven.

    Both chains plain, of one size, damping and sensor; positive parameters are given.
    """
    whole = target(given.structure, point)
    if other.damped:
        return _damped(other, whole)
    grounded, free = grounded_and_free(canonical(other).chain.structure)
    if not is_regular(whole.folded(1), 1, other.n_masses, free if grounded is None else None):
        return Answer.UNKNOWN
    if any(_both(pair) is Answer.YES for pair in _exact(given, point, whole, grounded, free)):
        return Answer.YES
    found = _at_some_precision(
        lambda: _over_splits(whole.folded(1), grounded, free), Answer.UNKNOWN
    )
    return Answer.UNKNOWN if found is Answer.YES and not is_untested(other) else found


def positive_point(chain: Chain, label: str) -> dict[str, fmpq]:
    """Random positive rational parameters, spread over a few powers of two; determined by the
    label.
    """
    names = chain.parameters
    numbers = residues(label, 2 * len(names), 1 << 20)
    return {
        n: fmpq(64 + a, 64 + b) for n, a, b in zip(names, numbers[::2], numbers[1::2], strict=True)
    }


def _damped(other: Chain, whole: Target) -> Answer:
    """NO where all solutions are listed and none is positive; that a listed one exists is not
    proven here.
    """
    found = fibre(other, whole)
    if found.status is Status.EMPTY:
        return Answer.NO
    listed = found.status is Status.COMPLETE and not found.tests.boundary
    return (
        Answer.NO
        if listed and all(s.positive is Answer.NO for s in found.solutions)
        else Answer.UNKNOWN
    )


def _exact(
    given: Chain, point: Mapping[str, fmpq], whole: Target, grounded: Row | None, free: Row
) -> Iterator[list[tuple[Row, Target]]]:
    """Yield the rows' receptances where they are known as fractions: nothing is left to balls,
    so what fits exists.
    """
    if grounded is None:
        if whole.folded(1).numerator.degree() == free.numerator_degree:
            yield [(free, whole.folded(1))]
    else:
        yield from exact_rows(given, point, whole.folded(1), grounded, free)


def _both(pairs: list[tuple[Row, Target]]) -> Answer:
    def answer() -> Answer:
        return _all(_part(row, exact.balls) for row, exact in pairs)

    return _at_some_precision(answer, Answer.UNKNOWN)


def _over_splits(whole: Target, grounded: Row | None, free: Row) -> Answer:
    """What all splits of the poles give, as far as balls tell: NO is proven, YES only where no
    test occurs.
    """
    data = whole.balls
    poles = roots(shift(data.denominator, -1), whole.denominator.degree() - 1)
    if not _real(poles):
        return Answer.NO if _certainly_not_real(poles) else Answer.UNKNOWN
    if grounded is None:
        return _part(free, data)
    return _any(_split(split, grounded, free) for split in pole_splits(data, grounded, free))


def _split(split: Split | Dead, grounded: Row, free: Row) -> Answer:
    if isinstance(split, Dead):
        return Answer.UNKNOWN if split == BOUNDARY else Answer.NO
    return _all(_part(*pair) for pair in ((grounded, split.grounded), (free, split.free)))


def _part(row: Row, data: Receptance) -> Answer:
    """Whether one row can be positive."""
    zeros = roots(data.numerator, row.numerator_degree)
    if not _real(zeros) or not data.gain(row).real > 0:
        return (
            Answer.NO if _certainly_not_real(zeros) or data.gain(row).real < 0 else Answer.UNKNOWN
        )
    if row.distance == 1:
        return _any(_family(row, data, kappa) for kappa in _representatives(row, data))
    found = _leaves(list(synthesise(row, data)))
    return found if row.distance == 0 or found is Answer.YES else Answer.UNKNOWN


def _family(row: Row, data: Receptance, kappa: fmpq) -> Answer:
    """Whether a chain with this spring between the ports is positive."""
    both = roots(data.denominator + kappa * data.numerator, row.n_masses)
    if not _real(both):
        return Answer.NO if _certainly_not_real(both) else Answer.UNKNOWN
    return _leaves(list(neighbours_at(row, data, kappa)))


def _leaves(leaves: list[Leaf]) -> Answer:
    """All values are real here: every root that they come from is."""
    return _any(_positive(leaf) for leaf in leaves)


def _positive(leaf: Leaf) -> Answer:
    if isinstance(leaf, Dead):
        return Answer.UNKNOWN if leaf == BOUNDARY else Answer.NO
    values = [*leaf.masses, *(spring[0] for spring in leaf.springs)]
    if any(v.real < 0 for v in values):
        return Answer.NO
    return Answer.YES if all(v.real > 0 for v in values) else Answer.UNKNOWN


def _representatives(row: Row, data: Receptance) -> Iterator[fmpq]:
    """One kappa from each interval of the positive axis between zeros of the discriminant of D +
    kappa N.

    For kappa to infinity n - 2 roots go to the zeros of N and two to +-sqrt(-kappa nu), so its
    degree is 2 n - 3; it is interpolated. Raises Imprecise where its zeros cannot be isolated,
    which multiple ones never can.
    """
    n = row.n_masses
    places = [acb(i) for i in range(2 * n - 2)]
    values = [
        _discriminant(roots(data.denominator + place * data.numerator, n)) for place in places
    ]
    found = roots(acb_poly.interpolate(places, values), 2 * n - 3)
    bounds = sorted(float(z.real.mid()) for z in found if z.imag.contains(0) and z.real > 0)
    yield from (fmpq(*value.as_integer_ratio()) for value in _between(bounds))


def _discriminant(zeros: list[Ball]) -> Ball:
    value = acb(1)
    for i, z in enumerate(zeros):
        for other in zeros[:i]:
            value *= (z - other) ** 2
    return value


def _between(bounds: list[float]) -> Iterator[float]:
    if not bounds:
        yield 1.0
        return
    yield bounds[0] / 2
    yield from ((a + b) / 2 for a, b in pairwise(bounds))
    yield 2 * bounds[-1]


def _real(zeros: list[Ball]) -> bool:
    """Isolated zeros of a real polynomial: one whose ball's conjugate meets no other ball is
    its own conjugate.
    """
    return all(
        not any(z.conjugate().overlaps(w) for w in zeros if w is not z) and z.imag.contains(0)
        for z in zeros
    )


def _any(answers: Iterable[Answer]) -> Answer:
    known = set(answers)
    return next((a for a in (Answer.YES, Answer.UNKNOWN) if a in known), Answer.NO)


def _all(answers: Iterable[Answer]) -> Answer:
    known = set(answers)
    return next((a for a in (Answer.NO, Answer.UNKNOWN) if a in known), Answer.YES)


def _at_some_precision(question: Callable[[], T], otherwise: T) -> T:
    """The answer with the fewest bits that suffice."""
    for bits in PRECISIONS[:4]:
        with ctx.workprec(bits):
            try:
                return question()
            except Imprecise:
                continue
    return otherwise


def _certainly_not_real(zeros: list[Ball]) -> bool:
    return any(not z.imag.contains(0) for z in zeros)
