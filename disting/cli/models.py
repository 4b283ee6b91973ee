"""disting models: the numbered list of one size."""

import argparse
from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import replace

from disting.behaviour.profile import Profile
from disting.catalogs import catalog
from disting.catalogs.files import SHIPPED_SIZES
from disting.cli.arguments import MASSES, add_damped, add_work, is_damped
from disting.cli.workers import engine_for
from disting.model.drawing import LEGEND, text_drawing
from disting.model.family import Family
from disting.questions.identifiability import Identifiability, Level
from disting.verdict import Engine, Progress

NOT_ASKED = "·"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    parser.add_argument("masses", type=MASSES, metavar="N", help="number of masses")
    parser.add_argument(
        "--identifiability",
        action="store_true",
        help="say for each model which parameters can be determined",
    )
    add_damped(parser)
    add_work(parser)


def run(options: argparse.Namespace) -> int:
    """List the models of one size."""
    family = Family(options.masses, is_damped(options))
    with engine_for(options) as (engine, pool, progress):
        # no dependences are shown, which are dear
        plain = Engine(replace(engine.settings, subset_limit=0), engine.store)
        profiles = plain.profiles_of(family, executor=pool, progress=progress)
        known = _identifiabilities(family, engine, pool, progress, options.identifiability)
    print(_table(family, profiles, known), end="")
    for gap in sorted({chain.gap for chain in family}):
        parameters = next(chain.parameters for chain in family if chain.gap == gap)
        print(f"parameters, gap {gap}: {' '.join(parameters)}")
    print("degree n/m of (25), free = non-constant coefficients, rank = determinable parameters")
    said = (
        "1 identifiable, ∞ not, ? not known"
        + f", {NOT_ASKED} not asked (--identifiability asks)" * (not known)
    )
    print(f"sets = parameter sets, real or complex, with the same behaviour: {said}")
    print(LEGEND)
    if options.identifiability:
        for number, found in enumerate(known, 1):
            print(f"A{number}: {found.sentence}")
    return 0


def _table(family: Family, profiles: Sequence[Profile], known: Sequence[Identifiability]) -> str:
    """A line a model: its number, indices, degrees, ranks and drawing."""
    from rich.console import Console
    from rich.table import Table

    names = (
        "model",
        "gap",
        "act-",
        "act+",
        "meas-",
        "meas+",
        "degree",
        "free",
        "params",
        "rank",
        "sets",
        "drawing",
    )
    table = Table(*names, box=None)
    sets = [_sets(found) for found in known] or [NOT_ASKED] * len(family)
    for number, (chain, profile, count) in enumerate(zip(family, profiles, sets, strict=True), 1):
        n, m = profile.degrees
        numbers = (
            number,
            *chain.indices[1:],
            f"{n}/{m}",
            len(profile.form),
            profile.n_parameters,
            profile.rank,
        )
        table.add_row(*map(str, numbers), count, text_drawing(chain).replace("[", r"\["))
    console = Console(highlight=False)
    # drawings are not cut, they may run over
    console.width = max(console.width, 74 + 8 * family.n_masses)
    # printed by print, so that a closed pipe ends this command as it ends the others
    with console.capture() as text:
        console.print(table)
    return text.get()


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
