"""disting next: what to measure next to distinguish structures."""

import argparse
import csv
import io
from collections.abc import Iterable, Iterator, Sequence

from disting.catalogs import catalog
from disting.catalogs.dampers import SHIPPED_SIZES as DAMPER_SIZES, damper_catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.catalogs.next_files import SHIPPED_SIZES as NEXT_SIZES, WITH_DAMPERS, next_catalog
from disting.cli.arguments import (
    FILE,
    add_damped,
    add_notation,
    add_work,
    is_damped,
)
from disting.cli.model_names import is_network, structures
from disting.cli.output import complain, emit, written_file
from disting.cli.workers import engine_for
from disting.errors import InputError, enumeration, printable
from disting.experiments.menu import Costs
from disting.files import json_text
from disting.model.chain import Chain
from disting.model.kinds import COSTS, PRICES
from disting.model.names import name_of, read, read_together
from disting.network.network import Network
from disting.verdict.engine import Engine
from disting.verdict.menu_text import menu_text
from disting.verdict.next_experiments import (
    Distinguishable,
    Menu,
    menu_for,
    refuse_distinguishable,
    sides_as_measured,
)
from disting.verdict.next_words import (
    CSV_COLUMNS,
    AnyMenu,
    rows,
    to_dict,
)
from disting.verdict.result import View

Named = tuple[str, Chain]
Table = Iterable[Sequence[str]]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    text = (
        "structures (masses:number, as 'disting models' lists them; +b2, +lag, +delay as for"
        " 'compare') that one measurement cannot distinguish; for a single one, all those that"
        " cannot be distinguished from it; or networks, such as 'R0-p(R1,C1)' or FILE.json:NAME; or"
        " a file of 'disting fit --json': the structures that the fit left"
    )
    parser.add_argument("models", nargs="+", metavar="N:I|NETWORK|FIT.json", help=text)
    add_damped(parser)
    defaults = ",".join(f"{name}={cost:g}" for name, cost in COSTS.items())
    more = " and ".join(price for price in PRICES if price not in COSTS)
    text = (
        "costs of the experiments, in any unit: a further sensor, a sensor or the force moved, a"
        " known inertia added, a mass locked; two experiments cost their sum (default:"
        f" {defaults}); {more} are on the menu if their cost is given"
    )
    parser.add_argument("--cost", default="", metavar="LIST", help=text)
    text = "write every experiment at every pair of masses as CSV; - is standard output"
    parser.add_argument("--csv", type=written_file, metavar="FILE", help=text)
    text = "write the menu with its answers as JSON; - is standard output"
    parser.add_argument("--json", type=written_file, metavar="FILE", help=text)
    add_notation(parser)
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
    if options.notation or any(FILE in m or is_network(m) for m in options.models):
        return _networks(options, costs)
    with engine_for(options) as (engine, pool, progress):
        group = _group(options, engine)
        if isinstance(group, str):
            print(group)
            return 0
        advice = _look_up(group, is_damped(options), costs) or menu_for(
            group, engine, costs=costs, executor=pool, progress=progress
        )
    return _write_result(
        options,
        _of_all([advice]),
        json_text(to_dict(advice), indent=1),
        menu_text(advice),
    )


def _networks(options: argparse.Namespace, costs: Costs) -> int:
    """Of networks in a notation."""
    named = structures([*dict.fromkeys(options.models)], options)
    networks = [network for network in named if isinstance(network, Network)]
    if len(networks) < 2:
        raise InputError(
            f"{enumeration(options.models)} is one network: name all that are to be"
            " distinguished; 'disting equivalents .. --family ..' finds those with the same"
            " response"
        )
    names = [network.name for network in networks]
    group = list(zip(names, networks, strict=True))
    with engine_for(options) as (engine, pool, progress):
        try:
            refuse_distinguishable(sides_as_measured(group, engine), engine)
        except Distinguishable as answer:
            print(answer)
            return 0
        advice = menu_for(group, engine, costs=costs, executor=pool, progress=progress)
    return _write_result(
        options,
        _of_all([advice]),
        json_text(to_dict(advice), indent=1),
        menu_text(advice),
    )


