"""What disting compare says: a verdict explained, on a pair, on every way to place experiments, and
within ranges.
"""

from collections.abc import Iterator, Sequence

from disting.cli.relations import in_colour
from disting.conditions.inclusion import Inclusion, InclusionFinding
from disting.errors import InputError, listed
from disting.experiments.experiment import Experiment, MeasuredChain
from disting.experiments.places import Places, moved
from disting.general.any_model import as_chain
from disting.general.matrix_model import AnyModel, MatrixModel
from disting.model.chain import Chain, text_drawing
from disting.model.question import Domain
from disting.network.element import Sort
from disting.verdict.everywhere import Answer, Everywhere
from disting.verdict.meaning import RESPONSE, shown
from disting.verdict.result import Relation, Verdict
from disting.verdict.sides import names_of

MOST_TERMS = 30  # of a transfer function that is written out


def explained(
    verdict: Verdict,
    drawn: list[str],
    unknown: Sequence[str] = (),
    what: str = RESPONSE,
    everywhere: bool = False,
) -> str:
    """Relation, drawings, what of the models is `unknown` whatever is measured, what a measurement
    (of `what`) shows (`everywhere`: at special values too), sentence, evidence, certainty, domain,
    inclusion.
    """
    names = (verdict.left, verdict.right)
    width = max(map(len, names))
    drawings = [f"  {name:{width}}  {text}" for name, text in zip(names, drawn, strict=True)]
    heading = in_colour(verdict.relation.upper(), verdict.relation)
    lines = [heading, "", *drawings, ""]
    lines += [*unknown, *[""] * bool(unknown)]
    lines += [shown(verdict, what, everywhere), "", verdict.sentence]
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


def _why(found: InclusionFinding, verdict: Verdict) -> str:
    """Grade and evidence of one statement, or why it is not known."""
    if found.evidence is None:
        return f"not known: {found.reason}"
    sure = f", {found.certainty.in_words(found.safety)}" if found.certainty else ""
    return f"{found.inclusion}{sure}: {found.evidence.sentence(verdict.left, verdict.right)}"


def every_way(
    found: Everywhere, chains: Sequence[Chain], experiments: Sequence[Experiment]
) -> Iterator[str]:
    """One way in full, several with what is common to them; one and the same chain is drawn with
    the experiments of each side.
    """
    left, right = names_of(*chains)
    if len(found.verdicts) == 1:
        places, verdict = found.verdicts[0]
        drawings = list(map(text_drawing, chains))
        if left == right:
            sides = experiments, [moved(e, places) for e in experiments]
            drawings = [_drawn(chains[0], side) for side in sides]
        yield explained(verdict, drawings)
        yield from (f"note       {note}" for note in verdict.notes if verdict.evidence)
        yield f"places     {_placed(places, left, right)}"
        return
    other = f"the other {right}" if left == right else right
    told = {
        Answer.SURELY: "told apart, wherever the places are in {}",
        Answer.NEVER: "not told apart, wherever the places are in {}",
        Answer.DEPENDS: "told apart or not, depending on where the places are in {}",
        Answer.UNKNOWN: "not known for all places in {}",
    }[found.answer]
    yield f"{found.answer.upper()}: {left} and {other} are {told.format(other)}"
    yield ""
    for places, verdict in found.verdicts:
        yield f"  {_placed(places, left, other)}: {verdict.sentence}"
        yield from (f"    {note}" for note in verdict.notes if verdict.evidence)


def _drawn(chain: Chain, experiments: Sequence[Experiment]) -> str:
    """A chain as it is, and where force and sensor are in each of the experiments."""
    ports = (entry.attached for entry in MeasuredChain(chain, tuple(experiments)).entries)
    drawings = (text_drawing(chain), *(text_drawing(chain, each) for each in ports))
    return " | ".join(dict.fromkeys(drawings))


def _placed(places: Places, left: str, right: str) -> str:
    """Which mass is which."""
    pairs = ", ".join(f"{a}/{b}" for a, b in places)
    return f"masses {pairs} of {left}/{right}"


def both_ways(
    verdict: Verdict, chains: list[Chain], limits: dict[str, tuple[str, str]]
) -> Iterator[str]:
    """Which positive models of each side, within ranges if there are any, have an equivalent on
    the other side.

    Without ranges that is told where the verdict tells it.
    """
    from disting.questions.positive import ranges, within_ranges

    unknown = set(limits) - {name for chain in chains for name in chain.parameters}
    if unknown:
        there = listed(dict.fromkeys(name for chain in chains for name in chain.parameters))
        raise InputError(
            f"no parameter of the two models is called {listed(sorted(unknown))}; there are {there}"
        )
    sides = list(
        zip(
            (verdict.left, verdict.right),
            chains,
            (verdict.left_positive, verdict.right_positive),
            strict=True,
        )
    )
    for (name, given, known), (other_name, other, _) in (sides, sides[::-1]):
        boxes = (
            {n: limits[n] for n in chain.parameters if n in limits} for chain in (given, other)
        )
        found = within_ranges(given, other, ranges(*boxes)) if limits else known
        if found is None:
            continue
        where = "within the ranges" if limits else "positive"
        why = found.evidence.sentence(name, other_name) if found.evidence else found.reason
        seen = f" ({found.empirical.sentence})" if found.empirical else ""
        yield f"{where}: {name} in {other_name} {found.share}{seen}. {why}"


def in_letters(
    side: Chain | AnyModel, most_terms: int = MOST_TERMS, longer: str = ", in --json"
) -> str:
    """A chain's drawing, or a transfer function of so many terms; where a longer one is."""
    if isinstance(side, Chain):
        return text_drawing(side)
    chain = as_chain(side)
    if chain is not None:
        return text_drawing(chain)
    entries = side.entries if isinstance(side, MatrixModel) else (side,)
    circuit = side.network is not None and side.network.sort is Sort.CIRCUIT
    letter = "Z" if circuit else "G"  # an impedance is called so
    if sum(e.n_terms for e in entries) <= most_terms:
        return letter + str(side).removeprefix("G")
    if isinstance(side, MatrixModel):
        return "{}(s) with {} outputs and {} inputs{}".format(letter, *side.shape, longer)
    powers = side.powers
    root = ", in powers of sqrt(s)" * powers.halves + "".join(f", s^{n}" for n in powers.exponents)
    return "{}(s) of degree {} over {}{}{}".format(letter, *side.degrees, root, longer)
