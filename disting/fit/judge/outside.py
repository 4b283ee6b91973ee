"""Machines outside the candidates, fitted to the data in addition to a chain of three or four
masses.

A chain with force and sensor at mass 1 comes near the response of a drive on an elastic base
(see below), and of a motor m1 that drives several loads, each a row of masses (a branch). These
are fitted to the data of the chain, from the values that have its response where nothing is damped:

- base: each mode of the chain may be that of the base;
- branch: where mass 1 is held, the rest of the chain has n - 1 modes. Each way to share them out
  among two rows or more is a branch. A row with the modes z_i and the modal masses mu_i has the
  dynamic stiffness, with x = s^2,

      D = sum mu_i z_i x / (x + z_i),

  so that its spring beside mass 1 is sum mu_i z_i, and 1 / D less that of the spring is the
  response of a free chain (`modes.row`).

Friction is that between mass 1 and the ground, or the base, where the chain has friction anywhere
and the data show it there.
Lag, dead time and all that the sensor does are those of the chain. A machine explains the data as
a candidate does (`explanation`). It does so better than the chain where the sum of squared
residuals is lower by more than what as many parameters as it has beyond the chain, or one, gain by
chance (`exclusion.limit`), also without the two neighbouring lines that gain most (`lone_lines`);
it is left out where the chain, or another of them, is better by as much.
The search is local: that none was found is no proof.

Elastic bases that give the response of a fitted chain within the scatter of the lines.

A damped drive on an elastic base has other responses than a chain of three masses or more, but
often hardly other ones: the damping alone distinguishes them. So the drive of n - 1 masses on a
base with a spring and a damper to the ground, force and sensor between base and mass 1, is fitted
to the response G of the chain, with friction b1 between base and mass 1 where the chain has
friction to the ground. With r_k = G_base / G - 1 at the lines and rho_k their scatter (`scatter`),

    T = sum_k |r_k|^2 / rho_k^2

is what the data can know of the difference: a test between both responses, known exactly, finds it
at level alpha with a chance of Phi(sqrt(T) - z_alpha), Phi the normal distribution and z_alpha its
quantile. Where that is one half or less, sqrt(T) <= z_alpha, the base is within the scatter.

Each mode of the chain may be that of the base; the chain's undamped modes are the starts.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from math import inf

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.special import ndtri

from disting.fit.judge.candidate import Candidate, Scatters, values_of
from disting.fit.judge.exclusion import LEVEL, limit
from disting.fit.judge.explanation import explanation, line_frequencies
from disting.fit.judge.look_alikes import (
    RUBBING,
    LookAlike,
    LookAlikeKind,
    base_text,
    values_on_elastic_base,
)
from disting.fit.search.data import WhitenedCost
from disting.fit.search.estimate import Task
from disting.fit.search.joint import AnyCost
from disting.fit.search.modes import row
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.statistics.lone_lines import lone_lines
from disting.statistics.scatter import Scatter

SOFT = 1e-9  # smallest damping of a start, as a share of the stiffness per rad/s
STEPS_OF_A_BASE = 60  # evaluations of a fit
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
        (_fit_base(start, wanted, omega, rho) for start in starts_on_base(chain, at)),
        key=lambda fit: fit[0],
    )
    near = dict[str, LookAlike]()
    for cost, there in fits:
        if np.sqrt(cost) <= -ndtri(LEVEL):
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


def _fit_base(
    start: Mapping[str, float], wanted: Complex, omega: Real, rho: Real
) -> tuple[float, dict[str, float]]:
    """T and the values of the best base near a start."""
    names, s = list(start), np.asarray(1j * omega, dtype=np.complex128)

    def residual(logarithms: Real) -> Real:
        there = dict(zip(names, np.exp(logarithms), strict=True))
        off = (wanted / on_base(there, s) - 1) / rho
        return np.concatenate([off.real, off.imag])

    found = least_squares(
        residual,
        np.log(list(start.values())),
        method="trf",
        x_scale="jac",
        max_nfev=STEPS_OF_A_BASE,
    )
    values = {n: float(v) for n, v in zip(names, np.exp(found.x), strict=True)}
    return 2 * float(found.cost), dict(sorted(values.items()))


SIZES = (3, 4)  # masses of a chain that is compared: two on a base are one more look-alike
STEPS, AGAIN = 80, 20  # evaluations of a fit, and of one that starts near its end
FARTHEST = 12.0  # of a value from its start, in its logarithm
BEYOND = 1e6  # residual that stands for no number

Values = Mapping[str, float]
Mode = tuple[float, float]  # square of a frequency [rad/s], and modal mass


@dataclass(frozen=True, slots=True)
class Outside:
    """A machine outside the candidates that explains the data, as text, with fitted values in SI
    units and its chi2 per line on the judged data; whether it does so better than the chain;
    `apart`: the largest share by which both responses differ at a line.
    """

    kind: LookAlikeKind
    text: str
    values: Values
    chi2: float
    is_better: bool
    apart: float


@dataclass(frozen=True, slots=True)
class _Machine:
    """Force per velocity at mass 1 as a function of values and s, and where its fit starts."""

    kind: LookAlikeKind
    text: Callable[[Values], str]
    impedance: Callable[[Values, Complex], Complex]
    start: Values


def machines_outside(
    candidate: Candidate, task: Task, judging: AnyCost, scatters: Scatters, bases: bool = True
) -> tuple[Outside, ...]:
    """Return the machines outside the candidates that explain the data on which a chain is judged,
    as well as it or better, the best first; `bases`: also drives on an elastic base, which may be
    candidates themselves.

    None of several responses, where values are given or bounded, or without dampers.
    """
    if not _is_compared(candidate.chain) or len(task.cost.parts) > 1:
        return ()
    if task.bounds or any(task.fixed.values()):  # a damper fixed to zero is none
        return ()
    pairs = zip((task.cost, judging), scatters, strict=True)
    fitted, judged = (
        _prepare_judging(candidate, replace(task, cost=cost), known) for cost, known in pairs
    )
    found = [
        outside
        for machine in _machines(candidate, bases)
        if all(0 < value < inf for value in machine.start.values())
        for outside in _judge_machine(
            machine, _with_friction_shown(machine, fitted), judged, candidate.n_parameters
        )
    ]
    chance = limit(1, judged.whitened.known.freedom) / judged.whitened.n_residuals
    best = dict[str, Outside]()
    for outside in sorted(found, key=lambda outside: outside.chi2):
        if not best or outside.chi2 <= next(iter(best.values())).chi2 + chance:
            best.setdefault(outside.text, outside)
    return tuple(best.values())


def _is_compared(chain: Chain) -> bool:
    """A damped chain of such a size with force and sensor at mass 1."""
    ports = chain.act_minus, chain.act_plus, chain.meas_minus, chain.meas_plus
    return chain.n_masses in SIZES and chain.damped and not chain.gap and ports == (0, 1, 0, 1)


@dataclass(frozen=True, slots=True, eq=False)
class _Seen:
    """Data with their scatter, the response of the chain at their lines, and what turns a velocity
    per force into a response: sensor, lag and dead time; shape (n_f,) each.
    """

    whitened: WhitenedCost
    s: Complex
    response: Complex
    factor: Complex

    def residual(self, machine: _Machine, values: Values) -> Real:
        """Residuals of a machine in units of the scatter, shape (2 n_f,)."""
        with np.errstate(all="ignore"):
            found = self.whitened.residual(self.factor / machine.impedance(values, self.s))
        return np.clip(np.nan_to_num(found, nan=BEYOND), -BEYOND, BEYOND)


def _prepare_judging(candidate: Candidate, task: Task, known: Scatter) -> _Seen:
    response = task.plant(candidate.chain).response(values_of(candidate.estimate, task))
    (part,) = task.cost.parts
    s = np.asarray(1j * part.measured.omega, dtype=np.complex128)
    factor = response * impedance(_plain(candidate), s)
    return _Seen(WhitenedCost(task.cost, known), s, response, factor)


def _plain(candidate: Candidate) -> Values:
    """Masses, springs and dampers of a chain."""
    return {n: v for n, v in candidate.estimate.parameters.items() if n[0] != "T"}


def _with_friction_shown(machine: _Machine, fitted: _Seen) -> Values:
    """The best values of a machine, without friction where the data do not show it."""
    values = _search(machine, fitted)
    if "b1" not in values:
        return values
    start = {name: value for name, value in values.items() if name != "b1"}
    without = _search(replace(machine, start=start), fitted, AGAIN)
    costs = [float(np.sum(fitted.residual(machine, at) ** 2)) for at in (values, without)]
    shown = costs[1] - costs[0] > limit(1, fitted.whitened.known.freedom)
    return values if shown else without


def _search(machine: _Machine, fitted: _Seen, steps: int = STEPS) -> Values:
    """The values of a machine that fit the data best, near its start."""
    names = list(machine.start)
    start = np.log([machine.start[name] for name in names])

    def residual(logarithms: Real) -> Real:
        return fitted.residual(machine, _name_values(names, logarithms))

    found = least_squares(
        residual,
        start,
        bounds=(start - FARTHEST, start + FARTHEST),
        x_scale="jac",
        max_nfev=steps,
    )
    return _name_values(names, found.x)


def _name_values(names: Sequence[str], logarithms: Real) -> Values:
    return dict(zip(names, map(float, np.exp(logarithms)), strict=True))


def _judge_machine(
    machine: _Machine, values: Values, judged: _Seen, n_parameters: int
) -> Iterator[Outside]:
    """Find machines other than the chain with this number of parameters that the judged data
    support; none where they do not explain the data, or the chain is better.
    """
    cost, known = judged.whitened.cost, judged.whitened.known
    own, other = judged.whitened.residual(judged.response), judged.residual(machine, values)
    (part,) = cost.parts
    fitted = explanation(other, np.ones(other.size), part, known)
    chance = limit(max(1, len(values) - n_parameters), known.freedom) * max(1.0, fitted.chi2)

    def is_shown(kept: NDArray[np.bool_]) -> bool:
        return float(np.sum(own[kept] ** 2 - other[kept] ** 2)) > chance

    if not fitted.explains or float(other @ other - own @ own) > chance:
        return
    is_better = lone_lines(own, other, line_frequencies(cost), is_shown) is None
    there = judged.factor / machine.impedance(values, judged.s)
    apart = float(np.max(np.abs(there / judged.response - 1)))
    yield Outside(
        machine.kind,
        machine.text(values),
        dict(sorted(values.items())),
        fitted.chi2,
        is_better,
        apart,
    )


def _machines(candidate: Candidate, bases: bool) -> Iterator[_Machine]:
    """The machines that are fitted, each with its start."""
    chain, values = candidate.chain, _plain(candidate)
    for start in starts_on_base(chain, values) if bases else ():
        yield _Machine(LookAlikeKind.ELASTIC_BASE, text_on_base, on_base, start)
    for rows in _shared_out(_held_modes(values), chain.n_masses):
        yield _branch(rows, values, chain)


def _branch(rows: Sequence[Sequence[Mode]], values: Values, chain: Chain) -> _Machine:
    """The branch whose rows have these modes where mass 1 is held; dampers as the chain's are."""
    start, edges, ends = {"m1": values["m1"]}, list[tuple[int, int]](), list[list[int]]()
    share = damping_share(chain, values)
    for modes in rows:
        first = 2 + len(edges)
        masses, springs = _row_behind(modes)
        ends.append([1, *range(first, first + len(masses))])
        edges += pairwise(ends[-1])
        for (i, j), mass, spring in zip(pairwise(ends[-1]), masses, springs, strict=True):
            start |= {f"m{j}": mass, f"k{i}{j}": spring, f"d{i}{j}": share * spring}
    grounded = sum(values[f"b{i}"] for i in chain.ground_dampers)
    start |= {"b1": max(grounded, SOFT)} if chain.ground_dampers else {}

    def text(at: Values) -> str:
        joints = [*(f"{i}={j}" for i, j in edges), *["1-#"] * ("b1" in at)]
        return f"{', '.join(joints)}; F1; S1"

    def side_by_side(at: Values, s: Complex) -> Complex:
        loads = sum(_load(at, row_masses, s) for row_masses in ends)
        return np.asarray(at["m1"] * s + at.get("b1", 0.0) + loads)

    return _Machine(LookAlikeKind.BRANCH, text, side_by_side, start)


