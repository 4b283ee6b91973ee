"""Random pairs of small general models as plain text: alike by substitution, nearly alike, of
lower rank, constant, unrelated.

Every model is written twice: as the package reads it, and as the plain program does
(`plain_models.Plain`).
"""

from dataclasses import dataclass, field, replace
from random import Random

from disting import InputError, Model
from tests.oracles.plain_models import Plain


@dataclass(frozen=True)
class Written:
    """State space (A, B, C, D; row i of A and B over r_i) or, with `num` and `den`, a transfer
    function.
    """

    a: tuple[tuple[str, ...], ...] = ()
    b: tuple[str, ...] = ()
    c: tuple[str, ...] = ()
    d: str = "0"
    r: tuple[str, ...] = ()
    num: str = ""
    den: str = ""
    names: tuple[str, ...] = field(default=())

    def model(self, name: str) -> Model:
        """As the package reads it."""
        if self.den:
            return Model.from_transfer_function(self.num, self.den, name=name)
        a = [[f"({e})/({r})" for e in row] for row, r in zip(self.a, self.r, strict=True)]
        b = [f"({e})/({r})" for e, r in zip(self.b, self.r, strict=True)]
        return Model.from_state_space(a, b, list(self.c), self.d, name=name)

    def plain(self) -> Plain:
        """As the plain program reads it."""
        if self.den:
            return Plain(self.names, ((self.den,),), ("1",), ("1",), above=self.num)
        n = len(self.b)
        rows = tuple(
            tuple(f"({r})*s*{int(i == j)}-({self.a[i][j]})" for j in range(n))
            for i, r in enumerate(self.r)
        )
        return Plain(self.names, rows, self.b, self.c, through=self.d)

    def substituted(self, put: dict[str, str], names: tuple[str, ...]) -> "Written":
        """With expressions in other parameters for its own."""
        change = lambda text: _replaced(text, put)  # noqa: E731
        each = lambda texts: tuple(map(change, texts))  # noqa: E731
        return Written(
            tuple(map(each, self.a)), each(self.b), each(self.c), change(self.d), each(self.r),
            change(self.num), change(self.den), names,
        )  # fmt: skip


def _replaced(text: str, put: dict[str, str]) -> str:
    out, word = "", ""
    for sign in f"{text} ":
        if sign.isalnum():
            word += sign
            continue
        out, word = out + (f"({put[word]})" if word in put else word) + sign, ""
    return out.strip()


def pair(draw: Random) -> tuple[str, Written, Written]:
    """A pair and what was planted in it."""
    kind = draw.choices(list(KINDS), [weight for weight, _ in KINDS.values()])[0]
    left, right = KINDS[kind][1](draw)
    left, right = (_cancelling(draw, x) if draw.random() < 0.25 else x for x in (left, right))
    left, right = (replace(x, names=_used(x)) for x in (left, right))
    if not left.names or not right.names:
        return pair(draw)
    return (kind, left, right) if draw.random() < 0.5 else (kind, right, left)


def _used(of: Written) -> tuple[str, ...]:
    """Names that are written anywhere, sorted, whether the transfer function depends on them or
    not.
    """
    texts = [*(e for row in of.a for e in row), *of.b, *of.c, of.d, *of.r, of.num, of.den]
    words = "".join(x if x.isalnum() else " " for x in " ".join(texts)).split()
    return tuple(sorted({w for w in words if not w.isdigit() and w != "s"}))


def _number(draw: Random) -> str:
    return str(draw.choice([-3, -2, -1, 1, 1, 1, 2, 3, 5]))


def _polynomial(draw: Random, names: tuple[str, ...], zero: float = 0.0) -> str:
    """A sum of up to three terms of degree 2 at most."""
    if draw.random() < zero:
        return "0"
    terms = []
    for _ in range(draw.choice([1, 1, 1, 2, 2, 3])):
        powers = draw.choices(names, k=draw.choice([0, 1, 1, 1, 2, 2]))
        terms.append("*".join([_number(draw), *powers]))
    return "+".join(f"({t})" for t in terms)


def _space(draw: Random, names: tuple[str, ...]) -> Written:
    n = draw.choice([1, 2, 2, 3])
    row = lambda zero: tuple(_polynomial(draw, names, zero) for _ in range(n))  # noqa: E731
    scales = tuple(draw.choice([*["1"] * 6, *names]) for _ in range(n))
    unit = lambda: tuple("1" if i == at else "0" for at in [draw.randrange(n)] for i in range(n))  # noqa: E731
    b = unit() if draw.random() < 0.6 else row(0.3)
    c = unit() if draw.random() < 0.6 else row(0.3)
    through = _polynomial(draw, names, 0.8)
    return Written(tuple(row(0.45) for _ in range(n)), b, c, through, scales, names=names)


def _quotient(draw: Random, names: tuple[str, ...]) -> Written:
    m = draw.choice([0, 1, 1, 2, 2, 2, 3])
    sides = []
    for degree in (draw.randint(0, m), m):
        terms = [
            f"({_polynomial(draw, names, 0.25 * (i < degree))})*s**{i}" for i in range(degree + 1)
        ]
        sides.append("+".join(terms))
    monic = f"s**{m}+" * (draw.random() < 0.5)
    return Written(num=sides[0], den=monic + sides[1], names=names)


