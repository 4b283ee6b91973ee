"""The selected model for other programs: state space (20) to (23), python-control, MATLAB, JSON
that reads back bit-equal.
"""

import json
from dataclasses import dataclass
from io import BytesIO
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from disting.errors import InputError, shown
from disting.files import write_whole
from disting.fit.candidates import as_listed, reference
from disting.fit.each import explanations
from disting.fit.explained import Explanation
from disting.fit.fitted import fit_percent
from disting.fit.judged import Candidate
from disting.fit.members import Member
from disting.fit.modes import poles, zeros
from disting.fit.plant import Plant, Real
from disting.fit.select import Selection
from disting.fit.telling import suspicions
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

    >>> ss = state_space(Chain(1), {"m1": 2.0})
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


def selection_to_dict(found: Selection) -> dict[str, Any]:
    """Plain data of a selection: `selected` (null if none), whether it explains the data, what
    else is not excluded.
    """
    return {
        "selected": candidate_to_dict(found.selected) if found.selected else None,
        "candidates": [candidate_to_dict(c) for c in found.candidates],
        "alternatives": [
            {**_named(a.chain), "relation": a.relation.value, "reason": a.sentence}
            for a in found.alternatives
        ],
        "not_fitted": [
            {**_named(c), "same_as": _named(other)} for c, other in found.same_as.items()
        ],
        "explained": found.explanation.explains,
        "chi2_per_line": found.explanation.chi2,
        "scatter": found.explanation.scatter.typical,
        "scatter_source": found.explanation.scatter.source,
        "frequencies": _frequencies(found),
        "residual_correlation": found.explanation.correlation,
        "fit_percent": _fit_percent(found),
        "not_excluded": [member_to_dict(m) for m in found.members],
        "suspicions": list(suspicions(found)),
        "rule": found.rule.value,
        "validation": found.validation,
        "repeatability": found.repeatability.typical,
        "repeatability_source": found.repeatability.source,
        "margin": found.margin,
        "sign": found.task.sign,
    } | (_joint_to_dict(found) if len(found.task.cost.parts) > 1 or found.silent else {})


def _joint_to_dict(found: Selection) -> dict[str, Any]:
    """Each response with what is said of it alone, and those from which nothing is learned."""
    judging, described = found.judging, found.described
    each = explanations(judging, described.residual, described.missed, found.explanation.scatter)
    said = dict(zip(judging.setups, each, strict=True))
    cost, p = found.task.cost, described.estimate.parameters
    names = found.task.names(described.chain)
    response = found.task.plant(described.chain).response(np.array([p[n] for n in names]))
    residuals = cost.by_residual(cost.residual(response))
    rows = zip(cost.parts, cost.setups, residuals, strict=True)
    return {
        "responses": [
            {
                "measured": setup.text,
                "origin": part.measured.origin,
                "quantity": part.measured.sensor.value,
                "lines": len(part.measured),
                "sign": found.task.sign * setup.sign,
                "dead_time": setup.delay or "Td",
                "j_train": float(residual @ residual),
                "fit_percent": _finite(fit_percent(described, found.task, part.measured, at)),
            }
            | (_explained(said[setup]) if setup in said else {})
            for at, (part, setup, residual) in enumerate(rows)
        ],
        "nothing_learned": list(found.silent),
    }


def _explained(said: Explanation) -> dict[str, Any]:
    """What the judged data of one response say."""
    return {
        "chi2_per_line": said.chi2,
        "scatter": said.scatter.typical,
        "residual_correlation": said.correlation,
    }


def _frequencies(found: Selection) -> dict[str, float]:
    """Range [Hz] and number of the lines of the training data."""
    hertz = found.task.cost.measured.frequency
    return {"low": float(hertz[0]), "high": float(hertz[-1]), "lines": len(hertz)}


def _fit_percent(found: Selection) -> dict[str, float | None]:
    """Of the described candidate on training and test data; null where there are none or where
    it is not defined.
    """
    train = found.task.cost.measured
    sizes = {"train": train, "test": None if found.test is train else found.test}
    return {
        key: None if data is None else _finite(fit_percent(found.described, found.task, data))
        for key, data in sizes.items()
    }


