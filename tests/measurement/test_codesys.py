"""Traces of CODESYS as text: each variable has its own times, in the unit that `Flags` tells."""

import numpy as np
import pytest

from disting import InputError
from disting.measurement import read, read_time_series
from tests.cli.process import called

COUNT, PERIOD = 400, 1000  # samples of a task of 1 ms, in microseconds
CYCLES = np.arange(COUNT)
TORQUE = np.random.default_rng(4).normal(size=COUNT)
ANGLE = np.cumsum(np.cumsum(TORQUE))
JITTER = np.random.default_rng(5).integers(-40, 40, COUNT)
TIMES = 291 + PERIOD * CYCLES + JITTER


def trace(path, variables, flags="32", end="\r\n"):
    """A file of variables by name, each with its times and values."""
    head = [f"Flags; {flags}"] if flags else []
    lines = ["[key]; [value]", "IecTaskName; MainTask", "EveryNCycles; 1", *head]
    for i, (name, (times, values)) in enumerate(variables.items()):
        lines += [f"{i}.Variable; {name}", f"{i}.Class; 7", f"{i}.Data; "]
        lines += [f"; {t}; {v}" for t, v in zip(times, values, strict=True)]
    path.write_text(end.join([*lines, ""]), encoding="utf-8-sig", newline="")
    return path


def both(times=TIMES, other=None):
    other = times if other is None else other
    return {"PLC_PRG.lrTorque": (times, TORQUE), "PLC_PRG.lrAngle": (other, ANGLE)}


@pytest.mark.parametrize(("flags", "unit"), [("32", 1e-6), ("16", 1e-3), ("36", 1e-6)])
def test_samples_and_rate(tmp_path, flags, unit):
    path = trace(tmp_path / "a.trace.csv", both(), flags)
    found = read_time_series(path, "PLC_PRG.lrTorque", "plc_prg.lrangle")
    np.testing.assert_array_equal(found.u, TORQUE)
    np.testing.assert_array_equal(found.y, ANGLE)
    assert found.sampling_rate == pytest.approx(1 / (PERIOD * unit), rel=1e-3)
    assert "times of the cycles vary by" in found.left_out


@pytest.mark.parametrize("flags", ["", "0", "48", "x"])
def test_an_unknown_unit_of_time_is_asked_for(tmp_path, flags):
    path = trace(tmp_path / "a.csv", both(), flags)
    with pytest.raises(
        InputError, match=r"not a known unit of time.* give --read sampling_rate=HZ"
    ):
        read_time_series(path, "PLC_PRG.lrTorque", "PLC_PRG.lrAngle")
    found = read_time_series(path, "PLC_PRG.lrTorque", "PLC_PRG.lrAngle", sampling_rate=500)
    assert found.sampling_rate == 500 and len(found) == COUNT


def test_what_all_variables_have_is_read_and_words_are_left_out(tmp_path):
    truth = ["TRUE" if k % 3 else "FALSE" for k in range(COUNT - 3)]
    variables = both() | {
        "PLC_PRG.xEnable": (TIMES[1:-2], truth),
        "PLC_PRG.sState": (TIMES, ["run"] * COUNT),
    }
    path = trace(tmp_path / "a.csv", variables)
    found = read_time_series(path, "PLC_PRG.lrTorque", "PLC_PRG.xEnable")
    np.testing.assert_array_equal(found.u, TORQUE[1:-2])
    np.testing.assert_array_equal(found.y, [value == "TRUE" for value in truth])
    assert "left out: PLC_PRG.sState ('run'), no numbers" in found.left_out


@pytest.mark.full
def test_input_and_output_are_known_by_their_names(tmp_path):
    times = 10 * np.arange(4096)
    u = np.random.default_rng(1).normal(size=4096)
    variables = {"PLC_PRG.lrTorque": (times, u), "PLC_PRG.lrSpeed": (times, np.cumsum(u))}
    path = trace(tmp_path / "a.csv", variables)
    found = read(path, segment=512)
    assert "input PLC_PRG.lrTorque, output PLC_PRG.lrSpeed" in found.reading
    done = called("fit", path, "--read", "segment=512", "--quantity", "speed", "--masses", "1")
    assert "input PLC_PRG.lrTorque" in done.stdout and "Traceback" not in done.stderr


def test_the_table_that_codesys_saves_as_text(tmp_path):
    """A line of the program, one of the project, names with the time first, blanks between."""
    rows = [f"{k} {TORQUE[k]:.6f} {ANGLE[k]:.6f}" for k in range(COUNT)]
    head = ["Editor V3.5 Trace: Trace", "C:\\Sample.project"]
    names = "Zeitstempel(ms) PLC_PRG.lrTorque PLC_PRG.lrAngle"
    path = tmp_path / "a.txt"
    path.write_text("\n".join([*head, names, *rows]))
    found = read_time_series(path, "PLC_PRG.lrTorque", "PLC_PRG.lrAngle")
    assert found.sampling_rate == pytest.approx(1000) and len(found) == COUNT


GAP = PERIOD * np.delete(np.arange(COUNT + 5), range(50, 55))


@pytest.mark.parametrize(
    ("variables", "words"),
    [
        (both(other=TIMES + 500), "lrAngle was sampled at other times than PLC_PRG.lrTorque"),
        (both(other=TIMES[::-1]), "was sampled at other times"),
        (both(GAP), "missing or doubled behind the time 49000"),
        (both(TIMES // 2000), "a resolution of microseconds"),
        (both(["x"] * COUNT), "line 8: 'x' is not a time"),
        ({"PLC_PRG.sState": (TIMES, ["run"] * COUNT)}, "no variable with numbers"),
        ({}, "no variable with numbers"),
        ({"a": ([1], [1]), "b": ([1], [2])}, "has one sample"),
    ],
    ids=["shifted", "backwards", "gap", "coarse", "words", "text", "empty", "one"],
)
def test_what_is_no_record_is_refused_with_the_remedy(tmp_path, variables, words):
    with pytest.raises(InputError, match=words):
        read_time_series(trace(tmp_path / "a.csv", variables), 2, 3)
