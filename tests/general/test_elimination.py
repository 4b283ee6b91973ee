"""Common zeros of two equations in two unknowns against Groebner bases of SymPy, and signs of
polynomials against their values.
"""

import random
from fractions import Fraction

import pytest
import sympy as sp

from disting.general.elimination import branches
from disting.general.orthant import Orthant, value_at
from disting.model.question import Domain

P, X, Y = 0, 2, 3  # positions of the first given and of both unknowns


def drawn(ring, draw):
    """A polynomial of low degree in everything, with both unknowns."""
    terms = [
        ring.number(draw.choice([-3, -2, -1, 1, 2, 3]))
        * ring.product(g ** draw.randint(0, 2) for g in ring.generators[: Y + 1])
        for _ in range(4)
    ]
    return sum(terms, ring.number(0))


def in_sympy(polynomial, point):
    """At given numbers, in x and y."""
    x, y = sp.symbols("x y")
    total = sp.Integer(0)
    for e, c in polynomial.to_dict().items():
        number = sp.Integer(int(c)) * sp.prod(sp.Rational(v) ** int(e[i]) for i, v in point.items())
        total += number * x ** int(e[X]) * y ** int(e[Y])
    return sp.expand(total)


@pytest.mark.full
@pytest.mark.parametrize("seed", range(12))
def test_branches_hold_all_common_zeros(seed):
    """The squarefree polynomial that x satisfies is the same as that of the ideal, and y too."""
    draw, ring = random.Random(seed), Orthant(2, 2, Domain.COMPLEX)
    x, y = sp.symbols("x y")
    for _ in range(99):  # the first pair of which all branches have a line
        one, other = (drawn(ring, draw).factor()[1][-1][0] for _ in range(2))
        if one != other and all(e.degrees()[X] and e.degrees()[Y] > 1 for e in (one, other)):
            found = branches(ring, one, other)
            if all(b.line for b in found.open):
                break
    else:
        pytest.fail("hardly any branch has a line")
    point = {0: Fraction(draw.randint(2, 40), 7), 1: Fraction(draw.randint(2, 40), 11)}
    seen = list(found.open)
    given = [in_sympy(e, point) for e in (one, other)]
    basis = sp.groebner(given, x, y, order="grevlex")
    for branch in seen:
        position, rest, factor = branch.line
        kept, out = (x, y) if position == Y else (y, x)
        low, top, bottom = (in_sympy(p, point) for p in (branch.factor, rest, factor))
        for e in given:  # every zero of the branch is one of both
            numerator = sp.together(e.subs(out, -top / bottom)).as_numer_denom()[0]
            assert sp.rem(numerator, low, kept) == 0
    position = seen[0].line[0] if seen else Y
    kept, out = (x, y) if position == Y else (y, x)
    if basis.exprs == [1]:
        assert not seen
        return
    alone = sp.groebner(given, out, kept, order="lex").exprs[-1]
    mine = sp.prod(in_sympy(b.factor, point) for b in seen)
    wanted = sp.sqf_part(sp.Poly(alone, kept)).monic()
    assert wanted == sp.sqf_part(sp.Poly(mine, kept)).monic()


def test_a_sign_that_a_discriminant_shows():
    ring = Orthant(3, 0, Domain.POSITIVE)
    a, b, c, _ = ring.generators
    assert ring.sign(a**2 - a * b + b**2) == 1
    assert ring.sign(-(a**2) + a * b - b**2) == -1
    assert ring.sign((a - b) ** 2 + a * c) == 1
    assert ring.sign(((a - b) ** 2 + a * b) * c - c * a * b + c**2) == 1
    for open_ in ((a - b) ** 2, a**2 - 3 * a * b + b**2, a - b, (a - b) ** 2 - a * c):
        assert ring.sign(open_) == 0
    assert Orthant(3, 0, Domain.REAL).sign(a**2 - a * b + b**2) == 0


@pytest.mark.thin(1)
@pytest.mark.parametrize("seed", range(40))
def test_a_sign_is_that_of_all_values(seed):
    draw, ring = random.Random(seed), Orthant(3, 0, Domain.POSITIVE)
    gens = ring.generators[:3]
    terms = [
        draw.choice([-2, -1, 1, 2, 3, 5]) * ring.product(g ** draw.randint(0, 2) for g in gens)
        for _ in range(draw.randint(2, 6))
    ]
    polynomial = sum(terms, ring.number(0)) ** draw.choice([1, 1, 2]) + draw.randint(0, 2)
    sign = ring.sign(polynomial)
    for _ in range(60):
        point = {i: Fraction(1 << draw.randint(0, 16), 256) for i in range(3)}
        assert sign * value_at(polynomial, point) > 0 or not sign
