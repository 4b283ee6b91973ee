"""Verifies a catalogue: its bytes against a rebuilt one, and every piece of evidence by itself."""

from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from pathlib import Path

from disting.catalogs.build import build
from disting.catalogs.catalog import Catalog, catalog
from disting.catalogs.files import lines, name_of
from disting.questions.same.evidence_check import Witness
from disting.verdict.chain_side import ComparedChain
from disting.verdict.claim_checks import false_of_inclusions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.query import View


def verify(
    n_masses: int,
    *,
    damped: bool,
    folder: Path,
    engine: Engine,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> list[str]:
    """Everything that is wrong with a catalogue file, in sentences; empty if nothing is."""
    stored = catalog(n_masses, damped=damped, folder=folder)
    rebuilt = build(n_masses, damped=damped, engine=engine, executor=executor, progress=progress)
    return [
        *_differences(stored, rebuilt, folder / f"{name_of(n_masses, damped)}.jsonl"),
        *false_evidence(stored, progress),
    ]


def false_evidence(stored: Catalog, progress: Progress = silent) -> Iterator[str]:
    """Yield a sentence for each piece of evidence that does not hold."""
    witness = Witness()
    subjects = {
        number: ComparedChain(f"A{number}", chain) for number, chain in enumerate(stored.family, 1)
    }
    total = len(stored.family) * (len(stored.family) - 1) // 2
    for done, (left, right, _) in enumerate(stored.pairs(View.EXACT), 1):
        for view in View:
            v = stored.verdict(left, right, view)
            chains = stored.family[left], stored.family[right]
            if v.evidence and not witness.confirms(v.evidence, v.representation, *chains):
                yield (
                    f"{stored.name}, {left}:{right}, {view}: the evidence of condition"
                    f" {v.decided_by} does not hold"
                )
        v, (one, other) = stored.verdict(left, right, View.EXACT), (subjects[left], subjects[right])
        for what in false_of_inclusions(v.inclusions, one, other):
            yield f"{stored.name}, {left}:{right}: {what} does not hold"
        yield from _false_shares(stored, subjects, left, right)
        progress("evidence", done, total)


def _false_shares(
    stored: Catalog, subjects: Mapping[int, ComparedChain], left: int, right: int
) -> Iterator[str]:
    """Of what is known of positive equivalents."""
    v = stored.verdict(left, right, View.EXACT)
    for found, given, other in ((v.left_positive, left, right), (v.right_positive, right, left)):
        if found is None or found.evidence is None:
            continue
        if not subjects[given].proves(subjects[other], found):
            yield (
                f"{stored.name}, {given}:{other}: the evidence on positive equivalents does not"
                " hold"
            )


def _differences(stored: Catalog, rebuilt: Catalog, path: Path) -> Iterator[str]:
    if path.read_text(encoding="utf-8") == lines(list(rebuilt.records)):
        return
    for number, (a, b) in enumerate(zip(stored.records, rebuilt.records, strict=False), 1):
        if lines([a]) != lines([b]):
            yield f"{path.name}, line {number} is not what is computed now"
            return
    yield f"{path.name} is formatted differently from what is computed now"
