"""A frequency response as CSV that reads back bit by bit: frequencies in rad/s, numbers with
all their digits.
"""

import re
from collections.abc import Iterator
from pathlib import Path

from disting.errors import InputError
from disting.files import write_whole
from disting.measurement.response import FrequencyResponse, Signal
from disting.measurement.tabular import ESCAPED, MARK

FORMULA = re.compile(
    rf"(?<=[,;])[=+@-]|(?<=[,;] )[=+@-]|{ESCAPED.pattern[:2]}(?={ESCAPED.pattern[2:]})"
)


def csv_text(response: FrequencyResponse) -> str:
    """Comment lines with sensor, signals and origin; a header; one line a frequency.

    >>> from disting.measurement import from_arrays
    >>> csv_text(from_arrays(range(1, 9), [1j, 2j] * 4, sensor="velocity")).splitlines()[1]
    '# sensor: velocity'
    """
    return "\n".join([*_head(response), *_rows(response), ""])


def write_csv(response: FrequencyResponse, path: str | Path) -> None:
    """Write `csv_text` to a file; `read` gives an equal response. Raises InputError where the
    file cannot be written.

    >>> from tempfile import TemporaryDirectory
    >>> from disting.measurement import from_arrays, read
    >>> data = from_arrays(range(1, 9), [1j, 2j] * 4)
    >>> with TemporaryDirectory() as folder:
    ...     write_csv(data, Path(folder, "a.csv"))
    ...     bool((read(Path(folder, "a.csv")).G == data.G).all())
    True
    """
    try:
        write_whole(Path(path), [csv_text(response)])
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror}") from None


def _head(response: FrequencyResponse) -> Iterator[str]:
    yield f"# {MARK}"
    yield f"# sensor: {response.sensor.value}"
    for role, signal in (("input", response.input), ("output", response.output)):
        yield from (
            f"# {role} {part}: {_line(text)}"
            for part, text in zip(Signal._fields, signal, strict=True)
            if text
        )
    if response.origin:
        yield f"# origin: {_line(response.origin)}"
    yield from (f"# note: {_line(note)}" for note in response.notes)


def _rows(response: FrequencyResponse) -> Iterator[str]:
    extra = [
        (name, c)
        for name, c in (("std", response.deviation), ("coherence", response.coherence))
        if c is not None
    ]
    yield ",".join(["omega [rad/s]", "Re G", "Im G", *(name for name, _ in extra)])
    columns = (response.omega, response.G.real, response.G.imag, *(column for _, column in extra))
    for numbers in zip(*(column.tolist() for column in columns), strict=True):
        yield ",".join(map(repr, numbers))


def _line(text: str) -> str:
    r"""A text of one line. Spreadsheets split comments too: what they would compute is written
    as \\u003d and the like.
    """
    return FORMULA.sub(lambda sign: f"\\u{ord(sign[0]):04x}", " ".join(text.split()))
