"""Structures that the data do not exclude, each with all that is known of it.

`choice` selects them. What contains the selected one (`containment`), or another one with
parameters that the data do not determine, is not excluded either, and by no experiment while the
smaller one is true: it is named, and no rival. And what behaves as one of them does, for exactly
these values, is not excluded either, by this or any other data of this force and sensor: other
structures of as many masses, anywhere in the catalogue, with any ground dampers, and other values
of its own.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from disting.equivalence import Origin, Signs
from disting.equivalence.search import chain_equivalents
from disting.fit.judge.alternatives import Limits
from disting.fit.judge.candidate import Candidate, Scatters, at_other_values
from disting.fit.judge.explanation import merge, noises, scatters
from disting.fit.judge.interval import Interval, intervals
from disting.fit.judge.joint_verdicts import behaves_alike
from disting.fit.search.candidates import listed_form, reference
from disting.fit.search.containment import contains
from disting.fit.search.descent import fine
from disting.fit.search.estimate import Task
from disting.fit.search.joint import AnyCost
from disting.model.chain import Chain, Damper
from disting.model.family import Family
from disting.model.names import chain_of_whole_name
from disting.model.presentation import plural, summary
from disting.statistics.covariance import expected_deviation
from disting.statistics.practical import practical
from disting.store.scheduling import map_tasks

# masses up to which every set of ground dampers is looked at; beyond, sets as large as the member's
EVERY_SET = 4
NOTHING = 1e-90  # a value that is smaller, or zero, has no effect; exact numbers are no smaller
APART = 3.0  # standard errors between training and test from which on a parameter disagrees
QUANTILE = 1.959964  # of the normal distribution, for bands of 95 %
STRONGEST = 2  # frequencies that are named, at which two structures differ most
WIDE = 1.3  # ratio of two such frequencies, at least


@dataclass(frozen=True)
class Twin:
    """A structure with positive parameters that has the same transfer function; `free_choices`
    = dimension of its family.
    """

    chain: Chain
    parameters: dict[str, float]
    free_choices: int = 0

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value:.4g}" for name, value in self.parameters.items())
        return summary(self, f"{self.name}, {values}")

    @property
    def name(self) -> str:
        """Such as 3:11+b1."""
        return reference(self.chain)


@dataclass(frozen=True)
class Disagreement:
    """A parameter that training and test data give differently: values, and their distance in
    standard errors.
    """

    name: str
    train: float
    test: float
    distance: float


@dataclass(frozen=True)
class Member:
    """A structure that the data do not exclude; `open` names those that may be equivalent;
    `intervals` of 95 % of its fitted parameters.

    `exchanged`: the candidate at each other set of values with exactly the same response, such as
    that of a drive on an elastic base of which the other resonance is the base's.

    `contains`: the simpler member that it contains, which makes it no rival; equivalents of it are
    not searched. `differs`: frequencies [Hz] at
    which it differs most from the first member, and by how much (0.01 = 1 % or 0.01 rad).
    """

    candidate: Candidate
    twins: tuple[Twin, ...]
    open: tuple[str, ...]
    disagreements: tuple[Disagreement, ...]
    intervals: dict[str, Interval]
    contains: Chain | None = None
    differs: tuple[tuple[float, float], ...] = ()
    exchanged: tuple[Candidate, ...] = ()

    def __repr__(self) -> str:
        return summary(
            self, f"{self.name}" + (f", {plural(len(self.twins), 'twin')}" if self.twins else "")
        )

    @property
    def name(self) -> str:
        """Such as 2:1+b2+delay, as the commands read it."""
        return reference(self.candidate.chain)

    @property
    def unsure(self) -> dict[str, Interval]:
        """The intervals of what is known badly: those that hold zero or have no end, or are as wide
        as the value itself.
        """
        values = self.candidate.estimate.parameters
        return {n: (a, b) for n, (a, b) in self.intervals.items() if b - a > values[n] or not a}


def members(
    left: Sequence[Candidate],
    task: Task,
    test: AnyCost | None,
    own_scatters: Scatters,
    limits: Limits,
    executor: Executor | None,
    progress: Callable[[str, int, int], object] = lambda what, done, total: None,
) -> tuple[Member, ...]:
    """The candidates that are left, in their order, as members of the set."""
    inside = {c.chain: _find_contained(c, left) for c in left}
    chosen = [c for c in left if inside[c.chain] is None]
    rows = [
        (c.chain, {n: c.estimate.parameters[n] for n in c.chain.parameters}, dict(limits))
        for c in chosen
    ]
    twins_of = dict[Chain, tuple[tuple[Twin, ...], tuple[str, ...]]]()
    for (chain, values, _), both in map_tasks(twins, rows, executor):
        twins_of[chain] = _in_all(chain, values, *both, task)
        progress("equivalents", len(twins_of), len(rows))
    others = {
        c.chain: _exchange_values(c, twins_of[c.chain][0], task, own_scatters) for c in chosen
    }
    return tuple(
        Member(
            c,
            *twins_of.get(c.chain, ((), ())),
            disagreements=disagreements(c, task, test) if test and c.chain in twins_of else (),
            intervals=_intervals(c, others[c.chain], task, own_scatters)
            if c.chain in twins_of
            else {},
            contains=inside[c.chain],
            differs=_differs(left[0], c, test or task.cost, task),
            exchanged=others.get(c.chain, ()),
        )
        for c in left
    )


def _exchange_values(
    candidate: Candidate, the_twins: Sequence[Twin], task: Task, own_scatters: Scatters
) -> tuple[Candidate, ...]:
    """The candidate at the other values of its own that give the same response."""
    form, values = listed_form(candidate.chain), candidate.estimate.parameters
    sets = (t.parameters for t in the_twins if t.chain == form.chain and not t.free_choices)
    return tuple(
        at_other_values(
            candidate,
            {n: there.get(form.renaming.get(n, n), v) for n, v in values.items()},
            task,
            own_scatters[0],
        )
        for there in sets
    )


def _intervals(
    candidate: Candidate, exchanged: Sequence[Candidate], task: Task, own_scatters: Scatters
) -> dict[str, Interval]:
    others = [other.estimate.parameters for other in exchanged]
    return intervals(candidate, task, own_scatters[0], others)


def _find_contained(candidate: Candidate, left: Sequence[Candidate]) -> Chain | None:
    """The simplest structure left that a candidate contains: the selected one, or, where the data
    do not determine all of its parameters, any.
    """
    inner = left[:1] if candidate.admissible else left
    return next((c.chain for c in inner if contains(candidate.chain, c.chain)), None)


def twins(
    chain: Chain, values: Mapping[str, float], limits: Limits
) -> tuple[tuple[Twin, ...], tuple[str, ...]]:
    """Structures with the same behaviour within the limits, and the names of those of which
    that is not known.
    """
    if chain.gap_damper:
        return _with_friction(chain, values, limits)
    the_twins, unknown, form = list[Twin](), list[str](), listed_form(chain)
    text = {form.renaming[name]: repr(max(value, NOTHING)) for name, value in values.items()}
    limits = {form.renaming.get(name, name): both for name, both in limits.items()}
    for other in _catalogue(chain):
        for listing in chain_equivalents(form.chain, text, other).listings:
            positive = [
                m
                for m in listing.members
                if m.signs is Signs.POSITIVE and m.origin is not Origin.GIVEN
            ]
            real = [
                (m.free_choices, {n: complex(v).real for n, v in m.values.items()})
                for m in positive
            ]
            the_twins += [Twin(other, p, free) for free, p in real if _inside(p, limits)]
            if not (listing.complete or positive or other == form.chain):
                unknown.append(listing.name)
    the_twins.sort(key=lambda t: (t.free_choices, len(t.chain.ground_dampers)))
    return tuple(the_twins), tuple(unknown)


def _with_friction(
    chain: Chain, values: Mapping[str, float], limits: Limits
) -> tuple[tuple[Twin, ...], tuple[str, ...]]:
    """The same of a chain with a damper across the gap, whose equivalents no theorem on chains
    lists.

    At force and sensor it adds d s to 1/G. It is the only term in s of 1/G at low frequencies,
    where the free part moves as one mass, so that G determines d and the response without it:
    structures that are equivalent without it are so with it. Of force and sensor elsewhere this is
    not known.
    """
    name = Damper(chain.gap).parameter
    if not chain.collocated or (chain.act_minus, chain.act_plus) != (chain.gap, chain.gap + 1):
        return (), (f"others than {reference(chain)}",)
    bare_values = {n: x for n, x in values.items() if n != name}
    found, unknown = twins(replace(chain, gap_damper=False), bare_values, limits)
    the_twins = (
        Twin(other, _in_order(other, twin.parameters | {new: values[name]}), twin.free_choices)
        for twin in found
        for other, new in _damped_at_port(twin.chain)
    )
    plain = (chain_of_whole_name(text, chain.damped, chain.sensor) for text in unknown)
    damped = (reference(other) for c in plain if c for other, _ in _damped_at_port(c))
    return tuple(t for t in the_twins if _inside(t.parameters, limits)), tuple(damped)


def _in_order(chain: Chain, values: Mapping[str, float]) -> dict[str, float]:
    return {name: values[name] for name in chain.parameters}


def _damped_at_port(chain: Chain) -> Iterator[tuple[Chain, str]]:
    """The chain with a damper at its force, and its name; none where no chain has it."""
    ends = chain.act_minus, chain.act_plus
    if chain.collocated and chain.gap and ends == (chain.gap, chain.gap + 1):
        yield replace(chain, gap_damper=True), Damper(chain.gap).parameter
    elif chain.collocated and not chain.gap:
        dampers = tuple(sorted({*chain.ground_dampers, chain.act_plus}))
        yield replace(chain, ground_dampers=dampers), f"b{chain.act_plus}"


def _in_all(
    chain: Chain,
    values: Mapping[str, float],
    the_twins: Sequence[Twin],
    unknown: Sequence[str],
    task: Task,
) -> tuple[tuple[Twin, ...], tuple[str, ...]]:
    """Structures equivalent in the first response that are so in all; for a family, of which one
    member is known, this stays open.
    """
    if len(task.cost.setups) == 1:
        return tuple(the_twins), tuple(unknown)
    kept = [
        t
        for t in the_twins
        if not t.free_choices and behaves_alike(chain, values, t.chain, t.parameters, task)
    ]
    families = [t.name for t in the_twins if t.free_choices]
    return tuple(kept), tuple(dict.fromkeys([*unknown, *families]))


def _catalogue(chain: Chain) -> Iterable[Chain]:
    """Every chain of as many masses, with every set of ground dampers; lag and dead time as
    given.
    """
    n = chain.n_masses
    sizes = range(n + 1) if n <= EVERY_SET else [len(chain.ground_dampers)]
    sets = [chosen for size in sizes for chosen in combinations(range(1, n + 1), size)]
    for plain in Family(n, chain.damped, chain.sensor):
        for chosen in sets:
            yield replace(plain, ground_dampers=chosen, lag=chain.lag, dead_time=chain.dead_time)


def _inside(values: Mapping[str, float], limits: Limits) -> bool:
    return all(
        low * (1 - 1e-9) <= values.get(name, low) <= high * (1 + 1e-9)
        for name, (low, high) in limits.items()
    )


def disagreements(candidate: Candidate, task: Task, test: AnyCost) -> tuple[Disagreement, ...]:
    """Parameters that a fit of the same structure to the test data moves by more than `APART`
    standard errors of both fits.
    """
    names, other_task = task.names(candidate.chain), replace(task, cost=test)
    start = np.array([candidate.estimate.parameters[n] for n in names])
    box, plant = other_task.box(names), other_task.plant(candidate.chain)
    if not box.free.any():
        return ()
    p, _ = fine(plant, test, box, start)
    residual, columns = test.of(plant, p)
    scatter = merge(scatters(test, [plant.response(p)]))
    free = [n for n, chosen in zip(names, box.free, strict=True) if chosen]
    sigma, columns = test.scatter(scatter), columns[:, box.free]
    other = practical(
        columns, free, noises(test, residual, sigma, expected_deviation(columns, sigma))
    ).relative_errors
    values = dict(zip(names, map(float, p), strict=True))
    the_disagreements = []
    for name, error in candidate.standard_errors.items():
        both = float(np.hypot(error, other[name] * values[name]))
        distance = abs(values[name] - candidate.estimate.parameters[name]) / both if both else 0.0
        if distance > APART:
            the_disagreements.append(
                Disagreement(name, candidate.estimate.parameters[name], values[name], distance)
            )
    return tuple(the_disagreements)


def _differs(
    first: Candidate, other: Candidate, cost: AnyCost, task: Task
) -> tuple[tuple[float, float], ...]:
    """Frequencies at which two fitted candidates differ most, largest difference first."""
    if first is other:
        return ()
    other_task = replace(task, cost=cost)
    both = [
        other_task.plant(c.chain).response(np.array(list(c.estimate.parameters.values())))
        for c in (first, other)
    ]
    size = np.abs(np.log(both[1] / both[0]))
    hertz = np.concatenate([part.measured.frequency for part in cost.parts])
    pairs = list[tuple[float, float]]()
    for i in np.argsort(-size):
        if all(max(hertz[i] / f, f / hertz[i]) > WIDE for f, _ in pairs):
            pairs.append((float(hertz[i]), float(size[i])))
        if len(pairs) == STRONGEST:
            break
    return tuple(pairs)
