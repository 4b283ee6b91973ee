"""What is a chain and what is none; names of parameters; families.

Structures: unions, rows; and the drawing in one line.
"""

import re
from dataclasses import FrozenInstanceError, replace

import pytest
from hypothesis import given, settings

from disting import (
    Chain,
    ConstraintViolation,
    Family,
    InputError,
    Quantity,
    Query,
    Relation,
    View,
    compare,
)
from disting.model.chain import (
    CONSTRAINTS,
    LEGEND,
    GroundDamper,
    Indices,
    Spring,
    Structure,
    text_drawing,
    violations,
)
from disting.model.minors import embeddings
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


VALID = (3, 1, 1, 2, 1, 3)

# --- (36) and (37): refused
# ------------------------------------------------------------------------------------------


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("indices", "equation", "text"),
    [
        ((3, 3, 1, 4, 1, 4), 36, "0 <= n_gap <= N_B - 1"),
        ((3, -1, 0, 1, 0, 1), 36, "0 <= n_gap <= N_B - 1"),
        ((3, 1, 2, 2, 1, 3), 36, "0 <= n_act- <= n_gap"),
        ((3, 1, -1, 2, 1, 3), 36, "0 <= n_act- <= n_gap"),
        ((3, 1, 1, 1, 1, 3), 36, "n_gap + 1 <= n_act+ <= N_B"),
        ((3, 1, 1, 4, 1, 3), 36, "n_gap + 1 <= n_act+ <= N_B"),
        ((3, 1, 1, 2, 2, 3), 36, "0 <= n_meas- <= n_gap"),
        ((3, 1, 1, 2, -1, 3), 36, "0 <= n_meas- <= n_gap"),
        ((3, 1, 1, 2, 1, 1), 36, "n_gap + 1 <= n_meas+ <= N_B"),
        ((3, 1, 1, 2, 1, 4), 36, "n_gap + 1 <= n_meas+ <= N_B"),
        ((3, 1, 0, 2, 1, 3), 37, "n_gap = 0 or n_act- > 0"),
        ((3, 1, 1, 2, 0, 3), 37, "n_gap = 0 or n_meas- > 0"),
    ],
)
def test_a_broken_constraint_is_named(indices, equation, text):
    with pytest.raises(ConstraintViolation) as refusal:
        Chain(*indices, damped=False)
    n, gap, act_minus, act_plus, meas_minus, meas_plus = indices
    words, _, symbols = str(refusal.value).partition(" (constraint ")
    assert (
        symbols == f"({equation}) {text} is violated by N_B={n}, n_gap={gap}, "
        f"n_act-={act_minus}, n_act+={act_plus}, n_meas-={meas_minus}, n_meas+={meas_plus})"
    )
    assert ", not " in words and re.search(r"gap|force|sensor", words) and "{" not in words


def test_the_limits_themselves_are_allowed():
    for indices in [
        VALID,
        (3, 2, 1, 3, 2, 3),
        (3, 2, 2, 3, 1, 3),
        (3, 0, 0, 1, 0, 3),
        (3, 0, 0, 3, 0, 1),
        (1, 0, 0, 1, 0, 1),
    ]:
        assert Chain(*indices, damped=False).indices == indices


def test_the_example_of_fig_9_is_refused():
    """N_B = 3, n_gap = 1, n_act+ = 3, n_act- = 1, n_meas+ = 2, n_meas- = 0: the sensor does not
    see mass 1.
    """
    with pytest.raises(ConstraintViolation, match=r"\(37\) n_gap = 0 or n_meas- > 0"):
        Chain(3, 1, 1, 3, 0, 2, damped=False)


@pytest.mark.parametrize(
    ("indices", "names"),
    [
        (VALID, []),
        ((3, 0, 0, 2, 0, 1), ["reciprocity-breaking"]),
        ((3, 1, 1, 3, 1, 3), ["reflection-breaking"]),
        ((3, 0, 0, 3, 0, 3), ["reflection-breaking"]),
        ((4, 0, 0, 3, 0, 2), ["reciprocity-breaking", "reflection-breaking"]),
        # Fig. 9
        ((3, 1, 1, 3, 0, 2), ["sensitivity", "reciprocity-breaking", "reflection-breaking"]),
    ],
)
def test_which_constraints_are_broken(indices, names):
    assert [c.name for c in violations(Indices(*indices), (36, 37, 38))] == names


def test_nine_constraints():
    assert [c.equation for c in CONSTRAINTS] == [36] * 5 + [37] * 2 + [38] * 2


# --- (38): another numbering
# -----------------------------------------------------------------------------------------


@pytest.mark.full
def test_a_chain_outside_38_is_a_model_with_another_number():
    outside, listed = Chain(3, 0, 0, 3, 0, 3, damped=True), Family(3, damped=True)[1]
    found = compare(outside, listed, query=Query(View.EXACT))
    assert (found.relation, found.decided_by) == (Relation.INDISTINGUISHABLE, "6")
    with pytest.raises(InputError, match="is not in the 3-mass family"):
        Family(3, damped=False).number(outside)


# --- bad input
# -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "arguments",
    [
        {"n_masses": 0},
        {"n_masses": -1},
        {"n_masses": 2.0},
        {"n_masses": "2"},
        {"n_masses": True},
        {"n_masses": 2, "gap": None},
        {"n_masses": 2, "meas_plus": 1.5},
        {"n_masses": 2, "quantity": "jerk"},
        {"n_masses": 2, "ground_dampers": (0,)},
        {"n_masses": 2, "ground_dampers": (3,)},
        {"n_masses": 2, "ground_dampers": (1, -1)},
        {"n_masses": 2, "ground_dampers": ("1",)},
        {"n_masses": 2, "ground_dampers": (1.0,)},
        {"n_masses": 2, "ground_dampers": (True,)},
    ],
    ids=str,
)
def test_bad_input(arguments):
    with pytest.raises(InputError):
        Chain(**arguments)


