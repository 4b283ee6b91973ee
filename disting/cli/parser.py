"""The command line's grammar: the parser of all commands, and what it says where it does not
understand.
"""

import argparse
import re
import sys
from collections.abc import Sequence
from typing import Any

from disting.cli.commands import COMMANDS, SECTIONS, Command, Group
from disting.cli.output import complain
from disting.errors import LONGEST_ECHO, short
from disting.files import __version__

DESCRIPTION = (
    "Which models of a servo drive, or of another linear network, can a measurement not tell apart?"
    " Exact verdicts, with evidence."
)
STATUS = (
    "exit status: 0 fine, 1 a failed verification, 2 bad usage or bad input,"
    " 3 a verdict that cannot be checked alone"
)
Subparsers = Any  # the object that argparse gives for sub-commands has no public type


def parser(*, whole: bool = True) -> argparse.ArgumentParser:
    """The parser of all commands; `command` of the parsed options is the one that they name.

    `whole`: with the arguments of all commands, else each declares its own when it is named.
    """
    top = _Parser(
        prog="disting",
        usage="disting [-h] [--version] COMMAND ...",
        description=DESCRIPTION,
        epilog=epilog(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="version", version=f"disting {__version__}")
    commands = top.add_subparsers(
        prog="disting",
        required=True,
        metavar="COMMAND",
        parser_class=_Parser,
        help=argparse.SUPPRESS,
    )
    for command in COMMANDS:
        if isinstance(command, Command):
            _add_command(commands, command, whole)
        else:
            _add_group(commands, command, whole)
    return top


BEGIN = """begin with:
  a measurement  disting fit FILE.csv, or disting fit --demo without one
  a machine      disting report 3, and "Describe your machine" on the page it writes
  two models     disting compare 3:1 3:11"""


def epilog() -> str:
    """The commands by subject, where to begin, and what exit statuses mean."""
    lists = [
        f"{title}:\n" + "\n".join(f"  {c.name:<13}{c.text}" for c in commands)
        for title, commands in SECTIONS.items()
    ]
    return "\n\n".join([*lists, BEGIN, f"disting COMMAND --help shows its options.\n{STATUS}"])


def _add_command(to: Subparsers, command: Command, whole: bool, **listed: str) -> None:
    text = command.text
    p = to.add_parser(command.name, description=text[0].upper() + text[1:] + ".", **listed)
    p.set_defaults(command=command)
    p.undeclared = command
    if whole:
        p.declare()


def _add_group(to: Subparsers, group: Group, whole: bool) -> None:
    p = to.add_parser(group.name, description=group.description)
    actions = p.add_subparsers(required=True, metavar="ACTION", parser_class=_Parser)
    for command in group.commands:
        _add_command(actions, command, whole, help=command.text)


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
        namespace_read, rest = super().parse_known_args(args, namespace)
        if rest:
            options = [name for action in self._actions for name in _offered(action)]
            meant = [near(word.partition("=")[0], options) for word in rest if word[0:1] == "-"]
            own = [word for word in args or () if word.lower().endswith(".json")]
            if own and not meant:  # names of models after the file that holds them
                meant = [f"; a model of a file is written {own[0]}:NAME"]
            self.error(
                f"unrecognized arguments: {' '.join(rest)}{''.join(meant) or '; leave them away'}"
            )
        return namespace_read, rest

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            names = list(map(str, action.choices))
            said = f"{short(value)} is none of {', '.join(names)}{near(str(value), names)}"
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
                value = f": {action.metavar}" if action.option_strings and action.metavar else ""
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


def near(word: str, names: Sequence[str]) -> str:
    """The end of a sentence on a word that is not known: what it may have been meant for."""
    from difflib import get_close_matches  # where something is wrong, and nowhere else

    texts = get_close_matches(word[:LONGEST_ECHO], names, 1)
    return f"; did you mean {texts[0]}?" if texts else ""


def _short(message: str) -> str:
    """argparse echoes what it does not know as it is."""
    return " ".join(
        word if len(word) <= 2 * LONGEST_ECHO else f"{word[:LONGEST_ECHO]}…"
        for word in message.split(" ")
    )
