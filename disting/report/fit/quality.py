"""The first line of a fit: the quality of the data."""

from collections.abc import Iterator

from disting.fit.results.selection import Selection
from disting.report.fit.doubts import (
    amplitude,
    closed_loops,
    distorts,
    doubtful_deviations,
    same_data_twice,
)
from disting.report.fit.words import percent


def quality_line(selection: Selection) -> str:
    """Return how many lines there are, how much they scatter or the machine distorts, and what to
    bear in mind.
    """
    scatter = selection.explanation.scatter
    noise = f"noise {percent(scatter.typical)} (from {scatter.source})"
    remarks = [*([] if distorts(selection) else [noise]), *quality_remarks(selection)]
    return f"{_lines(selection)}, {'; '.join(remarks)}"


def quality_remarks(selection: Selection) -> Iterator[str]:
    """Yield what is wrong with the data, as far as it changes the use of the values."""
    yield from amplitude(selection)
    yield from closed_loops(selection)
    yield from same_data_twice(selection)
    yield from doubtful_deviations(selection)


def _lines(selection: Selection) -> str:
    parts = [part.measured for part in selection.task.cost.parts]
    sizes = " + ".join(str(len(part)) for part in parts)
    of = f" of {len(parts)} responses" if len(parts) > 1 else ""
    low = min(part.frequency[0] for part in parts)
    high = max(part.frequency[-1] for part in parts)
    return f"{sizes} lines{of} from {low:.4g} to {high:.4g} Hz"
