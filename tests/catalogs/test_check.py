"""`catalog/check.py` accepts what is shipped, and refuses lies: changed, removed, exchanged leaves,
other names, a relation that does not hold, and what an engine with a fault would write.
"""

import copy
import json
import os
import random
import re
import shutil
import subprocess
import sys
from importlib import resources
from importlib.util import module_from_spec, spec_from_file_location
from math import prod
from pathlib import Path
from typing import get_args

import pytest

import disting
from disting.catalogs.files import shipped_folder
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveEvidence

PATH = shipped_folder() / "check.py"


@pytest.fixture(scope="module")
def check():
    spec = spec_from_file_location("catalog_check", PATH)
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def records(name):
    text = (shipped_folder() / f"{name}.jsonl").read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]


def table_of(check, tmp_path, name, lines):
    path = tmp_path / f"{name}.jsonl"
    path.write_text("\n".join(json.dumps(line) for line in lines) + "\n", encoding="utf-8")
    table = check.Table()
    check.check_file(table, path)
    return table


def run(*paths):
    command = [sys.executable, "-I", "-S", str(PATH), *map(str, paths)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.full
def test_it_needs_nothing_but_python():
    done = run(shipped_folder() / "chains-2-undamped.jsonl")
    assert done.returncode == 0, done.stdout
    assert "free-choice" in done.stdout
    assert "import disting" not in PATH.read_text(encoding="utf-8")


@pytest.mark.thin(1)
@pytest.mark.parametrize("name", [
    "chains-2-damped", "chains-3-undamped", "chains-3-damped", "networks-machines-2",
    "networks-machines-2-damped", "networks-compartments-2", "networks-circuits-4",
    "dampers-3-damped", "next-3-damped",
])  # fmt: skip
def test_what_is_shipped_is_accepted(check, tmp_path, name):
    table = table_of(check, tmp_path, name, records(name))
    assert not table.wrong
    assert sum(row[check.CHECKED] + row[check.SEARCH] for row in table.counts.values()) > 5


def table_by(interpreter, flags, seed, *paths):
    """What the checker prints, but for seconds; "" from an interpreter that does not start."""
    command = [interpreter, *flags, str(PATH), *map(str, paths)]
    env = os.environ | {"PYTHONHASHSEED": seed}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=env)
    return done.stdout.rpartition("\n\n")[0] if done.returncode != 127 else ""


@pytest.mark.full
def test_packages_of_the_site_and_hashes_of_texts_change_nothing():
    path = shipped_folder() / "networks-machines-2.jsonl"
    flags = (["-I", "-S"], "0"), (["-I"], "1"), ([], "2")
    tables = [table_by(sys.executable, *of, path) for of in flags]
    assert len(tables[0].splitlines()) > 5
    assert len(set(tables)) == 1


# a shim of a manager of versions ends with 127 where its version is not chosen
OTHERS = "pypy3", *(f"python3.{minor}" for minor in range(9, 16))


@pytest.mark.sampled(2)
@pytest.mark.full
@pytest.mark.parametrize("name", ["chains-3-damped", "dampers-3-undamped", "networks-cells-4"])
def test_another_python_gives_the_same_table(name):
    path = shipped_folder() / f"{name}.jsonl"
    found = [*filter(None, map(shutil.which, OTHERS))]
    tables = {table_by(python, ["-I", "-S"], "0", path) for python in (sys.executable, *found)}
    assert len(tables - {""}) == 1


@pytest.mark.slow
def test_all_that_is_shipped_is_accepted_by_each_python():
    done = run(shipped_folder())
    assert done.returncode == 0, done.stdout
    for python in filter(None, map(shutil.which, OTHERS)):
        table = table_by(python, ["-I", "-S"], "0", shipped_folder())
        assert table in ("", done.stdout.rpartition("\n\n")[0])


def pairs_of(check, name):
    """(pair, place, its part of the record) of all evidence of pairs of a file."""
    head, *lines = records(name)
    models = {}
    for r in lines:
        if "network" in r:
            models[r["model"]] = check.network(r["network"])
        elif "model" in r:
            models[r["model"]] = check.chain(head["n_masses"], *r["indices"], head["damped"])
        elif name.startswith("sizes"):
            for side in ("left", "right"):
                n, k = map(int, r[side].split(":"))
                models[r[side]] = list(check.enumerated(n, "undamped" not in name))[k - 1]
        if "left" not in r:
            continue
        a, b = models[r["left"]], models[r["right"]]
        pair = check.Pair(a, b, f"{a.text} | {b.text}", 2 if "cells" in name else 1)
        yield from (
            (pair, slot, r[slot]["evidence"])
            for slot in ("tf", "markov", "complex", "real")
            if r.get(slot, {}).get("evidence")
        )
        if r.get("finding", [None] * 5)[4]:
            yield pair, "finding", r["finding"][4]
        for side in ("closure", "image"):
            if r.get("inclusions", {}).get(side, {}).get("evidence"):
                yield pair, side, r["inclusions"][side]["evidence"]


def first_of_each(check, name, kinds):
    """The first piece of evidence of each of these kinds that the checker confirms."""
    seen = {}
    for pair, _, e in pairs_of(check, name):
        if seen.keys() == kinds:
            break
        if e["kind"] in kinds - seen.keys() and check.evidence(pair, e).status == check.CHECKED:
            seen[e["kind"]] = pair, e
    return seen


def lies(value):
    """The same with one leaf changed or removed, or two neighbours exchanged."""
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int):
        yield value + 1
    elif isinstance(value, str):
        yield value + "7"
    elif isinstance(value, list):
        for i, item in enumerate(value):
            yield value[:i] + value[i + 1 :]
            for lie in lies(item):
                yield [*value[:i], lie, *value[i + 1 :]]
    elif isinstance(value, dict):
        for key, item in value.items():
            if key != "kind":
                yield {k: v for k, v in value.items() if k != key}
                for lie in lies(item):
                    yield value | {key: lie}


# words that prove nothing, and what is as true in another way
HARMLESS = {"symmetries", "domain", "left_is_submodel"}


