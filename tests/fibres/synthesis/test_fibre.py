"""Fibres: planted solutions come back, counts are those of the theorems, special points are
told.
"""

from dataclasses import replace
from math import comb

import pytest
from flint import acb, ctx, fmpq

from disting.fibres.synthesis.damped_neighbours import degree_of
from disting.fibres.synthesis.decide import rational_point
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.methods import is_covered
from disting.fibres.synthesis.task import Confirmation, Fibre, Status, Target, target
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.question import Answer
from disting.model.row import Row, grounded_and_free, rows_of


def own_fibre(chain: Chain, seed: str = "test") -> tuple[dict[str, fmpq], Fibre]:
    point = rational_point(chain, seed)
    return point, fibre(chain, target(chain.structure, point))


def holds(fibre: Fibre, point: dict[str, fmpq]) -> int:
    return sum(
        all(s.values[name].overlaps(acb(v)) for name, v in point.items()) for s in fibre.solutions
    )


def covered(chain: Chain) -> bool:
    return all(map(is_covered, rows_of(chain.structure)))


@pytest.mark.full
@pytest.mark.parametrize("n", [2, 3, 4])
def test_a_planted_damped_solution_is_found_again(n: int) -> None:
    for chain in filter(covered, Family(n, damped=True)):
        point, found = own_fibre(chain)
        if found.status is Status.INFINITE:
            continue
        assert found.status is Status.COMPLETE, chain
        assert holds(found, point) == 1, chain
        assert all(s.confirmation is Confirmation.SUBSYSTEM for s in found.solutions), chain
        planted = next(
            s
            for s in found.solutions
            if all(s.values[p].overlaps(acb(v)) for p, v in point.items())
        )
        assert (planted.real, planted.positive) == (Answer.YES, Answer.YES)


@pytest.mark.full
@pytest.mark.parametrize("n", [2, 3, 4, 5])
def test_foster_counts_all_real_and_positive(n: int) -> None:
    for chain in Family(n, damped=False):
        grounded, free = grounded_and_free(chain.structure)
        if free.distance or (grounded is not None and grounded.distance):
            continue
        expected = comb(n - chain.gap - 1, free.a - 1)
        if grounded is not None:
            expected *= comb(n - 1, chain.gap) * comb(chain.gap - 1, grounded.a - 1)
        point, found = own_fibre(chain)
        assert len(found.solutions) == expected, chain
        assert holds(found, point) == 1
        assert all(s.positive is Answer.YES for s in found.solutions)


@pytest.mark.full
@pytest.mark.parametrize("n", [3, 4])
def test_undamped_chains_with_distant_ports_have_families(n: int) -> None:
    for chain in Family(n, damped=False):
        grounded, free = grounded_and_free(chain.structure)
        distance = free.distance + (grounded.distance if grounded else 0)
        _, found = own_fibre(chain)
        assert found.status is (Status.INFINITE if distance else Status.COMPLETE), chain
        assert all(s.gauges == distance for s in found.solutions)


def test_two_free_damped_masses_form_a_family() -> None:
    _, found = own_fibre(Chain(2, act_plus=1, meas_plus=2, damped=True))
    assert found.status is Status.INFINITE


def test_complex_solutions_come_in_pairs_and_are_neither_real_nor_positive() -> None:
    _, found = own_fibre(Family(4, damped=True)[9], "x9")
    complex_ones = [s for s in found.solutions if s.real is Answer.NO]
    assert len(complex_ones) % 2 == 0
    assert all(s.positive is Answer.NO for s in complex_ones)


def test_every_solution_reproduces_the_transfer_function() -> None:
    chain = Family(4, damped=True)[11]
    t = target(chain.structure, rational_point(chain, "test"))
    found = fibre(chain, t)
    assert len(found.solutions) > 1
    assert all(s.width < 1e-20 for s in found.solutions)


