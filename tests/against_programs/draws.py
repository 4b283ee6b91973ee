"""How many cases a test draws, and which: the same in every run, or new ones with
HYPOTHESIS_PROFILE=default.

ORACLE_CASES=1500 is the number of draws of every test; ORACLE_SEED=text repeats a run (every run
names its seed).
"""

import os
from collections import Counter
from collections.abc import Iterator
from random import Random, SystemRandom

FRESH = os.environ.get("HYPOTHESIS_PROFILE", "repeatable") != "repeatable"
SEED = os.environ.get("ORACLE_SEED") or (
    f"{SystemRandom().randrange(10**9)}" if FRESH else "repeatable"
)


def cases(name: str, number: int) -> Iterator[tuple[str, Random]]:
    """A label and a generator for each case; the label says all that is needed to draw it again."""
    for k in range(int(os.environ.get("ORACLE_CASES", number))):
        label = f"{name}:{SEED}:{k}"
        yield label, Random(label)


class Tally(Counter[str]):
    """Counts of what was compared, left open or refused, and the mismatches in words."""

    def __init__(self) -> None:
        super().__init__()
        self.mismatches: list[str] = []

    def check(self, right: bool, what: str) -> None:
        """One comparison."""
        self["compared"] += 1
        self["mismatches"] += not right
        if not right:
            self.mismatches.append(what)

    def report(self, record_property) -> None:
        """Hand the counts to the summary of the run, then fail on mismatches or where nothing
        was compared.
        """
        record_property(
            "oracle",
            f"seed {SEED}: " + ", ".join(f"{self[k]} {k}" for k in sorted({"mismatches", *self})),
        )
        assert not self.mismatches, "\n".join(self.mismatches)
        assert self["compared"], self
