"""Whether the first of two periods holds a transient.

What repeats is not in the difference of two periods: noise of both is, and a transient, which
decays. The difference is cut into parts, each under a Hann window, as it may jump at its ends, and
the power of each octave in the first part is compared with that in the second half. Noise has the
same power everywhere, a transient most at first. One that is too small to be seen is covered by the
scatter: it shifts the mean of both periods by half of its spectrum, which is the standard deviation
that two periods show at that line.

The ratio of both powers of noise has the F distribution with nu and PARTS / 2 nu degrees of
freedom. Noise of the spectrum P has nu = 2 / 1.5 (sum P)^2 / sum P^2 in a part (Welch and
Satterthwaite; 1.5 is the noise bandwidth of the window in lines).
"""

import numpy as np

from disting.measurement.arrays import Real

PARTS = 8
LEVEL = 0.01  # of a false alarm, over all octaves: it drops a period that could be kept
BANDWIDTH = 1.5  # of noise, of a Hann window [lines]
FEWEST = 4  # lines of a part, below which it has no octaves


def holds_transient(first: Real, second: Real) -> bool:
    """Return True if the first of two periods, shape (N,), differs from the second one by what
    decays; also for periods too short to show it.

    >>> time = np.arange(1000)
    >>> noise = np.random.default_rng(0).normal(size=(2, 1000))
    >>> holds_transient(*noise), holds_transient(noise[0] + 5 * np.exp(-time / 100), noise[1])
    (False, True)
    """
    from scipy.stats import f

    d = _level(first - second)
    size = len(d) // PARTS
    window = np.hanning(size + 1)[:-1]
    power = np.abs(np.fft.rfft(d[: PARTS * size].reshape(PARTS, size) * window, axis=1)) ** 2
    octaves = _octaves(power.shape[1])
    if not octaves:
        return True
    tests = [_test(power[:, low:high]) for low, high in octaves]
    return any(r > f.isf(LEVEL / len(tests), nu, PARTS / 2 * nu) for r, nu in tests)


def _level(d: Real) -> Real:
    """The difference without its constant part and slope, which are a trend's."""
    time = np.linspace(-1.0, 1.0, len(d))
    return np.asarray(d - d.mean() - time * (time @ d) / (time @ time))


def _octaves(count: int) -> list[tuple[int, int]]:
    """First line and the one after the last of octaves, from the highest one downwards."""
    edges = [count] if count > FEWEST else []
    while edges and edges[-1] > 1:
        edges.append(edges[-1] // 2)
    return list(zip(edges[1:], edges, strict=False))


def _test(power: Real) -> tuple[float, float]:
    """Power of the first part over the mean of the second half, shape (PARTS, lines), and the
    degrees of freedom of one part; 0 where there is no power.
    """
    rest = power[PARTS // 2 :].mean(axis=0)
    if not np.any(rest):
        return 0.0, 1.0
    nu = 2 / BANDWIDTH * rest.sum() ** 2 / (rest**2).sum()
    return float(power[0].sum() / rest.sum()), max(float(nu), 1.0)
