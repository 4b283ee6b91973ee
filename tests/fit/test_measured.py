"""What was measured: the quantity that nobody named, single bad lines, data given twice; said in
text, in JSON and on the page.
"""

import json
from dataclasses import replace

import numpy as np
import pytest
from jsonschema import validate

from disting import InputError
from disting.cli.fit_text import fit_text
from disting.files import Format, json_text, schema
from disting.fit import Case, FurtherResponse, Setup, read_model, select
from disting.fit.judge.readings import bad_lines, outside, quantity_readings, read_in_words
from disting.fit.search.candidates import chosen_ports
from disting.fit.search.joint import JointCost
from disting.measurement import read
from disting.measurement.response import ASSUMED_ACCELERATION
from disting.model.chain import Chain
from disting.report.fit import fit_page
from disting.report.fit.selection_json import selection_to_dict
from disting.report.fit.sentences import first_lines, suspicions
from tests.cli.process import called
from tests.fit.drives import OMEGA, response
from tests.measurement.bench_data import measured_data

pytestmark = pytest.mark.full

VALUES = {"m1": 5e-3, "m2": 4e-3, "k12": 800.0, "d12": 0.02, "b1": 0.05, "Td": 1e-4}


def file_of(path, quantity, seed=1, header="f [Hz],Re,Im", damage=None):
    """A CSV file of a motor with friction and a load; `damage` changes its response."""
    chain = Chain(2, damped=True, ground_dampers=(1,), dead_time=True, quantity=quantity)
    measured = response(chain, VALUES, noise=0.01, seed=seed)
    G = measured.G.copy() if damage is None else damage(measured.G.copy())
    rows = zip(measured.frequency.tolist(), G.real.tolist(), G.imag.tolist(), strict=True)
    path.write_text("\n".join([header, *(f"{f},{a},{b}" for f, a, b in rows), ""]))
    return path


def fitted(path, masses=(1, 2), **options):
    measured = read(path)
    return select(measured, candidates(masses, measured.quantity), **options)


def candidates(masses, sensor):
    """With all that a drive may have but friction of the load."""
    chosen = chosen_ports(masses, "1", "1", 0, sensor)
    return [c for c in chosen if c.ground_dampers in ((), (1,))]


@pytest.fixture(scope="module")
def speed(tmp_path_factory):
    return fitted(file_of(tmp_path_factory.mktemp("speed") / "a.csv", "velocity"), (2,))


def test_of_a_speed_that_nobody_named_the_quantity_is_asked_and_nothing_is_selected(speed):
    assert [r.quantity.value for r in speed.quantities] == ["acceleration", "velocity"]
    assert speed.selected is None and not speed.members and not speed.relied_on
    assert "lag" in speed.quantities[0].name and "lag" not in speed.quantities[1].name
    assert speed.quantities[0].integrates and not speed.quantities[1].integrates
    assert speed.question == first_lines(speed)[1] == suspicions(speed)[0]
    assert "give --quantity acceleration or --quantity velocity" in speed.question
    for reading in speed.quantities:
        assert f"{reading.name} has chi2 {reading.chi2:.3g} per line" in speed.question
    assert "open" in repr(speed)


def test_the_page_asks_for_it_first_and_gives_no_values(speed):
    page = fit_page(speed, [], [], speed.task.cost.measured)
    assert page.index(speed.question) < page.index("<main>")
    assert "frequency in Hz (column 1), real part (column 2)" in page
    assert "--quantity velocity" in page and "explains" not in page
    for word in ("95 %", "k12", "stiffness"):
        assert word not in page


def test_neither_text_nor_notebook_nor_file_of_it_gives_values(speed, tmp_path):
    lines, file = list(fit_text(speed, speed.task.cost.measured)), tmp_path / "fit.json"
    assert speed.question in lines and any(line.startswith("no values are given") for line in lines)
    for quantity in ("acceleration", "velocity"):
        assert sum(line.startswith(f"{quantity} ") for line in lines) == 1  # of the table
        assert any(f"--quantity {quantity}" in x for x in lines[lines.index("next:") :])
    shown = speed._repr_html_()
    assert speed.question in shown and shown.count("<tr>") == 3
    for text in ("\n".join(lines), shown):
        assert "explains" not in text and "k12" not in text
    file.write_text(json_text(selection_to_dict(speed)))
    with pytest.raises(InputError, match="do not determine which quantity"):
        read_model(file)


