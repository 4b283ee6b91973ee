"""disting simulate and disting plan of networks, as commands."""

import csv
import json
import shlex

import numpy as np
import pytest

from tests.cli.process import called

CELL = ("R0-p(R1,C1)", "--set", "R0=1,R1=2,C1=0.01")
TREE = "1=2=3, 2=4; F1; S4"
VALUES = "m1=0.01,m2=0.01,m3=0.02,m4=0.01,k12=500,k23=400,k24=300,d12=0.1,d23=0.2,d24=0.1"


def responses(text):
    """Frequencies [rad/s] and G of a CSV file of a response."""
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    rows = [[float(x) for x in row[:3]] for row in list(csv.reader(lines))[1:]]
    omega, re, im = np.array(rows).T
    return omega, re + 1j * im


@pytest.mark.full
def test_an_impedance_is_simulated_and_fitted(tmp_path):
    path = tmp_path / "cell.csv"
    done = called("simulate", *CELL, "--low", "1", "--output-noise", "0.001", "--csv", path)
    assert done.returncode == 0, done.stderr
    omega, impedance = responses(path.read_text(encoding="utf-8"))
    np.testing.assert_allclose(impedance, 1 + 2 / (1 + 0.02j * omega), rtol=1e-2)
    done = called("fit", path, "--models", CELL[0], "--models", "R1-C1")
    assert done.returncode == 0 and "R0-p(R1,C1) is the simplest" in done.stdout


@pytest.mark.full
def test_what_is_mostly_inductive_is_not_turned(tmp_path):
    path = tmp_path / "coil.csv"
    called("simulate", "R1-L1", "--set", "R1=1,L1=0.1", "--output-noise", "1e-4", "--csv", path)
    done = called("fit", path, "--models", "R1-L1", "--models", "R1-C1")
    assert done.returncode == 0 and "R1-L1 is the simplest" in done.stdout
    assert "-Im" not in done.stderr


def test_each_response_of_several_has_its_file(tmp_path):
    words = "1~2; F1; S1 S2", "--set", "m1=1,m2=1,k12=1000", "--samples", "500"
    done = called("simulate", *words, "--csv", tmp_path / "frf.csv")
    assert done.returncode == 0, done.stderr
    (omega, first), (_, second) = (
        responses((tmp_path / f"frf-{k}-1.csv").read_text(encoding="utf-8")) for k in (1, 2)
    )
    np.testing.assert_allclose(first / second, 1 - omega**2 / 1000, rtol=1e-6)


def test_a_model_of_a_file_that_is_no_network_is_not_fitted(tmp_path):
    file = tmp_path / "models.json"
    file.write_text('{"models": [{"name": "lag", "G": "a/(s + b)"}]}', encoding="utf-8")
    done = called("fit", "none.csv", "--models", file)
    assert done.returncode == 2
    assert "lag is not a network: describe it by its elements" in done.stderr


