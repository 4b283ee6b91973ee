"""Functions of the parameters that may be identifiable, the most readable first.

Single parameters; quotients of neighbours; sums of masses, of springs, of dampers and of
compliances; products of powers; sums of quotients k/m (squares of natural frequencies) and d/m of
neighbours; the transfer-function coefficients themselves. Sums and products are not guessed: they
come from linear systems that all of them solve (see `tangent`).

A readable basis of what can be determined: candidates taken greedily until the rank is reached.

A candidate counts if its gradient lies in the row space at every proof point. Were it not
identifiable, a minor of one row more than the rank would not vanish identically, and yet vanish at
all points: a probability that `safety` bounds. That accepted candidates are independent is proven
by one point.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations
from math import ceil, log2

from flint import fmpz

from disting.algebra.certainty import Size, safety
from disting.algebra.quotient import matrix
from disting.algebra.symbols import coefficients
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.transfer import expand
from disting.model.chain import Structure
from disting.questions.identifiability.parts import Exponents, Formula, monomial
from disting.questions.identifiability.tangent import (
    Tangent,
    combinations,
    monomials,
    search_tangents,
)

POINTS = 4
Terms = dict[tuple[int, ...], fmpz]  # coefficients by exponents
_ORDER = "kdbmT"  # numerators first


@dataclass(frozen=True, slots=True)
class Candidate:
    """A function of the parameters; `name` describes it where the formula is missing."""

    formula: Formula
    name: str = ""


@dataclass(frozen=True)
class Candidates:
    """All candidates of a structure whose Jacobian has a kernel of this dimension."""

    structure: Structure
    nullity: int
    seed: str

    def __iter__(self) -> Iterator[Candidate]:
        for stage in (
            self.parameters,
            self.quotients,
            self.sums,
            self.products,
            self.sums_of_quotients,
            self.coefficients,
        ):
            yield from sorted(stage(), key=_length)

    def parameters(self) -> Iterator[Candidate]:
        """Each parameter."""
        return (Candidate(monomial(**{name: 1})) for name in self.structure.parameters)

    def quotients(self) -> Iterator[Candidate]:
        """Quotients of neighbouring elements: k/m, d/m, k/d, k/k, d/d, m/m."""
        places = {e.parameter: e.at + (e.kind in "kd") / 2 for e in self.structure.elements}
        for above, below in permutations(places, 2):
            first = (_ORDER.index(above[0]), places[above]) < (
                _ORDER.index(below[0]),
                places[below],
            )
            if first and abs(places[above] - places[below]) <= 1:
                yield Candidate(monomial(**{above: 1, below: -1}))

    def sums(self) -> Iterator[Candidate]:
        """Sums of parameters of one kind, and of their reciprocals."""
        for power in (1, -1):
            for kind in "mkdb":
                terms = [((name, power),) for name in self.structure.parameters if name[0] == kind]
                yield from self._combine_terms(terms)

    def products(self) -> Iterator[Candidate]:
        """Products of powers: a basis of all that are identifiable, and sums and differences of
        its exponents.
        """
        for powers in _neighbours(monomials(self._tangents(len(self.structure.parameters)))):
            signed = [
                (name, e) for name, e in zip(self.structure.parameters, powers, strict=True) if e
            ]
            leading = min(signed, key=lambda pair: _ORDER.index(pair[0][0]))
            sign = 1 if leading[1] > 0 else -1
            yield Candidate(Formula(((1, tuple((name, sign * e) for name, e in signed)),)))

    def sums_of_quotients(self) -> Iterator[Candidate]:
        """Sums of quotients spring/mass, then damper/mass, of neighbours."""
        for kind in "kd":
            joints = [e for e in self.structure.elements if e.kind == kind]
            masses = [e for e in self.structure.elements if e.kind == "m"]
            pairs = [
                (j.parameter, m.parameter)
                for j in joints
                for m in masses
                if m.at in (j.at, j.at + 1)
            ]
            yield from self._combine_terms([((above, 1), (below, -1)) for above, below in pairs])

    def coefficients(self) -> Iterator[Candidate]:
        """The coefficients of the transfer function, the denominator made monic."""
        tops, bottoms = (coefficients(part, "s") for part in expand(self.structure))
        lead = bottoms.pop().to_dict()
        if len(lead) != 1:
            return
        for letter, parts in (("a", bottoms), ("b", tops)):
            for i, part in enumerate(parts):
                yield from (
                    Candidate(f, f"{letter}{i}") for f in self._divide_by_lead(part.to_dict(), lead)
                )

    def _divide_by_lead(self, part: Terms, lead: Terms) -> Iterator[Formula]:
        """part/lead; nothing where it is constant. The ring's first symbol is s."""
        ((below, scale),) = lead.items()
        names = ("s", *self.structure.parameters)
        terms = [
            (
                int(c) * int(scale),
                tuple(
                    (n, int(a - b)) for n, a, b in zip(names, above, below, strict=True) if a != b
                ),
            )
            for above, c in part.items()
        ]
        if any(exponents for _, exponents in terms):
            yield Formula(tuple(terms))

    def _combine_terms(self, terms: Sequence[Exponents]) -> Iterator[Candidate]:
        if len(terms) < 2:
            return
        functions = [Formula(((1, e),)) for e in terms]
        for vector in combinations(self._tangents(len(terms)), functions):
            sign = 1 if sum(vector) >= 0 else -1
            yield Candidate(
                Formula(tuple((sign * c, e) for c, e in zip(vector, terms, strict=True) if c))
            )

    def _tangents(self, unknowns: int) -> list[Tangent]:
        wanted = -(-(unknowns + 2) // self.nullity)
        return list(search_tangents(self.structure, self.seed, wanted))


def _neighbours(basis: list[list[int]]) -> list[list[int]]:
    """Short vectors of a lattice: the basis, and sums and differences of two of it."""
    pairs = [(a, b) for i, a in enumerate(basis) for b in basis[:i]]
    return basis + [
        [x + sign * y for x, y in zip(a, b, strict=True)] for a, b in pairs for sign in (1, -1)
    ]


def _length(candidate: Candidate) -> tuple[int, int, int]:
    """Number of terms, then of factors, squares counting as two more, then of dampers: what is
    short is read first.
    """
    terms = candidate.formula.terms
    powers = [(name, abs(e)) for _, exponents in terms for name, e in exponents]
    factors = sum(abs(c) for c, _ in terms) + sum(3 * e - 2 for _, e in powers)
    return len(terms), factors, sum(name[0] == "d" for name, _ in powers)


@dataclass(frozen=True, slots=True)
class Basis:
    """Identifiable parameters, independent identifiable functions, and the error bound
    2**-safety of all of it (0: proven).
    """

    singles: tuple[Candidate, ...]
    chosen: tuple[Candidate, ...]
    safety: int


def basis(structure: Structure, proof: Sequence[Tangent], rank: int, seed: str) -> Basis:
    """The basis; `proof` holds independent points, `rank` is the largest rank among them."""
    candidates = Candidates(structure, len(structure.parameters) - rank, seed)
    parameters = tuple(candidates.parameters())
    if rank == len(structure.parameters):
        return Basis(parameters, parameters, 0)
    at = next(t for t in proof if t.rank == rank)
    singles = tuple(c for c in parameters if _identifiable(c, proof))
    chosen, tested = list[Candidate](), list(parameters)
    for candidate in candidates:
        if len(chosen) == rank:
            break
        if _rank([*chosen, candidate], at) > len(chosen):
            tested.append(candidate)
            chosen += [candidate] if _identifiable(candidate, proof) else []
    return Basis(singles, tuple(chosen), _safety(structure, tested, len(proof)))


def _identifiable(candidate: Candidate, proof: Sequence[Tangent]) -> bool:
    return all(t.sees(candidate.formula.gradient(t.values, t.modulus)) for t in proof)


def _rank(candidates: Sequence[Candidate], at: Tangent) -> int:
    rows = [c.formula.gradient(at.values, at.modulus) for c in candidates]
    return int(matrix(rows, len(at.values), at.modulus).rank())


def _safety(structure: Structure, tested: Sequence[Candidate], points: int) -> int:
    """Bound for all tests and the rank: one more row in the largest minor, and as many
    statements as tests.
    """
    minor, sizes = ChainModel(structure).minor_size(None), [c.formula.size for c in tested]
    rows = len(structure.parameters) + 1
    bits = minor.bits + max(s.bits for s in sizes) + ceil(log2(rows))
    return safety(Size(minor.degree + max(s.degree for s in sizes), bits), points) - ceil(
        log2(len(tested) + 1)
    )
