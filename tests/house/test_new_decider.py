"""A decider is a row of a table and its functions, and nothing else: one that is written into a copy
of the package decides, is verified, and is printed.
"""

import json

import pytest

from tests.house.package_copy import copied, said

pytestmark = pytest.mark.full

PAIR = ("3:1", "3:11", "--quantity", "position", "--domain", "complex")
KIND = '''@dataclass(frozen=True, slots=True)
class Twins(Kind):
    """Exact decision: both chains have so many elements."""

    kind: ClassVar[str] = "twins"
    claim: ClassVar[Claim] = Claim(Carrier.EXACT, Relation.INDISTINGUISHABLE, COMPLEX, "twins")
    elements: int

    def sentence(self, left: str, right: str) -> str:
        return f"{left} and {right} are twins."

    @property
    def formula(self) -> str:
        return "T"


@dataclass(frozen=True, slots=True)
class DeadTime(Kind):'''
FUNCTIONS = """def by_twins(a: Chain, b: Chain, settings: Settings) -> Finding | None:
    count, other = (len(chain.structure.elements) for chain in (a, b))
    if count != other:
        return None
    evidence = Twins(count)
    return Finding(EXACT, Outcome.HOLDS, Certainty.THEOREM, evidence=evidence)


def check_twins(evidence: Twins, a: Chain, b: Chain) -> bool:
    return len(a.structure.elements) == len(b.structure.elements) == evidence.elements


def by_dead_time("""
ROW = """TWINS = Decider(
    name="twins",
    cost=Cost.CLOSED_FORM,
    decide=f"{_SAME}:by_twins",
    yields=(Twins,),
    check=f"{_SAME}:check_twins",
)
SAME_CHAINS = Table("""
CHANGES = {
    "evidence/decision.py": [
        ("@dataclass(frozen=True, slots=True)\nclass DeadTime(Kind):", KIND),
        ("import Carrier, Claim,", "import COMPLEX, Carrier, Claim,"),
    ],
    "evidence/kinds.py": [
        ("import DeadTime,", "import Twins, DeadTime,"),
        ("    Theorem | DeadTime | FibreAt", "    Theorem | Twins | DeadTime | FibreAt"),
    ],
    "decide/same/exact.py": [
        ("import DeadTime,", "import Twins, DeadTime,"),
        ("def by_dead_time(", FUNCTIONS),
    ],
    "decide/__init__.py": [
        ("    DeadTime,\n    Exclusion", "    Twins,\n    DeadTime,\n    Exclusion"),
        ("SAME_CHAINS = Table(", ROW),
        ("(THEOREMS, DEAD_TIME,", "(TWINS, THEOREMS, DEAD_TIME,"),
    ],
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A copy of the package with a decider more, and no other line that differs."""
    return copied(tmp_path_factory.mktemp("decider"), CHANGES)


def run(folder, *arguments, status=0):
    return said(folder, "-m", "disting", *arguments, status=status)


def test_it_decides_and_its_verdict_is_verified(folder):
    """And refused where its evidence is not true."""
    written = json.loads(run(folder, "compare", *PAIR, "--json", "-"))
    assert (written["relation"], written["decided_by"]) == ("indistinguishable", "exact")
    assert written["evidence"] == {"kind": "twins", "elements": 7}
    path = folder / "verdict.json"
    path.write_text(json.dumps(written), encoding="utf-8")
    assert "verdict.json: holds" in run(folder, "verify", "verdict.json")
    written["evidence"]["elements"] = 6
    path.write_text(json.dumps(written), encoding="utf-8")
    assert run(folder, "verify", "verdict.json", status=1) == ""


def test_it_is_told(folder):
    """By the command, and in the tables that the guide shows."""
    assert "3:1 and 3:11 are twins." in run(folder, "compare", *PAIR)
    code = "from disting.decide import as_markdown; print(as_markdown())"
    assert "| twins | closed form | Twins |" in said(folder, "-c", code)
