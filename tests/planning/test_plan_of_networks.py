"""How much measuring tells networks apart: the best fit by another route, and the power that is had."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import chi2

from disting.errors import InputError
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.network import network_of
from disting.network.chains import of_chain
from disting.planning.power import LEVEL, Answer, plan
from disting.planning.rival import Trust, gain
from disting.planning.spectrum import Adversary
from disting.simulation import frequency_response

MODEL, RIVAL = network_of("R0-p(R1,C1)-p(R2,C2)"), network_of("R0-p(R1,C1)")
VALUES = {"R0": 1.0, "R1": 2.0, "C1": 0.01, "R2": 0.3, "C2": 0.3}
OMEGA = 2 * np.pi * np.geomspace(0.1, 1000.0, 40)


def alike(noise):
    return np.full(len(OMEGA), noise)


@pytest.fixture(scope="module")
def planned():
    """At the noise that is just enough."""
    found = plan(MODEL, VALUES, RIVAL, OMEGA, alike(0.05))
    return plan(MODEL, VALUES, RIVAL, OMEGA, alike(0.05 / np.sqrt(found.factor)))


@pytest.mark.full
def test_best_fit_of_the_rival_is_that_of_another_optimiser(planned):
    exact, rho = frequency_response(MODEL, VALUES, OMEGA), planned.rival.rho

    def cost(logarithms):
        values = dict(zip(RIVAL.parameters, np.exp(logarithms), strict=True))
        ratio = frequency_response(RIVAL, values, OMEGA) / exact
        return np.sum(np.abs(ratio - 1) ** 2 / rho**2)

    draw = np.random.default_rng(3)
    starts = draw.normal(size=(5, 3)) + [np.log(VALUES[name]) for name in RIVAL.parameters]
    ends = [
        minimize(cost, start, method="Nelder-Mead", options={"maxiter": 2000}) for start in starts
    ]
    assert planned.noncentrality == pytest.approx(min(end.fun for end in ends), rel=1e-3)
    assert planned.rival.trust is Trust.AGREED and planned.surplus == 2


@pytest.mark.full
def test_planned_power_is_had(planned):
    assert planned.power == pytest.approx(0.95, abs=1e-6)
    draw, exact = np.random.default_rng(1), frequency_response(MODEL, VALUES, OMEGA)
    limit, count, excluded = chi2.isf(LEVEL, planned.surplus), 80, 0
    for _ in range(count):
        error = draw.normal(size=len(OMEGA)) + 1j * draw.normal(size=len(OMEGA))
        measured = FrequencyResponse(
            OMEGA, exact * (1 + planned.rival.rho * error), quantity="position"
        )
        excluded += gain(planned.rival, measured) > limit
    assert excluded / count == pytest.approx(0.95, abs=3.5 * np.sqrt(0.95 * 0.05 / count))


@pytest.mark.full
def test_a_chain_is_planned_alike_as_a_network():
    model, rival = (Chain(2, damped=True, ground_dampers=(i,)) for i in (1, 2))
    values = {"m1": 0.0045, "m2": 0.005, "k12": 550.0, "d12": 0.08, "b1": 0.1}
    omega = 2 * np.pi * np.geomspace(5.0, 300.0, 60)
    one, other = (
        plan(model_, values, rival_, omega, np.full(60, 0.3))
        for model_, rival_ in ((model, rival), (of_chain(model), of_chain(rival)))
    )
    assert other.noncentrality == pytest.approx(one.noncentrality, rel=1e-5)
    assert other.surplus == one.surplus and other.verdict.relation is one.verdict.relation
    for name, value in one.rival.parameters.items():
        assert other.rival.parameters[name] == pytest.approx(value, rel=1e-2)


@pytest.mark.full
def test_an_exponent_is_a_parameter_of_the_rival():
    values = {"R1": 1.0, "P1": 0.01, "n1": 0.7}
    model, rival = network_of("p(R1,P1)"), network_of("R0-p(R1,C1)")
    found = plan(model, values, rival, OMEGA, alike(0.1)).rival
    assert found.trust is Trust.AGREED and found.noncentrality > 1
    back = plan(rival, found.parameters, model, OMEGA, alike(0.1)).rival
    assert 0 < back.parameters["n1"] <= 1 and back.noncentrality > 0


def test_same_networks_are_not_even_fitted():
    found = plan(RIVAL, VALUES, network_of("p(R0,R1-C1)"), OMEGA, alike(0.1))
    assert found.answer is Answer.IMPOSSIBLE and found.rival is None


@pytest.mark.full
def test_a_network_in_which_the_model_is_contained_is_never_excluded():
    found = plan(RIVAL, {n: VALUES[n] for n in RIVAL.parameters}, MODEL, OMEGA, alike(0.1))
    assert found.answer is Answer.SAME and found.is_contained


DRIVE = {"m1": 0.01, "m2": 0.02, "m3": 0.01, "k12": 500.0, "k23": 300.0}
LINES = 2 * np.pi * np.geomspace(5.0, 200.0, 40)


@pytest.mark.full
def test_what_several_sensors_tell_is_summed():
    """Two sensors that show the same tell twice as much; another one tells more than one alone."""
    values = DRIVE | {"d12": 0.1, "d23": 0.1}
    size = {
        ports: plan(
            *(network_of(f"{t}; F1; {ports}") for t in ("1=2=3", "1=2")[:1]), values,
            network_of(f"1=2; F1; {ports.replace('3', '2')}"), LINES, np.full(40, 0.1),
        )
        for ports in ("S1", "S1 S1", "S1 S3")
    }  # fmt: skip
    one, twice, both = (found.noncentrality for found in size.values())
    assert twice == pytest.approx(2 * one, rel=1e-4) and both > 1.01 * one
    assert size["S1 S3"].rival.recovered and len(size["S1 S3"].rival.apart) == 40
    shares = np.full(40, 1 / 40)
    for found in size.values():
        adversary = Adversary(found.rival)
        assert adversary.bound(shares) == pytest.approx(found.noncentrality)
        assert adversary.noncentrality(shares) == pytest.approx(found.noncentrality, rel=1e-4)


@pytest.mark.slow
def test_planned_power_of_two_sensors_is_had():
    model, rival = (network_of(t) for t in ("R1-p(R2,C2)-p(R3,C3)", "R1-p(R2,C2)"))
    model, rival = (replace(n, inputs=n.inputs * 2, outputs=n.outputs) for n in (model, rival))
    values = {"R1": 1.0, "R2": 2.0, "C2": 0.01, "R3": 0.3, "C3": 0.3}
    found = plan(model, values, rival, OMEGA, alike(0.1))
    found = plan(model, values, rival, OMEGA, alike(0.1 / np.sqrt(found.factor)))
    assert found.power == pytest.approx(0.95, abs=1e-6)
    draw, limit, excluded = np.random.default_rng(5), chi2.isf(LEVEL, found.surplus), 0
    parts = [part.measured for part in found.rival.cost.parts]
    for _ in range(60):
        noise = draw.normal(size=(2, len(OMEGA), 2)) @ [1, 1j]
        seen = [
            replace(m, G=m.G * (1 + found.rival.rho * e)) for m, e in zip(parts, noise, strict=True)
        ]
        excluded += gain(found.rival, *seen) > limit
    assert excluded >= 51  # of 57 expected, 3.6 standard deviations
    with pytest.raises(InputError, match="at the planned lines"):
        gain(found.rival, parts[0])


@pytest.mark.full
def test_an_undamped_machine_is_found_back():
    """From random starts its sharp resonances are seen from nowhere."""
    tree, row = network_of("1~2, 1~3; F1; S2 S3"), network_of("1~2~3; F1; S2 S3")
    values = {"m1": 0.01, "m2": 0.012, "m3": 0.006, "k12": 500.0, "k13": 900.0}
    found = plan(tree, values, row, LINES, np.full(40, 0.1))
    assert found.rival.recovered and found.answer is Answer.ENOUGH


@pytest.mark.full
def test_a_sensor_that_shows_nothing_is_named():
    models = [network_of(f"1=#, 2=#{more}; F1 F2; S1 S2") for more in ("", ", 1=2")]
    values = dict.fromkeys(models[0].parameters, 1.0)
    with pytest.raises(InputError, match="does not affect one of the sensors"):
        plan(models[0], values, models[1], LINES, np.full(40, 0.1))


@pytest.mark.parametrize(
    ("rival", "words"),
    [
        (MODEL, "not a rival of itself"),
        (Chain(2), "write the chain as a network too"),
        (replace(RIVAL, inputs=RIVAL.inputs * 2), "has 1 x 2"),
    ],
)
def test_bad_input_is_named(rival, words):
    with pytest.raises(InputError, match=words):
        plan(MODEL, VALUES, rival, OMEGA, alike(0.1))