@pytest.mark.slow
def test_all_sensors_are_simulated_and_fitted(tmp_path):
    """One file for each sensor; a fit of an undamped machine to them begins anywhere."""
    two, values = "1~2~3; F1; S1 S3", "m1=0.01,m2=0.012,m3=0.006,k12=500,k23=900"
    path = tmp_path / "frf.csv"
    done = called(
        "simulate",
        two,
        "--set",
        values,
        "--output-noise",
        "1e-7",
        "--samples",
        "500",
        "--csv",
        path,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.split()[-1].endswith("frf-2-1.csv")
    data = [tmp_path / f"frf-{k}-1.csv" for k in (1, 2)]
    done = called("fit", *data, "--models", two, "--models", "1~2, 1~3; F1; S1 S3")
    assert done.returncode == 0, done.stderr
    assert f"{two} is the simplest that explains the data." in done.stdout


@pytest.mark.full
def test_networks_of_a_file_are_named_by_file_and_name(tmp_path):
    """In next, plan and simulate as in compare; what has no elements is refused."""
    path = tmp_path / "own.json"
    models = [{"name": "cell", "circuit": CELL[0]}, {"name": "twin", "circuit": "p(R1,R2-C1)"}]
    models += [{"name": "ratio", "num": ["a"], "den": [1, "b"]}]
    path.write_text(json.dumps({"models": models}), encoding="utf-8")
    cell, twin, ratio = (f"{path}:{name}" for name in ("cell", "twin", "ratio"))
    done = called("next", cell, twin)
    assert done.returncode == 0 and "if it is cell:" in done.stdout
    done = called("simulate", cell, *CELL[1:], "--csv", "-")
    plain = called("simulate", *CELL, "--csv", "-")
    assert done.returncode == 0 and responses(done.stdout)[1] == pytest.approx(
        responses(plain.stdout)[1]
    )
    done = called("plan", cell, twin, "--set", CELL[2], "--noise", "0.01", "--band", "1..99")
    assert "disting next" in done.stdout + done.stderr
    done = called("next", ratio, cell)
    assert done.returncode == 2 and "is given by formulas, not by its elements" in done.stderr
    done = called("next", cell, "3:1")
    assert done.returncode == 2 and "3:1 is a numbered chain" in done.stderr


@pytest.mark.slow
def test_a_tree_is_simulated_with_friction():
    done = called("simulate", TREE, "--set", VALUES, "--samples", "500", "--friction", "3=0.01")
    assert done.returncode == 0 and "# quantity: acceleration" in done.stdout
    other = called("simulate", TREE, "--set", VALUES, "--samples", "500")
    assert other.stdout != done.stdout


@pytest.mark.slow
def test_a_plan_says_how_much_noise_may_be_there():
    """By hand: R1 in series to C1 against R1 alone differ by 1/(j w C1); its best fit is a real
    number, so that of two lines the sum of squares is known.
    """
    done = called(
        "plan", "R1-C1", "p(R1,C1)", "--set", "R1=1,C1=0.01", "--noise", "0.02", "--band", "1..100",
        "--json", "-",
    )  # fmt: skip
    plain = json.loads(done.stdout)
    assert done.returncode == 0 and plain["answer"] == "enough" and plain["trust"] == "agreed"
    omega = 2 * np.pi * np.geomspace(1, 100, 120)
    exact = 1 + 1 / (0.01j * omega)
    p = [plain["best_fit"][name] for name in ("R1", "C1")]
    apart = np.abs(1 / (1 / p[0] + 1j * omega * p[1]) / exact - 1)
    assert plain["noncentrality"] == pytest.approx(np.sum(apart**2) / 0.02**2, rel=1e-9)
    for step in np.random.default_rng(1).normal(size=(200, 2)) * 0.1:
        q = p * np.exp(step)
        other = np.abs(1 / (1 / q[0] + 1j * omega * q[1]) / exact - 1)
        assert np.sum(other**2) > np.sum(apart**2)


@pytest.mark.full
def test_a_plan_writes_what_simulate_runs(tmp_path):
    done = called(
        "plan",
        CELL[0],
        "R1-C1",
        *CELL[1:],
        "--noise",
        "0.1",
        "--band",
        "0.5..50",
        "--lines",
        "30",
        "--out",
        tmp_path,
    )
    assert done.returncode == 0, done.stderr
    command = shlex.split(done.stdout.splitlines()[-1])
    assert command[:3] == ["disting", "simulate", "R0-p(R1,C1)"]
    ran = called(*command[1:])
    omega, impedance = responses(ran.stdout)
    np.testing.assert_allclose(impedance, 1 + 2 / (1 + 0.02j * omega), rtol=1e-6)


def test_same_networks_are_impossible_to_tell_apart_and_next_is_named():
    done = called("plan", CELL[0], "p(R0,R1-C1)", *CELL[1:], "--noise", "0.1", "--band", "0.5..50")
    assert done.returncode == 0 and done.stdout.startswith("impossible: however long")
    assert "disting next 'R0-p(R1,C1)' 'p(R0,R1-C1)'" in done.stdout.splitlines()[0]


@pytest.mark.full
def test_a_network_that_contains_the_true_one_is_never_excluded():
    done = called(
        "plan",
        CELL[0],
        "R0-p(R1,C1)-p(R2,C2)",
        *CELL[1:],
        "--noise",
        "0.1",
        "--band",
        "0.5..50",
        "--json",
        "-",
    )
    plain = json.loads(done.stdout)
    assert plain["answer"] == "same" and plain["contains"]


@pytest.fixture(scope="module")
def fit_file(tmp_path_factory):
    """A cell whose second arc the noise hides; one of the candidates is the same as another."""
    folder = tmp_path_factory.mktemp("cell")
    done = called(
        "simulate", "R0-p(R1,C1)", "--set", "R0=1,R1=2,C1=0.01", "--low", "1", "--high", "100",
        "--output-noise", "0.4", "--csv", folder / "cell.csv",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    models = ("R0-p(R1,C1)", "p(R0,R1-C1)", "R0-p(R1,C1)-p(R2,C2)", "R1-C1")
    named = [word for model in models for word in ("--models", model)]
    done = called("fit", folder / "cell.csv", *named, "--json", folder / "fit.json")
    assert done.returncode == 0, done.stderr
    return folder / "fit.json", done.stdout


@pytest.mark.full
def test_rivals_of_a_fit_of_networks_are_planned_for(fit_file):
    path, said = fit_file
    done = called("plan", path)
    assert done.returncode == 0, done.stderr
    first, same, *_ = done.stdout.splitlines()
    plain = json.loads(path.read_text(encoding="utf-8"))
    assert plain["selected"] in said and first.startswith(
        f"assumed: the circuit is {plain['selected']} with"
    )
    assert same.startswith("impossible: ") and "the same responses for all positive values" in same


@pytest.mark.full
def test_what_to_measure_next_on_what_a_fit_of_networks_left(fit_file):
    path, _ = fit_file
    done = called("next", path)
    assert done.returncode == 0, done.stderr
    assert "2 structures that the present measurement cannot distinguish" in done.stdout
    assert (
        "not a rival: R0-p(R1,C1)-p(R2,C2) contains R0-p(R1,C1) or one of its rivals" in done.stdout
    )
    assert "disting plan" not in done.stdout
    plain = json.loads(called("next", path, "--json", "-").stdout)
    assert plain["groups"][0]["structures"] == ["R0-p(R1,C1)", "p(R0,R1-C1)"]
    rows = called("next", path, "--csv", "-").stdout.splitlines()
    assert len(rows) > 5


@pytest.mark.full
@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"networks": []}, "is not a complete fit file"),
        ({"networks": [{"name": "x"}]}, "is not a complete fit file"),
        ({"fits": []}, "none of the networks"),
        ({"fits": [{}]}, "is not a complete fit file"),
        ({"frequencies": {}}, "is not a complete fit file"),
    ],
)
def test_damaged_files_are_refused(fit_file, tmp_path, change, words):
    path = tmp_path / "fit.json"
    plain = json.loads(fit_file[0].read_text(encoding="utf-8"))
    path.write_text(json.dumps(plain | change), encoding="utf-8")
    done = called("plan", path)
    assert done.returncode == 2 and words in done.stderr and "Traceback" not in done.stderr


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("plan R0-C1 --set R0=1,C1=1", "name the structure to exclude too"),
        ("plan R0-C1 2:1 --set R0=1,C1=1", "2:1 is a numbered chain, R0-C1 a network"),
        ("plan R0-C1 R0-L1 --set R0=1 --noise 0.1 --band 1..2", "the value of C1 is missing"),
        ("plan R0-C1 R0-C1 --set R0=1,C1=1 --noise 0.1 --band 1..2", "not a rival of itself"),
        ("plan R0-C1 R0-L1 --set R0=1,C1=1 --noise 0.1", "--band 5..300"),
        ("simulate R0-C1", "the value of C1, R0 is missing; the parameters of R0-C1 are C1, R0"),
        ("simulate R0-P1 --set R0=1,P1=1", "the value of n1 is missing"),
        ("simulate R0-P1 --set R0=1,P1=1,n1=2", "n1 = 2.0 is not an exponent"),
        ("simulate R0-C1 --set R0=1,C1=0", "values of elements are positive"),
        ("simulate R0-C1 --set R0=1,C1=1,L1=1", "L1: no parameter of R0-C1"),
        ("simulate R0-C1 --set R0=1,C1=1 --quantity velocity", "--quantity is supported for machines"),
        ("simulate R0-C1 --set R0=1,C1=1 --response position", "--response is supported for machines"),
        ("simulate R0-C1 --set R0=1,C1=1 --damped", "--damped is supported for numbered chains"),
        ("simulate R0-C1 --set R0=1,C1=1 --friction 1=1", "friction is supported for machines"),
        ("simulate '1~2; F1; S1 S2' --set m1=1,m2=1,k12=1", "such as --csv frf.csv for frf-1-1.csv"),
        (
            "plan '1~2; F1; S1 S2' '1~2; F1; S1' --set m1=1,m2=1,k12=1 --noise 0.1 --band 1..9",
            "have the same outputs and inputs",
        ),
        ("simulate --notation spice", "--set needs a model"),
    ],
)  # fmt: skip
def test_bad_input(command, words):
    done = called(*shlex.split(command))
    assert done.returncode == 2 and words in done.stderr and "Traceback" not in done.stderr


