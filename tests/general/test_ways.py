"""Equivalents over positive parameters by formulas, against plain SymPy, Gröbner bases and hand
calculation.
"""

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from itertools import combinations, islice, permutations

import networkx as nx
import pytest
import sympy as sp

from disting import Certainty, Family, Query, Relation, View, compare, compare as compare_chains
from disting.algebra.symbols import RationalFunction
from disting.conditions.rule import Outcome
from disting.errors import InputError
from disting.evidence.general import Explicit
from disting.general.alternatives import alternatives
from disting.general.any_model import of_network
from disting.general.cases import Search
from disting.general.elimination import Case
from disting.general.forms import over_positive
from disting.general.formulas import fit, is_explicit
from disting.general.intermediate_value import path
from disting.general.matrix_model import Model
from disting.general.model_evidence import confirms, confirms_models
from disting.general.orthant import BRIEF, Effort, Orthant, value_at
from disting.general.robust import CaseSearch
from disting.general.sections import sections, sign_on
from disting.general.which_models import Way, way
from disting.general.witnesses import points
from disting.model.question import Domain, Settings
from disting.network.notation import network_of

EDGES = [*((i, j) for i in (1, 2, 3) for j in (1, 2, 3) if i != j), (1, 0), (2, 0), (3, 0)]


def tf(num, den):
    return Model.from_transfer_function(num, den)


def positive(left, right):
    return compare(left, right, query=Query(view=View.POSITIVE))


def compartments(edges, out):
    """Rates k_ij from i to j, 0 the environment; input in 1; what one measures is the amount in
    `out`.
    """
    a = [["0"] * 3 for _ in range(3)]
    for i, j in edges:
        a[i - 1][i - 1] += f"-k{i}{j}"
        if j:
            a[j - 1][i - 1] += f"+k{i}{j}"
    return Model.from_state_space(
        a, [1, 0, 0], [int(k == out) for k in (1, 2, 3)], name=f"{edges} {out}"
    )


def is_reached(edges):
    graph = nx.DiGraph(e for e in edges if e[1])
    return all(graph.has_node(k) and graph.has_node(1) and nx.has_path(graph, 1, k) for k in (2, 3))


def structures():
    """One of each class that renumbering the compartments 2 and 3 makes, all three fed from the
    first.
    """
    seen, found = set(), []
    for count in (3, 4):
        for edges in combinations(EDGES, count):
            for out in (1, 2, 3):
                names = [{0: 0, 1: 1, 2: a, 3: b} for a, b in permutations((2, 3))]
                key = min((tuple(sorted((n[i], n[j]) for i, j in edges)), n[out]) for n in names)
                if key not in seen and is_reached(edges):
                    seen.add(key)
                    try:
                        found.append(compartments(edges, out))
                    except InputError:
                        continue
    return found


PAIRS = [
    (
        tf("k12", "(s + k12 + k01)*(s + k02)"),
        tf("k12", "s**2 + (k12 + k01 + k21)*s + k01*k21"),
        Relation.SOMETIMES,
    ),
    (tf("1", "(s + a)*(s + b)"), tf("1", "(s + a)*(s + a + c)"), Relation.INDISTINGUISHABLE),
    (tf("a + b", "s + c"), tf("a", "s + c"), Relation.INDISTINGUISHABLE),
    (tf("a + 1", "s + c"), tf("a", "s + c"), Relation.SOMETIMES),
    (tf("a", "s + a + c"), tf("a + c", "s + a"), Relation.DISTINGUISHABLE),
    (tf("1", "s**2 + (a + b + c)*s + a*c"), tf("1", "(s + a)*(s + b)"), Relation.INDISTINGUISHABLE),
    (tf("1", "s**2 + a*s + b"), tf("1", "(s + a)*(s + b)"), Relation.SOMETIMES),
    (tf("a*b", "s + c"), tf("a*b + 1", "s + c"), Relation.SOMETIMES),
    (tf("a", "s + b"), tf("b - a", "s + b"), Relation.SOMETIMES),
]


@pytest.mark.full
@pytest.mark.parametrize(("left", "right", "relation"), PAIRS)
def test_relations_by_hand(left, right, relation):
    for one, other in ((left, right), (right, left)):
        assert positive(one, other).relation is relation


