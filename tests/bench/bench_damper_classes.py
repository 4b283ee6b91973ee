"""What do all models of a size with any ground dampers cost by classes, and what would pair by
pair cost? Cold, two workers.

Pair by pair is extrapolated from random pairs, asked of one engine without inclusions, as a list
of pairs would be.
"""

import random
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context

import pytest

from disting import Engine, Query
from disting.catalogs.dampers import DamperSets, damper_family
from tests.bench.measure import peak_mebibytes, seconds, table

pytestmark = pytest.mark.bench
SIZES = [(3, True), (4, True), (5, True)]
SAMPLE = 100  # pairs
LOOK_UPS = 10_000


@pytest.mark.parametrize(("n", "damped"), SIZES)
def test_by_classes_and_pair_by_pair(benchmark, n: int, damped: bool) -> None:
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        list(pool.map(abs, range(2)))
        start = time.perf_counter()
        family = benchmark.pedantic(
            lambda: damper_family(n, damped=damped, which=DamperSets.ALL, executor=pool), rounds=1
        )
        taken = time.perf_counter() - start
    size, draw = len(family), random.Random(1)
    places = [draw.sample(range(size), 2) for _ in range(LOOK_UPS)]
    names = [(family.name(i), family.name(j)) for i, j in places]
    each = seconds(lambda: [family.look_up(a, b) for a, b in names]) / LOOK_UPS
    named = [[family.name(i) for i in pair] for pair in places[:SAMPLE]]
    chains = [
        [replace(family.family[number], ground_dampers=masses) for number, masses in pair]
        for pair in named
    ]
    engine = Engine()
    subjects = [[engine.subject(str(c), c) for c in pair] for pair in chains]
    alone = (
        seconds(lambda: [engine.verdict(a, b, Query(inclusion=False)) for a, b in subjects])
        / SAMPLE
    )
    pairs = size * (size - 1) // 2
    heads = [
        "models",
        "pairs",
        "by classes",
        "peak memory",
        "look-up",
        f"pair by pair (from {SAMPLE})",
        "ratio",
    ]
    whole = alone * pairs
    row = [
        str(size),
        str(pairs),
        f"{taken:.1f} s",
        f"{peak_mebibytes():.0f} MiB",
        f"{1e6 * each:.1f} µs",
        f"{whole:.3g} s",
    ]
    table(
        f"{n} masses, {'damped' if damped else 'undamped'}, all ground dampers",
        heads,
        [(*row, f"{whole / taken:.3g}")],
    )
