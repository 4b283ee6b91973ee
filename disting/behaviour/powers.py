"""Which coefficients of a transfer function vanish identically, and its degrees: known exactly,
without any chance.

Coefficients of a chain's numerator and denominator are sums of products of parameters with
positive signs (all-minors matrix-tree theorem; force and sensor cross the gap in the same sense).
Terms that all have one sign do not cancel, so a coefficient vanishes identically exactly if it is
zero at all parameters = 1, where it is an integer. Of structures in which a row holds a plus and a
minus port together, some terms of the numerator are subtracted; there the polynomials are written
out.
"""

from functools import lru_cache

from flint import fmpz_poly

from disting.algebra.symbols import coefficients
from disting.behaviour.expanded import written_out
from disting.behaviour.transfer import plain_receptance
from disting.model.structure import Structure

REMEMBERED = 4096
Powers = tuple[frozenset[int], frozenset[int]]
"""The powers of s in numerator and denominator, common ones cancelled."""


def powers(structure: Structure) -> Powers:
    """The powers of s whose coefficients do not vanish identically, of the transfer function
    without dead time.

    >>> from disting.model.chain import Chain
    >>> [sorted(p) for p in powers(Chain(2, meas_plus=2, damped=False).structure)]
    [[0], [0, 2]]
    """
    return _powers(structure)[0]


def common_power(structure: Structure) -> int:
    """The power of s that numerator (times that of the sensor) and denominator have in common
    before it is cancelled.
    """
    return _powers(structure)[1]


@lru_cache(maxsize=REMEMBERED)
def _powers(structure: Structure) -> tuple[Powers, int]:
    sides = _at_ones(structure) if is_sign_free(structure) else _written_out(structure)
    num, den = ({i for i, known in enumerate(side) if known} for side in sides)
    common = min(num | den)
    return (frozenset(i - common for i in num), frozenset(i - common for i in den)), common


def degrees(structure: Structure) -> tuple[int, int]:
    """Degrees of numerator and denominator once common powers of s are cancelled."""
    num, den = powers(structure)
    return max(num), max(den)


def zeros(structure: Structure) -> frozenset[str]:
    """Labels of the coefficients (25) up to the degrees that vanish identically."""
    sides = zip("ba", powers(structure), strict=True)
    return frozenset(
        f"{letter}{i}" for letter, known in sides for i in range(max(known)) if i not in known
    )


def is_sign_free(structure: Structure) -> bool:
    """No row holds a plus and a minus port together, so no term of the numerator is
    subtracted.
    """
    p = structure.ports
    rows = [range(first, last + 1) for first, last in structure.row_ends]
    return not any(
        (p.act_plus in s or p.meas_plus in s) and (p.act_minus in s or p.meas_minus in s)
        for s in rows
    )


def _at_ones(structure: Structure) -> tuple[list[bool], list[bool]]:
    """Which coefficients are not zero at all parameters = 1, over the integers."""
    ones = {name: fmpz_poly([1]) for name in structure.parameters}
    num, den = plain_receptance(structure, ones, fmpz_poly([0, 1]), fmpz_poly([1]))
    return [False] * structure.sensor_order + [bool(c) for c in num.coeffs()], [
        bool(c) for c in den.coeffs()
    ]


def _written_out(structure: Structure) -> tuple[list[bool], list[bool]]:
    """Which coefficients are not the polynomial 0."""
    num, den = ([not c.is_zero() for c in coefficients(p, "s")] for p in written_out(structure))
    return num, den
