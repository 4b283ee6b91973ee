"""Names of earlier versions: accepted for one version, with a warning that points at the caller."""

import json

import numpy as np
import pytest

import disting
from disting import Chain, Family, InputError, compare, read_models, verdict_file, verify
from disting.fit import select
from disting.measurement import FrequencyResponse, TimeSeries, csv_text, from_arrays, read

OMEGA = np.arange(1.0, 21.0)
MAKE = {
    "Chain": lambda **quantity: Chain(2, **quantity),
    "Family": lambda **quantity: Family(2, **quantity),
    "FrequencyResponse": lambda **quantity: FrequencyResponse(OMEGA, OMEGA + 1j, **quantity),
    "TimeSeries": lambda **quantity: TimeSeries(OMEGA, OMEGA**2, 10.0, **quantity),
}


@pytest.mark.parametrize("name", MAKE)
def test_what_a_sensor_shows_is_a_quantity(name):
    new = MAKE[name](quantity="velocity")
    with pytest.warns(DeprecationWarning, match=f"{name}: the argument sensor is now") as told:
        old = MAKE[name](sensor="velocity")
    assert old == new and told[0].filename == __file__
    with pytest.warns(DeprecationWarning, match=f"{name}: the attribute sensor is now") as told:
        assert old.sensor is new.quantity
    assert told[0].filename == __file__
    with pytest.raises(InputError, match=f"{name}: sensor is the old name of quantity"):
        MAKE[name](sensor="velocity", quantity="velocity")


def test_the_class_of_quantities_is_found_by_its_old_name():
    with pytest.warns(
        DeprecationWarning, match=r"disting\.Sensor is now disting\.Quantity"
    ) as told:
        assert disting.Sensor is disting.Quantity
    assert told[0].filename == __file__ and "Sensor" not in dir(disting)


def test_seeds_and_files_do_not_change_with_the_name():
    """A verdict file of version 0.3 calls the quantity of a chain sensor, and so do keys."""
    data = verdict_file("2:1", "2:2", quantity="velocity")
    assert (
        data["models"][0]["sensor"] == "velocity"
        and verify(json.loads(json.dumps(data))).status == "holds"
    )
    assert "sensor=<Sensor.VELOCITY: 'velocity'>" in disting.algebra.certainty.full_text(
        Chain(2, quantity="velocity")
    )


def test_files_say_quantity_and_those_of_version_0_3_are_read(tmp_path):
    measured = from_arrays(OMEGA, OMEGA + 1j, quantity="velocity")
    text = csv_text(measured)
    assert "\n# quantity: velocity\n" in text
    for number, written in enumerate((text, text.replace("# quantity", "# sensor"))):
        path = tmp_path / f"{number}.csv"
        path.write_text(written, encoding="utf-8")
        assert read(path) == measured
    path = tmp_path / "models.json"
    for name in ("quantity", "sensor"):
        models = [{"name": "one", "chain": "2:1", name: "velocity"}]
        path.write_text(json.dumps({"format": "disting models 1", "models": models}))
        assert (
            compare(read_models(path)["one"], Chain(2, quantity="velocity")).relation
            == "indistinguishable"
        )
    models[0]["quantity"] = "velocity"
    path.write_text(json.dumps({"format": "disting models 1", "models": models}))
    with pytest.raises(InputError, match="old name"):
        read_models(path)


@pytest.mark.full
def test_select_takes_keywords_of_before():
    """Values too: what was a function of the lines is among the weights."""
    chain = Chain(1, damped=False)
    data = FrequencyResponse(OMEGA, chain.frequency_response({"m1": 2.0}, OMEGA))

    def ones(response):
        return np.ones(len(response))

    for old, new in (
        ({"lines": ones, "fixed": {"m1": 2.0}}, {"weights": ones, "fix": {"m1": 2.0}}),
        ({"alike": True, "most_lines": 18}, {"weights": "none", "lines": 18}),
        ({"weights": (1.0, 2.0), "method": "starts"}, {"case_weights": (1.0, 2.0)}),
    ):
        with pytest.warns(DeprecationWarning, match="select: the argument .* is now") as told:
            before = select(data, [chain], **old)
        assert {warning.filename for warning in told} == {__file__} and len(told) == 2
        now = select(data, [chain], **new)
        assert before.described.estimate.parameters == now.described.estimate.parameters
        assert len(before.task.cost.measured) == new.get("lines", len(OMEGA))
    with pytest.raises(InputError, match="select: fixed is the old name of fix"):
        select(data, [chain], fix={"m1": 2.0}, fixed={"m1": 2.0})
