"""A fit of networks as a page with figures: the answer first, then values, responses, the list of
networks with those that cannot be distinguished.
"""

import csv
import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

from markupsafe import Markup

from disting.errors import enumeration
from disting.files import __version__, json_text, write_whole
from disting.fit.judge.exclusion import LEVEL
from disting.fit.judge.network_intervals import NetworkTwin
from disting.fit.judge.readings import read_in_words
from disting.fit.results.networks import BAR, FittedNetwork, NetworkSelection
from disting.report.environment import render
from disting.report.fit.links import Site, Step, folders_near
from disting.report.fit.network_figures import captions, network_figures
from disting.report.fit.network_words import ValueRow, standing, twin_words, value_rows
from disting.report.fit.responses import drawing
from disting.report.fit.style import FigureFiles
from disting.report.fit.words import readable
from disting.report.network_drawing import describe_network, draw_network
from disting.report.words import plural

COLUMNS = ("network", "values", "determined", "chi2_per_line", "standing", "same")


@dataclass(frozen=True, slots=True, eq=False)
class ShownNetwork:
    """A network with its drawing and values; `same`: those that cannot be distinguished from it."""

    name: str
    drawing: Markup
    description: str
    rows: list[ValueRow]
    note: str = ""
    same: tuple["ShownNetwork", ...] = ()


def write_network_report(selection: NetworkSelection, folder: Path) -> list[Path]:
    """Write fit.html, its figures (SVG, PNG, PDF), fit.json and candidates.csv of fitted networks;
    return the paths, in order.

    The same selection, with the same pages of `disting report` there, gives the same bytes.
    `folder` is made if it does not exist; other files in it stay as they are.
    """
    figures = network_figures(selection)
    folder.mkdir(parents=True, exist_ok=True)
    page = network_page(selection, figures, folder)
    files: list[tuple[str, bytes | list[str]]] = [("fit.html", [page])]
    for figure in figures:
        pairs = (("svg", figure.svg), ("png", figure.png), ("pdf", figure.pdf))
        files += [(f"{figure.name}.{kind}", content) for kind, content in pairs]
    files.append(("fit.json", [json_text(selection.to_dict(), indent=1), "\n"]))
    files.append(("candidates.csv", [networks_csv(selection)]))
    return [write_whole(folder / file, content) for file, content in files]


def network_page(selection: NetworkSelection, figures: Sequence[FigureFiles], folder: Path) -> str:
    """Return the HTML of a fit of networks; `figures` as `network_figures` returns them."""
    described = selection.fits[0]
    first, *others = zip(figures, captions(selection), strict=True)
    left = [f for f in selection.left if f is not described]
    return render(
        "fit-networks.html",
        selection=selection,
        described=shown(described),
        numbers=_numbers(selection),
        misses=[] if described.explains else [miss.sentence for miss in described.misses],
        first=first,
        figures=others,
        left=[shown(f) for f in left],
        fits=[(f, standing(f), BAR.join(f.same)) for f in selection.fits],
        steps=_steps(selection, folder),
        rule=_rule(),
        data=[(read_in_words(r), r) for r in selection.measured],
        home=Site(folders_near(folder), folder).home,
        readable=readable,
        plural=plural,
        version=__version__,
    )


def shown(fit: FittedNetwork) -> ShownNetwork:
    """Return a fitted network with those that cannot be distinguished from it, as the page shows
    them.
    """
    return ShownNetwork(
        fit.network.name,
        drawing(draw_network(fit.network)),
        describe_network(fit.network),
        value_rows(fit.network, fit.values, fit.intervals),
        same=tuple(map(_shown_twin, fit.twins)),
    )


def _shown_twin(twin: NetworkTwin) -> ShownNetwork:
    return ShownNetwork(
        twin.network.name,
        drawing(draw_network(twin.network)),
        describe_network(twin.network),
        value_rows(twin.network, twin.values, twin.intervals),
        twin_words(twin).removeprefix(f"{twin.network.name}, "),
    )


def _numbers(selection: NetworkSelection) -> list[tuple[str, str, str]]:
    """Return what the head of the page counts: heading, number, meaning."""
    described, count = selection.fits[0], len(selection.networks)
    same = sum(len(f.same) for f in selection.left)
    left = len(selection.left) + same
    meaning = f"of {plural(count, 'network')}"
    meaning += f"; {same} of these cannot be distinguished from another one" if same else ""
    return [
        ("not excluded", str(left), meaning),
        ("misfit", readable(described.chi2, 3), "chi2 per line; 1 is noise alone"),
        (
            "noise of a line",
            f"{100 * selection.scatter.typical:.2g} %",
            f"from {selection.scatter.source}",
        ),
    ]


def _rule() -> str:
    return (
        "A network explains the data if it leaves no more than the lines scatter. One that explains"
        f" them is excluded if another one does so clearly better (level {100 * LEVEL:g} %). Of"
        " those that are left, the one with the fewest values is named first. One that contains"
        " another one that is left fits at least as well, so it is not a rival."
    )


def _steps(selection: NetworkSelection, folder: Path) -> list[Step]:
    """Return the commands that lead on; none where no network explains the data."""
    chosen = selection.selected
    if chosen is None:
        return []
    file, name = shlex.quote(str(folder / "fit.json")), shlex.quote(chosen.network.name)
    steps = list[Step]()
    if chosen.same:
        other = shlex.quote(chosen.same[0])
        steps.append(
            Step("Why no impedance or response separates them:", f"disting compare {name} {other}")
        )
        steps.append(
            Step("At which further place a sensor separates them:", f"disting next {file}")
        )
    if len(selection.left) > 1:
        steps.append(
            Step(
                "How much noise still allows the remaining networks to be distinguished:",
                f"disting plan {file}",
            )
        )
    return steps


def networks_csv(selection: NetworkSelection) -> str:
    """Return the networks in the order of the page, a line each."""
    text = StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    for f in selection.fits:
        same = enumeration(f.same, BAR)
        row = (f.network.name, len(f.values), f.rank, f"{f.chi2:.9g}", standing(f), same)
        table.writerow(row)
    return text.getvalue()
