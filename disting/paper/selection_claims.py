"""Claims of section 3: candidates, and what a selection depends on."""

import numpy as np

from disting.fit import Plant, figure_1
from disting.fit.results.selection import CRITERIA, sweep
from disting.model.chain import Chain
from disting.paper.claim import Claim, Findings, Observed, name_list
from disting.paper.cost_claims import DRIVE, DRIVE_VALUES, OMEGA, TABLE_1

STEP = 1e-5


def candidates(findings: Findings) -> Observed:
    """Size of the candidate set."""
    number = len(figure_1())
    return Observed(
        f"{number} = Σ 2^N sets of ground dampers × 2 (lag) × 2 (dead time), N = 1 to 4",
        number == 120,
    )


def sizes(findings: Findings) -> Observed:
    """N_p of the four best models that are named."""
    named_models = ((3, (2,)), (4, (1,)), (3, (3,)), (2, (2,)))
    counts = [
        len(Chain(n, damped=True, ground_dampers=b, dead_time=True).parameters)
        for n, b in named_models
    ]
    return Observed(name_list(counts), counts == [9, 12, 9, 6])


def table_1(findings: Findings) -> Observed:
    """Whether every value of Table 1 keeps its threshold."""
    beyond = [
        f"{value} > {limit}"
        for limits, *beds in TABLE_1
        for bed in beds
        for limit, value in zip(limits, bed, strict=True)
        if value > limit
    ]
    return Observed(
        f"17 of 18 values; {', '.join(beyond)} (condition index, test bed 2, second row)",
        not beyond,
    )


def numerical_sensitivity(findings: Findings) -> Observed:
    """Closed-form derivatives of a 4-mass candidate with everything, against central
    differences of logarithms.
    """
    plant = Plant(DRIVE.structure, OMEGA)
    gradient = plant.logarithmic_gradient(DRIVE_VALUES)[1] * DRIVE_VALUES[:, None]
    steps = np.exp(STEP * np.eye(len(DRIVE_VALUES)))
    ahead, behind = plant.response(DRIVE_VALUES * steps), plant.response(DRIVE_VALUES / steps)
    exact = np.allclose(np.log(ahead / behind) / (2 * STEP), gradient, rtol=1e-5, atol=1e-7)
    return Observed(
        "closed forms for every size: two tridiagonal solves a frequency give G and all its"
        " derivatives",
        not exact,
    )


def thresholds(findings: Findings) -> Observed:
    """Steps of N_p with rising thresholds, on the demonstration drive."""
    steps = [np.diff(sweep(findings.selection.candidates, c).n_parameters) for c in CRITERIA]
    rises, falls = (sum(int((sign * s > 0).sum()) for s in steps) for sign in (1, -1))
    comparison = (
        f"simulated demonstration drive: with rising thresholds N_p rises {rises} times and falls"
        f" {falls} times"
    )
    return Observed(comparison, rises > falls)


TEST_BEDS = "It depends on measurements of the authors' test beds, which are not published."
SELECTION_CLAIMS = (
    Claim(
        key="candidates",
        place="Section 3.1",
        text="“a maximum of 4 masses are considered (120 different models)”",
        printed="120",
        check=candidates,
    ),
    Claim(
        key="sizes",
        place="Section 3.1",
        text=(
            "The best models, such as “a 3-mass system with additional damper to the base at mass 2"
            " and delay time”, have 9, 12, 9 and 6 estimation parameters."
        ),
        printed="9, 12, 9 and 6",
        check=sizes,
    ),
    Claim(
        key="numerical",
        about="Derivatives for large models",
        place="Section 3.1",
        text=(
            "4-mass models “often require numerical sensitivity matrix calculation due to TF"
            " complexity”"
        ),
        printed="numerical differentiation",
        check=numerical_sensitivity,
        reason=(
            "The transfer function is never expanded: its derivatives are products of two solutions"
            " of the same linear equations."
        ),
    ),
    Claim(
        key="table-1",
        about="Values against their thresholds",
        place="Table 1",
        text="Every best model fulfils the thresholds of its setting.",
        printed="18 values within their thresholds",
        check=table_1,
        reason="Either a digit of the table is wrong, or the comparison allowed for rounding.",
    ),
    Claim(
        key="thresholds",
        place="Section 3.2, Figs. 5 and 6",
        text=(
            "“mostly the number of parameters increases as the threshold increases. Exceptions"
            " exist …”"
        ),
        printed="mostly increases",
        check=thresholds,
        reason="Checked on other data than the paper's.",
    ),
    Claim(
        key="test-bed-1",
        place="Section 3.1, Fig. 3",
        text="Test bed 1: three masses, damper at mass 2 and delay time, for all three settings.",
        printed="3 masses, b2, delay",
        reason=TEST_BEDS,
    ),
    Claim(
        key="test-bed-2",
        place="Section 3.1, Fig. 4",
        text="Test bed 2: four masses, three or two, depending on the thresholds.",
        printed="4, 3 or 2 masses",
        reason=TEST_BEDS,
    ),
    Claim(
        key="values",
        place="Table 1",
        text="The values of the criteria of the best models.",
        printed="18 values",
        reason=TEST_BEDS,
    ),
    Claim(
        key="edge",
        place="Section 3.2, Figs. 7 and 8",
        text="“The graphs of testbed 1 show a clear edge at approx. 60 models.”",
        printed="about 60",
        reason=TEST_BEDS,
    ),
    Claim(
        key="hours",
        place="Section 3.1",
        text="The calculation takes about seven hours, for at most three masses 35 minutes.",
        printed="7 h, 35 min",
        reason=(
            "It depends on the authors' program and computer; here a selection takes seconds to a"
            " minute."
        ),
    ),
)
"""In the paper's order, what depends on the test beds last."""
