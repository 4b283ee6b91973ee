"""The canonical form of a matroid against all subsets of rows, tried one by one."""

from itertools import chain, combinations

import numpy as np
import pytest
from flint import nmod_mat
from hypothesis import given, settings, strategies as st

from disting.algebra.certainty import residues
from disting.algebra.matroid import (
    Component,
    Matroid,
    SearchTooLargeError,
    dependent_flats,
    matroid,
    rank_in,
    search_size,
    separating_rows,
)

P = 2**31 - 1
LIMIT = 10**6
many = settings(max_examples=60, deadline=None)
some = settings(max_examples=60, deadline=None)


def mat(rows, p=P):
    return nmod_mat(len(rows), len(rows[0]), [entry % p for row in rows for entry in row], p)


def rank(rows, chosen, p=P):
    return mat([rows[i] for i in chosen], p).rank() if chosen else 0


def subsets(n, sizes=None):
    return chain.from_iterable(
        combinations(range(n), k) for k in (range(n + 1) if sizes is None else sizes)
    )


def bases(rows, p=P):
    full = mat(rows, p).rank()
    return {s for s in combinations(range(len(rows)), full) if rank(rows, s, p) == full}


def form(rows, p=P):
    return matroid(mat(rows, p), LIMIT)


# --- matrices with all that can be special
# ---------------------------------------------------------------------------

entries = st.integers(-2, 2)


@st.composite
def plain(draw, max_rows=8, max_columns=4):
    n, k = draw(st.integers(1, max_rows)), draw(st.integers(1, max_columns))
    return draw(st.lists(st.lists(entries, min_size=k, max_size=k), min_size=n, max_size=n))


@st.composite
def blocks(draw):
    """Two blocks side by side: at least two components."""
    one, other = draw(plain(4, 3)), draw(plain(4, 3))
    width, rest = len(one[0]), len(other[0])
    rows = [row + [0] * rest for row in one] + [[0] * width + row for row in other]
    return draw(st.permutations(rows))


@st.composite
def repeated(draw):
    """Parallel rows, zero rows and sums of rows planted."""
    rows = draw(plain(4, 4))
    pick = st.sampled_from(rows)
    copies = [
        [draw(st.sampled_from([-1, 2, 3])) * e for e in draw(pick)]
        for _ in range(draw(st.integers(0, 2)))
    ]
    sums = [
        [a + b for a, b in zip(draw(pick), draw(pick), strict=True)]
        for _ in range(draw(st.integers(0, 2)))
    ]
    zeros = [[0] * len(rows[0])] * draw(st.integers(0, 1))
    return draw(st.permutations(rows + copies + sums + zeros))


matrices = st.one_of(plain(), blocks(), repeated())
primes = st.sampled_from([2, 3, 5, 7, P])

# --- ranks and bases
# -------------------------------------------------------------------------------------------------


@pytest.mark.full
@many
@given(matrices, primes)
def test_every_subset_has_its_rank(rows, p):
    m = form(rows, p)
    assert (m.size, m.rank) == (len(rows), mat(rows, p).rank())
    for s in subsets(len(rows)):
        assert rank_in(m, s) == rank(rows, s, p)


@pytest.mark.full
@many
@given(matrices, matrices, primes)
def test_forms_are_equal_exactly_if_the_bases_are(left, right, p):
    size = min(len(left), len(right))
    left, right = left[:size], right[:size]
    assert (form(left, p) == form(right, p)) == (bases(left, p) == bases(right, p))


@pytest.mark.full
@many
@given(matrices, st.data(), primes)
def test_one_changed_row_changes_the_form_exactly_if_it_changes_the_bases(rows, data, p):
    i = data.draw(st.integers(0, len(rows) - 1))
    other = list(rows)
    other[i] = data.draw(st.lists(entries, min_size=len(rows[0]), max_size=len(rows[0])))
    assert (form(rows, p) == form(other, p)) == (bases(rows, p) == bases(other, p))


@pytest.mark.full
@some
@given(matrices, st.data())
def test_other_coordinates_and_scaled_rows_have_the_same_form(rows, data):
    """A times an invertible matrix, and rows times numbers: the same matroid."""
    k = len(rows[0])
    lower = [[data.draw(entries) if j < i else int(i == j) for j in range(k)] for i in range(k)]
    upper = [[data.draw(entries) if j > i else int(i == j) for j in range(k)] for i in range(k)]
    factors = data.draw(st.lists(st.integers(1, P - 1), min_size=len(rows), max_size=len(rows)))
    scaled = [[factor * e for e in row] for factor, row in zip(factors, rows, strict=True)]
    moved = (mat(scaled) * mat(lower) * mat(upper)).tolist()
    assert form([[int(e) for e in row] for row in moved]) == form(rows)