def accepted_lies(check, pair, e):
    for lie in lies(e):
        changed = [k for k in e if lie.get(k) != e[k]]
        if set(changed) & HARMLESS:
            continue
        if check.evidence(pair, lie).status == check.CHECKED:
            yield {k: lie.get(k) for k in changed}


TRUE_LIES = {
    # fewer coefficients that vary on one side only are still some
    "forms": lambda change: any(change.values()),
    # fewer rows may have the same two ranks
    "ranks": lambda change: set(change) <= {"rows", "all_rows"},
    "larger-projection": lambda change: set(change) == {"rows"},
    # another numbering of the same kinds at the same places; the ground is 0 in both
    "embedding": lambda change: set(change) == {"numbering"},
    # a positive number before a form
    "inequality": lambda change: set(change) == {"form"},
    # a step whose row is the same after it
    "limit": lambda change: set(change) == {"parts"},
}


@pytest.mark.thin(1)
@pytest.mark.parametrize(("name", "kinds"), [
    ("chains-3-undamped", {"counts", "forms", "ranks", "renaming", "free-choice", "full-image",
                           "relative-degrees", "theorem"}),
    ("networks-machines-2", {"free-choice", "explicit"}),
    ("networks-cells-4", {"free-choice", "explicit"}),
    ("networks-compartments-3", {"solved"}),
    ("networks-compartments-2", {"renaming"}),
    ("networks-circuits-5", {"embedding"}),
    ("networks-machines-3-damped", {"inequality"}),
    ("sizes-damped", {"counts", "limit", "meeting"}),
    ("sizes-undamped", {"too-large"}),
])  # fmt: skip
def test_no_lie_in_evidence_is_accepted(check, name, kinds):
    found = first_of_each(check, name, kinds)
    assert kinds == found.keys()
    for kind in kinds:
        pair, e = found[kind]
        may = TRUE_LIES.get(kind, lambda change: False)
        accepted = [change for change in accepted_lies(check, pair, e) if not may(change)]
        assert accepted == [], kind


def test_witnesses_that_do_not_fit_are_refused(check):
    """What is not whole without a search is still compared as far as it is stored."""
    pairs = pairs_of(check, "networks-compartments-2")
    pair, _, e = next(x for x in pairs if x[2]["kind"] == "witnesses")
    assert check.evidence(pair, e).status == check.SEARCH
    (name, _), *rest = e["point_with"]
    for lie in ({"point_with": rest}, {"equivalent": e["point_without"][:1] * 3},
                {"with_left_given": not e["with_left_given"]},
                {"equivalent": [[n, "-1"] for n, _ in e["equivalent"]]},
                {"equivalent": [[n, "1e-9"] for n, _ in e["equivalent"]]},
                {"equivalent": [[n, f"{float(x) * 1.00001}"] for n, x in e["equivalent"]]},
                {"point_with": [[name, "none"], *rest]}):  # fmt: skip
        assert check.evidence(pair, e | lie).status == check.WRONG, lie


@pytest.mark.parametrize(("left", "right", "same"), [
    ("R1-p(R2,C1)", "p(R1,R2-C1)", True), ("R1-p(R2,C1)", "R1-p(C1,R2-C2)", False),
    ("L1-R1-p(R2,C1)-p(R3,C2)", "L1-p(R1,R2-C1,R3-C2)", True),
    ("1~2, 1~3; F1; S1", "1~2, 2~3; F1; S1", True), ("#~1, 1~2; F1; S1", "1~2; F1; S1", False),
    ("1=2, 1=3; F1; S1", "1=2, 2=3; F1; S1", False), ("1~2, 2~3; F1; S3", "1~2, 2~3; F3; S1", True),
    ("1~2, 2~3; F1; S2", "1~2, 2~3; F1; S3", False),
    # one-ports that are no parts in series and parallel, of which some remains
    ("#~1, #~2, 1~3; F3:2; S3:2", "#~1, 1~2, 2~3; F3; S3", True),
    ("R1 1 2; R2 1 3; C1 2 3; R3 2 0; R4 3 0", "R1-p(R2,C1)", True),
    ("R1 1 2; R2 1 3; C1 2 3; R3 2 0; R4 3 0", "R1-p(R2,C1)-p(R3,C2)", False),
    ("R1 1 2; R2 1 3; C1 2 3; R3 2 0; R4 3 0", "C1-p(R2,C2)", False),
    ("C1 1 2; R1 1 3; C2 2 3; R2 2 0; R3 3 0", "R1-p(C1,R2)-p(C2,R3)", False),
    ("R1 1 2; R2 1 3; C1 2 3; R3 2 0; L1 3 0", "R1-p(R2,C1)", False),
    ("1~2, 1~3; F2:1; S2:1", "1~2, 1~3; F2:1; S1:2", False),
    # bridges of which no part remains that shows it: by the degree of their map
    ("#~1, 1~2, 1~3; F3:2; S3:2", "#~1, 1~2, 2~3; F3; S3", True),
    ("#~1, 1~2, 2~3; F3:1; S3:1", "#~1, 1~2, 1~3; F2:3; S2:3", True),
    ("j1 1 0, j2 2 0, j3 3 0, k1 1 0, k2 1 2, k3 1 3, k4 1 3, in 3 2, out 3 2",
     "j1 1 0, j2 2 0, j3 3 0, k1 1 2, k2 2 3, k3 3 0, in 1 0, out 1 0", True),
    ("#~1, 1~2, 2~3; F3:1; S3:1", "#~1, 1~2, 1~3; F2:3; S3:2", False),
    ("#~1, 1~2, 2~3; F3:1; S3:1", "1~2, 2~3; F1; S1", False),
    ("#=1, 1~2, 2~3; F3:1; S3:1", "#~1, 1~2, 2~3; F3; S3", False),
    ("R1 1 2; R2 1 3; C1 2 3; R3 2 0; R4 3 0; R5 2 2", "R1-p(R2,C1)", True),
    # outflows of compartments: moved to a gate, left out between two, and where they may not be
    ("1>2, 2>1, 2>0; in 1; out 1", "1>0, 1>2, 2>1; in 1; out 1", True),
    ("1>2, 2>1, 2>0; in 1; out 2", "1>2, 2>1, 1>0; in 1; out 2", False),
    ("1>2, 2>1, 2>3, 3>2, 3>0; in 1; out 2", "1>2, 2>1, 2>3, 3>2, 2>0; in 1; out 2", True),
    ("1>0, 1>2, 2>3, 2>0, 3>0; in 1; out 3", "1>0, 1>2, 2>3, 3>0; in 1; out 3", True),
    ("1>0, 1>2, 2>3, 2>0; in 1; out 3", "1>0, 1>2, 2>3; in 1; out 3", False),
    ("1>2, 2>3, 3>0; in 1; out 3", "1>2, 1>0, 2>3, 3>0; in 1; out 3", False),
    ("1>2, 2>1; in 1; out 1", "1>2, 2>1, 2>0; in 1; out 1", False),
    # trees, flows turned round, what never reaches the output
    ("1<>2, 1<>3; in 1; out 1", "1<>2, 2<>3; in 1; out 1", True),
    ("1<>2, 1<>3; in 1; out 1", "1<>2, 2<>3; in 2; out 2", True),
    ("1<>2, 1<>3, 3>0; in 1; out 1", "1<>2, 2<>3, 1>0; in 1; out 1", True),
    ("1<>2, 1<>3; in 1; out 2", "1<>2, 2<>3; in 1; out 2", False),
    ("1>2, 2>3, 3>1, 2>1; in 1; out 1", "1>3, 3>2, 2>1, 1>2; in 1; out 1", True),
    ("1>2, 2>3, 3>1, 2>1; in 1; out 2", "1>3, 3>2, 2>1, 1>2; in 1; out 2", False),
    ("1>2, 2>0, 2>3; in 1; out 2", "1>2, 2>0; in 1; out 2", True),
])  # fmt: skip
def test_parts_that_can_replace_each_other(check, left, right, same):
    assert check.replaceable(check.network(left), check.network(right)) == same


