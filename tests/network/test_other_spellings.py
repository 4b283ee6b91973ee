"""Circuits and compartments as other programs and people write them."""

import cmath

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from disting.cli import main
from disting.errors import InputError
from disting.network import network_of
from disting.network.notation.circuit import UNSUPPORTED
from disting.network.notation.compartments import compartments

VALUES = {"R": 3.0, "L": 0.02, "C": 1e-3, "W": 5.0, "P": 2e-3}
EXPONENT = 0.8


def impedance_of_element(name, size, s):
    """By the first letter; each element has its own value."""
    value = VALUES[name[0]] * size
    return {
        "R": value,
        "L": value * s,
        "C": 1 / (value * s),
        "W": value / cmath.sqrt(s),
        "P": 1 / (value * s**EXPONENT),
    }[name[0]]


def by_admittances(network, sizes, s):
    """Impedance at the port from the matrix of node admittances: slow and obviously right."""
    nodes = sorted({i for e in network.elements for i in e.nodes} - {0})
    matrix = np.zeros((len(nodes), len(nodes)), dtype=complex)
    for e in network.elements:
        y = 1 / impedance_of_element(e.value, sizes[e.value], s)
        ends = [(nodes.index(i), sign) for i, sign in zip(e.nodes, (1, -1), strict=True) if i]
        for i, a in ends:
            for j, b in ends:
                matrix[i, j] += a * b * y
    port = network.inputs[0]
    current = np.zeros(len(nodes), dtype=complex)
    current[nodes.index(port.plus)] = 1.0
    return np.linalg.solve(matrix, current)[nodes.index(port.plus)]


def randles(z):
    """Rs in series with (Rct in series with W) beside a double layer."""
    return z["Rs"] + 1 / (1 / (z["Rct"] + z["Wd"]) + 1 / z["Cdl"])


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("Rs-p(Rct-Wd,Cdl)", ("Rs", "Rct", "Wd", "Cdl")),
        ("R_s + parallel(R_ct + W_d, C_dl)", ("R_s", "R_ct", "W_d", "C_dl")),
        ("Rs(Cdl[RctWd])", ("Rs", "Rct", "Wd", "Cdl")),
        ("R{R=20:s}(C{C=2e-5}[R{R=100/10/1E3:ct}W{Y=1e-3F}])", ("R1", "R2", "W1", "C1")),
        ("Rs-[Rct-Wd,Cdl]", ("Rs", "Rct", "Wd", "Cdl")),
    ],
)
def test_one_circuit_in_five_spellings_has_one_impedance(text, names):
    network, called = network_of(text), dict(zip(("Rs", "Rct", "Wd", "Cdl"), names, strict=True))
    assert {e.value for e in network.elements} == set(names)
    sizes = {name: 1.0 + 0.3 * k for k, name in enumerate(names)}
    for omega in (0.1, 3.0, 200.0):
        s = 1j * omega
        parts = {n: impedance_of_element(called[n], sizes[called[n]], s) for n in called}
        expected = randles(parts)
        assert by_admittances(network, sizes, s) == pytest.approx(expected, rel=1e-9)


def test_constant_phase_elements_of_other_programs_are_ours():
    for text in ("R0-p(R1,CPE1)", "R0+parallel(R1,CPE1)", "R0(R1Q1)", "R0(R1Q1{Y=2e-3,n=0.8})"):
        (phase,) = (e for e in network_of(text).elements if e.letter == "P")
        assert (phase.value, phase.exponent) == ("P1", "n1")
    (phase,) = (e for e in network_of("R0-p(R1,CPE_f3)").elements if e.letter == "P")
    assert (phase.value, phase.exponent) == ("P_f3", "n_f3")


@pytest.mark.thin(8)
@pytest.mark.parametrize("word", UNSUPPORTED)
@pytest.mark.parametrize("text", ["R0-p(R1,{}1)", "R0(R1{})", "R0 + parallel(R1, {}_f1)"])
def test_elements_that_are_known_are_refused_by_name_with_the_reason(text, word):
    what, reason = UNSUPPORTED[word]
    with pytest.raises(InputError) as found:
        network_of(text.format(word))
    assert f"{word} ({what}) is not supported: {reason}" in str(found.value)
    assert "cannot parse the circuit at position" in str(found.value)


@pytest.mark.parametrize("text", ["R0-R1C1", "R0-p(R1C1)", "R0-RC", "R0-p(R1,c1)", "R0{R=1-C1"])
def test_elements_that_are_run_together_are_no_name(text):
    with pytest.raises(InputError):
        network_of(text, "impedance")


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.integers(1, 5), min_size=2, max_size=6, unique=True),
    st.lists(st.booleans(), min_size=6, max_size=6),
    st.booleans(),
)
def test_a_path_of_compartments_is_its_arrows(nodes, both, leaks):
    signs = ["<>" if two else ">" for two in both]
    path = str(nodes[0]) + "".join(f"{s}{n}" for s, n in zip(signs, nodes[1:], strict=False))
    arrows = [f"{a}{s}{b}" for a, s, b in zip(nodes, signs, nodes[1:], strict=False)]
    if leaks:
        path, arrows = f"{path}>0", [*arrows, f"{nodes[-1]}>0"]
    ports = f"; in {nodes[0]}; out {nodes[-1]}"
    assert compartments(path + ports, "") == compartments(", ".join(arrows) + ports, "")


@pytest.mark.parametrize(
    "text", ["1>2>; in 1; out 1", ">1>2; in 1; out 1", "1><2; in 1; out 1", "1>2>1>2; in 1; out 1"]
)
def test_what_is_no_path_is_refused(text):
    with pytest.raises(InputError, match=r"is not a flow|is given twice"):
        compartments(text, "")


@pytest.mark.full
def test_models_and_fit_take_a_notation(tmp_path, capsys):
    assert main(["models", "[R1C1]", "--notation", "autoeis"]) == 2
    assert main(["models", "[R1C1]", "--notation", "boukamp"]) == 0
    assert "R1" in capsys.readouterr().out
    omega = 2 * np.pi * np.geomspace(1, 1e4, 40)
    z = 5 + 20 / (1 + 1j * omega * 20 * 1e-3)
    noise = 1 + 1e-3 * np.random.default_rng(0).normal(size=(2, 40))
    rows = [
        f"{w / 2 / np.pi},{x.real * a},{x.imag * b}"
        for w, x, a, b in zip(omega, z, *noise, strict=True)
    ]
    file = tmp_path / "cell.csv"
    file.write_text("\n".join(["freq/Hz,Re(Z)/Ohm,Im(Z)/Ohm", *rows]))
    assert main(["fit", str(file), "--models", "R(RC)", "--notation", "boukamp"]) == 0
    assert "R(RC) is the simplest that explains the data" in capsys.readouterr().out
