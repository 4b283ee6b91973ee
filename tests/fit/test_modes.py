"""The optimum from the truth is found from the data alone, whatever the lines; modes of the data
become masses and springs.
"""

from math import inf

import numpy as np
import pytest

from disting.fit.search.cost import Cost
from disting.fit.search.estimate import Estimate, Task, refine
from disting.fit.search.exchange import estimates
from disting.fit.search.modes import from_modes, row
from disting.fit.search.plant import Plant
from disting.measurement import FrequencyResponse, from_arrays
from disting.model.chain import Chain

BASE = (1, 1, 2, 1, 2)
KINDS = [
    Chain(2, damped=False, lag=True),
    Chain(3, damped=False),
    Chain(3, damped=False, dead_time=True),
    Chain(2, *BASE, damped=False),
    Chain(3, *BASE, damped=False, dead_time=True),
    Chain(4, *BASE),
]


def drawn(
    chain: Chain, seed: int, noise: float = 0.007
) -> tuple[dict[str, float], FrequencyResponse]:
    """Values of a drive and its response at 60 to 120 lines, 3 to 500 Hz."""
    source = np.random.default_rng(seed)
    f = np.geomspace(3, 500, int(source.integers(60, 121)))

    def value(name: str) -> float:
        match name[0]:
            case "m":
                heavy = 4 if name == "m1" and chain.gap else 1
                return heavy * 1e-3 * np.exp(source.normal(0, 0.7))
            case "k":
                hertz = np.exp(source.uniform(np.log(15), np.log(220)))
                return (1 + (name == "k01")) * 1e-3 * (2 * np.pi * hertz) ** 2
            case "d":
                ratio = np.exp(source.uniform(np.log(0.004), np.log(0.06)))
                return 2 * ratio * np.sqrt(values["k" + name[1:]] * 1e-3)
        return source.uniform(1e-4, 8e-4)

    values: dict[str, float] = {}
    for name in chain.parameters:
        values[name] = float(value(name))
    G = Plant(chain.structure, 2 * np.pi * f).response(np.array(list(values.values())))
    scatter = source.normal(size=len(f)) + 1j * source.normal(size=len(f))
    return values, from_arrays(f, G * (1 + noise * scatter / np.sqrt(2)), quantity="acceleration")


def is_missed(chain: Chain, seed: int) -> bool:
    values, data = drawn(chain, seed)
    task = Task(Cost(data))
    local = refine(chain, task, {chain: Estimate(chain, values, inf)})
    return estimates([chain], task)[chain].j > 1.001 * local.j


@pytest.mark.full
@pytest.mark.parametrize("chain", KINDS, ids=str)
def test_a_candidate_alone_finds_the_optimum_of_the_truth(chain):
    """No relative leads to it: neither an undamped resonance nor a base stops the search."""
    assert not is_missed(chain, seed=1)


@pytest.mark.slow
@pytest.mark.parametrize("chain", KINDS, ids=str)
def test_few_drives_are_missed(chain):
    assert sum(is_missed(chain, seed) for seed in range(3, 13)) <= 1


@pytest.mark.parametrize("chain", [Chain(4), Chain(3, act_plus=3, meas_plus=3), Chain(3, *BASE)])
def test_modes_of_exact_data_are_the_masses_and_springs(chain):
    """Also seen from the other end; one of the choices for the modes of a base is the true one."""
    chain = Chain(*chain.indices, damped=False)
    values, data = drawn(chain, seed=0, noise=0.0)
    true = [x for name, x in values.items() if name[0] in "mk"]
    found = [[*masses, *springs] for masses, springs, _ in from_modes(chain, data, 1)]
    assert any(np.allclose(x, true, rtol=0.02) for x in found)


def test_a_reversed_sensor_and_a_dead_time_are_seen():
    chain = Chain(2, damped=False, dead_time=True)
    _, data = drawn(chain, seed=3)
    late = drawn(chain, seed=3)[0]["Td"]
    turned = from_arrays(data.frequency, -data.G, quantity="acceleration")
    assert all(d == pytest.approx(late, rel=0.3) for *_, d in from_modes(chain, turned, -1))


def test_the_last_spring_of_a_row_holds_it_to_the_ground():
    """One mass: m = 1/share, k = square/share; of two the squares are those of the row; a free
    row has no such spring.
    """
    assert row(np.array([9.0]), np.array([0.5])) == ([2.0], [18.0])
    free = row(np.array([0.0, 2.0]), np.array([0.5, 0.5]))
    assert free[0] == pytest.approx([1.0, 1.0]) and free[1] == pytest.approx([1.0, 0.0])
    masses, (k1, k2) = row(np.array([1.0, 5.0]), np.array([0.3, 0.7]))
    m1, m2 = masses
    stiffness = np.array([[k1 / m1, -k1 / np.sqrt(m1 * m2)], [0, (k1 + k2) / m2]])
    stiffness[1, 0] = stiffness[0, 1]
    assert np.linalg.eigvalsh(stiffness) == pytest.approx([1.0, 5.0])


def test_few_modes_and_other_places_give_no_starts():
    _, data = drawn(Chain(2, damped=False), seed=4)
    assert list(from_modes(Chain(1), data, 1)) == []
    assert list(from_modes(Chain(3, meas_plus=3), data, 1)) == []
