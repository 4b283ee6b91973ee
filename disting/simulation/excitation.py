"""Periodic test signals: multisines with Schroeder or random phases, and a repeated linear
chirp.
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from disting.errors import InputError, shown
from disting.measurement.arrays import Real


class Kind(StrEnum):
    """How the lines of one period are chosen."""

    SCHROEDER = "schroeder"
    RANDOM_PHASE = "random-phase"
    CHIRP = "chirp"


@dataclass(frozen=True, slots=True)
class Excitation:
    """Signal between `low` and `high` [Hz] with root mean square `rms` [unit of the input];
    `every` = step between its lines.

    Schroeder multisine: equal amplitudes, phases -pi i (i - 1) / F of lines i = 1..F (Schroeder
    1970), low crest factor; random phases: uniform in 0..2 pi; chirp: one sweep of rising
    frequency a period (`every` has no meaning there).
    """

    kind: Kind = Kind.SCHROEDER
    low: float = 10.0
    high: float = 250.0
    rms: float = 1.0
    every: int = 1

    def __post_init__(self) -> None:
        if not 0 < self.low < self.high < np.inf or not 0 < self.rms < np.inf or self.every < 1:
            raise InputError("an excitation has 0 < low < high [Hz], a positive rms and every >= 1")
        try:
            object.__setattr__(self, "kind", Kind(self.kind))
        except ValueError:
            raise InputError(
                f"the excitation is one of {', '.join(Kind)}, not {shown(self.kind)}"
            ) from None

    def lines(self, samples: int, rate: float) -> np.ndarray[tuple[int], np.dtype[np.intp]]:
        """Numbers of the lines within the band, multiples of rate/samples [Hz]."""
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
            spectrum = np.zeros(samples // 2 + 1, dtype=complex)
            spectrum[lines] = np.exp(1j * self._phases(len(lines), seed))
            signal = np.fft.irfft(spectrum, samples)
        return np.asarray(signal * (self.rms / np.sqrt(np.mean(signal**2))))

    def _phases(self, count: int, seed: int) -> Real:
        if self.kind is Kind.RANDOM_PHASE:
            return np.random.default_rng(seed).uniform(0.0, 2 * np.pi, count)
        numbers = np.arange(1, count + 1)
        return np.asarray(-np.pi * numbers * (numbers - 1) / count)


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
