"""What `look` shows is what the readers did with the numbers, and nothing that can be shown is
refused.
"""

import json
from math import pi

import numpy as np
import pytest
from hypothesis import given, strategies as st
from jsonschema import Draft202012Validator

from disting.errors import InputError
from disting.files import Format, schema
from disting.measurement import in_si, look, read
from disting.measurement.column_words import Role, Why
from disting.measurement.excitation import Excitation, excitation, moving_share
from disting.measurement.look_text import look_lines, short_lines
from disting.statistics.scatter import scatter
from tests.measurement.bench_data import DATA, measured_data

RATE, PERIOD = 1000.0, 1000
CASES = DATA.parent / "cases"


def write(path, header, rows):
    lines = [] if header is None else [header]
    path.write_text("\n".join([*lines, *(",".join(map(repr, row)) for row in rows), ""]))
    return path


def bode_rows(count=20):
    """Frequency, gain and phase: 1, 10 + k, -10 k."""
    return [(float(k + 1), 10.0 + k, -10.0 * k) for k in range(count)]


def seen_columns(seen):
    return [(c.role.value, c.unit, c.why, c.unit_why) for c in seen.columns]


def test_roles_and_units_are_those_of_words_in_the_header(tmp_path):
    seen = look(write(tmp_path / "a.csv", "f [Hz],mag [dB],phase [deg]", bode_rows()))
    assert seen_columns(seen) == [
        ("frequency", "Hz", Why.WORD, Why.UNIT),
        ("gain", "dB", Why.WORD, Why.UNIT),
        ("phase", "deg", Why.WORD, Why.UNIT),
    ]
    assert [seen.quantity_of(c) for c in seen.columns] == ["", "acceleration", ""]
    assert seen.reason(seen.columns[1]) == "header word; quantity assumed"
    assert [c.values for c in seen.columns] == [(1, 2, 3), (10, 11, 12), (0, -10, -20)]
    assert [str(a) for a in seen.assumed] == [
        "quantity acceleration; if not, give --quantity position or --quantity velocity"
    ]


def test_a_header_that_is_a_unit_alone_is_understood_by_its_unit(tmp_path):
    seen = look(write(tmp_path / "a.csv", "Hz,dB,deg", bode_rows()))
    assert [c.why for c in seen.columns] == [Why.UNIT] * 3


def test_what_no_header_states_is_assumed_with_the_option_that_states_it(tmp_path):
    seen = look(write(tmp_path / "a.csv", "frequency,magnitude,phase", bode_rows()))
    assert [(a.what, a.option) for a in seen.assumed] == [
        ("quantity acceleration", "--quantity position or --quantity velocity"),
        ("frequency in Hz", "--unit frequency=rad/s"),
        ("gain linear", "--unit magnitude=dB"),
        ("phase in deg, from its values", "--unit phase=rad"),
    ]
    assert "unit assumed" in seen.reason(seen.columns[0])


def test_options_are_no_assumptions(tmp_path):
    path = write(tmp_path / "a.csv", "frequency,magnitude,phase", bode_rows())
    options = {"frequency_unit": "rad/s", "phase_unit": "deg", "magnitude_unit": "dB"}
    seen = look(path, quantity="velocity", **options)
    assert [(c.unit, c.unit_why) for c in seen.columns] == [
        ("rad/s", Why.OPTION),
        ("dB", Why.OPTION),
        ("deg", Why.OPTION),
    ]
    assert seen.assumed == () and seen.quantity.value == "velocity"
    named = look(path, quantity="velocity", columns=["Hz", "dB", "deg"])
    assert {c.why for c in named.columns} == {Why.OPTION} and named.assumed == ()


def test_columns_without_a_header_are_assumed(tmp_path):
    seen = look(write(tmp_path / "a.csv", None, bode_rows()))
    assert {c.why for c in seen.columns} == {Why.ASSUMED}
    assert seen.assumed[1].what == "columns frequency, real part, imaginary part, in this order"


