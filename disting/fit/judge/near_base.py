"""Elastic bases that give the response of a fitted chain within the scatter of the lines.

A damped drive on an elastic base has other responses than a chain of three masses or more, but
often hardly other ones: the damping alone tells them apart. So the drive of n - 1 masses on a base
with a spring and a damper to the ground, force and sensor between base and mass 1, is fitted to the
response G of the chain, with friction b1 between base and mass 1 where the chain has friction to
the ground. With r_k = G_base / G - 1 at the lines and rho_k their scatter (`scatter`),

    T = sum_k |r_k|^2 / rho_k^2

is what the data can know of the difference: a test between both responses, known exactly, finds it
at level alpha with a chance of Phi(sqrt(T) - z_alpha), Phi the normal distribution and z_alpha its
quantile. Where that is one half or less, sqrt(T) <= z_alpha, the base is within the scatter.

Each mode of the chain may be that of the base; the chain's undamped modes are the starts.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import norm

from disting.fit.judge.exclusion import LEVEL
from disting.fit.judge.look_alikes import (
    RUBBING,
    LookAlike,
    LookAlikeKind,
    base_text,
    values_on_elastic_base,
)
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain

SOFT = 1e-9  # smallest damping of a start, as a share of the stiffness per rad/s
STEPS = 60  # evaluations of a fit
REMEMBERED = 16  # answers


def near_bases(
    chain: Chain, values: Mapping[str, float], omega: Real, rho: Real
) -> tuple[LookAlike, ...]:
    """Return the elastic bases within the scatter of a chain with force and sensor at mass 1, the
    nearest first; none where none is found.

    `values` in SI units; `omega` [rad/s] and `rho`, shape (n_f,): lines and how much they scatter.
    """
    if chain.n_masses < 2 or not chain.damped or chain.meas_plus != 1:
        return ()
    plain = replace(chain, lag=False, dead_time=False)  # common factors of both
    of = tuple((name, values[name]) for name in plain.parameters)
    return _near_bases(plain, of, omega.tobytes(), rho.tobytes())


@lru_cache(maxsize=REMEMBERED)
def _near_bases(
    chain: Chain, values: tuple[tuple[str, float], ...], lines: bytes, scatter: bytes
) -> tuple[LookAlike, ...]:
    at, (omega, rho) = dict(values), (np.frombuffer(x) for x in (lines, scatter))
    s = np.asarray(1j * omega, dtype=np.complex128)
    wanted = impedance(at, s)
    fits = sorted(
        (_fitted(start, wanted, omega, rho) for start in starts_on_base(chain, at)),
        key=lambda fit: fit[0],
    )
    near = dict[str, LookAlike]()
    for cost, there in fits:
        if np.sqrt(cost) <= norm.isf(LEVEL):
            apart = float(np.max(np.abs(wanted / on_base(there, s) - 1)))
            text = text_on_base(there)
            near.setdefault(text, LookAlike(LookAlikeKind.ELASTIC_BASE, text, there, apart))
    return tuple(near.values())


def text_on_base(values: Mapping[str, float]) -> str:
    """Name a drive on an elastic base with these values."""
    masses = sum(name[0] == "m" for name in values) - 1
    hertz = np.sqrt(values["kb"] / values["mb"]) / (2 * np.pi)
    return f"{base_text(masses)} with its resonance at {hertz:.4g} Hz{RUBBING * ('b1' in values)}"


def impedance(values: Mapping[str, float], s: Complex) -> Complex:
    """Force per velocity at mass 1 of a chain, shape (n,).

    >>> impedance({"m1": 2.0, "b1": 1.0}, np.array([1.0 + 0j])).tolist()
    [(3+0j)]
    """
    n = max(int(name[1:]) for name in values if name[0] == "m" and name != "mb")
    behind = np.zeros_like(s)
    for i in range(n, 0, -1):
        own = values[f"m{i}"] * s + values.get(f"b{i}", 0.0) + behind
        if i == 1:
            break
        joint = values[f"k{i - 1}{i}"] / s + values.get(f"d{i - 1}{i}", 0.0)
        behind = own * joint / (own + joint)
    return np.asarray(own)


def on_base(values: Mapping[str, float], s: Complex) -> Complex:
    """Force per relative velocity between base and mass 1, friction b1 between both, shape (n,)."""
    friction = values.get("b1", 0.0)
    drive = impedance({n: v for n, v in values.items() if n != "b1"}, s)
    base = values["mb"] * s + values.get("db", 0.0) + values["kb"] / s
    return np.asarray(friction + drive * base / (drive + base))


def starts_on_base(chain: Chain, values: Mapping[str, float]) -> list[dict[str, float]]:
    """Values on a base for each mode that may be that of the base, dampers as the chain's are."""
    bare = {n: v for n, v in values.items() if n[0] in "mk"}
    share = damping_share(chain, values)
    grounded = sum(values[f"b{i}"] for i in chain.ground_dampers)
    friction = {"b1": max(grounded, SOFT)} if chain.ground_dampers else {}
    starts = []
    for _, there in values_on_elastic_base(chain.n_masses, bare):
        dampers = {f"d{n[1:]}": share * v for n, v in there.items() if n[0] == "k"}
        starts.append({**there, **dampers, **friction})
    return starts


def damping_share(chain: Chain, values: Mapping[str, float]) -> float:
    """The mean of d / k of the joints of a chain [s]."""
    soft = [values[f"d{i}{i + 1}"] / values[f"k{i}{i + 1}"] for i in range(1, chain.n_masses)]
    return max(float(np.exp(np.mean(np.log(np.maximum(soft, SOFT))))), SOFT)


def _fitted(
    start: Mapping[str, float], wanted: Complex, omega: Real, rho: Real
) -> tuple[float, dict[str, float]]:
    """T and the values of the best base near a start."""
    names, s = list(start), np.asarray(1j * omega, dtype=np.complex128)

    def residual(logarithms: Real) -> Real:
        there = dict(zip(names, np.exp(logarithms), strict=True))
        off = (wanted / on_base(there, s) - 1) / rho
        return np.concatenate([off.real, off.imag])

    found = least_squares(
        residual, np.log(list(start.values())), method="trf", x_scale="jac", max_nfev=STEPS
    )
    values = {n: float(v) for n, v in zip(names, np.exp(found.x), strict=True)}
    return 2 * float(found.cost), dict(sorted(values.items()))
