"""Amount of measuring that distinguishes two structures: power of the test of `rival`, and the
effort for more of it.

The test excludes the rival at the level 1 % if T exceeds the quantile c of chi2 with s degrees of
freedom; with the model true it does so with the probability (the power)

    P(chi2_s(lambda) > c),    chi2_s(lambda): noncentral chi2,

95 % for lambda = 17.8 and s = 1, where the scatter is known; a fit that has to find it does less
well (`sample`). lambda is proportional to 1/rho^2: twice the periods, or amplitude
times sqrt 2, or twice the lines within the same range, double it.

s is the rank of the smallest structure that contains both, less that of the rival: what a damper,
a lag, a dead time adds to what data determine. Structures that differ in more than these have no
such structure; there the ranks of the model and of the rival are compared. s is at least 1.

A design for two structures: G. Hunter, A. Reiner, Designs for discriminating between two rival
models, 1965; A. Atkinson, V. Fedorov, The design of experiments for discriminating between two
rival models, 1975.

The test as a fit will run it: with a scatter that it has to find in the data first.

A fit knows the scatter of a line from one measurement, or a few (`noise.scatter`): here too high,
there too low, least well at the ends of the band and where noise of another kind may hide. With
weights w = sigma / sigma_found of the lines, e = noise in units of sigma, and d = what the rival
misses, less what its parameters make up for under these weights (`exclusion`),

    T = (d'(d + w e))^2 / d'd,    E e e' = 1,

is nearly distributed as v chi2_s(lambda / v) with lambda = d'd and v = d' w^2 d / d'd. The power is
the mean over simulated measurements, each with its own weights and its own limit of T (F, by the
degrees of freedom of the scatter found). Noise is drawn from a fixed seed.
"""

from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from math import inf, sqrt
from typing import Any

import numpy as np
from scipy.optimize import brentq

from disting.conditions.inclusion import Inclusion
from disting.errors import InputError
from disting.files import Format
from disting.fit.judge.exclusion import LEVEL, basis_of, limit, surplus, trials, union
from disting.fit.search.containment import contains
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.model.presentation import NotebookTable, summary
from disting.network.network import Network
from disting.planning.effort import Effort, effort_of
from disting.planning.rival import (
    AnyStructure,
    Rival,
    Trust,
    fitted_rival,
    name_of,
    sensor_of,
    shown_as,
)
from disting.statistics.scatter import Scatter, scatter
from disting.verdict.comparison import compare
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.result import Relation, Verdict

POWER = 0.95  # wanted probability of excluding one that is not
LARGEST = 1e6  # noncentrality that is looked for, at most
BEYOND = 40.0  # standard deviations: a normal variable lies there with a probability of 1e-350
DRAWS = 60  # simulated measurements: the mean of their powers is known within a point or two
SEED = 20_251


@dataclass(frozen=True, slots=True, eq=False)
class Sample:
    """Of simulated measurements, shape (n,) each: `limits` of T, `shares` = lambda as they estimate
    it per lambda, `widths` = v; s = `surplus`.
    """

    limits: Real
    shares: Real
    widths: Real
    surplus: int

    def power(self, noncentrality: float) -> float:
        """Probability of excluding the rival if the model is true."""
        bent = noncentrality * self.shares / self.widths
        return float(np.mean(_exceeding(self.limits / self.widths, self.surplus, bent)))

    def needed(self, wanted: float = POWER) -> float:
        """Noncentrality for a power; infinite where one of a million does not reach it."""
        if self.power(LARGEST) < wanted:
            return np.inf
        return float(brentq(lambda size: self.power(size) - wanted, 1e-6, LARGEST))


def _exceeding(limits: Real, freedom: int, noncentrality: Real) -> Real:
    """P(chi2_s(lambda) > c) for c = `limits` and s = `freedom`, shape (n,) each.

    SciPy's series is not a number for lambda of about 1e12 and more. With one normal variable z,
    chi_s(lambda) >= sqrt(lambda) + z, so the probability is 1 to double precision where sqrt(c)
    lies 40 below sqrt(lambda).
    """
    from scipy.stats import ncx2  # takes a second to import

    is_certain = np.sqrt(noncentrality) - np.sqrt(limits) > BEYOND
    within = np.where(is_certain, 0.0, noncentrality)
    return np.where(is_certain, 1.0, ncx2.sf(limits, freedom, within))


def ideal(surplus: int = 1, level: float = LEVEL) -> Sample:
    """The test with a scatter that is known.

    >>> round(ideal().power(17.8), 3), round(ideal(2).needed(), 1)
    (0.95, 20.6)
    """
    ones = np.ones(1)
    return Sample(ones * limit(surplus, np.inf, level=level), ones, ones, surplus)


