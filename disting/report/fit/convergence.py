"""Convergence of a fit: costs that all starts reached, and profiles of single parameters."""

from collections.abc import Sequence
from math import ceil, isfinite
from typing import TYPE_CHECKING

import numpy as np

from disting.fit.judge.candidate import Candidate
from disting.fit.results.selection import Profile
from disting.fit.search.estimate import REACHED, Task
from disting.measurement.arrays import Real
from disting.report.fit.style import FigureFiles, Tone, draw_figure, heading, is_narrow, logarithmic
from disting.report.fit.words import percent, readable, unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LOWEST = 1e-12  # of the highest cost: what is below is drawn here, a perfect fit too
COLUMNS, NARROW_COLUMNS = 3, 2  # of the profiles
# of (ln p/p0)^2 / sigma^2 that 95 % of all measurements stay below, were the model linear
LIMIT = 1.96**2


def hits(candidate: Candidate) -> int:
    """Number of starts that reached the best cost."""
    return round(candidate.estimate.hit_rate * len(candidate.estimate.costs))


def hits_in_words(candidate: Candidate) -> str:
    """Number of starts that reached the best cost, in words."""
    estimate = candidate.estimate
    words = f"{hits(candidate)} of {len(estimate.costs)} starts ({percent(estimate.hit_rate)})"
    return f"{words} within {percent(REACHED)} of the best cost"


def waterfall(candidate: Candidate) -> FigureFiles:
    """Cost of each start after the rough search, in rising order; a long flat stretch at the bottom
    indicates a reliable optimum.
    """
    costs = np.array([cost for cost in candidate.estimate.costs if isfinite(cost)])
    hit = np.arange(len(costs)) < hits(candidate)
    highest = float(costs.max(initial=candidate.j_train))
    best = max(candidate.j_train, LOWEST * highest)
    title = f"Cost from each start, sorted: {hits_in_words(candidate)}"

    def draw(figure: "Figure") -> None:
        """A point a start, in rising order."""
        panel = figure.subplots()
        place = np.arange(1, len(costs) + 1)
        shown = np.maximum(costs, best)
        panel.plot(place, shown, color=Tone.RULE, linewidth=1.2, zorder=1.5)
        for chosen, inside, edge, label in (
            (hit, Tone.FIRST, Tone.FIRST, "reached the best cost"),
            (~hit, "none", Tone.SECOND, "stopped above it"),
        ):
            if chosen.any():
                panel.semilogy(
                    place[chosen], shown[chosen], "o", ms=4.5, mfc=inside, mec=edge, label=label
                )
        panel.axhline(
            best,
            color=Tone.INK,
            linewidth=1,
            label=f"best cost J = {readable(candidate.j_train)}",
            zorder=1,
        )
        edge = max(1.3, (highest / best) ** 0.04)
        low, high = best / edge, highest * edge
        panel.set_ylim(low, high)
        panel.set_xlim(0, len(costs) + 1)
        logarithmic(panel.yaxis, low, high)
        panel.set_xlabel("Start, by rising cost")
        panel.set_ylabel("Cost J on training data")
        heading(figure, title)
        figure.legend(loc="outside lower center", ncols=2 if is_narrow(figure) else 3)

    return draw_figure("starts", title, (3.5, 3.6), draw)


def profile_panels(candidate: Candidate, task: Task, profiles: Sequence[Profile]) -> FigureFiles:
    """Smallest cost at each value of a parameter, with the parabola of its standard error."""
    title = "Smallest cost at each value of one parameter, all others fitted anew"

    def rows(columns: int) -> int:
        """So many rows of panels."""
        return ceil(len(profiles) / columns)

    def draw(figure: "Figure") -> None:
        """A panel a parameter."""
        columns = NARROW_COLUMNS if is_narrow(figure) else COLUMNS
        panels = figure.subplots(rows(columns), columns, squeeze=False).ravel()
        for place, (panel, profile) in enumerate(zip(panels, profiles, strict=False)):
            _profile(panel, candidate, task, profile, unit=not is_narrow(figure))
            if place + columns >= len(profiles):
                panel.set_xlabel("Change [%]")
        for panel in panels[len(profiles) :]:
            panel.remove()
        panels[0].plot([], [], "-o", ms=4, color=Tone.FIRST, label="profile")
        panels[0].plot(
            [], [], color=Tone.SECOND, linestyle=(0, (5, 3)), label="as the standard error predicts"
        )
        panels[0].plot(
            [], [], color=Tone.MUTED, linestyle=(0, (1, 2)), label="limit of the 95 % interval"
        )
        heading(figure, title)
        figure.supylabel("Cost J on training data", size=9)
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(
            handles, labels, loc="outside lower center", ncols=1 if is_narrow(figure) else 3
        )

    return draw_figure(
        "profiles", title, (1.0 + 2.1 * rows(COLUMNS), 1.7 + 1.9 * rows(NARROW_COLUMNS)), draw
    )


def _profile(
    panel: "Axes", candidate: Candidate, task: Task, profile: Profile, *, unit: bool
) -> None:
    """J(p) and J (1 + (ln p/p0)^2 / (sigma^2 (n_y - N_p))), what it would be were the model
    linear in ln p.
    """
    from matplotlib.ticker import FuncFormatter

    best, sigma = (
        candidate.estimate.parameters[profile.name],
        candidate.practical.relative_errors[profile.name],
    )
    freedom = task.cost.n_residuals - candidate.n_parameters
    fine = np.geomspace(profile.values[0], profile.values[-1], 60)
    if np.isfinite(sigma) and freedom > 0:
        parabola = candidate.j_train * (1 + (np.log(fine / best) / sigma) ** 2 / freedom)
        panel.plot(
            _change(fine, best), parabola, color=Tone.SECOND, linestyle=(0, (5, 3)), linewidth=1.2
        )
        limit = candidate.j_train * (1 + LIMIT / freedom)
        panel.axhline(limit, color=Tone.MUTED, linestyle=(0, (1, 2)), linewidth=1.2)
    panel.plot(
        _change(profile.values, best), profile.costs, "-o", ms=3.5, color=Tone.FIRST, linewidth=1.2
    )
    panel.axvline(0, color=Tone.MUTED, linewidth=0.8)
    of = f" {unit_of(profile.name[0], task.cost.measured)}" if unit else ""
    panel.set_title(f"{profile.name} = {readable(best)}{of}", weight="normal")
    panel.ticklabel_format(axis="y", useOffset=False)
    panel.locator_params(axis="x", nbins=4)
    panel.xaxis.set_major_formatter(
        FuncFormatter(lambda value, _: readable(value).replace("-", "−"))
    )


def _change(values: Real, best: float) -> Real:
    """Relative change in percent."""
    return np.asarray(100 * (values / best - 1))
