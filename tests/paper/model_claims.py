"""Claims of section 5.1: which models there are, and how they are numbered.
Claims at the end of section 5.2: dead time, lag and dampers to the base (Fig. 14).
"""

from collections import Counter
from dataclasses import replace
from itertools import combinations

from disting import Chain, Family, Quantity, Query, Relation, Verdict, View
from disting.catalogs.dampers import DamperSets, spell
from disting.model.chain import Indices, violations
from tests.paper.claim import Claim, Findings, Observation, Observed, families, models, name_list

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


FIGURE_9 = Indices(3, 1, 1, 3, 0, 2)


def table_2(findings: Findings) -> Observed:
    """Sizes of the families."""
    sizes = [len(Family(n, damped=False)) for n in range(1, 11)]
    return Observed(
        f"{name_list(sizes[:5])}; going on {name_list(sizes[5:])} for 6 to 10 masses",
        sizes[:5] == [1, 3, 11, 29, 73],
        families(1, 2, 3, 4, 5),
    )


def numbering(findings: Findings) -> Observed:
    """Both printed hints at the order of Table 3: A3 has fewest coefficients, 11 and 13 of four
    masses differ in the gap.
    """
    sizes = coefficients(findings, damped=True)
    left, right = Family(4, damped=False)[11], Family(4, damped=False)[13]
    holds = (
        [i for i, n in enumerate(sizes, 1) if n == 7] == [3]
        and left != right
        and replace(left, gap=right.gap) == right
    )
    return Observed(
        "order of (n_gap, n_act−, n_act+, n_meas−, n_meas+): both hold",
        holds,
        models(3, [3], damped=True) + models(4, [11, 13]),
    )


def figure_9(findings: Findings) -> Observed:
    """Which constraints the example of Fig. 9 breaks."""
    broken = [c.name for c in violations(FIGURE_9, (36, 37, 38))]
    return Observed(
        "the sensor's condition of (37) and both of (38) are broken",
        broken == ["sensitivity", "reciprocity-breaking", "reflection-breaking"],
    )


def figure_1_models(findings: Findings) -> Observed:
    """The candidates of Fig. 1 among the families."""
    is_first = [Family(n, damped=True)[1] == Chain(n, damped=True) for n in (1, 2, 3, 4)]
    return Observed(
        "the candidate without base dampers is model 1 of its family, and collocated",
        all(is_first),
        tuple(seen for n in (1, 2, 3, 4) for seen in models(n, [1], damped=True)),
    )


def collocated_models(findings: Findings) -> Observed:
    """Collocated models: their force and sensor share both points."""
    marked = [row.number for row in findings.catalog(3, damped=False).rows if row.chain.collocated]
    same = [
        i
        for i, c in enumerate(Family(3, damped=False), 1)
        if (c.act_minus, c.act_plus) == (c.meas_minus, c.meas_plus)
    ]
    return Observed(f"models {name_list(marked)}", marked == same, models(3, marked))


def coefficients(findings: Findings, *, damped: bool) -> list[int]:
    """Non-constant coefficients of the 3-mass models."""
    return [len(p.form) for p in findings.engine.profiles_of(Family(3, damped))]


def sensors(findings: Findings) -> Observed:
    """Markov parameters of position and velocity sensors, moved by two places and one."""
    moved = []
    for damped in (False, True):
        for chain in Family(3, damped):
            shapes = [
                {
                    int(label[1:]) - shift
                    for label in _series(findings, replace(chain, quantity=sensor), 12 + shift)
                }
                for sensor, shift in (
                    (Quantity.ACCELERATION, 0),
                    (Quantity.VELOCITY, 1),
                    (Quantity.POSITION, 2),
                )
            ]
            moved.append(shapes[0] == shapes[1] == shapes[2])
    return Observed(
        "non-constant Markov parameters move by one (two) places in all 22 models",
        all(moved),
        families(3) + families(3, damped=True),
    )


def _series(findings: Findings, chain: Chain, count: int) -> frozenset[str]:
    (profile,) = findings.engine.profiles_of([chain], markov=count)
    return profile.form


FAMILY_CLAIMS = (
    Claim(
        key="table-2",
        place="Table 2",
        text="“Number of possible models for different numbers of masses”, 1 to 5.",
        printed="1, 3, 11, 29 and 73",
        check=table_2,
    ),
    Claim(
        key="numbering",
        place="Table 3, section 5.2",
        text=(
            "A3 alone has 7 non-constant coefficients; 4-mass models 11 and 13 have the same"
            " actuator and sensor location, but a different gap."
        ),
        printed="A3; 11 and 13",
        check=numbering,
        reason=(
            "Table 3 itself did not survive in the text; this order fits every statement that names"
            " a model."
        ),
    ),
    Claim(
        key="figure-9",
        place="Section 5.1, Fig. 9",
        text=(
            "“In the example in Fig. 9 the second condition [of (37)] is violated”; “In Fig. 9 both"
            " rules [(38)] are violated.”"
        ),
        printed="second of (37), both of (38)",
        check=figure_9,
    ),
    Claim(
        key="figure-1",
        place="Section 5",
        text=(
            "“Figure 1 represents a special case with single-sided force input and collocated"
            " measurement.”"
        ),
        printed="special case",
        check=figure_1_models,
    ),
    Claim(
        key="collocated",
        place="Table 3",
        text=(
            "“Collocated systems, i.e. sensor and actuator at the same position, are marked with an"
            " asterisk.”"
        ),
        printed="asterisks, lost with the table",
        check=collocated_models,
    ),
    Claim(
        key="sensors",
        place="Section 5.2",
        text=(
            "“For velocity (position) sensors, the same results can be obtained, except that the"
            " Markov parameters and TF coefficients are shifted by one (two) …”"
        ),
        printed="shifted by one (two)",
        check=sensors,
    ),
)