@pytest.mark.full
@given(
    frequency=st.sampled_from(["Hz", "kHz", "rad/s"]),
    level=st.sampled_from(["1", "%", "dB"]),
    phase=st.sampled_from(["deg", "rad", "gon"]),
    by_option=st.booleans(),
    is_bare=st.booleans(),
)
def test_the_units_that_are_shown_make_the_response_out_of_the_numbers(
    tmp_path_factory, frequency, level, phase, by_option, is_bare
):
    """The oracle knows the numbers of the file and the units of the table, nothing else."""
    rows = [(7.3 + 1.7 * k, 12.0 + k, -0.07 * k) for k in range(20)]
    named = f"f [{frequency}],mag [{level}],phase [{phase}]"
    header = "f,mag,phase" if by_option or is_bare else named
    options = {"frequency_unit": frequency, "magnitude_unit": level, "phase_unit": phase}
    path = write(tmp_path_factory.mktemp("units") / "a.csv", header, rows)
    seen = look(path, **(options if by_option else {}))
    if by_option or not is_bare:
        assert [c.unit for c in seen.columns] == [frequency, level, phase]
    hertz, size, angle = np.array(rows).T
    units = [c.unit for c in seen.columns]
    omega = hertz * {"Hz": 2 * pi, "kHz": 2000 * pi, "rad/s": 1.0}[units[0]]
    gain = {"1": size, "%": size / 100, "dB": 10 ** (size / 20)}[units[1]]
    turn = {"deg": pi / 180, "rad": 1.0, "gon": pi / 200}[units[2]]
    np.testing.assert_allclose(seen.response.omega, omega, rtol=1e-12)
    np.testing.assert_allclose(seen.response.G, gain * np.exp(1j * turn * angle), rtol=1e-12)


def test_the_response_is_that_of_read(tmp_path):
    path = write(tmp_path / "a.csv", "f [Hz],mag [dB],phase [deg]", bode_rows())
    assert look(path).response == read(path)
    turned = look(path, changes=[lambda r: r.sign_reversed()])
    assert turned.response == read(path).sign_reversed()


def test_columns_of_another_response_are_not_used_and_named(tmp_path):
    rows = [(f, g, p, g, p) for f, g, p in bode_rows()]
    seen = look(write(tmp_path / "a.csv", "f [Hz],Re a,Im a,Re b,Im b", rows))
    assert [c.is_used for c in seen.columns] == [True, True, True, False, False]
    assert seen.columns[3].why is Why.ELSEWHERE
    assert "other responses: column 4 (Re b); --column 4 reads this one" in repr(seen)
    other = look(tmp_path / "a.csv", column=4)
    assert [c.is_used for c in other.columns] == [True, False, False, True, True]


REFUSED = {
    "a unit that is unknown": ("f [Hz],mag [furlong],phase [deg]", bode_rows(), "'furlong'"),
    "too few lines": ("f [Hz],Re,Im", bode_rows(5), "5 frequencies are too few"),
    "no number": ("f [Hz],Re,Im", [*bode_rows(9), (10.0, float("nan"), 1.0)], "is not finite"),
    "no frequency": ("a,b,c", bode_rows(), "no column is a frequency"),
    "no imaginary part": ("f [Hz],Re,c", bode_rows(), "imaginary parts: 0"),
    "a unit of frequency": ("f [Furlong],Re,Im", bode_rows(), "not a known unit of frequency"),
    "no names of signals": ("t [s],a,b", bode_rows(), "which signal is the input"),
    "negative coherence": (
        "f [Hz],Re,Im,coherence",
        [(*row, -1.0) for row in bode_rows()],
        "coherence lies in 0..1",
    ),
}


@pytest.mark.parametrize("why", REFUSED)
def test_what_a_fit_refuses_is_shown_with_the_reason(tmp_path, why):
    header, rows, reason = REFUSED[why]
    path = write(tmp_path / "a.csv", header, rows)
    with pytest.raises(InputError):
        read(path)
    seen = look(path)
    assert seen.response is None and reason in seen.doubts[0]
    assert [c.name for c in seen.columns] == header.split(",")
    assert header.split(",")[0] in repr(seen) and "doubt: " in repr(seen)
    plain = seen.to_dict()
    assert plain["refused"] and plain["lines"] is None


def test_an_unknown_unit_is_shown_beside_its_role(tmp_path):
    header, rows, _ = REFUSED["a unit that is unknown"]
    seen = look(write(tmp_path / "a.csv", header, rows))
    assert [(c.role, c.unit) for c in seen.columns][1] == (Role.GAIN, "furlong")


