"""The exact decision by a list: all parameters that fit one experiment, put into the others.

Where an experiment is that of a chain of the class, inverse network synthesis lists every parameter
vector of the searched chain, complex ones included, with the given transfer function at a random
rational point of the other chain (`fibres.synthesis`). A listed ball that certainly gives another
transfer function in some other experiment is none of the stacked fibre. If all are, no parameters
of the searched chain have the behaviour of that point.

What one point proves is what `decide.same.exact` says of one transfer function: the argument
knows the equations by their degree alone. Equal transfer functions are equations N2 D1 = N1 D2 of
degree 2 (N_B + 1) at most in the parameters of both, in every experiment: locked masses and what is
known lower degrees. That is no more than the 3 N_B + 2 of `synthesis.decide.safety_of_point`, and
the degree of a component, D^(n + 1) at most, does not depend on how many equations there are. The
point is the same for all experiments that may be listed, so no more points are drawn than there.

Where many experiments are decided for few chains (`shared`), the point belongs to the chains, in
their canonical form, for all changes. So all that fits the present experiment is listed once, and
each further experiment at each place is only an evaluation of that list. Each statement has the
bound of its point, and bounds of many statements add up, whether their points are one or many. (A
comparison of its own has its own point: experiments could be written for a point that is known.)
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeVar

from flint import acb_poly, ctx, fmpq, fmpq_poly

from disting.algebra.certainty import Certainty, about
from disting.behaviour.transfer import plain_receptance
from disting.conditions.rule import EXACT, Finding, Outcome
from disting.evidence.decision import FibreUnder
from disting.experiments.experiment import Entry, MeasuredChain
from disting.fibres.synthesis.branch import Ball
from disting.fibres.synthesis.decide import (
    DRAWS,
    dearest,
    point_bits,
    rational_point,
    safety_of_point,
)
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.methods import is_covered
from disting.fibres.synthesis.task import Fibre, Solution, Status, target
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.model.row import rows_of
from disting.model.symmetry import canonical

Poly = TypeVar("Poly", fmpq_poly, acb_poly)
REMEMBERED = 64  # fibres


@dataclass(frozen=True, slots=True)
class ExperimentFibre:
    """At the point `values` of the given chain: all solutions of experiment `at` (from 0), and
    for each the first experiment whose transfer function it certainly misses, None if there is
    none.
    """

    values: dict[str, fmpq]
    at: int
    fibre: Fibre
    refuted_by: tuple[int | None, ...]

    @property
    def point(self) -> tuple[tuple[str, str], ...]:
        """The values as text."""
        return tuple((name, str(value)) for name, value in self.values.items())

    @property
    def kept(self) -> tuple[Solution, ...]:
        """The solutions that no experiment refutes."""
        pairs = zip(self.fibre.solutions, self.refuted_by, strict=True)
        return tuple(s for s, missed in pairs if missed is None)


def by_list(
    left: MeasuredChain, right: MeasuredChain, settings: Settings, *, shared: bool = False
) -> Finding | None:
    """FAILS where one list is refuted, the cheaper direction first; None where nothing is."""
    left, right = without_dead_time(left), without_dead_time(right)
    ways = [(True, left, right), (False, right, left)]
    ways.sort(key=lambda way: dearest(way[2].chain))
    for left_given, machine, searched in ways:
        listed = next(lists(machine, searched, settings.seed, shared=shared), None)
        if listed is not None and None not in listed.refuted_by:
            evidence = FibreUnder(
                left_given,
                listed.point,
                listed.at + 1,
                tuple(k + 1 for k in listed.refuted_by if k is not None),
            )
            safety = safety_of_point(searched.chain)
            return Finding(
                rule=EXACT,
                outcome=Outcome.FAILS,
                certainty=Certainty.BOUNDED,
                safety=safety,
                evidence=evidence,
            )
    return None


def lists(
    machine: MeasuredChain,
    searched: MeasuredChain,
    seed: str,
    *,
    confirm: bool = False,
    shared: bool = False,
) -> Iterator[ExperimentFibre]:
    """Yield lists at random points, one for each experiment that can be listed; `confirm` has
    solutions tested for being simple.
    """
    for at, _, _ in listable(machine, searched):
        for draw in range(DRAWS):
            label = f"synthesis:{seed}:{draw}"
            values = (_shared_point if shared else _own_point)(machine, searched, label)
            listed = listed_at(machine, searched, at, values, confirm=confirm)
            if listed is not None:
                yield listed
                break


def listed_at(
    machine: MeasuredChain,
    searched: MeasuredChain,
    at: int,
    values: dict[str, fmpq],
    *,
    confirm: bool = False,
) -> ExperimentFibre | None:
    """All solutions of one experiment at a point; None for an infinite or an open list."""
    chain, other_chain = machine.alone(at), searched.alone(at)
    if chain is None or other_chain is None:
        return None
    whole_fibre = _fibre(other_chain, chain, tuple(values.items()), confirm)
    whole = whole_fibre.status in (Status.COMPLETE, Status.EMPTY)
    if not whole or whole_fibre.tests.boundary or whole_fibre.tests.uncovered:
        return None
    missed = (missed_by(machine, values, searched, s, whole_fibre) for s in whole_fibre.solutions)
    return ExperimentFibre(values, at, whole_fibre, tuple(missed))


def listable(machine: MeasuredChain, searched: MeasuredChain) -> Iterator[tuple[int, Chain, Chain]]:
    """Yield the experiments in which both are chains of the class, and that a method serves."""
    for at in range(len(machine.experiments)):
        chain, other_chain = machine.alone(at), searched.alone(at)
        if (
            chain is not None
            and other_chain is not None
            and (chain.n_masses, chain.quantity) == (other_chain.n_masses, other_chain.quantity)
            and _is_covered(other_chain)
        ):
            yield at, chain, other_chain


def missed_by(
    machine: MeasuredChain,
    point: dict[str, fmpq],
    searched: MeasuredChain,
    solution: Solution,
    all_: Fibre,
) -> int | None:
    """The first experiment whose transfer function no parameters in the solution's balls have."""
    with ctx.workprec(max(all_.precision_bits, 64)):
        for k, (mine, theirs) in enumerate(zip(machine.entries, searched.entries, strict=True)):
            if _differs(mine, point, theirs, solution.values):
                return k
    return None


