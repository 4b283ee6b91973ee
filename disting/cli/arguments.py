"""Arguments that several commands share, and what their texts mean; nothing here loads numerical
libraries.
"""

import argparse
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from disting.cli.output import complain, written_file, written_folder
from disting.conditions.rule import RULES, condition_names
from disting.errors import InputError, short
from disting.model.family import MOST_MASSES
from disting.model.kinds import EXAMPLES
from disting.model.names import DAMPED
from disting.model.question import Domain
from disting.network.notation import NOTATIONS, notations_of
from disting.network.notation.member import FAMILY
from disting.quantities import MODELLED, Quantity, as_quantity

MODEL = (
    "a model: masses:number, as 'disting models' lists it; +b2: with a damper from mass 2 to the"
    " ground; +lag; +delay; a network such as 'R0-p(R1,C1)' or '1=2, 2=3, 2=4; F1; S4'; trees-4:17,"
    " number 17 of a family of networks; or file.json:name, a model of your own"
)

DOMAINS = tuple(domain.value for domain in Domain)


def whole(low: int, high: int = 10**9) -> Callable[[str], int]:
    """Whole numbers from `low` to `high`."""

    def number(text: str) -> int:
        """The number, or an error that states what is needed."""
        if not text.isdecimal() or len(text) > 99 or int(text) < low:
            raise argparse.ArgumentTypeError(
                f"a whole number of at least {low} is needed, not {short(text)}"
            )
        if int(text) > high:
            raise argparse.ArgumentTypeError(
                f"a whole number of at most {high} is needed, not {short(text)}"
            )
        return int(text)

    return number


MASSES = whole(1, MOST_MASSES)


def sizes(text: str) -> range:
    """One size such as 4, or several such as 1-4."""
    match = re.fullmatch(r"([1-9]\d{0,2})(?:-([1-9]\d{0,2}))?", text)
    if not match or int(match[2] or match[1]) < int(match[1]):
        raise argparse.ArgumentTypeError(f"sizes are written like 4 or 1-4, not {short(text)}")
    if int(match[2] or match[1]) > MOST_MASSES:
        raise argparse.ArgumentTypeError(
            f"families of at most {MOST_MASSES} masses are listed, not of {match[2] or match[1]}"
        )
    return range(int(match[1]), int(match[2] or match[1]) + 1)


Listed = Path | str
"""A list of models: a file, or the name of a family of networks."""


FILE = ".json:"  # between a file and the name of a model in it


def split_reference(text: str) -> tuple[str, str]:
    """A file and the name of a model in it; "" and the text where it names something else.

    >>> split_reference("own.json:two leaks"), split_reference("3:1")
    (('own.json', 'two leaks'), ('', '3:1'))
    """
    path, mark, name = text.partition(FILE)
    return (f"{path}{FILE[:-1]}", name) if mark else ("", text)


def sizes_or_list(text: str) -> range | Listed:
    """Sizes, or a list of models."""
    return _list(_no_network(text)) or sizes(text)


def size_or_list(text: str) -> int | Listed:
    """One number of masses, or a list of models."""
    return _list(_no_network(text)) or MASSES(text)


def _no_network(text: str) -> str:
    """Return the text; raise ArgumentTypeError for one network where a list is needed."""
    if notations_of(text):
        raise argparse.ArgumentTypeError(
            f"{short(text)} is one network; name a family such as circuits-4 or a file of networks,"
            " or two networks with disting compare"
        )
    return text


class NetworkText(str):
    """Text that is a network in some notation."""


def size_list_or_text(text: str) -> int | Listed | NetworkText:
    """One number of masses, a list of models, or the text of a network."""
    is_network = _list(text) is None and notations_of(text)
    return NetworkText(text) if is_network else size_or_list(text)


def size_or_family(text: str) -> int | str:
    """One number of masses, or the name of a family of networks."""
    return text if FAMILY.fullmatch(text) else MASSES(text)