def test_a_change_that_is_refused_leaves_the_others(tmp_path):
    path = write(tmp_path / "a.csv", "f [Hz],Re [rad/s],Im [rad/s]", bode_rows())
    seen = look(path, changes=[lambda r: in_si(r, output="rad/s^2"), lambda r: r.sign_reversed()])
    assert seen.response == read(path).sign_reversed()
    assert "give --quantity" in seen.doubts[0]


def test_what_cannot_be_parsed_and_what_is_no_option_are_errors(tmp_path):
    (tmp_path / "words.csv").write_text("nothing but words\n")
    (tmp_path / "a.mat").write_bytes(b"\0" * 5 + b"no MATLAB file")
    (tmp_path / "a.z").write_bytes(b"ZPLOT2 ASCII\nno table\n")
    for name in ("words.csv", "a.mat", "a.z", "absent.csv"):
        with pytest.raises(InputError):
            look(tmp_path / name)
    path = write(tmp_path / "a.csv", "f [Hz],Re,Im", bode_rows())
    with pytest.raises(InputError, match="unknown option wrong"):
        look(path, wrong=1)


def signals(kind, periods=4, noise=0.0):
    """An input of 1 s periods at 1 kHz, and a mass under it."""
    t = np.arange(PERIOD) / RATE
    source = np.random.default_rng(3)
    lines = np.arange(5, 200, 2)
    u = {
        "multisine": np.cos(2 * pi * np.outer(t, lines) + source.uniform(0, 7, 98)).sum(axis=1),
        "schroeder": sum(np.cos(2 * pi * f * t - pi * f * f / 200) for f in range(1, 200)),
        "sweep": np.sin(2 * pi * (5 * t + 90 * t**2)),
        "sine": np.sin(2 * pi * 7 * t),
    }[kind]
    u = np.tile(u, periods)
    return u + noise * source.normal(size=len(u))


@pytest.mark.parametrize(
    ("kind", "found", "lines"),
    [
        ("multisine", Excitation.MULTISINE, 98),
        ("schroeder", Excitation.MULTISINE, 199),
        ("sweep", Excitation.SWEEP, None),
        ("sine", Excitation.PERIODIC, 1),
    ],
)
@pytest.mark.parametrize("noise", [0.0, 0.01])
def test_periodic_inputs_are_told_apart(kind, found, lines, noise):
    got = excitation(signals(kind, noise=noise), RATE)
    assert got.kind is found and (lines is None or got.lines == lines)
    if kind == "multisine":
        assert (got.low, got.high, got.period) == (5.0, 199.0, PERIOD)


def test_inputs_that_do_not_repeat_are_sweeps_or_random():
    t = np.arange(8000) / RATE
    noise = np.random.default_rng(0).normal(size=8000)
    assert excitation(noise, RATE).kind is Excitation.RANDOM
    assert excitation(np.cumsum(noise), RATE).kind is Excitation.RANDOM
    sweep = excitation(np.sin(2 * pi * (2 * t + 10 * t**2)), RATE)
    assert sweep.kind is Excitation.SWEEP and sweep.low < 10 and 150 < sweep.high < 170
    steps = np.concatenate([np.sin(2 * pi * f * t[:500]) for f in np.geomspace(4, 300, 16)])
    assert excitation(steps, RATE).kind is Excitation.SWEEP


@pytest.mark.full
@given(st.floats(1e-6, 1e6), st.sampled_from(["multisine", "sweep"]), st.floats(-5, 5))
def test_the_kind_does_not_depend_on_unit_and_offset(factor, kind, offset):
    u = signals(kind, periods=2)
    share = moving_share(u[:PERIOD])
    assert moving_share(factor * (u[:PERIOD] + offset)) == pytest.approx(share, abs=1e-6)


def record(path, header="t [s],u [Nm],y [rad]", noise=0.0, slope=0.0):
    u = signals("multisine")
    spectrum = np.fft.rfft(u[:PERIOD])
    hertz = np.arange(len(spectrum))
    spectrum[1:] /= -((2 * pi * hertz[1:]) ** 2)
    y = np.tile(np.fft.irfft(spectrum, PERIOD), 4) + 3
    y += noise * np.random.default_rng(1).normal(size=len(y)) * y.std()
    t = np.arange(len(u)) / RATE
    return write(path, header, zip(t.tolist(), u.tolist(), (y + slope * t).tolist(), strict=True))


