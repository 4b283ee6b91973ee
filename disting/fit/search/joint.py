"""Several responses of one machine, fitted with one parameter vector.

The stacked response is that of each setup, one after the other, shape (..., n_f) with n_f the lines
of all; stacked residuals are those of each response, shape (..., 2 n_f). So the cost is the sum of
the costs, and whatever looks at neighbouring lines takes the responses one by one (`responses`).

A machine in one state is eliminated once for all its sensors. A dead time of its own, `Td2` of the
second response, follows the parameters of the chain.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from disting.errors import InputError, short
from disting.fit.search.cost import Case, Cost, SquaredCost
from disting.fit.search.plant import Motion, Plant
from disting.fit.search.setup import Setup, measurable
from disting.measurement import FrequencyResponse
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain, Structure
from disting.model.presentation import plural, summary
from disting.statistics.scatter import Scatter

DEAD_TIMES = ("shared", "own")


@dataclass(frozen=True, slots=True)
class FurtherResponse:
    """A further response of the machine, how it was measured, and independent data of it.

    >>> from disting.measurement import from_arrays
    >>> load = from_arrays(range(1, 17), [1j, 2j] * 8)
    >>> FurtherResponse(load, Setup(sensor="2")).thinned(8).setup.text
    'sensor 2'
    """

    measured: FrequencyResponse
    setup: Setup
    test: FrequencyResponse | None = None

    def thinned(self, count: int) -> "FurtherResponse":
        """With at most so many lines each."""
        test = None if self.test is None else self.test.thinned(count)
        return replace(self, measured=self.measured.thinned(count), test=test)

    def masked(self, low: float, high: float) -> "FurtherResponse":
        """With the lines from `low` to `high` [Hz]."""
        test = None if self.test is None else self.test.masked(low, high)
        return replace(self, measured=self.measured.masked(low, high), test=test)


def with_dead_times(
    further: Sequence[FurtherResponse], dead_time: str
) -> Sequence[FurtherResponse]:
    """The responses with a dead time of each, called Td2, Td3 and so on, if `dead_time` is "own";
    as they are if it is "shared". Raises InputError for another word.
    """
    if dead_time not in DEAD_TIMES:
        raise InputError(f"dead_time is {' or '.join(DEAD_TIMES)}, not {short(dead_time)}")
    if dead_time == "shared":
        return further
    numbered = enumerate(further, 2)
    return [replace(f, setup=replace(f.setup, delay=f"Td{k}")) for k, f in numbered]


@dataclass(frozen=True, eq=False)
class JointPlant:
    """The plants of all responses; `delays`: names of the dead times that are not common, also of
    responses that are not here.
    """

    parts: tuple[Plant, ...]
    setups: tuple[Setup, ...]
    delays: tuple[str, ...] = ()

    @property
    def parameters(self) -> tuple[str, ...]:
        """Those of the chain, then the dead times of their own."""
        return (*self.parts[0].parameters, *self._own)

    def at(self, omega: Real, which: int = 0) -> "JointPlant":
        """One of the responses at angular frequencies [rad/s], with the parameters of all."""
        alone = self.parts[which].at(omega)
        return JointPlant((alone,), (self.setups[which],), self.delays)

    def response(self, p: Real) -> Complex:
        """Stacked response, shape (..., n_f)."""
        return np.concatenate(
            [part.response(own, motion) for part, own, _, motion in self._with_motion(p)], axis=-1
        )

    def logarithmic_gradient(self, p: Real) -> tuple[Complex, Complex]:
        """Stacked G, shape (..., n_f), and d ln G / d p, shape (..., n_p, n_f)."""
        responses, gradients = list[Complex](), list[Complex]()
        for part, own, at, motion in self._with_motion(p):
            response, gradient = part.logarithmic_gradient(own, motion)
            whole = np.zeros((*p.shape, len(part.omega)), dtype=np.complex128)
            whole[..., at, :] = gradient
            responses.append(response)
            gradients.append(whole)
        return np.concatenate(responses, axis=-1), np.concatenate(gradients, axis=-1)

    def _with_motion(self, p: Real) -> list[tuple[Plant, Real, NDArray[np.intp], Motion]]:
        """Each part with its own parameters, their places in `p`, and the motion of its machine,
        computed once a state.
        """
        units: dict[tuple[object, ...], Motion] = {}
        answers = []
        for part, at in zip(self.parts, self._places, strict=True):
            force = part.structure.ports[:2]
            lines = part.omega.tobytes(), part.observation and part.observation.grid
            state, own = (force, part.still, part.added, *lines), p[..., at]
            if state not in units:
                units[state] = part.motion(own)
            answers.append((part, own, at, units[state]))
        return answers

    @cached_property
    def _own(self) -> tuple[str, ...]:
        return self.delays if self.parts[0].structure.dead_time else ()

    @cached_property
    def _places(self) -> list[NDArray[np.intp]]:
        """Places of the parameters of each part."""
        n = len(self.parts[0].parameters)
        places = []
        for setup in self.setups:
            at = np.arange(n)
            if self._own and setup.delay:
                at[-1] = n + self._own.index(setup.delay)
            places.append(at)
        return places


@dataclass(frozen=True, eq=False)
class JointCost(SquaredCost):
    """The sum of the costs of several responses, each with its setup; `delays` as in
    `JointPlant`; `places`: the setups at the masses of each structure, where these are not those
    that `setups` names.
    """

    parts: tuple[Cost, ...]
    setups: tuple[Setup, ...]
    delays: tuple[str, ...] = ()
    places: Mapping[Structure, tuple[Setup, ...]] = field(default_factory=dict)

    def __repr__(self) -> str:
        return summary(self, plural(len(self.parts), "response"))

    @property
    def measured(self) -> FrequencyResponse:
        """The first response, which starts are taken from."""
        return self.parts[0].measured

    @property
    def case(self) -> Case:
        """Definition of the residuals."""
        return self.parts[0].case

    @property
    def n_residuals(self) -> int:
        """Of all responses."""
        return sum(part.n_residuals for part in self.parts)

    def residual(self, response: Complex) -> Real:
        """Stacked residuals, shape (..., 2 n_f), of stacked responses."""
        each = zip(self.parts, self.by_line(response), strict=True)
        return np.concatenate([part.residual(own) for part, own in each], axis=-1)

    def sensitivity(self, response: Complex, gradient: Complex) -> Real:
        """S, shape (..., 2 n_f, n_p), from stacked G and d ln G / d p."""
        each = zip(self.parts, self.by_line(response), self.by_line(gradient), strict=True)
        return np.concatenate([part.sensitivity(*own) for part, *own in each], axis=-2)

    def scatter(self, scatter: Scatter) -> Real:
        """Standard deviation of the residuals, shape (2 n_f,), of data that scatter so."""
        each = zip(self.parts, self._of_each(scatter), strict=True)
        return np.concatenate([part.scatter(own) for part, own in each])

    def likely(self, scatter: Scatter) -> "JointCost":
        """The sum of those of all responses, which are independent."""
        each = zip(self.parts, self._of_each(scatter), strict=True)
        return replace(self, parts=tuple(part.likely(own) for part, own in each))

    def windowed(self) -> "JointCost":
        """Of what Welch's method shows."""
        return replace(self, parts=tuple(part.windowed() for part in self.parts))

    @property
    def leading(self) -> "JointCost":
        """The cost that leads a search: of logarithms."""
        return replace(self, parts=tuple(part.leading for part in self.parts))

    def _of_each(self, scatter: Scatter) -> Iterator[Scatter]:
        """The scatter of each response."""
        ends = np.cumsum([0, *(len(part.measured) for part in self.parts)])
        return (scatter.at(slice(*both)) for both in pairwise(ends))

    def plant(self, structure: Structure, sign: int) -> JointPlant:
        """The structure under each setup at the lines of the data."""
        n, setups = structure.n_masses, self.setups_of(structure)
        plants = [
            Plant(
                setup.seen(structure, part.measured.quantity),
                part.measured.omega,
                sign * setup.sign,
                setup.still(n),
                setup.added(n),
                part.observation,
            )
            for part, setup in zip(self.parts, setups, strict=True)
        ]
        return JointPlant(tuple(plants), setups, self.delays)

    def setups_of(self, structure: Structure) -> tuple[Setup, ...]:
        """The setups, at the masses of a structure."""
        return self.places.get(structure, self.setups)

    def on(self, chain: Chain) -> "AnyCost":
        """Of the responses that a chain has, such as one with fewer masses, where a place is
        missing, or of which it is not known which mass is which: it has the first one.
        """
        setups = self.setups_of(chain.structure)
        other_parts = measurable(chain, setups)
        if self.places and chain.structure not in self.places:
            other_parts = (True, *(False for _ in setups[1:]))
        if all(other_parts):
            return self
        kept = [(p, s) for p, s, has in zip(self.parts, setups, other_parts, strict=True) if has]
        parts, setups = zip(*kept, strict=True)
        return JointCost(parts, setups, self.delays)

    def thinned(self, count: int) -> "JointCost":
        """The cost of at most so many lines of each response; itself if there are no more."""
        parts = tuple(part.thinned(count) for part in self.parts)
        fewer = any(few is not part for few, part in zip(parts, self.parts, strict=True))
        return replace(self, parts=parts) if fewer else self

    def by_line(self, values: NDArray[np.generic]) -> list[NDArray]:  # type: ignore[type-arg]
        """Stacked values of lines, shape (..., n_f), for each response."""
        ends = np.cumsum([len(part.measured) for part in self.parts])[:-1]
        return np.split(values, ends, axis=-1)

    def by_residual(self, values: Real) -> list[Real]:
        """Stacked values of residuals, shape (2 n_f, ...), for each response."""
        ends = np.cumsum([part.n_residuals for part in self.parts])[:-1]
        return np.split(values, ends)


AnyCost = Cost | JointCost
AnyPlant = Plant | JointPlant
