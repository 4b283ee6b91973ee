"""A library call never runs the caller's script again, whether or not the script guards its
body with `__main__`.
"""

import os
import subprocess
import sys

import pytest

pytestmark = pytest.mark.full

GENERAL = """
from disting import Model, Query, View, compare

star = [[f"-(k10+k20+k30+k40+q)", "a1", "a2", "a3", "a4"]] + [
    [f"k{i}0"] + [f"-a{i}" if i == j else "0" for j in range(1, 5)] for i in range(1, 5)
]
chain = [
    ["-(u1+q)", "v1", "0", "0", "0"],
    ["u1", "-(u2+v1)", "v2", "0", "0"],
    ["0", "u2", "-(u3+v2)", "v3", "0"],
    ["0", "0", "u3", "-(u4+v3)", "v4"],
    ["0", "0", "0", "u4", "-v4"],
]
port = ["1", "0", "0", "0", "0"]
left, right = (Model.from_state_space(a, port, port) for a in (star, chain))
found = compare(left, right, query=Query(View.POSITIVE))
assert found.relation != "undecided" or "of 40" not in found.sentence, found.sentence  # no point was looked at
"""
PATIENT = """
from disting import Model, alternatives

model = Model.from_transfer_function(["a**50"], ["1", "1"])  # more solutions than are looked for at once
found = alternatives(model, {"a": 2}, model, seconds=600)
assert len(found.equivalents) == 50, found.reason
"""
CHAINS = """
from disting import Engine, Family, Store, catalog, compare
from disting.catalogs.build import build
from disting.decide.same.low_cost import quick_finding
from disting.model.question import Settings

build(2, damped=True, engine=Engine(store=Store.none()))
compare(Family(2, damped=False)[1], Family(2, damped=False)[2])
catalog(3, damped=False).classes()
quick_finding(Family(3, damped=False)[1], Family(3, damped=False)[2], Settings())
"""


@pytest.mark.parametrize("body", [PATIENT, CHAINS, pytest.param(GENERAL, marks=pytest.mark.slow)])
def test_the_body_of_a_script_without_a_guard_runs_once(tmp_path, body):
    runs, script = tmp_path / "runs", tmp_path / "script.py"
    script.write_text(f"open({str(runs)!r}, 'a').write('x')\n{body}", encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    done = subprocess.run(
        [sys.executable, script],
        capture_output=True,
        text=True,
        timeout=1200,
        check=False,
        env=environment,
    )
    assert (done.returncode, done.stderr) == (0, "") and runs.read_text() == "x"
