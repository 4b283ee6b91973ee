"""Input and output of a record, from names; and what is asked where names do not tell."""

import numpy as np
import pytest
import scipy.io

from disting.errors import InputError
from disting.measurement import read, read_time_series
from disting.measurement.files import guess
from tests.measurement.bench_data import measured_data

TIME = np.arange(6000) / 1000
U = np.cos(2 * np.pi * np.outer(TIME, np.arange(2, 22)) + np.arange(20) ** 2).sum(axis=1)
Y = 0.5 * np.roll(U, 3)


@pytest.mark.full
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
    with pytest.raises(InputError, match=r"give both; the signals are iq \[A\], iq_ref"):
        read(path, input="iq [A]")


def test_names_tell_input_and_output_of_a_matlab_file(tmp_path):
    path = tmp_path / "a.mat"
    scipy.io.savemat(path, {"torque": U, "position": Y, "fs": 1000.0, "gain": 3.0})
    assert np.allclose(read(path).frequency, np.arange(2, 22))
    scipy.io.savemat(path, {"torque": U, "position": Y, "speed": Y, "fs": 1000.0})
    with pytest.raises(
        InputError,
        match=r"which signal is the input, which the output.*the signals are fs, position, speed, torque",
    ):
        read(path)


def test_names_of_the_real_axis_do_not_tell():
    with pytest.raises(
        InputError, match="--read output=NAME; the signals are gtau, kp, kv, qg, qm, t, vir"
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
        assert guess(names, "a")[:2] == found
    else:
        with pytest.raises(InputError, match="which signal is the input"):
            guess(names, "a")


def test_an_export_without_sample_times_is_refused(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("Name;bench\n\nName;iq;speed\nSampleTime[ms];x;\n\n1;2;3\n")
    with pytest.raises(InputError, match=r"no channel .* has a SampleTime\[ms\]"):
        read(path)


def scope_export(mark, decimal, own_times):
    """What TwinCAT Scope exports of a current and a speed sampled each 1 ms and a torque sampled
    each 0.2 ms, which has more samples.
    """
    fast = ["Name", "torque"], ["SampleTime[ms]", "0.2"], ["Unit", "N m (Torque)"]
    slow = ["Name", "iq"], ["SampleTime[ms]", "1"], ["Unit", "A (Current)"]
    speed = ["motorSpeed"], ["1"], ["(None)"]
    if own_times:
        speed = ["Name", "motorSpeed"], ["SampleTime[ms]", "1"], ["Unit", "(None)"]
    head = [[*a, *b, *c] for a, b, c in zip(fast, slow, speed, strict=True)]
    head[1:1] = [["SymbolComment" if c == "Name" else "" for c in head[0]]]
    lines = ["Name", "bench"], ["File", "bench.csv"], ["Starttime of export", "132959733843760000"]
    rows = []
    for k in range(5 * len(TIME)):
        cells = [repr(0.2 * k), "1"]
        if k < len(TIME):
            cells += [repr(float(k)), repr(float(U[k]))]
            cells += [repr(float(k))] * own_times + [repr(float(Y[k]))]
        rows.append(cells)
    whole = [*lines, [""], *head, [""], *rows, ["EOF"]]
    point = [mark.join(c.replace(".", decimal) for c in row) for row in whole]
    return "\r\n".join(point) + "\r\n"


@pytest.mark.full
@pytest.mark.parametrize(
    ("mark", "decimal", "own"), [("\t", ",", False), (";", ".", True), (",", ".", False)]
)
def test_an_export_of_twincat_scope(tmp_path, mark, decimal, own):
    path = tmp_path / "a.csv"
    path.write_text(scope_export(mark, decimal, own))
    series = read_time_series(path, "iq [A]", "motorSpeed")
    assert series.sampling_rate == pytest.approx(1000.0) and series.input == ("iq", "A")
    assert np.array_equal(series.u, U) and np.array_equal(series.y, Y)
    found = read(path)
    assert np.allclose(found.frequency, np.arange(2, 22))
    left_out = f"left out: torque [N m] (each 0{decimal}2 ms), not each 1 ms"
    assert found.reading.endswith(f"; {left_out}")
    with pytest.raises(InputError, match=r"no columns are called 'torque'.*left out: torque"):
        read_time_series(path, "torque", "motorSpeed")
    path.write_text(
        path.read_text().replace(f"{mark}3{decimal}0{mark}", f"{mark}3{decimal}0{mark}x", 1)
    )
    with pytest.raises(InputError, match=r"line 13, column .*is not a number"):
        read(path)


def trace(first="", lost="0", frames=1):
    """What a Sinumerik control writes: a record leaves out what has not changed."""
    rows, known = list[str](), {}
    for n, (u, y) in enumerate(zip(U, Y, strict=True)):
        now = {"f1": repr(float(u)), "f2": repr(float(y)), "f3": "7"}
        said = " ".join(f'{k}="{v}"' for k, v in now.items() if known.get(k) != v)
        rows.append(f'<rec time="{first if first and n == 5 else n / 1000}" {said} />')
        known = now
    signals = "".join(
        f'<dataSignal id="{k}" key="{k}" name="{name}" unitsType="x" interval="{step}" />'
        for k, name, step in (
            ("f1", "iq", 0.001),
            ("f2", "motorSpeed", 0.001),
            ("f3", "load", 0.004),
        )
    )
    frame = f'<dataFrame><frameHeader dropOuts="{lost}" />{signals}{"".join(rows)}</dataFrame>'
    head = '<?xml version="1.0" encoding="utf-8"?>\n<traceSession version="2">'
    return f"{head}<traceData dataFrames='{frames}'>{frames * frame}</traceData></traceSession>"


@pytest.mark.full
def test_a_trace_of_sinumerik(tmp_path):
    path = tmp_path / "a.xml"
    path.write_text(trace())
    series = read_time_series(path, "iq", "motorSpeed")
    assert series.sampling_rate == pytest.approx(1000.0)
    assert np.array_equal(series.u, U) and np.array_equal(series.y, Y)
    found = read(path, input="iq", output="motorSpeed")
    assert np.allclose(found.frequency, np.arange(2, 22))
    assert found.reading.endswith("; left out: load (each 0.004 s), not each 0.001 s")
    for text, said in (
        (trace()[:-40], "not complete XML"),
        (trace(frames=2), "a trace of 2 frames; export one"),
        (trace(lost="3"), r"samples of this trace are lost \(3\)"),
        (trace(first="x"), "record 6, time: 'x' is not a number"),
        (trace().replace('f1="', 'f9="'), "record 1 of this trace has no value of f1"),
        (trace().replace("<dataSignal", "<signal"), "no signals or no records"),
    ):
        path.write_text(text)
        with pytest.raises(InputError, match=said):
            read(path)


def lvm(columns, decimal, steps=("1.0E-3", "1.0E-3")):
    """What LabVIEW writes of two channels, with a column of times for each or with none."""
    times = columns == "Multi"

    def beside(first, *cells):
        """Cells of the channels, between them those of the second column of times."""
        return [first, *([cells[0], "", cells[1]] if times else cells), ""]

    head = [
        ["LabVIEW Measurement", ""], ["Separator", "Tab"], ["X_Columns", columns],
        ["Time", "09:54:07,284627"], ["***End_of_Header***", ""], ["", ""],
        beside("Channels", "2", ""), beside("Samples", "6000", "6000"),
        beside("Y_Unit_Label", "A", ""), beside("X_Dimension", "Time", "Time"),
        beside("X0", "0.0E+0", "0.0E+0"), beside("Delta_X", *steps), ["***End_of_Header***", ""],
        ["X_Value", "iq", *(["X_Value"] * times), "motorSpeed", "Comment"],
    ]  # fmt: skip
    rows = [
        [t, u, t, y] if times else ["", u, y]
        for t, u, y in zip(*([repr(float(x)) for x in a] for a in (TIME, U, Y)), strict=True)
    ]
    return "\n".join(
        "\t".join(c.replace(".", decimal) for c in row) for row in [*head, *rows, [""]]
    )


@pytest.mark.full
@pytest.mark.parametrize(("columns", "decimal"), [("No", ","), ("Multi", ".")])
def test_a_record_of_labview(tmp_path, columns, decimal):
    path = tmp_path / "a.lvm"
    path.write_text(lvm(columns, decimal))
    series = read_time_series(path, "iq [A]", "motorSpeed")
    assert series.sampling_rate == pytest.approx(1000.0) and series.input == ("iq", "A")
    assert np.array_equal(series.u, U) and np.array_equal(series.y, Y)
    assert np.allclose(read(path).frequency, np.arange(2, 22))
    path.write_text(lvm(columns, decimal, ("1.0E-3", "2.0E-3")))
    with pytest.raises(InputError, match="no common Delta_X"):
        read(path)
    path.write_text(lvm(columns, decimal) + lvm(columns, decimal))
    with pytest.raises(InputError, match="an LVM file of 3 records; export one"):
        read(path)
