"""Units of headers and of the caller, decibels without a word, and repeated measurements."""

import numpy as np
import pytest

from disting.cli import main
from disting.errors import InputError
from disting.measurement import (
    FrequencyResponse,
    Signal,
    TimeSeries,
    in_si,
    mean_of,
    read,
    read_time_series,
)
from disting.measurement.repeats import find_outliers
from disting.measurement.scaling import in_omega, scale, with_constant
from disting.measurement.units import DRIVES, MOTIONS, motion, ratio
from disting.model.chain import Quantity
from disting.report.fit.words import unit_of
from tests.measurement.bench_data import measured_data

FREQUENCY = np.arange(1.0, 13.0)
G = 2.0 * np.exp(-0.1j * FREQUENCY) / FREQUENCY


def written(path, header, rows, comment=""):
    body = "\n".join(",".join(map(repr, map(float, row))) for row in rows)
    path.write_text(f"{comment}{header}\n{body}\n", encoding="utf-8")
    return path


def parts(tmp_path, comment, header="f [Hz],Re,Im"):
    return written(
        tmp_path / "a.csv",
        header,
        [(f, g.real, g.imag) for f, g in zip(FREQUENCY, G, strict=True)],
        comment,
    )


@pytest.mark.parametrize(
    ("comment", "output", "input", "sensor", "factor", "mass"),
    [
        ("# rad/s^2 per Nm", "rad/s^2", "Nm", Quantity.ACCELERATION, 1.0, "kg m²"),
        ("# bench of June, (m/s)/N", "m/s", "N", Quantity.VELOCITY, 1.0, "kg"),
        ("# deg/Nm", "rad", "Nm", Quantity.POSITION, np.pi / 180, "kg m²"),
        ("# um/kN", "m", "N", Quantity.POSITION, 1e-9, "kg"),
        ("# mm/s² per mA", "m/s^2", "A", Quantity.ACCELERATION, 1.0, "A/(m/s²)"),
    ],
)
def test_units_of_comments_are_taken_to_si(tmp_path, comment, output, input, sensor, factor, mass):
    found = in_si(read(parts(tmp_path, comment + "\n")))
    assert (found.output.unit, found.input.unit, found.quantity) == (output, input, sensor)
    np.testing.assert_allclose(found.G, G * factor, rtol=1e-14)
    assert unit_of("m", found) == mass and not any(
        "sensor quantity" in note for note in found.notes
    )
    assert any("output taken from" in note for note in found.notes) == (
        factor != 1 or "mm" in comment
    )


def test_what_is_no_unit_is_left_alone(tmp_path):
    for comment in ("", "# a mass of 3 kg, and m per s\n", "# rad/A or rad/s per A\n"):
        found = in_si(read(parts(tmp_path, comment), quantity="position"))
        assert (found.output.unit, found.input.unit) == ("", "") and np.array_equal(found.G, G)


@pytest.mark.thin(8)
@pytest.mark.parametrize("unit", [*MOTIONS, "cm/s", "mrad/s²", "rev/s", "mm/s2", "rpm/s"])
@pytest.mark.parametrize("wanted", Quantity)
def test_another_quantity_keeps_the_unit_whatever_it_is(unit, wanted):
    """Units that were not in one of two lists were lost, so that a record in rev was read as rad,
    one in cm as m, wherever another quantity was asked for.
    """
    seen = FrequencyResponse(
        2 * np.pi * FREQUENCY, G, quantity=motion(unit).quantity, output=Signal("y", unit)
    )
    found, before = in_si(seen.to_quantity(wanted)), in_si(seen).to_quantity(wanted)
    np.testing.assert_allclose(found.G, before.G, rtol=1e-14)
    assert found.output == before.output and found.output.unit


