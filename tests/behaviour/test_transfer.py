"""Transfer functions, Markov parameters and their derivatives against plain SymPy, and against
each other.

G(s) of a chain as a SymPy expression: against complex numbers, against a plain determinant,
and as a general model.
"""

from itertools import product
from random import Random
from types import SimpleNamespace

import numpy as np
import pytest
import sympy
from flint import fmpz_mpoly
from hypothesis import given, settings, strategies as st

from disting import Chain, Family, Model, Quantity, transfer_function
from disting.algebra.certainty import residues
from disting.algebra.symbols import coefficients
from disting.behaviour.chain_model import ChainModel, quotient
from disting.behaviour.sample import Representation, at_point, seen_at
from disting.behaviour.transfer import expand
from tests.laws.strategies import chains
from tests.oracles import sympy_twin as twin

S = sympy.Symbol("s")


def motion(chain, values, s, zero):
    """Dynamic stiffness of all masses, force, and sensor, from the definition: element by
    element, with a ground node.
    """
    n = chain.n_masses
    matrix = [[zero for _ in range(n + 1)] for _ in range(n + 1)]
    for i in range(1, n + 1):
        friction = values.get(f"b{i}", 0)
        matrix[i][i] += values[f"m{i}"] * s**2 + friction * s
    for i in range(n):
        if i == chain.gap:
            continue
        law = values[f"k{i}{i + 1}"] + values.get(f"d{i}{i + 1}", 0) * s
        for a, b, sign in ((i, i, 1), (i + 1, i + 1, 1), (i, i + 1, -1), (i + 1, i, -1)):
            matrix[a][b] += sign * law
    force, sensor = (
        [int(i == plus) - int(i == minus) for i in range(1, n + 1)]
        for plus, minus in ((chain.act_plus, chain.act_minus), (chain.meas_plus, chain.meas_minus))
    )
    return [row[1:] for row in matrix[1:]], force, sensor


@pytest.mark.full
@settings(max_examples=25, deadline=None)
@given(chains(max_masses=3, dead_time=True), st.integers(0, 10**6))
def test_at_random_numbers(chain, seed):
    draw = Random(seed)
    values = {name: draw.uniform(0.5, 2.0) for name in chain.parameters}
    s = complex(draw.uniform(0.1, 1.0), draw.uniform(0.1, 1.0))
    matrix, force, sensor = motion(chain, values, s, 0j)
    expected = (
        s**chain.quantity.order
        * np.array(sensor)
        @ np.linalg.solve(np.array(matrix), np.array(force, dtype=complex))
    )
    expected *= np.exp(-s * values.get("Td", 0.0)) / (1 + s * values.get("T1", 0.0))
    found = transfer_function(chain)
    assert found.free_symbols <= {
        S,
        *(sympy.Symbol(name, positive=True) for name in chain.parameters),
    }
    numbers = {sympy.Symbol(name, positive=True): value for name, value in values.items()}
    assert complex(found.subs(numbers).subs(S, s)) == pytest.approx(expected, rel=1e-9)


@pytest.mark.full
@pytest.mark.sampled(5)
@pytest.mark.parametrize(
    "chain",
    [
        *Family(2, damped=False),
        *Family(2, damped=True),
        *Family(3, damped=False),
        Chain(2, ground_dampers=(1, 2), lag=True, quantity="velocity", damped=False),
    ],
    ids=str,
)
def test_by_cramers_rule(chain):
    """Exactly: two determinants, written out."""
    values = {name: sympy.Symbol(name, positive=True) for name in chain.parameters}
    matrix, force, sensor = motion(chain, values, S, sympy.Integer(0))
    whole = sympy.Matrix(
        [[*row, -f] for row, f in zip(matrix, force, strict=True)] + [[*sensor, 0]]
    )
    expected = (
        S**chain.quantity.order
        * whole.det()
        / sympy.Matrix(matrix).det()
        / (1 + S * values.get("T1", 0))
    )
    assert sympy.cancel(transfer_function(chain) - expected) == 0


@pytest.mark.full
def test_lag_and_dead_time():
    m1, t1, td = sympy.symbols("m1 T1 Td", positive=True)
    chain = Chain(1, lag=True, dead_time=True, damped=False)
    assert sympy.simplify(transfer_function(chain) - sympy.exp(-S * td) / (m1 * (1 + t1 * S))) == 0


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    "chain",
    [*Family(3, damped=True), Chain(2, ground_dampers=(1,), lag=True, damped=False)],
    ids=str,
)
def test_read_again_it_is_the_model_of_the_chain(chain):
    assert Model.from_transfer_function(transfer_function(chain)) == Model.from_chain(chain)


