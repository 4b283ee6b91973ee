"""A model as numbers: its matrices and its frequency response.

An element of value p adds p s^r u v' to P(s) = sum_r P_r s^r (1/p of a resistor, an inductor, a
Warburg element; r of a constant phase element is a parameter). The response of a sensor of order
n = 0, 1, 2 (position, velocity, acceleration; 0 of a circuit or compartments) is

    G(s) = s^n exp(-s Td) / (1 + s T1) c' P(s)^-1 b.

Of a machine P(s) = M s^2 + D s + K, so that M x'' + D x' + K x = b F. A chain is the network of its
masses, springs and dampers behind a lag and a dead time.

Motion with Coulomb friction is computed by a fixed-step Runge-Kutta integration of fourth order.

M x'' + D x' + K x = e_act f(t) - c tanh(v / v_s) - b v for each mass with friction, where tanh
replaces the sign (v_s = speed below which the friction is not fully there), so that the right side
is smooth and the integration converges. Dead time and lag act on the force alone, before it reaches
the masses; the force is a trigonometric polynomial, known at every instant.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, SupportsFloat

import numpy as np

from disting.errors import InputError, enumeration, short
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain, Sort, Structure
from disting.network.chains import elements_of, ports_of
from disting.network.network import Element, Network, Port

AnyModel = Chain | Structure | Network
Powers = Mapping[float, Real]
"""P_r by r, shape (N, N) each."""


class Matrices(NamedTuple):
    """M, D and K of a machine, shape (N, N) each, in one system of units.

    >>> matrices(Chain(1, ground_dampers=(1,), damped=False), {"m1": 2.0, "b1": 0.1}).D.tolist()
    [[0.1]]
    """

    M: Real
    D: Real
    K: Real


@dataclass(frozen=True, slots=True)
class Form:
    """Terms of P(s), b and c; `parameters` with those that belong to no element; `nodes` in the
    order of rows; `order` of the sensor.
    """

    parameters: tuple[str, ...]
    elements: tuple[Element, ...]
    nodes: tuple[int, ...]
    force: Port
    sensor: Port
    order: int

    @property
    def act(self) -> Real:
        """b, shape (N,)."""
        return self._vector(self.force.ends)

    @property
    def meas(self) -> Real:
        """c, shape (N,)."""
        return self._vector(self.sensor.ends)

    def powers(self, values: Mapping[str, float]) -> Powers:
        """P_r by r, for values of all parameters."""
        coefficients: dict[float, Real] = {}
        for e in self.elements:
            size = values[e.value] if e.value else 1.0
            u, v = (
                self._vector({i: -values[x] if isinstance(x, str) else x for i, x in side.items()})
                for side in (e.pulls, e.feels)
            )
            term = (1 / size if e.kind.divides else size) * np.outer(u, v)
            power = values[e.exponent] if e.exponent else e.kind.halves / 2
            coefficients[power] = coefficients[power] + term if power in coefficients else term
        return coefficients

    def _vector(self, ends: Mapping[int, SupportsFloat]) -> Real:
        """+1 and -1 or a ratio at some nodes, nothing at the ground."""
        vector = np.zeros(len(self.nodes))
        for node, size in ends.items():
            vector[self.nodes.index(node)] = float(size)
        return vector


def form_of(model: AnyModel) -> Form:
    """The form of a chain, its structure, or a network with one input and one output; of a circuit
    without unobservable parts, as its potentials are known up to a constant. Raises InputError.
    """
    if isinstance(model, Network):
        if model.shape != (1, 1):
            raise InputError(
                f"{model.name} has several inputs or outputs: ask for one of its cells, which are"
                " networks too"
            )
        plain = _plain(model)
        force, sensor = plain.ports
        parameters = (*model.parameters, *model.exponents)
        return Form(parameters, plain.elements, plain.nodes, force, sensor, model.order)
    structure = model.structure if isinstance(model, Chain) else model
    nodes = tuple(range(1, structure.n_masses + 1))
    elements, ports = elements_of(structure), ports_of(structure)
    return Form(structure.parameters, elements, nodes, *ports, structure.sensor_order)


def _plain(network: Network) -> Network:
    """The network whose potentials are computed."""
    return network.grounded if network.sort is Sort.CIRCUIT else network


def check_values(model: AnyModel, values: Mapping[str, float]) -> dict[str, float]:
    """The values of all parameters; raises InputError for missing, unknown or negative ones, for
    masses, ratios, exponents and what divides that are zero, and for exponents above 1.
    """
    if isinstance(model, Network):
        names, elements = (*model.parameters, *model.exponents), _plain(model).elements
    else:
        names, elements = (form := form_of(model)).parameters, form.elements
    if set(names) != set(values):
        raise InputError(
            f"parameters {enumeration(names)} are needed, given are {enumeration(values) or 'none'}"
        )
    positive = {e.value for e in elements if e.letter == "m" or e.kind.divides}
    positive |= {name for e in elements for name in (e.ratio, e.exponent)}
    above = [e.exponent for e in elements if e.exponent and values[e.exponent] > 1]
    if above:
        raise InputError(f"{above[0]} = {values[above[0]]} is no exponent: it is at most 1")
    for name, value in values.items():
        if not 0 <= value < np.inf or (name in positive and value == 0):
            kind = "positive" if name in positive else "non-negative"
            raise InputError(f"{name} = {short(value)} is no {kind} number")
    return {name: float(values[name]) for name in names}


def matrices(model: AnyModel, values: Mapping[str, float]) -> Matrices:
    """M, D, K of a machine. Raises InputError for missing, unknown or negative values.

    >>> matrices(Chain(2, damped=False), {"m1": 1.0, "m2": 2.0, "k12": 4.0}).K.tolist()
    [[4.0, -4.0], [-4.0, 4.0]]
    """
    form = form_of(model)
    powers = form.powers(check_values(model, values))
    nothing = np.zeros((len(form.nodes),) * 2)
    return Matrices(*(powers.get(power, nothing) for power in (2, 1, 0)))


def port_vectors(model: AnyModel) -> tuple[Real, Real]:
    """b and c, shape (N,): +1 and -1 at the nodes of the ports, nothing at the ground.

    >>> [vector.tolist() for vector in port_vectors(Chain(2, meas_plus=2))]
    [[1.0, 0.0], [0.0, 1.0]]
    """
    form = form_of(model)
    return form.act, form.meas


def motion(powers: Powers, force: Real, omega: Real) -> Complex:
    """Positions of all masses per force, or the quantities in their place, shape (n_f, N), at omega
    [rad/s], shape (n_f,); raises InputError at a pole.
    """
    s = 1j * np.asarray(omega, dtype=np.float64)[:, None, None]
    try:
        with np.errstate(divide="ignore", invalid="ignore"):
            matrix = sum(term * s**power for power, term in powers.items())
        if not np.isfinite(matrix).all():
            raise np.linalg.LinAlgError
        return np.asarray(np.linalg.solve(matrix, force[None, :, None])[..., 0])
    except np.linalg.LinAlgError:
        raise InputError(
            "an undamped resonance or 0 Hz is among the frequencies: the response is infinite there"
        ) from None


def input_filter(model: AnyModel, values: Mapping[str, float], omega: Real) -> Complex:
    """exp(-j omega Td) / (1 + j omega T1), shape (n_f,); missing times are zero, as of networks."""
    times = {} if isinstance(model, Network) else values
    s = 1j * np.asarray(omega)
    return np.asarray(np.exp(-s * times.get("Td", 0.0)) / (1 + s * times.get("T1", 0.0)))


def frequency_response(model: AnyModel, values: Mapping[str, float], omega: Real) -> Complex:
    """G(j omega), shape (n_f,), of what the sensor of the model shows; `omega` [rad/s]. Raises
    InputError for missing, unknown or negative values.

    >>> abs(frequency_response(Chain(1, damped=False), {"m1": 2.0}, np.array([1.0, 9.0]))).tolist()
    [0.5, 0.5]
    """
    form, numbers = form_of(model), check_values(model, values)
    moved = motion(form.powers(numbers), form.act, omega) @ form.meas
    front = (1j * np.asarray(omega)) ** form.order
    return np.asarray(front * input_filter(model, numbers, omega) * moved)


STEP = 0.25  # of the shortest time in which the motion changes
MOST_STEPS = 5_000_000


@dataclass(frozen=True, slots=True)
class Friction:
    """Friction of one mass towards the ground.

    `coulomb` [N or N m], `viscous` [N s/m or N m s/rad], `speed` = v_s [m/s or rad/s], at which
    tanh(1) = 76 % of the Coulomb friction is reached.

    >>> Friction(coulomb=0.05).viscous
    0.0
    """

    coulomb: float = 0.0
    viscous: float = 0.0
    speed: float = 1e-2

    def __post_init__(self) -> None:
        if not (
            0 <= self.coulomb < np.inf and 0 <= self.viscous < np.inf and 0 < self.speed < np.inf
        ):
            raise InputError("friction has coulomb >= 0, viscous >= 0 and speed > 0")


def step(
    m: Matrices,
    act: Real,
    force: Complex,
    period: float,
    samples: int,
    periods: int,
    friction: Sequence[Friction],
) -> Real:
    """Positions, velocities and accelerations of all masses, shape (3, samples * periods, N).

    `m` with the viscous friction; `force` = spectrum of one period, shape (samples // 2 + 1,), of
    numpy.fft.rfft; `period` [s]; `friction` of each mass. Begins in the periodic motion without
    Coulomb friction. Raises InputError where M has no inverse.
    """
    coulomb, speed = np.array([(kind.coulomb, kind.speed) for kind in friction]).T
    inverse = _inverse(m)
    highest = 2 * np.pi * int(np.flatnonzero(force)[-1]) / period
    steps = _steps(m, coulomb / speed, highest, period / samples)
    if steps * samples * periods > MOST_STEPS:
        raise InputError(
            f"{steps * samples * periods} steps are too many; raise the speed of the friction, or"
            " simulate less"
        )
    push = np.outer(_oversample(force, samples, 2 * steps), act)

    def acceleration(x: Real, v: Real, f: Real) -> Real:
        """(f - D v - K x - F_c tanh(v/v_s)) / M."""
        return np.asarray(inverse @ (f - m.D @ v - m.K @ x - coulomb * np.tanh(v / speed)))

    x, v = _start(m, act, force, period, samples)
    h = period / samples / steps
    result = np.empty((3, samples * periods, len(act)))
    for sample in range(samples * periods):
        at = 2 * steps * (sample % samples)
        result[:, sample] = x, v, acceleration(x, v, push[at])
        for i in range(at, at + 2 * steps, 2):
            x, v = _next(acceleration, x, v, h, push[[i, i + 1, (i + 2) % len(push)]])
    return result


def _next(
    acceleration: Callable[[Real, Real, Real], Real], x: Real, v: Real, h: float, push: Real
) -> tuple[Real, Real]:
    """One step of Runge and Kutta; `push`: the force at its start, middle and end."""
    first, middle, last = push
    a1 = acceleration(x, v, first)
    v2 = v + h / 2 * a1
    a2 = acceleration(x + h / 2 * v, v2, middle)
    v3 = v + h / 2 * a2
    a3 = acceleration(x + h / 2 * v2, v3, middle)
    v4 = v + h * a3
    a4 = acceleration(x + h * v3, v4, last)
    return x + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


def _steps(m: Matrices, slope: Real, highest: float, sample: float) -> int:
    """Steps a sample [s]: from the force [rad/s], the eigenvalues (Gershgorin: rows of |K|,
    |D|), the slope of the friction.
    """
    inverse = _inverse(m)
    stiff, damped, rubbed = (
        np.max(np.abs(inverse @ matrix).sum(axis=1)) for matrix in (m.K, m.D, np.diag(slope))
    )
    fastest = np.sqrt(stiff) + damped + rubbed + highest
    return max(1, int(np.ceil(sample * fastest / STEP)))


def _inverse(m: Matrices) -> Real:
    try:
        return np.asarray(np.linalg.inv(m.M))
    except np.linalg.LinAlgError:
        raise InputError(
            "Coulomb friction needs a mass at every node: give each a mass, however small"
        ) from None


def _oversample(spectrum: Complex, samples: int, factor: int) -> Real:
    """The trigonometric polynomial between its samples, `factor` values a sample."""
    wide = np.zeros(samples * factor // 2 + 1, dtype=complex)
    wide[: len(spectrum)] = spectrum * factor
    return np.asarray(np.fft.irfft(wide, samples * factor))


def _start(
    m: Matrices, act: Real, force: Complex, period: float, samples: int
) -> tuple[Real, Real]:
    """Position and velocity at time zero of the periodic motion without Coulomb friction."""
    lines = np.flatnonzero(np.abs(force) > 0)
    omega = np.asarray(2 * np.pi * lines / period, dtype=np.float64)
    moved = motion({2: m.M, 1: m.D, 0: m.K}, act, omega) * force[lines, None] * (2 / samples)
    return np.asarray(moved.sum(axis=0).real), np.asarray(
        (1j * omega[:, None] * moved).sum(axis=0).real
    )
