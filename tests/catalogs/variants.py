"""What a lag, a dead time and the sensor quantity change, for whole families.

Lag. 1/(1 + T1 s) adds the pole -1/T1, which no zero cancels for generic T1: the denominator's
degree grows by one, the numerator stays, so n + m + 1 grows by one and condition 1 tells a model
with lag from the same model without, always.

Dead time. A theorem tells models with from those without (see `decide.same.exact`).

Sensor quantity. Position, velocity and acceleration are H, s H and s^2 H. Multiplication by s^k is
one to one on rational functions and has an inverse, so it maps equivalents to equivalents and
limits to limits: relations, inclusions, determinable parameters and equivalent parameters are the
same for all three. What changes are the places of the coefficients: powers of s that meet poles at
zero are cancelled, the others shift the numerator and leave zero coefficients. So the degrees and
the number of constant (zero) coefficients change, the number of free ones does not; and another
condition may be the first to decide where the models have different multiplicities of the pole at
zero, that is, where one has a damper from its free row to the ground and the other none.
"""

from collections import Counter
from dataclasses import dataclass, replace

from disting.behaviour.sample import Representation
from disting.conditions.rule import DEGREES, INVARIANTS
from disting.model.chain import Chain, Quantity
from disting.model.family import Family
from disting.verdict.engine import Engine
from disting.verdict.result import Query, Relation, Verdict, View


@dataclass(frozen=True, slots=True)
class SensorEffect:
    """The transfer function (25) for one sensor quantity: degrees, labels of the zero
    coefficients, free ones, rank.
    """

    sensor: Quantity
    numerator_degree: int
    denominator_degree: int
    zeros: tuple[str, ...]
    free: int
    rank: int


def sensor_effects(chain: Chain, engine: Engine | None = None) -> tuple[SensorEffect, ...]:
    """The three sensor quantities side by side.

    >>> effects = sensor_effects(Chain(2, damped=False))
    >>> [(e.numerator_degree, e.denominator_degree, e.free, e.rank) for e in effects]
    [(2, 4, 3, 3), (2, 3, 3, 3), (2, 2, 3, 3)]
    """
    engine = engine or Engine()
    return tuple(_effect(engine, replace(chain, quantity=sensor)) for sensor in Quantity)


def sensor_sentence(chain: Chain, engine: Engine | None = None) -> str:
    """What the sensor quantity changes for a chain, and what it does not.

    >>> degrees, unchanged = sensor_sentence(Chain(1, damped=False)).split("; ")
    >>> degrees
    'position 0/2 with a0, a1 zero, velocity 0/1 with a0 zero, acceleration 0/0'
    >>> unchanged
    'free coefficients (1) and rank (1) do not change'
    """
    seen = sensor_effects(chain, engine)
    parts = (
        f"{e.sensor} {e.numerator_degree}/{e.denominator_degree}{_zeros(e.zeros)}" for e in seen
    )
    return (
        f"{', '.join(parts)}; free coefficients ({seen[0].free}) and rank ({seen[0].rank}) do not"
        " change"
    )


def with_and_without_lag(family: Family, engine: Engine | None = None) -> tuple[Verdict, ...]:
    """Each model of a family against itself with a first-order lag."""
    return _against_itself(family, _by_degrees(engine or Engine()), lag=True)


def with_and_without_dead_time(family: Family, engine: Engine | None = None) -> tuple[Verdict, ...]:
    """Each model of a family against itself with a dead time."""
    return _against_itself(family, _by_degrees(engine or Engine()), dead_time=True)


def originals_against_lagged(
    family: Family, engine: Engine | None = None
) -> Counter[tuple[Relation, str]]:
    """Number of pairs (model of a family, any model of it with a lag) by relation and deciding
    rule.
    """
    engine, n = _by_degrees(engine or Engine()), len(family)
    names = [
        (f"A{i}{'+lag' * lag}", replace(chain, lag=lag))
        for lag in (False, True)
        for i, chain in enumerate(family, 1)
    ]
    query = Query(View.TF, conditions=(INVARIANTS.name, DEGREES.name))
    found = engine.decisions([engine.subject(*named) for named in names], query)
    pairs = ((i, j) for i in range(n) for j in range(n, 2 * n))
    return Counter((found.relation(i, j), found.rule(i, j)) for i, j in pairs)


def _against_itself(family: Family, engine: Engine, **extra: bool) -> tuple[Verdict, ...]:
    found = []
    for number, chain in enumerate(family, 1):
        other = replace(chain, **extra)  # type: ignore[arg-type]
        names = f"A{number}", f"A{number}+{'lag' if other.lag else 'delay'}"
        found.append(
            engine.verdict(
                engine.subject(names[0], chain),
                engine.subject(names[1], other),
                Query(inclusion=False),
            )
        )
    return tuple(found)


def _by_degrees(engine: Engine) -> Engine:
    """Conditions 1 to 4 suffice here, so no matroid is searched."""
    return Engine(replace(engine.settings, subset_limit=0), engine.store)


def _effect(engine: Engine, chain: Chain) -> SensorEffect:
    profile = engine.subject("", chain).profile(Representation.TF, 0)
    zeros = tuple(
        label for label, free in zip(profile.labels, profile.free, strict=True) if not free
    )
    numerator, denominator = profile.degrees
    return SensorEffect(
        chain.quantity, numerator, denominator, zeros, len(profile.form), profile.rank
    )


def _zeros(labels: tuple[str, ...]) -> str:
    return f" with {', '.join(labels)} zero" if labels else ""
