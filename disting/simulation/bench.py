"""Simulated measurements: a chain or a network, a periodic test signal, and what a real bench adds.

The force is the continuous band-limited signal through the samples u, not a staircase: no
correction for a zero-order hold is needed, and G of a record without noise is G of the model.
Without Coulomb friction the periodic motion is computed line by line, Y_k = G(j omega_k) U_k, with
dead time and lag exact and nothing left of a transient; with it, in steps of time, from the motion
without it, so that the first periods are a transient.

Periodic test signals are multisines with Schroeder or random phases, of equal or given amplitudes,
and a repeated linear chirp.
"""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path
from types import MappingProxyType

import numpy as np

from disting.errors import InputError, enumeration, short
from disting.files import read_bounded
from disting.measurement import Signal, TimeSeries
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain, Quantity, Sort
from disting.network.network import Network
from disting.renamed import renamed
from disting.simulation.mechanics import (
    AnyModel,
    Friction,
    check_values,
    form_of,
    input_filter,
    matrices,
    motion,
    step,
)

Lines = np.ndarray[tuple[int], np.dtype[np.intp]]
HEADER = ("frequency_hz", "amplitude")


class Kind(StrEnum):
    """Choice of the lines of one period.

    >>> Excitation(Kind.CHIRP, low=1.0, high=100.0).kind.value
    'chirp'
    """

    SCHROEDER = "schroeder"
    RANDOM_PHASE = "random-phase"
    CHIRP = "chirp"


