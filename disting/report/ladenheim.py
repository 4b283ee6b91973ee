"""The page of Ladenheim's canonical networks: one-ports of R, L and C with at most five elements,
at most two of them L or C, each of which determines all its values; by classes of what they can do.

E. L. Ladenheim, "A synthesis of biquadratic impedances", 1948; A. Morelli and M. C. Smith, "Passive
Network Synthesis: An Approach to Classification", SIAM 2019, find 108 networks in 62 classes. The
classes of the family hold for almost all values. A part of a class has the same impedances for all
values, special ones included: in one part networks of two kinds of elements that reach the same
lower orders (`disting.network.exact`), of others those for which formulas without exceptions are
known. Numerators and denominators that keep a common factor differ by more: by whether it is a
double pole or a double zero.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from markupsafe import Markup

from disting.equivalence.duplicates import duplicate
from disting.evidence.general import BOTH, Explicit
from disting.general.matrix_model import Model
from disting.general.special_values import Special, lower_degree
from disting.model.question import Domain
from disting.network.exact import within
from disting.report.drawing import share
from disting.report.environment import render
from disting.report.formulas import typeset
from disting.report.listing import Card, Listing
from disting.report.words import plural
from disting.verdict.result import Relation, View

FAMILY, ADDRESS = "circuits-5", "ladenheim.html"
OPEN = (Relation.SOMETIMES, Relation.UNDECIDED)


@dataclass(frozen=True, slots=True)
class Member:
    """A network of a class; `special`: where its impedance has a lower degree, None where it is not
    known whether it ever has.
    """

    card: Card
    special: tuple[Special, ...] | None

    @property
    def equations(self) -> list[tuple[Markup, str]]:
        """Where its impedance has a lower degree, typeset, and what falls together there."""
        return [(typeset(s.polynomial), _what_cancels(s)) for s in self.special or ()]

    @property
    def factors(self) -> frozenset[str]:
        """Possible common factors of its numerators and denominators."""
        return frozenset(_what_cancels(s) for s in self.special or ())


@dataclass(frozen=True, slots=True)
class Class:
    """Networks that are equivalent for almost all values; `parts`: those that are so for special
    values too; `exact`: whether that is proven of each part, and that no two parts are one.
    """

    number: int
    parts: tuple[tuple[Member, ...], ...]
    exact: bool

    @property
    def members(self) -> tuple[Member, ...]:
        """All of them."""
        return tuple(m for part in self.parts for m in part)

    @property
    def n_with_factors(self) -> int:
        """Number of parts if common factors are kept."""
        return len({(i, m.factors) for i, part in enumerate(self.parts) for m in part})

    @property
    def elements(self) -> str:
        """The kinds of its elements, such as C C R R."""
        names = self.members[0].card.model.parameters
        return " ".join(sorted(name[0] for name in names))


def is_canonical(card: Card) -> bool:
    """Return True if the impedance determines all values up to finitely many sets."""
    return card.known.local.rank == len(card.model.parameters)


def classes(shown: Listing) -> list[Class]:
    """The canonical networks by what they can do over positive values, the smallest first."""
    the_cards: dict[object, list[Card]] = {}
    for card in filter(is_canonical, shown.cards):
        the_cards.setdefault(card.groups[0] or ("alone", card.number), []).append(card)
    groups = sorted(the_cards.values(), key=lambda g: (len(g[0].model.parameters), g[0].number))
    return [_class(shown, number, cards) for number, cards in enumerate(groups, 1)]


def _class(shown: Listing, number: int, cards: list[Card]) -> Class:
    parts = list[list[Member]]()
    for card in cards:
        member = Member(card, lower_degree(card.model) if isinstance(card.model, Model) else None)
        part = next((p for p in parts if not _differ(p[0], member)), None)
        if part is None:
            parts.append([member])
        else:
            part.append(member)
    exact = all(_same(shown, part[0], m) for part in parts for m in part[1:])
    return Class(number, tuple(map(tuple, parts)), exact)


def _differ(member: Member, other: Member) -> bool:
    """Return True if one of two networks that are equivalent for almost all values is known to give
    more than the other one at special values.
    """
    if None not in (member.special, other.special) and bool(member.special) != bool(other.special):
        return True
    return False in _within(member, other)


def _within(member: Member, other: Member) -> tuple[bool | None, bool | None]:
    left, right = member.card.model.network, other.card.model.network
    if left is None or right is None:
        return None, None
    return within(left, right), within(right, left)


def _same(shown: Listing, member: Member, other: Member) -> bool:
    """Return True if two networks that are equivalent for almost all values are so for special ones
    too: by their parts, or by formulas.
    """
    if all(_within(member, other)):
        return True
    left, right = member.card.number, other.card.number
    decisions, models = shown.found.decisions[View.POSITIVE], shown.found.family
    if not decisions.verdict(left - 1, right - 1).has_exceptions:
        return True
    ways = (left, right), (right, left)
    formulas = [duplicate(decisions, models, a - 1, b - 1).formulas for a, b in ways]
    if not all(formulas):
        return False
    if any(f.steps for of in formulas for f in of):
        return False
    both = tuple((side, *f[1:4]) for side, of in zip(BOTH, formulas, strict=True) for f in of)
    return Explicit(Domain.POSITIVE, both).without_exception(Domain.POSITIVE)


def _what_cancels(special: Special) -> str:
    if special.poles == special.zeros:
        return "a pole cancels with a zero"
    return f"two {'poles' if special.poles else 'zeros'} fall together"


def open_pairs(shown: Listing) -> Iterator[tuple[Card, Card, Relation]]:
    """Yield the pairs of canonical networks that are the same for some values, or not decided."""
    for a, b in combinations(filter(is_canonical, shown.cards), 2):
        relation = shown.found.relation(a.number, b.number, View.POSITIVE)
        if relation in OPEN:
            yield a, b, relation


def ladenheim_page(shown: Listing, *, site: bool = False) -> str:
    """HTML of the page, from a family of circuits; its page of models is in the same folder.
    `site`: whether the pages of the site do.
    """
    the_classes = classes(shown)
    left = [card for card in shown.cards if not is_canonical(card)]
    pairs = list(open_pairs(shown))
    decided = not any(relation is Relation.UNDECIDED for *_, relation in pairs)
    return render(
        "ladenheim.html",
        shown=shown,
        classes=the_classes,
        canonical=len(shown.cards) - len(left),
        parts=sum(len(c.parts) for c in the_classes),
        with_factors=sum(c.n_with_factors for c in the_classes),
        proven=decided and all(c.exact for c in the_classes),
        split=[c for c in the_classes if len(c.parts) > 1],
        left=left,
        open=pairs,
        held=share(card.drawing for card in shown.cards if card.drawing),
        site=site,
        plural=plural,
    )
