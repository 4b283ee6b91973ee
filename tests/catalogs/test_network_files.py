"""Shipped verdicts on families of networks: what is computed now, byte for byte, and no lies."""

import json
import random
from dataclasses import replace
from itertools import combinations

import pytest

from disting.catalogs.build import _false_of_networks, verify_networks
from disting.catalogs.files import lines
from disting.catalogs.network_files import (
    COMPLEX,
    POSITIVE,
    SHIPPED,
    _pairs,
    build_networks,
    name_of,
    read,
    recall,
    recall_of,
    recall_open,
)
from disting.cli.run import main
from disting.decide import asking
from disting.errors import CatalogError
from disting.evidence.general import OfPart
from disting.evidence.kinds import evidence_from
from disting.files import shipped_folder
from disting.general.any_model import of_network, without_names
from disting.general.forms import BRIEFLY, WAS_BRIEF
from disting.general.identifiability import PARAMETERS
from disting.general.over_domain import positive_question
from disting.general.plain_maps import PLAIN_MAPS
from disting.network.families import family_of
from disting.network.notation import network_of
from disting.verdict.engine import Engine, question_key
from disting.verdict.model_equivalents import model_equivalents
from disting.verdict.result import Relation
from tests.oracles.twins import STARTS, twin


@pytest.mark.full
@pytest.mark.parametrize(
    "name",
    [
        "circuits-4",
        *(pytest.param(n, marks=pytest.mark.slow) for n in sorted({*SHIPPED} - {"circuits-4"})),
    ],
)
def test_what_is_shipped_is_what_is_computed(name):
    assert verify_networks(family_of(name), shipped_folder(), Engine()).wrong == ()


@pytest.mark.full
@pytest.mark.parametrize("name", ["machines-3", pytest.param("trees-4", marks=pytest.mark.slow)])
def test_evidence_on_two_chains_holds_by_the_theorem_that_is_named(name: str) -> None:
    """One on networks was looked up among those on chains, and the evidence "did not hold"."""
    family, engine = family_of(name), Engine()
    records = read(shipped_folder() / f"{name_of(name)}.jsonl")
    heads = records[: 1 + len(family.networks)]
    sides = engine.general_subjects(family.networks)
    pairs = [
        r
        for r in records[len(heads) :]
        if sides[r["left"] - 1].chain and sides[r["right"] - 1].chain
    ]
    assert len(pairs) > 1
    assert _false_of_networks(family, [*heads, *pairs], engine) == []
    written = (shipped_folder() / f"{name_of(name)}.jsonl").read_text(encoding="utf-8")
    for r in pairs:
        both = [sides[r[side] - 1] for side in ("left", "right")]
        decided = (engine.decisions(both, query) for query in (COMPLEX, POSITIVE))
        (line,) = _pairs(engine, both, *decided)
        number = {"left": r["left"], "right": r["right"]}
        assert lines([line | number]) in written


@pytest.mark.full
def test_a_verification_takes_over_what_a_brief_search_left_open():
    family = family_of("machines-3-damped")
    records = read(shipped_folder() / f"{name_of(family.name)}.jsonl")
    engine = Engine()
    count = recall_open(family, records, engine)
    assert count == 230
    assert len(engine.answers) == count
    assert recall_open(replace(family, in_brief=False), records, Engine()) == 0


@pytest.mark.full
@pytest.mark.parametrize(
    ("reason", "late"), [("out of time (20 s)", 1), ("too large: a matrix of 9 entries", 0)]
)
def test_what_is_not_found_in_time_now_is_no_fault_of_the_file(reason, late):
    """Any other difference of the same line is one."""
    family, engine = family_of("compartments-2"), Engine()
    recall(family.name, engine)
    model = (without_names(engine.general_subjects(family.networks)[0].subject),)
    known = engine.answer(PARAMETERS, model, engine.settings)
    engine.remember(PARAMETERS, model, replace(known, reason=reason))
    found = verify_networks(family, shipped_folder(), engine)
    assert (found.late, len(found.wrong)) == (late, 1 - late)


