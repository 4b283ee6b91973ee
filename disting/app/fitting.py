"""Fit of the Data page, as a job: what `disting fit --out` writes, into a folder of the project.

A fit is made beside the finished ones and takes its number when all of its files are there. So a
job that is killed leaves no half of a fit.
"""

import shlex
import shutil
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from pathlib import Path

from disting.app.figures import figures_of, figures_of_networks
from disting.app.interface import Json, Progress
from disting.app.project import ABOUT, FIGURES, fit_file, fit_numbers, inside, measured, summary
from disting.app.reading import command_words, response_of
from disting.app.workers import Setting
from disting.errors import InputError, short
from disting.experiments.changes import Change, read_changes
from disting.export import control_script, write_mat
from disting.files import json_text, write_whole
from disting.fit.networks import fit_networks
from disting.fit.search.candidates import chosen_ports, on_elastic_bases
from disting.fit.search.joint import FurtherResponse
from disting.fit.search.setup import Setup
from disting.fit.select import select
from disting.measurement.impedance import as_impedance
from disting.model.chain import Chain, Quantity, Sort
from disting.model.kinds import CHANGES
from disting.network.families import family_of
from disting.network.network import Network
from disting.network.notation import network_of
from disting.network.notation.member import FAMILY
from disting.planning.fit_file import named_by
from disting.report.fit import export, write_fit_report
from disting.report.fit.network_page import write_network_report
from disting.report.fit.sentences import first_lines
from disting.store import Store
from disting.store.scheduling import executor
from disting.verdict.engine import Engine

SIGNS = {"+": 1, "-": -1, "auto": 0}  # see `select`
KINDS = {kind.name: kind for kind in CHANGES}
UNFINISHED = "unfinished"  # folder of a fit that is being made
BESIDE = ("sensor", "force", "change")  # of a further measurement


@dataclass(frozen=True, slots=True)
class Work:
    """Resources of the computation."""

    engine: Engine
    executor: Executor | None
    progress: Progress


def fit(request: Json, progress: Progress, setting: Setting) -> Json:
    """Fit, write the pages, and return number and answer of the fit."""
    own = inside(Path(), "fits", UNFINISHED)
    shutil.rmtree(own, ignore_errors=True)  # of a job that was stopped
    own.mkdir(parents=True)
    find = _fit_networks if request.get("models") else _fit_chains
    with Store.open(None) as store, executor(setting.jobs, setting.scheduler) as pool:
        answer = find(request, own, Work(Engine(store=store), pool, progress))
    write_whole(own / ABOUT, [json_text({"request": request} | answer, indent=1), "\n"])
    number = max(fit_numbers(Path()), default=0) + 1
    own.rename(inside(Path(), "fits", str(number)))
    return summary(number)


def _fit_chains(request: Json, folder: Path, work: Work) -> Json:
    """Fit chains to all measurements of the request."""
    first = request["measurements"][0]
    train = response_of(first["file"], first["reading"])
    test = response_of(request["test"], first["reading"]) if "test" in request else None
    left = named_by(fit_file(request["left"])) if "left" in request else None
    chains = left.chains if left else _chains(request)
    selection = select(
        train,
        [replace(chain, quantity=train.quantity) for chain in chains],
        test=test,
        further=[*_further(request)],
        home=replace(left.model, quantity=train.quantity) if left else None,
        sign=SIGNS[first["reading"].get("sign", "+")],
        fix=request.get("fix"),
        bound=_ranges(request),
        controller=request.get("controller"),
        engine=work.engine,
        executor=work.executor,
        progress=work.progress,
    )
    again = _command(request, _option_words(request))
    selection = replace(selection, command=again)
    write_fit_report(selection, folder, train, test)
    _write_figures(folder, figures_of(selection, train, test))
    models = export(selection, train)
    if models:
        write_mat(folder / "model.mat", models, selection.task.sign)
        script = control_script(models, selection.task.sign)
        write_whole(folder / "models.py", script.encode())
    return {
        "answer": list(first_lines(selection)),
        "explains": selection.explanation.explains and not selection.question,
        "quantities": [r.quantity.value for r in selection.quantities if selection.question],
        "command": _command(request, [*_option_words(request), *_chain_words(request)]),
    }


def _ranges(request: Json) -> dict[str, tuple[float, float]]:
    """Ranges of parameters; raises InputError for one that ends before it begins."""
    for name, (low, high) in request.get("bound", {}).items():
        if not low < high:
            raise InputError(
                f"the range of {name} begins at {low:g} and ends at {high:g}; swap them"
            )
    return {name: (low, high) for name, (low, high) in request.get("bound", {}).items()}


def _chains(request: Json) -> tuple[Chain, ...]:
    """Candidates of the request, of any quantity."""
    first = request["measurements"][0]
    sensor, force = first.get("sensor", "1"), first.get("force", "1")
    chains = chosen_ports(request["masses"], force, sensor, 0, Quantity.ACCELERATION)
    if request.get("base"):
        if len(request["measurements"]) > 1 or (sensor, force) != ("1", "1"):
            raise InputError(
                "an elastic base needs one measurement with force and sensor at mass 1: remove the"
                " others, or the base"
            )
        chains += on_elastic_bases(chains)
    return tuple(replace(chain, damped=request.get("damped", True)) for chain in chains)


