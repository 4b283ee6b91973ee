"""One function a command: one call into the library, then print. Each returns the exit status."""

import argparse
import json
import re
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from pathlib import Path

from disting import __version__
from disting.catalogs import Catalog, catalog
from disting.catalogs.combined import combined_family
from disting.catalogs.export import decisions_csv, decisions_json
from disting.catalogs.files import SHIPPED_SIZES, shipped_folder
from disting.cli.work import engine_for
from disting.comparison import compare as compare_chains
from disting.conditions.admissible import ADMISSIBLE
from disting.conditions.exact import EXACT
from disting.conditions.inclusion import Inclusion
from disting.conditions.inclusion_finding import Limit
from disting.conditions.ways import BothWays
from disting.domain import Domain
from disting.engine import Decisions, Engine, Progress, Store
from disting.errors import InputError
from disting.identifiability import Identifiability, Level
from disting.model.chain import Chain, Sensor
from disting.model.drawing import LEGEND, text_drawing
from disting.model.family import Family
from disting.proof import prove, prove_all
from disting.verdict import RULE_NAMES, Query, Verdict, View

RULES = {RULE_NAMES[EXACT]: "the exact decision", RULE_NAMES[ADMISSIBLE]: "a look at admissible parameters"}
VIEWS = {"tf": View.TF, "markov": View.MARKOV, "all": View.EXACT}


def models(options: argparse.Namespace) -> int:
    """List the models of one size."""
    from rich.console import Console
    from rich.table import Table

    family = Family(options.masses, options.damped)
    with engine_for(options) as (engine, pool, progress):
        profiles = engine.profiles_of(family, executor=pool, progress=progress)
        known = _identifiabilities(family, engine, pool, progress)
    names = ("model", "gap", "act-", "act+", "meas-", "meas+", "degree", "free", "params", "rank", "sets", "drawing")
    table = Table(*names, box=None)
    for number, (chain, profile, found) in enumerate(zip(family, profiles, known, strict=True), 1):
        n, m = profile.degrees
        numbers = (number, *chain.indices[1:], f"{n}/{m}", len(profile.form), profile.n_parameters, profile.rank)
        table.add_row(*map(str, numbers), _sets(found), text_drawing(chain).replace("[", r"\["))
    console = Console(highlight=False)
    console.width = max(console.width, 74 + 8 * family.n_masses)  # drawings are not cut, they may run over
    console.print(table)
    for gap in sorted({chain.gap for chain in family}):
        parameters = next(chain.parameters for chain in family if chain.gap == gap)
        console.print(f"parameters, gap {gap}: {' '.join(parameters)}", markup=False)
    console.print("degree n/m of (25), free = non-constant coefficients, rank = determinable parameters", markup=False)
    console.print("sets = parameter sets with the same behaviour: 1 identifiable, ∞ not, ? not known", markup=False)
    console.print(LEGEND, markup=False)
    if options.identifiability:
        for number, found in enumerate(known, 1):
            console.print(f"A{number}: {found.sentence}", markup=False, soft_wrap=True)
    return 0


def _identifiabilities(family: Family, engine: Engine, pool: Executor | None, progress: Progress) -> Sequence[Identifiability]:
    """From the shipped catalogue where there is one."""
    if family.n_masses in SHIPPED_SIZES:
        return [row.identifiability for row in catalog(family.n_masses, damped=family.damped).rows]
    return engine.identifiabilities(list(family), executor=pool, progress=progress)


def _sets(found: Identifiability) -> str:
    """How many parameter sets have one behaviour."""
    if found.level is Level.NOT:
        return "∞"
    if found.most is None:
        return "?"
    return str(found.most) if found.least == found.most else f"{found.least}–{found.most}"


