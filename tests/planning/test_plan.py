"""How much measuring excludes a rival: the power that is planned is the power that is had."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import chi2, ncx2, norm

from disting.errors import InputError
from disting.export import predict
from disting.fit import select
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.model.family import Family
from disting.network import network_of
from disting.planning.fit_file import NamedNetworks
from disting.planning.power import (
    LEVEL,
    POWER,
    Answer,
    Sample,
    ideal,
    plan,
    power,
    simulate,
    surplus,
    typical,
    union,
)
from disting.planning.rival import Trust, fitted_rival, gain
from disting.report.fit.plan_page import title_of
from disting.report.fit.plan_words import plan_in_words
from disting.report.fit.words import percent
from disting.verdict.result import Relation
from tests.fit.monte_carlo import Drive, measured, true_scatter

MODEL = Chain(2, damped=True, ground_dampers=(1,))
RIVAL = Chain(2, damped=True, ground_dampers=(2,))
BOTH = Chain(2, damped=True, ground_dampers=(1, 2))
VALUES = {"m1": 0.0045, "m2": 0.005, "k12": 550.0, "d12": 0.08, "b1": 0.1}
OMEGA = 2 * np.pi * np.geomspace(5.0, 300.0, 120)


def alike(noise, omega=OMEGA):
    return np.full(len(omega), noise)


@pytest.fixture(scope="module")
def planned():
    """At the noise that is just enough."""
    found = plan(MODEL, VALUES, RIVAL, OMEGA, alike(0.05))
    return plan(MODEL, VALUES, RIVAL, OMEGA, alike(0.05 / np.sqrt(found.factor)))


def test_power_of_one_parameter_is_that_of_a_two_sided_normal_test():
    limit = norm.isf(LEVEL / 2)
    for size in (0.3, 5.0, 17.8, 40.0):
        shift = np.sqrt(size)
        assert power(size) == pytest.approx(norm.sf(limit - shift) + norm.cdf(-limit - shift))
    assert power(0.0, 3) == LEVEL and ideal().needed() == pytest.approx(17.814, abs=1e-3)
    assert power(ideal(4).needed(), 4) == pytest.approx(POWER, abs=1e-9)


@pytest.mark.parametrize("size", [1e12, 1e20, 1e300, float("inf")])
def test_power_against_a_rival_that_is_far_away_is_one(size):
    """SciPy's noncentral chi2 is not a number there."""
    assert power(size) == power(size, 9, 1e-6) == 1.0


@pytest.mark.parametrize("surplus", [1, 2, 12])
def test_power_is_the_same_on_both_sides_of_the_bound_of_the_series(surplus):
    limit = chi2.isf(1e-4, surplus)
    for size in np.square(np.sqrt(limit) + np.array([37.0, 39.9, 40.1, 50.0])):
        assert power(size, surplus, 1e-4) == ncx2.sf(limit, surplus, size)


def test_an_effort_that_is_never_enough_is_infinite():
    ones = np.ones(1)
    assert Sample(1e9 * ones, ones, ones, 1).needed() == np.inf


def test_power_of_several_parameters_is_what_sampling_shows():
    source = np.random.default_rng(5)
    drawn = source.normal(size=(200_000, 3)) + np.array([3.0, 0.0, 2.0])
    seen = np.mean((drawn**2).sum(axis=1) > chi2.isf(LEVEL, 3))
    assert power(13.0, 3) == pytest.approx(seen, abs=0.004)


@pytest.mark.full
def test_published_example_allows_a_noise_of_24_percent():
    found = plan(MODEL, VALUES, RIVAL, OMEGA, alike(0.2))
    assert np.sum(found.rival.apart**2) == pytest.approx(1.049, abs=0.001)
    assert typical(found.rival.rho) / np.sqrt(found.factor) == pytest.approx(0.243, abs=0.001)
    assert found.answer is Answer.ENOUGH and found.rival.trust is Trust.AGREED
    assert found.noncentrality == pytest.approx(1.0493 / 0.04, rel=1e-3)


