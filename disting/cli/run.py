"""Runs one command and turns every expected failure into one sentence and an exit status.

The parser of all commands is here too, and its messages for invalid input. Commands, options,
choices and models are completed by TAB, with argcomplete; a shell requests it by an environment
variable.
"""

import argparse
import os
import re
import signal
import sys
import warnings
from argparse import Namespace
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from typing import Any, TextIO, cast

from disting.cli.commands import COMMANDS, SECTIONS, Command, Group
from disting.cli.output import Output, complain, say_what_can_be_said
from disting.errors import LONGEST_ECHO, DistingError, short
from disting.files import __version__
from disting.model.family import Family

DESCRIPTION = (
    "Find the models of a servo drive, or of any linear network, that a measurement\n"
    "cannot distinguish. Exact verdicts, with evidence."
)
STATUS = (
    "exit status: 0 fine, 1 a failed verification or a fit that explains nothing,\n"
    "2 bad usage or bad input, 3 a verdict that cannot be checked alone"
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
    """A parser whose errors are one sentence, with a suggestion."""

    undeclared: Command | None = None
    brief: str = ""

    def declare(self) -> None:
        """Add the arguments of its command, once."""
        command, self.undeclared = self.undeclared, None
        if command is None:
            return
        command.declare(self)
        self._show_examples(command.examples)
        self.brief = command.brief_help()
        if self.brief:
            text = "show all options, each with what it means"
            self.add_argument("--help-all", action=_HelpAll, nargs=0, help=text)

    def _show_examples(self, examples: Sequence[str]) -> None:
        """End the help with the examples; the epilog follows as it is written."""
        if not examples:
            return
        end = self.epilog or ""
        self.formatter_class = argparse.RawDescriptionHelpFormatter
        shown = "\n".join(["examples:", *(f"  {line}" for line in examples)])
        self.epilog = f"{shown}\n\n{end}".rstrip()

    def format_help(self) -> str:
        """In brief, where there is such a help."""
        return self.brief or super().format_help()

    def parse_known_args(self, args=None, namespace=None):  # type: ignore[no-untyped-def]
        """A command refuses itself what it does not know, so that its own help is named."""
        self.declare()
        namespace_read, rest = super().parse_known_args(args, namespace)
        if rest:
            options = [name for action in self._actions for name in _list_choices(action)]
            meant = [near(word.partition("=")[0], options) for word in rest if word[0:1] == "-"]
            own = [word for word in args or () if word.lower().endswith(".json")]
            if own and not meant:  # names of models after the file that holds them
                meant = [f"; a model of a file is written {own[0]}:NAME"]
            self.error(
                f"unrecognized arguments: {' '.join(rest)}{''.join(meant) or '; remove them'}"
            )
        return namespace_read, rest

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            names = list(map(str, action.choices))
            message = f"{short(value)} is not one of {', '.join(names)}{near(str(value), names)}"
            raise argparse.ArgumentError(action, message)

    def _print_message(self, message: str, file: Any = None) -> None:
        (file or sys.stderr).write(message)  # argparse would hide that it cannot be written

    def error(self, message: str) -> None:  # type: ignore[override]
        """Say what is wrong and where help is; exit status 2."""
        sentence = _short(self._plain(message)).rstrip(".")
        complain(f"{sentence} (see '{self.prog} --help')")
        self.exit(2)

    def _plain(self, message: str) -> str:
        """Message of argparse about a missing word or a wrong number, completed with the expected
        value.
        """
        if match := re.fullmatch(r"the following arguments are required: ([^,]+).*", message):
            return f"{match[1]} is missing{self._meaning(match[1])}"
        if match := re.fullmatch(r"argument (.+): expected one argument", message):
            return f"{match[1]} needs a value{self._meaning(match[1])}"
        wanted = {"float": "a number", "int": "a whole number"}
        match = re.fullmatch(r"(.+): invalid (float|int) value: (.+)", message)
        return f"{match[1]}: {wanted[match[2]]} is needed, not {match[3]}" if match else message

    def _meaning(self, name: str) -> str:
        """The first words of the help of an argument, after the placeholder of its value."""
        for action in self._actions:
            if action.choices and action.metavar == name:
                return f": one of {', '.join(action.choices)}"
            names = (action.metavar, action.dest, "/".join(action.option_strings))
            if name in names and action.help:
                value = f": {action.metavar}" if action.option_strings and action.metavar else ""
                meaning = re.split(r"; | \(", action.help)[0]
                return f"{value}: {meaning}"
        return ""


class _HelpAll(argparse.Action):
    """The help of a command that has many options, whole."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Show it and end."""
        if isinstance(parser, _Parser):
            parser.brief = ""
        parser.print_help()
        parser.exit()


def _list_choices(action: argparse.Action) -> list[str]:
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


SIZES = range(1, 9)  # that are offered: of 9 masses there are a thousand models
MODELS = re.compile(r"\b[NM]:[IJ]\b")  # in what an argument is called
LONGEST_PATH = 200  # characters of a file name in a message
COMPLETION = "_ARGCOMPLETE"  # of the environment: a shell asks what a line may go on with


def complete(top: argparse.ArgumentParser) -> int:
    """Tell the shell, and end the process; status 1 where argcomplete is not installed."""
    try:
        import argcomplete
    except ImportError:
        return 1
    for action in _actions(top):
        if isinstance(action.metavar, str) and MODELS.search(action.metavar):
            action.completer = models  # type: ignore[attr-defined]
    argcomplete.autocomplete(top, always_complete_options=False)
    return 1


def models(prefix: str, **_: object) -> list[str]:
    """Names of models of the size that is typed, or sizes.

    >>> models("2:"), models("3:1")[:2], models("x")
    (['2:1', '2:2', '2:3'], ['3:1', '3:10'], [])
    """
    match = re.fullmatch(r"([1-9]?)(:\d*)?", prefix)
    if match is None:
        return []
    if match[2] is None:
        return [f"{n}:" for n in SIZES if str(n).startswith(match[1])]
    family = Family(int(match[1])) if int(match[1] or 0) in SIZES else ()
    names = (f"{match[1]}:{i}" for i in range(1, len(family) + 1))
    return [name for name in names if name.startswith(prefix)]


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    for action in parser._actions:
        yield action
        if isinstance(action, argparse._SubParsersAction):
            for inner in dict.fromkeys(action.choices.values()):
                yield from _actions(inner)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    _fill_closed_streams()
    say_what_can_be_said()
    with open(os.devnull, "w", encoding="utf-8") as nowhere, warnings.catch_warnings():
        warnings.showwarning = _print_warning
        # the shell may have closed them
        out = Output(sys.stdout or nowhere)
        with redirect_stdout(cast(TextIO, out)), redirect_stderr(sys.stderr or nowhere):
            return _run(arguments)


def _fill_closed_streams() -> None:
    """A file that is opened, such as the cache, must not get the number of a stream that
    libraries write to.
    """
    for number in (0, 1, 2):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # gets the lowest free number, which is this one


def _run(arguments: Sequence[str] | None) -> int:
    options = Namespace()
    try:
        if COMPLETION in os.environ:
            return _complete()
        options = _parse_arguments(arguments)
        work = options.command.work()
        with _raise_interrupts():
            status: int = work(options)
            sys.stdout.flush()
        return status
    except BrokenPipeError:  # the reader of a pipe has seen enough
        return 0
    except DistingError as reason:
        complain(reason)
        if reason.detail:
            print(reason.detail, file=sys.stderr)
        return 2
    except OSError as reason:
        complain(f"{reason.strerror or reason}: {_name(reason.filename)}".rstrip(": "))
        return 2
    except MemoryError as reason:
        complain(
            f"there is not enough memory ({str(reason) or 'no more can be had'}); ask for less"
        )
        return 2
    except KeyboardInterrupt:
        complain(f"interrupted{_cache_note(options)}")
        return 130
    finally:
        _drop_what_cannot_be_written()


def _cache_note(options: Namespace) -> str:
    """Note on the cache, empty if it was disabled on request."""
    from disting.store.store import MEMORY, NOWHERE, locate

    without = getattr(options, "no_cache", False) or locate(None) in (NOWHERE, MEMORY)
    return "" if without else "; what was finished is kept in the cache"


def _parse_arguments(arguments: Sequence[str] | None) -> Namespace:
    try:
        words = sys.argv[1:] if arguments is None else list(arguments)
        if words[:1] in ([], ["help"]):  # as people try first
            words = [*words[1:], "--help"]
        return parser(whole=False).parse_args(words, Namespace(words=words))
    except SystemExit:  # help was asked for, and must have been written
        sys.stdout.flush()
        raise


def _complete() -> int:

    return complete(parser())


@contextmanager
def _raise_interrupts() -> Iterator[None]:
    """Ctrl-C as an exception while a command works, where it ends the process at once before and
    after; where it is heard otherwise, or not, it stays so.
    """
    if signal.getsignal(signal.SIGINT) is not signal.SIG_DFL:
        yield
        return
    sys.unraisablehook = _not_lost
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        sys.unraisablehook = sys.__unraisablehook__


def _not_lost(lost: "sys.UnraisableHookArgs") -> None:
    """Where Python would report an interrupt and continue, since it occurred in a callback (there
    is one at the end of every import), the process ends at once.
    """
    if isinstance(lost.exc_value, KeyboardInterrupt):
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        signal.raise_signal(signal.SIGINT)
    sys.__unraisablehook__(lost)


def _name(of_file: object) -> str:
    """In full, but for one that no system would take."""
    name = str(of_file or "")
    return name if len(name) <= LONGEST_PATH else short(name)


def _drop_what_cannot_be_written() -> None:
    """Python would try once more at exit, complain, and replace the exit status."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _print_warning(message: Warning | str, *_: object, **__: object) -> None:
    complain(f"warning: {message}")
