"""`select(.., quantity=..)`: what the data show is stated beside them."""

import numpy as np

from disting import Chain
from disting.fit import predict, select
from disting.measurement import read
from disting.measurement.assumptions import assumed_quantity

OMEGA = 2 * np.pi * np.geomspace(1, 50, 40)
DRIVE, VALUES = Chain(1, quantity="velocity", ground_dampers=(1,)), {"m1": 0.1, "b1": 2.0}


def test_data_and_candidates_follow_the_stated_quantity(tmp_path):
    path = tmp_path / "a.csv"
    G = predict(DRIVE, VALUES, OMEGA)
    rows = (f"{f / 2 / np.pi},{z.real},{z.imag}" for f, z in zip(OMEGA, G, strict=True))
    path.write_text("\n".join(["f [Hz],re,im", *rows]))
    assumed = read(path)
    assert assumed.quantity == "acceleration" and assumed_quantity(assumed)
    found = select(assumed, [Chain(1, ground_dampers=(1,))], quantity="velocity")
    assert found.question == "" and found.selected.chain == DRIVE
    assert np.isclose(found.selected.estimate.parameters["m1"], 0.1)
