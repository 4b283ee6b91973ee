"""Initial states that are not zero: one more input, on which a unit impulse acts."""

import json

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings, strategies as st
from scipy.linalg import expm

from disting import InputError, MatrixModel, compare, identifiability, read_models
from disting.general.model_files import models_of

TWO = [["-a01-a21", "a12"], ["a21", "-a12"]]


def levels(model, domain="complex"):
    found = identifiability(model, domain=domain)
    return {name: level.value for name, level in found.levels.items()}


@pytest.mark.full
def test_a_source_that_is_not_seen():
    """The first example of StructuralIdentifiability.jl, whose initial states are parameters: x1' =
    -(a01 + a21) x1 + a12 x2 + u, x2' = a21 x1 - a12 x2 - x3/b, x3' = x3, y = x2. Its answer: a21
    globally, a01 and a12 locally, b not; x1 and x2 at least locally, x3 not.
    """
    a = [["-a01-a21", "a12", 0], ["a21", "-a12", "-1/b"], [0, 0, 1]]
    found = levels(MatrixModel.from_state_space(a, [1, 0, 0], [0, 1, 0], x0=["x1", "x2", "x3"]))
    assert {name: found[name] for name in ("a01", "a12", "a21", "b", "x3")} == {
        **{"a21": "global", "a01": "local", "a12": "local"},
        **{"b": "not identifiable", "x3": "not identifiable"},
    }
    assert {found["x1"], found["x2"]} <= {"local", "global"}


@pytest.mark.full
def test_two_compartments_whose_contents_are_parameters():
    """Of [s - A, b] known by the input, x2 is seen at first and x1 follows from its slope, once a12
    is known: a root of z^2 - (a01 + a12 + a21 - a21) z + a01 a12.
    """
    model = MatrixModel.from_state_space(TWO, [1, 0], [0, 1], x0=["x1", "x2"])
    assert model.shape == (1, 2)
    assert levels(model) == {
        **{"a21": "global", "x2": "global"},
        **{"a01": "local", "a12": "local", "x1": "local"},
    }
    # that exchange alone is left: the same without a start
    empty = MatrixModel.from_state_space(TWO, [1, 0], [0, 1])
    exchanged = dict.fromkeys(("a01", "a12"), "up to exchanges")
    assert levels(empty) == levels(empty, "positive") == {"a21": "global"} | exchanged


@pytest.mark.full
def test_integrators_of_which_two_initial_values_are_known():
    """Of its examples with known initial values: x1' = a + x2 + x3, x2' = b^2 + c, x3' = -c, y = x1,
    x2(0) and x3(0) known. Its answer: a, x1, x2, x3 globally, b locally, c not. A constant is a
    state that stays, known to be 1 at first.
    """
    a = [[0, 1, 1, "a"], [0, 0, 0, "b**2 + c"], [0, 0, 0, "-c"], [0, 0, 0, 0]]
    start = ["x1", "x2", "x3", 1]
    model = MatrixModel.from_state_space(a, None, [1, 0, 0, 0], x0=start, known=["x2", "x3"])
    assert levels(model) == {
        **dict.fromkeys(("a", "x1", "x2", "x3"), "global"),
        **{"b": "local", "c": "not identifiable"},
    }
    # a negative b is the only other one
    assert levels(model, "positive") == levels(model) | {"b": "global"}
    # nothing known: x2 and x3 only enter by their sum with a
    free = MatrixModel.from_state_space(a, None, [1, 0, 0, 0], x0=start)
    assert levels(free) == {
        "x1": "global",
        **{"b": "local", "c": "not identifiable"},
        **dict.fromkeys(("a", "x2", "x3"), "not identifiable"),
    }


