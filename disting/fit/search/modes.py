"""Starts from the modes that the data show: natural frequencies and the share of each at the
sensor, without a search.

The response of force and sensor at one place is, times a power of s, H = sum share_r s^2 / (s^2 + 2
zeta_r omega_r s + omega_r^2) with positive shares. Its poles are found by vector fitting (Gustavsen
and Semlyen 1999): linear least squares, the poles of the next round are the zeros of a common
denominator. Poles beyond those of the modes take up dead time, lag and friction; at its pole the
residue of a mode still has the size share omega / 2. So neither valleys nor lines that lie on the
wrong side of a resonance are in the way, as they are for a search.

Frequencies and shares are those of one chain (Lanczos). Of a machine with a gap, force and sensor
across it, the response is the sum of those of both sides, so that each choice of modes for the
side on the ground, an elastic base for instance, is a start.
"""

from collections.abc import Iterator
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain

ROUNDS = 8  # of vector fitting: poles stand still after fewer
MORE = (1, 3)  # pairs of poles beyond those of the modes
SHARPEST = 1e-6  # damping ratio of any: no pole lies on a line
LIGHT = 0.5  # damping ratio up to which a pole is that of a mode
OTHERS = 3  # modes that are tried as the last
RATIO = 0.01  # damping ratio that poles start with
MARGIN = 2.0  # how far beyond the lines a mode may lie
DELAYS = 60  # dead times that are tried, of a phase of up to
MOST_PHASE = 6.0  # radians at the last line


def is_across(chain: Chain) -> bool:
    """Return True if force and sensor are at one end of a free chain, or between the ends of two
    chains, one of them grounded: then the modes fix masses and springs.

    >>> is_across(Chain(3)), is_across(Chain(3, 1, 1, 2, 1, 2)), is_across(Chain(3, meas_plus=3))
    (True, True, False)
    """
    if not chain.collocated or chain.act_minus != chain.gap:
        return False
    return chain.act_plus in (chain.gap + 1, chain.n_masses)