def compare(options: argparse.Namespace) -> int:
    """Explain the verdict on one pair."""
    sensor = Sensor(options.sensor)
    references = [reference(text) for text in (options.left, options.right)]
    chains = [Family(n, options.damped, sensor)[number] for n, number in references]
    query = _query(options.conditions, View.EXACT, options.domain)
    verdict = _shipped(references, options.damped, query) if sensor is Sensor.ACCELERATION else None
    if verdict is None:
        with engine_for(options) as (engine, _, _progress):
            verdict = compare_chains(*chains, query=query, engine=engine)
    if options.prove:
        verdict = prove(verdict, chains[0], chains[1])
    print(json.dumps(verdict.to_dict(), indent=1, ensure_ascii=False) if options.json else _explained(verdict, chains))
    if not options.json and _tells_ways(verdict, options):
        print("\n".join(_both_ways(verdict, chains, dict(options.range))))
    return 0


def _tells_ways(verdict: Verdict, options: argparse.Namespace) -> bool:
    """Whether there is something to tell of positive equivalents that the verdict's evidence does not say."""
    if options.range or isinstance(verdict.evidence, BothWays):
        return bool(options.range)
    return options.domain == Domain.POSITIVE or verdict.inclusion in (Inclusion.LEFT_IN_RIGHT, Inclusion.RIGHT_IN_LEFT)


def _both_ways(verdict: Verdict, chains: list[Chain], limits: dict[str, tuple[str, str]]) -> Iterator[str]:
    """Which positive models of each side, within ranges if there are any, have an equivalent on the other side.

    Without ranges and over complex parameters that is told only where the verdict tells it.
    """
    from disting.positivity import positive_finding, ranges, within_ranges

    unknown = set(limits) - {name for chain in chains for name in chain.parameters}
    if unknown:
        raise InputError(f"no parameter of the two models is called {', '.join(sorted(unknown))}")
    sides = list(zip((verdict.left, verdict.right), chains, (verdict.left_positive, verdict.right_positive), strict=True))
    for (name, given, known), (other_name, other, _) in (sides, sides[::-1]):
        boxes = ({n: limits[n] for n in chain.parameters if n in limits} for chain in (given, other))
        found = within_ranges(given, other, ranges(*boxes)) if limits else known
        if found is None and verdict.domain is not Domain.POSITIVE:
            continue
        found = positive_finding(given, other) if found is None else found
        where = "within the ranges" if limits else "positive"
        why = found.evidence.sentence(name, other_name) if found.evidence else found.reason
        seen = f" ({found.empirical.sentence})" if found.empirical else ""
        yield f"{where}: {name} in {other_name} {found.share}{seen}. {why}"


def verdicts(options: argparse.Namespace) -> int:
    """Decide all pairs of one size, or of several."""
    query = _query(options.conditions, VIEWS[options.representation], options.domain, options.markov)
    named = combined_family(options.masses, damped=options.damped, sensor=Sensor(options.sensor))
    if len(options.masses) == 1:
        named = tuple((f"A{number}", chain) for number, (_, chain) in enumerate(named, 1))
    with engine_for(options) as (engine, pool, progress):
        subjects = [engine.subject(name, chain) for name, chain in named]
        decided = engine.decisions(subjects, query, executor=pool, progress=progress)
        if options.prove:
            decided = prove_all(decided, progress=progress)
    if options.csv:
        emitted(options.csv, decisions_csv(decided))
    if options.json:
        emitted(options.json, decisions_json(decided))
    if "-" not in (options.csv, options.json):
        print(_summary(decided))
    return 0


def fit(options: argparse.Namespace) -> int:
    """Fit measured data."""
    from disting.cli import fit as command  # loads what no other command needs

    return command.run(options)


def report(options: argparse.Namespace) -> int:
    """Write pages, figures and tables."""
    from disting.report.write import write_report

    if not (options.masses or options.paper):
        raise InputError("name at least one number of masses, or --paper")
    if options.paper:
        _paper(options)
    if not options.masses:
        return 0
    choices = [False, True] if options.damping == "both" else [options.damping == "damped"]
    with engine_for(options) as (engine, pool, progress):
        catalogs = [_catalog(n, damped, engine, pool, progress) for n in options.masses for damped in choices]
    paths = write_report(catalogs, options.out)
    for c in catalogs:
        print(f"{c.name}: {_counted(c.counts(View.EXACT))}, {len(c.classes(View.EXACT))} indistinguishable groups")
    print(f"{len(paths)} files in {options.out}; open {options.out / 'index.html'}")
    return 0


