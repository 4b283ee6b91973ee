"""The list of claims: what each check finds, literally, and that the outcome is the documented
one.
"""

import re
from math import pi

import pytest

from disting.fit.search.candidates import figure_1
from tests.paper.claim import GIVEN, refit
from tests.paper.claims import CLAIMS, Claim, Findings, Observed, Outcome

FOUND = {
    "weights": "π² a line for either",
    "sensitivities": "the same matrices",
    "phase": "the phase error is arg(G/G_M) in (−π, π]: nothing is interpolated",
    "importance": "the length of each column S_j Δp_j, with Δp_j = p_j",
    "collinearity": (
        "γ = 1/μ, μ the smallest singular value of S̃: μ² is the smallest eigenvalue of S̃ᵀS̃. Of "
        "Table 1's 6 pairs κ, γ "
        "this reading allows 6, the printed one 0"
    ),
    "condition": "μ_max/μ_k of S̃",
    "candidates": "120 = Σ 2^N sets of ground dampers × 2 (lag) × 2 (dead time), N = 1 to 4",
    "sizes": "9, 12, 9 and 6",
    "numerical": (
        "closed forms for every size: two tridiagonal solves a frequency give G and all its"
        " derivatives"
    ),
    "table-1": "17 of 18 values; 10.3 > 10 (condition index, test bed 2, second row)",
    "table-2": "1, 3, 11, 29 and 73; going on 157, 314, 574, 993 and 1623 for 6 to 10 masses",
    "numbering": "order of (n_gap, n_act−, n_act+, n_meas−, n_meas+): both hold",
    "figure-9": "the sensor's condition of (37) and both of (38) are broken",
    "figure-1": "the candidate without base dampers is model 1 of its family, and collocated",
    "collocated": "models 1, 4, 6, 8 and 11",
    "sensors": "non-constant Markov parameters move by one (two) places in all 22 models",
    "same-pictures": "the same condition decides in every field",
    "figure-10-left": (
        "26 by condition 1, 15 by condition 4, 2 by condition 5, 2 by condition 6, 10 by condition "
        "7, 0 undecided"
    ),
    "figure-10-right": (
        "26 by condition 3, 15 by condition 4, 2 by condition 5, 12 undecided: exactly the 12 "
        "indistinguishable pairs"
    ),
    "determinable": "5 parameters, of which 3 to 5 are determinable",
    "condition-7-markov": (
        "so in 11 of 11 models with all 12 Markov parameters; condition 7 holds for 0 pairs"
    ),
    "fewer-than-8": "29 pairs open with 7, 12 with 8",
    "all-12": (
        "all 12 are computed modulo primes: 26 by condition 3, 15 by condition 4, 2 by condition 5,"
        " 2 by condition 6, 10 undecided"
    ),
    "no-more": "0 pairs more",
    "figure-11": (
        "left: 26 by condition 1, 7 by condition 4, 10 by condition 5, 2 by condition 6, 10"
        " undecided; right: 26 by condition 3, 7 by condition 4, 6 by condition 5, 16 undecided;"
        " both together leave 6, of which the exact decision finds 1 indistinguishable and 5"
        " distinguishable"
    ),
    "non-constant": "7 to 9 damped (7 for A3 only), 3 to 5 undamped",
    "beyond": "4 pairs, all distinguishable: 1-4, 4-6, 4-8 and 4-11",
    "figure-12-pair": "open by coefficients, distinguishable by condition 5 on Markov parameters",
    "figure-12-frequencies": "all four within 0.5 %",
    "figure-12-damping": "off by 27 to 54 %",
    "8-as-7": "the same condition decides in every field",
    "fewer-than-7": "22 pairs open with 6, 16 with 7",
    "condition-9": (
        "0, 2 and 11 pairs of 3, 4 and 5 masses differ in the gap alone; condition 9 holds for 0, 0"
        " and 0 of them"
    ),
    "figure-13": (
        "168 by condition 1, 151 by condition 4, 34 by condition 5, 7 by condition 6, 37 by"
        " condition 7, 9 undecided; the exact decision leaves 0"
    ),
    "eight-cases": "8 cases, all distinguishable",
    "11-and-13": "equivalent by condition 7; condition 9 has 7, 7 and 8 determinable parameters",
    "condition-6": "it decides 2 and 7 damped pairs of 3 and 4 masses",
    "2-and-8": (
        "they decide 0 pairs within the families of 1 to 5 masses; of the fields of Fig. 14"
        " condition 2 decides 0 and condition 8 8"
    ),
    "superior": "open pairs: 0, 10 and 17 against 12, 16 and 61",
    "almost-all": (
        "0, 6 and 9 pairs stay open (3 masses undamped, damped, 4 undamped); with the exact"
        " decision 0, 0 and 0"
    ),
    "dead-time": "all 11 pairs are distinguishable",
    "lag": (
        "all 11 pairs are distinguishable by condition 1, and so is every model with a lag from"
        " every model without (121 pairs)"
    ),
    "figure-14": (
        "66 pairs: 51 distinguishable, 15 not; no damper and every single one are told apart in A1,"
        " A2, A5 only"
    ),
    "candidates-distinguishable": (
        "all 155 pairs of sets of base dampers for 1 to 4 masses are distinguishable"
    ),
    "a3": "told apart are only no damper and any: 0; 1, 2, 3, 1+2, 1+3, 2+3, 1+2+3",
}
WHOLE_FIT = {
    "thresholds": (
        "simulated demonstration drive: with rising thresholds N_p rises 11 times and falls 0 times"
    )
}
DIFFERING = [
    "phase", "collinearity", "numerical", "table-1", "determinable", "all-12", "beyond", "condition-9", "eight-cases",
    "11-and-13", "condition-6", "2-and-8",
]  # fmt: skip
UNCHECKED = ["test-bed-1", "test-bed-2", "values", "edge", "hours"]


