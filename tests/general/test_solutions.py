"""How many parameter vectors fit and what is determined, against SymPy's Gröbner bases at a
random point.
"""

import pytest
import sympy as sp

from disting import Domain
from disting.algebra.symbols import RationalFunction
from disting.general.any_model import of_network
from disting.general.global_identifiability import global_identifiability
from disting.general.matrix_model import Model
from disting.general.orthant import Orthant
from disting.general.solutions import _real_bounds
from disting.general.vectors import Vector, are_same
from disting.network import network_of

TF = Model.from_transfer_function
MODELS = [
    (TF("c", "(s + a)*(s + b)"), 2, ("c",)),
    (TF("u", "s + u**2*v"), 1, ("u", "v")),
    (TF("a", "s**2 + a**2*s + b**3"), 3, ("a",)),
    (TF("x*y", "s**2 + (x + y)*s + z"), 2, ("z",)),
    (Model.from_state_space([["-k12-k01", 0], ["k12", "-k02"]], [1, 0], [0, 1]), 2, ("k12",)),
    (Model.from_state_space([["-k12-k01", "k21"], ["k12", "-k21"]], [1, 0], [0, 1]), 2, ("k12",)),
    (TF("a**2", "s + b"), 2, ("b",)),
    (TF("a", "s**2 + b*s + a*b"), 1, ("a", "b")),
]


def vectors(model):
    """Number of solutions at a point, as the dimension of the algebra of a radical ideal (no
    double solutions there).
    """
    symbols = sp.symbols(model.parameters)
    values = dict(
        zip(symbols, (sp.Rational(7, 3), sp.Rational(5, 2), sp.Rational(11, 13)), strict=False)
    )
    sides = [sp.sympify(str(c).replace("^", "**")) for c in (*model.numerator, *model.denominator)]
    lead = sides[-1]
    equations = [sp.expand(c * lead.subs(values) - c.subs(values) * lead) for c in sides[:-1]]
    solutions = sp.solve([e for e in equations if e != 0], symbols, dict=True)
    return solutions, values, symbols


@pytest.mark.full
@pytest.mark.parametrize(("model", "count", "unique"), MODELS)
def test_numbers_against_sympy(model, count, unique):
    found = global_identifiability(model)
    assert (found.count, found.unique, found.is_infinite) == (count, unique, False)
    solutions, values, symbols = vectors(model)
    assert len(solutions) == count
    same = [
        x.name for x in symbols if all(sp.simplify(sol[x] - values[x]) == 0 for sol in solutions)
    ]
    assert tuple(same) == unique


@pytest.mark.full
def test_combinations_are_determined_and_independent():
    model = TF(["k"], ["m", "d", "k"])
    found = global_identifiability(model)
    assert found.is_infinite and found.count is None and found.combinations == ("k/m", "d/m")
    assert found.sentence == "3 parameters, only 2 determinable: k/m, d/m."
    k, m, d = sp.symbols("k m d")
    jacobian = sp.Matrix([sp.sympify(c) for c in found.combinations]).jacobian([k, m, d])
    assert jacobian.rank() == found.local.rank == 2


def test_a_product_is_determined_and_its_factors_are_not():
    found = global_identifiability(TF("a*b", "s + c"))
    assert (found.unique, found.combinations, found.local.identifiable) == (
        ("c",),
        ("c", "a*b"),
        ("c",),
    )


def test_what_is_not_known_is_said():
    found = global_identifiability(TF("1", "(s + a)*(s + b)*(s + c)"))
    assert found.count in (None, 6) and not found.is_infinite and found.unique == ()


def test_a_vector_presupposes_its_denominators():
    """c = a/(d - 1)^2 at d = 1 is none: five values of d are left, (b - d^3)(d - 1)^2 = a^2."""
    found = global_identifiability(TF(["c*(d-1)**2"], ["1", "c**2*(d-1)**2+d**3"]))
    assert (found.count, found.unique, found.is_infinite) == (5, (), False)


@pytest.mark.full
def test_a_solution_that_is_too_large_to_write_down_is_not_counted():
    bridge = of_network(network_of("C1 1 2; R1 1 3; C2 2 3; R2 2 0; R3 3 0"))
    found = global_identifiability(bridge)
    assert (found.count, found.is_infinite, found.unique) == (None, False, ())
    assert "how many sets of them fit is not known" in found.sentence


def test_values_at_the_roots_of_one_equation_are_compared_modulo_it():
    ring = Orthant(1, 2, Domain.REAL)
    p, x, _, _ = ring.generators
    one, root = ring.number(1), x**2 - p

    def vector(num, den=one, equation=root):
        return Vector((None, RationalFunction(num, den)), equation, 1)

    assert are_same(vector(x), vector(p, x))  # x = p/x
    assert are_same(vector(x), vector(x, equation=-root))
    assert not are_same(vector(x), vector(-x))
    assert not are_same(vector(x), vector(x, equation=x**2 - 2 * p))
    assert not are_same(vector(x), Vector((None, RationalFunction(x, one)), None, -1))
    assert [
        _real_bounds(ring, e, 1, n) for e, n in ((root, 2), (x**2 + p**2 + 1, 2), (x**3 - p, 3))
    ] == [
        (0, 2),
        (0, 0),
        (1, 3),
    ]
