"""Random and literal models as plain text, decided by Singular alone: elimination over Q, fibres
over Q and modulo a prime.

A model is a bordered matrix [[P, B], [-C, E]] of polynomials in s and the parameters, and a factor
f/g in front:

    G(s) = f/g det [[P, B], [-C, E]] / (e det P),    P (n x n), B (n x 1), C (1 x n), E = e d (1 x
    1)

which holds state spaces (P = diag(r) (s I - A), rows multiplied by their denominators r), transfer
functions (n = 1) and chains (P = M s^2 + D s + K). Nothing of the package is imported here.

Truth of a pair: the sets of all monic coefficient vectors have irreducible closures; the models
are indistinguishable exactly if these are the same (over complex parameters, for generic values).
"""

import random
from dataclasses import dataclass

import sympy as sp

from tests.oracles.singular import PRIME, answers, printed

SECONDS = 20.0


@dataclass(frozen=True)
class Plain:
    """Entries as Singular reads them (`^` for powers); `parameters` by name, not one of them
    `s`.
    """

    parameters: tuple[str, ...]
    dynamics: tuple[tuple[str, ...], ...]
    force: tuple[str, ...]
    output: tuple[str, ...]
    through: str = "0"
    scale: str = "1"
    above: str = "1"
    below: str = "1"

    def renamed(self, prefix: str) -> "Plain":
        """With parameters prefix1, prefix2, .. in their order."""
        names = {name: f"{prefix}({i})" for i, name in enumerate(self.parameters, 1)}
        put = lambda text: _put(text, names)  # noqa: E731
        return Plain(
            tuple(names.values()),
            tuple(tuple(map(put, row)) for row in self.dynamics),
            tuple(map(put, self.force)),
            tuple(map(put, self.output)),
            *map(put, (self.through, self.scale, self.above, self.below)),
        )


def _put(text: str, names: dict[str, str]) -> str:
    out, word = "", ""
    for sign in f"{text} ":
        if sign.isalnum() or sign == "_":
            word += sign
            continue
        out, word = out + names.get(word, word) + sign, ""
    return out.strip().replace("**", "^")


def _fraction(model: Plain, name: str) -> str:
    """Statements that define polynomials `name`N and `name`D: numerator and denominator in
    lowest terms.
    """
    n = len(model.force)
    rows = [[*row, b] for row, b in zip(model.dynamics, model.force, strict=True)]
    whole = [e for row in rows for e in row] + [f"-({c})" for c in model.output] + [model.through]
    square = [e for row in model.dynamics for e in row]
    return f"""
matrix {name}W[{n + 1}][{n + 1}] = {",".join(whole)}; matrix {name}P[{n}][{n}] = {",".join(square)};
poly {name}N = ({model.above})*det({name}W); poly {name}D = ({model.below})*({model.scale})*det({name}P);
poly {name}G = gcd({name}N, {name}D); {name}N = {name}N/{name}G; {name}D = {name}D/{name}G;
matrix {name}B = coeffs({name}N, s); matrix {name}A = coeffs({name}D, s);
int {name}n = nrows({name}B) - 1; int {name}m = nrows({name}A) - 1;"""


def _named(model: Plain, prefix: str) -> str:
    return f"{prefix}(1..{len(model.parameters)})"


@dataclass(frozen=True)
class Truth:
    """`same`: indistinguishable; None if the time was up. Degrees and dimensions where they
    were computed.
    """

    same: bool | None
    degrees: tuple[tuple[int, int], tuple[int, int]]
    ranks: tuple[int, int] | None
    method: str


def truth(left: Plain, right: Plain, draw: random.Random, seconds: float = SECONDS) -> Truth | None:
    """By elimination over Q; by ranks and fibres modulo a prime if that takes too long. None if
    that does too.
    """
    return by_elimination(left, right, seconds) or by_fibres(left, right, draw, seconds)


