"""Where the power of an excitation has to go, for a rival to be excluded with the least of it.

Shares w_k >= 0 of the power, in all 1, of n_f lines: a line of amplitude a_k scatters by rho_k
proportional to 1/a_k, so that

    lambda(w) = min over p of sum_k w_k psi_k(p),    psi_k(p) = n_f |G_B(p)/G_A - 1|_k^2 / rho_k^2

with rho_k of a spectrum whose lines are all alike. It is concave in w. The T-optimal spectrum
(Atkinson and Fedorov, 1975) has the largest one, and there all psi_k(p) are at most lambda. Every p
cuts: lambda(w) <= sum_k w_k psi_k(p) for all w. The spectrum that is best under the cuts found so
far (a linear programme, by HiGHS), the rival's best fit to it, which is a new cut, and so on in
turn (J. Kelley, The cutting-plane method for solving convex programs, 1960), taken half way to
the best spectrum so far (W. Ben-Ameur, J. Neto, Acceleration of cutting-plane and column
generation algorithms, 2007), until the upper bound is met.

The bound holds whatever the search of the rival's parameters misses; what it misses makes the
spectrum found look better than it is, so the rival is searched again, from all starts, at the end.

What to excite: bands and spectra in addition to the planned lines, as an excitation that can be
run.

A bench limits the power of an excitation, or its largest value. The peak of a multisine is its root
mean square times its crest factor; so at an equal peak the noncentrality of a spectrum is that at
an equal power times the squared ratio of the crest factors.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import combinations
from math import ceil
from typing import Any

import numpy as np
from scipy.optimize import linprog

from disting.fit.search.descent import fine
from disting.fit.search.estimate import different
from disting.fit.search.joint import AnyCost
from disting.measurement.arrays import Real
from disting.model.presentation import plural, summary
from disting.planning.power import Answer, Plan, plan_to_dict
from disting.planning.rival import Rival, box_of, relative_distance, reweight
from disting.simulation import Excitation

CLOSE = 1e-3  # relative distance of the bound at which a spectrum is optimal
ENOUGH = 1e-6  # relative gain of a fit at which its cut is sharp enough
TINY = 1e-9  # of the mean of the cuts
STEPS = 200  # cuts, at most
BASINS = 3  # of the rival's earlier fits, from which the next one begins
EDGES = 11  # of the bands that are tried, evenly on a logarithmic scale
ANEW = 3  # searches from all starts, at most
VANISHING = 1e-3  # of the power: what a line is not given
KEPT = 0.1  # of the power, which all lines share alike in a spectrum to be run


@dataclass(frozen=True, slots=True, eq=False)
class Spectrum:
    """Shares of the power, shape (n_f,), in all 1, and lambda of them; `bound` = what no spectrum
    of this power exceeds.
    """

    shares: Real
    noncentrality: float
    bound: float

    @property
    def lines(self) -> int:
        """Number of lines that have power."""
        return int(np.count_nonzero(self.shares))


@dataclass(frozen=True, slots=True)
class Band:
    """Frequencies [Hz] whose lines share the power alike, and lambda of them."""

    low: float
    high: float
    noncentrality: float


@dataclass(frozen=True, eq=False)
class Adversary:
    """The rival's best fits to weighted lines. `cuts` are psi_k of all fits, and `points` their
    parameters, which later fits begin from.
    """

    rival: Rival
    points: list[Real] = field(default_factory=list)
    cuts: list[Real] = field(default_factory=list)

    def __post_init__(self) -> None:
        if not self.points:
            self.add(self.rival.best.p)

    def add(self, p: Real) -> None:
        """One more fit."""
        values = len(self.rival.rho) * (relative_distance(self.rival, p) / self.rival.rho) ** 2
        self.points.append(p)
        self.cuts.append(values)

    def bound(self, shares: Real) -> float:
        """Upper bound of lambda for these shares, from the fits so far."""
        return float(min(cut @ shares for cut in self.cuts))

    def noncentrality(self, shares: Real) -> float:
        """lambda, from the nearest fits so far."""
        plant, cost = self.rival.plant, self._cost(shares)
        sizes = np.array([cut @ shares for cut in self.cuts])
        box = box_of(plant)
        ends = [fine(plant, cost, box, self.points[i], ENOUGH) for i in different(sizes, BASINS)]
        self.add(min(ends, key=lambda end: end[1])[0])
        return self.bound(shares)

    def searched(self, shares: Real) -> float:
        """lambda, from all starts."""
        self.add(self.rival.search.again(self._cost(shares)).p)
        return self.bound(shares)

    def _cost(self, shares: Real) -> AnyCost:
        return reweight(self.rival, np.sqrt(len(shares) * np.maximum(shares, 0.0)))


def optimal(adversary: Adversary) -> Spectrum:
    """The T-optimal spectrum."""
    count = len(adversary.rival.rho)
    best, size, bound = np.full(count, 1.0 / count), 0.0, np.inf
    for _ in range(ANEW):
        size = adversary.searched(best)
        best, size, bound = _improve_spectrum(adversary, best, size)
        best = _drop_idle(best)
        size = adversary.searched(best)
        if size * (1 + 2 * CLOSE) >= bound:
            break
    return Spectrum(best, size, max(bound, size))


def runnable(adversary: Adversary, best: Spectrum) -> Spectrum:
    """The optimal spectrum with a tenth of the power on all lines alike: as lambda is concave, it
    has nine tenths of the optimal one at least, and shows what neither structure foresees.
    """
    count = len(best.shares)
    shares = (1 - KEPT) * best.shares + KEPT / count
    return Spectrum(shares, adversary.searched(shares), best.bound)


def _improve_spectrum(adversary: Adversary, best: Real, size: float) -> tuple[Real, float, float]:
    """Spectrum, its lambda and the bound, after cuts until both meet."""
    bound = np.inf
    for _ in range(STEPS):
        corner, bound = _programme(np.array(adversary.cuts))
        size = adversary.bound(best)  # later fits may have lowered it
        if bound <= size * (1 + CLOSE):
            break
        tried = (corner + best) / 2
        reached = adversary.noncentrality(tried)
        if reached > size:
            best, size = tried, reached
    return best, size, bound


def _programme(cuts: Real) -> tuple[Real, float]:
    """The shares w that are best under the cuts, shape (n_c, n_f): max t with t <= cuts w; of cuts
    of very different sizes, at which the simplex method may give up, by an interior point.
    """
    n_c, n_f = cuts.shape
    scale = float(cuts.mean())
    scaled = np.maximum(cuts / scale, TINY)  # raised, so that the bound stays one
    for method in ("highs", "highs-ipm"):
        result = linprog(
            np.append(np.zeros(n_f), -1.0),
            A_ub=np.hstack([-scaled, np.ones((n_c, 1))]),
            b_ub=np.zeros(n_c),
            A_eq=np.append(np.ones(n_f), 0.0)[None, :],
            b_eq=[1.0],
            bounds=(0, None),
            method=method,
        )
        if result.x is not None:
            return np.maximum(result.x[:-1], 0.0), float(-result.fun) * scale
    return _loose(cuts)


def _loose(cuts: Real) -> tuple[Real, float]:
    """A bound that holds as well: no spectrum does better under one cut than all on its best line,
    and this for the lowest such cut.
    """
    lowest = cuts[int(cuts.max(axis=1).argmin())]
    return np.eye(cuts.shape[1])[int(lowest.argmax())], float(lowest.max())


def _drop_idle(shares: Real) -> Real:
    """Without lines that have next to nothing."""
    kept = np.where(shares >= VANISHING, shares, 0.0)
    return np.asarray(kept / kept.sum())


def best_band(adversary: Adversary) -> Band:
    """The band, of those between a few frequencies of the lines, whose lines share the power
    best.

    One that an earlier fit of the rival already bounds below the best one is not fitted.
    """
    hertz = adversary.rival.hertz
    every = [(band, _alike(hertz, band)) for band in _bands(hertz)]
    every.sort(key=lambda pair: -adversary.bound(pair[1]))
    best, size = every[0][0], -1.0
    for band, shares in every:
        if adversary.bound(shares) > size:
            value = adversary.noncentrality(shares)
            if value > size:
                best, size = band, value
    size = adversary.searched(_alike(hertz, best))
    return Band(*best, size)


def _bands(hertz: Real) -> Iterator[tuple[float, float]]:
    """Lowest and highest line of bands of at least eight lines."""
    edges = np.unique(np.searchsorted(hertz, np.geomspace(hertz[0], hertz[-1], EDGES)))
    last = np.minimum(edges, len(hertz) - 1)
    for i, j in combinations(last, 2):
        if j - i >= 7:
            yield float(hertz[i]), float(hertz[j])


def _alike(hertz: Real, band: tuple[float, float]) -> Real:
    """Equal shares of the lines of a band."""
    inside = (hertz >= band[0]) & (hertz <= band[1])
    return np.asarray(inside / inside.sum())


OVERSAMPLED = 5.0  # sampling rate, in highest frequencies
RESOLVED = 20  # lines of the bench below the lowest planned one


@dataclass(frozen=True, slots=True, eq=False)
class Design:
    """The best band, the optimal spectrum, and the one to be run, on lines [Hz]."""

    hertz: Real
    band: Band
    optimum: Spectrum
    run: Spectrum

    def __repr__(self) -> str:
        return summary(
            self,
            f"{plural(len(self.hertz), 'line')}, {self.hertz[0]:.4g} to {self.hertz[-1]:.4g} Hz",
        )

    @property
    def rate(self) -> float:
        """Sampling rate [Hz] at which the spectrum can be run."""
        return float(ceil(OVERSAMPLED * self.hertz[-1]))

    @property
    def samples(self) -> int:
        """Of a period."""
        return 2 * ceil(self.rate * RESOLVED / float(self.hertz[0]) / 2)

    def excitation(self, shares: Real) -> Excitation:
        """The multisine of a spectrum, root mean square 1."""
        amplitudes = np.sqrt(shares / shares.max())
        pairs = zip(self.hertz.tolist(), amplitudes.tolist(), strict=True)
        return Excitation(spectrum=tuple((f, a) for f, a in pairs if a > 0))

    def crest(self, shares: Real) -> float:
        """Crest factor of its multisine."""
        return float(np.abs(self.excitation(shares).period(self.samples, self.rate)).max())

    @property
    def crests(self) -> tuple[float, float]:
        """Crest factors of equal lines and of the spectrum to be run."""
        alike = np.full(len(self.hertz), 1.0 / len(self.hertz))
        return self.crest(alike), self.crest(self.run.shares)

    @property
    def at_equal_peak(self) -> float:
        """Noncentrality of the spectrum to be run whose peak, not power, is that of equal lines."""
        before, after = self.crests
        return self.run.noncentrality * (before / after) ** 2


def design(plan: Plan) -> Design | None:
    """Band and spectra against a rival; None where no effort is enough."""
    if plan.rival is None or plan.answer is Answer.SAME:
        return None
    adversary = Adversary(plan.rival)
    band = best_band(adversary)
    best = optimal(adversary)
    return Design(plan.rival.hertz, band, best, runnable(adversary, best))


def designed_to_dict(plan: Plan, best: Design | None) -> dict[str, Any]:
    """Plain data of a plan with its spectra; `shares` of the power by line."""
    plain = plan_to_dict(plan)
    if best is None:
        return plain
    return plain | {
        "band": _size_plan(plan, best.band.noncentrality)
        | {"low": best.band.low, "high": best.band.high},
        "optimal": _size_plan(plan, best.optimum.noncentrality)
        | {"bound": best.optimum.bound, "lines": best.optimum.lines},
        "run": _size_plan(plan, best.run.noncentrality)
        | {
            "noncentrality_at_equal_peak": best.at_equal_peak,
            "crest_factors": list(best.crests),
            "rate": best.rate,
            "samples": best.samples,
        },
        "frequency": best.hertz.tolist(),
        "shares_optimal": best.optimum.shares.tolist(),
        "shares_run": best.run.shares.tolist(),
    }


def _size_plan(plan: Plan, noncentrality: float) -> dict[str, float]:
    return {
        "noncentrality": noncentrality,
        "power": plan.power_at(noncentrality),
        "factor": plan.needed / noncentrality,
    }
