"""Candidates that differ by one step, and the fit of one as a start of the other.

A search from the data alone may end in a valley where one element does the work of another: a
damper at the wrong mass, a dead time for a lag, a small mass tuned to one line. The fit of a
neighbour often lies in the better one.

One more pair of pole and zero: the fit with one mass fewer, as a chain with one mass more that
behaves almost alike.

A mode that the data hardly show is a pole close to a zero. Splitting one mass in two moves all
other modes, so that the search loses what the smaller fit had; here they stay where they are. The
undamped fit's poles and zeros, with a pair added at a frequency, are realised as a chain by the
Cauer continued fraction, which is unique. It exists where force and sensor are the same end of the
chain. Frequencies: those at which the smaller fit misses the data most, and a grid.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import inf

import numpy as np
from scipy.linalg import eigvalsh_tridiagonal

from disting.fit.search.starts import (
    GRID,
    Parameters,
    Scale,
    cauer,
    extend,
    is_seen_at_one_end,
    shorten,
    split,
)
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain

ADDED = (0.1, 1.0)  # of its natural size, for an element that the neighbour lacks
CENTRES = 240  # lines that are tried as frequency of a pair, at most
TOGETHER = 1_000_000  # centres times lines that are held at once
SHARP = (0.003, 0.02)  # damping ratios of such a pair
PAIRS = 4  # frequencies that are taken
CLOSE = (1e-3, 3e-3, 3e-2)  # relative distance of pole and zero there,
WIDE = (0.1,)  # and on the grid
# of the largest mass: what is smaller has run away and has no frequency of its own
SMALLEST = 1e-12


def neighbours(chain: Chain) -> Iterator[Chain]:
    """Yield the candidates with one element fewer or more, a ground damper at another mass, the
    lag for the dead time.
    """
    yield from shorten(chain)
    dampers = set(chain.ground_dampers)
    free = [i for i in range(1, chain.n_masses + 1) if i not in dampers]
    for at in free:
        yield replace(chain, ground_dampers=tuple(sorted(dampers | {at})))
        for other in chain.ground_dampers:
            yield replace(chain, ground_dampers=tuple(sorted((dampers | {at}) - {other})))
    if chain.gap and not chain.gap_damper:
        yield replace(chain, gap_damper=True)
    if not chain.lag:
        yield replace(chain, lag=True)
    if not chain.dead_time:
        yield replace(chain, dead_time=True)
    if chain.lag != chain.dead_time:
        yield replace(chain, lag=chain.dead_time, dead_time=chain.lag)


def carry_over(chain: Chain, fit: Parameters, size: Scale) -> Iterator[Parameters]:
    """Starts from the fit of another candidate: what it has too much hands its value over to an
    element of its kind that is missing, or is left out; what is missing then is added.
    """
    missing = [name for name in chain.parameters if name not in fit]
    surplus = [name for name in fit if name not in chain.parameters]
    values = {name: fit[name] for name in chain.parameters if name in fit}
    for kind in {name[0] for name in missing}:  # a lag takes the value of a dead time
        wanted, spare = ([n for n in names if n[0] == kind] for names in (missing, surplus))
        values |= {new: fit[old] for new, old in zip(wanted, spare, strict=False)}
    if len(values) == len(chain.parameters):
        yield {name: values[name] for name in chain.parameters}
    else:
        yield from extend(chain, values, size, ADDED)


def split_starts(
    chain: Chain, joint: int, fewer: Parameters, size: Scale, missed: Sequence[float]
) -> Iterator[Parameters]:
    """Starts of a chain from the fit `fewer`, which has masses `joint` and `joint` + 1 as one;
    `missed` [rad/s].
    """
    if not is_seen_at_one_end(chain):
        return
    rest = next(split(chain, joint, fewer, size))
    masses, springs = (
        np.array([v for name, v in fewer.items() if name[0] == kind]) for kind in "mk"
    )
    if masses.min() < SMALLEST * masses.max():
        return
    order = 1 if chain.act_plus == 1 else -1
    poles, zeros = _undamped_modes(masses[::order], springs[::order])
    softness = (
        sum(v for name, v in fewer.items() if name[0] == "d") / springs.sum()
        if springs.size
        else 0.0
    )
    grid = np.geomspace(0.7 * size.low, 1.3 * size.high, GRID)
    for omegas, distances in ((missed, CLOSE), (grid, WIDE)):
        for omega in omegas:
            for distance in distances:
                with np.errstate(all="ignore"):
                    more = cauer(
                        float(masses.sum()), _with_pair(poles, zeros, float(omega), distance)
                    )
                if all(0 < value < inf for part in more for value in part):
                    yield {
                        **rest,
                        **_name_values(chain, rest, more[0][::order], more[1][::order], softness),
                    }


def _name_values(
    chain: Chain,
    rest: Parameters,
    masses: Sequence[float],
    springs: Sequence[float],
    softness: float,
) -> Parameters:
    """Masses, springs and dampers in parallel: for the springs as in the smaller fit, or as in
    `rest` where that has none.
    """
    values = dict(
        zip((name for name in chain.parameters if name[0] == "m"), map(float, masses), strict=True)
    )
    values |= dict(
        zip((name for name in chain.parameters if name[0] == "k"), map(float, springs), strict=True)
    )
    for name in chain.parameters:
        if name[0] == "d":
            spring = "k" + name[1:]
            values[name] = values[spring] * (softness or rest[name] / rest[spring])
    return values


def _undamped_modes(masses: Real, springs: Real) -> tuple[Real, Real]:
    """Poles but the one of the free motion, and zeros [rad/s] of the undamped free chain, driven
    and measured at its first mass.
    """
    stiffness = np.append(springs, 0.0) + np.append(0.0, springs)
    diagonal, beside = stiffness / masses, -springs / np.sqrt(masses[:-1] * masses[1:])
    if len(masses) == 1:
        return beside, beside
    poles, zeros = (np.sqrt(np.abs(eigvalsh_tridiagonal(diagonal[i:], beside[i:]))) for i in (0, 1))
    return poles[1:], zeros


def _with_pair(
    poles: Real, zeros: Real, omega: float, distance: float
) -> list[tuple[float, float]]:
    """Pairs (zero, pole) with one more at a frequency, in the order that the others require: z_1 <
    p_1 < z_2 < ...
    """
    below, above = omega * (1 - distance / 2), omega * (1 + distance / 2)
    zero, pole = (
        (below, above) if np.sum(zeros < omega) == np.sum(poles < omega) else (above, below)
    )
    return list(
        zip(sorted([*map(float, zeros), zero]), sorted([*map(float, poles), pole]), strict=True)
    )


def conspicuous(measured: FrequencyResponse, response: Complex) -> list[float]:
    """Angular frequencies at which one more resonance would explain most of what the response of a
    fit misses.

    A pole near a zero adds about a h to ln G, h = 1/(1 - x^2 + 2 j zeta x), x = omega/omega_0; with
    the best complex a it takes |h'e|^2 / h'h from |e|^2, e = ln(G_M/G). The highest maxima over the
    lines, for the better of two damping ratios.
    """
    ratio = measured.G / response
    missed = np.log(np.abs(ratio)) + 1j * np.angle(ratio)
    centres = measured.omega[:: -(-len(measured.omega) // CENTRES)]
    parts = np.array_split(centres, -(-len(centres) * len(missed) // TOGETHER))
    gains = [_explained_part(missed, measured.omega / part[:, None]) for part in parts]
    gain = np.concatenate([[0.0], *gains, [0.0]])
    peaks = np.flatnonzero((gain[1:-1] > gain[:-2]) & (gain[1:-1] >= gain[2:]))
    return [float(centres[i]) for i in peaks[np.argsort(-gain[1 + peaks], kind="stable")[:PAIRS]]]


def _explained_part(missed: Complex, x: Real) -> Real:
    """|h'e|^2 / h'h of e = `missed` at x = omega/omega_0, shape (centres, lines), for the better
    of two damping ratios.
    """
    shapes = (1 / (1 - x**2 + 2j * zeta * x) for zeta in SHARP)
    gains = [
        np.abs(h.conj() @ missed) ** 2 / np.einsum("cf,cf->c", h, h.conj()).real for h in shapes
    ]
    return np.asarray(np.max(gains, axis=0))