def by_elimination(left: Plain, right: Plain, seconds: float = SECONDS) -> Truth | None:
    """Compares the ideals of all polynomial relations between the coefficients b0.., a0.. of
    the monic forms over Q.
    """
    one, other = left.renamed("p"), right.renamed("q")
    size = 2 * max(len(left.force), len(right.force)) + 4
    p, q = len(left.parameters), len(right.parameters)
    script = f"""
ring r = 0,(s,t,p(1..{p}),q(1..{q}),x(0..{size}),y(0..{size})),dp;
{_fraction(one, "L")}{_fraction(other, "R")}
{printed("degrees", 'string(Ln)+" "+string(Lm)+" "+string(Rn)+" "+string(Rm)')}
if (Ln != Rn or Lm != Rm) {{ quit; }}
proc closure(matrix B, matrix A, int n, int m, poly gone) {{
  poly top = A[m+1,1]; ideal I = t*top - 1; int i;
  for (i = 0; i <= n; i++) {{ I = I, top*x(i) - B[i+1,1]; }}
  for (i = 0; i < m; i++) {{ I = I, top*y(i) - A[i+1,1]; }}
  return(std(eliminate(I, gone))); }}
poly gone = t; int i; for (i = 1; i <= {p}; i++) {{ gone = gone*p(i); }} for (i = 1; i <= {q}; i++) {{ gone = gone*q(i); }}
ideal E = closure(LB, LA, Ln, Lm, gone); ideal F = closure(RB, RA, Rn, Rm, gone);
int spare = nvars(r) - (Ln + 1) - Lm;
{printed("ranks", 'string(dim(E)-spare)+" "+string(dim(F)-spare)')}
{printed("same", "size(reduce(E,F))==0 and size(reduce(F,E))==0")}"""
    found = answers(script, seconds)
    if found is None:
        return None
    degrees = _degrees(found)
    if "ranks" not in found:
        return Truth(False, degrees, None, "degrees")
    one_rank, other_rank = map(int, found["ranks"].split())
    return Truth(found["same"] == "1", degrees, (one_rank, other_rank), "elimination")


def _degrees(found: dict[str, str]) -> tuple[tuple[int, int], tuple[int, int]]:
    a, b, c, d = map(int, found["degrees"].split())
    return (a, b), (c, d)


