"""Periodic test signals: multisines with Schroeder or random phases, of equal or given amplitudes,
and a repeated linear chirp.
"""

import csv
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

import numpy as np

from disting.errors import InputError, short
from disting.files import read_bounded
from disting.measurement.arrays import Real

Lines = np.ndarray[tuple[int], np.dtype[np.intp]]
HEADER = ("frequency_hz", "amplitude")


class Kind(StrEnum):
    """How the lines of one period are chosen.

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
            f"{path} is no spectrum: a CSV file with the columns {' and '.join(HEADER)} is needed"
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
