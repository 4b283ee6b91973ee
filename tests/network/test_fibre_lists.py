"""Lists of all equivalents of a point: what is said of the points near by, tried by numbers."""

from fractions import Fraction
from itertools import combinations, islice

import numpy as np
import pytest
from scipy.optimize import least_squares

from disting import Model, compare, network_of
from disting.conditions.rule import Outcome
from disting.general import fibre_lists
from disting.general.admissible import admissible_finding
from disting.general.any_model import of_network
from disting.general.model_evidence import confirms
from disting.general.witnesses import points
from disting.model.question import Domain
from disting.network.families import family_of
from disting.verdict.result import Relation

SOMETIMES = (
    ("R1-p(R2,C1-p(R3,L1))", "R1-p(R2-L1,R3-C1)"),
    ("p(R1,R2-p(C1,R3-L1))", "p(R1-L1,R2-p(R3,C1))"),
    ("R1-p(C1,R2-p(R3,L1))", "p(R1,p(R2,L1)-p(R3,C1))"),
    # neither is in series and parallel: open without lists
    ("C1 1 2; L1 1 3; R1 2 3; R2 2 0; R3 3 0", "C1 1 2; R1 1 3; L1 2 3; R2 2 0; R3 3 0"),
    ("L1 1 2; R1 1 3; C1 2 3; R2 2 0; R3 3 0", "C1 1 2; R1 1 3; R2 2 3; L1 2 0; R3 3 0"),
)
NEVER = ("R1-p(R2,L1-p(R3,C1))", "R1-p(C1,R2-p(R3,L1))")
ALWAYS = ("R1-p(R2-L1,R3-C1)", "C1 1 2; L1 1 3; R1 2 3; R2 2 0; R3 3 0")
S = np.geomspace(0.05, 20, 9)  # real: an impedance is positive there


def models(pair):
    return tuple(Model.from_network(network_of(text)) for text in pair)


def response(model):
    """log Z at points of the real axis, of the logarithms of the parameters."""
    sides = [
        [[(tuple(e), float(c)) for e, c in terms] for terms in side]
        for side in (model.numerator_terms, model.denominator_terms)
    ]

    def at(x):
        q = np.exp(x)
        top, bottom = (
            sum(
                sum(c * np.prod(q ** np.array(e)) for e, c in terms) * S**k
                for k, terms in enumerate(side)
            )
            for side in sides
        )
        with np.errstate(all="ignore"):  # the search may go far
            return np.nan_to_num(np.log(top / bottom), nan=1e3, posinf=1e3, neginf=-1e3)

    return at


def distance(given, values, other, rng, starts=8):
    """How near positive values of the other model come, by a search from many starts."""
    wanted = response(given)(np.log([float(values[p]) for p in given.parameters]))
    seen = response(other)
    n = len(other.parameters)
    fits = (
        least_squares(
            lambda x: seen(x) - wanted, rng.normal(0, 2, n), xtol=1e-15, ftol=1e-15, gtol=1e-15
        )
        for _ in range(starts)
    )
    return min(np.linalg.norm(f.fun) for f in fits)


def near(values, rng, size):
    return {p: x * Fraction(1 + size * float(rng.uniform(-1, 1))) for p, x in values.items()}


@pytest.mark.full
@pytest.mark.parametrize(
    "pair",
    [
        SOMETIMES[0],
        *(pytest.param(pair, marks=pytest.mark.slow) for pair in (*SOMETIMES[1:3], NEVER)),
    ],
)
def test_no_search_finds_what_lists_deny_and_all_around_it(pair):
    rng = np.random.default_rng(5)
    left, right = models(pair)
    tried = 0
    for given, other in ((left, right), (right, left)):
        for values in islice(points(given, Domain.POSITIVE, "lists"), 2):
            if fibre_lists.has_no_equivalent(given, values, other):
                assert distance(given, values, other, rng) > 1e-7
                around = near(values, rng, 1e-6)
                assert distance(given, around, other, rng, 4) > 1e-7
                tried += 1
    assert tried


