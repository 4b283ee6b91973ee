"""A printed statement, its check, and what it is checked against.

Some checks fit (Fig. 12): A4 fitted to the exact frequency response of a damped A1.

Without damping the two are indistinguishable: both have rank 5 for 5 non-constant coefficients
(condition 7), so resonances and antiresonances can agree. With damping, two dampers face the
damping ratios of two poles and two zeros.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from itertools import combinations
from math import pi
from types import MappingProxyType

import numpy as np

from disting import (
    Catalog,
    Chain,
    Decisions,
    Domain,
    Engine,
    Family,
    Quantity,
    Query,
    View,
    catalog,
)
from disting.catalogs.dampers import DamperSets, DamperTable, dampers
from disting.conditions.rule import RULES
from disting.fit import Cost, Plant, Selection, Task, estimates, figure_1, select
from disting.fit.judge.modes import oscillations, poles, zeros
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Real
from disting.simulation import demo
from disting.verdict.decisions import Pair
from disting.verdict.engine import Progress, silent

GIVEN: Mapping[str, float] = MappingProxyType(
    {"m1": 0.005, "m2": 0.01, "m3": 0.01, "k12": 1000.0, "k23": 1000.0, "d12": 0.2, "d23": 0.02}
)
"""Parameters of A1 in SI units: the size of a small servo drive, its first coupling ten times
as damped as the second.
"""
LINES = 400
# the response reaches this factor below the first antiresonance and above the last resonance
BAND = 3.0


@dataclass(frozen=True, slots=True)
class Mode:
    """A resonance or antiresonance: frequencies [Hz] and damping ratios in A1 and in the fitted
    A4.
    """

    name: str
    frequencies: tuple[float, float]
    damping: tuple[float, float]

    @property
    def detuned(self) -> float:
        """Relative error of the frequency."""
        return abs(self.frequencies[1] / self.frequencies[0] - 1)

    @property
    def misdamped(self) -> float:
        """Relative error of the damping ratio."""
        return abs(self.damping[1] / self.damping[0] - 1)


@dataclass(frozen=True, eq=False)
class Refit:
    """A1 with numbers and the A4 that fits it best; `j` = cost (14) over `LINES` lines."""

    source: Chain
    fitted: Chain
    given_parameters: Mapping[str, float]
    fitted_parameters: Mapping[str, float]
    measured: FrequencyResponse
    j: float

    @property
    def modes(self) -> tuple[Mode, ...]:
        """Antiresonances and resonances of both, by rising frequency."""
        return (*self._modes("antiresonance"), *self._modes("resonance"))

    def _modes(self, kind: str) -> tuple[Mode, ...]:
        roots = zeros if kind == "antiresonance" else poles
        ours = oscillations(
            roots(self.source.structure, _vector(self.source, self.given_parameters))
        )
        theirs = oscillations(
            roots(self.fitted.structure, _vector(self.fitted, self.fitted_parameters))
        )
        pairs = enumerate(zip(ours, theirs, strict=True), 1)
        return tuple(
            Mode(
                f"{kind} {i}",
                (abs(a) / (2 * pi), abs(b) / (2 * pi)),
                (-a.real / abs(a), -b.real / abs(b)),
            )
            for i, (a, b) in pairs
        )


def refit(parameters: Mapping[str, float] = GIVEN) -> Refit:
    """The best A4 for the exact response of A1 with the given parameters."""
    family = Family(3, damped=True)
    source, target = family[1], family[4]
    p = _vector(source, parameters)
    low = abs(oscillations(zeros(source.structure, p))[0]) / BAND
    high = abs(oscillations(poles(source.structure, p))[-1]) * BAND
    omega = np.geomspace(low, high, LINES)
    measured = FrequencyResponse(omega, Plant(source.structure, omega).response(p))
    estimate = estimates([target], Task(Cost(measured)))[target]
    return Refit(
        source=source,
        fitted=target,
        given_parameters=parameters,
        fitted_parameters=estimate.parameters,
        measured=measured,
        j=estimate.j,
    )


def _vector(chain: Chain, values: Mapping[str, float]) -> Real:
    return np.array([values[name] for name in chain.parameters])


PictureKey = tuple[int, bool, View, int, Quantity]


@dataclass
class Findings:
    """Verdicts, catalogues and fits behind one engine; `sizes` = numbers of masses of the
    fitted candidates of Fig. 1.
    """

    engine: Engine = field(default_factory=Engine)
    executor: Executor | None = None
    progress: Progress = silent
    sizes: tuple[int, ...] = (1, 2, 3, 4)
    _pictures: dict[PictureKey, Decisions] = field(default_factory=dict, repr=False)
    _tables: dict[tuple[Chain, DamperSets], DamperTable] = field(default_factory=dict, repr=False)

    def picture(
        self,
        n_masses: int,
        damped: bool,
        view: View,
        markov: int = 0,
        sensor: Quantity = Quantity.ACCELERATION,
    ) -> Decisions:
        """All pairs of a family, by the conditions in one view; `markov` parameters after G_0,
        0 = all.
        """
        key = (n_masses, damped, view, markov, sensor)
        if key not in self._pictures:
            chains = enumerate(Family(n_masses, damped, sensor), 1)
            subjects = [self.engine.subject(f"A{number}", chain) for number, chain in chains]
            self._pictures[key] = self.engine.decisions(
                subjects, Query(view, markov=markov), executor=self.executor
            )
        return self._pictures[key]

    def catalog(self, n_masses: int, *, damped: bool) -> Catalog:
        """The shipped catalogue."""
        return catalog(n_masses, damped=damped)

    def dampers(self, chain: Chain, which: DamperSets = DamperSets.SINGLE) -> DamperTable:
        """Ground dampers of a chain against each other, over complex parameters, as the paper
        has them.
        """
        if (chain, which) not in self._tables:
            self._tables[chain, which] = dampers(
                chain, which, domain=Domain.COMPLEX, engine=self.engine, executor=self.executor
            )
        return self._tables[chain, which]

    @cached_property
    def train(self) -> FrequencyResponse:
        """The simulated demonstration drive, measured once."""
        return demo(0).response("acceleration")

    @cached_property
    def test(self) -> FrequencyResponse:
        """The same drive, measured again."""
        return demo(1).response("acceleration")

    @cached_property
    def selection(self) -> Selection:
        """The candidates of Fig. 1 fitted to the demonstration drive."""
        candidates = figure_1(self.sizes)
        return select(
            self.train,
            candidates,
            test=self.test,
            engine=self.engine,
            executor=self.executor,
            progress=self.progress,
        )

    @cached_property
    def refit(self) -> Refit:
        """A4 fitted to A1."""
        return refit()


class Outcome(StrEnum):
    """Whether what is found here agrees with what is printed."""

    AGREES = "agrees"
    DIFFERS = "differs"
    UNCHECKED = "cannot be checked"


@dataclass(frozen=True, slots=True)
class Observation:
    """Where verdicts can be seen: all pairs of a family, one of its models, or two of them.

    `models` as their names go on behind the number of masses: 4, 1+b2, 1+lag. With `dampers`,
    the family is that of all sets of ground dampers.
    """

    n_masses: int
    damped: bool = False
    models: tuple[str, ...] = ()
    dampers: bool = False


@dataclass(frozen=True, slots=True)
class Observed:
    """What is found here, in words, whether the printed statement holds, and where the verdicts
    that it speaks of can be seen.
    """

    value: str
    agrees: bool
    seen: tuple[Observation, ...] = ()

    @property
    def outcome(self) -> Outcome:
        """As an outcome."""
        return Outcome.AGREES if self.agrees else Outcome.DIFFERS


def families(*sizes: int, damped: bool = False) -> tuple[Observation, ...]:
    """All pairs of each family."""
    return tuple(Observation(n, damped) for n in sizes)


def models(
    n_masses: int, numbers: Iterable[int], *, damped: bool = False
) -> tuple[Observation, ...]:
    """Single models of a family."""
    return tuple(Observation(n_masses, damped, (str(number),)) for number in numbers)


def pairs(
    n_masses: int, numbers: Iterable[tuple[int, int]], *, damped: bool = False
) -> tuple[Observation, ...]:
    """Pairs of models of a family."""
    return tuple(Observation(n_masses, damped, (str(i), str(j))) for i, j in numbers)


@dataclass(frozen=True, slots=True)
class Claim:
    """One statement of the paper.

    `place` where it is printed; `text` the statement, literally where it stands in quotation
    marks; `printed` its value; `check` computes ours, None where nobody can; `reason` why it does
    not agree; `about` the subject of what differs, in a few words, "" where nothing does.
    """

    key: str
    place: str
    text: str
    printed: str
    check: Callable[[Findings], Observed] | None = None
    reason: str = ""
    about: str = ""

    def __post_init__(self) -> None:
        if self.outcome is not Outcome.AGREES and not self.reason:
            raise ValueError(f"{self.key}: what does not agree needs a reason")

    @property
    def outcome(self) -> Outcome:
        """What the check is known to give."""
        if self.check is None:
            return Outcome.UNCHECKED
        return Outcome.DIFFERS if self.about else Outcome.AGREES


def counts_of(decisions: Decisions) -> dict[str, int]:
    """Pairs by deciding condition, undecided ones under ""."""
    return {rule: n for rule, n in decisions.counts().items() if n}


def in_words(counts: dict[str, int]) -> str:
    """Counts in words.

    >>> in_words({"1": 26, "": 3})
    '26 by condition 1, 3 undecided'
    """
    decided = [f"{counts[rule]} by {RULES[rule].in_words()}" for rule in sorted(counts) if rule]
    return ", ".join([*decided, f"{counts.get('', 0)} undecided"])


def deciding_rules(decisions: Decisions) -> dict[Pair, str]:
    """The deciding condition of every pair of models, "" where it is undecided."""
    pairs = combinations(range(len(decisions.subjects)), 2)
    return {(i + 1, j + 1): decisions.rule(i, j) for i, j in pairs}


def open_pairs(decisions: Decisions) -> set[Pair]:
    """The pairs that stay open."""
    return {pair for pair, rule in deciding_rules(decisions).items() if not rule}


def name_list(numbers: Sequence[object]) -> str:
    """Models, pairs or numbers with commas and a final "and".

    >>> name_list([1, 4, 7]), name_list([3])
    ('1, 4 and 7', '3')
    """
    *first, last = map(str, numbers)
    return f"{', '.join(first)} and {last}" if first else last
