"""Rows of masses by the zeros of their numerators: identities, orbits, and answers against the
ideal of the whole fibre.
"""

from itertools import combinations
from math import prod

import pytest

from disting.algebra.groebner.modular import matrix, null_space, polynomial
from disting.algebra.sampling import prime, residues
from disting.errors import CatalogError
from disting.fibres.ideals import Limits, decide, generic_rank
from disting.fibres.ideals.fibre_ideal import evaluated
from disting.fibres.ideals.monic_map import monic_map
from disting.fibres.ideals.row_answers import (
    ROWS,
    false_answers,
    known_answers,
    line_of,
    read_answers,
)
from disting.fibres.ideals.splits import receptances
from disting.fibres.ideals.system import terms
from disting.fibres.ideals.zeros import (
    BITS,
    are_comparable,
    assignments,
    branches,
    equations,
    given_point,
    refute,
    safety_of_branches,
    zeros_are_free,
)
from disting.files import shipped_folder
from disting.model.chain import Chain
from disting.model.question import Membership
from disting.model.row import Row, rows_of

P = prime("test of zeros")
LONG = prime("test of zeros", BITS)


def all_rows(masses):
    ports = [(a, b) for a in range(1, masses + 1) for b in range(a, masses + 1)]
    return sorted(
        {
            Row(masses, grounded, *p, damped=True).canonical
            for grounded in (False, True)
            if grounded or masses > 1
            for p in ports
        }
    )


def chain(row):
    n, a, b = row.n_masses, row.a, row.b
    return (
        Chain(n + 1, n, a, n + 1, b, n + 1, damped=True)
        if row.grounded
        else Chain(n, 0, 0, a, 0, b, damped=True)
    )


def heads(found):
    return [found.parameters[h] for h in found.joints]


def at(polynomials, values, names, modulus):
    return polynomial(
        [evaluated(terms(c), [values[x] for x in names], modulus) for c in polynomials], modulus
    )


@pytest.mark.parametrize("row", [r for n in (1, 2, 3, 4) for r in all_rows(n)], ids=str)
def test_numerator_and_denominator_are_those_of_the_chain(row):
    found, whole = monic_map(row), receptances(chain(row).structure).named[0][1]
    values = dict(zip(found.parameters, residues(str(row), len(found.parameters), P), strict=True))
    there = (
        values
        | {f"u{h[1:]}": values[h] * values[f"e{h[1:]}"] % P for h in heads(found)}
        | {"g1": 1}
    )
    num, den = (
        at(some, there, whole.parameters, P) for some in (whole.numerator, whole.denominator)
    )
    zeros, poles = (
        at(some, values, found.parameters, P)
        for some in (found.whole.numerator, found.whole.denominator)
    )
    gain = prod(values[f"e{h[1:]}"] for h in heads(found)) % P
    assert (
        num * poles == gain * zeros * den
        or num * poles * polynomial([0, 0, 1], P) == gain * zeros * den
    )
    assert rows_of(chain(row).structure)[0] == row


def full(masses):
    return [
        r
        for r in all_rows(masses)
        if generic_rank(monic_map(r).whole, "test") == len(monic_map(r).parameters)
    ]


PAIRS = [
    p
    for n in (2, 3)
    for p in combinations(full(n), 2)
    if are_comparable(*p) and are_comparable(*p[::-1])
]


def test_some_pairs_can_be_compared():
    assert len(PAIRS) >= 2


@pytest.mark.parametrize("pair", PAIRS, ids=str)
def test_an_answer_is_that_of_the_whole_fibre(pair):
    maps = [monic_map(row).whole for row in pair]
    whole = decide(
        *maps, equal_rank=True, seed="test", limits=Limits(seconds=600, entries=10**8, safety=40)
    )
    assert whole.membership is not Membership.UNKNOWN
    for given, searched in (pair, pair[::-1]):
        assert (refute(given, searched, "test") is not None) == (
            whole.membership is Membership.EXCLUDED
        )


