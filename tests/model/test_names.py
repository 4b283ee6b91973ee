"""One name for a model: what is read, what is written, what is refused with its remedy."""

import pytest
from hypothesis import given, strategies as st

from disting import (
    Family,
    InputError,
    catalog,
    compare,
    compare_everywhere,
    equivalents,
    explicit_map,
    prove,
    transfer_function,
)
from disting.catalogs.dampers import damper_catalog
from disting.catalogs.next_files import next_catalog
from disting.catalogs.sizes import combined_family, sizes_catalog
from disting.decide.identifiability.analysis import identifiability
from disting.model.chain import Chain, Quantity
from disting.model.names import chain_of, name_of, read, read_together

EXTRAS = [(), ("+b1",), ("+b3", "+b1"), ("+lag",), ("+delay", "+b2", "+lag")]


@pytest.mark.full
@given(
    n=st.integers(1, 5),
    at=st.integers(0, 72),
    dampers=st.sets(st.integers(1, 5)),
    lag=st.booleans(),
    late=st.booleans(),
    damped=st.booleans(),
    quantity=st.sampled_from(Quantity),
)
def test_what_is_written_is_read_as_the_same_chain(
    n: int, at: int, dampers: set[int], lag: bool, late: bool, damped: bool, quantity: Quantity
) -> None:
    family = Family(n, damped, quantity)
    indices = family[1 + at % len(family)].indices
    on_it = tuple(i for i in dampers if i <= n)
    chain = Chain(*indices, quantity, damped, on_it, lag, late)
    assert read_together([name_of(chain)], damped=damped, quantity=quantity) == [chain]
    short = "A" + name_of(chain).partition(":")[2]
    assert chain_of(short, family, masses=n) == chain


@pytest.mark.parametrize("extras", EXTRAS)
def test_the_order_of_what_stands_behind_a_number_does_not_matter(extras: tuple[str, ...]) -> None:
    one = chain_of("3:4" + "".join(extras), Family(1, damped=False))
    assert one == chain_of("3:4" + "".join(reversed(extras)), Family(1, damped=False))
    assert (
        chain_of(
            " 3 : 4 " + " + ".join(["", *(e[1:] for e in extras)])[1:], Family(1, damped=False)
        )
        == one
    )


def test_a4_is_of_the_size_that_is_known() -> None:
    assert [name_of(c) for c in read_together(["A4", "3:1", "a2+b1"])] == ["3:4", "3:1", "3:2+b1"]
    assert name_of(read_together([Family(5, damped=False)[1], "A73"])[1]) == "5:73"
    for unknown in (["A4"], ["A4", "A1"], ["A4", "3:1", "4:1"]):
        with pytest.raises(InputError, match="A4: the number of masses is not known here; write"):
            read_together(unknown)
    with pytest.raises(InputError, match="models 1 to 11, not 12"):
        read_together(["3:1", "A12"])


def test_damping_and_quantity_are_said_or_taken_from_the_chain_beside() -> None:
    beside = Family(3, damped=False, quantity=Quantity.VELOCITY)[1]
    assert read_together(["3:4", beside])[0] == Family(3, False, Quantity.VELOCITY)[4]
    said = read_together(["3:4", beside], damped=True, quantity="position")
    assert said == [Family(3, True, Quantity.POSITION)[4], beside]
    assert read_together(["3:4"]) == [Family(3, damped=True)[4]]
    with pytest.raises(InputError, match="quantity is position"):
        read_together(["3:4"], quantity="jerk")


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("3.4", "3:4"),
        ("3;4", "3:4"),
        ("3-4", "3:4"),
        ("3:4+dealy", "3:4+delay"),
        ("3:4+d2", "3:4+b2"),
        ("3:4+2", "3:4+b2"),
        ("3:4+lga+dead time", "3:4+lag+delay"),
        ("3:4+deadtime", "3:4+delay"),
    ],
)
def test_what_is_near_to_a_name_is_named(typed: str, meant: str) -> None:
    with pytest.raises(InputError, match=r"did you mean") as refused:
        read(typed)
    assert str(refused.value).endswith(f"did you mean {meant}?")


@pytest.mark.parametrize("typed", ["", "x", "3", "3:", "3:4:5", "3:1" * 50_000, "3:4+", "+", "A"])
def test_what_is_near_to_nothing_is_only_refused(typed: str) -> None:
    with pytest.raises(InputError, match="for instance 3:4 or 3:4") as refused:
        read(typed)
    assert "did you mean" not in str(refused.value) and len(str(refused.value)) < 300


@pytest.mark.full
def test_public_functions_take_names() -> None:
    family = Family(3, damped=True)
    by_chains = compare(family[1], family[4])
    for named in (compare("3:1", "3:4", damped=True), compare(family[1], "A4")):
        assert named == by_chains
    assert (by_chains.left, by_chains.right) == ("3:1", "3:4")
    assert compare("3:1", "3:4", damped=False) != by_chains
    assert prove(by_chains, "3:1", "3:4", damped=True) == prove(by_chains, family[1], family[4])
    here, there = (
        compare_everywhere("2:1", "A2", ["sensor=2"]),
        compare_everywhere(Family(2, damped=True)[1], Family(2, damped=True)[2], ["sensor=2"]),
    )
    assert here == there
    assert transfer_function("3:4") == transfer_function(family[4])
    assert identifiability("3:4", damped=False) == identifiability(Family(3, damped=False)[4])
    assert explicit_map("3:1", "A11") == explicit_map(family[1], family[11])
    values = {"m1": 1, "m2": 2, "k12": 3}
    to = equivalents("2:1", values, "A2", damped=False)
    assert [listing.name for listing in to.listings] == ["2:2"]


@pytest.mark.full
def test_what_is_built_means_what_is_named():
    """Where nothing is said, a name, a chain, a family and every shipped table are damped."""
    assert read_together(["3:4"]) == [Family(3)[4]] == [Chain(3, 0, 0, 2, 0, 2)]
    assert Chain(3).damped and Family(3).damped and catalog(3).damped
    assert damper_catalog(3).family.damped and sizes_catalog().damped
    assert next_catalog(3).further((1, 11)).structures[0].damped
    assert {chain.damped for _, chain in combined_family((1, 2))} == {True}
    assert compare("3:1", "3:4").relation is compare(Family(3)[1], Family(3)[4]).relation


@pytest.mark.parametrize("family", [Family(3), Family(2, False, Quantity.POSITION)], ids=repr)
def test_a_family_prints_as_what_can_be_typed_in_again_and_its_chains_by_their_names(family):
    assert eval(repr(family), {"Family": Family}) == family
    names = [repr(chain).split()[1] for chain in family]
    assert read_together(names, damped=family.damped, quantity=family.quantity) == list(family)
    shown = repr(family)
    assert f"damped={family.damped}" in shown and f"quantity='{family.quantity}'" in shown


@pytest.mark.parametrize("kind", [Family, Chain])
@pytest.mark.parametrize("wrong", [{"damped": "no"}, {"damped": 1}, {"quantity": 3}], ids=str)
def test_damping_and_quantity_of_another_type_are_refused(kind, wrong):
    with pytest.raises(InputError, match=r"True or False|quantity is position"):
        kind(3, **wrong)