def test_a_record_in_turns_is_one_in_radians(tmp_path):
    samples = np.arange(400)
    torque = np.sign(np.sin(2 * np.pi * samples / 40) + np.sin(2 * np.pi * 3 * samples / 40))
    angle = np.cumsum(np.cumsum(torque - torque.mean()))
    angle = angle - np.linspace(0, angle[-1], 400)
    options = {"input": "T [Nm]", "sampling_rate": 100.0, "segment": 80, "to": "acceleration"}
    found = []
    for unit, size in (("rad", 2 * np.pi), ("rev", 1.0), ("mrad", 2000 * np.pi)):
        path = written(
            tmp_path / "a.csv", f"T [Nm],y [{unit}]", zip(torque, angle * size, strict=True)
        )
        found.append(in_si(read(path, output=f"y [{unit}]", quantity="position", **options)))
    for other in found[1:]:
        np.testing.assert_allclose(other.G, found[0].G, rtol=1e-9)
        assert other.output.unit == found[0].output.unit == "rad/s^2"


def test_a_unit_that_contradicts_the_quantity_is_not_lost():
    """The speed of a record that is taken as a position was differentiated twice without a word."""
    said = {"quantity": "position", "output": Signal("w", "rad/s")}
    with pytest.raises(InputError, match=r"in rad/s is a velocity, .* give --quantity velocity"):
        FrequencyResponse(2 * np.pi * FREQUENCY, G, **said).to_quantity("acceleration")


def test_a_unit_that_is_known_is_known_in_a_comment():
    drives = {name.replace(" ", gap) for name in DRIVES for gap in ("", " ")}
    motions = [name for name, unit in MOTIONS.items() if not unit.order]
    pairs = [(f"{name}/s^2", drive) for name in motions for drive in drives]
    assert [pair for pair in pairs if ratio([f"# {' per '.join(pair)}, of June"]) != pair] == []
    assert len(pairs) > 200


def test_units_that_the_caller_gives():
    plain = FrequencyResponse(2 * np.pi * FREQUENCY, G, deviation=np.ones(12), quantity="position")
    found = in_si(plain.to_quantity("velocity"), output="deg", input="mNm")
    np.testing.assert_allclose(
        found.G, plain.to_quantity("velocity").G * np.pi / 180 * 1e3, rtol=1e-14
    )
    np.testing.assert_allclose(found.deviation, plain.omega * np.pi / 180 * 1e3, rtol=1e-14)
    assert (found.output.unit, unit_of("k", found), unit_of("b", found)) == (
        "rad/s",
        "Nm/rad",
        "N m s/rad",
    )
    speed = in_si(plain.to_quantity("velocity"), output="rpm")
    np.testing.assert_allclose(
        speed.G, plain.to_quantity("velocity").G * 2 * np.pi / 60, rtol=1e-14
    )
    for wrong in ({"output": "furlong"}, {"input": "rad"}, {"output": "rpm"}):
        with pytest.raises(InputError, match=r"not a known unit|is a velocity"):
            in_si(plain, **wrong)


def test_a_torque_constant_makes_a_current_a_torque_or_a_force():
    data = {"omega": 2 * np.pi * FREQUENCY, "G": G, "input": Signal("iq", "A")}
    linear = with_constant(FrequencyResponse(**data, output=Signal("x", "m/s^2")), 35.0)
    np.testing.assert_allclose(linear.G, G / 35, rtol=1e-14)
    assert [unit_of(kind, linear) for kind in "mkd"] == [
        "kg",
        "N/m",
        "N s/m",
    ] and linear.notes == ()
    unknown = with_constant(FrequencyResponse(**data), 0.5)
    assert [unit_of(kind, unknown) for kind in "mkd"] == ["kg m²", "Nm/rad", "N m s/rad"]
    assert any("taken to be in rad" in note for note in unknown.notes)
    for response, constant in (
        (linear, 1.0),
        (FrequencyResponse(**data), 0.0),
        (FrequencyResponse(**data), np.nan),
    ):
        with pytest.raises(InputError, match=r"remove --torque-constant|is positive"):
            with_constant(response, constant)
    np.testing.assert_allclose(scale(linear, 1e-3).G, G / 35e3, rtol=1e-14)
    with pytest.raises(InputError, match="a scale is a positive number"):
        scale(linear, -1.0)


def test_the_real_bench_has_units_in_its_header():
    found = in_si(read(measured_data("fditools_motorbench_frf_A.csv")))
    assert (found.output.unit, found.input.unit) == ("rad/s^2", "A")
    assert unit_of("m", with_constant(found, 0.3)) == "kg m²"


