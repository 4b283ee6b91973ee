"""Whether anything explains the data: right models do, what is no such chain is said, never
silently.
"""

from dataclasses import replace

import numpy as np
import pytest
from jsonschema import validate

from disting.cli.fit_text import fit_text
from disting.files import Format, schema
from disting.fit.judge.admissible import Rule
from disting.fit.judge.explanation import (
    LARGEST,
    Explanation,
    Level,
    Miss,
    chi2,
    explanation,
    systematic_share,
    yardsticks,
)
from disting.fit.judge.readings import _misread, _places
from disting.fit.search.candidates import figure_1, reference
from disting.fit.search.cost import Cost
from disting.fit.search.data import WhitenedCost
from disting.fit.select import select
from disting.measurement import FrequencyResponse
from disting.measurement.tabular import ASSUMED_LINEAR
from disting.model.chain import Chain, Quantity
from disting.report.fit.selection_json import selection_to_dict
from disting.report.fit.sentences import first_lines, suspicions
from disting.simulation import Bench, Friction, simulate
from disting.statistics.scatter import change, scatter
from tests.fit.drives import OMEGA, bench, response, truth
from tests.fit.monte_carlo import drive as bench_drive, measured as bench_data, truth as bench_truth

DRIVE = Chain(2, damped=True, ground_dampers=(2,))
VALUES = {"m1": 1.0, "m2": 0.6, "k12": 3e4, "d12": 8.0, "b2": 20.0}


def noisy(exact, sensor=Quantity.ACCELERATION, size=0.01, seed=1):
    """A measured response with 1 % noise."""
    source = np.random.default_rng(seed)
    error = (source.normal(size=OMEGA.size) + 1j * source.normal(size=OMEGA.size)) / np.sqrt(2)
    return FrequencyResponse(OMEGA, exact * (1 + size * error), quantity=sensor)


def beam(gains, ratio=0.01):
    """Acceleration by force of a free body with modes at 20, 55, 108, 178.. Hz."""
    s, whole = 1j * OMEGA, np.ones(OMEGA.size, complex)
    for k, gain in enumerate(gains, 1):
        w = 2 * np.pi * 20 * ((2 * k + 1) / 3) ** 2
        whole += gain * s**2 / (s**2 + 2 * ratio * w * s + w**2)
    return whole


def closed(gain):
    """What a velocity loop of this gain [N s/m] leaves of the velocity by reference: read as
    acceleration by force.
    """
    velocity = response(DRIVE, VALUES).G / (1j * OMEGA)
    return gain * velocity / (1 + gain * velocity)


EXACT = response(DRIVE, VALUES).G
WRONG = {
    "a free beam": (noisy(beam([1.5] * 8)), Quantity.ACCELERATION),
    "modes of mixed sign": (noisy(beam([1.0, -0.7, 0.5])), Quantity.ACCELERATION),
    "noise": (noisy(np.ones(OMEGA.size), size=30.0), Quantity.ACCELERATION),
    "a reversed sensor": (noisy(-EXACT), Quantity.ACCELERATION),
    "acceleration read as position": (noisy(EXACT), Quantity.POSITION),
    "a closed velocity loop": (noisy(closed(60.0)), Quantity.ACCELERATION),
    "a sensor on the load": (
        noisy(response(Chain(2, meas_plus=2, damped=True), VALUES).G),
        Quantity.ACCELERATION,
    ),
    "two machines at one input": (noisy(EXACT - 1.8), Quantity.ACCELERATION),
}
ONE = Chain(1, damped=True, ground_dampers=(1,))
HELD = np.sinc(OMEGA / OMEGA[-1] / 2)
ONE_MASS = response(ONE, {"m1": 0.01, "b1": 0.5}).G


