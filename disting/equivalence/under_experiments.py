"""Which equivalents of a model keep the responses of further experiments too: each is put into all
of them.

What fits one experiment is listed; of it that is kept which fits the others. So a list that is
complete for one experiment is complete for all of them, and where one experiment alone leaves
infinitely many another one may serve.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from flint import acb, acb_poly, ctx, fmpq, fmpq_poly

from disting.behaviour.transfer import plain_receptance
from disting.equivalence.identity import BITS
from disting.experiments import Experiment, MeasuredChain, Named, Places, moved, named, ways
from disting.experiments.experiment import Entry
from disting.model.chain import Chain

Number = Any  # fmpq or acb
Values = Mapping[str, Number]


@dataclass(frozen=True, slots=True)
class Bench:
    """Both machines under the same experiments, masses of the right one at `places`; the first
    experiment is that of the chains as they are.
    """

    given: MeasuredChain
    other: MeasuredChain
    places: Places

    @property
    def alone(self) -> Iterator[tuple[Chain, Chain]]:
        """Yield both chains in every experiment that is one of chains of the class."""
        for at in range(len(self.given.experiments)):
            one, there = self.given.alone(at), self.other.alone(at)
            if one is not None and there is not None:
                yield one, there

    def agrees(self, point: Values, values: Values) -> bool:
        """Whether all transfer functions are the same: exact for rational values, and that none
        certainly differs for balls.
        """
        coefficients = (c for gap, _ in self._crossed(point, values) for c in gap.coeffs())
        return all(c.contains(0) if isinstance(c, acb) else not c for c in coefficients)

    def deviation(self, point: Values, values: Values) -> float:
        """Upper bound of the largest coefficient of N2 D1 - N1 D2, relative to that of N1 D2, of
        all transfer functions that are not zero.
        """
        worst = 0.0
        with ctx.workprec(BITS):
            for gap, whole in self._crossed(point, {n: acb(v) for n, v in values.items()}):
                largest, rest = (
                    max((float(c.abs_upper()) for c in p.coeffs()), default=0.0)
                    for p in (whole, gap)
                )
                worst = max(worst, rest / largest if largest else 0.0)
        return worst

    def _crossed(self, point: Values, values: Values) -> Iterator[tuple[Any, Any]]:
        ring = acb_poly if any(isinstance(v, acb) for v in values.values()) else fmpq_poly
        with ctx.workprec(BITS):
            for here, there in zip(self.given.entries, self.other.entries, strict=True):
                num, den = _response(here, point, fmpq_poly)
                top, bottom = _response(there, values, ring)
                whole = ring(num) * bottom
                yield top * ring(den) - whole, whole


def benches(given: Chain, other: Chain, also: Sequence[str | Experiment]) -> Iterator[Bench]:
    """Yield every way to place the experiments in the other chain; in the given one they are where
    they are named. Raises InputError.
    """
    asked = [named(e) if isinstance(e, str) else Named(e) for e in also]
    used = {i for one in asked for i in one.experiment.masses}
    own = tuple((i, i) for i in sorted(used)) if other == given else ()
    lefts = [Experiment(), *(one.experiment for one in asked)]
    for places in ways(given, other, asked, own):
        rights = [moved(e, places) for e in lefts]
        pairs = dict.fromkeys(zip(lefts, rights, strict=True))
        sides = zip(*pairs, strict=True)
        one, there = (
            MeasuredChain(c, tuple(s)) for c, s in zip((given, other), sides, strict=True)
        )
        yield Bench(one, there, places)


def _response(entry: Entry, values: Values, ring: type) -> tuple[Any, Any]:
    lifted = {name: ring([value]) for name, value in values.items()}
    lifted |= {n: ring([fmpq(x.numerator, x.denominator)]) for n, x in entry.known.items()}
    num, den = plain_receptance(entry, lifted, ring([0, 1]), ring([1]))
    return num * ring([0, 1]) ** entry.sensor_order, den
