"""Verifies a file of classes with dampers to the ground: its bytes against a rebuilt one, and
what was settled once.
"""

from collections.abc import Iterator
from concurrent.futures import Executor
from pathlib import Path

from disting.catalogs.damper_family import DamperFamily, damper_family
from disting.catalogs.damper_files import name_of, read, text_of, was_patient
from disting.catalogs.damper_settled import read_settled
from disting.model.symmetry import canonical
from disting.questions.same.evidence_check import Witness
from disting.verdict import Engine, Progress, Relation, silent


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
