"""Values of a one-port of two kinds of elements, in series and parallel, from its function: by
Foster's sums and Cauer's continued fractions, whatever its branches are.

Let F(x) be of K(n, c, z) (see `disting.network.normal_form`): a constant if c, k_0/x if z, and n
terms k_i/(x + a_i). In series F is the sum over the branches: the constant and k_0/x go to the
branch that has one, the terms are shared by their numbers; with one branch of terms that needs no
roots, with more of them the denominator is a product of as many polynomials. For a branch in
parallel 1/(x F) is treated likewise, with both kinds exchanged. Every share is what a branch can
be, and is positive for positive values (the theorem there). So all values are fractions where the
denominators have the factors that are needed; one of degree 2 gives its roots by a square root.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product
from math import prod
from typing import Any, Protocol

from disting.general.field import Arithmetic, Poly
from disting.network.network import Element
from disting.network.normal_form import Part, Power, dual, in_parallel, in_series

Cut = list[tuple[int, ...]]
"""For each branch the positions of its factors."""
FieldValues = dict[str, Any]


class BranchShape(Protocol):
    """Shape of a group of branches: branches of one shape are interchangeable."""

    @property
    def shape(self) -> tuple[object, ...]:
        """Key of the shape."""


class NoFormulas(Exception):
    """Why values are not found as fractions and square roots."""


class NeedsRoots(NoFormulas):
    """They are roots of a polynomial of a higher degree."""


@dataclass(frozen=True, slots=True)
class Tree:
    """An element, or branches in series ("S") or parallel ("P"), and what it can be."""

    form: str
    part: Part
    inside: tuple["Tree", ...] = ()
    element: Element | None = None

    @property
    def shape(self) -> tuple[object, ...]:
        """The same of trees that differ by names and orders alone."""
        return self.form, self.part, tuple(sorted((t.shape for t in self.inside), key=repr))

    @property
    def elements(self) -> tuple[Element, ...]:
        """All that it is made of."""
        own = (self.element,) if self.element else ()
        return (*own, *(e for t in self.inside for e in t.elements))


def leaf(element: Element) -> Tree:
    """An element as a tree."""
    return Tree("", Part("S", (element.power,)), (), element)


def series(trees: Iterable[Tree]) -> Tree:
    """Branches one after the other."""
    return _join_trees("S", trees)


def parallel(trees: Iterable[Tree]) -> Tree:
    """Branches side by side."""
    return _join_trees("P", trees)


def _join_trees(form: str, trees: Iterable[Tree]) -> Tree:
    flat = tuple(t for tree in trees for t in (tree.inside if tree.form == form else (tree,)))
    if len(flat) == 1:
        return flat[0]
    join = in_series if form == "S" else in_parallel
    return Tree(form, join(t.part for t in flat), flat)


@dataclass(frozen=True, slots=True)
class Share:
    """Share of a branch: its number of terms, and whether it has the constant and the pole at 0."""

    terms: int
    constant: bool
    pole: bool


def synthesize(
    field: Arithmetic,
    tree: Tree,
    top: Poly,
    bottom: Poly,
    kinds: tuple[Power | None, Power | None],
    view: str = "S",
) -> Iterator[FieldValues]:
    """Yield the values at which the tree is top/bottom, one lot for each way to share the terms;
    `kinds`: that of a constant and that of a pole at 0, in `view` "S" of F, "P" of 1/(x F). Raises
    NoFormulas.
    """
    if tree.element is not None:
        yield _value(field, tree.element, view, top, bottom)
        return
    if tree.form != view:
        yield from synthesize(field, tree, *_inverse(field, top, bottom), kinds, tree.form)
        return
    part, other = kinds if view == "S" else kinds[::-1]
    shares = [_share(t.part, view, part, other) for t in tree.inside]
    _note_choice(field, tree.inside, shares)
    for parts in _part_functions(field, tree.inside, shares, top, bottom):
        pairs = [
            list(synthesize(field, t, *f, kinds, view))
            for t, f in zip(tree.inside, parts, strict=True)
        ]
        for chosen in product(*pairs):
            yield {name: x for values in chosen for name, x in values.items()}


def _share(part: Part, view: str, low: Power | None, high: Power | None) -> Share:
    if len(part.kinds) > 1:
        part = part if part.form == view else dual(part)
    count = sum(n for _, n in part.terms)
    return Share(count, low in part.single, high in part.single)


def _note_choice(field: Arithmetic, trees: Sequence[Tree], shares: Sequence[Share]) -> None:
    """Note which branches share a part of which only the sum is determined."""
    for has in ([s.constant for s in shares], [s.pole for s in shares]):
        sharing = [e.value for t, h in zip(trees, has, strict=True) if h for e in t.elements]
        if sum(has) > 1:
            field.choose(sharing)


def _inverse(field: Arithmetic, top: Poly, bottom: Poly) -> tuple[Poly, Poly]:
    """1/(x F); a pole of F at 0 is found by its first coefficient."""
    if field.is_zero(bottom[0]):
        return bottom[1:], top
    return bottom, (field.zero, *top)


def _value(field: Arithmetic, element: Element, view: str, top: Poly, bottom: Poly) -> FieldValues:
    """Of a constant top/bottom, or a pole at 0."""
    constant = top[0] / bottom[-1]
    is_inverse = (view == "S") is not element.kind.divides
    return {element.value: field.short(field.one / constant if is_inverse else constant)}


def _part_functions(
    field: Arithmetic, trees: Sequence[Tree], shares: Sequence[Share], top: Poly, bottom: Poly
) -> Iterator[list[tuple[Poly, Poly]]]:
    """Yield the functions of all branches, for every way to share the terms."""
    zero = field.zero
    many = [i for i, s in enumerate(shares) if s.terms]
    constants, poles = sum(s.constant for s in shares), sum(s.pole for s in shares)
    count = sum(s.terms for s in shares)
    if len(bottom) - 1 != count + bool(poles) or len(top) != len(bottom) - 1 + bool(constants):
        raise NoFormulas("both do not give functions of one set")
    alone = shares[many[0]] if len(many) == 1 else Share(0, False, False)
    keeps = Share(0, alone.constant and constants == 1, alone.pole and poles == 1)
    constant, pole, rest, left = zero, zero, top, bottom
    if constants and not keeps.constant:
        constant = field.short(top[-1] / bottom[-1])
        rest = field.plus(rest, left, -constant)[:-1]
    if poles and not keeps.pole:
        pole = field.short(top[0] / bottom[1])
        left = left[1:]
        rest = field.plus(rest, left, -pole)[1:]
    for terms in share_terms(field, [(i, trees[i], shares[i].terms) for i in many], rest, left):
        pairs = list[tuple[Poly, Poly]]()
        for i, share in enumerate(shares):
            above, below = terms.get(i, ((), (field.one,)))
            if share.constant and not keeps.constant:
                above = field.plus(above, below, constant / field.number(constants))
            if share.pole and not keeps.pole:
                part = pole / field.number(poles)
                above, below = field.plus((zero, *above), below, part), (zero, *below)
            pairs.append((above, below))
        yield pairs


def share_terms(
    field: Arithmetic, branches: Sequence[tuple[int, BranchShape, int]], top: Poly, bottom: Poly
) -> Iterator[dict[int, tuple[Poly, Poly]]]:
    """Yield the terms of branches, by their places: of so many terms each."""
    if len(branches) < 2:
        yield {place: (top, bottom) for place, _, _ in branches}
        return
    for factors, cut in _partitions(field, branches, bottom):
        terms = _partial(field, factors, top, bottom)
        functions = dict[int, tuple[Poly, Poly]]()
        for (place, _, _), chosen in zip(branches, cut, strict=True):
            below = field.times(*(factors[i] for i in chosen))
            above: Poly = ()
            for i in chosen:
                others = field.times(*(factors[j] for j in chosen if j != i))
                above = field.plus(above, field.times(terms[i], others))
            functions[place] = above, below
        yield functions


def _partitions(
    field: Arithmetic, branches: Sequence[tuple[int, BranchShape, int]], bottom: Poly
) -> Iterator[tuple[list[Poly], Cut]]:
    """Yield factors of a denominator and which of them each branch has; quadratic ones are split
    where that is needed.
    """
    factors = field.factors(bottom)
    wanted = [(count, tree.shape) for _, tree, count in branches]
    cuts = list(_cuts([len(f) - 1 for f in factors], wanted))
    if not cuts:
        factors = [g for f in factors for g in field.linear(f)]
        cuts = list(_cuts([len(f) - 1 for f in factors], wanted))
    if not cuts:
        degree = max(len(f) - 1 for f in factors)
        raise NeedsRoots(f"roots of a polynomial of degree {degree} are needed")
    for cut in cuts:
        yield factors, cut


def _cuts(degrees: Sequence[int], wanted: Sequence[tuple[int, object]]) -> Iterator[Cut]:
    """Yield positions for each branch whose degrees add up to what it wants; branches that are
    alike can exchange theirs, which is one way.
    """
    pairs = [(i, j) for i, j in combinations(range(len(wanted)), 2) if wanted[i] == wanted[j]]
    for cut in _every_cut(tuple(range(len(degrees))), degrees, [count for count, _ in wanted]):
        if all(cut[i] < cut[j] for i, j in pairs):
            yield cut


def _every_cut(
    left: tuple[int, ...], degrees: Sequence[int], wanted: Sequence[int]
) -> Iterator[Cut]:
    if not wanted:
        yield []
        return
    for size in range(1, len(left) + 1):
        for chosen in combinations(left, size):
            if sum(degrees[i] for i in chosen) == wanted[0]:
                rest = tuple(i for i in left if i not in chosen)
                yield from ([chosen, *cut] for cut in _every_cut(rest, degrees, wanted[1:]))


def _partial(field: Arithmetic, factors: Sequence[Poly], top: Poly, bottom: Poly) -> list[Poly]:
    """The numerators P_i of top/bottom = sum P_i/factor_i: P_i (bottom/factor_i) = top modulo
    factor_i.
    """
    leads = [f[-1] for f in factors]
    scale = field.short(bottom[-1] / prod(leads, start=field.one))
    pairs = list[Poly]()
    for i, f in enumerate(factors):
        others = [*(g for j, g in enumerate(factors) if j != i), (scale,)]
        below: Poly = (field.one,)
        for g in others:
            below = _modulo(field, field.times(below, _modulo(field, g, f)), f)
        pairs.append(_quotient(field, _modulo(field, top, f), below, f))
    return pairs


def _modulo(field: Arithmetic, polynomial: Poly, by: Poly) -> Poly:
    """The remainder."""
    rest, degree = polynomial, len(by) - 1
    while len(rest) > degree:
        factor = field.short(rest[-1] / by[-1])
        shifted = (*[field.zero] * (len(rest) - len(by)), *by)
        rest = field.plus(rest, shifted, -factor)[:-1]
    return rest


def _quotient(field: Arithmetic, top: Poly, bottom: Poly, by: Poly) -> Poly:
    """P with P bottom = top modulo a polynomial: linear equations for its coefficients."""
    zero, degree = field.zero, len(by) - 1
    columns = [_modulo(field, (*[zero] * k, *bottom), by) for k in range(degree)]
    rows = [
        [*((*c, *[zero] * degree)[i] for c in columns), (*top, *[zero] * degree)[i]]
        for i in range(degree)
    ]
    for at in range(degree):
        pivot = next((r for r in rows[at:] if not field.is_zero(r[at])), None)
        if pivot is None:
            raise NoFormulas("two terms of the function have one pole")
        rows.insert(at, rows.pop(rows.index(pivot)))
        for r in rows[at + 1 :]:
            factor = field.short(r[at] / pivot[at])
            r[at:] = [field.short(a - factor * b) for a, b in zip(r[at:], pivot[at:], strict=True)]
    solution = list[Any]()
    for r in reversed(rows):
        row_after = r[degree - len(solution) : degree]
        total = sum((a * b for a, b in zip(row_after, solution, strict=True)), zero)
        solution.insert(0, field.short((r[-1] - total) / r[degree - 1 - len(solution)]))
    return tuple(solution)
