"""The command line's grammar: names, arguments, defaults and help."""

import argparse
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from disting.catalogs.files import shipped_folder
from disting.cli import (
    catalogs,
    compare,
    dampers,
    equivalents,
    fit_arguments,
    models,
    next,
    plan_arguments,
    report,
    simulate,
    upkeep,
    verdicts,
)
from disting.cli.common import VIEWS
from disting.cli.paths import written_file, written_folder
from disting.cli.plain import complain
from disting.conditions.table import CONDITIONS
from disting.errors import LONGEST_ECHO, shown
from disting.files import __version__
from disting.model.chain import Sensor
from disting.model.domain import Domain
from disting.model.family import MOST_MASSES

MODEL = (
    "a model: masses:number, as 'disting models' lists it; +b2: with a damper from mass 2 to the"
    " ground; +lag; +delay; or file.json:name, a model of your own"
)
NAMES = [c.rule.name for c in CONDITIONS]
LIST = (
    "decide by these conditions only, over complex parameters, such as 1-5,8; 1-9 is the paper's"
    " view"
)
Groups = Any  # the object that argparse gives for sub-commands has no public type
DESCRIPTION = (
    "Which servo-drive chain models can one force and one sensor not tell apart? Exact verdicts,"
    " with evidence."
)
EPILOG = (
    "conditions:\n"
    + "\n".join(f"  {c.rule.name}  {c.rule.title}: {c.rule.text}" for c in CONDITIONS)
    + "\n\nexit status: 0 fine, 1 a failed verification, 2 bad usage or bad input"
)


def _whole(low: int, high: int = 10**9) -> Callable[[str], int]:
    """Whole numbers from `low` to `high`."""

    def number(text: str) -> int:
        """The number, or an error that says what is needed."""
        if not text.isdecimal() or len(text) > 99 or int(text) < low:
            raise argparse.ArgumentTypeError(
                f"a whole number of at least {low} is needed, not {shown(text)}"
            )
        if int(text) > high:
            raise argparse.ArgumentTypeError(
                f"a whole number of at most {high} is needed, not {shown(text)}"
            )
        return int(text)

    return number


def _sizes(text: str) -> range:
    """One size such as 4, or several such as 1-4."""
    match = re.fullmatch(r"([1-9]\d{0,2})(?:-([1-9]\d{0,2}))?", text)
    if not match or int(match[2] or match[1]) < int(match[1]):
        raise argparse.ArgumentTypeError(f"sizes are written like 4 or 1-4, not {shown(text)}")
    if int(match[2] or match[1]) > MOST_MASSES:
        raise argparse.ArgumentTypeError(
            f"families of at most {MOST_MASSES} masses are listed, not of {match[2] or match[1]}"
        )
    return range(int(match[1]), int(match[2] or match[1]) + 1)


def _sizes_or_file(text: str) -> range | Path:
    """Sizes, or a file of models."""
    return Path(text) if text.endswith(".json") else _sizes(text)


def _size_or_file(text: str) -> int | Path:
    """One number of masses, or a file of models."""
    return Path(text) if text.endswith(".json") else MASSES(text)


def _bounds(text: str) -> tuple[str, tuple[str, str]]:
    """A range such as k12=0..1000."""
    match = re.fullmatch(r"(\w+)=([^=.]*\.?[^=.]*)\.\.([^=]+)", text)
    if not match:
        raise argparse.ArgumentTypeError(f"a range is written like k12=0..1000, not {shown(text)}")
    return match[1], (match[2], match[3])


def _conditions(text: str) -> tuple[str, ...]:
    """Names and ranges such as 1-5,8, in the order of the table."""
    chosen = set[str]()
    for part in text.split(","):
        low, dash, high = part.strip().partition("-")
        high = high if dash else low
        if not {low, high} <= set(NAMES) or NAMES.index(high) < NAMES.index(low):
            known = f"the conditions {NAMES[0]} to {NAMES[-1]}"
            raise argparse.ArgumentTypeError(
                f"conditions are written like 1-5,8, of {known}, not {shown(text)}"
            )
        chosen |= set(NAMES[NAMES.index(low) : NAMES.index(high) + 1])
    return tuple(name for name in NAMES if name in chosen)