@pytest.mark.full
def test_special_values_are_left_aside_only_where_they_are() -> None:
    """In the sentence for who measures: two arcs in series and their parallel form give the same for
    all positive values, a branched machine gives more than the row.
    """
    for models, aside in (
        (("R0-p(R1,C1)", "p(R0,R1-C1)"), False),
        (("1~2~3, 2~4; F1; S1", "1~2~3~4; F1; S1"), True),
    ):
        said = called("compare", *models).stdout
        (first,) = (line for line in said.splitlines() if line.startswith("For every "))
        assert ("special values aside" in first) is aside and ("special    " in said) is aside


VOIGT, LADDER = "R0-p(R1,C1)-p(R2,C2)-p(R3,C3)", "R0-p(C1,R1-p(C2,R2-p(C3,R3)))"


@pytest.mark.full
def test_formulas_in_three_languages():
    said = called("equivalents", VOIGT, "--to", LADDER, "--formulas").stdout
    assert said.startswith(f"{VOIGT}: 1 of 1 other network equivalent for all positive values")
    assert f"\n\n{LADDER}   (primed)\nidentity checked, probability of error" in said
    assert "R0' = R0\n" in said
    assert r"R_{0}' &= R_{0} " in called("equivalents", VOIGT, "--to", LADDER, "--latex").stdout
    source = called("equivalents", VOIGT, "--to", LADDER, "--sympy").stdout
    space = {}
    exec(source, space)
    assert sorted(space["equivalent"]) == ["C1", "C2", "C3", "R0", "R1", "R2", "R3"]


