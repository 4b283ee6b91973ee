"""Findings as JSON text and back, for a cache."""

import json

from disting.certainty import Certainty
from disting.conditions.evidence import from_dict, to_dict
from disting.conditions.finding import Finding, Outcome


def finding_to_json(finding: Finding) -> str:
    """Compact JSON text of a finding."""
    evidence = to_dict(finding.evidence) if finding.evidence else None
    data = [finding.number, finding.outcome, finding.certainty, finding.safety, evidence, finding.note]
    return json.dumps(data, separators=(",", ":"))


def finding_from_json(text: str) -> Finding:
    """Inverse of `finding_to_json`; raises ValueError, KeyError or TypeError for what is none."""
    number, outcome, certainty, safety, evidence, note = json.loads(text)
    return Finding(number, Outcome(outcome), Certainty(certainty), safety, from_dict(evidence) if evidence else None, note)
