"""Structures: unions, rows; and the drawing in one line."""

from dataclasses import replace

import pytest
from hypothesis import given, settings

from disting import Chain, Family, InputError
from disting.model.chain import LEGEND, text_drawing
from disting.model.minors import embeddings
from disting.model.structure import GroundDamper, Spring, Structure
from tests.laws.strategies import chains

quick = settings(max_examples=40, deadline=None)


def without(structure, *elements):
    kept = tuple(e for e in structure.elements if e not in elements)
    return Structure(
        structure.n_masses,
        kept,
        structure.ports,
        structure.sensor_order,
        structure.lag,
        structure.dead_time,
    )


@pytest.mark.parametrize("order", [-1, 3])
def test_a_derivative_whose_transfer_function_is_not_proper_is_refused(order):
    """Its Markov parameters were those of the proper part alone, and verdicts rested on them."""
    with pytest.raises(InputError, match="is not proper"):
        replace(Chain(2, damped=False).structure, sensor_order=order)


# --- unions
# ----------------------------------------------------------------------------------------------------------


@quick
@given(chains(dead_time=True))
def test_united_with_itself(chain):
    assert chain.structure.united(chain.structure) == chain.structure


@pytest.mark.parametrize(
    ("one", "other", "both"), [((1,), (2,), (1, 2)), ((), (3,), (3,)), ((1, 2), (2, 3), (1, 2, 3))]
)
def test_united_ground_dampers(one, other, both):
    left, right, union = (
        Chain(3, damped=True, ground_dampers=masses).structure for masses in (one, other, both)
    )
    assert left.united(right) == right.united(left) == union


def test_united_gaps_have_none():
    left, right = Family(4, damped=True)[11].structure, Family(4, damped=True)[13].structure
    whole = left.united(right)
    assert whole.parameters == (
        "m1",
        "m2",
        "m3",
        "m4",
        "k01",
        "k12",
        "k23",
        "k34",
        "d01",
        "d12",
        "d23",
        "d34",
    )
    assert (left.row_ends, right.row_ends, whole.row_ends) == (
        ((1, 1), (2, 4)),
        ((1, 2), (3, 4)),
        ((1, 4),),
    )
    assert all(list(embeddings(part, whole)) for part in (left, right))


def test_united_sizes_and_extras():
    left, right = (
        Chain(2, lag=True, damped=False).structure,
        Chain(3, ground_dampers=(3,), dead_time=True, damped=False).structure,
    )
    whole = left.united(right)
    assert right.united(left).parameters == whole.parameters
    assert (whole.n_masses, whole.lag, whole.dead_time, whole.n_states) == (3, True, True, 7)
    assert whole.parameters == ("m1", "m2", "m3", "k12", "k23", "b3", "T1", "Td")


# --- rows
# ----------------------------------------------------------------------------------------------------------


@quick
@given(chains(max_masses=6))
def test_a_gap_makes_two_rows(chain):
    n, gap = chain.n_masses, chain.gap
    assert chain.structure.row_ends == (((1, gap), (gap + 1, n)) if gap else ((1, n),))


def test_rows_of_a_structure_with_few_springs():
    chain = Chain(4, damped=False).structure
    assert without(chain, Spring(2)).row_ends == ((1, 2), (3, 4))
    assert without(chain, Spring(1), Spring(3)).row_ends == ((1, 1), (2, 3), (4, 4))
    assert without(chain, GroundDamper(1)).row_ends == ((1, 4),)


# --- drawings
# --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("n_masses", [1, 2, 3, 4, 5])
def test_drawings_of_a_family_are_distinct(n_masses, damped):
    drawings = [text_drawing(chain) for chain in Family(n_masses, damped)]
    assert len(set(drawings)) == len(drawings)
    assert (
        not set(drawings) & {text_drawing(chain) for chain in Family(n_masses, not damped)}
        or n_masses == 1
    )


@pytest.mark.parametrize(
    ("chain", "drawing"),
    [
        (Chain(1, damped=False), "[1FS]"),
        (Chain(2, damped=True, ground_dampers=(2,)), "[1FS]=[2],"),
        (Chain(3, 2, 1, 3, 2, 3, damped=False), "#~[1f]~[2s]   [3FS]"),
        (Chain(3, 1, 1, 3, 1, 2, damped=True, ground_dampers=(1, 3)), "#=[1fs],   [2S]=[3F],"),
    ],
)
def test_drawings(chain, drawing):
    assert text_drawing(chain) == drawing


def test_the_legend_names_every_sign():
    assert all(sign in LEGEND for sign in "#~=,FfSs")
