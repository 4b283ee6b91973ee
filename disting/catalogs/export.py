"""Verdicts as CSV and JSON: names and columns are a contract.

Of a catalogue, and of all pairs of a list of models.
"""

import csv
import io
import re
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from disting.algebra.certainty import Certainty
from disting.conditions.inclusion import Inclusion, Sense
from disting.evidence.positive import PositiveFinding
from disting.files import Format, json_text
from disting.model.chain import Premise
from disting.model.question import Domain
from disting.verdict.result import Relation, Verdict, error_bound

if TYPE_CHECKING:  # a catalogue is read without what decides
    from disting.verdict.decisions import Decisions

FORMULA = re.compile(r"(?:^|(?<=[,;])|(?<=[,;] ))[=+@-]")
CSV_COLUMNS = (
    "left",
    "right",
    "relation",
    "decided_by",
    "representation",
    "certainty",
    "error_bound",
    "domain",
    "image",
    "closure",
    "left_positive",
    "right_positive",
    "damped",
    "quantity",
)
ExportRow = tuple[
    int | str, int | str, Relation, str, str, str, str, Domain, str, str, str, str, str, str
]
"""left, right (numbers, or names where models of several sizes are compared), relation, decided_by,
representation, certainty, error bound, domain, image and closure ("" if not known), and which
positive models of the left, and of the right, have a positive equivalent on the other side (""
where that is not decided), and `premise_text`
"""


def csv_text(rows: Iterable[ExportRow]) -> str:
    """CSV text of the rows, left < right, with a header line.

    >>> told = (Relation.DISTINGUISHABLE, "1", "tf", "proven", "0", Domain.COMPLEX)
    >>> row = (1, 2, *told, "neither", "neither", "", "", "true", "acceleration")
    >>> print(csv_text([row]), end="")
    left,right,relation,decided_by,representation,certainty,error_bound,domain,image,closure,left_positive,right_positive,damped,quantity
    1,2,distinguishable,1,tf,proven,0,complex,neither,neither,,,true,acceleration
    """
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(CSV_COLUMNS)
    for left, right, relation, *rest in rows:
        writer.writerow((left, right, relation.value, *map(str, rest)))
    return out.getvalue()


def premise_text(left: Premise | None, right: Premise | None) -> tuple[str, str]:
    """Texts of two columns: whether springs have dampers (true, false) and the sensor quantity, of
    both models where they differ, left/right; "" of models that are no chains.

    >>> from disting import Chain
    >>> premise_text(Chain(2).premise, Chain(2, quantity="position", damped=False).premise)
    ('true/false', 'acceleration/position')
    """
    sides = [
        ("", "")
        if side is None or side.quantity is None
        else (str(side.damped).lower(), side.quantity.value)
        for side in (left, right)
    ]
    damped, quantity = (a if a == b else f"{a}/{b}" for a, b in zip(*sides, strict=True))
    return damped, quantity


def share_text(finding: PositiveFinding | None) -> str:
    """Text of a column: always, sometimes, never, unknown, or "" where it is not decided."""
    return "" if finding is None else finding.share.value


def cell(name: int | str) -> int | str:
    """A name that no spreadsheet takes for a formula: = + - @ at its beginning, or behind what may
    part cells, are written as \\u003d and the like.

    >>> cell("=1+1"), cell("x;@SUM(A1)"), cell("a-b")
    ('\\\\u003d1+1', 'x;\\\\u0040SUM(A1)', 'a-b')
    """
    if isinstance(name, int):
        return name
    return FORMULA.sub(lambda sign: f"\\u{ord(sign[0]):04x}", name)


def inclusion_text(inclusion: Inclusion) -> str:
    """Text of a column, "" where it is not known."""
    return "" if inclusion is Inclusion.UNKNOWN else inclusion.value


def csv_row(left: int, right: int, v: Verdict) -> ExportRow:
    """The row of a verdict on two numbered models."""
    image, closure = (inclusion_text(inclusion) for inclusion in (v.image, v.closure))
    graded = (v.relation, v.decided_by, v.representation, v.certainty or "", v.error_bound)
    return (
        left,
        right,
        *graded,
        v.domain,
        image,
        closure,
        share_text(v.left_positive),
        share_text(v.right_positive),
        *premise_text(*v.premises),
    )


def decisions_csv(decided: "Decisions") -> str:
    """CSV text of all pairs, models numbered from 1, or named N:I where they are of several
    sizes.
    """
    names = [cell(name) for name in _names(decided)]

    def rest(i: int, j: int) -> tuple[Domain, str, str, str, str, str, str]:
        """Domain, image, closure, the positive equivalents of both sides, damping, quantity."""
        sides = decided.subjects[i].view.premise, decided.subjects[j].view.premise
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


def _names(decided: "Decisions") -> Sequence[int | str]:
    """Numbers from 1 for the numbered chains of one size, named 3:1, .. or A1, .., else the
    subjects' names.
    """
    names, sizes = [s.name for s in decided.subjects], set(decided.sizes)
    numbers = range(1, len(names) + 1)
    heads = ("A", f"{min(sizes)}:") if len(sizes) == 1 else ()
    numbered = any(names == [f"{head}{number}" for number in numbers] for head in heads)
    return numbers if numbered else names


def decisions_json(decided: "Decisions") -> str:
    """JSON text of all pairs with evidence and sentences; `joint_error_bound` is that of all of
    it together.
    """
    from disting.verdict.joint import family_safety  # with numpy, which a catalogue does not need

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
