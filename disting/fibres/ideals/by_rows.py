"""Two damped chains of equal rank that differ because one of their rows does.

Neither has a gap: each is one free row, and the question is that of the rows.

The searched one has a gap h: were the closures of both equal, generic models of the given chain
would have equivalents with elements other than zero, and by the theorem of `parts` in one of the
splits both parts would have the receptances that are there. Every other split than that of the
same parts must be refuted by a Markov parameter (`by_parts.vanishing`), or not exist. In that of
the same parts (gap h on both sides) a generic row of the given chain would be a row, of the same
kind, of the searched one. Both have equally many parameters and, where the rank is full, closures
of equal dimension: these would be equal. So an answer that two rows of full rank differ refutes
it, whichever of the two is the given one.
"""

from disting.evidence.ideals import ByRow
from disting.fibres.ideals.by_two_rows import not_covered, vanishing_step
from disting.fibres.ideals.parts import gap, is_plain, parts, power, splits
from disting.fibres.ideals.row_answers import known_answers
from disting.fibres.ideals.rows import DampedRow, rows_of
from disting.fibres.ideals.zeros import Branched, confirms_branches
from disting.model.structure import Structure

PARTS = ("grounded", "free")


def differ_by_row(a: Structure, b: Structure) -> ByRow | None:
    """The proof, but for its bound, that two chains of equal rank differ, by an answer that is
    known; None if there is none.
    """
    for part, pair in row_pairs(a, b):
        answer = known_answers().get(pair)
        if answer is not None:
            row = answer.given
            told = (
                answer.given.ports,
                answer.searched.ports,
                answer.label,
                answer.branches,
                answer.degree,
            )
            return ByRow(part, row.wall, row.masses, *told)
    return None


def row_pairs(
    a: Structure, b: Structure, label: str = "rows"
) -> list[tuple[str, frozenset[DampedRow]]]:
    """The rows, by their part, of which each pair that differs makes the two chains differ;
    they are canonical chains.
    """
    if not _comparable(a, b) or not (
        gap(a) == 0 or _same_parts_only(a, b, label) or _same_parts_only(b, a, label)
    ):
        return []
    found = zip(
        PARTS if gap(a) else ("whole",),
        map(frozenset, zip(rows_of(a), rows_of(b), strict=True)),
        strict=True,
    )
    return [(part, pair) for part, pair in found if len(pair) == 2]


def _comparable(a: Structure, b: Structure) -> bool:
    """Whether both are plain and damped, of one size, sensor and gap."""
    kinds = [(s.n_masses, s.sensor_order, gap(s), power(s)) for s in (a, b)]
    return is_plain(a) and is_plain(b) and kinds[0] == kinds[1] and power(a) == 2


def _same_parts_only(given: Structure, other: Structure, label: str) -> bool:
    """Whether an equivalent of `given` in `other` has the same parts, without any chance."""
    if not_covered(given, other, f"{label}:poles"):
        return False
    return all(
        vanishing_step(s, parts(other)) for s in splits(given, gap(other)) if s.name != "same"
    )


def confirms_row(evidence: ByRow, a: Structure, b: Structure) -> bool:
    """Whether the evidence holds of two structures: all of it is computed again."""
    for part, pair in row_pairs(a, b, "verify"):
        rows = {(r.wall, r.masses, r.ports) for r in pair}
        if part == evidence.part and rows == {
            (evidence.wall, evidence.masses, p) for p in (evidence.given, evidence.searched)
        }:
            given = next(r for r in pair if r.ports == evidence.given)
            (searched,) = pair - {given}
            return confirms_branches(
                Branched(given, searched, evidence.label, evidence.branches, evidence.degree)
            )
    return False
