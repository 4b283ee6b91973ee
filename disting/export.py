"""Models with numbers for other programs: state space (20) to (23), zeros and poles, MATLAB,
python-control. As JSON: `report.fit.selection_json`.

The models in a file of a fit, read back bit-equal.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from disting.errors import InputError, short
from disting.files import read_json, write_whole
from disting.fit.judge.modes import poles, zeros
from disting.fit.search.candidates import listed_form
from disting.fit.search.plant import Plant
from disting.measurement.arrays import Complex, Real
from disting.measurement.response import as_sign
from disting.model.chain import Chain, StateSpace
from disting.network.denotation import MisnamedError, naming_of, refuse_misnamed
from disting.simulation import matrices, port_vectors
from disting.simulation.mechanics import check_values

if TYPE_CHECKING:
    import control

HUGE = 1e100  # more is no value of an element, and squares of it are no numbers any more
FIT_FILE = "a file of 'disting fit --json'"


def model_from_dict(plain: dict[str, Any]) -> tuple[Chain, dict[str, float]]:
    """Chain and parameters of a candidate's plain data, bit-equal; raises InputError for what
    is none.
    """
    chain = chain_from_dict(plain)
    try:
        values = {name: number_of(plain["parameters"][name]) for name in chain.parameters}
    except (KeyError, TypeError, ValueError) as reason:
        raise _no_model(reason) from None
    return chain, values


def chain_from_dict(plain: dict[str, Any]) -> Chain:
    """The structure alone, of a candidate or of a structure named in addition; raises InputError,
    and MisnamedError for a name that denotes another structure.
    """
    try:
        (act_minus, act_plus), (meas_minus, meas_plus) = plain["actuator"], plain["sensor"]
        chain = Chain(
            plain["n_masses"],
            plain["gap"],
            act_minus,
            act_plus,
            meas_minus,
            meas_plus,
            plain["quantity"],
            plain["damped"],
            tuple(plain["ground_dampers"]),
            plain["lag"],
            plain["delay"],
            plain.get("gap_damper", False),
        )
        name = str(plain.get("name", ""))
    except (KeyError, TypeError, ValueError) as reason:
        raise _no_model(reason) from None
    refuse_misnamed(name, naming_of(name, listed_form(chain).chain))
    return chain


def number_of(value: Any, least: float = -HUGE, most: float = HUGE) -> float:
    """A number of a file, finite and between two others; raises ValueError."""
    if type(value) in (int, float) and least <= value <= most:
        return float(value)
    raise ValueError(f"{short(value)}, where a number from {least:g} to {most:g} belongs,")


def _no_model(reason: Exception) -> InputError:
    return InputError(f"this is not a fitted model: {short(reason)} is missing or wrong")


def refuse_open_quantity(plain: Any, path: Path) -> None:
    """Raise InputError with the question for the sensor quantity, where a file of a fit leaves it
    open.
    """
    if isinstance(plain, dict) and plain.get("question"):
        raise InputError(f"{path} names no model: {plain['question']}")


def read_model(path: Path) -> tuple[Chain, dict[str, float]]:
    """The selected model of a JSON file of `disting fit`; raises InputError."""
    plain = read_json(path, FIT_FILE)
    refuse_open_quantity(plain, path)
    selected = plain.get("selected", plain) if isinstance(plain, dict) else None
    if not isinstance(selected, dict):
        raise InputError(f"{path} holds no selected model")
    try:
        return model_from_dict(selected)
    except MisnamedError as reason:
        raise InputError(f"{path}: {reason}") from None


# where SciPy writes the time of day
MAT_HEAD = b"MATLAB 5.0 MAT-file, written by disting".ljust(116)


def state_space(chain: Chain, values: dict[str, float], sign: int = 1) -> StateSpace:
    """State space (20) to (23) with numbers, one input, one output; the torque lag adds a state.
    Raises InputError for missing, unknown or negative values, and for a sign that is not 1 or -1.

    >>> ss = state_space(Chain(1, damped=False), {"m1": 2.0})
    >>> ss.A.tolist(), ss.B.tolist(), ss.D.tolist()
    ([[0.0, 1.0], [-0.0, -0.0]], [[0.0], [0.5]], [[0.5]])
    """
    n, sign = chain.n_masses, as_sign(sign)
    mass, damping, stiffness = matrices(chain, values)
    force, shown = port_vectors(chain)
    inverse = 1.0 / np.diag(mass)[:, None]
    a = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse * stiffness, -inverse * damping]])
    b = np.concatenate([np.zeros(n), inverse[:, 0] * force])[:, None]
    c = np.concatenate([sign * shown, np.zeros(n)])[None, :]
    d = np.zeros((1, 1))
    # differentiation: c (A x + B u), with D = 0 until the acceleration
    for _ in range(chain.quantity.order):
        c, d = c @ a, c @ b
    if chain.lag:
        a, b, c, d = _add_lag(a, b, c, d, values["T1"])
    units = {f"x{i}": "m" for i in range(1, n + 1)} | {f"v{i}": "m/s" for i in range(1, n + 1)}
    units |= {"F": "N"} if chain.lag else {}
    ports = {"u": "N", "y": chain.quantity.unit}
    return StateSpace(a, b, c, d, values.get("Td", 0.0), tuple(units), units | ports)


def _add_lag(a: Real, b: Real, c: Real, d: Real, time: float) -> tuple[Real, Real, Real, Real]:
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
    """A python-control StateSpace, its states, input u and output y named, without the dead time,
    which no finite state space has; needs disting[control]. Raises InputError as `state_space`
    does, and where python-control is not installed.

    >>> to_control(Chain(1, damped=False), {"m1": 2.0}).nstates
    2
    """
    ss = state_space(chain, values, sign)
    names = {"states": list(ss.states), "inputs": ["u"], "outputs": ["y"]}
    return _control().StateSpace(ss.A, ss.B, ss.C, ss.D, remove_useless_states=False, **names)


def to_control_transfer_function(
    chain: Chain, values: dict[str, float], sign: int = 1
) -> "control.TransferFunction":
    """A python-control TransferFunction, without the dead time, from poles, zeros and gain; needs
    disting[control]. Raises InputError as `to_control` does.

    >>> mass = Chain(1, damped=False, quantity="position")
    >>> drive = to_control_transfer_function(mass, {"m1": 2.0})
    >>> complex(drive(1j)).real
    -0.5
    """
    the_zero_pole = zero_pole(chain, values, sign)
    top, bottom = (
        np.atleast_1d(np.poly(roots)).real for roots in (the_zero_pole.zeros, the_zero_pole.poles)
    )
    return _control().TransferFunction(the_zero_pole.gain * top, bottom)


@dataclass(frozen=True, eq=False)
class ZeroPole:
    """gain prod(s - z) / prod(s - p), roots in rad/s."""

    zeros: Complex
    poles: Complex
    gain: float


def zero_pole(chain: Chain, values: dict[str, float], sign: int = 1) -> ZeroPole:
    """Zeros, poles and gain of a chain with numbers, without the dead time. Raises InputError as
    `state_space` does.

    >>> found = zero_pole(Chain(1), {"m1": 2.0})
    >>> len(found.zeros), len(found.poles), found.gain
    (2, 2, 0.5)
    """
    structure, sign, values = chain.structure, as_sign(sign), check_values(chain, values)
    p = np.array([values[name] for name in structure.parameters])
    bottom, top = poles(structure, p), zeros(structure, p)
    at = 2.0 * np.abs(bottom).max() + 1.0  # a real point away from all of them
    ratio = np.prod(at - bottom) / np.prod(at - top)
    gain = sign * _real_response(chain, values, at) * float(np.real(ratio))
    top = np.append(top, np.zeros(chain.quantity.order))
    if chain.lag:
        bottom, gain = np.append(bottom, -1 / values["T1"]), gain / values["T1"]
    return ZeroPole(top, bottom, gain)


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


@dataclass(frozen=True, slots=True)
class NumberedStructure:
    """A structure with numbers under its name, such as 3:11+b1, the units of its parameters, ""
    where the data leave them open, and the parameters that the data do not determine
    (`undetermined`).

    >>> NumberedStructure("1:1", Chain(1, damped=False), {"m1": 2.0}, {"m1": "kg"}).units["m1"]
    'kg'
    """

    name: str
    chain: Chain
    values: dict[str, float]
    units: dict[str, str]
    undetermined: tuple[str, ...] = ()


def write_mat(path: Path, models: Sequence[NumberedStructure], sign: int = 1) -> None:
    """A MATLAB v5 file: A, B, C, D and delay of the first model, and the struct array `models` with
    name, A, B, C, D, delay, z, p, k, parameters, units and undetermined (names with blanks between)
    of each. The same models give the same
    bytes. Raises InputError for no models or wrong values, OSError where the file cannot be
    written.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "drive.mat")
    ...     chain = Chain(1, damped=False)
    ...     write_mat(path, [NumberedStructure("1:1", chain, {"m1": 2.0}, {"m1": "kg"})])
    ...     path.read_bytes()[:6]
    b'MATLAB'
    """
    from scipy.io import savemat

    if not models:
        raise InputError("a MATLAB file needs a model: none is given")
    whole = np.empty(len(models), dtype=object)
    whole[:] = [_plain(model, sign) for model in models]
    content = BytesIO()
    savemat(content, {n: whole[0][n] for n in (*"ABCD", "delay")} | {"models": whole})
    write_whole(path, MAT_HEAD + content.getvalue()[len(MAT_HEAD) :])


def _plain(model: NumberedStructure, sign: int) -> dict[str, Any]:
    """Fields of a MATLAB struct."""
    ss = state_space(model.chain, model.values, sign)
    zpk = zero_pole(model.chain, model.values, sign)
    return {
        "name": model.name,
        **{n: getattr(ss, n) for n in (*"ABCD", "delay")},
        **{"z": zpk.zeros[:, None], "p": zpk.poles[:, None], "k": zpk.gain},
        "parameters": model.values,
        "units": model.units,
        "undetermined": " ".join(model.undetermined),
    }


def control_script(models: Sequence[NumberedStructure], sign: int = 1) -> str:
    """A Python program that makes a python-control StateSpace of each model, by name. Raises
    InputError as `state_space` does.

    >>> drive = NumberedStructure("1:1", Chain(1, damped=False), {"m1": 2.0}, {"m1": "kg"})
    >>> "m1 = 2 kg" in control_script([drive])
    True
    """
    return "".join([_HEAD, *(_entry(model, sign) for model in models), "}\n", _DELAYS, *(
        f"    {model.name!r}: {model.values.get('Td', 0.0)!r},\n" for model in models
    ), "}\n"])  # fmt: skip


_HEAD = """\"\"\"Structures that a measurement leaves, for python-control.\"\"\"

