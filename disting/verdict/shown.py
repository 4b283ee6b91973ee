"""What a verdict means for who measures: one sentence for the engineer at the drive.

It is derived from the evidence, which says the same in algebra (`Verdict.sentence`). A curve here
is all that is measured, a frequency response from the force to the sensor; the parameters are
generic, finite and not zero.
"""

from disting.evidence.conditions import Counts, Forms, Ranks
from disting.evidence.decision import DeadTime
from disting.model.domain import Domain
from disting.questions.inclusion import Inclusion
from disting.verdict.result import Relation, Verdict

DECADE = 20  # decibels that a power of s falls in a decade of frequency
PARTS = {
    frozenset("a"): "its resonances and how they are damped",
    frozenset("b"): "its gain, its antiresonances and how they are damped",
    frozenset("G"): "how its motion begins after a blow",
}
WHOLE = "its resonances, antiresonances, their damping and its gain"


def shown(verdict: Verdict) -> str:
    """What a measurement of either model shows; "" where nothing is decided.

    Of unequal ranks (conditions 4 and 5): the behaviours of the model of smaller rank lie in a
    variety of smaller dimension, so a generic behaviour of the other one is not there; the number
    of laws is the difference of the ranks.
    """
    left, right = verdict.left, verdict.right
    if verdict.relation is Relation.INDISTINGUISHABLE:
        over = "" if verdict.domain is Domain.POSITIVE else f" with {verdict.domain} parameters"
        return (
            f"Every machine {left} has a twin {right}{over} with the same curve, special values"
            " aside, and the reverse: what is measured here does not tell them apart."
        )
    if verdict.relation is Relation.SOMETIMES:
        return (
            f"It depends on the machine: some curves fit both {left} and {right}, others only one"
            " of them."
        )
    match verdict.evidence:
        case Counts():
            return _steeper(verdict.evidence, left, right)
        case Ranks():
            return _more_laws(verdict.evidence, left, right)
        case Forms():
            return _varying(verdict.evidence, left, right)
        case DeadTime(left_given=given):
            delayed = left if given else right
            return f"Towards high frequencies the phase of {delayed} falls without an end."
        case None:
            return ""
        case _:
            said = (
                f"One of {left} and {right} has machines whose curve no machine of the other gives"
            )
            # one that is a limit of the other comes as close as one likes
            if verdict.closure is not Inclusion.NEITHER:
                return f"{said}."
            return (
                f"{said}: fitted to it, the wrong one leaves an error however well it is measured."
            )


def _steeper(found: Counts, left: str, right: str) -> str:
    """Degrees n over m: towards high frequencies |G| falls by 20 (m - n) dB in a decade."""
    (n1, m1), (n2, m2) = found.first
    if n1 < 0 or n2 < 0:
        still, moves = (left, right) if n1 < 0 else (right, left)
        return f"The sensor of {still} stands still, that of {moves} moves."
    if m1 - n1 != m2 - n2:
        steep, flat = (left, right) if m1 - n1 > m2 - n2 else (right, left)
        fall = DECADE * abs((m1 - n1) - (m2 - n2))
        return (
            f"Towards high frequencies the curve of {steep} falls by {fall} dB a decade more than"
            f" that of {flat}{_zeros(n2 - n1 if flat == right else n1 - n2, flat)}."
        )
    more, poles = (left, m1 - m2) if m1 > m2 else (right, m2 - m1)
    return f"The curve of {more} has {poles} {'pole' if poles == 1 else 'poles'} more."


def _zeros(more: int, flat: str) -> str:
    if more < 1:
        return ""
    zeros = "one zero" if more == 1 else f"{more} zeros"
    pair = " (an antiresonance is a pair of them)" if more > 1 else ""
    return f": {flat} has {zeros} more{pair}"


def _more_laws(found: Ranks, left: str, right: str) -> str:
    fewer, more = (left, right) if found.left < found.right else (right, left)
    count = abs(found.left - found.right)
    laws = "one law" if count == 1 else f"{count} laws"
    part = WHOLE
    if not found.all_rows:
        part = PARTS.get(frozenset(label[0] for label in found.rows), f"some of {WHOLE}")
    broken = "it" if count == 1 else "them"
    return (
        f"The curve of {fewer} obeys {laws} more than that of {more} does, on {part}; a curve of"
        f" {more} breaks {broken} unless its parameters happen to fit."
    )


def _varying(found: Forms, left: str, right: str) -> str:
    if "Td" in (*found.only_left, *found.only_right):
        delayed = left if "Td" in found.only_left else right
        return f"Towards high frequencies the phase of {delayed} falls without an end."
    fixed, free = (left, right) if found.only_right else (right, left)
    return (
        f"A coefficient of the curve is one fixed number for every {fixed}; that of {free} changes"
        " with its parameters."
    )