def test_exponents_are_named_beside_the_verdict():
    done = called("equivalents", "R0-p(R1,P1)", "--to", "p(R0,R1-P1)")
    assert done.stdout.splitlines()[1:] == [
        "p(R0,R1-P1)  indistinguishable (equivalents with positive parameters)",
        "  n1 = n1",
    ]


@pytest.mark.full
def test_what_is_the_same_for_some_values_only_has_no_formulas():
    one, other = "1>0, 1>2, 3>1; in 3; out 2", "1>2, 1>3, 2>1, 3>2; in 2; out 3"
    done = called("equivalents", one, "--to", other, "--formulas")
    head, blank, line = done.stdout.splitlines()
    assert head.endswith("0 of 1 other network equivalent for all positive values, 1 for some, 0 undecided")  # fmt: skip
    assert not blank and line.startswith(f"{other}: ")
    assert line.endswith("(no formulas; --set gives values)")


@pytest.mark.full
def test_where_formulas_are_not_known_it_is_said():
    done = called("equivalents", LADDER, "--to", VOIGT, "--formulas")
    assert (done.returncode, done.stderr) == (0, "")
    assert "no formulas: roots of a polynomial of degree 3 are needed" in done.stdout


@pytest.mark.full
def test_values_of_several_sensors():
    values = "m1=1,m2=2,m3=3,m4=1,k12=1,k23=5,k34=2"
    one, two = "1~2~3~4; F1; S1 S2", "1~2, 2~3, 2~4; F1; S1 S2"
    done = called("equivalents", one, "--to", two, "--set", values)
    assert "k12 = 1, k23 = 10/7, k24 = 25/7, m1 = 1, m2 = 2, m3 = 3/7, m4 = 25/7" in done.stdout


@pytest.mark.full
def test_values_of_large_circuits_by_synthesis():
    values = "R0=1,R1=2,R2=3,R3=1,C1=1,C2=1/2,C3=3"
    done = called("equivalents", LADDER, "--to", VOIGT, "--set", values)
    assert "R0 = 1, R1 = 5.56471, R2 = 0.35171, R3 = 0.0835808" in done.stdout
    assert "all positive ones, except exchanges of identical branches" in done.stdout
    told = json.loads(
        called("equivalents", LADDER, "--to", VOIGT, "--set", values, "--json").stdout
    )
    (found,) = told["equivalents"]
    assert (found["extent"], found["values"][0]["domain"]) == ("positive", "positive")


def test_other_values_of_the_same_network():
    cell, values = "R0-p(R1,C1)-p(R2,C2)", "R0=1,R1=2,R2=3,C1=1,C2=1"
    done = called("equivalents", cell, "--to", cell, "--set", values)
    assert done.returncode == 0
    assert "C1 = 1, C2 = 1, R0 = 1, R1 = 3, R2 = 2" in done.stdout
    assert done.stdout.startswith(f"{cell}: 1 of 1 network equivalent")


@pytest.mark.full
def test_values_at_which_there_is_none_are_explained():
    one, two = "p(R1,C1)-p(R2,C2)", "p(C1,R1-p(C2,R2))"
    done = called("equivalents", one, "--to", two, "--set", "R1=1,R2=2,C1=2,C2=1")
    assert "these values are special, for almost all others there is one" in done.stdout
    done = called("equivalents", one, "--to", two, "--set", "R1=1,R2=2,C1=-2,C2=1")
    assert "given values are not all positive, which is what the verdict is about" in done.stdout
