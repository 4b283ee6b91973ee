"""Check the shipped verdicts without the program that made them: `python -I -S check.py catalog`.

Standard library only; nothing of disting is imported. Models are built from their names, here;
transfer functions are determinants at points, modulo a prime. disting/guide/checking.md says what
each kind of evidence stores and why it proves what it says.

Three results: "checked" - what is stored was computed again and shows the verdict; "search" - the
verdict rests on a search or a theorem that is not repeated here; "wrong". The status is 0 only if
nothing is wrong and nothing is unreadable.

Primes and points come of SHA-256 of the model's text (`draw`), so nobody chooses them. The error:
a polynomial of degree d that is not zero vanishes at a random point with a probability of at most
d/p (Schwartz, Zippel). Coefficients of these models, and minors of their Jacobians, have degrees
below 2^12, and p is above 2^60: less than 2^-48 for one record.
"""

import ast
import hashlib
import json
import re
import sys
import time
from collections import Counter, namedtuple
from fractions import Fraction
from functools import cache, cached_property, lru_cache
from itertools import combinations, compress, count, islice, permutations, product
from operator import mul as times
from pathlib import Path

CHECKED, SEARCH, WRONG = "checked", "search", "wrong"


# ---- numbers modulo a prime, drawn of a text -------------------------------------------------


def is_prime(n):
    """Miller and Rabin with the 12 first primes: certain below 3.3 * 10^24."""
    bases = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)
    if any(n % b == 0 for b in bases):
        return n in bases
    r = ((n - 1) & -(n - 1)).bit_length() - 1
    for b in bases:
        x = pow(b, (n - 1) >> r, n)
        if x not in (1, n - 1):
            for _ in range(r - 1):
                x = x * x % n
                if x == n - 1:
                    break
            else:
                return False
    return True


@cache
def number(label):
    """A whole number below 2^256, of a text."""
    return int.from_bytes(hashlib.sha256(label.encode()).digest(), "big")


@cache
def prime_of(label):
    """The first prime behind 2^60 + (a number below 2^60 of the label)."""
    n = (1 << 60) + number("prime " + label) % (1 << 60) | 1
    while not is_prime(n):
        n += 2
    return n


def draw(label, names, p):
    """A value modulo p for each name."""
    return {name: 1 + number(f"{label} {name}") % (p - 1) for name in names}


