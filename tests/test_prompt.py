"""What a prompt prints and what the Tab key offers."""

import inspect
import subprocess
import sys
from dataclasses import replace
from enum import Enum

import numpy as np
import pytest
from hypothesis import given, strategies as st

import disting
from disting import (
    CONDITIONS,
    Chain,
    Engine,
    Experiment,
    Family,
    MatrixModel,
    Model,
    ModelList,
    Quantity,
    Query,
    Relation,
    Settings,
    Store,
    View,
    alternatives,
    catalog,
    compare,
    compare_everywhere,
    equivalents,
    explicit_map,
    findings,
    gate,
    global_identifiability,
    identifiability,
    local_identifiability,
    network_of,
    verdict_file,
    verify,
)
from disting.catalogs.next_files import next_catalog
from disting.catalogs.sizes import sizes_catalog
from disting.experiments.measured_network import MeasuredNetwork
from disting.fit import figure_1, plan, predict, select
from disting.fit.judge.alternatives import Alternative
from disting.fit.judge.members import Twin
from disting.fit.search.cost import Cost
from disting.fit.search.joint import JointCost
from disting.fit.search.setup import Setup
from disting.measurement import FrequencyResponse, TimeSeries
from disting.model.chain import text_drawing
from disting.model.names import read_together

LONGEST = 120
DRIVE = Chain(2, damped=True, ground_dampers=(1,))
VALUES = {"m1": 0.02, "m2": 0.01, "k12": 500.0, "d12": 0.1, "b1": 0.3}
OMEGA = 2 * np.pi * np.geomspace(5, 200, 60)
ERRORS = np.full(60, 0.01)
DATA = FrequencyResponse(OMEGA, predict(DRIVE, VALUES, OMEGA), input=("F", "N"))


@pytest.fixture(scope="module")
def shown() -> list[object]:
    """One of everything that a user meets on a prompt."""
    family, poles = Family(3, damped=True), Model.from_transfer_function("c", "(s + a)*(s + b)")
    long_name = replace(poles, name="a name of a model that somebody has written " * 2)
    engine = Engine()
    subjects = [engine.subject(f"A{n}", chain) for n, chain in enumerate(family, 1)]
    found = select(DATA, figure_1([1, 2]))
    ones = dict.fromkeys(family[2].parameters, 1)
    listed = equivalents(family[2], ones, family)
    return [
        *(catalog(n, damped=d) for n in range(1, 6) for d in (False, True)),
        *(v for _, _, v in catalog(3, damped=False).pairs()),
        *catalog(3, damped=False).rows,
        *(row.identifiability for row in catalog(4, damped=True).rows),
        *family,
        *CONDITIONS,
        *findings(family[1], family[2]),
        *(step.finding for step in findings(family[1], family[2])),
        family,
        engine,
        Store.none(),
        Settings(),
        Query(),
        engine.decisions(subjects, Query(View.EXACT)),
        compare(poles, long_name),
        verify(verdict_file(family[1], family[2])),
        compare_everywhere(family[1], family[11], ["sensor=3"]),
        Experiment(sensor=(3, 1), inertias={1: "0.5"}, springs={2: 3}, locked=2),
        cell := network_of("R0-p(R1,C1)"),
        *cell.elements,
        *cell.ports,
        poles,
        long_name,
        MatrixModel.from_transfer_functions([["1/(s + a)", 0], ["b/(s + a)", "1/(s + b)"]]),
        identifiability(family[3], experiments=[Experiment(), Experiment(locked=2)]),
        ModelList(
            (poles, Model.from_chain(Chain(1, damped=False), name="mass")), title="two <poles>"
        ),
        alternatives(poles, {"a": 1, "b": 2, "c": 1}, long_name),
        global_identifiability(poles),
        local_identifiability(poles),
        listed,
        *listed.listings,
        *listed,
        explicit_map(family[2], family[5]),
        next_catalog(3, damped=True),
        next_catalog(3, damped=True).further((1, 11)),
        *next_catalog(3, damped=True).further((1, 11)).tables.values(),
        sizes_catalog(damped=False),
        MeasuredNetwork(network_of("1=2; F1; S1"), (Experiment(), Experiment(inertias={1: 1}))),
        Alternative(DRIVE, Relation.UNDECIDED, "It is open."),
        Twin(DRIVE, VALUES, 1),
        JointCost((Cost(DATA), Cost(DATA)), (Setup(), Setup(sensor="2"))),
        gate([Chain(1, damped=False), family[1]], engine=engine),
        designed := plan(DRIVE, VALUES, replace(DRIVE, ground_dampers=(2,)), OMEGA, ERRORS),
        designed.rival,
        DATA,
        TimeSeries(np.sin(np.arange(99.0)), np.cos(np.arange(99.0)), 1000.0),
        found,
        found.task,
        found.explanation,
        found.explanation.scatter,
        *found.candidates,
        *(c.estimate for c in found.candidates),
        *(c.practical for c in found.candidates),
        *found.members,
    ]


