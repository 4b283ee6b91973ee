"""Number of parameter vectors of a model with one generic transfer function, and the values that it
determines.

The equivalents of a model in itself (see `cases`, over the complex numbers) are written down as
fractions of its parameters p, or by the roots of one irreducible polynomial of degree d over the
field of fractions of the p, where they are d vectors. A parameter is globally identifiable if it
is p_j in all of them. Two vectors of different fractions of the p differ for generic p; so do
those of roots of different irreducible polynomials for one unknown, and those of one polynomial
whose values differ at its roots: cases that differ in no value modulo the polynomial are one.
Cases in which roots of different unknowns are left may overlap, so that the number is not known.

Identifiable combinations: the coefficients of the monic transfer function are determined by it;
together they determine all that is. Of them, and of parameters that are globally identifiable, as
many independent ones as the rank are listed, the shortest first.
"""

import json
from dataclasses import asdict, dataclass

from flint import nmod_mat

from disting.algebra.certainty import Certainty, prime, residues
from disting.algebra.symbols import RationalFunction
from disting.general.behaviour import evaluate
from disting.general.cases import ORDERS
from disting.general.expression import text_of
from disting.general.identifiability import LocalIdentifiability, local_identifiability
from disting.general.matrix_model import AnyModel
from disting.general.orthant import Orthant
from disting.general.vectors import count_vectors, fewest_equations, is_unique, vectors_of
from disting.model.presentation import NotebookTable, summary
from disting.model.question import Domain, Question, Settings

CHEAP_UP_TO, TRIES = 8, 4  # parameters, and tries: a second or two
SETTINGS = Settings()


@dataclass(frozen=True, slots=True)
class GlobalIdentifiability(NotebookTable):
    """`count` of complex parameter vectors with one generic transfer function: None if infinite or
    not known.

    `unique`: parameters with one value in all of them, proven. `combinations`: independent
    functions that the transfer function determines, as many as `local.rank`; `local` has the rank
    and the locally identifiable parameters with their error bound.
    """

    local: LocalIdentifiability
    count: int | None
    is_infinite: bool
    unique: tuple[str, ...]
    combinations: tuple[str, ...]
    exponents: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return summary(self, self.sentence)

    @property
    def sentence(self) -> str:
        """The finding in plain English."""
        phrase = self._of_values
        if self.exponents:
            return f"{', '.join(self.exponents)} given: {phrase[0].lower()}{phrase[1:]}"
        return phrase

    @property
    def _of_values(self) -> str:
        n, rank = len(self.local.parameters), self.local.rank
        if rank < n:
            return f"{n} parameters, only {rank} determinable: {', '.join(self.combinations)}."
        if self.count == 1:
            return f"All {n} parameters are globally identifiable."
        many = (
            f"{self.count} sets of them fit"
            if self.count
            else "how many sets of them fit is not known"
        )
        some = f"; globally identifiable are {', '.join(self.unique)}" if self.unique else ""
        return f"All {n} parameters are locally identifiable, {many}{some}."


def global_identifiability(
    model: AnyModel, settings: Settings = SETTINGS, *, tries: int = ORDERS
) -> GlobalIdentifiability:
    """Count the parameter vectors that fit and find the determined values, from this number of
    `tries` of orders in which unknowns are solved for. Raises InputError for what is no model.

    >>> from disting.general.matrix_model import Model
    >>> found = global_identifiability(Model.from_transfer_function("c", "(s + a)*(s + b)"))
    >>> found.count, found.unique, found.combinations
    (2, ('c',), ('c', 'a*b', 'a + b'))
    """
    local = local_identifiability(model, settings)
    ring = Orthant(len(model.parameters), len(model.parameters), Domain.COMPLEX)
    search = fewest_equations(ring, model, tries)
    vectors = vectors_of(ring, model, search.cases) if search else []
    count, infinite = count_vectors(ring, search.cases if search else (), vectors)
    unique = tuple(
        name
        for i, name in enumerate(model.parameters)
        if vectors and is_unique(ring, vectors, i, search)
    )
    return GlobalIdentifiability(
        local=local,
        count=count,
        is_infinite=infinite,
        unique=unique,
        combinations=_combinations(ring, model, local.rank, unique),
        exponents=model.powers.exponents,
    )


def _encode(answer: GlobalIdentifiability) -> str:
    return json.dumps(asdict(answer), separators=(",", ":"))


def _decode(text: str) -> GlobalIdentifiability:
    data = json.loads(text)
    local = data["local"]
    return GlobalIdentifiability(
        local=LocalIdentifiability(
            parameters=tuple(local["parameters"]),
            rank=local["rank"],
            identifiable=tuple(local["identifiable"]),
            certainty=Certainty(local["certainty"]),
            safety=local["safety"],
        ),
        count=data["count"],
        is_infinite=data["is_infinite"],
        unique=tuple(data["unique"]),
        combinations=tuple(data["combinations"]),
        exponents=tuple(data["exponents"]),
    )


def _cheaply(model: AnyModel, settings: Settings) -> GlobalIdentifiability:
    few = len(model.parameters) <= CHEAP_UP_TO
    return global_identifiability(model, settings, tries=TRIES if few else 0)


IDENTIFIABILITY = Question("identifiability of general models", _cheaply, _encode, _decode)


def _combinations(
    ring: Orthant, model: AnyModel, rank: int, unique: tuple[str, ...]
) -> tuple[str, ...]:
    """Independent ones, by their gradients modulo a prime: what is independent there is so
    everywhere else.
    """
    polynomial = ring.number(1)
    singles = [
        RationalFunction(ring.generators[i], polynomial)
        for i, name in enumerate(model.parameters)
        if name in unique
    ]
    candidates = [
        *singles,
        *sorted(ring.monic(model), key=lambda r: (len(r.num) + len(r.den), r.num.total_degree())),
    ]
    modulus = prime(":".join(map(str, ("combinations", *model.content[1:]))))
    point = residues(f"combinations:{model.parameters}", ring.path + 1, modulus)
    chosen, rows = list[str](), list[list[int]]()
    for candidate in candidates:
        row = _gradient(candidate, point, modulus)[: len(model.parameters)]
        entries = [x for r in (*rows, row) for x in r]
        if len(chosen) < rank and nmod_mat(len(rows) + 1, len(row), entries, modulus).rank() > len(
            rows
        ):
            chosen.append(
                text_of(candidate, [*model.parameters, *(f"q{i}'" for i in ring.unknowns), "t'"])
            )
            rows.append(row)
    return tuple(chosen)


def _gradient(ratio: RationalFunction, point: list[int], modulus: int) -> list[int]:
    """Gradient of num/den times den^2."""
    sides = [
        [(tuple(map(int, e)), int(c)) for e, c in side.to_dict().items()]
        for side in (ratio.num, ratio.den)
    ]
    (top, above), (bottom, below) = (evaluate(tuple(side), point, modulus) for side in sides)
    return [(a * bottom - b * top) % modulus for a, b in zip(above, below, strict=True)]
