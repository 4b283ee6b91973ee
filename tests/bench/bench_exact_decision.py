"""What does the exact decision cost, against Groebner bases of the fibres?

The other ways get the fibre as one would write it down: the coefficient equations of the searched
model at a random point of the given one, denominators cleared, masses not zero, modulo a prime of
29 bits; one pair at a time, in one direction, in a process that is stopped after LIMIT seconds.
Setting the systems up is not counted. A pair that meets the limit counts as the limit, so the sums
are lower bounds wherever a pair was stopped. disting decides over the rationals, with evidence.
"""

import json
import random
import shutil
import statistics
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import combinations
from pathlib import Path

import pytest
from sympy import Symbol, expand, prod, symbols

from disting import Chain, Engine, Family, Query, Relation, Settings, View
from disting.conditions.rule import Stage
from disting.decide.same.exact import exact_finding
from disting.model.symmetry import canonical
from disting.verdict.result import Step
from tests.bench.measure import in_fresh_process, seconds, table
from tests.oracles.sympy_twin import Summary, summary

pytestmark = pytest.mark.bench
PRIME = 536870909
LIMIT = 10.0  # seconds a pair
CLASSES = [(3, True), (4, False), (4, True)]
PROGRAMS = {name: shutil.which(name) for name in ("Singular", "msolve")}
SYMPY = """
import sys, time
from sympy import groebner, symbols, sympify
names, *texts = sys.stdin.read().split("\\n")
system, x = [sympify(text) for text in texts], symbols(names.split(","))
start = time.perf_counter()
basis = groebner(system, *x, modulus={prime}, order="grevlex").exprs
print(time.perf_counter() - start, basis == [1])
"""
SINGULAR = """
ring R = {prime}, ({names}), dp;
ideal I = {system};
system("--ticks-per-sec", 1000); int start = rtimer;
ideal G = std(I);
print(string(rtimer - start) + " " + string(G[1] == 1));
quit;
"""
WHOLE = """
import json, time
from disting import Engine, Family, Query
start = time.perf_counter()
engine, open_pairs = Engine(), {{}}
for n, damped in {classes}:
    subjects = [engine.subject(str(i), c) for i, c in enumerate(Family(n, damped))]
    open_pairs[f"{{n}} {{damped}}"] = engine.decisions(subjects, Query()).counts()[""]
print(json.dumps([time.perf_counter() - start, sum(open_pairs.values())]))
"""


@dataclass(frozen=True)
class Fibre:
    """Equations for the parameters of the searched model; the first name makes the masses
    invertible.
    """

    names: tuple[str, ...]
    equations: tuple[str, ...]


@dataclass(frozen=True)
class Run:
    """Seconds of one pair, and whether the fibre is empty; None where the limit stopped it."""

    time: float
    empty: bool | None


STOPPED = Run(LIMIT, None)


@cache
def known(chain: Chain) -> Summary:
    return summary(chain)


def system(given: Chain, searched: Chain) -> Fibre:
    """Coefficients of `searched` = coefficients of `given` at a random point."""
    draw = random.Random(1)
    point = {name: draw.randrange(1, PRIME) for name in given.parameters}
    equations = [
        expand(entry.numer.as_expr() - _residue(value, point) * entry.denom.as_expr())
        for entry, value in zip(known(searched).entries, known(given).entries, strict=True)
    ]
    masses = prod(symbols([name for name in searched.parameters if name[0] == "m"]))
    equations.append(masses * Symbol("inverse") - 1)
    return Fibre(("inverse", *searched.parameters), tuple(str(e) for e in equations if e != 0))


def _residue(entry, point: dict[str, int]) -> int:
    numerator, denominator = (
        int(part.as_expr().subs(point)) for part in (entry.numer, entry.denom)
    )
    return numerator * pow(denominator, -1, PRIME) % PRIME


def by_sympy(fibre: Fibre, _: Path) -> Run:
    text = "\n".join([",".join(fibre.names), *fibre.equations])
    return _timed([sys.executable, "-c", SYMPY.format(prime=PRIME)], text, 1.0)


def by_singular(fibre: Fibre, _: Path) -> Run:
    """Singular's own clock, in whole milliseconds, without its start."""
    equations = ", ".join(fibre.equations).replace("**", "^")
    text = SINGULAR.format(prime=PRIME, names=",".join(fibre.names), system=equations)
    return _timed([str(PROGRAMS["Singular"]), "-q"], text, 1e-3)


def by_msolve(fibre: Fibre, folder: Path) -> Run:
    """The whole process on one thread: it starts in a few milliseconds."""
    given, out = folder / "in.ms", folder / "out.ms"
    equations = ",\n".join(fibre.equations).replace("**", "^")
    given.write_text(f"{','.join(fibre.names)}\n{PRIME}\n{equations}\n", encoding="utf-8")
    out.unlink(missing_ok=True)
    command = [str(PROGRAMS["msolve"]), "-g", "2", "-t", "1", "-f", str(given), "-o", str(out)]
    try:
        time = seconds(
            lambda: subprocess.run(command, capture_output=True, timeout=LIMIT, check=True)
        )
    except subprocess.TimeoutExpired:
        return STOPPED
    lines = [
        line for line in out.read_text(encoding="utf-8").splitlines() if line and line[0] != "#"
    ]
    return Run(time, "".join(lines).startswith("[1]"))


