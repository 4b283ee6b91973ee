"""Frequency response of a chain and its derivatives by all parameters: two tridiagonal solves a
frequency, for any size.

With A(s) = M s^2 + D s + K, A x = e_act, A y = e_sens and c = s^n exp(-s Td) / (1 + s T1), n = 0,
1, 2 for a position, velocity or acceleration sensor:

    G = c e_sens' x,                          dG/dTd = -s G,      dG/dT1 = -s G / (1 + s T1),
    dG/dm_i = -c s^2 x_i y_i,                 dG/db_i = -c s x_i y_i,
    dG/dk_ij = -c (x_i - x_j)(y_i - y_j),     dG/dd_ij = s dG/dk_ij.

A is symmetric (reciprocity), so the adjoint solution y turns every derivative into a product of
two numbers; where force and sensor sit at the same place, y = x. Everything is vectorised over
frequencies and over parameter vectors.

A locked mass has x_i = y_i = 0: its row and column of A are those of the identity, and nothing acts
on it; what is added to mass i, such as a known inertia J s^2, is a term of A_ii. All formulas above
hold for both.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from disting.errors import InputError
from disting.measurement.arrays import Complex, Real
from disting.measurement.observation import Observation
from disting.model.chain import Ports, Structure

Rows = slice | NDArray[np.intp]
ROUNDING = 2.0**-52


class Differentiable(Protocol):
    """Source of a response and its derivatives: one plant, or several."""

    def response(self, p: Real, /) -> Complex:
        """G(j omega), shape (..., n_f), of parameter vectors `p`, shape (..., n_p)."""

    def logarithmic_gradient(self, p: Real, /) -> tuple[Complex, Complex]:
        """G, shape (..., n_f), and d ln G / d p, shape (..., n_p, n_f)."""


@dataclass(frozen=True, eq=False)
class Plant:
    """A chain's structure at angular frequencies `omega` [rad/s], shape (n_f,); `sign` = -1 for
    a reversed sensor.

    `still`: masses that are locked; `added`: (mass, power of s, size) of what is known.
    `observation`: how lines show the response; `aside`: s = (j + aside) omega instead of j omega.

    >>> from disting import Chain
    >>> plant = Plant(Chain(1, damped=False).structure, np.array([1.0, 2.0]))
    >>> plant.parameters, plant.response(np.array([2.0])).real.tolist()
    (('m1',), [0.5, 0.5])
    """

    structure: Structure
    omega: Real
    sign: int = 1
    still: tuple[int, ...] = ()
    added: tuple[tuple[int, int, float], ...] = ()
    observation: Observation | None = None
    aside: float = 0.0

    def __post_init__(self) -> None:
        if self.sign not in (1, -1):
            raise InputError(f"the sign of a sensor is 1 or -1, not {self.sign!r}")

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names in the order of the last axis of a parameter array: m.., k.., d.., b.., T1, Td."""
        return self.structure.parameters

    def at(self, omega: Real, which: int = 0) -> "Plant":
        """The same plant at other angular frequencies; there is one response."""
        return replace(self, omega=omega)

    @np.errstate(all="ignore")  # where an interval has no end, values may overflow
    def motion(self, p: Real) -> "Motion":
        """Motion caused by the force; any sensor on the same machine at the same lines measures a
        part of it.
        """
        ports, pivots = self.structure.ports, self._pivots(p)
        return Motion(*pivots, _solve_motion(*pivots, ports.act_minus, ports.act_plus, self.still))

    def response(self, p: Real, motion: "Motion | None" = None) -> Complex:
        """G(j omega), shape (..., n_f), of parameter vectors `p`, shape (..., n_p), in one
        system of units; `motion` where it is known.
        """
        ports, x = self.structure.ports, (motion or self.motion(p)).x
        return self._observe(self._factor(p) * _difference(x, ports.meas_minus, ports.meas_plus))

    @np.errstate(all="ignore")
    def logarithmic_gradient(
        self, p: Real, motion: "Motion | None" = None
    ) -> tuple[Complex, Complex]:
        """G, shape (..., n_f), and d ln G / d p, shape (..., n_p, n_f)."""
        ports, s, unit = self.structure.ports, self._s, motion or self.motion(p)
        x = unit.x
        y = x if self._is_collocated else unit.adjoint(ports, self.still)
        receptance = _difference(x, ports.meas_minus, ports.meas_plus)
        scaled = x / -receptance[..., None, :]
        gradient = np.empty((*p.shape, s.size), dtype=np.complex128)
        moved = scaled[..., 1:, :] * y[..., 1:, :]
        np.multiply(moved, self._s2, out=gradient[..., self._slices["m"], :])
        if "b" in self._rows:
            np.multiply(moved[..., self._rows["b"], :], s, out=gradient[..., self._slices["b"], :])
        if "k" in self._rows:
            stretched = _steps(scaled) * _steps(y)
            gradient[..., self._slices["k"], :] = stretched[..., self._rows["k"], :]
            if "d" in self._rows:
                np.multiply(
                    stretched[..., self._rows["d"], :], s, out=gradient[..., self._slices["d"], :]
                )
        if self.structure.lag:
            gradient[..., self._lag_at, :] = -s / (1 + s * p[..., self._lag_at, None])
        if self.structure.dead_time:
            gradient[..., -1, :] = -s
        return self._shown_with(self._factor(p) * receptance, gradient)

    def _observe(self, response: Complex) -> Complex:
        """Observed values, shape (..., n_f), of responses, shape (..., n)."""
        if self.observation is None:
            return response
        rows = response.reshape(-1, response.shape[-1])
        return np.asarray((self._seen[1] @ rows.T).T.reshape(*response.shape[:-1], -1))

    def _shown_with(self, response: Complex, gradient: Complex) -> tuple[Complex, Complex]:
        """The same with d ln G / d p, shape (..., n_p, n)."""
        if self.observation is None:
            return response, gradient
        whole = self._observe(response)
        slope = self._observe(response[..., None, :] * gradient)
        return whole, np.asarray(slope / whole[..., None, :])

    def _factor(self, p: Real) -> Complex:
        """c of the module's formula, shape (..., n_f)."""
        factor = self._front
        if self.structure.dead_time:
            factor = factor * np.exp(-self._s * p[..., -1, None])
        if self.structure.lag:
            factor = factor / (1 + self._s * p[..., self._lag_at, None])
        return factor

    def _pivots(self, p: Real) -> tuple[Complex, Complex]:
        """Couplings c_j = k_j + s d_j of the joints 0..N-1 and the pivots of A, eliminated from
        the last mass to the first.
        """
        s, n = self._s, self.structure.n_masses
        coupling = np.zeros((*p.shape[:-1], n, s.size), dtype=np.complex128)
        for kind in ("k", "d"):
            if kind in self._rows:
                values = p[..., self._slices[kind], None]
                coupling[..., self._rows[kind], :] += values if kind == "k" else values * s
        pivots: Complex = p[..., self._slices["m"], None] * self._s2
        for at, power, size in self.added:
            pivots[..., at - 1, :] += size * s**power
        if "b" in self._rows:
            pivots[..., self._rows["b"], :] += p[..., self._slices["b"], None] * s
        pivots += coupling
        pivots[..., :-1, :] += coupling[..., 1:, :]
        for at in self.still:
            coupling[..., at - 1 : at + 1, :] = 0.0
            pivots[..., at - 1, :] = 1.0
        for i in range(n - 1, 0, -1):
            pivot = pivots[..., i, :]
            if not pivot.all():  # without damping a line may meet an antiresonance exactly
                pivot += (pivot == 0) * (ROUNDING * p[..., i, None] * self._s2)
            pivots[..., i - 1, :] -= coupling[..., i, :] ** 2 / pivot
        if not pivots[..., 0, :].all():  # nor an undamped resonance
            pivots[..., 0, :] += (pivots[..., 0, :] == 0) * (ROUNDING * p[..., 0, None] * self._s2)
        return coupling, pivots

    @cached_property
    def _s(self) -> Complex:
        omega = self.omega if self.observation is None else self._seen[0]
        return np.asarray((1j + self.aside) * omega, dtype=np.complex128)

    @cached_property
    def _seen(self) -> tuple[Complex, csr_array]:
        assert self.observation is not None
        return self.observation.weights(self.omega, self.structure.sensor_order)

    @cached_property
    def _s2(self) -> Complex:
        return self._s * self._s

    @cached_property
    def _front(self) -> Complex:
        return self.sign * self._s**self.structure.sensor_order

    @cached_property
    def _is_collocated(self) -> bool:
        ports = self.structure.ports
        return (ports.act_minus, ports.act_plus) == (ports.meas_minus, ports.meas_plus)

    @cached_property
    def _lag_at(self) -> int:
        return len(self.parameters) - 1 - self.structure.dead_time

    @cached_property
    def _slices(self) -> dict[str, slice]:
        """Places of the parameters of each kind of element in a parameter vector."""
        kinds = [e.kind for e in self.structure.elements]
        return {
            kind: slice(kinds.index(kind), kinds.index(kind) + kinds.count(kind))
            for kind in set(kinds)
        }

    @cached_property
    def _rows(self) -> dict[str, Rows]:
        """Indices of the joints (springs, dampers) or masses (ground dampers, from 0) of the
        parameters.
        """
        places: dict[str, list[int]] = {}
        for element in self.structure.elements:
            places.setdefault(element.kind, []).append(element.at - (element.kind in "mb"))
        return {kind: _rows(at) for kind, at in places.items()}


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Couplings and pivots of A, and the displacements of ground and masses under the force."""

    coupling: Complex
    pivots: Complex
    x: Complex

    def adjoint(self, ports: Ports, still: tuple[int, ...]) -> Complex:
        """Displacements under a force at the sensor, y of the module's formulas."""
        return _solve_motion(self.coupling, self.pivots, ports.meas_minus, ports.meas_plus, still)


