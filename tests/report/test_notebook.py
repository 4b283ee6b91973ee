"""What a notebook shows: well-formed, complete in itself, short, escaped, with plots on given axes."""

import subprocess
import sys
from dataclasses import replace
from importlib import import_module
from pkgutil import walk_packages
from xml.etree import ElementTree

import matplotlib as mpl
import numpy as np
import pytest

import disting
from disting import (
    Chain,
    DistingError,
    Engine,
    Family,
    Model,
    ModelList,
    Query,
    View,
    catalog,
    compare,
    equivalents,
    explicit_map,
    gate,
    global_identifiability,
    network_of,
)
from disting.catalogs.next_files import next_catalog
from disting.catalogs.sizes import sizes_catalog
from disting.decide.identifiability.analysis import identifiability
from disting.fit import figure_1, plan, predict, select
from disting.fit.networks import fit_networks
from disting.measurement import FrequencyResponse, look, write_csv
from disting.model.presentation import NotebookTable
from disting.report import chain_svg
from disting.report.notebook import table_of

mpl.use("Agg")
DRIVE = Chain(2, damped=True, ground_dampers=(1,))
VALUES = {"m1": 0.02, "m2": 0.01, "k12": 500.0, "d12": 0.1, "b1": 0.3}
OMEGA = 2 * np.pi * np.geomspace(5, 200, 60)
UNITS = {"input": ("<F>", "N"), "output": ("a", "m/s^2")}
DATA = FrequencyResponse(OMEGA, predict(DRIVE, VALUES, OMEGA), **UNITS, origin="a & b.csv")
POLES = Model.from_transfer_function("c", "(s + a)*(s + b)", name="<i>poles</i>")
LARGEST = 60_000  # characters


@pytest.fixture(scope="module")
def found():
    return select(DATA, [c for c in figure_1([1, 2]) if not c.lag])


def parsed(html: str) -> ElementTree.Element:
    """Its tree; no script, no style sheet, nothing from elsewhere."""
    tree = ElementTree.fromstring(html)
    tags = {element.tag.rpartition("}")[2] for element in tree.iter()}
    assert not tags & {"script", "style", "link", "img", "iframe"}
    addresses = [v for e in tree.iter() for k, v in e.attrib.items() if k.endswith(("href", "src"))]
    assert not addresses and "var(" not in html
    return tree


def text(html: str) -> str:
    return " ".join(" ".join(parsed(html).itertext()).split())


@pytest.mark.full
def test_everything_with_a_table_is_well_formed_and_short(found, tmp_path):
    file = tmp_path / "a & b.csv"
    write_csv(DATA, file)
    family, engine = Family(3, damped=True), Engine()
    subjects = [engine.subject(f"A{n}", chain) for n, chain in enumerate(family, 1)]
    ones = dict.fromkeys(family[2].parameters, 1)
    for one in (
        catalog(5, damped=True),
        catalog(1, damped=False),
        *(catalog(3, damped=True).verdict(2, other) for other in (1, 5, 9)),
        compare(POLES, POLES),
        found,
        DATA,
        look(file),
        family,
        Family(5, damped=False),
        identifiability(family[3]),
        global_identifiability(POLES),
        POLES,
        ModelList((POLES,)),
        equivalents(family[2], ones, family),
        engine.decisions(subjects, Query(View.EXACT)),
        next_catalog(3, damped=True).further((1, 11)),
        plan(DRIVE, VALUES, replace(DRIVE, ground_dampers=(2,)), OMEGA, np.full(60, 0.01)),
    ):
        html = one._repr_html_()
        assert len(html) < LARGEST, type(one)
        parsed(html)


def test_whatever_is_shown_as_a_table_has_one():
    """No kind of object breaks a cell that ends with it."""
    every = [
        m.name for m in walk_packages(disting.__path__, "disting.") if "__main__" not in m.name
    ]
    kinds = {x for name in every for x in vars(import_module(name)).values() if isinstance(x, type)}
    tabled = [
        kind for kind in kinds if issubclass(kind, NotebookTable) and kind is not NotebookTable
    ]
    unknown = table_of.registry[object]
    assert len(tabled) > 15
    assert [kind.__name__ for kind in tabled if table_of.dispatch(kind) is unknown] == []


@pytest.mark.full
def test_candidates_before_a_fit_and_networks_are_shown():
    cell, other = network_of("R0-p(R1,C1)"), network_of("p(R0,R1-C1)")
    found = gate([cell, other])
    said = text(found._repr_html_())
    assert "1 model to be fitted" in said and "the same" in said and "p(R0,R1-C1)" in said
    assert "indistinguishable" in text(found.duplicates[0]._repr_html_())
    omega = np.logspace(0, 3, 30)
    noisy = 1 + 1e-3 * np.random.default_rng(1).normal(size=(30, 2)) @ [1, 1j]
    data = FrequencyResponse(omega, (1 + 2 / (1 + 0.02j * omega)) * noisy, quantity="position")
    assert "is the simplest that explains" in text(fit_networks(data, [cell, other])._repr_html_())
    assert "chains-5-damped" in text(sizes_catalog(damped=True)._repr_html_())


def test_a_chain_shows_the_drawing_of_the_pages_on_its_own_paper():
    chain = Family(3, damped=False)[4]
    picture = chain._repr_svg_()
    assert picture == chain_svg(chain)
    tree = ElementTree.fromstring(picture)
    ground = tree.find("{http://www.w3.org/2000/svg}rect")
    assert ground is not None and ground.attrib["fill"] == "#ffffff"
    assert ground.attrib["width"] == tree.attrib["width"]


