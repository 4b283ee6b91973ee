"""disting plan on the command line: pairs, files of fits, and what it writes."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from disting.export import predict
from disting.fit import select
from disting.measurement import FrequencyResponse, read, write_csv
from disting.model.chain import Chain
from disting.planning.power import plan
from disting.report.fit import selection_to_dict
from tests.cli.process import called
from tests.fit.drives import response
from tests.fit.monte_carlo import drive, measured, offered, truth

GUIDE = Path(__file__).parents[2] / "disting" / "guide" / "plan.md"
VALUES = "m1=0.0045,m2=0.005,k12=550,d12=0.08,b1=0.1"
PAIR = ("2:1+b1", "2:1+b2", "--damped", "--set", VALUES, "--band", "5..300")
MODEL, RIVAL = (Chain(2, damped=True, ground_dampers=(i,)) for i in (1, 2))
NUMBERS = {"m1": 0.0045, "m2": 0.005, "k12": 550.0, "d12": 0.08, "b1": 0.1}


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plan")
    return called("plan", *PAIR, "--noise", 0.3, "--out", folder), folder


@pytest.mark.full
def test_answer_comes_first_with_what_is_needed(written):
    done, _ = written
    assert done.returncode == 0
    first, verdict, *rest = done.stdout.splitlines()
    assert first == (
        "not enough: if the machine is 2:1+b1, the data exclude 2:1+b2 with a probability of 72 %"
        " (level 1 %); for 95 % measure 1.77 times as many periods"
    )
    assert verdict.startswith(
        "verdict: 2:1+b1 and 2:1+b2, damped, acceleration, are distinguishable over positive"
    )
    text = "\n".join(rest)
    assert "  noise of a line at most 23 %\n  1.77 times the periods\n" in text
    assert "1 degree of freedom (2:1+b1+b2 contains both)" in text and ": agreed" in text
    assert "with the scatter that a fit finds in one measurement" in text


@pytest.mark.full
def test_the_guide_shows_what_is_printed(written):
    """Up to the spectra, whose last digits depend on the machine's linear algebra."""
    done, _ = written
    told, _, _ = done.stdout.partition("excitation of the same power")
    assert len(told.splitlines()) > 15 and told in GUIDE.read_text(encoding="utf-8")


@pytest.mark.full
def test_written_spectrum_is_run_by_the_command_that_is_named(written, tmp_path):
    done, folder = written
    command = done.stdout.splitlines()[-1].split()
    assert command[:2] == ["disting", "simulate"]
    ran = called(*command[1:], "--csv", tmp_path / "frf.csv")
    assert ran.returncode == 0, ran.stderr
    seen = read(tmp_path / "frf.csv")
    assert predict(MODEL, NUMBERS, seen.omega) == pytest.approx(seen.G, rel=1e-5)
    plain = json.loads((folder / "plan.json").read_text(encoding="utf-8"))
    assert len(seen) <= len(plain["frequency"]) == 120
    assert plain["optimal"]["noncentrality"] > 4 * plain["noncentrality"]
    rows = list(csv.DictReader((folder / "lines.csv").open(encoding="utf-8")))
    difference = np.array([float(row["difference"]) for row in rows])
    assert np.sum(difference**2) == pytest.approx(1.0493, abs=1e-4)
    assert {p.name for p in folder.iterdir()} == {
        "plan.svg", "plan.png", "plan.pdf", "plan.json", "lines.csv", "spectrum.csv",
    }  # fmt: skip


def test_indistinguishable_pair_is_impossible_and_next_is_named():
    values = "m1=1,m2=2,m3=3,k12=100,k23=50,d12=0.1,d23=0.3"
    done = called(
        "plan", "3:1", "3:11", "--damped", "--set", values, "--noise", "0.02", "--band", "0.1..10"
    )
    assert done.returncode == 0
    first, verdict = done.stdout.splitlines()[:2]
    assert first.startswith("impossible: however long") and first.endswith(
        "disting next 3:1 3:11 --damped"
    )
    assert "are indistinguishable over positive parameters" in verdict


