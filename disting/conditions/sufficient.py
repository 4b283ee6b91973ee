"""Conditions 6 and 7 (section 4.1): sufficient for indistinguishability on open sets of the
complex parameter space.
"""

from itertools import islice

from disting.algebra.certainty import Certainty
from disting.algebra.colouring import renamings
from disting.behaviour.profile import Profile
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import FREE_CHOICE, RENAMING
from disting.conditions.side import AnySide
from disting.evidence.conditions import FreeChoice, Renaming

INCOMPLETE = "fewer than N_S1 + N_S2 Markov parameters are not exhaustive"
CANDIDATES = 50  # of a renaming that are verified; a colouring leaves one or two in practice


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
    return _searched(left, right)


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


def _searched(left: AnySide, right: AnySide) -> Finding:
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
