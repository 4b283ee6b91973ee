"""The errors that docstrings name are those that bad calls raise: a bad call for each public function
and method that names one, and for those that take whatever their types allow a word that they do.
"""

import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np
import pytest

import disting
from disting import (
    Chain,
    Element,
    Experiment,
    Family,
    Finding,
    Identifiability,
    MatrixModel,
    Model,
    ModelList,
    Network,
    ParameterIdentifiability,
    Port,
    Verdict,
    catalog,
    equivalence,
    experiments,
    fit,
    measurement,
    network_of,
    report,
    simulation,
)
from disting.decide import identifiability
from disting.equivalence import explicit_map
from disting.errors import CatalogError, DistingError, InputError
from disting.experiments.experiment import MeasuredChain
from disting.model.kinds import LOCK
from tests.test_public_api import DOCUMENTED, callables

DRIVE, VALUES = Chain(2), {"m1": 1.0, "m2": 1.0, "k12": 1.0, "d12": 0.1}
FREE = Chain(2, damped=False)
ACROSS = Chain(2, 1, 1, 2, 1, 2, gap_damper=True)
OMEGA, HERTZ = np.geomspace(0.1, 10, 20), np.arange(1.0, 21.0)
NAN = np.array([[1.0, np.nan]])
MODEL, CIRCUIT = Model.from_chain(DRIVE), network_of("R0-p(R1,C1)")
STRUCTURE, P = DRIVE.structure, np.ones(3)


def measured(hertz: Any = HERTZ, **more: Any) -> measurement.FrequencyResponse:
    """A response without lines that stand out."""
    response = DRIVE.frequency_response(VALUES, 2 * np.pi * hertz)
    return measurement.from_arrays(hertz, response, **more)


TURNING = replace(measured(), output=measurement.Signal("angle", "rad"))
RECORD = measurement.TimeSeries(np.cos(HERTZ), np.sin(HERTZ), 10.0)


def rival() -> fit.Rival:
    """One mass with friction, to be told from one without."""
    brake = Chain(1, ground_dampers=(1,))
    return fit.plan(Chain(1), {"m1": 1.0}, brake, OMEGA, np.full(20, 0.1)).rival


def fitted() -> tuple[fit.Candidate, fit.Task]:
    """One mass, fitted."""
    alone = measurement.from_arrays(HERTZ, np.ones(20) * (1 + 0.01 * np.cos(HERTZ**2)))
    found = fit.select(alone, [Chain(1)])
    return found.described, found.task


