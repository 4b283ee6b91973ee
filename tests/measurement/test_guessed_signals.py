"""Input and output of a record, from names; and what is asked where names do not tell."""

import numpy as np
import pytest
import scipy.io

from disting.errors import InputError
from disting.measurement import read
from disting.measurement.reading import guessed
from tests.measurement.bench_data import measured_data

TIME = np.arange(6000) / 1000
U = np.cos(2 * np.pi * np.outer(TIME, np.arange(2, 22)) + np.arange(20) ** 2).sum(axis=1)
Y = 0.5 * np.roll(U, 3)


def test_names_tell_input_and_output_of_a_text_file(tmp_path):
    path = tmp_path / "a.csv"
    rows = "\n".join(
        f"{t!r},{u!r},{y!r},0.0"
        for t, u, y in zip(TIME.tolist(), U.tolist(), Y.tolist(), strict=True)
    )
    path.write_text(f"t [s],iq [A],motor angle [rad],iq_ref\n{rows}\n")
    found, told = read(path), read(path, input="iq [A]", output="motor angle [rad]")
    assert (
        found == told
        and np.allclose(found.frequency, np.arange(2, 22))
        and not any("by their names" in n for n in told.notes)
    )
    assert any("input taken as iq [A], output as motor angle [rad]" in note for note in found.notes)
    with pytest.raises(InputError, match=r"give both; there are iq \[A\], iq_ref"):
        read(path, input="iq [A]")


def test_names_tell_input_and_output_of_a_matlab_file(tmp_path):
    path = tmp_path / "a.mat"
    scipy.io.savemat(path, {"torque": U, "position": Y, "fs": 1000.0, "gain": 3.0})
    assert np.allclose(read(path).frequency, np.arange(2, 22))
    scipy.io.savemat(path, {"torque": U, "position": Y, "speed": Y, "fs": 1000.0})
    with pytest.raises(
        InputError,
        match=r"which signal is the input, which the output.*there are fs, position, speed, torque",
    ):
        read(path)


def test_names_of_the_real_axis_do_not_tell():
    with pytest.raises(
        InputError, match="--read output=NAME; there are gtau, kp, kv, qg, qm, t, vir"
    ):
        read(measured_data("EMPS.mat"))


@pytest.mark.parametrize(
    ("names", "found"),
    [
        (["time", "u", "y"], ("u", "y")),
        (["Kraft [N]", "Weg [mm]", "Zeit [s]"], ("Kraft [N]", "Weg [mm]")),
        (["motorCurrent", "loadSpeed", "speed_cmd"], ("motorCurrent", "loadSpeed")),
        (["u1", "u2", "y"], None),
        (["u"], None),
        ([], None),
    ],
)
def test_words(names, found):
    if found:
        assert guessed(names, "a")[:2] == found
    else:
        with pytest.raises(InputError, match="which signal is the input"):
            guessed(names, "a")
