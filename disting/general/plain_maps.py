"""Explicit maps without exception: one formula each way, with plus signs only, so that positive
parameters give positive equivalents wherever they are.

Theorems on networks and searches that rest on them speak of generic values. Where such a map
exists, the same statement holds for all values, so it is the stronger one.
"""

from dataclasses import replace

from disting.conditions.rule import ADMISSIBLE, Finding, Outcome
from disting.evidence.general import Explicit
from disting.general.formulas import explicit, fit
from disting.general.matrix_model import AnyModel
from disting.general.orthant import BRIEF
from disting.general.which_models import Way, way
from disting.model.question import Domain, Question, Settings

NO_MAP = "no map with plus signs only was found"
SMALL = 5  # parameters: of so few all orders are tried, whatever the numbering
EVERY = replace(BRIEF, orders=120)


def plain_maps(left: AnyModel, right: AnyModel) -> Explicit | None:
    """The map that has no exception, if a brief search finds one."""
    size = max(len(m.parameters) for m in (left, right))
    effort, ways = EVERY if size <= SMALL else BRIEF, list[Way]()
    for model, other in ((left, right), (right, left)):
        one_way = way(model, other, Domain.POSITIVE, effort)
        if one_way is None or not one_way.covering:
            return None
        ways.append(one_way)
    evidence = explicit(ways, left, right, Domain.POSITIVE, effort)
    is_plain = evidence is not None and evidence.without_exception(Domain.POSITIVE)
    return evidence if is_plain and evidence and fit(evidence, left, right) else None


def _search(left: AnyModel, right: AnyModel, settings: Settings) -> Finding:
    return stronger(Finding(ADMISSIBLE, Outcome.ABANDONED, note=NO_MAP), left, right)


def stronger(finding: Finding, left: AnyModel, right: AnyModel) -> Finding:
    """The map without exception as a finding; the given finding where there is none."""
    evidence = plain_maps(left, right)
    return Finding(ADMISSIBLE, Outcome.HOLDS, evidence=evidence) if evidence else finding


PLAIN_MAPS = Question(
    "maps of general models without exception",
    _search,
    Finding.to_json,
    lambda text: Finding.from_json(text, ADMISSIBLE),
)
"""Question on networks that are equivalent by a theorem, special values excepted."""