def test_a_verdict_says_domain_certainty_and_what_it_rests_on():
    verdict = catalog(3, damped=True).verdict(2, 5)
    said = text(verdict._repr_html_())
    assert verdict.sentence in said
    assert "For every 3:2 there is a 3:5 with exactly the same response, and vice versa." in said
    assert "holds for all positive parameters" in said
    assert "certainty proven (symmetry)" in said and f"rests on {verdict.rule}" in said
    assert "positive 3:2 always with a positive equivalent 3:5" in said


@pytest.mark.full
def test_a_large_catalogue_shows_its_first_models_and_where_the_rest_is():
    said = text(catalog(5, damped=False)._repr_html_())
    assert "A12" in said and "A13" not in said
    assert "The first 12 of 73 models. catalog.matrix() has them all" in said
    assert "The first" not in text(catalog(3, damped=False)._repr_html_())


@pytest.mark.full
def test_the_matrix_of_a_catalogue_is_that_of_its_data_frame():
    rows = parsed(catalog(3, damped=False)._repr_html_()).findall(".//tbody/tr")
    signs = {"distinguishable": "≠", "indistinguishable": "=", "": None}
    wanted = [[signs[name] for name in row] for row in catalog(3, damped=False).matrix().to_numpy()]
    assert [[cell.text for cell in row[1:]] for row in rows] == wanted


@pytest.mark.full
def test_a_selection_lists_candidates_criteria_and_what_is_excluded(found):
    html = found._repr_html_()
    said = text(html)
    assert "Selected: 2:1+b1, 2 masses, damper b1." in said and "explains the data" in said
    rows = parsed(html).findall(".//tbody/tr")
    assert len(rows) == 12 and next("".join(r[0].itertext()) for r in rows) == "2:1+b1"
    reasons = [";".join(c.reasons).replace(";", "; ") for c in found.candidates[:12]]
    assert ["".join(r[-1].itertext()) for r in rows] == reasons


def test_what_users_write_is_escaped():
    assert "<i>" not in POLES._repr_html_() and "<i>poles</i>" in text(POLES._repr_html_())
    said = text(DATA._repr_html_())
    assert "<F> [N]" in said and "a & b.csv" in said and "60, 5 to 200 Hz" in said


def test_a_map_is_shown_as_a_formula():
    found = explicit_map(Chain(2, damped=False), Chain(2, 1, 1, 2, 1, 2, damped=False))
    assert found is not None
    assert found._repr_latex_().startswith("\\begin{align}")


@pytest.mark.full
def test_bode_diagrams_lie_on_new_axes_or_on_given_ones():
    first = DATA.plot(label="one")
    again = DATA.sign_reversed().plot(first, label="two", color="red")
    assert again == first and len(first) == 2
    amplitude, phase = first
    for line in amplitude.get_lines():
        np.testing.assert_allclose(line.get_xdata(), DATA.frequency)
        np.testing.assert_allclose(line.get_ydata(), np.abs(DATA.G))
    one, two = (line.get_ydata() for line in phase.get_lines())
    np.testing.assert_allclose(np.abs(two - one), 180.0)
    assert (
        amplitude.get_ylabel() == "Amplitude [m/s² per N]"
        and phase.get_ylabel() == "Phase [degree]"
    )
    assert [t.get_text() for t in amplitude.get_legend().get_texts()] == ["one", "two"]
    alone = mpl.figure.Figure().subplots()
    assert DATA.plot(alone) == (alone,) and len(alone.get_lines()) == 1
    with pytest.raises(DistingError, match="one or two axes, not 3"):
        DATA.plot(mpl.figure.Figure().subplots(3, 1))


@pytest.mark.full
def test_a_selection_is_drawn_as_data_and_the_structures_not_excluded(found):
    amplitude, phase = found.plot()
    dots, line = amplitude.get_lines()
    np.testing.assert_allclose(dots.get_ydata(), np.abs(DATA.G))
    at = np.interp(DATA.frequency, line.get_xdata(), line.get_ydata())
    np.testing.assert_allclose(at, np.abs(DATA.G), rtol=0.05)
    shown = [entry.get_text() for entry in amplitude.get_legend().get_texts()]
    assert shown == ["measured", "2:1+b1"]
    beside = [np.interp(20.0, entry.get_xdata(), entry.get_ydata()) for entry in phase.get_lines()]
    assert abs(beside[0] - beside[1]) < 5


@pytest.mark.full
def test_a_matrix_has_a_field_a_pair_in_the_place_of_its_models():
    axes = catalog(4, damped=False).plot()
    fields = axes.get_images()[0].get_array()
    assert fields.shape == (29, 29) and fields.mask.diagonal().all()
    names = [entry.get_text() for entry in axes.get_legend().get_texts()]
    assert names == ["distinguishable", "indistinguishable", "sometimes indistinguishable"]
    matrix = catalog(4, damped=False).matrix().to_numpy()
    assert ((fields == 1).filled(False) == (matrix == "indistinguishable")).all()
    given = mpl.figure.Figure().subplots()
    assert catalog(2, damped=False).plot(given) is given


REMEDY = "a plot needs matplotlib; install it: pip install matplotlib"


@pytest.mark.full
def test_without_matplotlib_a_plot_names_the_remedy(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert len(catalog(3, damped=False)._repr_html_()) > 1000
    with pytest.raises(DistingError, match=f"^{REMEDY}$"):
        catalog(3, damped=False).plot()


@pytest.mark.slow
def test_in_a_process_without_matplotlib_as_well():
    code = (
        "import sys; sys.modules['matplotlib'] = None\n"
        "import disting\n"
        "assert len(disting.catalog(3, damped=False)._repr_html_()) > 1000\n"
        "disting.catalog(3, damped=False).plot()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=600)
    assert done.stderr.splitlines()[-1] == f"disting.errors.DistingError: {REMEDY}"
