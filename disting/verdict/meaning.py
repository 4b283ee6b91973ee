"""Meaning of a verdict for a measurement: one sentence for the engineer at the drive.

It is derived from the evidence, which gives the same in algebra (`Verdict.sentence`). A response
here is all that is measured, from the force to the sensor or from the inputs to the outputs; the
parameters are generic, finite and not zero.
"""

from disting.conditions.inclusion import Inclusion
from disting.conditions.rule import EXACT
from disting.evidence.conditions import Counts, Forms, Ranks
from disting.evidence.decision import DeadTime
from disting.model.presentation import COUNTED, HALVES, plural
from disting.model.question import Domain
from disting.verdict.result import Relation, Verdict, open_note

RESPONSE = "response"  # what is measured where nothing else is said
DECADE = 20  # decibels that a power of s falls in a decade of frequency
PARTS = {
    frozenset("a"): ("In its resonances and how they are damped", "In its poles"),
    frozenset("b"): (
        "In its gain, its antiresonances and how they are damped",
        "In its gain and its zeros",
    ),
    frozenset("G"): ("Just after an impulse", "Just after an impulse"),
}  # of a machine, and of any other model


def meaning_sentence(verdict: Verdict, what: str = RESPONSE, everywhere: bool = False) -> str:
    """Sentence on the result of measuring either model, or, where nothing is decided, on the reason
    and a remedy. `what` is measured: a response, of circuits an impedance. `everywhere`: special
    values, of which the verdict does not speak, are known to be no exception.

    Of unequal ranks (conditions 4 and 5): the behaviours of the model of smaller rank lie in a
    variety of smaller dimension, so a generic behaviour of the other one is not there; the number
    of equations is the difference of the ranks.
    """
    left, right, machines = verdict.left, verdict.right, _are_chains(verdict)
    if verdict.relation is Relation.INDISTINGUISHABLE:
        return _the_same(verdict, what, everywhere)
    if verdict.relation is Relation.SOMETIMES:
        return (
            f"It depends on the values: some {what}s fit both {left} and {right}, others only one"
            " of them."
        )
    match verdict.evidence:
        case Counts():
            if any(note.startswith(f"{COUNTED}v") for note in verdict.notes):
                return f"The {what}s of {left} and {right} are made of other powers of s."
            halves = HALVES in verdict.notes
            return _steeper(verdict.evidence, left, right, machines, halves, what)
        case Ranks():
            return _more_equations(verdict.evidence, left, right, machines, what)
        case Forms():
            return _varying(verdict.evidence, left, right, what)
        case DeadTime(left_given=is_left):
            delayed = left if is_left else right
            return f"Towards high frequencies the phase of {delayed} falls without an end."
        case None:
            return _not_known(verdict, what)
        case _:
            text = f"One of {left} and {right} has {what}s that the other never has"
            # one that is a limit of the other comes as close as one likes
            if verdict.closure is not Inclusion.NEITHER:
                return f"{text}."
            return (
                f"{text}: fitted to such a{_n(what)} {what}, the wrong one leaves an error however"
                " well it is measured."
            )


def _n(word: str) -> str:
    """The end of an article before it."""
    return "n" if word[0] in "aeiou" else ""


def undetermined_sentence(name: str, rank: int, parameters: int) -> str:
    """Sentence on the values of one model that no measurement with these inputs and outputs
    determines; "" where each parameter is determined, at least up to finitely many values.

    It is reported before a model is called distinguishable: that its structure shows does not mean
    that its values do.

    >>> undetermined_sentence("2:2", 3, 4)
    'Not all of 2:2 can be determined: what is measured fixes 3 combinations of its 4 parameters.'
    >>> undetermined_sentence("2:1", 4, 4)
    ''
    """
    if rank >= parameters:
        return ""
    fixed = plural(rank, "combination") if rank else "no combination"
    return (
        f"Not all of {name} can be determined: what is measured fixes {fixed} of its"
        f" {parameters} parameters."
    )


def _are_chains(verdict: Verdict) -> bool:
    return all(p is not None and p.quantity is not None for p in verdict.premises)