MASSES = _whole(1, MOST_MASSES)


def parser() -> argparse.ArgumentParser:
    """The parser of all commands; `run` of the parsed options is the command's function."""
    top = _Parser(
        prog="disting",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="version", version=f"disting {__version__}")
    groups = top.add_subparsers(required=True, metavar="COMMAND", parser_class=_Parser)
    for add in (
        _add_models,
        _add_compare,
        _add_verdicts,
        _add_equivalents,
        _add_next,
        _add_fit,
        _add_plan,
        _add_report,
        _add_catalog,
    ):
        add(groups)
    for add in (_add_simulate, _add_dampers, _add_cache, _add_doctor):
        add(groups)
    return top


def _add_models(groups: Groups) -> None:
    p = _command(groups, "models", models.run, "the numbered list of all models of one size")
    p.add_argument("masses", type=MASSES, metavar="N", help="number of masses")
    p.add_argument(
        "--identifiability",
        action="store_true",
        help="say for each model which parameters can be determined",
    )
    _shared(p, damped=True, work=True)


def _add_compare(groups: Groups) -> None:
    p = _command(groups, "compare", compare.run, "one verdict, explained")
    p.add_argument("left", metavar="N:I", help=MODEL)
    p.add_argument("right", metavar="M:J", help="the other model, of the same or another size")
    _shared(p, damped=True, sensor=True)
    p.add_argument("--conditions", type=_conditions, metavar="LIST", help=LIST)
    _deciding(p)
    text = "look only at models within this range of a parameter, of both models; may be repeated"
    p.add_argument(
        "--range", type=_bounds, action="append", default=[], metavar="NAME=LOW..HIGH", help=text
    )
    text = (
        "measure also like this: sensor=3, lock=2 or inertia=1:0.5, at masses of the left model"
        " (3/2: mass 2 of the right one, else every one is tried); may be repeated"
    )
    p.add_argument("--also", action="append", default=[], metavar="EXPERIMENT", help=text)
    p.add_argument(
        "--json", action="store_true", help="print the verdict with its evidence as JSON"
    )
    p.add_argument("--no-cache", action="store_true", help="neither read nor write the cache")


def _add_verdicts(groups: Groups) -> None:
    p = _command(
        groups,
        "verdicts",
        verdicts.run,
        "all pairs of one size, of several sizes together, or of your own models in a file",
    )
    p.add_argument(
        "masses",
        type=_sizes_or_file,
        metavar="N|N-M|FILE.json",
        help="number of masses, or several sizes such as 1-4 in one matrix, or a file of models",
    )
    _shared(p, damped=True, sensor=True, work=True)
    p.add_argument("--conditions", type=_conditions, metavar="LIST", help=LIST)
    _deciding(p)
    p.add_argument(
        "--representation", choices=VIEWS, default="all", help="which may decide (default: all)"
    )
    p.add_argument(
        "--markov",
        type=_whole(1),
        default=0,
        metavar="K",
        help="use G_0 and G_1..G_K (default: all that are needed)",
    )
    p.add_argument(
        "--csv",
        type=written_file,
        metavar="FILE",
        help="write the verdicts as CSV; - is standard output",
    )
    p.add_argument(
        "--json",
        type=written_file,
        metavar="FILE",
        help="write the verdicts with evidence as JSON; - is standard output",
    )


def _add_equivalents(groups: Groups) -> None:
    p = _command(
        groups,
        "equivalents",
        equivalents.run,
        "all parameters of other models with the same transfer function",
    )
    equivalents.add_arguments(p)
    _shared(p, damped=True)


def _add_next(groups: Groups) -> None:
    text = "what to measure next to tell structures apart that look the same"
    p = _command(groups, "next", next.run, text)
    next.add_arguments(p)
    _shared(p, damped=True, work=True)