def from_modes(
    chain: Chain, measured: FrequencyResponse, sign: int
) -> Iterator[tuple[list[float], list[float], float]]:
    """Yield masses and springs in their order, and the dead time [s] that the phase shows in
    addition; nothing where the data show fewer modes than the chain has.
    """
    wanted = chain.n_masses - 1
    if not wanted or not is_across(chain):
        return
    s = np.asarray(1j * measured.omega, dtype=np.complex128)
    inertance = np.asarray(sign * measured.G * s ** (2 - measured.quantity.order), np.complex128)
    rigid = 1 / float(np.median(1 / np.abs(inertance[: max(3, len(s) // 8)])))
    for more in MORE:
        for omegas, shares in modes(s, inertance, wanted, wanted + more):
            if not shares.min() > 0:
                continue
            delay = _delay(s, inertance, omegas, shares, rigid)
            for base in combinations(range(wanted), chain.gap):
                grounded = np.isin(np.arange(wanted), base)
                masses, springs = _across(omegas**2, shares, rigid, grounded, chain)
                if all(0 < value < np.inf for value in (*masses, *springs)):
                    yield masses, springs, delay


def _across(
    squares: Real, shares: Real, rigid: float, grounded: NDArray[np.bool_], chain: Chain
) -> tuple[list[float], list[float]]:
    """Masses and springs of both sides of the gap, those modes on the ground."""
    left: tuple[list[float], list[float]] = [], []
    if chain.gap:
        left = row(squares[grounded], shares[grounded])
    free = ~grounded
    masses, springs = row(np.append(0.0, squares[free]), np.append(rigid, shares[free]))
    springs = springs[:-1]  # to the ground
    if chain.act_plus != chain.gap + 1:
        masses, springs = masses[::-1], springs[::-1]
    return [*left[0][::-1], *masses], [*left[1][::-1], *springs]


def modes(s: Complex, inertance: Complex, count: int, pairs: int) -> Iterator[tuple[Real, Real]]:
    """Natural frequencies [rad/s] and shares [1/kg] of so many modes, in rising order, from a fit
    with so many pairs of poles: the modes that show most, then those with another one for the last
    of them; none where the data show fewer.
    """
    low, high = abs(s[0]), abs(s[-1])
    start = np.geomspace(1.2 * low, high / 1.2, pairs)
    poles = start * (1j - RATIO)
    weights = 1 / np.abs(inertance)
    for _ in range(ROUNDS):
        basis = _basis(s, poles)
        both = np.column_stack([basis, np.ones_like(s), -inertance[:, None] * basis])
        solved = _least_squares(both, inertance, weights)
        poles = _zeros(poles, solved[basis.shape[1] + 1 :])
    basis = np.column_stack([_basis(s, poles), np.ones_like(s)])
    solved = _least_squares(basis, inertance, weights)
    residues = _residues(poles, solved)
    omega = np.abs(poles)
    near = np.abs(np.interp(omega, np.abs(s), np.abs(inertance)))
    shown = np.abs(residues) / omega / near
    is_mode = (poles.imag > 0) & (-poles.real < LIGHT * omega)
    is_mode &= (omega > low / MARGIN) & (omega < MARGIN * high)
    best = [int(i) for i in np.argsort(-shown, kind="stable") if is_mode[i]]
    for last in best[count - 1 : count - 1 + OTHERS]:
        chosen = sorted([*best[: count - 1], last], key=lambda i: omega[i])
        yield omega[chosen], 2 * np.abs(residues[chosen]) / omega[chosen]


def row(squares: Real, shares: Real) -> tuple[list[float], list[float]]:
    """Masses and springs of the undamped chain with these squares of natural frequencies and these
    shares, from the mass that is driven and measured; the last spring holds it to the ground, and
    is zero for a free chain.

    >>> row(np.array([18.0]), np.array([0.5]))
    ([2.0], [36.0])
    """
    vector, before, beta = np.sqrt(shares / shares.sum()), np.zeros(len(shares)), 0.0
    masses, springs, spring = [float(1 / shares.sum())], list[float](), 0.0
    for _ in range(len(shares)):
        alpha = float(vector @ (squares * vector))
        spring = alpha * masses[-1] - spring
        springs.append(spring)
        if len(masses) == len(shares):
            break
        rest = squares * vector - alpha * vector - beta * before
        beta = float(np.linalg.norm(rest))
        before, vector = vector, rest / beta
        masses.append(spring**2 / (beta**2 * masses[-1]))
    return masses, springs


def _basis(s: Complex, poles: Complex) -> Complex:
    """Partial fractions with real coefficients, shape (n_f, n): two of a pair, which is written as
    the one above the axis, one of a real pole.
    """
    columns = []
    for pole in poles:
        first = 1 / (s - pole)
        if pole.imag:
            second = 1 / (s - pole.conjugate())
            columns += [first + second, 1j * (first - second)]
        else:
            columns.append(first)
    return np.column_stack(columns)


def _least_squares(columns: Complex, target: Complex, weights: Real) -> Real:
    weighted, wanted = columns * weights[:, None], target * weights
    rows = np.vstack([weighted.real, weighted.imag])
    size = np.linalg.norm(rows, axis=0)
    size[size == 0] = 1.0
    solved = np.linalg.lstsq(rows / size, np.concatenate([wanted.real, wanted.imag]))[0]
    return np.asarray(solved / size)


def _zeros(poles: Complex, coefficients: Real) -> Complex:
    """Zeros of 1 + the sum of partial fractions, those on or right of the axis mirrored."""
    n = len(coefficients)
    matrix, entry, at = np.zeros((n, n)), np.zeros(n), 0
    for pole in poles:
        if pole.imag:
            matrix[at : at + 2, at : at + 2] = [[pole.real, pole.imag], [-pole.imag, pole.real]]
            entry[at], at = 2.0, at + 2
        else:
            matrix[at, at], entry[at], at = pole.real, 1.0, at + 1
    zeros = np.linalg.eigvals(matrix - np.outer(entry, coefficients)).astype(complex)
    zeros = zeros[zeros.imag >= 0]
    return np.asarray(-np.maximum(np.abs(zeros.real), SHARPEST * np.abs(zeros)) + 1j * zeros.imag)


def _residues(poles: Complex, coefficients: Real) -> Complex:
    residues, at = np.zeros(len(poles), complex), 0
    for i, pole in enumerate(poles):
        if pole.imag:
            residues[i], at = coefficients[at] + 1j * coefficients[at + 1], at + 2
        else:
            residues[i], at = coefficients[at], at + 1
    return residues


def _delay(s: Complex, inertance: Complex, omegas: Real, shares: Real, rigid: float) -> float:
    """The dead time that turns the phase of these modes most nearly into that of the data."""
    parts = s[:, None] ** 2 / (s[:, None] ** 2 + 2 * RATIO * omegas * s[:, None] + omegas**2)
    ratio = inertance / (rigid + parts @ shares)
    tried = np.linspace(0.0, MOST_PHASE, DELAYS) / abs(s[-1])
    fits = (np.exp(tried[:, None] * s) * (ratio / np.abs(ratio))).real.sum(axis=1)
    return float(max(tried[int(np.argmax(fits))], tried[1] / 2))