@dataclass(frozen=True, slots=True)
class Excitation:
    """Signal between `low` and `high` [Hz] with root mean square `rms` [unit of the input];
    `every` = step between its lines.

    Schroeder multisine: equal amplitudes, phases -2 pi sum over j < i of (i - j) p_j, p_j = share
    of line j of the power, which are -pi i (i - 1) / F for F equal ones (Schroeder 1970), low
    crest factor; random phases: uniform in 0..2 pi; chirp: one sweep of rising frequency a period
    (`every` has no meaning there). `spectrum` = frequency [Hz] and relative amplitude of each line
    of a multisine, which then has these and no others: `low`, `high` and `every` have no meaning.

    >>> Excitation(low=5.0, high=400.0, rms=0.5).high
    400.0
    """

    kind: Kind = Kind.SCHROEDER
    low: float = 10.0
    high: float = 250.0
    rms: float = 1.0
    every: int = 1
    spectrum: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        if not 0 < self.low < self.high < np.inf or not 0 < self.rms < np.inf or self.every < 1:
            raise InputError(
                f"an excitation has 0 < low < high [Hz], a positive rms and every >= 1, not"
                f" low = {short(self.low)}, high = {short(self.high)}, rms = {short(self.rms)},"
                f" every = {short(self.every)}"
            )
        try:
            object.__setattr__(self, "kind", Kind(self.kind))
        except ValueError:
            raise InputError(
                f"the excitation is one of {', '.join(Kind)}, not {short(self.kind)}"
            ) from None
        if self.spectrum and self.kind is Kind.CHIRP:
            raise InputError("a chirp has no spectrum of its own: choose a multisine")
        if not all(0 < f < np.inf and 0 < a < np.inf for f, a in self.spectrum):
            raise InputError("a spectrum has positive frequencies [Hz] and positive amplitudes")

    @property
    def spectrum_csv(self) -> str:
        """The spectrum as text, which `read_spectrum` reads back bit by bit."""
        rows = (f"{float(f)!r},{float(a)!r}\n" for f, a in self.spectrum)
        return "".join([",".join(HEADER) + "\n", *rows])

    def lines(self, samples: int, rate: float) -> Lines:
        """Numbers of the lines within the band, or nearest to those of the spectrum, multiples of
        rate/samples [Hz].
        """
        if self.spectrum:
            return self._nearest(samples, rate)[0]
        spacing = rate / samples
        first, last = (
            int(np.ceil(self.low / spacing - 1e-9)),
            int(np.floor(self.high / spacing + 1e-9)),
        )
        if last >= samples / 2 or last < first:
            raise InputError(
                f"{self.low:g}..{self.high:g} Hz holds no line or passes half the sampling rate;"
                f" lines lie {spacing:g} Hz apart"
            )
        return np.arange(max(first, 1), last + 1, self.every)

    def period(self, samples: int, rate: float, seed: int = 0) -> Real:
        """One period of `samples` values at `rate` [Hz]; the seed steers random phases alone."""
        lines = self.lines(samples, rate)
        if self.kind is Kind.CHIRP:
            signal = _chirp(int(lines[0]), int(lines[-1]), samples)
        else:
            sizes = self._nearest(samples, rate)[1] if self.spectrum else np.ones(len(lines))
            spectrum = np.zeros(samples // 2 + 1, dtype=complex)
            spectrum[lines] = sizes * np.exp(1j * self._phases(sizes, seed))
            signal = np.fft.irfft(spectrum, samples)
        return np.asarray(signal * (self.rms / np.sqrt(np.mean(signal**2))))

    def _nearest(self, samples: int, rate: float) -> tuple[Lines, Real]:
        """Numbers and amplitudes of the lines nearest to those of the spectrum; the powers of those
        that become one are added.
        """
        hertz, amplitudes = np.array(self.spectrum).T
        at = np.round(hertz * samples / rate).astype(np.intp)
        if at.min() < 1 or at.max() >= samples / 2:
            raise InputError(
                f"the spectrum goes from {hertz.min():g} to {hertz.max():g} Hz, this period of"
                f" {samples} samples at {rate:g} Hz from {rate / samples:g} to below"
                f" {rate / 2:g} Hz: choose other samples or another rate"
            )
        lines, place = np.unique(at, return_inverse=True)
        return lines, np.sqrt(np.bincount(place, weights=amplitudes**2))

    def _phases(self, sizes: Real, seed: int) -> Real:
        count = len(sizes)
        if self.kind is Kind.RANDOM_PHASE:
            return np.random.default_rng(seed).uniform(0.0, 2 * np.pi, count)
        if not self.spectrum:
            numbers = np.arange(1, count + 1)
            return np.asarray(-np.pi * numbers * (numbers - 1) / count)
        shares = sizes**2 / np.sum(sizes**2)
        below = np.append(0.0, np.cumsum(shares)[:-1])
        return np.asarray(-2 * np.pi * np.cumsum(below))


def read_spectrum(path: Path) -> tuple[tuple[float, float], ...]:
    """The spectrum of a CSV file with the columns frequency_hz and amplitude; raises InputError."""
    text = read_bounded(path, f"a CSV file with the columns {' and '.join(HEADER)}")
    try:
        rows = list(csv.DictReader(text.decode("utf-8").splitlines()))
        lines = tuple((float(row[HEADER[0]]), float(row[HEADER[1]])) for row in rows)
    except (ValueError, KeyError, TypeError):
        lines = ()
    if not lines:
        raise InputError(
            f"{path} is not a spectrum: a CSV file with the columns {' and '.join(HEADER)} is"
            " needed"
        )
    return lines


def _chirp(first: int, last: int, samples: int) -> Real:
    """From `first` to `last` cycles a period, a whole number of cycles in all, without its mean
    and its highest line.
    """
    share = np.arange(samples) / samples
    last += (last - first) % 2
    spectrum = np.fft.rfft(np.sin(2 * np.pi * (first * share + (last - first) / 2 * share**2)))
    spectrum[0] = 0
    spectrum[-1] = 0
    return np.fft.irfft(spectrum, samples)


IMPEDANCE = (Signal("current", "A"), Signal("voltage", "V"))
SILENT = 1e-9  # share of the largest line of a period below which a line is rounding


@dataclass(frozen=True, slots=True)
class Bench:
    """Settings of the record.

    `sampling_rate` [Hz]; `samples` of one period; `periods`; standard deviations of noise
    `input_noise` and `output_noise` added to the recorded signals [their units]: white, that of
    the output of density (1 + (f/c)^2)^(-n/2), n = `noise_slope`, c = `noise_corner` [Hz] (n = 1:
    1/f above c, n = 2: white noise through a low-pass of first order); `quantum` = step of the
    sensor, to which the output is rounded (an encoder shows positions: use a position sensor) [unit
    of the output]; `friction` by mass, of a network by node; `seed` of phases and noise. An
    excitation that does not repeat is a single period with random phases.

    >>> Bench(sampling_rate=4000.0, quantum=6e-6).periods
    20
    """

    sampling_rate: float = 2500.0
    samples: int = 2500
    periods: int = 20
    input_noise: float = 0.0
    output_noise: float = 0.0
    noise_slope: float = 0.0
    noise_corner: float = 1.0
    quantum: float = 0.0
    friction: Mapping[int, Friction] = field(default_factory=dict)
    seed: int = 0

    def __post_init__(self) -> None:
        if not 0 < self.sampling_rate < np.inf or self.samples < 16 or self.periods < 1:
            raise InputError(
                "a bench has a positive sampling rate [Hz], periods of at least 16 samples, at"
                " least one period"
            )
        if not all(
            0 <= value < np.inf for value in (self.input_noise, self.output_noise, self.quantum)
        ):
            raise InputError("noise and quantum are finite and not negative")
        if not 0 <= self.noise_slope < np.inf or not 0 < self.noise_corner < np.inf:
            raise InputError("noise has a slope of at least 0 and a positive corner [Hz]")
        if self.seed < 0:
            raise InputError(f"a seed is a whole number of at least 0, not {self.seed}")


@np.errstate(over="ignore", invalid="ignore")  # what is not finite then is refused as no record
def as_excitation(excitation: Excitation | str | None) -> Excitation:
    """An excitation as it is or by its kind, the usual one for None; raises InputError."""
    if isinstance(excitation, Excitation):
        return excitation
    return Excitation() if excitation is None else Excitation(Kind(excitation))


@renamed(parameters="values")
def simulate(
    model: AnyModel,
    values: Mapping[str, float],
    excitation: Excitation | str | None = None,
    bench: Bench | None = None,
) -> TimeSeries:
    """Record of force and sensor of a model, of a circuit of current and voltage; `values` of its
    parameters by name in one system of units (SI); `excitation` also by its kind, such as "chirp".
    The same seed, the same record.

    Raises InputError for wrong parameters, an excitation beyond half the sampling rate, or one at
    an undamped resonance.

    >>> truth = {"m1": 0.01}
    >>> G = simulate(Chain(1, damped=False), truth).response().G
    >>> bool(abs(G - 100).max() < 1e-6)
    True
    """
    if isinstance(model, Network) and model.shape != (1, 1):
        raise InputError(
            f"{model.name} has several inputs or outputs: simulate_all records them all"
        )
    return _record(model, values, as_excitation(excitation), bench or Bench(), ())


def simulate_all(
    network: Network,
    parameters: Mapping[str, float],
    excitation: Excitation | None = None,
    bench: Bench | None = None,
) -> tuple[tuple[TimeSeries, ...], ...]:
    """Records of all sensors, a row each, of a network with several inputs or outputs, each of
    which is excited in turn (a column each): all sensors of a column record one experiment, with
    one recorded input. Raises InputError as `simulate`.

    >>> from disting.network import network_of
    >>> two = network_of("1=2; F1; S1; S2")
    >>> rows = simulate_all(two, {"m1": 1e-2, "m2": 1e-2, "k12": 500.0, "d12": 0.1})
    >>> len(rows), len(rows[0])
    (2, 1)
    """
    bench, excitation = bench or Bench(), excitation or Excitation()
    check_values(network, parameters)
    return tuple(
        tuple(
            _record(cell, parameters, excitation, replace(bench, seed=bench.seed + at), (row,))
            for at, cell in enumerate(cells)
        )
        for row, cells in enumerate(network.cells)
    )


def _record(
    model: AnyModel,
    parameters: Mapping[str, float],
    excitation: Excitation,
    bench: Bench,
    sensor: tuple[int, ...],
) -> TimeSeries:
    """One record; `sensor` separates the noise of several outputs of one experiment."""
    values = check_values(model, parameters)
    period = excitation.period(bench.samples, bench.sampling_rate, bench.seed)
    output = _output(model, values, period, bench)
    source = np.random.default_rng([bench.seed, 1])
    noise = source.standard_normal((2, bench.samples * bench.periods))
    if any(sensor):
        source = np.random.default_rng([bench.seed, 1, *sensor])
        noise[1] = source.standard_normal(noise.shape[1])
    coloured = _colour_noise(noise[1], bench, source) if bench.noise_slope else noise[1]
    recorded = output + bench.output_noise * coloured
    is_circuit = isinstance(model, Network) and model.sort is Sort.CIRCUIT
    signals = IMPEDANCE if is_circuit else (Signal("input"), Signal("output"))
    return TimeSeries(
        u=np.tile(period, bench.periods) + bench.input_noise * noise[0],
        y=np.round(recorded / bench.quantum) * bench.quantum if bench.quantum else recorded,
        sampling_rate=bench.sampling_rate,
        quantity=list(Quantity)[form_of(model).order],
        input=signals[0],
        output=signals[1],
        origin="simulation",
    )


def _output(model: AnyModel, values: Mapping[str, float], period: Real, bench: Bench) -> Real:
    """Sensor signal without noise, shape (samples * periods,)."""
    form = form_of(model)
    act, order = form.act, form.order
    omega = 2 * np.pi * np.arange(bench.samples // 2 + 1) * bench.sampling_rate / bench.samples
    force = _lines(period) * input_filter(model, values, omega)
    powers = dict(form.powers(values))
    if bench.friction:
        rubbed = _friction(model, form.nodes, bench.friction)
        m = matrices(model, values)
        m = m._replace(D=m.D + np.diag([kind.viscous for kind in rubbed]))
        powers = {2: m.M, 1: m.D, 0: m.K}
        if any(kind.coulomb for kind in rubbed):
            seconds = bench.samples / bench.sampling_rate
            whole = step(m, act, force, seconds, bench.samples, bench.periods, rubbed)
            return np.asarray(whole[order] @ form.meas)
    spectrum = np.zeros_like(force)
    used = np.flatnonzero(force)
    moved = motion(powers, act, omega[used]) @ form.meas
    spectrum[used] = (1j * omega[used]) ** order * moved * force[used]
    return np.tile(np.fft.irfft(spectrum, bench.samples), bench.periods)


def _friction(
    model: AnyModel, nodes: Sequence[int], friction: Mapping[int, Friction]
) -> list[Friction]:
    """The friction of each mass; raises InputError for one that is none."""
    if isinstance(model, Network) and model.sort is not Sort.MACHINE:
        raise InputError("friction is supported for machines only: remove it")
    if not set(friction) <= set(nodes):
        raise InputError(
            f"friction sits at masses {enumeration(map(str, nodes))}, not at {sorted(friction)}"
        )
    return [friction.get(node, Friction()) for node in nodes]


def _colour_noise(white: Real, bench: Bench, source: np.random.Generator) -> Real:
    """White noise, shape (n,), with the density of the bench and variance 1: half of a signal of
    twice its length, so that its end does not lead to its beginning.
    """
    whole = np.concatenate([white, source.standard_normal(len(white))])
    hertz = np.fft.rfftfreq(len(whole), 1 / bench.sampling_rate)
    gain = (1 + (hertz / bench.noise_corner) ** 2) ** (-bench.noise_slope / 4)
    gain[0] = 0.0
    shaped = np.fft.irfft(np.fft.rfft(whole) * gain, len(whole))
    return np.asarray(shaped[: len(white)] / np.sqrt(2 * np.sum(gain**2) / len(whole)))


def _lines(period: Real) -> Complex:
    """Spectrum of one period; lines that are rounding, 0 Hz and half the sampling rate are zero."""
    spectrum = np.fft.rfft(period)
    keep = np.abs(spectrum) > SILENT * np.max(np.abs(spectrum))
    keep[0] = False
    if len(period) % 2 == 0:
        keep[-1] = False
    return np.asarray(np.where(keep, spectrum, 0))


DEMO_MODEL = Chain(2, quantity=Quantity.POSITION, damped=True, ground_dampers=(1,), dead_time=True)
DEMO_PARAMETERS: Mapping[str, float] = MappingProxyType(
    {"m1": 0.0045, "m2": 0.005, "k12": 550.0, "d12": 0.08, "b1": 0.1, "Td": 3e-4}
)
DEMO_BENCH = Bench(input_noise=0.02, output_noise=2e-6, quantum=2 * np.pi / 2**20)


def demo(seed: int = 0) -> TimeSeries:
    """Record of a two-mass drive of the size of a small bench: motor current to motor angle,
    encoder of 20 bits, 20 periods.

    Inertias per torque constant 0.0045 and 0.005 A s^2/rad, antiresonance 53 Hz, resonance 77 Hz,
    dead time 0.3 ms; excited by a Schroeder multisine of 1 A (rms) from 10 to 250 Hz.
    `demo().response("acceleration")` is what a fit begins with. Raises InputError for a seed below
    0.

    >>> demo().input.unit, demo().output.unit
    ('A', 'rad')
    """
    series = simulate(DEMO_MODEL, DEMO_PARAMETERS, Excitation(), replace(DEMO_BENCH, seed=seed))
    return replace(series, input=Signal("motor current", "A"), output=Signal("motor angle", "rad"))
