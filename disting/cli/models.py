"""disting models: the numbered list of one size, or what can be determined of a file's models, of
a family of networks, of a network.
"""

import argparse
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from textwrap import fill

from disting.behaviour.profile import Profile
from disting.catalogs import catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.catalogs.network_files import recall
from disting.catalogs.recalled_chains import recall_chains
from disting.cli.arguments import (
    DOMAINS,
    Listed,
    NetworkText,
    add_damped,
    add_notation,
    add_work,
    is_damped,
    size_list_or_text,
)
from disting.cli.model_names import in_letters
from disting.cli.verdicts import LISTS, listed_models, refuse_chain_options
from disting.cli.workers import Work, announce, engine_for
from disting.decide.identifiability import Level, ParameterIdentifiability
from disting.errors import InputError, enumeration
from disting.experiments import Experiment, MeasuredChain
from disting.experiments.identifiable import IDENTIFIABLE
from disting.general.any_model import of_network
from disting.model.chain import LEGEND, text_drawing
from disting.model.family import Family
from disting.model.kinds import EXAMPLES
from disting.model.names import damping_option
from disting.model.question import Domain
from disting.network import Network, network_of
from disting.network.families import DAMPED, KINDS, Kind
from disting.verdict.comparison import identifiability, with_unmodified
from disting.verdict.engine import Engine, Progress
from disting.verdict.identifiable import Identified, identify, identify_measured

NOT_ASKED = "·"
MOST_LISTED = 25  # masses: 140 thousand models, in seconds
MOST_TERMS = 200  # of a transfer function that is printed
AT_ONCE = 7  # masses; 314 models take five seconds
WIDTH = 78  # of help
COLUMNS = ("model", "gap", "force", "sensor", "n/m", "free", "par", "rank", "sets", "drawing")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    text = (
        f"number of masses; or a file of models, or {LISTS}, or a network such as 'R0-p(R1,C1)':"
        " which parameters of each can be determined"
    )
    metavar = "N|FILE.json|FAMILY|NETWORK"
    parser.add_argument("masses", type=size_list_or_text, metavar=metavar, help=text)
    add_damped(parser)
    parser.add_argument(
        "--identifiability",
        action="store_true",
        help="show for each model which parameters can be determined",
    )
    text = (
        f"identifiability from the models as they are and also measured like this: {EXAMPLES},"
        " one or several;"
        " may be repeated"
    )
    parser.add_argument("--also", action="append", default=[], metavar="EXPERIMENT", help=text)
    text = (
        f"show degrees and ranks for more than {AT_ONCE} masses too, which takes a minute or more"
    )
    parser.add_argument("--ranks", action="store_true", help=text)
    text = "values for which identifiability holds (default: positive, those of a machine)"
    parser.add_argument("--domain", choices=DOMAINS, default=Domain.POSITIVE.value, help=text)
    add_notation(parser)
    add_work(parser)
    rows = (f"{k.name}-{_numbers(k)}: {k.text}" for k in KINDS.values())
    lines = [fill(row, WIDTH, initial_indent="  ", subsequent_indent="    ") for row in rows]
    more = f"{DAMPED} behind a family of machines: with a damper beside every spring"
    number = "trees-4:17: number 17 of a family, in every command"
    parser.epilog = "\n".join(["families of networks:", *lines, f"  {more}", f"  {number}"])
    parser.formatter_class = argparse.RawDescriptionHelpFormatter


def _numbers(kind: Kind) -> str:
    """The numbers that a name of the kind may have."""
    return f"{kind.sizes[0]}..{kind.largest}" if kind.largest > kind.sizes[0] else f"{kind.largest}"


def run(options: argparse.Namespace) -> int:
    """List the models of one size, or of a file; or describe a network."""
    if isinstance(options.masses, NetworkText):
        return _of_network(network_of(options.masses, options.notation), options)
    if isinstance(options.masses, Listed):
        return _of_list(options.masses, options)
    if options.masses > MOST_LISTED:
        raise InputError(f"models of at most {MOST_LISTED} masses are listed")
    family, domain = Family(options.masses, is_damped(options)), Domain(options.domain)
    also = with_unmodified(options.also)[1:]
    if also or (options.identifiability and family.n_masses not in SHIPPED_SIZES):
        work = Work.UNDER_EXPERIMENTS if also else Work.IDENTIFIABILITY
        announce(work, {family.n_masses: len(family) * max(1, len(also))}, options.jobs)
    with engine_for(options) as (engine, pool, progress):
        wanted = (
            bool(also) or options.ranks or options.identifiability or family.n_masses <= AT_ONCE
        )
        # no dependences are shown, which are dear
        plain = Engine(replace(engine.settings, subset_limit=0), engine.store)
        profiles = plain.profiles_of(family, executor=pool, progress=progress) if wanted else ()
        identifiabilities: Sequence[Identified] = ()
        if also:
            identifiabilities = _under_experiments(family, also, domain, engine, pool, progress)
        elif options.identifiability or family.n_masses in SHIPPED_SIZES:
            if family.n_masses in SHIPPED_SIZES:
                recall_chains(catalog(family.n_masses, damped=family.damped), engine)
            identifiabilities = identify(
                list(family), domain, engine, executor=pool, progress=progress
            )
    print("\n".join(_table(family, profiles, identifiabilities)))
    for gap in sorted({chain.gap for chain in family}):
        parameters = next(chain.parameters for chain in family if chain.gap == gap)
        print(f"parameters, gap {gap}: {' '.join(parameters)}")
    _explain(bool(profiles), bool(identifiabilities), bool(also), domain)
    print(LEGEND)
    for number, experiment in enumerate([Experiment(), *also], 1) if also else ():
        print(f"experiment {number}  {experiment.text}")
    if options.identifiability or also:
        for number, identifiability in enumerate(identifiabilities, 1):
            print(f"A{number}: {identifiability.sentence}")
    return 0