def simulate(rival: Rival, surplus: int, level: float, repeats: int) -> Sample:
    """The test with the scatter as estimated from this number of repeats."""
    source = np.random.default_rng(SEED)
    residual, columns = rival.cost.of(rival.plant, rival.best.p)
    limits, shares, widths = np.empty((3, DRAWS))
    for i in range(DRAWS):
        exact = [part.measured for part in rival.cost.parts]
        each = [_estimate_scatter(response, rival.rho, source, repeats) for response in exact]
        ratios = (
            np.abs(g.G) / k.size * rival.rho / k.rho for g, k in zip(exact, each, strict=True)
        )
        weights = np.concatenate([np.tile(ratio, 2) for ratio in ratios])
        basis, missed = basis_of(columns * weights[:, None]), residual * weights
        d = missed - basis @ (basis.T @ missed)
        shares[i] = d @ d
        widths[i] = (d * weights**2) @ d / shares[i]
        limits[i] = limit(surplus, min(own_scatter.freedom for own_scatter in each), level=level)
    return Sample(limits, shares / rival.noncentrality, widths, surplus)


def _estimate_scatter(
    exact: FrequencyResponse, rho: Real, source: np.random.Generator, repeats: int
) -> Scatter:
    """The scatter estimated from a simulated measurement."""
    shape = (2, repeats, len(exact))
    real, imaginary = source.normal(size=shape)
    error: Complex = real + 1j * imaginary
    each = exact.G * (1 + np.sqrt(repeats) * rho * error)
    mean = replace(exact, G=each.mean(axis=0))
    if repeats > 1:
        spread = np.std(each, axis=0, ddof=1) / np.sqrt(repeats)
        mean = replace(mean, deviation=spread, freedom=2.0 * (repeats - 1))
    return scatter(mean, [exact.G])


class Answer(StrEnum):
    """Use of more measurements."""

    ENOUGH = "enough"
    MORE = "more"
    SAME = "same"  # the rival fits within rounding
    IMPOSSIBLE = "impossible"  # the verdict says that the structures are indistinguishable


def power(noncentrality: float, surplus: int = 1, level: float = LEVEL) -> float:
    """Probability of excluding the rival if the model is true and the scatter known.

    >>> round(power(17.8), 3), round(power(0.0), 3)
    (0.95, 0.01)
    """
    return ideal(surplus, level).power(noncentrality) if noncentrality > 0 else level


@dataclass(frozen=True, eq=False)
class Plan(NotebookTable):
    """Plan for one rival; `rival` is None where the verdict makes a fit unnecessary, `verdict`
    where none was requested. `repeats`: of the measurement, from which a fit finds the scatter;
    None where it is known.
    """

    model: AnyStructure
    values: Mapping[str, float]
    other: AnyStructure
    verdict: Verdict | None
    surplus: int
    rival: Rival | None
    repeats: int | None = None

    def __repr__(self) -> str:
        size = f", lambda {self.noncentrality:.3g}" if self.noncentrality > 0 else ""
        return summary(self, f"{self.names[0]} against {self.names[1]}: {self.answer}{size}")

    @property
    def names(self) -> tuple[str, str]:
        """Model and rival, as the commands read them."""
        return name_of(self.model), name_of(self.other)

    @property
    def answer(self) -> Answer:
        """Use of more measurements."""
        if self.rival is None:
            return Answer.IMPOSSIBLE
        if self.rival.is_same:
            return Answer.SAME
        return Answer.ENOUGH if self.power >= POWER else Answer.MORE

    @property
    def is_contained(self) -> bool:
        """True if the rival contains the model, by its elements or by the verdict on inclusion; the
        verdict applies to this force and sensor only.
        """
        both = None if self.verdict is None else self.verdict.inclusions
        is_known = both is not None and both.closure.inclusion is Inclusion.LEFT_IN_RIGHT
        return is_known or contains(self.other, self.model)

    @property
    def joint(self) -> Chain | None:
        """The smallest chain that contains both, where they differ in dampers to the ground, lag
        and dead time alone.
        """
        if isinstance(self.model, Chain) and isinstance(self.other, Chain):
            return union(self.model, self.other)
        return None

    @property
    def noncentrality(self) -> float:
        """lambda; 0 where the rival is equivalent."""
        return 0.0 if self.rival is None or self.rival.is_same else self.rival.noncentrality

    @property
    def power(self) -> float:
        """With the effort at hand."""
        return self.power_at(self.noncentrality)

    def power_at(self, noncentrality: float) -> float:
        """With an effort of which this is lambda."""
        return self.test.power(noncentrality) if noncentrality > 0 else self.level

    @cached_property
    def test(self) -> Sample:
        """As a fit runs it."""
        if self.repeats is None or not self.noncentrality > 0:
            return ideal(self.surplus, self.level)
        assert self.rival is not None
        return simulate(self.rival, self.surplus, self.level, self.repeats)

    @property
    def level(self) -> float:
        """Of the test: divided by the places where an element of the model is searched."""
        model, other = self.model, self.other
        lines = 1 if self.rival is None else len(self.rival.rho)
        if isinstance(model, Chain) and isinstance(other, Chain):
            return LEVEL / trials(other, model, lines)
        return LEVEL

    @property
    def needed(self) -> float:
        """Noncentrality for a power of 95 %."""
        return self.test.needed()

    @property
    def factor(self) -> float:
        """Multiple of the effort at hand (periods, lines, square of the amplitude) that is needed;
        infinite where no effort is enough.
        """
        size = self.noncentrality
        return self.needed / size if size > 0 else inf


