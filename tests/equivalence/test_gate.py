"""What is known of candidates before they are fitted, put into the models again by SymPy."""

from itertools import combinations

import pytest
import sympy

from disting import Chain, MatrixModel, Model, Query, Relation, View, compare, gate
from disting.errors import InputError

CIRCUITS = (
    "R0-p(R1,C1)",
    "p(R0,R1-C1)",
    "R0-p(R1,C1)-R2",
    "R0-p(R1,C1)-p(R2,C2)",
    "R0-p(C1,R1-p(R2,C2))",
    "p(R0,R1-C1,R2-C2)",
    "L0-p(R1,C1)",
)
GROUPS = (CIRCUITS[:3], CIRCUITS[3:6])


def values_of(formula, given):
    """Numbers of the duplicate at numbers of the kept model, None where the piece is not valid."""
    _, where, values, root, steps = formula
    at = dict(given)
    if any(sympy.sympify(w).subs(at) <= 0 for w in where):
        return None
    if root:
        name, equation, low, high = root
        x = sympy.Symbol(name)
        low, high = (sympy.sympify(end.replace("infinity", "oo")).subs(at) for end in (low, high))
        roots = sympy.Poly(sympy.sympify(equation).subs(at), x).nroots(n=40)
        at[name] = next(r for r in roots if r.is_real and low < r < high)
    for name, value in steps:
        at[name] = sympy.sympify(value).subs(at)
    return {name: sympy.sympify(value).subs(at) for name, value in values}


def response(model, values):
    at = {"s": sympy.Rational(7, 5)} | values
    whole = model.expression()
    return whole.subs({symbol: at[symbol.name] for symbol in whole.free_symbols})


def assert_carried_over(found):
    """Every formula gives the duplicate the response of the kept model."""
    assert found.duplicates
    models = {s.name: s.subject for s in found.decisions.subjects}
    models = {n: Model.from_chain(m) if isinstance(m, Chain) else m for n, m in models.items()}
    for one in (d for d in found.duplicates if d.formulas):
        given = models[one.kept]
        at = {p: sympy.Rational(3 + 2 * i, 2 + i) for i, p in enumerate(given.parameters)}
        numbers = [v for f in one.formulas if (v := values_of(f, at)) is not None]
        assert numbers, one.name
        for values in numbers:
            assert all(v > 0 for v in values.values())
            left, right = response(given, at), response(models[one.name], values)
            assert abs(sympy.N(left - right, 30)) < 1e-20


@pytest.mark.full
def test_circuits_one_of_each_group_is_kept():
    found = gate(CIRCUITS)
    assert {frozenset(g) for g in found.groups} == {frozenset(g) for g in GROUPS}
    assert found.kept == ("R0-p(R1,C1)", "R0-p(R1,C1)-p(R2,C2)", "L0-p(R1,C1)")
    assert found.not_separate == ()
    assert all(d.formulas for d in found.duplicates)
    assert any("sqrt" in text for d in found.duplicates for f in d.formulas for _, text in f.steps)
    assert_carried_over(found)
    assert set(found.next) == {"R0-p(R1,C1)", "R0-p(R1,C1)-p(R2,C2)"}
    told = found.to_dict()
    assert [k["name"] for k in told["kept"]] == list(found.kept)
    assert told["kept"][2]["same"] == [] and told["kept"][2]["next"] is None


@pytest.mark.full
def test_chains_machines_and_compartments():
    names = ["3:1", "3:11", "3:4"]
    found = gate(names)
    assert found.groups == (("3:1", "3:11"),) and set(found.next) == {"3:1"}
    assert_carried_over(found)
    texts = ("1>2,2>1,2>0; in 1; out 1", "1>2,2>1,1>0; in 1; out 1")
    assert_carried_over(gate(texts))


@pytest.mark.full
def test_what_is_the_same_for_some_values_is_kept_and_told():
    texts = ["1~2, 1~#; F1; S1", "1~2, 2~#; F1; S1", "1~2, 1~#, 2~#; F1; S1"]
    found = gate(texts)
    for a, b in combinations(found.kept, 2):
        apart = compare(a, b).relation is Relation.DISTINGUISHABLE
        assert ((a, b) in found.not_separate) is not apart


@pytest.mark.slow
def test_networks_of_many_values_follow_by_parts():
    texts = ["R0-p(R1,C1)-p(R2,C2)-p(R3,C3)", "R0-p(C1,R1-p(C2,R2-p(C3,R3)))"]
    found = gate([*texts, "1=2*5/2=3; F1; S3", "1=2=3; F1; S3"])
    assert [d.name for d in found.duplicates if d.formulas] == [texts[1], "1=2=3; F1; S3"]
    assert_carried_over(found)


def test_a_renaming_is_a_formula():
    models = [Model.from_transfer_function(["a"], ["b", "c"], name="first")]
    models += [Model.from_transfer_function(["z"], ["y", "x"], name="second")]
    (one,) = gate(models).duplicates
    assert dict(one.formulas[0][2]) == {"z": "a", "y": "b", "x": "c"}


@pytest.mark.full
def test_the_domain_is_that_of_the_query():
    texts = ["R0-p(R1,C1)", "p(R0,R1-C1)"]
    found = gate(texts, query=Query(View.EXACT, inclusion=False))
    assert found.to_dict()["domain"] == "complex" and len(found.kept) == 1


@pytest.mark.parametrize(
    ("models", "sentence"),
    [
        ([], "no models"),
        (["3:1", "3:1"], "two models are called 3:1"),
        ([3], "a model is a Model"),
        (["no such"], "no such"),
        (
            ["3:1", MatrixModel.from_transfer_functions([["1/(s+a)", "b"]])],
            "same outputs and inputs",
        ),
    ],
)
def test_bad_input(models, sentence):
    with pytest.raises(InputError, match=sentence):
        gate(models)
