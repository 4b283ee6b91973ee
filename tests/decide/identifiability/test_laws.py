"""Laws: equivalent forms say the same in other names, the seed changes nothing, derivatives are
derivatives.
"""

from fractions import Fraction

import pytest
from hypothesis import given, settings, strategies as st
from sympy import Symbol, diff, sympify

from disting import Chain, Family, Quantity, Settings
from disting.decide.identifiability.analysis import identifiabilities, identifiability
from disting.decide.identifiability.parts import Formula
from disting.decide.identifiability.tangent import proof_tangents
from disting.model.symmetry import forms
from tests.laws.strategies import chains

MODULUS = 10**9 + 7


@pytest.mark.slow
@settings(max_examples=12, deadline=None)
@given(chains(max_masses=3, dead_time=True))
def test_equivalent_forms_say_the_same_in_other_names(chain):
    found = identifiability(chain)
    for form in forms(chain):
        there = identifiability(form.chain)
        assert (there.level, there.rank, there.least, there.most) == (
            found.level,
            found.rank,
            found.least,
            found.most,
        )
        renamed = {form.renaming[c.text]: (c.unique, c.certainty) for c in found.singles}
        assert renamed == {c.text: (c.unique, c.certainty) for c in there.singles}
        if found.renamings:
            continue  # the names of the basis are one choice of several
        values = {name: Fraction(i + 2) for i, name in enumerate(chain.parameters)}
        moved = {form.renaming[name]: value for name, value in values.items()}
        assert sorted(_values(found.basis, values)) == sorted(_values(there.basis, moved))


def _values(basis, at):
    return [c.formula.value(at) for c in basis]


@pytest.mark.full
@settings(max_examples=10, deadline=None)
@given(chains(max_masses=3), st.text("abc", min_size=1, max_size=3))
def test_the_seed_changes_nothing_but_the_point(chain, seed):
    one, other = identifiability(chain), identifiability(chain, Settings(seed=seed))
    assert (one.level, one.rank, one.most, one.combinations) == (
        other.level,
        other.rank,
        other.most,
        other.combinations,
    )
    assert [c.text for c in one.singles] == [c.text for c in other.singles]
    assert one.point != other.point


@pytest.mark.full
@settings(max_examples=10, deadline=None)
@given(chains(max_masses=4, dead_time=True))
def test_the_basis_has_as_many_combinations_as_parameters_can_be_determined(chain):
    found = identifiability(chain)
    assert len(found.basis) == found.rank
    assert len(set(found.combinations)) == found.rank
    assert {c.text for c in found.singles} <= set(found.combinations)


@pytest.mark.full
def test_a_family_at_once_is_each_model_alone():
    family = Family(3, damped=True)
    assert identifiabilities(family) == [identifiability(chain) for chain in family]


terms = st.tuples(
    st.integers(1, 5),
    st.dictionaries(
        st.sampled_from(["m1", "m2", "k12"]), st.integers(-3, 3).filter(bool), min_size=1
    ),
)


@pytest.mark.full
@given(st.lists(terms, min_size=1, max_size=3))
def test_gradients(given_terms):
    formula = Formula(tuple((c, tuple(sorted(powers.items()))) for c, powers in given_terms))
    at = {"k12": 3, "m1": 5, "m2": 7}
    function = sympify(formula.text)
    slopes = [diff(function, Symbol(name)).subs(at) for name in at]
    assert formula.gradient(at, MODULUS) == [
        int(s.p) * pow(int(s.q), -1, MODULUS) % MODULUS for s in slopes
    ]
    assert formula.value({name: sympify(x) for name, x in at.items()}) == function.subs(at)


def test_points_of_proofs_are_independent():
    seen = proof_tangents(Chain(3, damped=False).structure, "law", 3)
    assert len({t.modulus for t in seen}) == 3
    assert len({tuple(t.values.values()) for t in seen}) == 3
    other = proof_tangents(Chain(3, meas_plus=2, damped=False).structure, "law", 3)
    assert not {t.modulus for t in seen} & {t.modulus for t in other}


@pytest.mark.full
def test_a_coefficient_and_a_ground_damper_of_the_same_name_are_told_apart():
    ports = {"gap": 2, "act_minus": 1, "act_plus": 3, "meas_minus": 2, "meas_plus": 3}
    found = identifiability(
        Chain(4, **ports, damped=False, quantity=Quantity.POSITION, ground_dampers=(1, 2, 3, 4))
    )
    assert {"b4", "coefficient b4"} <= set(found.combinations)
