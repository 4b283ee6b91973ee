"""Rows told apart by sharing out the numerator's roots: against plain SymPy, against models
that are known to be the same.
"""

from dataclasses import replace
from fractions import Fraction
from itertools import combinations, product

import pytest
import sympy

from disting import Family
from disting.algebra.certainty import prime, residues
from disting.algebra.groebner.modular import long_polynomial
from disting.catalogs.dampers import damper_catalog
from disting.conditions.rule import Outcome
from disting.decide.same.evidence_check import Witness
from disting.decide.same.exact import by_shares, exact_finding, recheck_shares
from disting.fibres.ideals import Limits, decide, tell_chains_apart
from disting.fibres.ideals.factored_map import row_factors, shared_fibre, values
from disting.fibres.ideals.fibre_ideal import generic_rank
from disting.fibres.ideals.shares import (
    _may_split,
    _splits,
    _transposes,
    is_symmetric,
    shares_by_type,
    tell_apart,
)
from disting.model.chain import Chain
from disting.model.question import Membership, Settings
from disting.model.row import Row, rows_of
from disting.model.symmetry import canonical

S = sympy.Symbol("s")


def model(name, damped=True):
    """A chain by its name, such as 5:59+b2, with dampers beside its springs or not."""
    head, *dampers = name.split("+")
    n, number = map(int, head.split(":"))
    return canonical(
        replace(Family(n, damped)[number], ground_dampers=tuple(int(b[1:]) for b in dampers))
    ).chain


def physical(structure, ends, numbers):
    """Stiffness matrix of a row from its elements, by SymPy, and its elements by kind and place."""
    first, last = ends
    size, matrix, found = last - first + 1, sympy.zeros(last - first + 1), {}
    for e, number in zip(structure.elements, numbers, strict=True):
        if not first <= e.at + (e.kind in "kd") <= last:
            continue
        found[e.kind, e.at] = number
        term = number * S ** {"m": 2, "d": 1, "b": 1, "k": 0}[e.kind]
        nodes = [k - first for k in ((e.at, e.at + 1) if e.kind in "kd" else (e.at,)) if k >= first]
        for i in nodes:
            for j in nodes:
                matrix[i, j] += term if i == j else -term
    assert matrix.shape == (size, size)
    return matrix, found


def unknowns(row, found, ports):
    """The map's unknowns from masses, springs and dampers, as its text says."""
    return [unknown(name[0], int(name[1:]), found, ports) for name in row.parameters]


def unknown(kind, i, found, ports):
    """One of them."""
    spring, damper = found.get(("k", i)), found.get(("d", i))
    left, right = found.get(("m", i)), found.get(("m", i + 1))
    if kind == "f":
        return found["b", i] / left
    if kind == "h":
        return spring / damper
    if kind == "x":
        return (damper or spring) / right
    near = right if (left is None or i >= ports[1]) else left
    if kind == "r":
        return near / (left if near is right else right)
    if kind == "u":
        return spring / near
    return (damper + (found.get(("b", i + 1), 0) if left is None else 0)) / near


@pytest.mark.thin(1)
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize(
    "name", ["2:2+b1", "3:2+b1+b3", "3:3+b2", "3:6+b1+b3", "3:8+b1+b2", "4:6+b4", "4:18+b2+b4"]
)
def test_the_map_is_the_receptance_as_sympy_inverts_the_matrix(name, damped):
    structure = model(name, damped).structure
    numbers = [sympy.Rational(x, 7) for x in residues(name, len(structure.elements), 97)]
    for place, ends in zip(rows_of(structure), structure.row_ends, strict=True):
        matrix, found = physical(structure, ends, numbers)
        ports = sorted(p for p in structure.ports if ends[0] <= p <= ends[1])
        ports = (ports[0], ports[-1])
        row = row_factors(place)
        point = [*(Fraction(int(x.p), int(x.q)) for x in unknowns(row, found, ports)), Fraction(1)]

        def at(polynomials, point=point):
            total = 0
            for power, p in enumerate(polynomials):
                for e, c in p.to_dict().items():
                    value = Fraction(int(c))
                    for x, k in zip(point, e, strict=True):
                        value *= x ** int(k)
                    total += sympy.Rational(value.numerator, value.denominator) * S**power
            return total

        inverse = matrix.inv()[ports[0] - ends[0], ports[1] - ends[0]]
        ratio = sympy.cancel(inverse * at(row.whole.denominator) / at(row.whole.numerator))
        assert ratio.is_number
        assert ratio > 0