def by_fibres(
    left: Plain, right: Plain, draw: random.Random, seconds: float = SECONDS
) -> Truth | None:
    """Ranks at random points modulo a prime, and whether the fibre of each over a random point of
    the other is empty.

    Parameters that the rank does not need are set to random values first: the map that is left has
    the same closure.
    """
    one, other = left.renamed("p"), right.renamed("q")
    p, q = len(left.parameters), len(right.parameters)
    values = lambda n: ",".join(str(draw.randrange(1, PRIME)) for _ in range(n))  # noqa: E731
    script = f"""
ring r = {PRIME},(s,t,p(1..{p}),q(1..{q})),dp;
{_fraction(one, "L")}{_fraction(other, "R")}
{printed("degrees", 'string(Ln)+" "+string(Lm)+" "+string(Rn)+" "+string(Rm)')}
if (Ln != Rn or Lm != Rm) {{ quit; }}
proc at(poly f, int first, int k, list v) {{
  int i; for (i = 1; i <= k; i++) {{ f = subst(f, var(first+i-1), v[i]); }} return(f); }}
proc jac(matrix B, matrix A, int n, int m, int first, int k, list v) {{
  poly top = A[m+1,1]; matrix J[n+1+m][k]; int i; int j; poly c;
  for (i = 0; i <= n + m; i++) {{
    if (i <= n) {{ c = B[i+1,1]; }} else {{ c = A[i-n,1]; }}
    for (j = 1; j <= k; j++) {{
      J[i+1,j] = at(top*diff(c, var(first+j-1)) - c*diff(top, var(first+j-1)), first, k, v); }} }}
  return(J); }}
proc rk(matrix J) {{ return(size(std(module(J)))); }}
proc spare(matrix J) {{
  list free; int j; int old = 0; int now; module M = [0];
  for (j = 1; j <= ncols(J); j++) {{
    M = M, J[j]; now = size(std(M)); if (now == old) {{ free = insert(free, j); }} old = now; }}
  return(free); }}
proc solvable(poly gN, poly gD, int gfirst, int gk, list gv, matrix B, matrix A, int n, int m, int first, list free, list v) {{
  poly n0 = at(gN, gfirst, gk, gv); poly d0 = at(gD, gfirst, gk, gv); int i;
  poly N2 = 0; poly D2 = 0;
  for (i = 0; i <= n; i++) {{ N2 = N2 + B[i+1,1]*s^i; }} for (i = 0; i <= m; i++) {{ D2 = D2 + A[i+1,1]*s^i; }}
  poly top = A[m+1,1];
  for (i = 1; i <= size(free); i++) {{
    N2 = subst(N2, var(first+free[i]-1), v[i]); D2 = subst(D2, var(first+free[i]-1), v[i]);
    top = subst(top, var(first+free[i]-1), v[i]); }}
  ideal I = ideal(coeffs(N2*d0 - n0*D2, s)), t*top - 1;
  return(dim(slimgb(I)) >= 0); }}
list pv = {values(p)}; list qv = {values(q)}; list pw = {values(p)}; list qw = {values(q)};
matrix LJ = jac(LB, LA, Ln, Lm, 3, {p}, pv); matrix RJ = jac(RB, RA, Rn, Rm, {3 + p}, {q}, qv);
{printed("ranks", 'string(rk(LJ))+" "+string(rk(RJ))')}
if (rk(LJ) != rk(RJ)) {{ quit; }}
list lf = spare(LJ); list rf = spare(RJ);
{printed("there", f"solvable(LN, LD, 3, {p}, pv, RB, RA, Rn, Rm, {3 + p}, rf, qw)")}
{printed("back", f"solvable(RN, RD, {3 + p}, {q}, qv, LB, LA, Ln, Lm, 3, lf, pw)")}"""
    found = answers(script, seconds)
    if found is None:
        return None
    degrees = _degrees(found)
    if "ranks" not in found:
        return Truth(False, degrees, None, "degrees")
    one_rank, other_rank = map(int, found["ranks"].split())
    if "there" not in found:
        return Truth(False, degrees, (one_rank, other_rank), "ranks")
    # equal ranks: both fibres are empty, or none is
    assert found["there"] == found["back"], (found, left, right)
    return Truth(found["there"] == "1", degrees, (one_rank, other_rank), "fibres")


@dataclass(frozen=True)
class Zeros:
    """Parameter vectors over one transfer function: dimension (-1: none), and if finite how
    many, real, positive.
    """

    dimension: int
    count: int = 0
    real: int = 0
    positive: int = 0