def member_to_dict(member: Member) -> dict[str, Any]:
    """Plain data of a structure that the data do not exclude: name, values, intervals of 95 %,
    and what behaves the same.
    """
    return {
        "name": member.name,
        **_named(member.candidate.chain),
        "parameters": member.candidate.estimate.parameters,
        "intervals": {n: [_finite(end) for end in both] for n, both in member.intervals.items()},
        "j_test": member.candidate.j_test,
        "chi2_per_line": member.candidate.chi2,
        "equivalents": [
            {"name": t.name, "parameters": t.parameters, "free_choices": t.free_choices}
            for t in member.twins
        ],
        "not_decided": list(member.open),
        "disagreements": [
            {
                "parameter": d.name,
                "train": d.train,
                "test": d.test,
                "standard_errors_apart": d.distance,
            }
            for d in member.disagreements
        ],
        "differs_at": [{"frequency": hertz, "by": size} for hertz, size in member.differs],
    }


def candidate_to_dict(c: Candidate) -> dict[str, Any]:
    """Plain data of one candidate; a number that is not finite is null, and so is
    `unidentifiable` where nothing is.
    """
    return {
        "name": reference(c.chain),
        **_named(c.chain),
        "n_parameters": c.n_parameters,
        "parameters": c.estimate.parameters,
        "standard_errors": {name: _finite(value) for name, value in c.standard_errors.items()},
        "j_train": c.j_train,
        "j_test": c.j_test,
        "chi2_per_line": c.chi2,
        "pii_ratio": _finite(c.practical.importance_ratio),
        "collinearity": _finite(c.practical.collinearity),
        "condition_index": _finite(c.practical.condition_index),
        "unidentifiable": c.practical.unidentifiable or None,
        "akaike_weight": c.akaike_weight,
        "hit_rate": c.estimate.hit_rate,
        "admissible": c.admissible,
        "reasons": list(c.reasons),
    }


def _named(chain: Chain) -> dict[str, Any]:
    """A chain in the words of the fit: lag, delay, ground dampers; gap, force and sensor as
    indices.

    `renamed`: where the chain is named after another form of it, what its parameters are called
    there.
    """
    form = as_listed(chain)
    _, gap, act_minus, act_plus, meas_minus, meas_plus = chain.indices
    return {
        "n_masses": chain.n_masses,
        "ground_dampers": list(chain.ground_dampers),
        "lag": chain.lag,
        "delay": chain.dead_time,
        "gap": gap,
        "actuator": [act_minus, act_plus],
        "sensor": [meas_minus, meas_plus],
        "quantity": chain.sensor.value,
        "damped": chain.damped,
    } | ({"renamed": form.renaming} if form.chain != chain else {})


def model_from_dict(plain: dict[str, Any]) -> tuple[Chain, dict[str, float]]:
    """Chain and parameters of a candidate's plain data, bit-equal; raises InputError for what
    is none.
    """
    chain = chain_from_dict(plain)
    try:
        values = {name: float(plain["parameters"][name]) for name in chain.parameters}
    except (KeyError, TypeError, ValueError) as reason:
        raise _no_model(reason) from None
    return chain, values


def chain_from_dict(plain: dict[str, Any]) -> Chain:
    """The structure alone, of a candidate or of what is named beside it; raises InputError."""
    try:
        (act_minus, act_plus), (meas_minus, meas_plus) = plain["actuator"], plain["sensor"]
        return Chain(
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
        )
    except (KeyError, TypeError, ValueError) as reason:
        raise _no_model(reason) from None


def _no_model(reason: Exception) -> InputError:
    return InputError(f"this is no fitted model: {shown(reason)} is missing or wrong")


def read_model(path: Path) -> tuple[Chain, dict[str, float]]:
    """The selected model of a JSON file of `disting fit`; raises InputError."""
    try:
        plain = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as reason:
        raise InputError(f"{path} is no JSON file of a fit: {reason}") from None
    selected = plain.get("selected", plain) if isinstance(plain, dict) else None
    if not isinstance(selected, dict):
        raise InputError(f"{path} holds no selected model")
    return model_from_dict(selected)


def predicted(
    chain: Chain, values: dict[str, float], omega: Real, sign: int = 1
) -> np.ndarray[Any, np.dtype[np.complex128]]:
    """Response of a fitted chain, or of the same chain with other ports, at angular frequencies
    [rad/s].
    """
    return Plant(chain.structure, omega, sign).response(
        np.array([values[name] for name in chain.parameters])
    )


def _finite(value: float) -> float | None:
    return value if isfinite(value) else None
