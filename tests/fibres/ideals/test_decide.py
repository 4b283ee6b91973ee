"""Decisions of the ideal against the other exact decision, against hand-made models, and the
check of their evidence.
"""

from dataclasses import replace

import pytest

from disting.algebra.symbols import symbols
from disting.errors import InputError, NotSeenError
from disting.evidence.ideals import Refutation, Solutions
from disting.fibres.ideals import (
    CoefficientMap,
    Limits,
    coefficient_map,
    confirms,
    decide,
    match_maps,
    normalise as normal,
)
from disting.fibres.ideals.fibre_ideal import generic_rank
from disting.fibres.ideals.membership import is_empty
from disting.fibres.synthesis.decide import decide as by_synthesis
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.question import Membership
from disting.model.symmetry import canonical


def model(n, number, damped=True):
    return normal(canonical(Family(n, damped)[number]).chain.structure)


# of the 3-mass damped class, after conditions 1 to 9
OPEN = [(1, 6), (1, 8), (1, 11), (6, 8), (6, 11), (8, 11)]


@pytest.mark.parametrize(("i", "j"), OPEN)
def test_open_pairs_of_three_damped_masses(i, j):
    found = decide(model(3, i), model(3, j), equal_rank=True)
    other = by_synthesis(Family(3, True)[i], Family(3, True)[j])
    assert (
        found.membership.value
        == other.membership.value
        == ("member" if (i, j) == (1, 11) else "excluded")
    )
    assert found.safety >= 100
    assert found.evidence is not None and confirms(found.evidence, model(3, i), model(3, j))


@pytest.mark.full
def test_all_comparable_pairs_of_three_undamped_masses():
    """The 12 indistinguishable pairs of the published class, and no others among those of equal
    degrees and ranks.
    """
    models = {i: model(3, i, damped=False) for i in range(1, 12)}
    pairs = [
        (i, j) for i in models for j in models if i < j and models[i].degrees == models[j].degrees
    ]
    same = [
        (i, j) for i, j in pairs if generic_rank(models[i], "t") == generic_rank(models[j], "t")
    ]
    found = {(i, j): decide(models[i], models[j], equal_rank=True) for i, j in same}
    assert sum(d.membership is Membership.MEMBER for d in found.values()) == 12
    assert all(d.membership is not Membership.UNKNOWN and d.safety >= 100 for d in found.values())
    assert all(
        confirms(d.evidence, models[i], models[j]) for (i, j), d in found.items() if d.evidence
    )


@pytest.mark.full
def test_dual_chains_of_four_masses():
    found = decide(model(4, 1), model(4, 29), equal_rank=True)
    assert (
        found.membership is Membership.MEMBER
        and isinstance(found.evidence, Solutions)
        and found.safety >= 100
    )
    assert confirms(found.evidence, model(4, 1), model(4, 29))


@pytest.mark.full
def test_a_pair_of_four_masses_is_refuted():
    found = decide(model(4, 1), model(4, 8), equal_rank=True)
    assert (
        found.membership is Membership.EXCLUDED
        and isinstance(found.evidence, Refutation)
        and found.safety >= 100
    )


def test_ground_dampers_of_one_end():
    """Fig. 1, two masses: the damper at mass 1 or at mass 2 makes a difference for a sensor at
    mass 1.
    """
    chains = [Chain(2, damped=True, ground_dampers=(i,)) for i in (1, 2)]
    assert (
        decide(*(normal(c.structure) for c in chains), equal_rank=True).membership
        is Membership.EXCLUDED
    )


@pytest.mark.full
def test_ground_dampers_of_a_force_and_sensor_apart():
    """A3: force at 1, sensor at 3: every two dampers are indistinguishable."""
    chains = [Chain(3, 0, 0, 1, 0, 3, damped=True, ground_dampers=(i,)) for i in (1, 2)]
    models = [normal(c.structure) for c in chains]
    found = decide(*models, equal_rank=True)
    assert found.membership is Membership.MEMBER and confirms(found.evidence, *models)


@pytest.mark.parametrize(
    ("chains", "expected"),
    [
        ((Family(3, damped=False)[9], Family(3, damped=False)[10]), Membership.MEMBER),
        ([Chain(2, damped=True, ground_dampers=(i,)) for i in (1, 2)], Membership.EXCLUDED),
    ],
)
def test_own_parameters_give_the_same_answers(chains, expected):
    """Without normalisation a scale factor is needed; the question is the same."""
    models = [coefficient_map(chain.structure) for chain in chains]
    found = decide(*models, equal_rank=True)
    assert found.membership is expected and confirms(found.evidence, *match_maps(*models))


def family_of_squares():
    x, y = symbols(["x", "y"]).values()
    one = x**0
    line = CoefficientMap(("x", "y"), (x, x), (y, one))  # (x s + x)/(s + y)
    # a surface of dimension 2 that is another one
    plane = CoefficientMap(("x", "y"), (x, y), (x + y, one))
    return line, plane


def test_hand_made_models():
    line, plane = family_of_squares()
    assert decide(line, line, equal_rank=True).membership is Membership.MEMBER
    assert decide(line, plane, equal_rank=True).membership is Membership.EXCLUDED


