"""Evidence: what made a condition decide, small enough to be stored with the verdict and to be checked again alone.

Each kind says itself in a sentence and in a formula, and turns into plain data and back. `verify.py` checks it anew.
"""

from dataclasses import asdict
from typing import get_args

from disting.conditions.evidence_of_conditions import ByConditions as ByConditions
from disting.conditions.evidence_of_conditions import Counts as Counts
from disting.conditions.evidence_of_conditions import Embedding as Embedding
from disting.conditions.evidence_of_conditions import Forms as Forms
from disting.conditions.evidence_of_conditions import FreeChoice as FreeChoice
from disting.conditions.evidence_of_conditions import Labels as Labels
from disting.conditions.evidence_of_conditions import Ranks as Ranks
from disting.conditions.evidence_of_conditions import Renaming as Renaming
from disting.conditions.evidence_of_conditions import Supermodel as Supermodel
from disting.conditions.evidence_of_conditions import spelled as spelled
from disting.conditions.evidence_of_decision import DeadTime as DeadTime
from disting.conditions.evidence_of_decision import FibreAt as FibreAt
from disting.conditions.evidence_of_decision import Theorem as Theorem
from disting.conditions.explicit import Constants as Constants
from disting.conditions.explicit import Explicit as Explicit
from disting.conditions.explicit import NoEquivalent as NoEquivalent
from disting.conditions.reality import RealFactors, RealWitnesses
from disting.conditions.ways import BothWays, OddFibres
from disting.conditions.witnesses import Witnesses
from disting.ideals import ByRow, FullParts, Refuted, Shared, Solved

ByDecision = Theorem | DeadTime | FibreAt | FullParts | Solved | ByRow | Refuted | Shared
Nested = BothWays | RealFactors | RealWitnesses
Evidence = ByConditions | ByDecision | Nested | OddFibres | Witnesses | Explicit | NoEquivalent | Constants
_KINDS: dict[str, type[Evidence]] = {c.kind: c for c in get_args(Evidence)}


def to_dict(evidence: Evidence) -> dict[str, object]:
    """Plain data, ready for JSON."""
    return evidence.to_dict() if isinstance(evidence, Nested) else {"kind": evidence.kind, **asdict(evidence)}


def from_dict(data: dict[str, object]) -> Evidence:
    """Evidence from plain data; lists become tuples. Raises KeyError, TypeError or ValueError for what is none."""
    if data["kind"] == "program":
        raise ValueError("this verdict rests on an external program, which decides nothing now; ask for it again")
    kind = _KINDS[str(data["kind"])]
    if issubclass(kind, Nested):
        return kind.from_dict(data)
    fields = {name: _tupled(value) for name, value in data.items() if name != "kind"}
    return kind(**fields)  # type: ignore[arg-type]


def _tupled(value: object) -> object:
    return tuple(map(_tupled, value)) if isinstance(value, list) else value