def without_dead_time(measured: MeasuredChain) -> MeasuredChain:
    """The measured chain without the factor that it shares with the other side."""
    chain = measured.chain
    return replace(measured, chain=replace(chain, dead_time=False)) if chain.dead_time else measured


def _own_point(machine: MeasuredChain, searched: MeasuredChain, label: str) -> dict[str, fmpq]:
    """A point of this question alone."""
    return rational_point(
        machine.chain, about(label, machine, searched), point_bits(searched.chain)
    )


def _shared_point(machine: MeasuredChain, searched: MeasuredChain, label: str) -> dict[str, fmpq]:
    """A point of two chains, whatever is done to them."""
    form, other = canonical(machine.chain), canonical(searched.chain).chain
    drawn = rational_point(form.chain, about(label, form.chain, other), point_bits(other))
    return {name: drawn[form.renaming[name]] for name in machine.chain.parameters}


def _fibre(
    searched: Chain, chain: Chain, values: tuple[tuple[str, fmpq], ...], confirm: bool
) -> Fibre:
    """All parameters of one chain with the transfer function of the other, made once for all
    chains of the same canonical forms.
    """
    form, image = canonical(searched), canonical(chain)
    named = sorted((image.renaming[name], value) for name, value in values)
    whole = _canonical_fibre(form.chain, image.chain, tuple(named), confirm)
    solutions = (
        replace(s, values={name: s.values[form.renaming[name]] for name in searched.parameters})
        for s in whole.solutions
    )
    return replace(whole, solutions=tuple(solutions))


@lru_cache(maxsize=REMEMBERED)
def _canonical_fibre(
    searched: Chain, chain: Chain, values: tuple[tuple[str, fmpq], ...], confirm: bool
) -> Fibre:
    return fibre(searched, target(chain.structure, dict(values)), confirm=confirm)


def _differs(mine: Entry, point: dict[str, fmpq], theirs: Entry, balls: dict[str, Ball]) -> bool:
    """Return True if N2 D1 - N1 D2 has a coefficient that is certainly nonzero."""
    rational = {name: fmpq_poly([value]) for name, value in point.items()}
    num, den = _receptance(mine, rational, fmpq_poly)
    top, bottom = _receptance(theirs, {n: acb_poly([v]) for n, v in balls.items()}, acb_poly)
    lift = mine.sensor_order - theirs.sensor_order
    gap = top * acb_poly(den) - acb_poly(num) * bottom if not lift else acb_poly([1])
    return any(not gap[i].contains(0) for i in range(gap.length()))


def _receptance(entry: Entry, values: dict[str, Poly], ring: type[Poly]) -> tuple[Poly, Poly]:
    sizes = {n: ring([fmpq(x.numerator, x.denominator)]) for n, x in entry.known.items()}
    return plain_receptance(entry, values | sizes, ring([0, 1]), ring([1]))


def _is_covered(chain: Chain) -> bool:
    return all(map(is_covered, rows_of(canonical(chain).chain.structure)))
