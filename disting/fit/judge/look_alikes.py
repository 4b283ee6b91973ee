"""Structures outside the candidates that have the same responses as a fitted chain.

A chain of n masses (n <= 4) with force at mass 1 is compared with

- branches: trees of n masses with as many ground dampers and the same distance from the force to
  the sensor, without the row from mass 1, which is a chain and so a candidate. Named if
  `general.replacement` proves that both give the same responses for all positive values (special
  values aside). The distance fixes the slope at high frequencies, so trees of other distances
  cannot have the same responses.
- an elastic base: n - 1 masses and a base that a spring holds to the ground; the force acts between
  base and mass 1, the sensor shows mass 1 relative to the base. In the class of chains this is a
  chain of n masses with a gap behind mass 1. The engine of chains decides every such pair with at
  most 4 masses (a test asks it): with force and sensor at mass 1 and no ground dampers, the base
  has the same responses if there are no dampers or if n is 2; else it has others.
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

Friction at mass 1, where force and sensor are, is a term of force per velocity by itself. So a
chain with it has the look-alikes on a base of the chain without it, each with the same friction
between base and mass 1, as that of a motor's bearings.

In every case the fitted mass 1 is m1 mb / (m1 + mb), the limit at high frequencies, and a mode of
an elastic base is a term 1 / (mb s^2 + db s + kb) of the response in addition to those of the
drive.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction
from functools import cache
from itertools import combinations, permutations, product

import numpy as np

from disting.fit.search.modes import row
from disting.model.chain import Chain
from disting.network.chains import of_chain
from disting.network.network import Element, Network, Port

MOST_MASSES = 4
RUBBING = ", with friction b1 between base and motor"
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
    values with the fitted response; None where none is computed. `apart`: the largest share by
    which the response differs at a line, 0 where it is proven to be the same.
    """

    kind: LookAlikeKind
    text: str
    values: Mapping[str, float] | None
    apart: float = 0.0


@dataclass(frozen=True, slots=True)
class LookAlikes:
    """Look-alikes of a chain. `not_looked_for`: the reason why none were searched, else "".
    `base_differs`: a drive on an elastic base, with as many masses if the base is counted, has
    other responses (proven), so that data can decide between them. `lossless`: branches that are
    the same if all dampers are removed and not known to be the same with them. `near`: other
    responses, but within the scatter of the lines (`near_bases`).
    """

    found: tuple[LookAlike, ...] = ()
    not_looked_for: str = ""
    base_differs: bool = False
    lossless: tuple[str, ...] = ()
    near: tuple[LookAlike, ...] = ()


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
    found = (*elastic, *_with_friction(_free_base, chain, at), *_branches(chain, at))
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
        return _synthesize_values(chain, values, network)
    kept = tuple(e for e in network.elements if e.value != "b1")
    rest = _synthesize_values(
        replace(chain, ground_dampers=()), values, replace(network, elements=kept)
    )
    return None if rest is None else {**rest, "b1": values["b1"]}


def _same_branches(chain: Chain) -> Iterator[Network]:
    """Branches that have the same responses by the theorems."""
    others = _list_branches(chain.n_masses, chain.meas_plus - 1, len(chain.ground_dampers))
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


def _list_branches(masses: int, distance: int, dampers: int) -> list[Layout]:
    """Trees but the row from mass 1, with such a sensor and so many ground dampers, each once."""
    row = tuple((i, i + 1) for i in range(1, masses))
    pairs = list(combinations(range(1, masses + 1), 2))
    layouts = {
        _smallest(masses, (edges, sensor, grounded))
        for edges in combinations(pairs, masses - 1)
        for sensor, grounded in product(
            range(1, masses + 1), combinations(range(1, masses + 1), dampers)
        )
        if _distance(edges, sensor) == distance and _reaches_all(edges, masses)
    }
    return sorted(layout for layout in layouts if layout[0] != row)


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


