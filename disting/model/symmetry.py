"""Symmetries that hold for every parameter value: renamings of condition 6 that need no search.

With a gap, the receptance is the sum of the grounded row's (between `act_minus` and `meas_minus`)
and the free row's (between `act_plus` and `meas_plus`). Each row is reciprocal on its own (A(s)
is symmetric, so is its inverse), and the free row may be mirrored: mass i becomes mass n_gap + 1
+ N_B - i. So every chain has up to eight equivalent forms, with the same transfer function after a
renaming of the parameters, over complex, real and positive parameters alike.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache
from itertools import product

from disting.errors import InputError
from disting.model.chain import Chain, Element

REMEMBERED = 4096  # canonical forms; everything about a pair asks for them again


class Symmetry(StrEnum):
    """One of the three generators.

    >>> Symmetry.REFLECTION.value
    'reflection of the free part'
    """

    RECIPROCITY_FREE = "reciprocity of the free part"
    RECIPROCITY_GROUNDED = "reciprocity of the grounded part"
    REFLECTION = "reflection of the free part"


@dataclass(frozen=True, slots=True)
class Form:
    """An equivalent `chain`, the symmetries that lead to it, and the renaming {given parameter:
    parameter here}.
    """

    chain: Chain
    symmetries: tuple[Symmetry, ...]
    renaming: dict[str, str]


@lru_cache(maxsize=REMEMBERED)
def forms(chain: Chain) -> tuple[Form, ...]:
    """The (up to eight) equivalent forms of a chain, the chain itself first. Raises InputError for
    one with a damper across the gap.

    >>> len({form.chain for form in forms(Chain(3, 0, 0, 1, 0, 2, damped=False))})
    4
    """
    refuse_gap_damper(chain)
    return tuple(
        Form(_move_chain(chain, chosen), chosen, _renaming(chain, chosen)) for chosen in _choices()
    )


@lru_cache(maxsize=REMEMBERED)
def canonical(chain: Chain) -> Form:
    """The equivalent form with the smallest indices and ground dampers: equal for chains that
    are renamings by symmetry. Raises InputError as `forms` does.
    """
    refuse_gap_damper(chain)
    moved = {chosen: _move_chain(chain, chosen) for chosen in _choices()}
    best = min(
        moved, key=lambda chosen: (moved[chosen].indices, moved[chosen].ground_dampers, len(chosen))
    )
    return Form(moved[best], best, _renaming(chain, best))


def between(left: Chain, right: Chain) -> tuple[dict[str, str], tuple[str, ...]] | None:
    """The renaming {left parameter: right parameter} to the common canonical form and back, and the
    names of the symmetries behind it; None where there is no such form.

    >>> renaming, symmetries = between(*(Chain(2, 0, 0, i, 0, i, damped=False) for i in (1, 2)))
    >>> renaming["m1"], symmetries
    ('m2', ('reflection of the free part',))
    """
    there, here = canonical(left), canonical(right)
    if there.chain != here.chain:
        return None
    back = {new: old for old, new in here.renaming.items()}
    used = set(there.symmetries) ^ set(here.symmetries)
    return (
        {name: back[there.renaming[name]] for name in left.parameters},
        tuple(sorted(symmetry.value for symmetry in used)),
    )


def refuse_gap_damper(chain: Chain) -> None:
    """Raise InputError for a chain that the class of the paper does not have: neither symmetries
    nor theorems on chains hold of it.
    """
    if chain.gap_damper:
        raise InputError(
            "verdicts on chains know no damper across the gap, such as d12: compare the structure"
            " as a network (disting.network.chains.of_chain)"
        )


def _choices() -> Iterator[tuple[Symmetry, ...]]:
    for chosen in product((False, True), repeat=3):
        yield tuple(s for s, on in zip(Symmetry, chosen, strict=True) if on)


def _move_chain(chain: Chain, symmetries: tuple[Symmetry, ...]) -> Chain:
    act, meas = chain.act_plus, chain.meas_plus
    act_minus, meas_minus = chain.act_minus, chain.meas_minus
    if Symmetry.RECIPROCITY_FREE in symmetries:
        act, meas = meas, act
    if Symmetry.RECIPROCITY_GROUNDED in symmetries:
        act_minus, meas_minus = meas_minus, act_minus
    mirrored = Symmetry.REFLECTION in symmetries

    def fold(i: int) -> int:
        """Where mass i is after the reflection."""
        return chain.gap + 1 + chain.n_masses - i if mirrored and i > chain.gap else i

    return replace(
        chain,
        act_minus=act_minus,
        act_plus=fold(act),
        meas_minus=meas_minus,
        meas_plus=fold(meas),
        ground_dampers=tuple(fold(i) for i in chain.ground_dampers),
    )


def _renaming(chain: Chain, symmetries: tuple[Symmetry, ...]) -> dict[str, str]:
    mirrored = Symmetry.REFLECTION in symmetries
    renaming = {
        e.parameter: _fold_element(e, chain, mirrored).parameter for e in chain.structure.elements
    }
    return renaming | {p: p for p in chain.parameters if p not in renaming}


def _fold_element(element: Element, chain: Chain, mirrored: bool) -> Element:
    """Where reflection of the free row takes an element: a joint between i and i+1 goes to
    between fold(i+1) and fold(i).
    """
    if not mirrored or element.at <= chain.gap:
        return element
    last = chain.n_masses - (element.kind in "kd")
    return element._replace(at=chain.gap + 1 + last - element.at)