@pytest.mark.parametrize(
    "header", ["f [Hz],mag,phase", "f [Hz],amplitude,phase [deg]", "f [Hz],Gain,Phase"]
)
def test_negative_magnitudes_with_degrees_are_decibels_and_said(tmp_path, header):
    rows = [(f, 20 * np.log10(abs(g)), 30 * f - 180) for f, g in zip(FREQUENCY, G, strict=True)]
    found = read(written(tmp_path / "a.csv", header, rows))
    np.testing.assert_allclose(np.abs(found.G), np.abs(G), rtol=1e-12)
    assert any("taken as dB" in note for note in found.notes)
    for wrong in ("f [Hz],abs,phase [deg]", "f [Hz],mag,phase [rad]"):
        with pytest.raises(InputError, match="a magnitude is negative"):
            read(written(tmp_path / "b.csv", wrong, rows))
    with pytest.raises(InputError, match="a magnitude is negative"):
        read(tmp_path / "a.csv", columns=["Hz", "magnitude", "deg"])


def test_the_unit_of_a_column_of_frequencies(tmp_path):
    path = parts(tmp_path, "", "f,Re,Im")
    assert "frequencies of column 1 (f) taken as Hz" in read(path).notes
    assert np.array_equal(read(path, frequency_unit="rad/s").omega, FREQUENCY)
    assert np.allclose(read(path, frequency_unit="rpm").frequency, FREQUENCY / 60)
    circular = written(tmp_path / "b.csv", "f,Re,Im", [(2 * np.pi * f, 1, f) for f in FREQUENCY])
    assert np.allclose(read(circular).frequency, FREQUENCY) and any(
        "round numbers 1, 2, 3" in n for n in read(circular).notes
    )
    assert in_omega(FREQUENCY * 1.2345678, None, None, "f")[0][0] == pytest.approx(
        2 * np.pi * 1.2345678
    )


@pytest.mark.full
def test_repeats_have_a_mean_and_a_scatter(tmp_path):
    source = np.random.default_rng(0)
    several = G * (
        1 + 0.02 * (source.normal(size=(200, 12)) + 1j * source.normal(size=(200, 12))) / np.sqrt(2)
    )
    repeats = [FrequencyResponse(FREQUENCY, one) for one in several]
    found = mean_of(repeats)
    np.testing.assert_allclose(found.G, several.mean(axis=0), rtol=1e-13)
    np.testing.assert_allclose(found.deviation, 0.02 * np.abs(G) / np.sqrt(200), rtol=0.25)
    assert any("mean of 200 repeats, which scatter by 2" in note for note in found.notes)
    assert mean_of(repeats[:1]) == repeats[0]
    columns = [
        (f, *(x for g in several[:3, i] for x in (g.real, g.imag))) for i, f in enumerate(FREQUENCY)
    ]
    path = written(tmp_path / "a.csv", "f [Hz],Re 1,Im 1,Re 2,Im 2,Re 3,Im 3", columns)
    assert np.allclose(read(path, column="all").G, several[:3].mean(axis=0))
    for other in (repeats[0].sign_reversed().to_quantity("velocity"), repeats[0].masked(low=0.4)):
        with pytest.raises(InputError, match=r"one quantity|other frequencies"):
            mean_of([repeats[0], other])


def test_repeats_in_files_are_read_and_scaled_together(tmp_path):
    files = []
    for k, size in enumerate((0.9, 1.1)):
        rows = [(f, size * g.real, size * g.imag) for f, g in zip(FREQUENCY, G, strict=True)]
        files.append(written(tmp_path / f"{k}.csv", "f [Hz],Re,Im", rows))
    found = read(files[0], repeat=files[1:], unit={"output": "deg/s", "input": "Nm"}, scale=2.0)
    np.testing.assert_allclose(found.G, 2 * np.pi / 180 * G, rtol=1e-12)
    assert found.quantity is Quantity.VELOCITY and found.deviation is not None


def repeated(n, seed, lines=100):
    source = np.random.default_rng([seed, n])
    noise = source.normal(size=(n, lines)) + 1j * source.normal(size=(n, lines))
    return 1.0 + 0.1 * noise * source.uniform(0.2, 3.0, size=lines)


@pytest.mark.full
@pytest.mark.parametrize("n", [2, 3, 5, 10])
def test_repeats_of_one_noise_have_no_outliers(n):
    """Neither lines nor whole repeats, in 300 sets."""
    assert not any(find_outliers(repeated(n, seed)).any() for seed in range(300))


