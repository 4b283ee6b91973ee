"""Next measurements after a fit: sentences, rows and plain data on the remaining structures."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, permutations, product
from typing import Any

from disting.experiments.menu import Costs, Item
from disting.files import Format
from disting.fit.judge.exclusion import LEVEL
from disting.fit.search.candidates import listed_form, reference
from disting.fit.search.containment import contains
from disting.model.chain import LEGEND, Chain, text_drawing
from disting.planning.fit_file import FitRecord, Survivor
from disting.planning.next_experiment import Predictions, Reason, Step, Stood
from disting.planning.power import POWER
from disting.report.fit.plan_words import chance, larger_in_words
from disting.report.fit.words import percent, readable
from disting.verdict.next_experiments import Menu
from disting.verdict.next_words import CSV_COLUMNS, rows, to_dict
from disting.verdict.placement_verdicts import Answer
from disting.verdict.result import Relation

MEASURED_COLUMNS = ("largest", "frequency", "noncentrality", "power")
BEFORE = "at the fitted values, before a rival is fitted again"
SAYS = {
    Reason.EQUAL: "with this force and sensor no data can tell it from {}, whatever the values",
    Reason.TWIN: "with this force and sensor no data can tell it from {} at the fitted values",
    Reason.NOISE: "the data are too noisy to tell it from {}",
    Reason.OPEN: "it is not known whether data with this force and sensor can tell it from {}",
}


@dataclass(frozen=True)
class ChainAdvice:
    """All that is known: the relations of the structures, the menu of each group, and what each
    would show; `seen` is None where the file does not state the lines.
    """

    source: str
    named: FitRecord
    stood: Stood
    groups: tuple[Menu[Chain], ...]
    seen: Predictions | None
    costs: Costs

    @property
    def left(self) -> tuple[Survivor, ...]:
        """The structures."""
        return self.stood.left

    def pairs(self) -> Iterator[tuple[int, int]]:
        """Yield the pairs that sentences are about: the selected structure with each that was
        fitted, and each that was fitted with what behaves as it does.
        """
        for a, b in combinations(range(len(self.left)), 2):
            survivor, other = self.left[a], self.left[b]
            if (a == 0 and other.fitted) or survivor.chain in other.like:
                yield a, b

    def sure(self, a: int, item: Item, b: int) -> bool:
        """Return True if an item distinguishes structure a from b by what is known of all
        parameters: where both are of one group, some that it does not distinguish may remain.
        """
        for group in self.groups:
            names = [self.left[k].name for k in (a, b)]
            if set(names) <= set(group.names):
                own_place, other_place = map(group.names.index, names)
                return group.answer(own_place, item, other_place) is Answer.SURELY
        return self.stood.reason(a, b) is not Reason.EQUAL


def set_in_words(lead: ChainAdvice) -> Iterator[str]:
    """The structures with their drawings, their groups, and what is not considered."""
    yield f"{len(lead.left)} structures that the fit left:"
    width = max(len(survivor.name) for survivor in lead.left)
    for survivor in lead.left:
        yield f"  {survivor.name:{width}}  {text_drawing(survivor.chain)}  {_origin(survivor)}"
    yield ""
    yield LEGEND
    moved = ", ".join(x.name for x in lead.left if listed_form(x.chain).chain != x.chain)
    if moved:
        yield f"masses of {moved} have the numbers of these drawings"
    yield from larger_in_words(list(lead.named.larger), lead.left[0].name)
    left = {survivor.chain for survivor in lead.left}
    out = ", ".join(reference(chain) for chain in lead.named.rivals if chain not in left)
    if out:
        yield f"left out, because it is not known whether they behave the same: {out}"


def measured_in_words(lead: ChainAdvice) -> Iterator[str]:
    """Sentences on the basis of the numbers, one for each pair, then the menu of the selected
    structure in numbers.
    """
    if (predicted := lead.seen) is None:
        yield f"{lead.source} does not name the lines of its data: fit again to get powers"
        yield from (sentence(lead, a, b) for a, b in lead.pairs())
        return
    yield (
        f"differences and powers are {BEFORE}: fitted again it comes closer; one that contains the"
        " true structure fits it exactly"
    )
    yield bench_in_words(predicted)
    yield f"how much more of the same measurement tells them apart: disting plan {lead.source}"
    yield from ("", *(sentence(lead, a, b) for a, b in lead.pairs()))
    items = [(item, _nearest(lead, predicted, item)) for item in cheapest_first(lead, predicted, 0)]
    yield ""
    yield f"if the machine is {lead.left[0].name}: each experiment, and the rival it shows least:"
    head = "".join(f"{title:>10}" for title in ("largest", "at [Hz]", "lambda", "power"))
    width = max(len("rival"), *(len(survivor.name) for survivor in lead.left))
    yield f"  {'':33}{'rival':{width}}{head}"
    yield from (
        f"  {item.text:33}{_row(lead, predicted, width, *row)}" for item, row in items if row
    )
    yield (
        "largest: the largest difference at a line, in units of its scatter; lambda and power: of"
        f" the further response alone, level {percent(LEVEL)}"
    )


def sentence(lead: ChainAdvice, a: int, b: int) -> str:
    """Sentence on the relation of structure b to a, and on the cheapest experiment that
    distinguishes them.
    """
    survivor, other = lead.left[a], lead.left[b]
    standing = lead.stood.reason(a, b)
    text = f"{other.name}: {SAYS[standing].format(survivor.name)}"
    if standing is Reason.NOISE:
        if contains(other.chain, survivor.chain):
            text += f", which it contains: only {survivor.name} can be excluded"
        text += f" (disting plan {lead.source})"
    shown = _show_cheapest(lead, lead.seen, a, b) if lead.seen else ""
    return f"{text}; {shown}" if shown else text


def bench_in_words(seen: Predictions) -> str:
    """Lines, scatter, inertia, and what else is added."""
    bench, hertz = seen.bench, seen.bench.hertz
    more = [f"a {name} is {readable(size)}" for name, size in seen.sizes.items()][1:]
    beside = f"; {', '.join(more)}, times 2 pi f in the middle of the lines" if more else ""
    return (
        f"{len(hertz)} lines from {hertz[0]:.4g} to {hertz[-1]:.4g} Hz, each with a scatter of"
        f" {percent(float(bench.rho[0]))} (of the fitted data); the added inertia"
        f" is {readable(bench.inertia)}, the mean of the masses{beside}"
    )


def left_rows(lead: ChainAdvice) -> Iterator[tuple[str, ...]]:
    """Yield a row for each kind of experiment and each pair of places of each pair of structures,
    of CSV_COLUMNS and MEASURED_COLUMNS.
    """
    index = {own_survivor.name: k for k, own_survivor in enumerate(lead.left)}
    for row in (*(r for group in lead.groups for r in rows(group)), *_apart(lead)):
        plain = dict(zip(CSV_COLUMNS, row, strict=True))
        own_spot = index[plain["left"]], int(plain["at_left"])
        other_spot = index[plain["right"]], int(plain["at_right"])
        kind = next(k for k in lead.costs.cheapest_first if k.name == plain["experiment"])
        step = lead.seen.at(kind, own_spot, other_spot) if lead.seen else None
        yield (*row, *_numbers(lead, own_spot[0], other_spot[0], step))


def left_to_dict(lead: ChainAdvice) -> dict[str, Any]:
    """Plain data, ready for JSON; null where a number is not known or not finite."""
    return {
        "format": Format.NEXT_OF_FIT.value,
        "structures": [
            {
                "name": survivor.name,
                "fitted": survivor.fitted,
                "behaves_as": [reference(chain) for chain in survivor.like],
                "free_choices": survivor.free,
                "parameters": list(survivor.values),
            }
            for survivor in lead.left
        ],
        "groups": [to_dict(group) for group in lead.groups],
        "pairs": [_pair(lead, a, b) for a, b in combinations(range(len(lead.left)), 2)],
        "sentences": [sentence(lead, a, b) for a, b in lead.pairs()],
        "measured": _measure_items(lead, lead.seen) if lead.seen else None,
    }


def _pair(lead: ChainAdvice, a: int, b: int) -> dict[str, str]:
    names = {"left": lead.left[a].name, "right": lead.left[b].name}
    return names | {"standing": lead.stood.reason(a, b).value}


def _measure_items(lead: ChainAdvice, seen: Predictions) -> dict[str, Any]:
    hertz = seen.bench.hertz.tolist()
    return {
        "what": BEFORE,
        "low": hertz[0],
        "high": hertz[-1],
        "lines": len(hertz),
        "scatter": float(seen.bench.rho[0]),
        **seen.sizes,
        "level": LEVEL,
        "least": list(_least(lead, seen)),
    }


def _least(lead: ChainAdvice, seen: Predictions) -> Iterator[dict[str, Any]]:
    """Weakest distinction of a structure from another one, for each item of its menu."""
    for a, b in permutations(range(len(lead.left)), 2):
        for item in cheapest_first(lead, seen, a):
            nearest = seen.least(a, item, b)
            if nearest is not None:
                step, at = nearest
                yield {
                    "structure": lead.left[a].name,
                    "experiment": item.kind.name,
                    "mass": item.at,
                    "other": lead.left[b].name,
                    "at": at,
                    "moves_in_one_only": step.is_motion,
                    **_measures(seen, a, b, step),
                }


def _origin(survivor: Survivor) -> str:
    if survivor.fitted:
        return "fitted"
    family = f", one of many sets of values, {survivor.free} free" if survivor.free else ""
    like = ", ".join(reference(chain) for chain in survivor.like)
    return f"with the fitted response of {like}{family}"


def _apart(lead: ChainAdvice) -> Iterator[tuple[str, ...]]:
    """Rows of pairs of different classes: pairs that are distinguished now stay so."""
    for a, b in combinations(range(len(lead.left)), 2):
        if lead.stood.reason(a, b) is Reason.EQUAL:
            continue
        rule = lead.stood.rule(a, b)
        relation = Relation.DISTINGUISHABLE if rule else Relation.UNDECIDED
        places = product(*(range(1, lead.left[k].chain.n_masses + 1) for k in (a, b)))
        for kind, (i, j) in product(lead.costs.cheapest_first, places):
            names = lead.left[a].name, str(i), lead.left[b].name, str(j)
            yield kind.name, *names, relation.value, rule, "", ""


def cheapest_first(lead: ChainAdvice, seen: Predictions, structure: int) -> list[Item]:
    """The menu of a structure in the order of cost, then of masses."""
    order = lead.costs.cheapest_first
    return sorted(seen.items(structure), key=lambda i: (order.index(i.kind), i.at))


def _nearest(lead: ChainAdvice, seen: Predictions, item: Item) -> tuple[int, Step] | None:
    """The structure that an item distinguishes least from the selected one."""
    steps = [(k, seen.least(0, item, k)) for k in range(1, len(lead.left))]
    nearest = [(k, least[0]) for k, least in steps if least is not None]
    return min(nearest, key=lambda both: both[1], default=None)


def _row(lead: ChainAdvice, seen: Predictions, width: int, other: int, step: Step) -> str:
    name = lead.left[other].name
    if step.is_motion:
        return f"{name:{width}}  the sensor moves in one of the two only"
    sizes = (step.largest, step.frequency, step.noncentrality)
    reached = chance(seen.power(0, other, step))
    return f"{name:{width}}{''.join(f'{readable(size):>10}' for size in sizes)}{reached:>10}"


def _show_cheapest(lead: ChainAdvice, seen: Predictions, a: int, b: int) -> str:
    """The cheapest item that is enough at the fitted values, else the one that shows most."""
    best: tuple[float, str] | None = None
    unsure = False
    for item in cheapest_first(lead, seen, a):
        nearest = seen.least(a, item, b)
        if nearest is None:
            return "its values are not known"
        if not lead.sure(a, item, b):
            unsure = True
            continue
        reached = seen.power(a, b, nearest[0])
        text = f"{item.text} (cost {lead.costs.cost(item.kind):g}) {_size(nearest[0], reached)}"
        if reached >= POWER:
            free = lead.left[b].free > 0
            return text + ", for one of its values, the others were not looked at" * free
        if best is None or reached > best[0]:
            best = reached, text
    if best is None:
        return "no experiment on the menu surely tells them apart" if unsure else ""
    return f"no experiment on the menu has power {percent(POWER)}; the best: {best[1]}"


def _size(step: Step, reached: float) -> str:
    if step.is_motion:
        return "moves the sensor in one of the two only"
    return (
        f"shows up to {readable(step.largest)} standard deviations of a line at"
        f" {readable(step.frequency)} Hz, power {chance(reached)}"
    )


def _numbers(lead: ChainAdvice, a: int, b: int, step: Step | None) -> tuple[str, ...]:
    if step is None or lead.seen is None:
        return ("", "", "", "")
    measures = _measures(lead.seen, a, b, step).values()
    return tuple("" if x is None else repr(x) for x in measures)


def _measures(seen: Predictions, a: int, b: int, step: Step) -> dict[str, float | None]:
    """Numbers by MEASURED_COLUMNS; None but for the power where only one of the two moves."""
    sizes = step.largest, step.frequency, step.noncentrality
    columns = [None] * 3 if step.is_motion else sizes
    return dict(zip(MEASURED_COLUMNS, (*columns, seen.power(a, b, step)), strict=True))
