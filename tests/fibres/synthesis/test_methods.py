"""Methods that overlap agree: two different ways to the same chains."""

import pytest
from flint import acb, ctx

from disting.fibres.synthesis.branch import (
    BOUNDARY,
    NONZERO,
    OPEN,
    Imprecise,
    RowValues,
    circle,
    combine,
    poly,
    roots,
    through,
    vanishes,
)
from disting.fibres.synthesis.damped_neighbours import inner_neighbours
from disting.fibres.synthesis.damped_next_to_end import next_to_end
from disting.fibres.synthesis.decide import rational_point
from disting.fibres.synthesis.task import target
from disting.model.chain import Chain
from disting.model.row import Row


@pytest.mark.parametrize("n", [3, 4])
def test_inner_method_finds_what_the_end_method_finds(n: int) -> None:
    chain = Chain(n, act_plus=n - 1, meas_plus=n, damped=True)
    t = target(chain.structure, rational_point(chain, "test"))
    row = Row(n, False, n - 1, n, damped=True)
    with ctx.workprec(500):
        ways = [
            [p for p in way(row, t.balls) if isinstance(p, RowValues)]
            for way in (next_to_end, inner_neighbours)
        ]
        assert len(ways[0]) == len(ways[1]) >= 1
        for found in ways[0]:
            assert any(
                all(a.overlaps(b) for a, b in zip(found.masses, other.masses, strict=True))
                for other in ways[1]
            )


def test_interpolation_returns_the_polynomial() -> None:
    p = poly([1, -2, 0, 5])
    q = through([p(d) for d in circle(3, 2.0)], 2.0)
    assert all(q[i].contains(p[i]) for i in range(4))


def test_roots_are_sharp_and_multiple_ones_refused() -> None:
    with ctx.workprec(300):
        assert all(z.rad() < 1e-60 for z in roots(poly([-2, 0, 1]), 2))
        with pytest.raises(Imprecise):
            roots(poly([1, -2, 1]), 2)


def test_a_wide_ball_proves_nothing() -> None:
    with pytest.raises(Imprecise):
        vanishes(acb(0).union(acb(1)), acb(1))


def test_combined_keeps_what_is_open_unless_a_side_is_refuted() -> None:
    def join(a: RowValues, b: RowValues) -> RowValues:
        return RowValues(a.masses + b.masses)

    assert list(combine([NONZERO], lambda: [OPEN], join)) == [NONZERO]
    assert list(combine([OPEN], lambda: [NONZERO], join)) == [NONZERO]
    assert list(combine([RowValues()], lambda: [OPEN], join)) == [OPEN]
    assert list(combine([BOUNDARY], lambda: [RowValues()], join)) == [BOUNDARY]
    assert list(combine([RowValues()], lambda: [RowValues(), NONZERO], join)) == [
        RowValues(),
        NONZERO,
    ]