def claim(key):
    return next(c for c in CLAIMS if c.key == key)


@pytest.mark.parametrize("key", FOUND)
def test_what_a_check_finds(findings, key):
    found = claim(key).check(findings)
    assert found == Observed(FOUND[key], claim(key).outcome is Outcome.AGREES, found.seen)


@pytest.mark.slow
def test_a_fit_of_small_candidates_follows_the_thresholds_too(findings):
    assert claim("thresholds").check(findings).agrees
    assert len(findings.selection.candidates) == len(figure_1((1, 2))) == 24


@pytest.mark.slow
def test_what_the_fit_of_all_candidates_finds():
    found = claim("thresholds").check(Findings())
    assert found == Observed(WHOLE_FIT["thresholds"], agrees=True)


def test_every_claim_is_tested_once_and_its_outcome_is_the_documented_one():
    keys = [c.key for c in CLAIMS]
    assert sorted(keys) == sorted({*FOUND, *WHOLE_FIT, *UNCHECKED})
    assert [c.key for c in CLAIMS if c.outcome is Outcome.DIFFERS] == DIFFERING
    assert [c.key for c in CLAIMS if c.outcome is Outcome.UNCHECKED] == UNCHECKED


def test_what_does_not_agree_has_a_reason():
    with pytest.raises(ValueError, match="reason"):
        Claim("k", "place", "text", "printed", lambda findings: Observed("", False), about="k")
    with pytest.raises(ValueError, match="reason"):
        Claim("k", "place", "text", "printed")


def test_each_difference_has_a_label_of_its_own():
    labels = [c.about for c in CLAIMS if c.outcome is Outcome.DIFFERS]
    assert len(set(labels)) == len(labels) == len(DIFFERING)
    assert not any(re.search(r"Section|Fig\.|Table", label) for label in labels)


@pytest.mark.parametrize(
    ("d12", "d23"),
    [
        (0.1, 0.05),
        # for the dampers of Fig. 12 a claim says it too
        pytest.param(0.02, 0.2, marks=pytest.mark.slow),
        pytest.param(0.05, 0.1, marks=pytest.mark.slow),
    ],
)
def test_a4_with_the_antiresonances_of_a1_has_other_dampings(d12, d23):
    found = refit({**GIVEN, "d12": d12, "d23": d23})
    assert [m.name for m in found.modes] == [
        "antiresonance 1",
        "antiresonance 2",
        "resonance 1",
        "resonance 2",
    ]
    assert max(m.detuned for m in found.modes) < 0.01
    assert max(m.misdamped for m in found.modes) > 0.1


def test_dampers_in_proportion_to_the_springs_can_be_matched():
    """D = beta K: all damping ratios are beta omega / 2, and A4 needs the same beta only."""
    found = refit({**GIVEN, "d12": 0.1, "d23": 0.1})
    assert found.j < 1e-12
    assert max(m.misdamped for m in found.modes) < 1e-6
    beta = 1e-4
    for mode in found.modes:
        assert mode.damping[0] == pytest.approx(beta * 2 * pi * mode.frequencies[0] / 2, rel=1e-9)


def test_the_frequencies_of_the_given_a1_by_hand(findings):
    """Free masses 2 and 3 with mass 1 held: k12, k23 = 1000, m = 0.01: omega^2 = (3 -+ sqrt
    5)/2 * 1e5.
    """
    first, second = findings.refit.modes[:2]
    for mode, factor in ((first, 3 - 5**0.5), (second, 3 + 5**0.5)):
        undamped = (factor / 2 * 1e5) ** 0.5 / (2 * pi)
        assert mode.frequencies[0] == pytest.approx(undamped, rel=1e-3)
