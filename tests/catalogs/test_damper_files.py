"""The shipped classes of families with all sets of ground dampers: current, whole, and as
compare says.
"""

import json
from dataclasses import replace
from random import Random

import pytest

from disting import (
    CatalogError,
    ContradictionError,
    Engine,
    InputError,
    Query,
    Relation,
    View,
    catalog,
    compare,
)
from disting.catalogs import next_files
from disting.catalogs.build import (
    DECIDES,
    false_findings,
    settle_dampers,
    verify_dampers,
)
from disting.catalogs.dampers import (
    SHIPPED_SIZES,
    DamperFamily,
    _read,
    _rule_key,
    damper_catalog,
    damper_family,
    read,
    text_of,
    write,
)
from disting.catalogs.files import SETTLED, append, damper_name, read_findings, shipped_folder
from disting.cli import main
from disting.conditions.rule import EXACT, Finding, Outcome
from disting.decide.same.evidence_check import finding_holds
from disting.decide.same.low_cost import quick_finding, quick_profile
from disting.model.family import Family
from disting.model.question import Settings
from disting.model.symmetry import canonical
from disting.store.scheduling import executor
from disting.verdict.class_search import classes

SAME, APART, OPEN = Relation.INDISTINGUISHABLE, Relation.DISTINGUISHABLE, Relation.UNDECIDED
MODELS = {3: 88, 4: 464, 5: 2336}
UNDECIDED = 272  # of 2,727,280 damped pairs of 5 masses
ALL = [(n, damped) for n in SHIPPED_SIZES for damped in (False, True)]


def shipped_text(n, damped):
    return (shipped_folder() / f"{damper_name(n, damped)}.jsonl").read_text(encoding="utf-8")


@pytest.mark.parametrize(("n", "damped"), ALL)
def test_all_models_and_pairs_are_there(n, damped):
    found = damper_catalog(n, damped=damped)
    assert found.found.counts()[OPEN] == (UNDECIDED if (n, damped) == (5, True) else 0)
    assert len(found) == MODELS[n]
    assert sum(found.found.counts().values()) == MODELS[n] * (MODELS[n] - 1) // 2


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_three_masses_are_current_to_the_byte(damped):
    assert text_of(damper_family(3, damped=damped), Settings()) == shipped_text(3, damped)


@pytest.mark.slow
@pytest.mark.parametrize(("n", "damped"), [(4, False), (4, True), (5, False), (5, True)])
def test_larger_families_are_current_to_the_byte(n, damped):
    """Up to two minutes each with two workers."""
    with executor(2) as pool:
        assert text_of(damper_family(n, damped=damped, executor=pool), Settings()) == shipped_text(
            n, damped
        )


@pytest.mark.sampled(3)
@pytest.mark.thin(2)
@pytest.mark.parametrize(("n", "damped"), ALL)
def test_without_dampers_as_the_shipped_catalogue_says(n, damped):
    found, plain = damper_catalog(n, damped=damped), catalog(n, damped=damped)
    for left, right, verdict in plain.pairs(View.EXACT):
        assert found.look_up((left, ()), (right, ()))[0] in (verdict.relation, OPEN)


@pytest.mark.full
@pytest.mark.parametrize("n", [3, 4])
def test_at_random_as_compare_says(n):
    found, random = damper_catalog(n, damped=True), Random(n)
    for _ in range(25 if n == 3 else 2):
        i, j = random.sample(range(len(found)), 2)
        relation, rule = found.found.look_up(i, j)
        if rule != "exact":
            assert (
                compare(
                    found.found.chains[i], found.found.chains[j], query=Query(View.EXACT)
                ).relation
                is relation
            )


@pytest.mark.sampled(3)
@pytest.mark.full
@pytest.mark.parametrize(("n", "damped"), ALL)
def test_what_the_exact_decision_settled_at_random_as_one_fibre_says(n, damped):
    """Pairs of one bucket, asked anew: distinguishable ones have an empty fibre, or a rank of
    1/G that differs.
    """
    found, random = damper_catalog(n, damped=damped).found, Random(n)
    pairs = [
        (i, j)
        for i in random.sample(range(len(found)), 25)
        for j in random.sample(range(len(found)), 60)
        if i != j
    ]
    exact = [(i, j) for i, j in pairs if found.look_up(i, j)[1] == "exact"][:12]
    told = []
    for i, j in exact:
        a, b = (canonical(found.chains[k]).chain for k in (i, j))
        if quick_profile(a, Settings()).rank == quick_profile(b, Settings()).rank:
            outcome = quick_finding(a, b, Settings()).outcome
            told.append(outcome)
            expected = Outcome.HOLDS if found.relation(i, j) is SAME else Outcome.FAILS
            assert outcome in (expected, Outcome.ABANDONED)
    assert exact and told.count(Outcome.ABANDONED) < len(told)


