"""The selected model for other programs: state space (20) to (23), python-control, MATLAB; as JSON:
`plain`.
"""

from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from disting.errors import InputError
from disting.files import write_whole
from disting.fit.modes import poles, zeros
from disting.fit.plant import Plant, Real
from disting.model.chain import Chain, Sensor
from disting.model.shown import plural, summary
from disting.simulation import matrices, port_vectors

if TYPE_CHECKING:
    import control


# where SciPy writes the time of day
MAT_HEAD = b"MATLAB 5.0 MAT-file, written by disting".ljust(116)


@dataclass(frozen=True, eq=False)
class StateSpace:
    """x' = A x + B u, y = C x + D u of a chain; states: positions, velocities, the lag's force;
    `delay` of the input [s].
    """

    A: Real
    B: Real
    C: Real
    D: Real
    delay: float

    def __repr__(self) -> str:
        return summary(
            self, plural(len(self.A), "state") + f", dead time {self.delay:g} s" * bool(self.delay)
        )


def state_space(chain: Chain, values: dict[str, float], sign: int = 1) -> StateSpace:
    """State space (20) to (23) with numbers, one input, one output; the torque lag adds a state.

    >>> ss = state_space(Chain(1, damped=False), {"m1": 2.0})
    >>> ss.A.tolist(), ss.B.tolist(), ss.D.tolist()
    ([[0.0, 1.0], [-0.0, -0.0]], [[0.0], [0.5]], [[0.5]])
    """
    n = chain.n_masses
    mass, damping, stiffness = matrices(chain, values)
    force, shown = port_vectors(chain)
    inverse = 1.0 / np.diag(mass)[:, None]
    a = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse * stiffness, -inverse * damping]])
    b = np.concatenate([np.zeros(n), inverse[:, 0] * force])[:, None]
    c = np.concatenate([sign * shown, np.zeros(n)])[None, :]
    d = np.zeros((1, 1))
    # differentiation: c (A x + B u), with D = 0 until the acceleration
    for _ in range(chain.sensor.order):
        c, d = c @ a, c @ b
    if chain.lag:
        a, b, c, d = _lagged(a, b, c, d, values["T1"])
    return StateSpace(a, b, c, d, values.get("Td", 0.0))


def _lagged(a: Real, b: Real, c: Real, d: Real, time: float) -> tuple[Real, Real, Real, Real]:
    """The force follows the input through 1/(1 + s T1)."""
    n = len(a)
    whole = np.block([[a, b], [np.zeros((1, n)), np.full((1, 1), -1.0 / time)]])
    return (
        whole,
        np.concatenate([np.zeros((n, 1)), [[1.0 / time]]]),
        np.hstack([c, d]),
        np.zeros((1, 1)),
    )


def to_control(chain: Chain, values: dict[str, float], sign: int = 1) -> "control.StateSpace":
    """A python-control StateSpace, without the dead time, which no finite state space has;
    needs disting[control].
    """
    ss = state_space(chain, values, sign)
    return _control().StateSpace(ss.A, ss.B, ss.C, ss.D)


def to_control_transfer_function(
    chain: Chain, values: dict[str, float], sign: int = 1
) -> "control.TransferFunction":
    """A python-control TransferFunction, without the dead time, from poles, zeros and gain;
    needs disting[control].
    """
    p = np.array([values[name] for name in chain.parameters])
    bottom, top = (
        np.atleast_1d(np.poly(roots(chain.structure, p))).real for roots in (poles, zeros)
    )
    at = 2.0 * np.abs(poles(chain.structure, p)).max() + 1.0  # a real point away from all of them
    plain = Chain(
        *chain.indices,
        damped=chain.damped,
        ground_dampers=chain.ground_dampers,
        sensor=Sensor.POSITION,
    )
    whole = _real_response(plain, {name: values[name] for name in plain.parameters}, at)
    gain = whole * np.polyval(bottom, at) / np.polyval(top, at)
    top = sign * gain * np.append(top, np.zeros(chain.sensor.order))
    bottom = np.polymul(bottom, [values["T1"], 1.0]) if chain.lag else bottom
    return _control().TransferFunction(top, bottom)


def _real_response(chain: Chain, values: dict[str, float], s: float) -> float:
    """The receptance at a real s."""
    mass, damping, stiffness = matrices(chain, values)
    force, shown = port_vectors(chain)
    return float(shown @ np.linalg.solve(mass * s * s + damping * s + stiffness, force))


def _control() -> Any:
    try:
        import control
    except ImportError:
        raise InputError(
            'python-control is not installed: pip install "disting[control]"'
        ) from None
    return control


def write_mat(path: Path, chain: Chain, values: dict[str, float], sign: int = 1) -> None:
    """A, B, C, D and delay as a MATLAB v5 file; the same model gives the same bytes."""
    from scipy.io import savemat

    ss = state_space(chain, values, sign)
    content = BytesIO()
    savemat(content, {"A": ss.A, "B": ss.B, "C": ss.C, "D": ss.D, "delay": ss.delay})
    write_whole(path, MAT_HEAD + content.getvalue()[len(MAT_HEAD) :])


def predicted(
    chain: Chain, values: dict[str, float], omega: Real, sign: int = 1
) -> np.ndarray[Any, np.dtype[np.complex128]]:
    """Response of a fitted chain, or of the same chain with other ports, at angular frequencies
    [rad/s].
    """
    return Plant(chain.structure, omega, sign).response(
        np.array([values[name] for name in chain.parameters])
    )