Call = tuple[str, Callable[[], object], type[Exception]]
NAMELESS: tuple[Call, ...] = tuple(
    (f".{name}", partial(getattr(disting, name), *more), InputError)
    for name, more in {
        "compare": ("3:1", "nonsense"),
        "dampers": ("nonsense",),
        "next_experiments": (["3:1", "3:4"],),
        "verdicts": (["3:1", "nonsense"],),
        "compare_everywhere": ("3:1", "3:99", ["sensor=2"]),
        "equivalents": ("2:1", {"m1": 1}, "2:2"),
        "everywhere_file": ("3:1", "3:2", ["sensor=9"]),
        "explicit_map": ("nonsense", "3:1"),
        "findings": ("3:1", "nonsense"),
        "gate": (["nonsense", "3:1"],),
        "global_identifiability": ("3:1",),
        "identifiability": ("nonsense",),
        "local_identifiability": ("3:1",),
        "network_of": ("R0-p(R1",),
        "read_models": ("missing.json",),
        "transfer_function": ("nonsense",),
        "values_in": ("R{R=20",),
        "verdict_file": ("3:1", "nonsense"),
        "verify": ({"format": "another"},),
    }.items()
)
CALLS: tuple[Call, ...] = (
    *NAMELESS,
    (".alternatives", lambda: disting.alternatives(MODEL, {"m1": 1}, MODEL), InputError),
    (".catalog", lambda: catalog(99), CatalogError),
    (
        ".positive_shares",
        lambda: disting.positive_shares("3:1", "3:4", bound={"k99": (0, 1)}),
        InputError,
    ),
    (".prove", lambda: disting.prove(disting.compare("1:1", "1:1"), "1:1", "no"), InputError),
    (".write_models", lambda: disting.write_models("/dev/null/m.json", ModelList((MODEL,))), OSError),
    (".Catalog.verdict", lambda: catalog(2).verdict(1, 99), InputError),
    (".Chain", lambda: Chain(0), InputError),
    (".Chain.frequency_response", lambda: DRIVE.frequency_response({"m1": 1.0}, OMEGA), InputError),
    (".Chain.from_written_fields", lambda: Chain.from_written_fields({"no": 1}), TypeError),
    (".Element", lambda: Element("x1", "x", (1, 2)), InputError),
    (
        ".Engine.measured_subject",
        lambda: disting.Engine().measured_subject("", MeasuredChain(ACROSS, ())),
        InputError,
    ),
    (".Experiment", lambda: Experiment(locked=0), InputError),
    (".Experiment.refuse", lambda: Experiment(locked=9).refuse(DRIVE), InputError),
    (".Family.number", lambda: Family(2).number(Chain(3)), InputError),
    (".Finding.from_json", lambda: Finding.from_json("no"), ValueError),
    (".Identifiability.from_dict", lambda: Identifiability.from_dict({}), KeyError),
    (".MatrixModel.from_state_space", lambda: MatrixModel.from_state_space([[1]], [], [[1]]), InputError),
    (".MatrixModel.from_transfer_functions", lambda: MatrixModel.from_transfer_functions([]), InputError),
    (".Model", lambda: Model.from_transfer_function("k/s", name="\x07"), InputError),
    (".Model.from_chain", lambda: Model.from_chain(Chain(1, dead_time=True)), InputError),
    (".Model.from_network", lambda: Model.from_network(network_of("1=2; F1; S1 S2")), InputError),
    (".Model.from_state_space", lambda: Model.from_state_space([["a"]], [], [["1"]]), InputError),
    (".Model.from_transfer_function", lambda: Model.from_transfer_function("1/("), InputError),
    (".ModelList.__getitem__", lambda: ModelList((MODEL,))["other"], InputError),
    (".Network", lambda: Network((), (), ()), InputError),
    (".ParameterIdentifiability.from_dict", lambda: ParameterIdentifiability.from_dict({}), KeyError),
    (".Port", lambda: Port(-1), InputError),
    (".Verdict.from_dict", lambda: Verdict.from_dict({}), KeyError),
    ("measurement.beginnings", lambda: measurement.beginnings("missing.csv"), InputError),
    ("measurement.from_arrays", lambda: measurement.from_arrays([1, 2], [1]), InputError),
    ("measurement.from_control", lambda: measurement.from_control("no"), InputError),
    ("measurement.from_frame", lambda: measurement.from_frame("no"), InputError),
    ("measurement.in_si", lambda: measurement.in_si(measured(), output="foo"), InputError),
    ("measurement.look", lambda: measurement.look("missing.csv"), InputError),
    ("measurement.mean_of", lambda: measurement.mean_of([measured(), measured(HERTZ + 1)]), InputError),
    ("measurement.read", lambda: measurement.read("missing.csv"), InputError),
    ("measurement.read_time_series", lambda: measurement.read_time_series("missing.csv", 1, 2), InputError),
    ("measurement.series_from_frame", lambda: measurement.series_from_frame("no", 1, 2), InputError),
    ("measurement.write_csv", lambda: measurement.write_csv(measured(), "/dev/null/x.csv"), InputError),
    ("measurement.FrequencyResponse", lambda: measurement.FrequencyResponse(OMEGA[:3], OMEGA[:3]), InputError),
    ("measurement.FrequencyResponse.to_quantity", lambda: TURNING.to_quantity("position"), InputError),
    ("measurement.TimeSeries", lambda: measurement.TimeSeries(np.ones(9), np.ones(9), 10.0), InputError),
    ("measurement.TimeSeries.response", lambda: RECORD.response(segment=8, period=8), InputError),
    ("measurement.FrequencyResponse.held", lambda: measured().held(0), InputError),
    ("measurement.FrequencyResponse.masked", lambda: measured().masked(1, 3), InputError),
    ("measurement.FrequencyResponse.subset", lambda: measured().subset([1, 3]), InputError),
    ("report.chain_png", lambda: report.chain_png(DRIVE, scale=0), InputError),
    ("report.network_png", lambda: report.network_png(CIRCUIT, scale=float("nan")), InputError),
    ("report.model_page", lambda: report.model_page(catalog(2), 99), InputError),
    ("report.write_family", lambda: report.write_family(["nonsense"], "x", "folder"), InputError),
    ("report.write_report", lambda: report.write_report([], Path("/dev/null/x")), OSError),
    ("simulation.demo", lambda: simulation.demo(-1), InputError),
    ("simulation.frequency_response", lambda: simulation.frequency_response(DRIVE, {}, OMEGA), InputError),
    ("simulation.matrices", lambda: simulation.matrices(DRIVE, VALUES | {"m1": -1.0}), InputError),
    ("simulation.simulate", lambda: simulation.simulate(DRIVE, {}), InputError),
    ("simulation.simulate_all", lambda: simulation.simulate_all(network_of("1=2; F1; S1; S2"), {}), InputError),
    ("fit.candidates", lambda: fit.candidates([1], sensor="2"), InputError),
    ("fit.fit_networks", lambda: fit.fit_networks(measured(), ["R0-p(R1"]), InputError),
    ("fit.chosen_ports", lambda: fit.chosen_ports([1], "2", "2"), InputError),
    ("fit.collinearity_index", lambda: fit.collinearity_index(NAN), InputError),
    ("fit.condition_indices", lambda: fit.condition_indices(NAN), InputError),
    ("fit.practical", lambda: fit.practical(NAN, ["m1", "m2"], None), InputError),
    ("fit.importance", lambda: fit.importance(NAN), InputError),
    ("fit.control_script", lambda: fit.control_script([fit.NumberedStructure("2:1", DRIVE, VALUES, {})], 3), InputError),
    ("fit.figure_1", lambda: fit.figure_1([0]), InputError),
    ("fit.gain", lambda: fit.gain(rival(), measured(HERTZ + 1)), InputError),
    ("fit.lines_by_coherence", lambda: fit.lines_by_coherence(measured()), InputError),
    ("fit.lines_by_deviation", lambda: fit.lines_by_deviation(measured()), InputError),
    ("fit.margins", lambda: fit.margins(FREE, np.ones(3), fit.Controller(P=1.0)), InputError),
    ("fit.plan", lambda: fit.plan(DRIVE, {}, FREE, OMEGA, OMEGA), InputError),
    ("fit.poles", lambda: fit.poles(STRUCTURE, P), ValueError),
    ("fit.predict", lambda: fit.predict(DRIVE, VALUES, OMEGA, 2), InputError),
    ("fit.profile", lambda: fit.profile(*fitted(), "k9"), InputError),
    ("fit.read_model", lambda: fit.read_model(Path("missing.json")), InputError),
    ("fit.select", lambda: fit.select(measured(), []), InputError),
    ("fit.state_space", lambda: fit.state_space(DRIVE, {}), InputError),
    ("fit.sweep", lambda: fit.sweep([], "beauty"), InputError),
    ("fit.to_control", lambda: fit.to_control(DRIVE, {}), InputError),
    ("fit.to_control_transfer_function", lambda: fit.to_control_transfer_function(DRIVE, {}), InputError),
    ("fit.whole_family", lambda: fit.whole_family([0]), InputError),
    ("fit.write_mat", lambda: fit.write_mat(Path("x.mat"), []), InputError),
    ("fit.zero_pole", lambda: fit.zero_pole(DRIVE, {}), InputError),
    ("fit.zeros", lambda: fit.zeros(STRUCTURE, P), ValueError),
    ("fit.Controller", lambda: fit.Controller(P=float("nan")), InputError),
    ("fit.Setup", lambda: fit.Setup(sign=3), InputError),
    ("fit.Setup.added", lambda: fit.Setup(inertias=(("9", 0.5),)).added(2), InputError),
    ("fit.Setup.experiment", lambda: fit.Setup(locked=("9",)).experiment(2), InputError),
    ("fit.Setup.seen", lambda: fit.Setup(sensor="9").seen(STRUCTURE, disting.Quantity.POSITION), InputError),
    ("fit.Setup.still", lambda: fit.Setup(locked=("9",)).still(2), InputError),
    ("equivalence.assignments", lambda: equivalence.assignments(["m1"]), InputError),
    ("equivalence.chains_of", lambda: equivalence.chains_of("nonsense", DRIVE), InputError),
    ("equivalence.Map.at", lambda: explicit_map("3:1", "3:11").at({"m1": 1}), InputError),
    ("experiments.parse_experiment", lambda: experiments.parse_experiment("sensor=no"), InputError),
    ("experiments.ways", lambda: experiments.ways(DRIVE, DRIVE, [experiments.parse_experiment("sensor=9")]), InputError),
    ("experiments.move", lambda: experiments.move(Experiment(locked=9), ((1, 2),)), KeyError),
    ("experiments.Change", lambda: experiments.Change(LOCK, 2, "0.5"), InputError),
    ("experiments.MeasuredChain", lambda: experiments.MeasuredChain(DRIVE, (Experiment(locked=9),)), InputError),
    ("decide.identifiability.decode", lambda: identifiability.decode("nonsense"), ValueError),
    ("decide.identifiability.identifiability", lambda: identifiability.identifiability("no"), InputError),
)  # fmt: skip