@pytest.mark.full
def test_a_file_that_was_written_is_read(tmp_path):
    found = damper_catalog(3, damped=True)
    path = write(found, Settings(), tmp_path)
    again = read(tmp_path, 3, True)
    assert sorted(p.name for p in tmp_path.iterdir()) == [path.name, "provenance.json"]
    assert list(again.csv_lines()) == list(found.csv_lines())
    assert again.classes() == found.classes()


@pytest.mark.parametrize(
    "damage",
    [
        lambda lines: [],
        lambda lines: lines[:-1],
        lambda lines: [lines[0], lines[2], lines[1], *lines[3:]],
        lambda lines: [lines[0].replace('"schema":1', '"schema":0'), *lines[1:]],
        lambda lines: [*lines[:-1], lines[-1][:-3]],
        lambda lines: [*lines[:-1], json.dumps(json.loads(lines[-1]) | {"rank": [1]})],
        lambda lines: [*lines[:-1], json.dumps(json.loads(lines[-1]) | {"group": ["x"] * 8})],
    ],
)
def test_a_damaged_file_is_refused_with_the_remedy(tmp_path, damage):
    path = tmp_path / f"{damper_name(3, True)}.jsonl"
    path.write_text("\n".join(damage(shipped_text(3, True).splitlines())), encoding="utf-8")
    with pytest.raises(CatalogError, match="disting catalog dampers 3"):
        read(tmp_path, 3, True)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(CatalogError, match=r"there is no .*dampers-4-undamped.jsonl; make it with"):
        read(tmp_path, 4, False)


@pytest.mark.full
def test_the_command_writes_the_files(tmp_path, capsys):
    assert main(["catalog", "dampers", "2", "--out", str(tmp_path), "--no-cache"]) == 0
    over = "12 models, 66 pairs, over complex parameters"
    together = "all of it together is wrong with a probability of at most 2^-94"
    assert capsys.readouterr().out.splitlines() == [
        (
            f"{tmp_path}/dampers-2-undamped.jsonl: {over}: 62 distinguishable, 4 indistinguishable,"
            f" 0 undecided; {together}"
        ),
        (
            f"{tmp_path}/dampers-2-damped.jsonl: {over}: 59 distinguishable, 7 indistinguishable, 0"
            f" undecided; {together}"
        ),
    ]
    assert main(["catalog", "settle", "2", "--catalog", str(tmp_path)]) == 0
    assert capsys.readouterr().out.splitlines() == [  # nothing is undecided
        "2 masses with dampers to the ground: 0 pairs of classes settled"
    ]
    stored = read(tmp_path, 2, True)
    path = next_files.write(next_files.build_next(stored, Engine()), tmp_path)
    found = next_files.read(tmp_path, 2, True, dampers=True)
    assert path.name == "next-dampers-2-damped.jsonl"
    named = {frozenset(found.named(i)[0] for i in group) for group in found.groups}
    every = [{stored.text(stored.place(m)) for m in members} for members in stored.classes()]
    assert named == {frozenset(group) for group in every if "+" in "".join(group)}


@pytest.mark.full
def test_the_command_answers_from_the_shipped_file(tmp_path, capsys):
    target = tmp_path / "pairs.csv"
    assert main(["dampers", "3", "--damped", "--sets", "all", "--csv", str(target)]) == 0
    assert capsys.readouterr().out.startswith(
        "88 models, 3828 pairs, over complex parameters: 3678 distinguishable, 150"
        " indistinguishable"
    )
    lines = target.read_text(encoding="utf-8").splitlines()
    assert (
        len(lines) == 3829 and lines[1] == "3:1,3:1+b1,distinguishable,1,complex,true,acceleration"
    )


def test_models_that_are_not_there_are_refused():
    with pytest.raises(InputError, match="models 1 to 73"):
        damper_catalog(5, damped=False).look_up((74, ()), (1, ()))


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_a_file_is_verified_and_a_changed_one_is_found_out(damped, tmp_path):
    name = f"{damper_name(3, damped)}.jsonl"
    text = shipped_text(3, damped)
    (tmp_path / name).write_text(text, encoding="utf-8")
    engine = Engine()
    assert verify_dampers(3, damped=damped, folder=tmp_path, engine=engine) == []
    (tmp_path / name).write_text(
        text.replace('"undecided":[]', '"undecided":[[0,1]]'), encoding="utf-8"
    )
    assert verify_dampers(3, damped=damped, folder=tmp_path, engine=engine) == [
        f"{damper_name(3, damped)} is not what is computed now"
    ]


def settled(damped):
    return read_findings(canonical(c).chain for c in damper_catalog(5, damped=damped).found.chains)


def one_of_each(known):
    """A pair of each kind of evidence, of shares one with the lowest degree."""
    by_cost = sorted(known.items(), key=lambda x: -getattr(x[1].evidence, "degree", 0))
    return {found.evidence.kind: (found, *pair) for pair, found in by_cost}