def bridge_of(check, text):
    m = check.network(text)
    powers = sorted({e.power for e in m.elements})
    return check.one_port([(powers.index(e.power), e.a, e.b) for e in m.elements], *m.force)


@pytest.mark.parametrize(("text", "degree"), [
    # in series and parallel: values that branches exchange
    ("R1", 1), ("R1-p(C1,R2-C2)", 1), ("p(R1-C1,R2-C2)", 2), ("p(R1-C1,R2-C2,R3-C3)", 6),
    ("p(R1-C1,R2-p(C2,R3-C3))", 3), ("p(R1,C1)-p(R2,C2)", 2),
    # as lists of all values say
    ("#~1, 1~2, 1~3; F3:2; S3:2", 2), ("#~1, 1~2, 2~3; F3:1; S3:1", 1),
    # as exact algebra says; with 0 some functions of K are not given
    ("C1 1 2; R1 1 3; C2 2 3; R2 2 0; R3 3 0", 0), ("C1 1 2; R1 1 3; R2 2 3; R3 2 0; C2 3 0", 0),
    ("1~2, 1~3, 2~4, #~3; F4; S4", 1), ("1~2, 1~3, 2~4, #~3; F4:3; S4:3", 1),
    ("1~2, 1~3, 1~4, #~2; F3:2; S3:2", 2), ("1~2, 1~3, 1~4, #~2; F4:3; S4:3", 2),
    ("1~2, 1~3, 2~4, #~1; F3:2; S3:2", 5), ("1~2, 1~3, 2~4, #~1; F4:3; S4:3", 3),
    ("1~2, 1~3, 2~4, #~3; F4:1; S4:1", 1), ("1~2, 1~3, 2~4, #~3; F3:2; S3:2", 3),
])  # fmt: skip
def test_degree_of_a_bridge(check, text, degree):
    """But for the sign, which is that of an order of the elements."""
    assert abs(check.degree(bridge_of(check, text))) == degree


@pytest.mark.parametrize("text", [
    "p(R1,R2-p(R3,C1))", "R1 1 2; R2 1 3; C1 2 3; R3 2 0; R4 3 0", "p(R1,R2-p(R3,C1-C2),C3)",
])  # fmt: skip
def test_more_elements_than_coordinates_have_no_degree_here(check, text):
    assert check.degree(bridge_of(check, text)) == 0


def signs_of_map(check, bridge, values):
    """The determinant of all coefficients and their derivatives by the values."""
    parts = [check.element("kd"[p], f"e{i}", a, b) for i, (p, a, b) in enumerate(bridge)]
    num, den = check.symbolic(check.model("", parts, (1, 0), (1, 0)))
    row = [terms for side in (num, den) for _, terms in sorted(side.items())]

    def at(terms, without):
        held = {k: v for k, v in terms.items() if without is None or k[without]}
        kept = (tuple(e * (i != without) for i, e in enumerate(k)) for k in held)
        return sum(v * prod(map(pow, values, k)) for k, v in zip(kept, held.values(), strict=True))

    rows = [[at(terms, i) for terms in row] for i in (None, *range(len(values)))]
    p = 2**521 - 1  # above twice the determinant: all numbers are whole
    return check.signed(check.reduced(rows, len(rows), p)[2], p)


@pytest.mark.parametrize("text", [
    "#~1, 1~2, 1~3; F3:2; S3:2", "#~1, 1~2, 2~3; F3:1; S3:1", "R1-p(C1,R2-C2)",
])  # fmt: skip
def test_a_face_has_the_sign_of_the_column_and_row_that_are_left_out(check, text):
    bridge = bridge_of(check, text)
    (n, c, z), size, met = check.numbers_of(bridge), len(bridge), 0
    face, column = ((n, 0, z), n + z) if c else ((n - 1, 1, z), size)
    for i, rigid, rest in check.one_less(bridge):
        if len(rest) < size - 1 or check.numbers_of(rest) != face:
            continue
        values = [3, 5, 7, 11, 13, 17][: size - 1]
        close = 10**8 if rigid else 1
        scaled = [v * (1 if rigid else 10**8) for v in values]
        there = signs_of_map(check, bridge, [*scaled[:i], close, *scaled[i:]])
        assert there * signs_of_map(check, rest, values) * (-1) ** (i + 1 + column + rigid) > 0
        assert (rigid, bridge[i][0]) == (c, 1 - c)  # a B that vanishes, or an A that gets rigid
        met += 1
    assert met