def _rows(at: list[int]) -> Rows:
    """A slice where the places follow each other: numpy then copies nothing."""
    return (
        slice(at[0], at[-1] + 1)
        if at == list(range(at[0], at[-1] + 1))
        else np.array(at, dtype=np.intp)
    )


def _solve_motion(
    coupling: Complex, pivots: Complex, minus: int, plus: int, still: tuple[int, ...]
) -> Complex:
    """Displacements of ground and masses, shape (..., 1 + N, n_f), for a unit force on `plus`
    against `minus`.
    """
    n = pivots.shape[-2]
    x = np.zeros((*pivots.shape[:-2], n + 1, pivots.shape[-1]), dtype=np.complex128)
    x[..., plus, :] += 1.0
    x[..., minus, :] -= 1.0
    for at in (0, *still):
        x[..., at, :] = 0.0
    for i in range(max(plus, minus), 1, -1):
        x[..., i - 1, :] += coupling[..., i - 1, :] * x[..., i, :] / pivots[..., i - 1, :]
    x[..., 1, :] /= pivots[..., 0, :]
    for i in range(2, n + 1):
        x[..., i, :] += coupling[..., i - 1, :] * x[..., i - 1, :]
        x[..., i, :] /= pivots[..., i - 1, :]
    return x


def _difference(x: Complex, minus: int, plus: int) -> Complex:
    return x[..., plus, :] - x[..., minus, :] if minus else x[..., plus, :]


def _steps(x: Complex) -> Complex:
    """x_j - x_{j+1} over the joints 0..N-1."""
    return x[..., :-1, :] - x[..., 1:, :]
