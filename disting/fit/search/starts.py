"""Structured starting points: what random ones, swarms and evolution strategies miss from three
masses on.

(a) Resonances and antiresonances of the data, mapped to masses and springs by the Cauer continued
fraction (force and sensor at the free end). (b) The growth ladder: the best fit with one mass
fewer, one mass split in two by a spring tuned to each frequency of a grid; or with one more pair
of pole and zero, see `pairs`. (c) The best fits of candidates with one element fewer. (d) A few
random points.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from hashlib import blake2b
from itertools import combinations
from math import log, sqrt

import numpy as np

from disting.errors import ConstraintViolation
from disting.fit.search.modes import from_modes
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.model.chain import Chain

Parameters = Mapping[str, float]
DAMPING_RATIO = 0.02  # of a spring's damper in a start
SHARES = (0.5, 0.15, 0.85)  # of the mass that is split off
GRID = 12  # frequencies of the ladder and of resonances that the data do not show
EXTRA = (1e-6, 0.1, 1.0)  # of its natural size, for an element that is added
SPREAD = 1.0  # standard deviation of the logarithms of random starts
PROMINENCE = 0.05  # of an extremum, in decades of the amplitude


@dataclass(frozen=True)
class Scale:
    """Natural sizes: mass = amplitude of inertia at low frequencies, band [rad/s], dead time
    [s].
    """

    mass: float
    low: float
    high: float
    delay: float

    def of(self, name: str, size: float) -> float:
        """Typical value of an element that is no mass; `size` is that of the spring in parallel
        with a damper, else the mass.
        """
        match name[0]:
            case "d":
                return 2 * DAMPING_RATIO * size / sqrt(self.low * self.high)
            case "b":
                return 0.1 * size * self.low
        return self.delay if name == "Td" else 0.2 / self.high


def scale(measured: FrequencyResponse) -> Scale:
    """Natural sizes of a measured response."""
    omega, order = measured.omega, measured.quantity.order
    inertia = omega ** (order - 2) / np.abs(measured.G)
    slope = -np.polyfit(omega, np.unwrap(np.angle(measured.G)), 1)[0]
    delay = float(np.clip(slope, 0.01 / omega[-1], 1.0 / omega[-1]))
    return Scale(
        float(np.median(inertia[: max(3, len(omega) // 8)])),
        float(omega[0]),
        float(omega[-1]),
        delay,
    )


def from_extrema(chain: Chain, measured: FrequencyResponse) -> Iterator[Parameters]:
    """Starts (a): N - 1 pairs of antiresonance and resonance, found or assumed; none where the
    ports are elsewhere.
    """
    if not is_seen_at_one_end(chain):
        return
    size = scale(measured)
    found, wanted = extrema(measured), chain.n_masses - 1
    supposed = [(w, 1.1 * w) for w in np.geomspace(0.6 * size.low, 1.5 * size.high, GRID)]
    for kept in range(min(len(found), wanted), max(min(len(found), wanted) - 2, -1), -1):
        for more in (
            combinations(supposed, wanted - kept)
            if wanted - kept <= 2
            else [tuple(supposed[-(wanted - kept) :])]
        ):
            masses, springs = cauer(size.mass, sorted([*found[:kept], *more]))
            if chain.act_plus != 1:
                masses, springs = masses[::-1], springs[::-1]
            if min([*masses, *springs], default=0.0) > 0:
                yield _fill_start(chain, size, masses, springs)


def at_modes(chain: Chain, measured: FrequencyResponse, sign: int) -> Iterator[Parameters]:
    """Starts (e): masses and springs that have the modes of the data, see `modes`."""
    size = scale(measured)
    for masses, springs, late in from_modes(chain, measured, sign):
        times = {"Td": late, "T1": late} if chain.lag != chain.dead_time else {}
        start = dict(_fill_start(chain, size, masses, springs))
        yield start | {name: times.get(name, late / 2) for name in ("T1", "Td") if name in start}


def is_seen_at_one_end(chain: Chain) -> bool:
    """Return True if force and sensor are the same end of a free chain: then poles and zeros fix
    masses and springs.
    """
    return (
        chain.collocated
        and chain.gap == 0
        and chain.act_minus == 0
        and chain.act_plus in (1, chain.n_masses)
    )


def extrema(measured: FrequencyResponse) -> list[tuple[float, float]]:
    """Pairs (antiresonance, next resonance) [rad/s] of the apparent inertia, the most prominent
    first.
    """
    level = np.log10(np.abs(measured.G)) + (2 - measured.quantity.order) * np.log10(measured.omega)
    highs, lows = peaks(level), peaks(-level)
    pairs = []
    for at, size in highs:
        before = [(i, p) for i, p in lows if i < at]
        if before:
            pairs.append((size + before[-1][1], measured.omega[before[-1][0]], measured.omega[at]))
    return [(float(z), float(p)) for _, z, p in sorted(pairs, reverse=True)]


def peaks(level: Real) -> list[tuple[int, float]]:
    """Indices of the local maxima of a curve, shape (n,), with a prominence of at least PROMINENCE,
    and their prominences: the smaller of the descents to the left and to the right, each up to the
    next higher point. Of equal neighbours the middle one counts. scipy.signal finds the same, but
    its import takes as long as everything else that a fit imports.

    >>> peaks(np.array([0.0, 2.0, 2.0, 2.0, 1.0, 3.0, 0.0]))
    [(2, 1.0), (5, 3.0)]
    """
    changes = np.flatnonzero(level[1:] != level[:-1])
    firsts, lasts = np.append(0, changes + 1), np.append(changes, len(level) - 1)
    runs = level[firsts]
    found = list[tuple[int, float]]()
    for k in np.flatnonzero((runs[1:-1] > runs[:-2]) & (runs[1:-1] > runs[2:])) + 1:
        at = int(firsts[k] + lasts[k]) // 2
        higher = np.flatnonzero(level > level[at])
        below = int(np.searchsorted(higher, at))
        left = higher[below - 1] + 1 if below else 0
        right = higher[below] if below < len(higher) else len(level)
        prominence = float(level[at] - max(level[left : at + 1].min(), level[at:right].min()))
        if prominence >= PROMINENCE:
            found.append((at, prominence))
    return found


def cauer(total: float, pairs: Sequence[tuple[float, float]]) -> tuple[list[float], list[float]]:
    """Masses and springs of the undamped free chain, driven and measured at mass 1, from its total
    mass and (z_i, p_i) [rad/s].

    With x = s^2: 1/H = total x prod(1 + x/p_i^2) / prod(1 + x/z_i^2) = m1 x + 1/(1/k12 + 1/(m2 x +
    ...)); elements are positive exactly if z_1 < p_1 < z_2 < ..., which other pairs violate.
    """
    denominator, numerator = np.array([total, 0.0]), np.array([1.0])
    for zero, pole in pairs:
        denominator = np.convolve(denominator, [1 / pole**2, 1.0])
        numerator = np.convolve(numerator, [1 / zero**2, 1.0])
    masses, springs = [denominator[0] / numerator[0]], []
    while len(numerator) > 1:
        rest = (denominator - masses[-1] * np.append(numerator, 0.0))[1:]
        springs.append(rest[0] / numerator[0])
        numerator, denominator = (numerator - rest / springs[-1])[1:], rest
        masses.append(denominator[0] / numerator[0])
    return masses, springs


def merge(chain: Chain) -> Iterator[tuple[int, Chain]]:
    """Yield every chain with one mass fewer, and the joint j whose masses j, j+1 it has as one."""
    for joint in range(1, chain.n_masses):
        if joint != chain.gap:

            def moved(i: int, joint: int = joint) -> int:
                """Number of a mass after the joint became rigid."""
                return i - (i > joint)

            dampers = tuple(sorted({moved(i) for i in chain.ground_dampers}))
            try:
                other = replace(
                    chain,
                    n_masses=chain.n_masses - 1,
                    gap=moved(chain.gap),
                    act_minus=moved(chain.act_minus),
                    act_plus=moved(chain.act_plus),
                    meas_minus=moved(chain.meas_minus),
                    meas_plus=moved(chain.meas_plus),
                    ground_dampers=dampers,
                )
            except ConstraintViolation:
                continue
            yield joint, other


def split(chain: Chain, joint: int, fewer: Parameters, size: Scale) -> Iterator[Parameters]:
    """Starts (b): mass `joint` of the fit `fewer` split by a spring tuned to each frequency of
    a grid.
    """
    names, whole = chain.parameters, fewer[f"m{joint}"]
    kept = {_renumber(name, joint): value for name, value in fewer.items()}
    spring = next(n for n in names if n[0] == "k" and _left_number(n) == joint)
    for share in SHARES:
        parts = {f"m{joint}": (1 - share) * whole, f"m{joint + 1}": share * whole}
        reduced = share * (1 - share) * whole
        for omega in np.geomspace(0.7 * size.low, 1.3 * size.high, GRID):
            start = kept | parts | {spring: reduced * float(omega) ** 2}
            both = [n for n in (f"b{joint}", f"b{joint + 1}") if n in names]
            damper = fewer.get(f"b{joint}", 0.0)
            start |= {name: damper / len(both) for name in both}
            yield _complete_start(names, start, size)


def _renumber(name: str, joint: int) -> str:
    """Name of an element behind the joint after the split: numbers grow by one; joints are
    named by both neighbours.
    """
    if name[0] == "T":
        return name
    left = _left_number(name)
    if name[0] in "mb":
        return f"{name[0]}{left + (left > joint)}"
    left += left >= joint
    return f"{name[0]}{left}{left + 1}" if left < 9 else f"{name[0]}{left}_{left + 1}"


def _left_number(name: str) -> int:
    """Number of a mass or of a joint's left neighbour."""
    digits = name[1:].split("_")[0]
    return int(digits) if name[0] in "mb" or "_" in name else int(digits[0])


