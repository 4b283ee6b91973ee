"""Numbers in columns from text: any delimiter, decimal point or comma, comments, one header or
none.

The delimiter and the decimal sign are those of the first pair below that reads the most lines as
numbers; so "1,5;2,5" has decimal commas, "1,5" alone two columns, "1,5 2,5" decimal commas again.
"""

import re
from array import array
from collections import Counter
from collections.abc import Iterable

import numpy as np

from disting.errors import InputError, short
from disting.measurement.checks import FEWEST
from disting.measurement.column_words import Role, meaning, omega_per
from disting.measurement.table import Table

DIALECTS = ((";", "."), (";", ","), ("\t", "."), ("\t", ","), (",", "."), (" ", "."), (" ", ","))
MOST_QUANTITIES = 7  # lines of a table that has one for each quantity: fewer than a response has
SAMPLE = 60  # lines from the end by which the dialect is chosen: a header is at the beginning
# No two parts can match the same digits, so that a cell of many digits is read in linear time.
NUMBER = re.compile(
    r"[+-]?(\d+(\.\d*)?|\.\d+)([eEdD][+-]?\d+)?|[+-]?(nan|inf|infinity)", re.IGNORECASE | re.ASCII
)
SWAPPED = str.maketrans(",.", ".,")
BRACKET = re.compile(r"\s*\([^()]*\)\s*$")


def decode(content: bytes, origin: str) -> str:
    """Text of a file: UTF-8, UTF-16 with its mark, else Latin 1; raises InputError for what is
    no text.
    """
    for encoding in (
        ("utf-16",) if content[:2] in (b"\xff\xfe", b"\xfe\xff") else ("utf-8-sig", "latin-1")
    ):
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text
    raise InputError(
        f"{origin} is no text file; MATLAB files end in .mat, universal files in .uff or .unv"
    )


def table(text: str, origin: str) -> Table:
    """The table in a text; raises InputError with line and column of the first mistake."""
    numbers, rows, comments = array("q"), list[str](), list[str]()
    for n, whole in enumerate(re.split(r"\r\n|\n|\r", text), 1):
        line = whole.strip("\r\n ")
        if line[:1] in ("#", "%"):
            comments.append(line.lstrip("#% "))
        elif line.strip():
            numbers.append(n)
            rows.append(line)
    if 1 < len(rows) <= MOST_QUANTITIES:
        turned = _transpose(rows, origin, tuple(comments))
        if turned is not None:
            return turned
    delimiter, decimal = _dialect(rows, origin)
    width = _width(rows, delimiter, decimal)
    # the cells of all lines at once would take twenty times the file
    split = ((n, _fields(line, delimiter)) for n, line in zip(numbers, rows, strict=True))
    start = _first_row(split, decimal, width, origin)
    before = [_fields(line, delimiter) for line in rows[:start]]
    headers = _headers(before, comments, delimiter, width)
    cells = array("d")
    for n, line in zip(numbers[start:], rows[start:], strict=True):
        cells.extend(_numbers(n, _fields(line, delimiter), headers, decimal, origin))
    return Table(
        headers=headers,
        values=np.frombuffer(cells, dtype=np.float64).reshape(-1, width),
        lines=tuple(numbers[start:]),
        comments=(*comments, *(" ".join(fields) for fields in before)),
        origin=origin,
    )


def _transpose(lines: list[str], origin: str, comments: tuple[str, ...]) -> Table | None:
    """The table of a few long lines, one for each quantity, the first of them rising or falling
    frequencies; each may begin with its name. None for any other.
    """
    for named in (0, 1):
        for delimiter, decimal in DIALECTS:
            split = [_fields(line, delimiter) for line in lines]
            cells = [fields[named:] for fields in split]
            width = len(cells[0])
            whole = all(
                len(row) == width >= FEWEST and _count(row, decimal) == width for row in cells
            )
            headers = tuple(fields[0] if named else "" for fields in split)
            if not whole or (named and any(_count([h], decimal) for h in headers)):
                continue
            values = np.array([_plain_numbers(row, decimal) for row in cells]).T
            steps = np.diff(values[:, 0])
            if np.all(values[:, 0] > 0) and (np.all(steps > 0) or np.all(steps < 0)):
                lines_of = tuple(range(1, width + 1))
                return Table(headers, values, lines_of, comments, origin, transposed=True)
    return None


def _plain_numbers(fields: list[str], decimal: str) -> list[float]:
    return [float(re.sub("[dD]", "e", _with_point(field, decimal))) for field in fields]


