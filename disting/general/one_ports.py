"""One-ports of two kinds of elements (RC, RL, LC), and all models like them: the theorems of
Foster and Cauer.

Let K(n, at_oo, at_0) be the set of all F(s) = [k_oo] + [k_0/s] + sum k_i/(s + a_i) of order n with
positive k and positive distinct a_i, the terms in brackets present or not as stated: the impedances
of RC one-ports with n capacitors.

LEMMA. F in K(n, at_oo, at_0) exactly if H = 1/(s F) is of such a form with a constant where F has
none, a pole at 0 where F has none, and positive coefficients. Proof. Between two poles F falls
strictly from +oo to -oo, as F' < 0, so it has one zero there; left of all poles it falls from k_oo
to -oo: one zero more if k_oo > 0, none else; right of all poles F > 0. These are as many zeros as
the numerator has, so all are simple, real, negative. At a zero -b the residue of H is 1/(-b
F'(-b)) > 0; H has the residue 1/F(0) > 0 at 0 if F is finite there, none else; at oo it is 1/(s F)
= 1/(k_0 + sum k_i) > 0 if k_oo = 0, else
0. So H is of this form. As F = 1/(s H), the converse is the same statement.

THEOREM. K is the set of all (1) F as above (Foster); (2) 1/F = [c s] + [g] + sum k_i s/(s + b_i),
positive (Foster), c where k_oo is absent, g where k_0 is; (3) F = [r_0] + 1/(c_1 s + 1/(r_1 +
1/(c_2 s + ..))), positive, ending with r_n, or with c_n s where F has a pole at 0 (Cauer). Proof.
(2) is the lemma. (3) Let F in K have k_oo = 0, and H = c + H', c = H(oo) > 0. For H' = 0 F = 1/(c
s). Else H' is of the form of the lemma without constant, so F' = 1/(s H') has a constant r > 0, F
= 1/(c s + 1/F'), and F' - r is 0 or in K of order n - 1 without constant; so on. Backwards every
step leads from K into K.

A model whose coordinates in (1), (2) or (3) are fractions of its parameters, positive for all of
them, and reach all positive values (see `sections`), gives exactly the F in K, except those with
equal a_i in (1). Two such models with the same K give the same transfer functions. For RL one-ports
F is G/s, for LC ones F(s^2) is G or G/s: one G for one F.
"""

from collections.abc import Iterator
from dataclasses import replace

from flint import fmpz_mpoly

from disting.algebra.symbols import RationalFunction, factorise
from disting.general.cases import cases_of
from disting.general.elimination import Case
from disting.general.matrix_model import Model, Terms
from disting.general.orthant import Orthant, TooMuch
from disting.general.sections import cover, sections
from disting.model.question import Domain

CoefficientsInS = list[fmpz_mpoly]
"""Coefficients of s^0, s^1, .. in the parameters."""
ORDER = 5
TERMS = 150  # of a coefficient: quotients of larger ones would take seconds


def same_one_ports(left: Model, right: Model) -> bool:
    """Return True if both models give, for positive parameters, all functions of the same set K."""
    for change in (_plain, _over_s, _square_variable):
        model, other = change(left), change(right)
        if model and other and _kind(model) == _kind(other) and fills(model) and fills(other):
            return True
    return False


def fills(model: Model) -> bool:
    """Return True if coordinates of K are fractions of the parameters that are positive and reach
    all positive values.
    """
    order, at_oo, at_0 = _kind(model)
    count = 2 * order + at_oo - at_0
    if (
        not 0 < order <= ORDER
        or not order - 1 <= model.degrees[0] <= order
        or len(model.parameters) < count
    ):
        return False
    ring = Orthant(count, len(model.parameters), Domain.POSITIVE)
    num, den = (
        [ring.lifted(c, count) for c in side]
        for side in (model.numerator_terms, model.denominator_terms)
    )
    return any(_reaches(ring, way(ring, num, den)) for way in (_foster, _dual_foster, _cauer))


def _kind(model: Model) -> tuple[int, bool, bool]:
    """Order, and whether there are a constant at infinity and a pole at 0."""
    top, bottom = model.degrees
    return bottom, top == bottom, not model.denominator_terms[0]


