"""Levels, counts and combinations, literally; identities of theorems; bad input."""

import json
from collections import Counter
from dataclasses import replace
from math import comb

import pytest

from disting import Certainty, Chain, Family, Settings
from disting.decide.identifiability.analysis import identifiabilities, identifiability, judge
from disting.decide.identifiability.answer import Identifiability
from disting.decide.identifiability.check import confirms
from disting.decide.identifiability.parts import Formula, Level, Origin
from disting.decide.identifiability.solutions import Listing, foster_count, images
from disting.decide.identifiability.tangent import short_vectors
from disting.fibres.synthesis.decide import rational_point
from disting.fibres.synthesis.task import Status, target
from disting.model.question import Answer


def levels(n_masses, damped):
    """(level, least, most) of each model, where infinitely many solutions have no count."""
    found = identifiabilities(Family(n_masses, damped))
    return [
        str(f.level) if f.level is Level.NOT else (str(f.level), f.least, f.most) for f in found
    ]


NOT, GLOBAL = "not identifiable", ("global", 1, 1)
TWO, THREE = ("local", 2, 2), ("local", 1, 3)


@pytest.mark.full
def test_three_masses():
    assert levels(3, False) == [GLOBAL, NOT, NOT, TWO, NOT, TWO, NOT, GLOBAL, NOT, NOT, GLOBAL]
    assert levels(3, True) == [
        GLOBAL,
        THREE,
        NOT,
        TWO,
        THREE,
        TWO,
        NOT,
        GLOBAL,
        GLOBAL,
        GLOBAL,
        GLOBAL,
    ]


@pytest.mark.full
def test_four_masses():
    assert Counter(levels(4, False)) == {
        NOT: 20,
        GLOBAL: 3,
        TWO: 1,
        ("local", 3, 3): 4,
        ("local", 6, 6): 1,
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    ("damped", "counts"),
    [
        (False, {NOT: 57, GLOBAL: 3, 3: 2, 4: 4, 6: 3, 8: 1, 12: 3}),
        (True, {NOT: 15, GLOBAL: 28, 2: 7, 3: 8, None: 15}),
    ],
)
def test_five_masses(damped, counts):
    assert (
        Counter(level if level in (NOT, GLOBAL) else level[2] for level in levels(5, damped))
        == counts
    )


@pytest.mark.parametrize(
    ("n_masses", "number", "damped", "combinations"),
    [
        (3, 2, False, ("k23/m3", "m1 + m2 + m3", "k12/(m1*m2)", "k12/m1 + k12/m2 + k23/m2")),
        (3, 3, False, ("m1 + m2 + m3", "k12*k23/(m1*m2*m3)", "k12/m1 + k12/m2 + k23/m2 + k23/m3")),
        (3, 9, False, ("m3", "k01", "k12/(m1*m2)", "k01/m1 + k12/m1 + k12/m2")),
        (3, 7, True, ("m1", "k01", "d01", "k23/d23", "m2 + m3", "k23/(m2*m3)")),
        (
            3,
            3,
            True,
            (
                "k12/d12",
                "k23/d23",
                "m1 + m2 + m3",
                "m1*m3/m2",
                "k12*k23/(m1*m2*m3)",
                "k12/m1 + k12/m2",
            ),
        ),
    ],
)
def test_what_can_be_determined(n_masses, number, damped, combinations):
    assert identifiability(Family(n_masses, damped)[number]).combinations == combinations


@pytest.mark.full
def test_the_sentences():
    said = {number: f.sentence for number, f in enumerate(identifiabilities(Family(3, True)), 1)}
    assert (
        said[1]
        == "7 parameters, all determinable; no other non-zero parameters, real or complex, give the"
        " same behaviour."
    )
    assert (
        said[2]
        == "7 parameters, all determinable; three parameter vectors (not all proven to exist) give"
        " the same behaviour; with random values one of them real, one positive."
    )
    assert (
        said[4] == "7 parameters, all determinable; two positive parameter vectors give the same"
        " behaviour: "
        "exchanging d12 ↔ d23, k12 ↔ k23, m1 ↔ m3 changes nothing."
    )
    assert (
        said[6] == "7 parameters, all determinable; two positive parameter vectors give the same"
        " behaviour: "
        "each is the dual (mirror image at the gap) of another."
    )
    assert (
        said[7] == "7 parameters, only 6 determinable: m1, k01, d01, k23/d23, m2 + m3, k23/(m2*m3)."
    )
    long = identifiability(Chain(4, meas_plus=4, damped=False))
    assert long.sentence.endswith("k34/m3 + k34/m4, transfer-function coefficient a2.")