@pytest.mark.full
def test_a_record_shows_its_sampling_excitation_trend_and_distortion(tmp_path):
    seen = look(record(tmp_path / "a.csv", noise=0.01, slope=0.5), input="u [Nm]", output="y [rad]")
    assert [(c.role.value, c.unit) for c in seen.columns] == [
        ("clock", "s"),
        ("input", "Nm"),
        ("output", "rad"),
    ]
    assert [seen.quantity_of(c) for c in seen.columns] == ["", "torque", "position"]
    assert seen.assumed == ()
    method = seen.response.method
    assert (method.period, method.periods, method.dropped) == (PERIOD, 3, 1)
    assert seen.excitation.kind is Excitation.MULTISINE and seen.excitation.lines == 98
    assert len(seen.trends) == 1 and "output y [rad] drifts by 0.5 rad/s" in seen.trends[0]
    assert set(seen.distortion) == {"even distortion", "noise"}  # odd lines are excited
    text = repr(seen)
    assert "record: 4000 samples at 1000 Hz, 4 s; 3 periods of 1000 samples" in text
    assert "excitation: multisine, 98 lines, 5 to 199 Hz" in text
    assert "(3 periods)" in text and text.count("drifts by 0.5 rad/s") == 1


@pytest.mark.full
def test_signals_that_are_chosen_by_their_names_are_assumed(tmp_path):
    seen = look(record(tmp_path / "a.csv", "t,torque,y_act"), input="torque", output="y_act")
    assert [(a.what, a.option) for a in seen.assumed] == [
        ("quantity position", "--quantity velocity or --quantity acceleration"),
        ("time in s", "--read sampling_rate=HZ"),
    ]
    seen = look(record(tmp_path / "a.csv", "t,torque,angle"))
    assert [(a.what, a.option) for a in seen.assumed] == [
        ("input torque, by its name", "--read input=NAME"),
        ("output angle, by its name", "--read output=NAME"),
        ("time in s", "--read sampling_rate=HZ"),
    ]


def test_a_record_without_a_period_shows_its_samples(tmp_path):
    noise = np.random.default_rng(0).normal(size=(600, 2))
    rows = [(k / RATE, *map(float, row)) for k, row in enumerate(noise)]
    seen = look(write(tmp_path / "a.csv", "t [s],u,y", rows))
    assert seen.response is None and len(seen.record) == 600
    assert seen.excitation.kind is Excitation.RANDOM
    assert "no period was found" in seen.doubts[0]
    assert "record: 600 samples at 1000 Hz" in repr(seen)


def test_an_impedance_is_shown_and_refused_for_chains(tmp_path):
    rows = [(float(k + 1), 5.0, -1.0 / (k + 1)) for k in range(20)]
    seen = look(write(tmp_path / "a.csv", "freq/Hz,Re(Z)/Ohm,Im(Z)/Ohm", rows))
    assert seen.is_impedance and seen.quantity is None and seen.assumed == ()
    assert [seen.quantity_of(c) for c in seen.columns] == ["", "impedance", "impedance"]
    assert "--models" in seen.doubts[0]
    assert list(short_lines(read(tmp_path / "a.csv")))[2] == (
        "shows: impedance; 20 lines from 1 to 20 Hz"
    )


def test_repeats_are_averaged_and_their_scatter_is_known_from_them(tmp_path):
    source = np.random.default_rng(0)
    paths = []
    for k in range(4):
        rows = [(f, g + source.normal(), p) for f, g, p in bode_rows()]
        paths.append(write(tmp_path / f"{k}.csv", "f [Hz],Re,Im", rows))
    seen = look(paths[0], repeat=paths[1:])
    assert seen.scatter.source.endswith("(repeats)")
    assert seen.scatter.median == scatter(seen.response).typical
    others = write(tmp_path / "other.csv", "f [Hz],Re,Im", bode_rows(9))
    apart = look(paths[0], repeat=[others])
    assert apart.response == read(paths[0]) and "other frequencies" in apart.doubts[0]


def test_lines_fit_the_width(tmp_path):
    header = "frequency,magnitude of the response of the motor,phase"
    seen = look(write(tmp_path / "a.csv", header, bode_rows()))
    for width in (60, 80, 120):
        assert max(map(len, look_lines(seen, width))) <= width
    assert "begins with" in "".join(look_lines(seen, 140))
    assert "1, 2, 3" in "".join(look_lines(seen, 140))


def test_names_cannot_write_control_characters(tmp_path):
    path = write(tmp_path / "a.csv", "f [Hz],Re \x1b[2J,Im", bode_rows())
    assert "\x1b" not in repr(look(path))


