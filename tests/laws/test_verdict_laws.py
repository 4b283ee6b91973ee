"""What every verdict obeys, whatever the models: mirror, symmetry, seeds, transitivity, evidence that checks again."""

import json
import random
from dataclasses import fields, replace
from functools import cache
from itertools import combinations, permutations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from disting import Chain, ContradictionError, Engine, Family, Query, Relation, Sensor, Settings, Verdict, View, compare
from disting.certainty import Certainty
from disting.conditions import Subject
from disting.conditions.evidence import Counts, Embedding, Forms, FreeChoice, Ranks, Renaming, Supermodel, from_dict, to_dict
from disting.conditions.verify import Witness
from disting.model.symmetry import forms
from disting.verdict import ALL_CONDITIONS, RULE_NAMES, audit, decide, steps
from tests.laws.strategies import chains

ENGINE = Engine()
PAPER = Query(View.COMBINED)  # the exact decision of ground dampers is slow: it has laws of its own below
WITNESS = Witness()
BY_CONDITIONS = (View.TF, View.MARKOV, View.COMBINED)
SMALL = [(n, damped) for n in (1, 2, 3, 4) for damped in (False, True)]
often = settings(max_examples=100, deadline=None)
quick = settings(max_examples=40, deadline=None)


def verdict(left, right, query=PAPER, engine=ENGINE):
    return compare(left, right, query=query, engine=engine)


def subject(chain, engine=ENGINE):
    return engine.subject(str(chain), chain)


@cache
def family(n_masses, damped):
    return [ENGINE.subject(f"A{i}", chain) for i, chain in enumerate(Family(n_masses, damped), 1)]


@st.composite
def similar_pairs(draw, max_masses=3):
    """Two chains of one size and kind, so that the first conditions seldom decide."""
    n = draw(st.integers(1, max_masses))
    left, right = draw(chains(n, n)), draw(chains(n, n))
    return left, replace(right, sensor=left.sensor, lag=left.lag, damped=left.damped)


@st.composite
def damper_pairs(draw):
    """One chain of three masses with two sets of ground dampers, where conditions 8 and 9 apply."""
    chain, masses = draw(chains(3, 3)), draw(st.sets(st.integers(1, 3)))
    return chain, replace(chain, ground_dampers=tuple(masses))


any_pair = st.one_of(st.tuples(chains(), chains()), similar_pairs(), damper_pairs())
EXAMPLES = [
    (Chain(2), Chain(3, meas_plus=3)),  # condition 2
    (Family(3)[9], Family(3)[10]),  # 6
    (Chain(1), Chain(1, damped=True)),  # 6, no symmetry
    (Family(4)[11], Family(4)[13]),  # 7
    (Chain(2, 1, 1, 2, 1, 2, ground_dampers=(1,)), Chain(2, 1, 1, 2, 1, 2, ground_dampers=(1,), damped=True)),  # 8
    tuple(Chain(3, 2, 1, 3, 2, 3, damped=True, ground_dampers=(i,)) for i in (1, 2)),  # 9
    (Family(3, damped=True)[1], Family(3, damped=True)[4]),  # 5 on Markov parameters
    (Chain(1), Chain(1, dead_time=True)),  # 3
    (Chain(2, damped=True, ground_dampers=(1,)), Chain(2, damped=True, ground_dampers=(2,))),  # undecided
]


def with_examples(test):
    for pair in EXAMPLES:
        test = example(pair=pair)(test)
    return test


# --- mirror, symmetry ------------------------------------------------------------------------------------------------


def mirrored(evidence):
    """The same evidence said of (right, left)."""
    match evidence:
        case Counts() | Ranks():
            return replace(evidence, left=evidence.right, right=evidence.left)
        case Forms():
            return Forms(evidence.only_right, evidence.only_left)
        case Embedding():
            return replace(evidence, left_is_submodel=not evidence.left_is_submodel)
    return evidence