@pytest.mark.full
def test_best_fit_of_the_rival_is_no_worse_than_that_of_another_optimiser(planned):
    rival = planned.rival
    exact = predict(MODEL, VALUES, OMEGA)

    def cost(logarithms):
        values = dict(zip(RIVAL.parameters, np.exp(logarithms), strict=True))
        ratio = predict(RIVAL, values, OMEGA) / exact
        return np.sum(np.abs(ratio - 1) ** 2 / rival.rho**2)

    start = np.log([VALUES.get(n, VALUES["b1"]) for n in RIVAL.parameters])
    ends = [
        minimize(cost, start + shift, method="Nelder-Mead", options={"maxfev": 4000}).fun
        for shift in (0.0, 0.3, -0.3)
    ]
    assert rival.noncentrality <= min(ends) * (1 + 1e-6)
    assert rival.noncentrality == pytest.approx(min(ends), rel=1e-3)


@pytest.mark.full
def test_effort_counts_as_its_square_in_amplitude_and_lines_by_their_number(planned):
    half = plan(MODEL, VALUES, RIVAL, OMEGA, planned.rival.rho * np.sqrt(2))
    assert half.noncentrality == pytest.approx(planned.noncentrality / 2, rel=1e-6)
    assert half.factor == pytest.approx(2.0, rel=1e-6) and half.answer is Answer.MORE
    omega = 2 * np.pi * np.geomspace(5.0, 300.0, 480)
    more = plan(MODEL, VALUES, RIVAL, omega, alike(planned.rival.rho[0], omega))
    assert more.noncentrality == pytest.approx(4 * planned.noncentrality, rel=0.03)


def experiments(rival, chain, values, count, seed, effort=1.0):
    """T of simulated experiments with complex noise of the planned size."""
    source = np.random.default_rng(seed)
    exact, rho = predict(chain, values, OMEGA), rival.rho / np.sqrt(effort)
    for _ in range(count):
        error = source.normal(size=len(rho)) + 1j * source.normal(size=len(rho))
        yield gain(rival, FrequencyResponse(OMEGA, exact * (1 + rho * error)))


def share(rival, chain, values, count, seed, effort=1.0):
    """How often the rival is excluded; T is in units of the planned noise."""
    limit = chi2.isf(LEVEL, 1)
    found = [effort * t for t in experiments(rival, chain, values, count, seed, effort)]
    return np.mean(np.array(found) > limit)


def quiet(weaker):
    """A drive with less friction: less noise is allowed for, as on a bench."""
    values = VALUES | {"b1": weaker}
    found = plan(MODEL, values, RIVAL, OMEGA, alike(0.05))
    return plan(MODEL, values, RIVAL, OMEGA, alike(0.05 / np.sqrt(found.factor)))


@pytest.mark.full
def test_planned_power_is_had(planned):
    assert planned.power == pytest.approx(POWER, abs=1e-6)
    found = share(planned.rival, MODEL, VALUES, 150, 1)
    assert found == pytest.approx(POWER, abs=3.5 * np.sqrt(POWER * (1 - POWER) / 150))


@pytest.mark.slow
@pytest.mark.parametrize("friction", [0.1, 0.02])
def test_planned_power_is_had_within_three_points_in_a_thousand_experiments(friction):
    found = quiet(friction)
    values = dict(found.values)
    assert share(found.rival, MODEL, values, 1000, 1) == pytest.approx(POWER, abs=0.03)
    half = power(found.noncentrality / 2)
    assert share(found.rival, MODEL, values, 1000, 2, effort=0.5) == pytest.approx(half, abs=0.03)
    true = found.rival.parameters
    assert share(found.rival, RIVAL, true, 1000, 3) <= LEVEL + 0.01


@pytest.mark.slow
def test_planned_power_of_two_surplus_parameters():
    plain = Chain(2, damped=True)
    values = VALUES | {"b2": 0.05}
    first = plan(BOTH, values, plain, OMEGA, alike(0.05))
    assert first.surplus == 2
    found = plan(BOTH, values, plain, OMEGA, alike(0.05 / np.sqrt(first.factor)))
    limit = chi2.isf(LEVEL, 2)
    seen = np.mean([t > limit for t in experiments(found.rival, BOTH, values, 1000, 4)])
    assert seen == pytest.approx(POWER, abs=0.03)


