"""Verdicts over real and positive parameters: points with and without equivalents, renamings,
and what stays open.
"""

from dataclasses import replace

import pytest

from disting import Certainty, Query, Relation, View, compare
from disting.algebra.symbols import RationalFunction
from disting.conditions.rule import Outcome
from disting.decide import VALUES_POSITIVE, first_finding
from disting.errors import ContradictionError
from disting.evidence.conditions import Renaming
from disting.evidence.general import NoEquivalent, Witnesses
from disting.general.admissible import ValueSearch
from disting.general.alternatives import alternatives
from disting.general.cases import Search
from disting.general.elimination import Case
from disting.general.formulas import is_explicit, is_without
from disting.general.matrix_model import Model
from disting.general.model_evidence import confirms
from disting.general.orthant import Orthant
from disting.general.sections import sections
from disting.general.which_models import way
from disting.general.witnesses import points
from disting.model.question import Domain

IRREVERSIBLE = Model.from_state_space(
    [["-k12-k01", 0], ["k12", "-k02"]], [1, 0], [0, 1], name="irreversible"
)
REVERSIBLE = Model.from_state_space(
    [["-k12-k01", "k21"], ["k12", "-k21"]], [1, 0], [0, 1], name="reversible"
)
SQUARE = Model.from_transfer_function("k", "s + k**2", name="square")
SHIFTED = Model.from_transfer_function("k + 1", "s + (k + 1)**2", name="shifted")
PAIRS = [(IRREVERSIBLE, REVERSIBLE), (REVERSIBLE, IRREVERSIBLE)]


def over(view, left, right):
    return compare(left, right, query=Query(view=view))


@pytest.mark.full
@pytest.mark.parametrize("view", [View.REAL, View.POSITIVE])
@pytest.mark.parametrize(("left", "right"), PAIRS)
def test_two_compartments_agree_for_some_rates_only(view, left, right):
    assert over(View.EXACT, left, right).relation is Relation.INDISTINGUISHABLE
    verdict = over(view, left, right)
    assert (verdict.relation, verdict.certainty) == (Relation.SOMETIMES, Certainty.PROVEN)
    evidence = verdict.evidence
    assert isinstance(evidence, Witnesses) and evidence.solutions == 2
    assert confirms(evidence, left, right)
    assert "has no equivalent in" in verdict.sentence and "∅" in evidence.formula


@pytest.mark.full
@pytest.mark.parametrize(("left", "right"), PAIRS)
def test_the_published_rates_are_a_witness_and_others_are_not(left, right):
    rates = (("k01", "1/10"), ("k02", "1"), ("k12", "1"))
    fast = (("k01", "5"), ("k02", "1"), ("k12", "1"))
    given = left is IRREVERSIBLE
    equivalent = (("k01", "1.26795"), ("k12", "1"), ("k21", "4.73205"))  # 3 - √3, 1, 3 + √3
    evidence = Witnesses("positive", given, fast, equivalent, given, rates, 2)
    assert confirms(evidence, left, right)
    for near in ((), equivalent[1:], (("k01", "1.5"), *equivalent[1:])):
        assert not confirms(replace(evidence, equivalent=near), left, right)
    assert not confirms(replace(evidence, solutions=4), left, right)
    assert not confirms(replace(evidence, point_without=fast), left, right)
    assert not confirms(replace(evidence, point_with=rates), left, right)
    assert not confirms(
        replace(evidence, point_with=(("k01", "-5"), ("k02", "-1"), ("k12", "-1"))), left, right
    )


def test_renamed_oscillators_agree_for_all_parameters():
    one = Model.from_transfer_function(["g*w**2"], ["1", "2*z*w", "w**2"], name="one")
    other = Model.from_transfer_function(["a*b**2"], ["1", "2*c*b", "b**2"], name="other")
    for view in (View.REAL, View.POSITIVE):
        verdict = over(view, one, other)
        assert verdict.relation is Relation.INDISTINGUISHABLE and isinstance(
            verdict.evidence, Renaming
        )


def test_distinguishable_models_stay_so():
    cube = Model.from_transfer_function("k", "s + k**3", name="cube")
    assert over(View.POSITIVE, SQUARE, cube).relation is Relation.DISTINGUISHABLE


