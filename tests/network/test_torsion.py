"""Drive trains of openTorsion: against matrices with the gears eliminated as constraints, and bad
input.
"""

import json
from copy import deepcopy

import numpy as np
import pytest

from disting import InputError, compare, read_models
from disting.fit.search.network_plant import NetworkPlant
from disting.general.model_files import models_of
from disting.network.notation.torsion import drive_train


def disk(name, inertia, damping=0):
    return {"name": name, "type": "Disk", "inertia": inertia, "damping": damping}


def shaft(stiffness, damping=0, name="Shaft"):
    return {"name": name, "type": "ShaftDiscrete", "stiffness": stiffness, "damping": damping}


def gear(name, inertia, size, key="teeth", **more):
    return {"name": name, "type": "GearElement", "inertia": inertia, key: size, **more}


def train(force, sensor):
    """A motor, a stage that halves the speed, two loads behind it, one through another stage."""
    return {
        "name": "mill",
        "date": "2025-01-01",
        "components": [
            {"name": "Motor", "elements": [disk("Rotor", 2, 1), shaft(50, 0.5),
                                           gear("Pinion", 0.1, 20)]},
            {"name": "Drive", "elements": [gear("Wheel", 1.5, 40), shaft(80, 0.2), disk("Table", 7)]},
            {"name": "Pump", "elements": [gear("Small", 0.3, 0.5, "radius", damping=0.4),
                                          gear("Big", 0.7, 1.25, "radius", parent="Small"),
                                          shaft(30), disk("Impeller", 3, 2)]},
        ],
        "structure": [["Motor.Pinion", "Drive.Wheel"], ["Drive.Table", "Pump.Small"]],
        "force": force,
        "sensor": sensor,
        "quantity": "position",
    }  # fmt: skip


# coordinates: rotor, pinion, wheel, table = small, big, impeller
INERTIA = np.diag([2, 0.1, 1.5, 7 + 0.3, 0.7, 3])
GROUND = np.diag([1, 0, 0, 0.4, 0, 2.0])
SHAFTS = [(0, 1, 50, 0.5), (2, 3, 80, 0.2), (4, 5, 30, 0)]
# free ones: rotor, pinion, table, impeller; wheel = -20/40 pinion, big = -0.5/1.25 small
FREE = np.array(
    [[1, 0, 0, 0], [0, 1, 0, 0], [0, -0.5, 0, 0], [0, 0, 1, 0], [0, 0, -0.4, 0], [0, 0, 0, 1]]
)
PLACES = {"Motor.Rotor": 0, "Motor.Pinion": 1, "Drive.Wheel": 2, "Drive.Table": 3, "Pump.Big": 4,
          "Pump.Impeller": 5}  # fmt: skip


def truth(force, sensor, omega):
    stiffness, damping = np.zeros((6, 6)), GROUND.copy()
    for a, b, k, c in SHAFTS:
        e = np.eye(6)[a] - np.eye(6)[b]
        stiffness, damping = stiffness + k * np.outer(e, e), damping + c * np.outer(e, e)
    found = []
    for w in omega:
        dynamic = FREE.T @ (-(w**2) * INERTIA + 1j * w * damping + stiffness) @ FREE
        found.append(FREE[PLACES[sensor]] @ np.linalg.solve(dynamic, FREE[PLACES[force]]))
    return np.array(found)


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("force", "sensor"),
    [(f, s) for f in PLACES for s in PLACES if {f, s} not in ({"Motor.Pinion", "Drive.Wheel"},
                                                             {"Drive.Table", "Pump.Big"})],
)  # fmt: skip
def test_the_response_is_that_of_matrices_with_constraints(force, sensor):
    found, omega = drive_train(train(force, sensor), "mill"), np.array([0.3, 2.0, 5.0, 11.0])
    plant = NetworkPlant(found.network, omega)
    response = plant.response(np.array([found.values[p] for p in plant.parameters]))
    np.testing.assert_allclose(response, truth(force, sensor, omega), rtol=1e-9)


def test_a_drive_train_is_a_chain_with_a_gear():
    found = drive_train(train("Motor.Rotor", "Drive.Table"), "mill").network
    assert sorted(map(str, found.elements)) == sorted(
        ["m1 1", "m2 2", "m3 3", "m4 4", "k12 1 2", "d12 1 2", "k23 2 3 *2", "d23 2 3 *2", "b1 1 0",
         "b3 3 0", "k34 3 4 *5/2", "b4 4 0"]
    )  # fmt: skip


@pytest.mark.full
def test_a_file_is_read_alone_and_in_a_list(tmp_path):
    data = train("Motor.Rotor", "Pump.Impeller")
    alone, listed = tmp_path / "mill.json", tmp_path / "list.json"
    alone.write_text(json.dumps(data))
    listed.write_text(json.dumps({"models": [data | {"name": "other"}]}))
    (one,), (other,) = read_models(alone), read_models(listed)
    assert (one.name, other.name) == ("mill", "other") and one.network == other.network
    assert compare(one, other).relation.value == "indistinguishable"


def changed(path, value):
    data = deepcopy(train("Motor.Rotor", "Pump.Impeller"))
    *way, last = path
    inside = data
    for step in way:
        inside = inside[step]
    inside[last] = value
    return data


FIRST = ("components", 0, "elements")


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("data", "said"),
    [
        (
            changed(("force",), "Motor"),
            'give the place of the force as "force": one of Motor.Rotor',
        ),
        (changed(("sensor",), "Motor.Shaft"), "not 'Motor.Shaft'"),
        (changed(("sensor",), None), "Pump.Big, Pump.Impeller$"),
        (changed((*FIRST, 1, "stiffness"), 0), "stiffness of Motor.Shaft is a positive number"),
        (changed((*FIRST, 1, "stiffness"), "soft"), "not 'soft'"),
        (changed((*FIRST, 1, "stiffness"), "1e-999999999"), "not '1e-999999999'"),
        (changed((*FIRST, 1, "inertia"), 1), "Motor.Shaft has an inertia: add half of it"),
        (changed((*FIRST, 0, "inertia"), -1), "inertia of Motor.Rotor is a number, zero or"),
        (changed((*FIRST, 1, "type"), "ShaftContinuous"), "Motor.Shaft has its inertia along"),
        (changed((*FIRST, 1, "type"), "Belt"), "Motor.Shaft is of type 'Belt'"),
        (changed((*FIRST, 2, "teeth"), 0), "teeth of Motor.Pinion is a positive number"),
        (changed((*FIRST, 2), {"name": "Pinion", "type": "GearElement"}), "give its teeth or dia"),
        (changed((*FIRST, 1, "name"), "Rotor"), "Motor.Rotor is the name of two elements"),
        (changed(("structure", 0), ["Motor.Pinion"]), "a connection is a pair such as"),
        (changed(("structure", 0), ["Motor.Pinion", "Gone.Disk"]), "'Gone.Disk' is not an element"),
        (changed(("structure",), []), "no way from a force to a sensor"),
        (changed(("components",), {}), '"components" is a list'),
        (train("Motor.Pinion", "Drive.Wheel"), "at two gears that mesh"),
    ],
)
def test_bad_input(data, said):
    with pytest.raises(InputError, match=said):
        models_of({"models": [data]})


def test_gears_in_a_ring_do_not_turn():
    data = train("Motor.Rotor", "Pump.Impeller")
    data["components"][1]["elements"].append(gear("Idler", 1, 10))
    data["structure"].append(["Drive.Idler", "Motor.Pinion"])
    with pytest.raises(InputError, match="ring"):
        models_of({"models": [data]})
