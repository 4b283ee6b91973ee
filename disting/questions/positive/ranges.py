"""Positive equivalents within ranges that a user gives: of models of `chain` in its ranges, in the
ranges of `other`.

ALWAYS: a renaming takes the box of one into the box of the other. NEVER: not even without ranges (a
range that is one value may make special what never happens generically: then only the decay
counts). SOMETIMES: an open part of the box of `chain` that has equivalents in the box of `other`
and one that has none. Short random points find both; long ones nearby prove them (see `points`,
which has the proof). Where no long point confirms what the search saw, nothing is claimed.

What is proven at a point: exact maps (renamings, duality) that lead into the box are equivalents;
so are the listed solutions of an undamped chain without tests (see `synthesis.theorems`), if they
are real. None exists if there is no positive one at all, or if the list of solutions is complete
and each has a value outside. Of a family of solutions only random members are examined: if none of
them is inside, the point stays open.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

from flint import arb, fmpq

from disting.algebra.certainty import LEAST_SAFETY, Certainty, Grade, full_text, grade_of
from disting.errors import InputError, short
from disting.evidence.decision import Exclusion
from disting.evidence.positive import BoxMap, Empirical, Points, PositiveFinding, Share
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Point, Solution, Status, target
from disting.fibres.synthesis.theorems import are_dual, dual, is_untested
from disting.model.chain import Chain
from disting.model.names import MOST_DIGITS, is_too_long, name_of
from disting.model.question import Answer, Settings
from disting.model.symmetry import canonical, forms
from disting.questions.positive.obstacles import Obstacle
from disting.questions.positive.points import (
    DRAWS,
    Range,
    bits,
    drawn_near,
    equivalent,
    is_long,
    random_point,
    read,
    spell,
)
from disting.questions.positive.shares import is_plain, positive_finding, refuse

TRIES = 20
Bound = int | float | str | Fraction


@dataclass(frozen=True, slots=True)
class Ranges:
    """Closed intervals of parameters, by name, of each side; what has none is any positive
    number (drawn from 1/8 to 8).
    """

    chain: Mapping[str, Range]
    other: Mapping[str, Range]


def ranges(
    chain: Mapping[str, tuple[Bound, Bound]], other: Mapping[str, tuple[Bound, Bound]]
) -> Ranges:
    """Ranges from numbers or text such as "0.5" and "2/3", taken exactly. Raises InputError unless
    0 <= low <= high > 0.

    >>> ranges({"m1": (1, "3/2")}, {}).chain["m1"]
    (Fraction(1, 1), Fraction(3, 2))
    """
    return Ranges(
        *({name: _range(name, *bounds) for name, bounds in side.items()} for side in (chain, other))
    )


def within_ranges(
    chain: Chain, other: Chain, limits: Ranges, settings: Settings | None = None, tries: int = TRIES
) -> PositiveFinding:
    """Share of the models of `chain` in its ranges that have an equivalent in the ranges of
    `other`.

    Raises InputError for chains of different kinds and for ranges of parameters that a chain does
    not have.
    """
    refuse(chain, other)
    _check_names(chain, limits.chain)
    _check_names(other, limits.other)
    inside = next(
        (BoxMap(tuple(m.items())) for m in renamings(chain, other) if _maps(m, limits)), None
    )
    if inside:
        return PositiveFinding(Share.ALWAYS, Certainty.THEOREM, evidence=inside)
    if not all(is_plain(c) for c in (chain, other)):
        return PositiveFinding(
            Share.UNKNOWN, reason="ground dampers, a lag and dead time are not covered"
        )
    anywhere = positive_finding(chain, other, settings)
    fixed = any(low == high for low, high in limits.chain.values())
    if anywhere.share is Share.NEVER and (
        not fixed or anywhere.evidence == Exclusion(Obstacle.DECAY)
    ):
        return anywhere
    return _sample_ranges(chain, other, limits, (settings or Settings()).seed, tries)


def confirms_within(evidence: BoxMap | Points, chain: Chain, other: Chain, limits: Ranges) -> bool:
    """Return True if the evidence of `within_ranges` holds; statements without ranges are confirmed
    by `confirmation.confirms`.
    """
    if isinstance(evidence, BoxMap):
        renaming = dict(evidence.pairs)
        return renaming in list(renamings(chain, other)) and _maps(renaming, limits)
    with_one, without = read(evidence.with_one), read(evidence.without)
    inside = all(
        _is_of(point, chain, limits) and is_long(point, limits.chain)
        for point in (with_one, without)
    )
    has = inside and _has_piece(chain, with_one, other, limits)
    return has and _lacks_piece(chain, without, other, limits) is not None


def equivalent_within(chain: Chain, point: Point, other: Chain, box: Mapping[str, Range]) -> Answer:
    """Decide whether this model has an equivalent in the box of `other`."""
    if any(
        all(_in(value, box.get(name)) for name, value in image.items())
        for image in _images(chain, point, other)
    ):
        return Answer.YES
    if equivalent(chain, point, other) is Answer.NO:
        return Answer.NO
    whole_fibre = fibre(other, target(chain.structure, point))
    places = [_place(s, box) for s in whole_fibre.solutions]
    if is_untested(other) and Answer.YES in places:
        return Answer.YES
    complete = whole_fibre.status is Status.EMPTY or (
        whole_fibre.status is Status.COMPLETE and not whole_fibre.tests.boundary
    )
    return Answer.NO if complete and set(places) <= {Answer.NO} else Answer.UNKNOWN


def _sample_ranges(
    chain: Chain, other: Chain, limits: Ranges, seed: str, tries: int
) -> PositiveFinding:
    """Finding of short points, confirmed by long ones near them."""
    points = [random_point(chain, f"ranges:{seed}:{k}", limits.chain) for k in range(tries)]
    answers = [equivalent_within(chain, point, other, limits.other) for point in points]
    empirical = Empirical(answers.count(Answer.YES), tries, answers.count(Answer.UNKNOWN))
    label, length = f"{seed}:{full_text(chain)}:{full_text(other)}:{full_text(limits)}", bits(other)

    def near(wanted: Answer) -> Iterator[Point]:
        """Long points near the first places of this answer."""
        places = [p for p, answer in zip(points, answers, strict=True) if answer is wanted]
        yield from (
            drawn_near(p, limits.chain, length, f"{label}:{wanted}:{k}")
            for k, p in enumerate(places[:DRAWS])
        )

    with_one = next((p for p in near(Answer.YES) if _has_piece(chain, p, other, limits)), None)
    if with_one is not None:
        for without in near(Answer.NO):
            grade = _lacks_piece(chain, without, other, limits)
            if grade is not None:
                evidence = Points(spell(with_one), spell(without))
                return PositiveFinding(Share.SOMETIMES, *grade, evidence, empirical)
    return PositiveFinding(
        Share.UNKNOWN,
        empirical=empirical,
        reason="random points are no proof for all of the ranges",
    )


def _has_piece(chain: Chain, point: Point, other: Chain, limits: Ranges) -> bool:
    """Return True if an open part of the box around the point has equivalents in the box of
    `other`.
    """
    box = limits.other
    if any(_stays(renaming, point, limits) for renaming in renamings(chain, other)):
        return True
    if any(
        all(_strictly_in(v, box.get(name)) for name, v in image.items())
        for image in _images(chain, point, other)
    ):
        return True
    whole_fibre = fibre(other, target(chain.structure, point)) if is_untested(other) else None
    return whole_fibre is not None and any(
        _place(s, box) is Answer.YES for s in whole_fibre.solutions
    )


def _lacks_piece(chain: Chain, point: Point, other: Chain, limits: Ranges) -> Grade | None:
    """Certainty that an open part of the box near the point has no equivalents, None if it may
    have: words are exact, listed solutions bounded.
    """
    if equivalent_within(chain, point, other, limits.other) is not Answer.NO:
        return None
    return grade_of(not other.damped and equivalent(chain, point, other) is Answer.NO, LEAST_SAFETY)


def _stays(renaming: Mapping[str, str], point: Point, limits: Ranges) -> bool:
    """Return True if the renamed parameters near the point lie in the box: strictly inside, or with
    all of their range.
    """
    return all(
        _strictly_in(value, limits.other.get(renaming[name]))
        or _maps({name: renaming[name]}, limits)
        for name, value in point.items()
    )


def _place(solution: Solution, box: Mapping[str, Range]) -> Answer:
    """Decide whether a listed solution, if it is one, is real and inside."""
    sides = [_side(value, box.get(name)) for name, value in solution.values.items()]
    if solution.real is Answer.NO or Answer.NO in sides:
        return Answer.NO
    return solution.real if set(sides) == {Answer.YES} else Answer.UNKNOWN


def _side(value: object, bounds: Range | None) -> Answer:
    x = value.real  # type: ignore[attr-defined]
    if bounds is None:
        return Answer.YES if x > 0 else Answer.NO if x < 0 else Answer.UNKNOWN
    low, high = (arb(fmpq(b.numerator, b.denominator)) for b in bounds)
    if x < low or x > high:
        return Answer.NO
    return Answer.YES if x > low and x < high else Answer.UNKNOWN


def renamings(chain: Chain, other: Chain) -> Iterator[dict[str, str]]:
    """All renamings by symmetry that turn the one chain into the other."""
    form = canonical(other)
    back = {image: name for name, image in form.renaming.items()}
    for moved in forms(chain):
        if moved.chain == form.chain:
            yield {name: back[image] for name, image in moved.renaming.items()}


def _images(chain: Chain, point: Point, other: Chain) -> Iterator[Point]:
    """The point under all exact maps."""
    for renaming in renamings(chain, other):
        yield {renaming[name]: value for name, value in point.items()}
    form = canonical(chain)
    if is_plain(chain) and is_plain(other) and are_dual(form.chain, canonical(other).chain):
        image = dual(form.chain, {form.renaming[name]: value for name, value in point.items()})
        for renaming in renamings(canonical(other).chain, other):
            yield {renaming[name]: value for name, value in image.items()}


def _maps(renaming: Mapping[str, str], limits: Ranges) -> bool:
    """Return True if every range lies inside the one that it is renamed to."""
    pairs = [(limits.chain.get(name), limits.other.get(image)) for name, image in renaming.items()]
    return all(b is None or (a is not None and b[0] <= a[0] and a[1] <= b[1]) for a, b in pairs)


def _in(value: fmpq, bounds: Range | None) -> bool:
    exact = Fraction(int(value.p), int(value.q))
    return exact > 0 if bounds is None else bounds[0] <= exact <= bounds[1]


def _strictly_in(value: fmpq, bounds: Range | None) -> bool:
    exact = Fraction(int(value.p), int(value.q))
    return exact > 0 if bounds is None else bounds[0] < exact < bounds[1]


def _is_of(point: Point, chain: Chain, limits: Ranges) -> bool:
    """Return True if these are all parameters, inside the ranges."""
    inside = all(_in(value, limits.chain.get(name)) for name, value in point.items())
    return inside and sorted(point) == sorted(chain.parameters)


def _check_names(chain: Chain, side: Mapping[str, Range]) -> None:
    strange = sorted(set(side) - set(chain.parameters))
    if strange:
        raise InputError(
            f"{name_of(chain)} has no parameter {strange[0]}; it has {', '.join(chain.parameters)}"
        )


def _range(name: str, low: Bound, high: Bound) -> Range:
    if any(isinstance(edge, str) and is_too_long(edge) for edge in (low, high)):
        limits = f"at most {MOST_DIGITS} characters, and at most {MOST_DIGITS} as a power of ten"
        raise InputError(
            f"the range of {name}, {short(low)} to {short(high)}: a bound has {limits}; choose"
            " other units"
        )
    try:
        exact = Fraction(low), Fraction(high)
    except (ValueError, TypeError, OverflowError, ZeroDivisionError):
        raise InputError(
            f"the range of {name} has two numbers, not {short(low)} and {short(high)}"
        ) from None
    if not 0 <= exact[0] <= exact[1] or not exact[1]:
        raise InputError(f"the range of {name} is positive and not empty, not {low} to {high}")
    return exact
