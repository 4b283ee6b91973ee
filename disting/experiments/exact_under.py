"""The exact decision under several experiments, where conditions 1 to 7 stay silent: a list of all
parameters that fit one experiment, put into the others (`listing`), then the ideal of one fibre of
the stacked map.

All that `fibres.ideals` says of one transfer function it says of polynomial maps: closures of
images, fibres over a random point, tangent equations, slices, and bounds that are computed from
the degrees, the numbers and the count of the coordinates at hand. The stacked map (`maps`) is such
a map, so its fibre is that of all experiments with one parameter vector, and its bounds are those
of all equations together. More equations make the ideal easier, as a rule.

Of a whole menu, `quick_finding`: rows that show the same (`same_rows`), lists that are made once
for all places, ranks of parts (`part_ranks`), and ideals within limits that are soon reached.
"""

from dataclasses import replace

from disting.algebra.certainty import LEAST_SAFETY, Certainty
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import EXACT
from disting.experiments.experiment import MeasuredChain
from disting.experiments.listing import by_list
from disting.experiments.maps import matched
from disting.experiments.part_ranks import by_parts
from disting.experiments.same_rows import same_by_rows
from disting.fibres.ideals import Limits, decide_matched
from disting.model.question import Question
from disting.model.settings import Settings
from disting.questions.same.exact import SAFETY, decided

LIMITS = Limits(seconds=600.0, entries=4_000_000, safety=SAFETY)
SHARED = 10  # bits: a table rests on up to a thousand findings, and says nothing below LEAST_SAFETY
QUICK = replace(LIMITS, entries=1_000_000, safety=LEAST_SAFETY + SHARED)
"""A matrix takes a second or two: there are hundreds of pairs."""


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


def quick_finding(left: MeasuredChain, right: MeasuredChain, settings: Settings) -> Finding:
    """One of many decisions on the same chains; it names no evidence where rows or parts
    decide.
    """
    if same_by_rows(left, right):
        return Finding(EXACT, Outcome.HOLDS, Certainty.PROVEN)
    found = by_list(left, right, settings, shared=True)
    if found is None:
        found = by_parts(left, right, settings)
    return by_ideals(left, right, settings, QUICK) if found is None else found


QUICKLY = Question(
    "exact decisions under experiments, quickly", quick_finding, Finding.to_json, Finding.from_json
)
