"""disting next: what to measure next to tell structures apart."""

import argparse
import csv
import io
import json
from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations

from disting.catalogs import Catalog, catalog
from disting.catalogs.damper_family import DamperFamily
from disting.catalogs.damper_files import SHIPPED_SIZES as DAMPER_SIZES
from disting.catalogs.damper_files import damper_catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.catalogs.next_files import SHIPPED_SIZES as NEXT_SIZES
from disting.catalogs.next_files import WITH_DAMPERS, build_next, next_catalog, write
from disting.cli.arguments import add_damped, add_masses, add_out, add_work, is_damped
from disting.cli.output import emitted, written_file
from disting.cli.workers import engine_for
from disting.errors import InputError, listed, printable
from disting.experiments.menu import Costs, Item
from disting.model.chain import Chain
from disting.model.drawing import LEGEND, text_drawing
from disting.model.kinds import COSTS, PRICES
from disting.model.names import chains_named, name_of, read
from disting.verdict.engine import Engine
from disting.verdict.further import Further, further
from disting.verdict.further_words import (
    CSV_COLUMNS,
    anywhere,
    conclusion,
    in_words,
    rows,
    to_dict,
)
from disting.verdict.query import Query, View
from disting.verdict.result import Relation

Named = tuple[str, Chain]
DOMAIN = (
    "over complex parameters: what is told apart there is told apart over positive ones too; masses"
    " of another structure can be any, as it is not known which is which"
)

AGAIN = "with what was measured next, NEW: fit both together"
BRIEF = "menus on which nothing is surely enough are left out here; --json has them all"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    text = (
        "structures (masses:number, as 'disting models' lists them; +b2, +lag, +delay as for"
        " 'compare') that one measurement cannot tell apart; of one, all those that cannot be told"
        " from it; or a file of 'disting fit --json': the structures that the fit left"
    )
    parser.add_argument("models", nargs="+", metavar="N:I|FIT.json", help=text)
    defaults = ",".join(f"{name}={cost:g}" for name, cost in COSTS.items())
    more = " and ".join(price for price in PRICES if price not in COSTS)
    text = (
        "what the experiments cost, in any unit: a further sensor, a sensor or the force moved, a"
        f" known inertia added, a mass locked; two cost their sum (default: {defaults}); {more} are"
        " on the menu where their cost is named"
    )
    parser.add_argument("--cost", default="", metavar="LIST", help=text)
    text = "write every experiment at every pair of masses as CSV; - is standard output"
    parser.add_argument("--csv", type=written_file, metavar="FILE", help=text)
    text = "write the menu with its answers as JSON; - is standard output"
    parser.add_argument("--json", type=written_file, metavar="FILE", help=text)
    add_damped(parser)
    add_work(parser)


def run(options: argparse.Namespace) -> int:
    """Print what to measure next."""
    if options.csv == options.json == "-":
        raise InputError(
            "one of --csv and --json can be standard output, not both: name a file for the other"
        )
    costs = Costs.read(options.cost)
    if any(name.lower().endswith(".json") for name in options.models):
        return _from_fit(options, costs)
    with engine_for(options) as (engine, pool, progress):
        group = _group(options, engine)
        if isinstance(group, str):
            print(group)
            return 0
        found = _shipped(group, is_damped(options), costs) or further(
            group, engine, costs=costs, executor=pool, progress=progress
        )
    if options.csv:
        emitted(options.csv, _table([CSV_COLUMNS, *rows(found)]))
    if options.json:
        emitted(options.json, json.dumps(to_dict(found), indent=1) + "\n")
    if "-" not in (options.csv, options.json):
        print(told(found))
    return 0


def _from_fit(options: argparse.Namespace, costs: Costs) -> int:
    """Of the structures that a fit left; only here are the libraries of fits loaded."""
    from disting.cli.next_fit import onward
    from disting.report.fit.left_first import again, first_sentence
    from disting.report.fit.left_words import (
        MEASURED_COLUMNS,
        left_rows,
        left_to_dict,
        measured_in_words,
        set_in_words,
    )

    with engine_for(options) as (engine, pool, progress):
        found = onward(options, costs, engine, pool, progress)
    if options.csv:
        emitted(options.csv, _table([(*CSV_COLUMNS, *MEASURED_COLUMNS), *left_rows(found)]))
    if options.json:
        plain = left_to_dict(found) | {"first": first_sentence(found), "again": again(found)}
        text = json.dumps(plain, indent=1, ensure_ascii=False, allow_nan=False)
        emitted(options.json, text + "\n")
    if "-" not in (options.csv, options.json):
        menus = (line for group in found.groups for line in ("", *_told(group, brief=True)))
        domain = ["", DOMAIN, BRIEF] if found.groups else []
        first = [first_sentence(found), ""] if found.seen else []
        last = ["", AGAIN, f"  {again(found)}"] if again(found) else []
        lines = [
            *first,
            *set_in_words(found),
            "",
            *measured_in_words(found),
            *domain,
            *menus,
            *last,
        ]
        print(printable("\n".join(lines)))
    return 0


def told(found: Further) -> str:
    """The menu for each structure, cheapest first, with what its words mean."""
    return "\n".join(_told(found, ["", LEGEND, DOMAIN]))


