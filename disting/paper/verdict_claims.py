"""Claims of section 5.2 on the verdicts on 3-mass models without damping: Fig. 10, both
representations, and what holds with damping too.
"""

from itertools import combinations

import numpy as np

from disting.conditions.finding import Outcome as Holding
from disting.conditions.sufficient import condition_7
from disting.model.chain import Sensor
from disting.model.family import Family
from disting.paper.claim import (
    Claim,
    Findings,
    Observed,
    counts_of,
    families,
    in_words,
    models,
    open_pairs,
    pairs,
)
from disting.verdict.query import View
from disting.verdict.result import Relation

BOTH = families(3) + families(3, damped=True)


def same_pictures(findings: Findings) -> Observed:
    """Verdicts on 3 masses with every sensor quantity, in every view of the paper, with and
    without damping.
    """
    equal = [
        np.array_equal(
            findings.picture(3, damped, view).decided_by,
            findings.picture(3, damped, view, sensor=sensor).decided_by,
        )
        for damped in (False, True)
        for view in (View.TF, View.MARKOV, View.COMBINED)
        for sensor in (Sensor.POSITION, Sensor.VELOCITY)
    ]
    return Observed("the same condition decides in every field", all(equal), BOTH)


def figure_10_left(findings: Findings) -> Observed:
    """Undamped, transfer functions."""
    counts = counts_of(findings.picture(3, False, View.TF))
    return Observed(in_words(counts), "" not in counts, families(3))


def figure_10_right(findings: Findings) -> Observed:
    """Undamped, 8 Markov parameters: what is left open is what the transfer function proves
    indistinguishable.
    """
    series = findings.picture(3, False, View.MARKOV, 8)
    by = findings.picture(3, False, View.TF)
    same = {
        (i + 1, j + 1)
        for i, j in combinations(range(len(by.subjects)), 2)
        if by.relation(i, j) is Relation.INDISTINGUISHABLE
    }
    return Observed(
        f"{in_words(counts_of(series))}: exactly the {len(same)} indistinguishable pairs",
        open_pairs(series) == same,
        pairs(3, sorted(same)),
    )


def fewer_than_eight(findings: Findings) -> Observed:
    """Undamped, 7 against 8 Markov parameters."""
    eight, seven = (len(open_pairs(findings.picture(3, False, View.MARKOV, k))) for k in (8, 7))
    return Observed(f"{seven} pairs open with 7, {eight} with 8", seven > eight, families(3))


def all_twelve(findings: Findings) -> Observed:
    """Undamped, all 12 Markov parameters."""
    counts = counts_of(findings.picture(3, False, View.MARKOV))
    return Observed(
        f"all 12 are computed modulo primes: {in_words(counts)}", "6" not in counts, families(3)
    )


def no_additional_information(findings: Findings) -> Observed:
    """Undamped pairs that only Markov parameters decide."""
    gained = open_pairs(findings.picture(3, False, View.TF)) - open_pairs(
        findings.picture(3, False, View.MARKOV, 8)
    )
    return Observed(
        f"{len(gained)} pairs more", not gained, pairs(3, sorted(gained)) or families(3)
    )


def determinable(findings: Findings) -> Observed:
    """Determinable parameters of the undamped 3-mass models."""
    ranks = [row.rank for row in findings.catalog(3, damped=False).rows]
    return Observed(
        f"5 parameters, of which {min(ranks)} to {max(ranks)} are determinable",
        set(ranks) == {5},
        models(3, [number for number, rank in enumerate(ranks, 1) if rank < 5]),
    )


def more_markov_than_parameters(findings: Findings) -> Observed:
    """Whether condition 7 decides anything from all 12 Markov parameters, undamped."""
    profiles = findings.engine.profiles_of(Family(3, damped=False), markov=12)
    more = [len(p.form) > p.rank for p in profiles]
    holds = [condition_7(*pair).outcome is Holding.HOLDS for pair in combinations(profiles, 2)]
    said = (
        f"so in {sum(more)} of {len(more)} models with all 12 Markov parameters; condition 7 holds"
        f" for {sum(holds)} pairs"
    )
    return Observed(said, all(more) and not any(holds), families(3))


VERDICT_CLAIMS = (
    Claim(
        key="same-pictures",
        place="Section 5.2",
        text="“For velocity (position) sensors, the same results can be obtained …”",
        printed="same results",
        check=same_pictures,
    ),
    Claim(
        key="figure-10-left",
        place="Section 5.2, Fig. 10 left",
        text=(
            "“without damping a conclusive result is obtained for all model combinations with the"
            " TFA”"
        ),
        printed="0 of 55 open",
        check=figure_10_left,
    ),
    Claim(
        key="figure-10-right",
        place="Section 5.2, Fig. 10 right",
        text=(
            "“The MPA with 8 Markov parameters produces no contradictions but it cannot prove"
            " indistinguishability of the indistinguishable models …”"
        ),
        printed="all indistinguishable pairs open",
        check=figure_10_right,
    ),
    Claim(
        key="determinable",
        about="Number of determinable parameters",
        place="Section 5.2",
        text="“the 5 determinable parameters” (3 masses, undamped)",
        printed="5 determinable parameters",
        check=determinable,
        reason=(
            "Five is the number of parameters; several transfer functions determine fewer"
            " combinations of them."
        ),
    ),
    Claim(
        key="condition-7-markov",
        place="Section 5.2",
        text=(
            "“Condition 7 is not applicable because there are typically more non-constant moment"
            " invariants than the 5 determinable parameters”"
        ),
        printed="condition 7 not applicable",
        check=more_markov_than_parameters,
    ),
    Claim(
        key="fewer-than-8",
        place="Section 5.2",
        text=(
            "“For the case of calculating fewer Markov parameters than 8 the unknown area expands”"
        ),
        printed="expands",
        check=fewer_than_eight,
    ),
    Claim(
        key="all-12",
        about="Cost of all Markov parameters",
        place="Section 5.2",
        text="“for significantly more than 8, up to 12 the computation time would be formidable”",
        printed="out of reach",
        check=all_twelve,
        reason=(
            "At random points modulo primes all 12 take a fraction of a second for the whole"
            " family; condition 6 then applies."
        ),
    ),
    Claim(
        key="no-more",
        place="Section 5.2",
        text=(
            "“the TFA seems more powerful and the MPA provides no additional information”"
            " (undamped)"
        ),
        printed="none",
        check=no_additional_information,
    ),
)
