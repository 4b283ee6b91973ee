"""Figures show what was found, repeat byte by byte and leave no trace in matplotlib."""

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from io import BytesIO
from xml.etree import ElementTree as ET

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from disting.fit.judge.modes import Result, physical
from disting.fit.results.selection import Selection, profile
from disting.fit.select import select
from disting.measurement import FrequencyResponse
from disting.report.fit import bode, collinearity_dots, profile_panels
from disting.report.fit.bode import Mark, asymptotes, marks, model_line
from disting.report.fit.style import (
    NARROW,
    POINTS,
    VARIABLES,
    WIDE,
    FigureFiles,
    Tone,
    draw_figure,
    heading,
    is_narrow,
)

from .conftest import DRIVE, VALUES


@pytest.fixture(scope="module")
def figure(selection: Selection, train: FrequencyResponse, test: FrequencyResponse) -> FigureFiles:
    assert selection.selected is not None
    return bode(
        selection.selected,
        selection.task,
        physical(selection.selected, selection.task),
        train,
        test,
    )


@pytest.mark.full
def test_the_drive_is_found(selection: Selection) -> None:
    assert selection.selected is not None
    assert selection.selected.chain == DRIVE


@pytest.mark.full
def test_files_are_what_they_claim(figure: FigureFiles) -> None:
    assert ElementTree.fromstring(figure.svg).tag == "{http://www.w3.org/2000/svg}svg"
    assert Image.open(BytesIO(figure.png)).width > 1500
    assert figure.pdf.startswith(b"%PDF-") and b"CreationDate" not in figure.pdf
    assert b"atplotlib" not in figure.png and b"<dc:date>" not in figure.svg


@pytest.mark.slow
def test_nothing_is_cut_off_where_units_are_not_known(train: FrequencyResponse) -> None:
    """The legend then says "input per acceleration", its longest, behind inertias of seven
    characters.
    """
    nameless = {"input": train.input._replace(unit=""), "output": train.output._replace(unit="")}
    found = select(replace(train, G=train.G / 0.3177, **nameless), [DRIVE])
    assert found.selected is not None
    drawing = bode(
        found.selected, found.task, physical(found.selected, found.task), found.test, found.test
    )
    pixels = np.asarray(Image.open(BytesIO(drawing.png)).convert("L"))
    assert pixels.min() < 100
    assert (
        min(edge.min() for edge in (pixels[:3], pixels[-3:], pixels[:, :3], pixels[:, -3:]))
        == pixels.max()
    )


@pytest.mark.full
def test_settings_of_the_user_neither_enter_nor_change() -> None:
    def draw(figure: Figure) -> None:
        figure.subplots().plot([1, 2], [3, 5])
        heading(figure, "a title")

    before = draw_figure("t", "a title", (2, 2), draw)
    with matplotlib.rc_context(
        {"lines.linewidth": 9, "font.size": 20, "axes.facecolor": "red", "svg.hashsalt": "other"}
    ):
        after = draw_figure("t", "a title", (2, 2), draw)
        assert matplotlib.rcParams["font.size"] == 20
    assert (before.svg, before.png, before.pdf) == (after.svg, after.png, after.pdf)


@pytest.mark.full
def test_inline_figures_know_light_and_dark_and_their_own_ids(figure: FigureFiles) -> None:
    text = str(figure.inline)
    assert not any(tone.value in text for tone in VARIABLES)
    assert all(
        f"var(--{VARIABLES[tone]})" in text
        for tone in (Tone.INK, Tone.FIRST, Tone.SECOND, Tone.MUTED)
    )
    assert "<style" not in text and "xlink:" not in text and "http" not in text
    ids = re.findall(r'\bid="([^"]*)"', text)
    assert ids and all(i.startswith("bode-") for i in ids) and len(ids) == len(set(ids))
    assert set(re.findall(r'(?:href="#|url\(#)([^")]*)', text)) <= set(ids)


