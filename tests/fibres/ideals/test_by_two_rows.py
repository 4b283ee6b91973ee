"""Chains taken apart: identities of the splits, groups of the poles against SymPy, verdicts
against the synthesis.
"""

from dataclasses import replace
from itertools import combinations, product

import pytest
import sympy
from flint import nmod_poly
from sympy.polys.numberfields.galoisgroups import galois_group

from disting.algebra.certainty import prime, residues
from disting.evidence.ideals import Vanishing
from disting.fibres.ideals import (
    Limits,
    confirms_by_rows,
    included_by_rows,
    normalise,
    refuted_by_rows,
)
from disting.fibres.ideals.by_two_rows import obstacle, refuting_index
from disting.fibres.ideals.fibre_ideal import generic_rank
from disting.fibres.ideals.splits import (
    _is_inseparable,
    gap,
    poles_are_inseparable,
    receptances,
    splits,
)
from disting.fibres.synthesis.decide import Grounds, member
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.question import Membership
from disting.model.symmetry import canonical

LIMITS = Limits(seconds=600, entries=1_000_000, safety=100)
P = prime("test of rows")


def value(model, values):
    point = [values[name] for name in model.parameters]
    return tuple(
        nmod_poly([int(p(*point)) % P for p in some], P)
        for some in (model.numerator, model.denominator)
    )


def canonicals(n, damped):
    return list(dict.fromkeys(canonical(c).chain for c in Family(n, damped)))


@pytest.mark.parametrize(("n", "damped"), [(2, True), (3, False), (3, True), (4, True)])
def test_the_rows_of_every_split_add_up_to_the_receptance(n, damped):
    for chain, h in product(canonicals(n, damped), range(1, n)):
        structure = chain.structure
        own = [m for _, m in receptances(structure).named]
        names = sorted({x for m in own for x in m.parameters})
        values = dict(zip(names, residues(str(chain), len(names), P), strict=True))
        num, den = value(own[-1], values)
        values["c"] = int(num[0]) * pow(int(den[2]), -1, P)
        if len(own) == 2:
            first = value(own[0], values)
            num, den = num * first[1] + first[0] * den, den * first[1]
        for split in splits(structure, h):
            (a, b), (c, d) = (value(m, values) for _, m in split.receptances.named)
            assert (a * d + c * b) * den == num * b * d
            assert (b.degree(), d.degree()) == (2 * h, 2 * (n - h))


def test_the_number_of_splits():
    def names(chain, h):
        return [s.name for s in splits(chain.structure, h)]

    middle = Chain(5, 2, 1, 3, 1, 4, damped=True)
    assert (
        names(middle, 2) == ["same", "exchanged"]
        and names(middle, 4) == ["rigid"]
        and names(middle, 3) == []
    )
    assert (
        names(Chain(3, 0, 0, 1, 0, 3, damped=False), 2) == ["rigid"]
        and names(Chain(3, 0, 0, 1, 0, 3, damped=False), 1) == []
    )
    assert names(Chain(3, 2, 1, 3, 1, 3, damped=False), 2) == ["same"]


@pytest.mark.parametrize(
    "chain",
    [
        Chain(3, 0, 0, 1, 0, 2, damped=True),
        Chain(3, 2, 1, 3, 2, 3, damped=True),
        Chain(4, damped=False),
    ],
)
def test_groups_agree_with_sympy(chain):
    """The group at a point over the integers lies in the generic one, which was found doubly
    transitive.
    """
    s = sympy.Symbol("s")
    for _, row in receptances(chain.structure).named:
        point = [3 + 2 * i + i * i for i in range(len(row.parameters))]
        coefficients = [int(p(*point)) for p in row.denominator][:: 1 if chain.damped else 2]
        polynomial = sympy.Poly(coefficients[::-1], s)
        while polynomial.eval(0) == 0:
            polynomial = polynomial.quo(sympy.Poly(s))
        if polynomial.degree() > 2 and polynomial.is_irreducible:
            assert galois_group(polynomial)[0].transitivity_degree >= 2
    assert poles_are_inseparable(chain.structure, "test")


@pytest.mark.full
def test_roots_in_pairs_are_not_inseparable():
    """An undamped chain in s: with z also -z is a pole, so the group is imprimitive."""
    model = receptances(Chain(4, damped=False).structure).free
    assert _is_inseparable(model, 2, "test") and not _is_inseparable(model, 1, "test")


@pytest.mark.full
def test_markov_parameters_agree_with_sympy():
    """The free pair at one end has h_3 = -d/m1^2; F - c/s^2 of ports two masses apart has h_3 =
    0.
    """
    z, (m1, m2, m3, k1, k2, d1, d2) = (
        sympy.Symbol("z"),
        map(sympy.Integer, (2, 3, 5, 7, 11, 13, 17)),
    )
    s = 1 / z
    one, other = k1 + d1 * s, k2 + d2 * s
    pair = (m2 * s**2 + one) / ((m1 * s**2 + one) * (m2 * s**2 + one) - one**2)
    assert sympy.series(sympy.cancel(pair), z, 0, 4).coeff(z, 3) == -d1 / m1**2
    matrix = sympy.Matrix(
        [
            [m1 * s**2 + one, -one, 0],
            [-one, m2 * s**2 + one + other, -other],
            [0, -other, m3 * s**2 + other],
        ]
    )
    wanted = sympy.cancel(one * other / matrix.det() - z**2 / (m1 + m2 + m3))
    found = sympy.series(wanted, z, 0, 4)
    assert found.coeff(z, 3) == 0 != found.coeff(z, 2)
    given, searched = (
        Chain(3, 0, 0, 1, 0, 3, damped=True).structure,
        Chain(3, 2, 2, 3, 2, 3, damped=True).structure,
    )
    (split,) = splits(given, 2)
    assert refuting_index(split.receptances.grounded, receptances(searched).grounded) == 3
    assert refuting_index(split.receptances.free, receptances(searched).free) is None


