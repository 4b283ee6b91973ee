"""Classes of whole families with ground dampers, against the pair-by-pair decision and against
the shipped catalogues.
"""

from dataclasses import replace
from itertools import combinations
from random import Random

import numpy as np
import pytest

from disting import (
    Certainty,
    Chain,
    Domain,
    Engine,
    Family,
    Finding,
    InputError,
    Query,
    Relation,
    Store,
    View,
    catalog,
    compare,
)
from disting.catalogs.dampers import DamperFamily, DamperSets, damper_family, dampers
from disting.conditions.rule import EXACT, Outcome
from disting.decide.same.low_cost import QUICKLY, quick_finding, quick_profile
from disting.errors import ContradictionError
from disting.model.question import Settings
from disting.store.scheduling import executor
from disting.verdict.class_search import classes
from disting.verdict.engine import question_key

SAME, APART, OPEN = Relation.INDISTINGUISHABLE, Relation.DISTINGUISHABLE, Relation.UNDECIDED
ENGINE = Engine()
# a class links its models by chains of rules, so the rule of a pair may be another
LOOSE = {"8", "9", "exact"}


@pytest.fixture(scope="module", params=[False, True], ids=["undamped", "damped"])
def three(request):
    return damper_family(3, damped=request.param, engine=ENGINE)


@pytest.mark.full
def test_every_pair_of_three_masses_is_decided(three):
    assert len(three) == 88
    assert three.found.counts()[OPEN] == 0
    assert sum(three.found.counts().values()) == 3828


@pytest.mark.full
def test_as_the_decision_pair_by_pair_says(three):
    subjects = [ENGINE.subject(str(i), chain) for i, chain in enumerate(three.found.chains)]
    decided = ENGINE.decisions(subjects, Query(View.EXACT, inclusion=False))
    rules = {}
    for i, j, relation, rule in three.found.pairs():
        assert relation is decided.relation(i, j)
        expected = decided.rule(i, j)
        if rule != expected:
            assert {rule, expected} <= LOOSE
            rules[i, j] = (rule, expected)
    assert len(rules) < 40


@pytest.mark.full
def test_counts_are_those_of_the_pairs(three):
    relations, rules = {}, {}
    for _, _, relation, rule in three.found.pairs():
        relations[relation] = relations.get(relation, 0) + 1
        rules[rule] = rules.get(rule, 0) + 1
    assert {r: n for r, n in three.found.counts().items() if n} == relations
    assert {r: n for r, n in three.found.counts_by_rule().items() if n} == rules


@pytest.mark.full
def test_relations_are_symmetric_and_transitive(three):
    found = three.found
    for members in found.classes():
        for i, j in combinations(members, 2):
            assert found.relation(i, j) is found.relation(j, i) is SAME


@pytest.mark.full
@pytest.mark.parametrize("number", [1, 6, 7, 11])
def test_as_the_table_of_one_model_says(three, number):
    table = dampers(three.family[number], DamperSets.ALL, engine=ENGINE, domain=Domain.COMPLEX)
    for left, right, relation, _ in table.rows():
        assert three.look_up((number, left), (number, right))[0] is relation


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_without_ground_dampers_as_the_shipped_catalogue_says(damped):
    shipped = catalog(4, damped=damped)
    found = classes(list(shipped.family), ENGINE)
    for i, j, relation, rule in found.pairs():
        verdict = shipped.verdict(i + 1, j + 1, View.EXACT)
        assert relation in (verdict.relation, OPEN)
        if relation is not OPEN and rule != verdict.decided_by:
            assert rule == "exact" or {rule, verdict.decided_by} <= LOOSE


@pytest.fixture(scope="module")
def four():
    """One damper to the ground at most; nothing but the synthesis is asked."""
    family = Family(4, damped=False)
    chains = [replace(chain, ground_dampers=s) for chain in family for s in DamperSets.SINGLE.of(4)]
    return DamperFamily(family, DamperSets.SINGLE.of(4), classes(chains, ENGINE))


@pytest.mark.full
def test_four_masses_at_random_as_compare_says(four):
    random = Random(3)
    for _ in range(25):  # of three masses all are compared
        i, j = random.sample(range(len(four)), 2)
        relation, rule = four.found.look_up(i, j)
        if rule != "exact":
            query = Query(View.EXACT, inclusion=False)
            assert (
                compare(four.found.chains[i], four.found.chains[j], query=query).relation
                is relation
            )


@pytest.mark.full
def test_names_and_places(four):
    assert [four.place(four.name(i)) for i in range(len(four))] == list(range(len(four)))
    assert four.text(four.place((3, (2,)))) == "4:3+b2"
    assert next(four.csv_lines()) == "left,right,relation,decided_by,domain,damped,quantity\n"
    for wrong in ((0, ()), (30, ()), (1, (5,)), (1, (1, 2))):
        with pytest.raises(InputError, match="models 1 to 29"):
            four.place(wrong)
    with pytest.raises(InputError, match="two different models"):
        four.found.look_up(1, 1)


