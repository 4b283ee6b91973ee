"""A row of masses as a map to the factors of its receptance's numerator and to its poles, and
fibres of that map.

Force and sensor at the masses a <= b of one row: N = g theta prod_(a <= i < b) (s + h_i) phi over
D, with theta the determinant of the masses left of a, phi of those right of b, c_i = u_i + e_i s
the joints, h_i their ratio between the ports. `normalise` has ratios of masses everywhere; here
theta and phi look alike, and joints between the ports have their root as an unknown:

    left of a:   w_i = u_i + e_i s  enters row i,      r_i w_i        row i + 1  (c_i = m_i w_i)
    between:     e_i (s + h_i)      enters row i,      x_i (s + h_i)  row i + 1
    right of b:  w_i = u_i + e_i s  enters row i + 1,  r_i w_i        row i      (c_i = m_(i+1) w_i)

and f_i = b_i/m_i. The joint to a wall enters the first row alone; a damper of the first mass in
parallel is part of it.

Without dampers in the joints N has no roots between the ports: N = g theta phi, the stiffnesses
there are part of the gain, u_i enters row i and x_i row i + 1, both for themselves; the other
joints have e_i = 0. A damper of the mass at a wall has its own f_1.

For non-zero masses, springs and dampers of the joints these unknowns are quotients of products of
the elements, and the elements quotients of products of these and of one mass: a birational map, as
in `normalise`. N/g, theta, phi and D are monic.

FIBRES WITH SHARES. Let p0 be a point of one row where N has its roots in the field, all distinct.
An equivalent q of another row has the same N, so its joints between the ports, its theta and its
phi share out these roots. For one way of sharing,

    h_i = -z_i,    theta(q) = prod_left (s - rho),    phi(q) = prod_right (s - rho),    D(q) = D(p0)

has far fewer unknowns than the fibre of the coefficients. The gain g fits whatever the rest: it is
left out. For equal ranks the tangent equations are added in the coordinates h_i and the
coefficients of theta, phi and D. Near p0 they are functions of the coefficients of N/g and D,
invertible ones because the roots are distinct, and the same functions for both rows; so equal
tangent spaces remain equal: W J2(q) = 0 for W J1(p0) = 0. A factor f of N/g moves by df = d(N/g)
(N/(g f))^-1 modulo f.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from operator import mul

from flint import fmpz_mod_mpoly, fmpz_mod_mpoly_ctx, fmpz_mod_poly, fmpz_mpoly

from disting.algebra.groebner.modular import Sparse, long_polynomial, null_space
from disting.algebra.symbols import coefficients, symbols
from disting.fibres.ideals.fibre_ideal import derivative, evaluate
from disting.fibres.ideals.system import CoefficientMap, Terms, determinants, separate
from disting.model.row import Row


@dataclass(frozen=True, slots=True)
class Share:
    """Roots of the numerator that belong to theta and to phi, for the joints between the ports, in
    order.
    """

    joints: tuple[int, ...]
    left: tuple[int, ...]
    right: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class FactoredMap:
    """`joints`: positions of the h_i; coefficients of theta, phi and D but the leading ones, which
    are 1.

    D is without its factor s^k. `whole`: the receptance with its gain, the last parameter, which
    the others do not contain.
    """

    name: str
    parameters: tuple[str, ...]
    joints: tuple[int, ...]
    left: tuple[Terms, ...]
    right: tuple[Terms, ...]
    poles: tuple[Terms, ...]
    whole: CoefficientMap


@dataclass(frozen=True, slots=True)
class FactoredValues:
    """A point of a map: roots of the joints, theta, phi, D modulo the prime, and the derivatives
    (dN, dD) by each parameter.

    N is monic here.
    """

    joints: tuple[int, ...]
    left: fmpz_mod_poly
    right: fmpz_mod_poly
    numerator: fmpz_mod_poly
    poles: tuple[int, ...]
    slopes: tuple[tuple[fmpz_mod_poly, tuple[int, ...]], ...]


def row_factors(row: Row) -> FactoredMap:
    """The receptance of a row with dampers in its joints, or with dampers to the ground alone.

    >>> m = row_factors(Row(3, False, 1, 2, damped=True))
    >>> m.parameters, [len(x) for x in (m.joints, m.left, m.right, m.poles)]
    (('h1', 'e1', 'x1', 'u2', 'e2', 'r2'), [1, 0, 2, 4])
    """
    first, last = row.before + 1, row.before + row.n_masses
    a, b = _ports(row)
    names = _names(row)
    ring = symbols(["s", *names, "g"])
    added = [_entries(i, row, ring) for i in range(row.before, row.before + row.n_masses)]
    theta, phi, den = determinants(row, added, ring)
    heads = [f"h{i}" for i in range(a, b) if row.damped]
    num = reduce(mul, (ring["s"] + ring[h] for h in heads), ring["g"] * theta * phi)
    power = min(e[0] for e in den.monoms())  # of the poles at zero, which no zero cancels
    at = {name: k for k, name in enumerate(names)}
    return FactoredMap(
        name=f"masses {first}-{last}, ports {a}-{b}, {' '.join(names)}",
        parameters=names,
        joints=tuple(at[h] for h in heads),
        left=_by_power(theta),
        right=_by_power(phi),
        poles=_by_power(den // ring["s"] ** power),
        whole=separate((*names, "g"), num, den),
    )


def values(chain: FactoredMap, point: Sequence[int], modulus: int) -> FactoredValues:
    """The map and its derivatives at a point."""

    def at(coordinates: Sequence[Terms], lead: int) -> fmpz_mod_poly:
        """Their values as a polynomial in s."""
        return long_polynomial([*(evaluate(c, point, modulus) for c in coordinates), lead], modulus)

    def slope(coordinates: Sequence[Terms], by: int) -> fmpz_mod_poly:
        """The derivative of that polynomial."""
        return at([derivative(c, by) for c in coordinates], 0)

    roots = tuple(-point[h] % modulus for h in chain.joints)
    left, right = at(chain.left, 1), at(chain.right, 1)
    numerator = reduce(mul, (long_polynomial([-z, 1], modulus) for z in roots), left * right)
    slopes = []
    for by in range(len(point)):
        change = numerator // left * slope(chain.left, by) + numerator // right * slope(
            chain.right, by
        )
        if by in chain.joints:
            change += numerator // long_polynomial([point[by], 1], modulus)
        slopes.append(
            (change, tuple(evaluate(derivative(c, by), point, modulus) for c in chain.poles))
        )
    poles = tuple(evaluate(c, point, modulus) for c in chain.poles)
    return FactoredValues(
        joints=roots, left=left, right=right, numerator=numerator, poles=poles, slopes=tuple(slopes)
    )


def shared_fibre(
    at: FactoredValues, other: FactoredMap, share: Share, modulus: int
) -> tuple[int, list[Sparse]]:
    """Number of unknowns, and equations, of the parameters of `other` over these values with
    this share; linear ones solved.
    """
    field = fmpz_mod_mpoly_ctx.get(other.parameters, modulus=modulus)
    shares = [_product(share.left, modulus), _product(share.right, modulus)]
    wanted = [*(int(f[i]) for f in shares for i in range(f.degree())), *at.poles]
    lifted = [
        field.from_dict({e: x % modulus for e, x in c})
        for c in (*other.left, *other.right, *other.poles)
    ]
    equations = [p - y for p, y in zip(lifted, wanted, strict=True)]
    for normal in _normals(at, share, modulus):
        height = sum(
            (p * w for p, w in zip(lifted, normal[len(other.joints) :], strict=True)),
            field.constant(0),
        )
        equations += _tangents(height, other, normal)
    heads = zip(other.joints, share.joints, strict=True)
    placed: dict[str | int, int] = {h: -z % modulus for h, z in heads}
    return _solve_linear([p.subs(placed) for p in equations], field, set(other.joints))


def _ports(row: Row) -> tuple[int, int]:
    """Its ports, numbered as in the chain."""
    return row.a + row.before, row.b + row.before


def _names(row: Row) -> tuple[str, ...]:
    """Unknowns of a row but its gain, numbered as in the chain."""
    at = row.before
    between, outside, wall = ("hex", "uer", "ue") if row.damped else ("ux", "ur", "u")
    joints = (
        f"{x}{i + at}"
        for i in range(1, row.n_masses)
        for x in (between if row.a <= i < row.b else outside)
    )
    apart = (i for i in row.ground_dampers if not (row.grounded and row.damped and i == 1))
    walls = (f"{x}0" for x in wall) if row.grounded else ()
    return (*walls, *joints, *(f"f{i + at}" for i in apart))


def _entries(joint: int, row: Row, ring: dict[str, fmpz_mpoly]) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Terms of a joint in the rows of the masses on its left and on its right."""
    s, zero, (a, b) = ring["s"], 0 * ring["s"], _ports(row)
    if a <= joint < b and not row.damped:
        return ring[f"u{joint}"], ring[f"x{joint}"]
    if a <= joint < b:
        same = s + ring[f"h{joint}"]
        return ring[f"e{joint}"] * same, ring[f"x{joint}"] * same
    impedance = ring.get(f"u{joint}", zero) + ring.get(f"e{joint}", zero) * s
    if joint == row.before:
        return zero, impedance
    ratio = ring[f"r{joint}"]
    return (impedance, ratio * impedance) if joint < a else (ratio * impedance, impedance)