def test_a_shift_is_a_bijection_of_the_reals_and_none_of_the_positive_numbers():
    """k + 1 > 1: positive k of the one need k > 1 to be 1 + something positive."""
    positive = over(View.POSITIVE, SQUARE, SHIFTED)
    assert positive.relation is Relation.SOMETIMES and positive.evidence.without_left_given
    assert confirms(positive.evidence, SQUARE, SHIFTED)
    real = over(View.REAL, SQUARE, SHIFTED)
    assert (real.relation, real.certainty) == (Relation.INDISTINGUISHABLE, Certainty.PROVEN)
    assert is_explicit(real.evidence, SQUARE, SHIFTED) and "k' = k - 1" in real.sentence


def test_special_points_are_no_witnesses():
    """(s + a)(s + b) against a, a + c: a = b has no equivalent, which is no open set; all other
    a, b have one.
    """
    pair = Model.from_transfer_function("1", "(s + a)*(s + b)", name="pair")
    apart = Model.from_transfer_function("1", "(s + a)*(s + a + c)", name="apart")
    verdict = over(View.POSITIVE, pair, apart)
    assert (verdict.relation, verdict.certainty) == (Relation.INDISTINGUISHABLE, Certainty.PROVEN)
    assert is_explicit(verdict.evidence, pair, apart)
    assert alternatives(pair, {"a": 2, "b": 2}, apart).exist(Domain.POSITIVE) is Outcome.FAILS


@pytest.mark.full
def test_a_point_whose_equivalents_are_zero_is_no_witness():
    """(a - 1)^2 = u v: a = 1 alone has no positive u, v."""
    square = Model.from_transfer_function(["(a - 1)**2"], [1, 1], name="square")
    product = Model.from_transfer_function(["u*v"], [1, 1], name="product")
    verdict = over(View.POSITIVE, square, product)
    assert (verdict.relation, verdict.certainty) == (Relation.INDISTINGUISHABLE, Certainty.PROVEN)
    assert is_explicit(verdict.evidence, square, product)


def test_points_where_a_curve_meets_itself_are_no_witnesses():
    """The curve of t and the same one at t = -u: for positive parameters they meet in single
    points only.
    """

    def curve(t):
        return Model.from_transfer_function(
            [f"(({t})**2-1)*(5*({t})-18)", f"(({t})**2-1)*(({t})-2)*(({t})-3)"], [1, 1, 1]
        )

    one, other = curve("t"), curve("-u")
    assert over(View.EXACT, one, other).relation is Relation.INDISTINGUISHABLE
    verdict = over(View.POSITIVE, one, other)
    assert (verdict.relation, verdict.certainty) == (Relation.DISTINGUISHABLE, Certainty.PROVEN)
    assert is_without(verdict.evidence, one, other)
    assert alternatives(one, {"t": 1}, other).exist(Domain.POSITIVE) is Outcome.HOLDS


def test_opposite_signs_never_agree():
    one, other = (
        Model.from_transfer_function(["a"], [1, 1]),
        Model.from_transfer_function(["-b"], [1, 1]),
    )
    assert over(View.EXACT, one, other).relation is Relation.INDISTINGUISHABLE
    verdict = over(View.POSITIVE, one, other)
    assert (verdict.relation, verdict.certainty) == (Relation.DISTINGUISHABLE, Certainty.PROVEN)
    assert over(View.REAL, one, other).relation is Relation.INDISTINGUISHABLE


@pytest.mark.full
def test_evidence_is_refused_where_it_is_not_true():
    square, product = (
        Model.from_transfer_function(["(a-1)**2"], [1, 1]),
        Model.from_transfer_function(["u*v"], [1, 1]),
    )
    evidence = over(View.POSITIVE, square, product).evidence
    assert is_explicit(evidence, square, product) and not is_explicit(evidence, product, square)
    left_given, where, values, root = evidence.formulas[0]
    wrong = replace(
        evidence,
        formulas=(
            (left_given, where, ((values[0][0], "a + 1"), *values[1:]), root),
            *evidence.formulas[1:],
        ),
    )
    assert not is_explicit(wrong, square, product)
    assert not is_without(NoEquivalent("positive", True, ("q0",)), square, product)


def test_families_have_members_or_are_excluded():
    product = Model.from_transfer_function("a*b", "s + c", name="product")
    shifted = Model.from_transfer_function("a*b + 1", "s + c", name="shifted")
    verdict = over(View.POSITIVE, product, shifted)
    assert verdict.relation is Relation.SOMETIMES and confirms(verdict.evidence, product, shifted)
    assert verdict.evidence.solutions == -1 and "infinitely many complex" in verdict.sentence