def test_chains_that_do_not_belong_together_are_refused():
    for chains in (
        [],
        [Chain(2, damped=False), Chain(3, damped=False)],
        [Chain(2, damped=False), Chain(2, damped=True)],
        [Chain(2, damped=False), Chain(2, quantity="position", damped=False)],
    ):
        with pytest.raises(InputError, match="one size"):
            classes(chains, ENGINE)
    with pytest.raises(InputError, match="dead time"):
        classes([Chain(2, damped=False), Chain(2, dead_time=True, damped=False)], ENGINE)


@pytest.mark.full
def test_a_run_resumes_from_the_store(tmp_path):
    with Store.open(tmp_path / "cache.sqlite3") as store:
        chains = [
            replace(Family(3, damped=True)[1], ground_dampers=s) for s in DamperSets.ALL.of(3)
        ]
        first, told = classes(chains, Engine(store=store)), []
        again = classes(
            chains, Engine(store=store), progress=lambda what, done, total: told.append(what)
        )
    assert told == []
    assert np.array_equal(first.columns, again.columns) and np.array_equal(first.group, again.group)


def answered(chains, outcomes):
    """An engine that has heard these answers to the quick question already."""
    engine = Engine()
    subjects = [engine.subject(str(i), c) for i, c in enumerate(chains)]
    for (i, j), outcome in outcomes.items():
        bounded = outcome is not Outcome.ABANDONED
        finding = Finding(
            EXACT, outcome, Certainty.BOUNDED if bounded else Certainty.PROVEN, 120 * bounded
        )
        engine.answers[
            question_key(QUICKLY, subjects[i].view.pair(subjects[j].view), engine.settings)
        ] = finding
    return engine


@pytest.mark.full
def test_what_is_given_up_stays_undecided():
    """Pairs that only the synthesis decides are open where it gives up, and none is decided
    otherwise.
    """
    chains = [replace(Family(3, damped=True)[1], ground_dampers=s) for s in DamperSets.ALL.of(3)]
    given_up = dict.fromkeys(combinations(range(len(chains)), 2), Outcome.ABANDONED)
    hurried, whole = classes(chains, answered(chains, given_up)), classes(chains, ENGINE)
    assert hurried.counts()[OPEN] > 0 == whole.counts()[OPEN]
    for i, j, relation, _ in hurried.pairs():
        assert relation in (OPEN, whole.relation(i, j))


@pytest.mark.full
def test_answers_that_contradict_each_other_are_no_result():
    """Equality is transitive: two pairs that hold and a third that fails."""
    ports = ((1, 1, 2, 1, 2), (2, 1, 3, 1, 3), (2, 2, 3, 2, 3))
    chains = [Chain(3, *p, damped=True, ground_dampers=(2, 3)) for p in ports]
    answers = {(0, 1): Outcome.HOLDS, (1, 2): Outcome.HOLDS, (0, 2): Outcome.FAILS}
    with pytest.raises(ContradictionError, match="one class holds"):
        classes(chains, answered(chains, answers))


@pytest.mark.thin(8)
@pytest.mark.parametrize("number", range(1, 12))
def test_ranks_of_the_inverse_never_separate_what_is_indistinguishable(number):
    """Members of one class of the shipped catalogue have equal profiles of 1/G."""
    shipped = catalog(3, damped=True)
    for members in shipped.classes():
        if number in members:
            seen = [quick_profile(shipped.family[m], Settings()) for m in members]
            assert len({(p.form, p.rank, p.matroid) for p in seen}) == 1


@pytest.mark.full
def test_the_rank_of_the_inverse_is_the_number_of_determinable_parameters():
    for chain, row in zip(Family(3, damped=True), catalog(3, damped=True).rows, strict=True):
        assert quick_profile(chain, Settings()).rank == row.rank


def test_quick_findings():
    a = Family(3, damped=True)
    assert quick_finding(a[1], a[11], Settings()).outcome is Outcome.HOLDS
    friction = [replace(a[1], ground_dampers=(m,)) for m in (2, 3)]
    assert quick_finding(*friction, Settings()).outcome is Outcome.FAILS


@pytest.mark.slow
def test_all_damped_models_of_five_masses():
    """2336 models, 2,727,280 pairs: about three minutes with two processes."""
    with executor(2) as pool:
        found = damper_family(5, damped=True, executor=pool)
    assert len(found) == 2336
    assert sum(found.found.counts().values()) == 2_727_280
    assert found.found.counts()[OPEN] < 900
    shipped = catalog(5, damped=True)
    for left, right, verdict in shipped.pairs(View.EXACT):
        assert found.look_up((left, ()), (right, ()))[0] in (verdict.relation, OPEN)
