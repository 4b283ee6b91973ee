"""The figures of the paper from our own data, in its order; verdicts as triangles of fields, any
number of them side by side, as in Figs. 10, 11, 13 and 14.

A picture has its files (SVG, PNG, and PDF by matplotlib, one point a pixel; the same
scene gives the same bytes), and the element that stands in the page.

Fig. 12 shows the responses of A1 and of the fitted A4, and the damping ratios of their poles and
zeros side by side.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import combinations
from math import pi
from typing import TYPE_CHECKING

import numpy as np
from markupsafe import Markup

from disting import Catalog, Decisions, Family, Relation, View
from disting.catalogs.dampers import DamperTable, spell
from disting.export import predict
from disting.fit.judge.modes import physical
from disting.measurement.arrays import Complex
from disting.report.fit import bode, models_by_threshold, parameters_by_threshold
from disting.report.fit.style import (
    METADATA,
    SETTINGS,
    FigureFiles,
    Tone,
    degrees,
    draw_figure,
    heading,
    is_narrow,
    logarithmic,
)
from disting.report.fit.words import readable
from disting.report.matrix import (
    CORNERS,
    LETTERS,
    corner,
    field,
    legend,
    legend_entry,
    legend_width,
    sign,
)
from disting.report.png import png
from disting.report.scene import (
    FILE_PALETTE,
    PAGE_PALETTE,
    Anchor,
    Circle,
    Ink,
    Layer,
    Path,
    Rect,
    Scene,
    Shape,
    Text,
    body,
    number,
    svg,
)
from tests.paper.claims import Findings, Refit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SIGNS = {"antiresonance": "▽", "resonance": "△"}
GAP = 0.18  # between the two damping ratios of a mode, in rows


def refit_figure(refit: Refit) -> FigureFiles:
    """Both Bode curves; on the right frequency and damping of the four modes."""
    fitted = predict(refit.fitted, dict(refit.fitted_parameters), refit.measured.omega)

    def draw(figure: "Figure") -> None:
        """The Bode diagram, and the damping ratios beside it or, on a phone, below."""
        if is_narrow(figure):
            grid = figure.add_gridspec(3, 1, height_ratios=[2, 1.2, 1.9])
            places = (grid[0, 0], grid[1, 0], grid[2, 0])
        else:
            grid = figure.add_gridspec(2, 2, width_ratios=[1.9, 1], height_ratios=[2, 1.2])
            places = (grid[0, 0], grid[1, 0], grid[:, 1])
        top = figure.add_subplot(places[0])
        _amplitude(top, refit, fitted)
        _phase(figure.add_subplot(places[1], sharex=top), refit, fitted)
        _damping(figure.add_subplot(places[2]), refit)
        figure.legend(*top.get_legend_handles_labels(), loc="outside lower left", ncols=2)
        heading(figure, "The best A4 has the resonances of A1, but not their damping")

    said = "; ".join(
        f"{m.name}: damping {readable(m.damping[0])} and {readable(m.damping[1])}"
        for m in refit.modes
    )
    return draw_figure(
        "figure-12", f"Bode diagrams of A1 and of A4 fitted to it. {said}", (4.9, 7.6), draw
    )


def _amplitude(panel: "Axes", refit: Refit, fitted: Complex) -> None:
    hertz = refit.measured.omega / (2 * pi)
    panel.loglog(hertz, np.abs(refit.measured.G), color=Tone.FIRST, linewidth=2.2, label="A1")
    panel.loglog(
        hertz,
        np.abs(fitted),
        color=Tone.SECOND,
        linewidth=1.4,
        linestyle=(0, (5, 2)),
        label="A4, fitted to A1",
    )
    panel.set_xlim(float(hertz[0]), float(hertz[-1]))
    low, high = (float(f(np.abs([refit.measured.G, fitted]))) for f in (np.min, np.max))
    panel.set_ylim(low / 1.4, high * 1.4)
    logarithmic(panel.xaxis, float(hertz[0]), float(hertz[-1]))
    logarithmic(panel.yaxis, low / 1.4, high * 1.4)
    panel.set_ylabel("Amplitude [(m/s²)/N]")
    panel.tick_params(labelbottom=False)


def _phase(panel: "Axes", refit: Refit, fitted: Complex) -> None:
    hertz = refit.measured.omega / (2 * pi)
    for response, tone, dashes in (
        (refit.measured.G, Tone.FIRST, "-"),
        (fitted, Tone.SECOND, (0, (5, 2))),
    ):
        panel.semilogx(
            hertz,
            np.degrees(np.unwrap(np.angle(response))),
            color=tone,
            linewidth=1.6,
            linestyle=dashes,
        )
    logarithmic(panel.xaxis, float(hertz[0]), float(hertz[-1]))
    degrees(panel.yaxis, 180.0)
    panel.set_ylabel("Phase")
    panel.set_xlabel("Frequency [Hz]")


def _damping(panel: "Axes", refit: Refit) -> None:
    """A row a mode, a dot each for A1 and A4, joined by a line as long as the misfit."""
    rows = sorted(refit.modes, key=lambda m: m.frequencies[0])
    for row, mode in enumerate(rows):
        panel.plot(mode.damping, [row, row], color=Tone.MUTED, linewidth=1.2, zorder=2)
        panel.plot(mode.damping[0], row, "o", color=Tone.FIRST, ms=7, zorder=3)
        panel.plot(
            mode.damping[1], row, "s", mfc=Tone.PAPER, mec=Tone.SECOND, mew=1.6, ms=6.5, zorder=3
        )
        change = f"{100 * (mode.damping[1] / mode.damping[0] - 1):+.0f} %".replace("-", "−")
        panel.text(
            sum(mode.damping) / 2,
            row - GAP,
            change,
            ha="center",
            va="bottom",
            color=Tone.MUTED,
            size=8.5,
        )
    labels = [
        f"{SIGNS[m.name.split()[0]]} {readable(m.frequencies[0], 3)}"
        f" Hz\n{readable(m.frequencies[1], 3)} Hz"
        for m in rows
    ]
    panel.set_yticks(range(len(rows)), labels)
    panel.set_ylim(len(rows) - 0.5, -0.6)
    panel.set_xlim(0, 1.12 * max(max(m.damping) for m in rows))
    panel.set_xlabel("Damping ratio")
    panel.set_title("A1 ●  and A4 □", weight="normal")


POINTS = 72  # an inch
NARROWER = 0.92  # the font of the files is wider than those of browsers
SIDES = {Anchor.START: "left", Anchor.MIDDLE: "center", Anchor.END: "right"}


def pdf(scene: Scene) -> bytes:
    """PDF bytes of a scene."""
    import matplotlib
    from matplotlib.backends.backend_pdf import FigureCanvasPdf
    from matplotlib.figure import Figure

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(SETTINGS)
        figure = Figure(figsize=(scene.width / POINTS, scene.height / POINTS))
        figure.set_layout_engine("none")
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set_axis_off()
        axes.set_xlim(0, scene.width)
        axes.set_ylim(scene.height, 0)
        for shape in scene.shapes:
            _draw(axes, shape)
        out = BytesIO()
        FigureCanvasPdf(figure).print_pdf(out, metadata=METADATA["pdf"])
    return out.getvalue()


def _draw(axes: "Axes", shape: Shape) -> None:
    from matplotlib import patches

    match shape:
        case Text(x, _, text, size):
            words = axes.text(x, shape.baseline, text, ha=SIDES[shape.anchor], va="baseline")
            words.set(
                size=size * NARROWER,
                color=_colour(shape.fill),
                weight="bold" if shape.bold else "normal",
            )
            return
        case Rect(x, y, width, height):
            patch: patches.Patch = patches.Rectangle((x, y), width, height)
        case Circle(x, y, radius):
            patch = patches.Circle((x, y), radius)
        case Path(points):
            patch = patches.Polygon(points, closed=shape.fill != Ink.NONE)
    patch.set_facecolor(_colour(shape.fill))
    patch.set_edgecolor(_colour(shape.stroke))
    patch.set_linewidth(shape.line if shape.stroke != Ink.NONE else 0)
    axes.add_artist(patch)  # add_patch looks for limits of the data, which nobody asks for


def _colour(ink: Ink) -> str:
    return FILE_PALETTE[ink]


@dataclass(frozen=True, slots=True)
class Picture:
    """`name` of the files, `printed` = the paper's figures that it stands for, `caption`, the
    files, and its inline form.
    """

    name: str
    printed: str
    caption: str
    files: tuple[tuple[str, bytes], ...]
    inline: Markup


def of_scene(
    name: str, printed: str, caption: str, scene: Scene, narrow: Scene | None = None
) -> Picture:
    """A picture of a scene, in the page with the colours of the style sheet; `narrow` is shown
    on phones instead, if given.
    """
    inline = (
        _inline(scene, "wide") + _inline(narrow, "narrow") if narrow else _inline(scene, "both")
    )
    return Picture(
        name=name,
        printed=printed,
        caption=caption,
        files=((".svg", svg(scene).encode()), (".png", png(scene)), (".pdf", pdf(scene))),
        inline=inline,
    )


def _inline(scene: Scene, width: str) -> Markup:
    box = f"0 0 {number(scene.width)} {number(scene.height)}"
    opening = Markup(
        '<svg class="plot triangles {}" viewBox="{}" style="max-width:{}px" role="img"'
        ' aria-label="{}">'
    )
    return opening.format(width, box, number(scene.width), scene.title) + Markup(
        body(scene, PAGE_PALETTE) + "</svg>"
    )


def of_plot(name: str, printed: str, caption: str, plot: FigureFiles) -> Picture:
    """A picture of a plot, whatever name the plot has by itself."""
    return Picture(
        name=name,
        printed=printed,
        caption=caption,
        files=((".svg", plot.svg), (".png", plot.png), (".pdf", plot.pdf)),
        inline=plot.inline_as(name),
    )


MARGIN = 16.0
HEAD = 26.0  # a panel's title
FOOT = 34.0  # the legend, in one row
LEAST = 250.0  # width of a figure
LINE = 24.0  # a row of the legend, where it needs more


@dataclass(frozen=True, slots=True)
class Panel:
    """Names of the models; relation and sign of each pair i < j, counted from 0."""

    title: str
    names: tuple[str, ...]
    fields: dict[tuple[int, int], tuple[Relation, str]]


def of_decisions(title: str, decisions: Decisions, names: Sequence[str] = ()) -> Panel:
    """Every pair of a list of models; the sign is the condition's number."""
    pairs = combinations(range(len(decisions.subjects)), 2)
    fields = {(i, j): (decisions.relation(i, j), sign(decisions.rule(i, j))) for i, j in pairs}
    return Panel(title, tuple(names or (s.name for s in decisions.subjects)), fields)