@often
@with_examples
@given(pair=any_pair)
def test_the_mirrored_pair_has_the_mirrored_verdict(pair):
    there, back = verdict(*pair), verdict(*reversed(pair))
    for field in ("relation", "decided_by", "representation", "certainty", "safety", "notes"):
        assert getattr(there, field) == getattr(back, field)
    if isinstance(there.evidence, Renaming):
        assert {b for _, b in there.evidence.pairs} == {a for a, _ in back.evidence.pairs}
        assert there.evidence.symmetries == back.evidence.symmetries
    else:
        assert mirrored(there.evidence) == back.evidence


@quick
@given(chains(dead_time=True))
def test_reciprocity_and_reflection_give_indistinguishable_models(chain):
    for form in forms(chain):
        found = verdict(chain, form.chain)
        assert (found.relation, found.decided_by, found.certainty) == (Relation.INDISTINGUISHABLE, "6", Certainty.THEOREM)
        assert WITNESS.confirms(found.evidence, found.representation, chain, form.chain)


@quick
@with_examples
@given(pair=similar_pairs())
def test_an_equivalent_form_never_has_the_opposite_relation(pair):
    left, right = pair
    relations = {verdict(form.chain, right).relation for form in forms(left)}
    assert not relations >= {Relation.DISTINGUISHABLE, Relation.INDISTINGUISHABLE}


# --- more knowledge, other seeds -------------------------------------------------------------------------------------


@quick
@with_examples
@given(pair=any_pair)
def test_more_markov_parameters_never_turn_a_relation_round(pair):
    relations = [verdict(*pair, Query(View.MARKOV, markov=count)).relation for count in (1, 2, 3, 4, 6, 8, 11, 12, 16)]
    decided = [r for r in relations if r is not Relation.UNDECIDED]
    assert len(set(decided)) <= 1
    first = relations.index(decided[0]) if decided else len(relations)
    assert Relation.UNDECIDED not in relations[first:]


@quick
@with_examples
@given(pair=any_pair)
def test_more_conditions_and_views_never_turn_a_relation_round(pair):
    whole = verdict(*pair).relation
    for query in [Query(view) for view in BY_CONDITIONS] + [Query(View.COMBINED, conditions=(c,)) for c in ALL_CONDITIONS]:
        assert verdict(*pair, query).relation in (whole, Relation.UNDECIDED)


def assert_equal_decisions(n_masses, damped, seeds):
    base = ENGINE.decisions(family(n_masses, damped), Query())
    for seed in seeds:
        engine = Engine(Settings(seed=seed))
        other = engine.decisions([subject(c, engine) for c in Family(n_masses, damped)], Query())
        assert np.array_equal(base.decided_by, other.decided_by)
        assert np.array_equal(base.representation, other.representation)


@pytest.mark.parametrize(("n_masses", "damped"), SMALL)
def test_verdicts_do_not_depend_on_the_seed(n_masses, damped):
    assert_equal_decisions(n_masses, damped, ["one", "two", "three"])


@pytest.mark.slow
@pytest.mark.parametrize(("n_masses", "damped"), [*SMALL, (5, False), (5, True)])
def test_verdicts_do_not_depend_on_any_of_twenty_seeds(n_masses, damped):
    assert_equal_decisions(n_masses, damped, [f"seed {i}" for i in range(20)])


@pytest.mark.parametrize("points", [1, 2, 6])
def test_verdicts_do_not_depend_on_the_number_of_points(points):
    engine = Engine(Settings(points=points))
    other = engine.decisions([subject(c, engine) for c in Family(3, damped=True)], Query())
    assert np.array_equal(ENGINE.decisions(family(3, True), Query()).decided_by, other.decided_by)


# --- all pairs at once are the pairs one by one ----------------------------------------------------------------------


def assert_bucketed_as_pairwise(subjects, query, engine=ENGINE):
    found = engine.decisions(subjects, query)
    for i, j in combinations(range(len(subjects)), 2):
        one = decide(subjects[i], subjects[j], query)
        assert found.verdict(i, j) == found.verdict(j, i) == one
        assert found.relation(i, j) == found.relation(j, i) == one.relation
        assert RULE_NAMES[int(found.decided_by[i, j])] == one.decided_by


