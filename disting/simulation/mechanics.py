"""A structure as numbers: its matrices and its frequency response.

M x'' + D x' + K x = (e_act+ - e_act-) F. With A(s) = M s^2 + D s + K the response of a sensor of
order n = 0, 1, 2 (position, velocity, acceleration) is

    G(s) = s^n exp(-s Td) / (1 + s T1) (e_meas+ - e_meas-)' A(s)^-1 (e_act+ - e_act-).
"""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from disting.errors import InputError, shown
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.model.structure import Element, Structure, power


class Matrices(NamedTuple):
    """M, D and K, shape (N, N) each, in one system of units.

    >>> matrices(Chain(1, ground_dampers=(1,), damped=False), {"m1": 2.0, "b1": 0.1}).D.tolist()
    [[0.1]]
    """

    M: Real
    D: Real
    K: Real


def structure_of(model: Chain | Structure) -> Structure:
    """The structure of a chain, or the structure itself."""
    return model.structure if isinstance(model, Chain) else model


def checked(model: Chain | Structure, values: Mapping[str, float]) -> dict[str, float]:
    """The values of all parameters; raises InputError for missing, unknown or negative ones,
    and for masses that are zero.
    """
    names = structure_of(model).parameters
    if set(names) != set(values):
        raise InputError(
            f"parameters {', '.join(names)} are needed, given are {', '.join(values) or 'none'}"
        )
    for name, value in values.items():
        if not 0 <= value < np.inf or (name[0] == "m" and value == 0):
            raise InputError(
                f"{name} = {shown(value)} is no {'positive' if name[0] == 'm' else 'non-negative'}"
                " number"
            )
    return {name: float(values[name]) for name in names}


def matrices(model: Chain | Structure, values: Mapping[str, float]) -> Matrices:
    """M, D, K: every element adds value * v v' with v the masses that it joins.

    >>> matrices(Chain(2, damped=False), {"m1": 1.0, "m2": 2.0, "k12": 4.0}).K.tolist()
    [[4.0, -4.0], [-4.0, 4.0]]
    """
    structure, numbers = structure_of(model), checked(model, values)
    by_power = [np.zeros((structure.n_masses, structure.n_masses)) for _ in range(3)]
    for element in structure.elements:
        vector = _vector(element, structure.n_masses)
        by_power[power(element)] += numbers[element.parameter] * np.outer(vector, vector)
    return Matrices(by_power[2], by_power[1], by_power[0])


def port_vectors(model: Chain | Structure) -> tuple[Real, Real]:
    """e_act and e_meas, shape (N,): +1 and -1 at the masses of the ports, nothing at the ground.

    >>> [vector.tolist() for vector in port_vectors(Chain(2, meas_plus=2))]
    [[1.0, 0.0], [0.0, 1.0]]
    """
    structure = structure_of(model)
    ports = structure.ports
    return _port(ports.act_plus, ports.act_minus, structure.n_masses), _port(
        ports.meas_plus, ports.meas_minus, structure.n_masses
    )


def motion(m: Matrices, force: Real, omega: Real) -> Complex:
    """Positions of all masses per force, shape (n_f, N), at omega [rad/s], shape (n_f,); raises
    InputError at a pole.
    """
    s = 1j * np.asarray(omega)[:, None, None]
    try:
        return np.asarray(np.linalg.solve(m.M * s**2 + m.D * s + m.K, force[None, :, None])[..., 0])
    except np.linalg.LinAlgError:
        raise InputError(
            "an undamped resonance or 0 Hz is among the frequencies: the response is infinite there"
        ) from None


def input_filter(values: Mapping[str, float], omega: Real) -> Complex:
    """exp(-j omega Td) / (1 + j omega T1), shape (n_f,); missing times are zero."""
    s = 1j * np.asarray(omega)
    return np.asarray(np.exp(-s * values.get("Td", 0.0)) / (1 + s * values.get("T1", 0.0)))


def frequency_response(
    model: Chain | Structure, values: Mapping[str, float], omega: Real
) -> Complex:
    """G(j omega), shape (n_f,), of the sensor quantity of the model; `omega` [rad/s].

    >>> abs(frequency_response(Chain(1, damped=False), {"m1": 2.0}, np.array([1.0, 9.0]))).tolist()
    [0.5, 0.5]
    """
    act, meas = port_vectors(model)
    order = structure_of(model).sensor_order
    moved = motion(matrices(model, values), act, omega) @ meas
    return np.asarray((1j * np.asarray(omega)) ** order * input_filter(values, omega) * moved)


def _vector(element: Element, size: int) -> Real:
    nodes = (element.at, element.at + 1) if element.kind in "kd" else (element.at, 0)
    return _port(nodes[0], nodes[1], size)


def _port(plus: int, minus: int, size: int) -> Real:
    vector = np.zeros(size + 1)
    vector[plus] += 1.0
    vector[minus] -= 1.0
    return vector[1:]
