"""disting models: the numbered list of one size."""

import argparse
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import replace

from disting.behaviour.profile import Profile
from disting.catalogs import catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.cli.arguments import add_damped, add_work, is_damped, whole
from disting.cli.workers import engine_for
from disting.model.drawing import LEGEND, text_drawing
from disting.model.family import Family
from disting.questions.identifiability import Identifiability, Level
from disting.verdict import Engine, Progress

NOT_ASKED = "·"
MOST_LISTED = 25  # masses: 140 thousand models, in seconds
AT_ONCE = 7  # masses; 314 models take five seconds
COLUMNS = ("model", "gap", "force", "sensor", "n/m", "free", "par", "rank", "sets", "drawing")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    parser.add_argument("masses", type=whole(1, MOST_LISTED), metavar="N", help="number of masses")
    parser.add_argument(
        "--identifiability",
        action="store_true",
        help="say for each model which parameters can be determined",
    )
    text = f"say degrees and ranks of more than {AT_ONCE} masses too, which takes a minute or more"
    parser.add_argument("--ranks", action="store_true", help=text)
    add_damped(parser)
    add_work(parser)


def run(options: argparse.Namespace) -> int:
    """List the models of one size."""
    family = Family(options.masses, is_damped(options))
    with engine_for(options) as (engine, pool, progress):
        asked = options.ranks or options.identifiability or family.n_masses <= AT_ONCE
        # no dependences are shown, which are dear
        plain = Engine(replace(engine.settings, subset_limit=0), engine.store)
        profiles = plain.profiles_of(family, executor=pool, progress=progress) if asked else ()
        known = _identifiabilities(family, engine, pool, progress, options.identifiability)
    print("\n".join(_table(family, profiles, known)))
    for gap in sorted({chain.gap for chain in family}):
        parameters = next(chain.parameters for chain in family if chain.gap == gap)
        print(f"parameters, gap {gap}: {' '.join(parameters)}")
    print("force, sensor: what it acts or looks on, and against (0 the ground)")
    said = f"; {NOT_ASKED} not asked (--ranks asks)" * (not profiles)
    print("n/m degrees of (25), free non-constant coefficients, par parameters,")
    print(f"rank determinable parameters{said}")
    said = (
        "1 identifiable, ∞ not, ? not known"
        + f", {NOT_ASKED} not asked (--identifiability asks)" * (not known)
    )
    print(f"sets parameter sets, real or complex, with the same behaviour:\n     {said}")
    print(LEGEND)
    if options.identifiability:
        for number, found in enumerate(known, 1):
            print(f"A{number}: {found.sentence}")
    return 0


def _table(
    family: Family, profiles: Sequence[Profile], known: Sequence[Identifiability]
) -> Iterator[str]:
    """A line a model: its number, gap, ports, degrees, ranks and drawing; 80 columns hold five
    masses, drawings are not cut.
    """
    yield _line(COLUMNS)
    for place, chain in enumerate(family):
        _, gap, act_minus, act_plus, meas_minus, meas_plus = chain.indices
        ports = (f"{act_plus}-{act_minus}", f"{meas_plus}-{meas_minus}")
        found = _found(profiles[place]) if profiles else (NOT_ASKED,) * 4
        sets = _sets(known[place]) if known else NOT_ASKED
        yield _line((str(place + 1), str(gap), *ports, *found, sets, text_drawing(chain)))


def _line(cells: Sequence[str]) -> str:
    widths = (5, 3, 5, 6, 5, 4, 4, 4, 4, 0)
    return " ".join(f"{cell:{w}}" for cell, w in zip(cells, widths, strict=True)).rstrip()


def _found(profile: Profile) -> tuple[str, str, str, str]:
    """Degrees, non-constant coefficients, parameters, rank."""
    n, m = profile.degrees
    return f"{n}/{m}", str(len(profile.form)), str(profile.n_parameters), str(profile.rank)


def _identifiabilities(
    family: Family, engine: Engine, pool: Executor | None, progress: Progress, wanted: bool
) -> Sequence[Identifiability]:
    """From the shipped catalogue where there is one; else, as that takes a second a model,
    where it is wanted.
    """
    if family.n_masses in SHIPPED_SIZES:
        return [row.identifiability for row in catalog(family.n_masses, damped=family.damped).rows]
    return (
        engine.identifiabilities(list(family), executor=pool, progress=progress) if wanted else ()
    )


def _sets(found: Identifiability) -> str:
    """How many parameter sets have one behaviour."""
    if found.level is Level.NOT:
        return "∞"
    if found.most is None:
        return "?"
    return str(found.most) if found.least == found.most else f"{found.least}–{found.most}"