@pytest.mark.full
@pytest.mark.parametrize(
    ("damped", "kinds"), [(True, {"shared"}), (False, {"shared", "solved", "refuted"})]
)
def test_what_was_settled_once_is_sure_and_holds(damped, kinds):
    """One of each kind and, by hand, every ninth."""
    known = settled(damped)
    assert all(f.safety >= 100 and f.outcome in DECIDES for f in known.values())
    assert one_of_each(known).keys() >= kinds
    assert all(finding_holds(*of_one, Settings()) for of_one in one_of_each(known).values())


@pytest.mark.slow
@pytest.mark.parametrize("damped", [False, True])
def test_what_was_settled_once_holds(damped):
    assert all(
        finding_holds(found, *pair, Settings()) for pair, found in [*settled(damped).items()][::9]
    )


def forged(found):
    """Findings that say something else than their evidence shows, or have other evidence."""
    yield from (replace(found, safety=found.safety + n) for n in (1, -1))
    other = {Outcome.HOLDS: Outcome.FAILS, Outcome.FAILS: Outcome.HOLDS}
    yield replace(found, outcome=other[found.outcome])
    yield replace(found, evidence=None)
    if found.evidence.kind == "refuted":  # other labels, or more than there are
        yield replace(found, evidence=replace(found.evidence, labels=found.evidence.labels[1:]))
        yield replace(found, evidence=replace(found.evidence, tangent=False))
    else:  # another direction; an ideal that contradicts itself there is true evidence too
        yield found.turned
    if found.evidence.kind == "solved":
        first, *others = found.evidence.solutions
        yield replace(found, evidence=replace(found.evidence, solutions=((*first[1:], 1), *others)))
        yield replace(found, evidence=replace(found.evidence, labels=found.evidence.labels[::-1]))


@pytest.mark.full
@pytest.mark.parametrize("kind", ["shared", "solved", "refuted"])
def test_what_says_more_than_its_evidence_shows_does_not_hold(kind):
    found, *pair = one_of_each(settled(False))[kind]
    assert [x for x in forged(found) if finding_holds(x, *pair, Settings())] == []


@pytest.mark.full
def test_what_is_settled_of_another_pair_does_not_hold():
    known = settled(False)
    for found, *pair in one_of_each(known).values():
        others = (other for other in known if other[0] != pair[0])
        assert not finding_holds(found, *next(others), Settings())


def test_what_is_settled_is_taken_over_from_a_folder_of_ones_own(tmp_path):
    one, other = (canonical(replace(Family(2, True)[i], ground_dampers=(1,))).chain for i in (1, 2))
    assert read_findings([one, other], tmp_path) == {}
    append(tmp_path, one, other, Finding(EXACT, Outcome.FAILS))
    told = {(one, other): Finding(EXACT, Outcome.FAILS)}
    assert read_findings([one, other], tmp_path) == told
    assert read_findings([one], tmp_path) == {}
    assert classes([one, other], Engine(), settled=told).relation(0, 1) is APART


def test_a_settled_pair_that_something_else_contradicts_is_refused():
    same = [replace(Family(2, True)[2], ground_dampers=(m,)) for m in (1, 2)]
    assert classes(same, Engine()).relation(0, 1) is SAME
    pair = tuple(canonical(chain).chain for chain in same)
    with pytest.raises(ContradictionError, match="one class holds"):
        classes(same, Engine(), settled={pair: Finding(EXACT, Outcome.FAILS)})


@pytest.mark.full
def test_what_is_settled_and_what_contradicts_the_file_is_said_by_the_names_of_the_models(tmp_path):
    family, sets = Family(4, damped=True), ((1,),)
    chains = [replace(chain, ground_dampers=(1,)) for chain in family]
    found, lines = DamperFamily(family, sets, classes(chains, Engine(), more=[])), []
    for count in (2, 0):
        assert settle_dampers(found, tmp_path, Settings(), lines.append) == count
    assert lines == [
        "4:3+b1 and 4:7+b1, damped: distinguishable",
        "4:8+b1 and 4:19+b1, damped: indistinguishable",
    ]
    assert len((tmp_path / SETTLED).read_text(encoding="utf-8").splitlines()) == 2
    assert list(false_findings(found, tmp_path, Settings())) == [
        "4:3+b1 and 4:7+b1, damped: settled, but not in the file",
        "4:8+b1 and 4:19+b1, damped: settled, but not in the file",
    ]


def test_a_condition_of_any_name_is_read_as_it_was_written():
    names = ["1", "9", "10", "11", "marked", "exact"]
    plain = json.loads(json.dumps(list(map(_rule_key, names))))
    assert plain[-1] == 10 and list(map(_read, plain)) == names