@pytest.mark.full
def test_phones_get_a_narrow_drawing_with_letters_of_the_same_size() -> None:
    seen: list[bool] = []
    long = (
        "a title that is so long that it needs more than one line on a phone, but one line"
        " elsewhere"
    )

    def draw(figure: Figure) -> None:
        seen.append(is_narrow(figure))
        heading(figure, long)

    made = draw_figure("t", long, (2, 3), draw)
    assert seen == [False, True]
    boxes = re.findall(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', str(made.inline))
    sizes = [tuple(float(side) / POINTS for side in box) for box in boxes]
    assert sizes == [pytest.approx((WIDE, 2)), pytest.approx((NARROW, 3))]
    lines = [text.count("<!-- ") for text in (made.svg.decode(), made.narrow.decode())]
    assert lines[0] == 1 and lines[1] >= 2


@pytest.mark.full
def test_marks_of_one_measurement_carry_their_style_once(
    figure: FigureFiles, train: FrequencyResponse
) -> None:
    uses = re.findall(r"<use [^>]*>", str(figure.inline))
    assert len(uses) > 2 * 2 * len(train) and sum("stroke" in use for use in uses) < 60
    assert not re.search(r'<use [^>]*="\d+\.\d{3,}', str(figure.inline))


def test_the_label_of_a_mark_is_its_frequency_and_damping() -> None:
    assert Mark("resonance", 76.66, 0.0185).label() == "△ 76.7 Hz\nζ 0.018"


@pytest.mark.full
def test_a_text_of_the_user_is_no_formula() -> None:
    made = draw_figure(
        "t", '"a" & <b>', (2, 2), lambda figure: heading(figure, "$\\undefined{ <b> $")
    )
    assert ElementTree.fromstring(made.svg) is not None
    assert 'aria-label="&#34;a&#34; &amp; &lt;b&gt;"' in made.inline


def test_marks_stay_in_the_band_and_where_something_shows() -> None:
    rows = [
        ("antiresonance 1", 20.0, 0.1),
        ("resonance 1", 30.0, 0.8),
        ("resonance 2", 40.0, 0.02),
        ("resonance 3", 500.0, 0.1),
    ]
    pairs = [
        (Result(n, v, 0.0, "Hz"), Result(f"damping ratio of {n}", ratio, 0.0, ""))
        for n, v, ratio in rows
    ]
    omega = 2 * np.pi * np.array([10.0, 100.0])
    assert marks([r for pair in pairs for r in pair], omega) == [
        Mark("antiresonance", 20.0, 0.1),
        Mark("resonance", 40.0, 0.02),
    ]


@pytest.mark.full
def test_marks_and_asymptotes_are_those_of_the_drive(
    selection: Selection, train: FrequencyResponse
) -> None:
    assert selection.selected is not None
    results = physical(selection.selected, selection.task)
    low, high = (2 * np.pi * m.frequency for m in marks(results, train.omega))
    m1, m2, k = VALUES["m1"], VALUES["m2"], VALUES["k12"]
    assert low == pytest.approx(np.sqrt(k / m2), rel=0.01)
    assert high == pytest.approx(np.sqrt(k * (m1 + m2) / (m1 * m2)), rel=0.01)
    (total, at_low), (motor, at_high) = asymptotes(DRIVE, results, train.omega, train)
    assert (
        total.startswith("total inertia")
        and motor.startswith("motor inertia")
        and total.endswith("kg m²")
    )
    assert at_low[0] == pytest.approx(1 / (m1 + m2), rel=0.01) and at_high[0] == pytest.approx(
        1 / m1, rel=0.01
    )


@pytest.mark.full
def test_measured_phases_follow_the_model_without_jumps(
    selection: Selection, train: FrequencyResponse
) -> None:
    assert selection.selected is not None
    line = model_line(selection.selected, selection.task, [train])
    assert line.phase.max() <= 200.0
    shown = line.phase_of(train)
    assert np.cos(np.radians(shown)) == pytest.approx(np.cos(np.angle(train.G)), abs=1e-9)
    assert np.abs(shown - line.phase[np.searchsorted(line.omega, train.omega)]).max() < 10


@pytest.mark.full
def test_a_profile_is_drawn(selection: Selection) -> None:
    found = selection.selected
    assert found is not None
    panels = profile_panels(found, selection.task, [profile(found, selection.task, "k12")])
    assert len(panels.svg) > 5000


@pytest.mark.full
def test_one_parameter_has_no_collinearity(selection: Selection) -> None:
    smallest = min(selection.candidates, key=lambda c: c.n_parameters)
    assert smallest.n_parameters == 1
    assert collinearity_dots(smallest, selection.task, selection.thresholds) is None


@pytest.mark.full
def test_signs_that_the_font_lacks_are_drawn_without_a_word(recwarn) -> None:
    found = draw_figure("a", "t", (1.0, 1.0), lambda figure: heading(figure, "\x9b31m 漢"))
    assert found.png.startswith(b"\x89PNG") and not recwarn


def test_signs_that_no_xml_may_hold_are_left_out() -> None:
    found = draw_figure("a", "t", (1.0, 1.0), lambda figure: heading(figure, "a\x1bb\ufffec"))
    assert ET.fromstring(found.svg).tag.endswith("svg")
