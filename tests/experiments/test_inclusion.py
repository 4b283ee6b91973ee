"""Limits and submodels under several experiments: exact identities and ranks by plain SymPy, and
what is known of each experiment alone.
"""

from dataclasses import replace
from itertools import combinations, permutations

import pytest
from sympy import Rational, Symbol

from disting import Chain, Engine, Experiment, Family, Inclusion, Query, View, compare, findings
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.evidence.conditions import Counts
from disting.experiments.experiment import MeasuredChain
from disting.experiments.inclusion import inclusions_under, numbering
from disting.experiments.machine_model import MachineModel
from disting.experiments.measured_evidence import confirms, confirms_inclusion
from disting.model.question import Settings
from tests.experiments.plain_stack import determined, transfer

EXACT = Query(View.EXACT)
AS_IT_IS, SENSOR, LOCKED, INERTIA = (
    (Experiment(), {}),
    (Experiment(sensor=1), {"sensor": (1, 0)}),
    (Experiment(locked=3), {"locked": (3,)}),
    (Experiment(inertias={2: "3/2"}), {"inertias": {2: "3/2"}}),
)
TWO = [AS_IT_IS, SENSOR]
PLAIN = Chain(3, meas_plus=2, damped=False)


def with_dampers(*masses, damped=False, chain=PLAIN):
    return replace(chain, ground_dampers=masses, damped=damped)


def measured(chain, used=TWO):
    return MeasuredChain(chain, tuple(e for e, _ in used))


def profile_of(of):
    return profile(MachineModel(of), Representation.TF, 0, Settings(subset_limit=0))


def goes_over(part, whole, used):
    """Whether the elements that the part lacks, at zero, make all responses those of the part."""
    values = {name: Symbol(name) for name in part.parameters}
    rest = dict.fromkeys(set(whole.parameters) - set(values), 0)
    for _, plain in used:
        n1, d1 = transfer(part, values, **plain)
        n2, d2 = transfer(whole, values | rest, **plain)
        if (n1 * d2 - n2 * d1).expand() != 0 or d2 == 0:
            return False
    return True


CHAINS = [with_dampers(), with_dampers(1), with_dampers(1, 2), with_dampers(damped=True)]


@pytest.mark.full
@pytest.mark.parametrize("used", [TWO, [AS_IT_IS, LOCKED], [SENSOR, INERTIA]])
def test_a_part_is_a_limit_of_the_whole(used):
    for part, whole in permutations(CHAINS, 2):
        if set(part.parameters) < set(whole.parameters):
            places = numbering(measured(part, used), measured(whole, used))
            assert places == {i: i for i in range(4)} and goes_over(part, whole, used)
        else:
            assert numbering(measured(part, used), measured(whole, used)) is None


def test_limits_are_told_with_their_evidence():
    small, large = with_dampers(1), with_dampers(1, 3, damped=True)
    found = compare(small, large, experiments=[e for e, _ in TWO], query=EXACT)
    assert (found.relation.value, found.closure) == ("distinguishable", Inclusion.LEFT_IN_RIGHT)
    evidence = found.inclusions.closure.evidence
    assert evidence.sentence("A", "B").startswith("A is B with some elements missing")
    assert confirms(evidence, measured(small), measured(large))
    assert not confirms(replace(evidence, left_is_part=False), measured(small), measured(large))
    assert not confirms(
        replace(evidence, numbering=((0, 0), (1, 2), (2, 1), (3, 3))),
        measured(small),
        measured(large),
    )
    turned = compare(large, small, experiments=[e for e, _ in TWO], query=EXACT)
    assert turned.closure is Inclusion.RIGHT_IN_LEFT


def test_a_part_at_other_masses_is_none():
    """The same chains, the second sensor at different things."""
    small, large = with_dampers(), with_dampers(1)
    at = [(Experiment(), Experiment()), (Experiment(sensor=1), Experiment(sensor=3))]
    sides = [
        MeasuredChain(c, tuple(e))
        for c, e in zip((small, large), zip(*at, strict=True), strict=True)
    ]
    assert numbering(*sides) is None


