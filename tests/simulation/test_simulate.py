"""Simulated records: the response of a record without noise is that of the model, exactly."""

import re
from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest
import sympy
from hypothesis import given, strategies as st
from scipy.signal import cont2discrete

from disting.errors import InputError
from disting.model.chain import Chain, Quantity
from disting.model.family import Family
from disting.simulation import (
    DEMO_MODEL,
    DEMO_PARAMETERS,
    Bench,
    Excitation,
    Friction,
    Kind,
    demo,
    frequency_response,
    matrices,
    simulate,
)
from disting.simulation.bench import read_spectrum

BENCH = Bench(sampling_rate=1000.0, samples=1000, periods=3)
BAND = Excitation(low=5.0, high=200.0)


SPECTRUM = tuple(
    (f, a) for f, a in zip(range(10, 120, 10), (1, 2, 1, 3, 1, 1, 2, 1, 1, 5, 1), strict=True)
)


def test_a_multisine_has_the_lines_and_amplitudes_of_its_spectrum():
    signal = Excitation(spectrum=SPECTRUM, rms=3.0).period(1000, 1000.0)
    lines = np.abs(np.fft.rfft(signal))
    sizes = np.array([a for _, a in SPECTRUM], dtype=float)
    seen = lines[[f for f, _ in SPECTRUM]]
    assert seen / seen[0] == pytest.approx(sizes) and np.sqrt(np.mean(signal**2)) == pytest.approx(
        3.0
    )
    assert np.sum(lines**2) == pytest.approx(np.sum(seen**2))


def test_a_spectrum_of_equal_amplitudes_is_the_schroeder_multisine():
    equal = Excitation(spectrum=tuple((float(f), 0.5) for f in range(10, 101)))
    plain = Excitation(low=10.0, high=100.0)
    assert equal.period(1000, 1000.0) == pytest.approx(plain.period(1000, 1000.0), abs=1e-9)


def test_lines_that_fall_together_add_their_powers():
    near = Excitation(spectrum=((10.2, 3.0), (9.9, 4.0), (20.0, 5.0)))
    assert list(near.lines(1000, 1000.0)) == [10, 20]
    seen = np.abs(np.fft.rfft(near.period(1000, 1000.0)))
    assert seen[10] == pytest.approx(seen[20])


def test_a_spectrum_is_read_back_bit_by_bit(tmp_path):
    lines = ((1 / 3, 0.1), (10.0, 1 / 7), (77.7, 1.0))
    (tmp_path / "s.csv").write_text(Excitation(spectrum=lines).spectrum_csv, encoding="utf-8")
    assert read_spectrum(tmp_path / "s.csv") == lines


@pytest.mark.parametrize(
    "text", ["", "frequency_hz,amplitude\n", "a,b\n1,2\n", "frequency_hz,amplitude\n1,x\n"]
)
def test_what_is_no_spectrum_is_refused(tmp_path, text):
    (tmp_path / "s.csv").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="is not a spectrum"):
        read_spectrum(tmp_path / "s.csv")


def truth(chain, seed=0):
    source = np.random.default_rng(seed)
    sizes = {"m": 0.01, "k": 500.0, "d": 0.1, "b": 0.1, "T": 2e-3}
    return {
        name: sizes[name[0]] * float(np.exp(0.5 * source.normal())) for name in chain.parameters
    }


def sympy_response(chain, values, omega):
    """Independent: the equations of motion solved symbolically."""
    s = sympy.Symbol("s")
    n = chain.n_masses
    A = sympy.zeros(n + 1, n + 1)
    for name, value in values.items():
        if name[0] == "m":
            A[int(name[1]), int(name[1])] += value * s**2
        elif name[0] == "b":
            A[int(name[1]), int(name[1])] += value * s
        elif name[0] in "kd":
            i, j = int(name[1]), int(name[2])
            v = sympy.zeros(n + 1, 1)
            v[i], v[j] = 1, -1
            A += value * (s if name[0] == "d" else 1) * v * v.T
    force = sympy.zeros(n + 1, 1)
    force[chain.act_plus] += 1
    force[chain.act_minus] -= 1
    x = [0, *A[1:, 1:].LUsolve(force[1:, :])]
    G = s**chain.quantity.order * (x[chain.meas_plus] - x[chain.meas_minus])
    G = G * sympy.exp(-s * values.get("Td", 0)) / (1 + s * values.get("T1", 0))
    return np.array([complex(G.subs(s, sympy.I * w).evalf(30)) for w in omega])


