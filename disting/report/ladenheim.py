"""The page of Ladenheim's canonical networks: one-ports of R, L and C with at most five elements,
at most two of them L or C, each of which determines all its values; by classes of what they can do.

E. L. Ladenheim, "A synthesis of biquadratic impedances", 1948; A. Morelli and M. C. Smith, "Passive
Network Synthesis: An Approach to Classification", SIAM 2019, find 108 networks in 62 classes of
equal sets of impedances. The classes of the family hold for almost all values; some of them fall
apart where the sets are compared exactly: one network reaches impedances of a lower degree at
special values, another one never does (`disting.general.special_values`).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from markupsafe import Markup

from disting.equivalence.duplicates import duplicate
from disting.evidence.general import BOTH, Explicit
from disting.general.model import Model
from disting.general.special_values import lower_degree
from disting.model.question import Domain
from disting.report.environment import render
from disting.report.formulas import typeset
from disting.report.listing import Card, Listing
from disting.report.words import plural
from disting.verdict.query import View
from disting.verdict.result import Relation

FAMILY, ADDRESS = "circuits-5", "ladenheim.html"
OPEN = (Relation.SOMETIMES, Relation.UNDECIDED)


@dataclass(frozen=True, slots=True)
class Member:
    """A network of a class; `special`: polynomials that are zero where its impedance has a lower
    degree, None where it is not known whether it ever has.
    """

    card: Card
    special: tuple[str, ...] | None

    @property
    def equations(self) -> list[Markup]:
        """Where its impedance has a lower degree, typeset."""
        return [typeset(polynomial) for polynomial in self.special or ()]


@dataclass(frozen=True, slots=True)
class Class:
    """Networks that do the same for almost all values; `parts`: those that reach lower degrees, and
    those that never do; `exact`: whether within each part all values have equivalents.
    """

    number: int
    parts: tuple[tuple[Member, ...], ...]
    exact: bool

    @property
    def members(self) -> tuple[Member, ...]:
        """All of them."""
        return tuple(m for part in self.parts for m in part)

    @property
    def elements(self) -> str:
        """The kinds of its elements, such as C C R R."""
        names = self.members[0].card.model.parameters
        return " ".join(sorted(name[0] for name in names))


def is_canonical(card: Card) -> bool:
    """Whether the impedance determines all values, but for finitely many sets."""
    return card.known.local.rank == len(card.model.parameters)


def classes(shown: Listing) -> list[Class]:
    """The canonical networks by what they can do over positive values, the smallest first."""
    found: dict[object, list[Card]] = {}
    for card in filter(is_canonical, shown.cards):
        found.setdefault(card.groups[0] or ("alone", card.number), []).append(card)
    groups = sorted(found.values(), key=lambda g: (len(g[0].model.parameters), g[0].number))
    return [_class(shown, number, cards) for number, cards in enumerate(groups, 1)]


def _class(shown: Listing, number: int, cards: list[Card]) -> Class:
    members = [
        Member(c, lower_degree(c.model) if isinstance(c.model, Model) else None) for c in cards
    ]
    kinds = [[m for m in members if (m.special == ()) is never] for never in (True, False)]
    parts = tuple(tuple(part) for part in kinds if part)
    numbers = [[m.card.number for m in part] for part in parts]
    pairs = [pair for part in numbers for pair in combinations(part, 2)]
    return Class(number, parts, all(_holds_always(shown, *pair) for pair in pairs))


def _holds_always(shown: Listing, left: int, right: int) -> bool:
    """Whether two networks that are the same have equivalents of all values, special ones too."""
    found, models = shown.found.decisions[View.POSITIVE], shown.found.family
    if not found.verdict(left - 1, right - 1).has_exceptions:
        return True
    ways = (left, right), (right, left)
    formulas = [duplicate(found, models, a - 1, b - 1).formulas for a, b in ways]
    if not all(formulas):
        return False
    both = tuple((side, *f[1:]) for side, of in zip(BOTH, formulas, strict=True) for f in of)
    return Explicit(Domain.POSITIVE, both).without_exception(Domain.POSITIVE)


def open_pairs(shown: Listing) -> Iterator[tuple[Card, Card, Relation]]:
    """Yield the pairs of canonical networks that are the same for some values, or not decided."""
    for a, b in combinations(filter(is_canonical, shown.cards), 2):
        relation = shown.found.relation(a.number, b.number, View.POSITIVE)
        if relation in OPEN:
            yield a, b, relation


def ladenheim_page(shown: Listing, *, site: bool = False) -> str:
    """HTML of the page, from a family of circuits; its page of models lies beside it. `site`:
    whether the pages of the site do.
    """
    found = classes(shown)
    left = [card for card in shown.cards if not is_canonical(card)]
    return render(
        "ladenheim.html",
        shown=shown,
        classes=found,
        canonical=len(shown.cards) - len(left),
        parts=sum(len(c.parts) for c in found),
        split=[c for c in found if len(c.parts) > 1],
        left=left,
        open=list(open_pairs(shown)),
        drawings=[card.drawing for card in shown.cards if card.drawing],
        site=site,
        plural=plural,
    )