def _dialect(lines: list[str], origin: str) -> tuple[str, str]:
    def readable(dialect: tuple[str, str]) -> float:
        """Number of the last lines that consist of numbers only, more than one, under this dialect;
        between blanks a tab counts against it.

        A line of a file with tabs that lacks a cell must not make it one with blanks, where two
        tabs are as good as one.
        """
        delimiter, decimal = dialect
        sample = [(line, _fields(line, delimiter)) for line in lines[-SAMPLE:]]
        good = [
            line
            for line, parts in sample
            if len(parts) > 1 and _count(parts, decimal) == len(parts)
        ]
        return sum(0.5 if delimiter == " " and "\t" in line else 1.0 for line in good)

    best = max(DIALECTS, key=readable, default=DIALECTS[0])
    if not lines or not readable(best):
        raise InputError(
            f"{origin} holds no columns of numbers separated by comma, semicolon, tab or blanks:"
            " save the measurement as CSV"
        )
    return best


def _fields(line: str, delimiter: str) -> list[str]:
    """Fields without blanks and quotation marks; one delimiter at the end of a line closes it
    and opens no field.
    """
    parts = line.split() if delimiter == " " else line.split(delimiter)
    fields = [part.strip().strip('"') for part in parts]
    return fields[:-1] if len(fields) > 1 and not fields[-1] else fields


def _count(fields: list[str], decimal: str) -> int:
    """Number of fields that are numbers."""
    return sum(NUMBER.fullmatch(_with_point(field, decimal)) is not None for field in fields)


def _with_point(field: str, decimal: str) -> str:
    """A field of the file's decimal sign as one with a point; the other sign makes it no
    number, for it may mean thousands.
    """
    return field.translate(SWAPPED) if decimal == "," else field


def _width(rows: list[str], delimiter: str, decimal: str) -> int:
    """Most frequent number of columns."""
    split = (_fields(line, delimiter) for line in rows)
    whole = Counter(len(fields) for fields in split if _count(fields, decimal) == len(fields))
    return whole.most_common(1)[0][0]


def _first_row(
    split: Iterable[tuple[int, list[str]]], decimal: str, width: int, origin: str
) -> int:
    """Number of lines before the data; one that is partly numbers is damaged data, if it is of
    full width or below a header.
    """
    below_header = False
    for at, (n, fields) in enumerate(split):
        numbers = _count(fields, decimal)
        if len(fields) == width and numbers == width:
            return at
        if len(fields) != width and numbers and (below_header or numbers == len(fields) > 1):
            raise InputError(
                f"{origin}, line {n}: {len(fields)} columns where the others have {width}"
            )
        below_header |= len(fields) == width and not numbers
        if len(fields) == width and numbers:
            wrong = next(i for i, f in enumerate(fields, 1) if not _count([f], decimal))
            raise InputError(
                f"{origin}, line {n}, column {wrong}: {short(fields[wrong - 1])} is no number"
            )
    raise InputError(f"{origin} holds no line of {width} numbers")


def _headers(
    before: list[list[str]], comments: list[str], delimiter: str, width: int
) -> tuple[str, ...]:
    """Header lines (names, units) joined column by column; else the last comment that is a
    header; else nothing.
    """
    stacked = [fields for fields in before if len(fields) == width]
    if len(stacked) > 1 and any(omega_per(field) is not None for field in stacked[-1]):
        stacked[-1] = [f"[{field}]" if field else "" for field in stacked[-1]]  # a line of units
    if stacked:
        return tuple(" ".join(filter(None, words)) for words in zip(*stacked, strict=True))
    for comment in reversed(comments):
        for text in (comment, BRACKET.sub("", comment)):
            for mark in dict.fromkeys((delimiter, ",", ";", "\t", " ")):
                fields = _fields(text, mark)
                if len(fields) == width and _is_header(fields, mark == delimiter != " "):
                    return tuple(fields)
    return ("",) * width


def _is_header(fields: list[str], delimited: bool) -> bool:
    """Return True if the parts of a comment name columns: no numbers, and the delimiter of the data
    or the word frequency.
    """
    return not _count(fields, ".") and (
        delimited or any(meaning(field).role is Role.FREQUENCY for field in fields)
    )


def _numbers(
    n: int, fields: list[str], headers: tuple[str, ...], decimal: str, origin: str
) -> list[float]:
    if len(fields) != len(headers):
        raise InputError(
            f"{origin}, line {n}: {len(fields)} columns where the others have {len(headers)}"
        )
    numbers = []
    for column, field in enumerate(fields, 1):
        text = _with_point(field, decimal)
        if not NUMBER.fullmatch(text):
            named = f" ({headers[column - 1]})" if headers[column - 1] else ""
            raise InputError(
                f"{origin}, line {n}, column {column}{named}: {short(field)} is no number"
            )
        numbers.append(float(re.sub("[dD]", "e", text)))
    return numbers