def extend(
    chain: Chain, fewer: Parameters, size: Scale, factors: Iterable[float] = EXTRA
) -> Iterator[Parameters]:
    """Starts (c): the fit of a candidate with elements fewer, the missing ones at several
    shares of their natural sizes.
    """
    missing = [n for n in chain.parameters if n not in fewer]
    natural = _complete_start(chain.parameters, fewer, size)
    for factor in factors:
        yield natural | {name: factor * natural[name] for name in missing}


def bare(chain: Chain) -> Chain:
    """Masses, springs with their dampers, and ports alone."""
    return replace(chain, ground_dampers=(), lag=False, dead_time=False, gap_damper=False)


def shorten(chain: Chain) -> Iterator[Chain]:
    """Yield every candidate with one ground damper, the lag or the dead time removed."""
    if chain.gap_damper:
        yield replace(chain, gap_damper=False)
    for at in chain.ground_dampers:
        yield replace(chain, ground_dampers=tuple(i for i in chain.ground_dampers if i != at))
    if chain.lag:
        yield replace(chain, lag=False)
    if chain.dead_time:
        yield replace(chain, dead_time=False)


def random(chain: Chain, size: Scale, seed: str, count: int) -> Iterator[Parameters]:
    """Starts (d): logarithms spread around natural sizes; determined by the seed and the chain."""
    source = np.random.default_rng(
        int.from_bytes(blake2b(f"{seed}:{chain}".encode(), digest_size=8).digest())
    )
    n = chain.n_masses
    for _ in range(count):
        omegas = np.exp(source.uniform(log(size.low), log(size.high), n))
        shares = source.dirichlet(np.ones(n))
        natural = _fill_start(
            chain, size, size.mass * shares, (size.mass * omegas**2 / n)[: n - (chain.gap == 0)]
        )
        yield {
            name: value * float(np.exp(SPREAD * source.normal())) for name, value in natural.items()
        }


