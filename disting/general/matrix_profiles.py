"""What models with several inputs and outputs reveal: samples and profiles of the stacked summary
(`behaviour.stacked`), for conditions 1 to 7, and their one polynomial map.

Constants are proven as for one transfer function. Two monic denominators D1/a1 and D2/a2 are one
and the same exactly if D1 a2 = D2 a1.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache

from disting.algebra.quotient import Quotient
from disting.algebra.sampling import PROOF_BITS, SEARCH_BITS, Size, about, enough, prime, residues
from disting.behaviour.profile import Profile, from_samples, search_labels
from disting.behaviour.sample import Representation, Sample
from disting.behaviour.stacked import label, seen_degrees, shared_poles, stacked_rows
from disting.errors import InputError
from disting.fibres.ideals import Fraction as Ratio
from disting.fibres.ideals import StackedMap, Terms, stacked_maps
from disting.general.matrix_model import MatrixModel
from disting.general.model import Model
from disting.general.profiles import proven_constants
from disting.general.samples import DRAWS, minor_size, quotient
from disting.model.settings import Settings

Constants = dict[str, Fraction]


@lru_cache(maxsize=64)
def matrix_profile(
    model: MatrixModel, representation: Representation, count: int, settings: Settings
) -> Profile:
    """As `profiles.profile` of one transfer function."""
    size = stacked_size(model, representation, count)
    points = enough(size, settings.points)
    seen = list(matrix_samples(model, representation, count, points, settings.seed))
    searches = (
        _drawn(model, representation, count, at, SEARCH_BITS) for at in search_labels(settings.seed)
    )
    known = matrix_constants(model, representation, count)
    degrees = tuple(d for pair in model.degrees for d in pair)
    found = from_samples(
        seen, searches, frozenset(known), degrees, count, model.n_states, size, settings
    )
    values = zip(found.labels, found.constants, strict=True)
    constants = tuple(str(known[name]) if name in known else value for name, value in values)
    return replace(found, constants=constants, safety=found.safety - points)


def matrix_samples(
    model: MatrixModel, representation: Representation, count: int, points: int, seed: str
) -> Iterator[Sample]:
    """Yield samples at independent points, each with its own large prime."""
    labels = (f"{seed}:{k}" for k in range(points))
    return (_drawn(model, representation, count, at, PROOF_BITS) for at in labels)


def stacked_size(model: MatrixModel, representation: Representation, count: int) -> Size:
    """Bounds for the cleared minors of the Jacobian: those of the largest entry, where a difference
    of two denominators has both leading coefficients below it, so twice the power.
    """
    sizes = [minor_size(entry, representation, count) for entry in model.entries]
    twice = 1 + (len(sizes) > 1)
    return Size(
        twice * max(size.degree for size in sizes), twice * max(size.bits for size in sizes)
    )


def matrix_constants(model: MatrixModel, representation: Representation, count: int) -> Constants:
    """Label -> value of the invariants that are proven constant."""
    found: Constants = {}
    for i, entry in enumerate(model.cells):
        if entry is None:
            continue
        known = proven_constants(entry, representation, count)
        shared = None
        if representation is Representation.TF:
            shared = shared_poles(model.degrees, i)
        first = None if shared is None else model.cells[shared]
        if first is not None:
            known = {n: v for n, v in known.items() if n[0] == "b"} | _differences(entry, first)
        found |= {label(name, i, shared): value for name, value in known.items()}
    return found


def matrix_products(
    model: MatrixModel, point: list[int], modulus: int
) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
    """Values and Jacobian columns of the coefficients of all entries, each denominator monic: a
    renaming carries the functions of each entry into those of the same entry.
    """
    quotients = _quotients(model, point, modulus)
    rows = [
        row
        for i, q in enumerate(quotients)
        if q is not None
        for row in stacked_rows([q], [model.degrees[i]], Representation.TF, 0).values()
    ]
    columns = [tuple(slopes[j] for _, slopes in rows) for j in range(len(point))]
    return tuple(value for value, _ in rows), columns


def matrix_maps(*models: MatrixModel) -> tuple[StackedMap, ...]:
    """The maps of models of equal degrees, with names of their own: p1, p2, .."""
    sides = [[(e.numerator_terms, e.denominator_terms) for e in m.entries] for m in models]
    names = [tuple(f"p{i + 1}" for i in range(len(m.parameters))) for m in models]
    return stacked_maps(names, [[_monic(f) for f in side] for side in sides])


def _monic(sides: Ratio) -> Ratio:
    """Both sides with the sign that makes a leading -1 a leading 1."""
    lead = sides[1][-1]
    return (_negated(sides[0]), _negated(sides[1])) if lead[0][1] == -1 else sides


def _negated(side: tuple[Terms, ...]) -> tuple[Terms, ...]:
    return tuple(tuple((e, -c) for e, c in terms) for terms in side)


def _differences(entry: Model, first: Model) -> Constants:
    """Of the monic denominators, where they are proven constant."""
    found: Constants = {}
    one, other = entry.denominator, first.denominator
    mine, theirs = (proven_constants(m, Representation.TF, 0) for m in (entry, first))
    for k in range(entry.n_states):
        name = f"a{k}"
        if one[k] * other[-1] == other[k] * one[-1]:
            found[name] = Fraction(0)
        elif name in mine and name in theirs:
            found[name] = mine[name] - theirs[name]
    return found


def _drawn(
    model: MatrixModel, representation: Representation, count: int, at: str, bits: int
) -> Sample:
    """The sample at the point that the label stands for; special points are drawn again."""
    whole = about(at, *model.content)
    for again in (f"{whole}:{attempt}" for attempt in range(DRAWS)):
        modulus = prime(again, bits)
        point = residues(f"point:{again}", len(model.parameters), modulus)
        quotients = _quotients(model, point, modulus)
        if seen_degrees(quotients) == tuple(d for pair in model.degrees for d in pair):
            rows = stacked_rows(quotients, model.degrees, representation, count)
            values = tuple(value for value, _ in rows.values())
            jacobian = tuple(tuple(slopes) for _, slopes in rows.values())
            return Sample(tuple(rows), values, jacobian, len(point), modulus)
    raise InputError(f"the leading coefficients of {model.name} vanish at {DRAWS} random points")


def _quotients(model: MatrixModel, point: Sequence[int], modulus: int) -> list[Quotient | None]:
    return [None if e is None else quotient(e, point, modulus) for e in model.cells]