NOT_CAUSED = {
    # a defect of the program alone
    ".Catalog.classes", ".Decisions.classes",
    # where a library is missing
    ".Catalog.plot", ".Chain.to_control", "measurement.FrequencyResponse.plot",
    # by the environment, a disk, a computation that takes too long (with tests of their own)
    ".Store", ".Store.open", "experiments.confirms",
    # no network that can be described is known to be refused
    ".MatrixModel.from_network",
}  # fmt: skip
"""What no call raises."""
ERROR = re.compile(r"\b[A-Z]\w*(?:Error|Violation)\b")
LEAST = 105  # calls


def told(doc: str | None) -> set[str]:
    """The errors that a docstring names before its examples."""
    return set(ERROR.findall((doc or "").split(">>>")[0]))


def documented() -> dict[str, str | None]:
    """Docstrings of public functions, classes and their methods, by room and name; of what several
    rooms have in the first of them.
    """
    found, seen = dict[str, str | None](), set[object]()
    for room in DOCUMENTED:
        for name, thing in callables(room).items():
            if thing in seen or not thing.__module__.startswith("disting"):
                continue
            seen.add(thing)
            here = f"{room.removeprefix('.')}.{name}"
            found[here] = thing.__doc__
            if isinstance(thing, type) and not issubclass(thing, Exception):
                found |= {f"{here}.{n}": doc for n, doc in methods(thing)}
    return found


