"""Candidate models of a fit: Fig. 1 of the paper, and wider classes."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, product

from disting.model.chain import Chain, Sensor
from disting.model.family import Family


def figure_1(sizes: Sequence[int] = (1, 2, 3, 4), sensor: Sensor = Sensor.ACCELERATION) -> tuple[Chain, ...]:
    """Chains driven and seen at mass 1, every set of ground dampers, with and without lag and dead time.

    >>> len(figure_1())
    120
    """
    return tuple(variant for n in sizes for variant in variants(Chain(n, sensor=sensor, damped=True)))


def variants(chain: Chain) -> Iterator[Chain]:
    """Yield a chain with every set of ground dampers, with and without lag and dead time: 4 times 2^N models."""
    masses = range(1, chain.n_masses + 1)
    sets = [chosen for size in range(chain.n_masses + 1) for chosen in combinations(masses, size)]
    for chosen, lag, dead_time in product(sets, (False, True), (False, True)):
        yield replace(chain, ground_dampers=chosen, lag=lag, dead_time=dead_time)


def whole_family(sizes: Sequence[int], sensor: Sensor = Sensor.ACCELERATION) -> tuple[Chain, ...]:
    """Every chain under (36)-(38) of these sizes, with its variants."""
    return tuple(v for n in sizes for chain in Family(n, damped=True, sensor=sensor) for v in variants(chain))
