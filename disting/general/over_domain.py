"""Networks and other models beside each other: what theorems and constants decide at once, and
whether two that are the same over complex parameters are so over real or positive ones.

A pair that is distinguishable, or identical by a renaming, stays so over every domain; otherwise
points with and without an admissible equivalent are looked for.
"""

from collections.abc import Sequence
from dataclasses import replace

from disting.algebra.certainty import Certainty
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusions
from disting.conditions.rule import ADMISSIBLE, EXACT, Finding, Outcome, Rule
from disting.conditions.side import Ask
from disting.decide import POSITIVE_NETWORKS, REAL_NETWORKS, found_at_once
from disting.evidence.conditions import Renaming
from disting.evidence.decision import GEARS, GROUNDS, INTERLACING, REPLACEMENT, Theorem
from disting.evidence.general import OverDomain
from disting.evidence.kind import Carrier
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.general import model_evidence
from disting.general.any_model import with_names
from disting.general.forms import ADMISSIBLY
from disting.general.matrix_model import AnyModel
from disting.general.model_evidence import constants_finding
from disting.general.model_inclusions import confirms_inclusion, inclusions_of
from disting.general.network_view import NetworkSide, has_other_readings, in_every_order
from disting.general.plain_maps import PLAIN_MAPS
from disting.general.replacement import same_in_units
from disting.model.question import Domain, Question, Relation

TOO_MANY_TERMS = "the transfer functions have too many terms"


def confirms(
    evidence: Evidence, left: NetworkSide, right: NetworkSide, representation: str
) -> bool:
    """Return True if evidence of a verdict holds for both, as those who decide by it see them:
    conditions know the elements of networks.
    """
    one_order = Carrier.CONDITION not in evidence.claim.carriers and has_other_readings(left)
    if one_order and not any(evidence.shows(d) is Relation.INDISTINGUISHABLE for d in Domain):
        return False
    pair = left.view.given, right.view.given
    if isinstance(evidence, OverDomain):
        pair = _strip_names(left, right)
    return model_evidence.confirms_models(evidence, *pair, representation)


def over_domain(
    left: NetworkSide, right: NetworkSide, domain: Domain, why: Evidence | None = None
) -> Finding:
    """Return the decision over real or positive parameters: a renaming is a bijection there too;
    points with and without equivalents come next.
    """
    if isinstance(why, Renaming):
        return Finding(ADMISSIBLE, Outcome.ABANDONED, note="the renaming tells it")
    told = _theorem(left, right, domain)
    if told is not None and not _is_asked(left, right, domain):
        return told
    if not (left.view.is_writable and right.view.is_writable):
        return Finding(ADMISSIBLE, Outcome.ABANDONED, note=TOO_MANY_TERMS)
    question, models = _question(left, right, domain)
    finding = in_every_order(left, right, left.answerer(question, models, left.settings))
    if told is not None and finding.outcome is not Outcome.HOLDS:
        return told
    return replace(finding, note=with_names(finding.note, left.name, right.name))


def prepare(pairs: Sequence[tuple[NetworkSide, NetworkSide]], domain: Domain, ask: Ask) -> None:
    """Look for equivalents of many pairs; those that a renaming gives cost little."""
    asked = [_question(a, b, domain) for a, b in pairs if _is_asked(a, b, domain)]
    for question in (PLAIN_MAPS, ADMISSIBLY[domain]):
        ask(question, [models for q, models in asked if q is question])


def inclusions(left: NetworkSide, right: NetworkSide) -> Inclusions:
    """Return both statements on two models of unequal rank."""
    profiles = tuple(s.profile(Representation.TF, 0) for s in (left, right))
    smaller = left.rank < right.rank
    return inclusions_of(left.view.given, right.view.given, (profiles[0], profiles[1]), smaller)


def includes(evidence: InclusionEvidence, left: NetworkSide, right: NetworkSide) -> bool:
    """Return True if evidence of an inclusion holds for both."""
    return confirms_inclusion(evidence, left.view.given, right.view.given, left.rank < right.rank)