def _list(text: str) -> Listed | None:
    if FAMILY.fullmatch(text):
        return text
    return Path(text) if text.endswith(".json") else None


def exact_range(text: str) -> tuple[str, tuple[str, str]]:
    """A range such as k12=0..1000, its ends as they are written."""
    match = re.fullmatch(r"(\w+)=([^=.]*\.?[^=.]*)\.\.([^=]+)", text)
    if not match:
        raise argparse.ArgumentTypeError(f"a range is written like k12=0..1000, not {short(text)}")
    return match[1], (match[2], match[3])


FREQUENCY = r"\d+\.?\d*(?:[eE][+-]?\d+)?"


def frequency_range(text: str) -> tuple[float, float]:
    """Two rising numbers such as 11..250, or 11-250; raises ArgumentTypeError."""
    dashed = re.fullmatch(rf"({FREQUENCY})-({FREQUENCY})", text)
    low, _, high = (dashed[1], "", dashed[2]) if dashed else text.partition("..")
    try:
        limits = (float(low), float(high))
    except ValueError:
        limits = (1.0, 0.0)
    if not limits[0] < limits[1]:
        raise argparse.ArgumentTypeError(
            f"a range is written like 11..250, the lower end first, not {short(text)}"
        )
    return limits


def conditions(text: str) -> tuple[str, ...]:
    """Names and ranges such as 1-5,8, in the order of the table; raises ArgumentTypeError."""
    try:
        return condition_names(text)
    except InputError as reason:
        raise argparse.ArgumentTypeError(str(reason)) from None


def add_damped(parser: argparse.ArgumentParser) -> None:
    """--damped and --undamped; None if neither is given."""
    choice = parser.add_mutually_exclusive_group()
    for name, text in (
        ("damped", "a damper beside every spring (default)"),
        ("undamped", "springs without dampers"),
    ):
        choice.add_argument(
            f"--{name}", dest="damped", action="store_const", const=name == "damped", help=text
        )


def is_damped(options: argparse.Namespace) -> bool:
    """Return True if the springs of numbered chains have dampers (the default)."""
    return DAMPED if options.damped is None else bool(options.damped)


def quantity_word(text: str) -> str:
    """The name of a sensor quantity, of its usual words; raises ArgumentTypeError."""
    try:
        return as_quantity(text).value
    except InputError as reason:
        raise argparse.ArgumentTypeError(str(reason)) from None


def add_quantity(
    parser: argparse.ArgumentParser, default: Quantity = Quantity.ACCELERATION
) -> None:
    """--quantity: what the sensor shows; --sensor is everywhere the mass at which it sits."""
    parser.add_argument(
        "--quantity",
        type=quantity_word,
        choices=[s.value for s in MODELLED],
        default=default.value,
        help=f"what the sensor shows (default: {default})",
    )
    refuse(parser, "--sensor", "a sensor is a mass; what it shows is --quantity, such as velocity")


def add_bounds(parser: argparse.ArgumentParser, text: str) -> None:
    """--bound: ranges of parameters, exactly as they are written."""
    parser.add_argument(
        "--bound",
        type=exact_range,
        action="append",
        default=[],
        metavar="NAME=LOW..HIGH",
        help=text,
    )
    refuse(parser, "--range", "the range of a parameter is --bound, such as --bound k12=0..1000")


def add_json(
    parser: argparse.ArgumentParser | argparse._ArgumentGroup, what: str, *, alone: bool = False
) -> None:
    """--json FILE; `alone`: without a name, it is standard output."""
    rest = "; - or no name is standard output" if alone else "; - is standard output"
    optional: dict[str, Any] = {"nargs": "?", "const": "-"} if alone else {}
    help_ = f"write {what} as JSON{rest}"
    parser.add_argument("--json", type=written_file, metavar="FILE", help=help_, **optional)


def refuse(parser: argparse.ArgumentParser, option: str, remedy: str) -> None:
    """An option of another meaning elsewhere, or of before, is refused with what to write."""
    parser.add_argument(option, action=_Refused, remedy=remedy)


