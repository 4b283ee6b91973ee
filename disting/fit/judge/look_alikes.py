"""Structures outside the candidates that have the same responses as a fitted chain.

A chain of n masses (n <= 4) with force at mass 1 is compared with

- branches: the other trees of n masses with as many ground dampers and the same distance from the
  force to the sensor. Named if `general.replacement` proves that both give the same responses for
  all positive values (special values aside). The distance fixes the slope at high frequencies, so
  trees of other distances cannot have the same responses.
- an elastic base: n - 1 masses and a base that a spring holds to the ground; the force acts between
  base and mass 1, the sensor shows mass 1 relative to the base. In the class of chains this is a
  chain of n masses with a gap behind mass 1, so the engine decides it.
- a base that moves freely, without a spring to the ground; force and sensor as above.

THEOREM. A chain without ground dampers, force and sensor at mass 1, has the same responses on a
free base of any mass greater than the sum of the fitted masses. Proof. Mechanical admittance, x =
s^2. The base of mass a is in series with the drive, b x + Y, where b is mass 1 and Y what follows.
With T = (a / (a + b))^2 and A = a^2 / (a + b),

    a x (b x + Y) / ((a + b) x + Y) = (a b / (a + b)) x + A x T Y / (A x + T Y),

that is a mass 1 of a b / (a + b), followed by a mass A in series with all of Y times T. The spring
and damper of T Y are in series with A and can be exchanged with it; then A is the base of the rest
of the chain, and the step repeats. Behind the last mass A is loose and has no effect. Reversed, the
step needs a > b' for each fitted mass b', and the new base has the mass a - b'. QED. A lag and a
dead time are common factors of both.

FRICTION of the motor's bearings is a damper beside force and sensor, so that it adds b1 s to 1/G,
on the ground as on a base. So what holds of a chain without ground dampers, sensor at mass 1, holds
with b1 too, which is on the base the friction between motor and base.

In every case the fitted mass 1 is m1 mb / (m1 + mb), the limit at high frequencies, and a mode of
an elastic base is a term 1 / (mb s^2 + db s + kb) of the response beside those of the drive.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction
from functools import cache
from itertools import combinations, permutations, product

import numpy as np

from disting.fit.judge.alternatives import alternatives
from disting.fit.search.modes import row
from disting.model.chain import Chain
from disting.network.chains import of_chain
from disting.network.element import Element, Port
from disting.network.network import Network
from disting.verdict.engine import Engine
from disting.verdict.result import Relation

MOST_MASSES = 4
HEAVY = 4.0  # mass of the free base of the example, in masses of the whole fitted chain

Edge = tuple[int, int]
Layout = tuple[tuple[Edge, ...], int, tuple[int, ...]]
"""Joints, the mass of the sensor, and the masses with a ground damper; the force is at mass 1."""


class LookAlikeKind(StrEnum):
    """The change of the machine that leaves its responses the same."""

    BRANCH = "branch"
    ELASTIC_BASE = "elastic base"
    FREE_BASE = "free base"


@dataclass(frozen=True, slots=True)
class LookAlike:
    """A structure outside the candidates with the same responses, as text, and one set of its
    values with the fitted response; None where none is computed.
    """

    kind: LookAlikeKind
    text: str
    values: Mapping[str, float] | None


@dataclass(frozen=True, slots=True)
class LookAlikes:
    """Look-alikes of a chain. `not_looked_for`: the reason why none were looked for, else "".
    `base_differs`: a drive on an elastic base, with as many masses if the base is counted, has
    other responses (proven), so that data can decide between them. `lossless`: branches that are
    the same if all dampers are removed and not known to be the same with them.
    """

    found: tuple[LookAlike, ...] = ()
    not_looked_for: str = ""
    base_differs: bool = False
    lossless: tuple[str, ...] = ()


def look_alikes(chain: Chain, values: Mapping[str, float]) -> LookAlikes:
    """Look-alikes of a chain with these values in SI units; lag and dead time are passed over.

    >>> found = look_alikes(Chain(3, damped=False),
    ...     {"m1": 1.0, "m2": 1.0, "m3": 1.0, "k12": 1.0, "k23": 1.0}).found
    >>> [x.text for x in found if x.kind is LookAlikeKind.BRANCH]
    ['1~2, 1~3; F1; S1']
    """
    plain = replace(chain, lag=False, dead_time=False)
    if plain.gap or plain.act_minus or plain.meas_minus or plain.act_plus != 1:
        return LookAlikes(not_looked_for="only chains with the force at mass 1 are looked at")
    if plain.n_masses > MOST_MASSES:
        return LookAlikes(not_looked_for=f"only chains of up to {MOST_MASSES} masses are looked at")
    return _look_alikes(plain, tuple((n, values[n]) for n in plain.parameters))


@cache
def _look_alikes(chain: Chain, values: tuple[tuple[str, float], ...]) -> LookAlikes:
    at = dict(values)
    elastic, differs = _elastic_base(chain, at)
    found = (*elastic, *_free_base(chain, at), *_branches(chain, at))
    return LookAlikes(found, base_differs=differs, lossless=_lossless(chain, found))


def _lossless(chain: Chain, found: Collection[LookAlike]) -> tuple[str, ...]:
    if not chain.damped or chain.n_masses == 1:
        return ()
    bare = replace(chain, damped=False, ground_dampers=())
    with_dampers = {x.text.replace("=", "~") for x in found}
    return tuple(n.name for n in _same_branches(bare) if n.name not in with_dampers)


# branches


def _branches(chain: Chain, values: Mapping[str, float]) -> Iterator[LookAlike]:
    for network in _same_branches(chain):
        yield LookAlike(LookAlikeKind.BRANCH, network.name, _values_of(network, chain, values))


def _values_of(
    network: Network, chain: Chain, values: Mapping[str, float]
) -> Mapping[str, float] | None:
    """One set of values. A ground damper at force and sensor is a term of 1/G by itself."""
    if chain.ground_dampers != (1,) or chain.meas_plus != 1 or "b1" not in network.parameters:
        return _synthesized(chain, values, network)
    kept = tuple(e for e in network.elements if e.value != "b1")
    rest = _synthesized(replace(chain, ground_dampers=()), values, replace(network, elements=kept))
    return None if rest is None else {**rest, "b1": values["b1"]}


def _same_branches(chain: Chain) -> Iterator[Network]:
    """Trees other than the chain that have the same responses by the theorems."""
    own = _layout_of(chain)
    layouts = _layouts(chain.n_masses, _distance(own[0], own[1]), len(own[2]))
    others = [layout for layout in layouts if layout != _smallest(chain.n_masses, own)]
    if not others:
        return
    # the engine of networks, which a fit needs here alone
    from disting.general.any_model import as_model
    from disting.general.replacement import replaceable

    model = as_model(of_chain(chain))
    for layout in others:
        network = _network(layout, chain)
        if replaceable(model, as_model(network)):
            yield network


def _layout_of(chain: Chain) -> Layout:
    edges = tuple((i, i + 1) for i in range(1, chain.n_masses))
    return edges, chain.meas_plus, tuple(chain.ground_dampers)


def _layouts(masses: int, distance: int, dampers: int) -> list[Layout]:
    """All trees with such a sensor and so many ground dampers, each once."""
    pairs = list(combinations(range(1, masses + 1), 2))
    layouts = {
        _smallest(masses, (edges, sensor, grounded))
        for edges in combinations(pairs, masses - 1)
        for sensor, grounded in product(
            range(1, masses + 1), combinations(range(1, masses + 1), dampers)
        )
        if _distance(edges, sensor) == distance and _reaches_all(edges, masses)
    }
    return sorted(layouts)


def _smallest(masses: int, layout: Layout) -> Layout:
    """The first of all numberings in which the force stays at mass 1."""
    edges, sensor, grounded = layout
    numberings = ((0, 1, *rest) for rest in permutations(range(2, masses + 1)))
    return min(
        (
            tuple(sorted((min(at[i], at[j]), max(at[i], at[j])) for i, j in edges)),
            at[sensor],
            tuple(sorted(at[i] for i in grounded)),
        )
        for at in numberings
    )


def _reaches_all(edges: tuple[Edge, ...], masses: int) -> bool:
    return all(_distance(edges, i) >= 0 for i in range(1, masses + 1))


def _distance(edges: tuple[Edge, ...], to: int) -> int:
    """Number of joints from mass 1; -1 if there is no path."""
    reached, steps = {1}, 0
    while to not in reached:
        more = {j for e in edges if reached & set(e) for j in e} - reached
        if not more:
            return -1
        reached, steps = reached | more, steps + 1
    return steps


def _network(layout: Layout, chain: Chain) -> Network:
    edges, sensor, grounded = layout
    joints = [(f"{i}{j}", (i, j)) for i, j in edges]
    elements = (
        *(Element(f"m{i}", "m", (i,)) for i in range(1, chain.n_masses + 1)),
        *(Element(f"k{name}", "k", ends) for name, ends in joints),
        *(Element(f"d{name}", "d", ends) for name, ends in joints if chain.damped),
        *(Element(f"b{i}", "d", (i, 0)) for i in grounded),
    )
    joint = "=" if chain.damped else "~"
    text = ", ".join(f"{i}{joint}{j}" for i, j in edges) + f"; F1; S{sensor}"
    text += f"; damper{'s' if len(grounded) > 1 else ''} to the ground at " * bool(grounded)
    text += " and ".join(map(str, grounded))
    return Network(elements, (Port(1),), (Port(sensor),), chain.sensor.order, text)


def _synthesized(
    chain: Chain, values: Mapping[str, float], network: Network
) -> Mapping[str, float] | None:
    """Positive values by synthesis, None where there is no formula."""
    # as in `_same_branches`
    from disting.general.any_model import as_model, on_one_variable
    from disting.general.balls import positive_sets
    from disting.general.synthesis import NoFormulas
    from disting.general.target import rational_values

    model = as_model(of_chain(chain))
    at = {name: Fraction(values[name]) for name in chain.parameters}
    try:
        first, second = on_one_variable([model, as_model(network)])
        sets = positive_sets(first, dict(rational_values(model, at)), second).sets
    except NoFormulas:
        return None
    return {n: float(x) for n, x in sorted(sets[0].items())} if sets else None


# bases


def _elastic_base(chain: Chain, values: Mapping[str, float]) -> tuple[tuple[LookAlike, ...], bool]:
    """The drive with one mass less on an elastic base, if the engine proves it the same, and the
    proof that it differs.
    """
    n = chain.n_masses
    if n == 1:
        return (), False
    with_friction, apart = tuple[LookAlike, ...](), True
    if _has_motor_friction(chain):
        bare, apart = _elastic_base(replace(chain, ground_dampers=()), values)
        with_friction = tuple(_with_friction(x, values) for x in bare)
    if chain.meas_plus != 1:  # the motion of the base is seen: 1/(mb s^2) at high frequencies
        return (), True
    dampers = combinations(range(1, n + 1), len(chain.ground_dampers))
    bases = [Chain(n, 1, 1, 2, 1, 2, chain.sensor, chain.damped, chosen) for chosen in dampers]
    others = alternatives(chain, bases, Engine(), {})
    same = [a for a in others if a.relation is Relation.INDISTINGUISHABLE]
    found = tuple(x for a in same for x in _named_base(chain, a.chain, values))
    return (*with_friction, *found), apart and not others


def _named_base(chain: Chain, base: Chain, values: Mapping[str, float]) -> Iterator[LookAlike]:
    """The drive on a base, once for each resonance that may be that of the base."""
    kind, text = LookAlikeKind.ELASTIC_BASE, _base_text(chain.n_masses - 1, base)
    if chain.ground_dampers:
        yield LookAlike(kind, text, None)
        return
    for hertz, there in _values_on_elastic_base(chain, values):
        yield LookAlike(kind, f"{text} with its resonance at {hertz:.4g} Hz", there)


def _has_motor_friction(chain: Chain) -> bool:
    return chain.ground_dampers == (1,) and chain.meas_plus == 1


def _with_friction(same: LookAlike, values: Mapping[str, float]) -> LookAlike:
    """The same machine with the friction of the motor's bearings in the base."""
    there = None if same.values is None else {**same.values, "b1": values["b1"]}
    return replace(same, text=f"{same.text}, friction b1 between motor and base", values=there)


