"""Dampers to the ground and lags: planted solutions come back, numbers agree with theory, and
with the other engine.
"""

from dataclasses import replace
from itertools import combinations

import pytest
from flint import acb, fmpq, fmpq_poly
from hypothesis import given, settings, strategies as st

from disting import Query, View, compare
from disting.decide.identifiability.tangent import proof_tangents
from disting.fibres.ideals import coefficient_map
from disting.fibres.synthesis.decide import decide, rational_point
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.methods import is_covered
from disting.fibres.synthesis.task import Confirmation, Fibre, Status, Target, target
from disting.fibres.synthesis.theorems import is_untested
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.question import Answer, Membership
from disting.model.row import rows_of
from disting.verdict.engine import Engine
from tests.decide.identifiability.oracle import solutions


def rubbed(n: int, damped: bool) -> list[Chain]:
    """All models with any set of dampers to the ground."""
    sets = [chosen for size in range(n + 1) for chosen in combinations(range(1, n + 1), size)]
    return [replace(chain, ground_dampers=chosen) for chain in Family(n, damped) for chosen in sets]


def covered(chain: Chain) -> bool:
    return all(map(is_covered, rows_of(chain.structure)))


def own_fibre(chain: Chain, seed: str = "friction") -> tuple[dict[str, fmpq], Fibre]:
    point = rational_point(chain, seed)
    return point, fibre(chain, target(chain.structure, point))


def hits(found: Fibre, point: dict[str, fmpq]) -> int:
    return sum(
        all(s.values[name].overlaps(acb(v)) for name, v in point.items()) for s in found.solutions
    )


def plain_receptance(chain: Chain, values: dict[str, fmpq]) -> tuple[fmpq_poly, fmpq_poly]:
    """Numerator and denominator from the picture alone: determinants by Leibniz' formula,
    Cramer's rule.
    """
    n, s = chain.n_masses, fmpq_poly([0, 1])
    a = [[fmpq_poly([0]) for _ in range(n + 1)] for _ in range(n + 1)]
    for name, value in values.items():
        if name[0] in "mb":
            i = int(name[1:])
            a[i][i] += value * (s * s if name[0] == "m" else s)
        elif name[0] in "kd":
            i, j, w = int(name[1]), int(name[2]), value * (s if name[0] == "d" else s**0)
            for p, q, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
                a[p][q] += sign * w
    matrix = [row[1:] for row in a[1:]]
    force = [int(i == chain.act_plus) - int(i == chain.act_minus) for i in range(1, n + 1)]
    sensor = [int(i == chain.meas_plus) - int(i == chain.meas_minus) for i in range(1, n + 1)]
    num = fmpq_poly([0])
    for i in range(n):
        replaced = [
            [fmpq_poly([force[r]]) if c == i else matrix[r][c] for c in range(n)] for r in range(n)
        ]
        num += sensor[i] * determinant(replaced)
    den = determinant(matrix) * (1 + values["T1"] * s if "T1" in values else s**0)
    return num, den


def determinant(matrix: list[list[fmpq_poly]]) -> fmpq_poly:
    if not matrix:
        return fmpq_poly([1])
    minors = ([row[:j] + row[j + 1 :] for row in matrix[1:]] for j in range(len(matrix)))
    return sum(
        ((-1) ** j * matrix[0][j] * determinant(m) for j, m in enumerate(minors)), fmpq_poly([0])
    )


@pytest.mark.full
@pytest.mark.parametrize(
    ("n", "damped", "lag"), [(2, True, False), (2, False, False), (2, True, True), (3, True, False)]
)
def test_a_planted_solution_is_found_again(n: int, damped: bool, lag: bool) -> None:
    for chain in (replace(c, lag=lag) for c in rubbed(n, damped) if covered(c)):
        point, found = own_fibre(chain)
        full = max(t.rank for t in proof_tangents(chain.structure, "friction", 2)) == len(
            chain.parameters
        )
        assert found.status is (Status.COMPLETE if full else Status.INFINITE), chain
        assert hits(found, point) == full, chain
        if full:
            assert all(s.confirmation is Confirmation.SUBSYSTEM for s in found.solutions), chain


