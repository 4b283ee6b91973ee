"""The structures that the data do not exclude, as the page shows them: drawn, with intervals,
links and commands.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from disting.fit.members import Member, Twin
from disting.fit.select import Selection
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.report.drawing import draw
from disting.report.fit.onward import Link, Site, Step, step_to, steps_of
from disting.report.fit.table_rows import Row, intervals
from disting.report.scene import PAGE_PALETTE
from disting.report.svg import body, number


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
    the same, what comes next.
    """

    member: Member
    drawing: Markup
    page: Link | None
    parameters: Sequence[Row]
    same: Sequence[Same]
    steps: Sequence[Step]


def shown_set(selection: Selection, measured: FrequencyResponse, site: Site | None) -> list[Shown]:
    """The structures that the data do not exclude, each with those that behave as it does."""
    return [
        Shown(
            m,
            drawing(m.candidate.chain),
            site.page(m.candidate.chain) if site else None,
            intervals(m, measured),
            [
                Same(t, drawing(t.chain), site.page(t.chain) if site else None, step_to(m, t))
                for t in m.twins
            ],
            steps_of(selection, m),
        )
        for m in selection.members
    ]


def drawing(chain: Chain) -> Markup:
    """The chain as an engineer sketches it."""
    scene = draw(chain)
    box = f"0 0 {number(scene.width)} {number(scene.height)}"
    return Markup(
        '<svg class="chain" width="{}" viewBox="{}" role="img" aria-label="{}">{}</svg>'
    ).format(number(1.4 * scene.width), box, scene.title, Markup(body(scene, PAGE_PALETTE)))
