"""Builds catalogues: every model of a family, every pair, every representation, with evidence.
And verifies them: their bytes against rebuilt ones, and every piece of evidence by itself;
settles what the classes with dampers to the ground leave open, a pair of classes after the other,
each kept at once.
"""

import json
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path

from disting.catalogs import network_files
from disting.catalogs.catalog import Catalog, catalog
from disting.catalogs.dampers import DamperFamily, damper_family, read, text_of
from disting.catalogs.files import (
    INCLUSIONS,
    LEFT_POSITIVE,
    RIGHT_POSITIVE,
    SCHEMA,
    Record,
    append,
    damper_name,
    lines,
    name_of,
    read_findings,
    write_provenance,
)
from disting.conditions.chain_view import ChainSide, ChainView
from disting.conditions.inclusion import inclusions_to_dict
from disting.conditions.rule import Finding, Outcome, Stage
from disting.conditions.side import AnySide, Side
from disting.decide import asking
from disting.decide.identifiability.answer import Identifiability
from disting.decide.same.evidence_check import Witness, finding_holds
from disting.decide.same.low_cost import patient_finding
from disting.errors import CatalogError
from disting.evidence.general import without_digits
from disting.evidence.kinds import evidence_from
from disting.fibres.ideals.membership import OUT_OF_TIME
from disting.files import write_whole
from disting.general.replacement import replaceable
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.question import Domain, Settings
from disting.model.symmetry import canonical
from disting.network.families import NetworkFamily
from disting.verdict.claim_checks import false_of_inclusions
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, map_tasks, silent
from disting.verdict.forest import Forest
from disting.verdict.result import Query, Relation, View

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
        "sensor": family.quantity.value,
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


def _model(number: int, subject: ChainSide, identifiability: Identifiability) -> Record:
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
    """Positive equivalents of both sides, where they are requested."""
    sides = {LEFT_POSITIVE: decided.shares.get((i, j)), RIGHT_POSITIVE: decided.shares.get((j, i))}
    return {name: share.to_dict() for name, share in sides.items() if share is not None}


def _only_by(part: str, decided: Decisions, i: int, j: int) -> bool:
    """Return True if this part decides the pair and no earlier part does."""
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


Places = tuple[int, int]
DECIDES = {
    Outcome.HOLDS: Relation.INDISTINGUISHABLE,
    Outcome.FAILS: Relation.DISTINGUISHABLE,
}


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
        number: Side(f"A{number}", ChainView(chain))
        for number, chain in enumerate(stored.family, 1)
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
        v, (side, other) = (
            stored.verdict(left, right, View.EXACT),
            (subjects[left], subjects[right]),
        )
        for what in false_of_inclusions(v.inclusions, side, other):
            yield f"{stored.name}, {left}:{right}: {what} does not hold"
        yield from _false_shares(stored, subjects, left, right)
        progress("evidence", done, total)


