"""disting fit of several responses: columns and files, experiments, what is refused."""

import json
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from jsonschema import validate

from disting.cli.fit_data import data
from disting.cli.run import parser
from disting.fit.search.cost import Cost
from disting.fit.search.joint import FurtherResponse, JointCost, with_dead_times
from disting.fit.search.setup import Setup
from disting.fit.select import select
from disting.measurement import FrequencyResponse, read
from disting.model.chain import Chain
from disting.report.fit.selection_json import selection_to_dict
from disting.schemas import Format, schema
from tests.cli.process import called

DRIVE = Chain(2, damped=True, ground_dampers=(2,), dead_time=True)
VALUES = {"m1": 0.01, "m2": 0.004, "k12": 800.0, "d12": 0.05, "b2": 0.1, "Td": 2e-4, "Td2": 6e-4}
OMEGA = 2 * np.pi * np.geomspace(10.0, 200.0, 40)


def column(setup: Setup, seed: int, level: float = 0.003) -> np.ndarray:
    """A response of the drive under a setup, with relative noise."""
    data = FrequencyResponse(OMEGA, np.ones(len(OMEGA)))
    delays = (setup.delay,) if setup.delay else ()
    plant = JointCost((Cost(data),), (setup,), delays).plant(DRIVE.structure, 1)
    exact = plant.response(np.array([VALUES[n] for n in plant.parameters]))
    source = np.random.default_rng(seed)
    error = source.normal(size=len(OMEGA)) + 1j * source.normal(size=len(OMEGA))
    return exact * (1 + level * error / np.sqrt(2))


def written(path: Path, *columns: np.ndarray) -> Path:
    """A table of responses, their names those of the sensors."""
    names = ["motor", "load"][: len(columns)]
    header = ",".join(["f [Hz]", *(f"Re {n},Im {n}" for n in names)])
    rows = np.column_stack(
        [OMEGA / (2 * np.pi), *(part for c in columns for part in (c.real, c.imag))]
    )
    np.savetxt(path, rows, delimiter=",", header=header, comments="")
    return path


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    """One file with both sides, a file of each, one with a locked load, one with an inertia."""
    folder = tmp_path_factory.mktemp("bench")
    motor, load = column(Setup(), 1), column(Setup(sensor="2"), 2, 0.01)
    late = column(Setup(sensor="2", delay="Td2"), 2, 0.01)
    locked = column(Setup(locked=("2",)), 3)
    heavier = column(Setup(inertias=(("2", 0.004),)), 4)
    return {
        "both": written(folder / "both.csv", motor, load),
        "motor": written(folder / "motor.csv", motor),
        "load": written(folder / "load.csv", load),
        "turned": written(folder / "turned.csv", -load),
        "late": written(folder / "late.csv", late),
        "locked": written(folder / "locked.csv", locked),
        "heavier": written(folder / "heavier.csv", heavier),
        "record": record(folder / "record.csv"),
    }


def record(path: Path) -> Path:
    """Samples of a torque and of what two sensors show."""
    samples = np.random.default_rng(0).normal(size=(400, 3))
    table = np.column_stack([np.arange(400) / 1000, samples])
    header = "t [s],torque [Nm],motor [rad],load [rad]"
    np.savetxt(path, table, delimiter=",", header=header, comments="")
    return path


def fitted(*arguments, status=0):
    """The selection and what is printed; `status` 1: no candidate explains the data."""
    path = arguments[0].with_name("fit.json")
    done = called("fit", *arguments, "--masses", "2", "--fix", "d12=0.05", "--json", path)
    assert done.returncode == status, done.stderr
    return json.loads(path.read_text(encoding="utf-8")), done.stdout


def close(found, share):
    values = found["selected"]["parameters"]
    assert all(values[n] == pytest.approx(VALUES[n], rel=share) for n in values), values


def parsed(*arguments):
    """What the command would fit."""
    return data(parser().parse_args(["fit", *map(str, arguments)]))