@pytest.mark.full
def test_a_theorem_stays_beside_what_a_search_found():
    """What a renaming proves over complex values it proves over positive ones: so says a comparison
    of the two alone, and so say the files, made in whatever order.
    """
    renamed = [
        r["positive"]
        for name in SHIPPED
        for r in read(shipped_folder() / f"{name_of(name)}.jsonl")
        if "left" in r and "as" not in r
        if r["complex"].get("evidence", {}).get("kind") == "renaming"
    ]
    assert len(renamed) > 10
    assert {verdict["evidence"]["kind"] for verdict in renamed} == {"renaming"}


@pytest.mark.full
def test_a_theorem_is_the_evidence_of_what_is_called_one():
    """In lines of all files: where the search found something else, the theorem stands beside it."""
    found = [
        r
        for name in SHIPPED
        for r in read(shipped_folder() / f"{name_of(name)}.jsonl")
        if "left" in r and "as" not in r and r["positive"].get("certainty") == "theorem"
    ]
    assert len(found) > 10
    for r in found:
        evidence = r["positive"].get("evidence") or r["finding"].to_dict()["evidence"]
        assert evidence["kind"] == "theorem", (r["left"], r["right"])


@pytest.mark.full
@pytest.mark.parametrize(
    "name", [pytest.param("machines-2", marks=pytest.mark.slow), "compartments-2"]
)
def test_what_is_looked_up_is_what_is_decided(name):
    models = [of_network(n) for n in family_of(name).networks]
    known, fresh = Engine(), Engine()
    recall(name, known)
    assert known.answers and not fresh.answers
    looked_up, decided = (e.decisions(e.general_subjects(models), POSITIVE) for e in (known, fresh))
    asked = len(fresh.answers)
    assert asked == len(known.answers) - len(models)  # what can be determined of each is known too
    for i, j in combinations(range(len(models)), 2):
        if decided.rule(i, j) not in ("1", "2", "3"):
            assert looked_up.verdict(i, j).to_dict() == decided.verdict(i, j).to_dict()


@pytest.mark.parametrize(
    ("name", "count"), [("circuits-4", 96), ("circuits-5", 1590), ("cells-4", 142), ("cells-5", 62)]
)
def test_circuits_are_all_decided(name, count):
    text = (shipped_folder() / f"{name_of(name)}.jsonl").read_text(encoding="utf-8")
    header, *records = map(json.loads, text.splitlines())
    pairs = [r["positive"]["relation"] for r in records[header["models"] :]]
    assert len(pairs) == count
    assert Relation.UNDECIDED.value not in pairs


SEARCHED = {
    "machines-3": (2817, 16),
    "machines-3-damped": (1214, 230),
    "compartments-3": (8355, 919),
    "trees-4": (2767, 42),
}
"""Pairs that are the same over complex values, and those that stay open over positive ones."""


@pytest.fixture(
    scope="module",
    params=[
        pytest.param(n, marks=[pytest.mark.slow] * (n in ("machines-3", "trees-4")))
        for n in SEARCHED
    ],
)
def searched(request):
    """A large family: its name, its sides, and its pairs as the file has them."""
    header, *records = read(shipped_folder() / f"{name_of(request.param)}.jsonl")
    networks = family_of(request.param).networks
    sides = Engine().general_subjects([of_network(n) for n in networks])
    return request.param, sides, records[header["models"] :]


@pytest.mark.full
def test_a_large_family_is_searched_in_brief(searched):
    name, _, pairs = searched
    open_ = [r for r in pairs if r["positive"]["relation"] == "undecided"]
    assert (len(pairs), len(open_)) == SEARCHED[name]
    assert all(WAS_BRIEF in r["finding"].note for r in open_)


