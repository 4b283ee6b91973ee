"""Models from matrices, lists and expressions: literal transfer functions, SymPy as oracle,
refusals.
"""

import pickle
from copy import copy
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings, strategies as st

from disting import Chain, Family, InputError, Relation, compare
from disting.general.matrix_model import Model

k12, k21, k01, k02 = sp.symbols("k12 k21 k01 k02")
NAMES = "abcd"


def as_sympy(model):
    """The transfer function of a model, read back from its text by SymPy."""
    return sp.sympify(str(model).removeprefix("G(s) = "), locals={"s": sp.Symbol("s")})


def test_two_compartments():
    model = Model.from_state_space([["-k12-k01", 0], ["k12", "-k02"]], ["1", "0"], [0, 1])
    assert model.parameters == ("k01", "k02", "k12")
    assert str(model) == "G(s) = k12/(k01*k02 + k02*k12 + (k01 + k02 + k12)*s + s**2)"
    assert model.degrees == (0, 2)
    assert model.n_states == 2


@pytest.mark.parametrize(
    ("b", "c", "d"),
    [
        ([1, 0], [0, 1], 0),
        ([[1], [0]], [[0, 1]], [[0]]),
        (sp.Matrix([1, 0]), sp.Matrix([[0, 1]]), sp.zeros(1)),
        (np.array([1.0, 0.0]), np.array([[0, 1]]), np.zeros((1, 1))),
        ((Fraction(1), 0), (0, sp.Integer(1)), "0"),
    ],
)
def test_matrices_may_be_written_in_many_ways(b, c, d):
    a = sp.Matrix([[-k12 - k01, k21], [k12, -k21]])
    expected = Model.from_state_space([["-k12-k01", "k21"], ["k12", "-k21"]], [1, 0], [0, 1])
    assert Model.from_state_space(a, b, c, d) == expected
    assert Model.from_state_space(a.tolist(), b, c, d) == expected


entry = st.sampled_from(
    ["0", "0", "1", "-2", *NAMES, "-a", "a+b", "b/c", "1/(a-2)", "3*a*c/4", "d**2", "(a+1)/(b+1)"]
)


@pytest.mark.full
@given(st.data(), st.integers(1, 3))
@settings(max_examples=25, deadline=None)
def test_state_space_against_sympy_at_rational_points(data, n):
    shapes = ((n, n), (n, 1), (1, n), (1, 1))
    texts = [
        [[data.draw(entry) for _ in range(columns)] for _ in range(rows)]
        for rows, columns in shapes
    ]
    point = {name: sp.Rational(data.draw(st.integers(15, 99)), 7) for name in NAMES} | {
        "s": sp.Rational(1001, 13)
    }
    numbers = [
        sp.Matrix(rows).applyfunc(lambda text: sp.sympify(text).subs(point)) for rows in texts
    ]
    a, b, c, d = numbers
    expected = (c * (point["s"] * sp.eye(n) - a).LUsolve(b) + d)[0]
    if expected == 0 or not any(
        name in text for rows in texts for row in rows for text in row for name in NAMES
    ):
        with pytest.raises(InputError):
            Model.from_state_space(*texts)
        return
    model = Model.from_state_space(*texts)
    assert as_sympy(model).subs(point) == expected


def test_lists_fall_as_in_scipy():
    assert Model.from_transfer_function([1, "b"], ["m", "d", "k"]) == Model.from_transfer_function(
        "s + b", "m*s**2 + d*s + k"
    )


def test_expressions_and_texts_and_polynomials_agree():
    s, k, m = sp.symbols("s k m")
    written = Model.from_transfer_function("k", "m*s**2 + k")
    assert Model.from_transfer_function(k, m * s**2 + k) == written
    assert Model.from_transfer_function(sp.Poly(k, s), sp.Poly(m * s**2 + k, s)) == written
    assert Model.from_transfer_function(1, m / k * s**2 + 1) == written


def test_one_expression_is_a_whole_transfer_function():
    s, k, m = sp.Symbol("s"), *sp.symbols("k m", positive=True)
    assert Model.from_transfer_function(k / (m * s**2 + k) - 1) == Model.from_transfer_function(
        "-m*s**2", "m*s**2 + k"
    )
    assert Model.from_transfer_function("k/(m*s**2 + k)") == Model.from_transfer_function(
        k, m * s**2 + k
    )
    matrix = sp.ImmutableMatrix([[0, 1], [-k / m, 0]])
    space = Model.from_state_space(
        matrix, sp.SparseMatrix([0, 1 / m]), sp.ImmutableMatrix([[k, 0]]), sp.Integer(0), s=s
    )
    assert space == Model.from_transfer_function(k / (m * s**2 + k))
    with pytest.raises(InputError, match="not a rational expression"):
        Model.from_transfer_function(sp.exp(-s) / (s + k))


