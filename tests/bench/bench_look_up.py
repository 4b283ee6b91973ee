"""What does an answer cost that is there already, against computing it?"""

import statistics
import subprocess
import sys
from pathlib import Path

import pytest

from disting import Engine, Family, Query, Store, View, catalog
from tests.bench.measure import alternating, seconds, table

pytestmark = pytest.mark.bench
PAIR = (10, 20)


def process(*arguments: str) -> float:
    return seconds(
        lambda: subprocess.run([sys.executable, *arguments], check=True, capture_output=True)
    )


def test_look_up(benchmark, tmp_path: Path) -> None:
    family, shipped = Family(5, damped=True), catalog(5, damped=True)
    kept = Engine(store=Store.open(tmp_path / "cache.sqlite3"))
    stored = [kept.subject(f"A{i}", family[i]) for i in PAIR]
    kept.verdict(*stored, Query())

    def cold() -> None:
        engine = Engine()
        engine.verdict(*(engine.subject(f"A{i}", family[i]) for i in PAIR), Query())

    benchmark(lambda: shipped.verdict(*PAIR))
    found = alternating(
        {
            "shipped catalogue": lambda: [shipped.verdict(*PAIR) for _ in range(100)],
            "shipped catalogue, exact": lambda: [
                shipped.verdict(*PAIR, View.EXACT) for _ in range(100)
            ],
            "SQLite cache": lambda: [kept.verdict(*stored, Query()) for _ in range(100)],
            "computed": lambda: [cold() for _ in range(3)],
        },
        5,
    )
    each = {name: time / (3 if name == "computed" else 100) for name, time in found.items()}
    rows = [
        (name, f"{1e3 * time:.3f} ms", f"{each['computed'] / time:.0f}")
        for name, time in each.items()
    ]
    table(
        "One verdict of the 5-mass damped class",
        ("from", "time", "times faster than computed"),
        rows,
    )
    bare, loaded = (
        statistics.median(process("-c", code) for _ in range(7))
        for code in ("pass", "import disting")
    )
    whole = statistics.median(
        process("-m", "disting", "compare", "5:10", "5:20", "--damped") for _ in range(5)
    )
    heads = ("whole process", "time")
    table(
        "Start-up",
        heads,
        [
            ("import disting, less bare Python", f"{loaded - bare:.2f} s"),
            ("disting compare", f"{whole:.2f} s"),
        ],
    )
