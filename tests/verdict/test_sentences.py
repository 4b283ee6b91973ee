"""The sentence of a verdict stands alone, and says of special values what is true of them."""

import re

import pytest
import sympy

from disting import (
    Chain,
    Experiment,
    Family,
    Model,
    Quantity,
    Query,
    Relation,
    View,
    catalog,
    compare,
    explicit_map,
    transfer_function,
)
from disting.verdict.meaning import meaning_sentence
from disting.verdict.result import Verdict

SURE = re.compile(r"(Proven( \([^)]+\))?|Probability of error at most 2\^-\d{3})\.$")


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("n", [2, 3, 4])
def test_a_sentence_says_models_domain_reason_and_certainty(n, damped):
    kind = f"{'damped' if damped else 'undamped'}, acceleration,"
    for i, j, verdict in catalog(n, damped=damped).pairs(View.POSITIVE):
        assert verdict.sentence.startswith(f"{n}:{i} and {n}:{j}, {kind} are ")
        assert "over positive parameters" in verdict.sentence and SURE.search(verdict.sentence)
        assert "at most 0" not in verdict.sentence + verdict.sure
        again = Verdict.from_dict(verdict.to_dict())
        assert (again.premises, again.sentence) == (verdict.premises, verdict.sentence)


def test_what_is_not_the_same_of_both_is_said_of_each():
    mixed = compare(Chain(2, quantity="position"), Family(2, damped=False)[2])
    start = "2:1 (damped, position) and 2:2 (undamped, acceleration) are distinguishable"
    assert mixed.sentence.startswith(start)
    beside = compare("2:1", Model.from_transfer_function("a", "s + b", name="filter"))
    assert beside.sentence.startswith("2:1 (damped, acceleration) and filter are ")
    both = [Experiment(), Experiment(sensor=2)]
    measured = compare("2:1", "2:2", experiments=both).sentence
    assert measured.startswith("2:1 and 2:2, damped, acceleration, measured as it is and with ")


@pytest.mark.full
def test_general_models_are_no_machines():
    one = Model.from_transfer_function("a", "(s + b)*(s + c)", name="tank")
    other = Model.from_transfer_function("d", "s**2 + e*s + f", name="circuit")
    for view in View:
        verdict = compare(one, other, query=Query(view))
        said = f"{verdict.sentence} {meaning_sentence(verdict)}"
        assert not re.search("damped|machine|curve|acceleration", said), said
        assert verdict.to_dict()["left_premise"] == {}


def test_plain_data_says_damping_and_quantity():
    data = compare("3:1", "3:4", quantity=Quantity.VELOCITY).to_dict()
    assert data["left_premise"] == data["right_premise"] == {"damped": True, "quantity": "velocity"}


def degrees(chain, values):
    """Degrees of numerator and denominator with these numbers, common factors cancelled."""
    g = transfer_function(chain)
    s = next(x for x in g.free_symbols if x.name == "s")
    g = g.subs({x: values[x.name] for x in g.free_symbols if x != s})
    return tuple(sympy.degree(p, s) for p in sympy.fraction(sympy.cancel(g)))


@pytest.mark.full
def test_fosters_theorem_leaves_special_values_out_because_it_must():
    """With the force on the middle mass and both sides alike a pole is cancelled; with the force at
    the end none ever is: no 3:1 behaves as that 3:4.
    """
    family = Family(3, damped=False)
    verdict = compare(family[1], family[4])
    assert verdict.sure == "proven (Foster's theorem)" and verdict.has_exceptions
    assert "special values aside" in verdict.sentence and "special values" in meaning_sentence(
        verdict
    )
    alike = {"m1": 1, "m2": 2, "m3": 1, "k12": 3, "k23": 3}
    assert degrees(family[4], alike) == (2, 2) and degrees(family[4], alike | {"m3": 2}) == (4, 4)
    for k, values in enumerate(({}, {"m3": 2}, {"k23": 7}, {"m2": 1, "k12": 1})):
        assert degrees(family[1], alike | values) == (4, 4), k


@pytest.mark.full
@pytest.mark.parametrize(("i", "j", "why"), [(1, 11, "duality theorem"), (2, 5, "symmetry")])
def test_where_nothing_is_left_out_nothing_is_said(i, j, why):
    """Duality and symmetry carry over every positive choice, equal elements among them."""
    family = Family(3)
    verdict = compare(family[i], family[j])
    assert verdict.sure == f"proven ({why})" and not verdict.has_exceptions
    assert "special" not in verdict.sentence + meaning_sentence(verdict)
    back_and_forth = explicit_map(family[i], family[j]), explicit_map(family[j], family[i])
    for found, chain, other in zip(back_and_forth, (i, j), (j, i), strict=True):
        here = dict.fromkeys(family[chain].parameters, 1)
        there = {name: sympy.nsimplify(value) for name, value in found.at(here).items()}
        assert all(value > 0 for value in there.values())
        g, h = (transfer_function(family[k]) for k in (chain, other))
        g = g.subs({x: 1 for x in g.free_symbols if x.name != "s"})
        h = h.subs({x: there[x.name] for x in h.free_symbols if x.name != "s"})
        assert sympy.cancel(g - h) == 0


def test_over_complex_parameters_duality_divides_by_sums_that_may_vanish():
    verdict = compare("3:1", "3:11", query=Query(View.EXACT))
    assert verdict.relation is Relation.INDISTINGUISHABLE and verdict.has_exceptions


def test_formulas_of_general_models_tell_whether_they_leave_something_out():
    """c = a + b has all positive values; a = c - d has none where c < d, and a b = c is cut in
    cases.
    """
    pole = Model.from_transfer_function("1", "s + a + b", name="sum")
    plain = compare(pole, Model.from_transfer_function("1", "s + c", name="plain"))
    assert plain.relation is Relation.INDISTINGUISHABLE
    assert plain.has_exceptions == ("special" in plain.sentence)
    ladder = Model.from_transfer_function("1", "s**2 + (a + b)*s + a*b", name="two poles")
    turned = Model.from_transfer_function("1", "s**2 + (c + d)*s + c*d", name="turned")
    assert not compare(ladder, turned).has_exceptions
