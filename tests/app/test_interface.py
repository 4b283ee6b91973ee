"""Every call has a schema that is one, and a function that is there."""

import pytest
from jsonschema import Draft202012Validator

from disting.app.interface import CALLS, SCHEMAS


@pytest.mark.thin(8)
@pytest.mark.parametrize("name", CALLS)
def test_its_schema_is_one_and_closes_the_request(name):
    schema = CALLS[name].schema
    Draft202012Validator.check_schema(schema)
    assert schema["title"] == f"disting app {name} 1"
    assert schema["properties"]["request"]["additionalProperties"] is False
    assert "answer" in schema["properties"]


def test_no_schema_is_left_over():
    assert {path.stem for path in SCHEMAS.iterdir()} == set(CALLS)


@pytest.mark.full
@pytest.mark.parametrize("name", CALLS)
def test_its_function_is_there(name):
    assert callable(CALLS[name].load())
