"""Part of a model that another one reaches: the exact conditions on its positive values, where they
are short.

Unknowns are solved for case by case (`disting.general.cases`), each case being kept with what has
to be positive in it. If all cases are sections, or have one equation left in their last unknown x,
almost all values p of the given model have a positive equivalent in the other one exactly if in one
of the cases all polynomials are positive, and the equation has a positive root at which they are.
Only if: every equivalent of a generic p belongs to a case. If: the further conditions of a case,
that denominators are not zero, are polynomials without a factor in common with the equation, which
is irreducible, so at a root none of them vanishes for generic p.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from flint import fmpz_mpoly

from disting.general.elimination import Case
from disting.general.expression import polynomial_text
from disting.general.matrix_model import AnyModel
from disting.general.orthant import Effort
from disting.general.which_models import Way, way
from disting.model.question import Domain, Question, Settings

SHORT = Effort(orders=2, terms=1000)
MOST_PARAMETERS = 5  # of either model: conditions of more are seldom short
MOST_TERMS = 8  # of a polynomial that is written out
MOST_PIECES = 4
ROOTS = ("x", "root", "x_")


@dataclass(frozen=True, slots=True)
class Piece:
    """Where all of `positive` are positive; where there is an `equation`, it has a positive root
    at which they are: of the name `root`, the value of `parameter` in the other model.
    """

    positive: tuple[str, ...]
    equation: str = ""
    root: str = ""
    parameter: str = ""


@dataclass(frozen=True, slots=True)
class Reach:
    """Where a model has positive equivalents in another one, special values aside: in any of the
    pieces, everywhere if one of them has no condition, nowhere if there are none.
    """

    pieces: tuple[Piece, ...]

    @property
    def is_everything(self) -> bool:
        """True if there is no condition."""
        return Piece(()) in self.pieces

    def sentence(self, text: str, other: str) -> str:
        """The conditions in words; "" where nothing, or everything, is reached.

        >>> Reach((Piece(("R2 - R3",)),)).sentence("A1", "A2")
        'A1 has a positive equivalent A2 exactly where R2 > R3, special values aside.'
        """
        if self.is_everything or not self.pieces:
            return ""
        where = ", or where ".join(_describe_piece(piece, other) for piece in self.pieces)
        has = f"{text} has a positive equivalent {other} exactly where"
        return f"{has} {where}, special values aside."


def _describe_piece(piece: Piece, other: str) -> str:
    conditions = " and ".join(map(inequality, piece.positive))
    if not piece.equation:
        return conditions
    at = f" with {conditions}" if conditions else ""
    root = f"{piece.equation} = 0 has a positive root {piece.root}{at}"
    return f"{root}, the {piece.parameter} of {other}"


def inequality(polynomial: str) -> str:
    """A polynomial that is positive, its negative terms on the other side.

    >>> inequality("-C1*R2**2 + L1"), inequality("x + 1")
    ('L1 > C1*R2**2', 'x + 1 > 0')
    """
    terms = polynomial.replace(" - ", " + -").split(" + ")
    sides = [t for t in terms if t[0] != "-"], [t[1:] for t in terms if t[0] == "-"]
    return " > ".join(" + ".join(side) or "0" for side in sides)


def reach(model: AnyModel, other: AnyModel) -> Reach | None:
    """Conditions on the positive values of the one model that have a positive equivalent in the
    other one; None where they are unknown or not short. Both have the same degrees.

    >>> from disting.general.any_model import of_network, on_one_variable
    >>> from disting.network import network_of
    >>> texts = "1>0, 1>2, 2>0; in 1; out 2", "1>0, 1>2, 2>1; in 2; out 1"
    >>> one, two = on_one_variable([of_network(network_of(text)) for text in texts])
    >>> reach(one, two).pieces
    (Piece(positive=('a12 - a20',), equation='', root='', parameter=''),)
    """
    if max(len(m.parameters) for m in (model, other)) > MOST_PARAMETERS:
        return None
    this_way = way(model, other, Domain.POSITIVE, SHORT)
    if this_way is None:
        return None
    if this_way.covering or this_way.path():
        return Reach((Piece(()),))
    pieces = list(_pieces(this_way))
    if None in pieces or len(pieces) > MOST_PIECES:
        return None
    return Reach(_least([p for p in pieces if p]))


def _compute_reach(model: AnyModel, other: AnyModel, settings: Settings) -> Reach | None:
    return reach(model, other)


def _to_dict(the_reach: Reach | None) -> object:
    return the_reach and [
        [list(p.positive), p.equation, p.root, p.parameter] for p in the_reach.pieces
    ]


def _from_dict(data: Any) -> Reach | None:
    if data is None:
        return None
    return Reach(tuple(Piece(tuple(positive), *root) for positive, *root in data))


REACHED = Question.plain(
    "conditions for positive equivalents", _compute_reach, _to_dict, _from_dict
)


def _pieces(this_way: Way) -> Iterator[Piece | None]:
    """Yield the conditions of each case, None of one that is not short."""
    names = [*this_way.given.parameters, *(f"{i}'" for i in this_way.other.parameters), "t'"]
    for section in this_way.parted.sections:
        yield None if _is_long(section.where) else Piece(_texts(section.where, names))
    for case in this_way.parted.others:
        yield _at_root(this_way, case, names)


def _at_root(this_way: Way, case: Case, names: Sequence[str]) -> Piece | None:
    ring = this_way.parted.search.ring
    free = ring.occurring((*case.equations, *case.positive))
    if len(case.equations) != 1 or len(free) != 1 or _is_long((*case.equations, *case.positive)):
        return None
    (at,), (equation,) = free, case.equations
    if not equation.degrees()[at]:
        return None
    root = next(n for n in ROOTS if n not in this_way.given.parameters)
    called = [root if i == at else name for i, name in enumerate(names)]
    conditions = [g for g in case.positive if g != ring.generators[at]]
    return Piece(
        _texts(conditions, called),
        polynomial_text(equation, called),
        root,
        this_way.other.parameters[at - ring.n_given],
    )


def _is_long(polynomials: Sequence[fmpz_mpoly]) -> bool:
    return any(len(g) > MOST_TERMS for g in polynomials)


def _texts(polynomials: Sequence[fmpz_mpoly], names: Sequence[str]) -> tuple[str, ...]:
    return tuple(sorted(polynomial_text(g, names) for g in polynomials))


def _least(pieces: Sequence[Piece]) -> tuple[Piece, ...]:
    """Without pieces whose conditions include all those of another one."""
    every = list(dict.fromkeys(pieces))
    return tuple(p for p in every if not any(_asks_for_less(q, p) for q in every))


def _asks_for_less(piece: Piece, other: Piece) -> bool:
    same = piece.equation in ("", other.equation)
    return piece != other and same and set(piece.positive) <= set(other.positive)