def plan(
    model: AnyStructure,
    values: Mapping[str, float],
    rival: AnyStructure,
    omega: Real | None = None,
    rho: Real | None = None,
    *,
    noise: float | FrequencyResponse | None = None,
    band: tuple[float, float] | None = None,
    lines: int | None = None,
    repeats: int | None = None,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Plan:
    """Power of data of `model` with these parameters against `rival`.

    The data: `lines` in a `band` [Hz] (default: 120), evenly spaced on a logarithmic scale, of
    relative noise `noise`; or the lines of a measured response `noise`, with their scatter; or
    angular frequencies `omega` [rad/s] whose lines scatter by `rho`, shape (n_f,) each. A fit finds
    the scatter from so many `repeats` (module `sample`), by default those of a measured response,
    else it knows it (None). Raises InputError for data that are named in two ways or not at all,
    for missing, unknown or negative values (not required where both are equivalent), and for a
    chain together with a network.
    """
    if noise is None and omega is not None and rho is not None and not (band or lines):
        effort = Effort(omega, rho, "given", repeats)
    elif noise is not None and omega is None and rho is None:
        effort = effort_of(model, values, noise, band=band, lines=lines, repeats=repeats)
    else:
        raise InputError(
            "give the data to plan for as noise=0.02, band=(5, 300), or as omega and rho"
        )
    engine = engine or Engine()
    rival = shown_as(rival, sensor_of(model))
    verdict = compare(model, rival, engine=engine) if model != rival else None
    if verdict is not None and verdict.relation is Relation.INDISTINGUISHABLE:
        return Plan(model, values, rival, verdict, 1, None)
    fit = fitted_rival(
        model,
        values,
        rival,
        effort.omega,
        effort.rho,
        store=engine.store,
        executor=executor,
        progress=progress,
    )
    return Plan(model, values, rival, verdict, _surplus(model, rival, engine), fit, effort.repeats)


def _surplus(model: AnyStructure, rival: AnyStructure, engine: Engine) -> int:
    """s of the module; of networks the ranks of both are compared."""
    if isinstance(model, Chain) and isinstance(rival, Chain):
        return surplus(model, rival, engine.settings)
    networks = [n for n in (model, rival) if isinstance(n, Network)]
    side, other = engine.general_subjects(networks)
    return max(1, side.rank - other.rank)


def plan_to_dict(the_plan: Plan) -> dict[str, Any]:
    """Plain data; `noncentrality` 0 and `factor` null where no effort is enough."""
    rival, name = the_plan.rival, the_plan.names
    plain: dict[str, Any] = {
        "format": Format.PLAN.value,
        "model": name[0],
        "parameters": dict(the_plan.values),
        "rival": name[1],
        "answer": the_plan.answer.value,
        "relation": the_plan.verdict.relation.value if the_plan.verdict is not None else None,
        "reason": the_plan.verdict.sentence if the_plan.verdict is not None else None,
        "level": the_plan.level,
        "wanted_power": POWER,
        "noncentrality": the_plan.noncentrality,
        "power": the_plan.power,
    }
    if rival is None:
        return plain
    more = the_plan.noncentrality > 0
    return plain | {
        "surplus_parameters": the_plan.surplus,
        "repeats": the_plan.repeats,
        "needed_noncentrality": the_plan.needed,
        "factor": the_plan.factor if more else None,
        "noise": typical(rival.rho),
        "largest_noise": typical(rival.rho) / sqrt(the_plan.factor) if more else None,
        "best_fit": rival.parameters,
        "trust": rival.trust.value,
        "starts": [rival.best.reached, len(rival.best.costs)],
        "contains": the_plan.is_contained,
        "limits": {name: limit.value for name, limit in rival.limits.items()},
    }


def typical(rho: Real) -> float:
    """The equal scatter of all lines that counts as much: 1/rho^2 is the mean of that of the
    lines.
    """
    return float((rho**-2.0).mean() ** -0.5)


def is_trusted(the_plan: Plan) -> bool:
    """Return True if several starts reached the rival's best fit."""
    return the_plan.rival is None or the_plan.rival.trust is Trust.AGREED
