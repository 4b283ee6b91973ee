"""Findings: literally for the catalogues, and every ALWAYS and NEVER against the inverse
synthesis at random points.
"""

from collections import Counter
from dataclasses import replace
from itertools import combinations, pairwise, permutations

import numpy as np
import pytest

from disting import Certainty, Chain, Family, InputError, Quantity, Relation, View, catalog
from disting.decide.positive import confirms, positive_finding, proves
from disting.decide.positive.obstacles import obstacle, only_rows_sum_to_zero
from disting.decide.positive.points import equivalent, random_point, read
from disting.decide.same.real_and_positive import POSITIVELY
from disting.evidence.decision import Exclusion, Theorem
from disting.evidence.positive import (
    Empirical,
    EmptyFibre,
    Interlacing,
    OnlyOne,
    Points,
    PositiveFinding,
    Share,
)
from disting.fibres.synthesis.decide import rational_point
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.task import Status, target
from disting.model.question import Answer, Settings
from disting.model.symmetry import canonical
from tests.oracles.positive_synthesis import positive_equivalent

SHARES = {
    (3, False): {"Cauer": 6, "Foster": 14, "symmetry": 4},
    (3, True): {"duality": 2, "symmetry": 4},
    (4, False): {"Cauer": 6, "Foster": 66, "always": 5, "sometimes": 1, "symmetry": 14},
    (4, True): {"duality": 4, "symmetry": 14},
    (5, False): {"Cauer": 6, "Foster": 234, "always": 30, "sometimes": 6, "symmetry": 44},
    (5, True): {"duality": 4, "symmetry": 44},
}


def chains(n, damped):
    family = Family(n, damped)
    return list(dict.fromkeys(canonical(family[i]).chain for i in range(1, len(family) + 1)))


def indistinguishable(n, damped):
    """Ordered pairs of canonical forms, each unordered pair of forms once."""
    whole, seen = catalog(n, damped=damped), set()
    for i, j, v in whole.pairs(View.EXACT):
        pair = tuple(canonical(whole.family[k]).chain for k in (i, j))
        if v.relation is Relation.INDISTINGUISHABLE and pair not in seen:
            seen.add(pair)
            yield from (pair, pair[::-1])


def synthesised(given, point, other):
    """What the inverse synthesis says: an empty fibre is a NO."""
    if fibre(other, target(given.structure, point)).status is Status.EMPTY:
        return Answer.NO
    return positive_equivalent(given, point, other)


def agrees(given, other, found, points):
    for k in range(points):
        point = random_point(given, f"check:{k}")
        truth = synthesised(given, point, other)
        assert (found.share, truth) not in ((Share.ALWAYS, Answer.NO), (Share.NEVER, Answer.YES))
        if not given.damped and given.gap == other.gap:
            assert {truth, equivalent(given, point, other)} != {Answer.YES, Answer.NO}


@pytest.mark.full
@pytest.mark.parametrize(
    ("n", "damped"), [p if p[0] < 5 else pytest.param(*p, marks=pytest.mark.slow) for p in SHARES]
)
def test_catalogues_have_no_open_pair(n, damped):
    shares = Counter()
    for given, other in indistinguishable(n, damped):
        found = positive_finding(given, other)
        assert found.certainty is Certainty.THEOREM and confirms(found.evidence, given, other)
        assert POSITIVELY.decode(POSITIVELY.encode(found)) == found
        shares[
            found.evidence.name if isinstance(found.evidence, Theorem) else found.share.value
        ] += 1
    assert shares == SHARES[n, damped]


@pytest.mark.full
@pytest.mark.parametrize(
    ("n", "i", "j"), [(4, 6, 2), (5, 7, 2), (5, 8, 3), (5, 18, 14), (5, 64, 59), (5, 64, 69)]
)
def test_sometimes_one_way_always_the_other(n, i, j):
    family = Family(n, damped=False)
    there = positive_finding(family[i], family[j])
    assert (
        there.share is Share.SOMETIMES
        and there.empirical.tries == 100
        and 50 < there.empirical.hits < 95
    )
    assert (
        isinstance(there.evidence, Interlacing)
        and there.evidence.with_one
        and there.evidence.without
    )
    back = positive_finding(family[j], family[i])
    assert back.share is Share.ALWAYS and isinstance(back.evidence, Interlacing)


@pytest.mark.full
@pytest.mark.parametrize(("n", "i", "j"), [(4, 6, 2), (5, 7, 2), (5, 18, 14), (5, 64, 69)])
def test_points_are_what_the_synthesis_says(n, i, j):
    given, other = Family(n, damped=False)[i], Family(n, damped=False)[j]
    evidence = positive_finding(given, other).evidence
    assert synthesised(given, read(evidence.with_one), other) is Answer.YES
    assert synthesised(given, read(evidence.without), other) is Answer.NO


