"""What was measured: the quantity that nobody named, single bad lines, data given twice; said in
text, in JSON and on the page.
"""

import json

import numpy as np
import pytest

from disting.fit import select
from disting.fit.judge.reading import outside, read_in_words
from disting.fit.search.candidates import chosen_ports
from disting.measurement import read
from disting.model.chain import Chain
from disting.report.fit import fit_page, waterfall
from disting.report.fit.sentences import first_lines, suspicions
from tests.cli.process import called
from tests.fit.drives import OMEGA, response
from tests.measurement.bench_data import measured_data

VALUES = {"m1": 5e-3, "m2": 4e-3, "k12": 800.0, "d12": 0.02, "b1": 0.05, "Td": 1e-4}


def file_of(path, quantity, seed=1, header="f [Hz],Re,Im", damage=None):
    """A CSV file of a motor with friction and a load; `damage` changes its response."""
    chain = Chain(2, damped=True, ground_dampers=(1,), dead_time=True, sensor=quantity)
    measured = response(chain, VALUES, noise=0.01, seed=seed)
    G = measured.G.copy() if damage is None else damage(measured.G.copy())
    rows = zip(measured.frequency.tolist(), G.real.tolist(), G.imag.tolist(), strict=True)
    path.write_text("\n".join([header, *(f"{f},{a},{b}" for f, a, b in rows), ""]))
    return path


def fitted(path, masses=(1, 2), **options):
    measured = read(path)
    return select(measured, candidates(masses, measured.sensor), **options)


def candidates(masses, sensor):
    """With all that a drive may have but friction of the load."""
    chosen = chosen_ports(masses, "1", "1", 0, sensor)
    return [c for c in chosen if c.ground_dampers in ((), (1,))]


@pytest.fixture(scope="module")
def speed(tmp_path_factory):
    return fitted(file_of(tmp_path_factory.mktemp("speed") / "a.csv", "velocity"), (2,))


def test_a_speed_read_as_an_acceleration_is_the_first_suspicion(speed):
    first = suspicions(speed)[0]
    assert first.startswith("read as velocity, 2:1") and "as well or better" in first
    assert "acceleration is assumed; give --quantity velocity, or --quantity acceleration" in first
    assert first_lines(speed)[1] == first
    assert not any("no other sensor quantity" in line for line in first_lines(speed))


def test_the_page_says_it_too(speed):
    page = fit_page(speed, [], [waterfall(speed.described)], speed.task.cost.measured)
    assert page.index("read as velocity, 2:1") < page.index('id="result"')
    assert "frequency in Hz (column 1), real part (column 2)" in page


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
    found = select(data, chosen_ports((1, 2), "1", "1", 0, data.sensor))
    assert found.explanation.explains
    (asked,) = found.quantities
    assert asked.startswith("read as velocity") and "that it is position is assumed" in asked


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


def test_one_bad_line_is_named_and_no_further_mass(tmp_path):
    def damage(G):
        G[60] *= 8
        return G

    found = fitted(file_of(tmp_path / "a.csv", "acceleration", damage=damage), (2,))
    hertz = OMEGA[60] / 2 / np.pi
    said = [line for line in suspicions(found) if f"the line at {hertz:.5g} Hz alone makes" in line]
    assert said and "remove what is bad from the file" in said[0]
    assert not any("one mass more" in line for line in suspicions(found))


def test_test_data_that_are_the_training_data_are_said(tmp_path):
    path = file_of(tmp_path / "a.csv", "acceleration")
    found = fitted(path, (1,), test=read(path))
    assert any("training and test data are the same numbers" in said for said in suspicions(found))
    assert "training and test data are the same numbers" in first_lines(found)[1]
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
        "shows: velocity; 120 lines from 5 to 200 Hz",
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
    chain = Chain(2, damped=True, ground_dampers=(1,), sensor=quantity)
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


@pytest.mark.parametrize(
    ("masses", "lag"), [((2,), False), pytest.param((1, 2), True, marks=pytest.mark.slow)]
)
def test_a_recorded_speed_that_is_taken_as_a_position_is_suspected(tmp_path, masses, lag):
    path = record(tmp_path / "a.csv", "velocity", "t [s],u,y")
    measured = read(path, input="u", output="y", period=1000, to="acceleration")
    assert read_in_words(measured).endswith("sensor: acceleration, from a position (assumed)")
    tried = candidates(masses, measured.sensor)
    found = select(measured, [c for c in tried if lag or not c.lag])
    assert "that it is position is assumed; give --quantity velocity" in suspicions(found)[0]


def test_the_unit_of_a_recorded_output_says_its_quantity(tmp_path):
    path = record(tmp_path / "a.csv", "velocity", "t [s],u [A],y [rad/s]")
    measured = read(path, input="u [A]", output="y [rad/s]", period=1000, to="acceleration")
    assert read_in_words(measured).endswith("; sensor: acceleration")
    exact = response(Chain(2, damped=True, ground_dampers=(1,)), VALUES, omega=measured.omega)
    assert np.median(np.abs(measured.G / exact.G - 1)) < 0.02
