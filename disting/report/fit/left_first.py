"""What to measure next after a fit, in the first sentence."""

import shlex
from dataclasses import dataclass

from disting.errors import listed
from disting.experiments.menu import Item
from disting.fit.judge.exclusion import joined
from disting.fit.plan.further import Foretold
from disting.fit.plan.power import POWER
from disting.report.fit.left_words import Onward, cheapest_first
from disting.report.fit.plan_words import chance
from disting.report.fit.words import percent


@dataclass(frozen=True, slots=True)
class Reach:
    """An item of the selected structure's menu, the others that it parts from that with the power
    that is asked for, and those that are left, with the power that it has against them.
    """

    item: Item
    parted: tuple[int, ...]
    left: tuple[tuple[int, float], ...]


def again(found: Onward) -> str:
    """The command that fits what the first sentence advises together with the data of the fit, NEW
    its file; "" where the file of the fit does not tell its command.
    """
    if not found.named.command:
        return ""
    best = _best(found, found.seen, _others(found)) if found.seen else None
    what = "sensor=MASS"
    if best is not None:
        kind, size = best.item.kind, ":SIZE" if best.item.kind.takes_size else ""
        what = f"{kind.name}={best.item.at}{size}"
    given = f"--left {shlex.quote(found.source)} --experiment NEW:{what}"
    return f"{found.named.command} {given}"


def first_sentence(found: Onward) -> str:
    """The experiment that parts the selected structure from most of the others, of equals the
    cheapest, and what it leaves; "" where the lines of the data are not known.

    Structures that contain the selected one are named apart: if it is that one, no data exclude
    them. The powers are those at the fitted values, before a rival refits: upper bounds; a rival
    of which the selected structure is a limit, such as one with more masses, can follow it.
    """
    if found.seen is None:
        return ""
    selected = found.left[0]
    others = _others(found)
    larger = [k for k in range(1, len(found.left)) if k not in others]
    best = _best(found, found.seen, others)
    said = (
        f"if it is {selected.name}, no experiment on the menu has power {percent(POWER)} against"
        " another structure"
    )
    if best is not None:
        said = (
            f"measure next: {best.item.text} (cost {found.costs.cost(best.item.kind):g}); if it is"
            f" {selected.name}, that shows a difference from {_of(found, best, others)}"
        )
        left = [f"{found.left[k].name} (power {chance(power)})" for k, power in best.left]
        said += f"; not {listed(left)}" * bool(left)
    contain = listed([found.left[k].name for k in larger])
    verb = "contains" if len(larger) == 1 else "contain"
    return said + f"; {contain} {verb} it, which no data exclude" * bool(larger)


def _others(found: Onward) -> list[int]:
    """The structures that do not contain the selected one."""
    chain = found.left[0].chain
    return [k for k, o in enumerate(found.left) if k and joined(chain, o.chain) != o.chain]


def _best(found: Onward, seen: Foretold, others: list[int]) -> Reach | None:
    reaches = [_reach(found, seen, item, others) for item in cheapest_first(found, seen, 0)]
    best = max(reaches, key=lambda reach: len(reach.parted), default=None)
    return best if best and best.parted else None


def _reach(found: Onward, seen: Foretold, item: Item, others: list[int]) -> Reach:
    powers = {k: _power(found, seen, item, k) for k in others}
    parted = tuple(k for k, power in powers.items() if power >= POWER)
    return Reach(item, parted, tuple((k, p) for k, p in powers.items() if k not in parted))


def _power(found: Onward, seen: Foretold, item: Item, other: int) -> float:
    """Of parting another structure; 0 where it may be that nothing differs."""
    nearest = seen.least(0, item, other)
    if nearest is None or not found.sure(0, item, other):
        return 0.0
    return seen.power(0, other, nearest[0])


def _of(found: Onward, best: Reach, others: list[int]) -> str:
    if len(best.parted) <= 2:
        which = listed([found.left[k].name for k in best.parted])
    else:
        which = f"{len(best.parted)} of the {len(others)} others"
    return (
        f"{which} as fitted now (power {percent(POWER)} or more; less after a new fit, none where"
        f" that can come as close to {found.left[0].name} as it likes)"
    )