def _add_dampers(groups: Groups) -> None:
    p = _command(
        groups,
        "dampers",
        dampers.run,
        "which sets of dampers to the ground of one model can be told apart",
    )
    dampers.add_arguments(p)
    _shared(p, damped=True, work=True)


def _add_fit(groups: Groups) -> None:
    p = _command(groups, "fit", _fit, "the structures that explain a measured frequency response")
    fit_arguments.add_arguments(p)
    _shared(p, work=True, jobs=(0, "one for each core if there are many candidates"))


def _fit(options: argparse.Namespace) -> int:
    """Fit measured data; only here are the libraries loaded that no other command needs."""
    from disting.cli import fit

    return fit.run(options)


def _add_plan(groups: Groups) -> None:
    p = _command(groups, "plan", _plan, "how much measuring tells two structures apart")
    plan_arguments.add_arguments(p)
    _shared(p, damped=True, work=True)


def _plan(options: argparse.Namespace) -> int:
    """Plan a measurement; likewise."""
    from disting.cli import plan

    return plan.run(options)


def _add_simulate(groups: Groups) -> None:
    p = _command(
        groups,
        "simulate",
        simulate.run,
        "what a bench would measure on a chain with known parameters",
    )
    simulate.add_arguments(p)
    _shared(p, damped=True)


def _add_report(groups: Groups) -> None:
    what = "HTML pages, figures and tables of whole catalogues, or of your own models in a file"
    p = _command(groups, "report", report.run, what)
    text = "numbers of masses, or files of models"
    p.add_argument("masses", type=_size_or_file, nargs="*", metavar="N|FILE.json", help=text)
    text = (
        "the paper's figures and tables from our own data, and its claims one by one, into the"
        " folder paper below DIR"
    )
    p.add_argument("--paper", action="store_true", help=text)
    choice = p.add_mutually_exclusive_group()
    for name in ("damped", "undamped", "both"):
        choice.add_argument(
            f"--{name}", dest="damping", action="store_const", const=name, help=f"{name} models"
        )
    p.set_defaults(damping="both")
    p.add_argument(
        "--out",
        type=written_folder,
        default=Path("reports"),
        metavar="DIR",
        help="folder to write to (default: reports)",
    )
    _shared(p, work=True)


def _add_catalog(groups: Groups) -> None:
    what = "Precomputed catalogues."
    p: argparse.ArgumentParser = groups.add_parser(
        "catalog", help="build, settle or verify them", description=what
    )
    actions = p.add_subparsers(required=True, metavar="ACTION", parser_class=_Parser)
    q = _command(actions, "build", catalogs.build, "compute catalogues, undamped and damped")
    q.add_argument("masses", type=MASSES, nargs="+", metavar="N", help="numbers of masses")
    q.add_argument(
        "--out",
        type=written_folder,
        default=Path("catalog"),
        metavar="DIR",
        help="folder to write to (default: catalog)",
    )
    _shared(q, work=True)
    q = _command(
        actions,
        "candidates",
        catalogs.candidates,
        "compute the verdicts on all pairs of a fit's 120 candidates",
    )
    q.add_argument(
        "--out",
        type=written_folder,
        default=Path("catalog"),
        metavar="DIR",
        help="folder to write to (default: catalog)",
    )
    _shared(q, work=True)
    q = _command(
        actions,
        "dampers",
        dampers.build,
        "compute whole families with all sets of dampers to the ground, by classes",
    )
    q.add_argument(
        "masses", type=MASSES, nargs="*", metavar="N", help="numbers of masses (default: 3 4 5)"
    )
    q.add_argument(
        "--out",
        type=written_folder,
        default=Path("catalog"),
        metavar="DIR",
        help="folder to write to (default: catalog)",
    )
    text = (
        "ask the dearest method of what is left for 5 masses and more too: an hour instead of"
        " minutes"
    )
    q.add_argument("--patient", action="store_true", help=text)
    _shared(q, work=True)
    text = "compute what to measure next for all groups that one measurement cannot tell apart"
    q = _command(actions, "next", next.build, text)
    q.add_argument(
        "masses", type=MASSES, nargs="*", metavar="N", help="numbers of masses (default: 2 to 5)"
    )
    q.add_argument(
        "--out",
        type=written_folder,
        default=Path("catalog"),
        metavar="DIR",
        help="folder to write to (default: catalog)",
    )
    _shared(q, work=True)
    q = _command(
        actions,
        "settle",
        catalogs.settle,
        "decide the rows of masses that leave pairs open, to be shipped",
    )
    q.add_argument("masses", type=MASSES, nargs="+", metavar="N", help="numbers of masses")
    q.add_argument(
        "--dampers",
        action="store_true",
        help="and what is open with dampers to the ground, of 3 to 5 masses",
    )
    q.add_argument(
        "--catalog",
        type=Path,
        default=Path("catalog"),
        metavar="DIR",
        help="folder (default: catalog)",
    )
    q = _command(
        actions,
        "verify",
        catalogs.verify,
        "rebuild catalogues, compare bytes, and check every evidence anew",
    )
    q.add_argument("masses", type=MASSES, nargs="+", metavar="N", help="numbers of masses")
    q.add_argument(
        "--catalog",
        type=Path,
        default=shipped_folder(),
        metavar="DIR",
        help="folder (default: the shipped one)",
    )
    _shared(q, work=True)