def _reaches(ring: Orthant, coordinates: list[RationalFunction] | None) -> bool:
    if coordinates is None or len(coordinates) != ring.n_given:
        return False
    if any(ring.sign(c.num) * ring.sign(c.den) <= 0 for c in coordinates):
        return False
    equations = tuple(c.num - p * c.den for c, p in zip(coordinates, ring.generators, strict=False))
    try:
        search = cases_of(ring, Case(equations), tuple(ring.unknowns))
        return cover(
            ring,
            [s for case in search.cases if not case.equations for s in sections(search, case)[0]],
        )
    except TooMuch:
        return False


def _foster(
    ring: Orthant, num: CoefficientsInS, den: CoefficientsInS
) -> list[RationalFunction] | None:
    """k_oo, k_0, and all k_i and a_i, where the denominator has linear factors."""
    functions = [RationalFunction(num[-1], den[-1])] if len(num) == len(den) else []
    s = ring.generators[ring.path]
    top, bottom = (
        sum((c * s**i for i, c in enumerate(side)), ring.number(0)) for side in (num, den)
    )
    if max(len(top), len(bottom)) > ring.terms:
        return None
    for factor, power in factorise(bottom)[1]:
        if not factor.degrees()[ring.path]:
            continue
        if factor.degrees()[ring.path] > 1 or power > 1:
            return None
        e, d = ring.coefficients(factor, ring.path)
        above, below = (_at(ring, side, -e, d) for side in (top, bottom // factor))
        functions += [above / below / RationalFunction(d, ring.number(1))]
        functions += [] if e.is_zero() else [RationalFunction(e, d)]
    return functions


def _dual_foster(
    ring: Orthant, num: CoefficientsInS, den: CoefficientsInS
) -> list[RationalFunction] | None:
    """The same of H = den/(s num)."""
    return (
        _foster(ring, den[1:], num)
        if den[0].is_zero()
        else _foster(ring, den, [ring.number(0), *num])
    )


def _cauer(
    ring: Orthant, num: CoefficientsInS, den: CoefficientsInS
) -> list[RationalFunction] | None:
    """r_0, c_1, r_1, .. of the continued fraction; None where the degrees do not fall one by
    one.
    """
    polynomial = ring.number(1)
    top, bottom = ([RationalFunction(c, polynomial) for c in side] for side in (num, den))
    functions, zero = list[RationalFunction](), RationalFunction(ring.number(0), polynomial)
    if len(top) == len(bottom):
        functions.append(top[-1] / bottom[-1])
        top = _less(top, functions[-1], bottom)[:-1]
    while top:
        large = any(len(side) > TERMS for c in (*top, *bottom) for side in (c.num, c.den))
        if large or top[-1].num.is_zero() or len(top) != len(bottom) - 1:
            return None
        functions.append(bottom[-1] / top[-1])
        bottom = _less(bottom, functions[-1], [zero, *top])[:-1]
        if len(bottom) == 1 and bottom[0].num.is_zero():
            break
        if bottom[-1].num.is_zero():
            return None
        functions.append(top[-1] / bottom[-1])
        top = _less(top, functions[-1], bottom)[:-1]
    return functions


def _less(
    side: list[RationalFunction], factor: RationalFunction, other: list[RationalFunction]
) -> list[RationalFunction]:
    """side - factor * other, of equal lengths."""
    return [a - factor * b for a, b in zip(side, other, strict=True)]


def _at(
    ring: Orthant, polynomial: fmpz_mpoly, num: fmpz_mpoly, den: fmpz_mpoly
) -> RationalFunction:
    value, degree = ring.put(polynomial, ring.path, num, den)
    return RationalFunction(value, den**degree)


def _plain(model: Model) -> Model | None:
    return model


def _over_s(model: Model) -> Model | None:
    """G/s in lowest terms."""
    top, bottom = model.numerator_terms, model.denominator_terms
    if not top[0]:
        return replace(model, numerator_terms=top[1:])
    return replace(model, denominator_terms=((), *bottom))


def _square_variable(model: Model) -> Model | None:
    """F with F(s^2) = G or G/s, if there is one."""
    for changed in (model, _over_s(model)):
        if (
            changed
            and not any(_odd(changed.numerator_terms))
            and not any(_odd(changed.denominator_terms))
        ):
            return replace(
                changed,
                numerator_terms=changed.numerator_terms[::2],
                denominator_terms=changed.denominator_terms[::2],
            )
    return None


def _odd(coefficients: tuple[Terms, ...]) -> Iterator[Terms]:
    return iter(coefficients[1::2])