@pytest.mark.full
@pytest.mark.parametrize(("n", "i", "j"), [(3, 7, 6), (4, 20, 8)])
def test_inclusions_with_a_negative_grounded_part(n, i, j):
    """Generic models are included over the real numbers, by one solution whose grounded row is
    negative.
    """
    given, other = Family(n, damped=True)[i], Family(n, damped=True)[j]
    found = positive_finding(given, other)
    assert (
        found.share is Share.NEVER
        and found.certainty is Certainty.PROVEN
        and found.evidence.name == "swapped parts"
    )
    assert confirms(found.evidence, given, other)
    for k in range(10):
        listed = fibre(other, target(given.structure, random_point(given, f"inclusion:{k}")))
        assert listed.status is Status.COMPLETE and all(
            s.values["m1"].real < 0 for s in listed.solutions
        )


def assert_claims_hold(pairs, points):
    for given, other in pairs:
        found = positive_finding(given, other)
        assert found.evidence is None or confirms(found.evidence, given, other)
        agrees(given, other, found, points)


@pytest.mark.full
@pytest.mark.parametrize(("n", "damped", "every"), [(3, False, 1), (3, True, 2), (4, False, 9)])
def test_claims_on_ordered_pairs(n, damped, every):
    assert_claims_hold(list(permutations(chains(n, damped), 2))[::every], 2)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("n", "damped", "points"), [(3, False, 300), (3, True, 100), (4, False, 60), (4, True, 10)]
)
def test_claims_on_all_ordered_pairs_at_many_points(n, damped, points):
    assert_claims_hold(permutations(chains(n, damped), 2), points)


@pytest.mark.slow
@pytest.mark.parametrize("n", [4, 5])
def test_interlacing_at_hundreds_of_points(n):
    for given, other in indistinguishable(n, False):
        found = positive_finding(given, other)
        if isinstance(found.evidence, Interlacing):
            agrees(given, other, found, 300)


def test_each_obstacle():
    undamped = [
        (Chain(3, damped=False), Chain(3, meas_plus=2, damped=False), "decay"),
        (Chain(3, 1, 1, 2, 1, 3, damped=False), Chain(3, damped=False), "residues"),
        (Chain(4, 1, 1, 2, 1, 2, damped=False), Chain(4, 1, 1, 2, 1, 3, damped=False), "own poles"),
        (Chain(5, 2, 1, 3, 2, 5, damped=False), Chain(5, meas_plus=2, damped=False), "signs"),
    ]
    for given, other, name in undamped:
        found = positive_finding(given, other)
        assert (found.share, found.certainty, found.evidence) == (
            Share.NEVER,
            Certainty.THEOREM,
            Exclusion(name),
        )


@pytest.mark.full
@pytest.mark.parametrize("n", [4, 5])
def test_residues_change_their_signs_as_often_as_the_obstacle_says(n):
    """In floating point: every sum of two rows that the obstacle excludes against every row
    without a gap.
    """
    rows = [
        Chain(n, act_plus=a, meas_plus=b, damped=False) for a, b in combinations(range(1, n + 1), 2)
    ]
    sums = [c for c in chains(n, False) if c.gap]
    least = {c: min(sign_changes(c, k) for k in range(40)) for c in sums}
    most = {c: max(sign_changes(c, k) for k in range(40)) for c in rows}
    excluded = [(s, r) for s in sums for r in rows if obstacle(s, r) == "signs"]
    assert all(least[s] > most[r] for s, r in excluded) and len(excluded) == {4: 0, 5: 4}[n]


def sign_changes(chain, k):
    """Of the residues in the order of the poles, from the modes of both rows."""
    point = {name: float(v.p) / float(v.q) for name, v in random_point(chain, f"signs:{k}").items()}
    grounded = modes(point, 1, chain.gap, chain.act_minus, chain.meas_minus) if chain.gap else []
    free = modes(point, chain.gap + 1, chain.n_masses, chain.act_plus, chain.meas_plus)
    signs = [residue > 0 for _, residue in sorted(grounded + free)]
    return sum(x != y for x, y in pairwise(signs))


def modes(point, first, last, force, sensor):
    """(pole, residue) of each mode of the row of these masses; slow modes first when sorted."""
    size, names = last - first + 1, range(first, last + 1)
    k = np.zeros((size + 1, size + 1))
    for at, mass in enumerate(names):
        spring = point.get(f"k{mass - 1}{mass}", 0.0) if at or first == 1 else 0.0
        k[at : at + 2, at : at + 2] += spring * np.array([[1, -1], [-1, 1]])
    root = np.sqrt([point[f"m{mass}"] for mass in names])
    poles, shapes = np.linalg.eigh(k[1:, 1:] / np.outer(root, root))
    shapes = shapes / root[:, None]
    return list(zip(poles, shapes[force - first] * shapes[sensor - first], strict=True))


def test_empty_fibre_is_bounded():
    family = Family(3, damped=True)
    found = positive_finding(family[1], family[4])
    assert (
        found.share is Share.NEVER and found.certainty is Certainty.BOUNDED and found.safety >= 100
    )
    assert isinstance(found.evidence, EmptyFibre) and confirms(found.evidence, family[1], family[4])