def _timed(command: list[str], text: str, unit: float) -> Run:
    """Run a program that prints its time and whether the basis is 1; its start may take a few
    seconds more.
    """
    try:
        ran = subprocess.run(
            command, input=text, capture_output=True, text=True, timeout=LIMIT + 5, check=True
        )
    except subprocess.TimeoutExpired:
        return STOPPED
    time, empty = ran.stdout.split()[-2:]
    taken = unit * float(time)
    return Run(taken, empty in ("True", "1")) if taken < LIMIT else STOPPED


WAYS: dict[str, Callable[[Fibre, Path], Run]] = {"SymPy": by_sympy} | {
    name: way for name, way in (("Singular", by_singular), ("msolve", by_msolve)) if PROGRAMS[name]
}


def whole_class(n: int, damped: bool, view: View) -> Engine:
    """Every pair of a class by a fresh engine; returned with what it remembers."""
    engine = Engine()
    engine.decisions(
        [engine.subject(str(i), c) for i, c in enumerate(Family(n, damped))], Query(view)
    )
    return engine


def pairs(n: int, damped: bool) -> dict[str, list[tuple[Chain, Chain, Relation]]]:
    """Pairs that conditions 1 to 9 leave open, and pairs of equal degrees and rank, which is
    all that a fibre can decide.
    """
    engine = whole_class(n, damped, View.COMBINED)
    subjects = [engine.subject(str(i), c) for i, c in enumerate(Family(n, damped))]
    found: dict[str, list[tuple[Chain, Chain, Relation]]] = {"open": [], "equal rank": []}
    conditions, exact = (
        engine.decisions(subjects, Query(view)) for view in (View.COMBINED, View.EXACT)
    )
    for i, j in combinations(range(len(subjects)), 2):
        pair = (subjects[i].chain, subjects[j].chain, exact.relation(i, j))
        if conditions.relation(i, j) is Relation.UNDECIDED:
            found["open"].append(pair)
        if subjects[i].rank == subjects[j].rank and conditions.verdict(i, j).decided_by not in (
            "1",
            "2",
        ):
            found["equal rank"].append(pair)
    return found


def measured(
    way: Callable[[Fibre, Path], Run], chosen: list[tuple[Chain, Chain, Relation]], folder: Path
) -> list[Run]:
    """One run a pair; what a fibre says must be what disting says."""
    runs = [way(system(a, b), folder) for a, b, _ in chosen]
    for (a, b, relation), run in zip(chosen, runs, strict=True):
        assert run.empty is None or run.empty == (relation is Relation.DISTINGUISHABLE), (a, b)
    return runs


def by_disting(chosen: list[tuple[Chain, Chain, Relation]]) -> float:
    """The exact decision alone as an engine asks for it: symmetric models are one, so each
    problem is solved once.
    """

    def run() -> None:
        canonical.cache_clear()
        found: dict[tuple[Chain, Chain], Relation] = {}
        for a, b, relation in chosen:
            pair = (canonical(a).chain, canonical(b).chain)
            if pair not in found:
                finding = exact_finding(*pair, Settings())
                found[pair] = Step(Stage.FIBRE, finding).relation
            assert found[pair] is relation

    return statistics.median(seconds(run) for _ in range(3))


@pytest.mark.parametrize(("n", "damped"), CLASSES)
def test_against_groebner_bases(benchmark, tmp_path: Path, n: int, damped: bool) -> None:
    groups = pairs(n, damped)
    whole = statistics.median(seconds(lambda: whole_class(n, damped, View.EXACT)) for _ in range(3))
    benchmark.pedantic(lambda: by_disting(groups["open"]), rounds=1)
    name, rows = f"{n} masses, {'damped' if damped else 'undamped'}", []
    for group, chosen in groups.items():
        ours = by_disting(chosen)
        rows.append(
            (
                "disting, these pairs one by one",
                group,
                str(len(chosen)),
                "0",
                f"{ours:.3f} s",
                "1",
                "",
            )
        )
        for way, run in WAYS.items():
            if group == "equal rank" and way != "msolve":
                continue
            runs = measured(run, chosen, tmp_path)
            time, stopped = sum(r.time for r in runs), sum(r.empty is None for r in runs)
            least = "at least " if stopped else ""
            ratios = [f"{least}{time / ours:.2g}", f"{least}{time / whole:.2g}"]
            rows.append(
                (way, group, str(len(chosen)), str(stopped), f"{least}{time:.3g} s", *ratios)
            )
    number = len(Family(n, damped))
    all_pairs = str(number * (number - 1) // 2)
    rows.append(
        ("disting, whole class with conditions", "all", all_pairs, "0", f"{whole:.2f} s", "", "1")
    )
    heads = (
        "way",
        "pairs",
        "number",
        f"stopped at {LIMIT:.0f} s",
        "time",
        "ratio to these pairs",
        "ratio to whole class",
    )
    table(f"Fibres of the class of {name}", heads, rows)


@pytest.mark.parametrize(
    ("name", "classes"),
    [
        ("3 masses, damped", [(3, True)]),
        (
            "all six classes of 3, 4 and 5 masses",
            [(n, damped) for n in (3, 4, 5) for damped in (False, True)],
        ),
        ("6 masses, undamped", [(6, False)]),
        ("6 masses, damped", [(6, True)]),
    ],
)
def test_whole_classes(benchmark, name: str, classes: list[tuple[int, bool]]) -> None:
    """All pairs with conditions, all Markov parameters and the exact decision, cold, a process
    of its own, one core.
    """
    time, left = json.loads(
        benchmark.pedantic(lambda: in_fresh_process(WHOLE.format(classes=classes)), rounds=1)
    )
    table(f"All verdicts cold: {name}", ("time", "pairs left open"), [(f"{time:.2f} s", str(left))])