def zeros(
    given: Plain, values: dict[str, str], searched: Plain, seconds: float = SECONDS
) -> Zeros | None:
    """All parameters of `searched` with the transfer function of `given` at these rational values
    and with its full order.

    Real solutions are counted by the signature of the trace form; positive ones as the real
    solutions of the equations in y_i, q_i = y_i^2, all y_i other than zero, of which there are 2^n
    for each.
    """
    one, other = given.renamed("p"), searched.renamed("q")
    p, n = len(given.parameters), len(searched.parameters)
    put = " ".join(
        f"LN = subst(LN, p({i}), {v}); LD = subst(LD, p({i}), {v});"
        for i, v in _numbered(given, values)
    )
    squares = ",".join(
        ["s", "t", *(f"p({i})" for i in range(1, p + 1)), *(f"q({i})^2" for i in range(1, n + 1))]
    )
    product = "*".join(f"q({i})" for i in range(1, n + 1))
    script = f"""
LIB "primdec.lib"; LIB "rootsmr.lib";
ring r = 0,(s,t,p(1..{p}),q(1..{n})),dp;
{_fraction(one, "L")}{_fraction(other, "R")}
{put} LG = gcd(LN, LD); LN = LN/LG; LD = LD/LG;
{printed("orders", 'string(Lm)+" "+string(Rm)')}
poly top = RA[Rm+1,1];
ideal I = ideal(coeffs(RN*LD - LN*RD, s)), t*top - 1;
map squared = r, {squares};
ideal J = squared(I);
ring u = 0,(t,q(1..{n})),dp;
ideal I = std(imap(r, I));
int d = dim(I);
{printed("dimension", "d")}
if (d != 0) {{ quit; }}
ideal S = std(radical(I));
{printed("count", "vdim(S)")}
{printed("real", "nrRootsDeterm(S)")}
ring w = 0,(z,t,q(1..{n})),dp;
ideal J = std(ideal(imap(r, J)) + ideal(z*({product}) - 1));
if (dim(J) < 0) {{ {printed("positive", "0")} quit; }}
{printed("positive", "nrRootsDeterm(J)")}"""
    found = answers(script, seconds)
    if found is None:
        return None
    if found["dimension"] != "0":
        return Zeros(int(found["dimension"]))
    return Zeros(0, int(found["count"]), int(found["real"]), int(found["positive"]) // 2**n)


def _numbered(model: Plain, values: dict[str, str]) -> list[tuple[int, str]]:
    return [(i, f"({values[name]})") for i, name in enumerate(model.parameters, 1)]


def shaped_zeros(
    given: Plain,
    values: dict[str, str],
    searched: Plain,
    draw: random.Random,
    seconds: float = SECONDS,
) -> Zeros | None:
    """As `zeros`, for larger fibres: a lexicographic basis in a random linear form u, whose roots
    are found in 80 digits.

    Signs are those of the 80 digits: plain numerics. None also where u does not tell the solutions
    apart.
    """
    one, other = given.renamed("p"), searched.renamed("q")
    p, n = len(given.parameters), len(searched.parameters)
    put = " ".join(
        f"LN = subst(LN, p({i}), {v}); LD = subst(LD, p({i}), {v});"
        for i, v in _numbered(given, values)
    )
    form = "+".join(f"{draw.randrange(-9, 10)}*q({i})" for i in range(1, n + 1))
    script = f"""
LIB "primdec.lib"; option(redSB);
ring r = 0,(s,t,u,p(1..{p}),q(1..{n})),dp;
{_fraction(one, "L")}{_fraction(other, "R")}
{put} LG = gcd(LN, LD); LN = LN/LG; LD = LD/LG;
poly top = RA[Rm+1,1];
ideal I = ideal(coeffs(RN*LD - LN*RD, s)), t*top - 1, u - ({form});
ring v = 0,(t,q(1..{n}),u),dp;
ideal I = slimgb(imap(r, I));
int d = dim(I);
{printed("dimension", "d")}
if (d != 0) {{ quit; }}
ideal S = std(radical(I));
{printed("count", "vdim(S)")}
ring w = 0,(t,q(1..{n}),u),lp;
ideal S = fglm(v, S);
{printed("size", "size(S)")}
int i; for (i = 1; i <= size(S); i++) {{ print("@g"+string(i)+" "+string(S[i])); }}"""
    found = answers(script, seconds)
    if found is None:
        return None
    if found["dimension"] != "0":
        return Zeros(int(found["dimension"]))
    basis = [found[f"g{i}"] for i in range(1, int(found["size"]) + 1)]
    return _by_roots(basis, n, int(found["count"]))


def _by_roots(basis: list[str], n: int, count: int) -> Zeros | None:
    u, t, *q = sp.symbols("u t " + " ".join(f"q{i}" for i in range(1, n + 1)))
    read = [
        sp.Poly(
            sp.sympify(
                g.replace("(", "").replace(")", "").replace("^", "**"), locals={"u": u, "t": t}
            ),
            t,
            *q,
            u,
        )
        for g in basis
    ]
    last = next(
        sp.Poly(g.as_expr(), u)
        for g in read
        if g.free_symbols_in_domain == set() and g.as_expr().free_symbols == {u}
    )
    if last.degree() != count:
        return None
    images = []
    for x in q:
        g = next(
            g
            for g in read
            if g.as_expr().free_symbols <= {x, u}
            and x in g.as_expr().free_symbols
            and g.degree(x) == 1
        )
        slope = g.coeff_monomial(x)
        images.append(sp.Poly(-(g.as_expr() - slope * x) / slope, u))
    real = [z for z in last.nroots(n=80, maxsteps=500) if abs(sp.im(z)) < sp.Float(10) ** -50]
    positive = [z for z in real if all(image.eval(z) > 0 for image in images)]
    return Zeros(0, count, len(real), len(positive))