@pytest.mark.parametrize("view", View)
@pytest.mark.parametrize(("n_masses", "damped"), [(2, True), (3, False), (3, True), (4, False), (4, True)])
def test_buckets_decide_as_pairs_do(n_masses, damped, view):
    assert_bucketed_as_pairwise(family(n_masses, damped), Query(view))


@pytest.mark.parametrize("limit", [0, 36, 84])
def test_buckets_decide_as_pairs_do_where_matroids_are_too_large(limit):
    engine = Engine(Settings(subset_limit=limit))
    assert_bucketed_as_pairwise([subject(chain, engine) for chain in Family(3, damped=True)], Query(), engine)


def queries():
    """Conditions 1 to 4 and any of the others, any view, any number of Markov parameters."""
    some = st.sets(st.sampled_from(ALL_CONDITIONS[4:])).map(lambda chosen: (1, 2, 3, 4, *sorted(chosen)))
    few = st.sets(st.sampled_from([c for c in ALL_CONDITIONS if c != 5])).map(lambda chosen: tuple(sorted(chosen)))
    return st.builds(Query, st.sampled_from(BY_CONDITIONS), st.one_of(some, few), st.integers(0, 14))


@settings(max_examples=25, deadline=None)
@given(query=queries(), damped=st.booleans(), chosen=st.sets(st.integers(0, 10), min_size=2, max_size=5))
def test_buckets_decide_as_pairs_do_for_any_query(query, damped, chosen):
    assert_bucketed_as_pairwise([family(3, damped)[i] for i in sorted(chosen)], query)


@settings(max_examples=15, deadline=None)
@given(st.data())
def test_buckets_decide_as_pairs_do_for_any_models_of_one_size(data):
    """Dampers, sensors and ports may differ; equally many states are asked for."""
    n, lag = data.draw(st.integers(1, 3)), data.draw(st.booleans())
    models = data.draw(st.lists(chains(n, n, dead_time=True), min_size=2, max_size=6))
    assert_bucketed_as_pairwise([subject(replace(chain, lag=lag)) for chain in models], Query())


@pytest.mark.parametrize("damped", [False, True])
def test_grades_are_those_of_the_verdicts(damped):
    found = ENGINE.decisions(family(3, damped), Query())
    for i, j, number, where, certainty, safety in found.grades():
        one = decide(*(family(3, damped)[k] for k in (i, j)), Query())
        assert (RULE_NAMES[number], where, certainty, safety) == (
            one.decided_by,
            one.representation,
            one.certainty or "",
            one.safety,
        )


# --- no contradictions -----------------------------------------------------------------------------------------------


def audited(subjects, query):
    for left, right in combinations(subjects, 2):
        assert audit(left, right, query) == decide(left, right, query)


@pytest.mark.parametrize("view", [View.COMBINED, View.EXACT])
@pytest.mark.parametrize(("n_masses", "damped"), SMALL)
def test_no_condition_contradicts_another(n_masses, damped, view):
    audited(family(n_masses, damped), Query(view))


@pytest.mark.slow
@pytest.mark.parametrize("damped", [False, True])
def test_no_condition_contradicts_another_for_five_masses(damped):
    audited(family(5, damped), PAPER)


@often
@with_examples
@given(pair=any_pair)
def test_no_condition_contradicts_another_for_any_pair(pair):
    audited([subject(chain) for chain in pair], PAPER)


@pytest.mark.parametrize("reverse", [False, True])
def test_a_contradiction_is_an_error(reverse):
    """One model with two profiles: condition 4 tells it from itself, condition 6 does not."""
    chain = Family(3, damped=True)[1]
    false = Subject("false", chain, source=lambda *what: replace(ENGINE.profile(*what), rank=6))
    pair = (false, subject(chain)) if reverse else (subject(chain), false)
    assert decide(*pair, PAPER).decided_by == "4"
    assert decide(*pair, Query(View.COMBINED, conditions=(6, 7))).decided_by == "6"
    with pytest.raises(ContradictionError, match="indistinguishable by condition 6"):
        audit(*pair, PAPER)