P = twin.PRIME
THREE = [*Family(3, damped=False), *Family(3, damped=True)]
quick = settings(max_examples=40, deadline=None)
slower = settings(max_examples=12, deadline=None)


def point(chain):
    return residues(str(chain), len(chain.parameters), P)


def seen(chain, representation=Representation.TF, count=0):
    return seen_at(at_point(ChainModel(chain.structure), point(chain), P), representation, count)


def value(polynomial, numbers):
    """Value modulo P at numbers for s and the parameters."""
    total = 0
    for powers, factor in polynomial.to_dict().items():
        term = int(factor)
        for number, power in zip(numbers, powers, strict=True):
            term = term * pow(number, power, P) % P
        total += term
    return total % P


# --- against the oracle
# ----------------------------------------------------------------------------------------------


def as_fractions(chain):
    """The expanded coefficients b0.., a0.. divided by the leading one, as elements of the
    oracle's field.
    """
    field = twin.transfer_function(chain).numerator[0].field
    pair = expand(chain.structure)
    tops, bottoms = (
        [field.ring.from_dict(without_s(c)) for c in coefficients(part, "s")] for part in pair
    )
    *others, leading = bottoms
    return tuple(field(c) / field(leading) for c in tops), tuple(
        field(c) / field(leading) for c in others
    )


def without_s(polynomial):
    return {powers[1:]: int(number) for powers, number in polynomial.to_dict().items()}


def assert_equal_transfer_functions(chain):
    assert as_fractions(chain) == tuple(twin.transfer_function(chain))


def assert_equal_samples(chain, representation, count):
    one, other = (
        seen(chain, representation, count),
        twin.summary(chain, representation.value, count),
    )
    numbers = dict(zip(chain.parameters, point(chain), strict=True))
    assert list(one.values) == twin.values(other.entries, numbers)
    assert [list(row) for row in one.rows] == twin.jacobian(
        other.entries, chain.parameters, numbers
    ).to_Matrix().tolist()


@pytest.mark.thin(1)
@pytest.mark.parametrize("chain", THREE, ids=str)
def test_three_mass_transfer_functions_are_the_oracle_s(chain):
    assert_equal_transfer_functions(chain)


@pytest.mark.thin(1)
@pytest.mark.parametrize("chain", THREE, ids=str)
def test_three_mass_samples_are_the_oracle_s(chain):
    assert_equal_samples(chain, Representation.TF, 0)
    assert_equal_samples(chain, Representation.MARKOV, 6)


@pytest.mark.full
@slower
@given(chains())
def test_any_transfer_function_is_the_oracle_s(chain):
    assert_equal_transfer_functions(chain)


@pytest.mark.full
@slower
@given(chains(max_masses=3))
def test_any_sample_is_the_oracle_s(chain):
    assert_equal_samples(chain, Representation.TF, 0)
    assert_equal_samples(chain, Representation.MARKOV, 4)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_a_chain_without_gap_is_the_oracle_s(damped):
    """The third model of condition 9: force and sensor references inside the one block."""
    left, right = Chain(4, 1, 1, 3, 1, 4, damped=damped), Chain(4, 2, 1, 3, 1, 4, damped=damped)
    whole = left.structure.united(right.structure)
    assert len(whole.parameters) == (12 if damped else 8)
    plain = SimpleNamespace(
        **{
            f: getattr(left, f)
            for f in ("act_minus", "act_plus", "meas_minus", "meas_plus", "quantity")
        }
    )
    plain.n_masses, plain.gap, plain.damped, plain.ground_dampers, plain.lag = (
        4,
        -1,
        damped,
        (),
        False,
    )
    plain.parameters = whole.parameters
    numbers = residues("whole", len(whole.parameters), P)
    found = seen_at(at_point(ChainModel(whole), numbers, P), Representation.TF, 0)
    entries = twin.summary(plain).entries
    named = dict(zip(whole.parameters, numbers, strict=True))
    assert list(found.values) == twin.values(entries, named)
    assert [list(row) for row in found.rows] == twin.jacobian(
        entries, whole.parameters, named
    ).to_Matrix().tolist()


# --- against the definition (32), by numbers
# -------------------------------------------------------------------------


def markov_by_definition(chain, count):
    """G_0 = D, G_i = C A^(i-1) B modulo P."""
    inverted = [
        pow(x, -1, P) if name[0] in "mT" else x
        for name, x in zip(chain.parameters, point(chain), strict=True)
    ]
    a, column, c, d = (
        [[poly_value(entry, inverted) for entry in row] for row in part.to_list()]
        for part in twin.polynomial_form(chain)
    )
    found = [d[0][0]]
    for _ in range(count):
        found.append(product_of(c, column)[0][0])
        column = product_of(a, column)
    return found