CHAINS = [
    Chain(1, quantity=Quantity.POSITION, damped=True, ground_dampers=(1,)),
    Chain(2, damped=True, ground_dampers=(1, 2), lag=True, dead_time=True),
    Chain(3, meas_plus=3, quantity=Quantity.VELOCITY, damped=True),
    *(Family(3, damped=True)[i] for i in (1, 5, 8, 11)),
]


@pytest.mark.thin(1)
@pytest.mark.parametrize("chain", CHAINS, ids=str)
def test_a_record_without_noise_has_the_response_of_the_model(chain):
    values = truth(chain)
    found = simulate(chain, values, BAND, BENCH).response()
    model = frequency_response(chain, values, found.omega)
    assert len(found) == 196 and found.quantity is chain.quantity
    assert np.abs(found.G / model - 1).max() < 1e-8
    some = slice(0, None, 49)
    np.testing.assert_allclose(
        model[some], sympy_response(chain, values, found.omega[some]), rtol=1e-10
    )
    assert simulate(chain.structure, values, BAND, BENCH) == simulate(chain, values, BAND, BENCH)


def test_matrices_of_three_masses_by_hand():
    chain = Chain(
        3,
        gap=1,
        act_minus=1,
        act_plus=2,
        meas_minus=1,
        meas_plus=2,
        damped=True,
        ground_dampers=(3,),
    )
    values = {
        "m1": 1.0,
        "m2": 2.0,
        "m3": 3.0,
        "k01": 4.0,
        "k23": 5.0,
        "d01": 6.0,
        "d23": 7.0,
        "b3": 8.0,
    }
    M, D, K = matrices(chain, values)
    assert np.diag(M).tolist() == [1, 2, 3] and np.count_nonzero(M) == 3
    assert K.tolist() == [[4, 0, 0], [0, 5, -5], [0, -5, 5]]
    assert D.tolist() == [[6, 0, 0], [0, 7, -7], [0, -7, 15]]


@pytest.mark.parametrize("kind", list(Kind))
def test_test_signals_have_the_band_and_the_size_asked_for(kind):
    signal = Excitation(kind, 20.0, 100.0, rms=3.0).period(1000, 1000.0, seed=1)
    power = np.abs(np.fft.rfft(signal)) ** 2
    assert np.sqrt(np.mean(signal**2)) == pytest.approx(3.0) and abs(signal.mean()) < 1e-12
    inside = power[20:101]
    assert inside.sum() / power.sum() > (0.97 if kind is Kind.CHIRP else 1 - 1e-12)
    if kind is not Kind.CHIRP:
        assert np.ptp(inside) / inside.max() < 1e-9
    found = simulate(DEMO_MODEL, DEMO_PARAMETERS, Excitation(kind), Bench(periods=2)).response()
    assert (
        np.abs(found.G / frequency_response(DEMO_MODEL, DEMO_PARAMETERS, found.omega) - 1).max()
        < 1e-9
    )


def test_schroeder_phases_keep_the_peak_low_and_every_leaves_lines_out():
    peaks = [
        np.abs(Excitation(kind, 10, 250).period(2500, 2500.0)).max()
        for kind in (Kind.SCHROEDER, Kind.RANDOM_PHASE)
    ]
    assert peaks[0] < 2.0 < peaks[1]
    odd = simulate(DEMO_MODEL, DEMO_PARAMETERS, Excitation(low=11, high=249, every=2)).response()
    assert odd.frequency.round(6).tolist() == list(range(11, 250, 2))


@pytest.mark.full
@given(st.integers(0, 10**6))
def test_the_same_seed_gives_the_same_record(seed):
    bench = replace(BENCH, seed=seed, input_noise=0.1, output_noise=1e-4, periods=2)
    chain = CHAINS[0]
    record = simulate(chain, truth(chain), replace(BAND, kind="random-phase"), bench)
    assert record == simulate(chain, truth(chain), replace(BAND, kind="random-phase"), bench)
    assert record != simulate(
        chain, truth(chain), replace(BAND, kind="random-phase"), replace(bench, seed=seed + 1)
    )


def test_noise_is_as_large_as_asked_for_and_its_deviation_is_true():
    chain, values = CHAINS[0], truth(CHAINS[0])
    quiet = simulate(chain, values, BAND, replace(BENCH, periods=40))
    loud = simulate(
        chain, values, BAND, replace(BENCH, periods=40, input_noise=0.05, output_noise=1e-5)
    )
    assert np.std(loud.u - quiet.u) == pytest.approx(0.05, rel=0.02)
    assert np.std(loud.y - quiet.y) == pytest.approx(1e-5, rel=0.02)
    found = loud.response()
    error = np.abs(found.G - frequency_response(chain, values, found.omega)) / found.deviation
    assert 0.8 < np.mean(error**2) < 1.3