@pytest.mark.full
@pytest.mark.parametrize("n_masses", [2, 3, 4])
def test_foster(n_masses):
    """Undamped chains with force and sensor at one place: all ways to share out poles and
    zeros, all positive.
    """
    for chain in Family(n_masses, damped=False):
        assert foster_count(replace(chain, lag=True)) is None
        if not chain.collocated:
            continue
        g, at, below = chain.gap, chain.act_plus, chain.act_minus
        expected = (
            comb(n_masses - 1, g)
            * comb(max(g - 1, 0), max(below - 1, 0))
            * comb(n_masses - g - 1, at - g - 1)
        )
        found = identifiability(chain)
        assert foster_count(chain) == expected == found.least == found.most == found.positive
        assert found.count_grade == (Certainty.THEOREM, 0)


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    "chain",
    [
        *Family(3, True),
        *Family(4, damped=False),
        Family(4, True)[11],
        Chain(5, 2, 2, 3, 2, 3, damped=True),
    ],
)
def test_exact_alternatives_have_the_same_transfer_function(chain):
    point = rational_point(chain, "test")
    for member in images(chain, point):
        there, here = target(chain.structure, member.values), target(chain.structure, point)
        assert (there.numerator, there.denominator) == (here.numerator, here.denominator)
        assert all(value > 0 for value in member.values.values())


def test_many_solutions_are_counted_by_the_theorem_and_not_listed():
    found = identifiability(Chain(10, 4, 4, 5, 4, 5, damped=False))
    assert (found.level, found.least, found.most) == (Level.LOCAL, 126, 126)
    assert found.sentence.endswith("126 positive parameter vectors give the same behaviour.")
    assert confirms(found, Chain(10, 4, 4, 5, 4, 5, damped=False))


@pytest.mark.full
def test_duality_of_a_chain_with_itself():
    found = identifiability(Chain(5, 2, 2, 3, 2, 3, damped=True))
    assert found.self_dual and found.level is Level.LOCAL and (found.least, found.most) == (2, 2)
    assert [a.origin for a in found.alternatives] == [Origin.GIVEN, Origin.DUALITY]
    assert (found.real, found.positive) == (2, 2)
    assert not identifiability(Chain(4, 2, 2, 3, 2, 3, damped=True)).self_dual


@pytest.mark.full
def test_single_parameters():
    found = identifiability(Family(3, True)[4])
    assert {c.text: c.unique for c in found.singles} == {"m2": Answer.YES} | dict.fromkeys(
        ("m1", "m3", "k12", "k23", "d12", "d23"), Answer.NO
    )
    assert [c.text for c in identifiability(Family(3, True)[7]).singles] == ["m1", "k01", "d01"]
    assert all(c.unique is Answer.YES for c in identifiability(Family(3, True)[1]).singles)


@pytest.mark.full
def test_what_the_synthesis_does_not_cover_is_unknown_but_the_ranks_are_told():
    chain = Chain(3, damped=True, ground_dampers=(1,))
    neighbours = Chain(3, meas_plus=2, damped=True, ground_dampers=(1, 2))
    for unknown in (neighbours, Family(4, True)[3]):
        found = identifiability(unknown)
        assert (found.level, found.rank, found.most) == (
            Level.UNKNOWN,
            len(unknown.parameters),
            None,
        )
        assert found.reason in found.sentence and found.reason
        assert len(found.singles) == found.rank
    assert identifiability(chain).level is Level.GLOBAL
    assert (
        identifiability(Chain(3, 0, 0, 2, 0, 2, damped=True, ground_dampers=(1, 3))).level
        is Level.LOCAL
    )
    short = identifiability(replace(chain, meas_plus=3, ground_dampers=(1, 2, 3)))
    assert (short.level, short.rank) == (Level.NOT, 8)
    assert "b1 + b2 + b3" in short.combinations


def test_a_dead_time_adds_one_parameter_and_nothing_else():
    plain = identifiability(Family(3, True)[6])
    late = identifiability(replace(Family(3, True)[6], dead_time=True))
    assert (late.level, late.least, late.most, late.rank) == (
        plain.level,
        plain.least,
        plain.most,
        plain.rank + 1,
    )
    assert {c.text: c.unique for c in late.singles}["Td"] is Answer.YES


