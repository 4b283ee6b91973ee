"""Conditions 6 to 9 (sections 4.1 and 4.4): sufficient for indistinguishability.

Why they are sound: setting the missing elements to zero carries the larger model's transfer
function into the smaller one's, so the set of behaviours of the submodel lies in the closure of
the other's. Both closures are irreducible; of equal dimension (number of determinable parameters)
they are equal.
"""

from dataclasses import replace
from itertools import islice

from disting.algebra.certainty import Certainty, Grade, grade_of
from disting.algebra.colouring import renamings
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.profile import Profile, profile
from disting.behaviour.sample import Representation
from disting.conditions.rule import FREE_CHOICE, RENAMING, SUBMODEL, SUPERMODEL, Finding, Outcome
from disting.conditions.side import AnySide
from disting.evidence.conditions import Embedding, FreeChoice, Renaming, Supermodel

NO_ELEMENTS = "of general models no elements are left out"
NO_THIRD = f"{NO_ELEMENTS}, and under several experiments no third model is measured"
INCOMPLETE = "fewer than N_S1 + N_S2 Markov parameters are not exhaustive"
CANDIDATES = 50  # of a renaming that are verified; a colouring leaves one or two in practice


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
    return grade_of(all(p.rank_proven for p in profiles), min(p.safety for p in profiles) - 2)


def condition_6(left: AnySide, right: AnySide, exhaustive: bool) -> Finding:
    """Cond. 6: "A renaming and permutation scheme for the parameters of the first model exists so
    that the moment invariants are identical to those of the second model in symbolic form and vice
    versa."

    Symmetries of the class first (a theorem), then a search whose result is proven by expanding
    both transfer functions.
    """
    if not exhaustive:
        return Finding(RENAMING, Outcome.INAPPLICABLE, note=INCOMPLETE)
    symmetry = left.symmetry_with(right)
    if symmetry:
        return Finding(RENAMING, Outcome.HOLDS, Certainty.THEOREM, evidence=symmetry)
    if left.colouring.fingerprint != right.colouring.fingerprint:
        return Finding(RENAMING, Outcome.FAILS, note="no renaming exists")
    return _search_renaming(left, right)


def condition_7(left: Profile, right: Profile) -> Finding:
    """Cond. 7: "The two models have as many determinable parameters as non-constant moment
    invariants and the constant moment invariants are identical across the two models."

    Full row rank at one point proves the first part. Constants are compared as the numbers that
    they are proven to be, never by residues, so that what holds is proven.
    """
    if not left.describes_all(right):
        return Finding(FREE_CHOICE, Outcome.INAPPLICABLE, note=INCOMPLETE)
    if left.form != right.form or _constants(left) != _constants(right):
        return Finding(FREE_CHOICE, Outcome.FAILS, note="the constant invariants differ")
    if not left.rank == right.rank == len(left.form):
        return Finding(
            FREE_CHOICE,
            Outcome.FAILS,
            note=(
                f"{left.rank} and {right.rank} determinable parameters for {len(left.form)}"
                " invariants"
            ),
        )
    if not all(p.proven_zeros >= _constants(p).keys() for p in (left, right)):
        return Finding(
            FREE_CHOICE, Outcome.INAPPLICABLE, note="not all constant invariants are known exactly"
        )
    free = tuple(label for label in left.labels if label in left.form)
    return Finding(
        FREE_CHOICE, Outcome.HOLDS, Certainty.PROVEN, evidence=FreeChoice(left.rank, free)
    )


def _search_renaming(left: AnySide, right: AnySide) -> Finding:
    names = left.parameters, right.parameters
    candidates = list(islice(renamings(left.columns, right.columns, len(names[0])), CANDIDATES + 1))
    for images in candidates[:CANDIDATES]:
        renaming = {name: names[1][image] for name, image in zip(names[0], images, strict=True)}
        if left.is_renamed(right, renaming):
            return Finding(
                RENAMING,
                Outcome.HOLDS,
                Certainty.PROVEN,
                evidence=Renaming(tuple(renaming.items()), ()),
            )
    if len(candidates) > CANDIDATES:
        return Finding(
            RENAMING, Outcome.ABANDONED, note=f"more than {CANDIDATES} candidate renamings"
        )
    return Finding(RENAMING, Outcome.FAILS, note="no renaming exists")


def _constants(profile: Profile) -> dict[str, str]:
    rows = zip(profile.labels, profile.free, profile.constants, strict=True)
    return {label: value for label, free, value in rows if not free and value != ""}
