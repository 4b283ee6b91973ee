"""Networks fitted to responses: truths that are kept, published fits, bad input."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from disting import InputError, Quantity
from disting.fit.networks import _excluding, _improve_to_contained, _limits, fit_networks
from disting.fit.search.network_plant import NetworkPlant, NetworkPlants
from disting.general.any_model import of_network
from disting.measurement import FrequencyResponse, read, write_csv
from disting.network import Network, network_of
from disting.network.families import family_of
from disting.statistics.covariance import Noise, expected_deviation
from tests.cli.process import called

DATA = Path(__file__).parents[2].parent / "shared" / "data" / "eis"
needs_data = pytest.mark.skipif(not DATA.is_dir(), reason="no folder with measured impedances")
TEXTS = [
    "R0-p(R1,C1)-W1",
    "R0-p(R1-W1,P1)-p(P2,L1)",
    "L1-p(R1,C1)",
    "1=2*i, 2=3, 2~4; F1; S4",
    "1=2*3/2, 2-#; F1; S2:1; position",
    "1>2, 2>1, 2>0; in 1; out 2",
    "#=1, #=2, 1=2; F1; S2:1",
    "1=2; F1; S#:2",
    "1=2=3; F1:3; S3:2",
]


@pytest.mark.parametrize("text", TEXTS)
def test_response_and_gradient_are_those_of_the_transfer_function(text):
    network, draw = network_of(text), np.random.default_rng(1)
    model, plant = of_network(network), NetworkPlant(network, np.logspace(0, 2, 7))
    p = np.exp(draw.normal(size=(3, len(plant.parameters))))
    p[:, plant.highest < np.inf] = draw.uniform(0.5, 1, (3, len(network.exponents)))
    response, gradient = plant.logarithmic_gradient(p)
    s = 1j * plant.omega
    for k, values in enumerate(p):
        known = dict(zip(plant.parameters, values, strict=True))
        point = [known[name] for name in model.parameters]
        root = np.sqrt(s) if model.powers.halves else s
        bases = [root, *(s ** known[name] for name in model.powers.exponents)]
        top, bottom = (
            sum(
                sum(c * np.prod(point ** np.array(e)) for e, c in terms)
                * np.prod([b**k for b, k in zip(bases, model.powers.parts(i), strict=True)], axis=0)
                for i, terms in enumerate(side)
            )
            for side in (model.numerator_terms, model.denominator_terms)
        )
        np.testing.assert_allclose(response[k], top / bottom, rtol=1e-9)
        for j in range(len(values)):
            step = 1e-6 * values[j] * np.eye(len(values))[j]
            moved = np.log(plant.response(values + step) / plant.response(values - step))
            np.testing.assert_allclose(
                gradient[k, j], moved / (2e-6 * values[j]), rtol=1e-3, atol=1e-6
            )


@pytest.mark.full
def test_stacked_responses_have_the_gradients_of_each():
    network = network_of("1=2*i, 2~#; F1 F2; S1 S2:1")
    omegas = tuple(np.logspace(0, 1, n) for n in (3, 4, 5, 6))
    plant = NetworkPlants(network, omegas)
    p = np.exp(np.random.default_rng(1).normal(size=(2, len(plant.parameters))))
    response, gradient = plant.logarithmic_gradient(p)
    assert response.shape == (2, 18)
    np.testing.assert_allclose(plant.response(p), response)
    model = of_network(network)
    for k, (row, column) in enumerate([(0, 0), (0, 1), (1, 0), (1, 1)]):
        s = 1j * omegas[k]
        values = dict(zip(plant.parameters, p[0], strict=True))
        one = lambdify(str(model.rows[row][column]).removeprefix("G(s) = "), values)
        np.testing.assert_allclose(np.split(response[0], [3, 7, 12])[k], one(s), rtol=1e-9)
    for j in range(p.shape[1]):
        step = 1e-6 * p * np.eye(p.shape[1])[j]
        moved = np.log(plant.response(p + step) / plant.response(p - step)) / (2e-6 * p[:, [j]])
        np.testing.assert_allclose(gradient[:, j], moved, rtol=1e-3, atol=1e-6)


def lambdify(text, values):
    import sympy as sp

    return sp.lambdify(sp.Symbol("s"), sp.sympify(text, values))


@pytest.mark.full
def test_two_sensors_are_fitted_together(tmp_path):
    omega, draw = np.logspace(-0.7, 1, 80), np.random.default_rng(3)
    texts = ["1=2=3; F1; S1 S3", "1=2, 1=3; F1; S1 S3", "1=2; F1; S1 S2"]
    plant = NetworkPlants(network_of(texts[1], quantity=Quantity.POSITION), (omega, omega))
    values = {"d12": 0.2, "d13": 0.3, "k12": 3.0, "k13": 7.0, "m1": 1.0, "m2": 2.0, "m3": 0.5}
    assert plant.parameters == tuple(values)
    clean = np.split(plant.response(np.array(list(values.values()))), 2)
    noisy = [c * (1 + 2e-3 * draw.normal(size=(80, 2)) @ [1, 1j]) for c in clean]
    data = [FrequencyResponse(omega, g, quantity=Quantity.POSITION) for g in noisy]
    found = fit_networks(data, list(map(network_of, texts)))
    assert [f.network.name for f in found.left] == [texts[1]]
    assert found.left[0].values == pytest.approx(values, rel=0.02)
    for name, one in zip("ab", data, strict=True):
        write_csv(one, tmp_path / f"{name}.csv")
    command = ["fit", tmp_path / "a.csv", tmp_path / "b.csv", "--quantity", "position"]
    for text in texts:
        command += ["--models", text]
    done = called(*command)
    assert done.returncode == 0, done.stderr
    assert f"{texts[1]} is the simplest that explains the data." in done.stdout


@pytest.mark.parametrize(
    ("texts", "count", "said"),
    [
        (["1~2; F1; S1 S2"], 1, "give as many measured responses, not 1"),
        (["1~2; F1; S1 S2", "1~2; F1; S1"], 2, "fit them separately"),
        ([], 1, "name at least one network"),
    ],
)
def test_responses_and_networks_that_do_not_fit_each_other(texts, count, said):
    one = FrequencyResponse(np.logspace(0, 1, 20), np.ones(20) + 0j, quantity=Quantity.POSITION)
    with pytest.raises(InputError, match=said):
        fit_networks([one] * count, list(map(network_of, texts)))


def test_a_sensor_between_two_masses_that_move_alike_keeps_its_digits():
    """G = s^2 (x2 - x1)/F of two masses, stiffly joined: -m2/((m1 + m2) k12) in the limit."""
    plant = NetworkPlant(network_of("1~2, 2~#; F1; S2:1"), np.array([1.0]))
    assert plant.parameters == ("k02", "k12", "m1", "m2")
    far = np.array([1e-3, 1e18, 1.0, 2.0])
    response, gradient = plant.logarithmic_gradient(far)
    # x2 - x1 = -F (k02 + m2 s^2) / (k12 (k02 + (m1 + m2) s^2)), s^2 = -1
    truth = (1e-3 - 2.0) / (1e18 * (1e-3 - 3.0))
    np.testing.assert_allclose(response, [truth], rtol=1e-12)
    np.testing.assert_allclose(gradient[1] * 1e18, [-1.0], rtol=1e-12)


def test_what_a_fit_is_to_miss_is_a_number_where_values_hardly_matter():
    columns = np.random.default_rng(1).normal(size=(20, 3))
    tiny = columns * [1.0, 1e-60, 1e-161]
    np.testing.assert_allclose(
        expected_deviation(tiny, np.ones(20)), expected_deviation(columns, np.ones(20))
    )


def simulated(network: Network, draw: np.random.Generator, noise: float) -> FrequencyResponse:
    """The response that its sensor shows, at values within a factor of three of 1, with noise of
    constant size.
    """
    omega = np.logspace(-2, 2, 80)
    plant = NetworkPlant(network, omega)
    clean = plant.response(np.exp(draw.uniform(-1.1, 1.1, len(plant.parameters))))
    size = noise * np.abs(clean)
    noisy = clean + size * (draw.normal(size=(80, 2)) @ np.array([1, 1j]))
    return FrequencyResponse(omega, noisy, quantity=list(Quantity)[network.order])


def kept(name: str, count: int, seed: int) -> int:
    """How often the truth, or what cannot be told from it, is left, of networks of a family."""
    draw, family = np.random.default_rng(seed), family_of(name).networks
    found = 0
    for _ in range(count):
        truth = family[draw.integers(len(family))]
        others = [family[i] for i in draw.choice(len(family), 8)]
        networks = list(dict.fromkeys([*others, truth]))
        left = fit_networks(simulated(truth, draw, 0.01), networks).left
        found += any(truth.name in (f.network.name, *f.same) for f in left)
    return found


@pytest.mark.slow
def test_the_true_circuit_is_kept():
    assert kept("cells-4", 2, 1) == 2


@pytest.mark.slow
@pytest.mark.parametrize("name", ["circuits-4", "cells-4", "machines-2-damped"])
def test_the_truth_is_kept_in_95_of_100(name):
    assert kept(name, 60, 2) >= 57


@pytest.mark.full
def test_wrong_networks_are_excluded_or_do_not_explain():
    truth = network_of("R0-p(R1,C1)-p(R2,C2)")
    plant = NetworkPlant(truth, np.logspace(0, 4, 60))
    assert plant.parameters == ("C1", "C2", "R0", "R1", "R2")
    clean = plant.response(np.array([1e-2, 1e-3, 1.0, 2.0, 3.0]))
    noisy = clean * (1 + 3e-3 * np.random.default_rng(1).normal(size=(60, 2)) @ [1, 1j])
    data = FrequencyResponse(plant.omega, noisy, quantity="position")
    texts = ["R0-p(R1,C1)", "R0-p(R1-W1,C1)", truth.name, "R0-p(C1,R1-p(R2,C2))"]
    found = fit_networks(data, list(map(network_of, texts)))
    assert found.selected is not None and found.selected.network.name == truth.name
    assert found.selected.same == (texts[3],)
    assert [f.network.name for f in found.left] == [truth.name]
    low, high = sorted([found.selected.values["C1"], found.selected.values["C2"]])
    assert (low, high) == pytest.approx((1e-3, 1e-2), rel=0.05)
    first = found.selected
    for step, is_first in ((-1e-9, True), (-1e-3, False)):  # rounding selects nothing
        other = replace(first, residual=first.residual * (1 + step))
        assert (replace(found, fits=(first, other)).selected is first) == is_first


@pytest.mark.full
@pytest.mark.parametrize(("left", "excluded"), [(-2.9, False), (-2.0, True), (0.0, True)])
def test_a_network_that_fits_alike_in_another_place_excludes_none(left, excluded):
    """T is above 8, the cost lower by 0.6, 5 and 9."""
    omega = np.logspace(0, 4, 30)
    data = FrequencyResponse(omega, np.full(30, 2 + 0j), np.full(30, 0.02), quantity="position")
    found = fit_networks(data, [network_of("R1")])
    rest = np.random.default_rng(4).normal(size=59)
    true, other = (
        replace(
            found.fits[0],
            network=replace(found.fits[0].network, name=name),
            residual=np.array([size, *rest]),
            basis=np.empty((60, 0)),
            noise=Noise(np.ones(60)),
        )
        for name, size in (("true", 3.0), ("other", left))
    )
    scatter = replace(found.scatter, freedom=np.inf)
    assert (_excluding(true, [true, other], scatter) == "other") == excluded


def test_responses_of_two_quantities_are_refused():
    omega = np.logspace(0, 2, 20)
    data = [FrequencyResponse(omega, omega + 1j, quantity=q) for q in ("velocity", "position")]
    with pytest.raises(InputError, match="all responses of a network must have the same quantity"):
        fit_networks(data, ["1~2; F1; S1 S2"])


@pytest.mark.full
def test_a_search_that_failed_begins_again_at_the_limit():
    """At a capacitor and without an inductor; or the network has what the limit shows."""
    small, large = map(network_of, ("R0-p(R1,C1)", "R0-p(R1,P1)-L1"))
    plants = [NetworkPlant(network, np.logspace(0, 4, 40)) for network in (small, large)]
    assert plants[0].parameters == ("C1", "R0", "R1")
    noise = 3e-3 * np.random.default_rng(1).normal(size=(40, 2)) @ [1, 1j]
    measured = plants[0].response(np.array([1e-3, 1.0, 2.0])) * (1 + noise)
    data = FrequencyResponse(plants[0].omega, measured, quantity="position")
    found = fit_networks(data, [small, large])
    fits = [next(f for f in found.fits if f.network == plant.network) for plant in plants]
    fits[1] = replace(fits[1], residual=100 * fits[1].residual, chi2=1e4, explains=False)
    limits = _limits(fits, [[small], [large]])
    assert [*limits] == [(1, 0)]
    _, again = _improve_to_contained(fits, limits, plants, [data], found.scatter)
    assert again.explains and again.cost <= fits[0].cost * 1.001
    assert again.values["n1"] == pytest.approx(1, abs=0.05)
    assert again.values["R1"] == pytest.approx(2, rel=0.05)
    perfect = [replace(fits[0], residual=0 * fits[0].residual), fits[1]]  # that no search reaches
    quiet = replace(found.scatter, rho=found.scatter.rho / 100)
    _, there = _improve_to_contained(perfect, limits, plants, [data], quiet)
    assert there.explains and (there.cost, there.chi2) == (0, fits[0].chi2)


@pytest.mark.full
def test_an_exponent_is_found_and_a_capacitor_excluded():
    texts = ["R0-p(R1,C1)", "R0-p(R1,P1)", "p(R0,R1-P1)", "R0-p(R1,W1)"]
    plant = NetworkPlant(network_of(texts[1]), np.logspace(0, 5, 60))
    assert plant.parameters == ("P1", "R0", "R1", "n1")
    noise = 2e-3 * np.random.default_rng(5).normal(size=(60, 2)) @ [1, 1j]
    measured = plant.response(np.array([1e-4, 10.0, 50.0, 0.83])) * (1 + noise)
    data = FrequencyResponse(plant.omega, measured, quantity="position")
    found = fit_networks(data, list(map(network_of, texts)))
    assert [f.network.name for f in found.left] == [texts[1]]
    best = found.left[0]
    assert (best.same, best.rank) == ((texts[2],), 4)
    assert best.values["n1"] == pytest.approx(0.83, abs=5e-3)
    assert best.relative["n1"] == pytest.approx(2e-3, rel=2)


@pytest.mark.full
@needs_data
def test_a_capacitor_is_a_constant_phase_element_of_exponent_one():
    """A dummy cell of resistors and a capacitor: 150 and 502 ohm, published."""
    (fit,) = fit_networks(read(DATA / "Circuit2_EIS_1.z"), [network_of("R0-p(R1,CPE1)")]).fits
    assert fit.values["n1"] == pytest.approx(1, abs=5e-3)
    assert (fit.values["R0"], fit.values["R1"]) == pytest.approx((150, 502), rel=5e-3)


@pytest.mark.full
@needs_data
@pytest.mark.parametrize(
    ("file", "published"),
    [
        ("Circuit2_EIS_1.z", {"R0": 150, "R1": 502, "C1": 3.12e-8}),
        ("Circuit3_EIS_1.z", {"R0": 1510, "R1": 4630, "C1": 2.02e-8}),
    ],
)
def test_published_values_of_dummy_cells(file, published):
    (fit,) = fit_networks(read(DATA / file), [network_of("R0-p(R1,C1)")]).fits
    assert fit.values == pytest.approx(published, rel=0.005)


@needs_data
@pytest.mark.parametrize(
    ("file", "lines", "first"),
    [
        ("exampleDataGamry.DTA", 72, 17007.49 - 6635.557j),
        ("exampleDataBioLogic.mpt", 43, 110.97003 - 2.3458567j),
        ("exampleDataZPlot.z", 21, 613.68 - 137.13j),
    ],
)
def test_files_of_instruments(file, lines, first):
    found = read(DATA / file)
    assert len(found) == lines and found.G[0] == pytest.approx(first)


@pytest.mark.full
def test_the_command_takes_minus_im_and_tells_what_is_left(tmp_path):
    omega = np.logspace(0, 4, 60)
    cell = 1 + 2 / (1 + 0.02j * omega)
    cell = cell * (1 + 1e-3 * np.random.default_rng(1).normal(size=(60, 2)) @ [1, 1j])
    rows = zip(omega / (2 * np.pi), cell.real, -cell.imag, strict=True)
    file = tmp_path / "cell.csv"
    file.write_text("\n".join(",".join(map(str, row)) for row in rows))
    told = tmp_path / "found.json"
    words = [str(file), "--models", "R0-C1", "--models", "R0-p(R1,C1)", "--json", str(told)]
    done = called("fit", *words)
    assert done.returncode == 0, done.stderr
    assert "R0-p(R1,C1) is the simplest that explains the data." in done.stdout
    assert "taken as -Im" in done.stderr
    found = json.loads(told.read_text())
    assert found["selected"] == "R0-p(R1,C1)" and found["fits"][0]["values"]["R1"] == pytest.approx(
        2, rel=0.01
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--models", "3:1"], "is not a network"),
        (["--models", "R1-C1", "--models", "1=2; F1; S1"], "fit them separately"),
        (
            ["--models", "R1-C1", "--masses", "3"],
            "--masses adds chains; it is supported with machines",
        ),
        (["--models", "R1-C1", "--models", "R1-C1"], "named twice"),
        (["--models", "cells-9"], "families of networks are"),
    ],
)
def test_bad_input_is_one_sentence(tmp_path, words, said):
    file = tmp_path / "a.csv"
    file.write_text("\n".join(f"{k},{1 / k},0.1" for k in range(1, 20)))
    done = called("fit", file, *words)
    assert done.returncode == 2 and said in done.stderr and "Traceback" not in done.stderr
