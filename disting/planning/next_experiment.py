"""Predicted result of a further experiment on the structures that a fit left, each at its values.

The experiment gives the responses G_A, of the one that is assumed true, and G_B on lines that
scatter by rho in ln |G| and in arg G. With r_k = |G_B/G_A - 1|_k / rho_k

    largest = max_k r_k,    lambda = sum_k r_k^2.

lambda is the noncentrality of the test of `rival`, of the further response alone and before a rival
refits. The smallest one over all parameters of the rival is at most as large, so the power that
follows from it is an upper bound. Of a structure that is known to have one parameter vector only
with the response that was measured, it is what a measurement without noise would leave.

Which mass of one structure is which of another one is not known: `least` takes the place that
differs least. A structure with several parameter vectors that the data leave is as far away as
the nearest of them.

Relations of the structures that a fit left: those that no data with this force and sensor
distinguish, and those that only the noise left together.

Over generic complex parameters to be indistinguishable is transitive, so each structure is compared
with one of each class only.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import product
from math import inf, pi

import numpy as np

from disting.experiments.experiment import MeasuredChain
from disting.experiments.menu import Costs, Gain, Item, gain
from disting.fit.judge.exclusion import LEVEL, surplus, trials
from disting.fit.search.plant import Plant
from disting.fit.search.starts import Parameters
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.model.kinds import Kind
from disting.model.question import Settings
from disting.planning.fit_file import FitRecord, Survivor
from disting.planning.power import power
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.result import Query, Relation, View

Spot = tuple[int, int]
"""(structure, counted from 0; mass)."""
LINES = 120  # where the file of a fit does not say how many


class Reason(StrEnum):
    """Of two structures that the data leave.

    EQUAL: indistinguishable by this force and sensor, over generic complex parameters; TWIN: one
    has the response of the other for its fitted values, though generic ones are distinguishable;
    NOISE: distinguishable, and noise alone leaves both; OPEN: whether they are distinguishable is
    not known.
    """

    EQUAL = "equal"
    TWIN = "same for the fitted values"
    NOISE = "noise"
    OPEN = "undecided"


@dataclass(frozen=True, slots=True)
class Stood:
    """`classes`: structures of one size, counted from 0, that are EQUAL, singles included; `rules`:
    the rule that distinguished the first ones of two classes, "" where nothing did; `across`: pairs
    of classes that are EQUAL though of two sizes.
    """

    left: tuple[Survivor, ...]
    classes: tuple[tuple[int, ...], ...]
    rules: dict[tuple[int, int], str]
    across: frozenset[tuple[int, int]] = frozenset()

    @property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """The classes of several structures."""
        return tuple(c for c in self.classes if len(c) > 1)

    def reason(self, a: int, b: int) -> Reason:
        """Of two different structures."""
        survivor, other = self.left[a], self.left[b]
        if self._class(a) == self._class(b) or self._classes(a, b) in self.across:
            return Reason.EQUAL
        if (
            survivor.chain in other.like
            or other.chain in survivor.like
            or set(survivor.like) & set(other.like)
        ):
            return Reason.TWIN
        return Reason.NOISE if self.rule(a, b) else Reason.OPEN

    def rule(self, a: int, b: int) -> str:
        """Rule by which two structures of different classes are distinguished now; "" where there
        is none.
        """
        return self.rules[self._classes(a, b)]

    def _classes(self, a: int, b: int) -> tuple[int, int]:
        low, high = sorted((self._class(a), self._class(b)))
        return low, high

    def _class(self, at: int) -> int:
        return next(k for k, members in enumerate(self.classes) if at in members)


def stood(left: Sequence[Survivor], engine: Engine, progress: Progress = silent) -> Stood:
    """Sort the structures into classes; those of other sizes are in other classes."""
    sides = [engine.subject(survivor.name, survivor.chain) for survivor in left]
    query = Query(View.EXACT, inclusion=False)
    classes = list[list[int]]()
    rules: dict[tuple[int, int], str] = {}
    across = set[tuple[int, int]]()
    for at, survivor in enumerate(left):
        progress("structures", at, len(left))
        verdicts = {}
        for number, members in enumerate(classes):
            verdicts[number] = engine.verdict(sides[members[0]], sides[at], query)
            size = left[members[0]].chain.n_masses
            same = verdicts[number].relation is Relation.INDISTINGUISHABLE
            if same and size == survivor.chain.n_masses:
                members.append(at)
                break
        else:
            rules |= {
                (number, len(classes)): verdict.decided_by
                if verdict.relation is Relation.DISTINGUISHABLE
                else ""
                for number, verdict in verdicts.items()
            }
            across |= {
                (number, len(classes))
                for number, verdict in verdicts.items()
                if verdict.relation is Relation.INDISTINGUISHABLE
            }
            classes.append([at])
    return Stood(tuple(left), tuple(map(tuple, classes)), rules, frozenset(across))


@dataclass(frozen=True, slots=True, eq=False)
class Bench:
    """Lines [rad/s] and their scatter, shape (n_f,) each, and the size of the inertia that is
    added.
    """

    omega: Real
    rho: Real
    inertia: float

    @property
    def hertz(self) -> Real:
        """Frequencies, shape (n_f,)."""
        return self.omega / (2 * pi)

    def size(self, power: int) -> float:
        """Of what adds size * s^power to a mass: as much as the inertia does in the middle of the
        lines, w = sqrt(w_1 w_n).
        """
        middle = float(np.sqrt(self.omega[0] * self.omega[-1]))
        return self.inertia * middle ** (2 - power)


@dataclass(frozen=True, slots=True, order=True)
class Step:
    """`noncentrality` lambda, `largest` difference of a line in units of its scatter, at
    `frequency` [Hz]; infinite, at 0, where the sensor moves in one of the two only.
    """

    noncentrality: float
    largest: float
    frequency: float

    @property
    def is_motion(self) -> bool:
        """True if one of them moves and the other does not."""
        return self.noncentrality == inf


STILL = Step(0.0, 0.0, 0.0)
MOVES = Step(inf, inf, 0.0)


def bench_of(named: FitRecord) -> Bench | None:
    """The lines of the fit with their typical scatter, and an inertia as large as the mean mass of
    the selected structure; None where the file does not state the lines.
    """
    if not (0 < named.low < named.high and named.scatter > 0):
        return None
    count = named.lines or LINES
    omega = 2 * pi * np.geomspace(named.low, named.high, count)
    masses = [value for name, value in named.values.items() if name[0] == "m"]
    return Bench(omega, np.full(count, named.scatter), float(np.mean(masses)))


def response_under(chain: Chain, values: Parameters, item: Item, bench: Bench) -> Complex | None:
    """Response of a chain under an item of the menu, shape (n_f,); None where the sensor does not
    move.
    """
    machine = MeasuredChain(chain, (item.experiment,))
    if machine.silent:
        return None
    structure = replace(chain.structure, ports=machine.entries[0].ports)
    power = item.kind.power
    added = () if power is None else ((item.at, power, bench.size(power)),)
    plant = Plant(structure, bench.omega, 1, item.experiment.still, added)
    return plant.response(np.array([values[name] for name in chain.parameters]))


def step(values: Complex | None, other: Complex | None, bench: Bench) -> Step:
    """Distance of another response from the one that is assumed to be true."""
    if values is None or other is None:
        return STILL if values is other else MOVES
    apart = np.abs(other / values - 1) / bench.rho
    at = int(apart.argmax())
    return Step(float(np.sum(apart**2)), float(apart[at]), float(bench.hertz[at]))


@dataclass(frozen=True, eq=False)
class Predictions:
    """The structures `left` under every item of the menu; `responses[item, k]`: those of structure
    k, one for each of its parameter vectors.
    """

    left: tuple[Survivor, ...]
    bench: Bench
    responses: Mapping[tuple[Item, int], Sequence[Complex | None]]
    settings: Settings
    costs: Costs

    def items(self, structure: int) -> tuple[Item, ...]:
        """Items that are useful if this structure is true, by kind and mass."""
        chain = self.left[structure].chain
        every = _menu(chain, self.costs)
        return tuple(i for i in every if i.is_worth(gain(chain, i) or Gain.NEW))

    @property
    def sizes(self) -> dict[str, float]:
        """Of what the menu adds, by its name."""
        sized = ((kind.name, kind.power) for kind in self.costs.kinds(2))
        return {name: self.bench.size(power) for name, power in sized if power is not None}

    def at(self, kind: Kind, own_spot: Spot, other_spot: Spot) -> Step | None:
        """The difference of two structures at these masses, the first assumed true; None where one
        has no known values.
        """
        rows = [self.responses.get((Item(kind, i), k), ()) for k, i in (own_spot, other_spot)]
        steps = [step(own_values, other, self.bench) for own_values, other in product(*rows)]
        return min(steps, default=None)

    def least(self, structure: int, item: Item, other: int) -> tuple[Step, int] | None:
        """The difference of a structure from another one wherever the place is in that, and the
        mass at which it is that small; None as in `at`.
        """
        masses = range(1, self.left[other].chain.n_masses + 1)
        pairs = [(self.at(item.kind, (structure, item.at), (other, j)), j) for j in masses]
        return min(((s, j) for s, j in pairs if s is not None), default=None)

    def power(self, structure: int, other: int, the_step: Step) -> float:
        """Probability of excluding the other one by this difference, if it is this structure."""
        if the_step.is_motion:
            return 1.0
        chains = self.left[structure].chain, self.left[other].chain
        count = trials(chains[1], chains[0], len(self.bench.omega))
        return power(the_step.noncentrality, surplus(*chains, self.settings), LEVEL / count)


def predictions(
    left: Sequence[Survivor],
    bench: Bench,
    settings: Settings | None = None,
    costs: Costs | None = None,
) -> Predictions:
    """Every structure under every item of its menu, of all kinds that have a cost."""
    costs = costs or Costs()
    responses = {
        (item, k): [
            response_under(survivor.chain, values, item, bench) for values in survivor.values
        ]
        for k, survivor in enumerate(left)
        for item in _menu(survivor.chain, costs)
    }
    return Predictions(tuple(left), bench, responses, settings or Settings(), costs)


def _menu(chain: Chain, costs: Costs) -> list[Item]:
    masses = range(1, chain.n_masses + 1)
    return [Item(kind, at) for kind in costs.kinds(chain.n_masses) for at in masses]
