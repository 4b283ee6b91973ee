"""Settles what the classes with dampers to the ground leave open, a pair of classes after the
other, each kept at once.
"""

from collections.abc import Callable
from pathlib import Path

from disting.catalogs.damper_family import DamperFamily
from disting.catalogs.damper_settled import append, read_settled
from disting.conditions.finding import Outcome
from disting.model.settings import Settings
from disting.questions.same.limited import sharing_finding
from disting.verdict.chains import ComparedChain


def settle_dampers(
    found: DamperFamily, folder: Path, settings: Settings, told: Callable[[str], None]
) -> int:
    """Ask the shares about a representative of each open pair of classes that the file does not
    settle; the number settled. `told` gets a sentence a pair.
    """
    known, count = read_settled(folder), 0
    for groups in sorted(found.found.open_groups):
        low, high = (_representative(found, group) for group in groups)
        one, other = (ComparedChain("", found.found.chains[place]) for place in (low, high))
        first, second = one.in_order(other)
        if (str(first), str(second)) in known:
            continue
        finding = sharing_finding(first, second, settings)
        told(f"{found.pair_text(low, high)}: {finding.note or 'distinguishable'}")
        if finding.outcome is not Outcome.ABANDONED:
            append(folder, first, second, finding)
            count += 1
    return count


def _representative(found: DamperFamily, group: int) -> int:
    """The place of the member of a class with the fewest dampers, as `verdict.grouping` chooses
    it.
    """
    chains = found.found.chains
    places = (place for place, g in enumerate(found.found.group) if g == group)
    return min(places, key=lambda p: (len(chains[p].ground_dampers), chains[p].indices))