@pytest.mark.full
@pytest.mark.parametrize(("left", "right", "relation"), PAIRS)
def test_points_against_groebner_bases(left, right, relation):
    """What is said of all points around a point is true at the point itself."""
    for given, other in ((left, right), (right, left)):
        one = way(given, other, Domain.POSITIVE)
        for values in islice(points(given, Domain.POSITIVE, "test"), 12):
            exist = alternatives(given, values, other).exist(Domain.POSITIVE)
            assert not one.having(values) or exist is not Outcome.FAILS
            assert not one.lacking(values) or exist is not Outcome.HOLDS


def test_formulas_put_in_by_sympy():
    evidence = positive(tf("1", "(s + a)*(s + b)"), tf("1", "(s + a)*(s + a + c)")).evidence
    assert evidence.formulas
    c, d = sp.symbols("a b", positive=True)
    s = sp.Symbol("s")
    for left_given, _, values, root in evidence.formulas:
        assert not root
        numbers = {name: sp.sympify(text) for name, text in values}
        given = (s + c) * (s + d) if left_given else (s + c) * (s + c + sp.Symbol("c"))
        form = sp.sympify("(s + A)*(s + A + C)" if left_given else "(s + A)*(s + B)")
        put = form.subs({name.upper(): x for name, x in numbers.items()})
        plain = {x: sp.Symbol(str(x)) for x in (c, d)}
        assert sp.expand(put - given.subs(plain)) == 0


@pytest.mark.full
def test_a_root_between_two_formulas():
    """k = x + y, w = x y + x z: a quadratic whose positive root lies between formulas for all
    positive parameters.
    """
    ladder, poles = PAIRS[5][:2]
    verdict = positive(ladder, poles)
    assert verdict.relation is Relation.INDISTINGUISHABLE and is_explicit(
        verdict.evidence, ladder, poles
    )
    root = next(f[3] for f in verdict.evidence.formulas if f[3])
    name, equation, low, high = root
    for numbers in ((1, 2, 3), (5, Fraction(1, 7), 2)):
        at = dict(zip(("a", "b", "c"), numbers, strict=True))
        ends = [sp.oo if e == "infinity" else sp.sympify(e).subs(at) for e in (low, high)]
        between = [
            z
            for z in sp.Poly(sp.sympify(equation).subs(at), sp.Symbol(name)).real_roots()
            if min(ends) < z < max(ends)
        ]
        assert between


@pytest.mark.full
def test_some_undamped_chains_against_inverse_synthesis():
    family = Family(3, damped=False)
    assert (
        decided_as_by_synthesis(
            (family[i], family[j]) for i, j in ((1, 8), (1, 11), (2, 5), (8, 11), (9, 10), (1, 3))
        )
        == 5
    )


@pytest.mark.slow
def test_undamped_chains_against_inverse_synthesis():
    assert decided_as_by_synthesis(combinations(Family(3, damped=False), 2)) >= 5


def decided_as_by_synthesis(pairs):
    """Where both engines decide whether positive elements have positive equivalents, they say
    the same; how often they do.
    """
    decided = 0
    for left, right in pairs:
        models = Model.from_chain(left), Model.from_chain(right)
        if compare(*models, query=Query(View.EXACT)).relation is Relation.INDISTINGUISHABLE:
            found = positive(*models).relation
            expected = compare_chains(left, right, query=Query(view=View.POSITIVE)).relation
            assert Relation.UNDECIDED in (found, expected) or found is expected
            decided += found is not Relation.UNDECIDED
    return decided


@pytest.mark.slow
def test_three_compartments():
    """All pairs of 3-compartment models with 3 or 4 rates that agree over complex parameters;
    points against Gröbner bases.
    """
    models, counts, looked = structures(), {}, 0
    for left, right in combinations(models, 2):
        if (
            left.degrees != right.degrees
            or compare(left, right, query=Query(View.EXACT)).relation
            is not Relation.INDISTINGUISHABLE
        ):
            continue
        relation = positive(left, right).relation
        counts[relation] = counts.get(relation, 0) + 1
        one = way(left, right, Domain.POSITIVE)
        for values in islice(points(left, Domain.POSITIVE, "test"), 1):
            exist = alternatives(left, values, right, seconds=2).exist(Domain.POSITIVE)
            assert not one.having(values) or exist is not Outcome.FAILS
            assert not one.lacking(values) or exist is not Outcome.HOLDS
            looked += 1
    print(len(models), "models", counts, looked, "points looked at")
    assert sum(counts.values()) == 543
    assert Relation.UNDECIDED not in counts