@pytest.mark.full
def test_columns_and_files_of_two_sensors_are_the_same_data(bench):
    columns = parsed(bench["both"], "--sensor", "1,2")
    named = parsed(bench["both"], "--sensor", "1,2", "--column", "Re motor,Re load")
    files = parsed(bench["motor"], bench["load"], "--sensor", "1,2")
    swapped = parsed(bench["both"], "--sensor", "2,1", "--column", "Re load,Re motor")
    for one in (named, files):
        np.testing.assert_array_equal(one.train.G, columns.train.G)
        np.testing.assert_array_equal(one.further[0].measured.G, columns.further[0].measured.G)
    assert columns.further[0].setup == Setup(sensor="2") and columns.further[0].test is None
    assert swapped.train == columns.further[0].measured
    assert swapped.further[0] == FurtherResponse(columns.train, Setup(sensor="1"))


@pytest.mark.full
def test_test_data_go_to_their_sensors(bench):
    found = parsed(bench["both"], "--sensor", "1,2", "--test", bench["both"])
    assert found.test == found.train and found.further[0].test == found.further[0].measured
    found = parsed(
        *(bench["both"], "--sensor", "1,2", "--band", "20..100"),
        *("--test", bench["motor"], "--test", bench["load"]),
    )
    assert len(found.train) == len(found.further[0].test) == 20


@pytest.mark.full
def test_experiments_say_what_is_locked_and_what_is_added(bench):
    found = parsed(
        bench["both"],
        *("--sensor", "1,2", "--sign=-,+", "--dead-time", "own"),
        *("--experiment", f"{bench['locked']}:lock=2,sensor=1"),
        *("--experiment", f"{bench['both']}:inertia=2:0.004,inertia=1:1e-3"),
        *("--experiment", f"{bench['both']}:sensor=1:2,lock=last,column=Re load"),
        *("--experiment", f"{bench['locked']}:brake=1:0.3,spring=last:1/3,sensor=1"),
    )
    load, locked, heavy, loaded, between, braked = with_dead_times(found.further, "own")
    inertias = (("2", 0.004), ("1", 0.001))
    assert load.setup == Setup("2", sign=-1, delay="Td2")
    assert locked.setup == Setup("1", locked=("2",), delay="Td3")
    assert heavy.setup == Setup(inertias=inertias, delay="Td4")
    assert loaded.setup == Setup("2", inertias=inertias, sign=-1, delay="Td5")
    assert between.setup == Setup("1:2", locked=("last",), delay="Td6")
    known = {"brakes": (("1", 0.3),), "springs": (("last", "1/3"),)}
    assert braked.setup == Setup("1", delay="Td7", **known)
    for one, same in ((loaded, load.measured), (between, load.measured), (heavy, found.train)):
        np.testing.assert_array_equal(one.measured.G, same.G)


@pytest.mark.slow
def test_two_sensors_are_fitted_together(bench):
    """The drive is found, each response explained."""
    found, said = fitted(bench["both"], "--sensor", "1,2")
    assert [r["measured"] for r in found["responses"]] == ["the first response", "sensor 2"]
    assert [r["lines"] for r in found["responses"]] == [40, 40]
    assert found["explained"] and found["selected"]["name"] == "2:1+b2+delay"
    close(found, 0.1)
    assert "candidates fitted to 40 + 40 frequency lines of 2 responses, validated on " in said
    assert "\n  sensor 2: chi2 per line " in said


@pytest.mark.slow
def test_what_is_zero_teaches_nothing_and_the_output_says_so(bench):
    """A locked mass carries the force."""
    found, said = fitted(bench["motor"], "--experiment", f"{bench['locked']}:lock=1")
    zero = "mass 1 locked"
    assert f"  {zero}: that response is zero whatever the parameters, so nothing is" in said
    assert found["nothing_learned"] == [zero] and len(found["responses"]) == 1


