"""What do verdicts on networks cost? All pairs of classes of circuits and machines, cold, CPU of a
process each; a network's profile beside a chain's recurrence; fibres one by one beside Singular;
and a rule by numbers that deletes candidates, with its wrong answers.
"""

import json
import random
import statistics
import time
from collections import Counter

import numpy as np
import pytest

from disting import Chain, Engine, Query, View, compare
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation, draw_point
from disting.errors import InputError
from disting.general.any_model import of_network
from disting.general.network_model import behaviour_of
from disting.model.question import Settings
from disting.network.at_points import assembly, solve
from disting.network.chains import of_chain
from disting.network.families import circuits, family_of
from disting.network.forests import counts_of
from disting.network.notation import network_of
from disting.simulation import frequency_response
from disting.verdict.result import Relation
from tests.bench.measure import in_fresh_process, table
from tests.network.pairs import of_family, pattern
from tests.oracles.plain_models import truth
from tests.oracles.plain_network import plain
from tests.oracles.singular import PROGRAM

pytestmark = pytest.mark.bench
RRCCL = ("CCRR", "CCRRR", "CCLRR")
CODE = """
import json, time
from tests.bench.bench_networks import classes, decided
found = []
for networks in classes("{name}"):
    start = time.process_time()
    counts = decided(networks)
    found.append([time.process_time() - start, len(networks), counts])
print(json.dumps(found))
"""
CLASSES = {
    # name: pairs with the same coefficients and rank, and those that are the same over complex parameters
    "R-R-C-C, R-R-R-C-C, R-R-C-C-L": [(12, 12), (51, 51), (526, 66)],
    "three masses, at most three springs": [(187, 184), (238, 16)],
    "68 circuits of five elements": [],
}


def classes(name):
    """The networks of each class."""
    if name.startswith("R"):
        texts = [t for t in circuits(5, "RLC", 3) if "1 " not in t]
        return [[network_of(t) for t in texts if letters(t) == kinds] for kinds in RRCCL]
    if name.startswith("three"):
        families = (family_of(f"machines-3{damped}").networks for damped in ("", "-damped"))
        return [[n for n in f if sum(e.letter == "k" for e in n.elements) <= 3] for f in families]
    five = [n for n in family_of("circuits-5").networks if len(n.elements) == 5]
    return [[n for n in five if "1 " not in n.name]]


def letters(text):
    return "".join(sorted(c for c in text if c in "RLC"))