@pytest.mark.full
def test_the_equations_hold_where_the_roots_are_shared_as_they_are():
    row = row_factors(*rows_of(model("4:6+b1").structure))
    modulus = prime("own share", 192)
    for draw in range(200):
        point = residues(f"own:{draw}", len(row.parameters), modulus)
        at = values(row, point, modulus)
        found = [[int(z) for z, _ in f.roots()] for f in (at.left, at.right)]
        if [len(f) for f in found] == [2, 2]:
            break
    types = [
        *((z, "joint") for z in at.joints),
        *((z, kind) for kind, f in zip("lr", found, strict=True) for z in f),
    ]
    own = [
        s
        for s in shares_by_type(types, 1, 2)
        if s.joints == at.joints and set(s.left) == set(found[0])
    ]
    assert len(own) == 1
    count, equations = shared_fibre(at, row, own[0], modulus)
    assert 0 < count < len(row.parameters)
    assert not any(list(e) == [(0,) * count] for e in equations)


@pytest.mark.full
@pytest.mark.parametrize(("damped", "pairs"), [(False, 36), (True, 58)])
def test_models_that_are_the_same_are_never_told_apart(damped, pairs):
    """All pairs of unequal canonical forms in a class of 3 masses with all sets of dampers."""
    found, tried = damper_catalog(3, damped=damped).found, 0
    for members in found.classes():
        forms = sorted({canonical(found.chains[i]).chain for i in members}, key=str)
        for a, b in combinations(forms, 2):
            tried += 1
            assert tell_chains_apart(a.structure, b.structure, "same") is None
    assert tried == pairs


@pytest.mark.full
@pytest.mark.parametrize(
    ("left", "right"), [("4:2+b1", "4:2+b2"), ("4:3+b1", "4:3+b2"), ("4:6+b1+b2", "4:2+b3+b4")]
)
def test_models_that_the_shipped_classes_tell_apart_are(left, right):
    a, b = model(left), model(right)
    told = tell_chains_apart(a.structure, b.structure, "apart")
    assert told is not None
    assert told[1] >= 100
    assert told[0].shares > 1


@pytest.mark.full
@pytest.mark.parametrize(
    ("left", "right"), [("5:59+b2", "5:59+b3"), ("5:15+b2", "5:15+b3"), ("5:60+b5", "5:65+b5")]
)
def test_five_masses_that_were_left_open_are_decided_by_the_part_that_differs(left, right):
    a, b = model(left), model(right)
    found = exact_finding(a, b, Settings())
    assert found.outcome is Outcome.FAILS
    assert found.safety >= 100
    assert found.evidence.part in ("grounded", "free")
    assert Witness().confirms(found.evidence, "fibre", a, b)
    assert not Witness().confirms(replace(found.evidence, part="another"), "fibre", a, b)
    assert not Witness().confirms(found.evidence, "fibre", a, a)


@pytest.mark.full
@pytest.mark.parametrize(
    ("left", "right", "part"),
    [("5:3+b1+b4", "5:3+b2+b4", ""), ("5:59+b1+b2+b3", "5:69+b1+b2+b4", "grounded")],
)
def test_rows_with_dampers_to_the_ground_alone_are_told_apart(left, right, part):
    a, b = model(left, False), model(right, False)
    found = by_shares(a, b, Settings())
    assert found.evidence.part == part
    assert found.safety >= 100
    assert recheck_shares(found.evidence, a, b, Settings()) == found
    assert Witness().confirms(found.evidence, "fibre", a, b)
    assert not Witness().confirms(found.evidence, "fibre", a, a)


