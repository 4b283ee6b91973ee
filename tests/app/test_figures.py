"""The diagrams of a fit's answer: measured lines as they are, curves as they were fitted."""

from dataclasses import replace

import numpy as np
import pytest
from jsonschema import validate

from disting.app.figures import figures_of, figures_of_networks
from disting.app.interface import CALLS
from disting.app.project import show_figures
from disting.fit import fit_networks, select
from disting.fit.results.selection import response_of
from disting.measurement import FrequencyResponse
from disting.model.names import read_together
from disting.network.notation import network_of
from tests.app.served import bench_csv
from tests.app.test_onward import spectrum

FIGURES = CALLS["figures"].schema["properties"]["answer"]


def complex_of(line: dict) -> np.ndarray:
    return np.array(line["re"]) + 1j * np.array(line["im"])


def test_a_circuit_has_a_nyquist_diagram_with_its_curve_and_the_lines():
    measured = spectrum()
    selection = fit_networks(measured, [network_of("R0-p(R1,C1)")])
    figures = figures_of_networks(selection)
    validate({"figures": figures}, FIGURES)
    ((data,), (curve,)) = figures[0]["measured"], figures[0]["curves"]
    assert (figures[0]["kind"], curve["name"], data["name"]) == ("nyquist", "R0-p(R1,C1)", "data")
    assert np.allclose(complex_of(data), measured.G, rtol=1e-12)
    assert data["wide"] is None  # the file does not state its scatter
    v, f = selection.fits[0].values, np.array(curve["frequency"])
    Z = v["R0"] + v["R1"] / (1 + 2j * np.pi * f * v["R1"] * v["C1"])
    assert np.allclose(complex_of(curve), Z, rtol=1e-9)
    assert np.allclose(curve["gain"], np.abs(Z), rtol=1e-9)
    fine = np.geomspace(f[0], f[-1], 5000)
    between = np.interp(np.log(fine), np.log(f), curve["re"])
    exact = v["R0"] + v["R1"] / (1 + (2 * np.pi * fine * v["R1"] * v["C1"]) ** 2)
    assert np.max(np.abs(between - exact)) < 3e-4 * np.ptp(exact)
    across = np.hypot(curve["across_re"], curve["across_im"])
    assert 0 < across.max() < 0.1 * np.ptp(exact)


@pytest.mark.full
def test_a_chain_has_a_bode_diagram_of_each_response_with_what_is_left():
    rows = np.array([[float(x) for x in row.split(b",")] for row in bench_csv().splitlines()[1:]])
    G = rows[:, 1] + 1j * rows[:, 2]
    train = FrequencyResponse(2 * np.pi * rows[:, 0], G, quantity="velocity")
    named = read_together(["2:1+b1+delay", "2:1+b2+delay"])
    selection = select(train, [replace(chain, quantity=train.quantity) for chain in named])
    figures = figures_of(selection, train, None)
    validate({"figures": figures}, FIGURES)
    (figure,) = figures
    curve = figure["curves"][0]
    assert (figure["kind"], figure["title"], curve["name"]) == ("bode", "", "2:1+b1+delay")
    omega = 2 * np.pi * np.array(curve["frequency"])
    fitted = response_of(selection.described, selection.task, omega)
    assert np.allclose(complex_of(curve), fitted, rtol=1e-9)
    near = np.interp(figure["measured"][0]["frequency"], curve["frequency"], curve["phase"])
    assert np.max(np.abs(near - figure["measured"][0]["phase"])) < 10  # in one turn
    assert len(curve["wide"]) == len(curve["wide_phase"]) == len(omega)


def test_a_fit_without_diagrams_has_none(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    own = tmp_path / "fits" / "1"
    own.mkdir(parents=True)
    assert show_figures({"fit": 1}) == {"figures": []}
    (own / "figures.json").write_text("[1, 2")
    assert show_figures({"fit": 1}) == {"figures": []}
