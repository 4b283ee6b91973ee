"""Claims of section 5.2 on the verdicts on 3-mass models with damping: Figs. 11 and 12."""

from collections import Counter

import numpy as np

from disting.conditions.rule import DEPENDENCES
from disting.paper.claim import (
    Claim,
    Findings,
    Observation,
    Observed,
    counts_of,
    deciding_rules,
    families,
    in_words,
    models,
    name_list,
    open_pairs,
    pairs,
)
from disting.paper.family_claims import coefficients
from disting.verdict.decisions import Pair
from disting.verdict.query import View
from disting.verdict.result import Relation

A1_A4 = (*pairs(3, [(1, 4)], damped=True), Observation(3, False, ("1", "4")))


def figure_11(findings: Findings) -> Observed:
    """Damped, both representations."""
    left, right = findings.picture(3, True, View.TF), findings.picture(3, True, View.MARKOV, 7)
    exact = Counter(
        v.relation
        for i, j, v in findings.catalog(3, damped=True).pairs(View.EXACT)
        if (i, j) in _open(findings)
    )
    return Observed(
        f"left: {in_words(counts_of(left))}; right: {in_words(counts_of(right))}; both together"
        f" leave {len(_open(findings))}, of which the exact decision finds"
        f" {exact[Relation.INDISTINGUISHABLE]} indistinguishable and"
        f" {exact[Relation.DISTINGUISHABLE]} distinguishable",
        bool(open_pairs(left)) and bool(open_pairs(right)),
        pairs(3, sorted(_open(findings)), damped=True),
    )


def _open(findings: Findings) -> set[Pair]:
    return open_pairs(findings.picture(3, True, View.COMBINED))


def non_constant(findings: Findings) -> Observed:
    """Numbers of non-constant coefficients against parameters."""
    damped, undamped = coefficients(findings, damped=True), coefficients(findings, damped=False)
    fewest = [i for i, n in enumerate(damped, 1) if n == 7]
    agrees = (min(damped), max(damped), min(undamped), max(undamped), fewest) == (7, 9, 3, 5, [3])
    return Observed(
        f"{min(damped)} to {max(damped)} damped (7 for A{name_list(fewest)} only), {min(undamped)}"
        f" to {max(undamped)} undamped",
        agrees,
        models(3, fewest, damped=True),
    )


def beyond_coefficients(findings: Findings) -> Observed:
    """Damped pairs that Markov parameters decide and coefficients do not."""
    series = findings.picture(3, True, View.MARKOV, 7)
    gained = open_pairs(findings.picture(3, True, View.TF)) - open_pairs(series)
    said = name_list([f"{i}-{j}" for i, j in sorted(gained)])
    kinds = {series.relation(i - 1, j - 1) for i, j in gained}
    return Observed(
        f"{len(gained)} pairs, all distinguishable: {said}",
        kinds != {Relation.DISTINGUISHABLE},
        pairs(3, sorted(gained), damped=True),
    )


def figure_12_pair(findings: Findings) -> Observed:
    """A1 against A4."""
    by = [
        deciding_rules(findings.picture(3, True, *how))[1, 4]
        for how in ((View.TF,), (View.MARKOV, 7))
    ]
    return Observed(
        "open by coefficients, distinguishable by condition 5 on Markov parameters",
        by == ["", DEPENDENCES.name],
        A1_A4,
    )


def figure_12_frequencies(findings: Findings) -> Observed:
    """Frequencies of A1 and of the fitted A4."""
    worst = max(mode.detuned for mode in findings.refit.modes)
    return Observed(f"all four within {100 * worst:.1f} %", worst < 0.01, A1_A4)


def figure_12_damping(findings: Findings) -> Observed:
    """Damping ratios of A1 and of the fitted A4, the best of all starts."""
    errors = [mode.misdamped for mode in findings.refit.modes]
    return Observed(
        f"off by {100 * min(errors):.0f} to {100 * max(errors):.0f} %", min(errors) > 0.1, A1_A4
    )


def eight_as_seven(findings: Findings) -> Observed:
    """Damped, 7 and 8 Markov parameters."""
    seven, eight = (findings.picture(3, True, View.MARKOV, k).decided_by for k in (7, 8))
    return Observed(
        "the same condition decides in every field",
        np.array_equal(seven, eight),
        families(3, damped=True),
    )


def fewer_than_seven(findings: Findings) -> Observed:
    """Damped, 6 against 7 Markov parameters."""
    seven, six = (len(open_pairs(findings.picture(3, True, View.MARKOV, k))) for k in (7, 6))
    return Observed(
        f"{six} pairs open with 6, {seven} with 7", six > seven, families(3, damped=True)
    )


MISREAD = (
    "“Distinguishability” is meant: with fewer than all Markov parameters only the necessary"
    " conditions can be used, and Fig. 12 shows the misfit of a pair that is told apart."
)
DAMPED_CLAIMS = (
    Claim(
        key="figure-11",
        place="Section 5.2, Fig. 11",
        text=(
            "“neither the TFA, nor the MPA with 7 Markov parameters can derive an answer to the"
            " distinguishability question for all combinations” (damped)"
        ),
        printed="both leave pairs open",
        check=figure_11,
    ),
    Claim(
        key="non-constant",
        place="Section 5.2",
        text=(
            "“the number of non-constant TF coefficients (7...9, 7 only for model A3) … Without"
            " damping … (3...5)”"
        ),
        printed="7 to 9, 7 for A3 only; 3 to 5",
        check=non_constant,
    ),
    Claim(
        key="beyond",
        about="What Markov parameters add, damped",
        place="Section 5.2",
        text=(
            "“in some cases the MPA proves indistinguishability that cannot be proved with the TFA”"
        ),
        printed="indistinguishability",
        check=beyond_coefficients,
        reason=MISREAD,
    ),
    Claim(
        key="figure-12-pair",
        place="Section 5.2, Fig. 12",
        text="A1 and A4 are such a case.",
        printed="decided by the MPA only",
        check=figure_12_pair,
    ),
    Claim(
        key="figure-12-frequencies",
        place="Section 5.2, Fig. 12",
        text="“the frequencies of resonances and antiresonances are in agreement”",
        printed="in agreement",
        check=figure_12_frequencies,
        reason=(
            "A1 with damped first coupling (Fig. 12 below); the paper's parameters are not given."
        ),
    ),
    Claim(
        key="figure-12-damping",
        place="Section 5.2, Fig. 12",
        text=(
            "“it is not possible to match the damping at all four (anti)resonances simultaneously”"
        ),
        printed="not possible",
        check=figure_12_damping,
        reason=(
            "The best fit of many starts; the proof is the verdict on A1 and A4. "
            "Dampers in proportion to the springs are an exception: then A4 matches exactly."
        ),
    ),
    Claim(
        key="8-as-7",
        place="Section 5.2",
        text="“For 8 Markov parameters the same pattern results” (damped)",
        printed="same pattern",
        check=eight_as_seven,
    ),
    Claim(
        key="fewer-than-7",
        place="Section 5.2",
        text="“6 or fewer Markov parameters lead to larger unknown areas.”",
        printed="larger",
        check=fewer_than_seven,
    ),
)
