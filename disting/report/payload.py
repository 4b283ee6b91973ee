"""The data behind the fields: each view's verdicts in a compact form for the page's script, each
text once.

Pair (low, high) is entry (high - 1)(high - 2)/2 + low - 1 of a view, that is row after row of the
triangle. A sentence names the models {L} and {R}, so that pairs decided alike share it. Equal
neighbours are counted (`pack`).

Pages show of a catalogue, over positive and over complex parameters, counts, groups, and the order
by groups. Over complex parameters indistinguishable models form classes. Over positive ones a class
may fall apart: into smaller groups, which are indistinguishable for all positive parameters, and
pairs between them that are so for some values only, or that are open. Such groups are adjacent in
the order by groups.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import combinations, groupby
from operator import attrgetter

from markupsafe import Markup

from disting.conditions.rule import ADMISSIBLE, RULES
from disting.evidence.conditions import capital
from disting.evidence.positive import Share
from disting.files import json_text
from disting.model.question import Domain
from disting.report.words import (
    SAID as RELATIONS_SAID,
    VIEW_TITLES,
    DecidedModels,
    raise_exponents,
    totals,
)
from disting.verdict.meaning import RESPONSE, meaning_sentence
from disting.verdict.result import Relation, Verdict, View

Members = tuple[int, ...]
VIEWS = (View.POSITIVE, View.EXACT)  # the engineer's first, then the paper's
ABLE = (Share.ALWAYS, Share.SOMETIMES)


@dataclass(frozen=True, slots=True)
class OneSidedPair:
    """Of a distinguishable pair, models `given` have an equivalent `other` for all or some of
    their positive parameters.
    """

    given: int
    other: int
    share: Share


@dataclass(frozen=True, slots=True)
class Over:
    """A catalogue over one domain: pairs by relation, groups, pairs that depend on the values,
    one-sided ones.

    `aside`: the pairs of a group of which the verdict leaves special values aside. `blocks`: the
    groups and single models that the order by groups puts first, related ones adjacent.
    """

    view: View
    totals: dict[Relation, int]
    groups: tuple[Members, ...]
    aside: tuple[tuple[int, int], ...]
    depending: tuple[tuple[int, int], ...]
    one_sided: tuple[OneSidedPair, ...]
    blocks: tuple[Members, ...]

    @property
    def domain(self) -> Domain:
        """Domain of the parameters."""
        return self.view.domain


def over(decided: DecidedModels, view: View) -> Over:
    """Content of pages over the domain of a view, one of VIEWS."""
    groups = decided.classes(view)
    sides = tuple(one_sided_pairs(decided)) if view is View.POSITIVE else ()
    return Over(
        view=view,
        totals=totals(decided, view),
        groups=groups,
        aside=tuple(with_exceptions(decided, view)),
        depending=decided.depending(view),
        one_sided=sides,
        blocks=blocks(decided.classes(View.EXACT), groups),
    )


def with_exceptions(decided: DecidedModels, view: View) -> Iterator[tuple[int, int]]:
    """Yield the pairs of a group of which the verdict leaves special values aside."""
    for members in decided.classes(view):
        for pair in combinations(members, 2):
            if decided.verdict(*pair, view).has_exceptions:
                yield pair


def blocks(classes: tuple[Members, ...], groups: tuple[Members, ...]) -> tuple[Members, ...]:
    """The groups class by class, the largest first, and the single models of a class that falls
    apart behind its groups.

    >>> blocks(((1, 4), (2, 3, 5)), ((1, 4), (2, 5)))
    ((2, 5), (3,), (1, 4))
    """
    pairs: list[Members] = []
    for members in sorted(classes, key=_size_first):
        own = [group for group in groups if set(group) <= set(members)]
        singles = [(m,) for m in members if not any(m in group for group in own)]
        pairs += [*sorted(own, key=_size_first), *singles]
    return tuple(pairs)


def one_sided_pairs(decided: DecidedModels) -> Iterator[OneSidedPair]:
    """The distinguishable pairs of which positive models on one side have equivalents on the
    other.
    """
    for left, right, v in decided.pairs(View.POSITIVE):
        if v.relation is Relation.DISTINGUISHABLE:
            for finding, number, other in (
                (v.left_positive, left, right),
                (v.right_positive, right, left),
            ):
                if finding is not None and finding.share in ABLE:
                    yield OneSidedPair(number, other, finding.share)


def _size_first(members: Members) -> tuple[int, Members]:
    return -len(members), members


SHARES = {
    Share.ALWAYS: "Every{generic} {0} with positive parameters has a positive equivalent {1}",
    Share.SOMETIMES: (
        "Some {0} with positive parameters have a positive equivalent {1}, others have none"
    ),
    Share.NEVER: "No generic {0} with positive parameters has a positive equivalent {1}",
    Share.UNKNOWN: (
        "Whether {0} with positive parameters have a positive equivalent {1} is not known"
    ),
}
SYMBOLS = {
    r"\bb\d": "b0, b1, …: coefficients of the numerator, b0 that of s⁰; gain and antiresonances",
    r"\ba\d": (
        "a0, a1, …: coefficients of the denominator, the highest made 1; resonances and damping"
    ),
    r"\bG\d": (
        "G1, G2, …: Markov parameters, the series of the transfer function in 1/s; how the motion"
        " begins after a blow"
    ),
    r"\bn \+ m": "n, m: degrees of numerator and denominator",
    "Φ": "Φ: all coefficients of the transfer function, as functions of the parameters",
    r"\bp₀": "p₀: one choice of parameters of one model",
    r"∂|rank": (
        "rank: how many of these quantities can be set freely; the rest follows from them by laws"
    ),
    r"N_R|determinable": (
        "determinable parameters (N_R): how many numbers a measurement determines, the rank of Φ"
    ),
    r"N_R = .*\{": "{…}: the coefficients that depend on the parameters",
    "∅": "∅: no parameters at all",
    "Td": "Td: the dead time",
}
"""Symbols and words of formulas and sentences, as patterns, and what they mean."""
ALIKE = attrgetter(*(f.name for f in fields(Verdict) if f.name not in ("left", "right")))
"""All of a verdict but the names: what pairs have in common that are decided alike."""
Entry = tuple[str, str, str, str, str, str, str, str, str, str, str]
"""relation, decided_by, representation, certainty in words, domain, what a measurement shows, why,
formula, what decided in words, what else is known, what is left out
"""


@dataclass(slots=True)
class Pool:
    """Gives equal values one number, in the order of their first appearance."""

    numbers: dict[Entry | str, int] = field(default_factory=dict)

    def number(self, value: Entry | str) -> int:
        """Number of a value."""
        return self.numbers.setdefault(value, len(self.numbers))


def payload(
    decided: DecidedModels,
    domains: Sequence[Over],
    views: Iterable[View] = VIEW_TITLES,
    what: str = RESPONSE,
    aside: Callable[[int, int, View], str] = lambda low, high, view: "",
    **more: object,
) -> Markup:
    """JSON text that is safe inside a script element: the views, groups by domain, and further data
    for the script; `what` is measured of the models, `aside` adds a note on a pair.
    """
    texts, entries, known = Pool(), Pool(), dict[object, int]()

    def entry(low: int, high: int, view: View) -> int:
        """Number of the entry of a pair, which is made once for all that are decided alike."""
        verdict, reached = decided.verdict(low, high, view), aside(low, high, view)
        key = ALIKE(verdict), reached
        if key not in known:
            known[key] = entries.number(_entry(verdict, what, reached))
        return known[key]

    numbers = {
        view.value: pack([entry(*pair, view) for pair in _triangle(len(decided.family))])
        for view in views
    }
    rows = [[texts.number(text) for text in entry] for entry in entries.numbers]
    data = more | {
        "models": len(decided.family),
        "groups": {of.view.value: of.groups for of in domains},
        "blocks": {of.view.value: of.blocks for of in domains},
        "said": RELATIONS_SAID,
        "titles": VIEW_TITLES,
        "symbols": list(SYMBOLS.items()),
        "signs": {rule.name: rule.sign for rule in RULES.values()},
        "texts": list(texts.numbers),
        "entries": rows,
        "views": numbers,
    }
    return script_json(data)


def pack(numbers: Sequence[int]) -> list[int]:
    """Numbers >= 0 with their repetitions as one negative count, so that a matrix of millions of
    fields stays small.

    >>> pack([7, 7, 7, 0, 7])
    [7, -2, 0, 7]
    """
    the_numbers: list[int] = []
    for number, run in groupby(numbers):
        again = sum(1 for _ in run) - 1
        the_numbers += [number, -again] if again else [number]
    return the_numbers


def script_json(data: object) -> Markup:
    """Compact JSON without a character that could end a script element or begin a comment in it.

    >>> str(script_json(["</script>&"]))
    '["\\\\u003c/script\\\\u003e\\\\u0026"]'
    """
    text = json_text(data)
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)


def _triangle(size: int) -> Iterator[tuple[int, int]]:
    return ((low, high) for high in range(1, size + 1) for low in range(1, high))


def _entry(verdict: Verdict, what: str, reached: str) -> Entry:
    evidence = verdict.evidence
    why = evidence.sentence("{L}", "{R}") if evidence else _reason_undecided(verdict)
    certainty = f"{capital(raise_exponents(verdict.sure))}." if evidence else ""
    formula = evidence.formula if evidence else ""
    both = verdict.inclusions
    limits = [] if both is None else [f"Over complex parameters: {both.sentence('{L}', '{R}')}"]
    more = " ".join([*limits, *_shares(verdict)])
    graded = (
        verdict.relation,
        verdict.decided_by,
        verdict.representation,
        certainty,
        verdict.domain,
    )
    sentence = meaning_sentence(replace(verdict, left="{L}", right="{R}"), what)
    aside = ", special values aside" if verdict.has_exceptions else ""
    return *graded, f"{sentence} {reached}".strip(), why, formula, verdict.rule, more, aside


def _shares(verdict: Verdict) -> Iterator[str]:
    """Positive models of each side with positive equivalents, where the evidence does not state
    them already.
    """
    if verdict.decided_by == ADMISSIBLE.name:
        return
    for finding, text, other in (
        (verdict.left_positive, "{L}", "{R}"),
        (verdict.right_positive, "{R}", "{L}"),
    ):
        if finding is not None:
            stated = (
                f" ({finding.empirical.sentence})"
                if finding.share is Share.SOMETIMES and finding.empirical
                else ""
            )
            every = finding.evidence and finding.evidence.without_exception(Domain.POSITIVE)
            generic = "" if every else " generic"
            yield SHARES[finding.share].format(text, other, generic=generic) + stated + "."


def _reason_undecided(verdict: Verdict) -> str:
    # notes name models, and a name may look like a place for a name: a word joiner parts it
    phrase = "; ".join(verdict.notes).replace("{", "{\u2060")
    notes = f" ({phrase})" if phrase else ""
    return f"Nothing here settles {{L}} and {{R}} over {verdict.domain} parameters{notes}."