def _add_doctor(groups: Groups) -> None:
    _command(groups, "doctor", upkeep.doctor, "what is installed, and what else would help")


def _add_cache(groups: Groups) -> None:
    what = "The cache of profiles and verdicts."
    p: argparse.ArgumentParser = groups.add_parser(
        "cache", help="look at or empty the cache", description=what
    )
    actions = p.add_subparsers(required=True, metavar="ACTION", parser_class=_Parser)
    _command(actions, "info", upkeep.cache_info, "where the cache is and what it holds")
    _command(actions, "clear", upkeep.cache_clear, "remove all entries")


def _deciding(parser: argparse.ArgumentParser) -> None:
    names = [domain.value for domain in Domain]
    text = (
        "generic parameters that the verdict is about (default: positive; complex, as in the paper,"
        " where conditions or a representation are named)"
    )
    parser.add_argument("--domain", choices=names, default="", help=text)
    text = "prove by exact elimination what was computed at random points, where that ends in time"
    parser.add_argument("--prove", action="store_true", help=text)


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one sentence."""

    def error(self, message: str) -> None:  # type: ignore[override]
        """Say what is wrong and where help is; exit status 2."""
        complain(f"{_short(message)}; see '{self.prog} --help'")
        self.exit(2)


def _short(message: str) -> str:
    """argparse echoes what it does not know as it is."""
    return " ".join(
        word if len(word) <= 2 * LONGEST_ECHO else f"{word[:LONGEST_ECHO]}…"
        for word in message.split(" ")
    )


def _command(
    groups: Groups, name: str, run: Callable[[argparse.Namespace], int], text: str
) -> argparse.ArgumentParser:
    parser: argparse.ArgumentParser = groups.add_parser(
        name, help=text, description=text[0].upper() + text[1:] + "."
    )
    parser.set_defaults(run=run)
    return parser


def _shared(
    parser: argparse.ArgumentParser,
    *,
    damped: bool = False,
    sensor: bool = False,
    work: bool = False,
    jobs: tuple[int, str] = (1, "1"),
) -> None:
    if damped:
        parser.add_argument("--damped", action="store_true", help="a damper beside every spring")
    if sensor:
        names = [s.value for s in Sensor]
        parser.add_argument(
            "--sensor",
            choices=names,
            default="acceleration",
            help="measured quantity (default: acceleration)",
        )
    if work:
        parser.add_argument(
            "--no-cache", action="store_true", help="neither read nor write the cache"
        )
        parser.add_argument(
            "--jobs",
            type=_whole(1),
            default=jobs[0],
            metavar="K",
            help=f"worker processes (default: {jobs[1]})",
        )
        parser.add_argument(
            "--scheduler",
            default="",
            metavar="ADDRESS",
            help="compute on a dask.distributed cluster",
        )
