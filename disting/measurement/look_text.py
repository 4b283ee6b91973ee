"""A measured file as it was read, in plain text: for a terminal, a prompt, a log."""

from collections.abc import Iterator, Sequence
from textwrap import wrap
from typing import TYPE_CHECKING

from disting.errors import printable
from disting.measurement.assumptions import assumed_quantity, assumptions, shows_impedance
from disting.measurement.column_words import Role, Why
from disting.measurement.excitation import Excitation
from disting.measurement.response import FrequencyResponse, Method
from disting.measurement.time_series import TimeSeries
from disting.measurement.understanding import ReadColumn
from disting.model.presentation import plural

if TYPE_CHECKING:
    from disting.measurement.looking import Look

WIDTH = 80
WIDEST, NARROWEST = 22, 8  # characters of a name or a unit
MOST = 12  # columns that are not used, of which more are only counted
LEAST = 16  # characters that a column of reasons keeps
HEADS = ("#", "name", "unit", "role", "quantity", "begins with", "why")
NUMBERS = HEADS.index("begins with")
STARTS = (Role.REAL, Role.GAIN)  # roles of the first columns of a response
UNKNOWN = "random (neither periodic nor a sweep)"
GAP = "  "


def look_lines(seen: "Look", width: int = WIDTH) -> Iterator[str]:
    """Return the lines of a table of columns and of all facts below it, each at most `width` wide
    where its words allow.
    """
    origin = seen.response.origin if seen.response is not None else seen.file
    yield printable(origin or seen.file)
    yield from column_table(seen, width)
    yield ""
    for name, text in fact_rows(seen):
        yield from _fold_row(name, text, width)


def short_lines(response: FrequencyResponse, shows: str = "") -> Iterator[str]:
    """Return two to four lines on a response: its file, columns, quantity and lines, assumptions.
    `shows`: its quantity, where the sensor does not give it, such as an impedance.

    >>> from disting.measurement import from_arrays
    >>> print(*short_lines(from_arrays(range(1, 9), [1j] * 8)), sep="\\n")
    arrays
    shows: acceleration; 8 lines from 1 to 8 Hz
    """
    if response.origin:
        yield printable(response.origin)
    if response.reading:
        yield f"columns: {printable(response.reading)}"
    shows = shows or ("impedance" if shows_impedance(response.columns, response) else "")
    yield f"shows: {shows or _sensor(response)}; {_lines(response)}"
    quantity = None if shows else assumed_quantity(response)
    assumed = [f"{a.what} (else {a.option})" for a in assumptions(response.columns, quantity)]
    if assumed:
        yield f"assumed: {'; '.join(assumed)}"


def column_table(seen: "Look", width: int) -> Iterator[str]:
    """Return the table of columns: those that are used, and the others up to a number; nothing of
    what is in no file.
    """
    if not seen.columns:
        return
    used = [column for column in seen.columns if column.is_used]
    others = [column for column in seen.columns if not column.is_used]
    shown = sorted([*used, *others[:MOST]], key=lambda column: column.number)
    widest = max(WIDEST - max(WIDTH - width, 0), NARROWEST)
    rows = [HEADS, *(_row(seen, column, widest) for column in shown)]
    wide = list(_align_rows(rows, width))
    without = [tuple("" if i == NUMBERS else cell for i, cell in enumerate(row)) for row in rows]
    fits = max(map(len, wide)) <= width and len(wide) == len(rows)
    yield from wide if fits else _align_rows(without, width)
    if len(others) > MOST:
        yield f"and {len(others) - MOST} more that are not used"


def _row(seen: "Look", column: ReadColumn, widest: int) -> tuple[str, ...]:
    return (
        str(column.number or ""),
        _cut(printable(column.name) or "-", widest),
        _cut(printable(column.unit), widest),
        column.role.value if column.is_used else "not used",
        seen.quantity_of(column),
        ", ".join(f"{value:.5g}" for value in column.values),
        seen.reason(column),
    )


