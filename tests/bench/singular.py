"""Runs pairs.sing, conditions 1 to 5 on all pairs written for the computer algebra system
Singular, and reads its counts.
"""

import re
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path

from disting import Chain

PROGRAM = shutil.which("Singular")
PAIRS = Path(__file__).with_name("pairs.sing")


def script(chains: Sequence[Chain], count: int, *, by_recursion: bool) -> str:
    """The program for damped chains of one size, sorted by gap and force, and G_0..G_count."""
    models = ", ".join(f"intvec({', '.join(map(str, chain.indices[1:]))})" for chain in chains)
    numbers = (
        f"int N = {chains[0].n_masses}; int COUNT = {count}; int BY_RECURSION ="
        f" {int(by_recursion)};\n"
    )
    return numbers + f"list MODELS = {models};\n" + PAIRS.read_text(encoding="utf-8") + "quit;\n"


def run(text: str) -> str:
    """Standard output of a fresh Singular."""
    return subprocess.run(
        [str(PROGRAM), "-q"], input=text, capture_output=True, text=True, timeout=3600, check=True
    ).stdout


def counts(text: str) -> dict[str, dict[int, int]]:
    """Pairs by the first failing condition, 0 for none."""
    found = re.findall(r"^(tf|markov): ([\d,]+)$", run(text), re.MULTILINE)
    return {
        name: {i: int(n) for i, n in enumerate(numbers.split(",")) if n != "0"}
        for name, numbers in found
    }