def told(data, found):
    """What every output says where nothing fits."""
    plain = selection_to_dict(found)
    assert plain["explained"] is False and plain["not_excluded"] == []
    assert plain["chi2_per_line"] > 3 or found.explanation.noisy
    told = found.explanation.noisy or not any(c.chi2 <= LARGEST for c in found.candidates)
    which = "" if told else "that may be selected "
    quality, structure, more = first_lines(found)
    assert quality.startswith(f"data: {len(found.task.cost.measured)} lines from ")
    assert len(more) > len("next: ")
    assert structure.startswith(f"structure: none of the candidates {which}explains this data")
    assert any(said in structure for said in suspicions(found))
    best = reference(found.described.chain)
    assert f"the best one is {best}" in structure or f"{best} comes near" in structure


@pytest.mark.slow
@pytest.mark.parametrize("case", WRONG)
def test_what_is_no_such_chain_is_said_first(case):
    data, sensor = WRONG[case]
    told(data, select(replace(data, quantity=sensor), figure_1((1, 2), sensor)))


@pytest.mark.slow
def test_more_candidates_do_not_explain_a_beam_either():
    told(WRONG["a free beam"][0], select(WRONG["a free beam"][0], figure_1()))


@pytest.mark.full
@pytest.mark.parametrize(
    ("data", "chain", "words"),
    [
        (-ONE_MASS, ONE, "with the sign reversed"),
        (ONE_MASS / (1j * OMEGA), ONE, "read as velocity"),
        pytest.param(
            EXACT.conj(),
            DRIVE,
            "with the sign of all phases (of the imaginary parts) turned",
            marks=pytest.mark.slow,
        ),
        pytest.param(
            EXACT * HELD,
            DRIVE,
            "with a zero-order hold at 600 Hz taken out",
            marks=pytest.mark.slow,
        ),
    ],
    ids=["reversed", "velocity", "conjugate", "held"],
)
def test_what_would_fit_is_named_with_its_cost(data, chain, words):
    found = select(noisy(data), [Chain(1, damped=False), chain])
    told(data, found)
    assert (
        found.readings[0].words == words
        and found.readings[0].found.j < 0.05 * found.readings[0].before
    )
    assert f"what would fit better: {words} the cost falls from" in first_lines(found)[2]
    assert "; missed most at " in first_lines(found)[1]


def notch(hertz, narrow, wide):
    s, w = 1j * OMEGA, 2 * np.pi * hertz
    return (s * s + 2 * narrow * w * s + w * w) / (s * s + 2 * wide * w * s + w * w)


def rod(first=30.0, damping=0.02):
    """A free rod driven at one end: its resonances do not end."""
    q = 1j * OMEGA / (2 * first) / np.sqrt(1 + 1j * OMEGA * damping / (2 * first))
    return q / np.tanh(q)


def with_friction():
    """A record of a drive with dry friction at the motor."""
    values = {"m1": 0.0045, "m2": 0.005, "k12": 550.0, "d12": 0.08}
    stuck = Bench(periods=4, friction={1: Friction(0.1, 0.02, 0.05)}, seed=3)
    series = simulate(Chain(2, damped=True, quantity="velocity"), values, bench=stuck)
    return series.response("acceleration", period=2500, transient=1)


@pytest.mark.slow
@pytest.mark.parametrize(
    "data",
    [
        pytest.param(lambda: noisy(EXACT * notch(70, 0.05, 0.5)), marks=pytest.mark.slow),
        pytest.param(lambda: noisy(rod()), marks=pytest.mark.slow),
        pytest.param(
            lambda: noisy(EXACT * (1 + 0.3 * np.exp(-0.03j * OMEGA))), marks=pytest.mark.slow
        ),
        with_friction,
    ],
    ids=["notch", "rod", "ripple", "friction"],
)
def test_a_lead_that_does_not_explain_the_data_is_none(data):
    """A mass more fits each of them better, at most by a factor of four in J."""
    measured = data()
    found = select(measured, [Chain(1, damped=False), DRIVE])
    told(measured, found)
    said = " ".join(suspicions(found))
    assert found.readings == () and "closed loop" not in said
    assert "no further mass explains it: is the machine a chain" in said


