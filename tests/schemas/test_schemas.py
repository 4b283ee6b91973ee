"""Every JSON that is written says which format it is, and is what its schema says."""

import json
import shlex
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from disting import Model, ModelList, catalog, gate, write_models
from disting.algebra.certainty import Certainty
from disting.conditions.inclusion import Inclusion
from disting.conditions.rule import Stage
from disting.equivalence.listing import Signs
from disting.errors import InputError
from disting.evidence.positive import Share
from disting.fit.networks import fit_networks
from disting.fit.search.setup import Setup
from disting.general.any_model import of_network
from disting.general.balls import POSITIVE
from disting.general.fibre import Extent
from disting.general.model_files import read_models
from disting.measurement import write_csv
from disting.model.question import Domain
from disting.network.families import FAMILIES, family_of
from disting.network.notation import network_of
from disting.planning.next_experiment import Reason
from disting.planning.power import Answer
from disting.planning.rival import Limit, Trust
from disting.quantities import Quantity
from disting.schemas import Format, record_schema, schema
from disting.simulation import Bench, demo, simulate
from disting.verdict import placement_verdicts
from disting.verdict.result import Relation
from tests.cli.process import called
from tests.cli.test_fit_joint import column, written
from tests.fit.test_predictions import FREE, VALUES, fit_file, member, twin_values

MODELS = {
    "title": "Vessels",
    "models": [
        {"name": "cell", "circuit": "R0-p(R1,C1)"},
        {"name": "Boukamp", "circuit": "[R1C1]", "notation": "boukamp"},
        {"name": "drive", "machine": "1=2=3, 2=4; F1; S4", "quantity": "velocity"},
        {"name": "any", "network": "1>2, 2>0; in 1; out 2"},
        {"name": "drug", "flows": [[1, 2], [2, 1], [1, 0]], "input": 1, "output": [1]},
        {
            "name": "gear",
            "elements": [["m1", 1], ["m2", 2], ["k12", 1, 2, "i"]],
            "force": [1, 0],
            "sensor": 2,
            "quantity": "position",
        },
        {"name": "bridge", "elements": [["R1", 1, 2], ["C1", 2, 0]], "port": [1, 0]},
        {"name": "rough", "elements": [["P1", 1, 2, "n"], ["P2", 2, 0, "n"]], "port": [1, 0]},
        {"name": "dose", "flows": [[1, 0]], "output": 1, "x0": {"1": "c"}, "known": []},
        {"name": "decay", "A": [["-k"]], "C": [1], "x0": ["c"]},
        {
            "name": "train",
            "components": [
                {"name": "A", "elements": [{"name": "B", "type": "Disk", "inertia": 2}]}
            ],
            "structure": [],
            "force": "A.B",
            "sensor": "A.B",
        },
        {"name": "a", "A": [["-k12-k01", 0], ["k12", "-k02"]], "B": [1, 0], "C": [0, 1]},
        {"name": "b", "num": ["k"], "den": ["T", 1]},
        {"name": "c", "G": "(s**2 + w**2)/(s**2 + 2*z*w*s + w**2)"},
        {"name": "d", "chain": "2:1+b2", "damped": True},
    ],
}
SET = "m1=1,m2=2,m3=3,k12=4,k23=5,d12=1,d23=2"
PLAN = "2:1+b1 2:1+b2 --set m1=0.0045,m2=0.005,k12=550,d12=0.08,b1=0.1 --band 5..300"
WRITTEN = [
    ("compare 3:1 3:4", Format.VERDICT),
    (
        "compare 3:1 3:11 --also inertia=1:0.5 --also lock=2/2 --also inertia=1/1:2",
        Format.EVERYWHERE,
    ),
    ("compare 2:1 3:4 --undamped --quantity position", Format.VERDICT),
    ("compare 3:2 3:5 --undamped --domain complex --conditions 1-5", Format.VERDICT),
    ("compare models.json:a models.json:b", Format.VERDICT),
    ("compare 3:1+b1 3:4 --also sensor=2 --also spring=1:3 --also brake=1:0.5", Format.EVERYWHERE),
    ("compare models.json:d 2:1", Format.VERDICT),
    ("compare 'R0-p(R1,C1)' 'p(R0,R1-C1)'", Format.VERDICT),
    ("compare 'R0-C1' 'R0-p(R1,C1)-W1'", Format.VERDICT),
    ("compare '1=2=3, 2=4; F1; S4' '1=2=3=4; F1; S4' --domain complex", Format.VERDICT),
    ("compare '1>2, 2>1, 1>0; in 1, 2; out 1' '1>2, 2>1, 2>0; in 1, 2; out 1'", Format.VERDICT),
    ("compare models.json:drug models.json:gear", Format.VERDICT),
    ("verdicts 3 --undamped", Format.VERDICTS),
    ("verdicts compartments-2", Format.VERDICTS),
    ("verdicts 1-2", Format.VERDICTS),
    ("verdicts models.json --domain real", Format.VERDICTS),
    (f"equivalents 3:4 --to 3 --set {SET}", Format.EQUIVALENTS),
    (f"equivalents 3:4 --to 3:1 --set {SET} --also inertia=1:0.5", Format.EQUIVALENTS),
    (
        "equivalents 'R0-p(R1,C1)' --family circuits-4 --set R0=1,R1=2,C1=1/2",
        Format.NETWORK_EQUIVALENTS,
    ),
    ("equivalents '1>2, 2>0; in 1; out 2' --family compartments-2", Format.NETWORK_EQUIVALENTS),
    ("next 3:1 3:11 --cost sensor=2,brake=1", Format.NEXT),
    ('next "R0-p(R1,C1)" "p(R0,R1-C1)"', Format.NEXT),
    ('next "1>2,2>1,2>0; in 1; out 1" "1>2,2>1,1>0; in 1; out 1"', Format.NEXT),
    ("next left.json", Format.NEXT_OF_FIT),
    ("fit demo.csv --masses 1", Format.FIT),
    ("fit demo.csv --models '1=2; F1; S1' --models '1~2; F1; S1'", Format.NETWORK_FIT),
    (f"plan {PLAN} --noise 0.3", Format.PLAN),
    (
        "plan 3:1 3:11 --set m1=1,m2=2,m3=3,k12=4,k23=5,d12=1,d23=2 --noise 0.02 --band 1..9",
        Format.PLAN,
    ),
    ("plan left.json", Format.PLANS_OF_FIT),
    (
        "plan R0-p(R1,C1) R0-C1 --set R0=1,R1=2,C1=0.1 --noise 0.3 --band 1..9 --lines 9",
        Format.PLAN,
    ),
    ("next cells.json", Format.NEXT_OF_NETWORK_FIT),
    ("look demo.csv", Format.LOOK),
    ("look both.csv --band 1..2", Format.LOOK),
]
# formats that a cheaper command writes too; the second one is validated in tests/cli/test_fit_joint
BY_HAND = [
    pytest.param("verdicts circuits-4", Format.VERDICTS, marks=pytest.mark.slow),
    pytest.param(
        *("fit both.csv --sensor 1,2 --masses 2 --fix d12=0.05", Format.FIT), marks=pytest.mark.slow
    ),
    pytest.param("plan cells.json", Format.PLANS_OF_FIT, marks=pytest.mark.slow),
]


