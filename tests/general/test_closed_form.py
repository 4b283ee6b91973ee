"""Values of networks in those of others as formulas: put in, and beside the lists of all values."""

import re
from dataclasses import replace
from fractions import Fraction

import pytest
import sympy

from disting.equivalence.closed_forms import closed_forms
from disting.errors import ContradictionError
from disting.general.alternatives import alternatives
from disting.general.any_model import of_network
from disting.general.closed_form import confirm
from disting.general.field import Field, names_in
from disting.general.synthesis import NoFormulas
from disting.general.values_of_parts import by_parts
from disting.model.question import Domain
from disting.network.notation import network_of
from disting.verdict.comparison import compare

VOIGT = "R0-p(R1,C1)-p(R2,C2)-p(R3,C3)"
LADDER = "R0-p(C1,R1-p(C2,R2-p(C3,R3)))"
FOUR, slow = (f"{VOIGT}-p(R4,C4)",), pytest.mark.slow
BRIDGE = "C1 1 2; C2 1 3; R1 2 3; R2 2 0; R3 3 0; port 1 0"
BRANCHES = "C1 1 2; L1 1 3; R1 2 3; R2 2 0; R3 3 0; port 1 0"
STAR = "L1 1 2; R1 1 3; R2 2 3; L2 2 0; R3 3 0; port 1 0"
PAIRS = (
    ("R0-p(R1,C1)-p(R2,C2)", "p(R1,R2-C1,R3-C2)", 1, True),
    ("p(R1,R2-C1,R3-C2)", "R0-p(R1,C1)-p(R2,C2)", 1, True),
    (VOIGT, LADDER, 1, False),
    pytest.param(VOIGT, "R1-p(C1,R0-p(C2,R2))-p(R3,C3)", 3, False, marks=slow),
    pytest.param(*FOUR, "R0-p(C1,R1-p(C2,R2-p(C3,R3-p(C4,R4))))", 1, False, marks=slow),
    pytest.param(*FOUR, "R0-p(R1,C1)-p(C2,R2-p(C3,R3))-p(R4,C4)", 6, False, marks=slow),
    ("L1-p(L2,C1)-p(L3,C2)", "p(L1,C1-p(L2,C2-L3))", 1, False),
    ("W0-p(W1,C1)-p(W2,C2)", "W0-p(C1,W1-p(C2,W2))", 1, False),
    ("R0-p(R1,P1)-p(R2,C1-L1)", "p(R1,P1)-p(R2,C1-L1)-R0", 1, False),
    ("1~2~3, 1~4; F1; S1", "1~2~3~4; F1; S1", 1, False),
    ("1~2~3, 1~4; F1; S1", "1~2, 2~3, 2~4; F1; S1", 1, True),
    pytest.param("1=2~3~4; F1; S1", "1=2, 2~3, 2~4; F1; S1", 1, True, marks=slow),
    ("1=2~3~4; F1; S2", "1=2, 2~3, 2~4; F2; S1", 1, True),
    pytest.param(
        "1<>2, 1<>3, 1<>4, 1>0; in 1; out 1",
        "1<>2, 2<>3, 3<>4, 2>0; in 1; out 1",
        *(1, False),
        marks=slow,
    ),
    ("1<>2, 1<>3, 1<>4, 1>0; in 1; out 1", "1<>2, 2<>3, 1<>4, 2>0; in 1; out 1", 3, False),
    ("1<>2, 2<>3, 1>0; in 1; out 1", "1<>2, 1<>3, 2>0; in 1; out 1", 2, True),
    ("1<>2, 2<>3; in 1; out 1", "1<>2, 1<>3; in 1; out 1", 2, True),
    ("R1-C1-p(R2,C2)", BRIDGE, 1, True),
    ("p(L1,R1-p(R2,L2))", STAR, 1, True),
    (BRANCHES, "R1-p(R2-L1,R3-C1)", 1, False),
    ("R1-p(R2-L1,R3-R4-C1)", BRANCHES, 1, False),
    ("#~1, 1~2, 2~3; F1; S1", "#~1, 1~2, 1~3, 2~3; F2; S2", 2, True),
)


def models(*texts):
    return [of_network(network_of(text)) for text in texts]


def formulas(given_text, other_text):
    one, two = models(given_text, other_text)
    return closed_forms(one, two, compare(one, two))