def test_the_short_form_of_a_fit_has_all_assumptions(tmp_path):
    path = write(tmp_path / "a.csv", "frequency,magnitude,phase", bode_rows())
    assert list(short_lines(read(path))) == [
        "a.csv, column 2 (magnitude)",
        "columns: frequency in Hz (column 1), gain (column 2), phase in degrees (column 3)",
        "shows: acceleration (assumed); 20 lines from 1 to 20 Hz",
        "assumed: quantity acceleration (else --quantity position or --quantity velocity);"
        " frequency in Hz (else --unit frequency=rad/s); gain linear (else --unit magnitude=dB);"
        " phase in deg, from its values (else --unit phase=rad)",
    ]


def valid(plain):
    errors = Draft202012Validator(schema(Format.LOOK)).iter_errors(plain)
    return [f"{error.json_path}: {error.message[:200]}" for error in errors] == []


@pytest.mark.full
def test_plain_data_are_what_the_schema_says(tmp_path):
    frf = write(tmp_path / "a.csv", "f [Hz],Re,Im", bode_rows())
    few = write(tmp_path / "b.csv", "f [Hz],Re,Im", [*bode_rows(4), (9.0, float("nan"), 1.0)])
    for seen in (look(frf), look(few), look(record(tmp_path / "c.csv"))):
        assert valid(json.loads(json.dumps(seen.to_dict(), allow_nan=False)))


REAL = [
    ("EMPS.mat", {}),
    ("EMPS.mat", {"input": "vir", "output": "qm", "reference": "qg", "segment": 4096}),
    ("fditools_motorbench_A.mat", {"input": "iq_adx", "output": "theta_mx"}),
    ("fditools_motorbench_B.mat", {"input": "iq_adx", "output": "theta_mx", "to": "acceleration"}),
    ("fditools_motorbench_frf_A.csv", {}),
    ("fditools_motorbench_frf_B.csv", {"column": 6}),
    ("fditools_stage_frd.mat", {}),
    ("fditools_stage_frd.mat", {"response": "frf.Pv"}),
    ("fditools_stage_frd.mat", {"response": "frf.Pv[1]"}),
    ("belsley1991_consumption_X.csv", {}),
    ("daisy_robot_arm.dat", {}),
    ("daisy_robot_arm.dat", {"input": 1, "output": 2, "sampling_rate": 500.0, "segment": 128}),
    *((f"eis/{name}", {}) for name in (
        "Circuit1_EIS_1.z", "Circuit2_EIS_1.z", "Circuit3_EIS_1.z", "exampleData.csv",
        "exampleDataBioLogic.mpt", "exampleDataGamry.DTA", "exampleDataZPlot.z",
    )),
    *((f"../cases/{name}.csv", {}) for name in (
        "bode_a", "bode_b", "c3_2_A", "c4_2_A", "db", "eis", "gear_0_A", "load",
    )),
]  # fmt: skip


@pytest.mark.thin(8)
@pytest.mark.parametrize(("name", "options"), REAL)
def test_measured_files_are_shown(name, options):
    path = measured_data(name)
    seen = look(path, **options)
    assert seen.columns and valid(json.loads(json.dumps(seen.to_dict(), allow_nan=False)))
    assert "<table" in seen._repr_html_() and max(map(len, repr(seen).splitlines())) <= 100
    refusal = ""
    try:
        expected = read(path, **options)
    except InputError as reason:
        refusal = str(reason)
    if refusal:
        assert seen.response is None and refusal in seen.doubts
    else:
        assert seen.is_impedance or seen.response == expected


@pytest.mark.full
def test_the_bench_is_understood_as_its_owner_describes_it():
    seen = look(measured_data("fditools_motorbench_B.mat"), input="iq_adx", output="theta_mx")
    found = seen.excitation
    assert (found.kind, found.lines, found.low, found.high, found.period) == (
        Excitation.MULTISINE, 60, 13.0, 249.0, 2500,
    )  # fmt: skip
    assert seen.response.method.periods == 19
    schroeder = look(measured_data("fditools_motorbench_A.mat"), input="iq_adx", output="theta_mx")
    assert schroeder.excitation.kind is Excitation.MULTISINE
    assert (schroeder.excitation.low, schroeder.excitation.high) == (11.0, 250.0)