def test_other_places_of_a_chain_with_a_damper_across_its_gap_are_on_chains_without_one():
    """Data that such a chain does not explain are judged, not refused."""
    across = Chain(2, 1, 1, 2, 1, 2, damped=True, gap_damper=True)
    others = dict(_places(across))
    assert [*others] == [
        f"with the force at mass 1 and the sensor at mass {place} of 2" for place in (1, 2)
    ]
    assert not any(chain.gap or chain.gap_damper for chain in others.values())


def test_a_gain_without_a_unit_may_be_one_in_decibels():
    loud = 1e3 * EXACT
    level = 20 * np.log10(np.abs(loud)) * loud / np.abs(loud)
    data = FrequencyResponse(OMEGA, level, doubts=(ASSUMED_LINEAR,))
    words = "with gains in dB (--unit magnitude=dB)"
    assert dict(_misread(data))[words] == pytest.approx(loud)
    assert words not in dict(_misread(replace(data, doubts=())))
    assert words not in dict(_misread(replace(data, G=20 * level)))  # 10^40 is no response


@pytest.mark.full
def test_a_mass_more_is_named_where_it_explains_the_data():
    three = Chain(3, damped=True, ground_dampers=(2,))
    values = VALUES | {"m3": 0.4, "k23": 1e4, "d23": 3.0}
    found = select(noisy(response(three, values).G), [ONE, DRIVE])
    assert [r.words for r in found.readings] == ["with one mass more"]


@pytest.mark.slow
def test_gains_in_db_are_named_where_a_gain_has_no_unit():
    level = 20 * np.log10(np.abs(EXACT) * 100)
    data = noisy(level * np.exp(1j * np.angle(EXACT)))
    words = "with gains in dB (--unit magnitude=dB)"
    for note in ((), (f"column 2 {ASSUMED_LINEAR}",)):
        found = select(data.noted(*note), [DRIVE])
        assert (words in [r.words for r in found.readings]) == bool(note)


@pytest.mark.full
def test_noise_is_called_noise():
    found = select(noisy(np.ones(OMEGA.size), size=30.0), [Chain(1, damped=False), ONE])
    told(found.test, found)
    assert "mostly noise" in first_lines(found)[1] and found.readings == ()


@pytest.mark.full
@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_right_models_explain(seed):
    chain = Chain(2, damped=True, ground_dampers=(1,), dead_time=True)
    train, test = (
        response(chain, truth(chain, seed), noise=0.02, seed=100 * seed + k) for k in (1, 2)
    )
    found = select(train, [Chain(1, damped=True), chain], test=test)
    assert found.explanation.explains and 0.5 < found.explanation.chi2 < 2
    assert f"; {found.members[0].name} explains this data" in first_lines(found)[1]


@pytest.mark.full
def test_the_bench_and_its_demonstration_are_explained():
    train, test = bench("A"), bench("B")
    found = select(train, [replace(DRIVE, dead_time=True)], test=test)
    assert found.explanation.chi2 == pytest.approx(0.860, abs=0.01) and found.explanation.explains
    assert found.explanation.scatter.source == "the difference of training and test data"
    assert any(
        "training and test data differ by" in s and "values hold for this amplitude" in s
        for s in suspicions(found)
    )


def side_by_side(values):
    """Acceleration of a motor m1 with friction b1 that drives the loads m2 and m3."""
    s = 1j * OMEGA
    force = values["m1"] * s**2 + values["b1"] * s
    for load in "23":
        joint = values[f"k1{load}"] + values[f"d1{load}"] * s
        force += joint * values[f"m{load}"] * s**2 / (joint + values[f"m{load}"] * s**2)
    return s**2 / force


LOADS = {"m1": 1.0, "m2": 0.7, "m3": 0.4, "k12": 3e4, "k13": 6e4, "d12": 0.8, "d13": 0.8, "b1": 0.5}
ROW = Chain(3, damped=True, ground_dampers=(1,))


