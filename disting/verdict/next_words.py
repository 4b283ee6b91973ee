"""Next measurements, in words, as rows and as plain data."""

from collections.abc import Iterator
from itertools import product
from typing import Any

from disting.conditions.rule import EXACT, FREE_CHOICE, RENAMING
from disting.errors import enumeration
from disting.experiments.menu import Gain, Item
from disting.files import Format
from disting.model.chain import Chain
from disting.network.network import Network
from disting.verdict.next_experiments import Menu, Option
from disting.verdict.placement_record import REPEATS
from disting.verdict.result import Relation, error_bound

CSV_COLUMNS = (
    "experiment",
    "left",
    "at_left",
    "right",
    "at_right",
    "relation",
    "decided_by",
    "certainty",
    "error_bound",
)
WHY = {
    RENAMING.name: "by symmetry both show the same after a renaming of the parameters",
    FREE_CHOICE.name: "both can show any such numbers",
    EXACT.name: "each has parameters that show all that the other one shows",
    REPEATS: "it shows in both what is known already",
}
UNSEEN = "nothing moves"  # where nothing moves
AnyMenu = Menu[Chain | Network]
NOTHING = {
    Gain.REPEATS: "tells nothing new",
    Gain.SILENT: "the sensor does not move",
}


def left_over(further: AnyMenu, structure: int, item: Item) -> dict[int, tuple[int, ...]]:
    """The structures that an item does not certainly distinguish from this one, with the masses at
    which it does not.
    """
    table = further.tables[item.kind]
    places = {k: table.alike((structure, item.at), k) for k in further.others(structure)}
    return {k: masses for k, masses in places.items() if masses}


def in_words(further: AnyMenu, structure: int, item: Item) -> str:
    """Result of an item in words, if this structure is assumed."""
    gain = further.tables[item.kind].gain((structure, item.at))
    if not item.is_worth(gain):
        return NOTHING[gain] if further.place == "mass" or gain is Gain.REPEATS else UNSEEN
    left = left_over(further, structure, item)
    if not left:
        return "always separates it from the others"
    phrases = [
        f"{start} if that is {_among(further, kept)}"
        for start, kept in (
            ("not", _only(further, structure, item, Relation.INDISTINGUISHABLE)),
            ("not known", _only(further, structure, item, Relation.UNDECIDED)),
        )
        if kept
    ]
    return "; ".join(phrases)


def option_in_words(option: Option) -> str:
    """A set of items with its price.

    >>> from disting.model.kinds import LOCK
    >>> option_in_words(Option((Item(LOCK, 2),), 3.0, ()))
    'mass 2 locked (cost 3)'
    """
    return f"{' and '.join(item.text for item in option.items)} (cost {option.cost:g})"


def conclusion(further: AnyMenu, structure: int) -> str:
    """The cheapest sets that are enough, or what is left by the best one, and why."""
    least = further.least(structure)
    if least:
        return f"sufficient: {'; or '.join(map(option_in_words, least))}"
    best = further.best(structure)
    if best is None:
        return "no experiment on this menu shows anything new"
    kept = ", ".join(further.names[k] for k in best.left)
    return (
        f"no experiment on this menu is known to be enough; the best is {option_in_words(best)},"
        f" which may leave {kept}: {_why(further, structure, best)}"
    )


def anywhere(further: AnyMenu) -> str:
    """The kinds that distinguish all of them at any place; "" if none does."""
    enough = [k for k in further.kinds if further.anywhere(k)]
    phrases = [f"{k.anywhere} (cost {further.costs.cost(k):g})" for k in enough]
    return "; or ".join(phrases)