@pytest.mark.full
def test_whole_against_sum():
    """A sum of two rows in a chain without a gap: some have their zeros between the poles,
    some not.
    """
    given, other = Chain(4, 2, 1, 3, 2, 4, damped=False), Chain(4, meas_plus=2, damped=False)
    found = positive_finding(given, other)
    assert (
        found.share is Share.SOMETIMES
        and found.certainty is Certainty.PROVEN
        and isinstance(found.evidence, Points)
    )


def test_proof_of_swap_needs_simple_parts():
    """Equal poles on both sides of the gap: nothing is proven at such a point."""
    chain = Family(3, damped=True)[7]
    point = rational_point(chain, "swap")
    assert only_rows_sum_to_zero(chain, point, 2)
    reduced = 1 / point["m2"] + 1 / point["m3"]
    assert not only_rows_sum_to_zero(
        chain, point | {f"{x}01": point[f"{x}23"] * reduced * point["m1"] for x in "kd"}, 2
    )


@pytest.mark.full
def test_large_chains_stay_honest():
    """Whether 0-0-2-2-0-0 occurs with ports 3 and 5 of 7 is open: nothing is claimed that rests
    on it.
    """
    found = positive_finding(
        Chain(7, 0, 0, 3, 0, 5, damped=False), Chain(7, 0, 0, 2, 0, 4, damped=False)
    )
    assert found.share is Share.SOMETIMES
    assert (0, 0, 2, 2, 0, 0) not in found.evidence.parts[0].lacking
    assert (
        positive_finding(
            Chain(8, 7, 3, 8, 5, 8, damped=False), Chain(8, 7, 3, 8, 5, 8, damped=False)
        ).share
        is Share.ALWAYS
    )


@pytest.mark.full
def test_false_evidence_is_refused():
    six, two = Family(4, damped=False)[6], Family(4, damped=False)[2]
    found = positive_finding(six, two)
    evidence = found.evidence
    assert proves(found, six, two)
    for other in (Points(evidence.with_one, evidence.without), OnlyOne(1)):  # of other certainty
        assert not proves(replace(found, evidence=other), six, two)
    swapped = replace(evidence, with_one=evidence.without, without=evidence.with_one)
    nothing_lacking = replace(evidence, parts=tuple(replace(p, lacking=()) for p in evidence.parts))
    negative = replace(evidence, without=(("m1", "-1"), *evidence.without[1:]))
    assert confirms(evidence, six, two)
    assert not any(
        confirms(e, six, two) for e in (swapped, nothing_lacking, negative, Theorem("Foster"))
    )
    assert not confirms(Exclusion("residues"), six, two)
    with pytest.raises(ValueError, match="no theorem is called"):
        Theorem("")
    assert not confirms(Points(evidence.without, evidence.with_one), six, two)
    damped = Family(3, damped=True)
    shared = positive_finding(damped[7], damped[6]).evidence
    assert not confirms(shared, damped[6], damped[6]) and not confirms(
        replace(shared, point=()), damped[7], damped[6]
    )


def test_what_is_not_covered_is_unknown():
    friction = [Chain(3, 0, 0, 1, 0, 3, damped=True, ground_dampers=(at,)) for at in (1, 2)]
    assert positive_finding(*friction).share is Share.UNKNOWN
    assert positive_finding(friction[0], friction[0]).share is Share.ALWAYS


def test_bad_input():
    for other in (
        Chain(4, damped=False),
        Chain(3, damped=True),
        Chain(3, quantity=Quantity.POSITION, damped=False),
        Chain(3, dead_time=True, damped=False),
    ):
        with pytest.raises(InputError):
            positive_finding(Chain(3, damped=False), other)


def test_findings_cannot_contradict_themselves():
    with pytest.raises(ValueError, match="not unknown"):
        PositiveFinding(Share.ALWAYS)
    with pytest.raises(ValueError, match="bound"):
        PositiveFinding(Share.NEVER, Certainty.PROVEN, 120, Exclusion("decay"))
    assert (
        PositiveFinding(Share.NEVER, Certainty.BOUNDED, 0, Exclusion("decay")).share
        is Share.UNKNOWN
    )
    with pytest.raises(ValueError, match="tries"):
        Empirical(8, 10, 3)
    with pytest.raises(TypeError):
        bool(positive_finding(Chain(3, damped=False), Chain(3, damped=False)))


def test_interval_widens_with_open_points():
    low, high = Empirical(50, 100).interval
    assert (round(low, 3), round(high, 3)) == (0.404, 0.596)
    wide = Empirical(50, 100, 20).interval
    assert wide[0] == low and wide[1] > high


@pytest.mark.full
def test_seed_moves_points_not_shares():
    six, two = Family(4, damped=False)[6], Family(4, damped=False)[2]
    findings = [positive_finding(six, two, Settings(seed=seed)) for seed in ("a", "b")]
    assert findings[0].evidence.with_one != findings[1].evidence.with_one
    assert findings[0].share is findings[1].share
