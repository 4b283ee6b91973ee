"""Frequency response of a network and its derivatives by all parameters: two solutions of one
matrix a frequency.

With P x = b, P^T y = c and G = s^q c^T x, for a term f(p) s^r u v^T of P, f = p or 1/p:

    dG/dp = -s^q s^r f'(p) (y.u) (v.x),
    dG/dn = -s^q s^r ln(s) f (y.u) (v.x)                  for r = n of a constant phase element,
    dG/dg = -s^q s^r f ((y.u') (v.x) + (y.u) (v'.x))    for the ratio g of a gear, u' = du/dg.

Everything is vectorised over frequencies and over parameter vectors.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Sort
from disting.network.network import Element, Network, Port

Entries = Mapping[int, Fraction | str | int]
"""Of a vector, by nodes; a text denotes minus a parameter."""
Sized = Mapping[int, float | str]
"""The same in floating point."""
RATIOS = 3.0  # of gears: starts lie within this factor of 1
LEAST_EXPONENT = 0.5  # of starts: between a Warburg element and a capacitor
SPREAD = 3.0  # of other values, around their size
SMALL = 1e-13  # of the largest entry of P: what keeps an undamped one from being singular


@dataclass(frozen=True, eq=False)
class NetworkPlant:
    """A network with one input and one output at angular frequencies `omega` [rad/s], (n_f,).

    `breadth` h: at s = j omega (1 - j h) instead, where resonances are as broad as if they had a
    damping ratio of about h: a start for the search, since an undamped resonance has no effect from
    afar.
    """

    network: Network
    omega: Real
    breadth: float = 0.0

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """Those that enter, values and ratios, then exponents, each sorted: names in the order of
        the last axis of a parameter array.
        """
        every = (*self.network.parameters, *self.network.exponents)
        return tuple(p for p in every if p not in self.network.unseen)

    @cached_property
    def highest(self) -> Real:
        """Upper bounds of the parameters, (n_p,): 1 of exponents."""
        exponents = self.network.exponents
        return np.array([1.0 if name in exponents else np.inf for name in self.parameters])

    def response(self, p: Real) -> Complex:
        """G(j omega), shape (..., n_f), of parameter vectors `p`, shape (..., n_p)."""
        x = _solve_moved(self._matrix(p), self._input)
        return np.asarray(self._front * (x @ self._output))

    def logarithmic_gradient(self, p: Real) -> tuple[Complex, Complex]:
        """G, shape (..., n_f), and d ln G / d p, shape (..., n_p, n_f)."""
        matrix = self._matrix(p)
        x = _solve_moved(matrix, self._input)
        y = _solve_moved(matrix.swapaxes(-1, -2), self._output)
        whole = x @ self._output
        # where G is too small for a number its logarithm is taken as constant
        share = np.divide(1, whole, out=np.zeros_like(whole), where=whole != 0)
        gradient = np.zeros((*p.shape, self.omega.size), dtype=np.complex128)
        for e, pulls, feels in self._terms:
            power = self._power(e, p)
            felt, pulled = self._project(feels, x, p), self._project(pulls, y, p)
            if e.value:
                at = self._at[e.value]
                slope = -1 / p[..., at, None] ** 2 if e.kind.divides else 1.0
                moved = power * pulled * felt * share
                gradient[..., at, :] -= slope * moved
                if e.exponent:
                    sizes = p[..., at, None] * np.log(self._s)
                    gradient[..., self._at[e.exponent], :] -= sizes * moved
            if e.ratio and e.known_ratio is None:
                size = p[..., self._at[e.value], None] * power
                moved = -(x[..., e.nodes[1] - 1] * pulled + y[..., e.nodes[1] - 1] * felt)
                gradient[..., self._at[e.ratio], :] -= size * moved * share
        return np.asarray(self._front * whole), gradient

    def _matrix(self, p: Real) -> Complex:
        """P, shape (..., n_f, n, n)."""
        size = len(self._plain.nodes)
        values = np.zeros((*p.shape[:-1], self.omega.size, size, size), dtype=np.complex128)
        for e, pulls, feels in self._terms:
            value = p[..., self._at[e.value], None] if e.value else np.ones(1)
            term = self._power(e, p) * (1 / value if e.kind.divides else value)
            for i, u in pulls.items():
                for j, v in feels.items():
                    values[..., i - 1, j - 1] += term * (self._size(u, p) * self._size(v, p))
        return values

    def _project(self, side: Sized, z: Complex, p: Real) -> Complex:
        """v.x or u.y, shape (..., n_f)."""
        return np.asarray(sum(self._size(w, p) * z[..., i - 1] for i, w in side.items()))

    def _size(self, entry: float | str, p: Real) -> Real | float:
        """An entry of u or v: a number, or minus a ratio."""
        return np.asarray(-p[..., self._at[entry], None]) if isinstance(entry, str) else entry

    def _power(self, e: Element, p: Real) -> Complex:
        """s^r, shape (..., n_f)."""
        if e.exponent:
            return np.asarray(self._s ** p[..., self._at[e.exponent], None])
        return self._powers[e.kind.halves]

    @cached_property
    def _powers(self) -> dict[int, Complex]:
        """s^r by 2 r."""
        halves = {e.kind.halves for e in self._plain.elements}
        return {h: np.asarray(self._s ** (h / 2)) for h in halves}

    @cached_property
    def _terms(self) -> tuple[tuple[Element, Sized, Sized], ...]:
        """The elements with u and v over the unknowns."""
        sides = (
            (e, self._place_entries(e.pulls), self._place_entries(e.feels))
            for e in self._plain.elements
        )
        return tuple((e, _size_entries(pulls), _size_entries(feels)) for e, pulls, feels in sides)

    @cached_property
    def _plain(self) -> Network:
        return self.network.grounded

    @cached_property
    def _reference(self) -> int:
        """The node whose potential is zero: the other end of the sensor, so that what it shows is
        one unknown; a small difference of two large ones would be lost in rounding. Gears and flows
        feel more than differences: there it is the ground.
        """
        (sensor,) = self._plain.outputs
        more = self.network.is_directed or any(e.ratio for e in self._plain.elements)
        return sensor.minus if sensor.plus and not more else 0

    def _place_entries(self, side: Entries) -> Entries:
        """A vector u, v, b or c over the unknowns, of which the ground takes the place of the
        reference.
        """
        if not self._reference:
            return side
        entries = {i: Fraction(x) for i, x in side.items()}
        entries |= {self._reference: -sum(entries.values(), Fraction())}
        return {i: x for i, x in entries.items() if x}

    @cached_property
    def _at(self) -> dict[str, int]:
        return {name: i for i, name in enumerate(self.parameters)}

    @cached_property
    def _s(self) -> Complex:
        return np.asarray((1j + self.breadth) * self.omega, dtype=np.complex128)

    @cached_property
    def _front(self) -> Complex:
        return np.asarray(self._s**self.network.order)

    @cached_property
    def _input(self) -> Complex:
        return self._vector(self._plain.inputs[0])

    @cached_property
    def _output(self) -> Complex:
        return self._vector(self._plain.outputs[0])

    def _vector(self, port: Port) -> Complex:
        values = np.zeros(len(self._plain.nodes), dtype=np.complex128)
        for i, x in self._place_entries(port.ends).items():
            values[i - 1] = float(x)
        return values


@dataclass(frozen=True, eq=False)
class NetworkPlants:
    """A network with several inputs and outputs: all its responses, one behind the other, row by
    row, each at its own angular frequencies [rad/s]; `breadth` as of a `NetworkPlant`.
    """

    network: Network
    omegas: tuple[Real, ...]
    breadth: float = 0.0

    @cached_property
    def parameters(self) -> tuple[str, ...]:
        """Those that enter any response, as in `NetworkPlant`."""
        return NetworkPlant(self.network, self.omegas[0]).parameters

    @cached_property
    def highest(self) -> Real:
        """Upper bounds of the parameters."""
        return NetworkPlant(self.network, self.omegas[0]).highest

    def response(self, p: Real) -> Complex:
        """Stacked responses, shape (..., n_f)."""
        return np.concatenate([part.response(p[..., at]) for part, at in self._parts], axis=-1)

    def logarithmic_gradient(self, p: Real) -> tuple[Complex, Complex]:
        """Stacked G, shape (..., n_f), and d ln G / d p, shape (..., n_p, n_f)."""
        responses, gradients = list[Complex](), list[Complex]()
        for part, at in self._parts:
            response, gradient = part.logarithmic_gradient(p[..., at])
            whole = np.zeros((*p.shape, len(part.omega)), dtype=np.complex128)
            whole[..., at, :] = gradient
            responses.append(response)
            gradients.append(whole)
        return np.concatenate(responses, axis=-1), np.concatenate(gradients, axis=-1)

    @cached_property
    def _parts(self) -> list[tuple[NetworkPlant, NDArray[np.intp]]]:
        """The plant of each response, and the places of its parameters."""
        pairs = []
        cells = (cell for row in self.network.cells for cell in row)
        for cell, omega in zip(cells, self.omegas, strict=True):
            part = NetworkPlant(cell, omega, self.breadth)
            at = [self.parameters.index(name) for name in part.parameters]
            pairs.append((part, np.array(at, dtype=np.intp)))
        return pairs


AnyNetworkPlant = NetworkPlant | NetworkPlants


def is_lossless(network: Network) -> bool:
    """Return True if all powers of s differ by even numbers: its resonances are undamped.

    >>> from disting.network import network_of
    >>> [is_lossless(network_of(t)) for t in ("1~2; F1; S2", "1=2; F1; S2", "p(L1,C1)")]
    [True, False, True]
    """
    return len({e.kind.halves % 4 for e in network.elements}) == 1 and not network.exponents


def network_plant(network: Network, omegas: Sequence[Real]) -> AnyNetworkPlant:
    """A network at the angular frequencies [rad/s] of each of its responses."""
    if len(omegas) == 1:
        return NetworkPlant(network, omegas[0])
    return NetworkPlants(network, tuple(omegas))


def _size_entries(side: Entries) -> Sized:
    return {i: x if isinstance(x, str) else float(x) for i, x in side.items()}


def _solve_moved(matrix: Complex, side: Complex) -> Complex:
    """Solutions, shape (..., n_f, n); a matrix that is singular, as without damping at a resonance,
    is moved by a rounding error.
    """
    try:
        return np.asarray(np.linalg.solve(matrix, side[..., None])[..., 0])
    except np.linalg.LinAlgError:
        moved = matrix + SMALL * np.abs(matrix).max() * np.eye(matrix.shape[-1])
        return np.asarray(np.linalg.solve(moved, side[..., None])[..., 0])


def measured_as(network: Network, measured: FrequencyResponse) -> Network:
    """The network with sensors of the measured quantity; circuits, compartments as they are."""
    is_machine = network.sort is Sort.MACHINE
    return replace(network, order=measured.sensor.order) if is_machine else network


def random_starts(
    plant: AnyNetworkPlant, measured: FrequencyResponse, count: int, draw: np.random.Generator
) -> NDArray[np.float64]:
    """Values, shape (count, n_p), with which each element alone would have the size of the response
    at a random frequency of the band, within a factor of three; exponents from 1/2 to 1.
    """
    low, high = np.log(measured.omega[0]), np.log(measured.omega[-1])
    omega = np.exp(draw.uniform(low, high, (count, len(plant.parameters))))
    size = np.exp(np.interp(np.log(omega), np.log(measured.omega), np.log(np.abs(measured.G)))) / (
        omega**plant.network.order
    )
    values = np.ones_like(omega)
    is_exponent = plant.highest < np.inf
    values[:, is_exponent] = draw.uniform(LEAST_EXPONENT, 1, values[:, is_exponent].shape)
    for e in plant.network.seen:
        if e.value:
            at = plant.parameters.index(e.value)
            power = (
                values[:, plant.parameters.index(e.exponent)] if e.exponent else e.kind.halves / 2
            )
            # p w^r = 1/|G|, where p divides w^r/p = 1/|G|
            stiffness = omega[:, at] ** -power / size[:, at]
            values[:, at] = 1 / stiffness if e.kind.divides else stiffness
    spread = np.full(len(plant.parameters), np.log(SPREAD))
    for e in plant.network.elements:
        if e.known_ratio is None and e.ratio in plant.parameters:
            spread[plant.parameters.index(e.ratio)] = np.log(RATIOS)
    spread[is_exponent] = 0
    return np.asarray(values * np.exp(draw.uniform(-1, 1, values.shape) * spread))