def assert_transitive(relations, n):
    """No triangle has two equalities and one difference."""
    same, apart = Relation.INDISTINGUISHABLE, Relation.DISTINGUISHABLE
    for a, b, c in permutations(range(n), 3):
        if a < c and relations(a, b) is same and relations(b, c) is same:
            assert relations(a, c) is not apart


@pytest.mark.parametrize("view", View)
@pytest.mark.parametrize(("n_masses", "damped"), [(3, False), (3, True), (4, False), (4, True)])
def test_indistinguishability_is_transitive(n_masses, damped, view):
    assert_transitive(ENGINE.decisions(family(n_masses, damped), Query(view)).relation, len(family(n_masses, damped)))


@pytest.mark.parametrize("model", range(1, 12))
def test_indistinguishability_is_transitive_among_ground_dampers(model):
    chain = Family(3, damped=True)[model]
    sets = [masses for size in range(4) for masses in combinations((1, 2, 3), size)]
    subjects = [subject(replace(chain, ground_dampers=masses)) for masses in sets]
    assert_transitive(ENGINE.decisions(subjects, PAPER).relation, len(subjects))


# --- evidence --------------------------------------------------------------------------------------------------------


@often
@with_examples
@given(pair=any_pair)
def test_evidence_checks_again(pair):
    found = verdict(*pair)
    if found.evidence:
        assert WITNESS.confirms(found.evidence, found.representation, *pair)
        assert WITNESS.confirms(mirrored_renaming(found.evidence), found.representation, *reversed(pair))


def mirrored_renaming(evidence):
    if isinstance(evidence, Renaming):
        return replace(evidence, pairs=tuple((b, a) for a, b in evidence.pairs))
    return mirrored(evidence)


@often
@with_examples
@given(pair=any_pair)
def test_every_condition_that_decides_has_evidence_that_checks_again(pair):
    """Of the necessary ones the first in each representation, for the later ones presuppose it."""
    done = set()
    for step in steps(*(subject(chain) for chain in pair), PAPER):
        if step.relation is not Relation.UNDECIDED and step.representation not in done:
            assert WITNESS.confirms(step.finding.evidence, step.representation, *pair)
            if step.relation is Relation.DISTINGUISHABLE:
                done.add(step.representation)


def swapped(pairs):
    """Two images of a renaming exchanged."""
    (a, x), (b, y), *rest = pairs
    return ((a, y), (b, x), *rest)


def evidence_of(kind):
    pair = {
        Counts: (Family(3, damped=True)[1], Family(3, damped=True)[2]),
        Forms: (Chain(1), Chain(1, dead_time=True)),
        Ranks: (Family(3, damped=True)[1], Family(3, damped=True)[4]),
        Renaming: (Family(3)[2], Family(3)[5]),
        FreeChoice: (Family(4)[11], Family(4)[13]),
        Embedding: EXAMPLES[4],
        Supermodel: EXAMPLES[5],
    }[kind]
    found = verdict(*pair)
    assert isinstance(found.evidence, kind)
    return found, pair


