"""Measured responses as a fit takes them, and what each of several counts.

Residuals in units of what the lines scatter, in the complex plane.

    e_k = sqrt(2) (G_k(p) - G_M,k) conj(G_M,k / |G_M,k|) / sigma_k,

real parts (along the response: amplitude) of all lines first, then imaginary parts (across it:
phase); of the true parameters each has variance 1 and all are independent, however small the
response is compared with its noise, where logarithms are neither. |e|^2 is minus twice the
logarithm of the likelihood.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import compress

import numpy as np

from disting.errors import InputError
from disting.fit.search.cost import Cost, SquaredCost
from disting.fit.search.joint import AnyCost, FurtherResponse, JointCost
from disting.fit.search.setup import Setup
from disting.measurement import FrequencyResponse, are_opposite
from disting.measurement.arrays import Complex, Real
from disting.measurement.response import NO_MOTION
from disting.model.chain import Chain
from disting.statistics.scatter import LEAST, Scatter, change, scatter, widen

MOST_EXTREME = 1e30  # of a frequency or an amplitude
Lines = Callable[[FrequencyResponse], Real]


@dataclass(frozen=True, eq=False)
class WhitenedCost(SquaredCost):
    """Cost of the data of `cost`, with the scatter `known` of the lines."""

    cost: AnyCost
    known: Scatter

    @property
    def n_residuals(self) -> int:
        """Those of the cost."""
        return self.cost.n_residuals

    def residual(self, response: Complex) -> Real:
        """e, shape (..., 2 n_f), of stacked responses, shape (..., n_f)."""
        parts = [
            _apart((own - measured) * unit)
            for own, (measured, unit) in zip(self.cost.by_line(response), self._units, strict=True)
        ]
        return np.concatenate(parts, axis=-1)

    def sensitivity(self, response: Complex, gradient: Complex) -> Real:
        """d e / d p, shape (..., 2 n_f, n_p), from stacked G and d ln G / d p."""
        moved = gradient * response[..., None, :]
        parts = [
            _apart(own * unit)
            for own, (_, unit) in zip(self.cost.by_line(moved), self._units, strict=True)
        ]
        return np.concatenate(parts, axis=-1).swapaxes(-1, -2)

    @property
    def _units(self) -> Iterator[tuple[Complex, Complex]]:
        """Measured response and what turns and scales its residuals, for each response; a line of
        weight zero counts nothing.
        """
        for part, own in zip(self.cost.parts, self.cost.by_line(self.known.sigma), strict=True):
            measured = part.measured.G
            used = 1.0 if part.lines is None else (part.lines > 0) * 1.0
            yield measured, np.sqrt(2) * used * (np.abs(measured) / measured) / own


def _apart(values: Complex) -> Real:
    return np.concatenate([values.real, values.imag], axis=-1)


def check(
    train: FrequencyResponse,
    test: FrequencyResponse | None,
    further: Sequence[FurtherResponse],
    candidates: Sequence[Chain],
    most: int,
) -> tuple[FrequencyResponse, FrequencyResponse | None, Sequence[FurtherResponse]]:
    """The responses with at most so many lines each; raises InputError for what no fit is made
    of.
    """
    if not candidates:
        raise InputError("a selection needs at least one candidate")
    _check_pair(train, test)
    every = (train, test, *(data for extra in further for data in (extra.measured, extra.test)))
    for data in filter(None, every):
        if data.is_impedance:
            raise InputError(f"{data.origin or 'data'}: {NO_MOTION}")
    other = {c.quantity for c in candidates} - {train.quantity}
    if other:
        raise InputError(
            f"the data shows {train.quantity.value}, a candidate {other.pop().value}; choose one"
            f" quantity"
        )
    for data in filter(None, (train, test)):
        check_range(data)
    for extra in further:  # each against its own test data
        if extra.test is not None and test is None:
            raise InputError("test data of a further response need test data of the first one too")
        _check_pair(extra.measured, extra.test)
        for data in filter(None, (extra.measured, extra.test)):
            check_range(data)
    thinned = None if test is None else test.thinned(most)
    return (
        train.thinned(most),
        thinned,
        [extra.thinned(most) for extra in further],
    )


def _check_pair(train: FrequencyResponse, test: FrequencyResponse | None) -> None:
    if test is not None and test.quantity is not train.quantity:
        raise InputError(
            f"training shows {train.quantity.value}, test {test.quantity.value};"
            " convert one of them"
        )
    if test is not None and are_opposite(train, test):
        raise InputError(
            "training and test are of opposite sign; reverse one of them, as by sign_reversed()"
        )


def check_range(data: FrequencyResponse) -> None:
    """Raise InputError for frequencies or amplitudes beyond 1e-30 to 1e30: their squares and
    products leave floating point, and no unit of measurement is sensible there.
    """
    for name, values, unit in (
        ("frequencies", data.omega, "rad/s"),
        ("amplitudes", np.abs(data.G), "output per input"),
    ):
        low, high = float(values.min()), float(values.max())
        if low < 1 / MOST_EXTREME or high > MOST_EXTREME:
            limits = f"a fit accepts {1 / MOST_EXTREME:g} to {MOST_EXTREME:g}"
            raise InputError(
                f"the {name} are {low:g} to {high:g} {unit}; {limits}: choose other units or"
                " remove lines"
            )


@dataclass(frozen=True, slots=True, eq=False)
class Weights:
    """Weights of the lines of all responses: of the `first` cost's, measured a second time where
    there is a `test`, and of `further` ones, each in units of its own scatter.

    Weights are 1/rho of each line, rho from `scatter`, including the change of the machine until
    its test data; or those by `lines`, of each response divided by what its weighted residuals
    scatter by, lambda^2 = mean (w rho)^2. `alike`: all lines of all responses count alike.
    """

    first: Cost
    test: FrequencyResponse | None = None
    further: Sequence[FurtherResponse] = ()
    lines: Lines | None = None
    alike: bool = False

    @property
    def by_scatter(self) -> bool:
        """True if lines are weighted by their scatter."""
        return self.lines is None and not self.alike

    def training(self, fitted: Sequence[Complex] = ()) -> AnyCost:
        """The cost of all responses on the training data, weights scaled to a mean square of 1. The
        scatter of the lines is estimated with the stacked responses `fitted` of candidates.
        """
        whole = (FurtherResponse(self.first.measured, Setup(), self.test), *self.further)
        ends = np.cumsum([len(extra.measured) for extra in whole])[:-1]
        rows = [np.split(response, ends) for response in fitted]
        own = [
            self._weights(extra.measured, extra.test, [each[k] for each in rows])
            for k, extra in enumerate(whole)
        ]
        size = float(np.sqrt(np.mean(np.concatenate(own) ** 2)))
        plain = self.alike and not self.further
        parts = [
            replace(self.first, measured=extra.measured, lines=None if plain else w / size)
            for extra, w in zip(whole, own, strict=True)
        ]
        setups = tuple(extra.setup for extra in whole)
        if not self.further:
            return parts[0]
        return JointCost(tuple(parts), setups, tuple(s.delay for s in setups if s.delay))

    def judging(
        self, cost: AnyCost, fitted: Callable[[AnyCost], Sequence[Complex]]
    ) -> AnyCost | None:
        """The cost on independent data, of the responses that have some, None without such; a
        response counts there as much as on the training data, in `cost`. `fitted`: responses of
        candidates at the lines of a cost.
        """
        if self.test is None:
            return None
        tests = [self.test, *(extra.test for extra in self.further)]
        kept = [
            (replace(part, measured=data, lines=None), part)
            for part, data in zip(cost.parts, tests, strict=True)
            if data is not None
        ]
        tested = [data is not None for data in tests]
        places = cost.places if isinstance(cost, JointCost) else {}
        plain = JointCost(
            tuple(part for part, _ in kept),
            tuple(compress(cost.setups, tested)),
            cost.delays,
            {of: tuple(compress(setups, tested)) for of, setups in places.items()},
        )
        each = [plain.by_line(response) for response in fitted(plain)]
        parts = []
        for k, (part, trained) in enumerate(kept):
            own = [responses[k] for responses in each]
            weights = self._weights(part.measured, trained.measured, own)
            parts.append(replace(part, lines=weights * _size(trained.lines) / _size(weights)))
        return parts[0] if isinstance(cost, Cost) else replace(plain, parts=tuple(parts))

    def _weights(
        self,
        measured: FrequencyResponse,
        other: FrequencyResponse | None,
        fitted: Sequence[Complex],
    ) -> Real:
        """Weights of the lines of a response that was measured another time too."""
        if self.alike:
            return np.ones(len(measured))
        own = scatter(measured, fitted)
        if self.lines is not None:
            weights = self.lines(measured)
            return weights / max(float(np.sqrt(np.mean((weights * own.rho) ** 2))), LEAST)
        tau = change(measured, other, own, scatter(other)) if other is not None else 0.0
        return np.asarray(1.0 / widen(own, tau).rho)


def _size(weights: Real | None) -> float:
    return 1.0 if weights is None else float(np.sqrt(np.mean(weights**2)))
