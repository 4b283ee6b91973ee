"""The exact decision under several experiments, where conditions 1 to 7 stay silent: a list of all
parameters that fit one experiment, put into the others (`listing`), then the ideal of one fibre of
the stacked map.

All that `fibres.ideals` says of one transfer function it says of polynomial maps: closures of
images, fibres over a random point, tangent equations, slices, and bounds that are computed from
the degrees, the numbers and the count of the coordinates at hand. The stacked map (`maps`) is such
a map, so its fibre is that of all experiments with one parameter vector, and its bounds are those
of all equations together. More equations make the ideal easier, as a rule.
"""

from disting.conditions.finding import Finding
from disting.experiments.experiment import MeasuredChain
from disting.experiments.listing import by_list
from disting.experiments.maps import matched
from disting.fibres.ideals import Limits, decide_matched
from disting.model.settings import Settings
from disting.questions.same.exact import SAFETY, decided

LIMITS = Limits(seconds=600.0, entries=4_000_000, safety=SAFETY)


def exact_finding(left: MeasuredChain, right: MeasuredChain, settings: Settings) -> Finding:
    """The finding for two measured chains of equal ranks and degrees; dead times are equal where
    conditions 1 to 3 hold, and a factor of their own.
    """
    found = by_list(left, right, settings)
    return by_ideals(left, right, settings, LIMITS) if found is None else found


def by_ideals(
    left: MeasuredChain, right: MeasuredChain, settings: Settings, limits: Limits
) -> Finding:
    """What the ideal of one fibre of the stacked map says."""
    maps = matched(left, right)
    found = decide_matched(*maps, equal_rank=True, seed=settings.seed, limits=limits)
    return decided(found)