@pytest.mark.parametrize(
    ("kind", "tamper"),
    [
        (Counts, lambda e: replace(e, left=(e.left[0] + 1, e.left[1]))),
        (Counts, lambda e: replace(e, left=e.right)),
        (Counts, lambda e: replace(e, right=e.left)),
        (Counts, lambda e: replace(e, right=(e.right[0], e.right[1] - 1))),
        (Counts, lambda e: Counts(e.right, e.left)),
        (Forms, lambda e: Forms((), ())),
        (Forms, lambda e: Forms(e.only_right, ())),
        (Forms, lambda e: Forms((), ("b0",))),
        (Forms, lambda e: Forms((), ("Td", "b0"))),
        (Ranks, lambda e: replace(e, left=e.left + 1)),
        (Ranks, lambda e: replace(e, right=e.right - 1)),
        (Ranks, lambda e: replace(e, left=e.right, right=e.left)),
        (Ranks, lambda e: replace(e, right=e.left)),
        (Ranks, lambda e: replace(e, rows=e.rows[:6])),
        (Ranks, lambda e: replace(e, rows=("G0", *e.rows))),
        (Ranks, lambda e: replace(e, rows=())),
        (Renaming, lambda e: replace(e, pairs=swapped(e.pairs))),
        (Renaming, lambda e: replace(e, pairs=e.pairs[1:])),
        (Renaming, lambda e: replace(e, pairs=((e.pairs[0][0], e.pairs[1][1]), *e.pairs[1:]))),
        (Renaming, lambda e: replace(e, pairs=((e.pairs[0][0], "b9"), *e.pairs[1:]))),
        (Renaming, lambda e: replace(e, pairs=tuple((a, a) for a, _ in e.pairs))),
        (FreeChoice, lambda e: replace(e, free=e.free[1:])),
        (FreeChoice, lambda e: replace(e, free=(*e.free, "a1"))),
        (Embedding, lambda e: replace(e, left_is_submodel=not e.left_is_submodel)),
        (Embedding, lambda e: replace(e, rank=e.rank + 1)),
        (Embedding, lambda e: replace(e, numbering=swapped(e.numbering))),
        (Supermodel, lambda e: replace(e, rank=e.rank - 1)),
        (Supermodel, lambda e: replace(e, parameters=e.parameters[:-1])),
    ],
)
def test_tampered_evidence_is_refused(kind, tamper):
    found, pair = evidence_of(kind)
    assert WITNESS.confirms(found.evidence, found.representation, *pair)
    assert tamper(found.evidence) != found.evidence
    assert not WITNESS.confirms(tamper(found.evidence), found.representation, *pair)


OTHER = (Family(3, damped=True)[3], Family(3, damped=True)[7])


@pytest.mark.parametrize("kind", [Counts, Forms, Ranks, Renaming, FreeChoice, Embedding, Supermodel])
def test_evidence_of_another_pair_is_refused(kind):
    found, pair = evidence_of(kind)
    assert not WITNESS.confirms(found.evidence, found.representation, *OTHER)
    assert not WITNESS.confirms(found.evidence, found.representation, pair[0], OTHER[1])


def test_a_supermodel_of_larger_rank_is_refused():
    """The chain without gap has rank 8, its two parts have 7."""
    left, right = Family(4)[11], Family(4)[13]
    names = left.structure.united(right.structure).parameters
    assert not any(WITNESS.confirms(Supermodel(names, rank), "structure", left, right) for rank in (6, 7, 8))


def test_a_whole_of_larger_rank_is_refused():
    part, whole = Chain(2, damped=True, ground_dampers=(1,)), Chain(2, damped=True, ground_dampers=(1, 2))
    numbering = ((0, 0), (1, 1), (2, 2))
    assert not any(WITNESS.confirms(Embedding(True, numbering, rank), "structure", part, whole) for rank in (5, 6))


@quick
@given(pair=similar_pairs(), other=similar_pairs())
def test_evidence_of_one_pair_never_decides_another_one_wrongly(pair, other):
    """Confirmed for other models, it tells the truth about them."""
    found = verdict(*pair)
    if isinstance(found.evidence, Counts | Forms | Ranks | Embedding | Supermodel):
        confirmed = WITNESS.confirms(found.evidence, found.representation, *other)
        assert not confirmed or verdict(*other).relation in (found.relation, Relation.UNDECIDED)


def test_witnesses_use_points_of_their_own():
    pair = Family(3, damped=True)[1], Family(3, damped=True)[4]
    evidence = verdict(*pair).evidence
    one, other = Witness("one"), Witness("other")
    assert one.confirms(evidence, "markov", *pair)
    assert other.confirms(evidence, "markov", *pair)
    assert set(one.memo) == set(other.memo)
    assert all(one.memo[key] != other.memo[key] for key in one.memo)


@often
@with_examples
@given(pair=any_pair)
def test_every_condition_reports_in_order_under_its_own_number(pair):
    parts = [("tf", range(1, 8)), ("markov", range(1, 8)), ("structure", (8, 9))]
    expected = [(where, number) for where, numbers in parts for number in numbers]
    for count in (0, 3):
        found = list(steps(*(subject(chain) for chain in pair), Query(View.COMBINED, markov=count)))
        assert [(s.representation, s.finding.number) for s in found] == expected
        assert all(bool(s.finding.evidence) == (s.relation is not Relation.UNDECIDED) for s in found)


