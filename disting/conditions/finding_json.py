"""Findings of decisions as JSON text and back, for a cache and for files of settled decisions."""

import json

from disting.algebra.certainty import Certainty
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import EXACT, Rule
from disting.evidence.kinds import evidence_from

# what the files have in the place of the rule where a decision found it, since the first of them:
# a mark, and no place in the table of conditions, of which one called 10 is written as text
WRITTEN = 10


def finding_to_json(finding: Finding) -> str:
    """Compact JSON text of a finding of a decision; its rule is known to whoever asked."""
    evidence = finding.evidence.to_dict() if finding.evidence else None
    data = [WRITTEN, finding.outcome, finding.certainty, finding.safety, evidence, finding.note]
    return json.dumps(data, separators=(",", ":"))


def finding_from_json(text: str, rule: Rule = EXACT) -> Finding:
    """Inverse of `finding_to_json`, for a finding by this rule; raises ValueError, KeyError or
    TypeError for what is none.
    """
    written, outcome, certainty, safety, evidence, note = json.loads(text)
    if written != WRITTEN:
        raise ValueError("not a finding of a decision")
    return Finding(
        rule=rule,
        outcome=Outcome(outcome),
        certainty=Certainty(certainty),
        safety=safety,
        evidence=evidence_from(evidence) if evidence else None,
        note=note,
    )
