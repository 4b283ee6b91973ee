"""disting simulate and disting plan of networks, as commands."""

import csv
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


def test_an_impedance_is_simulated_and_fitted(tmp_path):
    path = tmp_path / "cell.csv"
    done = called("simulate", *CELL, "--low", "1", "--output-noise", "0.001", "--csv", path)
    assert done.returncode == 0, done.stderr
    omega, impedance = responses(path.read_text(encoding="utf-8"))
    np.testing.assert_allclose(impedance, 1 + 2 / (1 + 0.02j * omega), rtol=1e-2)
    done = called("fit", path, "--models", CELL[0], "--models", "R1-C1")
    assert done.returncode == 0 and "R0-p(R1,C1) is the simplest" in done.stdout


def test_what_is_mostly_inductive_is_not_turned(tmp_path):
    path = tmp_path / "coil.csv"
    called("simulate", "R1-L1", "--set", "R1=1,L1=0.1", "--output-noise", "1e-4", "--csv", path)
    done = called("fit", path, "--models", "R1-L1", "--models", "R1-C1")
    assert done.returncode == 0 and "R1-L1 is the simplest" in done.stdout
    assert "-Im" not in done.stderr


def test_a_tree_is_simulated_with_friction():
    done = called("simulate", TREE, "--set", VALUES, "--samples", "500", "--friction", "3=0.01")
    assert done.returncode == 0 and "# sensor: acceleration" in done.stdout
    other = called("simulate", TREE, "--set", VALUES, "--samples", "500")
    assert other.stdout != done.stdout


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("simulate R0-C1", "the value of C1, R0 is missing; the parameters of R0-C1 are C1, R0"),
        ("simulate R0-C1 --set R0=1,C1=0", "values of elements are positive"),
        ("simulate R0-C1 --set R0=1,C1=1,L1=1", "L1: no parameter of R0-C1"),
        ("simulate R0-C1 --set R0=1,C1=1 --quantity velocity", "--quantity belongs to machines"),
        ("simulate R0-C1 --set R0=1,C1=1 --response position", "--response belongs to machines"),
        ("simulate R0-C1 --set R0=1,C1=1 --damped", "--damped belongs to numbered chains"),
        ("simulate R0-C1 --set R0=1,C1=1 --friction 1=1", "friction belongs to machines"),
        ("simulate '1~2; F1; S1 S2' --set m1=1,m2=1,k12=1", "several inputs or outputs"),
        ("simulate --notation spice", "parameters belong to a model"),
    ],
)  # fmt: skip
def test_bad_input(command, words):
    done = called(*shlex.split(command))
    assert done.returncode == 2 and words in done.stderr and "Traceback" not in done.stderr
