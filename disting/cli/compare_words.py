"""What disting compare says: a verdict explained, and what it tells of either way."""

from collections.abc import Iterable, Iterator, Sequence

from disting.cli.relations import in_colour
from disting.conditions.inclusion import Inclusion, InclusionFinding
from disting.evidence.positive import PositiveFinding
from disting.model.question import Domain
from disting.verdict.meaning import RESPONSE, meaning_sentence, undetermined_sentence
from disting.verdict.result import Relation, Verdict

Known = tuple[str, int, int]
"""The name of a model, how much of it is determined, how many parameters it has."""


def explain(
    verdict: Verdict,
    drawn: list[str],
    items: Iterable[Known] | None = None,
    what: str = RESPONSE,
    everywhere: bool = False,
) -> str:
    """Relation, drawings, what cannot be determined of models that are told apart, what a
    measurement (of `what`) shows (`everywhere`: at special values too), sentence, evidence,
    certainty, domain, inclusion.
    """
    names = (verdict.left, verdict.right)
    width = max(map(len, names))
    drawings = [f"  {name:{width}}  {text}" for name, text in zip(names, drawn, strict=True)]
    heading = in_colour(verdict.relation.upper(), verdict.relation)
    lines = [heading, "", *drawings, ""]
    apart = verdict.relation is Relation.DISTINGUISHABLE
    unknown = list(
        filter(None, (undetermined_sentence(*parts) for parts in (apart and items) or ()))
    )
    lines += [*unknown, *([""] if unknown else [])]
    lines += [meaning_sentence(verdict, what, everywhere), "", verdict.sentence]
    if verdict.evidence:
        lines += [f"evidence   {verdict.evidence.formula}", f"certainty  {verdict.sure}"]
    lines.append(f"domain     {verdict.domain} parameters{_over_complex(verdict)}")
    return "\n".join([*lines, *_inclusion(verdict)])


def _over_complex(verdict: Verdict) -> str:
    """Beside a verdict over real or positive parameters, that over complex ones, where it is
    known.
    """
    if verdict.domain is Domain.COMPLEX or (
        verdict.closure is Inclusion.UNKNOWN and verdict.inclusions is None
    ):
        return ""
    complex_relation = (
        Relation.INDISTINGUISHABLE
        if verdict.closure is Inclusion.EQUAL
        else Relation.DISTINGUISHABLE
    )
    also = (
        "too"
        if verdict.relation is complex_relation
        else f"they are {complex_relation} (--domain complex)"
    )
    return f"; over complex ones {also}"


def _inclusion(verdict: Verdict) -> list[str]:
    """What is said of models of unequal rank."""
    both = verdict.inclusions
    if both is None:
        return []
    lines = [f"inclusion  over complex parameters: {both.sentence(verdict.left, verdict.right)}"]
    if both.image == both.closure:
        return [*lines, f"why        {_why(both.closure, verdict)}"]
    return [
        *lines,
        f"image      {_why(both.image, verdict)}",
        f"closure    {_why(both.closure, verdict)}",
    ]


def _why(finding: InclusionFinding, verdict: Verdict) -> str:
    """Grade and evidence of one statement, or why it is not known."""
    if finding.evidence is None:
        return f"not known: {finding.reason}"
    sure = f", {finding.certainty.in_words(finding.safety)}" if finding.certainty else ""
    return f"{finding.inclusion}{sure}: {finding.evidence.sentence(verdict.left, verdict.right)}"


def both_ways(
    verdict: Verdict,
    where: str = "positive",
    shares: Sequence[PositiveFinding | None] = (),
) -> Iterator[str]:
    """Which positive models of each side have an equivalent on the other side, as far as that is
    told: by the verdict, or by the shares of both sides that are given, `where` they were counted.
    """
    names = (verdict.left, verdict.right)
    shares = shares or (verdict.left_positive, verdict.right_positive)
    for name, other, finding in zip(names, reversed(names), shares, strict=True):
        if finding is not None:
            why = finding.evidence.sentence(name, other) if finding.evidence else finding.reason
            seen = f" ({finding.empirical.sentence})" if finding.empirical else ""
            yield f"{where}: {name} in {other} {finding.share}{seen}. {why}"
