"""A kind of change is a row of the table, and nothing else: one that is written into a copy of the
package is at work everywhere. It does what a spring does, so a spring says what is true of it.
"""

import json

import pytest

from tests.house import package_copy
from tests.house.package_copy import copied

ROW = """MAGNET = Kind(
    name="magnet",
    argument="magnets",
    power={power},
    text="magnet {{size}} at mass {{at}}",
    item="a known magnet at mass {{}}",
    anywhere="a known magnet at any mass",
    title="known magnet there",
    sign="B",
    prices=("magnet",),
)
KINDS = (SENSOR, FORCE, INERTIA, LOCK, SPRING, BRAKE, MAGNET)
"""
OLD = "KINDS = (SENSOR, FORCE, INERTIA, LOCK, SPRING, BRAKE)\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A copy of the package whose table has a row more, and no other line that differs."""
    return with_power(tmp_path_factory.mktemp("kind"), 0)


def with_power(folder, power):
    return copied(folder, {"model/kinds.py": [(OLD, ROW.format(power=power))]})


COMMANDS = {
    "told apart": "compare 3:1 3:1 --also {0}=1/3:0.5",
    "not told apart": "compare 3:1 3:1 --also {0}=2/2:0.5",
    "written": "compare 3:1 3:1 --also {0}=1/3:0.5 --json {0}.json",
    "verified": "verify {0}.json",
    "next": "next 3:2 3:5 --undamped --cost sensor=9,move=9,lock=9,inertia=9,{0}=1",
    "not on the menu": "next 3:2 3:5 --undamped",
    "equivalents": "equivalents 3:1 --undamped --set m1=1,m2=3,m3=2,k12=5,k23=7 --to 3:1"
    " --also {0}=1/1:2",
    "models": "models 2 --undamped --also {0}=1:0.5",
}
SCRIPT = """
import io, json
from contextlib import redirect_stdout
from disting.cli import main

said = {{}}
for name, command in {commands!r}.items():
    for kind in ("magnet", "spring"):
        with redirect_stdout(io.StringIO()) as text:
            status = main(command.format(kind).split())
        said[f"{{name}}, {{kind}}"] = status, text.getvalue()
print(json.dumps(said))
"""


@pytest.fixture(scope="module")
def said(folder):
    return json.loads(package_copy.said(folder, "-c", SCRIPT.format(commands=COMMANDS)))


@pytest.mark.full
@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_says_of_it_what_it_says_of_a_spring(said, name):
    (status, magnet), (same, spring) = (said[f"{name}, {kind}"] for kind in ("magnet", "spring"))
    assert status == same == 0
    words = spring.replace("spring from", "spring at").replace(" to the ground (", " (")
    assert magnet.replace("magnet", "spring") == words.replace("ground here", "")


@pytest.mark.full
def test_it_is_there_where_it_is_asked_for(said):
    assert said["told apart, magnet"][1].startswith("DISTINGUISHABLE")
    assert said["not told apart, magnet"][1].startswith("INDISTINGUISHABLE")
    for name in ("told apart", "not told apart", "next", "equivalents", "models"):
        assert "magnet" in said[f"{name}, magnet"][1]
    assert "magnet" not in said["not on the menu, magnet"][1]
    assert "holds" in said["verified, magnet"][1]


@pytest.mark.full
def test_verify_looks_at_it(folder, said):
    whole = json.loads((folder / "magnet.json").read_text(encoding="utf-8"))
    pair = whole["verdicts"][0]["experiments"][1]
    assert (pair["left"]["magnets"], pair["right"]["magnets"]) == ([[1, "1/2"]], [[3, "1/2"]])
    pair["left"]["magnets"] = []
    (folder / "without.json").write_text(json.dumps(whole), encoding="utf-8")
    script = "from disting.cli import main; raise SystemExit(main(['verify', 'without.json']))"
    package_copy.said(folder, "-c", script, status=1)


@pytest.mark.full
def test_fit_and_pages(folder):
    said = package_copy.said(
        folder,
        "-c",
        """
from disting.fit import Setup
from disting.fit.search.joint import JointCost
from disting.model.chain import Chain
from disting.report.drawing import draw_item, state
from disting.model.kinds import MAGNET
from disting.experiments.menu import Item

setup = Setup(magnets=(("last", 0.5),))
print(setup.text, setup.added(2))
shapes = [s for layer in state(Chain(2, damped=False), {}, setup.experiment(2).changes).layers for s in layer.shapes]
print([s.text for s in shapes if getattr(s, "text", "").startswith("+")])
print(draw_item(Chain(2, damped=False), Item(MAGNET, 1)).name)
""",
    )
    assert said.splitlines() == [
        "magnet 0.5 at mass last ((2, 0, 0.5),)",
        "['+B']",
        "magnet-1",
    ]


@pytest.mark.full
def test_what_no_equation_of_motion_has_is_refused(tmp_path):
    """The theorems know powers 0 to 2 of s: another one is no row of this table."""
    said = package_copy.said(with_power(tmp_path, 3), "-c", "import disting.model.kinds", status=1)
    assert "magnet: A(s) has the powers 0 to 2 of s only" in said
