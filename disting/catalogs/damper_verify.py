"""Verifies a file of classes with dampers to the ground: its bytes against a rebuilt one, and
what was settled once by its evidence.

Settles what the classes with dampers to the ground leave open, a pair of classes after the
other, each kept at once.
"""

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from pathlib import Path

from disting.catalogs.damper_family import DamperFamily, damper_family
from disting.catalogs.damper_files import name_of, read, text_of
from disting.catalogs.damper_settled import append, holds, read_settled
from disting.conditions.rule import Finding, Outcome
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.model.symmetry import canonical
from disting.questions.same.low_cost import patient_finding
from disting.verdict.buckets import Forest
from disting.verdict.chain_side import ComparedChain
from disting.verdict.engine import Engine, Progress, mapped, silent
from disting.verdict.result import Relation

Places = tuple[int, int]
DECIDES = {
    Outcome.HOLDS: Relation.INDISTINGUISHABLE,
    Outcome.FAILS: Relation.DISTINGUISHABLE,
}


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
    name = name_of(n_masses, damped)
    wrong = list(false_settled(stored, folder, engine.settings, executor, progress))
    there = (folder / f"{name}.jsonl").read_text(encoding="utf-8")
    if there != text_of(rebuilt, engine.settings):
        wrong.append(f"{name} is not what is computed now")
    return wrong


def false_settled(
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
    known = read_settled(place, folder)
    asked = [(found, *pair, settings) for pair, found in known.items()]
    for done, ((found, *chains, _), is_true) in enumerate(mapped(holds, asked, executor), 1):
        left, right = (place[chain] for chain in chains)
        pair = stored.pair_text(left, right)
        if not is_true or classes.rank[left] != classes.rank[right]:
            yield f"{pair}: the evidence does not hold"
        if classes.relation(left, right) is not DECIDES.get(found.outcome):
            yield f"{pair}: settled, but not in the file"
        progress("settled evidence", done, len(asked))


def settle_dampers(
    found: DamperFamily, folder: Path, settings: Settings, told: Callable[[str], None]
) -> int:
    """Ask shares and ideals about a representative of each open pair of classes that nothing
    settled; the number settled. `told` gets a sentence a pair.
    """
    chains = found.found.chains
    known, count = read_settled({canonical(chain).chain for chain in chains}, folder), 0
    for low, high in _open(found, known):
        one, other = (ComparedChain("", chains[place]) for place in (low, high))
        first, second = one.in_order(other)
        finding = patient_finding(first, second, settings)
        decided = DECIDES.get(finding.outcome)
        told(f"{found.pair_text(low, high)}: {decided or finding.note}")
        if decided:
            append(folder, first, second, finding)
            known[first, second] = finding
            count += 1
    return count


def _open(found: DamperFamily, known: Mapping[tuple[Chain, Chain], Finding]) -> Iterator[Places]:
    """Yield representatives of each pair of classes that is open and does not follow from what is
    known, which may grow meanwhile.
    """
    classes = found.found
    group = {canonical(c).chain: int(g) for c, g in zip(classes.chains, classes.group, strict=True)}
    for one, other in sorted(classes.open_groups):
        links = [(group[a], group[b], x.outcome) for (a, b), x in known.items()]
        same = Forest.of(1 + max(group.values()))
        for a, b, outcome in links:
            if outcome is Outcome.HOLDS:
                same.unite(a, b)
        root = same.root
        apart = [{root(a), root(b)} for a, b, outcome in links if outcome is Outcome.FAILS]
        if root(one) != root(other) and {root(one), root(other)} not in apart:
            yield _representative(found, one), _representative(found, other)


def _representative(found: DamperFamily, group: int) -> int:
    """The place of the member of a class with the fewest dampers, as `verdict.grouping` chooses
    it.
    """
    chains = found.found.chains
    places = (place for place, g in enumerate(found.found.group) if g == group)
    return min(places, key=lambda p: (len(chains[p].ground_dampers), chains[p].indices))
