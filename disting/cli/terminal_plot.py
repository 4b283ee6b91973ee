"""Plots of plain characters for a terminal or a pipe: eight dots to a character by braille signs,
or two to a character where only ASCII can be written.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]
DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))  # of a braille sign, by row, column
BRAILLE = 0x2800
LABEL = 10  # characters left of an axis


@dataclass(frozen=True, slots=True)
class Signs:
    """Characters of axes, and whether dots are braille."""

    tick: str
    side: str
    corner: str
    line: str
    is_braille: bool


UNICODE = Signs("┤", "│", "└", "─", True)
ASCII = Signs("+", "|", "+", "-", False)


def signs_of(encoding: str) -> Signs:
    """Return the signs that an encoding can write.

    >>> signs_of("utf-8").is_braille, signs_of("ascii").is_braille
    (True, False)
    """
    try:
        f"{chr(BRAILLE)}{UNICODE.tick}{UNICODE.line}".encode(encoding)
    except (UnicodeEncodeError, LookupError):
        return ASCII
    return UNICODE


def bode_lines(
    hertz: Values, response: NDArray[np.complex128], width: int, signs: Signs, unit: str
) -> Iterator[str]:
    """Return the lines of a Bode diagram of `width` characters; `hertz`, `response`: shape (n,)."""
    room = width - LABEL - 1
    size, phase = np.abs(response), np.degrees(np.unwrap(np.angle(response)))
    x = np.log(hertz)
    yield f"amplitude{f' [{unit}]' if unit else ''}"
    ends = [
        f"{size.max():.3g}",
        f"{np.sqrt(size.max()) * np.sqrt(size.min()):.3g}",
        f"{size.min():.3g}",
    ]
    yield from _frame_rows(curve(x, np.log(size), room, 9, signs), ends, signs)
    yield "phase [deg]"
    middle = (phase.max() + phase.min()) / 2
    ends = [f"{phase.max():.0f}", f"{middle:.0f}", f"{phase.min():.0f}"]
    yield from _frame_rows(curve(x, phase, room, 5, signs), ends, signs)
    marks = [f"{hertz[0]:.4g} Hz", f"{np.sqrt(hertz[0] * hertz[-1]):.4g}", f"{hertz[-1]:.4g} Hz"]
    yield from _below(marks, room)


def nyquist_lines(
    response: NDArray[np.complex128], width: int, signs: Signs, unit: str
) -> Iterator[str]:
    """Return the lines of a Nyquist diagram, -Im over Re, both at one scale."""
    room, height = width - LABEL - 1, 14
    real, down = response.real, -response.imag
    # a character is about twice as high as it is wide
    span = max(np.ptp(real) / (2 * room), np.ptp(down) / (4 * height), np.finfo(float).tiny)
    across = (real.min() + real.max()) / 2 + span * room * np.array([-1, 1])
    up = (down.min() + down.max()) / 2 + 2 * span * height * np.array([-1, 1])
    yield f"-Im over Re{f' [{unit}]' if unit else ''}"
    rows = curve(real, down, room, height, signs, (*across, *up))
    ends = [f"{up[1]:.3g}", f"{up.mean():.3g}", f"{up[0]:.3g}"]
    yield from _frame_rows(rows, ends, signs)
    yield from _below([f"{across[0]:.4g}", f"{across.mean():.4g}", f"{across[1]:.4g}"], room)


def curve(
    x: Values,
    y: Values,
    width: int,
    height: int,
    signs: Signs = UNICODE,
    box: tuple[float, float, float, float] | None = None,
) -> list[str]:
    """Return `height` rows of `width` characters with a line through the points, shape (n,) each;
    `box`: the left, right, lower and upper edge, by default those of the points.

    >>> curve(np.arange(8.0), np.zeros(8), 4, 1), curve(np.arange(4.0), np.arange(4.0), 2, 1)
    (['⠒⠒⠒⠒'], ['⡠⠊'])
    """
    left, right, low, high = box or (x.min(), x.max(), y.min(), y.max())
    across = _places(x, left, right, 2 * width)
    down = 4 * height - 1 - _places(y, low, high, 4 * height)
    dots = np.zeros((4 * height, 2 * width), dtype=np.bool_)
    dots[down[-1], across[-1]] = True
    for i in range(len(x) - 1):
        steps = max(abs(across[i + 1] - across[i]), abs(down[i + 1] - down[i]), 1)
        along = np.linspace(0, 1, int(steps) + 1)
        rows = np.rint(down[i] + along * (down[i + 1] - down[i])).astype(int)
        columns = np.rint(across[i] + along * (across[i + 1] - across[i])).astype(int)
        dots[rows, columns] = True
    cells = dots.reshape(height, 4, width, 2).swapaxes(1, 2)
    return ["".join(_sign(cell, signs) for cell in row) for row in cells]


def _places(values: Values, low: float, high: float, count: int) -> NDArray[np.intp]:
    """Numbers of dots, 0 .. count - 1; the middle where there is no range."""
    share = (values - low) / (high - low) if high > low else np.full(len(values), 0.5)
    return np.clip(np.rint(share * (count - 1)), 0, count - 1).astype(np.intp)


def _sign(cell: NDArray[np.bool_], signs: Signs) -> str:
    """Character of 4 x 2 dots."""
    if not cell.any():
        return " "
    if signs.is_braille:
        return chr(BRAILLE + int(np.sum(np.array(DOTS)[cell])))
    upper, lower = cell[:2].any(), cell[2:].any()
    return ":" if upper and lower else "'" if upper else "."


def _frame_rows(rows: list[str], ends: list[str], signs: Signs) -> Iterator[str]:
    """Rows with the labels of the upper end, the middle and the lower end, and an axis below."""
    labels = {0: ends[0], len(rows) // 2: ends[1], len(rows) - 1: ends[2]}
    for i, row in enumerate(rows):
        edge = signs.tick if i in labels else signs.side
        yield f"{labels.get(i, ''):>{LABEL - 1}} {edge}{row}".rstrip()
    yield f"{'':{LABEL}}{signs.corner}{signs.line * len(rows[0])}"


def _below(marks: list[str], room: int) -> Iterator[str]:
    """Labels of the left end, the middle and the right end."""
    left, middle, right = marks
    row = left + middle.center(room - 2 * max(len(left), len(right))).rjust(
        room - max(len(left), len(right)) - len(left)
    )
    yield f"{'':{LABEL + 1}}{row}{right:>{room - len(row)}}"