def test_what_has_solutions_is_tried_once():
    """No larger matrices, no other direction."""
    a, b = (row_factors(rows_of(model(name, False).structure)[-1]) for name in ("3:3+b1", "3:3+b3"))
    tries = iter([(True, 10**6), (False, 10**6)])
    assert tell_apart(a, b, "same", tries) is None
    assert list(tries) == [(False, 10**6)]


def test_parts_are_not_compared_where_both_or_none_differ():
    a, b = (Chain(4, 2, 1, 3, p, q, damped=True).structure for p, q in ((1, 3), (2, 4)))
    assert tell_chains_apart(a, b, "both") is None
    assert tell_chains_apart(a, a, "none") is None


def test_a_power_that_is_a_transposition():
    assert _transposes((2,), ())
    assert _transposes((1, 2, 3), (3, 3, 1))
    assert not _transposes((2, 2), ())
    assert not _transposes((4,), ())
    assert not _transposes((1, 2), (2,))


def test_groups_of_rows_are_symmetric():
    assert is_symmetric(row_factors(*rows_of(model("5:2+b1").structure)), "six roots")
    assert is_symmetric(row_factors(*rows_of(model("5:8+b1").structure)), "two and two")


def of_one_kind(masses, damped):
    """Pairs of rows of equal rank and degrees, with one damper to the ground or, if damped, none."""
    ports = [(a, b) for a in range(1, masses + 1) for b in range(a, masses + 1)]
    dampers = [*[()] * damped, *((m,) for m in range(1, masses + 1))]
    found = product((False, True), ports, dampers)
    rows = sorted({Row(masses, wall, *p, damped, d).canonical for wall, p, d in found})
    maps = {row: row_factors(row) for row in rows}
    ranks = {row: generic_rank(m.whole, "test") for row, m in maps.items()}
    return [
        (maps[r], maps[s]) for r, s in combinations(rows, 2) if alike(r, ranks) == alike(s, ranks)
    ]


def alike(row, ranks):
    """What two rows that may be the same have in common."""
    return row.grounded, row.distance, len(row.ground_dampers), ranks[row]


@pytest.mark.full
@pytest.mark.parametrize(
    ("masses", "damped"),
    [(2, True), (2, False), *(pytest.param(3, x, marks=pytest.mark.slow) for x in (True, False))],
)
def test_rows_are_told_apart_where_the_ideal_of_the_whole_fibre_is_everything(masses, damped):
    limits, told = Limits(seconds=600, entries=10**8, safety=40), list[bool]()
    for left, right in of_one_kind(masses, damped):
        whole = decide(left.whole, right.whole, equal_rank=True, seed="test", limits=limits)
        told.append(whole.membership is Membership.EXCLUDED)
        assert whole.membership is not Membership.UNKNOWN
        assert (tell_apart(left, right, "test") is not None) == told[-1]
    assert 0 < sum(told) < len(told)


@pytest.mark.parametrize("degree", [1, 2, 3, 4])
def test_what_splits_is_what_has_as_many_linear_factors(degree):
    seen = set()
    for draw in range(200):
        f = long_polynomial([*residues(f"{degree}:{draw}", degree, 31), 1], 31)
        factors = f.factor()[1]
        seen.add(_splits(f, 31))
        assert _splits(f, 31) == all(g.degree() == e == 1 for g, e in factors)
        assert _may_split(f, 31) or not _splits(f, 31)
        distinct = all(e == 1 for _, e in factors)
        assert degree < 2 or _may_split(f, 31) == (distinct and (degree - len(factors)) % 2 == 0)
    assert seen == {True, False} or degree == 1