def _paper(options: argparse.Namespace) -> None:
    """Write the paper's figures, tables and claims."""
    from collections import Counter

    from disting.paper import CLAIMS, Findings, Outcome
    from disting.report.paper import write_paper

    with engine_for(options) as (engine, pool, progress):
        paths = write_paper(Findings(engine, pool, progress), options.out / "paper")
    counts = Counter(claim.outcome for claim in CLAIMS)
    agree, differ, unchecked = (counts[outcome] for outcome in Outcome)
    print(f"{len(CLAIMS)} claims of the paper: {agree} agree, {differ} differ, {unchecked} cannot be checked")
    print(f"{len(paths)} files in {options.out / 'paper'}; open {paths[0]}")


def build(options: argparse.Namespace) -> int:
    """Compute catalogues."""
    from disting.catalogs.build import build, write
    from disting.catalogs.settle import read_settled

    settled = read_settled(shipped_folder())
    with engine_for(options) as (engine, pool, progress):
        for n in options.masses:
            pair = [build(n, damped=d, engine=engine, settled=settled, executor=pool, progress=progress) for d in (False, True)]
            for path in write(pair, options.out)[:-1]:
                print(path)
    return 0


def candidates(options: argparse.Namespace) -> int:
    """Compute the verdicts on the candidates of a fit."""
    from disting.catalogs.candidates import matrix, write
    from disting.fit.candidates import figure_1

    with engine_for(options) as (engine, pool, progress):
        found = matrix(figure_1(), engine=engine, executor=pool, progress=progress)
    counts = ", ".join(f"{n} {relation}" for relation, n in found.counts().items())
    print(f"{write(found, options.out)}: {len(found.chains)} models, {counts}")
    return 0


def settle(options: argparse.Namespace) -> int:
    """Settle what catalogues leave open."""
    from disting.catalogs.settle import settle

    for n in options.masses:
        for damped in (False, True):
            found = catalog(n, damped=damped, folder=options.catalog)
            count = settle(found, options.catalog, options.seconds, print)
            print(f"{found.name}: {count} settled")
    return 0


def verify(options: argparse.Namespace) -> int:
    """Verify catalogues; status 1 if something is wrong."""
    from disting.catalogs.verify import verify

    wrong: list[str] = []
    with engine_for(options) as (_, pool, progress):
        for n in options.masses:
            for damped in (False, True):
                fresh = Engine()  # nothing is taken from the cache: a verification computes
                found = verify(n, damped=damped, folder=options.catalog, engine=fresh, executor=pool, progress=progress)
                what = f"{n} masses, {'damped' if damped else 'undamped'}"
                print(f"{what}: {'; '.join(found) or 'every byte and every evidence holds'}")
                wrong += found
    return 1 if wrong else 0


def cache_info(options: argparse.Namespace) -> int:
    """Say where the cache is and what it holds."""
    with Store.open(None) as store:
        info = store.info()
    print(f"path     {info.path or 'no cache'}\nentries  {info.entries}")
    print(f"size     {info.bytes} bytes\nschema   {info.schema_version}")
    return 0


def cache_clear(options: argparse.Namespace) -> int:
    """Remove all entries."""
    with Store.open(None) as store:
        print(f"{store.clear()} entries removed")
    return 0


def doctor(options: argparse.Namespace) -> int:
    """Say what works here, and what else could."""
    from importlib.metadata import version
    from importlib.util import find_spec

    from disting.ideals.programs import installed

    print(f"{'disting':14}{__version__}")
    for name in ("python-flint", "numpy"):
        print(f"{name:14}{version(name)}")
    for name, found, brings in installed():
        print(
            f"{name:14}{found or 'not found'}; optional, it would bring {brings}"
            if not found
            else f"{name:14}{found}: {brings}"
        )
    for name, brings in (("sympy", "maps as SymPy expressions"), ("distributed", "work on a cluster (--scheduler)")):
        print(f"{name:14}{version(name) if find_spec(name) else 'not found'}; optional, for {brings}")
    with Store.open(None) as store:
        print(f"{'cache':14}{store.info().path or 'off'}")
    return 0