def _load(values: Values, masses: Sequence[int], s: Complex) -> Complex:
    """Force per velocity of mass 1 of a row behind it: masses[0] is 1."""
    behind = np.zeros_like(s)
    for i, j in reversed([*pairwise(masses)]):
        own = values[f"m{j}"] * s + behind
        joint = values[f"k{i}{j}"] / s + values[f"d{i}{j}"]
        behind = own * joint / (own + joint)
    return behind


def _held_modes(values: Values) -> list[Mode]:
    """z_i and mu_i of an undamped chain whose mass 1 is held."""
    n = sum(name[0] == "m" for name in values)
    m = np.array([values[f"m{i}"] for i in range(2, n + 1)])
    k = np.array([values[f"k{i}{i + 1}"] for i in range(1, n)])
    stiffness = np.diag(k + np.append(k[1:], 0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    squares, shapes = np.linalg.eigh(stiffness / np.sqrt(np.outer(m, m)))
    modal = k[0] ** 2 * shapes[0] ** 2 / (m[0] * squares**2)
    return [(float(z), float(mu)) for z, mu in zip(squares, modal, strict=True)]


def _shared_out(modes: Sequence[Mode], n: int) -> Iterator[list[list[Mode]]]:
    """Each way to share out modes among two rows or more, of at most two modes each."""
    yield [[mode] for mode in modes]
    if n == 4:
        for k in range(3):
            yield [[mode for i, mode in enumerate(modes) if i != k], [modes[k]]]


def _row_behind(modes: Sequence[Mode]) -> tuple[list[float], list[float]]:
    """Masses and springs, from mass 1 on, of a row with one mode or two.

    >>> _row_behind([(4.0, 0.5)])
    ([0.5], [2.0])
    >>> masses, springs = _row_behind(_held_modes(
    ...     {"m1": 1.0, "m2": 2.0, "m3": 3.0, "k12": 5.0, "k23": 7.0}))
    >>> [round(x, 9) for x in (*masses, *springs)]
    [2.0, 3.0, 5.0, 7.0]
    """
    squares, modal = np.array(modes).T
    stiff = squares * modal
    spring, mass = float(stiff.sum()), float(modal.sum())
    if len(modes) == 1:
        return [mass], [spring]
    # 1 / D - 1 / spring: the whole mass, and one mode at the zero of sum stiff / (x + square)
    zero = float(stiff @ squares[::-1] / stiff.sum())
    share = 1 / (zero * float(np.sum(stiff / (squares - zero) ** 2)))
    masses, springs = row(np.array([0.0, zero]), np.array([1 / mass, share]))
    return masses, [spring, *springs[:-1]]
