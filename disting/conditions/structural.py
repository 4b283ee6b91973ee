"""Conditions 8 and 9 (section 4.4): sufficient, from the model structure.

Why they are sound: setting the missing elements to zero carries the larger model's transfer
function into the smaller one's, so the set of behaviours of the submodel lies in the closure of
the other's. Both closures are irreducible; of equal dimension (number of determinable parameters)
they are equal.
"""

from dataclasses import replace

from disting.algebra.certainty import Grade, graded
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.profile import Profile, profile
from disting.behaviour.sample import Representation
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import SUBMODEL, SUPERMODEL
from disting.conditions.side import AnySide
from disting.evidence.conditions import Embedding, Supermodel

NO_ELEMENTS = "of general models no elements are left out"
NO_THIRD = f"{NO_ELEMENTS}, and under several experiments no third model is measured"


def condition_8(left: AnySide, right: AnySide) -> Finding:
    """Cond. 8: "One model is a submodel of the other and both have the same number of determinable
    parameters. Submodel means that model structures are identical except for missing elements such
    as springs, dampers and masses."
    """
    if left.n_elements is None or right.n_elements is None:
        return Finding(SUBMODEL, Outcome.INAPPLICABLE, note=NO_ELEMENTS)
    if left.n_elements == right.n_elements:
        return Finding(
            SUBMODEL,
            Outcome.INAPPLICABLE,
            note="neither is a submodel: both have equally many elements",
        )
    left_is_part = left.n_elements < right.n_elements
    part, whole = (left, right) if left_is_part else (right, left)
    numbering = part.part_of(whole)
    if numbering is None:
        return Finding(SUBMODEL, Outcome.INAPPLICABLE, note="neither is a submodel of the other")
    profiles = [s.profile(Representation.TF, 0) for s in (left, right)]
    if profiles[0].rank != profiles[1].rank:
        return Finding(
            SUBMODEL,
            Outcome.FAILS,
            note=f"{profiles[0].rank} and {profiles[1].rank} determinable parameters",
        )
    evidence = Embedding(left_is_part, tuple(sorted(numbering.items())), profiles[0].rank)
    return Finding(SUBMODEL, Outcome.HOLDS, *_grade(profiles), evidence)


def condition_9(left: AnySide, right: AnySide) -> Finding:
    """Cond. 9: "The two models are submodels of a third model and all three models have the same
    number of determinable parameters." The third model has the elements of both; force and sensor
    must be at the same places.
    """
    a, b = left.structure, right.structure
    if a is None or b is None:
        return Finding(SUPERMODEL, Outcome.INAPPLICABLE, note=NO_THIRD)
    if (a.ports, a.sensor_order, a.dead_time) != (b.ports, b.sensor_order, b.dead_time):
        return Finding(
            SUPERMODEL,
            Outcome.INAPPLICABLE,
            note="force or sensor differ, so no common supermodel keeps both",
        )
    third = a.united(b)
    if third in (a, b):
        return Finding(
            SUPERMODEL, Outcome.INAPPLICABLE, note="one is a submodel of the other (condition 8)"
        )
    profiles = [s.profile(Representation.TF, 0) for s in (left, right)]
    profiles.append(
        profile(ChainModel(third), Representation.TF, 0, replace(left.settings, subset_limit=0))
    )
    ranks = [p.rank for p in profiles]
    if len(set(ranks)) > 1:
        return Finding(
            SUPERMODEL,
            Outcome.FAILS,
            note=f"{ranks[0]}, {ranks[1]} and {ranks[2]} determinable parameters",
        )
    return Finding(
        SUPERMODEL, Outcome.HOLDS, *_grade(profiles), Supermodel(third.parameters, ranks[0])
    )


def _grade(profiles: list[Profile]) -> Grade:
    return graded(all(p.rank_proven for p in profiles), min(p.safety for p in profiles) - 2)
