"""A value of another type is refused in one sentence, by every public function."""

import inspect

import pytest

import disting
from disting import (
    Experiment,
    InputError,
    Model,
    compare,
    compare_everywhere,
    findings,
    verdict_file as file_of_verdict,
)

WRONG = [3, None, 3.5, object(), [], {}]
FUNCTIONS = [
    name
    for name in dir(disting)
    if not name.startswith("_") and inspect.isfunction(getattr(disting, name))
]


@pytest.mark.thin(8)
@pytest.mark.parametrize("name", FUNCTIONS)
@pytest.mark.parametrize("wrong", WRONG, ids=lambda x: type(x).__name__)
def test_of_every_argument_that_is_needed(name, wrong):
    function = getattr(disting, name)
    needed = [p for p in inspect.signature(function).parameters.values() if p.default is p.empty]
    if not needed or (name, wrong) in [("catalog", 3), ("verdicts", 3), ("verify", {})]:
        return
    by_name = {p.name: wrong for p in needed if p.kind is p.KEYWORD_ONLY}
    with pytest.raises(InputError) as refusal:
        function(*[wrong] * (len(needed) - len(by_name)), **by_name)
    assert "\n" not in str(refusal.value) and "attribute" not in str(refusal.value)


@pytest.mark.thin(8)
@pytest.mark.parametrize("function", [compare, findings, file_of_verdict])
@pytest.mark.parametrize("name", ["query", "engine", "experiments", "quantity", "domain"])
def test_of_what_may_be_left_out(function, name):
    if name in inspect.signature(function).parameters:
        for wrong in (3, "all", object()):
            with pytest.raises(InputError):
                function("3:1", "3:4", **{name: wrong})


def test_of_one_of_several():
    with pytest.raises(InputError, match="list of Experiment"):
        compare("3:1", "3:4", experiments=[Experiment(), (Experiment(), "sensor=2")])
    with pytest.raises(InputError, match="list of texts"):
        compare_everywhere("3:1", "3:4", 3)
    with pytest.raises(InputError, match="a model is a chain"):
        compare("3:1", 3)
    with pytest.raises(InputError, match="a model is a chain"):
        compare(Model.from_transfer_function("a", "s + b"), 1.5)