def _explain(has_profiles: bool, has_sets: bool, several: bool, domain: Domain) -> None:
    """Print the meaning of the columns."""
    print("force, sensor: mass where it acts or measures, and its reference (0 the ground)")
    note = "" if has_profiles else f"; {NOT_ASKED} not computed (--ranks)"
    print("n/m degrees of (25), free non-constant coefficients, par parameters,")
    print(f"rank determinable parameters{note}")
    note = "1 identifiable, ∞ not, ? not known" + (
        "" if has_sets else f", {NOT_ASKED} not computed (--identifiability)"
    )
    where = " in all experiments" if several else ""
    print(f"sets {domain} parameter sets with the same behaviour{where}:\n     {note}")


def _of_list(source: Listed, options: argparse.Namespace) -> int:
    """Tell what can be determined of the models of a list."""
    if options.also:
        raise InputError(
            "--also is supported for chains only: a model of a list has no masses to name"
        )
    refuse_chain_options(options)
    models = listed_models(source)
    with engine_for(options) as (engine, pool, progress):
        if isinstance(source, str):
            recall(source, engine)
        domain = Domain(options.domain)
        found = identify(list(models), domain, engine, executor=pool, progress=progress)
    for model, identified in zip(models, found, strict=True):
        print(f"{model.name}: {identified.sentence}")
    return 0


def _of_network(network: Network, options: argparse.Namespace) -> int:
    """Tell the transfer function of a network, what does not enter, what can be determined."""
    if options.damped is not None:
        raise InputError(
            f"{damping_option(options.damped)} is supported for numbered chains only: the text"
            f" of a network has its dampers"
        )
    model, experiments = of_network(network), with_unmodified(options.also)
    with engine_for(options) as (engine, _, _progress):
        identified = identifiability(model, also=options.also, domain=options.domain, engine=engine)
    print(f"{model.name}  {in_letters(model, MOST_TERMS, '')}")
    if network.unseen:
        print(
            "without effect on the response, as no path leads through it:"
            f" {enumeration(network.unseen)}"
        )
    for number, experiment in enumerate(experiments, 1):
        print(f"experiment {number}  {experiment.text}")
    print(identified.sentence)
    return 0


def _table(
    family: Family, profiles: Sequence[Profile], identifiabilities: Sequence[Identified]
) -> Iterator[str]:
    """A line a model: its number, gap, ports, degrees, ranks and drawing; 80 columns hold five
    masses, drawings are not cut.
    """
    yield _line(COLUMNS)
    for place, chain in enumerate(family):
        _, gap, act_minus, act_plus, meas_minus, meas_plus = chain.indices
        ports = (f"{act_plus}-{act_minus}", f"{meas_plus}-{meas_minus}")
        cells = _summarise(profiles[place]) if profiles else (NOT_ASKED,) * 3
        rank = (
            str(identifiabilities[place].rank if identifiabilities else profiles[place].rank)
            if profiles
            else NOT_ASKED
        )
        sets = _sets(identifiabilities[place]) if identifiabilities else NOT_ASKED
        yield _line((str(place + 1), str(gap), *ports, *cells, rank, sets, text_drawing(chain)))


def _line(cells: Sequence[str]) -> str:
    widths = (5, 3, 5, 6, 5, 4, 4, 4, 4, 0)
    return " ".join(f"{cell:{w}}" for cell, w in zip(cells, widths, strict=True)).rstrip()


def _summarise(profile: Profile) -> tuple[str, str, str]:
    """Degrees, non-constant coefficients, parameters."""
    n, m = profile.degrees
    return f"{n}/{m}", str(len(profile.form)), str(profile.n_parameters)


def _under_experiments(
    family: Family,
    also: Sequence[Experiment],
    domain: Domain,
    engine: Engine,
    pool: Executor | None,
    progress: Progress,
) -> list[ParameterIdentifiability]:
    """Parameters that the chains as given and these experiments determine together."""
    experiments = tuple(dict.fromkeys([Experiment(), *also]))
    machines = [MeasuredChain(chain, experiments) for chain in family]
    engine.answer_all(IDENTIFIABLE, [(m,) for m in machines], executor=pool, progress=progress)
    return [identify_measured(measured, domain, engine) for measured in machines]


def _sets(found: Identified) -> str:
    """Number of parameter sets with the same behaviour: the numbers found at random values, where
    they are known to depend on the values.
    """
    if found.level is Level.NOT:
        return "∞"
    if found.least == found.most:
        return str(found.most)
    if found.most is None:
        return "?"
    low, high = (found.sampled[0], found.sampled[-1]) if found.varies else (found.least, found.most)
    return f"{low}–{high}"
