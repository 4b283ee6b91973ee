"""Simulated records of networks: the response without noise is the transfer function, expanded
elsewhere; friction is that of any node.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st

from disting.errors import InputError
from disting.general.any_model import of_network
from disting.model.chain import Chain, Quantity
from disting.network import Element, Network, Port, network_of
from disting.network.chains import of_chain
from disting.simulation import (
    Bench,
    Excitation,
    Friction,
    frequency_response,
    matrices,
    simulate,
    simulate_all,
)
from tests.network.drawn import built, descriptions

BENCH = Bench(sampling_rate=1000.0, samples=1000, periods=3)
BAND = Excitation(low=5.0, high=200.0)
TREE = "1=2=3, 2=4, 4=#; F1; S4:3"
LOOP = "1~2, 2~3*i, 1~3, 3~#; F2; S1"
TEXTS = [
    TREE, LOOP, "1~2, 2~#, 3~#; F1; S1", "R0-p(R1,C1)-W1", "R1 1 2; L1 2 0; C1 1 0; C2 2 3; R2 3 0; R3 1 3; port 1 2",
    "L1-R1", "1>2, 2>3, 3>1, 2>0; in 1; out 3",
]  # fmt: skip
SIZES = {"m": 0.01, "k": 500.0, "d": 0.1, "b": 0.1, "C": 1e-3, "L": 1e-2}


def truth(network, seed=0):
    draw = np.random.default_rng(seed)
    sizes = (SIZES.get(name[0], 1.0) for name in network.parameters)
    return dict(
        zip(network.parameters, [x * np.exp(0.5 * draw.normal()) for x in sizes], strict=True)
    )


def expanded(network, values, omega):
    """Independent: the quotient of polynomials by exact determinants, at j omega."""
    model = of_network(network)
    s = np.sqrt(1j * omega) if model.powers.halves else 1j * omega
    point = [values[name] for name in model.parameters]
    top, bottom = (
        sum(
            sum(c * np.prod(np.power(point, e)) for e, c in terms) * s**i
            for i, terms in enumerate(side)
        )
        for side in (model.numerator_terms, model.denominator_terms)
    )
    return top / bottom


@pytest.mark.full
def test_all_sensors_of_an_experiment():
    """Each response is that of the network between both; one recorded input for all sensors."""
    network = network_of("1=2=3, 2=4; F1 F3; S4 S3:2", quantity="position")
    values = truth(network)
    clean = simulate_all(network, values, BAND, BENCH)
    for cells, records in zip(network.cells, clean, strict=True):
        for cell, record in zip(cells, records, strict=True):
            found = record.response()
            np.testing.assert_allclose(found.G, expanded(cell, values, found.omega), rtol=1e-7)
    loud = replace(BENCH, input_noise=0.1, output_noise=0.1)
    (a, b), (c, d) = simulate_all(network, values, BAND, loud)
    assert np.array_equal(a.u, c.u) and not np.array_equal(a.u, b.u)
    noise = [
        loud.y - clean.y for loud, clean in ((a, clean[0][0]), (c, clean[1][0]), (d, clean[1][1]))
    ]
    assert np.abs(np.corrcoef(noise) - np.eye(3)).max() < 0.1


@pytest.mark.parametrize("text", TEXTS)
def test_a_record_without_noise_has_the_response_of_the_network(text):
    network = network_of(text, quantity="velocity")
    values = truth(network)
    found = simulate(network, values, BAND, BENCH).response()
    assert len(found) == 196 and found.quantity is list(Quantity)[network.order]
    np.testing.assert_allclose(found.G, expanded(network, values, found.omega), rtol=1e-7)


@pytest.mark.full
@settings(max_examples=60)
@given(descriptions(most_ports=1), st.integers(0, 2**32))
def test_responses_of_networks(description, seed):
    network = built(description)
    assume(isinstance(network, Network) and network.shape == (1, 1) and not network.exponents)
    draw = np.random.default_rng(seed)
    values = {name: float(draw.uniform(0.5, 2)) for name in network.parameters}
    omega = draw.uniform(0.3, 3, 5)
    try:
        found = frequency_response(network, values, omega)
        expected = expanded(network, values, omega)
    except InputError:
        return
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-9)


def test_an_impedance_by_hand():
    omega = np.array([1.0, 30.0, 1e3])
    found = frequency_response(
        network_of("R0-p(R1,C1)-L1"), {"R0": 1.0, "R1": 2.0, "C1": 0.1, "L1": 3.0}, omega
    )
    np.testing.assert_allclose(found, 1 + 2 / (1 + 0.2j * omega) + 3j * omega, rtol=1e-10)


def test_a_constant_phase_element_by_hand():
    omega, values = np.array([1.0, 30.0, 1e3]), {"R0": 1.0, "R1": 2.0, "P1": 0.1, "n1": 0.8}
    found = frequency_response(network_of("R0-p(R1,P1)"), values, omega)
    np.testing.assert_allclose(found, 1 + 2 / (1 + 0.2 * (1j * omega) ** 0.8), rtol=1e-10)


def test_what_a_circuit_shows_is_a_voltage_per_ampere():
    record = simulate(network_of("R1-L1"), {"R1": 1.0, "L1": 1.0})
    assert record.input == ("current", "A") and record.output == ("voltage", "V")


@pytest.mark.full
def test_a_chain_as_a_network_gives_the_same_record():
    chain = Chain(3, meas_plus=3, damped=True, ground_dampers=(2,))
    network = of_chain(chain)
    values = truth(network)
    rubbed = replace(BENCH, friction={2: Friction(coulomb=0.1, viscous=0.1)})
    for bench in (BENCH, rubbed):
        assert np.array_equal(
            simulate(chain, values, BAND, bench).y, simulate(network, values, BAND, bench).y
        )


def test_viscous_friction_of_a_node_is_a_damper_to_the_ground():
    values = truth(network_of("1=2=3, 2=4; F1; S4"))
    with_damper = network_of("1=2=3, 2=4, 3-#; F1; S4")
    left = simulate(with_damper, values | {"b3": 0.2}, BAND, BENCH)
    bench = replace(BENCH, friction={3: Friction(viscous=0.2)})
    right = simulate(network_of("1=2=3, 2=4; F1; S4"), values, BAND, bench)
    np.testing.assert_allclose(left.y, right.y, atol=1e-9 * np.abs(left.y).max())


@pytest.mark.full
def test_time_steps_of_a_geared_loop_agree_with_the_exact_lines():
    network = network_of("1=2*i, 2=3, 1=3; F1; S3", quantity="position")
    values = truth(network)
    bench = Bench(samples=500, periods=2, friction={3: Friction(coulomb=1e-10)})
    record = simulate(network, values, Excitation(low=20.0), bench)
    exact = simulate(network, values, Excitation(low=20.0), replace(bench, friction={}))
    assert np.abs(record.y - exact.y).max() < 1e-5 * np.abs(exact.y).max()


@pytest.mark.parametrize(
    ("text", "values", "friction", "words"),
    [
        ("1~2; F1; S1, S2", {}, {}, "several inputs or outputs: simulate_all records"),
        ("R1-C1", {"R1": 1}, {}, "parameters C1, R1 are needed"),
        ("R1-C1", {"R1": 0, "C1": 1}, {}, "R1 = 0 is not a positive"),
        ("R1-P1", {"R1": 1, "P1": 1}, {}, "parameters P1, R1, n1 are needed"),
        ("R1-P1", {"R1": 1, "P1": 1, "n1": 1.5}, {}, "n1 = 1.5 is not an exponent"),
        ("R1-C1", {"R1": 1, "C1": -1}, {}, "C1 = -1 is not a non-negative"),
        ("R1-C1", {"R1": 1, "C1": 1}, {1: Friction(1.0)}, "friction is supported for machines"),
        ("1~2; F1; S2", {"m1": 1, "m2": 1, "k12": 1}, {3: Friction(1.0)}, "masses 1, 2, not at"),
    ],
)  # fmt: skip
def test_bad_input_is_refused(text, values, friction, words):
    with pytest.raises(InputError, match=words):
        simulate(network_of(text), values, bench=Bench(friction=friction))


def test_friction_needs_a_mass():

    elements = Element("m1", "m", (1,)), Element("k12", "k", (1, 2)), Element("k20", "k", (2, 0))
    network = Network(elements, (Port(1),), (Port(1),))
    assert matrices(network, {"m1": 1, "k12": 1, "k20": 1}).M.tolist() == [[1, 0], [0, 0]]
    with pytest.raises(InputError, match="needs a mass at every node"):
        simulate(network, {"m1": 1, "k12": 1, "k20": 1}, bench=Bench(friction={1: Friction(1e-3)}))
