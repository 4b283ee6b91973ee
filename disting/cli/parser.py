"""The command line's grammar: which commands there are, what each is for, which module runs it.

The arguments of a command are declared in its own module, which is imported when the command is
named: it takes longer than most commands run. Those of `fit` and `plan` stand apart from what runs
them, which loads libraries that help needs not.
"""

import argparse
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from disting.cli.plain import complain
from disting.conditions.rule import RULES
from disting.errors import LONGEST_ECHO, shown
from disting.files import __version__

DESCRIPTION = (
    "Which servo-drive chain models can one force and one sensor not tell apart? Exact verdicts,"
    " with evidence."
)
STATUS = (
    "exit status: 0 fine, 1 a failed verification, 2 bad usage or bad input,"
    " 3 a verdict that cannot be checked alone"
)
Subparsers = Any  # the object that argparse gives for sub-commands has no public type


@dataclass(frozen=True, slots=True)
class Command:
    """`text` says in a list of commands what `run` of its module does with the options; `add`
    declares its arguments, in the same module if no other one is named. Of a command with many
    options `brief` names the few lines that `--help` shows, beside them; the rest is behind
    `--help-all`.
    """

    name: str
    text: str
    module: str
    run: str = "run"
    add: str = "add_arguments"
    arguments: str = ""
    brief: str = ""

    def work(self) -> Callable[[argparse.Namespace], int]:
        """What runs it, imported."""
        return self._of(self.module, self.run)

    def declare(self, parser: argparse.ArgumentParser) -> None:
        """Add its arguments to its parser."""
        if self.add:
            self._of(self.arguments or self.module, self.add)(parser)

    def brief_help(self) -> str:
        """Its help in brief; "" where there is none."""
        if not self.brief:
            return ""
        found: str = getattr(import_module(f"disting.cli.{self.arguments}"), self.brief)
        return found

    @staticmethod
    def _of(module: str, name: str) -> Callable[..., Any]:
        function: Callable[..., Any] = getattr(import_module(f"disting.cli.{module}"), name)
        return function


@dataclass(frozen=True, slots=True)
class Group:
    """Commands behind one name."""

    name: str
    text: str
    description: str
    commands: tuple[Command, ...]


CATALOG = Group(
    "catalog",
    "build, settle or verify them",
    "Precomputed catalogues.",
    (
        Command(
            "build",
            "compute catalogues, undamped and damped",
            "catalogs",
            "build",
            "add_build_arguments",
        ),
        Command(
            "candidates",
            "compute the verdicts on all pairs of a fit's 120 candidates",
            "catalogs",
            "candidates",
            "add_candidates_arguments",
        ),
        Command(
            "dampers",
            "compute whole families with all sets of dampers to the ground, by classes",
            "dampers",
            "build",
            "add_build_arguments",
        ),
        Command(
            "families",
            "compute the verdicts on families of networks",
            "catalogs",
            "families",
            "add_families_arguments",
        ),
        Command(
            "next",
            "compute what to measure next for all groups that one measurement cannot tell apart",
            "catalogs",
            "menus",
            "add_menus_arguments",
        ),
        Command(
            "sizes",
            "compute the verdicts on pairs of models of different sizes, 1 to 5 masses",
            "catalogs",
            "sizes",
            "add_sizes_arguments",
        ),
        Command(
            "settle",
            "decide pairs of classes with dampers to the ground that are open, to be shipped",
            "catalogs",
            "settle",
            "add_settle_arguments",
        ),
        Command(
            "verify",
            "rebuild catalogues, compare bytes, and check every evidence anew",
            "catalogs",
            "verify",
            "add_verify_arguments",
        ),
    ),
)
CACHE = Group(
    "cache",
    "look at or empty the cache",
    "The cache of profiles and verdicts.",
    (
        Command("info", "where the cache is and what it holds", "upkeep", "cache_info", ""),
        Command("clear", "remove all entries", "upkeep", "cache_clear", ""),
    ),
)
COMMANDS = (
    Command(
        "models",
        "the numbered list of all models of one size, or your own models in a file",
        "models",
    ),
    Command("compare", "one verdict, explained", "compare"),
    Command(
        "verify",
        "whether one verdict holds, checked anew from its evidence alone",
        "verify",
    ),
    Command(
        "verdicts",
        "all pairs of one size, of several sizes together, or of your own models in a file",
        "verdicts",
    ),
    Command(
        "equivalents",
        "all parameters of other models with the same transfer function",
        "equivalents",
    ),
    Command(
        "next",
        "what to measure next to tell structures apart that look the same",
        "next",
    ),
    Command(
        "fit",
        "the structures that explain a measured frequency response",
        "fit",
        arguments="fit_arguments",
        brief="BRIEF",
    ),
    Command(
        "plan",
        "how much measuring tells two structures apart",
        "plan",
        arguments="plan_arguments",
    ),
    Command(
        "report",
        "HTML pages, figures and tables of whole catalogues, or of your own models in a file",
        "report",
    ),
    Command("draw", "the drawing of a model, as SVG or PNG", "draw"),
    CATALOG,
    Command(
        "simulate",
        "what a bench would measure on a chain with known parameters",
        "simulate",
    ),
    Command(
        "dampers",
        "which sets of dampers to the ground of one model can be told apart",
        "dampers",
    ),
    Command(
        "schema",
        "what is in the JSON files that disting writes, as JSON Schema",
        "schema",
    ),
    CACHE,
    Command("doctor", "what is installed, and what else would help", "upkeep", "doctor", ""),
)


