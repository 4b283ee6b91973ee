"""All pairs of a list of models as CSV and JSON, as `export` writes those of a catalogue."""

from collections.abc import Sequence

from disting.algebra.certainty import Certainty
from disting.catalogs.export import cell, csv_text, inclusion_text, premise_text, share_text
from disting.conditions.inclusion import Sense
from disting.files import Format, json_text
from disting.model.question import Domain
from disting.verdict.decisions import Decisions
from disting.verdict.joint import family_safety
from disting.verdict.result import error_bound


def decisions_csv(decided: Decisions) -> str:
    """CSV text of all pairs, models numbered from 1, or named N:I where they are of several
    sizes.
    """
    names = [cell(name) for name in _names(decided)]

    def rest(i: int, j: int) -> tuple[Domain, str, str, str, str, str, str]:
        """Domain, image, closure, the positive equivalents of both sides, damping, quantity."""
        sides = decided.subjects[i].premise, decided.subjects[j].premise
        own_share, other_share = (share_text(decided.shares.get(way)) for way in ((i, j), (j, i)))
        image, closure = (inclusion_text(decided.inclusion(i, j, sense)) for sense in Sense)
        return (
            decided.query.view.domain,
            image,
            closure,
            own_share,
            other_share,
            *premise_text(*sides),
        )

    graded = (
        (
            names[i],
            names[j],
            decided.relation(i, j),
            rule,
            where,
            certainty,
            error_bound(certainty, safety),
            *rest(i, j),
        )
        for i, j, rule, where, certainty, safety in decided.grades()
    )
    return csv_text(graded)


def _names(decided: Decisions) -> Sequence[int | str]:
    """Numbers from 1 for the numbered chains of one size, named 3:1, .. or A1, .., else the
    subjects' names.
    """
    names, sizes = [s.name for s in decided.subjects], set(decided.sizes)
    numbers = range(1, len(names) + 1)
    heads = ("A", f"{min(sizes)}:") if len(sizes) == 1 else ()
    numbered = any(names == [f"{head}{number}" for number in numbers] for head in heads)
    return numbers if numbered else names


def decisions_json(decided: Decisions) -> str:
    """JSON text of all pairs with evidence and sentences; `joint_error_bound` is that of all of
    it together.
    """
    size = len(decided.subjects)
    pairs = ((i, j) for i in range(size) for j in range(i + 1, size))
    names = _names(decided)
    # one after the other: together they take more memory than their text
    verdicts = (
        decided.verdict(i, j).to_dict() | {"left": names[i], "right": names[j]} for i, j in pairs
    )
    safety = family_safety(decided)
    bound = error_bound(Certainty.BOUNDED if safety else Certainty.PROVEN, safety)
    plain = {"format": Format.VERDICTS.value, "joint_error_bound": bound, "verdicts": []}
    return f"{json_text(plain).removesuffix(']}')}{','.join(map(json_text, verdicts))}]}}\n"
