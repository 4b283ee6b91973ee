"""What does it cost to give chains as state spaces instead? All pairs of 3 masses, cold, CPU of a
process each.
"""

import json
import statistics

import pytest

from tests.bench.measure import in_fresh_process, table

pytestmark = pytest.mark.bench
CODE = """
import json, time
from disting import Engine, Family, Model, Query, View
from tests.oracles.plain_chains import plain_state_space
engine, query = Engine(), Query(View("{view}"), inclusion=False)
family = [(f"A{{i}}", chain) for i, chain in enumerate(Family(3, damped=True), 1)]
start = time.process_time()
if {general}:
    models = [Model.from_state_space(*plain_state_space(c), name=name) for name, c in family]
    subjects = engine.general_subjects(models)
else:
    subjects = [engine.subject(*named) for named in family]
found = engine.decisions(subjects, query)
pairs = [(i, j) for i in range(11) for j in range(i)]
print(json.dumps([time.process_time() - start, [found.relation(*p).value for p in pairs]]))
"""
MOST = 10.0


def measured(view: str, general: bool) -> tuple[float, list[str]]:
    """CPU seconds and the relations of all pairs."""
    seconds, relations = json.loads(in_fresh_process(CODE.format(view=view, general=general)))
    return seconds, relations


def test_general_models(benchmark) -> None:
    rows = []
    for view in ("exact", "positive"):
        rounds = [(measured(view, False), measured(view, True)) for _ in range(5)]
        assert all(chains[1] == general[1] for chains, general in rounds)
        chains, general = (statistics.median(r[k][0] for r in rounds) for k in range(2))
        rows.append((view, f"{chains:.2f} s", f"{general:.2f} s", f"{general / chains:.1f}"))
        assert general <= MOST * chains
    benchmark.pedantic(lambda: measured("exact", True), rounds=1)
    table(
        "All pairs of the 3-mass damped class, without inclusions",
        ("view", "as chains", "as state spaces, made from their matrices", "ratio"),
        rows,
    )
