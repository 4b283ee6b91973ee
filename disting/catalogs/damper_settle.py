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
    settle; the number settled.
    """
    known, count = read_settled(folder), 0
    for low, high in sorted(found.found.open_groups):
        first, second = _representative(found, low).in_order(_representative(found, high))
        if (str(first), str(second)) in known:
            continue
        finding = sharing_finding(first, second, settings)
        told(f"{first} and {second}: {finding.note or finding.outcome}")
        if finding.outcome is not Outcome.ABANDONED:
            append(folder, first, second, finding)
            count += 1
    return count


def _representative(found: DamperFamily, group: int) -> ComparedChain:
    """The member of a class with the fewest dampers, as `verdict.grouping` chooses it."""
    members = (c for c, g in zip(found.found.chains, found.found.group, strict=True) if g == group)
    return ComparedChain("", min(members, key=lambda c: (len(c.ground_dampers), c.indices)))