def test_points_are_of_their_domain_and_determined():
    for domain in (Domain.REAL, Domain.POSITIVE):
        stream = points(IRREVERSIBLE, domain, "seed")
        seen = [next(stream) for _ in range(50)]
        assert (
            seen[0] == next(points(IRREVERSIBLE, domain, "seed"))
            and len({str(p) for p in seen}) > 40
        )
        assert all(set(p) == set(IRREVERSIBLE.parameters) for p in seen)
        assert all(x > 0 for p in seen for x in p.values()) is (domain is Domain.POSITIVE)


REAL_PAIRS = [
    (
        Model.from_transfer_function([text], ["1", "e"]),
        Model.from_transfer_function(["a"], ["1", "b"]),
    )
    for text in ("c*(d-f)", "c*(d-1)")
]
REAL_PAIRS.append(
    (
        Model.from_transfer_function("12*a1+2+(6*a1+1)*s", "1+3*s+s**2"),
        Model.from_transfer_function("-4*b1*b3+4*b1+(-2*b1*b3+2*b1)*s", "1+3*s+s**2"),
    )
)


@pytest.mark.parametrize(("left", "right"), REAL_PAIRS)
def test_real_factors_are_chosen_so_that_no_denominator_vanishes(left, right):
    """c = a/(d - f): d = f = 1 would be no choice."""
    for one, other in ((left, right), (right, left)):
        verdict = over(View.REAL, one, other)
        assert (verdict.relation, verdict.certainty) == (
            Relation.INDISTINGUISHABLE,
            Certainty.PROVEN,
        )
        assert is_explicit(verdict.evidence, one, other)


FIRST = "first "  # rows that do not look at the ways


def of_ways(left, right, ways):
    rows = [row for row in VALUES_POSITIVE.rows if not row.name.startswith(FIRST)]
    return first_finding(rows, ValueSearch(left, right, Domain.POSITIVE, "s", known_ways=ways))


def test_what_contradicts_itself_is_no_finding():
    """All a have the equivalent u = a; a search that found no case is a defect, not a proof
    that there is none.
    """
    one, other = (
        Model.from_transfer_function(["a"], [1, 1]),
        Model.from_transfer_function(["u"], [1, 1]),
    )
    shifted = Model.from_transfer_function(["u+1"], [1, 1])
    for searched_, sometimes in ((other, False), (shifted, True)):
        there, back = way(one, searched_, Domain.POSITIVE), way(searched_, one, Domain.POSITIVE)
        expected = Outcome.SOMETIMES if sometimes else Outcome.HOLDS
        assert of_ways(one, searched_, (there, back)).outcome is expected
        lost = replace(there, parted=replace(there.parted, sections=(), others=()), covering=())
        with pytest.raises(ContradictionError, match="has none"):
            of_ways(one, searched_, (lost, back))


def test_formulas_of_another_model_are_no_evidence():
    one, other = (
        Model.from_transfer_function(["a"], [1, 1]),
        Model.from_transfer_function(["u"], [1, 1]),
    )
    there, back = way(one, other, Domain.POSITIVE), way(other, one, Domain.POSITIVE)
    double = RationalFunction(2 * there.covering[0].values[0].num, there.covering[0].values[0].den)
    wrong = replace(there, covering=(replace(there.covering[0], values=(double,)),))
    with pytest.raises(ContradictionError, match="another transfer function"):
        of_ways(one, other, (wrong, back))


def test_points_with_a_zero_are_no_witnesses():
    """k^2 > 0 has a real root r = k; at k = 0 nothing is said of the points around."""
    square, linear = (
        Model.from_transfer_function(["k**2"], [1, 1]),
        Model.from_transfer_function(["r"], [1, 1]),
    )
    verdict = over(View.REAL, square, linear)
    assert verdict.relation is Relation.SOMETIMES and confirms(verdict.evidence, square, linear)
    assert not confirms(
        replace(
            verdict.evidence, point_with=tuple((n, "0") for n, _ in verdict.evidence.point_with)
        ),
        square,
        linear,
    )


def test_no_equivalent_names_what_is_impossible():
    """u > 0 and 2 - u > 0 and u - 3 > 0: no section, and the inequalities are named."""
    one, other = (
        Model.from_transfer_function(["a", "b"], [1, 1, 1]),
        Model.from_transfer_function(["u - 3", "2 - u"], [1, 1, 1]),
    )
    verdict = over(View.POSITIVE, one, other)
    assert verdict.relation is Relation.DISTINGUISHABLE
    ring = Orthant(1, 1, Domain.POSITIVE)
    u = ring.generators[1]
    search = Search(ring, (1,))
    assert sections(search, Case((), (2 - u, u - 3))) == ([], []) and len(search.closed) == 1