def of_catalog(title: str, catalog: Catalog, view: View) -> Panel:
    """Every pair of a catalogue in one view."""
    names = tuple(f"A{number}" for number in range(1, len(catalog.family) + 1))
    return Panel(
        title,
        names,
        {(i - 1, j - 1): (v.relation, sign(v.decided_by)) for i, j, v in catalog.pairs(view)},
    )


def of_dampers(title: str, table: DamperTable) -> Panel:
    """Every pair of sets of ground dampers."""
    return of_decisions(title, table.decided, tuple(map(spell, table.sets)))


def triangles(title: str, panels: Sequence[Panel], columns: int, cell: float) -> Scene:
    """The panels row after row, and the legend of the relations that occur."""
    side = max(len(panel.names) for panel in panels) * cell
    width, height = side + 3.2 * cell, side + HEAD + 0.6 * cell
    layers: list[Layer] = []
    for place, panel in enumerate(panels):
        row, column = divmod(place, columns)
        layers += _panel(panel, MARGIN + 2.0 * cell + column * width, 8 + HEAD + row * height, cell)
    rows = -(-len(panels) // columns)
    occurring = [
        r
        for r in Relation
        if any(r is relation for p in panels for relation, _ in p.fields.values())
    ]
    total = max(2 * MARGIN + min(columns, len(panels)) * width, LEAST)
    foot = 8 + rows * height + FOOT / 2
    if sum(map(legend_width, occurring)) < total + LINE:
        layers += legend(occurring, MARGIN, foot)
    else:
        layers += (
            legend_entry(relation, MARGIN, foot + i * LINE) for i, relation in enumerate(occurring)
        )
        foot += (len(occurring) - 1) * LINE
    return Scene(total, foot + FOOT / 2 + 4, tuple(layers), title)


def _panel(panel: Panel, x: float, y: float, cell: float) -> Iterator[Layer]:
    places = {(i, j): (x + i * cell, y + j * cell) for i, j in panel.fields}
    by_relation = sorted(panel.fields.items(), key=lambda item: list(Relation).index(item[1][0]))
    marked = [
        (places[pair], relation) for pair, (relation, _) in by_relation if relation in CORNERS
    ]
    signs = [(places[pair], relation, mark) for pair, (relation, mark) in by_relation if mark]
    half = (cell - 1) / 2
    yield Layer("title", (Text(x, y - 4, panel.title, 13, anchor=Anchor.START, bold=True),))
    yield Layer("names", tuple(_names(panel.names, x, y, cell)))
    yield Layer(
        "fields",
        tuple(
            s for pair, (relation, _) in by_relation for s in field(*places[pair], relation, cell)
        ),
    )
    yield Layer("corners", tuple(corner(*place, relation, cell) for place, relation in marked))
    yield Layer(
        "signs",
        tuple(
            Text(a + half, b + half, mark, 0.62 * cell, LETTERS[relation])
            for (a, b), relation, mark in signs
        ),
    )


def _names(names: Sequence[str], x: float, y: float, cell: float) -> Iterator[Text]:
    """Each name at the left of its row and on the diagonal, on top of its column."""
    size = min(11.0, 0.62 * cell)
    for i, name in enumerate(names):
        middle = y + (i + 0.5) * cell
        if i:
            yield Text(x - 5, middle, name, size, Ink.MUTED, Anchor.END)
        yield Text(x + i * cell + 3, middle, name, size, Ink.MUTED, Anchor.START)


SECOND_BED = (
    "The paper draws one figure for each of its two test beds, whose data are not published; here"
    " it is the simulated demonstration drive."
)


def paper_figures(findings: Findings) -> tuple[Picture, ...]:
    """All figures that can be drawn: 3 to 8, 10 to 14."""
    return (
        *_of_the_fit(findings),
        *_of_verdicts(findings),
        _figure_12(findings),
        *_of_larger_sets(findings),
    )


def _of_the_fit(findings: Findings) -> Iterator[Picture]:
    selection = findings.selection
    candidate, fitted = selection.described, len(selection.candidates)
    plot = bode(
        candidate,
        selection.task,
        physical(candidate, selection.task),
        findings.train,
        findings.test,
    )
    yield of_plot(
        "figures-3-4",
        "Figs. 3 and 4",
        f"Measured responses and the best of {fitted} models, with asymptotes. {SECOND_BED}",
        plot,
    )
    yield of_plot(
        "figures-5-6",
        "Figs. 5 and 6",
        "Number of parameters of the best model when one criterion is applied alone, by its"
        " threshold; dashed: in use.",
        parameters_by_threshold(selection.candidates, selection.thresholds),
    )
    yield of_plot(
        "figures-7-8",
        "Figs. 7 and 8",
        f"Number of models that fulfil one criterion alone, out of all {fitted}, by its threshold.",
        models_by_threshold(selection.candidates, selection.thresholds),
    )


def _of_verdicts(findings: Findings) -> Iterator[Picture]:
    for name, damped, count, without in (
        ("figure-10", False, 8, "without damping"),
        ("figure-11", True, 7, "with damping"),
    ):
        panels = (
            of_decisions("Transfer function", findings.picture(3, damped, View.TF)),
            of_decisions(
                f"{count} Markov parameters", findings.picture(3, damped, View.MARKOV, count)
            ),
        )
        printed = f"Fig. {name.removeprefix('figure-')}"
        caption = (
            f"The eleven 3-mass models {without}, by conditions 1 to 7; a field shows the condition"
            " that decides."
        )
        title = f"{printed}: {caption}"
        yield of_scene(
            name,
            printed,
            caption,
            triangles(title, panels, 2, 24.0),
            triangles(title, panels, 1, 24.0),
        )


def _figure_12(findings: Findings) -> Picture:
    caption = (
        "A4 fitted to the exact response of a damped A1: resonances and antiresonances agree, the"
        " four damping ratios cannot. Without damping the two models are indistinguishable."
    )
    return of_plot("figure-12", "Fig. 12", caption, refit_figure(findings.refit))


def _of_larger_sets(findings: Findings) -> Iterator[Picture]:
    caption = "The 29 4-mass models without damping, by conditions 1 to 9 on both representations."
    panel = of_catalog(
        "Transfer function and Markov parameters", findings.catalog(4, damped=False), View.COMBINED
    )
    yield of_scene(
        "figure-13", "Fig. 13", caption, triangles(f"Fig. 13: {caption}", (panel,), 1, 20.0)
    )
    caption = (
        "For each of the eleven damped 3-mass models: no damper to the base (0) or one at mass 1, 2"
        " or 3, against each other. E: decided exactly, where conditions 1 to 9 leave the pair"
        " open."
    )
    family = enumerate(Family(3, damped=True), 1)
    panels = tuple(of_dampers(f"A{number}", findings.dampers(chain)) for number, chain in family)
    title = f"Fig. 14: {caption}"
    yield of_scene(
        "figure-14",
        "Fig. 14",
        caption,
        triangles(title, panels, 4, 30.0),
        triangles(title, panels, 2, 26.0),
    )