SHARED_FACTORS = [
    (
        tf(["e"], ["1", "f", "g"]),
        tf(["b/(a1*a2)"], ["1", "a1+c", "a2+c"]),
        Relation.INDISTINGUISHABLE,
    ),
    (
        tf(["e", "h"], ["1", "f", "g"]),
        tf(["b/(a1*a2)", "h"], ["1", "a1+c", "a2+c"]),
        Relation.INDISTINGUISHABLE,
    ),
    (
        tf(["e", "h"], ["1", "f", "g"]),
        tf(["b*a1*a2", "h"], ["1", "a1+c", "a2+c"]),
        Relation.INDISTINGUISHABLE,
    ),
    (
        tf(["e", "h"], ["1", "f", "g"]),
        tf(["b/(k1*k2)", "h"], ["1", "k1+u", "k2+u"]),
        Relation.INDISTINGUISHABLE,
    ),
]


@pytest.mark.full
@pytest.mark.parametrize(("left", "right", "relation"), SHARED_FACTORS)
def test_a_factor_of_two_inequalities_is_one_bound(left, right, relation):
    """Any e, f, g, h: c smaller than f and g, then a1 = f - c, a2 = g - c, and b is what e
    wants, whatever the names are.
    """
    verdict = positive(left, right)
    assert verdict.relation is relation and is_explicit(verdict.evidence, left, right)
    assert positive(right, left).relation is relation


def test_sections_of_two_products_with_a_common_factor():
    """(x - p0)(x - p1) > 0 and (x - p0)(x - p2) > 0: x > p0 where p0 is the largest, x > p1
    where p1 is, and so on.
    """
    ring = Orthant(3, 1, Domain.POSITIVE)
    p, x = ring.generators[:3], ring.generators[3]
    case = Case((), ((x - p[0]) * (x - p[1]), (x - p[0]) * (x - p[2])))
    found, left = sections(Search(ring, (3,)), case)
    assert not left
    for numbers in permutations((1, 2, 3)):
        at = dict(enumerate(map(Fraction, numbers)))
        here = [s for s in found if all(value_at(g, at) > 0 for g in s.where)]
        values = [value_at(s.values[0].num, at) / value_at(s.values[0].den, at) for s in here]
        assert any(v > max(numbers) for v in values)
        assert all(
            v > 0 and all(value_at(g, at | {3: v}) > 0 for g in case.positive) for v in values
        )


@pytest.mark.full
def test_a_root_at_which_a_denominator_vanishes_is_none():
    """a = c (d^2 - 2)^2 and d^3 = b - g - a^2 < b - g: no equivalent where b <= g, least of all
    d^2 = 2 with c = a/0.
    """
    left, right = tf(["a"], ["1", "b-g"]), tf(["c*(d**2-2)**2"], ["1", "c**2*(d**2-2)**2+d**3"])
    for one, other in ((left, right), (right, left)):
        verdict = positive(one, other)
        assert (verdict.relation, verdict.certainty) == (Relation.SOMETIMES, Certainty.PROVEN)
        assert verdict.evidence.without_left_given is (one is left) and confirms(
            verdict.evidence, one, other
        )


def test_a_common_root_is_no_path():
    """x between 0 and oo is a root of x^2 - 2 p, but where x^2 - 2 p must not be zero there is
    none.
    """
    ring = Orthant(1, 2, Domain.POSITIVE)
    p, x = ring.generators[:2]
    equation = x**2 - 2 * p
    case = Case((equation,), (), ((2, RationalFunction(p, x)),))
    assert path(ring, case).values == (RationalFunction(x, ring.number(1)), RationalFunction(p, x))
    assert path(ring, replace(case, nonzero=(equation,))) is None
    assert path(ring, replace(case, equations=(equation * (x - p),), nonzero=(equation,))) is None
    assert path(ring, replace(case, nonzero=(x - p,)))