def _told(found: Further, words: Sequence[str] = (), *, brief: bool = False) -> list[str]:
    """The menu of each structure; `brief`: only where something on it is surely enough."""
    width = max(map(len, found.names))
    drawings = [
        f"  {name:{width}}  {text_drawing(chain)}"
        for name, chain in zip(found.names, found.chains, strict=True)
    ]
    head = f"{len(found.names)} structures that the present force and sensor cannot tell apart:"
    enough = anywhere(found)
    told = [f"what tells all of them apart: {enough}"] if enough else []
    lines = [head, *drawings, *words, *told]
    for structure, name in enumerate(found.names):
        lines += ["", f"if it is {name}:"]
        for kind in found.kinds if found.least(structure) or not brief else ():
            cost = f"{kind.name:8} cost {found.costs.cost(kind):g}"
            for at in range(1, found.n_masses + 1):
                lines.append(f"  {cost}  mass {at}: {in_words(found, structure, Item(kind, at))}")
        lines.append(f"  {conclusion(found, structure)}")
    return lines


def add_build_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `disting catalog next`."""
    add_masses(parser, default="2 3 4 5")
    add_out(parser, "catalog")
    add_work(parser)


def build(options: argparse.Namespace) -> int:
    """Compute what to measure next for all groups of whole families, and write the files."""
    with engine_for(options) as (engine, pool, progress):
        for n in options.masses or NEXT_SIZES:
            for damped in (False, True):
                stored: list[Catalog | DamperFamily] = [catalog(n, damped=damped)]
                if n in WITH_DAMPERS:
                    stored.append(damper_catalog(n, damped=damped))
                for one in stored:
                    text = build_next(one, engine, executor=pool, progress=progress)
                    print(write(text, options.out))
    return 0


def _table(lines: Iterable[Sequence[str]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(lines)
    return text.getvalue()


def _shipped(group: list[Named], damped: bool, costs: Costs) -> Further | None:
    """The look-up of a shipped catalogue, where all structures are of it."""
    n = group[0][1].n_masses
    if any(chain.lag or chain.dead_time for _, chain in group):
        return None
    dampers = any(chain.ground_dampers for _, chain in group)
    if n not in (WITH_DAMPERS if dampers else NEXT_SIZES):
        return None
    stored = next_catalog(n, damped=damped, dampers=dampers)
    numbers = [stored.number(read(name).number, chain.ground_dampers) for name, chain in group]
    return stored.further(numbers, costs)


def _group(options: argparse.Namespace, engine: Engine) -> list[Named] | str:
    """The structures to tell apart, or the sentence that says that there is nothing to do."""
    texts = list(dict.fromkeys(options.models))
    chains = chains_named(texts, damped=is_damped(options))
    again = next((i for i, chain in enumerate(chains) if chain in chains[:i]), None)
    if again is not None:
        first = texts[chains.index(chains[again])]
        raise InputError(f"{texts[again]} and {first} are the same structure")
    names = [name_of(chain) for chain in chains]
    if len(names) == 1:
        return _all_like(names[0], is_damped(options))
    if len({chain.n_masses for chain in chains}) > 1:
        raise InputError("the structures have different numbers of masses: name some of one size")
    named = list(zip(names, chains, strict=True))
    for (left, a), (right, b) in combinations(named, 2):
        sides = engine.subject(left, a), engine.subject(right, b)
        verdict = engine.verdict(*sides, Query(View.EXACT, inclusion=False))
        if verdict.relation is Relation.DISTINGUISHABLE:
            return f"{left} and {right} are told apart by the present force and sensor already"
        if verdict.relation is Relation.UNDECIDED:
            raise InputError(f"{left} and {right} are undecided as they are measured now")
    return named


def _all_like(name: str, damped: bool) -> list[Named] | str:
    """The group of a shipped catalogue."""
    (chain,) = chains_named([name], damped=damped)
    n, dampers = chain.n_masses, bool(chain.ground_dampers)
    sizes = DAMPER_SIZES if dampers else SHIPPED_SIZES
    if n not in sizes or chain.lag or chain.dead_time:
        raise InputError(
            f"groups are known of the catalogues of {SHIPPED_SIZES[0]} to {SHIPPED_SIZES[-1]}"
            f" masses, with dampers to the ground of {DAMPER_SIZES[0]} to {DAMPER_SIZES[-1]}, not"
            f" for {listed([name])}: name all structures that are to be told apart"
        )
    groups = _damper_groups(n, damped) if dampers else _groups(n, damped)
    for members in groups:
        if chain in [other for _, other in members]:
            rest = [m for m in members if m[1] != chain]
            return [(name, chain), *rest]
    return f"{name} is told from all other structures of {n} masses by its force and sensor already"


def _groups(n: int, damped: bool) -> Iterator[list[Named]]:
    stored = catalog(n, damped=damped)
    for members in stored.classes(View.EXACT):
        yield [(f"{n}:{m}", stored.family[m]) for m in members]


def _damper_groups(n: int, damped: bool) -> Iterator[list[Named]]:
    stored = damper_catalog(n, damped=damped)
    for places in stored.found.classes():
        yield [(stored.text(i), stored.found.chains[i]) for i in places]