@pytest.mark.full
def test_a_structure_that_comes_near_the_data_of_another_one_decides_nothing():
    """Two loads side by side, fitted as two in a row: small misses of many lines together."""
    found = select(noisy(side_by_side(LOADS), size=0.003), [ROW])
    assert found.explanation.level is Level.NEARLY and found.explanation.chi2 < LARGEST
    plain, (_, structure, more) = selection_to_dict(found), first_lines(found)
    assert structure.startswith(
        "structure: none of the candidates explains this data fully: 3:1+b1 comes near"
    )
    (branch,) = (machine for machine in found.outside if machine.is_better)
    assert branch.text == "1=2, 1=3, 1-#; F1; S1" and 0.5 < branch.chi2 < 1.3
    assert {n: branch.values[n] for n in LOADS if n[0] in "mk"} == pytest.approx(
        {n: v for n, v in LOADS.items() if n[0] in "mk"}, rel=0.01
    )
    assert f"explains it: a branch {branch.text} (chi2 {branch.chi2:.3g}); values hold" in structure
    assert "may lie outside their intervals" in structure
    assert more.endswith(f'(--models "{branch.text}" with --masses)')
    assert (plain["status"], plain["explained"]) == ("not explained fully", False)
    assert plain["values_hold"] == "as an approximation only"
    validate(plain, schema(Format.FIT))
    assert [m["name"] for m in plain["not_excluded"]] == ["3:1+b1"]
    text = list(fit_text(found, found.task.cost.measured))
    values = [line for line in text if " = " in line and " ± " in line]
    assert len(values) == 8 and all(line.endswith(" *") for line in values)
    assert any("by how much another structure shifts a value" in line for line in text)


@pytest.mark.full
def test_what_no_machine_outside_explains_either_is_said_too():
    """An echo of 0.5 % beside the response."""
    echo = 1 + 0.005 * np.exp(-0.02j * OMEGA)
    found = select(noisy(EXACT * echo, size=0.004), [DRIVE])
    assert found.explanation.level is Level.NEARLY and found.outside == ()
    _, structure, more = first_lines(found)
    assert "the machine may be a branch, a drive on an elastic base" in structure
    assert "--base" in more and '--models "1=2, 1=3; F1; S1"' in more


def test_disturbed_lines_are_no_other_structure():
    """Neither far misses of two neighbouring lines nor larger noise of all hang together."""
    source, ones = np.random.default_rng(3), np.ones(2 * OMEGA.size)
    residual = source.normal(size=2 * OMEGA.size)
    assert systematic_share(residual, ones) == systematic_share(1.6 * residual, ones) == 0.0
    residual[[40, 41, 160, 161]] = 20.0
    assert systematic_share(residual, ones) == 0.0
    wave = np.tile(np.sin(np.arange(OMEGA.size) / 4), 2)
    assert systematic_share(residual + wave, ones) > 0.2


@pytest.mark.full
@pytest.mark.parametrize("noise", [0.003, 0.01, 0.03])
def test_scatter_from_neighbouring_lines_is_the_noise(noise):
    chain = Chain(3, damped=True, ground_dampers=(1,))
    found = [
        scatter(
            response(chain, truth(chain, s), noise=noise, seed=s),
            [response(chain, truth(chain, s)).G],
        )
        for s in range(8)
    ]
    assert np.mean([f.typical for f in found]) == pytest.approx(noise / np.sqrt(2), rel=0.15)
    assert {f.source for f in found} == {"neighbouring lines"}


def test_scatter_prefers_what_the_file_knows():
    data = response(DRIVE, VALUES, noise=0.01, seed=3)
    stated = replace(data, deviation=0.02 * np.abs(data.G))
    assert (
        scatter(stated).typical == pytest.approx(0.02 / np.sqrt(2), rel=1e-3)
        and "standard deviations" in scatter(stated).source
    )
    uneven = np.where(np.arange(OMEGA.size) % 2, 0.999, 0.9)  # neighbours alone cannot see that
    size = np.sqrt((1 - uneven) / uneven)
    error = np.random.default_rng(1).normal(size=(2, OMEGA.size)) * 0.1 * size
    loud = replace(data, G=EXACT * np.exp(error[0] + 1j * error[1]), coherence=uneven)
    found = scatter(loud, [EXACT])
    assert found.source.startswith("the coherence") and found.rho == pytest.approx(
        0.1 * size, rel=0.6
    )
    jumping = replace(data, deviation=0.001 * np.abs(data.G))
    assert "jump" in scatter(jumping, [EXACT]).source and scatter(jumping, [EXACT]).typical > 0.004


