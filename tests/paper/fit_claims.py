"""Claims of section 2: the cost function and the criteria. Claims of
section 3: candidates, and what a selection depends on.
"""

from math import pi, sqrt

import numpy as np

from disting import Chain
from disting.fit import Case, Cost, Plant, figure_1
from disting.fit.results.selection import CRITERIA, sweep
from disting.measurement import FrequencyResponse
from disting.statistics.practical import (
    collinearity_index,
    condition_indices,
    importance,
    unit_columns,
)
from tests.paper.claim import Claim, Findings, Observed, name_list

SAMPLE = np.array([[3.0, 1.0], [4.0, 2.0], [0.0, 2.0]])  # columns of lengths 5 and 3
# condition index, PII ratio, collinearity index: their thresholds, test bed 1, test bed 2
TABLE_1 = (
    ((30, 1000, 20), (6.4, 10.2, 4.0), (11.3, 12.0, 7.0)),
    ((10, 1000, 10), (6.4, 10.2, 4.0), (10.3, 7.7, 7.0)),
    ((10, 1000, 5), (6.4, 10.2, 4.0), (2.6, 7.5, 1.9)),
)
TABLE_1_SIZES = ((9, 12), (9, 9), (9, 6))  # N_p of those models (section 3.1)
DRIVE = Chain(4, damped=True, ground_dampers=(1, 3), lag=True, dead_time=True)
DRIVE_VALUES = np.array(
    [0.01, 0.02, 0.01, 0.03, 900.0, 700.0, 500.0, 0.1, 0.2, 0.05, 0.3, 0.1, 1e-3, 2e-3]
)
OMEGA = 2 * pi * np.geomspace(5.0, 300.0, 60)


def weights(findings: Findings) -> Observed:
    """Cost (14) of a factor 10 in the amplitude and of half a turn of the phase."""
    measured = FrequencyResponse(OMEGA, Plant(DRIVE.structure, OMEGA).response(DRIVE_VALUES))
    larger, turned = (
        float(Cost(measured).total(measured.G * factor)) / len(OMEGA) for factor in (10, -1)
    )
    return Observed("π² a line for either", bool(np.allclose([larger, turned], pi**2)))


def importance_index(findings: Findings) -> Observed:
    """(16) of columns of known length."""
    indices = importance(SAMPLE)
    return Observed(
        "the length of each column S_j Δp_j, with Δp_j = p_j",
        bool(np.allclose(indices, [5.0, 3.0])),
    )


def collinearity_formula(findings: Findings) -> Observed:
    """(17) against Table 1: with "singular value", kappa / gamma^2 would be mu_max, between 1
    and sqrt(N_p).
    """
    rows = [
        (row[k + 1], sizes[k])
        for row, sizes in zip(TABLE_1, TABLE_1_SIZES, strict=True)
        for k in (0, 1)
    ]
    printed = [kappa / gamma**2 >= 1 for (kappa, _, gamma), _ in rows]
    ours = [1 <= kappa / gamma <= sqrt(n) for (kappa, _, gamma), n in rows]
    smallest = np.linalg.svd(unit_columns(SAMPLE), compute_uv=False)[-1]
    as_used = np.isclose(collinearity_index(SAMPLE), 1 / np.sqrt(smallest))
    return Observed(
        "γ = 1/μ, μ the smallest singular value of S̃: μ² is the smallest eigenvalue of S̃ᵀS̃. Of"
        f" Table 1's {len(rows)} pairs κ, γ this reading allows {sum(ours)}, the printed one"
        f" {sum(printed)}",
        bool(all(printed) and as_used),
    )


def condition_index(findings: Findings) -> Observed:
    """(18) from the singular values of unit columns."""
    values = np.linalg.svd(SAMPLE / [5.0, 3.0], compute_uv=False)
    return Observed(
        "μ_max/μ_k of S̃", bool(np.allclose(condition_indices(SAMPLE), values[0] / values))
    )


def sensitivities(findings: Findings) -> Observed:
    """(13) and (15), written out as printed, against `Cost.sensitivity`; weights 1."""
    plant = Plant(DRIVE.structure, OMEGA)
    response, gradient = plant.logarithmic_gradient(DRIVE_VALUES)
    measured, absolute = FrequencyResponse(OMEGA, response), gradient * response
    along = response.imag * absolute.imag + response.real * absolute.real
    across = (response.real * absolute.imag - response.imag * absolute.real) / np.abs(response) ** 2
    printed = {
        Case.AMPLITUDE: along / np.abs(response),
        Case.LOGARITHM: along / np.abs(response) ** 2 / np.log(10),
    }
    equal = [
        np.allclose(
            Cost(measured, case, (1.0, 1.0)).sensitivity(response, gradient),
            np.concatenate([first, across], axis=-1).T,
        )
        for case, first in printed.items()
    ]
    return Observed("the same matrices", all(equal))


def phase(findings: Findings) -> Observed:
    """The phase residual of a response that turns many times, off by 0.1 rad everywhere."""
    response = Plant(DRIVE.structure, OMEGA).response(DRIVE_VALUES) * np.exp(-0.2j * OMEGA)
    error = Cost(FrequencyResponse(OMEGA, response)).residual(response * np.exp(0.1j))[len(OMEGA) :]
    turns = int(np.sum(np.abs(np.diff(np.angle(response))) > pi))
    continuous = turns > 10 and np.allclose(error, 0.1)
    return Observed(
        "the phase error is arg(G/G_M) in (−π, π]: nothing is interpolated", not continuous
    )


COST_CLAIMS = (
    Claim(
        key="weights",
        place="Section 2.3, after (14)",
        text=(
            "“… π and 1 can be chosen as weightings for amplitude and phase, respectively. Then 20"
            " dB difference in the amplitude has an equivalent effect as 180° in the phase.”"
        ),
        printed="20 dB ≙ 180°",
        check=weights,
    ),
    Claim(
        key="sensitivities",
        place="Equations (13), (15)",
        text=(
            "The sensitivities of amplitude, of its logarithm and of the phase in terms of S_r and"
            " S_i."
        ),
        printed="formulas",
        check=sensitivities,
    ),
    Claim(
        key="phase",
        about="Continuity of the phase",
        place="Section 2.3, end",
        text=(
            "“A potential problem is, however, that the measured and simulated phase must be"
            " interpolated continuous beyond ±2π.”"
        ),
        printed="must be interpolated",
        check=phase,
        reason=(
            "The difference of the phases is the argument of the quotient; neither phase has to be"
            " unwrapped."
        ),
    ),
    Claim(
        key="importance",
        place="Equation (16)",
        text="msqr parameter importance index “given by Brun et al. (2001): δ_j = ‖S_j Δp_j‖₂”",
        printed="‖S_j Δp_j‖₂",
        check=importance_index,
        reason=(
            "Brun et al. divide by the number of rows under the root; the ratio of two indices,"
            " which is thresholded, is the same."
        ),
    ),
    Claim(
        key="collinearity",
        about="Formula of the collinearity index",
        place="Equation (17)",
        text="“γ_k = 1/√λ_k … λ_k is the smallest singular value of S̃”",
        printed="smallest singular value under the root",
        check=collinearity_formula,
        reason=(
            "A misprint: with unit columns 1 ≤ μ_max ≤ √N_p, which the printed formula contradicts"
            " in every row of Table 1. Brun et al. take the smallest eigenvalue of S̃ᵀS̃."
        ),
    ),
    Claim(
        key="condition",
        place="Equation (18)",
        text="“η̃_k = μ_max/μ_k”, with the singular values of S̃",
        printed="μ_max/μ_k",
        check=condition_index,
    ),
)


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