def _align_rows(rows: Sequence[Sequence[str]], width: int) -> Iterator[str]:
    """Rows with columns of one width; empty columns are left out, the last one is folded."""
    kept = [i for i in range(len(rows[0])) if any(row[i] for row in rows[1:])]
    cells = [[row[i] for i in kept] for row in rows]
    widths = [max(len(row[i]) for row in cells) for i in range(len(kept) - 1)]
    margin = sum(widths) + len(GAP) * len(widths)
    for row in cells:
        first = GAP.join(cell.ljust(size) for cell, size in zip(row, widths, strict=False))
        folded = wrap(row[-1], max(width - margin, LEAST)) or [""]
        yield f"{first}{GAP}{folded[0]}".rstrip()
        yield from (" " * margin + rest for rest in folded[1:])


def fact_rows(seen: "Look") -> Iterator[tuple[str, str]]:
    """Name and sentence of each fact."""
    response, record = seen.response, seen.record
    if record is not None:
        yield "record", _record(record, response.method if response is not None else None)
    if seen.excitation is not None:
        excited = seen.excitation
        count = f", {plural(excited.lines, 'line')}" if excited.lines else ""
        kind = UNKNOWN if excited.kind is Excitation.RANDOM else excited.kind.value
        yield "excitation", f"{kind}{count}, {excited.low:.4g} to {excited.high:.4g} Hz"
    others = [c for c in seen.columns if c.why is Why.ELSEWHERE and c.role in STARTS]
    if others:
        places = ", ".join(f"{c.place} ({c.name})" for c in others[:MOST])
        yield "other responses", f"{places}; --column {others[0].number} reads this one"
    if response is not None:
        shows = "an impedance" if seen.is_impedance else _sensor(response)
        yield "response", f"{shows}; {_lines(response)}"
    if seen.scatter is not None:
        yield "scatter", f"{100 * seen.scatter.median:.2g} % (median), from {seen.scatter.source}"
    if seen.distortion:
        each = (f"{kind} {100 * share:.2g} %" for kind, share in seen.distortion.items())
        yield "distortion", f"{', '.join(each)} of the response (medians)"
    if response is not None and response.loop is not None and not response.is_biased_by_loop:
        yield "loop", response.loop_sentence
    yield from (("trend", trend) for trend in seen.trends)
    yield from (("assumed", str(assumption)) for assumption in seen.assumed)
    yield from (("note", note) for note in seen.notes)
    yield from (("doubt", doubt) for doubt in seen.doubts)


def _fold_row(name: str, text: str, width: int) -> Iterator[str]:
    yield from wrap(
        f"{name}: {printable(text)}",
        width,
        subsequent_indent="  ",
        break_long_words=False,
        break_on_hyphens=False,
    )


def _sensor(response: FrequencyResponse) -> str:
    """Quantity and unit of a response, with the quantity of the record that it comes from."""
    output, input = response.output.unit, response.input.unit
    unit = f" [{output} per {input}]" if output and input else ""
    taken = assumed_quantity(response)
    phrase = "" if taken is None else " (assumed)"
    if taken is not None and taken is not response.quantity:
        phrase = f", from a {taken} (assumed)"
    return f"{response.quantity}{unit}{phrase}"


def _lines(response: FrequencyResponse) -> str:
    low, high = response.frequency[0], response.frequency[-1]
    return f"{plural(len(response), 'line')} from {low:.4g} to {high:.4g} Hz"


def _record(record: TimeSeries, method: Method | None) -> str:
    seconds = len(record) / record.sampling_rate
    text = f"{plural(len(record), 'sample')} at {record.sampling_rate:.6g} Hz, {seconds:.4g} s"
    if method is None:
        return text
    if method.segment:
        return f"{text}; {method.segments} segments of {method.segment} samples (Welch's method)"
    dropped = f", {method.dropped} before dropped" if method.dropped else ""
    return f"{text}; {plural(method.periods, 'period')} of {method.period} samples{dropped}"


def _cut(text: str, widest: int) -> str:
    return text if len(text) <= widest else f"{text[: widest - 1]}…"
