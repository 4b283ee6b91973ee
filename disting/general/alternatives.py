"""All parameter vectors of one model with exactly the transfer function that another one has at
given rational values.

The equations of the fibre (see `target`) have no zero, finitely many or infinitely many, which a
Groebner basis over Q decides without chance; statements on them are proven (see `fibre`).
Alternatives keep the order of the model: parameters at which its leading denominator coefficient is
zero are none.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from disting.algebra.groebner.modular import Sparse
from disting.algebra.groebner.own_process import run_limited
from disting.algebra.groebner.rational import Bounds, TooLarge
from disting.conditions.rule import Outcome
from disting.errors import InputError, of_type
from disting.general.any_model import given_model, on_one_variable
from disting.general.equivalent import Equivalent, rational
from disting.general.fibre import Extent, Fibre, solve
from disting.general.matrix_model import AnyModel
from disting.general.target import Target, joint_equations, rational_values, target
from disting.model.chain import Chain
from disting.model.presentation import plural, summary
from disting.model.question import Domain
from disting.network.network import Network

SECONDS = 30.0
OTHER_ZEROS = "not the same transfer functions of both are zero"
# milliseconds, seldom half a second; what is larger gets a process of its own, with a limit of time
AT_ONCE = Bounds()
AT_MOST = Bounds(2000, 5000, 100_000, 300)

PointValues = tuple[tuple[str, Fraction], ...]


@dataclass(frozen=True, slots=True)
class Alternatives:
    """Parameter vectors of `other` with the transfer function of `model` at `values`: all of them
    if finitely many.

    FAMILY: infinitely many over the complex numbers, `equivalents` some of them, `free` the
    parameters that were fixed at random; `excluded`: domains without any. UNKNOWN: not decided,
    for this `reason`. Everything else is proven.

    >>> from disting import Model, alternatives
    >>> low_pass = Model.from_transfer_function("1", "s + a*b")
    >>> alternatives(low_pass, {"a": 1, "b": 2}, low_pass).extent.value
    'family'
    """

    model: str
    other: str
    values: PointValues
    extent: Extent
    equivalents: tuple[Equivalent, ...] = ()
    free: tuple[str, ...] = ()
    excluded: tuple[Domain, ...] = ()
    reason: str = ""

    def __repr__(self) -> str:
        return summary(self, self.sentence)

    def __bool__(self) -> bool:
        raise TypeError("alternatives are not true or false; use their extent")

    def within(self, domain: Domain) -> tuple[Equivalent, ...]:
        """Those that are real or positive, or all."""
        admissible = {
            Domain.COMPLEX: tuple(Domain),
            Domain.REAL: (Domain.REAL, Domain.POSITIVE),
        }.get(domain, (domain,))
        return tuple(x for x in self.equivalents if x.domain in admissible)

    def exist(self, domain: Domain) -> Outcome:
        """Existence of alternatives in a domain: HOLDS, FAILS, or ABANDONED where it is unknown."""
        if self.within(domain) or (domain is Domain.COMPLEX and self.extent is Extent.FAMILY):
            return Outcome.HOLDS
        return (
            Outcome.FAILS
            if self.extent in (Extent.NONE, Extent.FINITE) or domain in self.excluded
            else Outcome.ABANDONED
        )

    @property
    def sentence(self) -> str:
        """Result in words."""
        at = ", ".join(f"{name} = {x}" for name, x in self.values)
        match self.extent:
            case Extent.NONE:
                return (
                    f"{self.other} has no parameters, real or complex, with the transfer function"
                    f" of {self.model} at {at}."
                )
            case Extent.UNKNOWN:
                return (
                    f"Which parameters of {self.other} give {self.model} at {at} was not decided:"
                    f" {self.reason}."
                )
            case Extent.FINITE:
                many = f"exactly {plural(len(self.equivalents), 'parameter vector')}"
            case Extent.FAMILY:
                many = (
                    f"infinitely many parameter vectors; {len(self.equivalents)} found with random"
                    f" {', '.join(self.free)}"
                )
        return (
            f"{self.other} has {many} with the transfer function of {self.model} at {at};"
            f" {len(self.within(Domain.REAL))} of them real, {len(self.within(Domain.POSITIVE))}"
            f" positive{self._none}."
        )

    @property
    def _none(self) -> str:
        return f" (none at all is {self.excluded[0]})" if self.excluded else ""


def alternatives(
    model: AnyModel | Chain | Network | tuple[object, ...],
    values: Mapping[str, object],
    other: AnyModel | Chain | Network | tuple[object, ...],
    *,
    plain: Sequence[Mapping[str, object]] = (),
    seed: str = "disting",
    seconds: float = SECONDS,
) -> Alternatives:
    """Alternatives to a model at rational values (numbers, texts such as "0.1", fractions), in the
    parameters of `other`, which has as many inputs and outputs: with all its transfer functions.
    Sets of positive values that are `plain`, as a theorem has them, come first where they do.

    Gives up after so many seconds. Raises InputError for missing, foreign or inexact values, a
    zero leading coefficient, and models of different inputs and outputs.

    >>> from disting import Model
    >>> a = Model.from_transfer_function("1", "(s + a)*(s + b)")
    >>> [str(x) for x in alternatives(a, {"a": 1, "b": "1/2"}, a).equivalents]
    ['a = 1/2, b = 1', 'a = 1, b = 1/2']
    """
    model, other = given_model(model), given_model(other)
    of_type(values, Mapping, "values are a mapping of names to numbers")
    exact = rational_values(model, values)
    if model.shape != other.shape:
        raise InputError(f"{model.name} and {other.name} have other numbers of inputs and outputs")
    first_model, other_model = on_one_variable([model, other])
    fibre, goals = Fibre(Extent.UNKNOWN, reason=OTHER_ZEROS), _targets(first_model, exact)
    if [e is None for e in first_model.cells] == [e is None for e in other_model.cells]:
        equations = joint_equations(goals, other_model.entries)
        fibre = _solve_fibre(equations, other.parameters, seed, seconds)
        points = [rational_values(other, values) for values in plain]
        first = [rational(dict(point)) for point in points if _targets(other_model, point) == goals]
        others = (
            x for x in fibre.equivalents if x.values not in [either.values for either in first]
        )
        fibre = replace(fibre, equivalents=(*first, *others))
    return Alternatives(
        model=model.name,
        other=other.name,
        values=exact,
        extent=fibre.extent,
        equivalents=fibre.equivalents,
        free=fibre.free,
        excluded=fibre.excluded,
        reason=fibre.reason,
    )


def _targets(model: AnyModel, values: PointValues) -> list[Target]:
    return [target(replace(entry, name=model.name), values) for entry in model.entries]


def _solve_fibre(
    equations: tuple[Sparse, ...], parameters: tuple[str, ...], seed: str, seconds: float
) -> Fibre:
    """At once, or in a process of its own."""
    try:
        return solve(equations, parameters, seed, AT_ONCE)
    except TooLarge:
        ended = run_limited(solve, (equations, parameters, seed, AT_MOST), seconds)
        return ended.value or Fibre(Extent.UNKNOWN, reason=ended.reason)
