"""Columns of numbers with headers, from a text file or a data frame."""

from dataclasses import dataclass

import numpy as np

from disting.errors import InputError, listed, shown
from disting.measurement.arrays import Real


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Columns of numbers, shape (rows, columns), their headers ("" without one), the line
    number of each row, the comments; `transposed`: the file has a line for each column.
    """

    headers: tuple[str, ...]
    values: Real
    lines: tuple[int, ...]
    comments: tuple[str, ...]
    origin: str
    transposed: bool = False

    def column(self, at: int) -> Real:
        """Numbers of column `at` (from 0); raises InputError naming the line of one that is not
        finite.
        """
        values = self.values[:, at]
        if not np.all(np.isfinite(values)):
            line = self.lines[int(np.argmin(np.isfinite(values)))]
            raise InputError(
                f"{self.origin}, line {line}, {self.named(at)}: the value is not finite; remove the"
                " line"
            )
        return np.asarray(values)

    def at(self, column: str | int) -> int:
        """Number, from 0, of a column named by its header or by its number from 1; raises
        InputError listing the headers.
        """
        if (
            isinstance(column, int)
            and not isinstance(column, bool)
            and 1 <= column <= len(self.headers)
        ):
            return column - 1
        found = [
            i
            for i, h in enumerate(self.headers)
            if isinstance(column, str) and h and h == column.strip()
        ]
        if not found and isinstance(column, str) and column.isdecimal():
            return self.at(int(column))
        if len(found) != 1:
            raise InputError(
                f"{self.origin}: {len(found) or 'no'} columns are called {shown(column)}; headers:"
                f" {self.listed()}"
            )
        return found[0]

    def named(self, at: int) -> str:
        """Number from 1 and header of a column, for messages."""
        return f"column {at + 1} ({self.headers[at]})" if self.headers[at] else f"column {at + 1}"

    def listed(self) -> str:
        """All headers, for messages."""
        return listed(h or f"(column {i})" for i, h in enumerate(self.headers, 1))
