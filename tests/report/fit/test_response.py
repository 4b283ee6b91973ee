"""Error bars, bands, residuals and distortion: drawn where there is something to draw, and told
with their sizes.
"""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from disting.export import predict
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import figure_1
from disting.fit.select import select
from disting.measurement import FrequencyResponse, TimeSeries
from disting.report.fit import residuals
from disting.report.fit.residuals import bands_in_words, misfits
from disting.report.fit.selection_json import selection_to_dict
from disting.report.fit.series import (
    BARRED,
    MANY,
    Series,
    bar_lines,
    bars,
    beneath,
    gather,
    series_of,
)
from disting.report.fit.style import Tone
from disting.report.fit.words import between, fit_in_words
from disting.statistics.scatter import Scatter

from .conftest import DRIVE, VALUES

PERIOD, RATE = 2000, 1000.0  # samples, Hz


@pytest.fixture(scope="module")
def plain(train: FrequencyResponse) -> Selection:
    """Data that do not tell how much they scatter."""
    return select(replace(train, coherence=None), [DRIVE])


@pytest.fixture(scope="module")
def wrong(train: FrequencyResponse, test: FrequencyResponse) -> Selection:
    """Nothing explains the data."""
    return select(
        train, [c for c in figure_1((1,)) if c.damped and not c.lag and not c.dead_time], test=test
    )


@pytest.fixture(scope="module")
def multisine() -> Selection:
    """The drive behind a square, excited at odd lines."""
    lines, time = np.arange(11, 401, 4), np.arange(PERIOD) / PERIOD
    u = np.cos(2 * np.pi * np.outer(time, lines) + 0.3 * lines**2).sum(axis=1) / 7
    whole = np.fft.rfft(u + 0.02 * u**2)
    omega = 2 * np.pi * np.arange(1, len(whole)) * RATE / PERIOD
    whole[1:] *= predict(DRIVE, VALUES, omega)
    y = np.tile(np.fft.irfft(whole, PERIOD), 5) + np.random.default_rng(2).normal(size=5 * PERIOD)
    record = TimeSeries(np.tile(u, 5), y, RATE, quantity="acceleration")  # type: ignore[arg-type]
    return select(record.response(), [DRIVE])


@pytest.fixture
def panel() -> Axes:
    return Figure().subplots()


def series(measured: FrequencyResponse, rho: float = 0.05) -> Series:
    return Series(
        "training data",
        measured,
        Tone.FIRST,
        "o",
        Scatter(np.full(len(measured), rho), np.abs(measured.G), "somewhere"),
    )


def test_lines_that_tell_their_scatter_have_bars_of_that_length(
    train: FrequencyResponse, panel: Axes
) -> None:
    size = np.abs(train.G)
    bars(panel, series(replace(train, coherence=None)), size, 0.9 * size, 1.2 * size)
    assert not panel.collections
    bars(panel, series(train), size, 0.9 * size, 1.2 * size)
    (found,) = [c for c in panel.collections if isinstance(c, LineCollection)]
    ends = np.array([segment[:, 1] for segment in found.get_segments()])
    assert ends == pytest.approx(np.stack([0.9 * size, 1.2 * size], axis=1))


@pytest.mark.parametrize(
    "omega", [np.geomspace(1, 1e4, 3000), np.linspace(1, 1e4, 3000), np.arange(1.0, 21.0)]
)
def test_bars_of_many_lines_are_thinned_over_the_whole_axis(omega: np.ndarray) -> None:
    at = bar_lines(omega)
    assert len(at) <= BARRED and (len(at) == len(omega) or len(omega) > BARRED)
    assert at[0] == 0 and at[-1] == len(omega) - 1 and np.all(np.diff(at) > 0)


@pytest.mark.full
def test_residuals_are_those_of_data_and_model(
    selection: Selection, train: FrequencyResponse, test: FrequencyResponse
) -> None:
    first, second = misfits(selection, train, test)
    model = predict(DRIVE, selection.described.estimate.parameters, train.omega)
    assert np.exp(first.amplitude + 1j * first.phase) == pytest.approx(train.G / model)
    assert second.series.scatter is selection.explanation.scatter
    wide = replace(
        first,
        series=replace(
            first.series, scatter=Scatter(np.full(len(train), 1.0), np.abs(train.G), "")
        ),
    )
    assert wide.outside == 0.0 and first.outside < 0.2