def _the_same(verdict: Verdict, what: str, everywhere: bool) -> str:
    left, right = verdict.left, verdict.right
    over = "" if verdict.domain is Domain.POSITIVE else f" with {verdict.domain} parameters"
    aside = ", special values aside" if verdict.has_exceptions and not everywhere else ""
    return (
        f"For every {left} there is a {right}{over} with exactly the same {what}, and vice"
        f" versa{aside}. What is measured here does not tell them apart."
    )


def _not_known(verdict: Verdict, what: str) -> str:
    """Sentence on the consequences of an undecided verdict for a measurement, and on what may
    decide after all.
    """
    text = f"Not known: a measurement may or may not tell {verdict.left} and {verdict.right} apart."
    if verdict.notes[:1] and verdict.notes[0].startswith(open_note("")):
        return (
            f"{text} Some values, perhaps negative ones, give both the same {what}; whether"
            f" {verdict.domain} ones do is open. What helps: the values of your own machine;"
            " 'disting equivalents' with --set lists what else does the same with positive values."
        )
    if any(note.startswith(EXACT.in_words()) for note in verdict.notes):
        return (
            f"{text} They are too large for the exact decision, or it would take too long. What"
            " helps: ask smaller ones of the same kind (fewer elements; of machines also without"
            " dampers), and take the answer as theirs alone."
        )
    return (
        f"{text} What was asked does not decide it. What helps: let everything decide, without"
        " --conditions and --representation, where they were given."
    )


def _steeper(counts: Counts, left: str, right: str, machines: bool, halves: bool, what: str) -> str:
    """Degrees n over m: towards high frequencies |G| falls by 20 (m - n) dB in a decade, by half of
    it where powers are counted in halves.
    """
    (n1, m1), (n2, m2) = counts.first
    if n1 < 0 or n2 < 0:
        still, moves = (left, right) if n1 < 0 else (right, left)
        sensor = "sensor" if machines else "output"
        return f"The {sensor} of {still} never moves, that of {moves} does."
    if m1 - n1 != m2 - n2:
        steep, flat = (left, right) if m1 - n1 > m2 - n2 else (right, left)
        fall = DECADE * abs((m1 - n1) - (m2 - n2)) // (1 + halves)
        if halves:
            return (
                f"Towards high frequencies the {what} of {steep} falls by {fall} dB a decade more"
                f" than that of {flat}."
            )
        return (
            f"Towards high frequencies the {what} of {steep} falls by {fall} dB a decade more"
            f" than that of {flat}"
            f"{_zeros(n2 - n1 if flat == right else n1 - n2, flat, machines)}."
        )
    more, poles = (left, m1 - m2) if m1 > m2 else (right, m2 - m1)
    if halves:
        return f"The {what} of {more} has more coefficients in powers of s^(1/2)."
    return f"The {what} of {more} has {poles} {'pole' if poles == 1 else 'poles'} more."


def _zeros(more: int, flat: str, machines: bool) -> str:
    if more < 1:
        return ""
    zeros = "one zero" if more == 1 else f"{more} zeros"
    pair = " (an antiresonance is a pair of them)" if more > 1 and machines else ""
    return f": {flat} has {zeros} more{pair}"


def _more_equations(ranks: Ranks, left: str, right: str, machines: bool, what: str) -> str:
    fewer, more = (left, right) if ranks.left < ranks.right else (right, left)
    count = abs(ranks.left - ranks.right)
    equations = "an equation" if count == 1 else f"{count} equations"
    kinds = frozenset(label[0] for label in ranks.rows)
    of_machines, of_others = PARTS.get(kinds, ("", ""))
    where = of_machines if machines else of_others
    every = f"{where}, every" if where and not ranks.all_rows else "Every"
    return (
        f"{every} {fewer} {what} satisfies {equations} that a {more} {what} satisfies only by"
        " coincidence. That tells them apart."
    )


def _varying(forms: Forms, left: str, right: str, what: str) -> str:
    if "Td" in (*forms.only_left, *forms.only_right):
        delayed = left if "Td" in forms.only_left else right
        return f"Towards high frequencies the phase of {delayed} falls without an end."
    fixed, free = (left, right) if forms.only_right else (right, left)
    return (
        f"A coefficient of the {what} is one fixed number for every {fixed}; that of {free}"
        " changes with its parameters."
    )