def engine_residue(label, modulus):
    """The number of 1..modulus-1 that the engine's label stands for: a rule of its files."""
    width = max(16, modulus.bit_length() // 8 + 9)
    stream = hashlib.shake_256(label.encode()).digest(width)
    return 1 + int.from_bytes(stream, "big") % (modulus - 1)


def engine_prime(label, bits=64):
    """The prime that the engine's label stands for: the first of the candidates that is one."""
    top = 1 << (bits - 1)
    for attempt in range(10_000):
        candidate = engine_residue(f"prime:{label}:{attempt}", top) | top | 1
        if is_prime(candidate):
            return candidate
    raise ValueError("no prime")


# ---- polynomials in s modulo p: lists of coefficients, ascending, [] for zero ------------------


def trim(a):
    while a and not a[-1]:
        a.pop()
    return a


def mul(a, b, p):
    out = [0] * max(0, len(a) + len(b) - 1)
    for i, x in enumerate(a):
        if x:
            for j, y in enumerate(b):
                out[i + j] += x * y
    return trim([x % p for x in out])


def add(a, b, p, factor=1):
    n = max(len(a), len(b))
    a, b = a + [0] * (n - len(a)), b + [0] * (n - len(b))
    return trim([(x + factor * y) % p for x, y in zip(a, b)])


def divide(a, b, p):
    """Quotient and remainder."""
    a, out, inverse = list(a), [0] * max(0, len(a) - len(b) + 1), pow(b[-1], -1, p)
    for k in range(len(a) - len(b), -1, -1):
        q = out[k] = a[k + len(b) - 1] * inverse % p
        if q:
            for j, y in enumerate(b):
                a[k + j] = (a[k + j] - q * y) % p
    return trim(out), trim(a[: len(b) - 1])


def exactly(a, b, p):
    quotient, rest = divide(a, b, p)
    if rest:
        raise ArithmeticError("a division that ought to be exact")
    return quotient


def gcd_inverse(a, b, p):
    """(gcd of a and b, t) with t a = gcd modulo b."""
    r0, r1, t0, t1 = list(b), divide(a, b, p)[1], [], [1]
    while r1:
        q, r = divide(r0, r1, p)
        r0, r1, t0, t1 = r1, r, t1, add(t0, mul(q, t1, p), p, -1)
    return r0, t0


def at(a, x, p):
    value = 0
    for c in reversed(a):
        value = (value * x + c) % p
    return value


def expand(a, b, top, p, count):
    """Coefficients of a/b in 1/s; the first is that of s^(top - degree of b)."""
    a, back, out = (a + [0] * (top + 1 - len(a)))[::-1], b[::-1], []
    inverse = pow(back[0], -1, p)
    for k in range(count):
        x = a[k] if k < len(a) else 0
        x -= sum(back[j] * out[k - j] for j in range(1, min(k, len(b) - 1) + 1))
        out.append(x * inverse % p)
    return out


@cache
def interpolation(xs, p):
    """Of the Lagrange polynomials of these places the coefficients, by power."""
    whole = [1]
    for x in xs:
        whole = mul(whole, [-x % p, 1], p)
    parts = [exactly(whole, [-x % p, 1], p) for x in xs]
    lagrange = [[c * pow(at(part, x, p), -1, p) % p for c in part] for part, x in zip(parts, xs)]
    return list(zip(*lagrange))


def through(values, columns, p):
    return trim([sum(map(times, values, column)) % p for column in columns])


def reduced(rows, width, p):
    """(reduced row echelon form of the first columns, columns of its pivots, determinant of these
    if they are all) modulo p.
    """
    rows, pivots, det = [list(r) for r in rows], [], 1
    for col in range(width):
        k = len(pivots)
        pivot = next((i for i in range(k, len(rows)) if rows[i][col] % p), None)
        if pivot is None:
            continue
        if pivot != k:
            rows[k], rows[pivot], det = rows[pivot], rows[k], -det
        det = det * rows[k][col] % p
        inverse = pow(rows[k][col], -1, p)
        top = rows[k] = [x * inverse % p for x in rows[k]]
        for i, row in enumerate(rows):
            if i != k and (f := row[col]):
                rows[i] = [(x - f * y) % p for x, y in zip(row, top)]
        pivots.append(col)
    return rows, pivots, det


def rank_of(rows, p):
    """Rank of a matrix modulo p."""
    return len(reduced(rows, len(rows[0]) if rows else 0, p)[1])


def dependences(vectors, p):
    """Which vectors depend on which. The reduced echelon form writes each vector in the first
    independent ones; places that are not zero are the same in all bases of the space.
    Seen from the first vector and from the last one.
    """
    out = []
    for order in (vectors, vectors[::-1]):
        rows, pivots, _ = reduced(zip(*order), len(order), p)
        out.append((tuple(pivots), tuple(tuple(map(bool, r)) for r in rows[: len(pivots)])))
    return out[0], out[1]


def inverse_of(rows, p):
    """(inverse, determinant) modulo p; None for a singular matrix."""
    n = len(rows)
    both = [[*r, *(int(i == j) for j in range(n))] for i, r in enumerate(rows)]
    done, pivots, det = reduced(both, n, p)
    return ([r[n:] for r in done], det) if len(pivots) == n else None


# ---- models, built from their names ------------------------------------------------------------

# kind: its letter; the parameter stands in the matrix as it is, or as 1/parameter ("inverse"),
# with s^power, at rows and columns of (e_a - e_b)(e_a - e_b)^T, or (e_a - e_b) e_a^T for a flow.
Element = namedtuple("Element", "kind name a b power inverse exponent")
Model = namedtuple(
    "Model", "text names elements nodes force sensor order fixed lag delay exponents"
)
POWER = {"m": 2, "j": 2, "d": 1, "b": 1, "k": 0, "C": 1, "R": 0, "L": -1, "W": 0.5, "P": 0, "f": 0}


def element(kind, name, a, b, exponent=""):
    return Element(kind, name, a, b, POWER[kind], kind in "RLW", exponent)


def named(name, a, b):
    """An element by its name; a constant phase element has an exponent of its own."""
    return element(name[0], name, a, b, "n" + name[1:] if name[0] == "P" else "")


def model(text, elements, force, sensor, order=0, fixed=0, lag=False, delay=False, names=None):
    """`fixed`: power of s on the whole diagonal (1 for compartments)."""
    ends = [*force, *sensor, *(x for e in elements for x in (e.a, e.b))]
    sources = [e.a for e in elements if e.kind == "f"] + [max(x) for x in (force, sensor)]
    if min(ends) < 0 or min(sources) < 1 or {*map(type, ends)} != {int}:
        raise ValueError(f"no nodes: {text}")
    nodes = max(ends)
    names = tuple(names or sorted(e.name for e in elements))
    if len(set(names)) < len(names):
        raise ValueError(f"one name for two elements: {text}")
    exponents = tuple(sorted({e.exponent for e in elements if e.exponent}))
    ports = force, sensor
    return Model(text, names, tuple(elements), nodes, *ports, order, fixed, lag, delay, exponents)


def between(i, j):
    i, j = sorted((i, j))
    return f"{i}{j}"


def is_proper(n, gap, am, ap, mm, mp):
    """Whether ports are in the rows to which they belong."""
    below = range(1, gap + 1) if gap else (0,)
    return 0 <= gap < n and {am, mm} <= {*below} and {ap, mp} <= {*range(gap + 1, n + 1)}


@cache
def chain(n, gap, am, ap, mm, mp, damped, dampers=(), lag=False, delay=False, order=2):
    """Masses in a row, joints between neighbours but for the gap, the first one at the ground
    where there is a gap; force between `am` and `ap`, sensor between `mm` and `mp`, 0: ground.
    """
    are_words = {type(x) for x in (damped, lag, delay)} == {bool}  # 1 is True, but another text
    is_whole = are_words and is_proper(n, gap, am, ap, mm, mp)
    if not is_whole or not {*dampers} <= {*range(1, n + 1)}:
        raise ValueError("no chain has these indices")
    joints = [i for i in range(n) if i != gap]
    parts = [element("m", f"m{i}", i, 0) for i in range(1, n + 1)]
    parts += [element("k", f"k{i}{i + 1}", i, i + 1) for i in joints]
    parts += [element("d", f"d{i}{i + 1}", i, i + 1) for i in joints if damped]
    parts += [element("b", f"b{i}", i, 0) for i in dampers]
    names = [e.name for e in parts] + ["T1"] * lag + ["Td"] * delay
    text = f"chain {n} {gap} {am} {ap} {mm} {mp} {damped} {dampers} {lag} {delay} {order}"
    return model(text, parts, (ap, am), (mp, mm), order, 0, lag, delay, names)


def series_parallel(text):
    """`R1-p(L1,R2)` as elements between nodes; the port is 1, 0."""
    if not re.fullmatch(r"(?:[A-Z]\d+|[-p(),])+", text):
        raise ValueError(f"no circuit: {text}")
    fresh, out = count(2), []

    def lay(tree, a, b):
        if isinstance(tree, ast.Name):
            out.append(named(tree.id, a, b))
        elif isinstance(tree, ast.Call) and tree.func.id == "p":
            for branch in tree.args:
                lay(branch, a, b)
        elif isinstance(tree, ast.BinOp):
            row = []
            while isinstance(tree, ast.BinOp):
                row, tree = [tree.right, *row], tree.left
            ends = [a, *(next(fresh) for _ in row), b]
            for part, x, y in zip([tree, *row], ends, ends[1:]):
                lay(part, x, y)
        else:
            raise ValueError(f"no circuit: {text}")

    lay(ast.parse(text, mode="eval").body, 1, 0)
    return model(text, out, (1, 0), (1, 0))


def ends_of(text):
    a, _, b = text.replace(" ", ":").partition(":")
    return int(a), int(b or 0)


def joints(head, signs):
    """Yield (node, sign, node) of paths such as `#~1, 1=2=3`, the ground as 0."""
    for path in head.split(","):
        tokens = re.findall(rf"#|\d+|{signs}", path)
        if "".join(tokens) != path.replace(" ", ""):
            raise ValueError(f"no network: {head}")
        for a, joint, b in zip(tokens[::2], tokens[1::2], tokens[2::2]):
            yield int(a.replace("#", "0")), joint, int(b.replace("#", "0"))


def machine(text):
    """`#~1, 1=2; F2:1; S2`: springs (~), dampers (-), both (=), a mass at each node."""
    head, force, sensor = (part.strip() for part in text.split(";"))
    parts, nodes = [], set()
    for a, joint, b in joints(head, "[~=-]"):
        nodes |= {a, b} - {0}
        for kind in {"~": "k", "-": "d", "=": "kd"}[joint]:
            parts.append(element(kind, kind + between(a, b), a, b))
    parts += [element("m", f"m{i}", i, 0) for i in sorted(nodes)]
    if force[0] != "F" or sensor[0] != "S":
        raise ValueError(f"no ports: {text}")
    return model(text, parts, ends_of(force[1:]), ends_of(sensor[1:]), 2)


def compartments(text):
    head, force, sensor = (part.strip() for part in text.split(";"))
    flows = []
    for a, arrow, b in joints(head, "<>|>"):
        flows += [(a, b), *[(b, a)] * (arrow == "<>")]
    parts = [element("f", f"a{i}{j}", i, j) for i, j in flows]
    given, seen = (int(re.fullmatch(r"(?:in|out) (\d+)", x)[1]) for x in (force, sensor))
    return model(text, parts, (given, 0), (seen, 0), 0, 1)


def listed(text):
    """`k1 1 0, j1 1 2, in 3 1, out 3 2` or `R1 1 2; L1 2 0`: elements with their nodes."""
    ports, parts = {"in": (1, 0), "out": (1, 0)}, []
    for item in re.split(r"[,;]", text):
        name, *ends = item.split()
        ends = tuple(map(int, ends))
        if name[0] in "av":
            raise NotImplementedError("compartments as a list")
        if name in ports:
            ports[name] = ends
        else:
            parts.append(named(name, *ends))
    return model(text, parts, ports["in"], ports["out"])


@cache
def network(text):
    """The network of a text, in whichever of the four notations it is."""
    if ">" in text:
        return compartments(text)
    if "; F" in text:
        return machine(text)
    return listed(text) if " " in text else series_parallel(text)


# ---- transfer functions -------------------------------------------------------------------------


def matrix(m, values, s, p, z, scale):
    """Entries modulo p at s (with `scale` 2 s is the root of the frequency variable), times s^k
    where elements have negative powers; and the derivative's weight of each element.
    """
    a = [[0] * m.nodes for _ in range(m.nodes)]
    shift = -min([0, *(int(e.power * scale) for e in m.elements)])
    weights = []
    for e in m.elements:
        w = pow(s, int(e.power * scale) + shift, p)
        w = w * z[e.exponent] % p if e.exponent else w
        x = values[e.name] % p
        inverse = pow(x, -1, p) if e.inverse else 0
        weights.append(-w * inverse * inverse % p if e.inverse else w)
        x = w * (inverse if e.inverse else x) % p
        for i, j, sign in places(e):
            a[i][j] = (a[i][j] + sign * x) % p
    if m.fixed:
        for i in range(m.nodes):
            a[i][i] += pow(s, m.fixed * scale + shift, p)
    return a, weights, shift


def places(e):
    """(row, column, sign) of an element."""
    a, b = e.a - 1, e.b - 1
    if e.kind == "f":
        return [(a, a, 1)] + ([(b, a, -1)] if b >= 0 else [])
    first, second = [(a, 1)] * (a >= 0), [(b, -1)] * (b >= 0)
    ends = first + second
    return [(i, j, x * y) for i, x in ends for j, y in ends]


def ports_dot(port, vector, p):
    plus, minus = port
    return ((vector[plus - 1] if plus else 0) - (vector[minus - 1] if minus else 0)) % p


def solved(m, values, s, p, z, scale, slopes=True):
    """(N, D, [(dN, dD) by element]) at one s; None where the matrix is singular."""
    a, weights, shift = matrix(m, values, s, p, z, scale)
    both = inverse_of(a, p)
    if both is None:
        return None
    inverse, det = both
    x = [ports_dot(m.force, row, p) for row in inverse]
    h = ports_dot(m.sensor, x, p)
    top = pow(s, m.order * scale + shift, p)
    if not slopes:
        return h * det * top % p, det, []
    y = [ports_dot(m.sensor, column, p) for column in zip(*inverse)]
    out = []
    for e, w in zip(m.elements, weights):
        trace = change = 0
        for i, j, sign in places(e):
            trace += sign * inverse[j][i]
            change += sign * y[i] * x[j]
        d_det = det * trace % p * w % p
        out.append(((d_det * h - det * change % p * w) * top % p, d_det))
    return h * det * top % p, det, out


def value(m, values, s, p, z=(), scale=1):
    """H at one s modulo p; None at a pole."""
    found = solved(m, values, s, p, z, scale, slopes=False)
    if found is None:
        return None
    lag = (1 + values["T1"] * pow(s, scale, p)) % p if m.lag else 1
    return found[0] * pow(found[1] * lag, -1, p) % p if lag else None


def agree(left, x, right, y, label, p, scale=2):
    """Whether both transfer functions are the same function of s: at 3 random s (degrees below
    100, so by chance with at most (100/p)^3). s^n of a constant phase element is one more variable:
    exponents are those of the same names, or exchanged.
    """
    own, others = left.exponents, right.exponents

    def at_one(label, of):
        s = 2 + number(f"{label} s") % (p - 2)
        z = draw(f"{label} z", own, p)
        a = value(left, x, s, p, z, scale)
        return a is not None and a == value(right, y, s, p, {n: z[of[n]] for n in of}, scale)

    return (
        (left.delay and x["Td"]) == (right.delay and y["Td"])
        and len(own) == len(others)
        and any(
            all(at_one(f"{label} {k}", dict(zip(order, own))) for k in range(3))
            for order in permutations(others)
        )
    )


class Profile:
    """Reduced coefficients b0.. and a0.. (the last a is 1) at a random point, and derivatives."""

    def __init__(self, m, scale=1):
        self.given, self.scale = m, scale
        # s^n of a constant phase element becomes s^(7/2): equal functions stay equal
        plain = [e._replace(power=3.5, exponent="") if e.exponent else e for e in m.elements]
        m = m._replace(elements=tuple(plain))
        if any(scale * e.power % 1 for e in plain):
            raise ValueError("roots of s")
        self.model, self.p = m, prime_of(f"{m.nodes} nodes")
        self.values = draw(m.text, m.names, self.p)
        self._compute(scale)

    def _compute(self, scale):
        m, p = self.model, self.p
        size = max(int(2 * scale), *(int(scale * (e.power + 1)) for e in m.elements))
        lagrange_at, got = [], []
        s = 1
        while len(got) < m.nodes * size + size + 1:
            if (found := solved(m, self.values, s, p, {}, scale)) is not None:
                lagrange_at.append(s)
                got.append(found)
            s += 1
            if s > 10 * (len(got) + 20):
                raise ArithmeticError("the matrix is singular everywhere")
        lagrange = interpolation(tuple(lagrange_at), p)
        num = through([g[0] for g in got], lagrange, p)
        den = through([g[1] for g in got], lagrange, p)
        slopes = {}
        for k, e in enumerate(m.elements):
            pair = [through([g[2][k][i] for g in got], lagrange, p) for i in (0, 1)]
            slopes[e.name] = pair
        if m.lag:
            factor = [1, self.values["T1"]]
            slopes = {n: [x, mul(y, factor, p)] for n, (x, y) in slopes.items()}
            slopes["T1"] = [[], [0, *den]]
            den = mul(den, factor, p)
        self._reduce(num, den, slopes)

    def _reduce(self, num, den, slopes):
        p = self.p
        common = gcd_inverse(num, den, p)[0]
        self.den = exactly(den, common, p)
        lead = self.den[-1]
        self.den = [c * pow(lead, -1, p) % p for c in self.den]
        factor = exactly(den, self.den, p)
        self.num, square = exactly(num, factor, p), mul(factor, factor, p)
        inverse = gcd_inverse(self.num, self.den, p)
        inverse = [c * pow(inverse[0][0], -1, p) % p for c in inverse[1]]
        self.slopes = {}
        for name in self.model.names:
            d_num, d_den = slopes.get(name, ([], []))
            change = add(mul(d_num, den, p), mul(num, d_den, p), p, -1)
            change = exactly(change, square, p) if change else []
            v = divide(mul([-c % p for c in change], inverse, p), self.den, p)[1] if change else []
            u = exactly(add(change, mul(v, self.num, p), p), self.den, p) if change or v else []
            self.slopes[name] = (u, v)

    @property
    def degrees(self):
        return [len(self.num) - 1, len(self.den) - 1]

    @property
    def labels(self):
        """All coefficients; a dead time counts as one more."""
        n, m = self.degrees
        return [f"b{i}" for i in range(n + 1)] + [f"a{i}" for i in range(m)]

    def gradient(self, label):
        if not re.fullmatch(r"Td|[abG](0|[1-9]\d?)", label):
            raise ValueError(f"no coefficient: {label}")
        if label == "Td":
            return [int(n == "Td" and self.model.delay) for n in self.model.names]
        if label[0] == "G":
            return self.markov(int(label[1:]))[1]
        side, i = "ba".index(label[0]), int(label[1:])
        rows = [self.slopes[n][side] for n in self.model.names]
        return [r[i] if i < len(r) else 0 for r in rows]

    def coefficient(self, label):
        if label[0] == "G":
            return self.markov(int(label[1:]))[0]
        a, i = (self.num if label[0] == "b" else self.den), int(label[1:])
        return a[i] if i < len(a) else 0

    def markov(self, index):
        """Coefficient of s^-index, and its derivatives."""
        plain, slopes = self._expand()
        return plain[index], [slopes[n][index] for n in self.model.names]

    @cache  # noqa: B019 - profiles are kept as long as the program runs
    def _expand(self, inverse=False, count=28):
        """Coefficients of H in 1/s from s^0 downwards, and their derivatives by parameter; of 1/H
        from its first power.
        """
        a, b, p = self.num, self.den, self.p
        if len(a) > len(b) and not inverse:
            raise NotImplementedError("improper")
        a, b = (b, a) if inverse else (a, b)
        top, m = len(self.den) - 1, len(b) - 1
        plain = expand(a, b, top, p, count)
        slopes = {}
        for n, (u, v) in self.slopes.items():
            u, v = (v, u) if inverse else (u, v)
            first, second = expand(u, b, top, p, count), expand(v, b, m, p, count)
            product = [sum(second[i] * plain[k - i] for i in range(k + 1)) for k in range(count)]
            slopes[n] = [(x - y) % p for x, y in zip(first, product)]
        return plain, slopes

    @cache  # noqa: B019
    def dependent(self, kind):
        """Which functions of a kind depend on which: b0.., a0.. ("H"), or the coefficients in 1/s
        of H ("G") or 1/H ("1/G").
        """
        if kind == "H":
            vectors = [self.gradient(x) for x in self.labels]
        else:
            slopes = self._expand(kind == "1/G")[1]
            vectors = list(zip(*(slopes[n][: sum(self.degrees) + 2] for n in self.model.names)))
        return dependences(vectors, self.p)

    def rank(self, labels):
        return rank_of([self.gradient(x) for x in labels], self.p)

    @cached_property
    def rows(self):
        """Gradients of all that the response shows: its coefficients; with exponents, which are
        parameters, its values at random s and s^n.
        """
        if not self.given.exponents:
            return [self.gradient(x) for x in [*self.labels, *["Td"] * self.model.delay]]
        m, p, found = self.given, self.p, []
        for k in range(len(m.names)):
            z = draw(f"{m.text} {k}", m.exponents, p)
            s = number(f"{m.text} s{k}") % p
            num, den, slopes = solved(m, self.values, s, p, z, self.scale)
            of = {e.name: (x * den - num * y) % p for e, (x, y) in zip(m.elements, slopes)}
            found.append([of[n] for n in m.names])
        return found

    @cached_property
    def varying(self):
        """Coefficients that depend on parameters."""
        return {x for x in self.labels if any(self.gradient(x))}

    @cached_property
    def full_rank(self):
        """Number of parameters that the response determines, exponents among them."""
        return rank_of(self.rows, self.p) + len(self.given.exponents)

    @cached_property
    def constants(self):
        """Values of the other coefficients."""
        fixed = (x for x in self.labels if x not in self.varying)
        return {x: signed(self.coefficient(x), self.p) for x in fixed}

    def unseen(self, name):
        """Whether the coefficients leave a parameter free: a rank that does not fall without it."""
        i = self.model.names.index(name)
        rank = rank_of([r[:i] + r[i + 1 :] for r in self.rows], self.p)
        return rank + len(self.given.exponents) == self.full_rank

    def monomial(self, index):
        """Whether a Markov parameter is a product of powers of parameters: then its logarithmic
        derivatives are whole numbers, the same everywhere.
        """
        x, slopes = self.markov(index)
        if not x:
            return False
        inverse = pow(x, -1, self.p)
        ratios = [self.values[n] * d * inverse % self.p for n, d in zip(self.model.names, slopes)]
        return all(min(r, self.p - r) < 50 for r in ratios)


def signed(x, p):
    return x if x < p // 2 else x - p


profile = lru_cache(maxsize=None)(Profile)


# ---- evidence -----------------------------------------------------------------------------------

Pair = namedtuple("Pair", "left right label scale")
Result = namedtuple("Result", "status why")
DIFFERENT, SAME = "distinguishable", "indistinguishable"
SOMETIMES = "sometimes"
SHOWS = {
    **dict.fromkeys(("counts", "forms", "ranks", "constants", "refuted", "shared"), (DIFFERENT,)),
    **dict.fromkeys(("no equivalent", "inequality"), (DIFFERENT,)),
    **dict.fromkeys(("renaming", "free-choice", "embedding", "solved"), (SAME,)),
    **dict.fromkeys(("supermodel", "odd fibres"), (SAME,)),
    "dead time": (DIFFERENT,),
    **dict.fromkeys(("full-parts", "explicit", "theorem", "real factors"), (SAME,)),
    **dict.fromkeys(("witnesses", "real witnesses"), (SOMETIMES,)),
    "fibre": (DIFFERENT, SAME),
}
FINDING = {SAME: "holds", DIFFERENT: "fails", SOMETIMES: "sometimes"}


WRAPS = ("replaced", "at-inverse", "of-part")


def core_of(e):
    """The innermost evidence: of networks that stand for these."""
    return core_of(e["inner"]) if e["kind"] in WRAPS else e


def shows(e):
    """Relations that evidence of this kind can show. A network that stands for one of these and
    gives more shows only that they differ.
    """
    if e["kind"] in WRAPS:
        is_larger = e.get("left_larger") or e.get("right_larger")
        return tuple(x for x in shows(e["inner"]) if x == DIFFERENT or not is_larger)
    if e["kind"] != "both ways":
        return SHOWS.get(e["kind"], ())
    shares = tuple(sorted({e[side]["share"] for side in ("left", "right")}))
    return BOTH.get(shares, ())


BOTH = {("always",): (SAME,), ("never",): (DIFFERENT,), ("sometimes",): (SOMETIMES,)}
BOTH["always", "sometimes"] = (SOMETIMES,)


def result(is_right, why):
    return Result(CHECKED, why) if is_right else Result(WRONG, why)


def searched(why):
    return Result(SEARCH, why)


def pair_of(left, right, scale=1):
    return Pair(left, right, f"{left.text} | {right.text}", scale)


def sides(pair):
    return profile(pair.left, pair.scale), profile(pair.right, pair.scale)


def counts(pair, e):
    """Degrees of both transfer functions in lowest terms."""
    a, b = (x.degrees for x in sides(pair))
    return result([a, b] == [e["left"], e["right"]] and a != b, "degrees computed again")


def varies(x, label):
    if label == "Td":
        return x.model.delay
    return any(x.gradient(label))


def forms(pair, e):
    """A coefficient that depends on parameters in one model, in the other one not at all."""
    a, b = sides(pair)
    ways = ((e["only_left"], a, b), (e["only_right"], b, a))
    right = all(varies(x, n) and not varies(y, n) for names, x, y in ways for n in names)
    return result(right and bool(e["only_left"] or e["only_right"]), "derivatives computed again")


def ranks(pair, e):
    """The same coefficients have different numbers of independent values."""
    a, b = sides(pair)
    rows, every = set(e["rows"]), (a.full_rank, b.full_rank)
    own = {*a.labels, *b.labels, "Td"}
    if len(rows) < len(e["rows"]) or not all(x in own or x[0] == "G" for x in rows):
        return result(False, "coefficients that are none")
    found = every if e["all_rows"] else (a.rank(e["rows"]), b.rank(e["rows"]))
    whole = e["rows"][:1] == ["G0"] or a.varying <= rows or b.varying <= rows
    if e["all_rows"] and not whole:  # the rows that are named are those of one of the two
        return result(False, "not all coefficients")
    return result(found == (e["left"], e["right"]) and found[0] != found[1], "ranks computed again")


def renaming(pair, e):
    """One model is the other with parameters renamed, compared at a random point."""
    p, (left, right, label, _) = prime_of(pair.label), pair
    names = [sorted(x) for x in zip(*e["pairs"])]
    if e["symmetries"] and moved(left, e["symmetries"]) != moved(right, []):
        return result(False, "the symmetries lead to another model")
    if names != [sorted(left.names), sorted(right.names)]:
        return result(False, "the renaming names other parameters")
    x = draw(label, left.names, p)
    y = {b: x[a] for a, b in e["pairs"]}
    return result(agree(left, x, right, y, label, p, 2), "compared at a random point")


def free_choice(pair, e):
    """As many independent coefficients as vary, the same in both; the others are equal numbers."""
    if pair.left.exponents or pair.right.exponents:
        return searched("coefficients of constant phase elements")
    a, b = sides(pair)
    free, size = set(e["free"]), e["rank"]
    right = a.varying == b.varying == free and a.full_rank == b.full_rank == size == len(free)
    right = right and not a.model.delay and not b.model.delay
    right = right and a.degrees == b.degrees and a.constants == b.constants
    return result(right, "coefficients, ranks and constants computed again")


def factors(m):
    """What multiplies the response of the elements: a power of s, a lag, a dead time."""
    return m.order, m.lag, m.delay


def embedded(part, whole, numbering):
    """Whether the part's elements and ports are among those of the whole."""
    to = dict(map(tuple, numbering))
    if len(set(to.values())) < len(numbering) or set(to) != set(range(part.nodes + 1)) or to[0]:
        return False

    def spot(e, via):
        ends = via[e.a], via[e.b]
        return (e.kind, ends if e.kind == "f" else tuple(sorted(ends)))

    same = dict(zip(range(whole.nodes + 1), range(whole.nodes + 1)))
    have = Counter(spot(e, same) for e in whole.elements)
    need = Counter(spot(e, to) for e in part.elements)
    ports = [tuple(to[x] for x in port) for port in (part.force, part.sensor)]
    wanted = [whole.force, whole.sensor]
    fits = any(all(x in (y, y[::-1]) for x, y in zip(ports, way)) for way in (wanted, wanted[::-1]))
    if any(e.kind == "f" for e in whole.elements):
        fits = ports == wanted
    return fits and not need - have


def embedding(pair, e):
    """One model is the other without some elements, and both have one rank: the closures of what
    they give are irreducible, of one dimension, one inside the other.
    """
    left, right = pair.left, pair.right
    part, whole = (left, right) if e["left_is_submodel"] else (right, left)
    fits = embedded(part, whole, e["numbering"]) and factors(part) == factors(whole)
    a, b = sides(pair)
    return result(fits and a.full_rank == b.full_rank == e["rank"], "elements and ranks compared")


def solutions(pair, e):
    """At the points of the labels, modulo their primes, the stored parameters of the other model
    give the same function.
    """
    if e["is_normalised"]:
        return searched("stored in other coordinates")
    given, other = pair[:2] if e["left_given"] else pair[1::-1]
    labels, values = e["labels"], e["solutions"]
    if not labels or not len(labels) == len(set(labels)) == len(values):
        return result(False, "no labels, or not as many solutions")
    for label, values in zip(e["labels"], e["solutions"]):
        p = engine_prime(label)
        if len(values) not in (len(other.names), len(other.names) + 1):
            return result(False, "solutions of other parameters")
        if not all(x % p for x in values):
            return searched("a solution with a zero")
        x = {n: engine_residue(f"{of}:{label}", p) for n, of in zip(given.names, drawn_by(given))}
        y = dict(zip(other.names, values))
        if not agree(given, x, other, y, f"{pair.label} {label}", p):
            return result(False, "a stored solution does not fit")
    a, b = sides(pair)
    if a.full_rank != b.full_rank:
        return result(False, "ranks differ")
    return Result(CHECKED, "solutions put in")


def drawn_by(m):
    """Names by which the engine draws values: those of a chain, p1, p2, .. of a network."""
    return m.names if is_chain(m) else [f"p{i + 1}" for i in range(len(m.names))]


def formula_value(text, values, p):
    """Value modulo p of a formula of + - * / ** in names; sqrt and others are refused."""

    def walk(t):
        if isinstance(t, ast.BinOp):
            a, b = walk(t.left), walk(t.right)
            if isinstance(t.op, ast.Pow):
                return pow(a, b, p) if isinstance(t.right, ast.Constant) else bad()
            if isinstance(t.op, ast.Div):
                return a * pow(b, -1, p) % p
            return {ast.Add: a + b, ast.Sub: a - b, ast.Mult: a * b}[type(t.op)] % p
        if isinstance(t, ast.UnaryOp) and isinstance(t.op, ast.USub):
            return -walk(t.operand) % p
        if isinstance(t, ast.Name):
            return values[t.id]
        return t.value if isinstance(t, ast.Constant) and isinstance(t.value, int) else bad()

    def bad():
        raise NotImplementedError(text)

    return walk(ast.parse(text.replace("^", "**"), mode="eval").body)


def root_point(given, root, label, p):
    """Random values of the given parameters and the root that fulfil its equation: solved for one
    of them in which it is linear; None where there is none.
    """
    name, equation = root[0], root[1]
    values = draw(label, (*given.names, name), p)
    for n in (*given.names, name):
        f = [formula_value(equation, values | {n: t}, p) for t in (0, 1, 2)]
        if (f[2] - 2 * f[1] + f[0]) % p == 0 and (slope := (f[1] - f[0]) % p):
            solved_for = -f[0] * pow(slope, -1, p) % p
            return values | {n: solved_for} if solved_for else None
    return None


def explicit(pair, e):
    """Formulas for the parameters of the other model, put in at a random point. Whether the cases
    cover all parameters, and whether values are positive where a formula has a minus sign or a
    root, is not repeated.
    """
    p, plain = prime_of(f"{pair.label} {e['formulas']}"), Counter()  # no formula names p - 1
    if e["domain"] not in ("positive", "real"):
        return result(False, "another domain")
    for k, (left_given, where, values, root) in enumerate(e["formulas"]):
        given, other = pair[:2] if left_given else pair[1::-1]
        label = f"{pair.label} formula {k}"
        if {n for n, _ in values} != set(other.names):
            return result(False, "the formulas give other parameters")
        if any(v == "0" for _, v in values):
            plain[None] += 1
            continue
        x = root_point(given, root, label, p) if root else draw(label, given.names, p)
        if x is None:
            plain[None] += 1
            continue
        try:
            y = {n: formula_value(v, x, p) for n, v in values}
        except NotImplementedError:
            plain[None] += 1
            continue
        if not all(y.values()) or not agree(given, x, other, y, label, p):
            return result(False, "a formula does not fit")
        if not where and not root and not any("-" in v for _, v in values):
            plain[left_given] += 1
    if plain[True] and plain[False]:
        return Result(CHECKED, "formulas put in, positive by their signs")
    if plain[None]:
        return searched("formulas near zeros or with roots that are not put in")
    return searched("formulas put in; that they are positive, or the cases all, not repeated")


def exact_value(m, values, s):
    """H at a positive s, of fractions: exact but for powers of an exponent."""
    a = [[Fraction(0)] * (m.nodes + 1) for _ in range(m.nodes)]
    for e in m.elements:
        x = values[e.name]
        x = s**e.power * (1 / x if e.inverse else x)
        x *= s ** values.get(e.exponent, 0) if e.exponent else 1
        for i, j, sign in places(e):
            a[i][j] += sign * x
    for i, row in enumerate(a):
        row[i] += m.fixed * s
        row[-1] += (i + 1 == m.force[0]) - (i + 1 == m.force[1])
    for i in range(m.nodes):
        pivot = max(range(i, m.nodes), key=lambda k: abs(a[k][i]))
        a[i], a[pivot] = a[pivot], a[i]
        for k in range(m.nodes):
            if k != i and a[k][i]:
                f = a[k][i] / a[i][i]
                a[k] = [x - f * y for x, y in zip(a[k], a[i])]
    x = [0, *(row[-1] / row[i] for i, row in enumerate(a))]
    return x[m.sensor[0]] - x[m.sensor[1]]


@cache
def misfit(given, x, other, y):
    """The largest relative difference of two functions at places on the positive axis."""
    places_ = [Fraction(21, 100) * Fraction(8, 5) ** k for k in range(len(y) + 4)]
    wanted = [exact_value(given, dict(x), s) for s in places_]
    found = [exact_value(other, dict(y), s) for s in places_]
    return max(abs(float(b / a) - 1) for a, b in zip(wanted, found))


FITS = 1e-6  # relative: what a stored, rounded equivalent may be off by


def witnesses(pair, e):
    """At a stored point the other model has the stored, rounded equivalent: put in, it gives the
    same function. That an exact one is near it, and that another point has none, is not repeated.
    """
    given, other = pair[:2] if e["with_left_given"] else pair[1::-1]
    if any(re.search(r"[eE][+-]?\d{3}", v) for k in ("point_with", "equivalent") for _, v in e[k]):
        return result(False, "a number that is too long")
    x, y = ({n: Fraction(v) for n, v in e[k]} for k in ("point_with", "equivalent"))
    without = (pair.left if e["without_left_given"] else pair.right).names
    if [set(x), set(y), {n for n, _ in e["point_without"]}] != [
        set(m) for m in (given.names, other.names, without)
    ]:
        return result(False, "points of other parameters")
    lowest = min(*x.values(), *y.values())
    if e["domain"] not in ("positive", "real") or (e["domain"] == "positive" and lowest <= 0):
        return result(False, "a point that is not positive")
    off = misfit(given, tuple(x.items()), other, tuple(y.items()))
    if off > FITS:
        return result(False, f"the stored equivalent gives a function that is off by {off:.0e}")
    return searched("the equivalent fits; that the other point has none is not repeated")


def monomials_alike(text):
    """Whether all terms of a polynomial have one sign, so that it is not zero for positive
    values.
    """
    body = text.strip()
    body = body[1:] if body.startswith("-") else body
    plus, minus = "+" in body, "-" in body
    return not (plus and (minus or text.strip().startswith("-")))


def no_equivalent(pair, e):
    """That one of the contradictions follows is not repeated."""
    alike = [monomials_alike(c) for c in e["contradictions"] if not set("<>=") & set(c)]
    why = "impossible by signs" if alike and all(alike) else "contradictions"
    return searched(f"{why}; that they follow is not repeated")


# polynomials in names over the integers: {exponents: number}, for an inequality's signs


def poly_mul(a, b):
    out = Counter()
    for x, c in a.items():
        for y, d in b.items():
            out[tuple(map(sum, zip(x, y)))] += c * d
    return Counter({k: v for k, v in out.items() if v})


def symbolic(m):
    """Coefficients of numerator and denominator by power of s, of a model whose elements stand in
    the matrix as they are: the determinant by permutations of rows, s the last exponent.
    """
    if any(e.inverse or e.exponent for e in m.elements) or m.lag or m.delay:
        raise NotImplementedError("inverse elements, lags")
    size, where = len(m.names) + 1, {n: i for i, n in enumerate(m.names)}
    a = [[Counter() for _ in range(m.nodes + 1)] for _ in range(m.nodes + 1)]
    for e in m.elements:
        key = (*(int(where[e.name] == i) for i in range(size - 1)), e.power)
        for i, j, sign in places(e):
            a[i][j][key] += sign
    s = (0,) * (size - 1) + (1,)
    for i in range(m.nodes):
        if m.fixed:
            a[i][i][s] += 1
    one = (0,) * size
    for force, sensor, sign in zip(m.force, m.sensor, (1, -1)):
        if force:
            a[force - 1][m.nodes][one] += sign
        if sensor:
            a[m.nodes][sensor - 1][one] -= sign

    def det(rows, columns):
        if not rows:
            return Counter({one: 1})
        total = Counter()
        for k, c in enumerate(columns):
            if a[rows[0]][c]:
                part = poly_mul(a[rows[0]][c], det(rows[1:], columns[:k] + columns[k + 1 :]))
                for key, x in part.items():
                    total[key] += x * (-1) ** k
        return Counter({k: v for k, v in total.items() if v})

    inner = tuple(range(m.nodes))
    num, den = det((*inner, m.nodes), (*inner, m.nodes)), det(inner, inner)
    num = Counter({(*k[:-1], k[-1] + m.order): v for k, v in num.items()})
    low = min(k[-1] for k in (*num, *den))
    out = [{}, {}]
    for side, poly in enumerate((num, den)):
        for k, v in poly.items():
            out[side].setdefault(k[-1] - low, Counter())[k[:-1]] += v
    return out


def inequality(pair, e):
    """A quadratic form in the coefficients whose terms all have one sign in one model, and the
    other sign, or none, in the other one: expanded here.
    """
    given, other = pair[:2] if e["left_given"] else pair[1::-1]
    if e["domain"] != "positive":
        return result(False, "signs of terms are those at positive parameters")
    signs = []
    if any(type(number_) is not int for number_, _, _ in e["form"]):
        return result(False, "numbers that are none")
    for m in (given, other):
        num, den = symbolic(m)
        if [max(num), max(den)] != profile(m, pair.scale).degrees:
            return searched("a common factor of numerator and denominator")
        total = Counter()
        for number_, x, y in e["form"]:
            x, y = ((num if n[0] == "b" else den).get(int(n[1:]), Counter()) for n in (x, y))
            for k, v in poly_mul(x, y).items():
                total[k] += v * number_
        signs.append({(v > 0) - (v < 0) for v in total.values()} - {0})
    if signs[0] == {-1} and signs[1] <= {1}:
        return Result(CHECKED, "form expanded, its signs seen")
    if {1} == signs[0] or signs[1] == {-1}:
        return result(False, "the form has other signs")
    return searched("form expanded; its signs are not seen by its terms")


# parts that can replace each other (disting/guide/replacement.md)


def in_series_or_parallel(n, c, z):
    """(n, c, z) of F, of two kinds of elements, as that of 1/(x F), and back."""
    return n + c + z - 1, 1 - z, 1 - c


def items(part, way):
    """(powers of single elements, {two powers: number of terms}, other parts) of a part that is
    connected in this way, "series" or "parallel".
    """
    shape, *rest = part
    if shape == "one":
        return {rest[0]}, Counter(), []
    if shape == "two":
        a, b, *numbers = rest
        n, c, z = numbers if way == "series" else in_series_or_parallel(*numbers)
        return {power for power, on in ((a, c), (b, z)) if on}, Counter({(a, b): n}), []
    if shape == way:
        return set(rest[0]), Counter(dict(rest[1])), [*rest[2]]
    return set(), Counter(), [part]


def connected(way, parts):
    """What a connection of parts can produce: ("one", power) for one kind of elements, ("two",
    power, power, n, c, z) for two kinds, else what it consists of.
    """
    singles, terms, others = set(), Counter(), []
    for part in parts:
        one, two, rest = items(part, way)
        singles, terms, others = singles | one, terms + two, others + rest
    powers = sorted({*singles, *(x for two in terms for x in two)})
    if len(powers) == 1 and not others:
        return "one", powers[0]
    if len(powers) == 2 and not others:
        numbers = terms[tuple(powers)], *(int(x in singles) for x in powers)
        return "two", *powers, *(numbers if way == "series" else in_series_or_parallel(*numbers))
    return (
        way,
        tuple(sorted(singles)),
        tuple(sorted(terms.items())),
        tuple(sorted(others, key=repr)),
    )


def parts_of(labels, ends):
    """{(node, node): part} when all parts (node, node, part) in parallel or in series are connected
    between the nodes that are no ends.
    """
    parts = {}

    def put(a, b, part):
        key = min(a, b), max(a, b)
        parts[key] = connected("parallel", [parts[key], part]) if key in parts else part

    for a, b, part in labels:
        if a != b:
            put(a, b, part)
    while True:
        at = {}
        for key in parts:
            for x in key:
                at.setdefault(x, []).append(key)
        inner = next((x for x in sorted(at) if x not in ends and len(at[x]) <= 2), None)
        if inner is None:
            return parts
        row = [parts.pop(key) for key in at[inner]]
        if len(row) == 2:
            put(*(x for key in at[inner] for x in key if x != inner), connected("series", row))


def numberings(first, others):
    """Yield all numbers of nodes, the first ones in order."""
    if len(others) > 7:
        raise NotImplementedError("many nodes")
    for order in permutations(sorted(others)):
        yield {x: i for i, x in enumerate((*dict.fromkeys(first), *order))}


@cache
def normal_form(m):
    """The parts and the ports, in the numbering that comes first: force and sensor may be
    exchanged, and the signs of both reversed.
    """
    if m.fixed:
        return form_of_compartments(m)
    parts = whole_parts(m)
    others, found = {x for key in parts for x in key} - {*m.force, *m.sensor}, []
    for pair in ((m.force, m.sensor), (m.sensor, m.force)):
        for force, sensor in (pair, [port[::-1] for port in pair]):
            for to in numberings((*force, *sensor), others):
                drawn = sorted((*sorted(to[x] for x in key), part) for key, part in parts.items())
                found.append(([to[x] for x in (*force, *sensor)], repr(drawn)))
    return min(found)


def whole_parts(m):
    """The parts of a network, or the one that gives all that it gives."""
    labels = [(e.a, e.b, ("exponent",) if e.exponent else ("one", e.power)) for e in m.elements]
    parts = parts_of(labels, {*m.force, *m.sensor})
    return parts if len(parts) == 1 else full_set(m) or parts


def full_set(m):
    """{(node, node): part} of a one-port of two kinds of elements that gives all of K(n, c, z)."""
    powers = sorted({e.power for e in m.elements})
    if {*m.force} != {*m.sensor} or len(powers) != 2 or m.exponents:
        return None
    bridge = one_port([(powers.index(e.power), e.a, e.b) for e in m.elements], *m.force)
    part = "two", *powers, *numbers_of(bridge)
    return {m.force: part} if gives_all(bridge) else None


# bridges: elements (power of x, node, node) of two kinds, seen between the nodes 0 and 1


def one_port(bridge, low, high):
    """What is seen of a bridge between two nodes, which become 0 and 1: an element that one held
    node cuts off from both is not. Nothing if they are one node or not joined.
    """
    kept = bridge = [(p, a, b) for p, a, b in bridge if a != b]
    pairs = [(low, high), *((a, b) for _, a, b in bridge)]
    nodes = {x for pair in pairs for x in pair}
    for held in nodes if low != high else ():
        of = classes(
            [pair for pair in pairs if held not in pair] + [(x, x) for x in nodes - {held}]
        )
        part = of[high if held == low else low]
        kept = [e for e in kept if {of.get(x, part) for x in e[1:]} == {part}]
    inner = sorted({x for _, *ends in kept for x in ends} - {low, high})
    to = {x: i for i, x in enumerate((low, high, *inner))}
    return tuple((p, *sorted((to[a], to[b]))) for p, a, b in kept) if low != high else ()


def one_less(bridge):
    """Yield (place of an element, whether it becomes rigid or vanishes, what is left)."""
    for i, rigid in product(range(len(bridge)), (False, True)):
        at = {bridge[i][2]: bridge[i][1]} if rigid else {}
        kept = [(p, at.get(a, a), at.get(b, b)) for p, a, b in bridge[:i] + bridge[i + 1 :]]
        if rest := one_port(kept, 0, at.get(1, 1)):
            yield i, rigid, rest


@cache
def numbers_of(bridge):
    """(n, c, z): trees of numerator and denominator have so many powers of x; c and z are 1 where
    one kind alone does not join the ends.
    """

    def joined(powers):
        of = classes((a, b) for p, a, b in bridge if p in powers)
        return len(of) - len({*of.values()}), of.get(0, 0) == of.get(1, 1)

    (low, is_low), (high, is_high), (every, _) = joined({0}), joined({1}), joined({0, 1})
    return low + high - every, int(not is_high), int(not is_low)


@cache
def degree(bridge):
    """The degree of the map from values to K(n, c, z), of as many elements as K has coordinates;
    0 of others. It is the sum over what is left without one B, on the face K(n-1, 1, z) of K, or
    without one A, on K(n, 0, z), if c = 1. There one coefficient is 0, the last of the denominator
    or of the numerator. A determinant with one entry in this column, in the row of the element,
    gives the sign.
    """
    (n, c, z), size = numbers_of(bridge), len(bridge)
    if not 1 < size == 2 * n + c + z <= 14:
        return int(size == 1)
    gone = [(i, x) for i, rigid, x in one_less(bridge) if rigid == c and bridge[i][0] == 1 - c]
    column = n + z + 1 if c else size
    return sum((-1) ** (i + 1 + column) * degree(x) for i, x in gone if len(x) == size - 1)


@cache
def gives_all(bridge):
    """Whether a bridge gives all of its K(n, c, z): it is in series and parallel, or the degree of
    its map is not 0, or it has up to three elements too many and without one it gives all.
    """
    n, c, z = numbers = numbers_of(bridge)
    labels = [(a, b, ("one", power)) for power, a, b in bridge]
    if parts_of(labels, {0, 1}) == {(0, 1): ("two", 0, 1, *numbers)}:
        return True
    if not 0 < len(bridge) - 2 * n - c - z <= 3:
        return degree(bridge) != 0
    return any(gives_all(rest) for _, _, rest in one_less(bridge) if numbers_of(rest) == numbers)


# compartments: outflows that may be moved, trees that hang at one compartment


def reached(start, flows, closed=None):
    """Compartments to which flows lead, past a closed one."""
    found, todo = set(), [start]
    while todo:
        if (x := todo.pop()) not in found | {closed}:
            found.add(x)
            todo += [b for a, b in flows if a == x]
    return found


def moved_outflows(flows, leaky, given, seen):
    """Compartments whose outflows do as well as these, if the one that is seen has a way out: the
    first that no way to x avoids, and only the two of the ports if both are among them.
    """
    if not leaky & reached(seen, flows):
        return leaky
    here = {given, seen, *(x for flow in flows for x in flow)}
    ways = {c: reached(given, flows, c) | reached(seen, flows, c) for c in here}
    gates = {x: {c for c in here if x not in ways[c]} for x in here}
    leaky = {c for x in leaky for c in gates[x] if gates[c] == {c}}
    return {given, seen} if {given, seen} <= leaky else leaky


def form_of_compartments(m):
    """The flows, and of each compartment how many hang at it in trees and whether there is an
    outflow: in the numbering that comes first, flows turned round where input and output are one.
    """
    (given, _), (seen, _) = m.force, m.sensor
    flows = {(e.a, e.b) for e in m.elements}
    here = reached(given, flows) & reached(seen, [flow[::-1] for flow in flows])
    if not here:
        raise ValueError(f"no response: {m.text}")
    leaky = {a for a, b in flows if a in here and b not in here}
    flows = {(a, b) for a, b in flows if {a, b} <= here}
    leaky, hanging = moved_outflows(flows, leaky, given, seen), dict.fromkeys(here, 0)
    while True:
        near = {x: {b for a, b in flows if a == x} for x in hanging}
        before = {x: {a for a, b in flows if b == x} for x in hanging}
        free = hanging.keys() - {given, seen}
        x = next((x for x in sorted(free) if len(near[x]) == 1 and near[x] == before[x]), None)
        if x is None:
            break
        (y,) = near[x]
        hanging[y] += hanging.pop(x) + 1
        leaky = leaky - {x} | ({y} if x in leaky else set())
        flows = {flow for flow in flows if x not in flow}
    found = []
    for to in numberings((given, seen), free):
        at = [(hanging[x], x in leaky) for x in to]
        drawn = sorted((to[a], to[b]) for a, b in flows)
        found += [(at, drawn)] + [(at, sorted((b, a) for a, b in drawn))] * (given == seen)
    return given == seen, *min(found)


def replaceable(a, b):
    """Whether two networks become the same when parts are labelled by what they can produce."""
    return factors(a) == factors(b) and normal_form(a) == normal_form(b)


# undamped machines: the places of springs to the ground, and zeros that lie between poles
# (disting/guide/replacement.md and positive-values.md)


def as_chain(ends, part, ground, fresh):
    """(nodes with a mass, springs) of a part of which all masses meet in the ground: of two kinds
    it is a chain of masses that is seen at its end; None of others.
    """
    if part == ("one", 0):
        return [], [ends]
    shape, *numbers = ("two", 0, 2, 0, 0, 1) if part == ("one", 2) else part
    if shape != "two" or numbers[:2] != [0, 2] or numbers[3] or ground not in ends:
        return None
    n, _, z = numbers[2:]
    row = [sum(ends) - ground, *islice(fresh, n + z - 1)]
    return row, [*zip(row, [*row[1:], ground])][:n]


def machines(m):
    """Undamped machines, a mass at each node, that give the same as a network: itself; and what its
    parts are where all masses meet in one node, which becomes the ground.
    """
    springs = [e for e in m.elements if e.kind == "k"]
    masses = sorted((e.a, e.b) for e in m.elements if e.kind == "m")
    if masses == [(i, 0) for i in range(1, m.nodes + 1)] and len(masses + springs) == len(m.names):
        yield m
    parts = {} if m.fixed else whole_parts(m)
    for ground in {x for ends in parts for x in ends}:
        fresh = count(m.nodes + 1)
        rows = [as_chain(ends, part, ground, fresh) for ends, part in parts.items()]
        masses, springs = [[x for row in rows for x in row[i]] if all(rows) else [] for i in (0, 1)]
        to = {x: i for i, x in enumerate((ground, *masses))}
        if {x for ends in (*parts, *springs, m.force, m.sensor) for x in ends} == {*to}:
            drawn = [element("m", f"m{to[x]}", to[x], 0) for x in masses]
            drawn += [element("k", f"k{i}", to[a], to[b]) for i, (a, b) in enumerate(springs)]
            ports = (tuple(to[x] for x in port) for port in (m.force, m.sensor))
            yield model(f"{m.text} at {ground}", drawn, *ports, m.order)


def grounded_everywhere(m):
    """A machine with a spring to the ground at each mass, which gives the same if springs join all
    masses, some spring is at the ground, and force and sensor are at one mass each; else None.
    """
    masses, springs = ([e for e in m.elements if e.kind == kind] for kind in "mk")
    inner = [e for e in springs if e.a * e.b]
    is_whole = len(joined_nodes(inner, range(1, m.nodes + 1))) == 1
    if not is_whole or len(inner) == len(springs) or min(m.force) or min(m.sensor):
        return None
    at_ground = [element("k", f"k{e.a} ground", e.a, 0) for e in masses]
    return model(m.text, (*masses, *inner, *at_ground), m.force, m.sensor, m.order)


def joined_nodes(springs, nodes):
    """Nodes that springs join without the other nodes and the ground."""
    pairs = [(e.a, e.b) for e in springs if {e.a, e.b} <= {*nodes}]
    of = classes(pairs + [(x, x) for x in nodes])
    return [[x for x in nodes if of[x] == number_] for number_ in sorted({*of.values()})]


def is_held(springs):
    """Whether some are at the ground."""
    return not all(e.a * e.b for e in springs)


def is_tree(m, springs):
    """Whether these join the masses as a tree, and at most one of them is at the ground."""
    grounded = sum(not e.a * e.b for e in springs)
    is_whole = len(joined_nodes(springs, range(1, m.nodes + 1))) == 1
    return is_whole and len(springs) == m.nodes - 1 + grounded and grounded <= 1


def part_at(m, x, springs, nodes, s):
    """Determinant of these masses at s, the others held, without the factor s^2 of a free part."""
    to = {node: i for i, node in enumerate(nodes, 1)}
    own = [e for e in m.elements if e.kind == "m" or e in springs]
    own = [e._replace(a=to.get(e.a, 0), b=to.get(e.b, 0)) for e in own]
    rows = matrix(m._replace(elements=own, nodes=len(nodes)), x.values, s, x.p, {}, 1)[0]
    is_free = all({e.a, e.b} <= {*nodes} for e in springs if {e.a, e.b} & {*nodes})
    return reduced(rows, len(nodes), x.p)[2] * pow(s, -2 * is_free, x.p)


def zeros_are_of_parts(m, x, springs):
    """Whether the zeros are the poles of some of the parts that are left where a mass is held or,
    in a held tree, a spring is cut: compared at random places.
    """
    ways = [(springs, held) for held in range(1, m.nodes + 1)]
    if is_tree(m, springs) and is_held(springs):
        ways += [([e for e in springs if e is not cut], 0) for cut in springs if cut.a * cut.b]
    spots = [1 + number(f"{m.text} s{i}") % (x.p - 1) for i in range(3)]
    first = next(i for i, c in enumerate(x.num) if c)
    wanted = [at(x.num, s, x.p) * pow(s, -first, x.p) for s in spots]
    for kept, held in ways:
        parts = joined_nodes(kept, [i for i in range(1, m.nodes + 1) if i != held])
        values = [[part_at(m, x, kept, part, s) for s in spots] for part in parts]
        for chosen in product((False, True), repeat=len(parts)):
            found = [1] * len(spots)
            for factor in compress(values, chosen):
                found = [a * b for a, b in zip(found, factor)]
            if all((a * found[0] - wanted[0] * b) % x.p == 0 for a, b in zip(wanted, found)):
                return True
    return False


@cache
def interlaced(m):
    """(number of masses, whether they are held, powers of the denominator at zero, powers and sign
    of the numerator) of an undamped machine that gives all functions whose zeros lie between
    neighbouring poles, no two between the same, 0 being a pole of a free one; None of others. A
    tree with at most one spring to the ground, or a machine that is one without some springs.
    """
    masses, springs = ([e for e in m.elements if e.kind == kind] for kind in "mk")
    x, held = profile(m), is_held(springs)
    at_zero = next(i for i, c in enumerate(x.den) if c)
    if x.degrees[1] - at_zero != 2 * (m.nodes - (not held)):
        return None
    if not zeros_are_of_parts(m, x, springs):
        return None
    num = symbolic(m)[0]
    found = m.nodes, held, at_zero, sorted(num), {v > 0 for v in num[min(num)].values()}
    if len(found[-1]) > 1 or is_tree(m, springs):
        return found if len(found[-1]) == 1 else None
    trees = combinations(springs, m.nodes - (not held))
    trees = (kept for kept in trees if is_tree(m, kept) and is_held(kept) == held)
    trees = (model(m.text, (*masses, *kept), m.force, m.sensor, m.order) for kept in trees)
    return found if any(interlaced(tree) == found for tree in trees) else None


def inner_of(pair, e):
    """Evidence on two networks that stand for these."""
    a, b = network(e["left"]), network(e["right"])
    inner = evidence(Pair(a, b, f"{pair.label} {e['left']} | {e['right']}", pair.scale), e["inner"])
    if inner.status == WRONG:
        return inner
    likes = e["kind"] == "replaced" and factors(pair.left) == factors(pair.right)
    alike = ((x, y._replace(order=x.order)) for x, y in zip(pair, (a, b)))
    if likes and factors(a) == factors(b) and all(replaceable(x, y) for x, y in alike):
        return inner
    return searched("the networks that stand for these are not derived again")


def of_part(pair, e):
    """The part, as it is the network of which the inner evidence speaks."""
    whole = pair.left if e["left_is_part"] else pair.right
    kept = [x for x in whole.elements if x.name not in e["missing"]]
    if len(kept) + len(e["missing"]) != len(whole.elements):
        return result(False, "elements are missing that are not there")
    part = whole._replace(
        text=f"{whole.text} without {e['missing']}",
        elements=tuple(kept),
        names=tuple(n for n in whole.names if n not in e["missing"]),
    )
    pair = pair._replace(**{"left" if e["left_is_part"] else "right": part})
    inner = evidence(pair, e["inner"])
    return inner if inner.status == WRONG else searched(f"part: {inner.why}")


# theorems on chains: what they ask for, seen in the names


def is_chain(m):
    return m.text.startswith("chain ")


SAME_BY = ("symmetry", "duality", "Foster", "Cauer")


def indices(m):
    """(masses, gap, force, sensor, damped, the rest) of a chain's text."""
    n, gap, am, ap, mm, mp, damped, *rest = m.text.removeprefix("chain ").split(" ")
    return (*map(int, (n, gap, am, ap, mm, mp)), damped == "True", rest)


def moved(m, symmetries):
    """Indices and ground dampers of a chain after symmetries: exchange of force and sensor in one
    of the rows, reflection of the free row.
    """
    n, gap, am, ap, mm, mp, damped, _ = indices(m)
    at = [e.a for e in m.elements if e.kind == "b"]
    for name in symmetries:
        if name == "reciprocity of the free part":
            ap, mp = mp, ap
        elif name == "reciprocity of the grounded part":
            am, mm = mm, am
        elif name == "reflection of the free part":
            ap, mp = (n + gap + 1 - i for i in (ap, mp))
            at = [n + gap + 1 - i if i > gap else i for i in at]
        else:
            raise ValueError(f"no symmetry: {name}")
    return n, gap, am, ap, mm, mp, damped, sorted(at)


def row_key(n, wall, a, b):
    """A row up to exchange of its ports and, where it is free, mirroring."""
    ports = sorted((a, b))
    return (n, wall, *(ports if wall else min(ports, sorted((n + 1 - a, n + 1 - b)))))


def rows_of(m):
    n, gap, am, ap, mm, mp, *_ = indices(m)
    grounded = {"grounded": row_key(gap, True, am, mm)} if gap else {}
    return {"free": row_key(n - gap, False, ap - gap, mp - gap), **grounded}


def is_dual(a, b):
    """Gap g with both ports at its sides, against gap N - 1 - g, up to symmetry."""
    n, gap, *_, damped, _ = indices(a)

    def around(gap):
        grounded = {"grounded": row_key(gap, True, gap, gap)} if gap else {}
        return {"free": row_key(n - gap, False, 1, 1), **grounded}

    return damped and rows_of(a) == around(gap) and rows_of(b) == around(n - 1 - gap)


def is_foster(m):
    """Undamped, force and sensor at one place in each row."""
    return not indices(m)[6] and all(row[2] == row[3] for row in rows_of(m).values())


def is_cauer(m):
    """Foster's, with one long row, driven at an end."""
    rows = rows_of(m)
    row = rows.get("grounded", rows["free"])
    if "grounded" in rows and rows["free"][0] != 1:
        return False
    return is_foster(m) and row[2] in (1, row[0])


def functions_of(m, name):
    """What a network gives by a theorem, in one form or several; networks that share one of them
    give the same.
    """
    if name == "replacement":
        return [normal_form(m)]
    if name == "interlacing":
        return [*filter(None, map(interlaced, machines(m)))]
    return [*map(normal_form, filter(None, map(grounded_everywhere, machines(m))))]


ON_NETWORKS = {
    "replacement": "parts that can replace each other",
    "interlacing": "zeros between poles, in both",
    "springs to the ground": "the same with a spring to the ground at each mass",
}


def theorem(pair, e):
    """Whether the theorem's premises hold for two chains or two networks."""
    a, b, name = pair.left, pair.right, e["name"]
    alike, are_chains = factors(a) == factors(b), is_chain(a) and is_chain(b)
    if name in ON_NETWORKS and alike and not are_chains:
        found = functions_of(b, name)
        if any(x in found for x in functions_of(a, name)):
            return Result(CHECKED, ON_NETWORKS[name])
    plain = are_chains and all(indices(m)[7][:3] == ["()", "False", "False"] for m in (a, b))
    if not plain or name not in SAME_BY:
        return searched(f"theorem {name}: its premises are not derived again")
    alike = alike and all(indices(a)[i] == indices(b)[i] for i in (0, 6))
    return result(alike and same_by(a, b, name), f"premises of {name}")


REPLACEMENT = {"kind": "theorem", "name": "replacement"}


def same_by(a, b, name):
    """Whether two chains are what a theorem asks for."""
    if name == "symmetry":
        return rows_of(a) == rows_of(b)
    if name == "duality":
        return is_dual(a, b) or is_dual(b, a)
    one = is_cauer(a) and is_cauer(b)
    return is_foster(a) and is_foster(b) and one == (name == "Cauer")


def both_ways(pair, e):
    """On two chains that are these, or stand for these: the share of each that has equivalents."""
    sides_ = [e[side] for side in ("left", "right")]
    right = all(x["share"] in SHARES[x["evidence"]["kind"]].split() for x in sides_)
    if not right or not all(
        is_certain(x["certainty"], x["safety"], x["evidence"], pair) for x in sides_
    ):
        return result(False, "shares that their evidence does not show")
    return searched("shares of both are not repeated")


def by_search(pair, e):
    return searched("a search that is not repeated")


# inclusions: one model is a limit of the other one, or is none


LIMITS = ("full-image", "limit", "meeting", "limit-fibre")
INSIDE = ("parts-inside", "fibre")  # of the side that is given
NO_LIMIT = ("counts", "larger-projection", "too-large", "relative-degrees", "outside")
NO_LIMIT += ("pole-sharing", "refuted")
WAYS = {True: "right-in-left", False: "left-in-right", None: ""}
ONLY_IMAGE = ("relative-degrees", "refuted", "fibre")  # of finite values other than zero


def shows_inclusion(slot, pair, e, found):
    """Evidence that speaks for a limit names the larger side; what `inclusion` says must fit.
    Limits say nothing on finite values (`image`), nor these on limits (`closure`).
    """
    kind = e["kind"]
    if kind in (ONLY_IMAGE if slot == "closure" else (*LIMITS, "parts-inside")):
        return False
    if kind == "counts":
        return found == "neither" and exceeds(*sides(pair)) and exceeds(*sides(pair)[::-1])
    if kind in LIMITS:
        return found == WAYS[e["left_is_larger"]]
    if kind in NO_LIMIT:
        return found == "neither"
    inside = WAYS[not e["left_given"]]
    return found == inside or (kind in ("fibre", "by-parts") and found == "neither")


def exceeds(a, b):
    """Whether the first model cannot be a limit of the other one: a degree or the rank exceeds."""
    return a.full_rank > b.full_rank or any(x > y for x, y in zip(a.degrees, b.degrees))


def full_image(pair, e):
    """The larger model gives its varying coefficients any values; the others are those of the
    smaller one.
    """
    a, b = sides(pair) if e["left_is_larger"] else sides(pair)[::-1]
    right = a.varying == set(e["free"]) and a.full_rank == e["rank"] == len(a.varying)
    right = right and a.degrees[1] == b.degrees[1] and a.degrees[0] >= b.degrees[0]
    right = right and all(
        x not in b.varying and signed(b.coefficient(x), b.p) == c for x, c in a.constants.items()
    )
    return result(right, "coefficients, ranks and constants computed again")


def larger_projection(pair, e):
    """Coefficients with a larger rank in the model of the smaller rank."""
    a, b = sides(pair)
    if not {*e["rows"]} <= {*a.labels, *b.labels}:
        return result(False, "coefficients that are none")
    found = a.rank(e["rows"]), b.rank(e["rows"])
    right = (
        found == (e["left"], e["right"]) and (found[0] - found[1]) * (a.full_rank - b.full_rank) < 0
    )
    return result(right, "ranks computed again")


def relative_degrees(pair, e):
    """Of receptances: two more than those of accelerations. A larger one cannot fall; the first
    Markov parameter of a smaller one must be a product, which is never zero.
    """
    a, b = sides(pair)
    found = [x.degrees[1] - x.degrees[0] + x.model.order for x in (a, b)]
    larger, small = (0, 1) if e["left_is_larger"] else (1, 0)
    in_order = (a, b)[larger].full_rank > (a, b)[small].full_rank
    if found != [e["left"], e["right"]] or found[0] == found[1] or not in_order:
        return result(False, "relative degrees")
    if found[larger] > found[small]:
        return Result(CHECKED, "relative degrees computed again")
    x = (a, b)[larger]
    return (
        Result(CHECKED, "relative degrees, and a product that is not zero")
        if x.monomial(found[larger] - x.model.order)
        else searched("no product is seen")
    )


def too_large(pair, e):
    """The chain with fewer masses has as many determinable parameters or more."""
    found, sizes = [x.full_rank for x in sides(pair)], [indices(m)[0] for m in pair[:2]]
    (few, small), (many, big) = sorted(zip(sizes, found))
    return result(found == [e["left"], e["right"]] and few < many and small >= big, "ranks")


def meeting(pair, e):
    """rank + factors + 1 (of the mass) >= coordinates: dimensions of cones add up."""
    small, big = sides(pair) if not e["left_is_larger"] else sides(pair)[::-1]
    step = 1 if indices(big.model)[6] else 2
    room = [x - y for x, y in zip(big.degrees, small.degrees)]
    found = big.full_rank, sum(big.degrees) // step + 2, min(room) // step + 1
    right = found == (e["rank"], e["coordinates"], e["factors"]) and min(room) >= 0
    momentum = all(
        (x.coefficient("b0") * x.coefficient("a1") - x.coefficient("b1") * x.coefficient("a0"))
        % x.p
        == 0
        for x in (small, big)
    )
    right = right and (not e["same_mass"] or (step == 1 and momentum))
    enough = found[0] + found[2] + bool(e["same_mass"]) >= found[1]
    return result(right and enough, "dimensions counted again")


def step_row(row, element_, limit):
    """A row (masses, wall, ports) after one limit; None for one that is not known here."""
    n, wall, a, b = row
    i = int(element_[1]) if re.fullmatch(r"k\d\d", element_) else -1
    if limit == "0" and i == 0 and wall:
        return n, False, a, b
    if limit == "0" and 0 < i < n and max(a, b) <= i:
        return i, wall, a, b
    if limit == "0" and 0 < i < n and not wall and min(a, b) > i:
        return n - i, False, a - i, b - i
    if limit == "∞" and 0 < i < n:
        return n - 1, wall, *(x - (x > i) for x in (a, b))
    if limit == "∞" and i == 0 and wall and min(a, b) > 1:
        return n - 1, True, a - 1, b - 1
    if limit == "0" and element_ == f"m{n}" and not wall and max(a, b) < n:
        return n - 1, wall, a, b
    return None


def limit(pair, e):
    """Joints of the larger chain's rows that vanish or become rigid, one by one; a row that is not
    named comes to rest. With a count in addition the last step is not repeated.
    """
    larger, smaller = pair[:2] if e["left_is_larger"] else pair[1::-1]
    for own, shape in ((smaller, e["smaller"]), (larger, e["larger"])):
        if shape:
            n, *rest = shape
            other = chain(n, *rest, indices(own)[6])
            is_same = any(same_by(own, other, x) for x in SAME_BY)
            if n != indices(own)[0] or not is_same:
                return result(False, "a chain that is not the same")
            larger, smaller = (other, smaller) if own is larger else (larger, other)
    have, want, counted = rows_of(larger), rows_of(smaller), False
    if sorted(part[1] for part in e["parts"]) != sorted(want):
        return result(False, "rows are missing")
    for given, wanted, steps, room in e["parts"]:
        row = have.pop(given)
        for element_, to in steps:
            row = step_row(row, element_, to) if row else None
            row = row_key(*row) if row else None
        if row is None:
            return searched("a step that is not known here")
        if room and (room[0] + room[2] + room[3] < max(0, room[1])):
            return result(False, "the count fails")
        if not room and row != want[wanted]:
            return result(False, "a row ends as another one")
        counted = counted or bool(room)
    if counted:
        return searched("steps followed, the count not repeated")
    return Result(CHECKED, "limits followed, row by row")


NAMED = (counts, forms, ranks, renaming, embedding, explicit, witnesses, inequality, theorem, limit)
NAMED += (free_choice, of_part, full_image, larger_projection, relative_degrees, too_large, meeting)
CHECKS = {check.__name__.replace("_", "-"): check for check in NAMED}
CHECKS |= {"solved": solutions, "replaced": inner_of, "at-inverse": inner_of}
CHECKS |= {"no equivalent": no_equivalent, "both ways": both_ways}
UNREADABLE = (KeyError, ValueError, TypeError, IndexError, AttributeError)
UNREADABLE += (ArithmeticError, SyntaxError, RecursionError, MemoryError)


def unreadable(why):
    return f"{type(why).__name__} {why}"


def evidence(pair, e):
    """What evidence is worth; whatever cannot be read is wrong."""
    try:
        return CHECKS.get(e["kind"], by_search)(pair, e)
    except NotImplementedError as why:
        return searched(f"not known here: {why}"[:60])
    except UNREADABLE as why:
        return result(False, f"cannot be read: {unreadable(why)}"[:90])


# ---- files --------------------------------------------------------------------------------------


class Table:
    """Results by file kind, place of the record and evidence, with the first reasons."""

    def __init__(self):
        self.counts, self.wrong, self.folder = {}, [], Path(__file__).parent

    def beside(self, name):
        """Lines of another file of the folder; none if it is not there."""
        path = self.folder / name
        return path.read_text(encoding="utf-8").splitlines() if path.exists() else []

    def add(self, kind, place, what, found, where, times_=1):
        row = self.counts.setdefault((kind, place, what, found.why), Counter())
        row[found.status] += times_
        if found.status == WRONG:
            self.wrong.append(f"{where}: {place} {what}: {found.why}")

    def __str__(self):
        merged, total = {}, Counter()
        for (kind, place, what, why), row in sorted(self.counts.items()):
            whole = merged.setdefault((kind, place, what), [Counter(), []])
            whole[0] += row
            if row[SEARCH]:
                whole[1].append(f"{row[SEARCH]} {why}")
            total += row
        lines = [f"{'file':14}{'record':16}{'evidence':18}{'checked':>9}{'search':>8}{'wrong':>7}"]
        for (kind, place, what), (row, why) in merged.items():
            told = "  " + "; ".join(why) if why else ""
            lines.append(
                f"{kind:14}{place:16}{what:18}{row[CHECKED]:9}{row[SEARCH]:8}{row[WRONG]:7}{told}"
            )
        lines.append(f"{'all':48}{total[CHECKED]:9}{total[SEARCH]:8}{total[WRONG]:7}")
        return "\n".join(lines)


def expect(table, kind, place, what, is_right, where, why=""):
    table.add(kind, place, what, result(is_right, why or "computed again"), where)


def classes(pairs):
    """Number of the class of each model that is in a pair of indistinguishable ones."""
    parent = {}

    def root(x):
        while parent.setdefault(x, x) != x:
            x = parent[x]
        return x

    for a, b in pairs:
        parent[root(a)] = root(b)
    return {x: root(x) for x in list(parent)}


def consistent(table, kind, where, verdicts):
    """Over complex parameters "indistinguishable" is an equivalence: no pair of one class is
    distinguishable.
    """
    of = classes([pair for pair, relation in verdicts.items() if relation == SAME])
    for (a, b), relation in verdicts.items():
        if relation == DIFFERENT and of.get(a, a) == of.get(b, b):
            why = "distinguishable in one class"
            expect(table, kind, "classes", "transitivity", False, f"{where} {a} {b}", why)
    expect(table, kind, "classes", "transitivity", True, where)


def chain_record(table, kind, where, r, m):
    """The line of one chain: parameters, degrees, varying coefficients, rank, and which parameters
    are free.
    """
    x = profile(m)
    found = (list(x.model.names), x.degrees, len(x.varying), x.full_rank)
    right = found == (r["parameters"], r["degrees"], r["free"], r["rank"])
    whole = r["rank"] in (len(r["parameters"]), r["free"])  # no rank is larger
    word, bits = r["rank_certainty"], r["safety"]
    right = right and r.keys() == MODEL_OF_CHAINS
    right = right and (word == "proven" if whole else word == "bounded" and 0 < bits <= BITS)
    expect(table, kind, "model", "degrees, rank", right and (bits == 0 or not whole), where)
    is_same = r["identifiability"]["rank"] == x.full_rank
    found = searched("numbers of equivalents") if is_same else Result(WRONG, "rank")
    table.add(kind, "model", "identifiability", found, where)


MODEL_OF_CHAINS = {"model", "indices", "parameters", "degrees", "free", "rank", "identifiability"}
MODEL_OF_CHAINS |= {"rank_certainty", "safety"}

# what a record says beside its evidence: the kinds of evidence that allow it

RULES = {"renaming": "6", "free-choice": "7", "embedding": "8", "supermodel": "9", "forms": "3"}
CERTAINTY = {
    **dict.fromkeys(("counts", "free-choice", "explicit", "inequality", "limit"), "proven"),
    **dict.fromkeys(("meeting", "parts-inside", "points", "relative-degrees"), "proven"),
    **dict.fromkeys(("witnesses", "of-part", "replaced", "at-inverse"), "proven"),
    **dict.fromkeys(("no equivalent", "real witnesses"), "proven"),
    **dict.fromkeys(("embedding", "solved", "shared", "refuted"), "bounded"),
    **dict.fromkeys(("full-image", "larger-projection", "limit-fibre", "too-large"), "bounded"),
    **dict.fromkeys(("theorem", "interlacing", "real factors"), "theorem"),
    **dict.fromkeys(("by-parts", "forms", "outside", "pole-sharing"), "proven bounded"),
    "ranks": "proven bounded",
    **dict.fromkeys(("excluded", "renaming"), "proven theorem"),
    **dict.fromkeys(("constants", "full-parts"), "proven"),
    **dict.fromkeys(("fibre", "no-equivalent"), "bounded"),
    "dead time": "theorem",
    "both ways": "theorem proven bounded",
    "supermodel": "proven bounded",
    "odd fibres": "theorem proven bounded",
}
SHARES = {"excluded": "never", "theorem": "always", "points": "sometimes"}
SHARES |= {"no-equivalent": "never", "interlacing": "always sometimes"}
PLACES = {"tf": "tf", "markov": "markov", "structure": "structure", "fibre": "fibre"}
PLACES |= {"embedding": "structure", "supermodel": "structure", "solved": "fibre"}


BITS = 192  # the program's bounds rest on at most three points modulo primes of 64 bits


def is_by_algebra(word, pair, e):
    """Whether ranks are called proven although the smaller one could be larger than at a prime."""
    if (e["kind"], word) != ("ranks", "proven"):
        return False
    small = sides(pair)[e["left"] > e["right"]]
    rows = small.varying if e["all_rows"] else e["rows"]
    return min(e["left"], e["right"]) not in (len(small.model.names), len(rows))


def is_certain(word, bits, e, pair):
    """Whether evidence has such a certainty; bits of a bound stand with bounds."""
    kind, right = e["kind"], type(bits) is int
    if kind == "renaming":  # by a symmetry that is named, of a model with itself, or by a search
        is_one = pair.left == pair.right and all(a == b for a, b in e["pairs"])
        right = right and (is_one or (word == "theorem") == bool(e["symmetries"]))
    if kind == "forms" and pair.left.delay != pair.right.delay:
        right = right and word == "theorem"  # no fraction equals another one times exp(-Td s)
    else:
        right = right and word in CERTAINTY[kind].split()
    return right and (0 < bits <= BITS if word == "bounded" else bits == 0)


def condition(e):
    """The number of the condition that evidence stands for, or "exact"."""
    if e["kind"] == "counts":
        return "1" if sum(e["left"]) != sum(e["right"]) else "2"
    if e["kind"] == "ranks":
        return "4" if e["all_rows"] else "5"
    return RULES.get(e["kind"], "exact")


def decided(slot, told, e):
    """Whether the condition that is named is that of the evidence, and where it was seen."""
    rule, place = told["decided_by"], told.get("representation")
    if slot in ("positive", "real"):
        return rule == "admissible" and place in (None, "parameters")
    return place in (None, PLACES.get(e["kind"], "tf")) and rule == condition(e)


FIELDS = {
    **dict.fromkeys(("tf", "markov", "structure"), "decided_by"),
    **dict.fromkeys(("fibre", "real"), "decided_by relation"),
    **dict.fromkeys(("complex", "positive"), "decided_by relation representation"),
    **dict.fromkeys(("left_positive", "right_positive"), "share"),
    **dict.fromkeys(("closure", "image"), "inclusion reason"),
}


def has_fields(slot, told):
    """Whether a verdict has the fields of its place; one that is open has no evidence."""
    fields = {*FIELDS[slot].split(), "certainty", "safety", "evidence"}
    return fields <= told.keys() | {"evidence"} <= fields | {"empirical"}


def unfounded(slot, told, e, pair):
    """What a verdict says that its evidence does not show; "" if nothing."""
    kind = e["kind"]
    if not has_fields(slot, told):
        return "fields are missing or unknown"
    is_more = is_by_algebra(told["certainty"], pair, e)  # no catalogue is built so
    if is_more or not is_certain(told["certainty"], told["safety"], e, pair):
        return "a certainty that its evidence does not give"
    if told.get("reason"):
        return "a reason for what is not open"
    if "decided_by" in told and not decided(slot, told, e):
        return "another condition than its evidence"
    if "share" in told:
        fits = told["share"] in SHARES[kind].split()
        return "" if fits else "a share that its evidence does not show"
    if "inclusion" in told:
        fits = shows_inclusion(slot, pair, e, told["inclusion"])
        return "" if fits else "an inclusion that its evidence does not show"
    return relation_of(slot if slot in DOMAINS else "complex", told.get("relation"), e, pair)


def relation_of(domain, relation, e, pair):
    """What is wrong with a relation that rests on evidence; without one it is that of the kind."""
    core = core_of(e)
    if not shows(e) or (relation or shows(e)[0]) not in shows(e):
        return "a relation that its evidence does not show"
    own = "positive" if core["kind"] == "both ways" else core.get("domain", domain)
    if domain not in DOMAINS or own != domain:
        return "evidence over other values"
    if domain != "complex" and relation == SAME and core["kind"] in ONLY_COMPLEX:
        return "evidence over complex values"
    if domain == "real" and (e["kind"] == "replaced" or core.get("name") in NOT_REAL):
        return "a theorem on positive values"
    if relation == SAME and len({x.full_rank for x in sides(pair)}) > 1:
        return "the same, with unequal ranks"
    return ""


DOMAINS = ("complex", "real", "positive")
ONLY_COMPLEX = ("free-choice", "embedding", "supermodel", "solved", "full-parts", "fibre")
NOT_REAL = ("Foster", "Cauer", "replacement", "interlacing", "springs to the ground")


def judged(found, false_of, *told):
    """A result, or wrong if `false_of` finds that more is said than the evidence shows."""
    try:
        why = "" if found.status == WRONG else false_of(*told)
    except UNREADABLE as reason:
        why = f"cannot be read: {unreadable(reason)}"[:90]
    return Result(WRONG, why) if why else found


DECIDED = ("certainty", "safety", "decided_by", "representation")  # of what is not open


def claim(table, kind, slot, told, pair, where):
    """A verdict and its evidence; returns the relation that it gives."""
    if e := told.get("evidence"):
        found = judged(evidence(pair, e), unfounded, slot, told, e, pair)
        table.add(kind, slot, str(e.get("kind")), found, where)
        return told.get("relation", *shows(e)[:1])
    right = told.get("relation", told.get("inclusion")) in ("undecided", "unknown")
    right = right and has_fields(slot, told)
    if not right or any(map(told.get, DECIDED)) or not told.get("reason", "-"):
        expect(table, kind, slot, "none", False, where, "a verdict without evidence")
    return "undecided"


CHAIN_SLOTS = {"tf", "markov", "structure", "fibre"}
VALUES = {"left_positive", "right_positive", "real"}


def chain_pair(table, kind, where, r, pair, verdicts):
    """All evidence of one pair of chains."""
    if unknown := r.keys() - CHAIN_SLOTS - VALUES - {"left", "right", "inclusions"}:
        expect(table, kind, "pair", "known", False, where, f"unknown: {sorted(unknown)}")
    shown = {claim(table, kind, slot, r[slot], pair, where) for slot in CHAIN_SLOTS & r.keys()}
    if len(shown) != 1:
        expect(table, kind, "pair", "one answer", False, where, "no answer, or two")
    verdicts[r["left"], r["right"]] = next(iter(shown), "undecided")
    for slot in VALUES & r.keys():
        claim(table, kind, slot, r[slot], pair, where)
    for side, told in r.get("inclusions", {}).items():
        if side not in ("closure", "image"):
            expect(table, kind, "pair", "known", False, where, f"unknown: {side}")
        claim(table, kind, side, told, pair, where)


def header(table, kind, name, head, **counted):
    """The first line of a file: its name, its sensor, and numbers of what is in it."""
    schema = 4 if kind == "chains" else 1
    told = {"catalog": Path(name).stem, "sensor": "acceleration", "schema": schema, **counted}
    right = all(head[key] == told[key] for key in told if key in head or key in counted)
    expect(table, kind, "file", "header", right and "catalog" in head, name)


def chains_file(table, name, lines):
    """chains-*: a line a chain, then a line a pair; all pairs are there."""
    head, kind, models, verdicts = lines[0], "chains", {}, {}
    for k, r in enumerate(lines[1:], 2):
        where = f"{name}:{k}"
        if "model" in r:
            models[r["model"]] = m = chain(head["n_masses"], *r["indices"], head["damped"])
            chain_record(table, kind, where, r, m)
        else:
            a, b = models[r["left"]], models[r["right"]]
            chain_pair(table, kind, where, r, pair_of(a, b), verdicts)
    whole = set(combinations(range(1, head["models"] + 1), 2))
    right = set(verdicts) == whole and len(lines) == 1 + len(models) + len(whole)
    every = dict(enumerate(enumerated(head["n_masses"], head["damped"]), 1))
    expect(table, kind, "file", "all models, pairs", right and models == every, name)
    own = f"chains-{head['n_masses']}-{'' if head['damped'] else 'un'}damped.jsonl"
    expect(table, kind, "file", "name", name == own, name)
    header(table, kind, name, head, models=len(every))
    consistent(table, kind, name, verdicts)
    return {(n, head["n_masses"]): m for n, m in models.items()}


def enumerated(n, damped):
    """All chains under (36), (37), (38) of the paper, in the order of their numbers."""
    for gap in range(n):
        below = range(1, gap + 1) if gap else (0,)
        for am in below:
            for ap in range(gap + 1, gap + (n - gap + 1) // 2 + 1):
                for mm in below:
                    for mp in range(ap, n + 1):
                        yield chain(n, gap, am, ap, mm, mp, damped)


def sizes_file(table, name, lines):
    """sizes-*: pairs of two sizes, the smaller chain left."""
    head, verdicts, models = lines[0], {}, {}
    for n in head["sizes"]:
        every = enumerated(n, "undamped" not in name)
        models |= {f"{n}:{k}": m for k, m in enumerate(every, 1)}
    for k, r in enumerate(lines[1:], 2):
        a, b = models[r["left"]], models[r["right"]]
        chain_pair(table, "sizes", f"{name}:{k}", r, pair_of(a, b), verdicts)
    wanted = {(a, b) for a, b in combinations(models, 2) if a[0] < b[0]}
    right = set(verdicts) == wanted and len(lines) == 1 + len(wanted)
    expect(table, "sizes", "file", "all pairs", right, name)
    header(table, "sizes", name, head, models=len(models))


def sets_of(n):
    return [c for k in range(n + 1) for c in combinations(range(1, n + 1), k)]


@cache
def coarse(x):
    """Degrees, rank, coefficients that vary, values of the others, dead time, exponents: models
    that differ in one of them differ.
    """
    constants = sorted(x.constants.items())
    own = x.model.delay, len(x.model.exponents)
    return x.degrees, x.full_rank, sorted(x.varying), constants, *own


Damped = namedtuple("Damped", "x base dampers form columns group renamed free")
"""A model of dampers-*: its profile, the chain without ground dampers, what symmetry leaves of it,
and what is stored.
"""


def form_of(m):
    """A chain up to exchange of force and sensor in a row and mirroring of the free row."""
    n, gap, am, ap, mm, mp, damped, _ = indices(m)
    at = sorted(e.a for e in m.elements if e.kind == "b")
    size = n - gap
    ports, free = sorted((ap - gap, mp - gap)), [i - gap for i in at if i > gap]
    mirrored = [sorted(size + 1 - i for i in x) for x in (ports, free)]
    grounded = sorted((am, mm)), [i for i in at if i <= gap]
    return size, gap, damped, *grounded, min([ports, free], mirrored)


def damped_models(table, name, lines):
    """All chains of a size, each with all sets of dampers to the ground."""
    n, damped = int(name.split("-")[1]), "undamped" not in name
    every, sets, out = list(enumerated(n, damped)), sets_of(n), []
    stored = ("columns", "group", "renamed", "free", "rank")
    right = [r["model"] for r in lines[1:]] == list(range(1, len(every) + 1))
    right = right and all(len(r[key]) == len(sets) for r in lines[1:] for key in stored)
    expect(table, "dampers", "file", "all models, sets", right, name)
    header(table, "dampers", name, lines[0], models=len(every), sets=len(sets))
    for r, m in zip(lines[1:], every):
        for dampers, *told, rank in zip(sets, *(r[key] for key in stored)):
            own = chain(*indices(m)[:6], damped, dampers)
            x = profile(own)
            where = f"{name} {r['model']} {dampers}"
            expect(table, "dampers", "model", "rank", x.full_rank == rank, where)
            out.append(Damped(x, m.text, dampers, repr(form_of(own)), *told))
    return out


def links(table, models):
    """Yield pairs of models, by place, that are the same for a reason seen here: one form; free
    choice of all coefficients; one damper more and the same rank; a settled pair that is checked.
    """
    first, place = {}, {(m.base, m.dampers): i for i, m in enumerate(models)}
    for i, m in enumerate(models):
        yield first.setdefault(m.form, i), i
        if m.x.full_rank == len(m.x.varying):
            yield first.setdefault(repr(coarse(m.x)), i), i
        for other in range(1, m.x.model.nodes + 1):
            j = place.get((m.base, tuple(sorted({*m.dampers, other}))), i)
            if models[j].x.full_rank == m.x.full_rank:
                yield i, j
    for line in table.beside("settled-dampers.jsonl"):
        r = read(line)
        ends = [first.get(repr(form_of(chain_text(r[side])))) for side in ("left", "right")]
        known = SAME in shows(r["finding"][4] or {}) and None not in ends
        if known and settled(json.dumps(r))[1].status == CHECKED:
            yield ends[0], ends[1]


ALL = ("H", "1/G", "G")


def told_apart(a, b, kinds):
    """Whether degrees, ranks, constants or dependences of these kinds tell two models apart."""
    return coarse(a) != coarse(b) or any(a.dependent(kind) != b.dependent(kind) for kind in kinds)


def same_classes(table, name, models):
    """Models of one class are the same, and what is the same is one class."""
    of = classes(links(table, models))
    members, numbers = {}, {}
    for i, m in enumerate(models):
        members.setdefault(m.group, []).append(i)
        numbers.setdefault(of[i], set()).add(m.group)
    one = all(len(groups) == 1 for groups in numbers.values())
    expect(table, "dampers", "classes", "none is two", one, name)
    for number_, places_ in members.items():
        first = models[places_[0]]
        for i in places_[1:]:
            m = models[i]
            linked = of[i] == of[places_[0]]
            if m.columns != first.columns or told_apart(first.x, m.x, () if linked else ALL):
                found = Result(WRONG, "told apart by degrees, ranks or columns")
            elif linked:
                found = Result(CHECKED, "linked")
            else:
                found = searched("same class: degrees, ranks and dependences agree")
            table.add("dampers", "class", "indistinguishable", found, f"{name} class {number_}")
    reasons(table, name, models)


def reasons(table, name, models):
    """The numbers that say which condition joins two models of a class."""
    renamed, free = {}, {}
    for m in models:
        first = renamed.setdefault(m.renamed, m)
        if first is not m:
            found = searched("a renaming that is no symmetry")
            found = Result(CHECKED, "one form") if first.form == m.form else found
            found = found if first.group == m.group else Result(WRONG, "of two classes")
            table.add("dampers", "model", "renamed", found, name)
        if m.free >= 0:
            first = free.setdefault(m.free, m)
            right = m.x.full_rank == len(m.x.varying) and coarse(m.x) == coarse(first.x)
            expect(table, "dampers", "model", "free", right and first.group == m.group, name)


def parted(buckets, key):
    """Buckets split by a property of their members."""
    out = []
    for bucket in buckets:
        parts = {}
        for x in bucket:
            parts.setdefault(key(x) if len(bucket) > 1 else 0, []).append(x)
        out += parts.values()
    return out


def pairs_in(buckets):
    return sum(len(b) * (len(b) - 1) // 2 for b in buckets)


def varying_markov(x):
    """Which coefficients of H in 1/s depend on parameters."""
    rows = x.dependent("G")[0][1]
    return tuple(map(any, zip(*rows)))


INVARIANTS = (coarse, *(lambda x, kind=kind: x.dependent(kind) for kind in ALL))
# what the columns of dampers-* are: conditions 1 to 5, 3 to 5 of G, and all of 1/G
COLUMNS = (lambda x: sum(x.degrees), lambda x: x.degrees, lambda x: x.varying)
COLUMNS += (lambda x: x.full_rank, INVARIANTS[1], varying_markov)
COLUMNS += (lambda x: x.full_rank, INVARIANTS[3], INVARIANTS[2])


def different_classes(table, name, head, models):
    """Classes differ by degrees, ranks or by which functions depend on which."""
    firsts = list({m.group: m for m in reversed(models)}.values())
    groups = {m.group for m in firsts}
    listed_ = {tuple(sorted(pair)) for pair in head["undecided"]}
    right = all(a != b and {a, b} <= groups for a, b in listed_)
    expect(table, "dampers", "file", "undecided pairs", right, name)
    buckets = [[m.x for m in firsts]]
    for key in INVARIANTS:
        buckets = parted(buckets, lambda x, key=key: repr(key(x)))
    close, whole = pairs_in(buckets), pairs_in([firsts])
    told = Result(CHECKED, "invariants"), searched("classes that invariants leave alike")
    for found, many in zip(told, (whole - close, close - len(listed_))):
        table.add("dampers", "class", "distinguishable", found, name, many)
    columns_of_classes(table, name, head, firsts)


def columns_of_classes(table, name, head, firsts):
    """Each column splits classes that those before it leave together, as its condition does."""
    right = head["tests"] == [1, 2, 3, 4, 5, 3, 4, 5, 10]
    right = right and all(len(m.columns) == len(COLUMNS) for m in firsts)
    expect(table, "dampers", "file", "conditions", right, name)
    buckets = [firsts]
    for t, key in enumerate(COLUMNS):
        true = shown = True
        for bucket in buckets:
            known = [m for m in bucket if m.columns[t] is not None] if len(bucket) > 1 else []
            seen = {(m.columns[t], repr(key(m.x))) for m in known}
            true = true and len({column for column, _ in seen}) == len(seen)
            shown = shown and len({value_ for _, value_ in seen}) == len(seen)
        found = Result(CHECKED, "split again") if shown else searched("split finer than here")
        found = found if true and (shown or t not in range(4)) else Result(WRONG, "split otherwise")
        table.add("dampers", "column", f"{t}", found, name)
        buckets = parted(buckets, lambda m, t=t: repr(m.columns[t]))


def dampers_file(table, name, lines):
    """dampers-*: a line a chain, lists by sets of dampers to the ground."""
    models = damped_models(table, name, lines)
    same_classes(table, name, models)
    different_classes(table, name, lines[0], models)


@cache
def settled(line):
    """(pair, result) of one line of settled-dampers."""
    r = read(line)
    pair = pair_of(chain_text(r["left"]), chain_text(r["right"]))
    return pair, evidence(pair, r["finding"][4])


def chain_text(text):
    """`5 masses, gap 0, force 1-0, sensor 3-0, damped, ground dampers 1+2` as a chain."""
    got = re.fullmatch(
        r"(\d) masses, gap (\d), force (\d)-(\d), sensor (\d)-(\d)(, damped)?"
        r"(?:, ground dampers ([\d+]+))?",
        text,
    )
    n, gap, ap, am, mp, mm = map(int, got.groups()[:6])
    dampers = tuple(map(int, got[8].split("+"))) if got[8] else ()
    return chain(n, gap, am, ap, mm, mp, bool(got[7]), dampers)


def finding(table, kind, where, told, pair, domain, found=None):
    """[format, word, certainty, safety, evidence or null, reason]."""
    form, word, certainty, bits, e, reason = told
    if not e:
        right = (form, word, certainty, bits) == (10, "abandoned", "proven", 0)
        if not right or not isinstance(reason, str) or not reason:
            expect(table, kind, "finding", "none", False, where, "no evidence")
        return
    relation = next((x for x in shows(e) if FINDING[x] == word), "none")
    found = judged(found or evidence(pair, e), relation_of, domain, relation, e, pair)
    if form != 10 or reason != "":
        found = Result(WRONG, "a finding with a reason, or of another format")
    if not all(is_certain(certainty, bits, x, pair) for x in (e, core_of(e))):
        found = Result(WRONG, "a certainty that its evidence does not give")
    table.add(kind, "finding", e["kind"], found, where)


def settled_file(table, name, lines):
    pairs = {tuple(sorted((r["left"], r["right"]))) for r in lines}
    expect(table, "settled", "file", "once", len(pairs) == len(lines), name)
    for k, r in enumerate(lines, 1):
        pair, found = settled(json.dumps(r))
        finding(table, "settled", f"{name}:{k}", r["finding"], pair, "complex", found)


def network_record(table, kind, where, r):
    """Rank, and which parameters the response leaves free."""
    m, told = network(r["network"]), r["identifiability"]
    x = profile(m, SCALE.get(kind, 1))
    free = {n for n, level in told["levels"].items() if level == "not identifiable"}
    if r.keys() != {"model", "network", "group", "identifiability"}:
        expect(table, kind, "model", "known", False, where, "missing or unknown fields")
    right = told["rank"] == x.full_rank
    right = right and set(told["levels"]) == {*m.names, *m.exponents}
    right = right and free == {n for n in m.names if x.unseen(n)}
    expect(table, kind, "model", "rank, free ones", right, where)
    table.add(kind, "model", "local or global", searched("numbers of equivalents"), where)
    return m


SCALE = {"cells": 2}


def network_pair(table, kind, where, r, pair):
    """The verdicts of a pair, over complex and positive parameters, and the finding behind them."""
    wanted = {"left", "right", "complex", "positive"}
    wanted = {"left", "right", "as"} if "as" in r else wanted
    if not wanted <= r.keys() <= {"left", "right", "complex", "positive", "finding", "as"}:
        expect(table, kind, "pair", "known", False, where, "missing or unknown fields")
    if "complex" in r:
        claim(table, kind, "complex", r["complex"], pair, where)
    if "finding" in r:
        finding(table, kind, where, r["finding"], pair, "positive")
    if "positive" in r:
        over_positive(table, kind, where, r, pair)


def over_positive(table, kind, where, r, pair):
    """Evidence of its own, or the verdict that the finding gives."""
    told = r["positive"]
    if told.get("evidence"):
        claim(table, kind, "positive", told, pair, where)
        fits = r.get("finding", [10, "abandoned"])[1] in ("abandoned", FINDING[told["relation"]])
        return expect(table, kind, "positive", "finding", fits, where, "the finding says otherwise")
    given = r["finding"][1:4] if "finding" in r else ["abandoned", "proven", 0]
    words = told["relation"], told["decided_by"], told["representation"]
    fits = given[0] == FINDING.get(told["relation"]) and words[1:] == ("admissible", "parameters")
    fits = fits and [told["certainty"], told["safety"]] == given[1:]
    if given[0] == "abandoned":
        fits = (*words, told["certainty"], told["safety"]) == ("undecided", "", "", "", 0)
    fits = fits and has_fields("positive", told)
    return expect(table, kind, "positive", "verdict", fits, where, "what the finding gives")


def networks_file(table, name, lines):
    """networks-*: a line a network with its class, then a line a pair of one class."""
    kind, models, groups, verdicts, told = name.split("-")[1], {}, {}, {}, {}
    scale = SCALE.get(kind, 1)
    for k, r in enumerate(lines[1:], 2):
        where = f"{name}:{k}"
        if "network" in r:
            models[r["model"]] = network_record(table, kind, where, r)
            groups[r["model"]] = r["group"]
            continue
        key = r["left"], r["right"]
        if key in told:
            expect(table, kind, "pair", "once", False, where, "a pair stands twice")
        told[key] = r
        if groups[key[0]] != groups[key[1]] or not groups[key[0]]:
            expect(table, kind, "pair", "class", False, where, "a pair of two classes")
        network_pair(table, kind, where, r, pair_of(models[key[0]], models[key[1]], scale))
        if "complex" in r:
            verdicts[key] = r["complex"]["relation"]
    different = len({m.text for m in models.values()}) == len(models)
    expect(table, kind, "file", "all models", different, name)
    header(table, kind, name, lines[0], models=len(models), family=name[9:-6])
    for key, r in told.items():
        if "as" in r:
            of = tuple(sorted(r["as"]))
            right = of in told and "as" not in told[of] and groups[of[0]] == groups[key[0]]
            ways = (pair_of(models[x], models[y]) for x, y in zip(key, r["as"])) if right else ()
            found = [evidence(way, REPLACEMENT) for way in ways] or [result(False, "other class")]
            found = next((x for x in found if x.status != CHECKED), found[0])
            table.add(kind, "pair", "as another", found, f"{name} {key}")
            verdicts.setdefault(key, verdicts.get(of, "missing"))
    consistent(table, kind, name, verdicts)
    unlisted(table, kind, name, models, groups, verdicts, scale)


def unlisted(table, kind, name, models, groups, verdicts, scale):
    """Pairs that are not there are told apart; pairs of one class are all there."""
    of = {x: profile(m, scale) for x, m in models.items()}
    for a, b in combinations(models, 2):
        where = f"{name} {a} {b}"
        if groups[a] and groups[a] == groups[b]:
            if (a, b) not in verdicts:
                expect(table, kind, "pair", "class", False, where, "a pair of a class is missing")
            elif verdicts[a, b] != SAME and told_apart(of[a], of[b], ()):
                expect(table, kind, "pair", "class", False, where, "told apart by invariants")
        else:
            told = Result(CHECKED, "invariants"), searched("degrees, ranks, dependences agree")
            differ = told_apart(of[a], of[b], ("H", "1/G") if not models[a].exponents else ())
            table.add(kind, "unlisted", "", told[not differ], where)


def candidates_pair(a, b, sign, rule, place, certainty):
    """The signs of one pair: `.`, the first condition that tells it apart, t (transfer function) or
    f (fibre), and p, b or t (proven, bounded, theorem: one of the two has a dead time).
    """
    late = a.model.delay != b.model.delay
    conditions = [sum(a.degrees) != sum(b.degrees), a.degrees != b.degrees]
    conditions += [late or a.varying != b.varying, a.full_rank != b.full_rank]
    first = next((f"{i}" for i, holds in enumerate(conditions, 1) if holds), "5e")
    words = {"1": "p", "2": "p", "3": "t" if late else "pb", "4": "pb"}.get(rule, "b")
    right = sign == "." and rule and rule in first and place == "tf"[rule == "e"]
    if first == "5e" and right and certainty in words:
        return searched("condition 5 or an exact decision, computed on demand")
    return result(right and certainty in words, "degrees, ranks and what varies")


def candidates_file(table, name, lines):
    """candidates: models of a fit, and a sign for each pair of them."""
    models = {}
    for k, r in enumerate(lines[1:], 2):
        if "model" in r:
            m = chain(
                *r["indices"], r["damped"], tuple(r["ground_dampers"]), r["lag"], r["dead_time"]
            )
            models[r["model"]] = x = profile(m)
            expect(table, "candidates", "model", "rank", x.full_rank == r["rank"], f"{name}:{k}")
            continue
        a = models[r["left"]]
        others = [models[i] for i in range(r["left"] + 1, len(models) + 1)]
        signs = [r[key] for key in ("relation", "decided_by", "representation", "certainty")]
        if {len(others)} != {*map(len, signs)}:
            expect(table, "candidates", "pair", "all pairs", False, f"{name}:{k}", "missing")
        for b, *signs_ in zip(others, *signs):
            found = candidates_pair(a, b, *signs_)
            table.add("candidates", "pair", signs_[1], found, f"{name}:{k}")
    right = [r["left"] for r in lines[1:] if "left" in r] == list(range(1, len(models)))
    expect(table, "candidates", "file", "all pairs", right, name)
    header(table, "candidates", name, lines[0], models=len(models))


def next_file(table, name, lines):
    header(table, "next", name, lines[0], groups=len(lines) - 1)
    for k, r in enumerate(lines[1:], 2):
        for kind in ("sensor", "force", "inertia", "lock"):
            if kind in r:
                table.add("next", kind, "gains, classes", searched("not repeated"), f"{name}:{k}")


ORDERS = {"position": 0, "velocity": 1, "acceleration": 2}


def verdict_model(record):
    """A model of a single verdict file, by its content: its name is that of a person."""
    keys = record.keys() - {"name"}
    if keys == CHAIN_OF_VERDICTS:
        keys = ("n_masses", "gap", "act_minus", "act_plus", "meas_minus", "meas_plus", "damped")
        more = tuple(record["ground_dampers"]), record["lag"], record["dead_time"]
        return chain(*(record[k] for k in keys), *more, ORDERS[record["sensor"]])
    if keys == {"network"}:
        return network(record["network"])
    if keys == {"flows", "input", "output"}:
        parts = [element("f", f"a{i}{j}", i, j) for i, j in record["flows"]]
        (given,), (seen,) = record["input"], record["output"]
        return model(json.dumps(record), parts, (given, 0), (seen, 0), 0, 1)
    if keys not in ({"elements", "port"}, {"elements", "force", "sensor", "quantity"}):
        raise NotImplementedError("fields of models")
    parts = [listed_element(*item) for item in record["elements"]]
    (force,), (sensor,) = (record.get(key, record.get("port")) for key in ("force", "sensor"))
    order = ORDERS[record.get("quantity", "position")]
    return model(json.dumps(record), parts, tuple(force), tuple(sensor), order)


CHAIN_OF_VERDICTS = {"sensor", "n_masses", "gap", "act_minus", "act_plus", "meas_minus"}
CHAIN_OF_VERDICTS |= {"meas_plus", "damped", "ground_dampers", "lag", "dead_time"}


def listed_element(name, a, b=0, more=""):
    """An element such as ["k12", 1, 2]; `more`: the exponent of a constant phase element."""
    if name[0] not in "mjdbkRLCWP" or (more and name[0] != "P"):
        raise NotImplementedError("compartments as a list, gears")
    return element(name[0], name, a, b, more or "n" + name[1:] if name[0] == "P" else "")


def verdict_file(table, name, told):
    """`disting compare A B --json FILE`."""
    try:
        a, b = map(verdict_model, told["models"])
        if any(told.get(k) or told["query"].get(k) for k in ("experiments", "also", "places")):
            raise ValueError("several experiments")
        if any(note.startswith("compared as the chain") for note in told["notes"]):
            raise ValueError("a chain in other names")
        if any(e.kind == "P" for m in (a, b) for e in m.elements):
            raise ValueError("exponents of constant phase elements")
    except (NotImplementedError, *UNREADABLE) as why:
        found = searched(f"not known here: {unreadable(why)}"[:90])
        return table.add("verdict", "models", "", found, name)
    half = any(e.kind == "W" for m in (a, b) for e in m.elements)
    pair = pair_of(a, b, 2 if half else 1)
    for place, part in (("verdict", told), ("over complex", told.get("over_complex") or {})):
        says = part.get("relation") in FINDING or any(map(part.get, DECIDED))
        if not (e := part.get("evidence")) and says:
            expect(table, "verdict", place, "none", False, name, "a verdict without evidence")
        if place != "verdict" and part and part.get("domain") != "complex":
            expect(table, "verdict", place, "domain", False, name, "other values")
        if e:
            found = judged(evidence(pair, e), overstated, part, e, pair)
            if found.status == CHECKED and is_by_algebra(part["certainty"], pair, e):
                found = searched("ranks by exact algebra")
            table.add("verdict", place, str(e.get("kind")), found, name)
    if not table.counts:
        table.add("verdict", "verdict", "none", searched("no evidence in the file"), name)


def overstated(part, e, pair):
    """What a single verdict says that its evidence does not show; "" if nothing."""
    domain, core = part["domain"], core_of(e)
    if core["kind"] not in CERTAINTY:
        return ""  # not repeated here
    if not is_certain(part["certainty"], part["safety"], e, pair):
        return "a certainty that its evidence does not give"
    if part["decided_by"] in CONDITIONS - {condition(e)}:  # others are those of a newer program
        return "another condition than its evidence"
    return relation_of(domain, part["relation"] or "none", e, pair)


CONDITIONS = {*"123456789", "exact", ""}


FILES = {
    "chains": chains_file,
    "sizes": sizes_file,
    "dampers": dampers_file,
    "settled": settled_file,
    "networks": networks_file,
    "candidates": candidates_file,
    "next": next_file,
}


def once(pairs):
    """A dictionary in which each name stands once."""
    if len(found := dict(pairs)) < len(pairs):
        raise ValueError("a name stands twice")
    return found


def finite(text):
    if abs(number_ := float(text)) < 1e300:
        return number_
    raise ValueError(f"no number: {text}")


def read(text):
    """A value of JSON; what the format leaves open is refused."""
    return json.loads(text, object_pairs_hook=once, parse_float=finite, parse_constant=finite)


def check_file(table, path):
    """All records of one file; a file that cannot be read is wrong."""
    try:
        text, table.folder = path.read_text(encoding="utf-8"), path.parent
        if path.suffix == ".json":
            return verdict_file(table, path.name, read(text))
        lines = [read(line) for line in text.splitlines()]
        return FILES[re.match(r"[a-z]+", path.stem)[0]](table, path.name, lines)
    except UNREADABLE as why:
        found = result(False, f"cannot be read: {unreadable(why)}"[:90])
        table.add("file", "file", "", found, path.name)


def main(arguments):
    table, start = Table(), time.monotonic()
    for argument in arguments or [str(Path(__file__).parent)]:
        path = Path(argument)
        for file in sorted(path.glob("*.jsonl")) if path.is_dir() else [path]:
            began = time.monotonic()
            check_file(table, file)
            print(f"{file.name}: {time.monotonic() - began:.1f} s", file=sys.stderr, flush=True)
    print(table)
    print(*table.wrong[:20], sep="\n")
    print(f"{time.monotonic() - start:.0f} s")
    return int(bool(table.wrong) or not table.counts)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