def test_one_sided_inclusion():
    x = symbols(["x"])["x"]
    _, plane = family_of_squares()
    inside = CoefficientMap(("x",), (x, x), (2 * x, x**0))
    outside = CoefficientMap(("x",), (x, x), (x, x**0))
    found = decide(inside, plane, equal_rank=False)
    assert found.membership is Membership.MEMBER and confirms(found.evidence, inside, plane)
    found = decide(outside, plane, equal_rank=False)
    assert found.membership is Membership.EXCLUDED and confirms(found.evidence, outside, plane)


def test_one_sided_inclusion_with_infinitely_many_solutions():
    x, y, z = symbols(["x", "y", "z"]).values()
    doubled = CoefficientMap(("x", "y", "z"), (x * z, y * z), (x + y * z, x**0))
    line, _ = family_of_squares()
    found = decide(line, doubled, equal_rank=False)
    assert found.membership is Membership.MEMBER and confirms(found.evidence, line, doubled)


@pytest.mark.parametrize("seed", ["a", "b", "c", "d", "e", "f"])
def test_solutions_that_are_rare_modulo_primes_are_drawn_until_the_bound_is_reached(seed):
    """Half of all numbers are squares modulo a prime: one point in eight has a solution, in the
    direction with the roots.
    """
    x, y, z = symbols(["x", "y", "z"]).values()
    one = x**0
    plain = CoefficientMap(("x", "y", "z"), (x, y), (z + x * y, one))
    roots = CoefficientMap(("x", "y", "z"), (x**2, y**2), (z**2 + x**2 * y**2, one))
    for models in ((plain, roots), (roots, plain)):
        found = decide(*models, equal_rank=True, seed=seed)
        assert (
            found.membership is Membership.MEMBER
            and found.safety >= 100
            and confirms(found.evidence, *models)
        )


def test_symmetry_in_the_order_of_the_models():
    first, second = model(3, 1), model(3, 6)
    there, back = decide(first, second, equal_rank=True), decide(second, first, equal_rank=True)
    assert there.membership is back.membership is Membership.EXCLUDED


@pytest.mark.full
def test_results_depend_on_the_seed_only():
    a, b = model(3, 1), model(3, 11)
    assert decide(a, b, equal_rank=True) == decide(a, b, equal_rank=True)
    assert (
        decide(a, b, equal_rank=True, seed="x").evidence
        != decide(a, b, equal_rank=True, seed="y").evidence
    )


@pytest.mark.full
def test_forged_evidence_is_refused():
    a, b = model(3, 1), model(3, 11)
    found = decide(a, b, equal_rank=True)
    assert isinstance(found.evidence, Solutions)
    wrong = tuple(tuple(x + 1 for x in q) for q in found.evidence.solutions)
    assert not confirms(replace(found.evidence, solutions=wrong), a, b)
    assert not confirms(replace(found.evidence, labels=("other",) * len(wrong)), a, b)
    assert not confirms(Refutation(True, ("ideals:disting:0",), 4, True), a, b)
    assert not confirms(Refutation(True, (), 4, True), model(3, 1), model(3, 6))


@pytest.mark.full
def test_limits_make_it_unknown_with_the_reason():
    a, b = model(4, 1), model(4, 8)
    late = decide(a, b, equal_rank=True, limits=Limits(seconds=0.0))
    assert (
        late.membership is Membership.UNKNOWN
        and "out of time" in late.reason
        and late.evidence is None
    )
    small = decide(a, b, equal_rank=True, limits=Limits(entries=1000))
    assert small.membership is Membership.UNKNOWN and "too large" in small.reason


def test_what_a_short_time_allows_is_said_with_the_reason():
    """Here runs would go on for hours until the bound is reached."""
    line, plane = family_of_squares()
    brief = Limits(seconds=0.2, safety=10**7)
    for other, membership in ((line, Membership.MEMBER), (plane, Membership.EXCLUDED)):
        found = decide(line, other, equal_rank=True, limits=brief)
        assert found.membership is membership and confirms(found.evidence, line, other)
        assert found.reason == "out of time (0.2 s)" and 0 < found.safety < 10**7


def test_degrees_beyond_the_codes_are_too_large():
    x, y = symbols(["x", "y"]).values()
    high, plain = (CoefficientMap(("x", "y"), (x**n, y), (y, x**0)) for n in (70, 1))
    found = decide(high, plain, equal_rank=True)
    assert (found.membership, found.reason) == (Membership.MEMBER, "")  # in the other direction
    found = decide(high, high, equal_rank=True)
    assert (found.membership, found.reason) == (Membership.UNKNOWN, "too large: degree 70")


def test_a_contradiction_that_takes_too_long_is_not_seen():
    a, b = model(3, 1), model(3, 6)
    assert is_empty(a, b, equal_rank=True, label="again", limits=Limits())
    with pytest.raises(NotSeenError, match=r"not found again .too large: a matrix of"):
        is_empty(a, b, equal_rank=True, label="again", limits=Limits(entries=1))


def test_bad_questions():
    line, plane = family_of_squares()
    with pytest.raises(InputError, match="ranks"):
        decide(line, plane, equal_rank=False)
    assert decide(model(3, 1), model(2, 1), equal_rank=True).membership is Membership.UNKNOWN
    with pytest.raises(TypeError):
        bool(decide(line, line, equal_rank=True))
