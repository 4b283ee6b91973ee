"""Limits of rows of masses: the list, its check in exact numbers, and SymPy's own limits."""

from dataclasses import replace

import pytest
import sympy as sp

from disting import Chain, Family
from disting.decide.inclusion.limits import (
    INFINITE,
    ZERO,
    follows,
    is_limit,
    reach,
    specialise,
)
from disting.model.chain import Spring
from disting.model.row import FREE, GROUNDED, Row, canonical_rows

S = sp.Symbol("s")
ROWS = [
    Row(2, False, 1, 2),
    Row(3, False, 2, 3, True),
    Row(3, True, 1, 3),
    Row(3, True, 2, 2, True, (1, 3)),
    Row(3, False, 2, 2, False, (3,)),
]


def receptance(row, p):
    """Receptance in SymPy, from the equation of motion written down entry by entry."""
    n = row.n_masses
    a = sp.zeros(n, n)
    for i in range(1, n + 1):
        a[i - 1, i - 1] += p[f"m{i}"] * S**2 + p.get(f"b{i}", 0) * S
    for i in range(n):
        w = p.get(f"k{i}{i + 1}", 0) + p.get(f"d{i}{i + 1}", 0) * S
        for r, c, sign in ((i, i, 1), (i - 1, i - 1, 1), (i, i - 1, -1), (i - 1, i, -1)):
            if r >= 0 and c >= 0:
                a[r, c] += sign * w
    return sp.cancel(a.adjugate()[row.b - 1, row.a - 1] / a.det(method="berkowitz"))


def moved(row, s, numbers):
    """The new row's parameters, by hand: what meets is added, what loses an end is left out."""
    out = dict.fromkeys(s.row.structure.parameters, 0)
    for name, value in numbers.items():
        kind, at = name[0], int(name[1])
        if name == s.element.parameter or (
            isinstance(s.element, Spring) and kind == "d" and at == s.element.at
        ):
            continue
        if kind in "mb":
            new = f"{kind}{s.nodes[at]}"
        else:
            ends = [s.nodes[at], s.nodes[at + 1]]
            new = "" if None in ends or ends[0] == ends[1] else f"{kind}{min(ends)}{max(ends)}"
        if new in out:
            out[new] += value
    return out


@pytest.mark.full
@pytest.mark.sampled(2)
@pytest.mark.parametrize("row", ROWS)
def test_limits_against_sympy(row):
    """The limit of the transfer function is of the form of the new row's, for chosen parameters."""
    numbers = {name: sp.Integer(2 + i * i) for i, name in enumerate(row.structure.parameters)}
    w = sp.Symbol("w", positive=True)
    for s in specialise(row):
        name = s.element.parameter
        values = numbers | {name: w} | ({"d" + name[1:]: 0} if name[0] == "k" else {})
        found = sp.limit(receptance(row, values), w, sp.oo if s.limit == INFINITE else 0)
        assert sp.simplify(found - receptance(s.row, moved(row, s, numbers))) == 0
        assert is_limit(row, s)


def test_the_limits_of_a_free_row_of_three():
    """Force at mass 1, sensor at mass 2: springs between, the end let go, the end held fast."""
    found = {
        (s.step, s.row.n_masses, s.row.grounded, s.row.a, s.row.b)
        for s in specialise(Row(3, False, 1, 2))
    }
    assert found == {
        (("k12", INFINITE), 2, False, 1, 1),
        (("k23", INFINITE), 2, False, 1, 2),
        (("k23", ZERO), 2, False, 1, 2),
        (("m3", INFINITE), 2, True, 1, 2),
    }


def test_a_grounded_row_is_let_go_and_a_damper_vanishes():
    row = Row(1, True, 1, 1, True, (1,))
    assert {(s.step, s.row) for s in specialise(row)} == {
        (("k01", ZERO), Row(1, False, 1, 1, True, (1,))),
        (("b1", ZERO), Row(1, True, 1, 1, True)),
    }


@pytest.mark.parametrize("row", ROWS)
def test_every_way_checks_again_and_leads_to_one_row(row):
    start = row.canonical
    for below, steps in reach(start).items():
        assert follows(start, steps) >= {below}
        assert below == below.canonical and below.n_masses <= row.n_masses
    assert reach(start)[start] == ()


def test_false_limits_are_seen():
    row = Row(2, False, 1, 1)
    rigid = next(
        s for s in specialise(row) if s.limit == INFINITE and isinstance(s.element, Spring)
    )
    assert is_limit(row, rigid)
    assert not is_limit(row, replace(rigid, limit=ZERO))
    assert not is_limit(row, replace(rigid, row=Row(1, True, 1, 1)))
    assert not is_limit(row, replace(rigid, nodes=(0, 1, None)))
    assert follows(row, (("k12", INFINITE), ("k12", INFINITE))) == set()
    assert follows(row, (("k01", INFINITE),)) == set()


@pytest.mark.parametrize("damped", [False, True])
def test_rows_add_up_to_the_chain(damped):
    """The receptance at s = 2 of a chain, with unit masses and different springs, is the sum of
    its rows'.
    """
    for chain in (*Family(2, damped), *Family(3, damped)):
        rows = canonical_rows(chain.structure)
        assert list(rows) == [FREE, GROUNDED][: 2 if chain.gap else 1]
        assert sum(row.n_masses for row in rows.values()) == chain.n_masses
        assert (rows[FREE].grounded, GROUNDED in rows) == (False, chain.gap > 0)
        assert all(row.canonical == row for row in rows.values())
    grounded = canonical_rows(
        Chain(4, 2, 2, 3, 1, 4, ground_dampers=(1, 4), damped=False).structure
    )
    assert grounded == {
        FREE: Row(2, False, 1, 2, False, (1,)),
        GROUNDED: Row(2, True, 1, 2, False, (1,)),
    }
