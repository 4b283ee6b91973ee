"""Checks a verdict from its file alone: the evidence is checked again at fresh random points, and
every statement of the file must follow from it.

No stored result is used. Evidence that would take too much work to recompute is reported, and
everything else is checked (`claim_checks`).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import Any

from disting.conditions.inclusion import Inclusion
from disting.errors import DistingError, InputError, NotSeenError, short
from disting.files import as_path, read_json
from disting.general.matrix_model import AnyModel
from disting.general.naming import naming_of_model
from disting.model.chain import Chain
from disting.model.presentation import summary
from disting.model.question import Domain
from disting.network.denotation import FREE_NAMES, MisnamedError, Naming
from disting.verdict.claim_checks import CHECKS, LIMITS, SHARES, Check, Claim
from disting.verdict.engine import Engine
from disting.verdict.placement_verdicts import (
    FORMAT as EVERYWHERE,
    difference_everywhere,
    read_everywhere,
)
from disting.verdict.result import Relation
from disting.verdict.sides import Sides
from disting.verdict.verdict_file import (
    DAMAGED,
    StoredVerdict,
    as_file,
    difference,
    exact,
    has_more,
    read_file,
)

NUMBERED = "a numbered chain"
WANTED = "a file of a verdict, as 'disting compare N:I M:J --json' writes it"


class Status(StrEnum):
    """Result of the check of a verdict, as far as its file shows."""

    HOLDS = "holds"
    FAILS = "does not hold"
    OPEN = "cannot be checked alone"


@dataclass(frozen=True, slots=True)
class Verification:
    """Result of a check, and the reason if it is not "holds".

    `verdicts`: the sentences of the verdicts, none where one does not hold; `models`: their models;
    `found_again`: what was checked; `as_written`: statements of the file that no check can confirm.

    >>> from disting import verdict_file, verify
    >>> verify(verdict_file("2:1", "2:2")).status.value
    'holds'
    """

    status: Status
    reason: str = ""
    verdicts: tuple[str, ...] = ()
    models: str = ""
    found_again: tuple[str, ...] = ()
    as_written: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return summary(self, self.sentence)

    def __bool__(self) -> bool:
        raise TypeError("a verification is not true or false; look at its status")

    @property
    def sentence(self) -> str:
        """In one sentence, without a subject."""
        because = {Status.HOLDS: "", Status.FAILS: ": ", Status.OPEN: " because "}
        return f"{self.status.value}{because[self.status]}{self.reason}"

    @property
    def text(self) -> str:
        """All of it, a thing a line."""
        lines = [self.sentence, *self.verdicts]
        for name, words in (
            ("models", self.models),
            ("found again", "; ".join(self.found_again)),
            ("as written", "; ".join(self.as_written)),
        ):
            lines += [f"{name:<12}{words}"] if words else []
        return "\n".join(lines)


def verify(verdict: dict[str, Any] | str | Path) -> Verification:
    """Check whether a verdict holds: plain data of `verdict_file` or of
    `placement_verdicts.everywhere_file`, or the file with it as JSON.

    Raises InputError for what is no file of a verdict, or is damaged.

    >>> from disting.verdict.verdict_file import verdict_file
    >>> data = verdict_file("3:1", "3:4", damped=True)
    >>> verify(data).sentence
    'holds'
    >>> verify(data | {"relation": "indistinguishable"}).status.value
    'does not hold'
    """
    data = verdict if isinstance(verdict, dict) else read_json(as_path(verdict), WANTED)
    try:
        return _verified_file(data)
    except MisnamedError as reason:
        return Verification(Status.FAILS, str(reason))


def _verified_file(data: Any) -> Verification:
    """Verify a file of one verdict, or of one for every place."""
    if not isinstance(data, dict) or data.get("format") != EVERYWHERE:
        return _verify_claims(data, read_file(data))
    stored = read_everywhere(data)
    other = difference_everywhere(data, stored)
    if other:
        return Verification(Status.FAILS, _not_agreeing(other))
    ways = [
        _verify_claims(plain, read) for plain, read in zip(data["verdicts"], stored, strict=True)
    ]
    whole = Verification(
        Status.HOLDS,
        verdicts=tuple(sentence for way in ways for sentence in way.verdicts),
        models=ways[0].models,
        found_again=tuple(dict.fromkeys(what for way in ways for what in way.found_again)),
        as_written=tuple(dict.fromkeys(what for way in ways for what in way.as_written)),
    )
    for status in (Status.FAILS, Status.OPEN):
        where = next((i for i, way in enumerate(ways) if way.status is status), None)
        if where is not None:
            base = whole if status is Status.OPEN else Verification(status)
            reason = f"{ways[where].reason} (way {where + 1})"
            return replace(base, status=status, reason=reason)
    return whole


def _verify_claims(data: dict[str, Any], stored: StoredVerdict) -> Verification:
    """Combine all checks; those that take too long leave it open, if nothing is wrong."""
    unseen, found = list[str](), list[str]()
    written = [
        f"the settings that choose the random points (seed {short(stored.settings.seed)})",
        f"the version that wrote it ({data['program']})",
    ]
    try:
        sides = stored.sides(Engine(settings=stored.settings))
        for what, check in _checks(data, stored, sides):
            try:
                wrong = next(check(), "")
            except NotSeenError as reason:
                unseen.append(str(reason))
                written.append(what)
                continue
            if wrong:
                return Verification(Status.FAILS, wrong)
            found.append(what)
    except InputError as reason:
        raise InputError(f"the file of the verdict is damaged ({reason})") from None
    except (*DAMAGED, DistingError, RecursionError, AssertionError) as reason:
        return Verification(Status.FAILS, f"it is damaged ({type(reason).__name__}: {reason})")
    if stored.verdict.evidence is None:
        unseen.append("it is undecided: it says nothing that evidence could show")
    return Verification(
        Status.OPEN if unseen else Status.HOLDS,
        unseen[0] if unseen else "",
        (as_file(stored)["sentence"],),
        _whose(stored, sides),
        tuple(filter(None, dict.fromkeys(found))),
        tuple(filter(None, dict.fromkeys(written))),
    )


def _whose(stored: StoredVerdict, sides: Sides) -> str:
    """Origin of the models, by what their names are."""
    named = zip((sides.left.name, sides.right.name), stored.models, strict=True)
    kinds: dict[str, list[str]] = {}
    for name, model in dict(named).items():
        kinds.setdefault(_kind_of(name, model), []).append(name)
    if [*kinds] == [NUMBERED]:
        return f"{' and '.join(kinds[NUMBERED])}: numbered chains, the catalogue's numbers"
    return "; ".join(f"{' and '.join(names)}: {kind}" for kind, names in kinds.items())


def _kind_of(name: str, model: Chain | AnyModel) -> str:
    """Type of a model's name; a chain without a number is named by its indices."""
    if isinstance(model, Chain):
        return "a chain without a number" if name.startswith("(") else NUMBERED
    return FREE_NAMES if naming_of_model(model) is Naming.FREE else "as denoted by the notation"