def _fill_start(
    chain: Chain, size: Scale, masses: Sequence[float] | Real, springs: Sequence[float] | Real
) -> Parameters:
    """A start from masses and springs in their order, the rest at natural sizes."""
    kinds = {kind: [n for n in chain.parameters if n[0] == kind] for kind in "mk"}
    values = dict(zip(kinds["m"], map(float, masses), strict=True)) | dict(
        zip(kinds["k"], map(float, springs), strict=False)
    )
    return _complete_start(chain.parameters, values, size)


def _complete_start(names: Sequence[str], entries: Parameters, size: Scale) -> dict[str, float]:
    """All parameters; dampers in parallel with springs follow the springs."""
    values = dict(entries)
    for name in names:
        if name not in values and "k" + name[1:] in values and name[0] == "d":
            values[name] = size.of(name, values["k" + name[1:]])
        elif name not in values:  # a damper across the gap is like one to the ground
            values[name] = size.of(name.replace("d", "b"), size.mass)
    return {name: values[name] for name in names}


def stack(starts: Sequence[Parameters], names: Sequence[str]) -> Real:
    """Array of shape (n_s, n_p)."""
    return np.array([[start[name] for name in names] for start in starts]).reshape(
        len(starts), len(names)
    )


def natural(chain: Chain, size: Scale) -> Parameters:
    """Natural sizes of all parameters: equal masses, resonances in the middle of the band."""
    share = size.mass / chain.n_masses
    return _fill_start(
        chain, size, [share] * chain.n_masses, [share * size.low * size.high] * chain.n_masses
    )
