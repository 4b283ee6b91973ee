"""A condition is a rule and a row of the table, and nothing else: those written into a copy of the
package are at work everywhere.
"""

import csv
import json

import pytest

from tests.cli.process import called
from tests.house.package_copy import copied, said

pytestmark = pytest.mark.full

MARKED = ("1", "11")  # of 3 damped masses: indistinguishable, which only the exact decision finds
RULES = """ALWAYS = Rule("10", Role.NECESSARY, "a matter of course", "both are models")
NEVER = Rule("11", Role.NECESSARY, "beside the point", "both are something else")
AGAIN = Rule("12", Role.NECESSARY, "degrees once more", "the degrees are equal")
MARKED = Rule("marked", Role.STRUCTURAL, "a marked pair", "they are the marked ones", "the mark", "M")
"""
CHECKS = """
from dataclasses import replace
from disting.algebra.certainty import Certainty, grade_of
from disting.evidence.conditions import Mark
from disting.conditions.rule import Outcome
from disting.conditions.rule import AGAIN, ALWAYS, MARKED, NEVER


def _again(left: Profile, right: Profile) -> Finding:
    return replace(necessary.condition_2(left, right), rule=AGAIN)


def _marked(left: AnySide, right: AnySide) -> Finding:
    if {left.name, right.name} not in ({"A1", "A11"}, {"3:1", "3:11"}):
        return Finding(MARKED, Outcome.INAPPLICABLE, note="not marked")
    return Finding(MARKED, Outcome.HOLDS, Certainty.THEOREM, evidence=Mark((4, 4)))


"""
KIND = """@dataclass(frozen=True, slots=True)
class Mark(Kind):
    kind: ClassVar[str] = "mark"
    claim: ClassVar[Claim] = _SAME
    degrees: tuple[int, ...]

    def sentence(self, left: str, right: str) -> str:
        return f"{left} and {right} are marked."

    @property
    def formula(self) -> str:
        return "M"

    def holds(self, pair: "SampledPair", representation: str) -> bool:
        return pair.left.degrees == pair.right.degrees == self.degrees


ByConditions = Mark | """
NECESSARY = """    Necessary(ALWAYS, lambda p: 0, lambda a, b: grade_of(True, 0), lambda a, b: Finding(ALWAYS, Outcome.HOLDS)),
    Necessary(NEVER, lambda p: 0, lambda a, b: grade_of(True, 0), lambda a, b: Finding(NEVER, Outcome.INAPPLICABLE)),
    Necessary(AGAIN, _n.numbers_of_coefficients, _n.degree_grade, _again, of_degrees=True),
)
SUFFICIENT = ("""
STRUCTURAL = """    Structural(MARKED, _marked),
)
CONDITIONS"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A copy of the package with four rules more, a row for each and a kind of evidence, and no
    other line that differs.
    """
    rules = (
        ("RULES = {", RULES + "RULES = {"),
        ("RANK, DEPENDENCES)", "RANK, DEPENDENCES, ALWAYS, NEVER, AGAIN)"),
        ("SUBMODEL, SUPERMODEL)", "SUBMODEL, SUPERMODEL, MARKED)"),
    )
    rows = (
        ("\n_n = ", CHECKS + "_n = "),
        (")\nSUFFICIENT = (", NECESSARY),
        (")\nCONDITIONS", STRUCTURAL),
    )
    changes = {
        "conditions/rule.py": rules,
        "conditions/table.py": rows,
        "evidence/conditions.py": (("ByConditions = ", KIND),),
    }
    return copied(tmp_path_factory.mktemp("rows"), changes)


def run(folder, *arguments):
    return said(folder, "-m", "disting", *arguments)


VERDICTS = ("verdicts", "3", "--damped", "--no-cache", "--csv", "-", "--conditions")


def rows(text):
    return {(row["left"], row["right"]): row for row in csv.DictReader(text.splitlines())}


def test_it_changes_no_other_verdict(folder):
    before, after = (
        rows(text) for text in (called(*VERDICTS, "1-9").stdout, run(folder, *VERDICTS, "1-9"))
    )
    assert before == after and before[MARKED]["relation"] == "undecided"
    every = rows(run(folder, *VERDICTS, "1-marked"))
    assert {pair for pair in every if every[pair] != before[pair]} == {MARKED}
    assert (every[MARKED]["relation"], every[MARKED]["decided_by"]) == (
        "indistinguishable",
        "marked",
    )


@pytest.mark.parametrize(
    ("pair", "rule", "relation"),
    [(("3:1", "3:11"), "marked", "indistinguishable"), (("3:1", "3:2"), "12", "distinguishable")],
)
def test_its_verdict_is_verified(folder, pair, rule, relation):
    """By evidence of a kind of its own, and of one that other rules have too; and refused where it
    is not true.
    """
    written = json.loads(run(folder, "compare", *pair, "--conditions", rule, "--json", "-"))
    assert (written["relation"], written["decided_by"]) == (relation, rule)
    path = folder / "verdict.json"
    path.write_text(json.dumps(written), encoding="utf-8")
    assert "verdict.json: holds" in run(folder, "verify", "verdict.json")
    if rule == "marked":
        false = written | {"evidence": written["evidence"] | {"degrees": [4, 5]}}
        path.write_text(json.dumps(false), encoding="utf-8")
        assert said(folder, "-m", "disting", "verify", "verdict.json", status=1) == ""


def test_it_is_told_everywhere(folder):
    assert "10  a matter of course: both are models" in run(folder, "compare", "--help")
    assert "1 by the mark" in run(
        folder, "verdicts", "3", "--damped", "--no-cache", "--domain", "complex"
    )
    run(folder, "report", "2", "--out", "site")
    page = (folder / "site" / "chains-2-damped.html").read_text(encoding="utf-8")
    assert "a matter of course" in page and '"marked":"M"' in page
