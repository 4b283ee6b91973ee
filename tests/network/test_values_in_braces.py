"""Values in braces behind elements, as pyimpspec writes them."""

from fractions import Fraction

import numpy as np
import pytest

from disting import InputError, network_of, values_in
from disting.network.notation import notations_of
from tests.cli.process import called

RANDLES = "R{R=20f:sol}(Q{Y=25e-6//1e-3,n=0.9:dl}[R{R=100/50/200:ct}W{Y=0.1/inf/150%:diff}])"


def test_values_follow_the_elements_and_have_their_names():
    values = values_in(RANDLES)
    assert values == {
        "R1": 20,
        "P1": Fraction(25, 10**6),
        "n1": Fraction(9, 10),
        "R2": 100,
        "W1": 10,
    }
    network = network_of(RANDLES)
    assert sorted(values) == sorted((*network.parameters, *network.exponents))
    assert network == network_of("R(Q[RW])")


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("R{R=2.000E+01F/0.000E+00/inf:sol}(RC{C=.5})", {"R1": 20, "C1": Fraction(1, 2)}),
        ("R{:ct}(R{R=3}C{})", {"R2": 3}),
        ("R7{R=1} - p(R3{ R = 2 }, C1 {C=3})", {"R7": 1, "R3": 2, "C1": 3}),
        ("L{L=1e-3}(R_ct{R=2}CPE{Y=1,n=0.5})", {"L1": Fraction(1, 1000), "R_ct": 2, "P1": 1, "n1": Fraction(1, 2)}),
        ("R1-p(R2,C1)", {}),
        ("1=2=3; F1; S3", {}),
    ],
)  # fmt: skip
def test_forms_of_braces(text, values):
    assert values_in(text) == values


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("R{R=20Ohm}(RC)", "R1: cannot read 'R=20Ohm'"),
        ("R{C=20}(RC)", "R1: cannot read 'C=20'"),
        ("R{R=1,R=2}(RC)", "R with R once|with R once"),
        ("R{R=1/2/3/4}(RC)", "cannot read"),
        ("R{20}(RC)", "cannot read '20'"),
        ("R(RC)W{Y=0}", "W1: Y = 0"),
        ("R{R=1e999999999}(RC)", "at most"),
        ("{R=1}R(RC)", "position 1 do not follow an element"),
        ("R{R=1}{R=2}(RC)", "position 7 do not follow an element"),
    ],
)
def test_braces_of_another_form_are_refused_where_values_are_needed(text, words):
    with pytest.raises(InputError, match=words):
        values_in(text)
    assert network_of(text).parameters  # the structure needs none of them


@pytest.mark.full
def test_simulate_takes_them_and_set_wins():
    low = ("--low", "1", "--high", "100", "--samples", "200", "--sampling-rate", "500")
    own = called("simulate", RANDLES, *low)
    values = "R1=20,P1=25e-6,n1=0.9,R2=100,W1=10"
    assert own.returncode == 0, own.stderr
    assert own.stdout == called("simulate", "R(Q[RW])", "--set", values, *low).stdout
    other = called("simulate", RANDLES, *low, "--set", "R2=30")
    assert other.stdout == called("simulate", "R(Q[RW])", "--set", values.replace("100", "30"), *low).stdout  # fmt: skip
    missing = called("simulate", "R{R=20}(RC)", *low)
    assert missing.returncode == 2 and "the value of C1, R2 is missing" in missing.stderr


@pytest.mark.full
def test_equivalents_and_plan_take_them():
    text = "R{R=1}(R{R=2}C{C=0.5})"
    done = called("equivalents", text, "--to", "p(R1,R2-C1)")
    assert "C1 = 2/9, R1 = 3, R2 = 3/2" in done.stdout
    done = called("equivalents", text, "--to", "p(R1,R2-C1)", "--set", "R2=3")
    assert "C1 = 9/32, R1 = 4, R2 = 4/3" in done.stdout
    done = called("equivalents", text, "--to", "p(R1,R2-C1)", "--formulas")
    assert done.returncode == 0, done.stderr
    done = called("plan", text, "R0-C1", "--noise", "0.01", "--band", "0.01..10")
    assert "true: C1 = 0.5, R1 = 1, R2 = 2" in done.stdout


def test_python_simulates_with_them():
    from disting.simulation import Bench, Excitation, simulate

    text = "R{R=1}(R{R=2}C{C=0.01})"
    series = simulate(network_of(text), values_in(text), Excitation(), Bench())
    found = series.response("position", period=2500)
    expected = 1 + 2 / (1 + 0.02j * found.omega)
    np.testing.assert_allclose(found.G, expected, rtol=1e-6)


@pytest.mark.parametrize(
    ("text", "notation"),
    [
        ("parallel(R1, C1) + R0", "impedancefitter"),
        ("p(p(R1,C1)-R2,C2)", "impedance"),
        ("([RC]R)C", "boukamp"),
    ],
)
def test_a_circuit_that_begins_with_brackets_is_recognized(text, notation):
    assert notations_of(text) == [notation]
    assert called("models", text).returncode == 0


@pytest.mark.parametrize("command", ["verdicts", "report"])
def test_one_network_is_no_list(command):
    done = called(command, "R0-p(R1,C1)")
    assert done.returncode == 2 and "is one network" in done.stderr
