"""Several responses with one parameter vector: the stacked response against a dense solve, the
truth found, intervals that cover it.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from disting.errors import InputError
from disting.experiments.machine_model import rank_by
from disting.fit.judge.alternatives import representatives
from disting.fit.judge.explanation import JointNoise, merge, noises, scatters
from disting.fit.judge.joint_verdicts import (
    behaves_alike,
    is_same_under_all,
    representatives_under_all,
    under_all,
)
from disting.fit.judge.members import QUANTILE
from disting.fit.search.cost import Case, Cost, lines_by_deviation
from disting.fit.search.data import Weights
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Task
from disting.fit.search.joint import FurtherResponse, JointCost
from disting.fit.search.setup import Setup, measured_chain
from disting.fit.select import select
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain, Quantity
from disting.statistics.covariance import expected_deviation
from disting.statistics.practical import covariance
from disting.store import Store
from disting.verdict.engine import Engine
from disting.verdict.result import Relation
from tests.fit.drives import OMEGA, bench, response, truth

TWO = Chain(2, damped=True, ground_dampers=(2,), dead_time=True)
THREE = Chain(3, damped=True, ground_dampers=(1, 3), lag=True, dead_time=True)
RELATIVE = Chain(4, gap=2, act_minus=1, act_plus=3, meas_minus=2, meas_plus=4, damped=True)
SETUPS = [
    Setup(),
    Setup(sensor="2"),
    Setup(sensor="last", inertias=(("1", 0.5),)),
    Setup(sensor="1:2", delay="Td2"),
    Setup(locked=("last",), inertias=(("1", 0.25), ("2", 0.7))),
    Setup(sensor="1", locked=("2",), sign=-1),
    Setup(sensor="2", inertias=(("2", 0.5),), springs=(("1", 30.0),), brakes=(("2", 0.4),)),
    Setup(brakes=(("last", 1.5), ("1", 0.25))),
    Setup(force="2"),
    Setup(sensor="2", force="1:last", inertias=(("1", 0.5),)),
]


def dense(chain, values, setup, quantity, s):
    """A slow twin: the matrix equation of the masses that move."""
    n = chain.n_masses
    whole = np.zeros((n + 1, n + 1), dtype=complex)
    for element in chain.structure.elements:
        v = np.zeros(n + 1)
        v[element.at + (element.kind in "kd")] = 1.0
        v[element.at if element.kind in "kd" else 0] -= 1.0
        power = {"m": 2, "k": 0, "d": 1, "b": 1}[element.kind]
        whole += values[element.parameter] * s**power * np.outer(v, v)
    number = {"last": n} | {str(i): i for i in range(n + 1)}
    for change in setup.changes:
        power = {"inertia": 2, "brake": 1, "spring": 0, "lock": None}[change.kind.name]
        if power is not None:
            whole[(number[change.place],) * 2] += float(change.size) * s**power
    held = [number[change.place] for change in setup.changes if change.size is None]
    moving = [i for i in range(1, n + 1) if i not in held]
    force, x = np.zeros(n + 1), np.zeros(n + 1, dtype=complex)
    driven = [number[e] for e in setup.force.split(":")] if setup.force else []
    force[driven[-1] if driven else chain.act_plus] += 1.0
    force[(driven[0] if len(driven) > 1 else 0) if driven else chain.act_minus] -= 1.0
    x[moving] = np.linalg.solve(whole[np.ix_(moving, moving)], force[moving])
    ends = [number[e] for e in setup.sensor.split(":")] if setup.sensor else []
    plus, minus = (
        (ends[-1], ends[0] if len(ends) > 1 else 0) if ends else (chain.meas_plus, chain.meas_minus)
    )
    lag = 1 + s * values["T1"] if chain.lag else 1.0
    late = values.get(setup.delay or "Td", 0.0)
    return setup.sign * s**quantity.order * (x[plus] - x[minus]) / lag * np.exp(-s * late)


def stack(chain, setups, omega=OMEGA[::13]):
    """A cost with some response of each setup, of different quantities and lines."""
    quantities = [Quantity.ACCELERATION, Quantity.VELOCITY, Quantity.POSITION]
    parts = [
        Cost(
            FrequencyResponse(
                omega[k % 2 :] * 1.0, np.ones(len(omega) - k % 2), quantity=quantities[k % 3]
            )
        )
        for k in range(len(setups))
    ]
    delays = tuple(s.delay for s in setups if s.delay)
    return JointCost(tuple(parts), tuple(setups), delays)


def vector(chain, delays, seed):
    values = truth(chain, seed) | dict.fromkeys(delays if chain.dead_time else (), 2e-4)
    return values, np.array(list(values.values()))


@pytest.mark.full
@pytest.mark.parametrize("chain", [TWO, THREE, RELATIVE], ids=str)
@settings(max_examples=15)
@given(seed=st.integers(0, 10**6))
def test_the_stacked_response_is_that_of_the_matrix_equations(chain, seed):
    setups = SETUPS[:4] if chain is RELATIVE else SETUPS
    setups = [s for s in setups if not s.is_silent(chain.structure)]
    cost = stack(chain, setups)
    values, p = vector(chain, cost.delays, seed)
    found = cost.by_line(cost.plant(chain.structure, 1).response(p))
    for part, setup, own in zip(cost.parts, setups, found, strict=True):
        measured = part.measured
        exact = [dense(chain, values, setup, measured.quantity, 1j * w) for w in measured.omega]
        np.testing.assert_allclose(own, exact, rtol=1e-9)


@pytest.mark.full
@pytest.mark.parametrize("chain", [TWO, THREE], ids=str)
@settings(max_examples=15)
@given(seed=st.integers(0, 10**6))
def test_its_derivatives_are_those_of_central_differences(chain, seed):
    cost, h = stack(chain, SETUPS), 1e-6
    _, p = vector(chain, cost.delays, seed)
    plant = cost.plant(chain.structure, 1)
    assert len(plant.parameters) == len(p)
    response, gradient = plant.logarithmic_gradient(p)
    np.testing.assert_array_equal(response, plant.response(p))
    for i in range(len(p)):
        step = h * p[i] * (np.arange(len(p)) == i)
        moved = np.log(plant.response(p + step) / plant.response(p - step)) / (2 * h)
        np.testing.assert_allclose(gradient[i] * p[i], moved, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("case", list(Case))
def test_the_cost_is_the_sum_of_the_costs(case):
    cost = stack(TWO, SETUPS[:4])
    cost = replace(cost, parts=tuple(replace(part, case=case) for part in cost.parts))
    plant, p = (
        cost.plant(TWO.structure, 1),
        np.array([vector(TWO, cost.delays, k)[1] for k in (1, 2)]),
    )
    each = [
        part.total(own)
        for part, own in zip(cost.parts, cost.by_line(plant.response(p)), strict=True)
    ]
    np.testing.assert_allclose(cost.total(plant.response(p)), np.sum(each, axis=0), rtol=1e-12)
    residual, columns = cost.of(plant, p[0])
    assert residual.shape == (cost.n_residuals,) and columns.shape == (cost.n_residuals, p.shape[1])
    h = 1e-6
    for i in range(p.shape[1]):
        step = np.where(np.arange(p.shape[1]) == i, np.exp(h), 1.0)
        ends = [cost.residual(plant.response(p[0] * step**k)) for k in (1, -1)]
        np.testing.assert_allclose(
            columns[:, i], (ends[0] - ends[1]) / (2 * h), rtol=1e-4, atol=1e-6
        )


def test_a_stack_of_one_response_is_that_response():
    data = response(TWO, truth(TWO, 3), noise=0.01)
    one = Task(Cost(data))
    stacked = Task(JointCost((Cost(data),), (Setup(),)))
    p = np.array(list(truth(TWO, 4).values()))
    for a, b in zip(
        one.cost.of(one.plant(TWO), p), stacked.cost.of(stacked.plant(TWO), p), strict=True
    ):
        np.testing.assert_array_equal(a, b)
    sigma = one.cost.scatter(merge(scatters(one.cost, [])))
    residual = one.cost.residual(data.G * 1.01)
    alone, both = noises(one.cost, residual, sigma), noises(stacked.cost, residual, sigma)
    np.testing.assert_array_equal(alone.sigma, both.sigma)


def test_noise_is_not_carried_from_one_response_to_the_next():
    """Correlated residuals in the second response leave the errors of the first alone."""
    cost = stack(TWO, SETUPS[:2], OMEGA)
    source = np.random.default_rng(1)
    residual = source.normal(size=cost.n_residuals)
    at = cost.parts[0].n_residuals
    for k in range(at + 1, cost.n_residuals):
        residual[k] += 0.8 * residual[k - 1]
    found = noises(cost, residual, np.ones(cost.n_residuals))
    assert isinstance(found, JointNoise)
    assert found.parts[0].correlation == 0.0 and found.parts[1].correlation > 0.5
    columns = np.zeros((cost.n_residuals, 1))
    columns[at:] = 1.0
    assert not found.seen(columns)[:at].any()


SILENT = [
    (Setup(sensor="2", locked=("2",)), True),
    (Setup(locked=("1",)), True),
    (Setup(sensor="3", locked=("2",)), True),
    (Setup(sensor="3", locked=("1",)), True),
    (Setup(sensor="1", locked=("2",)), False),
    (Setup(sensor="1:3", locked=("3",)), False),
    (Setup(sensor="3"), False),
]


@pytest.mark.parametrize(("setup", "silent"), SILENT)
def test_a_locked_mass_silences_what_it_carries_and_what_lies_behind_it(setup, silent):
    chain = Chain(3, damped=True)
    assert setup.is_silent(chain.structure) is silent
    values = truth(chain, 1)
    size = abs(dense(chain, values, setup, Quantity.POSITION, 30j))
    assert bool(size < 1e-12) is silent


RANKS = [
    (Chain(3, damped=False), (Setup(),), 5),
    (Chain(2, meas_plus=2, damped=False), (Setup(),), 2),
    (Chain(2, meas_plus=2, damped=False), (Setup(), Setup(sensor="1")), 3),
    (Chain(3, damped=True, lag=True), (Setup(), Setup(sensor="2")), 8),
    (Chain(2, meas_plus=2, damped=False), (Setup(), Setup(inertias=(("1", 0.5),))), 3),
    (Chain(2, meas_plus=2, damped=False), (Setup(), Setup(sensor="1", locked=("2",))), 3),
    (Chain(3, damped=False), (Setup(), Setup(sensor="1", locked=("2",))), 5),
]


@pytest.mark.parametrize(("chain", "setups", "rank"), RANKS)
def test_the_rank_of_a_stack_is_that_of_differences(chain, setups, rank):
    free = tuple(name for name in chain.parameters if name != "Td")
    assert rank_by(measured_chain(chain, setups), free, "test") == rank
    cost = stack(chain, list(setups), OMEGA[::8])
    values = {n: v for n, v in truth(chain, 2).items() if n in free}
    columns = cost.of(cost.plant(chain.structure, 1), np.array(list(values.values())))[1]
    values = np.linalg.svd(columns / np.linalg.norm(columns, axis=0), compute_uv=False)
    assert int(np.sum(values > 1e-9 * values[0])) == rank


def white(chain, values, setup, level, seed, omega=OMEGA):
    """White noise on the position of one setup."""
    cost = JointCost((Cost(FrequencyResponse(omega, np.ones(len(omega)))),), (setup,))
    p = np.array([values[n] for n in chain.parameters])
    exact = cost.plant(chain.structure, 1).response(p)
    source = np.random.default_rng([seed, 11])
    error = (source.normal(size=omega.size) + 1j * source.normal(size=omega.size)) / np.sqrt(2)
    size = level * np.median(np.abs(exact) / omega**2) * omega**2
    return FrequencyResponse(omega, exact + size * error, size)


def drive(chain, seed):
    """A random drive whose dampers matter."""
    source = np.random.default_rng(seed)
    sizes = {"m": 1.0, "k": 5e4, "d": 20.0, "b": 20.0, "T": 2e-4}
    return {
        name: float(sizes[name[0]] * np.exp(0.3 * source.normal())) for name in chain.parameters
    }


def errors(chain, values, data, further):
    """How many standard errors each estimate is from the truth, and the cost less that of the
    truth.
    """
    start = np.array([values[n] for n in chain.parameters])
    task = Task(Weights(Cost(data), further=further).training())
    exact = task.plant(chain).response(start)
    task = Task(Weights(Cost(data), further=further).training([exact]))
    plant = task.plant(chain)
    p, j = fine(plant, task.cost, task.box(chain.parameters), start)
    residual, columns = task.cost.of(plant, p)
    sigma = task.cost.scatter(merge(scatters(task.cost, [plant.response(p)])))
    there = noises(task.cost, residual, sigma, expected_deviation(columns, sigma))
    return (p - start) / (p * np.sqrt(np.diag(covariance(columns, there)))), j


def coverage(chain, count):
    """Share of drives whose true value lies in the interval of 95 %: a loud and a quiet response of
    different lines, and one with a locked mass.
    """
    found = []
    for seed in range(count):
        values = drive(chain, seed)
        further = [
            FurtherResponse(white(chain, values, setup, level, 1000 * k + seed, OMEGA[k::2]), setup)
            for k, (setup, level) in enumerate(
                [(Setup(sensor="2"), 0.01), (Setup(locked=("last",)), 0.001)], 1
            )
        ]
        found.append(errors(chain, values, white(chain, values, Setup(), 0.003, seed), further)[0])
    return dict(zip(chain.parameters, np.mean(np.abs(found) < QUANTILE, axis=0), strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("chain", [TWO, Chain(3, damped=True, ground_dampers=(1,))], ids=str)
def test_intervals_of_95_percent_cover_92_to_98(chain):
    found = coverage(chain, 400)  # a share of 400 varies by one per cent by chance
    assert all(0.92 <= share <= 0.98 + 0.01 for share in found.values()), found


@pytest.mark.full
def test_intervals_cover_in_a_small_sample():
    found = coverage(TWO, 40)
    assert all(share >= 0.85 for share in found.values()), found


def test_two_equal_responses_are_one_of_half_the_variance():
    """As many lines again, of equal noise: errors shrink by the root of two."""
    values = drive(TWO, 5)
    data = [white(TWO, values, Setup(), 0.003, seed) for seed in (1, 2)]
    p = np.array([values[n] for n in TWO.parameters])
    sizes = []
    for further in ([], [FurtherResponse(data[1], Setup(sensor="1"))]):
        task = Task(Weights(Cost(data[0]), further=further, alike=True).training())
        residual, columns = task.cost.of(task.plant(TWO), p)
        sigma = task.cost.scatter(merge(scatters(task.cost, [task.plant(TWO).response(p)])))
        there = noises(task.cost, residual, sigma, expected_deviation(columns, sigma))
        sizes.append(np.sqrt(np.diag(covariance(columns, there))))
    np.testing.assert_allclose(sizes[0] / sizes[1], np.sqrt(2), rtol=0.1)


@pytest.mark.full
def test_a_search_reaches_the_cost_of_the_truth_and_finds_it():
    values = drive(TWO, 2)
    data = white(TWO, values, Setup(), 0.003, 2)
    further = [
        FurtherResponse(
            white(TWO, values, Setup(sensor="2"), 0.003, 3, OMEGA[::2]), Setup(sensor="2")
        )
    ]
    found = select(
        data, [Chain(1, damped=True), TWO, replace(TWO, ground_dampers=(1,))], further=further
    )
    assert [c.chain.n_masses for c in found.candidates] == [2, 2]  # one mass has no sensor 2
    assert found.selected.chain == TWO and found.explanation.explains
    task = found.task
    p = np.array([values[n] for n in TWO.parameters])
    assert found.selected.j_train <= task.cost.total(task.plant(TWO).response(p))
    ends = found.members[0].intervals
    inside = [low <= values[name] <= high for name, (low, high) in ends.items()]
    assert sum(inside) >= len(inside) - 1
    for name, value in found.selected.estimate.parameters.items():
        assert value == pytest.approx(values[name], rel=0.1)


@pytest.mark.full
def test_a_second_sensor_identifies_what_the_first_leaves_open():
    """Force at 1, sensor at 2 without a damper to the ground: only m1 m2 and m1 + m2 are seen, over
    k12; a sensor at 1 tells which mass is which.
    """
    chain = Chain(2, meas_plus=2, damped=True)
    values = drive(chain, 3)
    data = [white(chain, values, Setup(sensor=s), 0.002, k) for k, s in enumerate("21")]
    alone = select(data[0], [chain]).candidates[0]
    assert not alone.admissible and alone.practical.unidentifiable
    both = select(data[0], [chain], further=[FurtherResponse(data[1], Setup(sensor="1"))])
    assert both.selected is not None and not both.selected.practical.unidentifiable
    for name, value in both.selected.estimate.parameters.items():
        assert value == pytest.approx(values[name], rel=0.1)


@pytest.mark.full
def test_what_behaves_alike_in_the_first_response_alone_is_not_merged():
    """Force and sensor are both ends: the damper at either end is the same structure mirrored, for
    this sensor; with a sensor at the force it is not.
    """
    one = Chain(2, meas_plus=2, damped=True, ground_dampers=(1,))
    other = replace(one, ground_dampers=(2,))
    values = drive(one, 4)
    data = [white(one, values, Setup(sensor=s), 0.002, k) for k, s in enumerate("21")]
    assert select(data[0], [one, other]).saved == 1
    both = select(data[0], [one, other], further=[FurtherResponse(data[1], Setup(sensor="1"))])
    assert both.saved == 0 and len(both.candidates) == 2
    assert both.selected.chain == one
    assert all(a.relation is not Relation.INDISTINGUISHABLE for a in both.alternatives)
    assert all(t.chain != other for m in both.members for t in m.twins)


MIRRORED = Chain(3, act_plus=2, meas_plus=2, damped=True, ground_dampers=(1,))
MERGED = [
    (Setup(inertias=(("2", 0.5),)), True),
    (Setup(inertias=(("1", 0.5),)), False),
    (Setup(sensor="3"), False),
    (Setup(sensor="2", locked=("1",)), False),
]


@pytest.mark.full
@pytest.mark.parametrize(("setup", "same"), MERGED)
def test_mirrored_candidates_are_merged_where_every_response_is_mirrored(setup, same):
    """Force and sensor in the middle: a damper at either end is the same, until a response tells
    the ends apart.
    """
    other, engine = replace(MIRRORED, ground_dampers=(3,)), Engine(store=Store.none())
    assert representatives([MIRRORED, other], engine, {})[other] == MIRRORED
    cost = stack(MIRRORED, (Setup(), setup))
    found = representatives_under_all({MIRRORED: MIRRORED, other: MIRRORED}, cost, {})
    assert found == {MIRRORED: MIRRORED, other: MIRRORED if same else other}
    said = under_all(MIRRORED, other, cost, engine, {})
    if same:
        assert said.relation is Relation.INDISTINGUISHABLE
    else:
        assert said is None or said.relation is Relation.UNDECIDED
    assert not is_same_under_all(MIRRORED, other, cost, {"b1": (1.0, 2.0)})


def test_what_the_second_response_tells_apart_is_no_alternative():
    """By the conditions on the stacked coefficients."""
    one = Chain(2, meas_plus=2, damped=True, ground_dampers=(1,))
    other, engine = replace(one, ground_dampers=(2,)), Engine(store=Store.none())
    first, both = stack(one, [Setup()]), stack(one, [Setup(), Setup(sensor="1")])
    assert under_all(one, other, first, engine, {}).relation is Relation.INDISTINGUISHABLE
    assert under_all(one, other, both, engine, {}) is None


def test_a_twin_must_have_all_responses():
    one = Chain(2, meas_plus=2, damped=True, ground_dampers=(1,))
    other, values = replace(one, ground_dampers=(2,)), drive(one, 4)
    mirrored = {"m1": "m2", "m2": "m1", "b1": "b2"}
    there = {n: values[{v: k for k, v in mirrored.items()}.get(n, n)] for n in other.parameters}
    # the mass to which the inertia is added is not known of the other structure: mirrored, it fits
    for setup, alike in (
        (Setup(sensor="2"), True),
        (Setup(inertias=(("2", 0.5),)), True),
        (Setup(sensor="1"), False),
        (Setup(sensor="1", locked=("2",)), False),
    ):
        task = Task(stack(one, [Setup(), setup]))
        assert behaves_alike(one, values, other, there, task) is alike


@pytest.mark.full
def test_a_response_that_is_zero_teaches_nothing_and_is_named():
    values = drive(TWO, 6)
    data = white(TWO, values, Setup(), 0.003, 6)
    zero = FurtherResponse(data, Setup(sensor="2", locked=("2",)))
    found = select(data, [TWO], further=[zero])
    assert found.silent == ("sensor 2, mass 2 locked",) and len(found.task.cost.parts) == 1
    assert found.selected.estimate.parameters == select(data, [TWO]).selected.estimate.parameters


WRONG = [
    (lambda: Setup(inertias=(("1", -1.0),)), "a known inertia is positive, not '-1.0'"),
    (lambda: Setup(locked=("0",)), "a mass is a number or the word last, not '0'"),
]


@pytest.mark.parametrize(("make", "said"), WRONG)
def test_a_setup_that_is_none_is_refused(make, said):
    with pytest.raises(InputError, match=said):
        make()


def test_places_that_no_candidate_has_are_refused():
    data = response(TWO, truth(TWO, 1))
    for setup, said in (
        (Setup(sensor="3"), "there is no place 3 in a chain of 2 masses"),
        (Setup(locked=("3",)), "there is no mass 3 in a chain of 2 masses"),
        (Setup(locked=("1", "2")), "all masses of a chain of 2 are locked"),
    ):
        with pytest.raises(InputError, match=said):
            select(data, [TWO], further=[FurtherResponse(data, setup)])


@pytest.mark.full
def test_a_coarse_grid_does_not_pass_for_scatter():
    """Every other line over a sharp resonance: neighbours jump because the response bends. Taken for
    scatter it would leave the response without weight, and its dead time open.
    """
    values, setup = drive(TWO, 2), Setup(sensor="2", delay="Td2")
    further = [
        FurtherResponse(white(TWO, values, Setup(sensor="2"), 0.003, 1, OMEGA[1::2]), setup),
        FurtherResponse(
            white(TWO, values, Setup(locked=("2",)), 0.003, 2, OMEGA[2::2]), Setup(locked=("2",))
        ),
    ]
    found = select(white(TWO, values, Setup(), 0.003, 0), [TWO], further=further)
    fitted = found.selected
    assert fitted is not None and found.explanation.explains
    assert fitted.estimate.parameters["Td2"] == pytest.approx(values["Td"], rel=0.1)
    assert fitted.practical.relative_errors["Td2"] < 0.05


@pytest.mark.slow
def test_the_load_side_of_the_bench_sharpens_the_intervals():
    """Weighted by deviations; without weights the load side, which is noisier, harms k12."""
    motor, load = bench("A"), bench("A", "load")
    sizes = {}
    for name, further in (("motor", []), ("both", [FurtherResponse(load, Setup(sensor="2"))])):
        found = select(motor, [TWO], further=further, weights=lines_by_deviation)
        sizes[name] = found.candidates[0].practical.relative_errors
    ratio = {n: sizes["both"][n] / sizes["motor"][n] for n in sizes["both"]}
    assert ratio["k12"] < 0.8 and ratio["b2"] < 0.95 and ratio["d12"] < 0.95, ratio
