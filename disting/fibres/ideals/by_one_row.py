"""Two damped chains of equal rank that differ because one of their rows does.

Neither has a gap: each is one free row, and the question is that of the rows.

The searched one has a gap h: were the closures of both equal, generic models of the given chain
would have equivalents with elements other than zero, and by the theorem of `splits` in one of the
splits both rows would have the receptances that are there. Every other split than that of the
same rows must be refuted by a Markov parameter (`by_two_rows.vanishing`), or not exist. In that of
the same rows (gap h on both sides) a generic row of the given chain would be a row, of the same
kind, of the searched one. Both have equally many parameters and, where the rank is full, closures
of equal dimension: these would be equal. So an answer that two rows of full rank differ refutes
it, whichever of the two is the given one.
"""

from disting.evidence.ideals import ByRow
from disting.fibres.ideals.by_two_rows import not_covered, vanishing_step
from disting.fibres.ideals.row_answers import known_answers
from disting.fibres.ideals.splits import gap, is_plain, power, receptances, splits
from disting.fibres.ideals.zeros import Branched, confirms_branches
from disting.model.row import Row, rows_of
from disting.model.structure import Structure


def differ_by_row(a: Structure, b: Structure) -> ByRow | None:
    """The proof, but for its bound, that two chains of equal rank differ, by an answer that is
    known; None if there is none.
    """
    for name, pair in row_pairs(a, b):
        answer = known_answers().get(pair)
        if answer is not None:
            row, searched = answer.given, answer.searched
            told = (row.ports, searched.ports, answer.label, answer.branches, answer.degree)
            return ByRow(name, row.grounded, row.n_masses, *told)
    return None


def row_pairs(a: Structure, b: Structure, label: str = "rows") -> list[tuple[str, frozenset[Row]]]:
    """The rows, by name ("whole" without a gap), of which each pair that differs makes the two
    chains differ; they are canonical chains.
    """
    if not _comparable(a, b) or not (
        gap(a) == 0 or _same_rows_only(a, b, label) or _same_rows_only(b, a, label)
    ):
        return []
    found = [
        ("whole" if here.is_whole else here.name, frozenset((here.canonical, there.canonical)))
        for here, there in zip(rows_of(a), rows_of(b), strict=True)
    ]
    return [(name, pair) for name, pair in found if len(pair) == 2]


def _comparable(a: Structure, b: Structure) -> bool:
    """Whether both are plain and damped, of one size, sensor and gap."""
    kinds = [(s.n_masses, s.sensor_order, gap(s), power(s)) for s in (a, b)]
    return is_plain(a) and is_plain(b) and kinds[0] == kinds[1] and power(a) == 2


def _same_rows_only(given: Structure, other: Structure, label: str) -> bool:
    """Whether an equivalent of `given` in `other` has the same rows, without any chance."""
    if not_covered(given, other, f"{label}:poles"):
        return False
    return all(
        vanishing_step(s, receptances(other)) for s in splits(given, gap(other)) if s.name != "same"
    )


def confirms_row(evidence: ByRow, a: Structure, b: Structure) -> bool:
    """Whether the evidence holds of two structures: all of it is computed again."""
    told = {
        Row(evidence.masses, evidence.wall, *ports, damped=True): ports
        for ports in (evidence.given, evidence.searched)
    }
    for name, pair in row_pairs(a, b, "verify"):
        if name == evidence.part and pair == told.keys():
            given = next(row for row, ports in told.items() if ports == evidence.given)
            (searched,) = pair - {given}
            return confirms_branches(
                Branched(
                    given=given,
                    searched=searched,
                    label=evidence.label,
                    branches=evidence.branches,
                    degree=evidence.degree,
                )
            )
    return False
