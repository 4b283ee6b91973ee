"""The file of all pairs of two sizes: computed, written, and verified like a catalogue."""

from collections.abc import Iterator
from concurrent.futures import Executor
from itertools import combinations
from pathlib import Path

from disting.catalogs.build import step
from disting.catalogs.catalog import catalog
from disting.catalogs.files import (
    INCLUSIONS,
    SHIPPED_SIZES,
    Record,
    lines,
    shipped_folder,
    write_provenance,
)
from disting.catalogs.sizes import answers_in, combine
from disting.catalogs.sizes_files import COMMAND, SCHEMA, SizesCatalog, name_of, sizes_catalog
from disting.conditions.inclusion import inclusions_to_dict
from disting.files import write_whole
from disting.questions.inclusion.confirmation import confirms
from disting.questions.same.evidence_check import Witness
from disting.verdict.chain_side import ComparedChain
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.query import Query, View


def build_sizes(
    *,
    damped: bool,
    engine: Engine,
    folder: Path | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> str:
    """The file's text; the bytes do not depend on the machine or the order of the work.

    What the catalogues of the sizes (of a folder, or the shipped ones) say of pairs of one size is
    not computed again.
    """
    for n in SHIPPED_SIZES:
        stored = catalog(n, damped=damped, folder=folder)
        if stored.record(0)["settings"] == engine.settings.to_dict():
            for parts in answers_in(stored):
                engine.remember(*parts)
    decisions = combine(
        SHIPPED_SIZES,
        damped=damped,
        query=Query(View.EXACT),
        engine=engine,
        executor=executor,
        progress=progress,
    )
    header: Record = {
        "schema": SCHEMA,
        "catalog": name_of(damped),
        "sizes": list(SHIPPED_SIZES),
        "models": len(decisions.subjects),
        "command": COMMAND,
        "settings": engine.settings.to_dict(),
    }
    return lines([header, *_pairs(decisions)])


def write(text: str, damped: bool, folder: Path) -> Path:
    """Write the file and, last, the provenance of its folder; returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = write_whole(folder / f"{name_of(damped)}.jsonl", [text])
    write_provenance(folder)
    return path


def verify_sizes(
    *,
    damped: bool,
    folder: Path,
    engine: Engine,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> list[str]:
    """What is wrong with the file, in sentences: its bytes against those that are computed now,
    and every piece of evidence by itself.
    """
    path = folder / f"{name_of(damped)}.jsonl"
    if not path.exists() and folder.resolve() != shipped_folder().resolve():
        return []  # a folder of one's own need not have it
    stored = sizes_catalog(damped=damped, folder=folder)
    text = build_sizes(
        damped=damped, engine=engine, folder=folder, executor=executor, progress=progress
    )
    rows = lines(list(stored.records)).splitlines()
    differ = (
        f"{stored.name}.jsonl, line {number} is not what is computed now"
        for number, (a, b) in enumerate(zip(rows, text.splitlines(), strict=True), 1)
        if a != b
    )
    return [*([first] if (first := next(differ, "")) else []), *false_evidence(stored, progress)]


def false_evidence(stored: SizesCatalog, progress: Progress = silent) -> Iterator[str]:
    """Yield a sentence for each piece of evidence on two sizes that does not hold."""
    witness, chains = Witness(), stored.family
    subjects = [ComparedChain(*named) for named in zip(stored.names, chains, strict=True)]
    across = [
        (i, j)
        for i, j in combinations(range(len(chains)), 2)
        if chains[i].n_masses != chains[j].n_masses
    ]
    for done, (i, j) in enumerate(across, 1):
        v = stored.verdict(i + 1, j + 1, View.EXACT)
        where = f"{stored.name}, {v.left} and {v.right}"
        if v.evidence and not witness.confirms(v.evidence, v.representation, chains[i], chains[j]):
            yield f"{where}: the evidence of {v.rule} does not hold"
        limits = None if v.inclusions is None else v.inclusions.closure.evidence
        if limits is not None and not confirms(limits, subjects[i], subjects[j]):
            yield f"{where}: the evidence of the inclusion (limits) does not hold"
        progress("evidence", done, len(across))


def _pairs(decisions: Decisions) -> Iterator[Record]:
    """A record a pair of two sizes."""
    sizes, names = decisions.sizes, [s.name for s in decisions.subjects]
    for i, j in combinations(range(len(names)), 2):
        if sizes[i] != sizes[j]:
            both = decisions.inclusions.get((i, j))
            fields = {} if both is None else {INCLUSIONS: inclusions_to_dict(both)}
            where = decisions.verdict(i, j).representation.value
            yield {"left": names[i], "right": names[j], **fields, where: step(decisions, i, j)}