@pytest.mark.full
def test_what_the_figures_show_is_said_with_sizes(
    selection: Selection, train: FrequencyResponse, test: FrequencyResponse
) -> None:
    above, below = (" ".join(said) for said in bands_in_words(selection, train, test))
    assert (
        "Error bars of the training data hold 95 %: ±" in above
        and "Error bars of the test data" in above
    )
    assert (
        "The band of the model holds 95 % at each frequency, if the structure is right: ±" in above
    )
    assert "Residuals outside the scatter: " in below and "noise alone leaves 5 % there" in below
    assert "Under the response" not in above


@pytest.mark.full
def test_without_scatter_no_bars_are_claimed(plain: Selection) -> None:
    above, below = (" ".join(said) for said in bands_in_words(plain, plain.test))
    assert "Error bars" not in above and "from neighbouring lines" in below


@pytest.mark.full
def test_a_model_that_misses_is_told_by_factors_and_its_ranges_are_marked(
    wrong: Selection, train: FrequencyResponse, test: FrequencyResponse
) -> None:
    assert not wrong.explanation.explains
    assert any(m.outside > 0.8 for m in misfits(wrong, train, test))
    assert "a factor " in " ".join(bands_in_words(wrong, train, test)[0])
    found = residuals(wrong, train, test)
    text = found.svg.decode()
    assert "missed by more than the scatter" in text and "Amplitude [dB]" in text
    assert "var(--force)" in found.inline and "Residuals outside the scatter" in found.title


@pytest.mark.full
def test_distortion_lies_under_the_response(multisine: Selection, panel: Axes) -> None:
    (s,) = series_of(multisine.described, multisine.task, multisine.test, None)
    panel.set_xscale("log")
    panel.set_xlim(5.0, 200.0)
    panel.set_ylim(3.0, 2000.0)
    beneath(panel, s, 3.0)
    drawn = {line.get_label(): line for line in panel.lines}
    assert set(drawn) == {"odd distortion", "even distortion", "noise"}
    even, odd = (
        np.median(np.asarray(drawn[f"{kind} distortion"].get_ydata())) for kind in ("even", "odd")
    )
    assert even > 5 * odd  # a square makes even ones
    assert panel.get_ylim()[0] < even < 3.0 and panel.get_ylim()[1] == 2000.0
    assert "Under the response" in " ".join(bands_in_words(multisine, multisine.test)[0])


@pytest.mark.full
def test_no_rounding_is_drawn_as_distortion(multisine: Selection, panel: Axes) -> None:
    (s,) = series_of(multisine.described, multisine.task, multisine.test, None)
    assert s.measured.distortion is not None
    panel.set_xlim(5.0, 200.0)
    panel.set_ylim(3.0, 2000.0)
    beneath(
        panel,
        replace(s, measured=replace(s.measured, distortion=s.measured.distortion.times(1e-9))),
        3.0,
    )
    assert not panel.lines and panel.get_ylim() == (3.0, 2000.0)


@pytest.mark.parametrize("count", [5, MANY, 4000])
def test_many_levels_become_root_mean_squares_of_near_ones(count: int) -> None:
    hertz = np.linspace(1.0, 500.0, count)
    at, levels = gather(hertz, np.full(count, 0.3))
    assert len(at) == len(levels) <= MANY and levels == pytest.approx(0.3)
    assert hertz[0] <= at[0] and at[-1] <= hertz[-1] and np.all(np.diff(at) > 0)


@pytest.mark.full
def test_the_fit_in_percent_is_said_and_exported(
    selection: Selection, plain: Selection, train: FrequencyResponse, test: FrequencyResponse
) -> None:
    plainly = selection_to_dict(selection)["fit_percent"]
    assert 95 < plainly["train"] < 100 and 95 < plainly["test"] < 100
    said = fit_in_words(selection, train, test)
    assert said.startswith(
        f"fit: {plainly['train']:.4g} % of the training data, {plainly['test']:.4g} % of the test"
        " data ("
    )
    assert selection_to_dict(plain)["fit_percent"]["test"] is None


@pytest.mark.parametrize(
    ("low", "high", "said"),
    [
        (0.0, 12.3, "0 to 12"),
        (898.99, 904.19, "899.0 to 904.2"),
        (1e-9, 2e-9, "1.0·10⁻⁹ to 2.0·10⁻⁹"),
        (-1.0, 1.0, "-1.0 to 1.0"),
    ],
)
def test_intervals_show_digits_of_their_width(low: float, high: float, said: str) -> None:
    assert between(low, high) == said