def _query(conditions: tuple[int, ...] | None, view: View, domain: str, markov: int = 0) -> Query:
    """Conditions that are named decide alone: the exact decision belongs to the default."""
    if domain != Domain.COMPLEX:
        if conditions is not None or view is not View.EXACT:
            raise InputError(f"--domain {domain} comes after the exact decision: leave --conditions and --representation away")
        return Query(View(domain), markov=markov)
    if conditions is None:
        return Query(view, markov=markov)
    return Query(View.COMBINED if view is View.EXACT else view, conditions, markov)


def _shipped(references: list[tuple[int, int]], damped: bool, query: Query) -> Verdict | None:
    """The stored verdict of a shipped pair, if all conditions may decide."""
    (n, left), (m, right) = references
    stored = n == m in SHIPPED_SIZES and left != right and query == Query(query.view)
    return catalog(n, damped=damped).verdict(left, right, query.view) if stored else None


def _catalog(n: int, damped: bool, engine: Engine, pool: Executor | None, progress: Progress) -> Catalog:
    from disting.catalogs.build import build

    if n in SHIPPED_SIZES:
        return catalog(n, damped=damped)
    return build(n, damped=damped, engine=engine, executor=pool, progress=progress)


def _explained(verdict: Verdict, chains: list[Chain]) -> str:
    names = (verdict.left, verdict.right)
    width = max(map(len, names))
    drawings = [f"  {name:{width}}  {text_drawing(c)}" for name, c in zip(names, chains, strict=True)]
    lines = [verdict.relation.upper(), "", *drawings, "", verdict.sentence]
    if verdict.evidence:
        certainty = f"{verdict.certainty}, probability of error at most {verdict.error_bound}"
        lines += [f"evidence   {verdict.evidence.formula}", f"certainty  {certainty}"]
    lines.append(f"domain     {verdict.domain} parameters")
    return "\n".join([*lines, *_inclusion(verdict)])


def _inclusion(verdict: Verdict) -> list[str]:
    """What is said of models of unequal rank."""
    found = verdict.inclusion_finding
    if found is None:
        return []
    says = {
        Inclusion.LEFT_IN_RIGHT: f"generic {verdict.left} lie in {verdict.right}, not the reverse",
        Inclusion.RIGHT_IN_LEFT: f"generic {verdict.right} lie in {verdict.left}, not the reverse",
        Inclusion.NEITHER: "neither lies in the other",
    }.get(found.inclusion, f"not known: {found.reason}")
    why = f" ({found.certainty}): {found.evidence.sentence(verdict.left, verdict.right)}" if found.evidence else ""
    return [f"inclusion  {says}{why}"]


def _summary(decided: Decisions) -> str:
    total = len(decided.subjects) * (len(decided.subjects) - 1) // 2
    counted = f"{len(decided.subjects)} models, {total} pairs: {_counted(decided.counts())}"
    inside = sum(_is_limit(decided, i, j) for i, j in decided.inclusions)
    return counted + (f"; {inside} smaller models lie in larger ones, as limits" if inside else "")


def _is_limit(decided: Decisions, i: int, j: int) -> bool:
    """Whether the smaller model lies in the one with more masses."""
    return isinstance(decided.inclusions[i, j].evidence, Limit)


def _counted(counts: dict[str, int]) -> str:
    parts = [f"{n} by condition {number}" for number, n in counts.items() if number.isdigit()]
    parts += [f"{counts[rule]} by {text}" for rule, text in RULES.items() if counts.get(rule)]
    return ", ".join([*parts, f"{counts.get('', 0)} undecided"])


def emitted(where: str, text: str) -> None:
    """Write text to a file, or to standard output for -."""
    if where == "-":
        sys.stdout.write(text)
    else:
        Path(where).write_text(text, encoding="utf-8")


def reference(text: str) -> tuple[int, int]:
    """Size and number of a model written masses:number; raises InputError."""
    match = re.fullmatch(r"(\d{1,3}):(\d{1,6})", text)
    if not match:
        raise InputError(f"a model is written masses:number, for instance 3:4, not {text!r}")
    return int(match[1]), int(match[2])