def poly_value(entry, numbers):
    return (
        entry
        if isinstance(entry, int)
        else twin._value(entry, dict(zip(map(str, entry.ring.symbols), numbers, strict=True)))
    )


def product_of(left, right):
    return [
        [
            sum(x * y for x, y in zip(row, column, strict=True)) % P
            for column in zip(*right, strict=True)
        ]
        for row in left
    ]


@pytest.mark.full
@settings(max_examples=20, deadline=None)
@given(chains())
def test_markov_parameters_are_powers_of_the_system_matrix(chain):
    assert list(seen(chain, Representation.MARKOV, 11).values) == markov_by_definition(chain, 11)


# --- against each other
# ----------------------------------------------------------------------------------------------


def series(top, bottom, count):
    """G_0..G_count of top/bottom, coefficients (value, derivatives..) from low to high, the
    leading one being 1, at infinity: sum_j a_(m-j) G_(i-j) = b_(m-i).
    """
    m, width = len(bottom), len(bottom[0]) if bottom else len(top[0])
    found = []
    for i in range(count + 1):
        entry = list(top[m - i]) if 0 <= m - i < len(top) else [0] * width
        for j in range(1, min(i, m) + 1):
            entry = [e - d for e, d in zip(entry, times(bottom[m - j], found[i - j]), strict=True)]
        found.append([e % P for e in entry])
    return found


def times(left, right):
    """Product rule on (value, derivatives..)."""
    return [
        left[0] * right[0],
        *(left[0] * y + x * right[0] for x, y in zip(left[1:], right[1:], strict=True)),
    ]


@pytest.mark.full
@quick
@given(chains(max_masses=6))
def test_markov_parameters_and_their_derivatives_are_the_series_at_infinity(chain):
    tf, expansion = seen(chain), seen(chain, Representation.MARKOV, 14)
    rows = [[v, *row] for v, row in zip(tf.values, tf.rows, strict=True)]
    cut = sum(label.startswith("b") for label in tf.labels)
    expected = series(rows[:cut], rows[cut:], 14)
    assert [[v, *row] for v, row in zip(expansion.values, expansion.rows, strict=True)] == expected


@pytest.mark.full
@quick
@given(chains(max_masses=5))
def test_derivatives_are_those_of_the_expanded_formulas(chain):
    """(c/l)' = (c' l - c l')/l^2 for each coefficient c and the leading one l."""
    tops, bottoms = (coefficients(part, "s") for part in expand(chain.structure))
    tf = seen(chain)
    *others, leading = bottoms
    numbers = [0, *point(chain)]
    bottom, inverse = value(leading, numbers), pow(value(leading, numbers), -2, P)
    for row, c in zip(tf.rows, [*tops, *others], strict=True):
        top = value(c, numbers)
        slopes = [
            (value(c.derivative(i), numbers), value(leading.derivative(i), numbers))
            for i in range(1, len(numbers))
        ]
        assert list(row) == [(up * bottom - top * down) * inverse % P for up, down in slopes]


@quick
@given(chains(max_masses=6, dead_time=True))
def test_labels_count_the_degrees(chain):
    q, tf = quotient(chain.structure, point(chain), P), seen(chain)
    n, m = q.num.degree(), q.den.degree()
    delay = ("Td",) * chain.dead_time
    assert tf.labels == (*(f"b{i}" for i in range(n + 1)), *(f"a{i}" for i in range(m)), *delay)
    assert len(tf.values) == len(tf.rows) == len(tf.labels)
    assert q.den[m] == 1
    assert n <= m


def test_a_dead_time_is_one_more_invariant():
    plain, delayed = (Chain(2, damped=True, dead_time=on) for on in (False, True))
    numbers = point(delayed)
    for representation, count in ((Representation.TF, 0), (Representation.MARKOV, 3)):
        one = seen_at(at_point(ChainModel(plain.structure), numbers[:-1], P), representation, count)
        other = seen_at(at_point(ChainModel(delayed.structure), numbers, P), representation, count)
        assert other.labels == (*one.labels, "Td")
        assert other.values == (*one.values, numbers[-1])
        assert other.rows == (*((*row, 0) for row in one.rows), (0, 0, 0, 0, 1))


# --- lowest terms and degrees
# ----------------------------------------------------------------------------------------


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    "chain", [*THREE, *Family(4, damped=False), *Family(4, damped=True)], ids=str
)
def test_numerator_and_denominator_are_coprime(chain):
    num, den = expand(chain.structure)
    assert isinstance(num, fmpz_mpoly)
    assert num.gcd(den).total_degree() == 0