def positive_question(
    left: NetworkSide, right: NetworkSide
) -> tuple[Question[Finding], tuple[AnyModel, AnyModel]]:
    """Question of the search for positive equivalents, in the form in which an engine caches the
    answer.
    """
    return _question(left, right, Domain.POSITIVE)


def _question(
    left: NetworkSide, right: NetworkSide, domain: Domain
) -> tuple[Question[Finding], tuple[AnyModel, AnyModel]]:
    """For networks that are equivalent by a theorem only a map without exception adds
    information.
    """
    decided = _theorem(left, right, domain)
    question = ADMISSIBLY[domain] if decided is None else PLAIN_MAPS
    return question, _strip_names(left, right)


def _strip_names(left: NetworkSide, right: NetworkSide) -> tuple[AnyModel, AnyModel]:
    """Both in the form in which they are decided over real and positive parameters."""
    return left.view.asked_about[0], right.view.asked_about[1]


def _theorem(left: NetworkSide, right: NetworkSide, domain: Domain) -> Finding | None:
    """The theorem by which networks give the same functions over a domain."""
    table = POSITIVE_NETWORKS if domain is Domain.POSITIVE else REAL_NETWORKS
    finding: Finding | None = found_at_once(table.at_once, left, right)
    return finding


def _is_asked(left: NetworkSide, right: NetworkSide, domain: Domain) -> bool:
    renamed = left.colouring.fingerprint == right.colouring.fingerprint
    written = left.view.is_writable and right.view.is_writable
    decided = _theorem(left, right, domain)
    evidence = None if decided is None else decided.evidence
    settled = evidence is not None and evidence.without_exception(domain)
    return written and not renamed and not settled


def refuse_unequal(left: NetworkSide, right: NetworkSide) -> Finding | None:
    """Not decided for unequal ranks or degrees."""
    mine, theirs = left.transfer_profile, right.transfer_profile
    if mine.rank == theirs.rank and mine.degrees == theirs.degrees:
        return None
    note = "the ranks or degrees differ (conditions 2 and 4)"
    return Finding(EXACT, Outcome.INAPPLICABLE, note=note)


def by_constants(left: NetworkSide, right: NetworkSide) -> Finding | None:
    """Transfer functions without parameters, by their values."""
    return constants_finding(left.view.given, right.view.given) if left.rank == 0 else None


def refuse_large(left: NetworkSide, right: NetworkSide) -> Finding | None:
    """Not decided for functions that are too large to write down."""
    written = left.view.is_writable and right.view.is_writable
    return None if written else Finding(EXACT, Outcome.ABANDONED, note=TOO_MANY_TERMS)


def same_by_gears(left: NetworkSide, right: NetworkSide) -> Finding | None:
    """Machines that differ by gears alone, over complex parameters."""
    return _of_theorem(EXACT, GEARS, same_in_units(left.view.given, right.view.given))


def by_gears(left: NetworkSide, right: NetworkSide) -> Finding | None:
    """Machines that differ by gears alone: by rational maps of positive factors."""
    return _of_theorem(ADMISSIBLE, GEARS, same_in_units(left.view.given, right.view.given))


def by_replacement(left: NetworkSide, right: NetworkSide) -> Finding | None:
    """Networks with one simplest network."""
    return _of_theorem(ADMISSIBLE, REPLACEMENT, _gives_same(REPLACEMENT, left, right))


def by_interlacing(left: NetworkSide, right: NetworkSide) -> Finding | None:
    """Undamped machines with any zeros between their poles."""
    return _of_theorem(ADMISSIBLE, INTERLACING, _gives_same(INTERLACING, left, right))


def by_grounds(left: NetworkSide, right: NetworkSide) -> Finding | None:
    """Undamped machines that differ by the places of their springs to the ground."""
    return _of_theorem(ADMISSIBLE, GROUNDS, _gives_same(GROUNDS, left, right))


def _of_theorem(rule: Rule, name: str, applies: bool) -> Finding | None:
    evidence = Theorem(name)
    return Finding(rule, Outcome.HOLDS, Certainty.THEOREM, evidence=evidence) if applies else None


def _gives_same(name: str, left: NetworkSide, right: NetworkSide) -> bool:
    given_set = left.view.gives.get(name)
    return given_set is not None and given_set == right.view.gives.get(name)