@pytest.mark.sampled(1)
@pytest.mark.full
def test_pairs_of_a_large_family_are_found_again(searched):
    """Some that were asked about: parts of the networks do not tell them."""
    name, sides, pairs = searched
    asked = [r for r in pairs if "finding" in r and "as" not in r]
    asked = [r for r in asked if not isinstance(r["finding"].evidence, OfPart)]
    engine = Engine()
    for r in random.Random(name).sample(asked, 2):
        question, models = positive_question(sides[r["left"] - 1], sides[r["right"] - 1])
        searched_by = question if question is PLAIN_MAPS else BRIEFLY
        assert engine.answer(searched_by, models, engine.settings) == r["finding"]


@pytest.mark.sampled(1)
@pytest.mark.full
def test_what_pairs_have_from_others_is_true_of_them(searched):
    """That networks which give the same do so, by twins in plain numbers, and all evidence of some."""
    name, sides, pairs = searched
    draw = random.Random(name)
    shared = [r for r in pairs if "as" in r]
    assert bool(shared) is (name != "machines-3-damped")  # none of which gives the same
    for r in draw.sample(shared, min(3, len(shared))):
        places = zip((r["left"], r["right"]), r["as"], strict=True)
        for own, other in places:
            networks = [sides[at - 1].subject.network for at in (own, other)]
            assert twin(*networks, draw, 4 * STARTS)[1] is not None
    decided = [r for r in pairs if r["positive"]["relation"] != "undecided"]
    for r in decided:
        assert r["positive"].get("evidence") or r["finding"].evidence is not None
    for r in draw.sample(decided, 6):
        left, right = sides[r["left"] - 1], sides[r["right"] - 1]
        evidence = r["finding"].evidence if "finding" in r else None
        evidence = evidence or evidence_from(r["positive"]["evidence"])
        assert asking.confirms(left, right, evidence, r["positive"]["representation"])


@pytest.mark.full
def test_what_a_theorem_tells_is_written_beside_an_open_search():
    """Networks 17 and 28 of machines-3: interlacing tells that they are the same."""
    whole = family_of("machines-3")
    names = [whole.networks[i - 1].name for i in (17, 28)]
    text = build_networks(replace(whole, source=lambda: names), Engine())
    record = json.loads(text.splitlines()[-1])
    assert record["positive"]["evidence"] == {"kind": "theorem", "name": "interlacing"}
    assert record["finding"][1] == "abandoned"


@pytest.mark.sampled(1)
@pytest.mark.full
@pytest.mark.parametrize("name", ["circuits-4", "machines-3-damped"])
def test_what_can_be_determined_is_taken_over(name):
    """Networks of 15 values take minutes: nothing of them is computed again."""
    engine = Engine()
    recall(name, engine)
    _, *records = read(shipped_folder() / f"{name_of(name)}.jsonl")
    for record, network in zip(records, family_of(name).networks, strict=False):
        key = question_key(PARAMETERS, (without_names(of_network(network)),), engine.settings)
        assert engine.answers[key].to_dict() == record["identifiability"]


@pytest.mark.sampled(1)
@pytest.mark.full
def test_what_a_part_shows_of_the_whole_is_taken_from_the_part():
    """Two networks and the rest of one of them without a flow, out of a large family."""
    whole = family_of("compartments-3")
    numbers = (3, 12, 51)
    names = [whole.networks[n - 1].name for n in numbers]
    built = build_networks(replace(whole, source=lambda: names), Engine())
    record = next(r for r in map(json.loads, built.splitlines()) if (r.get("left"), r.get("right")) == (1, 3))  # fmt: skip
    _, *stored = read(shipped_folder() / f"{name_of(whole.name)}.jsonl")
    known = next(r for r in stored if (r.get("left"), r.get("right")) == (3, 51))
    finding = known["finding"]
    assert record["finding"] == json.loads(finding.to_json())
    assert (finding.evidence.kind, finding.evidence.missing) == ("of-part", ("a12",))
    said = finding.evidence.sentence("A", "B")
    assert said.startswith("E is B without a12, which gives an open set of")


