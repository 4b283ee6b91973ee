"""What an attack tried and what became of it; told at the end of the run.

DISTING_ATTACK multiplies the numbers of attempts (0.01 for a look, 10 for a night),
DISTING_ATTACK_SEED draws others.
"""

import os
import random
import resource
from collections import Counter

TIMES = float(os.environ.get("DISTING_ATTACK", "1"))
SEED = os.environ.get("DISTING_ATTACK_SEED", "disting")


def times(number):
    """So many attempts, as the run is asked to be long; at least one."""
    return max(1, round(number * TIMES))


def chance(name):
    """Random numbers of one attack, the same in every run with the same seed."""
    return random.Random(f"{SEED} {name}")


class Counts(Counter):
    """Numbers by what happened, such as tried, refused, accepted, wrong, hung."""

    def __str__(self):
        own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
        return ", ".join(
            f"{name} {number}" for name, number in (dict(self) | {"peak memory [MB]": own}).items()
        )
