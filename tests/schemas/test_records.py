"""Each line of the shipped files is what its schema says, and the schema says no less than that."""

import json
from collections.abc import Iterator
from dataclasses import fields
from functools import cache
from typing import Any, get_args

import pytest
from jsonschema import Draft202012Validator
from jsonschema.exceptions import best_match

from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveEvidence
from disting.files import shipped_folder
from disting.schemas import record_schema
from tests.catalogs.lies import kinds_in, leaf, leaves, without_leaf

CLASSES = {
    kind.kind: kind
    for union in (Evidence, InclusionEvidence, PositiveEvidence)
    for kind in get_args(union)
}
# kinds that only single verdicts have, and evidence on experiments and ranges
NOT_SHIPPED = {
    "both ways", "box", "constants", "dead time", "fibre under experiments", "full-parts", "minor",
    "missing-elements", "no-equivalent", "odd fibres", "only one", "supermodel",
}  # fmt: skip
SMALL = (
    "chains-2-damped", "sizes-undamped", "dampers-3-damped", "networks-machines-2", "candidates",
    "next-3-damped", "settled-dampers",
)  # fmt: skip


def lines(name: str) -> list[str]:
    return (shipped_folder() / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()


def names() -> list[str]:
    return sorted(path.stem for path in shipped_folder().glob("*.jsonl"))


@cache
def validator(definition: str) -> Draft202012Validator:
    """Of one definition alone."""
    return Draft202012Validator(record_schema() | {"anyOf": [{"$ref": f"#/$defs/{definition}"}]})


def fault(name: str, line: str) -> str:
    """The first fault of a line of a file, "" if there is none."""
    error = best_match(validator(f"{name.split('-')[0]}_line").iter_errors(json.loads(line)))
    return "" if error is None else f"{name} {error.json_path}: {error.message[:200]}"


def faults(step: int) -> list[str]:
    """Faults of every so many lines of each file, from its first one."""
    found = (fault(name, line) for name in names() for line in lines(name)[::step])
    return [*filter(None, found)]


@pytest.mark.parametrize("name", SMALL)
def test_lines_are_what_their_schema_says(name: str) -> None:
    some = lines(name)
    assert [*filter(None, (fault(name, line) for line in (*some[:2], some[-1])))] == []


@pytest.mark.full
def test_lines_of_all_files_are_what_their_schema_says() -> None:
    assert faults(40) == []


@pytest.mark.slow
def test_all_lines_are_what_their_schema_says() -> None:
    assert faults(1) == []


@pytest.mark.parametrize("name", SMALL)
def test_a_field_that_is_missing_or_unknown_is_refused(name: str) -> None:
    for line in lines(name)[:2]:
        record = json.loads(line)
        assert fault(name, json.dumps(record | {"note": 1}))
        for field in record.keys() - {"inertia", "lock", "inclusions"}:
            assert fault(name, json.dumps({k: v for k, v in record.items() if k != field})), field
            assert fault(name, json.dumps(record | {field: {"x": 1}})), field


def test_evidence_without_a_field_is_refused() -> None:
    line = next(line for line in lines("chains-3-damped")[2:] if '"ranks"' in line)
    record = json.loads(line)
    paths = [path for path in leaves(record) if "evidence" in path and "rows" not in path]
    assert paths
    for path in paths:
        assert fault("chains", json.dumps(without_leaf(record, path))), path
        assert leaf(record, path) is not None


def of_kinds() -> dict[str, dict[str, Any]]:
    every = record_schema()["$defs"]["evidence_of_a_kind"]["anyOf"]
    return {of["properties"]["kind"]["const"]: of for of in every}


def test_every_kind_of_evidence_has_a_schema_with_its_fields() -> None:
    found = of_kinds()
    assert [*found] == sorted(CLASSES)
    for kind, of in found.items():
        assert [*of["properties"]] == ["kind", *(f.name for f in fields(CLASSES[kind]))], kind


@pytest.mark.full
def test_every_kind_occurs_and_every_line_has_a_schema() -> None:
    whole = record_schema()["$defs"]
    lines_of = {f: [x["$ref"].rpartition("/")[2] for x in of["anyOf"]]
                for f, of in whole.items() if f.endswith("_line")}  # fmt: skip
    assert {f"{name.split('-')[0]}_line" for name in names()} == lines_of.keys()
    kinds, seen = set[str](), set[str]()
    for name in names():
        for line in lines(name):
            kinds |= {*kinds_in(json.loads(line))}
        few = [json.loads(line) for line in (*lines(name)[:2], *lines(name)[-9:])]
        for definition in {*lines_of[f"{name.split('-')[0]}_line"]} - seen:
            seen |= {definition} if any(map(validator(definition).is_valid, few)) else set()
    assert kinds - {"vanishing"} == CLASSES.keys() - NOT_SHIPPED  # vanishing: a step of by-parts
    assert seen == {definition for some in lines_of.values() for definition in some}


def properties(schema: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield all properties in a schema, at any depth, with their names."""
    for key, value in schema.items() if isinstance(schema, dict) else enumerate(schema):
        if key == "properties" and isinstance(value, dict):
            yield from value.items()
        if isinstance(value, dict | list):
            yield from properties(value)


def test_every_field_is_explained() -> None:
    own = {name: of for name, of in record_schema()["$defs"].items() if "_line" not in name}
    bare = {
        name
        for name, of in properties(own)
        if not {"description", "const", "$ref"} & of.keys() and name not in ("kind", "terms")
    }
    assert bare == set()