@pytest.mark.full
@pytest.mark.parametrize(
    ("group", "kinds"),
    [
        pytest.param(6, {"of-part", "witnesses"}, marks=pytest.mark.slow),
        (9, {"explicit"}),
    ],
)
def test_some_of_a_large_family_alone_get_what_the_whole_gets(group, kinds):
    """Eight networks of a class: other ones are searched then, and what is found is the same."""
    whole = family_of("compartments-3")
    header, *records = read(shipped_folder() / f"{name_of(whole.name)}.jsonl")
    models, pairs = records[: header["models"]], records[header["models"] :]
    members = [m["model"] for m in models if m["group"] == group]
    chosen = sorted(random.Random(2).sample(members, 8))
    names = [whole.networks[i - 1].name for i in chosen]
    built = build_networks(replace(whole, source=lambda: names), Engine()).splitlines()[9:]
    known = {(p["left"], p["right"]): p["positive"]["relation"] for p in pairs}
    seen = set()
    for record in map(json.loads, built):
        if "positive" in record:
            found = record["positive"]["relation"]
            wanted = known[chosen[record["left"] - 1], chosen[record["right"] - 1]]
            assert found == wanted or "undecided" in (found, wanted)
        evidence = record.get("finding", [None] * 5)[4]
        seen |= {evidence["kind"]} if evidence else set()
    assert (
        len(built) == 28 and kinds <= seen and any('"as"' in line for line in built) is (group == 9)
    )


FAMILY_TEXTS = ("#~1, 1~2; F1; S1",)


@pytest.mark.full
@pytest.mark.parametrize("text", [*FAMILY_TEXTS, "#~2, 2~1; F2; S2"])
def test_a_network_of_a_family_in_any_numbers_is_looked_up(text):
    given, engine = of_network(network_of(text)), Engine()
    others = [of_network(n) for n in family_of("machines-2").networks if n.name != text]
    recall_of(given, "machines-2", engine)
    known = len(engine.answers)
    found = model_equivalents(given, others, engine=engine)
    computed = len(engine.answers) - known
    assert known and (computed == 0) is (text in FAMILY_TEXTS)  # maps name the parameters
    fresh = model_equivalents(given, others, engine=Engine())
    assert [(x.model.name, x.verdict.relation) for x in found] == [
        (x.model.name, x.verdict.relation) for x in fresh
    ]
    for x in found:
        left, right = engine.general_subjects([given, x.model])
        evidence = x.verdict.evidence
        assert evidence is None or asking.confirms(left, right, evidence, x.verdict.representation)


def lied(record):
    """Lies about one pair, each another one."""
    yield "relation", {"positive": record["positive"] | {"relation": "undecided"}}
    yield "pair", {"right": record["right"] + 1}
    if record.get("finding"):
        kept, outcome, certainty, safety, evidence, note = record["finding"]
        other = "fails" if outcome == "holds" else "holds"
        yield "outcome", {"finding": [kept, other, certainty, safety, evidence, note]}


@pytest.mark.full
def test_a_lie_is_found(tmp_path):
    name = "compartments-2"
    family = family_of(name)
    text = (shipped_folder() / f"{name_of(name)}.jsonl").read_text(encoding="utf-8")
    lines = text.splitlines()
    at, record = next(
        (at, r) for at, line in enumerate(lines) if (r := json.loads(line)).get("finding")
    )
    engine = Engine()  # what it computes is no lie
    for _, change in lied(record):
        path = tmp_path / f"{name_of(name)}.jsonl"
        new = [*lines[:at], json.dumps(record | change), *lines[at + 1 :]]
        path.write_text("\n".join(new) + "\n", encoding="utf-8")
        assert verify_networks(family, tmp_path, engine).wrong, change


def first_witnesses(lines):
    """Where the first points with and without an equivalent are, and the record."""
    return next(
        (at, r)
        for at, line in enumerate(lines)
        if (r := json.loads(line)).get("finding") and r["finding"][4]["kind"] == "witnesses"
    )