@pytest.mark.full
@pytest.mark.parametrize("pair", [*SOMETIMES, ALWAYS])
def test_what_lists_find_is_found_around_it_too(pair):
    rng = np.random.default_rng(6)
    left, right = models(pair)
    found = 0
    for given, other in ((left, right), (right, left)):
        for values in islice(points(given, Domain.POSITIVE, "lists"), 10):
            equivalent = fibre_lists.find_equivalent(given, values, other)
            if equivalent:
                seen, wanted = response(other), response(given)
                around = near(values, rng, 1e-4)
                for at in (values, around):
                    goal = wanted(np.log([float(at[p]) for p in given.parameters]))
                    fit = least_squares(
                        lambda x, goal=goal, seen=seen: seen(x) - goal,
                        np.log(equivalent),
                        xtol=1e-15,
                        ftol=1e-15,
                        gtol=1e-15,
                    )
                    assert np.linalg.norm(fit.fun) < 1e-9
                found += 1
    assert found


@pytest.mark.full
@pytest.mark.sampled(2)
@pytest.mark.parametrize("pair", SOMETIMES)
def test_pairs_that_are_the_same_for_some_values(pair):
    left, right = models(pair)
    found = admissible_finding(left, right, Domain.POSITIVE, "disting")
    assert found.outcome is Outcome.SOMETIMES
    assert confirms(found.evidence, left, right)
    assert confirms(found.evidence.turned, right, left)
    assert compare(*pair).relation is Relation.SOMETIMES


@pytest.mark.full
def test_lists_agree_with_formulas():
    """Of circuits of four elements all pairs are decided by formulas and contradictions."""
    nets = [of_network(n) for n in family_of("circuits-4").networks[::2]]
    decided = 0
    for left, right in combinations(nets, 2):
        if left.degrees != right.degrees or len(left.parameters) != len(right.parameters):
            continue
        verdict = compare(left, right)
        values = next(points(left, Domain.POSITIVE, "agree"))
        has, none = (
            fibre_lists.find_equivalent(left, values, right),
            fibre_lists.has_no_equivalent(left, values, right),
        )
        assert not (has and none)
        if has:
            assert verdict.relation is not Relation.DISTINGUISHABLE
        if none:
            assert verdict.relation is not Relation.INDISTINGUISHABLE
        decided += bool(has or none)
    assert decided > 10


def test_a_function_of_a_minor_has_equivalents_near_by():
    """(c s + a)/(b s + 1) is R1-p(R2,C1) with R1 = c/b: none at c = 0, some for any small c."""
    given = Model.from_transfer_function(["c", "a"], ["b", "1"])
    (whole, part) = models(("R1-p(R2,C1)", "p(R2,C1)"))
    at = {"a": Fraction(2), "b": Fraction(3), "c": Fraction(0)}
    near_by = at | {"c": Fraction(1, 10**6)}
    assert fibre_lists.find_equivalent(given, near_by, whole) is not None
    assert fibre_lists.find_equivalent(given, at, whole) is None
    assert not fibre_lists.has_no_equivalent(given, at, whole)
    negative = at | {"c": Fraction(-1, 10**6)}
    assert fibre_lists.has_no_equivalent(given, negative, whole) and fibre_lists.has_no_equivalent(
        given, negative, part
    )


@pytest.mark.full
def test_a_lie_is_refused():
    left, right = models(SOMETIMES[3])
    evidence = admissible_finding(left, right, Domain.POSITIVE, "disting").evidence
    turned = evidence.turned
    assert not confirms(turned, left, right)


def test_values_without_a_transfer_function_are_passed_over():
    given = Model.from_transfer_function(["a"], ["a - b", "c"])
    values = {"a": Fraction(1), "b": Fraction(1), "c": Fraction(1)}
    assert fibre_lists.find_equivalent(given, values, given) is None
    assert not fibre_lists.has_no_equivalent(given, values, given)
    assert admissible_finding(given, given, Domain.POSITIVE, "disting").outcome is not None


def test_a_special_value_says_nothing_of_those_near_by():
    """At a = d a pole is cancelled, and the function is one of a smaller network."""
    given = Model.from_transfer_function(["1", "d"], "(s + a)*(s + b)*c")
    other = Model.from_transfer_function(["1"], ["p", "q"])
    values = {"a": Fraction(2), "b": Fraction(3), "c": Fraction(1), "d": Fraction(2)}
    assert fibre_lists.find_equivalent(given, values, other) is None
