"""The few errors that a user can meet. Not knowing is no error: it is the relation UNDECIDED.

An echo of any input is short and printable: see `short` and `enumeration`.
"""

from collections.abc import Iterable
from itertools import islice
from types import UnionType
from typing import TypeVar

T = TypeVar("T")

LONGEST_ECHO = 60  # characters of one thing that is echoed
MOST_LISTED = 30  # of many
LONGEST_MESSAGE = 1500  # whatever a message is made of


class DistingError(Exception):
    """Base of every error that this package raises on purpose; the message names the cause and
    the remedy. `detail`: lines to show below it, such as a table.

    >>> str(DistingError("no such thing; name another one"))
    'no such thing; name another one'
    """

    def __init__(self, message: object = "", detail: str = "") -> None:
        super().__init__(brief(str(message)))
        self.detail = printable(detail)


class ConstraintViolation(DistingError):
    """A chain that breaks one of the constraints (36) or (37): no model of the class.

    >>> from disting import Chain
    >>> Chain(2, gap=2)
    Traceback (most recent call last):
    disting.errors.ConstraintViolation: ...
    """


class InputError(DistingError):
    """An argument that cannot be understood, such as a model reference that does not exist.

    >>> from disting import compare
    >>> compare("3:1", "3:99")
    Traceback (most recent call last):
    disting.errors.InputError: ...
    """


class CatalogError(DistingError):
    """A catalogue file that is missing, damaged or written by another schema.

    >>> issubclass(CatalogError, DistingError)  # one `except DistingError` catches all of them
    True
    """


class ContradictionError(DistingError):
    """Two conditions decided one pair differently: a defect of the program, never of the input.

    >>> issubclass(ContradictionError, InputError)
    False
    """


class NotSeenError(DistingError):
    """Evidence that takes more work to recompute than allowed: the message names what was not
    found.
    """


def short(value: object) -> str:
    """Short form of a user's value, as Python writes it.

    >>> short("a" * 99), short(10**9999), short("a\\x1b[2J")
    ("'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…'", 'a number of 33216 bits', "'a\\\\x1b[2J'")
    """
    if isinstance(value, str):
        return _cut(repr(value[:LONGEST_ECHO]), len(value) > LONGEST_ECHO)
    if isinstance(value, int) and value.bit_length() > 200:
        return f"a number of {value.bit_length()} bits"
    return _cut(printable(" ".join(repr(value).split())), False)  # of a matrix on one line


def of_type(value: T, kind: type | UnionType | tuple[type, ...], wanted: str) -> T:
    """The value; raises InputError, which states what is expected, where it is of another type.

    >>> of_type(3, str, "a name is a text")
    Traceback (most recent call last):
    disting.errors.InputError: a name is a text, not 3
    """
    if not isinstance(value, kind):
        raise InputError(f"{wanted}, not {short(value)}")
    return value


def enumeration(names: Iterable[str], separator: str = ", ") -> str:
    """Names in a row, the first of them if there are many.

    >>> enumeration(map(str, range(10**6)))[-30:]
    '26, 27, 28, 29 and 999970 more'
    """
    rest = iter(names)
    first = [
        name if len(name) <= LONGEST_ECHO else f"{name[: LONGEST_ECHO // 2]}…"
        for name in islice(rest, MOST_LISTED)
    ]
    more = sum(1 for _ in rest)
    return printable(separator.join(first)) + (f" and {more} more" if more else "")


def in_row(names: Iterable[str]) -> str:
    """All names in a row; with a bar between where they have commas themselves, as networks do.

    >>> in_row(["3:1", "3:4"]), in_row(["R0-C1", "p(R0,C1)"])
    ('3:1, 3:4', 'R0-C1 | p(R0,C1)')
    """
    every = list(names)
    return (" | " if any(set(",;") & set(name) for name in every) else ", ").join(every)


def printable(text: str) -> str:
    """The text with what is no printable character, nor the end of a line, written as an escape.

    >>> printable("a\\x00ü\\n")
    'a\\\\x00ü\\n'
    """
    return "".join(c if c.isprintable() or c == "\n" else repr(c)[1:-1] for c in text)


def brief(message: str) -> str:
    """A message that fits a screen: printable, beginning and end of one that is too long."""
    if len(message) > LONGEST_MESSAGE:
        message = f"{message[: LONGEST_MESSAGE // 2]} … {message[-LONGEST_MESSAGE // 2 :]}"
    return printable(message)


def _cut(written: str, is_part: bool) -> str:
    if len(written) <= LONGEST_ECHO + 2 and not is_part:
        return written
    return f"{written[: LONGEST_ECHO // 2 + 1]}…{written[0] if is_part else ''}"
