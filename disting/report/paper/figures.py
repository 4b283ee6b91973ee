"""The figures of the paper from our own data, in its order."""

from collections.abc import Iterator

from disting.fit.modes import physical
from disting.model.family import Family
from disting.paper import Findings
from disting.report.fit.bode import bode
from disting.report.fit.thresholds import models_by_threshold, parameters_by_threshold
from disting.report.paper.picture import Picture, of_plot, of_scene
from disting.report.paper.refit import refit_figure
from disting.report.paper.triangles import of_catalog, of_dampers, of_decisions, triangles
from disting.verdict import View

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
    found = findings.selection
    candidate, fitted = found.described, len(found.candidates)
    plot = bode(
        candidate, found.task, physical(candidate, found.task), findings.train, findings.test
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
        parameters_by_threshold(found.candidates, found.thresholds),
    )
    yield of_plot(
        "figures-7-8",
        "Figs. 7 and 8",
        f"Number of models that fulfil one criterion alone, out of all {fitted}, by its threshold.",
        models_by_threshold(found.candidates, found.thresholds),
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