def numbers(form, values):
    """The values of a form, by its source in Python, run at numbers in place of its symbols."""
    head, line, steps = re.fullmatch(
        r"(.*\n\n)(.*positive=True\)\n)(.*)", form.python, re.DOTALL
    ).groups()
    space = {}
    exec(head + line, space)
    assert {n for n, x in space.items() if isinstance(x, sympy.Symbol)} == set(values)
    space |= {n: sympy.Rational(x) for n, x in values.items()}
    exec(steps, space)
    return {n: sympy.sympify(e) for n, e in space["equivalent"].items()}


def response(text, values, at):
    """The transfer function by SymPy, from the terms of the model."""
    (model,) = models(text)
    total = []
    for side in (model.numerator_terms, model.denominator_terms):
        total.append(
            sum(
                c
                * sympy.prod([values[n] ** k for n, k in zip(model.parameters, e, strict=True)])
                * at**i
                for i, terms in enumerate(side)
                for e, c in terms
            )
        )
    return total[0] / total[1]


@pytest.mark.full
@pytest.mark.sampled(5)
@pytest.mark.parametrize(("one", "other", "count", "by_roots"), PAIRS)
def test_both_give_the_same(one, other, count, by_roots):
    """At numbers, in SymPy, to 30 digits."""
    found = formulas(one, other)
    assert len(found) == count
    assert any(s.root for f in found for s in f.steps) is by_roots
    (model,) = models(one)
    values = {n: Fraction(i * i + 3, i + 2) for i, n in enumerate(model.parameters)}
    for form in found:
        there = {n: sympy.N(x, 40) for n, x in numbers(form, values).items()}
        assert all(x.is_real and x > 0 for x in there.values())
        given_ones = {n: sympy.Rational(x) for n, x in values.items()}
        for at in (sympy.Rational(2, 3), 5):
            difference = response(one, given_ones, at) / response(other, there, at) - 1
            assert abs(sympy.N(difference, 40)) < 1e-30


SOLVED = (
    ("1>2, 1>3, 2>1, 3>1; in 2; out 3", "1>2, 2>1, 3>1; in 3; out 2", True, "at 40 of 40", ()),
    ("1>2, 1>3, 2>3; in 1; out 3", "1>2, 1>3, 2>1, 2>3; in 1; out 3", False, "of 40", ("a23",)),
    ("1<>2, 1>0; in 1; out 1", "1<>2, 2>0; in 1; out 1", False, "", ()),
    ("#~1, 1~2; F2; S2:1", "#~1, #~2; F2:1; S2:1", True, "at 40 of 40", ()),
)


@pytest.mark.full
@pytest.mark.parametrize(("one", "other", "by_roots", "seen", "chosen"), SOLVED)
def test_equations_of_few_values(one, other, by_roots, seen, chosen):
    """Compartments: positive for all values, or at how many points that is seen; what is a number
    is a choice.
    """
    found = formulas(one, other)
    assert any(s.root for f in found for s in f.steps) is by_roots
    assert all(seen in f.seen and bool(f.seen) is bool(seen) for f in found)
    assert {f.chosen for f in found} == {chosen}
    (model,) = models(one)
    values = {n: sympy.Rational(i * i + 3, i + 2) for i, n in enumerate(model.parameters)}
    for form in found:
        there = {n: sympy.N(x, 40) for n, x in numbers(form, values).items()}
        difference = response(one, values, 5) / response(other, there, 5) - 1
        assert abs(sympy.N(difference, 40)) < 1e-30
        if not chosen:
            assert all(x > 0 for x in there.values())


@pytest.mark.full
@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("1>0, 1>2, 2>1; in 1; out 1", "1>0, 1>2, 2>0, 2>1; in 1; out 1"),
        ("p(L1,R1-p(R2,C1))", "p(R1,L1,R2-C1)"),  # parts that differ by more than their branches
    ],
)
def test_sections_of_the_equations_cover_all_values(one, other):
    found = formulas(one, other)
    assert found and all(form.checked for form in found)
    (model,) = models(one)
    values = {n: sympy.Rational(i * i + 3, i + 2) for i, n in enumerate(model.parameters)}
    there = [{n: sympy.N(x, 40) for n, x in numbers(form, values).items()} for form in found]
    for known in there:
        assert abs(sympy.N(response(one, values, 5) / response(other, known, 5) - 1, 40)) < 1e-30
    assert any(all(x > 0 for x in known.values()) for known in there)


