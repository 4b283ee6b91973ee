"""Runs one command and turns every expected failure into one sentence and an exit status.

Completion of commands, options, choices and models by TAB, with argcomplete; a shell asks for it
by an environment variable, see `disting.cli.run`.
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
from typing import TextIO, cast

from disting.cli.output import Output, complain, say_what_can_be_said
from disting.cli.parser import parser
from disting.errors import DistingError, short
from disting.model.family import Family

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
        warnings.showwarning = _warned
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
        options = _parsed(arguments)
        work = options.command.work()
        with _heard():
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
        complain(f"interrupted{_kept(options)}")
        return 130
    finally:
        _drop_what_cannot_be_written()


def _kept(options: Namespace) -> str:
    """What there is to say of the cache, which is done without where somebody asks for that."""
    from disting.store.database_file import MEMORY, NOWHERE, locate

    without = getattr(options, "no_cache", False) or locate(None) in (NOWHERE, MEMORY)
    return "" if without else "; what was finished is kept in the cache"


def _parsed(arguments: Sequence[str] | None) -> Namespace:
    try:
        words = sys.argv[1:] if arguments is None else list(arguments)
        if words[:1] in ([], ["help"]):  # as people try first
            words = [*words[1:], "--help"]
        return parser(whole=False).parse_args(words, Namespace(words=words))
    except SystemExit:  # help was asked for, and must have been written
        sys.stdout.flush()
        raise


def _complete() -> int:
    from disting.cli.run import complete

    return complete(parser())


@contextmanager
def _heard() -> Iterator[None]:
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
    """Where Python would tell of an interrupt and go on, since it fell into a callback (there is
    one at the end of every import), the process ends at once.
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


def _warned(message: Warning | str, *_: object, **__: object) -> None:
    complain(f"warning: {message}")
