"""Completion of commands, options, choices and models by TAB, with argcomplete; a shell asks for it
by an environment variable, see `disting.cli.run`.
"""

import argparse
import re
from collections.abc import Iterator

from disting.model.family import Family

SIZES = range(1, 9)  # that are offered: of 9 masses there are a thousand models
MODELS = re.compile(r"\b[NM]:[IJ]\b")  # in what an argument is called


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
    known = Family(int(match[1])) if int(match[1] or 0) in SIZES else ()
    names = (f"{match[1]}:{i}" for i in range(1, len(known) + 1))
    return [name for name in names if name.startswith(prefix)]


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    for action in parser._actions:
        yield action
        if isinstance(action, argparse._SubParsersAction):
            for inner in dict.fromkeys(action.choices.values()):
                yield from _actions(inner)