def _further(request: Json) -> Iterator[FurtherResponse]:
    """Further measurements of the same machine, which are fitted together with the first."""
    first, *others = request["measurements"]
    of_first = SIGNS[first["reading"].get("sign", "+")] or 1
    for other in others:
        if not any(other.get(name) for name in BESIDE):
            raise InputError(
                f"{other['file']}: name what is different in this measurement: its sensor, its"
                " force, or a change of the machine"
            )
        response = response_of(other["file"], other["reading"])
        sign = (SIGNS[other["reading"].get("sign", "+")] or 1) * of_first
        setup = Setup(
            sensor=other.get("sensor", ""),
            force=other.get("force", ""),
            sign=sign,
            changes=[*_changes(other.get("change", ""))],
        )
        yield FurtherResponse(response, setup)


def _changes(text: str) -> Iterator[Change[str]]:
    """Changes of the machine, as on the command line: lock=2, inertia=1:0.5."""
    for part in filter(None, (part.strip() for part in text.split(","))):
        name, _, value = part.partition("=")
        if name not in KINDS or not value:
            known = ", ".join(kind.example for kind in CHANGES)
            raise InputError(f"a change is written like {known}, not {short(part)}")
        yield from read_changes(KINDS[name], value, str)


def _fit_networks(request: Json, folder: Path, work: Work) -> Json:
    """Fit circuits or machines in any notation to the first measurement."""
    if len(request["measurements"]) > 1:
        raise InputError("models of your own are fitted to one measurement: remove the others")
    if "test" in request:
        raise InputError(
            "models of your own are fitted without test data: remove the measurement that tests the"
            " fit"
        )
    first = request["measurements"][0]
    networks = [network for text in request["models"] for network in _networks(text)]
    is_circuit = any(network.sort is Sort.CIRCUIT for network in networks)
    reading = first["reading"]
    reading = {"quantity": "position"} | reading if is_circuit else reading  # an impedance has none
    response = response_of(first["file"], reading)
    response = as_impedance(response) if is_circuit else response
    selection = fit_networks(response, networks, engine=work.engine, progress=work.progress)
    write_network_report(selection, folder)
    _write_figures(folder, figures_of_networks(selection))
    return {
        "answer": [*selection.warnings, selection.sentence],
        "explains": bool(selection.left),
        "quantities": [],
        "command": _command(request, ["--models", *request["models"]]),
    }


def _write_figures(folder: Path, figures: list[Json]) -> None:
    """Write the diagrams that the page draws."""
    write_whole(folder / FIGURES, [json_text({"figures": figures}), "\n"])


def _networks(text: str) -> Sequence[Network]:
    """One network in any notation, or all of a family such as cells-4."""
    return tuple(family_of(text).networks) if FAMILY.fullmatch(text) else (network_of(text),)


def _command(request: Json, words: Sequence[str]) -> str:
    """The command with the data of the request and these words; "" where there is none, since the
    command reads all files alike.
    """
    first, *others = request["measurements"]
    if not all(_is_read_alike(first["reading"], other["reading"]) for other in others):
        return ""
    own = command_words(measured(first["file"]), first["reading"])
    if "test" in request:
        own += ["--test", str(measured(request["test"]))]
    for other in others:
        entries = [f"{name}={other[name]}" for name in ("sensor", "force") if other.get(name)]
        entries += [other["change"]] if other.get("change") else []
        entries += [f"column={other['reading']['column']}"] if "column" in other["reading"] else []
        own += ["--experiment", f"{measured(other['file'])}:{','.join(entries)}"]
    return shlex.join(["disting", "fit", *own, *words])


def _is_read_alike(first: Json, other: Json) -> bool:
    """Return True if the options of the command for the first file read the other one too: a column
    may be named for each.

    >>> _is_read_alike({"hold": 1e-4}, {"hold": 1e-4, "column": 2})
    True
    >>> _is_read_alike({"column": 2}, {})
    False
    """
    if "," in str(other.get("column", "")) or ("column" in first and "column" not in other):
        return False
    return all(first.get(n) == other.get(n) for n in {*first, *other} - {"column"})


def _option_words(request: Json) -> list[str]:
    """Words of the command line that belong to the machine, whatever the candidates are."""
    first = request["measurements"][0]
    words = ["--sensor", first["sensor"]] if first.get("sensor") else []
    for name, value in request.get("fix", {}).items():
        words += ["--fix", f"{name}={value!r}"]
    for name, (low, high) in request.get("bound", {}).items():
        words += ["--bound", f"{name}={low!r}..{high!r}"]
    return words + (["--controller", request["controller"]] if "controller" in request else [])


def _chain_words(request: Json) -> list[str]:
    """Words of the command line for the candidates."""
    if "left" in request:
        return ["--left", fit_file(request["left"]).as_posix()]
    first = request["measurements"][0]
    words = ["--masses", ",".join(map(str, request["masses"]))]
    words += ["--actuator", first["force"]] if first.get("force") else []
    words += [] if request.get("damped", True) else ["--undamped"]
    return words + (["--base"] if request.get("base") else [])