def decided(networks):
    """All pairs over complex parameters: how many have the same coefficients and rank, are the
    same, are undecided.
    """
    engine = Engine()
    sides = engine.general_subjects(list(map(of_network, networks)))
    found = engine.decisions(sides, Query(View.EXACT, inclusion=False))
    like = Counter((pattern(s.subject), s.transfer_profile.rank) for s in sides)
    relations = Counter(
        found.relation(i, j).value for i in range(len(sides)) for j in range(i + 1, len(sides))
    )
    pairs = sum(n * (n - 1) // 2 for n in like.values())
    return [pairs, relations["indistinguishable"], relations["undecided"]]


def test_all_pairs(benchmark) -> None:
    rows = []
    for name, expected in CLASSES.items():
        rounds = [json.loads(in_fresh_process(CODE.format(name=name))) for _ in range(3)]
        seconds = statistics.median(sum(part[0] for part in found) for found in rounds)
        sizes = [n * (n - 1) // 2 for _, n, _ in rounds[0]]
        counts = [part[2] for part in rounds[0]]
        for (pairs, same), (alike, there, open_) in zip(expected, counts, strict=False):
            assert (alike, there, open_) == (pairs, same, 0)
        shown = "; ".join(f"{alike} alike, {same} the same" for alike, same, _ in counts)
        rows.append((name, str(sum(sizes)), shown, f"{seconds:.2f} s"))
    benchmark.pedantic(lambda: decided(classes("R")[0]), rounds=1)
    table("All pairs over complex parameters, cold, CPU", ("class", "pairs", "", "time"), rows)


def test_damped_machines_of_three_masses(benchmark) -> None:
    """Over complex parameters; their catalogue with positive ones takes hours."""
    networks = family_of("machines-3-damped").networks
    start = time.process_time()
    pairs, same, undecided = benchmark.pedantic(lambda: decided(networks), rounds=1)
    row = ("7875", str(pairs), str(same), f"{time.process_time() - start:.1f} s")
    assert not undecided
    table("Damped machines of three masses", ("pairs", "alike", "the same", "CPU"), [row])


LIMIT = 20.0  # s of one profile


def networks_of_size(n):
    """A row with a branch in its middle, the same with a loop, and with a gear of a known ratio."""
    row = "=".join(str(i) for i in range(1, n))
    branch = f"{row}, {n // 2}={n}"
    texts = branch, f"{branch}={n // 2 + 1}", f"{branch}*5/2"
    return [network_of(f"{text}; F1; S{n - 1}") for text in texts]


def profiled(network):
    """The model made of the network and its profile, nothing kept from before."""
    for kept in (assembly, counts_of, solve):
        kept.cache_clear()
    return one_profile(behaviour_of(of_network(network)))


def one_profile(model):
    """Nothing kept from before."""
    draw_point.cache_clear()
    return profile.__wrapped__(model, Representation.TF, 0, Settings())


def cpu(run):
    start = time.process_time()
    run()
    return time.process_time() - start


def test_growth(benchmark) -> None:
    benchmark.pedantic(lambda: profiled(networks_of_size(4)[0]), rounds=1)
    rows, stopped = [], set()
    for n in range(3, 13):
        chain = Chain(n, meas_plus=n, damped=True)
        model = ChainModel(chain.structure)
        recurrence = statistics.median(
            cpu(lambda model=model: one_profile(model)) for _ in range(5)
        )
        row = [str(n), f"{1e3 * recurrence:.1f} ms"]
        for kind, network in enumerate([of_chain(chain), *networks_of_size(n)]):
            said = "-"
            if kind not in stopped:
                try:
                    rounds = [
                        cpu(lambda network=network: profiled(network))
                        for _ in range(1 + 2 * (n < 7))
                    ]
                    seconds = statistics.median(rounds)
                    said = f"{1e3 * seconds:.1f} ms ({seconds / recurrence:.1f})"
                    stopped |= {kind} if seconds > LIMIT else set()
                except InputError as problem:
                    said, stopped = f"refused: {str(problem)[:40]}", stopped | {kind}
            row.append(said)
        rows.append(tuple(row))
    table(
        "One profile, CPU, in times of the chain's recurrence in brackets",
        ("masses", "chain", "as a network", "with a branch", "with a loop", "with a gear 5/2"),
        rows,
    )


@pytest.mark.skipif(PROGRAM is None, reason="Singular is not installed")
def test_beside_singular(benchmark) -> None:
    """Every pair alone and cold: our verdict, and a Gröbner basis of the fibre, one prime, at most
    10 s; a process of Singular each, whose start is in its time.
    """
    benchmark.pedantic(lambda: compare("R1-C1", "p(R1,C1)"), rounds=1)
    rows = []
    for name, most in (
        ("circuits-4", 30),
        ("circuits-5", 20),
        ("machines-3", 10),
        ("compartments-3", 20),
    ):
        ours = theirs = 0.0
        late = wrong = 0
        for left, right in of_family(name, most):
            start = time.perf_counter()
            found = compare(left, right, query=Query(View.EXACT, inclusion=False)).relation
            ours += time.perf_counter() - start
            start = time.perf_counter()
            networks = (plain(m.network, left.powers.halves) for m in (left, right))
            true = truth(*networks, random.Random(1), 10.0)
            theirs += time.perf_counter() - start
            late += true is None
            wrong += true is not None and (found is Relation.INDISTINGUISHABLE) != true.same
        assert not wrong
        rows.append(
            (
                f"{name}, {most} pairs",
                f"{ours:.2f} s",
                f"{theirs:.2f} s, {late} stopped",
                f"{theirs / ours:.1f}",
            )
        )
    table("Pairs of equal degrees and rank, one by one", ("", "disting", "Singular", "ratio"), rows)


VALUES = {"R": 0.85, "C": 0.75, "L": 0.3}
TOLERANCE = 1e-5


def looks_alike(networks):
    """Pairs that a rule by numbers takes for the same, as a tool of the field has it: one value for
    all elements of a kind, and impedances that agree within 1e-5 at ten frequencies between 1 mHz
    and 1 kHz.
    """
    omega = 2 * np.pi * np.logspace(-3, 3, 10)
    seen = [frequency_response(n, {p: VALUES[p[0]] for p in n.parameters}, omega) for n in networks]
    return {
        (i, j)
        for i in range(len(seen))
        for j in range(i + 1, len(seen))
        if np.abs(seen[i] / seen[j] - 1).max() < TOLERANCE
    }


def test_beside_a_rule_by_numbers(benchmark) -> None:
    benchmark.pedantic(lambda: looks_alike(classes("R")[0]), rounds=1)
    rows = []
    lists = dict(zip(("R-R-C-C", "R-R-R-C-C", "R-R-C-C-L"), classes("R"), strict=True))
    lists["circuits-5"] = list(family_of("circuits-5").networks)
    for name, networks in lists.items():
        start = time.process_time()
        engine = Engine()
        sides = engine.general_subjects(list(map(of_network, networks)))
        found = engine.decisions(sides, Query(View.EXACT, inclusion=False))
        count = len(networks)
        same = {
            (i, j)
            for i in range(count)
            for j in range(i + 1, count)
            if found.relation(i, j) is Relation.INDISTINGUISHABLE
        }
        ours = time.process_time() - start
        start = time.process_time()
        alike = looks_alike(networks)
        theirs = time.process_time() - start
        rows.append(
            (
                name, str(count * (count - 1) // 2), str(len(same)), str(len(same & alike)),
                str(len(alike - same)), f"{ours:.2f} s", f"{theirs:.2f} s",
            )
        )  # fmt: skip
    wrong = [network_of(t, "autoeis") for t in ("[R1,C1]-[R2,C2]", "[R1-R2,C1-C2]")]
    assert looks_alike(wrong) == {(0, 1)} and compare(*wrong).relation is Relation.DISTINGUISHABLE
    heads = ("class", "pairs", "the same", "of them found by the rule", "others that it deletes")
    table("Beside a rule by numbers", (*heads, "disting", "rule"), rows)