def add_old_option(
    parser: argparse.ArgumentParser, old: str, new: str, kind: Callable[[str], object]
) -> None:
    """The old name of an option with a value, accepted for one version, with a warning."""
    parser.add_argument(old, action=_Renamed, new=new, type=kind)


class _Renamed(argparse.Action):
    """The old name of an option."""

    def __init__(
        self, option_strings: list[str], dest: str, new: str, type: Callable[[str], object]
    ) -> None:
        place = new.removeprefix("--").replace("-", "_")
        super().__init__(
            option_strings, place, type=type, default=argparse.SUPPRESS, help=argparse.SUPPRESS
        )
        self.new = new

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: object,
        option_string: str | None = None,
    ) -> None:
        """Keep the value, and say the new name."""
        complain(f"{option_string} is now {self.new}; the old name works in this version only")
        setattr(namespace, self.dest, values)


class _Refused(argparse.Action):
    """An option that ends in a sentence."""

    def __init__(self, option_strings: list[str], dest: str, remedy: str) -> None:
        super().__init__(option_strings, argparse.SUPPRESS, nargs="?", help=argparse.SUPPRESS)
        self.remedy = remedy

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Say it."""
        parser.error(f"{self.option_strings[0]}: {self.remedy}")


def add_deciding(parser: argparse.ArgumentParser) -> None:
    """Add the options that select the conditions and the parameter domain; the help ends with the
    list of conditions.
    """
    rows = (f"  {r.name}  {r.title}: {r.text}" for r in RULES.values() if r.is_condition)
    parser.epilog = "\n".join(["conditions that verdicts name:", *rows])
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    text = (
        "decide by these conditions only, over complex parameters, such as 1-5,8; 1-9 is the"
        " paper's view"
    )
    parser.add_argument("--conditions", type=conditions, metavar="LIST", help=text)
    text = (
        "parameters for which the verdict holds (default: positive; complex, as in the paper, if"
        " conditions or a representation are given)"
    )
    parser.add_argument("--domain", choices=DOMAINS, default="", help=text)
    text = "prove by exact elimination what was computed at random points, if it ends in time"
    parser.add_argument("--prove", action="store_true", help=text)


def add_also(parser: argparse.ArgumentParser) -> None:
    """--also: further experiments on two chains or networks of masses."""
    text = (
        f"measure also like this: {EXAMPLES}, one or several, at masses of the left model (3/2:"
        " mass 2 of the right one, else every one is tried); may be repeated"
    )
    parser.add_argument("--also", action="append", default=[], metavar="EXPERIMENT", help=text)


def add_notation(parser: argparse.ArgumentParser | argparse._ArgumentGroup) -> None:
    """--notation."""
    text = f"notation of the network, if its text does not show it: {', '.join(NOTATIONS)}"
    parser.add_argument("--notation", choices=NOTATIONS, default="", metavar="NOTATION", help=text)


def add_no_cache(parser: argparse.ArgumentParser) -> None:
    """--no-cache."""
    parser.add_argument("--no-cache", action="store_true", help="neither read nor write the cache")


def add_work(parser: argparse.ArgumentParser, jobs: tuple[int, str] = (1, "1")) -> None:
    """Cache and workers; `jobs`: their default number, and its description in the help."""
    add_no_cache(parser)
    parser.add_argument(
        "--jobs",
        type=whole(1),
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


def add_masses(parser: argparse.ArgumentParser, default: str = "") -> None:
    """One number of masses or more; with a default they can be omitted."""
    text = "numbers of masses" + (f" (default: {default})" if default else "")
    parser.add_argument(
        "masses", type=MASSES, nargs="*" if default else "+", metavar="N", help=text
    )


def add_out(parser: argparse.ArgumentParser, default: str) -> None:
    """The folder that is written to."""
    parser.add_argument(
        "--out",
        type=written_folder,
        default=Path(default),
        metavar="DIR",
        help=f"folder to write to (default: {default})",
    )
