"""Verifies a file of classes with dampers to the ground: its bytes against a rebuilt one, and
what was settled once.

Settles what the classes with dampers to the ground leave open, a pair of classes after the
other, each kept at once.
"""

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from pathlib import Path

from disting.catalogs.damper_family import DamperFamily, damper_family
from disting.catalogs.damper_files import name_of, read, text_of, was_patient
from disting.catalogs.damper_settled import append, read_settled
from disting.conditions.finding import Outcome
from disting.model.question import Settings
from disting.model.symmetry import canonical
from disting.questions.same.evidence_check import Witness
from disting.questions.same.low_cost import sharing_finding
from disting.verdict.chain_side import ComparedChain
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.result import Relation


def verify_dampers(
    n_masses: int,
    *,
    damped: bool,
    folder: Path,
    engine: Engine,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> list[str]:
    """Everything that is wrong with a file and with what was settled for it, in sentences;
    empty if nothing is.
    """
    stored, patient = read(folder, n_masses, damped), was_patient(folder, n_masses, damped)
    rebuilt = damper_family(
        n_masses,
        damped=damped,
        patient=patient,
        engine=engine,
        executor=executor,
        progress=progress,
    )
    name = name_of(n_masses, damped)
    wrong = list(false_settled(stored, folder, progress))
    if (folder / f"{name}.jsonl").read_text(encoding="utf-8") != text_of(
        rebuilt, engine.settings, patient=patient
    ):
        wrong.append(f"{name} is not what is computed now")
    return wrong


def false_settled(stored: DamperFamily, folder: Path, progress: Progress = silent) -> Iterator[str]:
    """Yield a sentence for each settled pair of the family whose evidence does not hold, or
    that the file contradicts.
    """
    place = {str(canonical(chain).chain): i for i, chain in enumerate(stored.found.chains)}
    known = {
        names: found for names, found in read_settled(folder).items() if place.keys() >= set(names)
    }
    witness = Witness()
    for done, (names, found) in enumerate(known.items(), 1):
        left, right = (place[name] for name in names)
        pair = stored.pair_text(left, right)
        chains = (canonical(stored.found.chains[i]).chain for i in (left, right))
        if found.evidence is None or not witness.confirms(found.evidence, "fibre", *chains):
            yield f"{pair}: the evidence does not hold"
        if stored.found.relation(left, right) is not Relation.DISTINGUISHABLE:
            yield f"{pair}: settled, but not in the file"
        progress("settled evidence", done, len(known))


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