def group_in_words(further: AnyMenu) -> str:
    """Number of experiments that distinguish the structures of a group: one anywhere, one at the
    right place, or two.

    >>> from disting.catalogs.next_files import next_catalog
    >>> group_in_words(next_catalog(3, damped=True).further((9, 10)))[:57]
    'one experiment separates each from the others, but none d'
    """
    if anywhere(further):
        return f"all separated by {anywhere(further)}"
    least = [further.least(k) for k in range(len(further.names))]
    counts = [len(options[0].items) if options else 0 for options in least]
    unknown, two = (
        [name for name, count in zip(further.names, counts, strict=True) if count == wanted]
        for wanted in (0, 2)
    )
    if unknown:
        return f"no two experiments are known to separate {enumeration(unknown)} from the others"
    if two:
        return (
            f"no single experiment always separates {enumeration(two)} from the others, but two do"
        )
    return (
        "one experiment separates each from the others, but none does so at every"
        f" {further.place}: see which {further.place} below"
    )


def rows(further: AnyMenu) -> Iterator[tuple[str, ...]]:
    """Yield a row of CSV_COLUMNS for each kind of experiment and each pair of places."""
    for kind in further.kinds:
        table = further.tables[kind]
        for a, left in enumerate(further.names):
            for b, right in enumerate(further.names[a + 1 :], a + 1):
                for i, j in product(further.places(a), further.places(b)):
                    relation, rule = table.look_up((a, i), (b, j))
                    grade, safety = table.grade((a, i), (b, j))
                    bound = error_bound(grade, safety)
                    row = (kind.name, left, i, right, j, relation.value, rule, grade, bound)
                    yield tuple(map(str, row))


def to_dict(further: AnyMenu) -> dict[str, Any]:
    """Plain data, ready for JSON."""
    return {
        "format": Format.NEXT.value,
        "structures": list(further.names),
        "domain": "complex",
        "costs": further.costs.of_kinds(further.kinds),
        "anywhere": [kind.name for kind in further.kinds if further.anywhere(kind)],
        "menu": [
            _item(further, k, item) for k in range(len(further.names)) for item in further.items(k)
        ],
        "least": {
            name: [_option(further, o) for o in further.least(k)]
            for k, name in enumerate(further.names)
        },
        "pairs": [dict(zip(CSV_COLUMNS, row, strict=True)) for row in rows(further)],
    }


def many(further: AnyMenu) -> str:
    """The name of several places in plain data.

    >>> from disting.catalogs.next_files import next_catalog
    >>> many(next_catalog(3).further((1, 11)))
    'masses'
    """
    return "masses" if further.place == "mass" else f"{further.place}s"


def _item(further: AnyMenu, structure: int, item: Item) -> dict[str, Any]:
    left = left_over(further, structure, item)
    return {
        "structure": further.names[structure],
        "experiment": item.kind.name,
        further.place: item.at,
        "cost": further.costs.cost(item.kind),
        "answer": further.whole(structure, item).value,
        "not_from": [
            {"structure": further.names[k], many(further): list(m)} for k, m in left.items()
        ],
    }


def _option(further: AnyMenu, option: Option) -> dict[str, Any]:
    items = [{"experiment": i.kind.name, further.place: i.at} for i in option.items]
    return {"cost": option.cost, "experiments": items}


def _why(further: AnyMenu, structure: int, option: Option) -> str:
    """The reason for the first structure that is left."""
    item, other = option.items[0], option.left[0]
    table = further.tables[item.kind]
    j = table.alike((structure, item.at), other)[0]
    relation, rule = table.look_up((structure, item.at), (other, j))
    return "this is undecided" if relation is Relation.UNDECIDED else WHY[rule]


def _only(
    further: AnyMenu, structure: int, item: Item, relation: Relation
) -> dict[int, tuple[int, ...]]:
    """Structures that remain because of this relation."""
    table, spot = further.tables[item.kind], (structure, item.at)
    left = {
        k: tuple(j for j in masses if table.look_up(spot, (k, j))[0] is relation)
        for k, masses in left_over(further, structure, item).items()
    }
    return {k: masses for k, masses in left.items() if masses}


def _among(further: AnyMenu, left: dict[int, tuple[int, ...]]) -> str:
    return ", or ".join(
        f"{further.place} {_either(at)} of {further.names[k]}" for k, at in left.items()
    )


def _either(masses: tuple[int, ...]) -> str:
    return " or ".join(map(str, masses))
