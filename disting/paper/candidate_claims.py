"""Claims at the end of section 5.2: dead time, lag and dampers to the base (Fig. 14)."""

from collections import Counter
from dataclasses import replace
from itertools import combinations

from disting.catalogs.dampers import DamperSets, spell
from disting.model.chain import Chain
from disting.model.family import Family
from disting.paper.claim import Claim, Findings, Observation, Observed
from disting.verdict.query import Query, View
from disting.verdict.result import Relation, Verdict

SIZES = (1, 2, 3, 4)


def dead_time(findings: Findings) -> Observed:
    """Models with a dead time against the same without."""
    verdicts = [
        _compared(findings, chain, replace(chain, dead_time=True))
        for chain in Family(3, damped=True)
    ]
    return Observed(
        f"all {len(verdicts)} pairs are distinguishable",
        _all_distinguishable(verdicts),
        _with_and_without("delay"),
    )


def lag(findings: Findings) -> Observed:
    """Models with a first-order lag against the same without, and against each other model
    without.
    """
    family = Family(3, damped=True)
    same = [_compared(findings, chain, replace(chain, lag=True)) for chain in family]
    every = [_compared(findings, a, replace(b, lag=True)) for a in family for b in family]
    return Observed(
        f"all {len(same)} pairs are distinguishable by condition {same[0].decided_by}, and so is"
        f" every model with a lag from every model without ({len(every)} pairs)",
        _all_distinguishable(same)
        and _all_distinguishable(every)
        and {v.decided_by for v in same} == {"1"},
        _with_and_without("lag"),
    )


def _with_and_without(extra: str) -> tuple[Observation, ...]:
    """The first of the pairs of models without and with an extra."""
    return (Observation(3, True, ("1", f"1+{extra}")),)


def figure_14(findings: Findings) -> Observed:
    """The single dampers of the eleven damped 3-mass models."""
    counts = Counter[Relation]()
    located = list[int]()
    for number, chain in enumerate(Family(3, damped=True), 1):
        table = findings.dampers(chain)
        relations = [table.relation(*pair) for pair in combinations(table.sets, 2)]
        counts.update(relations)
        if set(relations) == {Relation.DISTINGUISHABLE}:
            located.append(number)
    return Observed(
        f"{counts.total()} pairs: {counts[Relation.DISTINGUISHABLE]} distinguishable,"
        f" {counts[Relation.INDISTINGUISHABLE]} not; no damper and every single one are told apart"
        f" in {', '.join(f'A{i}' for i in located)} only",
        1 in located and counts[Relation.UNDECIDED] == 0,
        (Observation(3, True, dampers=True),),
    )


def candidates(findings: Findings) -> Observed:
    """All sets of base dampers of the candidates of Fig. 1 (force and sensor at mass 1)."""
    tables = [findings.dampers(Chain(n, damped=True), DamperSets.ALL) for n in SIZES]
    relations = [t.relation(*pair) for t in tables for pair in combinations(t.sets, 2)]
    return Observed(
        f"all {len(relations)} pairs of sets of base dampers for 1 to {SIZES[-1]} masses are"
        " distinguishable",
        set(relations) == {Relation.DISTINGUISHABLE},
        tuple(Observation(n, True, ("1",), dampers=True) for n in SIZES),
    )


def model_a3(findings: Findings) -> Observed:
    """Base dampers of A3 (force at mass 1, sensor at mass 3)."""
    groups = findings.dampers(Family(3, damped=True)[3], DamperSets.ALL).classes()
    classes = "; ".join(", ".join(map(spell, group)) for group in groups)
    return Observed(
        f"told apart are only no damper and any: {classes}",
        [len(g) for g in groups] == [1, 7],
        (
            Observation(3, True, ("3", "3+b1"), dampers=True),
            Observation(3, True, ("3+b1", "3+b2"), dampers=True),
        ),
    )


def _compared(findings: Findings, left: Chain, right: Chain) -> Verdict:
    engine = findings.engine
    return engine.verdict(
        engine.subject("left", left),
        engine.subject("right", right),
        Query(View.EXACT, inclusion=False),
    )


def _all_distinguishable(verdicts: list[Verdict]) -> bool:
    return {v.relation for v in verdicts} == {Relation.DISTINGUISHABLE}


CANDIDATE_CLAIMS = (
    Claim(
        key="dead-time",
        place="Section 5.2",
        text=(
            "“delay time cannot be confused with a fractional polynomial TF, unless the order is"
            " very high”"
        ),
        printed="distinguishable",
        check=dead_time,
        reason="An exponential is no rational function, of whatever order.",
    ),
    Claim(
        key="lag",
        place="Section 5.2",
        text=(
            "“the first-order hold model leads to augmented models that are distinguishable from"
            " the original models in all eleven cases”"
        ),
        printed="all eleven",
        check=lag,
        reason="Read as the first-order lag of the torque control.",
    ),
    Claim(
        key="figure-14",
        place="Section 5.2, Fig. 14",
        text=(
            "“For each of the eleven 3-mass systems it is shown which combinations of dampers are"
            " distinguishable …”"
        ),
        printed="figure lost",
        check=figure_14,
        reason="The figure is lost; what the text says of it holds.",
    ),
    Claim(
        key="candidates-distinguishable",
        place="Section 5.2",
        text=(
            "“the set of candidate models was chosen appropriately with distinguishable models"
            " only”"
        ),
        printed="all distinguishable",
        check=candidates,
        reason="Conditions 1 to 9 leave some of these pairs open; the exact decision settles them.",
    ),
    Claim(
        key="a3",
        place="Section 5.2",
        text=(
            "“for other system, e.g. A3 it would not be possible to determine the correct positions"
            " of dampers”"
        ),
        printed="not possible",
        check=model_a3,
    ),
)