def agrees_with_the_synthesis(n, damped):
    chains = canonicals(n, damped)
    ranks = {c: generic_rank(normalise(c.structure), "test") for c in chains}
    refuted = 0
    for small, large in product(chains, chains):
        if not (ranks[small] < ranks[large] and gap(large.structure)):
            continue
        exact = refuted_by_rows(small.structure, large.structure, "test")
        inside = included_by_rows(
            small.structure, large.structure, "test", replace(LIMITS, entries=30_000)
        )
        synthesis = member(small, large)
        assert exact is None or synthesis.grounds in (Grounds.REFUTED, Grounds.NONE)
        refuted += exact is not None
        for evidence in (exact, inside.evidence) if n == 3 else ():
            assert evidence is None or confirms_by_rows(evidence, small.structure, large.structure)
    return refuted


@pytest.mark.full
@pytest.mark.parametrize(
    ("n", "damped"), [(3, False), (3, True), pytest.param(4, False, marks=pytest.mark.slow)]
)
def test_rows_agree_with_the_synthesis(n, damped):
    assert agrees_with_the_synthesis(n, damped) > 0


@pytest.mark.slow
def test_rows_agree_with_the_synthesis_on_four_damped_masses():
    agrees_with_the_synthesis(4, True)


def test_20_lies_in_the_closure_of_8():
    """Four damped masses; the ideals of the whole fibre found it first."""
    small, large = (canonical(Family(4, True)[i]).chain.structure for i in (20, 8))
    found = included_by_rows(small, large, "test", LIMITS)
    assert found.membership is Membership.MEMBER and found.safety >= 100
    assert confirms_by_rows(found.evidence, small, large)
    assert not confirms_by_rows(replace(found.evidence, left_given=False), small, large)
    said = found.evidence.sentence("A", "B")
    assert said.startswith("Both rows of B can have, at least in the limit, the receptances that")
    assert "row of B was solved for" in said and "random receptances modulo random primes" in said


def test_members_refute_nothing():
    """Models of equal rank that are the same, in either order: nothing may be refuted."""
    pairs = [
        (a, b)
        for a, b in combinations(Family(4, True), 2)
        if canonical(a).chain == canonical(b).chain and a.gap
    ]
    # dual
    pairs.append((Chain(4, 1, 1, 2, 1, 2, damped=True), Chain(4, 2, 2, 3, 2, 3, damped=True)))
    for a, b in pairs:
        assert refuted_by_rows(a.structure, b.structure, "test") is None
        assert refuted_by_rows(b.structure, a.structure, "test") is None


def test_what_is_not_covered_is_unknown():
    plain = Chain(3, 1, 1, 2, 1, 2, damped=True)
    others = (
        Chain(3, 0, 0, 1, 0, 2, damped=True),
        replace(plain, lag=True),
        replace(plain, ground_dampers=(1,)),
        Chain(3, damped=False),
    )
    for other in others:
        assert obstacle(plain.structure, other.structure, "test")
        assert refuted_by_rows(plain.structure, other.structure, "test") is None
    both = Chain(3, 1, 1, 2, 1, 2, damped=False)
    assert "one place" in obstacle(both.structure, both.structure, "test")
    with pytest.raises(TypeError):
        bool(included_by_rows(both.structure, both.structure, "test", LIMITS))


def test_a_forged_step_is_refused():
    small, large = (
        Chain(4, 2, 1, 3, 1, 4, damped=True).structure,
        Chain(4, 2, 2, 3, 2, 3, damped=True).structure,
    )
    found = refuted_by_rows(small, large, "test")
    assert found is not None and confirms_by_rows(found, small, large)
    (step,) = found.steps
    assert step.shown == Vanishing(2)
    for forged in (
        replace(step, shown=Vanishing(3)),
        replace(step, part="grounded"),
        replace(step, split="rigid"),
    ):
        assert not confirms_by_rows(replace(found, steps=(forged,)), small, large)


def test_sentences_name_the_rows():
    small, large = (
        Chain(4, 2, 1, 3, 1, 4, damped=True).structure,
        Chain(4, 2, 2, 3, 2, 3, damped=True).structure,
    )
    found = refuted_by_rows(small, large, "test")
    assert "Markov parameter 2 of the free row of B" in found.sentence("A", "B")
    assert "of a generic B stay together in an equivalent A" in replace(
        found, left_given=False
    ).sentence("A", "B")
    nothing = refuted_by_rows(
        Chain(5, 1, 1, 2, 1, 3, damped=True).structure,
        Chain(5, 2, 2, 3, 2, 3, damped=True).structure,
        "t",
    )
    assert nothing is not None and nothing.steps == () and not nothing.is_member
    assert "as many poles" in nothing.sentence("A", "B") and nothing.formula
