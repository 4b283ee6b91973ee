"""Matrices, poles and zeros of a chain with numbers for its parameters, and what an engineer reads off them."""

from dataclasses import dataclass
from math import inf, pi

import numpy as np
from scipy.linalg import eig

from disting.fit.estimate import Task
from disting.fit.plant import Complex, Real
from disting.fit.practical import covariance
from disting.fit.select import Candidate
from disting.model.structure import Structure

REMOTE = 1e6  # zeros this much faster than the fastest pole are at infinity
INERTIA, STIFFNESS = "input per acceleration", "input per position"  # what the units of the data make of them
STEP = 1e-4  # of a logarithm, for derivatives of the results


def matrices(structure: Structure, p: Real) -> tuple[Real, Real, Real]:
    """M, D, K, shape (N, N), of A(s) = M s^2 + D s + K, from parameters in the order of `structure.parameters`."""
    n = structure.n_masses
    by_kind = {kind: np.zeros((n, n)) for kind in "mdk"}
    for element, value in zip(structure.elements, p, strict=False):
        v = np.zeros(n)
        if element.kind in "mb":
            v[element.at - 1] = 1.0
        else:
            v[element.at] = 1.0
            if element.at:
                v[element.at - 1] = -1.0
        by_kind["d" if element.kind == "b" else element.kind] += value * np.outer(v, v)
    return by_kind["m"], by_kind["d"], by_kind["k"]


def port(structure: Structure, minus: int, plus: int) -> Real:
    """Unit vector of a port, shape (N,)."""
    v = np.zeros(structure.n_masses + 1)
    v[plus] += 1.0
    v[minus] -= 1.0
    return v[1:]


def poles(structure: Structure, p: Real) -> Complex:
    """Roots of det A(s) [rad/s], shape (2 N,), the lag's pole not among them."""
    mass, damping, stiffness = matrices(structure, p)
    n = structure.n_masses
    inverse = 1.0 / np.diag(mass)[:, None]
    companion = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse * stiffness, -inverse * damping]])
    return np.asarray(np.linalg.eigvals(companion))


def zeros(structure: Structure, p: Real) -> Complex:
    """Zeros of the receptance [rad/s]: finite roots of the determinant of A(s) bordered by the two ports."""
    n, ports = structure.n_masses, structure.ports
    bordered = [np.pad(matrix, (0, 1)) for matrix in matrices(structure, p)]
    bordered[2][:n, n] = port(structure, ports.act_minus, ports.act_plus)
    bordered[2][n, :n] = port(structure, ports.meas_minus, ports.meas_plus)
    mass, damping, stiffness = bordered
    one, nothing = np.eye(n + 1), np.zeros((n + 1, n + 1))
    found = eig(np.block([[nothing, one], [-stiffness, -damping]]), np.block([[one, nothing], [nothing, mass]]), right=False)
    fastest = np.abs(poles(structure, p)).max()
    return np.asarray(found[np.isfinite(found) & (np.abs(found) < REMOTE * fastest)])


@dataclass(frozen=True)
class Result:
    """A physical result with its standard error, in `unit`."""

    name: str
    value: float
    standard_error: float
    unit: str


def physical(candidate: Candidate, task: Task) -> tuple[Result, ...]:
    """Inertias, stiffnesses, times, antiresonances and resonances [Hz] with damping ratios, each with its standard error.

    Errors are propagated by central differences from the covariance of the logarithms of the fitted parameters.
    """
    chain, names = candidate.chain, candidate.chain.parameters
    p = np.array([candidate.estimate.parameters[n] for n in names])
    free = task.box(names).free
    spread = covariance(task.cost.of(task.plant(chain), p)[1][:, free], candidate.j_train)
    centre = _values(chain.structure, p)
    slopes = np.zeros((len(centre), int(free.sum())))
    for column, i in enumerate(np.flatnonzero(free)):
        both = [_values(chain.structure, p * np.exp(sign * STEP * (np.arange(len(p)) == i))) for sign in (1, -1)]
        slopes[:, column] = [(a.value - b.value) / (2 * STEP) for a, b in zip(*both, strict=True)]
    errors = np.sqrt(np.einsum("ri,ij,rj->r", slopes, spread, slopes)) if np.isfinite(spread).all() else [inf] * len(centre)
    return tuple(Result(r.name, r.value, float(e), r.unit) for r, e in zip(centre, errors, strict=True))


def _values(structure: Structure, p: Real) -> list[Result]:
    """The results without errors; equally many for all parameters near by."""
    known = dict(zip(structure.parameters, map(float, p), strict=True))
    masses = {n: v for n, v in known.items() if n[0] == "m"}
    motor = masses[f"m{structure.ports.act_plus}"]
    rows = [("total inertia", sum(masses.values()), INERTIA)]
    if len(masses) > 1:
        rows += [("motor inertia", motor, INERTIA), ("load inertia", sum(masses.values()) - motor, INERTIA)]
    rows += [(f"stiffness {n}", v, STIFFNESS) for n, v in known.items() if n[0] == "k"]
    rows += [("dead time" if n == "Td" else "time constant of the lag", v, "s") for n, v in known.items() if n[0] == "T"]
    for what, roots in (("antiresonance", zeros(structure, p)), ("resonance", poles(structure, p))):
        for i, root in enumerate(oscillating(roots), 1):
            rows.append((f"{what} {i}", abs(root) / (2 * pi), "Hz"))
            rows.append((f"damping ratio of {what} {i}", -root.real / abs(root), ""))
    return [Result(name, value, 0.0, unit) for name, value, unit in rows]


def oscillating(roots: Complex) -> list[complex]:
    """One of each pair of conjugate roots, by rising frequency |s|."""
    return sorted((complex(r) for r in roots if r.imag > 1e-9 * abs(r)), key=abs)