@pytest.mark.slow
@pytest.mark.parametrize(("damped", "lag"), [(False, False), (True, True), (False, True)])
def test_a_planted_solution_of_three_masses_is_found_again(damped: bool, lag: bool) -> None:
    for chain in (replace(c, lag=lag) for c in rubbed(3, damped) if covered(c)):
        point, found = own_fibre(chain)
        assert found.status in (Status.COMPLETE, Status.INFINITE), chain
        assert hits(found, point) == (found.status is Status.COMPLETE), chain


def test_what_is_covered_without_dampers_beside_the_springs() -> None:
    assert sum(covered(c) for c in rubbed(3, False)) == 61


def test_what_is_covered() -> None:
    """All damped 3-mass models but force and sensor at both ends, and two of force and sensor
    at neighbours.
    """
    left = [c for c in rubbed(3, True) if not covered(c)]
    assert len(left) == 12
    distant = [c for c in left if c.meas_plus - c.act_plus == 2]
    assert len(distant) == 8
    assert {(c.indices[2:], c.ground_dampers) for c in left if c not in distant} == {
        ((0, 1, 0, 2), (1, 2)),
        ((0, 1, 0, 2), (1, 3)),
        ((0, 2, 0, 3), (1, 3)),
        ((0, 2, 0, 3), (2, 3)),
    }
    assert (
        fibre(left[0], target(left[0].structure, rational_point(left[0], "x"))).status
        is Status.NOT_COVERED
    )


@pytest.mark.parametrize(
    "chain",
    [
        Chain(2, damped=True, ground_dampers=(1, 2)),
        Chain(3, 0, 0, 2, 0, 2, ground_dampers=(1, 3), lag=True, damped=False),
        Chain(3, 1, 1, 2, 1, 2, damped=True, ground_dampers=(1, 3)),
        Chain(3, 0, 0, 1, 0, 2, damped=True, ground_dampers=(1, 2, 3)),
    ],
)
def test_solutions_have_the_receptance_judged_by_plain_determinants(chain: Chain) -> None:
    """Midpoints rounded to fractions: num den' - num' den is small against its terms."""
    point, found = own_fibre(chain)
    num, den = plain_receptance(chain, point)
    at = fmpq(7, 3)
    exact = num(at) / den(at)
    for solution in (s for s in found.solutions if s.real is Answer.YES):
        rounded = {
            name: fmpq(round(float(v.real.mid()) * 2**60), 2**60)
            for name, v in solution.values.items()
        }
        ours = plain_receptance(chain, rounded)
        ratio = (ours[0](at) / ours[1](at)) / exact
        assert abs(int(ratio.p) / int(ratio.q) - 1) < 1e-9


@pytest.mark.full
@pytest.mark.parametrize(
    ("chain", "count"),
    [
        (Chain(2, damped=True, ground_dampers=(1, 2)), 2),
        (Chain(3, damped=True, ground_dampers=(1, 2, 3)), 12),
        (Chain(3, 0, 0, 2, 0, 2, damped=True, ground_dampers=(1, 2, 3)), 24),
        (Chain(3, 0, 0, 1, 0, 2, damped=True, ground_dampers=(2, 3)), 18),
        (Chain(3, 0, 0, 2, 0, 2, ground_dampers=(2,), damped=False), 2),
        (Chain(3, ground_dampers=(1, 2, 3), damped=False), 1),
    ],
)
def test_numbers_of_solutions(chain: Chain, count: int) -> None:
    """Stationary points: 2 for one mass, 6 * 2 for two; 2 * 2 on both sides of the middle mass,
    times 6 shares of the zeros.
    """
    assert (
        len(own_fibre(chain)[1].solutions) == len(own_fibre(chain, "other")[1].solutions) == count
    )


@pytest.mark.full
@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "chain",
    [
        Chain(2, damped=True, ground_dampers=(1, 2)),
        Chain(2, meas_plus=2, damped=True, ground_dampers=(1,)),
        Chain(2, 1, 1, 2, 1, 2, damped=True, ground_dampers=(2,)),
        Chain(3, 0, 0, 2, 0, 2, ground_dampers=(1, 3), damped=False),
        Chain(3, 0, 0, 2, 0, 3, ground_dampers=(1, 2), damped=False),
        Chain(3, 0, 0, 2, 0, 2, damped=True, ground_dampers=(2,)),
    ],
)
def test_numbers_of_solutions_agree_with_plain_groebner_bases(chain: Chain) -> None:
    assert len(own_fibre(chain)[1].solutions) == solutions(chain)


