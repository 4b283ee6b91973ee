"""The page of a fit of networks, and of a plan against all rivals that it names."""

import csv
import json
import re

import numpy as np
import pytest

from disting import network_of
from disting.fit.networks import fit_networks
from disting.fit.search.network_plant import NetworkPlant
from disting.measurement import FrequencyResponse
from disting.report.fit.network_curves import network_line
from disting.report.fit.network_figures import _tube, network_figures
from disting.report.fit.network_page import network_page, write_network_report
from disting.report.fit.style import FigureFiles
from tests.cli.process import called
from tests.report.outline import Outline

pytestmark = pytest.mark.full

OMEGA = 2 * np.pi * np.logspace(1, 2.4, 12)
# the true one, its equivalent, one that the data do not exclude, one that they do
TEXTS = ("R0-p(R1,C1)", "p(R2,R0-C1)", "p(R1,P1)", "p(R1,C1)")
FIGURES = ["nyquist", "bode", "residuals"]
KINDS = ("svg", "png", "pdf")


def cell(seed=3):
    """Most of an arc, with 4 % noise."""
    noise = np.random.default_rng(seed).normal(size=(2, len(OMEGA))) * 0.04
    impedance = 10 + 1 / (1 / 80 + 2e-5j * OMEGA)
    measured = impedance * (1 + noise[0] + 1j * noise[1])
    return FrequencyResponse(OMEGA, measured, quantity="position", is_impedance=True)


@pytest.fixture(scope="module")
def selection():
    return fit_networks(cell(), list(map(network_of, TEXTS)))


@pytest.fixture(scope="module")
def folder(selection, tmp_path_factory):
    folder = tmp_path_factory.mktemp("networks") / "new"
    write_network_report(selection, folder)
    return folder


def test_all_files_are_written_and_linked(folder):
    figures = [f"{name}.{kind}" for name in FIGURES for kind in KINDS]
    names = {"fit.html", *figures, "fit.json", "candidates.csv"}
    assert {path.name for path in folder.iterdir()} == names
    outline = Outline((folder / "fit.html").read_text(encoding="utf-8"))
    links = {a.get("href") for tag, a in outline.elements if tag == "a"}
    assert names - {"fit.html"} <= links


def test_the_page_tells_what_the_selection_does(selection, folder):
    text = (folder / "fit.html").read_text(encoding="utf-8")
    assert text.index(selection.sentence) < text.index("Nyquist diagram")
    for name in TEXTS[:3]:
        assert f'aria-label="Values of {name}"' in text
    assert "excluded by R0-p(R1,C1)" in text and "{{" not in text
    rows = list(csv.DictReader((folder / "candidates.csv").open(encoding="utf-8")))
    assert [row["network"] for row in rows] == [f.network.name for f in selection.fits]
    assert json.loads((folder / "fit.json").read_text()) == json.loads(
        json.dumps(selection.to_dict())
    )


@pytest.mark.slow
def test_the_same_selection_gives_the_same_page(selection, folder):
    page = network_page(selection, network_figures(selection), folder)
    assert page == (folder / "fit.html").read_text(encoding="utf-8")


def test_no_network_explains(folder, tmp_path):
    """With the figures of another fit, at which nobody looks."""
    nothing = fit_networks(cell(), [network_of("R0-C1")])
    drawn = [
        FigureFiles(
            name, name, *[(folder / f"{name}.{kind}").read_bytes() for kind in (*KINDS, "svg")]
        )
        for name in FIGURES
    ]
    text = network_page(nothing, drawn, tmp_path)
    assert "<h1>No network explains the data</h1>" in text and "misses the data at" in text


@pytest.mark.slow
def test_the_band_of_the_line_is_the_scatter_of_refitted_lines(selection):
    """The fits of 40 other noises scatter by the standard errors that the first one states."""
    line = network_line(selection.fits[0], selection, 0)
    others = []
    for seed in range(40):
        (fit,) = fit_networks(cell(100 + seed), [network_of("R0-p(R1,C1)")]).fits
        p = np.array(list(fit.values.values()))
        others.append(NetworkPlant(fit.network, line.omega).response(p))
    amplitude = np.std(np.log(np.abs(others)), axis=0)
    across = np.std(
        (line.normal.conj() * (np.array(others) - np.mean(others, axis=0))).real, axis=0
    )
    for stated, had in ((line.sure.amplitude, amplitude), (line.across, across)):
        assert 0.7 < np.median(stated / had) < 1.4
        assert np.all(stated < 2.5 * had) and np.all(had < 2.5 * stated)


def test_a_capacitor_is_drawn_upward(selection, folder):
    from matplotlib.figure import Figure

    panel = Figure().subplots()
    _tube(panel, network_line(selection.fits[0], selection, 0))
    (patch,) = panel.patches
    assert patch.get_xy()[:, 1].max() > 30  # -Im Z of an arc of 80 ohm
    text = (folder / "fit.html").read_text(encoding="utf-8")
    assert "Nyquist diagram of R0-p(R1,C1) and the data, -Im Z upward" in text


def test_a_machine_has_no_nyquist_diagram(tmp_path):
    omega = np.logspace(0, 2, 40)
    model = network_of("1=2; F1; S1", quantity="position")
    p = np.array([0.3, 500.0, 1.0, 0.5])
    G = NetworkPlant(model, omega).response(p)
    noise = np.random.default_rng(1).normal(size=(2, 40)) * 1e-2
    data = FrequencyResponse(omega, G * (1 + noise[0] + 1j * noise[1]), quantity="position")
    write_network_report(fit_networks(data, [model]), tmp_path)
    assert not (tmp_path / "nyquist.svg").exists() and (tmp_path / "bode.svg").exists()


def test_a_plan_of_the_fit_is_a_page(folder, tmp_path):
    out = tmp_path / "plan"
    done = called("plan", folder / "fit.json", "--out", out, "--json", tmp_path / "plan.json")
    assert done.returncode == 0, done.stderr
    names = {path.name for path in out.iterdir()}
    figures = {f"plan-1.{kind}" for kind in KINDS}
    assert names == {"plan.html", "plan.json", "lines-1.csv", "spectrum-1.csv", *figures}
    assert (out / "plan.json").read_bytes() == (tmp_path / "plan.json").read_bytes()
    text = (out / "plan.html").read_text(encoding="utf-8")
    assert "<h1>Measure more to exclude p(R1,P1)</h1>" in text
    assert "<strong>p(R2,R0-C1)</strong>: the same responses" in text
    power = re.search(r"p\(R1,P1\) +[\d.]+ +([\d.]+ %)", done.stdout)[1]
    assert f'<td class="n">{power}</td>' in text