def test_numbers_of_a_bridge_are_those_of_its_function(check):
    draw = random.Random(1)
    for _ in range(60):
        size = draw.randint(2, 5)
        parts = [(draw.randint(0, 1), *draw.sample(range(size), 2)) for _ in range(6)]
        parts += [(draw.randint(0, 1), i, i + 1) for i in range(size - 1)]
        whole = [check.element("kd"[p], f"e{i}", a, b) for i, (p, a, b) in enumerate(parts)]
        x = check.Profile(check.model(f"{parts}", whole, (1, 0), (1, 0)))
        zero = int(x.den[0] == 0)
        found = x.degrees[1] - zero, int(x.degrees[0] == x.degrees[1]), zero
        assert check.numbers_of(check.one_port(parts, 1, 0)) == found


@pytest.mark.parametrize(("left", "right", "same"), [
    ("#~1, 1~2, 1~3; F1; S2", "#~1, 1~2, 2~3; F1; S2", True),  # a mass is held
    ("#~1, 1~2, 1~3; F1; S2:1", "#~1, 1~2, 2~3; F2:1; S3:2", True),  # a spring is cut
    ("#~1, 1~2, 1~3; F1; S2:1", "#~1, 1~2, 2~3; F2:1; S2:3", False),  # of the other sign
    ("#~1, 1~2, 1~3; F1; S2", "#~1, 1~2, 2~3; F1; S3", False),  # no antiresonance
    ("#~1, #~2, 1~2; F1; S2", "#~1, 1~2; F1; S2", True),  # a spring more
    ("#~1, #~2, 1~2, 1~3; F1; S3", "#~1, 1~2, 2~3; F3; S2:1", True),
    ("#~1, 1~2, 1~3, 2~3; F1; S2", "#~1, 1~2, 1~3, 2~3; F1; S2", False),  # of no part
    ("#~1, #~2, 1~2, 1~3; F1; S2:1", "#~1, #~2, 1~2, 1~3; F1; S2:1", False),
    ("1~2, 1~3, 1~4; F2; S3", "1~2, 1~3, 2~4; F1; S4", True),  # free
    ("1~2, 1~3, 2~3, 1~4; F1; S4", "1~2, 2~3, 1~4; F4; S1", True),
    ("1~2, 2~3; F1; S2", "#~1, 1~2; F1; S2", False), ("1~2, 2~3; F1; S2", "#~1, 1~2, 2~3; F1; S2", False),
    ("1~2, 1~3, 2~3; F1; S2", "1~2, 1~3, 2~3; F1; S2", False),
    ("#=1, 1=2, 1=3; F1; S2", "#=1, 1=2, 1=3; F1; S2", False),  # dampers
    ("R1-p(R2,C1)", "R1-p(R2,C1)", False), ("1>2, 2>0; in 1; out 2", "1>2, 2>0; in 1; out 2", False),
    # read from the parts of one of them or of both
    ("1~2, 1~3, 1~4, #~1; F2; S2:1", "1~2, 1~3, 1~4, #~1; F2:1; S2:1", True),
    ("1~2, 1~3, 1~4, #~1; F2; S2:1", "1~2, 1~3, 1~4, #~1; F2:1; S1:2", False),
    ("#~1, 1~2, 2~3; F3; S3:2", "#~1, 1~2, 2~3; F2:1; S2:1", True),
    ("#~1, #~2, 1~3; F3:2; S3:2", "#~1, 1~2, 1~3; F2; S2:1", True),
    ("#~1, 1~2, 1~3; F3:2; S3:2", "#~1, 1~2, 2~3; F3; S3", True),  # by the degree of a bridge
    ("1~2, 2~3; F1; S1:2", "1~2, 2~3; F2:1; S2:1", False),
    ("j1 1 2, j2 2 3, k1 1 3, j3 1 0, k2 2 0, in 1 0, out 1 0", "#~1, 1~2, 2~3; F3; S3", False),
])  # fmt: skip
def test_machines_with_any_zeros_between_their_poles(check, left, right, same):
    e = {"kind": "theorem", "name": "interlacing"}
    pair = check.pair_of(check.network(left), check.network(right))
    assert check.evidence(pair, e).status == (check.CHECKED if same else check.SEARCH)


@pytest.mark.parametrize(("left", "right", "same"), [
    ("#~1, 1~2, 1~3, 2~3; F1; S2", "#~1, #~3, 1~2, 1~3, 2~3; F1; S2", True),
    ("#~1, 1~2, 1~3, 2~3; F1; S2", "#~1, 1~2, 1~3, 2~3; F2; S3", True),
    ("#~1, 1~2, 1~3, 2~3; F1; S2", "#~1, 1~2, 1~3, 2~3; F1; S1", False),
    ("#~1, 1~2, 1~3, 2~3; F1; S2", "#~1, 1~2, 1~3; F1; S2", False),
    ("#~1, 1~2, 1~3, 2~3; F1; S2", "1~2, 1~3, 2~3; F1; S2", False),  # no spring to the ground
    ("#~1, 1~2, 1~3; F1; S3:2", "#~2, 1~2, 1~3; F1; S3:2", False),  # between two masses
    ("#~1, #~2, 1~3; F1; S3", "#~1, #~2, #~3, 1~3; F1; S3", True),  # one mass is not seen
    ("#~1, #~2, 1~3; F1; S2:3", "#~1, #~2, 1~3; F1; S2:3", False),  # of two parts
    # a tree that hangs at a mass is a chain
    ("#~1, 1~2, 1~3, 2~3, 3~4, 3~5; F1; S2", "#~3, 1~2, 1~3, 2~3, 3~4, 4~5; F1; S2", True),
    ("#=1, 1=2; F1; S2", "#=2, 1=2; F1; S2", False),  # dampers
])  # fmt: skip
def test_places_of_springs_to_the_ground(check, left, right, same):
    e = {"kind": "theorem", "name": "springs to the ground"}
    pair = check.pair_of(check.network(left), check.network(right))
    assert check.evidence(pair, e).status == (check.CHECKED if same else check.SEARCH)