@pytest.mark.full
@pytest.mark.parametrize(("slope", "corner"), [(1.0, 2.0), (2.0, 20.0)])
def test_coloured_noise_has_its_size_and_its_density(slope, corner):
    chain, values = CHAINS[0], truth(CHAINS[0])
    bench = replace(BENCH, periods=200)
    loud = replace(bench, output_noise=1e-3, noise_slope=slope, noise_corner=corner)
    noise = simulate(chain, values, BAND, loud).y - simulate(chain, values, BAND, bench).y
    assert np.std(noise) == pytest.approx(1e-3, rel=0.05)
    power = np.abs(np.fft.rfft(noise.reshape(200, 1000) * np.hanning(1000), axis=1)) ** 2
    hertz = np.arange(5, 400)
    flat = power.mean(axis=0)[hertz] * (1 + (hertz / corner) ** 2) ** (slope / 2)
    for part in np.array_split(flat / flat.mean(), 4):
        assert part.mean() == pytest.approx(1, abs=0.05)


def test_an_encoder_shows_multiples_of_its_step():
    quantum = 2 * np.pi / 2**16
    record = simulate(DEMO_MODEL, DEMO_PARAMETERS, bench=Bench(quantum=quantum, periods=2))
    steps = record.y / quantum
    assert np.abs(steps - np.rint(steps)).max() < 1e-6
    assert np.abs(
        record.y - simulate(DEMO_MODEL, DEMO_PARAMETERS, bench=Bench(periods=2)).y
    ).max() <= quantum / 2 * (1 + 1e-9)


def test_viscous_friction_is_a_ground_damper():
    chain = Chain(2, damped=True, ground_dampers=(2,))
    plain = Chain(2, damped=True)
    values = truth(chain)
    rest = {name: value for name, value in values.items() if name != "b2"}
    left = simulate(chain, values, BAND, BENCH)
    right = simulate(
        plain, rest, BAND, replace(BENCH, friction={2: Friction(viscous=values["b2"])})
    )
    np.testing.assert_allclose(left.y, right.y, atol=1e-9 * np.abs(left.y).max())


@pytest.mark.full
def test_time_steps_agree_with_the_exact_lines_where_friction_vanishes():
    bench = Bench(samples=500, periods=3, friction={1: Friction(coulomb=1e-10)})
    record = simulate(DEMO_MODEL, DEMO_PARAMETERS, Excitation(low=20.0), bench)
    exact = simulate(DEMO_MODEL, DEMO_PARAMETERS, Excitation(low=20.0), replace(bench, friction={}))
    assert np.abs(record.y - exact.y).max() < 1e-5 * np.abs(exact.y).max()


@pytest.mark.full
def test_coulomb_friction_acts_like_the_describing_function_of_a_sign():
    """One sine, one mass: friction c sign(v) seen at the same frequency is a damper 4 c / (pi
    V) for speeds of amplitude V.
    """
    chain = Chain(1, quantity=Quantity.VELOCITY, damped=False)
    c, low = 0.02, 10.0
    bench = Bench(samples=250, periods=12, friction={1: Friction(coulomb=c, speed=2e-3)})
    record = simulate(chain, {"m1": 0.01}, Excitation(low=low, high=low + 1.0, rms=1.0), bench)
    U, V = (np.fft.rfft(x.reshape(12, 250)[6:]).mean(axis=0)[1] for x in (record.u, record.y))
    speed = abs(V) / 125
    expected = 1 / (0.01 * 2j * np.pi * low + 4 * c / (np.pi * speed))
    assert abs(V / U / expected - 1) < 0.01
    assert abs(V / U * (0.01 * 2j * np.pi * low) - 1) > 0.01  # and not that of the mass alone


def test_the_demonstration_is_a_bench_that_shows_its_model():
    found = demo().response("acceleration")
    model = frequency_response(
        replace(DEMO_MODEL, quantity=Quantity.ACCELERATION), DEMO_PARAMETERS, found.omega
    )
    assert len(found) == 241 and found.suspicions == () and demo() == demo() and demo() != demo(1)
    assert 0.7 < np.mean(np.abs((found.G - model) / found.deviation) ** 2) < 1.4
    assert (found.input.unit, found.output.unit, demo().output.unit) == ("A", "rad/s^2", "rad")
    assert (
        found.frequency[np.argmin(np.abs(found.G))].round() == 53
        and found.frequency[np.argmax(np.abs(found.G))].round() == 77
    )