@pytest.mark.parametrize(("bound", "found"), [(9, True), (1, False)])
def test_the_root_nearest_to_an_end_is_in_bounds_where_the_equation_says_so(bound, found):
    """x^2 = 4 p^2 and x^2 < 9 p^2, where x^2 - 4 p^2 is 5 p^2 at the bound; but x^2 < p^2 fails."""
    ring = Orthant(1, 1, Domain.POSITIVE)
    p, x = ring.generators[:2]
    case = Case((x**2 - 4 * p**2,), (bound * p**2 - x**2,))
    assert bool(path(ring, case)) is found


@pytest.mark.full
def test_a_factor_without_the_root_is_no_part_of_its_equation():
    """One factor of the numerator is found first; what is left is a3**2 x**2 - a1 a3**2."""
    left, right = (
        tf("b1**2 - 3*b3**2*s", "(2*b2*b3 + 1)*s"),
        tf("a1 - 3*a3**2*s", "(2*a2*a3 + 1)*s"),
    )
    assert compare(left, right).relation is Relation.INDISTINGUISHABLE


def test_formulas_that_divide_by_zero_are_refused():
    """c = a/(x^4 - 4x^2 + 4) with x^2 = 2: the polynomials agree where the equation holds, but
    c does not exist.
    """
    left, right = tf(["a"], ["1", "b"]), tf(["c*(d**2-2)**2"], ["1", "b"])
    root = ("x", "x**2 - 2", "0", "infinity")
    values = (("c", "a/(x**4 - 4*x**2 + 4)"), ("d", "x"), ("b", "b"))
    names = dict(values)
    formula = (True, (), tuple((n, names[n]) for n in right.parameters), root)
    assert not fit(Explicit("positive", (formula,)), left, right)
    there = (
        True,
        (),
        tuple((n, {"c": "a/4", "d": "2", "b": "b"}[n]) for n in right.parameters),
        (),
    )
    assert fit(Explicit("positive", (there,)), left, right)


@pytest.mark.full
def test_a_linear_case_presupposes_its_denominator():
    """c (d - f)^2 = a: c = a/(d - f)^2 has no value where d = f, and d, f are to be chosen so
    that it has one.
    """
    for text in ("c*(d-f)**2", "c*(d-1)**2"):
        left, right = tf([text], ["1", "e"]), tf(["a"], ["1", "b"])
        for one, other in ((left, right), (right, left)):
            verdict = positive(one, other)
            assert (verdict.relation, verdict.certainty) == (
                Relation.INDISTINGUISHABLE,
                Certainty.PROVEN,
            )
            assert is_explicit(verdict.evidence, one, other)


@pytest.mark.full
def test_a_case_is_void_if_a_denominator_becomes_zero():
    """c (d - 1)^2 = a, c^2 (d - 1)^2 + d^3 = b: a = 3, b = 1 has none, as a^2/(d - 1)^2 > 1 for
    d < 2 and d^3 > 1 for d > 1.
    """
    left, right = tf(["c*(d-1)**2"], ["1", "c**2*(d-1)**2+d**3"]), tf(["a"], ["1", "b"])
    verdict = positive(left, right)
    assert verdict.relation is Relation.SOMETIMES and confirms(verdict.evidence, left, right)
    back = way(right, left, Domain.POSITIVE)
    assert back.lacking({"a": Fraction(3), "b": Fraction(1)})
    assert not back.lacking({"a": Fraction(16, 25), "b": Fraction(809, 125)})


def test_elimination_keeps_off_denominators():
    """q0 between 0 and 2p: the middle p is a zero of q0 - p, so another point is taken; above p
    it is p + 1.
    """
    ring = Orthant(1, 2, Domain.POSITIVE)
    p, x = ring.generators[:2]
    for positive_, zero in ((2 * p - x, x - p), (x - p, x - p - 1)):
        found, left = sections(
            Search(ring, (1, 2)),
            Case((), (positive_,), ((2, RationalFunction(p, zero**2)),), (zero,)),
        )
        assert found and not left
        for section in found:
            assert (
                not sign_on(ring, zero, section).is_zero() and not section.values[1].den.is_zero()
            )


# three compartments without outflow, or with as many rates that cannot be told apart from those
CYCLE, BACK, LEAK = (
    [(1, 2), (2, 3), (3, 1)],
    [(1, 2), (2, 3), (3, 1), (3, 2)],
    [(1, 2), (2, 3), (3, 2), (1, 0)],
)