def random_machine(check, draw):
    """Three masses, springs between them and to the ground, ports anywhere."""
    size = 3
    ends = {tuple(sorted(draw.sample(range(size + 1), 2))) for _ in range(size + 1)}
    parts = [check.element("m", f"m{i}", i, 0) for i in range(1, size + 1)]
    parts += [check.element("k", f"k{a}{b}", a, b) for a, b in sorted(ends)]
    ports = [draw.choice([(1, 0), (2, 0), (1, 2), (2, 1)]) for _ in range(2)]
    return check.model(f"{sorted(ends)} {ports}", parts, *ports, 2)


@pytest.mark.parametrize("size", [16, pytest.param(150, marks=pytest.mark.full)])
def test_machines_that_share_a_form_are_told_apart_by_nothing(check, size):
    """By no degree, rank, constant or dependence: what the theorems join is the same."""
    draw, first, joined = random.Random(1), {}, 0
    for _ in range(size):
        m = random_machine(check, draw)
        for name in check.ON_NETWORKS:
            for form in check.functions_of(m, name):
                other = first.setdefault((name, repr(form)), m)
                joined += other is not m
                assert not check.told_apart(check.profile(m), check.profile(other), ("H",))
    assert joined


@pytest.mark.thin(1)
@pytest.mark.parametrize("name", [
    "networks-circuits-4", "networks-machines-3", "networks-compartments-3",
])  # fmt: skip
def test_networks_that_differ_cannot_be_replaced(check, name):
    """No pair that is told to differ for some positive values has one normal form."""
    models = {r["model"]: check.network(r["network"]) for r in records(name) if "network" in r}
    pairs = [r for r in records(name) if "positive" in r]
    for r in pairs:
        if r["positive"]["relation"] in ("distinguishable", "sometimes"):
            assert not check.replaceable(models[r["left"]], models[r["right"]])
    assert len(pairs) > 50


@pytest.mark.parametrize("name", ["chains-2-undamped", "networks-compartments-2"])
def test_evidence_of_another_pair_is_refused(check, name):
    """Names replaced by other names: each piece of evidence is put at a pair of other models."""
    every = list(pairs_of(check, name))
    strangers = [
        (pair, e)
        for (_, _, e), (pair, _, _) in zip(every, every[::-1], strict=True)
        if e["kind"] in ("counts", "renaming", "explicit")
    ]
    wrong = [check.evidence(pair, e).status for pair, e in strangers]
    assert wrong.count(check.CHECKED) <= len(wrong) // 3  # some are true of the other pair too


def changed(lines, at, change):
    lines = copy.deepcopy(lines)
    change(lines[at])
    return lines


def at_pair(lines, left, right):
    return next(k for k, r in enumerate(lines) if (r.get("left"), r.get("right")) == (left, right))


RELATION = [
    ("a pair is missing", lambda lines: lines[:-1]),
    ("a pair stands twice", lambda lines: [*lines, lines[-1]]),
    ("a model is another one", lambda lines: changed(
        lines, 1, lambda r: r.update(indices=[0, 0, 1, 0, 2]))),
    ("another rank", lambda lines: changed(lines, 1, lambda r: r.update(rank=2))),
    ("other degrees", lambda lines: changed(lines, 1, lambda r: r.update(degrees=[1, 2]))),
    ("other parameters", lambda lines: changed(
        lines, 1, lambda r: r.update(parameters=["m1", "m2", "k01"]))),
    ("another condition", lambda lines: changed(
        lines, at_pair(lines, 1, 3), lambda r: r["tf"].update(decided_by="6"))),
    ("a planted relation", lambda lines: changed(
        lines, at_pair(lines, 1, 2), lambda r: r.update(tf={
            "decided_by": "7", "certainty": "proven", "safety": 0,
            "evidence": {"kind": "free-choice", "rank": 3, "free": ["b0", "b2", "a0"]}}))),
    ("the reverse inclusion", lambda lines: changed(
        lines, at_pair(lines, 1, 2), lambda r: r["inclusions"]["closure"].update(
            inclusion="left-in-right"))),
    ("evidence that is none", lambda lines: changed(
        lines, at_pair(lines, 1, 2), lambda r: r["tf"].update(evidence={"kind": "counts"}))),
]  # fmt: skip


@pytest.mark.parametrize(("what", "lie"), RELATION, ids=[what for what, _ in RELATION])
def test_lies_of_a_file_are_refused(check, tmp_path, what, lie):
    lines = records("chains-2-undamped")
    assert table_of(check, tmp_path, "chains-2-undamped", lie(lines)).wrong, what


NETWORKS = [
    ("another class", lambda lines: changed(lines, 2, lambda r: r.update(group=r["group"] + 1))),
    ("a pair is missing", lambda lines: lines[:-1]),
    ("another rank", lambda lines: changed(
        lines, 1, lambda r: r["identifiability"].update(rank=1))),
    ("another network", lambda lines: changed(
        lines, 1, lambda r: r.update(network=lines[6]["network"]))),
    ("a class of strangers", lambda lines: changed(
        changed(lines, 1, lambda r: r.update(group=9)), 2, lambda r: r.update(group=9))),
    ("a verdict that the finding does not give", lambda lines: changed(
        lines, -1, lambda r: r["positive"].update(relation="distinguishable")
        if r["finding"][1] == "holds" else r["finding"].__setitem__(1, "holds"))),
]  # fmt: skip


@pytest.mark.parametrize(("what", "lie"), NETWORKS, ids=[what for what, _ in NETWORKS])
def test_lies_of_a_family_are_refused(check, tmp_path, what, lie):
    name = "networks-machines-2-damped"
    assert table_of(check, tmp_path, name, lie(records(name))).wrong, what


def stored(key, *changes):
    """Change entries of the first model's list: (place, value or the place that it is taken of)."""

    def change(r):
        for place, value in changes:
            r[key][place] = r[key][value[0]] if isinstance(value, tuple) else value

    return lambda lines: changed(lines, 1, change)


def as_one_class(lines):
    """Sets 1 and 2 of the first model told to be one class, with all that follows."""
    lines = copy.deepcopy(lines)
    old, new = lines[1]["group"][2], lines[1]["group"][1]
    for r in lines[1:]:
        for k, group in enumerate(r["group"]):
            if group == old:
                r["group"][k], r["columns"][k] = new, lines[1]["columns"][1]
    return lines