@pytest.mark.full
def test_where_the_model_contains_the_rival_the_test_is_the_difference_of_the_costs():
    plain = Chain(2, damped=True)
    rival = fitted_rival(MODEL, VALUES, plain, OMEGA, alike(0.05))
    source = np.random.default_rng(8)
    noise = 0.05 * (source.normal(size=120) + 1j * source.normal(size=120))
    exact = predict(MODEL, VALUES, OMEGA)
    data = FrequencyResponse(OMEGA, exact * (1 + noise))

    def lowest(chain, start):
        def cost(logarithms):
            values = dict(zip(chain.parameters, np.exp(logarithms), strict=True))
            missed = predict(chain, values, OMEGA) - data.G
            return np.sum(np.abs(missed / exact) ** 2) / 0.05**2

        begin = np.log([start[n] for n in chain.parameters])
        found = minimize(cost, begin, method="Nelder-Mead", options={"maxfev": 6000, "fatol": 1e-8})
        return found.fun

    difference = lowest(plain, rival.parameters) - lowest(MODEL, VALUES)
    assert gain(rival, data) == pytest.approx(difference, rel=0.02)


def test_surplus_is_what_the_joint_structure_has_more():
    assert union(MODEL, RIVAL) == BOTH and surplus(MODEL, RIVAL) == 1
    assert surplus(BOTH, Chain(2, damped=True)) == 2
    lag, delay = Chain(2, damped=True, lag=True), Chain(2, damped=True, dead_time=True)
    assert surplus(lag, delay) == 1 and union(MODEL, Chain(3, damped=True)) is None
    assert surplus(Chain(3, damped=True), MODEL) == 2  # ranks 7 and 5
    assert surplus(MODEL, Chain(3, damped=True)) == 1


def test_indistinguishable_structures_are_not_even_fitted():
    one, other = (Family(3, damped=True)[i] for i in (1, 11))
    values = {"m1": 1.0, "m2": 2.0, "m3": 3.0, "k12": 100.0, "k23": 50.0, "d12": 0.1, "d23": 0.3}
    found = plan(one, values, other, OMEGA, alike(0.02))
    assert found.answer is Answer.IMPOSSIBLE and found.rival is None
    assert found.verdict.relation is Relation.INDISTINGUISHABLE
    assert found.power == LEVEL and found.factor == np.inf


@pytest.mark.full
def test_rival_that_contains_the_model_is_never_excluded_and_the_limit_is_named():
    found = plan(MODEL, VALUES, BOTH, OMEGA, alike(0.001))
    assert found.verdict.relation is Relation.DISTINGUISHABLE
    assert found.answer is Answer.SAME and found.rival.limits == {"b2": "zero"}
    assert found.is_contained
    assert found.noncentrality == 0.0 and found.factor == np.inf
    reverse = plan(BOTH, VALUES | {"b2": 0.05}, MODEL, OMEGA, alike(0.01))
    assert reverse.noncentrality > 0


@pytest.mark.full
def test_a_limit_on_narrow_lines_is_not_taken_for_a_rival_that_contains_the_model(planned):
    """At 10^-30 Hz a mass does nothing, which is no statement on structures."""
    slow = OMEGA * 1e-30
    found = plan(MODEL, VALUES, RIVAL, slow, alike(0.1))
    assert found.answer is Answer.SAME and found.rival.limits and not found.is_contained
    said = next(plan_in_words(found, None, "given"))
    assert said.startswith("impossible on these lines") and "wider range" in said


@pytest.mark.full
def test_a_larger_structure_contains_the_smaller_one_as_the_verdict_tells():
    small = Chain(2, damped=True)
    values = {n: v for n, v in VALUES.items() if n != "b1"}
    found = plan(small, values, Chain(3, damped=True), OMEGA, alike(0.1))
    assert found.answer is Answer.SAME and found.is_contained
    assert next(plan_in_words(found, None, "given")).startswith("impossible: 3:1 contains 2:1")


@pytest.mark.full
def test_how_many_rivals_the_same_effort_excludes_is_the_title(planned):
    rival = planned.rival
    quiet, loud = (
        replace(planned, rival=replace(rival, best=replace(rival.best, j=x * rival.best.j)))
        for x in (4.0, 0.25)
    )
    same = replace(planned, rival=None)  # which no measuring excludes
    assert [p.answer for p in (quiet, loud)] == [Answer.ENOUGH, Answer.MORE]
    named = NamedNetworks(network_of("1=2; F1; S1"), VALUES, {}, {}, 0.05, 5.0, 300.0, 120)
    assert title_of([quiet, quiet], named) == "The same effort excludes every rival"
    assert title_of([quiet, same], named) == "More of the same excludes 1 of 2 rivals"
    assert title_of([quiet, loud], named) == "Measure more to exclude 2:1+b2"
    assert title_of([loud, loud, quiet], named) == "Measure more to exclude 2 rivals"