def test_a_plan_without_anything_to_measure_is_not_written(tmp_path):
    """Lines that scatter much are said to give a rough estimate before."""
    values = "m1=1,m2=2,m3=3,k12=100,k23=50,d12=0.1,d23=0.3"
    words = "--damped", "--set", values, "--noise", "0.6", "--band", "0.1..10"
    done = called("plan", "3:1", "3:11", *words, "--out", tmp_path / "plan")
    rough, refusal = done.stderr.splitlines()
    assert "lines scatter by more than" in rough and "the power is a rough estimate" in rough
    assert refusal.endswith("there is nothing to measure, so nothing is written: remove --out")
    assert done.returncode == 2 and not (tmp_path / "plan").exists()


@pytest.mark.full
def test_noise_of_a_measured_response_is_taken_line_by_line(tmp_path):
    exact = response(MODEL, NUMBERS)
    rho = np.geomspace(0.3, 0.03, len(exact))
    path = tmp_path / "frf.csv"
    deviation = np.abs(exact.G) * rho * np.sqrt(2)
    write_csv(FrequencyResponse(exact.omega, exact.G, deviation), path)
    done = called("plan", *PAIR[:5], "--noise", path, "--json", "-")
    plain = json.loads(done.stdout)
    assert plain["noise"] == pytest.approx(np.mean(rho**-2.0) ** -0.5, rel=0.01)
    assert plain["largest_noise"] == pytest.approx(
        plain["noise"] * np.sqrt(plain["noncentrality"] / plain["needed_noncentrality"]), rel=1e-6
    )


@pytest.fixture(scope="module")
def fit_file(tmp_path_factory):
    """Of data that are too loud to see the friction: the structure without any is selected."""
    candidates = [MODEL, RIVAL, Chain(2, damped=True)]
    found = select(response(MODEL, NUMBERS | {"b1": 0.006}, noise=0.1, seed=5), candidates)
    path = tmp_path_factory.mktemp("fit") / "fit.json"
    path.write_text(json.dumps(selection_to_dict(found)), encoding="utf-8")
    return path, found


@pytest.fixture(scope="module")
def rivals(fit_file):
    """What is said of a fit, and the file about its rivals."""
    path = fit_file[0].with_name("plan.json")
    done = called("plan", fit_file[0], "--json", path)
    return done, json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.slow
def test_what_contains_the_selected_structure_is_no_rival_and_the_reverse_is_planned_for(
    fit_file, rivals
):
    (path, found), (done, plain) = fit_file, rivals
    assert [m.name for m in found.members] == ["2:1"]
    assert [m.name for m in found.containing] == ["2:1+b1", "2:1+b2"]
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("assumed: the machine is 2:1 with")
    first, second = done.stdout.split("the reverse: can data exclude")
    assert "\nnot a rival: 2:1+b1, 2:1+b2 contain 2:1 or one of its rivals; no experiment" in first
    assert plain["rivals"] == []
    assert [one["name"] for one in plain["larger"]] == ["2:1+b1", "2:1+b2"]
    for one in plain["larger"]:
        back = one["reverse"]
        assert (back["model"], back["rival"]) == (one["name"], "2:1")
        assert back["noise"] == pytest.approx(found.explanation.scatter.typical)
        assert f"\n{back['model']} " in second and back["factor"] > 0
    hertz = found.task.cost.measured.frequency
    assert json.loads(path.read_text(encoding="utf-8"))["frequencies"] == {
        "low": pytest.approx(hertz[0]), "high": pytest.approx(hertz[-1]), "lines": 120,
    }  # fmt: skip


@pytest.mark.full
def test_reverse_plan_of_a_fit_is_the_plan_of_that_pair(fit_file, rivals):
    back, found = rivals[1]["larger"][0]["reverse"], fit_file[1]
    values = found.containing[0].candidate.estimate.parameters
    assert back["parameters"] == values
    hertz = found.task.cost.measured.frequency
    omega = 2 * np.pi * np.geomspace(hertz[0], hertz[-1], 120)
    rho = np.full(120, found.explanation.scatter.typical)
    alone = plan(MODEL, values, Chain(2, damped=True), omega, rho)
    assert back["noncentrality"] == pytest.approx(alone.noncentrality, rel=1e-6)