def test_parallel_dampers_are_a_family_of_halves() -> None:
    chain = Chain(2, 1, 1, 2, 1, 2, damped=True, ground_dampers=(1,))
    point, found = own_fibre(chain)
    (solution,) = found.solutions
    assert found.status is Status.INFINITE and solution.gauges == 1
    assert solution.values["b1"].overlaps(acb((point["d01"] + point["b1"]) / 2))
    assert solution.positive is Answer.YES


def test_an_undamped_lag_is_found_exactly() -> None:
    chain = Chain(3, 0, 0, 2, 0, 2, lag=True, damped=False)
    point, found = own_fibre(chain)
    assert len(found.solutions) == 2 and all(
        s.values["T1"].overlaps(acb(point["T1"])) for s in found.solutions
    )
    damped = Chain(3, damped=True, lag=False)
    other = target(
        replace(damped, ground_dampers=(2,)).structure,
        rational_point(replace(damped, ground_dampers=(2,)), "x"),
    )
    assert fibre(chain, other).status is not Status.EMPTY
    assert fibre(replace(chain, n_masses=2, act_plus=1, meas_plus=1), other).status is Status.EMPTY


def test_a_lag_is_told_from_none() -> None:
    plain = Chain(3, damped=True, ground_dampers=(2,))
    point = rational_point(replace(plain, lag=True), "x")
    assert fibre(plain, target(replace(plain, lag=True).structure, point)).status is Status.EMPTY
    assert (
        fibre(replace(plain, lag=True), target(plain.structure, point)).status is Status.DEGENERATE
    )


def test_the_pole_at_zero_rules_out() -> None:
    """One damper stops the motion of the whole; two with the sum zero do not, so nothing is
    said of them there.
    """
    plain = Chain(2, damped=True)
    t = target(plain.structure, rational_point(plain, "test"))
    assert fibre(replace(plain, ground_dampers=(1,)), t).status is Status.EMPTY
    assert (
        fibre(replace(plain, ground_dampers=(1, 2)), t).reason
        != "the multiplicities of the pole at zero differ"
    )
    rubbing = replace(plain, ground_dampers=(2,))
    assert (
        fibre(plain, target(rubbing.structure, rational_point(rubbing, "test"))).status
        is Status.EMPTY
    )


def test_dampers_of_opposite_sign_are_found_where_their_sum_is_zero() -> None:
    chain = Chain(2, damped=True, ground_dampers=(1, 2))
    point = rational_point(chain, "test") | {"b1": fmpq(1, 3), "b2": fmpq(-1, 3)}
    found = fibre(chain, target(chain.structure, point))
    assert found.status is Status.COMPLETE and hits(found, point) == 1


@pytest.mark.parametrize(
    "chain",
    [
        Chain(3, 0, 0, 2, 0, 3, damped=True, ground_dampers=(1, 2)),
        Chain(3, 1, 1, 2, 1, 3, damped=True, ground_dampers=(2, 3)),
        Chain(3, 0, 0, 2, 0, 3, ground_dampers=(1, 2), damped=False),
        Chain(3, 0, 0, 2, 0, 2, damped=True, ground_dampers=(1, 2)),
        # the first with a mass more
        pytest.param(
            Chain(4, 0, 0, 2, 0, 3, damped=True, ground_dampers=(1, 2)), marks=pytest.mark.slow
        ),
    ],
    ids=str,
)
def test_a_sum_of_dampers_that_is_zero_is_never_called_empty(chain: Chain) -> None:
    """All methods: the pole at 0 is double there, as it is without dampers."""
    one, two = (f"b{i}" for i in chain.ground_dampers)
    point = rational_point(chain, "test")
    point[two] = -point[one]
    assert fibre(chain, target(chain.structure, point)).status is not Status.EMPTY


