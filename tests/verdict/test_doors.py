"""A pair of chains has one answer, whoever asks: Python, `compare`, `verdicts` of sizes and of a file
of models, `FILE.json:name`, the shipped catalogues and the pages.
"""

import json
from dataclasses import replace
from itertools import combinations
from random import Random

import pytest

from disting import Engine, Family, Quantity, Query, View, catalog, compare, read_models, verify
from disting.general.matrix_model import Model
from disting.general.model_files import ModelList, models_of, write_models
from disting.model.names import name_of
from disting.report.listing import judge
from disting.verdict.joint import family_safety
from disting.verdict.verification import Status
from tests.cli.process import called

STRANGER = {"name": "low pass", "num": ["k"], "den": ["T", 1]}


def entry(chain):
    """A chain of a file, by a name of its own."""
    name = name_of(chain)
    quantity = {"damped": chain.damped, "quantity": chain.quantity.value}
    return {"name": f"own {name}{' damped' * chain.damped}", "chain": name, **quantity}


def told(verdict):
    """Relation, reason and certainty, without names."""
    return (
        verdict.relation,
        verdict.decided_by,
        verdict.representation,
        verdict.certainty,
        verdict.error_bound,
        # a list looks at as many Markov parameters as its largest pair needs
        verdict.evidence and verdict.evidence.kind,
        verdict.representation != "markov" and verdict.evidence and verdict.evidence.formula,
        verdict.domain,
    )


def limits(verdict):
    """What is told over complex parameters, and why."""
    both = verdict.inclusions
    why = () if both is None else (both.image.certainty, both.closure.certainty)
    return verdict.image, verdict.closure, why


def told_in_json(data):
    """The same of plain data."""
    names = ("relation", "decided_by", "representation", "certainty", "error_bound", "domain")
    evidence = {k: v for k, v in data["evidence"].items() if isinstance(v, int | str)}
    return [data[name] for name in (*names, "image", "closure")], evidence


def doors(chains, engine):
    """Verdicts of every door of Python on all pairs, by the door's name."""
    models = models_of({"models": [*map(entry, chains), STRANGER]})
    only = ModelList(models.models[:-1])
    pairs = list(combinations(range(len(chains)), 2))

    def of_list(members):
        subjects = engine.general_subjects(members)
        decided = engine.decisions(subjects, Query())
        return {pair: decided.verdict(*pair) for pair in pairs}

    yield "two chains", {(i, j): compare(chains[i], chains[j], engine=engine) for i, j in pairs}
    yield "file", {(i, j): compare(only.models[i], only.models[j]) for i, j in pairs}
    yield (
        "file and chain",
        {(i, j): compare(only.models[i], chains[j], engine=engine) for i, j in pairs},
    )
    yield "list of chains", of_list(only)
    yield "list with a stranger", of_list(models)


def refuse_differences(chains):
    """All doors of Python tell the same of all pairs."""
    engine = Engine()
    (_, first), *others = doors(chains, engine)
    for door, found in others:
        for pair, verdict in found.items():
            assert told(verdict) == told(first[pair]), (door, verdict, first[pair])
            assert limits(verdict) == limits(first[pair]), (door, verdict)


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_all_pairs_of_one_to_three_masses(damped):
    refuse_differences([chain for n in (1, 2, 3) for chain in Family(n, damped)])


@pytest.mark.thin(1)
@pytest.mark.parametrize("numbers", [(1, 4, 6), pytest.param(range(1, 12), marks=pytest.mark.slow)])
@pytest.mark.parametrize("damped", [False, True])
def test_pages_tell_the_same(damped, numbers):
    chains = [Family(3, damped)[number] for number in numbers]
    page = judge(models_of({"models": [*map(entry, chains), STRANGER]}), Engine())
    for i, j in combinations(range(len(chains)), 2):
        assert told(page.verdict(i + 1, j + 1, View.POSITIVE)) == told(
            compare(chains[i], chains[j])
        )


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_shipped_tables_tell_the_same(damped):
    for n in (2, 3):
        family = Family(n, damped)
        for i, j in combinations(range(1, len(family) + 1), 2):
            shipped = catalog(n, damped=damped).verdict(i, j, View.POSITIVE)
            assert told(shipped) == told(compare(family[i], family[j]))


@pytest.mark.full
@pytest.mark.parametrize("seed", range(3))
def test_commands_tell_the_same(seed, tmp_path):
    random = Random(seed)
    damped = random.random() < 0.5
    known = [chain for n in (1, 2, 3) for chain in Family(n, damped)]
    option = "--damped" if damped else "--undamped"
    of_sizes = {
        (v["left"], v["right"]): v
        for v in json.loads(called("verdicts", "1-3", option, "--json", "-").stdout)["verdicts"]
    }
    chains = sorted(random.sample(known, 4), key=known.index)
    path = tmp_path / "models.json"
    path.write_text(json.dumps({"models": [*map(entry, chains), STRANGER]}))
    listed = {
        (v["left"], v["right"]): v
        for v in json.loads(called("verdicts", path, "--json", "-").stdout)["verdicts"]
    }
    for pair in combinations(chains, 2):
        names, own = [name_of(c) for c in pair], [entry(c)["name"] for c in pair]
        files = [f"{path}:{name}" for name in own]
        asked = [
            (*names, option),
            files,
            (files[0], names[1], option),
            (names[0], files[1], option),
        ]
        found = [json.loads(called("compare", *words, "--json").stdout) for words in asked]
        assert all(verify(data).status is Status.HOLDS for data in found)
        every = [told_in_json(data) for data in (*found, listed[*own], of_sizes[*names])]
        assert every == every[:1] * len(every)
        assert all(name in found[1]["sentence"] for name in own)


def test_a_chain_of_a_file_is_drawn_and_written_back_as_a_chain(tmp_path):
    models = models_of({"models": [entry(Family(2)[3]), entry(Family(2, False)[1]), STRANGER]})
    again = read_models(write_models(tmp_path / "again.json", models))
    assert [m.chain for m in again] == [Family(2)[3], Family(2, False)[1], None]
    done = called("compare", *(f"{tmp_path / 'again.json'}:{m.name}" for m in list(again)[:2]))
    assert "#=[1fs]   [2FS]" in done.stdout and "condition" in done.stdout


def test_foster_in_a_file_of_models():
    one, five = (Model.from_chain(Family(4, False)[number]) for number in (1, 5))
    verdict = compare(one, five)
    assert (verdict.relation, verdict.evidence.formula) == ("indistinguishable", "Foster theorem")


@pytest.mark.full
def test_a_bound_of_a_mixed_list_counts_both_parts():
    chains = [entry(chain) for chain in Family(3)]
    engine = Engine()

    def safety(entries):
        subjects = engine.general_subjects(models_of({"models": entries}).models)
        return family_safety(engine.decisions(subjects, Query()))

    alone, mixed = safety(chains), safety([*chains, STRANGER])
    assert 100 < mixed <= alone


def drawn(random, sizes, damped, sensor):
    """A chain of one of these sizes, now and then with a ground damper or a lag."""
    family = Family(random.choice(sizes), damped, sensor)
    chain = family[random.randint(1, len(family))]
    dampers = random.choice([(), (), (), (random.randint(1, chain.n_masses),)])
    return replace(chain, ground_dampers=dampers, lag=random.random() < 0.1)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_two_hundred_pairs_of_four_and_five_masses(seed):
    random = Random(seed)
    sensor = random.choice(list(Quantity))
    chains = dict.fromkeys(drawn(random, (4, 5), seed % 2 == 1, sensor) for _ in range(11))
    refuse_differences(list(chains))
