"""Checks of the evidence for verdicts on two measured chains (recomputed from scratch), and its
certainty.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

from disting.algebra.certainty import Certainty
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.conditions.rule import Finding
from disting.decide import OF_INCLUSIONS, OF_VERDICTS, Of, check, deciders_of
from disting.evidence.conditions import Counts, FreeChoice, Ranks
from disting.evidence.decision import FibreUnder
from disting.evidence.ideals import Refutation, Solutions
from disting.evidence.kind import Kind, ModelSamples, SampledPair, samples_of
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.limits import FullImage, LargerProjection, MissingElements
from disting.evidence.positive import BothWays, OnlyOne, Points, PositiveFinding, Share
from disting.experiments.exact import answer_of
from disting.experiments.experiment import MeasuredChain
from disting.experiments.inclusion import confirms_missing, numberings
from disting.experiments.listing import listable, listed_at, without_dead_time
from disting.experiments.machine_model import MachineModel, is_renaming
from disting.experiments.maps import match_maps
from disting.fibres.ideals import find_again
from disting.fibres.synthesis.task import fraction
from disting.model.chain import Chain
from disting.model.question import Answer, Settings
from disting.model.symmetry import canonical
from disting.questions.identifiability.analysis import identifiability
from disting.questions.inclusion.profiles import exceed, order
from disting.questions.positive import proves
from disting.questions.same.exact import by_labels

FRESH = Settings(seed="checked again", subset_limit=0)
OfMeasured = Evidence | InclusionEvidence


def confirms(
    evidence: OfMeasured, left: MeasuredChain, right: MeasuredChain, representation: str = "tf"
) -> bool:
    """Return True if the evidence holds: lists are recomputed at the stored point, contradictions
    and parts are searched again; everything else is checked at fresh points.

    Raises NotSeenError where a contradiction takes too long.
    """
    pair = SampledPair(
        left=_sample_model(left),
        right=_sample_model(right),
        renames=partial(is_renaming, left, right),
        found_again=partial(_found_again, left=left, right=right),
        numberings=lambda left_is_part: numberings(
            *((left, right) if left_is_part else (right, left))
        ),
    )
    return evidence.holds(pair, representation)


def _found_again(evidence: Kind, left: MeasuredChain, right: MeasuredChain) -> bool:
    """Recompute the evidence of the exact decision, of positive equivalents and of inclusions."""
    return check(evidence, deciders_of(Of.MEASURED, OF_VERDICTS + OF_INCLUSIONS), left, right)


def check_missing(evidence: MissingElements, left: MeasuredChain, right: MeasuredChain) -> bool:
    """The part once more, in all experiments."""
    return confirms_missing(evidence, left, right)


def check_profiles(
    evidence: LargerProjection | FullImage, left: MeasuredChain, right: MeasuredChain
) -> bool:
    """Ranks of a projection, or a full image."""
    if isinstance(evidence, LargerProjection):
        return check_larger(evidence, left, right)
    return check_full_image(evidence, left, right)


def check_full_image(evidence: FullImage, left: MeasuredChain, right: MeasuredChain) -> bool:
    """Free choice of these invariants in the one of larger rank."""
    larger = left if evidence.left_is_larger else right
    return confirms(FreeChoice(evidence.rank, evidence.free), larger, larger)


def check_ideal(
    evidence: Solutions | Refutation, left: MeasuredChain, right: MeasuredChain
) -> bool:
    """Solutions put into all functions, contradictions found again."""
    # normalised coordinates are those of a chain alone
    return not evidence.is_normalised and find_again(evidence, *match_maps(left, right))


def confirms_inclusion(
    evidence: InclusionEvidence, left: MeasuredChain, right: MeasuredChain
) -> bool:
    """Return True if the evidence of an inclusion holds: it must refute the inclusion by
    degrees.
    """
    return check(evidence, deciders_of(Of.MEASURED, OF_INCLUSIONS), left, right)


def recheck_labels(
    evidence: Solutions | Refutation,
    left: MeasuredChain,
    right: MeasuredChain,
    settings: Settings,
) -> Finding:
    """Of ideals the labels are drawn again."""
    return by_labels(evidence, *match_maps(left, right), settings.seed)


def _sample_model(measured: MeasuredChain) -> ModelSamples:
    return samples_of(MachineModel(measured))


def check_larger(evidence: LargerProjection, left: MeasuredChain, right: MeasuredChain) -> bool:
    """Ranks of the named rows of all experiments, or of all rows of one experiment alone."""
    ranks = Ranks(evidence.rows, evidence.left, evidence.right, all_rows=False)
    labels = set[str]().union(*(_sample_model(m).labels("tf") for m in (left, right)))
    if set(evidence.rows) <= labels:
        return confirms(ranks, left, right)
    for k in range(len(left.experiments)):
        mine, theirs = (MeasuredChain(m.chain, (m.experiments[k],)) for m in (left, right))
        rows = tuple(name.replace(f"[{k + 1}]", "[1]") for name in evidence.rows)
        if set(rows) in [_sample_model(m).labels("tf") for m in (mine, theirs)]:
            return confirms(replace(ranks, rows=rows), mine, theirs)
    return False


def check_counts(evidence: Counts, left: MeasuredChain, right: MeasuredChain) -> bool:
    """Return True if these are the degrees of one experiment, and no limit of the other chain has
    those of the chain of smaller rank.
    """
    models = [MachineModel(m) for m in (left, right)]
    pairs = (model.degrees for model in models)
    ranks = [profile(model, Representation.TF, 0, FRESH).rank for model in models]
    small, large = order(evidence.left, evidence.right, ranks[0] < ranks[1])
    is_stated = (evidence.left, evidence.right) in list(zip(*pairs, strict=True))
    return is_stated and exceed(small, large)


def check_list(evidence: FibreUnder, left: MeasuredChain, right: MeasuredChain) -> bool:
    """The list once more, and what each of it misses."""
    left, right = without_dead_time(left), without_dead_time(right)
    machine, searched = (left, right) if evidence.left_given else (right, left)
    at = evidence.listed - 1
    if not _is_of(evidence.point, machine) or not 0 <= at < len(machine.experiments):
        return False
    try:
        values = {name: fraction(value) for name, value in evidence.point}
    except (ValueError, ZeroDivisionError):
        return False  # no numbers
    listed = listed_at(machine, searched, at, values)
    return listed is not None and evidence.missed == tuple(
        None if k is None else k + 1 for k in listed.refuted_by
    )


def _is_of(point: tuple[tuple[str, str], ...], machine: MeasuredChain) -> bool:
    return sorted(name for name, _ in point) == sorted(machine.chain.parameters)


def check_both_ways(evidence: BothWays, left: MeasuredChain, right: MeasuredChain) -> bool:
    """Recompute the finding of either direction; at least one is known."""
    left, right = without_dead_time(left), without_dead_time(right)
    ways = [(evidence.left, left, right), (evidence.right, right, left)]
    graded_ways = [way for way in ways if way[0].certainty]
    return bool(graded_ways) and all(_proves(*way) for way in graded_ways)


def _proves(finding: PositiveFinding, machine: MeasuredChain, other: MeasuredChain) -> bool:
    match finding.evidence:
        case Points():
            with_one = _answer(finding.evidence.with_one, machine, other)
            without = _answer(finding.evidence.without, machine, other)
            is_sometimes = (
                finding.share is Share.SOMETIMES and finding.certainty is Certainty.BOUNDED
            )
            return is_sometimes and (with_one, without) == (Answer.YES, Answer.NO)
        case OnlyOne():
            at = finding.evidence.experiment - 1
            return finding.share is Share.ALWAYS and _is_only_one(at, machine, other)
    pairs = _alone(machine, other)
    return finding.share is Share.NEVER and any(proves(finding, *pair) for pair in pairs)


def _answer(
    values: tuple[tuple[str, str], ...], machine: MeasuredChain, other: MeasuredChain
) -> Answer:
    """Decide whether there is a positive equivalent at a stored positive point."""
    point = {name: fraction(value) for name, value in values}
    if not _is_of(values, machine) or any(value <= 0 for value in point.values()):
        return Answer.UNKNOWN
    for at, _, _ in listable(machine, other):
        listed = listed_at(machine, other, at, point)
        if listed is not None and listed.kept:
            return answer_of(listed.kept)
    return Answer.UNKNOWN


def _is_only_one(at: int, machine: MeasuredChain, other: MeasuredChain) -> bool:
    """Return True if there is exactly one equivalent in this experiment, counted from 0."""
    if not 0 <= at < len(machine.experiments):
        return False
    chain = other.alone(at)
    if machine.alone(at) is None or chain is None:
        return False
    count = identifiability(canonical(chain).chain, FRESH)
    return count.least == count.most == 1 and count.count_grade[0] is not Certainty.NUMERICAL


def _alone(machine: MeasuredChain, other: MeasuredChain) -> Iterator[tuple[Chain, Chain]]:
    """Yield the canonical chains of each experiment in which both are chains of the class."""
    for at in range(len(machine.experiments)):
        chain, other_chain = machine.alone(at), other.alone(at)
        if chain is not None and other_chain is not None:
            yield canonical(chain).chain, canonical(other_chain).chain