@some
@given(matrices)
def test_more_columns_without_more_rank_change_nothing(rows):
    assert form([[*row, sum(row), 0] for row in rows]) == form(rows)


# --- the parts of the form
# -------------------------------------------------------------------------------------------


@some
@given(matrices, primes)
def test_components_partition_what_is_no_loop(rows, p):
    m = form(rows, p)
    inside = [i for c in m.components for i in c.rows]
    assert len(inside) == len(set(inside))
    assert set(range(len(rows))) - set(inside) == {
        i for i in range(len(rows)) if rank(rows, (i,), p) == 0
    }
    assert sum(c.rank for c in m.components) == m.rank
    assert all(c.rank == rank(rows, c.rows, p) for c in m.components)
    assert all(c.dual == (2 * c.rank > len(c.rows)) for c in m.components)


@some
@given(matrices, primes)
def test_components_cannot_be_split(rows, p):
    """A part and its complement in a component have more rank than the whole."""
    for c in form(rows, p).components:
        for size in range(1, len(c.rows)):
            for part in combinations(c.rows, size):
                rest = tuple(set(c.rows) - set(part))
                assert rank(rows, part, p) + rank(rows, rest, p) > c.rank


@some
@given(matrices, primes)
def test_dependences_state_the_true_rank(rows, p):
    for chosen, bound in form(rows, p).dependences():
        assert rank(rows, chosen, p) == bound


@pytest.mark.full
@many
@given(matrices, matrices, primes)
def test_dependences_fix_the_matroid(left, right, p):
    """If the right rows fulfil all that the left form states, and the left ones all of the
    right, then they are equal.
    """
    size = min(len(left), len(right))
    left, right = left[:size], right[:size]
    one, other = form(left, p), form(right, p)
    if one.rank != other.rank:
        return
    mutual = all(rank(right, s, p) <= b for s, b in one.dependences()) and all(
        rank(left, s, p) <= b for s, b in other.dependences()
    )
    assert mutual == (one == other)


@pytest.mark.full
@many
@given(matrices, st.data(), primes)
def test_separating_rows_have_different_ranks(rows, data, p):
    other = data.draw(st.permutations(rows))
    one, two = form(rows, p), form(other, p)
    if one != two:
        chosen = separating_rows(one, two)
        assert chosen == separating_rows(two, one)
        assert rank(rows, chosen, p) != rank(other, chosen, p)


def test_separating_rows_are_the_smallest_recorded():
    parallel = form([[1, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 1]])
    uniform = form([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 2, 3]])
    assert separating_rows(parallel, uniform) == (0, 1)


def test_relabelled_rows():
    m = form([[0, 0], [1, 0], [0, 0], [2, 0], [0, 1]])
    assert m.relabelled({1: 0, 3: 1, 4: 2}) == form([[1, 0], [2, 0], [0, 1]])


# --- literal examples
# ------------------------------------------------------------------------------------------------

FANO = [[(i >> b) & 1 for b in range(3)] for i in range(1, 8)]
LINES = [(0, 1, 2), (0, 3, 4), (0, 5, 6), (1, 3, 5), (1, 4, 6), (2, 3, 6), (2, 4, 5)]


def test_fano_plane():
    (component,) = form(FANO, 2).components
    assert component == Component(tuple(range(7)), 3, False, tuple((line, 2) for line in LINES))


@pytest.mark.parametrize("p", [3, 5, P])
def test_beyond_two_the_seventh_line_is_none(p):
    (component,) = form(FANO, p).components
    assert component.flats == tuple((line, 2) for line in LINES if line != (2, 4, 5))


def test_the_dual_of_the_fano_plane_is_found_in_the_dual():
    """[I A] of the plane gives rows [-A' I] of its dual, rank 4 of 7."""
    a = [[0, 1, 1, 1], [1, 0, 1, 1], [1, 1, 0, 1]]
    plane = [[int(i == j) for j in range(3)] for i in range(3)] + [
        [a[i][j] for i in range(3)] for j in range(4)
    ]
    dual = [[a[i][j] for j in range(4)] for i in range(3)] + [
        [int(i == j) for j in range(4)] for i in range(4)
    ]
    (one,), (other,) = form(plane, 2).components, form(dual, 2).components
    assert (one.rank, one.dual, other.rank, other.dual) == (3, False, 4, True)
    assert one.flats == other.flats
    assert len(one.flats) == 7


