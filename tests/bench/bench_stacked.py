"""What several experiments cost: verdicts on all pairs of a class under two experiments beside those
under one, and the exact decision beside a Gröbner basis of the same ideals by Singular.

Singular computes one basis modulo a prime of 31 bits, at one point, of the stacked ideal of one
fibre, equations as they come, without tangent equations or slices. The exact decision lists the
fibre where it can, otherwise it computes several bases for a bound of 2^-100 (`by_ideals`).
"""

from itertools import combinations

import pytest

from disting import Engine, Experiment, Family, Query, View, compare
from disting.algebra.certainty import prime, residues
from disting.experiments.exact import LIMITS, by_ideals, exact_finding
from disting.experiments.experiment import MeasuredChain
from disting.experiments.maps import match_maps
from disting.fibres.ideals.fibre_ideal import evaluate
from disting.model.question import Settings
from tests.bench import singular
from tests.bench.measure import alternating, table

pytestmark = pytest.mark.bench
A = Family(3, damped=True)
PAIRS = list(combinations(range(1, len(A) + 1), 2))
EXACT = Query(View.EXACT)
FURTHER = {
    "a second sensor": Experiment(sensor=2),
    "a locked mass": Experiment(locked=3),
    "an added inertia": Experiment(inertias={1: 1}),
}
DECIDED = {
    "A1, A11, inertia 1/1": ((1, 11), Experiment(inertias={1: 1}), Experiment(inertias={1: 1})),
    "A2, A5, sensor 2/3": ((2, 5), Experiment(sensor=2), Experiment(sensor=3)),
    "A9, A10, inertia 1/2": ((9, 10), Experiment(inertias={1: 1}), Experiment(inertias={2: 1})),
}


def verdicts(*experiments) -> None:
    """All pairs, with profiles that are computed once a chain."""
    engine = Engine()
    for i, j in PAIRS:
        compare(A[i], A[j], experiments=experiments, query=EXACT, engine=engine)


def test_two_experiments_beside_one(benchmark) -> None:
    runs = {"one experiment": verdicts}
    for name, further in FURTHER.items():
        runs[name] = lambda further=further: verdicts(Experiment(), further)
    found = alternating(runs, 3)
    benchmark.pedantic(verdicts, rounds=3)
    one = found["one experiment"]
    benchmark.extra_info |= {name: time / one for name, time in found.items()}
    rows = [(name, f"{time:.2f} s", f"{time / one:.2f}") for name, time in found.items()]
    table("All 55 pairs of the 3-mass damped class", ("way", "time", "ratio to one"), rows)


def ideal(left: MeasuredChain, right: MeasuredChain) -> str:
    """A program for Singular: the basis of the fibre of the right map over a point of the left."""
    given, other = match_maps(left, right)
    modulus = prime("bench", 31)
    point = residues("bench", len(given.parameters), modulus)
    names = [f"x{i}" for i in range(len(other.parameters))]
    equations = []
    for mine, theirs in zip(given.coordinates, other.coordinates, strict=True):
        terms = (
            "*".join(
                [str(c % modulus), *(f"{n}^{e}" for n, e in zip(names, powers, strict=True) if e)]
            )
            for powers, c in theirs
        )
        equations.append(f"{'+'.join(terms)}-{evaluate(mine, point, modulus)}")
    return (
        f"ring r = {modulus}, ({','.join(names)}), dp;\nideal i = {','.join(equations)};\n"
        "ideal g = groebner(i); print(reduce(poly(1), g) == 0); quit;\n"
    )


@pytest.mark.skipif(singular.PROGRAM is None, reason="Singular is not installed")
@pytest.mark.parametrize("name", DECIDED)
def test_exact_decision_beside_singular(benchmark, name) -> None:
    (i, j), here, there = DECIDED[name]
    sides = (MeasuredChain(A[n], (Experiment(), further)) for n, further in ((i, here), (j, there)))
    left, right = sides
    program, settings = ideal(left, right), Settings()
    is_empty = singular.run(program).split()[-1] == "1"
    assert (exact_finding(left, right, settings).outcome.value == "fails") is is_empty
    found = alternating(
        {
            "disting": lambda: exact_finding(left, right, settings),
            "disting, by ideals alone": lambda: by_ideals(left, right, settings, LIMITS),
            "Singular, started only": lambda: singular.run("quit;\n"),
            "Singular, one basis": lambda: singular.run(program),
        },
        5,
    )
    benchmark.pedantic(lambda: exact_finding(left, right, settings), rounds=3)
    ours = found["disting"]
    benchmark.extra_info |= {way: time / ours for way, time in found.items()}
    rows = [(way, f"{time:.3f} s", f"{time / ours:.2f}") for way, time in found.items()]
    table(f"The exact decision, {name}", ("way", "time", "ratio to disting"), rows)
