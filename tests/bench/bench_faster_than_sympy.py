"""How much faster than SymPy? 4-mass damped class, one process, one core: transfer functions, 12
Markov parameters, ranks, conditions 1 to 5 on all 406 pairs, everything cold.
"""

from collections import Counter

import pytest

from disting import Engine, Family, Query, Settings, View
from tests.bench.measure import alternating, seconds, table
from tests.oracles import sympy_best, sympy_twin

pytestmark = pytest.mark.bench
CHAINS = list(Family(4, damped=True))
FIVE = (1, 2, 3, 4, 5)
COUNTS = {"tf": {0: 89, 1: 168, 4: 61, 5: 88}, "markov": {0: 91, 3: 208, 4: 55, 5: 52}}


def ours(points: int = 3) -> None:
    engine = Engine(Settings(points=points))
    subjects = [engine.subject(str(i), chain) for i, chain in enumerate(CHAINS)]
    for view, count in ((View.TF, 0), (View.MARKOV, 12)):
        found = engine.decisions(subjects, Query(view, FIVE, count)).counts()
        assert {int(k or 0): n for k, n in found.items()} == COUNTS[view.value]


def twin() -> None:
    for representation, count in (("tf", 0), ("markov", 12)):
        found = Counter(
            n if n < 6 else 0
            for n in sympy_twin.decide_family(CHAINS, representation, count).values()
        )
        assert found == COUNTS[representation]


def test_against_sympy(benchmark) -> None:
    fast = alternating(
        {
            "disting": ours,
            "disting, one point": lambda: ours(1),
            "SymPy, tuned by hand": sympy_best.run,
        },
        5,
    )
    slow = {"SymPy, plain (the oracle of the tests)": seconds(twin)}
    textbook = "SymPy, textbook inverse, transfer functions only"
    slow[textbook] = seconds(lambda: [sympy_twin.transfer_function_textbook(c) for c in CHAINS])
    benchmark.pedantic(ours, rounds=3)
    benchmark.extra_info |= {name: time / fast["disting"] for name, time in (fast | slow).items()}
    rows = [
        (name, f"{time:.2f} s", f"{time / fast['disting']:.1f}")
        for name, time in (fast | slow).items()
    ]
    table("4-mass damped class, conditions 1 to 5", ("way", "time", "ratio to disting"), rows)
