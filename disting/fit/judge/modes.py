"""Poles and zeros of a chain with numbers for its parameters, and what an engineer reads off
them.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from math import pi

import numpy as np
from scipy.linalg import eig

from disting.fit.judge.candidate import Candidate
from disting.fit.search.estimate import Task
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Structure
from disting.simulation import matrices, port_vectors
from disting.statistics.practical import standard_errors

# of the fastest root: rounding spreads the double pole of a free chain at zero this far
STILL = 1e-6
REMOTE = 1e6  # zeros this much faster than the fastest pole are at infinity
REMEMBERED = 100  # structures, each asked about at many parameters
STEP = 1e-4  # of a logarithm, for derivatives of the results


def poles(structure: Structure, p: Real) -> Complex:
    """Roots of det A(s) [rad/s], shape (2 N,), the lag's pole not among them. Raises ValueError for
    p of another length.

    >>> from disting import Chain
    >>> drive = Chain(2, damped=False).structure
    >>> sorted(poles(drive, np.array([1.0, 1.0, 2.0])).imag.round(6))[-1]  # sqrt(k (1/m1 + 1/m2))
    np.float64(2.0)
    """
    mass, damping, stiffness = _matrices(structure, p)
    n = structure.n_masses
    inverse = 1.0 / np.diag(mass)[:, None]
    companion = np.block(
        [[np.zeros((n, n)), np.eye(n)], [-inverse * stiffness, -inverse * damping]]
    )
    return np.asarray(np.linalg.eigvals(companion))


def zeros(structure: Structure, p: Real) -> Complex:
    """Zeros of the receptance [rad/s]: finite roots of the determinant of A(s) bordered by the two
    ports. Raises ValueError for p of another length.

    >>> from disting import Chain
    >>> drive = Chain(2, damped=False).structure
    >>> sorted(zeros(drive, np.array([1.0, 1.0, 4.0])).imag.round(6))[-1]  # sqrt(k / m2)
    np.float64(2.0)
    """
    n = structure.n_masses
    bordered = np.pad(_matrices(structure, p), ((0, 0), (0, 1), (0, 1)))
    bordered[2][:n, n], bordered[2][n, :n] = port_vectors(structure)
    mass, damping, stiffness = bordered
    identity, nothing = np.eye(n + 1), np.zeros((n + 1, n + 1))
    eigenvalues = eig(
        np.block([[nothing, identity], [-stiffness, -damping]]),
        np.block([[identity, nothing], [nothing, mass]]),
        right=False,
    )
    fastest = np.abs(poles(structure, p)).max()
    return np.asarray(
        eigenvalues[np.isfinite(eigenvalues) & (np.abs(eigenvalues) < REMOTE * fastest)]
    )


@dataclass(frozen=True)
class Result:
    """A physical result with its standard error; `unit` is empty where it follows from the
    units of the data, or is 1.
    """

    name: str
    value: float
    standard_error: float
    unit: str


def physical(candidate: Candidate, task: Task) -> tuple[Result, ...]:
    """Inertias, stiffnesses, times, antiresonances and resonances [Hz] with damping ratios, each
    with its standard error.

    Errors are propagated by central differences from the covariance of the logarithms of the
    fitted parameters; a result may be determined although the parameters are not, such as the
    total inertia of an unidentifiable chain.
    """
    chain, names = candidate.chain, task.names(candidate.chain)
    p = np.array([candidate.estimate.parameters[n] for n in names])
    free = task.box(names).free
    centre = _values(chain.structure, p)
    if not free.any():
        return tuple(centre)  # given, not estimated
    columns = task.cost.of(task.plant(chain), p)[1][:, free]
    slopes = np.zeros((len(centre), int(free.sum())))
    for column, i in enumerate(np.flatnonzero(free)):
        both = [
            _values(chain.structure, p * np.exp(sign * STEP * (np.arange(len(p)) == i)))
            for sign in (1, -1)
        ]
        slopes[:, column] = [(a.value - b.value) / (2 * STEP) for a, b in zip(*both, strict=True)]
    errors = standard_errors(slopes, columns, candidate.noise, candidate.practical.rank)
    return tuple(
        Result(r.name, r.value, float(e), r.unit) for r, e in zip(centre, errors, strict=True)
    )


def _values(structure: Structure, p: Real) -> list[Result]:
    """The results without errors; equally many for all parameters near by."""
    p = p[: len(structure.parameters)]
    values = _name_values(structure, p)
    masses = {n: v for n, v in values.items() if n[0] == "m"}
    motor = masses[f"m{structure.ports.act_plus}"]
    rows = [("total inertia", sum(masses.values()), "")]
    if len(masses) > 1:
        rows += [("motor inertia", motor, ""), ("load inertia", sum(masses.values()) - motor, "")]
    rows += [(f"stiffness {n}", v, "") for n, v in values.items() if n[0] == "k"]
    rows += [
        ("dead time" if n == "Td" else "time constant of the lag", v, "s")
        for n, v in values.items()
        if n[0] == "T"
    ]
    for what, roots in (("antiresonance", zeros(structure, p)), ("resonance", poles(structure, p))):
        for i, root in enumerate(oscillations(roots), 1):
            rows.append((f"{what} {i}", abs(root) / (2 * pi), "Hz"))
            rows.append((f"damping ratio of {what} {i}", 0.0 - root.real / abs(root), ""))
    return [Result(name, value, 0.0, unit) for name, value, unit in rows]


def _matrices(structure: Structure, p: Real) -> Real:
    """M, D, K at once, shape (3, N, N)."""
    return np.tensordot(p, _shares(structure), 1)


@lru_cache(maxsize=REMEMBERED)
def _shares(structure: Structure) -> Real:
    """Contributions of each parameter at 1 to M, D and K, shape (n_p, 3, N, N)."""
    ones = dict.fromkeys(structure.parameters, 1.0)
    whole = np.stack(matrices(structure, ones))
    doubled = (matrices(structure, {**ones, name: 2.0}) for name in structure.parameters)
    return np.stack([np.stack(more) - whole for more in doubled])


def _name_values(structure: Structure, p: Real) -> dict[str, float]:
    return dict(zip(structure.parameters, map(float, p), strict=True))


def oscillations(roots: Complex) -> list[complex]:
    """One of each pair of conjugate roots, by rising frequency |s|; the motion as one rigid
    body is none.
    """
    fastest = max((abs(r) for r in roots), default=0.0)
    return sorted(
        (complex(r) for r in roots if r.imag > 1e-9 * abs(r) and abs(r) > STILL * fastest), key=abs
    )


def between_lines(
    structure: Structure, values: Mapping[str, float], grid: Real
) -> Iterator[tuple[float, float]]:
    """Yield resonance and antiresonance [Hz] that lie between the same two of the measured lines
    `grid` [Hz], both narrower than these are apart: nearly the same response without both.

    >>> from disting import Chain
    >>> added = {"m1": 1.0, "m2": 1e-6, "k12": 0.04, "d12": 1e-9}
    >>> [*between_lines(Chain(2).structure, added, np.arange(1.0, 60.0))][0][0].round(2)
    np.float64(31.83)
    >>> [*between_lines(Chain(2).structure, {**added, "m2": 0.5}, np.arange(1.0, 60.0))]
    []
    """
    p = np.array([values[name] for name in structure.parameters])
    pairs = [oscillations(roots(structure, p)) for roots in (poles, zeros)]
    for pole, zero in product(*pairs):
        hertz = np.array([pole.imag, zero.imag]) / (2 * pi)
        before, other = np.searchsorted(grid, hertz)
        if before == other and 0 < before < len(grid):
            # the width at half power is twice the real part
            width = 2 * max(abs(pole.real), abs(zero.real)) / (2 * pi)
            if width < grid[before] - grid[before - 1]:
                yield hertz[0], hertz[1]