@pytest.mark.full
def test_symbols_that_only_look_alike_are_refused():
    """SymPy computes with them as two; as one parameter they would make another model."""
    k, other, s = sp.Symbol("k"), sp.Symbol("k", positive=True), sp.Symbol("s")
    with pytest.raises(InputError, match="two different symbols are called 'k'"):
        Model.from_transfer_function(k / (s + other))
    with pytest.raises(InputError, match="two different symbols are called 'k'"):
        Model.from_state_space(sp.Matrix([[-k]]), [other], ["k"])
    with pytest.raises(InputError, match="two different symbols are called 's'"):
        Model.from_transfer_function(1 / (sp.Symbol("s", real=True) + k), s=s)
    with pytest.raises(InputError, match="two different symbols are called 'x'"):
        Model.from_transfer_function([sp.Dummy("x")], [1, sp.Dummy("x")])
    assert Model.from_transfer_function(other, ["1", other], s=s).parameters == ("k",)
    for _ in range(3000):
        k = sp.Add(sp.Mul(k, s, evaluate=False), 1, evaluate=False)
    # before its symbols are looked for, by recursion
    with pytest.raises(InputError, match="nested too deeply"):
        Model.from_transfer_function(1, k)


@pytest.mark.parametrize(
    ("num", "den", "text"),
    [
        ("1 - k*s", "s + k", "(1 - k*s)/(k + s)"),
        (
            "2*k*s**2/3 - 1/7",
            "k*m*s**3 + s**2*(k - m) - 5*s + 1",
            "(-3 + 14*k*s**2)/(21 - 105*s + (21*k - 21*m)*s**2 + 21*k*m*s**3)",
        ),
        ("k*m*s", "2*s + 1", "k*m*s/(1 + 2*s)"),
        ("k + 1", "7*(m + n)", "(k + 1)/(7*m + 7*n)"),
        ("2*s", "-k*s**2", "-2/(k*s)"),
        ("k*m", "s**2*(k - m)*(k + m)", "k*m/((k**2 - m**2)*s**2)"),
        ("k", "3", "k/3"),
    ],
)
def test_a_model_is_written_as_it_can_be_read_again(num, den, text):
    model = Model.from_transfer_function(num, den)
    assert str(model) == f"G(s) = {text}"
    assert Model.from_transfer_function(text) == model


def test_another_frequency_variable():
    z, s = sp.symbols("z s")
    model = Model.from_transfer_function(s, z + s, s=z)
    assert model.parameters == ("s",)
    assert model.n_states == 1
    assert Model.from_state_space([["-s"]], ["s"], [1], s="z") == model


def test_common_factors_are_cancelled_and_the_sign_is_fixed():
    plain = Model.from_transfer_function("k", "s + k")
    assert Model.from_transfer_function("-6*k*(s + p)", "-6*(s + p)*(s + k)").numerator_terms == (
        (((1, 0), 1),),
    )  # p is kept as a parameter, though nothing depends on it
    assert Model.from_transfer_function("-6*k*(s + k)", "-6*(s + k)*(s + k)") == plain
    unobservable = Model.from_state_space([["-k", 0], ["k", "-2*k"]], ["k", 0], [1, 0])
    assert unobservable == plain


def test_whole_floats_and_decimal_texts_are_exact():
    model = Model.from_transfer_function([2.0], ["0.1", "1e-1 + k"])
    assert str(model) == "G(s) = 20/(10*k + 1 + s)"


def test_models_are_values():
    one, other = (
        Model.from_transfer_function("k", "s + k", name=name) for name in ("one", "other")
    )
    assert one == other and hash(one) == hash(other) and len({one, other}) == 1
    assert pickle.loads(pickle.dumps(one)) == one
    assert one != Model.from_transfer_function("q", "s + q")
    assert [str(p) for p in one.denominator] == ["k", "1"] and [str(p) for p in one.numerator] == [
        "k"
    ]
    with pytest.raises(AttributeError):
        one.name = "third"