def _by_power(polynomial: fmpz_mpoly) -> tuple[Terms, ...]:
    """Coefficients of s^0, s^1, .. but the leading one, in the unknowns: between s, the first
    symbol, and the gain.
    """
    powers = (c.to_dict() for c in coefficients(polynomial, "s")[:-1])
    return tuple(tuple((tuple(map(int, e[1:-1])), int(x)) for e, x in c.items()) for c in powers)


def _product(roots: Sequence[int], modulus: int) -> fmpz_mod_poly:
    return reduce(
        mul, (long_polynomial([-z, 1], modulus) for z in roots), long_polynomial([1], modulus)
    )


def _normals(at: FactoredValues, share: Share, modulus: int) -> list[list[int]]:
    """W: the relations between the rows of the Jacobian matrix, in the order joints, theta,
    phi, D, in echelon form.
    """
    factors = [f for f in (*((z,) for z in share.joints), share.left, share.right) if f]
    parts = [
        (f, (at.numerator // f).inverse_mod(f)) for f in (_product(x, modulus) for x in factors)
    ]
    columns = []
    for change, poles in at.slopes:
        moved = [(change * inverse % f, f.degree()) for f, inverse in parts]
        columns.append([*(int(d[i]) for d, size in moved for i in range(size)), *poles])
    return [normal[::-1] for normal in null_space([column[::-1] for column in columns], modulus)]


def _tangents(
    height: fmpz_mod_mpoly, other: FactoredMap, normal: Sequence[int]
) -> list[fmpz_mod_mpoly]:
    """The derivatives of the height along a normal by all parameters; the coordinates h_i are
    parameters themselves.
    """
    more = dict(zip(other.joints, normal, strict=False))
    return [height.derivative(by) + more.get(by, 0) for by in range(len(other.parameters))]


def _solve_linear(
    equations: list[fmpz_mod_mpoly], field: fmpz_mod_mpoly_ctx, gone: set[int]
) -> tuple[int, list[Sparse]]:
    """The equations without the unknowns that are gone already, or that linear equations give."""
    gone = set(gone)
    while True:
        equations = [p for p in equations if not p.is_zero()]
        linear = next((p for p in equations if p.total_degree() == 1), None)
        if linear is None:
            break
        lead = next(e for e, _ in linear.terms() if sum(e))
        gone.add(lead.index(1))
        equations = [p % linear for p in equations]  # its first unknown is put in
    # in this order the bases are found a little faster
    kept = [i for i in reversed(range(field.nvars())) if i not in gone]
    return len(kept), [
        {tuple(map(int, map(e.__getitem__, kept))): int(c) for e, c in p.terms()} for p in equations
    ]