@pytest.mark.slow
def test_a_locked_mass_and_a_known_inertia_are_fitted_with_it(bench):
    found, _ = fitted(
        bench["motor"],
        *("--experiment", f"{bench['locked']}:lock=2"),
        *("--experiment", f"{bench['heavier']}:inertia=2:0.004"),
    )
    said = [r["measured"] for r in found["responses"]]
    assert said[1:] == ["mass 2 locked", "inertia 0.004 at mass 2"]
    close(found, 0.05)


@pytest.mark.slow
def test_dead_times_are_shared_or_not_as_asked(bench):
    both = (bench["motor"], bench["late"], "--sensor", "1,2")
    own, _ = fitted(*both, "--dead-time", "own")
    assert own["selected"]["parameters"]["Td2"] == pytest.approx(6e-4, rel=0.1)
    assert own["selected"]["parameters"]["Td"] == pytest.approx(2e-4, rel=0.1)
    assert [r["dead_time"] for r in own["responses"]] == ["Td", "Td2"]
    assert own["explained"] and not fitted(*both, status=1)[0]["explained"]


@pytest.mark.slow
def test_each_sensor_has_its_sign(bench):
    both = (bench["motor"], bench["turned"], "--sensor", "1,2")
    given, found = fitted(*both, "--sign=+,-")[0], fitted(*both, "--sign", "auto")[0]
    assert given["selected"] == found["selected"] and given["explained"]
    assert [r["sign"] for r in found["responses"]] == [1, -1]


REFUSED = [
    (["motor", "--sensor", "1,2"], "motor.csv holds 1 response, for 2 sensors: give a file or a"),
    (["motor", "load"], "2 files of TRAIN and 1 sensor: name a place for each file"),
    (["motor", "load", "--sensor", "1,5"], "there is no place 5 in a chain of 2 masses"),
    (["motor", "load", "--sensor", "1,2", "--sign=+,-,+"], "3 signs, 2 sensors: give one for each"),
    (["motor", "--experiment", "{locked}:lock=7"], "there is no mass 7 in a chain of 2 masses"),
    (["motor", "--experiment", "{locked}:lock=1+2"], "all masses of a chain of 2 are locked"),
    (["motor", "--experiment", "{locked}:inertia=1:-1"], "a known inertia is positive"),
    (["motor", "--experiment", "{locked}:brake=1:generic"], "a known brake that was measured with"),
    (["motor", "--experiment", "{locked}:brake=x:1"], "a mass is a number or the word last"),
    (
        ["motor", "--experiment", "{locked}:inertia=1"],
        "size of a known inertia is missing: write inertia=1:1",
    ),
    (["motor", "--experiment", "{locked}"], "an experiment is written FILE:lock=2"),
    (["motor", "--experiment", "{locked}:torque=2"], "an experiment is written FILE:lock=2"),
    (["motor", "--experiment", "{locked}:column=2"], "an experiment is written FILE:lock=2"),
    (
        ["both", "--sensor", "1,2", "--column", "1,2,3"],
        "column is given for 3 responses, but there are 2",
    ),
    (
        ["record", "--sensor", "1,2"],
        "record.csv: name the response of each sensor, as --read output=a,b",
    ),
    (["motor", "--experiment", "nowhere.csv:lock=2"], "there is no file nowhere.csv"),
    (["motor", "load", "--sensor", "1,2", "--family"], "--family moves the sensor and is not"),
    (["both", "--sensor", "1,2", "--test", "{motor}"], "motor.csv holds 1 response"),
]


@pytest.mark.thin(8)
@pytest.mark.parametrize(("arguments", "said"), REFUSED)
def test_what_cannot_be_fitted_is_refused_in_a_sentence(bench, arguments, said):
    given = [bench.get(a, a.format(**bench)) for a in arguments]
    done = called("fit", *given, "--masses", "2")
    assert done.returncode == 2 and said in done.stderr and "Traceback" not in done.stderr


