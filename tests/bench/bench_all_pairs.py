"""What do conditions 1 to 5 on all pairs cost, and what would listing all sets of rows cost?
Cold, one core, a process each.
"""

import json
from math import comb

import pytest

from disting import Chain, Engine, Family
from disting.algebra.certainty import residues
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.sample import Representation, samples
from disting.model.symmetry import canonical
from tests.bench.measure import in_fresh_process, seconds, table

pytestmark = pytest.mark.bench
CLASSES = [(5, True), (6, True), (7, True), (8, False), (8, True)]
CODE = """
import json, time
from disting import Engine, Family, Query, View
from tests.bench.measure import peak_mebibytes
start = time.perf_counter()
engine = Engine()
subjects = [engine.subject(str(i), c) for i, c in enumerate(Family({n}, {damped}))]
counts = engine.decisions(subjects, Query(View.TF, (1, 2, 3, 4, 5))).counts()
print(json.dumps([time.perf_counter() - start, peak_mebibytes(), sum(counts.values())]))
"""


def listing(n: int, damped: bool) -> float:
    """Seconds that the ranks of all binomial(N_MI, N_R) sets of rows would take: their exact
    number, each symmetric model counted once, times the mean time of a set, from 300 random sets
    of a dozen models weighted by their numbers of sets.
    """
    engine = Engine()
    chains = sorted({canonical(c).chain for c in Family(n, damped)}, key=repr)
    profiles = {c: engine.subject("", c).profile(Representation.TF, 0) for c in chains}
    sets = {c: comb(len(p.form), p.rank) for c, p in profiles.items()}
    timed = chains[:: max(1, len(chains) // 12)]
    spent = sum(
        _each(c, [i for i, f in enumerate(profiles[c].free) if f], profiles[c].rank) * sets[c]
        for c in timed
    )
    return spent / sum(sets[c] for c in timed) * sum(sets.values())


def _each(chain: Chain, rows: list[int], rank: int) -> float:
    """Mean seconds for the rank of one set of rows."""
    seen = next(samples(ChainModel(chain.structure), Representation.TF, 0, 1, "bench"))
    chosen = [tuple(rows[j] for j in _some(len(rows), rank, k)) for k in range(300)]
    return seconds(lambda: [seen.rank(s) for s in chosen]) / 300


def _some(size: int, count: int, k: int) -> list[int]:
    keys = residues(f"subset:{k}", size, 1 << 61)
    return sorted(sorted(range(size), key=keys.__getitem__)[:count])


def test_all_pairs(benchmark) -> None:
    benchmark.pedantic(lambda: in_fresh_process(CODE.format(n=5, damped=True)), rounds=2)
    rows = []
    for n, damped in CLASSES:
        time, memory, pairs = json.loads(in_fresh_process(CODE.format(n=n, damped=damped)))
        subsets = listing(n, damped)
        name = f"{n} masses, {'damped' if damped else 'undamped'}"
        rows.append(
            (
                name,
                str(pairs),
                f"{time:.2f} s",
                f"{memory:.0f} MiB",
                f"{subsets:.2g} s",
                f"{subsets / time:.2g}",
            )
        )
    heads = (
        "class",
        "pairs",
        "time",
        "peak memory",
        "listing all row sets (extrapolated)",
        "ratio",
    )
    table("Conditions 1 to 5 on transfer-function coefficients, all pairs, cold", heads, rows)
