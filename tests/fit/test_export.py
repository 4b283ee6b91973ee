"""Exports mean the same response in other programs, and read back."""

import json

import numpy as np
import pytest

from disting.errors import InputError
from disting.fit.export import (
    predicted,
    state_space,
    to_control,
    to_control_transfer_function,
    write_mat,
)
from disting.fit.modes import oscillating, poles, zeros
from disting.fit.select import select
from disting.fit.selection_json import candidate_to_dict, model_from_dict, read_model
from disting.model.chain import Chain
from tests.fit.drives import CHAINS, OMEGA, response, truth


@pytest.mark.parametrize("chain", CHAINS, ids=str)
@pytest.mark.parametrize("sign", [1, -1])
def test_the_state_space_has_the_response(chain, sign):
    values = truth(chain, 3)
    ss, expected = state_space(chain, values, sign), predicted(chain, values, OMEGA[::10], sign)
    one = np.eye(len(ss.A))
    seen = [
        (ss.C @ np.linalg.solve(1j * w * one - ss.A, ss.B) + ss.D)[0, 0]
        * np.exp(-1j * w * ss.delay)
        for w in OMEGA[::10]
    ]
    np.testing.assert_allclose(seen, expected, rtol=1e-8)
    assert ss.delay == values.get("Td", 0.0) and len(ss.A) == chain.structure.n_states


@pytest.mark.parametrize("chain", CHAINS, ids=str)
def test_python_control_sees_the_same(chain):
    pytest.importorskip("control", reason="python-control is not installed")
    values = truth(chain, 4)
    delay = np.exp(-1j * OMEGA[::10] * values.get("Td", 0.0))
    expected = predicted(chain, values, OMEGA[::10])
    np.testing.assert_allclose(
        to_control(chain, values)(1j * OMEGA[::10]) * delay, expected, rtol=1e-7
    )
    np.testing.assert_allclose(
        to_control_transfer_function(chain, values)(1j * OMEGA[::10]) * delay, expected, rtol=1e-6
    )


def test_matlab_reads_the_matrices(tmp_path):
    from scipy.io import loadmat

    chain, values = CHAINS[2], truth(CHAINS[2], 5)
    write_mat(tmp_path / "model.mat", chain, values)
    seen, ss = loadmat(tmp_path / "model.mat"), state_space(chain, values)
    for name in "ABCD":
        np.testing.assert_array_equal(seen[name], getattr(ss, name))
    assert seen["delay"] == values["Td"]


@pytest.mark.parametrize("chain", CHAINS[:4], ids=str)
def test_json_reads_back_bit_equal(chain, tmp_path):
    data = response(chain, truth(chain, 6), noise=0.01)
    (found,) = select(data, [chain], test=data).candidates
    plain = json.dumps({"selected": candidate_to_dict(found)})
    (tmp_path / "fit.json").write_text(plain)
    assert read_model(tmp_path / "fit.json") == (chain, found.estimate.parameters)
    assert model_from_dict(json.loads(plain)["selected"]) == (chain, found.estimate.parameters)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "holds no JSON; name a file of .disting fit --json."),
        ("[]", "holds no selected model"),
        ('{"selected": null}', "holds no selected model"),
        ('{"selected": {"n_masses": 2}}', "no fitted model"),
        (None, "cannot be read .*; name a file of .disting fit --json."),
    ],
)
def test_what_is_no_model_is_refused(text, message, tmp_path):
    path = tmp_path / "fit.json"
    if text is not None:
        path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_model(path)


def test_poles_and_zeros_of_a_two_mass_drive_by_hand():
    """Free: poles 0, 0, +-sqrt(k/mu); zeros +-sqrt(k/m2); the rigid-body motion is no
    oscillation.
    """
    p = np.array([2.0, 1.0, 600.0])
    (resonance,), (antiresonance,) = (
        oscillating(roots(Chain(2, damped=False).structure, p)) for roots in (poles, zeros)
    )
    assert resonance == pytest.approx(30j) and antiresonance == pytest.approx(np.sqrt(600) * 1j)
    free = Chain(3, damped=True)
    for seed in range(20):
        values = np.array(list(truth(free, seed).values()))
        assert len(oscillating(poles(free.structure, values))) <= 2