@pytest.mark.full
def test_training_against_test_counts_where_it_is_larger():
    one, other = (response(DRIVE, VALUES, noise=0.01, seed=s) for s in (1, 2))
    own, there = scatter(one, [EXACT]), scatter(other, [EXACT])
    assert change(one, other, own, there) == change(one, one, own, own) == 0.0
    moved = replace(other, G=other.G * 1.2)
    assert change(one, moved, own, there) == pytest.approx(np.log(1.2) / 2, rel=0.05)
    both = yardsticks(Cost(one), Cost(moved), [EXACT], [EXACT])
    assert [b.typical for b in both] == pytest.approx([np.log(1.2) / 2] * 2, rel=0.05)
    assert {b.source for b in both} == {"the difference of training and test data"}


def test_what_is_missed_is_named_by_its_frequencies():
    data = response(DRIVE, VALUES, noise=0.01, seed=1)
    cost = Cost(data)
    wrong = EXACT * np.where(np.abs(data.frequency - 50) < 10, 1.3, 1.0)
    known = scatter(data, [EXACT])
    whitened, ones = WhitenedCost(cost, known), np.ones(2 * OMEGA.size)
    assert chi2(whitened.residual(EXACT), ones) == pytest.approx(1, rel=0.4)
    (miss,) = explanation(whitened.residual(wrong), ones, cost, known).misses
    assert (
        35 < miss.low < 42
        and 58 < miss.high < 66
        and miss.factor == pytest.approx(np.log(1.3), abs=0.03)
    )


@pytest.mark.full
def test_what_is_not_admissible_and_fits_better_is_named():
    """A damper held below its value is at its bound; without it the mass alone is worse."""
    free = Chain(1, damped=False)
    given = {"rule": Rule.PAPER, "bound": {"b1": (0.0, 0.4)}, "test": noisy(ONE_MASS, seed=2)}
    found = select(noisy(ONE_MASS), [free, ONE], **given)
    assert found.selected.chain == free and [c.chain for c in found.better] == [ONE]
    (said,) = [line for line in suspicions(found) if "1:1+b1 fits better" in line]
    assert "b1 is at its bound" in said


@pytest.mark.slow
def test_what_the_paper_does_not_admit_is_named_where_it_fits_better():
    """A parameter at its bound is not admissible; one that is given does not count. By default it
    stays and is marked.
    """
    data, low = [response(DRIVE, VALUES, noise=0.01, seed=s) for s in (1, 2)], {"k12": (0.0, 2.9e4)}
    given = {"test": data[1], "bounds": low, "fixed": {"b2": 20.0}}
    candidates = [Chain(1, damped=False), DRIVE]
    found = select(data[0], candidates, rule=Rule.PAPER, **given)
    (better,) = found.better
    assert found.selected.chain == candidates[0] and better.chain == DRIVE
    assert better.at_bound == ("k12",) and "k12 is at its bound" in better.reasons
    assert better.n_parameters == 4
    assert any(
        "2:1+b2 fits better" in line and "k12 is at its bound" in line
        for line in first_lines(found)
    )
    kept = select(data[0], candidates, **given)
    assert kept.selected.chain == DRIVE and kept.better == ()
    assert kept.selected.reasons == ("k12 is at its bound",)


@pytest.mark.full
def test_where_nothing_explains_the_data_the_misfit_is_not_taken_for_noise():
    data = [response(DRIVE, VALUES, noise=0.01, seed=s) for s in (1, 2)]
    found = select(
        data[0],
        [Chain(1, damped=False), replace(ONE, dead_time=True)],
        test=data[1],
        fix={"m1": 0.5},
    )
    lowest = min(c.j_test for c in found.candidates)
    assert not found.explanation.explains and found.described.j_test == lowest