def _base_text(masses: int, base: Chain) -> str:
    grounded = [f"mass {i - 1}" if i > 1 else "the base" for i in base.ground_dampers]
    text = f"{masses} mass{'es' if masses > 1 else ''} on an elastic base"
    return text + f" with dampers to the ground at {' and '.join(grounded)}" * bool(grounded)


def _values_on_elastic_base(
    chain: Chain, values: Mapping[str, float]
) -> Iterator[tuple[float, Mapping[str, float]]]:
    """For each mode the undamped frequency in Hz and the values if it is that of the base."""
    n = chain.n_masses
    m = np.array([values[f"m{i}"] for i in range(1, n + 1)])
    k = np.array([values[f"k{i}{i + 1}"] for i in range(1, n)])
    stiffness = np.diag(np.append(k, 0) + np.append(0, k)) - np.diag(k, 1) - np.diag(k, -1)
    squares, shapes = np.linalg.eigh(stiffness / np.sqrt(np.outer(m, m)))
    squares[0], shares = 0.0, shapes[0] ** 2 / m[0]  # G = sum of share / (s^2 + square)
    for at in range(1, n):
        base = {"mb": float(1 / shares[at]), "kb": float(squares[at] / shares[at])}
        if chain.damped:  # two masses: one mode, damped as the joint is
            base["db"] = base["kb"] * values["d12"] / values["k12"]
        masses, springs = row(np.delete(squares, at), np.delete(shares, at))
        drive = {f"k{i}{i + 1}": k for i, k in enumerate(springs[:-1], 1)}
        drive |= {f"m{i}": m for i, m in enumerate(masses, 1)}
        drive = dict(sorted(drive.items()))
        yield float(np.sqrt(squares[at]) / (2 * np.pi)), drive | base


def _free_base(chain: Chain, values: Mapping[str, float]) -> Iterator[LookAlike]:
    """The same drive on a free base by the theorem; values with a base that is `HEAVY`."""
    n = chain.n_masses
    if _has_motor_friction(chain):
        same = _free_base(replace(chain, ground_dampers=()), values)
        yield from (_with_friction(x, values) for x in same)
    if chain.ground_dampers or chain.meas_plus != 1:
        return
    base = HEAVY * sum(values[f"m{i}"] for i in range(1, n + 1))
    there, left, scale = {"mb": base}, base, 1.0
    for i in range(1, n + 1):  # the step of the theorem, reversed
        mass = values[f"m{i}"] * left / (left - values[f"m{i}"])
        there[f"m{i}"] = mass / scale
        scale *= (left / (left + mass)) ** 2
        left -= values[f"m{i}"]
        for name in {f"k{i}{i + 1}", f"d{i}{i + 1}"} & values.keys():
            there[name] = values[name] / scale
    text = f"{n} mass{'es' if n > 1 else ''} on a base that moves freely"
    yield LookAlike(LookAlikeKind.FREE_BASE, text, dict(sorted(there.items())))
