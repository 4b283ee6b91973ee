"""How much faster than the computer algebra system Singular? The work of bench_faster_than_sympy,
on one core.

Singular runs pairs.sing as a process of its own, whose start is timed beside it; it works over one
prime field of 29 bits, at one point. It has two ways to the Jacobian of the Markov parameters: by
`diff` of the expanded polynomials, as one would write it in a computer algebra system, and by the
derivative of their recursion in numbers.
"""

import pytest

from tests.bench import singular
from tests.bench.bench_faster_than_sympy import CHAINS, COUNTS, ours
from tests.bench.measure import alternating, in_fresh_process, table

pytestmark = [
    pytest.mark.bench,
    pytest.mark.skipif(singular.PROGRAM is None, reason="Singular is not installed"),
]
CODE = """
from disting import Engine, Family, Query, View
engine = Engine()
subjects = [engine.subject(str(i), chain) for i, chain in enumerate(Family(4, damped=True))]
for view, count in ((View.TF, 0), (View.MARKOV, 12)):
    engine.decisions(subjects, Query(view, (1, 2, 3, 4, 5), count)).counts()
"""


def theirs(script: str) -> None:
    assert singular.counts(script) == COUNTS


def test_against_singular(benchmark) -> None:
    by_diff, by_recursion = (singular.script(CHAINS, 12, by_recursion=way) for way in (False, True))
    found = alternating(
        {
            "disting": ours,
            "disting, one point": lambda: ours(1),
            "disting, a process of its own": lambda: in_fresh_process(CODE),
            "Singular, started only": lambda: singular.run("quit;\n"),
            "Singular, Jacobians by diff": lambda: theirs(by_diff),
            "Singular, Jacobians by the recursion": lambda: theirs(by_recursion),
        },
        9,
    )
    benchmark.pedantic(ours, rounds=3)
    benchmark.extra_info |= {name: time / found["disting"] for name, time in found.items()}
    rows = [
        (name, f"{time:.3f} s", f"{time / found['disting']:.2f}") for name, time in found.items()
    ]
    table("4-mass damped class, conditions 1 to 5", ("way", "time", "ratio to disting"), rows)