@pytest.mark.full
def test_a_scatter_that_is_known_is_no_estimate(planned):
    lines = list(plan_in_words(planned, None, "given"))
    (tested,) = [line for line in lines if line.startswith("test ")]
    assert tested.endswith(f"level {percent(LEVEL)}")


@pytest.mark.full
def test_few_starts_that_agree_make_the_answer_doubtful(planned):
    rival = planned.rival
    j = rival.noncentrality
    for costs, recovered, trust in (
        ((j, j, j, 9 * j), True, Trust.AGREED),
        ((j, j, 2 * j, 9 * j), True, Trust.DOUBTFUL),
        ((j, j, j, 9 * j), False, Trust.DOUBTFUL),
    ):
        other = replace(rival, best=replace(rival.best, costs=costs), recovered=recovered)
        found = replace(planned, rival=other)
        said = next(plan_in_words(found, None, "given"))
        assert other.trust is trust and ("Doubtful" in said) == (trust is Trust.DOUBTFUL)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda: fitted_rival(MODEL, VALUES, MODEL, OMEGA, alike(0.1)), "not a rival of itself"),
        (lambda: fitted_rival(MODEL, VALUES, RIVAL, OMEGA, alike(0.0)), "noise of a line lies"),
    ],
)
def test_bad_input_is_named(change, words):
    with pytest.raises(InputError, match=words):
        change()


@pytest.mark.full
def test_data_at_other_lines_are_refused(planned):
    with pytest.raises(InputError, match="planned lines"):
        gain(planned.rival, FrequencyResponse(OMEGA * 1.1, predict(MODEL, VALUES, OMEGA)))


@pytest.mark.full
def test_a_scatter_that_has_to_be_found_excludes_less(planned):
    """From one measurement the least, from fifty repeats what a known one does."""
    plain = planned.rival, planned.surplus, planned.level
    found = [simulate(*plain, repeats) for repeats in (1, 2, 50)]
    reached = [one.power(planned.noncentrality) for one in found]
    assert reached[0] < reached[1] < reached[2] == pytest.approx(planned.power, abs=0.01)
    assert found[0].needed() > found[1].needed() > planned.needed
    assert found[0].power(found[0].needed()) == pytest.approx(POWER)
    alone = replace(planned, repeats=1)
    assert alone.power == reached[0] and alone.factor > planned.factor
    assert replace(planned, rival=None, repeats=1).power == planned.level


@pytest.mark.slow
@pytest.mark.parametrize(("pair", "repeats"), [("damper", 1), ("damper", 2), ("lag", 1)])
def test_a_fit_does_what_is_promised(pair, repeats):
    """White noise on current and speed: full fits of 100 simulated measurements."""
    values = {"m1": 5e-3, "m2": 4e-3, "k12": 500.0, "d12": 0.02}
    one, other = (
        (replace(MODEL, dead_time=True), replace(MODEL, lag=True))
        if pair == "lag"
        else (MODEL, RIVAL)
    )
    values |= {"b1": 0.1, "Td": 2e-4} if pair == "lag" else {"b1": 0.01}
    level = (0.058 if pair == "lag" else 0.051) * float(np.sqrt(repeats))
    machine = Drive(replace(one, quantity="velocity"), values, level, 0)
    omega = measured(machine, 1).omega
    rho = true_scatter(machine, omega, repeats)
    promised = plan(one, values, other, omega, rho, repeats=repeats).power
    found = [
        select(measured(replace(machine, seed=seed), repeats), [one, other]) for seed in range(100)
    ]
    done = np.mean(
        [any(c.chain == other and c.excluded is not None for c in s.candidates) for s in found]
    )
    print(pair, repeats, promised, done)
    assert 0.3 < promised < 0.6 and done == pytest.approx(promised, abs=0.12)
