"""Links from a fit: pages of the catalogues with their addresses, and ready commands for each
structure.
"""

import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from os import fsencode
from os.path import relpath
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from disting.catalogs.files import damper_name, name_of as catalog_name
from disting.fit.judge.members import NOTHING, Member, Twin
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import listed_form, reference
from disting.fit.search.containment import AnyStructure, name_of
from disting.model.chain import Chain
from disting.model.names import damping_option

if TYPE_CHECKING:  # a fit without a plan has no use for what plans
    from disting.planning.power import Plan

PURPOSES = {
    "compare": "Whether an experiment tells them apart, and why:",
    "fit": "The fit, where the sensor shows this quantity:",
    "equivalents": "Every structure with the same response, and its parameters:",
}
SAME = "Why nothing tells them apart, and whether that holds for all parameters:"


@dataclass(frozen=True, slots=True)
class Link:
    """The structure that a page is about, and where that is."""

    name: str
    address: str


@dataclass(frozen=True, slots=True)
class Site:
    """The pages of `disting report` in the folder `root`, as pages in `folder` lead to them."""

    root: Path
    folder: Path

    def page(self, chain: Chain) -> Link | None:
        """The page about a structure, or about it without its ground dampers where its family has
        none; None without either.

        Lag and dead time have no pages of their own.
        """
        return next(
            (self._link(*page) for page in _pages(chain) if (self.root / page[1]).is_file()), None
        )

    @property
    def home(self) -> str | None:
        """Base address of its pages; None where it has no guide."""
        is_there = (self.root / "guide" / "index.html").is_file()
        return f"{self._way(self.root.resolve())}/" if is_there else None

    def _link(self, name: str, file: str, fragment: str) -> Link:
        return Link(name, self._way((self.root / file).resolve()) + fragment)

    def _way(self, target: Path) -> str:
        try:
            return quote(fsencode(Path(relpath(target, self.folder.resolve())).as_posix()))
        except ValueError:  # another drive
            return target.as_uri()


@dataclass(frozen=True, slots=True)
class Step:
    """A command, and the information that it gives."""

    purpose: str
    command: str


def folders_near(folder: Path) -> Path:
    """Where the pages of the catalogues may lie that nobody named: in the folder itself, or in
    the one that holds it.
    """
    return next(
        (root for root in (folder, folder.resolve().parent) if (root / "models").is_dir()), folder
    )


def _pages(chain: Chain) -> Iterator[tuple[str, str, str]]:
    """Name, file and fragment of the pages that describe a structure, the most detailed first."""
    if chain.gap_damper:  # no catalogue has it
        return
    chain = listed_form(chain).chain
    name = reference(replace(chain, ground_dampers=(), lag=False, dead_time=False))
    size, colon, number = name.partition(":")
    if not colon or not number.isdecimal():
        return
    kind = int(size), chain.damped
    if chain.ground_dampers:
        dampers = "".join(f"+b{i}" for i in chain.ground_dampers)
        yield name + dampers, f"{damper_name(*kind)}.html", f"#{number}{dampers}"
    yield name, f"models/{catalog_name(*kind).removeprefix('chains-')}/{number}.html", ""


def new_names(selection: Selection) -> str:
    """Names of the parameters of the described candidate in the structure that it is named after;
    "" for the same.
    """
    form = listed_form(selection.described.chain)
    other = ", ".join(f"{old} is {new} there" for old, new in form.renaming.items() if old != new)
    exchanged = "" if other else "force and sensor are exchanged there"
    names = (
        f"{reference(selection.described.chain)} is the structure of the catalogue that behaves the"
        " same"
    )
    return "" if form.chain == selection.described.chain else f"{names}: {other or exchanged}"


def commands(selection: Selection) -> tuple[str, ...]:
    """Ready command lines for the next steps; none from a structure that does not explain the data,
    whose values mean nothing. Where the sensor quantity is open, the fit with each.
    """
    if selection.question:
        fit = selection.command or "disting fit FILE"
        return tuple(f"{fit} --quantity {r.quantity.value}" for r in selection.quantities)
    if not selection.explanation.is_near:
        return ()
    first = selection.described
    if first.chain.gap_damper:
        return ()
    rest = [m.name for m in selection.members[1:] if not m.candidate.chain.gap_damper]
    damped = damping_option(first.chain.damped)
    steps = [f"disting compare {reference(first.chain)} {rest[0]} {damped}"] if rest else []
    chain, fitted = _without_zeros(first.chain, first.estimate.parameters)
    form, damped = listed_form(chain), damping_option(chain.damped)
    values = ",".join(f"{form.renaming[n]}={v:.6g}" for n, v in fitted.items())
    options = f'--to "{chain.n_masses}+b*" --set {values}'
    return (*steps, f"disting equivalents {reference(chain)} {damped} {options}")


def _without_zeros(chain: Chain, values: Mapping[str, float]) -> tuple[Chain, dict[str, float]]:
    """The chain without dampers that are zero, as far as it has a name, and its values; in parallel
    with one of several springs a negligible damper instead.
    """
    springs = [name for name in chain.parameters if name[0] == "d"]
    other_chain = replace(
        chain,
        damped=chain.damped and (not springs or any(values[name] for name in springs)),
        ground_dampers=tuple(i for i in chain.ground_dampers if values[f"b{i}"]),
    )
    return other_chain, {name: max(values[name], NOTHING) for name in other_chain.parameters}


def next_steps(selection: Selection) -> list[Step]:
    """Commands that lead on from the described candidate."""
    return [Step(PURPOSES[command.split()[1]], command) for command in commands(selection)]


def steps_of(selection: Selection, member: Member) -> list[Step]:
    """Commands that lead on from a structure of the set, against the first one; of that itself
    `next_steps` are.
    """
    first = selection.members[0]
    return (
        []
        if member is first
        else next_steps(replace(selection, selected=member.candidate, members=(member, first)))
    )


def step_to(member: Member, twin: Twin) -> Step:
    """The command that compares a structure with one that behaves as it does."""
    damped = f" {damping_option(twin.chain.damped)}"
    return Step(SAME, f"disting compare {member.name} {twin.name}{damped}")


def next_command(plan: "Plan") -> str:
    """The command that lists the experiments that distinguish two structures."""
    return f"disting next {command_names(plan.model, plan.other)}"


def command_names(model: AnyStructure, *others: AnyStructure) -> str:
    """Structures as a command names them."""
    names = " ".join(shlex.quote(name_of(chain)) for chain in (model, *others))
    return f"{names} {damping_option(model.damped)}" if isinstance(model, Chain) else names


def named_with_values(
    model: AnyStructure, values: Mapping[str, float], *others: AnyStructure
) -> str:
    """Structures with the values of the first one, under the names of the structure that is
    listed.
    """
    names = listed_form(model).renaming if isinstance(model, Chain) else {}
    text = ",".join(f"{names.get(n, n)}={v:.6g}" for n, v in values.items())
    return f"{command_names(model, *others)} --set {text}"


def plan_command(plan: "Plan") -> str:
    """The command for one pair."""
    from disting.planning.power import typical  # whoever has a plan has imported it

    size = typical(plan.rival.rho) if plan.rival else 0.02
    lines = ""
    if plan.rival:
        hertz = plan.rival.hertz
        lines = f" --band {hertz[0]:.6g}..{hertz[-1]:.6g} --lines {len(hertz)}"
    call = named_with_values(plan.model, plan.values, plan.other)
    repeats = f" --repeats {plan.repeats}" if (plan.repeats or 1) > 1 else ""
    return f"disting plan {call} --noise {size:.3g}{lines}{repeats}"