def methods(thing: type) -> list[tuple[str, str | None]]:
    """Its own public methods with their docstrings."""
    own = ((n, getattr(x, "__func__", x)) for n, x in vars(thing).items())
    return [
        (n, x.__doc__)
        for n, x in own
        if (isinstance(x, FunctionType) and n[0] != "_") or n == "__getitem__"
    ]


def test_docstrings_are_read() -> None:
    assert told("Raises InputError, as `f` does.\n>>> f()  # OSError") == {"InputError"}
    assert told("A value.") == set() and len(documented()) > 300


def test_each_that_names_an_error_is_called_wrongly() -> None:
    named = {name for name, doc in documented().items() if told(doc)}
    called = {name for name, _, _ in CALLS}
    assert named - called == NOT_CAUSED
    assert called <= named and len(CALLS) == len(called) >= LEAST


@pytest.mark.full
@pytest.mark.parametrize(("name", "call", "error"), CALLS, ids=[name for name, _, _ in CALLS])
def test_what_is_raised_is_what_is_told(
    name: str, call: Callable[[], object], error: type[Exception]
) -> None:
    with pytest.raises(error) as raised:
        call()
    assert error.__name__ in told(documented()[name])
    if issubclass(error, DistingError):
        assert len(str(raised.value).split()) > 3, raised.value