@quick
@given(chains(max_masses=8))
def test_only_powers_of_s_cancel(chain):
    """The degrees at a point are those of the formulas before any other cancellation."""
    q = quotient(chain.structure, point(chain), P)
    assert q.num.gcd(q.den).degree() == 0
    assert int(q.num[0]) or int(q.den[0])
    mass_states = 2 * chain.n_masses + chain.lag
    assert q.den.degree() <= mass_states


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("chain", "degrees"),
    [
        (Chain(1, damped=False), (0, 0)),
        (Chain(1, quantity="velocity", damped=False), (0, 1)),
        (Chain(1, quantity="position", damped=False), (0, 2)),
        (Chain(1, ground_dampers=(1,), damped=False), (1, 1)),
        (Chain(1, lag=True, damped=False), (0, 1)),
        (Chain(2, damped=False), (2, 2)),
        (Chain(2, meas_plus=2, damped=True), (1, 2)),
        (Chain(2, 1, 1, 2, 1, 2, damped=False), (2, 2)),
        (Chain(2, 1, 1, 2, 1, 2, quantity="position", damped=False), (2, 4)),
        (Chain(3, meas_plus=3, damped=True), (2, 4)),
        (Chain(3, meas_plus=3, damped=True, ground_dampers=(3,)), (3, 5)),
    ],
    ids=str,
)
def test_degrees(chain, degrees):
    q = quotient(chain.structure, point(chain), P)
    assert (q.num.degree(), q.den.degree()) == degrees


@pytest.mark.parametrize("n_masses", [1, 2, 3, 5])
@pytest.mark.parametrize(("sensor", "shift"), [(Quantity.VELOCITY, 1), (Quantity.POSITION, 2)])
def test_other_sensors_shift_the_markov_parameters(n_masses, sensor, shift):
    """Section 5.2: "shifted by one (two)"."""
    chain = Chain(n_masses, meas_plus=n_masses, damped=True)
    other = Chain(n_masses, meas_plus=n_masses, damped=True, quantity=sensor)
    long = seen_at(
        at_point(ChainModel(other.structure), point(chain), P), Representation.MARKOV, 10
    )
    short = seen_at(
        at_point(ChainModel(chain.structure), point(chain), P), Representation.MARKOV, 10 - shift
    )
    assert long.values == (0,) * shift + short.values
    assert long.rows[shift:] == short.rows


def test_the_transfer_function_of_two_masses_written_out():
    """Force and sensor at mass 1 of a free pair: (m2 s^2 + d s + k)/(m1 m2 s^2 + (m1 + m2)(d s
    + k)), by hand.
    """
    found = [
        [str(c) for c in coefficients(part, "s")]
        for part in expand(Chain(2, damped=True).structure)
    ]
    assert found == [["k12", "d12", "m2"], ["m1*k12 + m2*k12", "m1*d12 + m2*d12", "m1*m2"]]


@pytest.mark.parametrize(("free", "grounded"), list(product((1, 2), repeat=2)))
def test_with_a_gap_the_two_parts_add(free, grounded):
    """G = response of the free row + response of the grounded row, each as if alone (values
    at a point).
    """
    n = free + grounded
    chain = Chain(n, grounded, grounded, n, 1, n, damped=True, quantity="position")
    q = quotient(chain.structure, point(chain), P)
    numbers = dict(zip(chain.parameters, point(chain), strict=True))
    s = 12345
    stiffness = {
        i: numbers[f"k{i}{i + 1}"] + s * numbers[f"d{i}{i + 1}"] for i in range(n) if i != grounded
    }
    inertia = {i: numbers[f"m{i}"] * s * s for i in range(1, n + 1)}
    low = [inertia[i] + stiffness.get(i - 1, 0) + stiffness.get(i, 0) for i in range(1, n + 1)]
    parts = one_part(low[:grounded], stiffness.get(1), 0, grounded - 1)
    parts += one_part(low[grounded:], stiffness.get(n - 1), free - 1, free - 1)
    assert int(q.num(s)) * pow(int(q.den(s)), -1, P) % P == parts % P


def one_part(diagonal, coupling, row, column):
    """Entry of the inverse of a 1 x 1 or 2 x 2 symmetric matrix, modulo P."""
    if len(diagonal) == 1:
        return pow(diagonal[0], -1, P)
    determinant = diagonal[0] * diagonal[1] - coupling * coupling
    adjugate = [[diagonal[1], coupling], [coupling, diagonal[0]]]
    return adjugate[row][column] * pow(determinant, -1, P)