@pytest.mark.slow
def test_the_command_asks_for_it_and_its_file_leads_nowhere(tmp_path):
    """Status 1, the same sentence on the page and in JSON, and no value by any door."""
    path, file = file_of(tmp_path / "a.csv", "velocity"), tmp_path / "fit.json"
    done = called("fit", path, "--masses", "2", "--json", file, "--out", tmp_path / "out")
    assert done.returncode == 1
    asked = next(line for line in done.stdout.splitlines() if line.startswith("the data do not"))
    assert "explains" not in done.stdout and "k12" not in done.stdout
    assert f"disting fit {path} --quantity velocity" in done.stdout
    assert asked in (tmp_path / "out" / "fit.html").read_text(encoding="utf-8")
    plain = json.loads(file.read_text(encoding="utf-8"))
    assert (plain["status"], plain["explained"], plain["selected"]) == (
        "quantity not settled", False, None,
    )  # fmt: skip
    validate(plain, schema(Format.FIT))
    assert plain["question"] == asked and plain["not_excluded"] == plain["relied_on"] == []
    assert not (tmp_path / "out" / "model.mat").exists()
    for words in (("next", file), ("plan", file), ("fit", path, "--left", file)):
        refused = called(*words)
        assert refused.returncode == 2 and asked in refused.stderr
    with pytest.raises(InputError, match="do not determine which quantity"):
        read_model(file)
    named = called("fit", path, "--masses", "2", "--quantity", "speed")
    assert named.returncode == 0 and "explains this data" in named.stdout


@pytest.mark.slow
def test_several_responses_and_another_cost_ask_for_it_too(tmp_path):
    """Of two sensors, and with the cost of the paper, the same question."""
    measured = read(file_of(tmp_path / "a.csv", "velocity"))
    at_load = Chain(2, 0, 0, 1, 0, 2, "velocity", True, (1,), dead_time=True)
    load = replace(response(at_load, VALUES, noise=0.01, seed=5), quantity="acceleration")
    second = FurtherResponse(load, Setup(sensor="2"))
    chosen = [c for c in candidates((2,), measured.quantity) if c.lag and c.dead_time]
    both = select(measured, chosen, further=[second])
    assert both.explanation.explains and both.selected is None
    assert [r.quantity.value for r in both.quantities] == ["acceleration", "velocity"]
    paper = select(measured, chosen, case=Case.COMPLEX)
    assert paper.question and paper.selected is None


def test_of_another_cost_the_quantity_is_asked_as_well():
    """Of one mass: what the paper's cost fits is fitted again by logarithms."""
    chain = Chain(1, damped=True, ground_dampers=(1,), quantity="velocity")
    exact = response(chain, VALUES, noise=0.01)
    measured = replace(exact, quantity="acceleration", notes=(ASSUMED_ACCELERATION,))
    tried = [replace(chain, quantity="acceleration", lag=True, dead_time=True)]
    asked = [
        quantity_readings([c.estimate for c in found.candidates], None, found.task)
        for found in (select(measured, tried), select(measured, tried, case=Case.COMPLEX))
    ]
    for readings in asked:
        assert [r.quantity.value for r in readings] == ["acceleration", "velocity"]


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_an_acceleration_that_is_assumed_and_is_one_is_no_suspicion(tmp_path, seed):
    found = fitted(file_of(tmp_path / "a.csv", "acceleration", seed), (2,))
    assert found.quantities == () and found.explanation.explains


@pytest.mark.parametrize("masses", [(1,), pytest.param((1, 2), marks=pytest.mark.slow)])
def test_a_free_mass_is_no_speed_under_a_damper(tmp_path, masses):
    chain = Chain(1, damped=True, ground_dampers=(1,), dead_time=True)
    measured = response(chain, VALUES, noise=0.01)
    rows = zip(measured.frequency, measured.G.real, measured.G.imag, strict=True)
    text = "\n".join(["f [Hz],Re,Im", *(f"{f},{a},{b}" for f, a, b in rows)])
    (tmp_path / "a.csv").write_text(text)
    assert fitted(tmp_path / "a.csv", masses).quantities == ()