def test_chains_are_values():
    one, other = (
        Chain(2, ground_dampers=(2, 1, 2), damped=False),
        Chain(2, ground_dampers=[1, 2], quantity="acceleration", damped=False),
    )
    assert one == other
    assert hash(one) == hash(other)
    assert one.ground_dampers == (1, 2)
    assert one.quantity is Quantity.ACCELERATION
    with pytest.raises(FrozenInstanceError):
        one.gap = 1


# --- parameters, texts
# -----------------------------------------------------------------------------------------------


def test_parameters_in_fixed_order():
    chain = Chain(3, 1, 1, 2, 1, 3, damped=True, ground_dampers=(3, 1), lag=True, dead_time=True)
    assert chain.parameters == (
        "m1",
        "m2",
        "m3",
        "k01",
        "k23",
        "d01",
        "d23",
        "b1",
        "b3",
        "T1",
        "Td",
    )


def test_parameters_beyond_nine_masses_stay_apart():
    names = Chain(12, damped=True).parameters
    assert len(set(names)) == len(names) == 34
    assert {"k89", "k9_10", "k10_11", "k11_12"} <= set(names)


@settings(max_examples=50, deadline=None)
@given(chains(dead_time=True))
def test_numbers_of_parameters_and_states(chain):
    springs = chain.n_masses - 1
    expected = (
        chain.n_masses
        + springs * (1 + chain.damped)
        + len(chain.ground_dampers)
        + chain.lag
        + chain.dead_time
    )
    assert len(set(chain.parameters)) == len(chain.parameters) == expected
    assert chain.structure.n_states == 2 * chain.n_masses + chain.lag


@pytest.mark.parametrize(
    ("sensor", "order"), [("position", 0), ("velocity", 1), ("acceleration", 2)]
)
def test_sensor_orders(sensor, order):
    assert (
        Quantity(sensor).order
        == order
        == Chain(1, quantity=sensor, damped=False).structure.sensor_order
    )


def test_collocated_models_of_table_3():
    assert [i for i, chain in enumerate(Family(3, damped=False), 1) if chain.collocated] == [
        1,
        4,
        6,
        8,
        11,
    ]


def test_a_chain_in_words():
    assert str(Chain(2, damped=False)) == "2 masses, gap 0, force 1-0, sensor 1-0"
    assert (
        str(
            Chain(
                2,
                1,
                1,
                2,
                1,
                2,
                quantity="velocity",
                damped=True,
                ground_dampers=(1, 2),
                lag=True,
                dead_time=True,
            )
        )
        == "2 masses, gap 1, force 2-1, sensor 2-1, velocity, damped, ground dampers 1+2, lag, dead"
        " time"
    )


# --- families
# --------------------------------------------------------------------------------------------------------


def test_three_masses():
    assert [chain.indices[1:] for chain in Family(3, damped=False)] == [
        (0, 0, 1, 0, 1),
        (0, 0, 1, 0, 2),
        (0, 0, 1, 0, 3),
        (0, 0, 2, 0, 2),
        (0, 0, 2, 0, 3),
        (1, 1, 2, 1, 2),
        (1, 1, 2, 1, 3),
        (2, 1, 3, 1, 3),
        (2, 1, 3, 2, 3),
        (2, 2, 3, 1, 3),
        (2, 2, 3, 2, 3),
    ]


@pytest.mark.parametrize("n_masses", [1, 2, 3, 4, 5])
def test_numbers_and_order(n_masses):
    family = Family(n_masses, damped=True, quantity=Quantity.POSITION)
    assert [family.number(chain) for chain in family] == list(range(1, len(family) + 1))
    assert [chain.indices for chain in family] == sorted({chain.indices for chain in family})
    assert all(chain.damped and chain.quantity is Quantity.POSITION for chain in family)
    assert family[1] == family.models[0]


@pytest.mark.parametrize("number", [0, 12, -1, True, "1", 1.0])
def test_numbers_that_are_none(number):
    with pytest.raises(InputError, match="models 1 to 11"):
        Family(3, damped=False)[number]


@pytest.mark.parametrize("n_masses", [0, -2, "3", True, 2.0])
def test_families_that_are_none(n_masses):
    with pytest.raises(InputError, match="at least one mass"):
        Family(n_masses, damped=False)


def test_a_chain_with_extras_is_in_no_family():
    with pytest.raises(InputError, match="not in the 2-mass family"):
        Family(2, damped=False).number(Chain(2, ground_dampers=(1,), damped=False))


@pytest.mark.parametrize(
    ("words", "quantity"),
    [
        (("position", "pos", "angle", "Displacement", "Weg"), "position"),
        (("velocity", "speed", "omega", "SPEED "), "velocity"),
        (("acceleration", "accel", "acc"), "acceleration"),
    ],
)
def test_usual_words_for_a_quantity(words, quantity):
    assert {Chain(2, quantity=word).quantity.value for word in words} == {quantity}


@pytest.mark.parametrize("word", ["torque", "Torque per speed", "current", "iq"])
def test_what_drives_a_machine_is_no_quantity_of_its_response(word):
    with pytest.raises(InputError, match="what the sensor shows: position, velocity or acc"):
        Chain(2, quantity=word)