import control

models = {
"""
_DELAYS = "dead_times = {  # [s], no part of a state space\n"


def _entry(model: NumberedStructure, sign: int) -> str:
    """The matrices, with the parameters as a comment."""
    ss = state_space(model.chain, model.values, sign)
    parameters = ", ".join(
        f"{n} = {v:.6g}{f' {model.units[n]}' if model.units.get(n) else ''}"
        for n, v in model.values.items()
    )
    if model.undetermined:
        parameters += f"; not determined by the data: {', '.join(model.undetermined)}"
    fields = "".join(f"        {getattr(ss, n).tolist()!r},\n" for n in "ABCD")
    return f"    # {parameters}\n    {model.name!r}: control.StateSpace(\n{fields}    ),\n"


def predict(
    chain: Chain, values: dict[str, float], omega: Real, sign: int = 1
) -> np.ndarray[Any, np.dtype[np.complex128]]:
    """Response of a fitted chain, or of the same chain with other ports, at angular frequencies
    [rad/s]; values that it has no parameter for are left out. Raises InputError for missing or
    negative values, and for a sign that is not 1 or -1.

    >>> abs(predict(Chain(1, damped=False), {"m1": 2.0}, np.array([1.0, 9.0]))).tolist()
    [0.5, 0.5]
    """
    own = check_values(chain, {name: values[name] for name in chain.parameters if name in values})
    return Plant(chain.structure, omega, sign).response(np.array(list(own.values())))
