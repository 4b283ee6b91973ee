"""Writes what a fit or a plan found into a folder: page, figures, data."""

import csv
from collections import Counter
from collections.abc import Iterator, Sequence
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from disting.export import NumberedStructure
from disting.files import json_text, write_whole
from disting.fit.judge.admissible import undetermined
from disting.fit.judge.modes import Result, physical
from disting.fit.results.selection import Profile, Selection, profile
from disting.fit.search.candidates import reference as name_of
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.planning.power import Plan, typical
from disting.planning.spectrum import Design, designed_to_dict
from disting.report.fit.bode import bode
from disting.report.fit.convergence import profile_panels, waterfall
from disting.report.fit.criteria import models_by_threshold, parameters_by_threshold
from disting.report.fit.left_figure import left_figure
from disting.report.fit.links import Site, folders_near, named_with_values
from disting.report.fit.residuals import residuals
from disting.report.fit.responses import responses
from disting.report.fit.selection_json import candidate_to_dict, selection_to_dict
from disting.report.fit.selection_page import fit_page
from disting.report.fit.sensitivity import collinearity_dots, importance_bars
from disting.report.fit.style import FigureFiles, Tone, draw_figure, heading, is_narrow, logarithmic
from disting.report.fit.words import name, unit_of

COLUMNS = (
    "n_masses", "gap", "actuator", "sensor", "ground_dampers", "lag", "delay", "n_parameters",
    "j_train", "j_test", "condition_index", "pii_ratio", "collinearity", "akaike_weight",
    "hit_rate", "admissible", "reasons",
)  # fmt: skip


if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def write_plan(plan: Plan, best: Design, folder: Path) -> str:
    """Write plan.svg, .png, .pdf, plan.json, lines.csv and spectrum.csv; the command that simulates
    the spectrum. The same plan gives the same bytes.
    """
    folder.mkdir(parents=True, exist_ok=True)
    figure = plan_figure(plan, best)
    text = json_text(designed_to_dict(plan, best), indent=1)
    for file, content in (
        ("plan.svg", figure.svg),
        ("plan.png", figure.png),
        ("plan.pdf", figure.pdf),
        ("plan.json", [text, "\n"]),
        ("lines.csv", [lines_csv(plan, best)]),
        ("spectrum.csv", [best.excitation(best.run.shares).spectrum_csv]),
    ):
        write_whole(folder / file, content)
    return simulation(plan, best, folder / "spectrum.csv")


def simulation(plan: Plan, best: Design, path: Path) -> str:
    """The command that runs a spectrum on the model."""
    return (
        f"disting simulate {named_with_values(plan.model, plan.values)}"
        f" --spectrum {path} --sampling-rate {best.rate:g} --samples {best.samples}"
    )


def lines_csv(plan: Plan, best: Design) -> str:
    """Return a row a line: frequency, difference, noise, shares of the power."""
    rows = ["frequency_hz,difference,noise,share_optimal,share_run\n"]
    rival = plan.rival
    if rival is not None:
        columns = (best.hertz, rival.apart, rival.rho, best.optimum.shares, best.run.shares)
        rows += [",".join(f"{v:.9g}" for v in row) + "\n" for row in zip(*columns, strict=True)]
    return "".join(rows)


def plan_figure(plan: Plan, best: Design, file: str = "plan") -> FigureFiles:
    """Difference of the two structures over frequency with the noise, and the shares of the power
    of the optimal spectrum below; `file`: its name without ending.
    """
    model, name = plan.names
    rival = plan.rival
    title = f"Where {name}, fitted to {model}, differs from it, and where the power has to go"
    size = rival.apart if rival is not None else np.zeros(len(best.hertz))
    noise = rival.rho if rival is not None else np.ones(len(best.hertz))

    def draw(figure: "Figure") -> None:
        """Two panels over one frequency axis."""
        upper, lower = figure.subplots(2, 1, sharex=True)
        _difference(upper, best, size, noise)
        _shares(lower, best)
        lower.set_xlabel("Frequency [Hz]")
        logarithmic(lower.xaxis, best.hertz[0], best.hertz[-1])
        heading(figure, title)
        figure.legend(loc="outside lower center", ncols=2 if is_narrow(figure) else 5)

    caption = f"{title}; noise {100 * typical(noise):.2g} % a line"
    return draw_figure(file, caption, (5.2, 5.6), draw)


def _difference(panel: "Axes", best: Design, size: Real, noise: Real) -> None:
    """Difference of the structures, noise of a line, best band."""
    panel.plot(best.hertz, 100 * size, color=Tone.FIRST, label="difference |G_B/G_A - 1|")
    panel.plot(
        best.hertz,
        100 * noise,
        color=Tone.SECOND,
        linestyle=(0, (5, 3)),
        label="noise of a line",
    )
    panel.axvspan(best.band.low, best.band.high, color=Tone.BODY, zorder=0.5, label="best band")
    panel.set_xscale("log")
    panel.set_ylabel("Difference [%]")


def _shares(panel: "Axes", best: Design) -> None:
    """Shares of the power of the optimal spectrum and of the one to be run."""
    chosen = best.optimum.shares > 0
    panel.vlines(
        best.hertz[chosen],
        0,
        100 * best.optimum.shares[chosen],
        color=Tone.THIRD,
        linewidth=2.5,
        label="share of the power, optimal",
    )
    panel.plot(
        best.hertz,
        100 * best.run.shares,
        "o",
        ms=2.5,
        mfc="none",
        mec=Tone.INK,
        label="to be run",
    )
    panel.set_ylim(bottom=0)
    panel.set_ylabel("Share of the power [%]")