@pytest.mark.slow
def test_the_quantity_of_an_axis_with_dry_friction_is_asked():
    """Friction scatters the lines so much that a speed explains them too: that it is a position is
    said to be assumed.
    """
    data = read(measured_data("EMPS.mat"), input="vir", output="qm", reference="qg", segment=4096)
    found = select(data, chosen_ports((1, 2), "1", "1", 0, data.quantity))
    assert found.explanation.explains
    assert [r.quantity.value for r in found.quantities] == ["position", "velocity"]
    assert found.selected is None


def test_a_quantity_that_is_said_is_not_doubted(tmp_path):
    path = file_of(
        tmp_path / "a.csv", "acceleration", header="f [Hz],Re [rad/s^2/A],Im [rad/s^2/A]"
    )
    found = fitted(path, (1,))
    assert found.quantities == ()
    assert read_in_words(found.task.cost.measured).endswith("; sensor: acceleration")


def test_a_lag_below_the_band_integrates(speed):
    lagging = [c for c in speed.candidates if c.chain.lag and c.chain.n_masses == 2]
    best = min(lagging, key=lambda c: c.j_train)
    (said,) = outside(best, speed.task.cost.measured)
    assert "below the lowest line (5 Hz): over the whole band it integrates" in said


def test_a_dead_time_longer_than_a_period_of_the_lowest_line_is_doubted(speed):
    best = min(speed.candidates, key=lambda c: c.j_train)
    late = replace(best.estimate, parameters=best.estimate.parameters | {"T1": 0.0, "Td": 0.3})
    (said,) = outside(replace(best, estimate=late), speed.task.cost.measured)
    assert said.startswith("the dead time Td = 0.3 s is longer than a period of the lowest line (5")


def test_a_response_that_was_integrated_says_of_what_it_is(speed):
    measured = replace(speed.task.cost.measured, quantity="velocity")
    assert read_in_words(measured).endswith("; sensor: velocity, from acceleration (assumed)")


def test_lines_that_alone_make_the_misfit_are_named():
    """Of a structure as large as the best one, or smaller, and of one response only."""
    chain = Chain(1, damped=True, ground_dampers=(1,))
    found = select(response(chain, VALUES, noise=0.01), [chain])
    measured, cost = found.task.cost.measured, found.task.cost
    hertz = [f"{f:.5g}" for f in measured.frequency]
    for lines, said in (
        ([60], f"the line at {hertz[60]} Hz alone makes"),
        ([20, 60], f"the lines at {hertz[20]}, {hertz[60]} Hz alone make"),
        ([20, 40, 60], None),
        ([], None),
    ):
        G = measured.G.copy()
        G[lines] *= 4
        task = replace(found.task, cost=replace(cost, measured=replace(measured, G=G)))
        told = bad_lines(found.candidates, found.described, task)
        assert told is None if said is None else told.startswith(said) and "1:1+b1" in told
        joint = replace(task, cost=JointCost((task.cost,), (Setup(),)))
        assert bad_lines(found.candidates, found.described, joint) is None


@pytest.mark.slow
def test_one_bad_line_is_named_and_no_further_mass(tmp_path):
    def damage(G):
        G[60] *= 8
        return G

    measured = read(file_of(tmp_path / "a.csv", "acceleration", damage=damage))
    tried = [c for c in candidates((2,), measured.quantity) if c.dead_time and not c.lag]
    found = select(measured, tried)
    hertz = OMEGA[60] / 2 / np.pi
    said = [line for line in suspicions(found) if f"the line at {hertz:.5g} Hz alone makes" in line]
    assert said and "remove what is bad from the file" in said[0]
    assert not any("one mass more" in line for line in suspicions(found))


def test_test_data_that_are_the_training_data_are_said(tmp_path):
    path = file_of(tmp_path / "a.csv", "acceleration")
    found = fitted(path, (1,), test=read(path))
    assert any("training and test data are the same numbers" in said for said in suspicions(found))
    assert "training and test data are the same numbers" in first_lines(found)[0]
    other = fitted(path, (1,), test=read(file_of(tmp_path / "b.csv", "acceleration", 2)))
    assert not any("the same numbers" in said for said in suspicions(other))