@pytest.mark.full
@settings(max_examples=25, deadline=None)
@given(st.data())
def test_a_model_is_never_proven_to_be_no_model_of_its_own_structure(data: st.DataObject) -> None:
    """Small integers of both signs, where poles, zeros and elements coincide often."""
    chain = data.draw(
        st.sampled_from(
            [c for n in (2, 3) for damped in (False, True) for c in rubbed(n, damped) if covered(c)]
        )
    )
    values = data.draw(
        st.lists(st.sampled_from((-3, -2, -1, 1, 2, 3, 5)), min_size=16, max_size=16)
    )
    point = {name: fmpq(v) for name, v in zip(chain.parameters, values, strict=False)}
    found = fibre(chain, target(chain.structure, point))
    assert found.status is not Status.EMPTY
    assert found.status is not Status.COMPLETE or hits(found, point) == 1


def test_special_values_are_told() -> None:
    """A coefficient of the numerator vanishes here."""
    chain = Chain(3, 0, 0, 1, 0, 2, damped=True, ground_dampers=(1,))
    point = dict(zip(chain.parameters, map(fmpq, (-2, 2, 2, -2, 2, 1, 2, 1)), strict=True))
    assert fibre(chain, target(chain.structure, point)).status is Status.DEGENERATE


def test_a_single_mass() -> None:
    for chain in (
        Chain(1, ground_dampers=(1,), damped=False),
        Chain(1, damped=True, ground_dampers=(1,), lag=True),
        Chain(1, lag=True, damped=False),
    ):
        point, found = own_fibre(chain)
        assert found.status is Status.COMPLETE and hits(found, point) == 1
        # which pole is the lag's
        assert len(found.solutions) == (2 if chain.lag and chain.ground_dampers else 1)


def test_an_element_near_zero_is_no_proof_of_emptiness() -> None:
    less, more = (Chain(3, damped=True, ground_dampers=dampers) for dampers in ((3,), (1, 3)))
    found = fibre(more, target(less.structure, rational_point(less, "test")))
    assert found.status is Status.DEGENERATE and found.tests.boundary


def test_friction_is_never_untested() -> None:
    assert (
        is_untested(Chain(3, damped=False))
        and not is_untested(Chain(3, ground_dampers=(1,), damped=False))
        and not is_untested(Chain(3, lag=True, damped=False))
    )


def test_a_dead_time_is_left_out() -> None:
    chain = Chain(2, ground_dampers=(1,), damped=False)
    t = target(chain.structure, rational_point(chain, "x"))
    assert fibre(replace(chain, dead_time=True), t).status is Status.NOT_COVERED
    assert isinstance(t, Target)


def comparable(models: list[Chain]) -> list[tuple[Chain, Chain]]:
    """Pairs of equal rank and degrees."""
    kinds = [
        (
            max(t.rank for t in proof_tangents(c.structure, "kind", 2)),
            coefficient_map(c.structure).degrees,
        )
        for c in models
    ]
    return [
        (models[i], models[j])
        for i, j in combinations(range(len(models)), 2)
        if kinds[i] == kinds[j]
    ]


def agreements(pairs: list[tuple[Chain, Chain]]) -> dict[Membership, int]:
    """How many pairs are decided how; each decision must be that of the conditions and the
    ideals.
    """
    engine, counts = Engine(), dict.fromkeys(Membership, 0)
    said = {Membership.MEMBER: "indistinguishable", Membership.EXCLUDED: "distinguishable"}
    for left, right in pairs:
        found = decide(left, right)
        counts[found.membership] += 1
        other = compare(left, right, query=Query(View.EXACT), engine=engine).relation.value
        assert said.get(found.membership, other) == other, (left, right)
    return counts


@pytest.mark.full
def test_both_engines_agree_on_a_sample_of_the_88_models() -> None:
    counts = agreements(comparable(rubbed(3, True))[::40])
    assert counts[Membership.MEMBER] and counts[Membership.EXCLUDED] > 8


@pytest.mark.slow
@pytest.mark.parametrize(("damped", "expected"), [(True, (127, 487, 23)), (False, None)])
def test_both_engines_agree_on_all_88_models(
    damped: bool, expected: tuple[int, ...] | None
) -> None:
    counts = agreements(comparable(rubbed(3, damped)))
    assert expected is None or tuple(counts[m] for m in Membership) == expected
    assert counts[Membership.EXCLUDED] > 300