@pytest.mark.full
@pytest.mark.parametrize(
    ("one", "other"),
    [("R0-p(R1,C1)-p(R2,C2)", "R0-p(C1,R1-p(R2,C2))"), ("1~2~3, 1~4; F1; S1", "1~2~3~4; F1; S1")],
)
def test_beside_the_list_of_all_values(one, other):
    here, there = models(one, other)
    values = {n: Fraction(i + 1, i + 2) for i, n in enumerate(here.parameters)}
    listed = alternatives(here, values, there).within(Domain.POSITIVE)
    found = [
        {n: Fraction(str(x)) for n, x in numbers(f, values).items()} for f in formulas(one, other)
    ]
    assert found == [x.values for x in listed]


@pytest.mark.full
def test_what_needs_more_than_square_roots_is_said():
    with pytest.raises(NoFormulas, match="roots of a polynomial of degree 3 are needed"):
        formulas(LADDER, VOIGT)


@pytest.mark.full
def test_what_can_be_shared_is_shared_equally():
    one, two = models(VOIGT, "R0-p(C1,R1-R4-p(C2,R2-p(C3,R3)))")
    (form,) = by_parts(one, two)
    values = dict(form.values)
    assert (form.choices, values["R1"] == values["R4"]) == ((("R1", "R4"),), True)
    assert confirm(form, one, two).safety >= 100


@pytest.mark.full
def test_what_is_chosen_of_a_triangle_is_so_of_all_three():
    """The star has R1 and R4 in series: in the bridge R2, R3, R4 are what is chosen with R1."""
    one, two = models("R1-p(R2,C1)", "C1 1 2; R1 1 3; R2 2 3; R3 2 0; R4 3 0; port 1 0")
    (form,) = by_parts(one, two)
    assert form.choices and all({"R1", "R2", "R4"} <= {*names} for names in form.choices)
    assert confirm(form, one, two).safety >= 100


@pytest.mark.full
def test_a_wrong_formula_is_refused():
    one, two = models(VOIGT, LADDER)
    (form,) = by_parts(one, two)
    assert confirm(form, one, two).safety >= 100
    (name, value), *others = form.values
    wrong = replace(form, values=((name, value + value), *others))
    with pytest.raises(ContradictionError):
        confirm(wrong, one, two)


@pytest.mark.full
def test_one_wrong_sign_of_a_root_is_refused():
    one, two = models("R0-p(R1,C1)-p(R2,C2)", "p(R1,R2-C1,R3-C2)")
    (form,) = by_parts(one, two)
    first, second, *others = form.steps
    wrong = replace(form, steps=(first, replace(second, sign=1), *others))
    with pytest.raises(ContradictionError):
        confirm(wrong, one, two)


@pytest.mark.full
@pytest.mark.parametrize("kinds", ["RL", "LC"])
@pytest.mark.parametrize(("sections", "is_open"), [(2, False), (4, True)])
def test_ladders_of_any_length(sections, is_open, kinds):
    """From a sum of partial fractions to a ladder: fractions of any size, no roots."""
    a, b = kinds
    partial = "-".join([f"{a}0"] * is_open + [f"p({a}{i},{b}{i})" for i in range(1, sections + 1)])
    one, two = models(partial, _ladder(a, b, sections, is_open))
    (form,) = by_parts(one, two)
    assert confirm(form, one, two).safety >= 100
    assert not any(s.root for s in form.steps)


def _ladder(a, b, sections, is_open):
    inside = f"p({a}{sections},{b}{sections})"
    for i in range(sections - 1, 0, -1):
        inside = f"p({b}{i},{a}{i}-{inside})"
    return f"{a}0-{inside}" if is_open else inside


def test_a_renaming_is_read_the_right_way():
    """Of three masses around a loop: 1 to 2 to 3 to 1 is not its own inverse."""
    one, two = "1~2*3/2, 2~3, 1~3; F1; S2", "2~3*3/2, 3~1, 2~1; F2; S3"
    (form,) = formulas(one, two)
    assert not form.steps
    assert [line.split() for line in form.text.splitlines() if line.startswith("m")] == [
        ["m1'", "=", "m3"],
        ["m2'", "=", "m1"],
        ["m3'", "=", "m2"],
    ]


def test_names_that_are_taken_are_not_given_to_steps():
    ring = Field(("u1", "x2", "xx1"))
    value = (ring["u1"] + ring["x2"]) ** 30
    assert names_in(ring.short(value)) == {"uu1"}
    assert names_in(ring.split((ring["u1"], ring["x2"], ring.one))[1]) == {"xxx2"}
