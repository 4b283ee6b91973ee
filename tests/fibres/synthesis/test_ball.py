"""Roots in balls: each ball holds its root, sharp where it is asked to be."""

import pytest
from flint import acb, acb_poly, ctx

from disting.fibres.synthesis.branch import Imprecise, enclose, roots

with ctx.workprec(192):
    KNOWN = (acb(-3) / 7, acb(-1, 2) / 3, acb(-1, -2) / 3, acb(1) / 3, acb(7) / 5)
SHARP, WIDE = 2.0**-150, 2.0**-90


def polynomial():
    return acb_poly.from_roots(list(KNOWN))


def matched(found):
    """The ball of each known root."""
    met = [[z for z in found if z.overlaps(w)] for w in KNOWN]
    assert [len(zs) for zs in met] == [1] * len(KNOWN) == [1] * len(found)
    return [z for (z,) in met]


def test_roots_are_sharp_but_those_that_are_excluded():
    with ctx.workprec(192):
        every = matched(roots(polynomial(), 5))
        assert all(float(z.rad()) < SHARP for z in every)
        some = matched(roots(polynomial(), 5, lambda z: bool(z.real > 0)))
        is_sharp = [float(z.rad()) < SHARP for z in some]
        assert is_sharp == [bool(w.real < 0) for w in KNOWN]
        assert all(wide.overlaps(sharp) for wide, sharp in zip(some, every, strict=True))


def test_wide_balls_hold_the_same_roots():
    with ctx.workprec(192):
        sharp, wide = matched(roots(polynomial(), 5)), matched(enclose(polynomial(), 5))
        assert all(
            float(w.rad()) > WIDE and w.overlaps(s) for w, s in zip(wide, sharp, strict=True)
        )


def test_double_roots_are_never_told_apart():
    with ctx.workprec(192), pytest.raises(Imprecise):
        roots(acb_poly.from_roots([acb(1), acb(1), acb(2)]), 3)
