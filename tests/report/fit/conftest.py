"""A measured two-mass drive, simulated: what both modules of tests look at."""

from dataclasses import replace

import numpy as np
import pytest

from disting.export import predict
from disting.fit.judge.admissible import Rule
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import figure_1
from disting.fit.select import select
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.report.fit import waterfall
from disting.report.fit.style import FigureFiles
from disting.statistics.practical import Thresholds

DRIVE = Chain(2, damped=True, ground_dampers=(2,), quantity="acceleration")  # type: ignore[arg-type]
# antiresonance 33.8 Hz, resonance 58.5 Hz
VALUES = {"m1": 0.01, "m2": 0.02, "k12": 900.0, "d12": 0.12, "b2": 0.2}
HOSTILE = """</script><img src=x onerror='alert(1)'>&amp;{{ 7*7 }} $x^2$ <!-- --"""


def response(start: int, step: int, seed: int, drive: Chain = DRIVE) -> FrequencyResponse:
    """The drive, or another with its values, between 5 and 200 Hz with 1 % noise."""
    omega = 2 * np.pi * np.geomspace(5.0, 200.0, 90)[start::step]
    noise = np.random.default_rng(seed).normal(size=(2, len(omega))) / 100
    values = {name: VALUES[name] for name in drive.parameters}
    measured = predict(drive, values, omega) * (1 + noise[0] + 1j * noise[1])
    coherence = np.full(len(omega), 0.998)
    signals = (("torque", "Nm"), (HOSTILE, "rad/s^2"))
    return FrequencyResponse(omega, measured, None, coherence, DRIVE.quantity, *signals, HOSTILE)  # type: ignore[arg-type]


@pytest.fixture(scope="session")
def train() -> FrequencyResponse:
    return response(0, 2, 1)


@pytest.fixture(scope="session")
def test() -> FrequencyResponse:
    return response(1, 3, 2)


@pytest.fixture(scope="session")
def selection(train: FrequencyResponse, test: FrequencyResponse) -> Selection:
    return select(train, [c for c in figure_1((1, 2)) if not c.lag], test=test)


@pytest.fixture(scope="session")
def starts(selection: Selection) -> FigureFiles:
    """One figure, for pages of which no figure is looked at."""
    return waterfall(selection.described)


@pytest.fixture(scope="session")
def nothing(train: FrequencyResponse) -> Selection:
    """No candidate is admissible, no test data, one parameter fixed, one at its bound; the data are
    missed by so little that no other reading of them is looked for.
    """
    strict = Thresholds(condition_index=5.0, importance_ratio=10.0, collinearity=2.0)
    candidates = [replace(DRIVE, ground_dampers=at) for at in ((), (1,), (2,))]
    return select(
        train,
        candidates,
        thresholds=strict,
        rule=Rule.PAPER,
        fix={"k12": 900.0},
        bound={"m1": (0.0, 0.0098)},
    )