@pytest.mark.full
def test_findings_are_confirmed_by_what_they_say():
    for chain in (
        *Family(3, True),
        Family(4, damped=False)[26],
        Chain(5, 2, 2, 3, 2, 3, damped=True, dead_time=True),
    ):
        assert confirms(identifiability(chain), chain), chain


@pytest.mark.full
def test_false_findings_are_not_confirmed():
    local, short, exchanged = (identifiability(Family(3, True)[number]) for number in (6, 7, 4))
    wrong = replace(short.basis[0], formula=Formula(((1, (("m2", 1),)),)))
    square = replace(short.singles[0], formula=Formula(((1, (("m1", 2),)),)))
    false = (
        (replace(short, singles=(square, *short.singles[1:])), 7),
        (replace(short, basis=(wrong, *short.basis[1:])), 7),
        (replace(short, basis=(short.basis[1], *short.basis[1:])), 7),
        (replace(short, singles=short.singles[1:]), 7),
        (replace(short, singles=(*short.singles, wrong)), 7),
        (replace(local, most=3), 6),
        (replace(local, alternatives=local.alternatives[:1]), 6),
        (
            replace(
                exchanged,
                renamings=(replace(exchanged.renamings[0], moved=(("m1", "m2"), ("m2", "m1"))),),
            ),
            4,
        ),
        (exchanged, 5),
    )
    for found, number in false:
        assert not confirms(found, Family(3, True)[number])


def test_one_mass():
    assert all(
        identifiability(Chain(1, damped=damped)).level is Level.GLOBAL for damped in (False, True)
    )


def test_a_single_solution_that_may_not_be_the_only_one_is_no_global_identifiability():
    proven = (Certainty.PROVEN, 0)
    for certainty, expected in (
        (Certainty.NUMERICAL, Level.UNKNOWN),
        (Certainty.PROVEN, Level.GLOBAL),
    ):
        known = Listing({}, (), Status.COMPLETE, 1, 1, (certainty, 0), "")
        assert judge(3, 3, proven, known)[0] is expected
        assert judge(3, 2, proven, known)[0] is Level.NOT


@pytest.mark.full
def test_grades():
    found = identifiability(Family(3, True)[1])
    assert found.rank_grade == (Certainty.PROVEN, 0) and found.safety == 0
    assert found.level_grade == found.count_grade == (Certainty.BOUNDED, 159)
    assert identifiability(Family(3, True)[2]).level_grade == (Certainty.NUMERICAL, 0)
    assert identifiability(Family(3, True)[6]).level_grade == (Certainty.THEOREM, 0)
    assert identifiability(Family(3, damped=False)[3]).rank_grade == (Certainty.PROVEN, 0)
    certainty, bits = identifiability(Family(3, True)[3]).rank_grade
    assert certainty is Certainty.BOUNDED and bits > 100


def test_no_vectors_are_short():
    assert short_vectors([]) == []


def test_formulas_for_print():
    formula = Formula(((1, (("k9_10", 2), ("m1", -1))), (-3, (("m2", 1),)), (1, (("T1", -1),))))
    assert formula.text == "k9_10**2/m1 - 3*m2 + 1/T1"
    assert formula.latex == r"\frac{k_{9,10}^{2}}{m_{1}} - 3 m_{2} + \frac{1}{T_{1}}"
    assert (
        identifiability(Chain(4, meas_plus=4, damped=False)).basis[-1].latex
        == r"\text{coefficient } a_{2}"
    )


@pytest.mark.full
def test_findings_turn_into_plain_data_and_back():
    for chain in (*Family(3, True), Chain(4, meas_plus=4, damped=False)):
        found = identifiability(chain)
        assert Identifiability.from_dict(json.loads(json.dumps(found.to_dict()))) == found
    with pytest.raises((KeyError, TypeError, ValueError)):
        Identifiability.from_dict({"level": "global"})


def test_findings_cannot_contradict_themselves_and_are_not_true_or_false():
    found = identifiability(Chain(2, damped=False))
    with pytest.raises(TypeError):
        bool(found)
    with pytest.raises(ValueError, match="least"):
        replace(found, least=2)
    with pytest.raises(ValueError, match="rank"):
        replace(found, rank=1)


@pytest.mark.full
def test_settings_steer_the_points():
    chain = Family(3, True)[3]
    one, three, five = (identifiability(chain, Settings(points=points)) for points in (1, 3, 5))
    assert one.combinations == three.combinations == five.combinations
    assert 100 <= one.safety <= three.safety < five.safety