@pytest.mark.slow
def test_what_a_cycle_of_compartments_gives_is_known_by_hand():
    """Out of the third, G = n/(s (s^2 + e s + f + n)). A cycle needs real roots of t^2 - e t + f,
    the larger one at least 2 sqrt(n); so does one with a way back. With an outflow from the first
    t^2 - e t + f + n is to have real roots, which is more.
    """
    cycle, back, leak = (compartments(edges, 3) for edges in (CYCLE, BACK, LEAK))
    verdict = positive(cycle, back)
    assert verdict.relation is Relation.INDISTINGUISHABLE
    assert is_explicit(verdict.evidence, cycle, back)
    for whole in (cycle, back):
        verdict = positive(whole, leak)
        assert verdict.relation is Relation.SOMETIMES and confirms(verdict.evidence, whole, leak)
        assert verdict.evidence.without_left_given
        k = {name: Fraction(x) for name, x in verdict.evidence.point_without}
        back_rate = k.get("k32", 0)
        e = k["k12"] + k["k23"] + k["k31"] + back_rate
        both = k["k12"] * (k["k23"] + k["k31"] + back_rate) + k["k23"] * k["k31"]
        assert e**2 < 4 * both


@pytest.mark.full
def test_a_chain_of_three_without_outflow_is_a_star():
    """1/G = s (1 + sum of r/(s + l)): both give any of it, a chain by a continued fraction."""
    star, chain = (
        compartments([(1, 2), (2, 1), *more], 1) for more in ([(1, 3), (3, 1)], [(2, 3), (3, 2)])
    )
    verdict = positive(star, chain)
    assert verdict.relation is Relation.INDISTINGUISHABLE
    assert is_explicit(verdict.evidence, star, chain)


@pytest.mark.slow
def test_all_pairs_of_three_compartments_are_decided():
    """543 of equal functions over complex values: in 2 no positive values agree, and the numbers of
    the others are those of the first full count.
    """
    exact = Query(View.EXACT)
    pairs = [
        (a, b)
        for a, b in combinations(structures(), 2)
        if a.degrees == b.degrees
        and compare(a, b, query=exact).relation is Relation.INDISTINGUISHABLE
    ]
    found = Counter(positive(*pair).relation.value for pair in pairs)
    assert found == {"indistinguishable": 342, "sometimes": 199, "distinguishable": 2}


def test_a_path_too_large_to_be_looked_at_is_found_by_counting():
    model = tf(["a"], ["1", "b"])
    ring = Orthant(1, 2, Domain.POSITIVE)
    p, x = ring.generators[:2]
    for equation, found in ((x**2 - x - p, True), (x**2 - x + p, False)):
        for degree in (0, 40):
            search = Search(replace(ring, degree=degree), (1, 2))
            parted = CaseSearch(search, (), (Case((equation,)),), ring.number(1))
            assert bool(Way(model, model, parted, ()).path()) is found


def test_a_small_effort_ends_a_search_and_says_nothing():
    """With as many terms as it takes it finds what it finds without end."""
    left, right = tf("n", "(s + n + x)*(s + y)"), tf("n", "(s + n + y)*(s + x)")
    every = way(left, right, Domain.POSITIVE)
    assert every.covering or every.path() or every.parted.sections
    assert way(left, right, Domain.POSITIVE, Effort(terms=3)) is None
    assert way(left, right, Domain.POSITIVE, Effort(orders=0)) is None
    enough = way(left, right, Domain.POSITIVE, Effort(terms=100_000))
    assert (enough.covering, enough.parted.sections) == (every.covering, every.parted.sections)


@pytest.mark.full
@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("1>0, 1>2, 2>3, 3>1; in 1; out 3", "1>0, 1>2, 2>1, 2>3, 3>1; in 1; out 3"),
        ("1>0, 1>2, 2>1, 2>3, 3>1; in 3; out 1", "1>0, 1>2, 2>1, 3>1, 3>2; in 3; out 2"),
    ],
)
def test_what_a_brief_search_finds_is_confirmed(left, right):
    """A thorough one solves in another order, and finds less of these."""
    pair = [of_network(network_of(text)) for text in (left, right)]
    found = over_positive(*pair, Settings(), BRIEF)
    assert found.evidence is not None and confirms_models(found.evidence, *pair)
    assert confirms_models(found.turned.evidence, *pair[::-1])
    assert found.turned.turned == found
