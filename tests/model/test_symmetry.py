"""Reciprocity and reflection: every form has the same transfer function, and one of them is
canonical.
"""

import pytest
from hypothesis import given, settings

from disting import Chain, Family, Symmetry
from disting.behaviour.transfer import is_renaming
from disting.model.symmetry import canonical, forms
from tests.laws.strategies import chains

quick = settings(max_examples=40, deadline=None)


@settings(max_examples=15, deadline=None)
@given(chains(max_masses=3))
def test_every_form_has_the_same_transfer_function(chain):
    """An exact identity of formulas."""
    for form in forms(chain):
        assert sorted(form.renaming) == sorted(chain.parameters)
        assert sorted(form.renaming.values()) == sorted(form.chain.parameters)
        assert is_renaming(chain.structure, form.chain.structure, form.renaming)


@pytest.mark.parametrize(
    "chain",
    [
        Chain(5, 2, 1, 3, 2, 4, damped=True, ground_dampers=(1, 3), lag=True),
        Chain(4, 0, 0, 2, 0, 3, damped=True),
    ],
    ids=str,
)
def test_forms_of_larger_chains_have_the_same_transfer_function(chain):
    found = list(forms(chain))
    assert len(found) == 8
    for form in found:
        assert is_renaming(chain.structure, form.chain.structure, form.renaming)


@quick
@given(chains(max_masses=6, dead_time=True))
def test_the_canonical_form_is_one_for_all_forms(chain):
    one = canonical(chain).chain
    assert canonical(one).chain == one
    assert canonical(one).symmetries == ()
    assert {canonical(form.chain).chain for form in forms(chain)} == {one}
    assert one in {form.chain for form in forms(chain)}
    assert one.indices == min(form.chain.indices for form in forms(chain))


@pytest.mark.full
@quick
@given(chains(max_masses=6, dead_time=True))
def test_forms_keep_everything_but_ports_and_numbering(chain):
    for form in forms(chain):
        c = form.chain
        assert (c.n_masses, c.gap, c.quantity, c.damped, c.lag, c.dead_time) == (
            chain.n_masses,
            chain.gap,
            chain.quantity,
            chain.damped,
            chain.lag,
            chain.dead_time,
        )
        assert len(c.ground_dampers) == len(chain.ground_dampers)
        assert form.renaming.get("T1", "T1") == "T1"
        assert form.renaming.get("Td", "Td") == "Td"


@quick
@given(chains(max_masses=6))
def test_forms_of_a_form_are_the_same_set(chain):
    all_forms = {form.chain for form in forms(chain)}
    assert chain in all_forms
    assert len(all_forms) in (1, 2, 4, 8)
    for form in forms(chain):
        assert {other.chain for other in forms(form.chain)} == all_forms


@quick
@given(chains(max_masses=6))
def test_each_symmetry_is_its_own_inverse(chain):
    for form in forms(chain):
        back = next(f for f in forms(form.chain) if f.symmetries == form.symmetries)
        assert back.chain == chain
        assert {back.renaming[there]: there for there in back.renaming} == form.renaming


def test_the_eight_forms_of_a_chain():
    chain = Chain(5, 2, 1, 3, 2, 4, ground_dampers=(1, 3), damped=False)
    expected = {
        (): (1, 3, 2, 4, (1, 3)),
        ("free",): (1, 4, 2, 3, (1, 3)),
        ("grounded",): (2, 3, 1, 4, (1, 3)),
        ("free", "grounded"): (2, 4, 1, 3, (1, 3)),
        ("mirror",): (1, 5, 2, 4, (1, 5)),
        ("free", "mirror"): (1, 4, 2, 5, (1, 5)),
        ("grounded", "mirror"): (2, 5, 1, 4, (1, 5)),
        ("free", "grounded", "mirror"): (2, 4, 1, 5, (1, 5)),
    }
    short = {
        Symmetry.RECIPROCITY_FREE: "free",
        Symmetry.RECIPROCITY_GROUNDED: "grounded",
        Symmetry.REFLECTION: "mirror",
    }
    found = {
        tuple(short[s] for s in f.symmetries): (*f.chain.structure.ports, f.chain.ground_dampers)
        for f in forms(chain)
    }
    assert found == expected


def test_reflection_renames_masses_springs_dampers_and_ground_dampers():
    chain = Chain(4, 1, 1, 2, 1, 3, damped=True, ground_dampers=(1, 2))
    mirrored = next(f for f in forms(chain) if f.symmetries == (Symmetry.REFLECTION,))
    assert {a: b for a, b in mirrored.renaming.items() if a != b} == {
        "m2": "m4",
        "m4": "m2",
        "k23": "k34",
        "k34": "k23",
        "d23": "d34",
        "d34": "d23",
        "b2": "b4",
    }
    assert mirrored.chain == Chain(4, 1, 1, 4, 1, 3, damped=True, ground_dampers=(1, 4))


def test_a_false_renaming_is_none():
    """Masses exchanged without the springs between them."""
    left, right = Chain(3, damped=False), Chain(3, act_plus=3, meas_plus=3, damped=False)
    names = {p: p for p in left.parameters}
    assert not is_renaming(left.structure, right.structure, names | {"m1": "m3", "m3": "m1"})
    assert is_renaming(
        left.structure,
        right.structure,
        names | {"m1": "m3", "m3": "m1", "k12": "k23", "k23": "k12"},
    )


def test_a_dead_time_is_renamed_to_a_dead_time_only():
    plain, delayed = (
        Chain(1, damped=False).structure,
        Chain(1, dead_time=True, damped=False).structure,
    )
    assert is_renaming(delayed, delayed, {"m1": "m1", "Td": "Td"})
    assert not is_renaming(delayed, delayed, {"m1": "Td", "Td": "m1"})
    assert not is_renaming(plain, delayed, {"m1": "m1"})
    assert not is_renaming(delayed, plain, {"m1": "m1", "Td": "Td"})


def test_the_family_lists_one_form_of_each_pair_but_where_constraint_38_does_not_see_the_grounded_part():
    """(38) leaves A2 beside A5, and A9 beside A10, though they are forms of each other."""
    shared = [
        (i, j)
        for i, a in enumerate(Family(3, damped=False), 1)
        for j, b in enumerate(Family(3, damped=False), 1)
        if i < j and canonical(a).chain == canonical(b).chain
    ]
    assert shared == [(2, 5), (9, 10)]