def test_an_outlier_among_repeats_is_named_and_left_out_where_that_is_said():
    frequency = np.geomspace(1.0, 100.0, 100)
    values = repeated(10, 7)
    values[3, 40:42] += 30.0
    repeats = [FrequencyResponse(frequency, one, origin=f"{i}.csv") for i, one in enumerate(values)]
    kept, dropped = mean_of(repeats), mean_of(repeats, outliers="drop")
    hertz = ", ".join(f"{f:.4g}" for f in kept.frequency[40:42])
    (doubt,) = kept.doubts
    assert (
        doubt.startswith(f"3.csv at {hertz} Hz: differs from the other") and "--outliers" in doubt
    )
    np.testing.assert_array_equal(kept.G, values.mean(axis=0))
    rest = np.delete(values, 3, axis=0)
    np.testing.assert_allclose(dropped.G[40:42], rest.mean(axis=0)[40:42])
    np.testing.assert_allclose(dropped.deviation[41], np.std(rest[:, 41], ddof=1) / 3)
    np.testing.assert_allclose(np.delete(dropped.G, [40, 41]), np.delete(kept.G, [40, 41]))
    assert not dropped.doubts and any(f"3.csv at {hertz} Hz" in n for n in dropped.notes)
    assert (kept.freedom, dropped.freedom) == (18.0, 16.0)
    with pytest.raises(InputError, match="--outliers is keep or drop"):
        mean_of(repeats, outliers="median")


def test_a_whole_repeat_and_a_period_that_are_not_like_the_others():
    values = repeated(5, 1)
    values[2] += 1.5 * np.std(values[[0, 1, 3, 4]], axis=0).max()
    assert find_outliers(values)[2].all() and not find_outliers(values)[[0, 1, 3, 4]].any()
    u = np.tile(np.random.default_rng(1).normal(size=64), 6)
    y = u + 0.01 * np.random.default_rng(2).normal(size=u.size)
    y[3 * 64 : 4 * 64] *= 1.5
    record = TimeSeries(u, y, 64.0)
    said = record.response(period=64, transient=0)
    assert [d[:11] for d in said.doubts] == ["period 4 at"]
    left = record.response(period=64, transient=0, outliers="drop")
    assert left.freedom == 8.0 and np.allclose(left.to_quantity("position").G, 1.0, atol=0.05)


def test_signals_of_a_record_have_units_in_their_headers(tmp_path):
    rows = [(0.01 * i, np.sin(i), np.cos(i)) for i in range(100)]
    path = written(tmp_path / "a.csv", "t [s],iq [A],angle (deg)", rows)
    found = read_time_series(path, "iq [A]", "angle (deg)")
    assert (found.input, found.output) == (Signal("iq", "A"), Signal("angle", "deg"))


@pytest.mark.full
def test_units_on_the_command_line(tmp_path, capsys):
    path = written(
        tmp_path / "a.csv",
        "f,Re,Im",
        [(f, 5.0 + 0.1 * np.sin(f), 0.1 * np.cos(f)) for f in np.arange(1.0, 31.0)],
    )
    mass = [
        "fit",
        str(path),
        "--masses",
        "1",
        "--unit",
        "input=A",
        "--unit",
        "output=mm/s^2",
        "--unit",
        "frequency=rad/s",
    ]
    assert main([*mass, "--torque-constant", "0.02", "--repeat", str(path), "--scale", "2"]) == 1
    said = capsys.readouterr()
    assert (
        "kg\n" in said.out
        and "mean of 2 repeats" in said.err
        and "output taken from mm/s^2 to m/s^2" in said.err
    )
    inertia = next(
        line for line in said.out.splitlines() if line.strip().startswith("total inertia")
    )
    assert float(inertia.split()[2].strip("(")) == pytest.approx(0.02 / 0.01, rel=0.01)
    for wrong in (["--unit", "input=furlong"], ["--scale", "-1"], ["--torque-constant", "0"]):
        assert main(["fit", str(path), *wrong]) == 2
    with pytest.raises(SystemExit):
        main(["fit", str(path), "--unit", "mass=kg"])
