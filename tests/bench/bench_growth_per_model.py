"""How does one model's cost grow with its size? Transfer function, Jacobian and rank modulo one
prime, damped.
"""

import statistics

import pytest

from disting import Chain
from disting.algebra.certainty import prime, residues
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.sample import Representation, at_point, seen_at
from tests.bench.measure import seconds, table

pytestmark = pytest.mark.bench
PRIME = prime("bench")


def chains(n: int) -> list[Chain]:
    """Four typical chains: no gap, gap in the middle, collocated and not."""
    g = n // 2
    return [Chain(n, damped=True), Chain(n, 0, 0, 1, 0, n, damped=True)] + [
        Chain(n, g, 1, g + 1, minus, plus, damped=True) for minus, plus in ((1, g + 1), (g, n))
    ]


def milliseconds(chain: Chain) -> float:
    model = ChainModel(chain.structure)
    point = residues(str(chain), len(chain.parameters), PRIME)
    return 1e3 * seconds(
        lambda: seen_at(at_point(model, point, PRIME), Representation.TF, 0).jacobian.rank()
    )


def test_growth(benchmark) -> None:
    benchmark.pedantic(lambda: [milliseconds(c) for c in chains(8)], rounds=3)
    sizes = (3, 4, 5, 6, 7, 8, 10, 12, 15, 20)
    found = {
        n: statistics.median(milliseconds(c) for _ in range(15) for c in chains(n)) for n in sizes
    }
    rows = [(str(n), f"{ms:.2f} ms", f"{ms / found[3]:.1f}") for n, ms in found.items()]
    table(
        "One model: transfer function, Jacobian, rank",
        ("masses", "time", "ratio to 3 masses"),
        rows,
    )