@pytest.mark.sampled(1)
@pytest.mark.full
@pytest.mark.parametrize(
    ("digits", "told"),
    [("{:.5g}", False), pytest.param("{:.1e}", True, marks=pytest.mark.slow), ("", True)],
)
def test_digits_of_an_equivalent_are_checked_by_themselves(digits, told, tmp_path):
    """Where it lies on a curve a search in rounded numbers ends at others on another processor."""
    path = tmp_path / f"{name_of('compartments-2')}.jsonl"
    lines = (shipped_folder() / path.name).read_text(encoding="utf-8").splitlines()
    at, record = first_witnesses(lines)
    record["finding"][4]["equivalent"] = [
        [name, digits.format(float(x)) or f"{2 * float(x)}"]
        for name, x in record["finding"][4]["equivalent"]
    ]
    assert json.loads(lines[at]) != record
    lines[at] = json.dumps(record, separators=(",", ":"))
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")
    wrong = verify_networks(family_of("compartments-2"), tmp_path, Engine()).wrong
    assert any("the evidence does not hold" in sentence for sentence in wrong) is told
    assert bool(wrong) is told


@pytest.mark.full
def test_evidence_that_is_false_is_found_by_itself(tmp_path):
    name = "compartments-2"
    path = tmp_path / f"{name_of(name)}.jsonl"
    text = (shipped_folder() / path.name).read_text(encoding="utf-8")
    lines = text.splitlines()
    at, record = first_witnesses(lines)
    twin = next(
        r
        for line in lines
        if (r := json.loads(line)).get("finding")
        and r["finding"][4]
        and r["finding"][4]["kind"] == "witnesses"
        and r["finding"] != record["finding"]
    )
    new = [*lines[:at], json.dumps(record | {"finding": twin["finding"]}), *lines[at + 1 :]]
    path.write_text("\n".join(new) + "\n", encoding="utf-8")
    told = verify_networks(family_of(name), tmp_path, Engine()).wrong
    assert any("the evidence does not hold" in sentence for sentence in told)


@pytest.mark.parametrize("damage", ["{", '{"schema": 9}', ""])
def test_a_damaged_file_is_refused(damage, tmp_path):
    path = tmp_path / f"{name_of('circuits-4')}.jsonl"
    path.write_text(damage, encoding="utf-8")
    with pytest.raises(CatalogError, match="cannot be read"):
        recall("circuits-4", Engine(), tmp_path)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        (lambda records: [records[0] | {"schema": 0}, *records[1:]], "another schema, or other"),
        (lambda rows: [rows[0], rows[1] | {"network": "1>0"}, *rows[2:]], "or other networks"),
        (
            lambda records: [*records, records[-1] | {"left": 2, "right": 2}],
            "no pair: 2, 2",
        ),
    ],
    ids=["schema", "networks", "pair"],
)
def test_a_file_of_something_else_is_refused(changed, said, tmp_path):
    name = f"{name_of('compartments-2')}.jsonl"
    lines = (shipped_folder() / name).read_text(encoding="utf-8").splitlines()
    records = changed([json.loads(line) for line in lines])
    text = "".join(f"{json.dumps(record)}\n" for record in records)
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(CatalogError, match=said):
        recall("compartments-2", Engine(), tmp_path)


@pytest.mark.full
def test_commands(tmp_path, capsys):
    assert main(["catalog", "families", "compartments-2", "--out", str(tmp_path)]) == 0
    assert main(["catalog", "verify", "compartments-2", "--catalog", str(tmp_path)]) == 0
    assert "as it is computed now, and every evidence holds" in capsys.readouterr().out
    assert main(["catalog", "verify", "circuits-4", "--catalog", str(tmp_path)]) != 0
    assert "there is no" in capsys.readouterr().err
    shipped = (shipped_folder() / f"{name_of('compartments-2')}.jsonl").read_bytes()
    assert (tmp_path / f"{name_of('compartments-2')}.jsonl").read_bytes() == shipped
