"""Rows of masses: what a structure consists of, against matrices and against the chain's indices."""

from dataclasses import replace

import pytest
import sympy as sp

from disting import Chain, Family
from disting.errors import InputError
from disting.model.chain import Damper, GroundDamper, Ports, Spring
from disting.model.row import FREE, GROUNDED, Row, canonical_rows, grounded_and_free, rows_of

S = sp.Symbol("s")
CHAINS = [
    replace(chain, ground_dampers=dampers)
    for damped in (False, True)
    for chain in Family(3, damped)
    for dampers in ((), (1,), (2, 3))
]
ROWS = [
    Row(n, grounded, a, b, damped, dampers)
    for n in (1, 2, 3)
    for grounded in (False, True)
    for a in range(1, n + 1)
    for b in range(a, n + 1)
    for damped in (False, True)
    for dampers in ((), (1,), (n,))
]


def receptance(structure, act, meas):
    """Between two masses, by SymPy's determinants, all parameters distinct primes."""
    values = dict(zip(structure.parameters, map(sp.prime, range(1, 99)), strict=False))
    n, a = structure.n_masses, sp.zeros(structure.n_masses + 1)
    for e in structure.elements:
        term = values[e.parameter] * S ** {"m": 2, "d": 1, "b": 1, "k": 0}[e.kind]
        ends = (e.at, e.at + 1) if e.kind in "kd" else (e.at,)
        for i in ends:
            for j in ends:
                a[i, j] += term if i == j else -term
    a = a[1:, 1:]
    minor = a.minor_submatrix(act - 1, meas - 1).det() if n > 1 else sp.Integer(1)
    return sp.cancel((-1) ** (act + meas) * minor / a.det())


@pytest.mark.thin(1)
@pytest.mark.parametrize("row", ROWS, ids=str)
def test_degrees_and_poles_at_zero_are_those_of_the_receptance(row):
    found = receptance(row.structure, row.a, row.b)
    num, den = (sp.Poly(p, S) for p in sp.fraction(found))
    assert den.degree() - num.degree() == row.relative_degree
    step = 2 // row.q
    assert all(e % step == 0 for p in (num, den) for (e,) in p.monoms())
    free = not row.grounded
    assert min(e for (e,) in den.monoms()) == (row.poles_at_zero(2) if free else 0)
    # nothing cancels but for special values, and these are none
    assert (num.degree() // step, den.degree()) == (row.numerator_degree, 2 * row.n_masses)
    assert row.numerator_degree_in(2) == num.degree()


@pytest.mark.thin(1)
@pytest.mark.parametrize("row", ROWS, ids=str)
def test_a_row_is_found_again_in_its_structure(row):
    assert rows_of(row.structure) == (row,)
    assert row.mirrored.mirrored == row
    same = receptance(row.structure, row.b, row.a) == receptance(row.structure, row.a, row.b)
    assert same
    assert row.canonical in (row, row.mirrored)


@pytest.mark.thin(8)
@pytest.mark.parametrize("chain", CHAINS, ids=str)
def test_rows_hold_all_that_a_chain_consists_of(chain):
    rows = rows_of(chain.structure)
    assert [row.name for row in rows] == [GROUNDED, FREE][chain.gap == 0 :]
    assert [row.before for row in rows] == [0, chain.gap][chain.gap == 0 :]
    assert rows[-1].is_whole == (chain.gap == 0)
    parameters = [
        replace_number(e, row.before).parameter for row in rows for e in row.structure.elements
    ]
    assert sorted(parameters) == sorted(chain.parameters)
    *grounded, free = rows
    assert {free.a + chain.gap, free.b + chain.gap} == {chain.act_plus, chain.meas_plus}
    assert all(set(row.ports) == {chain.act_minus, chain.meas_minus} for row in grounded)
    assert grounded_and_free(chain.structure) == (grounded[0] if grounded else None, free)
    assert [*canonical_rows(chain.structure).values()] == [row.canonical for row in rows[::-1]]


def replace_number(element, before):
    return element._replace(at=element.at + before)


def test_one_free_mass_has_no_springs_and_so_no_dampers_beside_them():
    assert Row(1, False, 1, 1, damped=True) == Row(1, False, 1, 1)
    assert Row(1, True, 1, 1, damped=True) != Row(1, True, 1, 1)
    damped = Chain(2, 1, 1, 2, 1, 2, damped=True).structure
    assert [(row.damped, row.q) for row in rows_of(damped)] == [(True, 2), (False, 1)]


@pytest.mark.parametrize("arguments", [(2, True, 2, 1), (2, True, 0, 1), (2, False, 1, 3)])
def test_ports_outside_of_a_row_are_refused(arguments):
    with pytest.raises(InputError, match="ports"):
        Row(*arguments)


def test_ground_dampers_outside_of_a_row_are_refused():
    with pytest.raises(InputError, match="ground dampers"):
        Row(2, True, 1, 2, ground_dampers=(3,))


def test_structures_that_are_no_rows_with_two_ports_are_refused():
    chain = Chain(3, damped=True).structure
    broken = replace(chain, elements=tuple(e for e in chain.elements if e != Damper(1)))
    with pytest.raises(InputError, match="dampers beside all or none"):
        rows_of(broken)
    with pytest.raises(InputError, match="four ports"):
        rows_of(replace(chain, ports=Ports(1, 2, 1, 3)))


def test_rows_without_a_port_are_left_out():
    chain = Chain(3, ground_dampers=(3,), damped=False).structure
    split = replace(chain, elements=tuple(e for e in chain.elements if e != Spring(2)))
    assert GroundDamper(3) in split.elements
    assert rows_of(split) == (Row(2, False, 1, 1),)