@pytest.mark.full
def test_what_explains_the_data_goes_before_what_does_not():
    """Few repeats of a quiet machine: the loud lines above the resonance hide in the cost what the
    simpler candidate misses at the quiet ones below it.
    """
    right, wrong = (Chain(2, damped=True, dead_time=True, ground_dampers=at) for at in ((1,), ()))
    values = {"m1": 0.0045, "m2": 0.005, "k12": 550.0, "d12": 0.075, "b1": 0.12, "Td": 3e-4}
    source = np.random.default_rng(0)
    omega = 2 * np.pi * np.arange(20.0, 251.0)
    exact = response(right, values, omega).G
    sigma = 4e-5 * omega**2  # of a position that is noisy, as acceleration
    error = sigma * (source.normal(size=omega.size) + 1j * source.normal(size=omega.size))
    data = FrequencyResponse(omega, exact + error / np.sqrt(2), deviation=sigma)
    found = select(data, [right, wrong])
    sizes = {c.chain: c.chi2 for c in found.candidates}
    assert sizes[right] < 3 < sizes[wrong]
    assert found.selected.chain == right and [m.name for m in found.members] == ["2:1+b1+delay"]
    assert "; 2:1+b1+delay explains this data" in first_lines(found)[1]


@pytest.mark.full
def test_what_is_not_determined_has_no_percentage():
    found = select(noisy(ONE_MASS), [ONE])
    errors = replace(found.selected.practical, relative_errors={"m1": 92.0, "b1": 0.5})
    badly = replace(found, selected=replace(found.selected, practical=errors), members=())
    assert "poorly determined: m1 not at all, b1 to ± 50 %" in suspicions(badly)


@pytest.mark.full
@pytest.mark.parametrize(("step", "said"), [(1.0, True), (0.002, False)])
def test_a_resonance_between_two_lines_is_named(step, said):
    """A small mass beside a large one: its resonance and antiresonance are 0.02 Hz apart."""
    drive = Chain(2)
    values = {"m1": 1.0, "m2": 1e-3, "k12": 36.0, "d12": 1e-5}
    hertz = 30.2 + step * np.arange(-12.3, 13)
    found = select(response(drive, values, 2 * np.pi * hertz, noise=1e-5), [drive])
    named = [line for line in suspicions(found) if "Both lie between two measured lines" in line]
    assert bool(named) == said, suspicions(found)


@pytest.mark.slow
def test_what_one_line_alone_determines_is_not_foretold_by_the_others():
    """A narrow resonance next to one line: without this line its height is not known."""
    machine = bench_drive(4, 52)
    found = select(bench_data(machine, 1), [bench_truth(machine)])
    (candidate,) = found.candidates
    assert found.explanation.explains
    assert np.abs(candidate.residual).max() > 10 and candidate.missed.max() > 10


@pytest.mark.parametrize(
    ("misses", "level"),
    [
        ((), Level.APART),
        ((Miss(155, 195, 1.5, 3.0, 0.4),), Level.APART),
        ((Miss(155, 195, 1.5, 0.1, 0.4), Miss(47, 53, 0.1, 0.2, 0.1)), Level.APART),
        ((Miss(155, 195, 1.5, 0.1, 0.4), Miss(111, 119, 0.1, 3.0, 0.2)), Level.NOT),
        ((Miss(155, 195, 1.5, 3.0, 0.4, "a"), Miss(111, 119, 1.8, 3.0, 0.2, "b")), Level.APART),
    ],
)
def test_two_ranges_missed_by_as_much_as_the_response_are_not_apart(misses, level):
    """A drive with backlash and 22 % noise was explained apart from a factor 4 and one of 6."""
    found = Explanation(
        1.8, scatter(noisy(EXACT), []), 0.0, misses, chi2_apart=1.5, worst_apart=2.0, lines=100
    )
    assert found.size_level is level