def parser(*, whole: bool = True) -> argparse.ArgumentParser:
    """The parser of all commands; `command` of the parsed options is the one that they name.

    `whole`: with the arguments of all commands, else each declares its own when it is named.
    """
    top = _Parser(
        prog="disting",
        description=DESCRIPTION,
        epilog=epilog(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="version", version=f"disting {__version__}")
    commands = top.add_subparsers(required=True, metavar="COMMAND", parser_class=_Parser)
    for one in COMMANDS:
        if isinstance(one, Command):
            _add_command(commands, one, whole)
        else:
            _add_group(commands, one, whole)
    return top


BEGIN = """begin with:
  a measurement  disting fit FILE.csv, or disting fit --demo without one
  a machine      disting report 3, and "Describe your machine" on the page it writes
  two models     disting compare 3:1 3:11
"""


def epilog() -> str:
    """Where to begin, the conditions, and what exit statuses mean."""
    rows = (f"  {r.name}  {r.title}: {r.text}" for r in RULES.values() if r.is_condition)
    return "\n".join([BEGIN, "conditions that verdicts name:", *rows, "", STATUS])


def _add_command(to: Subparsers, command: Command, whole: bool) -> None:
    text = command.text
    p = to.add_parser(command.name, help=text, description=text[0].upper() + text[1:] + ".")
    p.set_defaults(command=command)
    p.undeclared = command
    if whole:
        p.declare()


def _add_group(to: Subparsers, group: Group, whole: bool) -> None:
    p = to.add_parser(group.name, help=group.text, description=group.description)
    actions = p.add_subparsers(required=True, metavar="ACTION", parser_class=_Parser)
    for command in group.commands:
        _add_command(actions, command, whole)


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one sentence, which says what may have been meant."""

    undeclared: Command | None = None
    brief: str = ""

    def declare(self) -> None:
        """Add the arguments of its command, once."""
        command, self.undeclared = self.undeclared, None
        if command is None:
            return
        command.declare(self)
        self.brief = command.brief_help()
        if self.brief:
            text = "show all options, each with what it means"
            self.add_argument("--help-all", action=_HelpAll, nargs=0, help=text)

    def format_help(self) -> str:
        """In brief, where there is such a help."""
        return self.brief or super().format_help()

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def]
        """A command refuses itself what it does not know, so that its own help is named."""
        self.declare()
        found, rest = super().parse_known_args(args, namespace)
        if rest:
            options = [name for action in self._actions for name in _offered(action)]
            meant = [near(word.partition("=")[0], options) for word in rest if word[0:1] == "-"]
            own = [word for word in args or () if word.lower().endswith(".json")]
            if own and not meant:  # names of models after the file that holds them
                meant = [f"; a model of a file is written {own[0]}:NAME"]
            self.error(
                f"unrecognized arguments: {' '.join(rest)}{''.join(meant) or '; leave them away'}"
            )
        return found, rest

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            known = list(map(str, action.choices))
            said = f"{shown(value)} is none of {', '.join(known)}{near(str(value), known)}"
            raise argparse.ArgumentError(action, said)

    def _print_message(self, message: str, file: Any = None) -> None:
        (file or sys.stderr).write(message)  # argparse would hide that it cannot be written

    def error(self, message: str) -> None:  # type: ignore[override]
        """Say what is wrong and where help is; exit status 2."""
        said = _short(self._plain(message)).rstrip(".")
        complain(f"{said} (see '{self.prog} --help')")
        self.exit(2)

    def _plain(self, message: str) -> str:
        """What argparse says of a missing word or a wrong number, with what belongs there."""
        if match := re.fullmatch(r"the following arguments are required: ([^,]+).*", message):
            return f"{match[1]} is missing{self._meaning(match[1])}"
        if match := re.fullmatch(r"argument (.+): expected one argument", message):
            return f"{match[1]} needs a value{self._meaning(match[1])}"
        wanted = {"float": "a number", "int": "a whole number"}
        match = re.fullmatch(r"(.+): invalid (float|int) value: (.+)", message)
        return f"{match[1]}: {wanted[match[2]]} is needed, not {match[3]}" if match else message

    def _meaning(self, name: str) -> str:
        """The first words of the help of an argument, after what stands for its value."""
        for action in self._actions:
            if action.choices and action.metavar == name:
                return f": one of {', '.join(action.choices)}"
            names = (action.metavar, action.dest, "/".join(action.option_strings))
            if name in names and action.help:
                value = f": {action.metavar}" * bool(action.option_strings and action.metavar)
                said = re.split(r"; | \(", action.help)[0]
                return f"{value}: {said}"
        return ""


class _HelpAll(argparse.Action):
    """The help of a command that has many options, whole."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Show it and end."""
        if isinstance(parser, _Parser):
            parser.brief = ""
        parser.print_help()
        parser.exit()


def _offered(action: argparse.Action) -> list[str]:
    return [] if action.help == argparse.SUPPRESS else list(action.option_strings)


def near(word: str, known: Sequence[str]) -> str:
    """The end of a sentence on a word that is not known: what it may have been meant for."""
    from difflib import get_close_matches  # where something is wrong, and nowhere else

    found = get_close_matches(word[:LONGEST_ECHO], known, 1)
    return f"; did you mean {found[0]}?" if found else ""


def _short(message: str) -> str:
    """argparse echoes what it does not know as it is."""
    return " ".join(
        word if len(word) <= 2 * LONGEST_ECHO else f"{word[:LONGEST_ECHO]}…"
        for word in message.split(" ")
    )
