"""The reference of the command line, read off its grammar."""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass

from markupsafe import Markup

from disting.report.environment import render
from disting.report.markdown import GuidePage, Section

NAME, TITLE = "commands", "All commands and options"


@dataclass(frozen=True, slots=True)
class Option:
    """An argument or an option: its notation, its help, its possible values and its default."""

    anchor: str
    written: tuple[str, ...]
    text: str
    choices: tuple[str, ...]
    default: str


@dataclass(frozen=True, slots=True)
class Command:
    """A command: its words, such as "catalog build", what it does, how it is called."""

    words: str
    text: str
    usage: str
    options: tuple[Option, ...]
    ending: str = ""

    @property
    def anchor(self) -> str:
        """Anchor of its section."""
        return self.words.replace(" ", "-")


def command_page(parser: argparse.ArgumentParser) -> GuidePage:
    """The page of all commands of a parser."""
    the_commands = list(commands(parser))
    body = Markup(render("commands.html", commands=the_commands))
    return GuidePage(NAME, TITLE, (Section("", TITLE, 1), *_sections(the_commands)), body, True)


def commands(parser: argparse.ArgumentParser, words: str = "disting") -> Iterator[Command]:
    """The command of a parser, then those of its sub-commands.

    >>> parser = argparse.ArgumentParser(description="Adds.")
    >>> _ = parser.add_argument("--old", help=argparse.SUPPRESS)
    >>> _ = parser.add_argument("--by", type=int, default=2, metavar="N", help="so much")
    >>> (found,) = commands(parser, "add")
    >>> found.usage, found.options[0].anchor, found.options[0].default
    ('add [--by N]', 'add--by', '2')
    """
    inner = [a for a in parser._actions if isinstance(a, argparse._SubParsersAction)]
    actions = [a for a in parser._actions if a.help != argparse.SUPPRESS]
    own = [a for a in actions if a not in inner and not isinstance(a, argparse._HelpAction)]
    usage = " ".join(
        [words, *(_place(a) for a in own if _keeps_action(a)), *(str(a.metavar) for a in inner)]
    )
    options = tuple(_option(a, words, parser) for a in own)
    yield Command(words, parser.description or "", usage, options, parser.epilog or "")
    for action in inner:
        for name, child in action.choices.items():
            yield from commands(child, f"{words} {name}")


def _option(action: argparse.Action, words: str, parser: argparse.ArgumentParser) -> Option:
    name = max(action.option_strings, key=len) if action.option_strings else _value(action)
    text = (action.help or "") % {**vars(action), "prog": words} if action.help else ""
    written = tuple(
        f"{flag} {_value(action)}" if _takes(action) else flag for flag in action.option_strings
    )
    default = "" if "default" in text else _default(action)
    return Option(
        f"{words.replace(' ', '-')}{name if name.startswith('-') else '-' + name}".replace(
            "|", "-"
        ),
        written or (_value(action),),
        text,
        tuple(map(str, action.choices or ())),
        default,
    )


def _default(action: argparse.Action) -> str:
    if action.default in (None, False, True, "", argparse.SUPPRESS) or action.default == []:
        return ""
    if not _takes(action):
        return ""
    return (
        ",".join(map(str, action.default))
        if isinstance(action.default, list | tuple)
        else str(action.default)
    )


def _takes(action: argparse.Action) -> bool:
    """Return True if a value follows."""
    return action.nargs != 0


def _value(action: argparse.Action) -> str:
    """Notation of the value; for choices, the choices themselves."""
    if action.metavar is not None:
        return str(action.metavar)
    if action.choices:
        return "|".join(map(str, action.choices))
    return action.dest.upper() if action.option_strings else action.dest


def _keeps_action(action: argparse.Action) -> bool:
    return not isinstance(action, argparse._VersionAction)


def _place(action: argparse.Action) -> str:
    """Notation of an argument in a call."""
    if not action.option_strings:
        value = _value(action)
        return {"*": f"[{value} ...]", "+": f"{value} [...]", "?": f"[{value}]"}.get(
            str(action.nargs), value
        )
    name = max(action.option_strings, key=len)
    written = f"{name} {_value(action)}" if _takes(action) else name
    return written if action.required else f"[{written}]"


def _sections(the_commands: list[Command]) -> Iterator[Section]:
    for command in the_commands:
        yield Section(command.anchor, command.words, 2, command.text)
        for option in command.options:
            title = f"{command.words} {', '.join(option.written)}"
            yield Section(option.anchor, title, 3, option.text)