# --- plain data ------------------------------------------------------------------------------------------------------


@often
@with_examples
@given(pair=any_pair)
def test_verdicts_survive_json(pair):
    found = verdict(*pair)
    assert Verdict.from_dict(json.loads(json.dumps(found.to_dict()))) == found
    if found.evidence:
        assert from_dict(json.loads(json.dumps(to_dict(found.evidence)))) == found.evidence


@pytest.mark.parametrize("data", [{}, {"left": "a"}, {"kind": "counts"}])
def test_other_data_is_no_verdict(data):
    with pytest.raises((KeyError, TypeError, ValueError)):
        Verdict.from_dict(data)


@pytest.mark.parametrize("data", [{}, {"kind": "other"}, {"kind": "counts"}, {"kind": "counts", "left": 1, "right": 2, "x": 3}])
def test_other_data_is_no_evidence(data):
    with pytest.raises((KeyError, TypeError)):
        from_dict(data)


@quick
@with_examples
@given(pair=any_pair)
def test_a_verdict_tells_its_relation_and_its_proof(pair):
    found = verdict(*pair)
    assert found.relation.value in found.sentence
    assert (found.error_bound == "") == (found.relation is Relation.UNDECIDED)
    assert found.error_bound.startswith("2^-") == (found.certainty is Certainty.BOUNDED)
    if found.evidence:
        assert f"condition {found.decided_by}" in found.sentence
        assert found.evidence.formula


def test_a_verdict_is_neither_true_nor_false():
    with pytest.raises(TypeError, match="relation"):
        bool(verdict(Chain(1), Chain(2)))


DECIDED = {
    "decided_by": "1",
    "representation": "tf",
    "certainty": Certainty.PROVEN,
    "evidence": Counts((1, 1), (2, 2)),
}


@pytest.mark.parametrize("missing", DECIDED)
def test_a_decided_verdict_lacks_nothing(missing):
    assert Verdict("a", "b", Relation.DISTINGUISHABLE, **DECIDED).decided_by == "1"
    incomplete = {key: value for key, value in DECIDED.items() if key != missing}
    with pytest.raises(ValueError, match="exactly a decided verdict"):
        Verdict("a", "b", Relation.DISTINGUISHABLE, **incomplete)


def test_an_undecided_verdict_has_no_proof():
    with pytest.raises(ValueError, match="exactly a decided verdict"):
        Verdict("a", "b", Relation.UNDECIDED, **DECIDED)
    assert Verdict("a", "b", Relation.UNDECIDED).sentence == "a and b are undecided: nothing settles them."


def test_verdicts_are_values():
    found = verdict(Chain(1), Chain(2))
    assert found == verdict(Chain(1), Chain(2), engine=Engine())
    assert len({found, verdict(Chain(1), Chain(2))}) == 1
    with pytest.raises(AttributeError):
        found.relation = Relation.UNDECIDED
    assert [f.name for f in fields(found)][:4] == ["left", "right", "relation", "decided_by"]


# --- independence of order -------------------------------------------------------------------------------------------


def test_the_order_of_the_models_does_not_matter():
    shuffled = list(family(3, True))
    random.Random(1).shuffle(shuffled)
    base, other = (ENGINE.decisions(subjects, Query()) for subjects in (family(3, True), shuffled))
    names = [s.name for s in family(3, True)]
    places = [[s.name for s in shuffled].index(name) for name in names]
    for i, j in combinations(range(11), 2):
        assert base.relation(i, j) == other.relation(places[i], places[j])


@pytest.mark.parametrize("sensor", Sensor)
def test_few_and_no_models(sensor):
    assert ENGINE.decisions([], Query()).counts() == {"": 0}
    assert ENGINE.decisions([subject(Chain(1, sensor=sensor))], Query()).counts() == {"": 0}
