"""A page of the plans against all rivals of a fit, with a figure and a spectrum for each."""

import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from disting.files import __version__, json_text, write_whole
from disting.fit.judge.exclusion import LEVEL
from disting.planning.fit_file import FitRecord, NamedNetworks
from disting.planning.power import POWER, Answer, Plan
from disting.planning.rival import name_of
from disting.planning.spectrum import Design
from disting.report.environment import render
from disting.report.fit.links import Site, Step, folders_near, plan_command
from disting.report.fit.plan_words import answer_in_words, chance, larger_in_words
from disting.report.fit.style import FigureFiles
from disting.report.fit.words import percent, readable
from disting.report.fit.write import lines_csv, plan_figure, simulation
from disting.report.words import plural

Designed = tuple[Plan, Design | None]


@dataclass(frozen=True, slots=True)
class ShownPlan:
    """A rival as the page shows it; without a figure where nothing is to be measured."""

    name: str
    noncentrality: str
    power: str
    periods: str
    answer: str
    sentence: str
    figure: FigureFiles | None
    steps: tuple[Step, ...]


def write_plans(
    named: FitRecord | NamedNetworks,
    plans: Sequence[Designed],
    reverse: Sequence[Plan],
    source: str,
    file: Path,
    plain: dict[str, Any],
    folder: Path,
) -> list[Path]:
    """Write plan.html, plan.json (`plain`), and for each rival that more measuring excludes a
    figure, the lines and the spectrum to run; return the paths, in order.

    `reverse`: plans against the selected structure, if one that gives its response or contains it
    is true; `file` is the fit that names the rivals, `source` gives the origin of the noise. The
    same plans give the same bytes.
    """
    folder.mkdir(parents=True, exist_ok=True)
    shown = [_show_plan(plan, best, folder, k) for k, (plan, best) in enumerate(plans, 1)]
    title = title_of([plan for plan, _ in plans], named)
    page = _page(title, named, shown, reverse, source, file, folder)
    files: list[tuple[str, bytes | list[str]]] = [
        ("plan.html", [page]),
        ("plan.json", [json_text(plain, indent=1), "\n"]),
    ]
    for k, ((plan, best), row) in enumerate(zip(plans, shown, strict=True), 1):
        if best is None or row.figure is None:
            continue
        pairs = (("svg", row.figure.svg), ("png", row.figure.png), ("pdf", row.figure.pdf))
        files += [(f"plan-{k}.{kind}", content) for kind, content in pairs]
        files.append((f"lines-{k}.csv", [lines_csv(plan, best)]))
        files.append((_spectrum(k), [best.excitation(best.run.shares).spectrum_csv]))
    return [write_whole(folder / name, content) for name, content in files]


def _spectrum(k: int) -> str:
    return f"spectrum-{k}.csv"


def _show_plan(plan: Plan, best: Design | None, folder: Path, k: int) -> ShownPlan:
    is_open = plan.noncentrality > 0
    steps = list[Step]()
    if best is not None:
        run = simulation(plan, best, folder / _spectrum(k))
        steps.append(Step("The spectrum, run on the model:", run))
        steps.append(Step("This pair in full:", plan_command(plan)))
    return ShownPlan(
        plan.names[1],
        readable(plan.noncentrality, 3),
        chance(plan.power) if is_open else "–",
        f"{readable(plan.factor, 3)}×" if is_open else "–",
        {Answer.ENOUGH: "enough", Answer.MORE: "measure more"}.get(plan.answer, "impossible"),
        answer_in_words(plan),
        None if best is None else plan_figure(plan, best, f"plan-{k}"),
        tuple(steps),
    )


def _page(
    title: str,
    named: FitRecord | NamedNetworks,
    shown: Sequence[ShownPlan],
    reverse: Sequence[Plan],
    source: str,
    file: Path,
    folder: Path,
) -> str:
    name = name_of(named.model)
    return render(
        "plan.html",
        title=title,
        explained=named.explained,
        reverse=[(back.names[0], answer_in_words(back)) for back in reverse],
        name=name,
        values=", ".join(f"{n} = {readable(v, 4)}" for n, v in named.values.items()),
        source=source,
        file=file,
        plans=shown,
        same=named.same,
        steps=_onward(named, file),
        larger=list(larger_in_words(list(named.larger), name)),
        power=percent(POWER),
        level=percent(LEVEL),
        home=Site(folders_near(folder), folder).home,
        version=__version__,
    )


def _onward(named: FitRecord | NamedNetworks, file: Path) -> list[Step]:
    """Return the command for what no data of this kind distinguish."""
    command = f"disting next {shlex.quote(str(file))}"
    return [Step("Which other experiment separates them:", command)] if named.same else []


def title_of(plans: Sequence[Plan], named: FitRecord | NamedNetworks) -> str:
    """Return the answer in a few words."""
    more = [plan.names[1] for plan in plans if plan.answer is Answer.MORE]
    enough = sum(plan.answer is Answer.ENOUGH for plan in plans)
    if not plans:
        if not named.explained:
            return "The fit explains nothing, so it names no rival"
        return "Measuring more separates nothing" if named.same else "The fit left no rival"
    if more:
        rivals = more[0] if len(more) == 1 else plural(len(more), "rival")
        return f"Measure more to exclude {rivals}"
    if enough == len(plans):
        return "The same effort excludes every rival"
    return f"More of the same excludes {enough} of {plural(len(plans), 'rival')}"