@pytest.mark.full
def test_every_object_is_one_short_line(shown):
    for one in shown:
        text = repr(one)
        assert len(text) <= LONGEST and text.isprintable(), text
        assert " object at 0x" not in text and "<function" not in text, text


@pytest.mark.full
def test_every_public_class_is_among_them(shown):
    """A new one needs a line of its own; enumerations, errors and warnings have theirs."""
    public = {
        value
        for name in disting.__all__
        if inspect.isclass(value := getattr(disting, name))
        and not issubclass(value, Enum | Exception)
    }
    assert public - {type(one) for one in shown} == set()


@pytest.mark.full
def test_lines_say_what_is_there(shown):
    lines = {type(one).__name__: repr(one) for one in reversed(shown)}
    assert lines["Catalog"] == "<Catalog: chains-1-undamped, 1 model, 0 pairs>"
    assert repr(catalog(5, damped=False)) == "<Catalog: chains-5-undamped, 73 models, 2628 pairs>"
    assert (
        lines["Verdict"]
        == "<Verdict: 3:1 and 3:2, undamped, acceleration: distinguishable over positive parameters,"
        " proven>"
    )
    assert lines["Selection"] == "<Selection: 2:1+b1 of 24 candidates, 1 not excluded>"
    assert lines["FrequencyResponse"] == "<FrequencyResponse: 60 lines, 5 to 200 Hz, acceleration>"
    assert lines["Twin"] == "<Twin: 2:1+b1, m1=0.02, m2=0.01, k12=500, d12=0.1, b1=0.3>"
    assert lines["JointCost"] == "<JointCost: 2 responses>"
    assert lines["Gate"] == "<Gate: 2 models, 2 kept>"
    assert lines["SizesCatalog"] == "<SizesCatalog: sizes-undamped, 117 models>"
    assert lines["NextCatalog"] == "<NextCatalog: next-3-damped, 3 groups>"
    assert (
        lines["MeasuredNetwork"]
        == "<MeasuredNetwork: 1=2; F1; S1 | as it is | inertia 1 at mass 1>"
    )
    assert lines["Chain"] == "<Chain: 3:1 [1FS]=[2]=[3], damped, acceleration>"


CHAINS = st.builds(
    lambda chain, masses, sensor, flags: replace(
        chain,
        quantity=sensor,
        ground_dampers=tuple(m for m in masses if m <= chain.n_masses),
        lag=flags[0],
        dead_time=flags[1],
    ),
    st.sampled_from([c for n in range(1, 5) for d in (False, True) for c in Family(n, damped=d)]),
    st.sets(st.integers(1, 4)),
    st.sampled_from(Quantity),
    st.tuples(st.booleans(), st.booleans()),
)
SIZES = st.dictionaries(st.integers(1, 9), st.fractions(min_value="1/9"), max_size=2)
EXPERIMENTS = st.builds(
    Experiment,
    force=st.none() | st.integers(1, 9),
    sensor=st.none() | st.tuples(st.integers(2, 9), st.integers(0, 1)),
    quantity=st.none() | st.sampled_from(Quantity),
    locked=st.sets(st.integers(1, 9), max_size=3),
    inertias=SIZES,
    springs=SIZES,
)


@pytest.mark.full
@given(EXPERIMENTS)
def test_what_is_printed_can_be_typed_in(one):
    assert eval(repr(one), {"Experiment": Experiment}) == one


@pytest.mark.full
@given(CHAINS)
def test_a_chain_prints_its_name_and_its_drawing(chain):
    line = repr(chain)
    name = line.removeprefix("<Chain: ").split(" ")[0]
    assert read_together([name], damped=chain.damped, quantity=chain.quantity) == [chain]
    assert f" {text_drawing(chain)}, {chain.premise}>" in line


@pytest.mark.parametrize(
    "one",
    [
        Family(3, damped=False),
        Family(2, damped=True, quantity=Quantity.POSITION),
        Query(),
        Query(View.TF, conditions=("1", "4"), markov=5, inclusion=False),
        Settings(points=4),
    ],
)
def test_so_can_choices(one):
    assert eval(repr(one), {**vars(disting)}) == one


def test_the_tab_key_offers_public_names_only():
    rooms = ["fit", "measurement", "report", "simulation"]
    assert sorted(dir(disting)) == sorted([*disting.__all__, *rooms, "__version__"])
    assert all(hasattr(disting, name) for name in dir(disting))
    assert not [name for name in disting.__all__ if name.startswith("_")]


@pytest.mark.full
def test_rooms_are_imported_when_they_are_named():
    code = (
        "import sys, disting; assert 'disting.fit' not in sys.modules\n"
        "print(disting.fit.select.__name__, disting.transfer_function(disting.Chain(1)))\n"
        "disting.fits"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=600)
    assert done.stdout.split() == ["select", "1/m1"]
    assert "AttributeError: disting has no fits; dir(disting) lists what it has" in done.stderr


def test_the_package_says_that_it_is_typed():
    from importlib.resources import files

    assert files("disting").joinpath("py.typed").is_file()
