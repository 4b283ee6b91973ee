"""Checks of equivalents: as an identity, and under further experiments.

Small chains: both receptances are written out as rational functions and compared, a proof. Larger
ones: both are evaluated at a random point, exactly, over the fractions, and compared as
polynomials in s. A receptance is num/den with coefficients that are of degree one in each
parameter, so with formulas a_j/b_j, E_j = max(deg a_j, deg b_j), every coefficient of num den' -
num' den becomes, multiplied by all b_j, a polynomial of degree at most sum E_j + n in the n given
parameters. If it is not zero, it vanishes at a point with coordinates from a set of S numbers with
probability (sum E_j + n)/S at most (Schwartz and Zippel); so does one of the b_j.

Of values the agreement of two models is a number: the largest difference of a coefficient of both
transfer functions, in balls.

What fits one experiment is listed; of it that is kept which fits the others. So a list that is
complete for one experiment is complete for all of them, and where one experiment alone leaves
infinitely many another one may serve.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from hashlib import shake_256
from itertools import zip_longest
from math import ceil, log2
from typing import Any

from flint import acb, acb_poly, ctx, fmpq, fmpq_poly

from disting.algebra.symbols import RationalFunction, symbols, variables
from disting.behaviour.transfer import plain_receptance
from disting.experiments.experiment import Entry, Experiment, MeasuredChain
from disting.experiments.places import PlacedExperiment, Places, move, parse_experiment, ways
from disting.fibres.synthesis.task import SolutionValues
from disting.model.chain import Chain

COORDINATE = 256  # bits of a random coordinate
BITS = 320  # of the evaluation in balls; inputs of 15 digits leave far more than enough


def is_identity(chain: Chain, other: Chain, formulas: Mapping[str, RationalFunction]) -> bool:
    """Written out: exact. For small chains and short formulas."""
    ring = symbols(["s", *chain.parameters])
    names = variables(["s", *chain.parameters])
    function = names["s"] / names["s"]
    plain = plain_receptance(chain.structure, ring, ring["s"], ring["s"] ** 0)
    num, den = plain_receptance(other.structure, formulas, names["s"], function)
    return bool((num / den) == RationalFunction(*plain))


def holds_at_random(
    chain: Chain, other: Chain, formulas: Mapping[str, RationalFunction], seed: str
) -> bool:
    """At one random point, exactly; False is a proof that the formulas are wrong, True holds
    but for `safety`.
    """
    count = COORDINATE // 8
    digits = shake_256(f"equivalence:{seed}".encode()).digest(count * len(chain.parameters))
    numbers = [
        int.from_bytes(digits[i * count : (i + 1) * count], "big") + 1
        for i in range(len(chain.parameters))
    ]
    point = {name: fmpq(number) for name, number in zip(chain.parameters, numbers, strict=True)}
    return exactly_equal(
        chain, point, other, {name: formula.value(point) for name, formula in formulas.items()}
    )


def safety(chain: Chain, formulas: Mapping[str, RationalFunction]) -> int:
    """The probability that wrong formulas pass at one random point is at most 2^-safety."""
    degree = sum(formula.degree for formula in formulas.values()) + len(chain.parameters)
    return COORDINATE - ceil(log2(degree))


def exactly_equal(left: Chain, a: Mapping[str, fmpq], right: Chain, b: Mapping[str, fmpq]) -> bool:
    """Return True if two models at rational points have the same transfer function: exact, common
    factors do not matter.
    """
    polynomial, s = fmpq_poly([1]), fmpq_poly([0, 1])
    (f_num, f_den), (g_num, g_den) = (
        plain_receptance(
            chain.structure, {name: fmpq_poly([v]) for name, v in values.items()}, s, polynomial
        )
        for chain, values in ((left, a), (right, b))
    )
    return bool(f_num * g_den == g_num * f_den)


def difference(left: Chain, a: Mapping[str, fmpq], right: Chain, b: SolutionValues) -> float:
    """Upper bound of the largest relative difference of a coefficient, denominators made monic.

    Relative to the coefficient of the left model, or to its largest one where that coefficient is
    zero.
    """
    with ctx.workprec(BITS):
        pairs = zip(_coefficients(left, a), _coefficients(right, b), strict=True)
        return max(_relative(*pair) for pair in pairs)


def _coefficients(chain: Chain, values: SolutionValues) -> Iterator[list[acb]]:
    """Numerator and denominator, coefficients from low to high."""
    lifted = {name: acb_poly([acb(value)]) for name, value in values.items()}
    num, den = plain_receptance(chain.structure, lifted, acb_poly([0, 1]), acb_poly([1]))
    lead = den[den.degree()]
    for p in (num, den):
        yield [p[i] / lead for i in range(den.degree() + 1)]


def _relative(balls: list[acb], ours: list[acb]) -> float:
    largest = max((c.abs_upper() for c in balls), key=float)
    worst = 0.0
    for a, b in zip_longest(balls, ours, fillvalue=acb(0)):
        scale = largest if a.contains(0) else a.abs_lower()
        worst = max(worst, float((a - b).abs_upper() / scale))
    return worst


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
            own_chain, other_chain = self.given.alone(at), self.other.alone(at)
            if own_chain is not None and other_chain is not None:
                yield own_chain, other_chain

    def agrees(self, point: SolutionValues, values: SolutionValues) -> bool:
        """Return True if all transfer functions are equal: exact for rational values; for balls,
        none is certainly different.
        """
        coefficients = (c for gap, _ in self._cross_products(point, values) for c in gap.coeffs())
        return all(c.contains(0) if isinstance(c, acb) else not c for c in coefficients)

    def deviation(self, point: SolutionValues, values: SolutionValues) -> float:
        """Upper bound of the largest coefficient of N2 D1 - N1 D2, relative to that of N1 D2, of
        all transfer functions that are not zero.
        """
        worst = 0.0
        with ctx.workprec(BITS):
            for gap, whole in self._cross_products(point, {n: acb(v) for n, v in values.items()}):
                largest, rest = (
                    max((float(c.abs_upper()) for c in p.coeffs()), default=0.0)
                    for p in (whole, gap)
                )
                worst = max(worst, rest / largest if largest else 0.0)
        return worst

    def _cross_products(
        self, point: SolutionValues, values: SolutionValues
    ) -> Iterator[tuple[Any, Any]]:
        ring = acb_poly if any(isinstance(v, acb) for v in values.values()) else fmpq_poly
        with ctx.workprec(BITS):
            for own_entry, other_entry in zip(self.given.entries, self.other.entries, strict=True):
                num, den = _response(own_entry, point, fmpq_poly)
                top, bottom = _response(other_entry, values, ring)
                whole = ring(num) * bottom
                yield top * ring(den) - whole, whole


def benches(chain: Chain, other: Chain, also: Sequence[str | Experiment]) -> Iterator[Bench]:
    """Yield every way to place the experiments in the other chain; in the given one they are where
    they are named. Raises InputError.
    """
    experiments = [parse_experiment(e) if isinstance(e, str) else PlacedExperiment(e) for e in also]
    used = {i for own_machine in experiments for i in own_machine.experiment.masses}
    own = tuple((i, i) for i in sorted(used)) if other == chain else ()
    lefts = [Experiment(), *(own_machine.experiment for own_machine in experiments)]
    for places in ways(chain, other, experiments, own):
        rights = [move(e, places) for e in lefts]
        pairs = dict.fromkeys(zip(lefts, rights, strict=True))
        sides = zip(*pairs, strict=True)
        own_machine, other_machine = (
            MeasuredChain(c, tuple(s)) for c, s in zip((chain, other), sides, strict=True)
        )
        yield Bench(own_machine, other_machine, places)


def _response(entry: Entry, values: SolutionValues, ring: type) -> tuple[Any, Any]:
    lifted = {name: ring([value]) for name, value in values.items()}
    lifted |= {n: ring([fmpq(x.numerator, x.denominator)]) for n, x in entry.known.items()}
    num, den = plain_receptance(entry, lifted, ring([0, 1]), ring([1]))
    return num * ring([0, 1]) ** entry.sensor_order, den