@pytest.mark.parametrize(
    ("row", "degree"),
    [
        (Row(2, True, 1, 2, damped=True), 1),
        (Row(3, True, 1, 2, damped=True), 8),
        (Row(3, True, 2, 3, damped=True), 3),
        (Row(4, True, 1, 2, damped=True), 19),
        (Row(4, True, 2, 3, damped=True), 33),
        (Row(4, True, 3, 4, damped=True), 5),
        (Row(3, False, 1, 2, damped=True), 2),
        (Row(4, False, 1, 2, damped=True), 4),
        (Row(4, False, 2, 3, damped=True), 18),
    ],
)
def test_degree_of_the_inner_equation(row: Row, degree: int) -> None:
    """The numbers are those of Groebner bases modulo a prime for random data."""
    assert degree_of(row) == degree


def test_long_inner_equations_are_solved_only_where_the_poles_are_known() -> None:
    row = Row(5, False, 2, 3, damped=True)
    assert degree_of(row) == 54
    assert is_covered(row) and not is_covered(replace(row, before=1))


@pytest.mark.slow
def test_long_inner_equations_find_the_planted_model_alone() -> None:
    chain = Chain(5, act_plus=2, meas_plus=3, damped=True)
    point = rational_point(chain, "test")
    found = fibre(chain, target(chain.structure, point))
    assert found.status is Status.COMPLETE and len(found.solutions) == 1
    with ctx.workprec(400):
        assert all(
            found.solutions[0].values[name].overlaps(acb(value)) for name, value in point.items()
        )


@pytest.mark.slow
@pytest.mark.parametrize(
    "ports", [(2, 1, 3, 2, 5), (3, 1, 4, 2, 5), (3, 1, 4, 3, 5), (3, 2, 4, 3, 5)]
)
def test_long_inner_equations_refute_models_of_smaller_rank(ports: tuple[int, ...]) -> None:
    given = Chain(5, *ports, damped=True)
    found = fibre(
        Chain(5, act_plus=2, meas_plus=3, damped=True),
        target(given.structure, rational_point(given, "test")),
    )
    assert found.status is Status.EMPTY


def test_uncovered_chains_say_so() -> None:
    _, found = own_fibre(Family(3, damped=True)[3])
    assert found.status is Status.NOT_COVERED


def test_equal_ratios_of_stiffness_and_damping_are_no_generic_point() -> None:
    """Rayleigh damping: zeros of the springs coincide; whatever comes out, it is not 'empty'."""
    for chain in (
        Chain(3, damped=True),
        Chain(3, act_plus=1, meas_plus=3, damped=True),
        Family(3, damped=True)[2],
    ):
        point = rational_point(chain, "rayleigh")
        point |= {f"d{name[1:]}": value / 3 for name, value in point.items() if name[0] == "k"}
        assert fibre(chain, target(chain.structure, point)).status is not Status.EMPTY


def test_a_damped_receptance_has_no_undamped_chain() -> None:
    chain = Chain(3, damped=True)
    t = target(chain.structure, rational_point(chain, "test"))
    assert fibre(replace(chain, damped=False), t).status is Status.EMPTY


def test_a_wrong_degree_is_an_exact_proof() -> None:
    family = Family(3, damped=True)
    t = target(family[1].structure, rational_point(family[1], "test"))
    assert fibre(family[4], t).status in (Status.EMPTY, Status.COMPLETE)
    assert fibre(family[2], t).status is Status.EMPTY
    assert fibre(family[2], t).precision_bits == 0


def test_double_poles_are_degenerate() -> None:
    chain = Family(3, damped=False)[11]
    t = target(chain.structure, rational_point(chain, "test"))
    x = type(t.denominator)([0, 0, 1])
    doubled = Target(t.numerator, x * (x + 1) * (x + 1))
    assert fibre(chain, doubled).status is Status.DEGENERATE


def test_a_fibre_is_not_true_or_false_and_cannot_contradict_itself() -> None:
    with pytest.raises(TypeError):
        bool(Fibre(Status.EMPTY))
    with pytest.raises(ValueError, match="lists solutions"):
        Fibre(Status.COMPLETE)