@pytest.mark.parametrize(
    "chain",
    [
        *Family(2, damped=True),
        Chain(2, ground_dampers=(1, 2), lag=True, damped=False),
        Chain(3, quantity="position", damped=False),
    ],
)
def test_chains_become_models(chain):
    model = Model.from_chain(chain)
    assert model.parameters == tuple(sorted(chain.parameters))
    assert model.n_states <= chain.structure.n_states


def test_what_was_made_of_a_chains_model_is_not_taken_for_the_chain():
    """Here it has the transfer function of another chain."""
    one, other = (Model.from_chain(chain) for chain in (Chain(2), Chain(2, meas_plus=2)))
    fields = ("parameters", "numerator_terms", "denominator_terms")
    made = replace(one, **{name: getattr(other, name) for name in fields})
    assert made == other and made.chain is None and one.chain == Chain(2)
    assert compare(made, Chain(2, meas_plus=2)).relation is Relation.INDISTINGUISHABLE
    assert pickle.loads(pickle.dumps(one)).chain == copy(one).chain == Chain(2)


A, B, C = [["-k"]], [1], [1]
BAD_SPACES = {
    "A is square, not 2 x 1": ([["k"], ["k"]], [1, 0], [1, 0]),
    "A is a matrix: a list of rows": (["k", "k"], [1, 0], [1, 0]),
    "A is square, not 2 x 2": ([["k", "1"], ["k"]], [1, 0], [1, 0]),
    "B is 1 x 1 .*, not 2 x 1": (A, [1, 0], C),
    "these are 1 outputs and 2 inputs: .* MatrixModel": (A, [[1, 0]], C),
    "these are 2 outputs and 1 inputs: .* MatrixModel": (A, B, [[1], [0]]),
    "C is 1 x 1 .*, not 0 x 0": (A, B, []),
    "D is 1 x 1 .*, not 1 x 2": (A, B, C, [[0, 0]]),
    "0.1 is a float, which is not exact; write it as text": ([[-0.1]], B, C),
    "not of type NoneType": ([[None]], B, C),
    "not of type complex": ([[1j]], B, C),
    "not True": ([[True]], B, C),
    "frequency variable s": ([["-s"]], B, C),
    "divides by zero": ([["1/(k-k)"]], B, C),
    "the output does not depend on the input": (A, ["0"], C),
    "'k.2' is not a rational expression": ([["k^2"]], B, C),
    "'k [+]' is no expression": ([["k +"]], B, C),
    "'sin.k.' is not a rational expression": ([["sin(k)"]], B, C),
    "exponents are whole": ([["k**m"]], B, C),
    "'k[*][*]0.5': exponents are whole": ([["k**0.5"]], B, C),
    "sin.k12. is not a rational": ([[sp.sin(k12)]], B, C),
    "sqrt": ([[sp.sqrt(k12)]], B, C),
    "0.25 is a float": ([[sp.Float(0.25)]], B, C),
    "ASCII": ([["α"]], B, C),
    "exponents are 1000 at most": ([["k**1001"]], B, C),
}


@pytest.mark.thin(8)
@pytest.mark.parametrize(("message", "space"), BAD_SPACES.items(), ids=range(len(BAD_SPACES)))
def test_bad_state_spaces(message, space):
    with pytest.raises(InputError, match=message):
        Model.from_state_space(*space)


BAD_FUNCTIONS = {
    "denominator of the transfer function is zero": ("k", "0"),
    "is zero: the output": ("k - k", "s + k"),
    "not empty": ([], ["1", "k"]),
    "the coefficients contain the frequency variable s": (["s"], ["1", "k"]),
    "not of type list": ([["k"]], ["1", "k"]),
    "at least one parameter": ("1", "s + 1"),
}


@pytest.mark.parametrize(
    ("message", "function"), BAD_FUNCTIONS.items(), ids=range(len(BAD_FUNCTIONS))
)
def test_bad_transfer_functions(message, function):
    with pytest.raises(InputError, match=message):
        Model.from_transfer_function(*function)


@pytest.mark.parametrize("s", ["s + 1", 1, None])
def test_bad_frequency_variables(s):
    with pytest.raises(InputError):
        Model.from_transfer_function("k", "s + k", s=s)


def test_dead_time_is_refused():
    with pytest.raises(InputError, match="dead time"):
        Model.from_chain(Chain(1, dead_time=True, damped=False))
