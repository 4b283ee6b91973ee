"""Next measurement after a fit, in the first sentence."""

import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from disting.errors import enumeration
from disting.experiments.menu import Item
from disting.fit.judge.admissible import KNOWN, UNDETERMINED
from disting.fit.search.candidates import reference
from disting.fit.search.containment import contains
from disting.planning.fit_file import FitRecord
from disting.planning.next_experiment import Predictions
from disting.planning.power import POWER
from disting.report.fit.left_words import ChainAdvice, cheapest_first
from disting.report.fit.plan_words import chance, larger_in_words
from disting.report.fit.words import percent, readable


@dataclass(frozen=True, slots=True)
class Reach:
    """An item of the selected structure's menu, the others that it distinguishes from that with the
    required power, and those that remain, with the power that it has against them.
    """

    item: Item
    parted: tuple[int, ...]
    left: tuple[tuple[int, float], ...]


def repeat_command(lead: ChainAdvice) -> str:
    """The command that fits what the first sentence advises together with the data of the fit, NEW
    its file; "" where the file of the fit does not state its command, or leaves one structure.
    """
    if not lead.named.command or len(lead.left) < 2:
        return ""
    what = advised_setup(lead) or "sensor=MASS"
    text = f"--left {shlex.quote(lead.source)} --experiment NEW:{what}"
    return f"{lead.named.command} {text}"


def advised_setup(lead: ChainAdvice) -> str:
    """Setup of the experiment that the first sentence advises, as the option --experiment takes it:
    sensor=2, or inertia=1:SIZE where its size is to be named; "" where it advises none.
    """
    best = _best(lead, lead.seen, _others(lead)) if lead.seen and len(lead.left) > 1 else None
    if best is None:
        return ""
    kind, size = best.item.kind, ":SIZE" if best.item.kind.takes_size else ""
    return f"{kind.name}={best.item.at}{size}"


def first_sentence(lead: ChainAdvice) -> str:
    """The experiment that parts the selected structure from most of the others, of equals the
    cheapest, and what it leaves; "" where the lines of the data are not known.

    Structures that contain the selected one are no rivals: if it is that one, no experiment
    excludes them. The powers are those at the fitted values, before a rival refits: upper bounds.
    Where one structure is left the sentence states it, and what would narrow its worst parameter.
    """
    if len(lead.left) == 1:
        return "; ".join(_alone(lead.named, lead.source))
    if lead.seen is None:
        return ""
    selected = lead.left[0]
    others = _others(lead)
    larger = [k for k in range(1, len(lead.left)) if k not in others]
    best = _best(lead, lead.seen, others)
    sentence = (
        f"if the machine is {selected.name}, no experiment on the menu excludes another structure"
        f" with power {percent(POWER)}"
    )
    if best is not None:
        sentence = (
            f"measure next: {best.item.text} (cost {lead.costs.cost(best.item.kind):g}); if the"
            f" machine is {selected.name}, it shows a difference from {_of(lead, best, others)}"
        )
        left = [f"{lead.left[k].name} (power {chance(power)})" for k, power in best.left]
        sentence += f"; not {enumeration(left)}" if left else ""
    contain = enumeration([lead.left[k].name for k in larger])
    return sentence + (
        f"; no data exclude {contain}, which {_contain(larger)} it" if larger else ""
    )


def _alone(named: FitRecord, source: str) -> Iterator[str]:
    """Sentences that nothing is to be distinguished, what else is unknown, and the worst
    parameter.
    """
    yield (
        f"{source} leaves {reference(named.model)} alone: no further measurement is needed to"
        " distinguish structures"
    )
    yield from larger_in_words(list(named.larger), reference(named.model))
    if named.rivals:
        names = enumeration(map(reference, named.rivals))
        yield f"it is not known whether these structures behave the same: {names}"
    if named.errors:
        yield _worst(named.errors)


def _worst(errors: Mapping[str, float]) -> str:
    """The parameter that is known worst: its error falls with the root of the periods."""
    name = max(errors, key=lambda text: errors[text])
    error = errors[name]
    if not error <= UNDETERMINED:
        return (
            f"the data do not determine {name}: another sensor, another place of the force or a"
            " wider band may help"
        )
    sentence = f"{name} has the largest error, ± {percent(error)} (one standard error)"
    if error <= KNOWN:
        return sentence
    return (
        f"{sentence}: {readable((error / KNOWN) ** 2)} times as many periods, or lines in the same"
        f" range, reduce it to ± {percent(KNOWN)} as far as noise is the cause"
    )


def _contain(names: Sequence[object]) -> str:
    return "contains" if len(names) == 1 else "contain"


def _others(lead: ChainAdvice) -> list[int]:
    """The structures that do not contain the selected one."""
    chain = lead.left[0].chain
    return [k for k, o in enumerate(lead.left) if k and not contains(o.chain, chain)]


def _best(lead: ChainAdvice, seen: Predictions, others: list[int]) -> Reach | None:
    reaches = [_reach(lead, seen, item, others) for item in cheapest_first(lead, seen, 0)]
    best = max(reaches, key=lambda reach: len(reach.parted), default=None)
    return best if best and best.parted else None


def _reach(lead: ChainAdvice, seen: Predictions, item: Item, others: list[int]) -> Reach:
    powers = {k: _power(lead, seen, item, k) for k in others}
    parted = tuple(k for k, power in powers.items() if power >= POWER)
    return Reach(item, parted, tuple((k, p) for k, p in powers.items() if k not in parted))


def _power(lead: ChainAdvice, seen: Predictions, item: Item, other: int) -> float:
    """Of parting another structure; 0 where it may be that nothing differs."""
    nearest = seen.least(0, item, other)
    if nearest is None or not lead.sure(0, item, other):
        return 0.0
    return seen.power(0, other, nearest[0])


def _of(lead: ChainAdvice, best: Reach, others: list[int]) -> str:
    if len(best.parted) <= 2:
        which = enumeration([lead.left[k].name for k in best.parted])
    else:
        which = f"{len(best.parted)} of the {len(others)} others"
    return (
        f"{which} (power {percent(POWER)} or more for the values fitted now; a rival that is fitted"
        " again comes closer)"
    )