@pytest.mark.parametrize(("n", "k"), [(5, 2), (7, 3), (6, 3), (9, 4)])
def test_uniform_matroids_have_no_flats(n, k):
    (component,) = form([[pow(x, j) for j in range(k)] for x in range(1, n + 1)]).components
    assert component == Component(tuple(range(n)), k, False, ())


@pytest.mark.parametrize(("n", "k"), [(5, 3), (7, 5)])
def test_uniform_matroids_of_large_rank_are_kept_as_duals(n, k):
    (component,) = form([[pow(x, j) for j in range(k)] for x in range(1, n + 1)]).components
    assert component == Component(tuple(range(n)), k, True, ())


def test_loops_coloops_and_parallel_rows():
    m = form([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 3, 0], [0, 0, 1]])
    assert m == Matroid(
        5,
        3,
        (
            Component((1,), 1, True, ()),
            Component((2, 3), 1, False, ()),
            Component((4,), 1, True, ()),
        ),
    )
    assert form([[0, 0], [0, 0]]) == Matroid(2, 0, ())


def test_parallel_rows_inside_a_component_are_flats_of_rank_one():
    (component,) = form([[1, 0], [2, 0], [0, 1], [1, 1], [0, 5]]).components
    assert component.flats == (((0, 1), 1), ((2, 4), 1))


def test_64_rows_fit():
    rows = [[1, x, x * x] for x in range(1, 62)] + [[2, 4, 8], [3, 9, 27], [0, 0, 1]]
    (component,) = form(rows).components
    assert component.rows == tuple(range(64))
    assert ((1, 61), 1) in component.flats
    assert ((2, 62), 1) in component.flats


@pytest.mark.parametrize(("limit", "raises"), [(34, True), (35, False)])
def test_the_limit_counts_subsets_of_the_smaller_rank(limit, raises):
    rows = [[pow(x, j) for j in range(4)] for x in range(1, 8)]  # rank 4 of 7: C(7, 3) in the dual
    if raises:
        with pytest.raises(SearchTooLargeError, match="7 rows of rank 4"):
            matroid(mat(rows), limit)
    else:
        assert matroid(mat(rows), limit).rank == 4


# --- the flats of circuits
# -------------------------------------------------------------------------------------------


def circuits(rows, p, longest):
    """All smallest dependent sets of at most `longest` rows."""
    found = []
    for s in subsets(len(rows), range(1, longest + 1)):
        if rank(rows, s, p) == len(s) - 1 and all(
            rank(rows, t, p) == len(t) for t in combinations(s, len(s) - 1)
        ):
            found.append(s)
    return found


def closure_mask(rows, chosen, p):
    base = rank(rows, chosen, p)
    return sum(1 << i for i in range(len(rows)) if rank(rows, {*chosen, i}, p) == base)


@pytest.mark.full
@many
@given(matrices, primes)
def test_dependent_flats_are_the_spans_of_all_short_circuits(rows, p):
    reduced, k = mat(rows, p).transpose().rref()
    if k == 0:
        return
    table = np.array([[int(e) for e in row] for row in reduced.tolist()[:k]], dtype=np.uint64)
    spans = {(closure_mask(rows, c, p), len(c) - 1) for c in circuits(rows, p, k)}
    assert dependent_flats(table, p) == sorted(spans)


@pytest.mark.parametrize(
    "planted", [[(0, 1, 5)], [(3, 9, 14, 18, 20, 21, 23)], [(0, 1, 5), (2, 5, 8, 11, 14, 22, 23)]]
)
def test_planted_circuits_are_all_that_is_found_where_the_search_is_wide(planted):
    """24 columns of rank 7: 134,596 sets of 6, more than are kept at once. The last column of each
    circuit is the sum of its others, all else is random modulo a large prime.
    """
    numbers = iter(residues("wide", 24 * 7, P))
    rows = [[next(numbers) for _ in range(7)] for _ in range(24)]
    for *others, last in planted:
        rows[last] = [sum(column) % P for column in zip(*(rows[i] for i in others), strict=True)]
    (component,) = form(rows).components
    assert component.flats == tuple((c, len(c) - 1) for c in planted)


def test_search_size():
    assert search_size(3, 7) == 35
    assert search_size(0, 1) == 1