UNEXPLAINED = ("fit demo.csv --masses 1", "fit demo.csv --models")


def valid(data: dict[str, object], of: Format) -> None:
    assert data["format"] == of.value
    errors = Draft202012Validator(schema(of)).iter_errors(data)
    assert [f"{error.json_path}: {error.message[:200]}" for error in errors] == []


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("schemas")
    (place / "models.json").write_text(json.dumps(MODELS), encoding="utf-8")
    fit_file(place / "left.json", member(FREE, VALUES, **{"3:11": twin_values()}))
    write_csv(demo(0).response("acceleration"), place / "demo.csv")
    cells = [network_of(text) for text in ("R0-p(R1,C1)", "p(R0,R1-C1)", "R0-p(R1-R2,C1)-C2")]
    measured = simulate(cells[0], {"R0": 1, "R1": 2, "C1": 0.01}, bench=Bench(output_noise=0.1))
    found = fit_networks(measured.response("position"), cells).to_dict()
    (place / "cells.json").write_text(json.dumps(found), encoding="utf-8")
    written(place / "both.csv", column(Setup(), 1), column(Setup(sensor="2"), 2, 0.01))
    return place


@pytest.mark.full
@pytest.mark.parametrize(("command", "of"), [*WRITTEN, *BY_HAND])
def test_what_a_command_writes_is_what_its_schema_says(
    folder: Path, command: str, of: Format, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    done = called(*shlex.split(command), "--json", "out.json")
    assert done.returncode == int(command.startswith(UNEXPLAINED)), done.stderr
    valid(json.loads((folder / "out.json").read_text(encoding="utf-8")), of)


@pytest.mark.parametrize("masses", [2, pytest.param(3, marks=pytest.mark.full)])
def test_a_catalogue_is_what_its_schema_says(masses: int) -> None:
    for damped in (False, True):
        valid(json.loads(catalog(masses, damped=damped).to_json()), Format.CATALOGUE)


@pytest.mark.full
def test_a_gate_is_what_its_schema_says() -> None:
    models = ["R0-p(R1,C1)", "p(R0,R1-C1)", "p(R0,C1)-p(R1,C2)", "p(R0,R1-C1,C2)", "L1-p(R1,C1)"]
    valid(json.loads(json.dumps(gate(models).to_dict())), Format.GATE)


def test_a_file_of_models_is_what_its_schema_says(tmp_path: Path) -> None:
    model = Model.from_transfer_function(["k"], ["T", 1], name="lag")
    path = write_models(tmp_path / "m.json", ModelList((model,)))
    valid(json.loads(path.read_text(encoding="utf-8")), Format.MODELS)
    Draft202012Validator(schema(Format.MODELS)).validate(MODELS)
    assert read_models(path)["lag"] == model
    path.write_text(
        path.read_text(encoding="utf-8").replace("models 1", "models 9"), encoding="utf-8"
    )
    with pytest.raises(InputError, match="disting models 1"):
        read_models(path)


@pytest.mark.full
def test_every_format_has_a_schema_of_its_own_and_all_are_written_somewhere() -> None:
    for of in Format:
        found = schema(of)
        Draft202012Validator.check_schema(found)
        assert found["title"] == of.value and of.description
    told = {of for _, of in WRITTEN} | {Format.CATALOGUE, Format.MODELS, Format.GATE}
    assert told == set(Format)


@pytest.mark.thin(8)
@pytest.mark.parametrize("of", Format)
def test_another_field_or_a_missing_one_is_none_of_the_format(of: Format) -> None:
    """A schema that lets everything pass says nothing."""
    validator = Draft202012Validator(schema(of))
    assert not validator.is_valid({"format": of.value})
    assert not validator.is_valid({})


def test_words_of_the_schemas_are_those_of_the_program() -> None:
    defined = schema(Format.VERDICT)["$defs"] | schema(Format.PLAN)["$defs"]
    words = {
        "relation": [r.value for r in Relation],
        "quantity": [s.value for s in Quantity],
        "domain": [d.value for d in Domain],
        "inclusion": [i.value for i in Inclusion],
        "certainty": ["", *(c.value for c in Certainty)],
        "answer": [a.value for a in Answer],
    }
    assert {name: defined[name]["enum"] for name in words} == words
    verdict, plan = defined["verdict"]["properties"], defined["plan"]["properties"]
    assert verdict["representation"]["enum"] == [s.value for s in Stage]
    assert plan["trust"]["enum"] == [t.value for t in Trust]
    assert plan["limits"]["additionalProperties"]["enum"] == [x.value for x in Limit]
    (share,) = [s for s in defined["share"]["anyOf"] if s["properties"]]
    assert share["properties"]["share"]["enum"] == [s.value for s in Share]
    answer = schema(Format.EVERYWHERE)["properties"]["answer"]["enum"]
    assert answer == [a.value for a in placement_verdicts.Answer]
    listing = schema(Format.EQUIVALENTS)["properties"]["listings"]["items"]["properties"]
    signs = listing["equivalents"]["items"]["properties"]["signs"]["enum"]
    assert signs == [s.value for s in Signs]
    networks = schema(Format.NETWORK_EQUIVALENTS)["properties"]["equivalents"]["items"]
    extents = networks["properties"]["extent"]["enum"]
    assert extents == ["", *(e.value for e in Extent), POSITIVE]
    pairs = schema(Format.NEXT_OF_FIT)["properties"]["pairs"]["items"]["properties"]
    assert pairs["standing"]["enum"] == [s.value for s in Reason]


def test_the_command_prints_a_schema_that_needs_no_other_file() -> None:
    done = called("schema", "fit")
    assert json.loads(done.stdout) == schema(Format.FIT)
    listed = called("schema").stdout.splitlines()
    assert [line.partition(":")[0] for line in listed] == [*(of.short for of in Format), "records"]
    assert json.loads(called("schema", "records").stdout) == record_schema()


# seconds to enumerate, and written like smaller ones
LARGE = ("machines-3", "machines-3-damped", "trees-4", "trees-4-damped")


@pytest.mark.full
@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] * (n in LARGE)) for n in FAMILIES]
)
def test_families_and_networks_are_written_as_the_schema_of_models_says(
    tmp_path: Path, name: str
) -> None:
    networks = family_of(name).networks[-2:]
    models = ModelList(tuple(of_network(network) for network in networks))
    path = write_models(tmp_path / f"{name}.json", models)
    valid(json.loads(path.read_text(encoding="utf-8")), Format.MODELS)
    assert [m.network for m in read_models(path)] == list(networks)