def test_the_command_says_first_how_the_file_was_read(tmp_path):
    path = file_of(tmp_path / "a.csv", "velocity")
    done = called(
        "fit", path, "--masses", "1", "--quantity", "velocity", "--json", tmp_path / "fit.json"
    )
    assert done.returncode == 1, done.stderr  # one mass does not explain it
    assert done.stdout.splitlines()[:4] == [
        "a.csv, column 2 (Re)",
        "columns: frequency in Hz (column 1), real part (column 2), imaginary part (column 3)",
        "shows: velocity; 120 lines from 5 to 300 Hz",
        "",
    ]
    plain = json.loads((tmp_path / "fit.json").read_text())
    assert plain["data"] == [
        {
            "origin": "a.csv, column 2 (Re)",
            "reading": "frequency in Hz (column 1), real part (column 2), imaginary part (column 3)",
            "quantity": "velocity",
            "quantity_assumed": False,
            "notes": [],
        }
    ]


def test_falling_frequencies_and_a_wrong_unit_are_in_the_json(tmp_path):
    path = tmp_path / "a.csv"
    rows = [f"{f},{5 + 0.1 * np.sin(f)},{0.1 * np.cos(f)}" for f in range(30, 0, -1)]
    path.write_text("\n".join(["f [rad/s],Re,Im", *rows, ""]))
    done = called("fit", path, "--masses", "1", "--json", "-")
    plain = json.loads(done.stdout)
    assert (
        "the frequencies were not in rising order and have been sorted" in plain["data"][0]["notes"]
    )
    assert plain["data"][0]["quantity_assumed"] is True
    assert any("give --unit frequency=Hz" in said for said in plain["suspicions"])


def test_a_file_that_is_not_understood_shows_its_rows(tmp_path):
    (tmp_path / "a.csv").write_text(
        "Punkt,Wert,Lage\n" + "".join(f"{i},-{i},{9 * i}\n" for i in range(1, 20))
    )
    done = called("fit", tmp_path / "a.csv")
    assert done.returncode == 2
    assert "disting fit a.csv --read columns=Hz,dB,deg" in done.stderr
    assert "  1 Punkt" in done.stderr and "1, 2, 3, .." in done.stderr


def record(path, quantity, header, seed=3):
    """Three periods of 1 s of a multisine from 5 to 200 Hz, and what the sensor shows of it."""
    lines = np.arange(5, 201)
    chain = Chain(2, damped=True, ground_dampers=(1,), quantity=quantity)
    exact = response(chain, VALUES, omega=2 * np.pi * lines)
    source, spectrum = np.random.default_rng(seed), np.zeros(501, dtype=complex)
    spectrum[lines] = np.exp(2j * np.pi * source.random(len(lines)))
    u = np.tile(np.fft.irfft(spectrum, 1000), 3)
    spectrum[lines] *= exact.G
    y = np.tile(np.fft.irfft(spectrum, 1000), 3)
    y += 0.003 * y.std() * source.normal(size=len(y))
    rows = zip(np.arange(3000) / 1000, u.tolist(), y.tolist(), strict=True)
    path.write_text("\n".join([header, *(f"{t},{a},{b}" for t, a, b in rows), ""]))
    return path


@pytest.mark.slow
@pytest.mark.parametrize(
    ("masses", "lag"), [((2,), False), pytest.param((1, 2), True, marks=pytest.mark.slow)]
)
def test_a_recorded_speed_that_is_taken_as_a_position_is_suspected(tmp_path, masses, lag):
    path = record(tmp_path / "a.csv", "velocity", "t [s],u,y")
    measured = read(path, input="u", output="y", period=1000, to="acceleration")
    assert read_in_words(measured).endswith("sensor: acceleration, from a position (assumed)")
    tried = candidates(masses, measured.quantity)
    found = select(measured, [c for c in tried if lag or not c.lag])
    assert [r.quantity.value for r in found.quantities][:2] == ["position", "velocity"]
    assert any("give --quantity" in said and "velocity" in said for said in suspicions(found))


def test_the_unit_of_a_recorded_output_says_its_quantity(tmp_path):
    path = record(tmp_path / "a.csv", "velocity", "t [s],u [A],y [rad/s]")
    measured = read(path, input="u [A]", output="y [rad/s]", period=1000, to="acceleration")
    assert read_in_words(measured).endswith("; sensor: acceleration")
    exact = response(Chain(2, damped=True, ground_dampers=(1,)), VALUES, omega=measured.omega)
    assert np.median(np.abs(measured.G / exact.G - 1)) < 0.02