def _synthesize_values(
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


def base_is_the_same(chain: Chain) -> bool:
    """Return True if a drive with one mass less on an elastic base has the same responses as this
    chain, False if it has others; for 2 to 4 masses and the force at mass 1, for all positive
    values (special values aside).

    Without ground dampers both responses are the double integrator of the whole mass and n - 1
    modes, each with a positive weight. Where nothing is damped, such a sum fixes either structure,
    whichever mode is that of the base. The one mode of two masses has one damping for either.

    >>> base_is_the_same(Chain(3, damped=False)), base_is_the_same(Chain(3))
    (True, False)
    """
    if chain.meas_plus != 1:  # the motion of the base is seen: 1/(mb s^2) at high frequencies
        return False
    return not chain.ground_dampers and (not chain.damped or chain.n_masses == 2)


def _with_friction(
    bases: Callable[[Chain, Mapping[str, float]], Iterable[LookAlike]],
    chain: Chain,
    values: Mapping[str, float],
) -> tuple[LookAlike, ...]:
    """Bases of a chain; those of one with friction at force and sensor are bases of the chain
    without it.
    """
    if chain.ground_dampers[:1] != (1,) or chain.meas_plus != 1:
        return tuple(bases(chain, values))
    rest = replace(chain, ground_dampers=chain.ground_dampers[1:])
    return tuple(
        replace(x, text=x.text + RUBBING, values=x.values and {**x.values, "b1": values["b1"]})
        for x in bases(rest, values)
    )


def _elastic_base(chain: Chain, values: Mapping[str, float]) -> tuple[tuple[LookAlike, ...], bool]:
    """The drive with one mass less on an elastic base, if the engine proves it the same, and the
    proof that it differs.
    """
    if chain.n_masses == 1:
        return (), False
    if chain.meas_plus != 1:  # the motion of the base is seen: 1/(mb s^2) at high frequencies
        return (), True
    differing = list[bool]()

    def bases(of: Chain, at: Mapping[str, float]) -> Iterator[LookAlike]:
        same, differs = _same_bases(of)
        differing.append(differs)
        yield from (x for base in same for x in _named_base(of, base, at))

    found = _with_friction(bases, chain, values)
    if not found and 1 in chain.ground_dampers:  # friction at the base's mass, to the ground
        found = tuple(bases(chain, values))
    return found, all(differing)


def _same_bases(chain: Chain) -> tuple[list[Chain], bool]:
    """Drives with one mass less on an elastic base, with as many dampers to the ground, that have
    the same responses; and whether all of them are proven to have others. Without such dampers the
    theorem decides, else the engine, which is imported for that.
    """
    n, count = chain.n_masses, len(chain.ground_dampers)
    dampers = combinations(range(1, n + 1), count)
    bases = [Chain(n, 1, 1, 2, 1, 2, chain.sensor, chain.damped, chosen) for chosen in dampers]
    if not count:
        same = base_is_the_same(chain)
        return bases if same else [], not same
    from disting.fit.judge.alternatives import alternatives
    from disting.verdict.engine import Engine
    from disting.verdict.result import Relation

    left = list(alternatives(chain, bases, Engine(), {}))
    return [a.chain for a in left if a.relation is Relation.INDISTINGUISHABLE], not left


def _named_base(chain: Chain, base: Chain, values: Mapping[str, float]) -> Iterator[LookAlike]:
    """The drive on a base, once for each resonance that may be that of the base."""
    kind, text = LookAlikeKind.ELASTIC_BASE, base_text(chain.n_masses - 1)
    grounded = [f"mass {i - 1}" if i > 1 else "the base" for i in base.ground_dampers]
    if grounded:
        text += f" with dampers to the ground at {' and '.join(grounded)}"
    if chain.ground_dampers:
        yield LookAlike(kind, text, None)
        return
    for hertz, there in values_on_elastic_base(chain.n_masses, values):
        yield LookAlike(kind, f"{text} with its resonance at {hertz:.4g} Hz", there)


def is_on_base(chain: Chain) -> bool:
    """Return True if mass 1 is an elastic base, with the force between it and mass 2.

    >>> is_on_base(Chain(3, 1, 1, 2, 1, 2)), is_on_base(Chain(3))
    (True, False)
    """
    return chain.gap == 1 and (chain.act_minus, chain.act_plus) == (1, 2) and chain.collocated


def base_text(masses: int) -> str:
    """A drive on an elastic base in words.

    >>> base_text(2)
    '2 masses on an elastic base'
    """
    return f"{masses} mass{'es' if masses > 1 else ''} on an elastic base"


def values_on_elastic_base(
    n: int, values: Mapping[str, float]
) -> Iterator[tuple[float, Mapping[str, float]]]:
    """For each mode of a chain of n masses the undamped frequency in Hz and the values if it is
    that of the base; with dampers where the values hold them and there are two masses.
    """
    m = np.array([values[f"m{i}"] for i in range(1, n + 1)])
    k = np.array([values[f"k{i}{i + 1}"] for i in range(1, n)])
    stiffness = np.diag(np.append(k, 0) + np.append(0, k)) - np.diag(k, 1) - np.diag(k, -1)
    squares, shapes = np.linalg.eigh(stiffness / np.sqrt(np.outer(m, m)))
    squares[0], shares = 0.0, shapes[0] ** 2 / m[0]  # G = sum of share / (s^2 + square)
    for at in range(1, n):
        base = {"mb": float(1 / shares[at]), "kb": float(squares[at] / shares[at])}
        if n == 2 and "d12" in values:  # one mode, damped as the joint is
            base["db"] = base["kb"] * values["d12"] / values["k12"]
        masses, springs = row(np.delete(squares, at), np.delete(shares, at))
        drive = {f"k{i}{i + 1}": k for i, k in enumerate(springs[:-1], 1)}
        drive |= {f"m{i}": m for i, m in enumerate(masses, 1)}
        drive = dict(sorted(drive.items()))
        yield float(np.sqrt(squares[at]) / (2 * np.pi)), drive | base


def _free_base(chain: Chain, values: Mapping[str, float]) -> Iterator[LookAlike]:
    """The same drive on a free base by the theorem; values with a base that is `HEAVY`."""
    n = chain.n_masses
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
