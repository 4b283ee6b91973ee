"""Candidates that differ by one step, and the fit of one as a start of the other.

A search from the data alone may end in a valley where one element does the work of another: a
damper at the wrong mass, a dead time for a lag, a small mass tuned to one line. The fit of a
neighbour often lies in the better one.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from disting.fit.search.starts import Scale, Values, extended, shortened
from disting.model.chain import Chain

ADDED = (0.1, 1.0)  # of its natural size, for an element that the neighbour lacks


def neighbours(chain: Chain) -> Iterator[Chain]:
    """Yield the candidates with one element fewer or more, a ground damper at another mass, the
    lag for the dead time.
    """
    yield from shortened(chain)
    dampers = set(chain.ground_dampers)
    free = [i for i in range(1, chain.n_masses + 1) if i not in dampers]
    for at in free:
        yield replace(chain, ground_dampers=tuple(sorted(dampers | {at})))
        for other in chain.ground_dampers:
            yield replace(chain, ground_dampers=tuple(sorted((dampers | {at}) - {other})))
    if not chain.lag:
        yield replace(chain, lag=True)
    if not chain.dead_time:
        yield replace(chain, dead_time=True)
    if chain.lag != chain.dead_time:
        yield replace(chain, lag=chain.dead_time, dead_time=chain.lag)


def carried(
    chain: Chain, fit: Values, size: Scale, factors: Iterable[float] = ADDED
) -> Iterator[Values]:
    """Starts from the fit of another candidate: what it has too much hands its value over to an
    element of its kind that is missing, or is left out; what is missing then is added.
    """
    missing = [name for name in chain.parameters if name not in fit]
    surplus = [name for name in fit if name not in chain.parameters]
    values = {name: fit[name] for name in chain.parameters if name in fit}
    for kind in {name[0] for name in missing}:  # a lag takes the value of a dead time
        wanted, spare = ([n for n in names if n[0] == kind] for names in (missing, surplus))
        values |= {new: fit[old] for new, old in zip(wanted, spare, strict=False)}
    if len(values) == len(chain.parameters):
        yield {name: values[name] for name in chain.parameters}
    else:
        yield from extended(chain, values, size, factors)