def _checks(
    data: dict[str, Any], stored: StoredVerdict, sides: Sides
) -> Iterator[tuple[str, Callable[[], Iterator[str]]]]:
    """Yield the name of each check, "" where there is nothing to check, with the iterator of its
    failures, cheap ones first.
    """
    yield "models, sentence and all that is derived", partial(_disagreeing, data, stored, sides)
    beside = stored.over_complex
    claims = [Claim(stored.verdict, stored.query, sides, beside, "")]
    if beside is not None:
        query, where = exact(stored.query), "over complex parameters "
        claims.append(Claim(beside, query, sides, None, where))
    for what, check in CHECKS.items():
        yield from (_name_check(what, claim, check) for claim in claims)
    yield "", partial(_false_equality, stored)


def _name_check(what: str, claim: Claim, check: Check) -> tuple[str, Callable[[], Iterator[str]]]:
    """The check of a claim, and its name if there is anything to check."""
    v = claim.verdict
    shares = v.right_positive if v.left_positive is None else v.left_positive
    looked_at = {LIMITS: v.inclusions, SHARES: shares}.get(what, v.evidence) is not None
    where = f", {claim.where.strip()}" if claim.where else ""
    return f"{what}{where}" if looked_at else "", partial(check, claim)


def _disagreeing(data: dict[str, Any], stored: StoredVerdict, sides: Sides) -> Iterator[str]:
    other = difference(data, stored, sides)
    if other:
        yield _not_agreeing(other)
    if stored.verdict.domain is not stored.query.view.domain:
        yield "the domain is not the one that was asked for"
    if (stored.over_complex is not None) != has_more(stored.verdict):
        yield "the verdict over complex parameters is missing, or there for nothing"


def _not_agreeing(what: str) -> str:
    return f"what it says does not agree with its evidence and models ({what})"


def _false_equality(stored: StoredVerdict) -> Iterator[str]:
    """Yield statements on complex parameters that are not found again."""
    v, beside = stored.verdict, stored.over_complex
    over_complex = v if beside is None else beside
    equal = over_complex.relation is Relation.INDISTINGUISHABLE
    same = equal and over_complex.domain is Domain.COMPLEX
    if v.closure is Inclusion.EQUAL and not same:
        yield "equality over complex parameters is told without evidence"
    if beside is None:
        return
    if beside.domain is not Domain.COMPLEX:
        yield "the verdict over complex parameters is over others"
    if (v.image, v.closure) != (beside.image, beside.closure):
        yield "what is told of complex parameters is not what the verdict over them says"
    if same and beside.closure not in (Inclusion.EQUAL, Inclusion.UNKNOWN):
        yield "equality over complex parameters is denied"
    if v.relation is not Relation.UNDECIDED and beside.relation is Relation.DISTINGUISHABLE:
        yield "models that differ over complex parameters differ over others too"