def test_a_shorter_chain_is_a_limit_of_a_longer_one():
    short, long = Chain(2, damped=True), Chain(3, damped=True)
    both = [Experiment(), Experiment(sensor=2)]
    assert compare(short, long, experiments=both, query=EXACT).closure is Inclusion.LEFT_IN_RIGHT
    further = [Experiment(), Experiment(inertias={2: 1})]
    assert compare(long, short, experiments=further, query=EXACT).closure is Inclusion.RIGHT_IN_LEFT


def test_ranks_under_experiments_are_evidence_that_is_checked():
    """Of the rows of one experiment, or of as many as can be chosen freely."""
    family, used = Family(3, damped=False), (Experiment(), Experiment(sensor=2))
    left, right = (MeasuredChain(family[n], used) for n in (2, 8))
    found = inclusions_under(left, right, profile_of).closure
    assert found.inclusion is Inclusion.NEITHER and found.evidence.kind == "larger-projection"
    assert confirms_inclusion(found.evidence, left, right)
    for changes in ({"rows": ("b0[3]",)}, {"left": found.evidence.left + 1}):
        assert not confirms_inclusion(replace(found.evidence, **changes), left, right)
    locked = (Experiment(), Experiment(locked=1))
    larger, smaller = (MeasuredChain(family[n], locked) for n in (1, 2))
    full = inclusions_under(larger, smaller, profile_of).closure
    assert full.inclusion is Inclusion.RIGHT_IN_LEFT and full.evidence.kind == "full-image"
    assert confirms_inclusion(full.evidence, larger, smaller)
    for changes in ({"left_is_larger": False}, {"rank": full.evidence.rank + 1}):
        assert not confirms_inclusion(replace(full.evidence, **changes), larger, smaller)


@pytest.mark.full
def test_one_experiment_that_determines_more_excludes():
    """Alone the left model has the larger rank in one experiment, together the smaller one."""
    seen = 0
    family = list(Family(3, damped=False))
    used = (Experiment(), Experiment(locked=1))
    for left, right in permutations(family, 2):
        sides = [MeasuredChain(c, used) for c in (left, right)]
        profiles = [profile_of(m) for m in sides]
        alone = [[profile_of(MeasuredChain(m.chain, (e,))).rank for e in used] for m in sides]
        crossed = any(a > b for a, b in zip(*alone, strict=True))
        if profiles[0].rank < profiles[1].rank and crossed:
            seen += 1
            found = inclusions_under(*sides, profile_of)
            assert found.closure.inclusion is Inclusion.NEITHER
    assert seen


@pytest.mark.full
def test_what_holds_of_all_holds_of_each():
    """A limit in all experiments together is one in each, where that is known."""
    engine = Engine()
    chains = [with_dampers(*b) for n in range(3) for b in combinations((1, 2, 3), n)]
    for left, right in combinations(chains, 2):
        together = compare(left, right, experiments=[e for e, _ in TWO], query=EXACT, engine=engine)
        if together.closure in (Inclusion.LEFT_IN_RIGHT, Inclusion.RIGHT_IN_LEFT):
            for experiment, _ in TWO:
                alone = compare(left, right, experiments=[experiment], query=EXACT, engine=engine)
                excluded = {Inclusion.NEITHER, together.closure.turned}
                assert alone.closure not in excluded, (left, right, experiment)


@pytest.mark.full
@pytest.mark.parametrize("names", [("1:1", "2:2"), ("2:1", "3:2")])
@pytest.mark.parametrize("damped", [False, True])
def test_a_rigid_spring_is_a_limit_under_experiments(names, damped):
    """k12 -> infinity raises no relative degree: what is told without experiments is told with
    them.
    """
    left, right = (Family(int(n), damped)[int(i)] for n, i in (x.split(":") for x in names))
    assert compare(left, right, query=EXACT).closure is Inclusion.LEFT_IN_RIGHT
    changes = [{"inertias": {1: 1}}, {"springs": {1: 1}}, {"sensor": 1}]
    changes += [{"locked": 2}] if left.n_masses > 1 else []
    for change in changes:
        places = [change, change | {"locked": 3}] if "locked" in change else [change, change]
        sides = [
            MeasuredChain(c, (Experiment(), Experiment(**e)))
            for c, e in zip((left, right), places, strict=True)
        ]
        found = inclusions_under(*sides, profile_of).closure
        assert found.inclusion is Inclusion.LEFT_IN_RIGHT
        assert "masses 1 and 2 one rigid body" in found.evidence.sentence("A", "B")
        assert confirms(found.evidence, *sides)
        apart = found.evidence.numbering[:-1]
        assert not confirms(replace(found.evidence, numbering=apart), *sides)
        assert not confirms_inclusion(Counts((0, 0), (0, 2)), *sides)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_a_lag_is_a_limit_under_experiments(damped):
    """T1 -> 0, for all chains of 2 and 3 masses."""
    for chain in (*Family(2, damped), *Family(3, damped)):
        sides = [measured(replace(chain, lag=lag)) for lag in (False, True)]
        found = inclusions_under(*sides, profile_of).closure
        assert found.inclusion is Inclusion.LEFT_IN_RIGHT
        degrees = [p.degrees[:2] for p in map(profile_of, sides)]
        assert not confirms_inclusion(Counts(*degrees), *sides)


