"""Builds a catalogue: every model of a family, every pair, every representation, with evidence."""

from collections.abc import Iterator
from concurrent.futures import Executor
from pathlib import Path

from disting.catalogs.catalog import Catalog
from disting.catalogs.files import (
    INCLUSIONS,
    LEFT_POSITIVE,
    RIGHT_POSITIVE,
    SCHEMA,
    Record,
    lines,
    name_of,
    write_provenance,
)
from disting.conditions.inclusion import inclusions_to_dict
from disting.conditions.rule import Stage
from disting.files import write_whole
from disting.model.family import Family
from disting.model.question import Domain
from disting.questions.identifiability.answer import Identifiability
from disting.verdict.chain_side import ComparedChain
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.query import Query, View
from disting.verdict.result import Relation

PARTS = {"tf": View.TF, "markov": View.MARKOV, "structure": View.COMBINED, Stage.FIBRE: View.EXACT}
# what holds over positive parameters follows from the shares of both sides
PARTS |= {View.REAL.value: View.REAL}


def build(
    n_masses: int,
    *,
    damped: bool,
    engine: Engine,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Catalog:
    """The catalogue of a family, computed (profiles may come from the engine's store or the
    executor's workers).
    """
    family = Family(n_masses, damped)
    subjects = [engine.subject(f"A{number}", chain) for number, chain in enumerate(family, 1)]
    decisions = {
        part: engine.decisions(subjects, Query(view), executor=executor, progress=progress)
        for part, view in PARTS.items()
    }
    header: Record = {
        "schema": SCHEMA,
        "catalog": name_of(n_masses, damped),
        "n_masses": n_masses,
        "damped": damped,
        "sensor": family.sensor.value,
        "models": len(family),
        "markov": 4 * n_masses,
        "conditions": "1-9",
        "settings": engine.settings.to_dict(),
    }
    identifiabilities = engine.identifiabilities(list(family), executor=executor, progress=progress)
    models = (
        _model(number, s, i)
        for number, (s, i) in enumerate(zip(subjects, identifiabilities, strict=True), 1)
    )
    records = [header, *models, *_pairs(decisions)]
    return Catalog.from_records(records)


def write(catalogs: list[Catalog], folder: Path) -> list[Path]:
    """Write catalogue files and, last, their provenance; returns the paths."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / f"{c.name}.jsonl" for c in catalogs]
    for c, path in zip(catalogs, paths, strict=True):
        write_whole(path, [lines(list(c.records))])
    return [*paths, write_provenance(folder)]


def _model(number: int, subject: ComparedChain, identifiability: Identifiability) -> Record:
    profile = subject.transfer_profile
    return {
        "model": number,
        "indices": list(subject.chain.indices[1:]),
        "parameters": list(subject.chain.parameters),
        "degrees": list(profile.degrees),
        "free": len(profile.form),
        "rank": profile.rank,
        "rank_certainty": "proven" if profile.rank_proven else "bounded",
        "safety": 0 if profile.rank_proven else profile.safety,
        "identifiability": identifiability.to_dict(),
    }


def _pairs(decisions: dict[str, Decisions]) -> Iterator[Record]:
    size = len(decisions["tf"].subjects)
    for i in range(size):
        for j in range(i + 1, size):
            both = decisions[Stage.FIBRE].inclusions.get((i, j))
            fields = {} if both is None else {INCLUSIONS: inclusions_to_dict(both)}
            yield (
                {"left": i + 1, "right": j + 1}
                | fields
                | _shares(decisions[Stage.FIBRE], i, j)
                | {
                    part: step(decided, i, j)
                    for part, decided in decisions.items()
                    if decided.relation(i, j) is not Relation.UNDECIDED
                    and (part in ("tf", "markov") or _only_by(part, decided, i, j))
                }
            )


def _shares(decided: Decisions, i: int, j: int) -> Record:
    """Positive equivalents of both sides, where they are asked for."""
    sides = {LEFT_POSITIVE: decided.shares.get((i, j)), RIGHT_POSITIVE: decided.shares.get((j, i))}
    return {name: share.to_dict() for name, share in sides.items() if share is not None}


def _only_by(part: str, decided: Decisions, i: int, j: int) -> bool:
    """Whether this part decides, not an earlier one."""
    domain = decided.query.view.domain
    where = part if domain is Domain.COMPLEX else Stage.PARAMETERS
    return (i, j) in decided.steps and decided.steps[i, j].representation == where


def step(decided: Decisions, i: int, j: int) -> Record:
    """The deciding step of subjects i and j as plain data."""
    verdict = decided.verdict(i, j)
    assert verdict.evidence is not None  # only decided pairs get here
    assert verdict.certainty is not None
    # the condition's number tells the relation
    holds = verdict.representation not in (Stage.FIBRE, Stage.PARAMETERS)
    relation = {} if holds else {"relation": verdict.relation.value}
    return relation | {
        "decided_by": verdict.decided_by,
        "certainty": verdict.certainty.value,
        "safety": verdict.safety,
        "evidence": verdict.evidence.to_dict(),
    }