def _false_shares(
    stored: Catalog, subjects: Mapping[int, ChainSide], left: int, right: int
) -> Iterator[str]:
    """Of what is known of positive equivalents."""
    v = stored.verdict(left, right, View.EXACT)
    for finding, number, other in ((v.left_positive, left, right), (v.right_positive, right, left)):
        if finding is None or finding.evidence is None:
            continue
        if not asking.confirms_share(subjects[number], subjects[other], finding):
            yield (
                f"{stored.name}, {number}:{other}: the evidence on positive equivalents does not"
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
    stored = read(folder, n_masses, damped)
    rebuilt = damper_family(
        n_masses,
        damped=damped,
        folder=folder,
        engine=engine,
        executor=executor,
        progress=progress,
    )
    name = damper_name(n_masses, damped)
    wrong = list(false_findings(stored, folder, engine.settings, executor, progress))
    other_name = (folder / f"{name}.jsonl").read_text(encoding="utf-8")
    if other_name != text_of(rebuilt, engine.settings):
        wrong.append(f"{name} is not what is computed now")
    return wrong


def false_findings(
    stored: DamperFamily,
    folder: Path,
    settings: Settings,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Iterator[str]:
    """Yield a sentence for each settled pair of the family whose evidence does not hold, or
    that the file contradicts.
    """
    classes = stored.found
    place = {canonical(chain).chain: i for i, chain in enumerate(classes.chains)}
    findings = read_findings(place, folder)
    tasks = [(finding, *pair, settings) for pair, finding in findings.items()]
    for done, ((finding, *chains, _), is_true) in enumerate(
        map_tasks(finding_holds, tasks, executor), 1
    ):
        left, right = (place[chain] for chain in chains)
        pair = stored.pair_text(left, right)
        if not is_true or classes.rank[left] != classes.rank[right]:
            yield f"{pair}: the evidence does not hold"
        if classes.relation(left, right) is not DECIDES.get(finding.outcome):
            yield f"{pair}: settled, but not in the file"
        progress("settled evidence", done, len(tasks))


@dataclass(frozen=True, slots=True)
class FamilyCheck:
    """Faults of the file of a family, in sentences; the number of pairs that were not searched
    again; the number of networks whose identifiability was not found in time now.
    """

    wrong: tuple[str, ...]
    not_searched: int
    late: int


def verify_networks(
    family: NetworkFamily,
    folder: Path,
    engine: Engine,
    *,
    search_open: bool = False,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> FamilyCheck:
    """Check the file of a family: its bytes are compared with those computed now, and every piece
    of evidence on a pair is checked by itself, at fresh points. Pairs that a brief search had left
    open are not searched again, but with `search_open`, which takes most of the time of a large
    family and proves nothing where the searches end as before.

    Digits of rounded equivalents are checked with the evidence (see `without_digits`).
    """
    path = folder / f"{network_files.name_of(family.name)}.jsonl"
    if not path.is_file():
        raise CatalogError(
            f"there is no {path}; make it with '{network_files.COMMAND} {family.name}'"
        )
    stored = network_files.read(path)
    wrong = _false_of_networks(family, stored, engine)
    left = 0 if search_open else network_files.recall_open(family, stored, engine)
    text = network_files.build_networks(family, engine, executor=executor, progress=progress)
    rows, now = path.read_text(encoding="utf-8").splitlines(), text.splitlines()
    late = 0
    for number, (a, b) in enumerate(zip(rows, now, strict=False), 1):
        if without_digits(a) == without_digits(b):
            continue
        if not _ran_out_of_time(b):
            wrong.append(f"{path.name}, line {number} is not what is computed now")
            break
        late += 1
    others = [f"{path.name} has other pairs"] if len(rows) != len(now) else []
    return FamilyCheck((*wrong, *others), left, late)


def _ran_out_of_time(line: str) -> bool:
    """Return True for the line of a network whose identifiability was not found in time now: on a
    busy machine that shows nothing about the line of the file.
    """
    found = json.loads(line).get("identifiability", {})
    return OUT_OF_TIME in found.get("reason", "")


def _false_of_networks(family: NetworkFamily, records: list[Record], engine: Engine) -> list[str]:
    sides = engine.general_subjects(family.networks)
    wrong = []
    for r in records[1 + len(sides) :]:
        left, right = sides[r["left"] - 1], sides[r["right"] - 1]
        a, b = left.chain, right.chain
        doors: list[tuple[AnySide, AnySide]] = [(left, right)]
        if a is not None and b is not None:  # a theorem on chains, or one on networks
            doors.insert(0, (engine.subject(left.name, a), engine.subject(right.name, b)))
        origin = r.get("as")
        if origin and not all(
            replaceable(s.subject, sides[at - 1].subject)
            for s, at in zip((left, right), origin, strict=True)
        ):
            wrong.append(f"{left.name} and {right.name}: not the same as {origin}")
        for verdict in (r["complex"],) if origin else (r["complex"], r["positive"]):
            data = verdict.get("evidence")
            evidence = evidence_from(data) if data else None
            if "evidence" not in verdict:
                evidence = r["finding"].evidence
            if evidence and not any(
                asking.confirms(*door, evidence, verdict["representation"]) for door in doors
            ):
                wrong.append(f"{left.name} and {right.name}: the evidence does not hold")
    return wrong


def settle_dampers(
    family: DamperFamily, folder: Path, settings: Settings, announce: Callable[[str], None]
) -> int:
    """Ask shares and ideals about a representative of each open pair of classes that nothing
    settled; the number settled. `announce` gets a sentence a pair.
    """
    chains = family.found.chains
    findings, count = read_findings({canonical(chain).chain for chain in chains}, folder), 0
    for low, high in _open(family, findings):
        side, other = (Side("", ChainView(chains[place])) for place in (low, high))
        first, second = side.view.pair(other.view)
        finding = patient_finding(first, second, settings)
        decided = DECIDES.get(finding.outcome)
        announce(f"{family.pair_text(low, high)}: {decided or finding.note}")
        if decided:
            append(folder, first, second, finding)
            findings[first, second] = finding
            count += 1
    return count


def _open(
    family: DamperFamily, findings: Mapping[tuple[Chain, Chain], Finding]
) -> Iterator[Places]:
    """Yield representatives of each pair of classes that is open and does not follow from what is
    known, which may grow meanwhile.
    """
    classes = family.found
    group = {canonical(c).chain: int(g) for c, g in zip(classes.chains, classes.group, strict=True)}
    for group_number, other in sorted(classes.open_groups):
        links = [(group[a], group[b], x.outcome) for (a, b), x in findings.items()]
        same = Forest.of(1 + max(group.values()))
        for a, b, outcome in links:
            if outcome is Outcome.HOLDS:
                same.unite(a, b)
        root = same.root
        apart = [{root(a), root(b)} for a, b, outcome in links if outcome is Outcome.FAILS]
        if root(group_number) != root(other) and {root(group_number), root(other)} not in apart:
            yield _representative(family, group_number), _representative(family, other)


def _representative(family: DamperFamily, group: int) -> int:
    """The place of the member of a class with the fewest dampers, as `verdict.class_search` chooses
    it.
    """
    chains = family.found.chains
    places = (place for place, g in enumerate(family.found.group) if g == group)
    return min(places, key=lambda p: (len(chains[p].ground_dampers), chains[p].indices))