def test_known_sizes_of_one_body_add_up():
    """Inertias on two masses that become one; a mass at rest may carry what it likes."""
    part, whole = Chain(1, damped=True), Chain(3, damped=True)
    alone = MeasuredChain(part, (Experiment(), Experiment(inertias={1: 3})))
    for inertias, inside in (({1: 1, 2: 2}, True), ({1: 3, 3: 7}, True), ({1: 2, 2: 2}, False)):
        both = MeasuredChain(whole, (Experiment(), Experiment(inertias=inertias)))
        found = inclusions_under(alone, both, profile_of).closure.inclusion
        assert (found is Inclusion.LEFT_IN_RIGHT) == inside and found is not Inclusion.NEITHER


@pytest.mark.full
def test_condition_8_under_experiments():
    """Equal rank and a part: the same behaviour, and so say the other conditions."""
    chain = Chain(3, act_plus=1, meas_plus=3, damped=False)
    part, whole = with_dampers(1, chain=chain), with_dampers(1, 2, chain=chain)
    used = [AS_IT_IS, (Experiment(quantity="position"), {})]
    experiments = [e for e, _ in used]
    point = {n: Rational(k + 2, k + 5) for k, n in enumerate(whole.parameters)}
    ranks = [determined(c, {n: point[n] for n in c.parameters}, [{}])[0] for c in (part, whole)]
    assert ranks[0] == ranks[1] and goes_over(part, whole, [AS_IT_IS])
    by_8 = compare(part, whole, experiments=experiments, query=Query(View.COMBINED, ("8",)))
    assert (by_8.relation.value, by_8.decided_by) == ("indistinguishable", "8")
    without = Query(View.EXACT, conditions=tuple("1234567"))
    assert compare(part, whole, experiments=experiments, query=without).relation is by_8.relation
    sides = [measured(c, used) for c in (part, whole)]
    assert confirms(by_8.evidence, *sides)
    assert not confirms(replace(by_8.evidence, rank=9), *sides)


def test_condition_9_is_not_asked_under_experiments():
    a, b = Family(3, damped=False)[6], Family(3, damped=False)[8]
    query = Query(View.COMBINED, ("9",))
    found = compare(a, b, experiments=[Experiment(), Experiment(sensor=3)], query=query)
    assert found.relation.value == "undecided"
    assert len(findings(a, b)) > 8


def test_a_dead_time_on_one_side_under_experiments():
    """Td -> 0 is a limit; what has a dead time is no limit of what has none."""
    small, large = Chain(2, damped=False), Chain(2, ground_dampers=(1, 2))
    for first, second, inclusion in (
        (small, replace(large, dead_time=True), Inclusion.LEFT_IN_RIGHT),
        (replace(small, dead_time=True), large, Inclusion.NEITHER),
    ):
        sides = [measured(chain) for chain in (first, second)]
        assert profile_of(sides[0]).rank < profile_of(sides[1]).rank
        found = inclusions_under(*sides, profile_of).closure
        assert found.inclusion is inclusion and confirms_inclusion(found.evidence, *sides)
        back = inclusions_under(*sides[::-1], profile_of).closure
        assert back.inclusion is inclusion.turned
        assert confirms_inclusion(back.evidence, *sides[::-1])