def alone(lines):
    """A model of a class of several told to be a class of its own."""
    lines = copy.deepcopy(lines)
    of = lines[1]["group"] + lines[2]["group"]
    number = next(g for g in of if of.count(g) > 1)
    next(r for r in lines[1:] if number in r["group"])["group"][of.index(number) % 8] = 999
    return lines


DAMPERS = [
    ("a rank", stored("rank", (1, 9))),
    ("a class of its own", alone),
    ("a member of another class", stored("group", (1, (2,)))),
    ("two classes as one", as_one_class),
    ("a column of another class", stored("columns", (1, (2,)))),
    ("a column of a class that is not known", stored("columns", (1, [9] * 9))),
    ("a renaming that is none", stored("renamed", (1, (2,)))),
    ("a free choice that is none", stored("free", (0, 4))),
    ("a list that is shorter", lambda lines: changed(lines, 1, lambda r: r["free"].pop())),
    ("a model is missing", lambda lines: [lines[0], *lines[2:]]),
    ("another condition", lambda lines: changed(lines, 0, lambda r: r["tests"].reverse())),
    ("an open pair of one class", lambda lines: changed(
        lines, 0, lambda r: r["undecided"].append([1, 1]))),
]  # fmt: skip


@pytest.mark.full
@pytest.mark.parametrize(("what", "lie"), DAMPERS, ids=[what for what, _ in DAMPERS])
def test_lies_of_classes_with_dampers_are_refused(check, tmp_path, what, lie):
    assert table_of(check, tmp_path, "dampers-3-damped", lie(records("dampers-3-damped"))).wrong


@pytest.mark.full
def test_classes_with_dampers_are_told_apart_by_dependences(check, tmp_path):
    """Of 528 pairs of classes all but 17 differ by what depends on what."""
    counts = table_of(check, tmp_path, "dampers-3-damped", records("dampers-3-damped")).counts
    of = {why: row for (_, place, what, why), row in counts.items() if what == "distinguishable"}
    assert of["invariants"][check.CHECKED] >= 511
    assert sum(row[check.SEARCH] for row in of.values()) <= 17


def test_formulas_over_real_values_are_no_finding_over_positive_ones(check):
    pairs = pairs_of(check, "networks-cells-4")
    pair, e = next((pair, e) for pair, _, e in pairs if e["kind"] == "explicit")
    real = e | {"domain": "real"}
    assert check.evidence(pair, real).status != check.WRONG
    for evidence, wrong in ((e, False), (real, True)):
        table = check.Table()
        check.finding(table, "", "", [10, "holds", "proven", 0, evidence, ""], pair, "positive")
        assert bool(table.wrong) == wrong


@pytest.mark.full
def test_a_file_that_is_none_is_wrong(check, tmp_path):
    path = tmp_path / "chains-2-damped.jsonl"
    path.write_text("{}\nnone", encoding="utf-8")
    assert run(path).returncode == 1


def test_the_guide_names_every_kind_of_evidence(check):
    page = (resources.files("disting") / "guide" / "checking.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`([^`]+)`", page))
    kinds = {*check.CHECKS, *check.CERTAINTY, *check.SHOWS}
    assert len(kinds) > 30
    assert kinds - named == set()


# kinds that only single verdicts of several experiments, of ranges or of limits have
OF_VERDICTS = {
    "box", "fibre under experiments", "minor", "missing-elements", "only one",
}  # fmt: skip


def test_every_kind_that_a_catalogue_may_hold_is_known(check):
    """A kind that is not known here would make the catalogue of a larger size wrong."""
    kinds = {k.kind for union in (Evidence, InclusionEvidence, PositiveEvidence)
             for k in get_args(union)}  # fmt: skip
    assert kinds - check.CERTAINTY.keys() == OF_VERDICTS


FAULTS = [
    ("a coefficient of the recurrence of determinants", "disting/algebra/determinants.py",
     "off[i - 1] * minors[-2] if i", "off[i - 1] * minors[-2] * 2 if i"),
    ("condition 7 holds whatever the ranks are", "disting/conditions/sufficient.py",
     "if not left.rank == right.rank == len(left.form):", "if False:"),
]  # fmt: skip


