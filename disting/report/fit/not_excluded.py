"""The structures that the data do not exclude, as the page shows them: drawn, with intervals,
links and commands.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from disting.fit.judge.members import Member, Twin
from disting.fit.results.selection import Selection
from disting.measurement import FrequencyResponse
from disting.report.drawing import draw
from disting.report.fit.onward import Link, Site, Step, step_to, steps_of
from disting.report.fit.responses import drawing, fits_of, seen_together
from disting.report.fit.table_rows import Row, intervals


@dataclass(frozen=True, slots=True)
class Same:
    """A structure that behaves as one of the set does: its drawing, its page in the catalogue,
    how to compare both.
    """

    twin: Twin
    drawing: Markup
    page: Link | None
    step: Step


@dataclass(frozen=True, slots=True)
class Shown:
    """A structure of the set: its drawing, its page in the catalogue, parameters, what behaves
    the same, what comes next; where there are several responses, how much it reproduces of each.
    """

    member: Member
    drawing: Markup
    page: Link | None
    parameters: Sequence[Row]
    same: Sequence[Same]
    steps: Sequence[Step]
    fits: Sequence[tuple[str, str]]


def shown_set(selection: Selection, measured: FrequencyResponse, site: Site | None) -> list[Shown]:
    """The structures that the data do not exclude, each with those that behave as it does."""
    return [
        Shown(
            m,
            drawing(seen_together(m.candidate.chain, selection)),
            site.page(m.candidate.chain) if site else None,
            intervals(m, measured),
            [
                Same(t, drawing(draw(t.chain)), site.page(t.chain) if site else None, step_to(m, t))
                for t in m.twins
            ],
            steps_of(selection, m),
            fits_of(selection, m.candidate),
        )
        for m in selection.members
    ]
