"""Structures that contain others: one notion for fit, plan, next, pages and exports.

A structure contains another one if it tends to it as some of its parameters go to zero or grow
without bound: masses, dampers, lag and dead time vanish, springs become rigid and join two masses
and their dampers to the ground; of networks likewise. This is the theorem of `model.minors` and of
`network.minors`, with force at force and sensor at sensor. Therefore whatever is measured, at any
place and after any change of the machine, follows from the larger structure too: no experiment
excludes it while the smaller one is true. The relation is transitive.

Where a chain is only a limit of another one by reciprocity, its force in place of the other one's
sensor, a further sensor may distinguish them: this is not containment.
"""

from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import islice
from math import sqrt

from disting.evidence.limits import Minor
from disting.fit.search.candidates import reference
from disting.fit.search.starts import Parameters, Scale
from disting.model.chain import Chain
from disting.model.minors import Fates, Places, fates, minors
from disting.network.network import Network

AnyStructure = Chain | Network
REMEMBERED = 20_000  # pairs of structures
WAYS = 8  # in which one chain becomes another one, at most so many of which are tried
# shares of their natural sizes for elements that vanish: what is small depends on parameters that
# may have run far away
VANISHING = [10.0**-k for k in (3, 4, 5, *range(6, 97, 10))]
STIFFEST = 1e12  # times its natural size, for a spring that becomes rigid: rounding grows with it


def name_of(structure: AnyStructure) -> str:
    """Return the name of a structure in commands and sentences."""
    return reference(structure) if isinstance(structure, Chain) else structure.name


def contains(larger: AnyStructure, smaller: AnyStructure) -> bool:
    """Return True if the larger structure tends to the smaller one at some limits of its
    parameters, with the same force and the same sensor.

    >>> contains(Chain(3, ground_dampers=(2,)), Chain(2, ground_dampers=(1,)))  # k12 -> infinity
    True
    >>> contains(Chain(3, ground_dampers=(1,)), Chain(2, ground_dampers=(2,)))
    False
    """
    if isinstance(larger, Chain) and isinstance(smaller, Chain):
        return (
            _has_factors(larger, smaller)
            and len(larger.parameters) > len(smaller.parameters)
            and bool(_ways(_plain(smaller), _plain(larger)))
        )
    if isinstance(larger, Network) and isinstance(smaller, Network):
        return limit_of(larger, smaller) is not None
    return False


def embeddings(larger: Chain, smaller: Chain, fit: Parameters, size: Scale) -> Iterator[Parameters]:
    """Yield parameters of a larger chain at which it almost is a smaller one with the parameters
    `fit`: each way, with what vanishes from 1/1000 of its natural size down.
    """
    if not contains(larger, smaller):
        return
    part, whole = smaller.structure, larger.structure
    for places in islice(_ways(_plain(smaller), _plain(larger)), WAYS):
        limits = fates(part, whole, dict(places))
        for share in VANISHING:
            yield {name: _value(name, limits, fit, size, share) for name in larger.parameters}


def limit_of(larger: Network, smaller: Network) -> Minor | None:
    """The values of the larger network in the limit that is the smaller one; None where it does not
    contain it.
    """
    return None if larger == smaller else _minor(smaller, larger)


def _value(name: str, limits: Fates, fit: Parameters, size: Scale, share: float) -> float:
    """Of one parameter near its limit."""
    if name in limits.shared:
        own, count = limits.shared[name]
        return fit[own] if name[0] == "T" else fit[own] / count
    if name in limits.idle:
        return size.mass
    if name in limits.rigid:
        return size.mass * size.high**2 * min(1 / share, STIFFEST)
    middle = sqrt(size.low * size.high)
    natural = {"m": size.mass, "k": size.mass * size.low**2, "T": 1 / size.high}
    return share * natural.get(name[0], size.mass * middle)


def _has_factors(larger: Chain, smaller: Chain) -> bool:
    """Return True if lag, dead time and sensor quantity of the smaller chain are those of the
    larger one too.
    """
    return (
        larger.quantity is smaller.quantity
        and larger.lag >= smaller.lag
        and larger.dead_time >= smaller.dead_time
        and larger.n_masses >= smaller.n_masses
    )


@lru_cache(maxsize=REMEMBERED)
def _plain(chain: Chain) -> Chain:
    """The chain without lag and dead time."""
    indices = chain.indices
    return Chain(
        *indices, chain.quantity, chain.damped, chain.ground_dampers, gap_damper=chain.gap_damper
    )


@lru_cache(maxsize=REMEMBERED)
def _ways(part: Chain, whole: Chain) -> tuple[tuple[tuple[int, int], ...], ...]:
    """Places, as in `model.minors`, at which the whole is the part, force and sensor included."""
    found = dict[tuple[tuple[int, int], ...], None]()
    for ports in _ports(part, whole):
        for places in islice(minors(part.structure, whole.structure, ports), WAYS):
            found[tuple(sorted(places.items()))] = None
    return tuple(found)


def _ports(part: Chain, whole: Chain) -> Iterator[Places]:
    """Yield where the ports of the whole are in the part: the two rows next to a gap may be
    exchanged, which turns force and sensor alike.
    """
    mine = (whole.act_plus, whole.act_minus, whole.meas_plus, whole.meas_minus)
    a, b, c, d = part.act_plus, part.act_minus, part.meas_plus, part.meas_minus
    for own in ((a, b, c, d), (b, a, d, c)):
        pairs = set(zip(mine, own, strict=True))
        ports: Mapping[int, int] = dict(pairs)
        if len(ports) == len(pairs):
            yield ports


@lru_cache(maxsize=REMEMBERED)
def _minor(part: Network, whole: Network) -> Minor | None:
    from disting.general.minor import minor_of  # chains have their own theorem

    return minor_of(part, whole)