def _write_result(options: argparse.Namespace, lines: Table, plain: str, text: str) -> int:
    """The table, the JSON and the text, each where it is requested."""
    if options.csv:
        emit(options.csv, _table(lines))
    if options.json:
        emit(options.json, plain + "\n")
    if "-" not in (options.csv, options.json):
        print(printable(text))
    return 0


def _of_all(all_advice: Iterable[AnyMenu]) -> Table:
    """Every experiment at every pair of places."""
    return [
        CSV_COLUMNS,
        *(row for advice in all_advice for row in rows(advice)),
    ]


def _from_fit(options: argparse.Namespace, costs: Costs) -> int:
    """Of the structures that a fit left; only here are the libraries of fits loaded."""
    from disting.report.fit.next_of_fit import advise_fit

    source = _source(options)
    with engine_for(options) as (engine, pool, progress):
        advice = advise_fit(source, costs, engine, pool, progress)
    for warning in advice.warnings:
        complain(warning)
    written = json_text(advice.to_dict(), indent=1)
    return _write_result(options, advice.table(), written, advice.text)


def _source(options: argparse.Namespace) -> str:
    """The file; raises InputError for arguments in addition to it."""
    source = next(name for name in options.models if name.lower().endswith(".json"))
    if len(options.models) > 1 or options.damped is not None:
        raise InputError(
            f"{source} names its structures itself: remove other names and --damped or --undamped"
        )
    return str(source)


def _table(lines: Iterable[Sequence[str]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(lines)
    return text.getvalue()


def _look_up(group: list[Named], damped: bool, costs: Costs) -> Menu[Chain] | None:
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
    """The structures to distinguish, or the sentence that says that there is nothing to do."""
    texts = list(dict.fromkeys(options.models))
    chains = read_together(texts, damped=is_damped(options))
    again = next((i for i, chain in enumerate(chains) if chain in chains[:i]), None)
    if again is not None:
        first = texts[chains.index(chains[again])]
        raise InputError(f"{texts[again]} and {first} are the same structure")
    names = [name_of(chain) for chain in chains]
    if len(names) == 1:
        return _all_like(names[0], is_damped(options))
    named = list(zip(names, chains, strict=True))
    try:
        refuse_distinguishable(sides_as_measured(named, engine), engine)
    except Distinguishable as answer:
        return str(answer)
    return named


def _all_like(name: str, damped: bool) -> list[Named] | str:
    """The group of a shipped catalogue."""
    (chain,) = read_together([name], damped=damped)
    n, dampers = chain.n_masses, bool(chain.ground_dampers)
    sizes = DAMPER_SIZES if dampers else SHIPPED_SIZES
    if n not in sizes or chain.lag or chain.dead_time:
        raise InputError(
            f"groups are known of the catalogues of {SHIPPED_SIZES[0]} to {SHIPPED_SIZES[-1]}"
            f" masses, with dampers to the ground of {DAMPER_SIZES[0]} to {DAMPER_SIZES[-1]}, not"
            f" for {enumeration([name])}: name all structures that are to be distinguished"
        )
    groups = _damper_groups(n, damped) if dampers else _groups(n, damped)
    for members in groups:
        if chain in [other for _, other in members]:
            rest = [m for m in members if m[1] != chain]
            return [(name, chain), *rest]
    return (
        f"{name} is distinguishable from all other structures of {n} masses with its force"
        " and sensor already"
    )


def _groups(n: int, damped: bool) -> Iterator[list[Named]]:
    stored = catalog(n, damped=damped)
    for members in stored.classes(View.EXACT):
        yield [(f"{n}:{m}", stored.family[m]) for m in members]


def _damper_groups(n: int, damped: bool) -> Iterator[list[Named]]:
    stored = damper_catalog(n, damped=damped)
    for places in stored.found.classes():
        yield [(stored.text(i), stored.found.chains[i]) for i in places]
