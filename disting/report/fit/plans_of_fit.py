"""Plans after a fit: its selected structure against each rival that it names."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from disting.files import Format
from disting.fit.search.containment import contains
from disting.planning.effort import Effort, effort_of
from disting.planning.fit_file import FitRecord, NamedNetworks
from disting.planning.power import Answer, Plan, plan, plan_to_dict
from disting.planning.rival import AnyStructure, name_of
from disting.planning.spectrum import design
from disting.report.fit.plan_page import title_of, write_plans
from disting.report.fit.plan_words import LOUD, rivals_in_words

OF_FIT = "of the fitted data"


@dataclass(frozen=True, slots=True)
class PlansOfFit:
    """Plans of the fit in `file`: each rival with its plan and, where more measuring cannot exclude
    it, the plan back; `reverse`: the plan against the selected structure, if a larger one is true.
    """

    file: Path
    named: FitRecord | NamedNetworks
    source: str
    pairs: tuple[tuple[Plan, Plan | None], ...]
    reverse: Mapping[Any, Plan]

    @property
    def title(self) -> str:
        """The answer in a few words."""
        return title_of([own_plan for own_plan, _ in self.pairs], self.named)

    def to_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON."""
        larger = self.named.larger
        return {
            "format": Format.PLANS_OF_FIT.value,
            "same": self.named.same,
            "rivals": [plan_to_dict(own_plan) | _back(back) for own_plan, back in self.pairs],
            "larger": [{"name": name_of(x), **_back(self.reverse.get(x))} for x in larger],
        }

    def in_words(self) -> Iterator[str]:
        """Yield the lines of the answer."""
        back = list(self.reverse.values())
        yield from rivals_in_words(self.named, self.pairs, back, self.source, str(self.file))

    def write(self, folder: Path) -> list[Path]:
        """Write page, figures, spectra and JSON into a folder; return the paths."""
        designed = [(own_plan, design(own_plan)) for own_plan, _ in self.pairs]
        back = [*(b for _, b in self.pairs if b is not None), *self.reverse.values()]
        return write_plans(
            self.named, designed, back, self.source, self.file, self.to_dict(), folder
        )


def doubts_of(file: Path, named: FitRecord | NamedNetworks, effort: Effort) -> list[str]:
    """Sentences on what limits the plans of the fit in `file`."""
    nothing = (
        f"warning: none of the structures of {file} explains its data, so no rival is named; name"
        " the structures to plan for"
    )
    return [*([] if named.explained else [nothing]), *loud(effort)]


def loud(effort: Effort) -> Iterator[str]:
    """Yield a warning if the lines scatter so much that the power is a rough estimate."""
    if np.median(effort.rho) > LOUD:
        yield (
            f"warning: lines scatter by more than {100 * LOUD:.0f} %, so the power is a rough"
            " estimate: the test assumes small differences"
        )


def effort_like(
    named: FitRecord | NamedNetworks,
    noise: float | None = None,
    *,
    band: tuple[float, float] | None = None,
    lines: int | None = None,
    repeats: int | None = None,
) -> Effort:
    """The effort of the measurement that was fitted, its lines and the scatter of a line, but for
    what is named otherwise: `noise` of a line, `band` [Hz], number of `lines`, `repeats`.
    """
    effort = effort_of(
        named.model,
        named.values,
        named.scatter if noise is None else noise,
        band=band or (named.low, named.high),
        lines=named.lines or None if lines is None else lines,
        repeats=repeats or 1,
    )
    return effort if noise is not None else replace(effort, source=OF_FIT)


def plan_rivals(
    file: Path, named: FitRecord | NamedNetworks, effort: Effort, **work: Any
) -> PlansOfFit:
    """Plans against each rival, and back where the rival cannot be excluded; and for each larger
    structure, with values that the data determine, against the selected one. `work`: engine,
    executor and progress, which hears of every rival.
    """
    progress = work.pop("progress")
    pairs = list[tuple[Plan, Plan | None]]()

    def against(model: AnyStructure, values: Any, rival: AnyStructure) -> Plan:
        """Return one plan with this effort."""
        return plan(model, values, rival, effort.omega, effort.rho, repeats=effort.repeats, **work)

    for rival, values in named.rivals.items():
        progress("rival", len(pairs), len(named.rivals))
        own_plan = against(named.model, named.values, rival)
        is_same = own_plan.answer is Answer.SAME and values
        pairs.append((own_plan, against(rival, values, named.model) if is_same else None))
    reverse = {
        structure: against(structure, values, named.model)
        for structure, values in named.larger.items()
        if structure in named.determined and contains(structure, named.model)
    }
    return PlansOfFit(file, named, effort.source, tuple(pairs), reverse)


def _back(the_plan: Plan | None) -> dict[str, Any]:
    """The plan against the model, were a structure true that gives the model's response too."""
    return {"reverse": plan_to_dict(the_plan)} if the_plan else {}