def held_error(rate, hertz):
    """Errors of the motor position per force, held at a rate [Hz]: beside half a sample of delay,
    and after division by the response of the hold; by exact discretisation.
    """
    chain = replace(DEMO_MODEL, dead_time=False)
    values = {name: value for name, value in DEMO_PARAMETERS.items() if name != "Td"}
    m = matrices(chain, values)
    A = np.block(
        [
            [np.zeros((2, 2)), np.eye(2)],
            [-np.linalg.solve(m.M, m.K), -np.linalg.solve(m.M, m.D)],
        ]
    )
    B = np.array([[0.0], [0.0], [1 / values["m1"]], [0.0]])
    a, b, c, _, _ = cont2discrete((A, B, np.eye(4)[:1], [[0.0]]), 1 / rate)
    s = 2j * np.pi * hertz / rate
    sampled = np.array([(c @ np.linalg.solve(np.exp(x) * np.eye(4) - a, b))[0, 0] for x in s])
    ratio = sampled / frequency_response(chain, values, 2 * np.pi * hertz)
    return abs(ratio * np.exp(s / 2) - 1), abs(ratio * s / (1 - np.exp(-s)) - 1)


def test_a_held_input_makes_the_errors_that_the_guide_tells():
    guide = files("disting").joinpath("guide", "time-records.md").read_text(encoding="utf-8")
    rows = re.findall(r"\| ([\d.]+) f_s \| ([\d.]+) % \| ([\d.]+) % \|", guide)
    assert len(rows) == 5
    lines = np.linspace(0.01, 0.45, 441)
    delayed, divided = (100 * error for error in held_error(5000.0, 5000.0 * lines))
    for share, one, other in rows:
        last = np.argmin(abs(lines - float(share))) + 1
        assert delayed[:last].max() == pytest.approx(float(one), rel=0.06)
        assert divided[:last].max() == pytest.approx(float(other), rel=0.06, abs=0.008)
    antiresonance = held_error(300.0, np.linspace(50.0, 55.0, 501))[1]
    assert 100 * antiresonance.max() == pytest.approx(17, abs=1)


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: simulate(Chain(2, damped=False), {"m1": 1.0}),
            "parameters m1, m2, k12 are needed",
        ),
        (lambda: simulate(Chain(1, damped=False), {"m1": 0.0}), "m1 = 0.0 is not a positive"),
        (lambda: simulate(Chain(1, damped=False), {"m1": float("nan")}), "m1 = nan"),
        (
            lambda: simulate(Chain(2, damped=False), {"m1": 1.0, "m2": 1.0, "k12": -1.0}),
            "k12 = -1.0 is not a non-negative",
        ),
        (lambda: Excitation(low=0.0), "0 < low < high"),
        (lambda: Excitation(spectrum=((10.0, 0.0),)), "positive amplitudes"),
        (lambda: Excitation("chirp", spectrum=((10.0, 1.0),)), "no spectrum of its own"),
        (lambda: Excitation(spectrum=((600.0, 1.0),)).period(1000, 1000.0), "other samples"),
        (lambda: Excitation("noise"), "one of schroeder, random-phase, chirp"),
        (lambda: Excitation(high=600.0).period(1000, 1000.0), "half the sampling rate"),
        (lambda: Excitation(low=10.1, high=10.2).period(1000, 1000.0), "holds no line"),
        (lambda: Bench(sampling_rate=0.0), "positive sampling rate"),
        (lambda: Bench(quantum=-1.0), "not negative"),
        (lambda: Bench(noise_slope=-1.0), "slope of at least 0"),
        (lambda: Bench(noise_corner=0.0), "positive corner"),
        (lambda: Friction(speed=0.0), "speed > 0"),
        (
            lambda: simulate(
                Chain(1, damped=False), {"m1": 1.0}, bench=Bench(friction={2: Friction(1.0)})
            ),
            "at masses 1, not at",
        ),
        (
            lambda: simulate(
                Chain(1, damped=False),
                {"m1": 1.0},
                bench=Bench(friction={1: Friction(1e9, speed=1e-9)}),
            ),
            "steps are too many",
        ),
        (
            lambda: frequency_response(Chain(1, damped=False), {"m1": 1.0}, np.zeros(1)),
            "response is infinite",
        ),
    ],
)
def test_bad_input_is_refused(call, words):
    with pytest.raises(InputError, match=words):
        call()
