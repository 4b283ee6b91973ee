"""What pages say of a catalogue over positive and over complex parameters: counts, groups, and the
order by groups.

Over complex parameters indistinguishable models form classes. Over positive ones a class may fall
apart: into smaller groups, which are indistinguishable for all positive parameters, and pairs
between them that are so for some values only, or that are open. Such groups stand beside each
other in the order by groups.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from disting.evidence.positive import Share
from disting.model.question import Domain
from disting.report.words import DecidedModels, totals
from disting.verdict.query import View
from disting.verdict.result import Relation

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
    groups and single models that the order by groups puts first, related ones beside
    each other.
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
        """Which parameters."""
        return self.view.domain


def over(decided: DecidedModels, view: View) -> Over:
    """What pages say over the domain of a view, one of VIEWS."""
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