@pytest.mark.full
@settings(deadline=None, max_examples=12)
@given(st.integers(1, 3), st.integers(0, 2), st.randoms(use_true_random=False))
def test_the_last_column_is_the_response_to_the_initial_state(n, inputs, draw):
    """Against SymPy: C (s I - A)^-1 [B, x0]."""
    a = [[draw.choice([0, f"p{i}{j}", "-q"]) for j in range(n)] for i in range(n)]
    a[0][0] = "p00"
    b = [[draw.randint(0, 2) for _ in range(inputs)] for _ in range(n)] if inputs else None
    x0 = [draw.choice([0, f"x{i}", 2]) for i in range(n)]
    x0[0] = "x0"
    c = [[draw.randint(1, 3) for _ in range(n)]]
    model = MatrixModel.from_state_space(a, b, c, x0=x0)
    s = sp.Symbol("s")
    plain = [
        sp.Matrix(n, len(rows[0]), lambda i, j, rows=rows: sp.sympify(str(rows[i][j])))
        for rows in (a, [[*(b[i] if b else []), x0[i]] for i in range(n)])
    ]
    truth = sp.Matrix(c) * (s * sp.eye(n) - plain[0]).inv() * plain[1]
    for seen, true in zip(model.cells, truth, strict=True):
        mine = 0 if seen is None else sp.sympify(str(seen).removeprefix("G(s) = "))
        assert sp.cancel(mine - true) == 0


@pytest.mark.full
def test_a_measured_decay_is_that_of_the_model():
    """y(t) = C exp(A t) x0, against the poles and residues of the column."""
    model = MatrixModel.from_state_space(TWO, None, [0, 1], x0=["x1", 0])
    (entry,) = model.cells
    values = {"a01": 0.3, "a12": 0.2, "a21": 0.5, "x1": 4.0}
    expression = sp.sympify(str(entry).removeprefix("G(s) = ")).subs(values)
    s, t = sp.symbols("s t", positive=True)
    time = sp.inverse_laplace_transform(sp.nsimplify(expression.subs("s", s)), s, t)
    a = np.array([[-0.8, 0.2], [0.5, -0.2]])
    for at in (0.5, 2.0):
        assert float(time.subs(t, at).evalf()) == pytest.approx((expm(a * at) @ [4.0, 0])[1])


def test_models_that_start_elsewhere_are_told_apart():
    """Without an input: contents of the first or of the second vessel, seen in the second."""
    first = MatrixModel.from_state_space(TWO, None, [0, 1], x0=["c", 0], name="first")
    second = MatrixModel.from_state_space(TWO, None, [0, 1], x0=[0, "c"], name="second")
    assert compare(first, second).relation.value == "distinguishable"
    assert compare(first, first).relation.value == "indistinguishable"


def test_a_file_has_initial_states(tmp_path):
    flows = [[1, 2], [2, 1], [1, 0]]
    entries = [
        {"name": "space", "A": [["-a12-a10", "a21"], ["a12", "-a21"]], "B": [1, 0], "C": [0, 1],
         "x0": ["x1", "x2"]},
        {"name": "flows", "flows": flows, "input": 1, "output": 2, "x0": {"1": "x1", "2": "x2"}},
    ]  # fmt: skip
    path = tmp_path / "models.json"
    path.write_text(json.dumps({"models": entries}))
    space, network = read_models(path)
    assert (space.rows, space.parameters) == (network.rows, network.parameters)
    alone = {"name": "decay", "flows": flows, "output": 2, "x0": {"1": "dose"}, "known": ["dose"]}
    (model,) = models_of({"models": [alone]})
    assert str(model) == ("G(s) = [[a12*dose/(a10*a21 + (a10 + a12 + a21)*s + s**2)], [dose]]")
    assert "all determinable; globally: a12, dose" in identifiability(model).sentence


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        ({"A": [["-k"]], "C": [1]}, '"B" is missing'),
        ({"A": [["-k"]], "C": [1], "x0": [1, 2]}, "x0 is a list of the 1 initial values"),
        ({"A": [["-k"]], "C": [1], "x0": "c"}, "x0 is a list"),
        ({"A": [["-k"]], "C": [1], "x0": ["c"], "known": ["d"]}, "'d' is not a parameter"),
        ({"A": [["-k"]], "C": [1], "x0": ["c"], "known": "c"}, "is a list of names"),
        ({"A": [["-k"]], "C": [1], "x0": [0]}, "the transfer function is zero"),
        ({"flows": [[1, 0]], "output": 1, "x0": {"2": "c"}}, "compartment '2', which none"),
        ({"flows": [[1, 0]], "output": 1, "x0": ["c"]}, "contents by compartment"),
    ],
)  # fmt: skip
def test_bad_input(entry, said):
    with pytest.raises(InputError, match=said):
        models_of({"models": [{"name": "a", **entry}]})


def test_nothing_moves_the_states():
    with pytest.raises(InputError, match="nothing moves the states"):
        MatrixModel.from_state_space([["-k"]], None, [1])