@pytest.mark.parametrize(
    "row",
    [Row(3, True, 1, 2, True), Row(4, True, 2, 4, True), Row(4, False, 1, 3, True)],
    ids=str,
)
def test_a_row_is_not_refuted_by_itself_and_its_own_branch_holds_the_point(row):
    found = monic_map(row)
    point = given_point(found, "test")
    own = next(
        b
        for b in branches(row, row)
        if b.heads == tuple(range(len(heads(found))))
        and set(b.left) == {len(b.heads) + k for k in range(len(b.left))}
    )
    label = next(
        f"zeros:test:{k}"
        for k in range(10**4)
        if _zeros_at(found, f"zeros:test:{k}", point.modulus) <= set(point.zeros)
    )
    q = residues(label, len(found.parameters), point.modulus)
    kept = [x for x, name in zip(q, found.parameters, strict=True) if name not in heads(found)]
    assert all(
        evaluated(tuple(g.items()), kept, point.modulus) == 0 for g in equations(point, found, own)
    )
    assert refute(row, row, "test") is None


def _zeros_at(found, label, modulus):
    values = dict(
        zip(found.parameters, residues(label, len(found.parameters), modulus), strict=True)
    )
    return {-values[h] % modulus for h in heads(found)}


def test_one_branch_of_each_orbit_speaks_for_all():
    given, searched = Row(3, True, 2, 3, True), Row(3, True, 1, 2, True)
    assert len(branches(given, searched)) < len(list(assignments(3, searched)))
    point = given_point(monic_map(given), "test")
    from disting.fibres.ideals.zeros import _basis

    size = len(monic_map(searched).parameters) - len(monic_map(searched).joints)
    found = {
        b: _basis(equations(point, monic_map(searched), b), size, point.modulus, 10**8).is_one
        for b in assignments(3, searched)
    }
    assert all(found.values()) == all(found[b] for b in branches(given, searched))


@pytest.mark.parametrize(
    "row",
    [Row(4, True, 2, 4, True), Row(5, True, 3, 4, True), Row(5, False, 2, 4, True)],
    ids=str,
)
def test_zeros_are_free_where_sympy_finds_the_whole_group(row):
    assert zeros_are_free(row)


@pytest.mark.parametrize("modulus", [P, LONG])
def test_null_space_is_orthogonal_and_complete(modulus):
    rows = [residues(f"row:{k}", 5, modulus) for k in range(2)]
    rows.append([(a + b) % modulus for a, b in zip(*rows, strict=True)])
    found = null_space(rows, modulus)
    assert len(found) == 3 and all(
        sum(a * b for a, b in zip(r, w, strict=True)) % modulus == 0 for r in rows for w in found
    )
    assert matrix(3, 5, [x for w in found for x in w], modulus).rank() == 3


def test_shipped_answers_have_their_bounds_and_read_back():
    known = known_answers()
    assert known and all(safety_of_branches(a.given, a.searched) >= 100 for a in known.values())
    assert all(pair == {a.given, a.searched} for pair, a in known.items())


def test_a_forged_or_damaged_answer_is_found(tmp_path):
    row, other = Row(4, True, 2, 4, True), Row(4, True, 1, 3, True)
    true = known_answers()[frozenset((row, other))]
    (tmp_path / ROWS).write_text(line_of(true))
    assert (
        read_answers(tmp_path) == {frozenset((row, other)): true}
        and false_answers(tmp_path, 4) == []
    )
    (tmp_path / ROWS).write_text(
        line_of(true).replace(f'"branches":{true.branches}', '"branches":1')
    )
    assert len(false_answers(tmp_path, 4)) == 1 and false_answers(tmp_path, 5) == []
    (tmp_path / ROWS).write_text(line_of(true)[:-9])
    with pytest.raises(CatalogError, match="rows"):
        read_answers(tmp_path)


@pytest.mark.slow
def test_every_shipped_answer_is_found_again():
    """Some minutes: all branches of all answers."""
    assert [wrong for n in range(1, 8) for wrong in false_answers(shipped_folder(), n)] == []