def _any(draw: Random, prefix: str, most: int = 4) -> Written:
    names = tuple(f"{prefix}{i}" for i in range(1, draw.randint(1, most) + 1))
    while True:
        found = draw.choice([_space, _quotient])(draw, names)
        try:
            found.model("drawn")
        except InputError:  # zero, not proper, or without parameters
            continue
        return found


def _unrelated(draw: Random) -> tuple[Written, Written]:
    return _any(draw, "a"), _any(draw, "b")


def _alike(draw: Random) -> tuple[Written, Written]:
    """A substitution by expressions: mostly dominant, so that the pair is the same; sometimes
    of lower rank.
    """
    left = _any(draw, "a", 3)
    count = draw.choice(
        [len(left.names), len(left.names), min(4, len(left.names) + 1), max(1, len(left.names) - 1)]
    )
    names = tuple(f"b{i}" for i in range(1, count + 1))
    own = dict(zip(left.names, [*names, *names], strict=False))
    put = {name: _image(draw, own[name], names) for name in left.names}
    return left, left.substituted(put, names)


def _image(draw: Random, own: str, names: tuple[str, ...]) -> str:
    other = draw.choice(names)
    choices = [
        own,
        f"-{own}",
        f"{own}*{other}",
        f"{own}+{other}",
        f"{own}**2",
        f"{own}-2",
        f"{own}**2+{other}",
        f"2*{own}",
    ]
    return draw.choices(choices, [3, 1, 2, 2, 1, 1, 1, 1])[0]


def _perturbed(draw: Random) -> tuple[Written, Written]:
    """Alike but for one entry."""
    left, right = _alike(draw)
    entry = _polynomial(draw, right.names)
    if right.den:
        return left, replace(
            right, **{draw.choice(["num", "den"]): f"{draw.choice([right.num, right.den])}+{entry}"}
        )
    i, j = draw.randrange(len(right.a)), draw.randrange(len(right.a))
    rows = [list(row) for row in right.a]
    rows[i][j] = entry
    return left, replace(right, a=tuple(map(tuple, rows)))


def _shaped(draw: Random) -> tuple[Written, Written]:
    """Two transfer functions of one shape with entries drawn anew, so that degrees and often
    ranks agree.
    """
    m = draw.choice([1, 2, 2, 3])
    top = draw.randint(0, m)
    zeros = [draw.random() < 0.3 for _ in range(m + 1)]
    numbers = [_number(draw) if draw.random() < 0.3 else "" for _ in range(m + 1)]
    made = []
    count = draw.randint(1, 4)
    for prefix in "ab":
        names = tuple(f"{prefix}{i}" for i in range(1, count + 1))
        den = [numbers[i] or ("0" if zeros[i] else _polynomial(draw, names)) for i in range(m)]
        num = [_polynomial(draw, names) for _ in range(top + 1)]
        text = lambda side: "+".join(f"({c})*s**{i}" for i, c in enumerate(side))  # noqa: E731
        made.append(Written(num=text(num), den=f"s**{m}+{text(den)}", names=names))
    return made[0], made[1]


def _gain_only(draw: Random) -> tuple[Written, Written]:
    den = draw.choice(["1", "s+1", "s**2+3*s+1"])
    made = []
    for prefix in "ab":
        names = tuple(f"{prefix}{i}" for i in range(1, draw.randint(1, 3) + 1))
        gain = _polynomial(draw, names)
        made.append(Written(num=f"({gain})*(s+2)" if den != "1" else gain, den=den, names=names))
    return made[0], made[1]


def _constant(draw: Random) -> tuple[Written, Written]:
    """Rank 0 on one side or both: the parameter cancels."""
    numbers = [draw.choice([2, 2, 3, -2, 10**30, 10**30 + 1]) for _ in range(2)]
    made = []
    for prefix, number in zip("ab", numbers, strict=True):
        common = draw.choice(
            [f"{prefix}1", f"({prefix}1+1)", f"{prefix}1*{prefix}2", f"({prefix}1-{prefix}2)**2"]
        )
        free = draw.choice(["1", "1", "1", f"{prefix}1"])
        made.append(Written(num=f"{number}*{common}*{free}", den=f"{common}*(s+3)"))
    return made[0], made[1]


def _cancelling(draw: Random, model: Written) -> Written:
    """A common factor in s and the parameters, or in the parameters alone."""
    if not model.den:
        return model
    names = tuple(n for n in model.names if n) or ("z1",)
    factor = draw.choice(
        [f"(s+{names[0]})", names[-1], f"({names[0]}+1)", f"(s**2+{names[-1]}*s+1)", "(z1*s+1)"]
    )
    return replace(model, num=f"({model.num})*{factor}", den=f"({model.den})*{factor}")


KINDS = {
    "unrelated": (1, _unrelated),
    "alike": (3, _alike),
    "perturbed": (2, _perturbed),
    "shaped": (3, _shaped),
    "gain": (1, _gain_only),
    "constant": (1, _constant),
}