MACHINE = Chain(3, 2, 2, 3, 2, 3, damped=True)  # 3:11: an experiment on 3:1 is one on it too
OF_MACHINE = dict(zip(MACHINE.parameters, (1.1, 1.3, 1.1, 34e3, 66e3, 23.0, 17.0), strict=True))


@pytest.fixture(scope="module")
def left(tmp_path_factory):
    """The file of what a first fit of the machine leaves, of 3:1 alone: what cannot be told from it
    is found in the catalogue.
    """
    path = tmp_path_factory.mktemp("machine") / "left.json"
    words = machine_fit(measured_machine(path.with_name("first.csv"), Setup(), 0))
    found = select(read(words[1], quantity="acceleration"), [Chain(3, damped=True)])
    plain = selection_to_dict(replace(found, command=shlex.join(["disting", *map(str, words)])))
    path.write_text(json.dumps(plain), encoding="utf-8")
    return path


def machine_fit(table):
    return ("fit", table, "--quantity", "acceleration", "--jobs", "1")


def measured_machine(path, setup, seed):
    """A table of the machine's response under a setup, with noise of 0.2 %."""
    omega = 2 * np.pi * np.geomspace(3.0, 150.0, 80)
    cost = JointCost((Cost(FrequencyResponse(omega, np.ones(80))),), (setup,))
    source = np.random.default_rng(seed)
    error = source.normal(size=80) + 1j * source.normal(size=80)
    values = np.array([OF_MACHINE[name] for name in MACHINE.parameters])
    G = cost.plant(MACHINE.structure, 1).response(values) * (1 + 0.002 * error)
    table = np.column_stack([omega / (2 * np.pi), G.real, G.imag])
    np.savetxt(path, table, delimiter=",", header="f [Hz],Re,Im", comments="")
    return path


@pytest.mark.full
def test_what_a_fit_left_is_measured_next_by_the_command_that_is_named(left):
    plain = json.loads(left.read_text(encoding="utf-8"))
    assert plain["selected"]["name"] == "3:1"
    assert "3:11" in [twin["name"] for twin in plain["not_excluded"][0]["equivalents"]]
    onward = called("next", left).stdout
    assert f"--left {left} --experiment NEW:sensor=2" in onward.splitlines()[-1]


@pytest.mark.full
@pytest.mark.parametrize(
    ("setup", "said"),
    [
        (Setup(sensor="1"), "sensor=2"),
        pytest.param(Setup(sensor="3"), "sensor=2", marks=pytest.mark.slow),
        pytest.param(Setup(force="2"), "force=3", marks=pytest.mark.slow),
        pytest.param(Setup(inertias=(("3", 0.5),)), "inertia=2:0.5", marks=pytest.mark.slow),
    ],
)
def test_a_joint_fit_finds_the_twin_that_is_the_truth(tmp_path, left, setup, said):
    """The set that a fit left, measured as one of its structures would be: what is a mass of that
    one is some mass of the others.
    """
    further = measured_machine(tmp_path / "next.csv", setup, 1)
    again = machine_fit(left.with_name("first.csv"))
    path = tmp_path / "both.json"
    done = called(*again, "--left", left, "--experiment", f"{further}:{said}", "--json", path)
    found = json.loads(path.read_text(encoding="utf-8"))
    validate(found, schema(Format.FIT))
    assert found["explained"] and found["selected"]["name"] == "3:11"
    assert {"name": "3:11", "measured": setup.text} in found["places"]
    assert f"in 3:11 this is {setup.text}" in done.stdout


def test_what_names_candidates_twice_is_refused(tmp_path):
    np.savetxt(tmp_path / "a.csv", np.ones((9, 3)) * np.arange(1, 10)[:, None])
    done = called("fit", tmp_path / "a.csv", "--left", tmp_path / "fit.json", "--masses", "2")
    assert done.returncode == 2 and "remove --masses" in done.stderr