def write_fit_report(
    selection: Selection,
    folder: Path,
    train: FrequencyResponse,
    test: FrequencyResponse | None = None,
    *,
    profiles: Sequence[str] = (),
    site: Path | None = None,
) -> list[Path]:
    """Write fit.html, its figures (SVG, PNG, PDF), fit.json and candidates.csv; the paths written,
    in order.

    `train` and `test` are the data of the selection; `profiles` names parameters whose profiles
    are drawn, which takes a second each. `site`: folder with the pages of the catalogues, to which
    the structures are linked; by default those that lie in `folder` or in the folder that holds
    it. The same selection, with the same pages there, gives the same bytes. `folder` is made if it
    does not exist; other files in it stay as they are. Raises InputError for the name of a
    parameter that the described candidate does not have.
    """
    candidate, results = selection.described, list[Result]()
    figures = list[FigureFiles]()
    if not selection.question:  # else there is no model to show
        the_profiles = [profile(candidate, selection.task, n) for n in profiles]
        results = [*physical(candidate, selection.task)]
        figures = fit_figures(selection, results, train, test, the_profiles)
    folder.mkdir(parents=True, exist_ok=True)
    page = fit_page(
        selection, results, figures, train, test, Site(site or folders_near(folder), folder)
    )
    return [
        write_whole(folder / file, content) for file, content in _files(selection, page, figures)
    ]


def fit_figures(
    selection: Selection,
    results: Sequence[Result],
    train: FrequencyResponse,
    test: FrequencyResponse | None = None,
    profiles: Sequence[Profile] = (),
) -> list[FigureFiles]:
    """Bode diagram and residuals of each response, criteria against thresholds, importance,
    collinearity, starts, profiles.
    """
    candidate, task, thresholds = selection.described, selection.task, selection.thresholds
    drawn = [
        *(
            figure
            for response in responses(selection, train, test)
            for figure in (
                bode(candidate, task, results, response.train, response.test, response.at),
                residuals(selection, response.train, response.test, response.at),
            )
        ),
        left_figure(selection, train),
        parameters_by_threshold(selection.candidates, thresholds),
        models_by_threshold(selection.candidates, thresholds),
        importance_bars(candidate, thresholds),
        collinearity_dots(candidate, task, thresholds),
        waterfall(candidate),
    ]
    if profiles:
        drawn.append(profile_panels(candidate, task, profiles))
    return [figure for figure in drawn if figure is not None]


def _files(
    selection: Selection, page: str, figures: Sequence[FigureFiles]
) -> Iterator[tuple[str, bytes | list[str]]]:
    yield "fit.html", [page]
    for figure in figures:
        yield f"{figure.name}.svg", figure.svg
        yield f"{figure.name}.png", figure.png
        yield f"{figure.name}.pdf", figure.pdf
    yield (
        "fit.json",
        [
            json_text(selection_to_dict(selection), indent=1),
            "\n",
        ],
    )
    yield "candidates.csv", [candidates_csv(selection)]


def export(selection: Selection, measured: FrequencyResponse) -> list[NumberedStructure]:
    """The structures that the data leave, the selected one first, then other possible ones; further
    parameter sets of one structure are numbered. Others than the selected one are left out where
    the data do not determine all of their parameters (`not_exported`).
    """
    kept = [m for m in selection.members if m.name not in not_exported(selection)]
    fitted = [m.candidate for m in kept] or [c for c in (selection.selected,) if c is not None]
    models = [
        (
            name_of(c.chain),
            c.chain,
            {n: c.estimate.parameters[n] for n in c.chain.parameters},
            undetermined(c),
        )
        for c in fitted
    ]
    models += [(t.name, t.chain, t.parameters, ()) for m in kept for t in m.twins]
    counted = Counter[str]()
    exporteds = []
    for called, chain, values, unknown in models:
        counted[called] += 1
        number = f" ({counted[called]})" if counted[called] > 1 else ""
        units = {n: unit_of(n[0], measured) for n in values}
        exporteds.append(NumberedStructure(called + number, chain, values, units, unknown))
    return exporteds


def not_exported(selection: Selection) -> tuple[str, ...]:
    """Names of the structures left, others than the selected one, of which the data do not
    determine all parameters: their values are those of one point of many, such as a mass of 1e-17.
    """
    return tuple(m.name for m in selection.members[1:] if undetermined(m.candidate))


def candidates_csv(selection: Selection) -> str:
    """The candidates in the order of the cost on test, a line each; lists with blanks between;
    infinite numbers are empty.
    """
    text = StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(["rank", "name", *COLUMNS])
    for rank, candidate in enumerate(selection.candidates, 1):
        plain = candidate_to_dict(candidate)
        table.writerow([rank, name(candidate.chain), *(_cell(plain[column]) for column in COLUMNS)])
    return text.getvalue()


def _cell(value: Any) -> Any:
    if isinstance(value, list):
        return ("; " if any(isinstance(v, str) for v in value) else " ").join(map(str, value))
    return "" if value is None else str(value).lower() if isinstance(value, bool) else value