@pytest.mark.full
@pytest.mark.parametrize(("what", "file", "right", "wrong"), FAULTS, ids=[f[0] for f in FAULTS])
def test_a_fault_of_the_engine_is_found_in_what_it_builds(tmp_path, what, file, right, wrong):
    """The engine is copied, one line is changed, and a small catalogue is built anew."""
    package = Path(disting.__file__).parent
    shutil.copytree(package, tmp_path / "disting", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(shipped_folder(), tmp_path / "catalog")
    text = (tmp_path / file).read_text(encoding="utf-8")
    assert text.count(right) == 1
    (tmp_path / file).write_text(text.replace(right, wrong), encoding="utf-8")
    command = "-m", "disting", "catalog", "build", "2", "--out", "built", "--no-cache"
    env = os.environ | {"PYTHONPATH": str(tmp_path)}
    subprocess.run([sys.executable, *command], cwd=tmp_path, env=env, check=True)
    done = run(tmp_path / "built")
    assert done.returncode == 1
    assert "wrong" in done.stdout, what


@pytest.mark.full
def test_a_single_verdict_is_checked(tmp_path):
    from disting import verdict_file

    for left, right in (("3:4", "3:5"), ("R1-p(R2,C1)", "p(R1,R2-C1)")):
        path = tmp_path / "verdict.json"
        path.write_text(json.dumps(verdict_file(left, right)), encoding="utf-8")
        done = run(path)
        assert done.returncode == 0, done.stdout


CHAIN = {
    "n_masses": 3, "gap": 0, "act_minus": 0, "act_plus": 1, "meas_minus": 0, "meas_plus": 1,
    "damped": True, "sensor": "acceleration", "ground_dampers": [], "lag": False,
    "dead_time": False,
}  # fmt: skip
SYMMETRY = {"kind": "theorem", "name": "symmetry"}
EXPLICIT = {
    "kind": "explicit", "domain": "positive", "formulas": [
        [True, [], [["C1", "C1*R1**2/(R0 + R1)**2"], ["R0", "R0 + R1"],
                    ["R1", "R0*(R0 + R1)/R1"]], []],
        [False, [], [["C1", "C1*(R0 + R1)**2/R0**2"], ["R0", "R0*R1/(R0 + R1)"],
                     ["R1", "R0**2/(R0 + R1)"]], []],
    ],
}  # fmt: skip
CELLS = [{"network": "R0-p(R1,C1)"}, {"network": "p(R0,C1-R1)"}]
REPLACED = {
    "kind": "replaced", "left": "R0-p(C1,R1)", "right": "p(R0,R1-C1)", "left_larger": False,
    "right_larger": False, "inner": EXPLICIT,
}  # fmt: skip


def is_wrong(check, models, evidence, relation="indistinguishable", **others):
    """Return True if a single verdict is wrong; raises AssertionError where it is not checked."""
    told = {"models": models, "query": {}, "notes": [], "evidence": evidence}
    told |= {"relation": relation, "domain": "positive", "decided_by": "admissible"}
    told |= {"certainty": "proven", "safety": 0}
    table = check.Table()
    check.verdict_file(table, "", told | others)
    assert table.wrong or any(row[check.CHECKED] for row in table.counts.values())
    return bool(table.wrong)


def test_a_single_verdict_says_no_more_than_its_evidence(check):
    assert not is_wrong(check, CELLS, EXPLICIT)
    assert is_wrong(check, CELLS, EXPLICIT, domain="real")
    assert is_wrong(check, CELLS, EXPLICIT, certainty="theorem")
    assert is_wrong(check, CELLS, EXPLICIT, decided_by="7")
    assert is_wrong(check, CELLS, EXPLICIT, safety=9)
    assert not is_wrong(check, CELLS, REPLACED)
    for relation in ("distinguishable", "sometimes", "undecided", None):
        assert is_wrong(check, CELLS, EXPLICIT, relation)
        assert is_wrong(check, CELLS, REPLACED, relation)


def test_a_single_verdict_is_on_its_elements_not_on_its_names(check):
    """A name is what a person likes; a machine's quantity is a field."""
    elements = [["R0", 1, 2], ["R1", 2, 0], ["C1", 2, 0]]
    given = {"name": "cell", "elements": elements, "port": [[1, 0]]}
    assert not is_wrong(check, [given, CELLS[1]], EXPLICIT)
    other = given | {"name": "R0-p(R1,C1)", "elements": [["R0", 1, 2], ["R1", 1, 2], ["C1", 2, 0]]}
    assert is_wrong(check, [other, CELLS[1]], EXPLICIT)
    machine = {"name": "x", "elements": [["m1", 1], ["m2", 2], ["k12", 1, 2]], "force": [[1, 0]],
               "sensor": [[1, 0]], "quantity": "acceleration"}  # fmt: skip
    pairs = {"kind": "renaming", "pairs": [[n, n] for n in ("m1", "m2", "k12")], "symmetries": []}
    assert not is_wrong(check, [machine, {"network": "1~2; F1; S1"}], pairs)
    slow = machine | {"quantity": "velocity"}
    assert is_wrong(check, [slow, {"network": "1~2; F1; S1"}], pairs)
    drug = {"name": "drug", "flows": [[1, 2], [2, 0]], "input": [1], "output": [2]}
    found, wanted = check.verdict_model(drug), check.network("1>2, 2>0; in 1; out 2")
    assert found.elements == wanted.elements and found.fixed == wanted.fixed == 1


def test_a_theorem_is_one_on_the_same_quantity(check):
    models, theorem = [CHAIN, CHAIN], {"certainty": "theorem"}
    assert not is_wrong(check, models, SYMMETRY, **theorem)
    assert is_wrong(check, [CHAIN, CHAIN | {"sensor": "position"}], SYMMETRY, **theorem)
    assert check.replaceable(*[check.network("1~2; F1; S1")] * 2)
    other = check.network("1~2; F1; S1")._replace(order=0)
    assert not check.replaceable(check.network("1~2; F1; S1"), other)


def test_evidence_on_limits_shows_no_relation(check):
    larger = CHAIN | {"meas_plus": 2}
    ranks = {"kind": "too-large", "left": 7, "right": 7}
    bounded = {"certainty": "bounded", "safety": 120, "domain": "complex", "decided_by": "exact"}
    assert is_wrong(check, [CHAIN, larger], ranks, **bounded)


def is_inclusion_wrong(check, name, side, left, right, inclusion, e, certainty="proven"):
    """Return True if a statement on limits of a pair of chains in a file of this name is wrong."""
    table, told = check.Table(), {"inclusion": inclusion, "certainty": certainty, "evidence": e}
    told |= {"safety": 120 if certainty == "bounded" else 0, "reason": ""}
    models = [check.chain(*indices, "undamped" not in name) for indices in (left, right)]
    check.claim(table, "", side, told, check.pair_of(*models), "")
    return bool(table.wrong)


def test_degrees_exclude_a_limit_only_where_they_are_larger(check):
    """A mass more: the smaller chain is a limit of the larger one, though their degrees differ."""
    one, two = (1, 0, 0, 1, 0, 1), (2, 0, 0, 1, 0, 1)
    apart = (2, 0, 0, 1, 0, 2)
    for left, right, counts, is_wrong in (
        (one, two, ([0, 0], [2, 2]), True),
        (one, apart, ([0, 0], [0, 2]), True),
        (apart, two, ([0, 2], [2, 2]), True),
        ((3, 0, 0, 1, 0, 3), two, ([0, 4], [2, 2]), False),
    ):
        e = {"kind": "counts", "left": counts[0], "right": counts[1]}
        pair = check.pair_of(check.chain(*left, False), check.chain(*right, False))
        assert check.evidence(pair, e).status == check.CHECKED
        found = is_inclusion_wrong(check, "undamped", "closure", left, right, "neither", e)
        assert found == is_wrong


OF_ONE_SIDE = {"parts-inside", "full-image", "relative-degrees", "refuted", "fibre"}


@pytest.mark.parametrize("kind", ["damped", "undamped"])
def test_evidence_on_limits_says_nothing_on_finite_values(check, kind):
    """Of a shipped file, each statement put in the place of the other one."""
    lines = records(f"chains-3-{kind}")[1:]
    models = {r["model"]: (3, *r["indices"]) for r in lines if "model" in r}
    stated = [
        (models[r["left"]], models[r["right"]], side, told)
        for r in lines
        for side, told in r.get("inclusions", {}).items()
        if (told["evidence"] or {}).get("kind") in OF_ONE_SIDE
    ]
    assert len({told["evidence"]["kind"] for *_, told in stated}) > 1
    for left, right, side, told in stated:
        rest = left, right, told["inclusion"], told["evidence"], told["certainty"]
        other = {"closure": "image", "image": "closure"}[side]
        assert not is_inclusion_wrong(check, kind, side, *rest)
        assert is_inclusion_wrong(check, kind, other, *rest)


def test_signs_of_coefficients_with_a_common_factor_show_nothing(check):
    """The loose part 2~3 has no influence on the response, only on the determinants."""
    pair = check.pair_of(check.network("#~1, 2~3; F1; S1"), check.network("#~1, 1~2; F1; S1"))
    e = {"kind": "inequality", "domain": "positive", "left_given": True}
    assert check.evidence(pair, e | {"form": [[-1, "a6", "a6"]]}).status == check.SEARCH
    assert check.evidence(pair, e | {"form": [[1, "a6", "a6"]]}).status != check.CHECKED


def test_two_elements_of_one_name_are_no_model(check):
    for text in ("R1 1 2; R1 2 0", "1>2, 1>2; in 1; out 2", "R1-R1", "R1(R2,C1)", "R1--C1"):
        with pytest.raises(ValueError, match=r"one name|no circuit"):
            check.network(text)


def test_lag_and_dead_time_are_compared(check):
    m = check.chain(2, 0, 0, 1, 0, 2, True, (), True, True)
    p = check.prime_of("a lag")
    x = check.draw("a lag", m.names, p)
    assert check.value(m, x, 9, p) == check.value(m, x, 3, p, scale=2)
    assert check.agree(m, x, m, x, "a lag", p)
    for name in ("T1", "Td"):
        assert not check.agree(m, x, m, x | {name: x[name] + 1}, "a lag", p)


def test_a_rank_is_not_larger_than_the_number_of_parameters(check):
    """Two exponents are taken for one, so that the rank is not computed again, but it is bounded."""
    names = ["C1", "P1", "P2", "R1", "R2", "n1", "n2"]
    r = {"network": "R1-P1-p(R2,C1-P2)", "identifiability": {"levels": dict.fromkeys(names, "")}}
    r |= {"model": 1, "group": 0}
    for rank, is_wrong in ((7, False), (8, True), (3, True)):
        table = check.Table()
        r["identifiability"]["rank"] = rank
        check.network_record(table, "cells", "", r)
        assert bool(table.wrong) == is_wrong


@pytest.mark.parametrize("change", [
    {"sensor": "position"}, {"models": 4}, {"catalog": "chains-2-damped"}, {"n_masses": 3},
])  # fmt: skip
def test_lies_of_a_header_are_refused(check, tmp_path, change):
    head, *lines = records("chains-2-undamped")
    assert table_of(check, tmp_path, "chains-2-undamped", [head | change, *lines]).wrong


def test_the_certainty_of_a_rank_is_refused(check, tmp_path):
    for change in ({"rank_certainty": "bounded"}, {"rank_certainty": "x"}, {"safety": 120}):
        lines = changed(records("chains-2-undamped"), 1, lambda r, change=change: r.update(change))
        assert table_of(check, tmp_path, "chains-2-undamped", lines).wrong


def test_a_pair_is_as_another_only_where_networks_replace_each_other(check, tmp_path):
    """One pair's verdict stands for another: the other pair's networks can replace these."""
    name = "networks-compartments-3"
    head, *lines = records(name)
    places = {r["model"]: r for r in lines if "network" in r}
    pair = next(r for r in lines if "as" in r)
    group = places[pair["left"]]["group"]
    few = [r for r in places.values() if r["group"] == group]
    few += [r for r in lines if "left" in r and places[r["left"]]["group"] == group]
    lines = [head | {"models": len([r for r in few if "network" in r])}, *few]
    at = lines.index(pair)

    def count(lines):
        table = table_of(check, tmp_path, name, lines)
        return table.wrong, [row for key, row in table.counts.items() if key[2] == "as another"]

    wrong, rows = count(lines)
    assert not wrong and sum(row[check.SEARCH] for row in rows) == 0
    stranger = next(r for r in few if "complex" in r and {r["left"], r["right"]} != {*pair["as"]})
    ends = [stranger["left"], stranger["right"]]
    wrong, rows = count(changed(lines, at, lambda r: r.update({"as": ends})))
    assert wrong or sum(row[check.SEARCH] for row in rows) == 1
    other = next(r for r in places.values() if r["group"] != group)
    assert count(changed(lines, at, lambda r: r.update({"as": [other["model"]] * 2})))[0]


def some_candidates():
    head, *lines = records("candidates")
    few = [r for r in lines if r.get("model", r.get("left", 9)) <= 4 - ("left" in r)]
    cut = [r | {k: v[: 4 - r["left"]] for k, v in r.items() if k != "left"} if "left" in r else r
           for r in few]  # fmt: skip
    return [head | {"models": 4}, *cut]


@pytest.mark.parametrize("lie", [
    lambda r: r.update(relation="=" + r["relation"][1:]),
    lambda r: r.update(decided_by="1" + r["decided_by"][1:], left=2),
    lambda r: r.update(relation=r["relation"][1:]),
    lambda r: r.update(certainty=r["certainty"][1:]),
    lambda r: r.update(left=3),
])  # fmt: skip
def test_lies_of_candidates_are_refused(check, tmp_path, lie):
    lines = some_candidates()
    assert not table_of(check, tmp_path, "candidates", lines).wrong
    assert table_of(check, tmp_path, "candidates", changed(lines, 5, lie)).wrong


def test_a_settled_pair_stands_once(check, tmp_path):
    lines = records("settled-dampers")[:1]
    assert not table_of(check, tmp_path, "settled-dampers", lines).wrong
    assert table_of(check, tmp_path, "settled-dampers", [*lines, *lines]).wrong
