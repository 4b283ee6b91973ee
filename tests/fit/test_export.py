"""Exports mean the same response in other programs, and read back."""

import json
import sys

import numpy as np
import pytest

from disting.errors import InputError
from disting.export import (
    NumberedStructure,
    control_script,
    model_from_dict,
    predict,
    read_model,
    state_space,
    to_control,
    to_control_transfer_function,
    write_mat,
    zero_pole,
)
from disting.fit.judge.modes import oscillations, poles, zeros
from disting.fit.select import select
from disting.model.chain import Chain
from disting.report.fit.selection_json import candidate_to_dict
from tests.fit.drives import CHAINS, OMEGA, response, truth


@pytest.mark.thin(8)
@pytest.mark.parametrize("chain", CHAINS, ids=str)
@pytest.mark.parametrize("sign", [1, -1])
def test_the_state_space_has_the_response(chain, sign):
    values = truth(chain, 3)
    ss, expected = state_space(chain, values, sign), predict(chain, values, OMEGA[::10], sign)
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
    expected = predict(chain, values, OMEGA[::10])
    np.testing.assert_allclose(
        to_control(chain, values)(1j * OMEGA[::10]) * delay, expected, rtol=1e-7
    )
    np.testing.assert_allclose(
        to_control_transfer_function(chain, values)(1j * OMEGA[::10]) * delay, expected, rtol=1e-6
    )


def left():
    """Two structures with numbers."""
    return [
        NumberedStructure(
            f"model {k}", chain, truth(chain, k), dict.fromkeys(chain.parameters, "kg")
        )
        for k, chain in enumerate(CHAINS[2:4])
    ]


@pytest.mark.thin(8)
@pytest.mark.parametrize("chain", CHAINS, ids=str)
@pytest.mark.parametrize("sign", [1, -1])
def test_zeros_poles_and_gain_have_the_response(chain, sign):
    values = truth(chain, 3)
    found = zero_pole(chain, values, sign)
    s = 1j * OMEGA[::10]
    seen = found.gain * np.prod(s[:, None] - found.zeros, axis=1)
    seen = seen / np.prod(s[:, None] - found.poles, axis=1) * np.exp(-s * values.get("Td", 0.0))
    np.testing.assert_allclose(seen, predict(chain, values, OMEGA[::10], sign), rtol=1e-6)


def test_matlab_reads_every_model(tmp_path):
    from scipy.io import loadmat

    write_mat(tmp_path / "model.mat", left())
    seen = loadmat(tmp_path / "model.mat", simplify_cells=True)
    first = state_space(CHAINS[2], truth(CHAINS[2], 0))
    for name in "ABCD":
        np.testing.assert_array_equal(np.atleast_2d(seen[name]).reshape(getattr(first, name).shape),
                                      getattr(first, name))  # fmt: skip
    assert seen["delay"] == first.delay and len(seen["models"]) == 2
    for model, struct in zip(left(), seen["models"], strict=True):
        zpk = zero_pole(model.chain, model.values)
        assert struct["name"] == model.name and struct["parameters"] == model.values
        assert struct["units"] == model.units and struct["k"] == zpk.gain
        np.testing.assert_array_equal(np.ravel(struct["p"]), zpk.poles)


def test_without_python_control_the_remedy_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(InputError, match=r'pip install "disting.control.'):
        to_control(Chain(1, damped=False), {"m1": 1.0})


def test_the_script_says_what_the_data_do_not_determine():
    chain = Chain(1, damped=False)
    drive = NumberedStructure("1:1", chain, {"m1": 2.0}, {"m1": "kg"}, undetermined=("m1",))
    assert "# m1 = 2 kg; not determined by the data: m1\n" in control_script([drive])


def test_the_script_makes_every_model_in_python_control():
    pytest.importorskip("control", reason="python-control is not installed")
    names = {}
    exec(compile(control_script(left()), "models.py", "exec"), names)
    for model in left():
        delay = np.exp(-1j * OMEGA[::10] * names["dead_times"][model.name])
        np.testing.assert_allclose(
            names["models"][model.name](1j * OMEGA[::10]) * delay,
            predict(model.chain, model.values, OMEGA[::10]),
            rtol=1e-7,
        )


@pytest.mark.full
@pytest.mark.parametrize(
    "chain", [CHAINS[1], pytest.param(CHAINS[2], marks=pytest.mark.slow)], ids=str
)
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
        ('{"selected": {"n_masses": 2}}', "not a fitted model"),
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
        oscillations(roots(Chain(2, damped=False).structure, p)) for roots in (poles, zeros)
    )
    assert resonance == pytest.approx(30j) and antiresonance == pytest.approx(np.sqrt(600) * 1j)
    free = Chain(3, damped=True)
    for seed in range(20):
        values = np.array(list(truth(free, seed).values()))
        assert len(oscillations(poles(free.structure, values))) <= 2