@pytest.mark.full
def test_twins_that_a_fit_names_are_impossible(tmp_path, fit_file):
    path, _ = fit_file
    plain = json.loads(path.read_text(encoding="utf-8"))
    plain["not_excluded"][0]["equivalents"] = [{"name": "2:2+b1", "parameters": {}}]
    plain["not_excluded"] = plain["not_excluded"][:1]
    plain["alternatives"] = []
    other = tmp_path / "twins.json"
    other.write_text(json.dumps(plain), encoding="utf-8")
    said = called("plan", other).stdout
    assert "impossible: 2:2+b1: the same response for the fitted values" in said
    assert f"\nfor another experiment: disting next {other}\n" in said


@pytest.mark.full
def test_what_is_the_same_for_these_values_names_no_command_that_denies_it():
    values = (  # of 3:1+b1+b3 with m = 1, 2, 3, k = 100, 150, d = 0.1, 0.2, b = 0.2, 0.3
        "m1=0.149957938326015,m2=1,m3=4.84996534958645,k12=23.8889425518369,k23=76.1116574329771,"
        "d12=0.0192530376701838,d23=0.123171237219046,b1=0.0142792213520461,b2=0.15757572511077,"
        "b3=0.328145053537184"
    )
    pair = ("3:4+b1+b2+b3", "3:1+b1+b3", "--damped", "--set", values)
    said = called("plan", *pair, "--noise", 0.1, "--band", "0.5..5").stdout
    assert said.startswith("impossible for these values: 3:1+b1+b3 fits them up to rounding")
    assert said.splitlines()[0].endswith(
        "; another sensor, or the force elsewhere, may separate them"
    )
    done = called("next", *pair[:3])
    assert "are distinguishable by the present measurement already" in done.stdout


@pytest.mark.slow
@pytest.mark.parametrize("n_masses", [2, 3, 4])
def test_plan_and_next_answer_for_fits_of_random_drives(tmp_path, n_masses):
    for seed in range(10):
        machine = drive(n_masses, 100 + seed)
        some = np.random.default_rng(seed).permutation(len(offered(machine)))[:6]
        chains = dict.fromkeys([truth(machine), *(offered(machine)[i] for i in some)])
        found = select(measured(machine, (1, 2, 10)[seed % 3]), list(chains))
        path = tmp_path / f"{seed}.json"
        path.write_text(json.dumps(selection_to_dict(found)), encoding="utf-8")
        done = called("plan", path)
        assert done.returncode == 0 and "assumed: the machine is" in done.stdout
        done = called("next", path)
        alone = len(found.members) < 2 and not any(m.twins for m in found.members)
        assert done.returncode == 0
        assert ("alone: no further measurement" if alone else "measure") in done.stdout


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((*PAIR,), "--noise 0.02, or --noise FRF.csv"),
        ((*PAIR[:5], "--noise", "0.02"), "--band 5..300"),
        ((*PAIR, "--noise", "0"), "the noise of a line lies"),
        ((*PAIR, "--noise", "nan"), "the noise of a line lies"),
        ((*PAIR, "--noise", "0.1", "--lines", "3"), "at least 8 lines"),
        (("2:1+b1", *PAIR[2:], "--noise", "0.1"), "name the structure to exclude"),
        (("2:1+b1", "2:1+b1", *PAIR[2:], "--noise", "0.1"), "not a rival of itself"),
        (("nothing.json",), "nothing.json cannot be read"),
        (("fit.json", "2:1"), "names structures and values itself"),
        ((*PAIR, "--noise", "nothing.csv"), "nothing.csv"),
        ((*PAIR[:3], "--set", "m1=1", "--noise", "0.1", "--band", "1..2"), "is missing"),
    ],
)
def test_bad_input_is_one_sentence_with_the_remedy(arguments, words):
    done = called("plan", *arguments)
    assert done.returncode == 2 and words in done.stderr and "Traceback" not in done.stderr
    assert len(done.stderr.splitlines()) == 1


@pytest.mark.parametrize("text", ["[]", "{}", '{"selected": {}}', '{"selected": {"n_masses": 2}}'])
def test_damaged_file_of_a_fit_is_refused(tmp_path, text):
    path = tmp_path / "fit.json"
    path.write_text(text, encoding="utf-8")
    done = called("plan", path)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1


def test_spectrum_of_simulate_is_checked(tmp_path):
    done = called("simulate", "--spectrum", tmp_path / "none.csv")
    assert done.returncode == 2 and "cannot be read" in done.stderr
