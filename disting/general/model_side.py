"""A general model as one side of a comparison: the properties that conditions and verdicts need.

Condition 8 applies where both are networks, condition 9 never; which of its models are limits of
another one of larger rank is decided where elements or profiles show it. Verdicts are over complex
parameters first; over real or positive ones a pair that is distinguishable, or identical by a
renaming, stays so, and points with and without an admissible equivalent are searched otherwise.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from disting.algebra.certainty import Certainty, joint_safety
from disting.behaviour.sample import Representation
from disting.conditions.inclusion import Inclusions
from disting.conditions.rule import ADMISSIBLE, EXACT, Finding, Outcome, Rule
from disting.conditions.side import Ask, Side
from disting.conditions.sufficient import condition_6
from disting.decide import (
    POSITIVE_NETWORKS,
    REAL_NETWORKS,
    SAME_NETWORKS,
    found_at_once,
    recheck,
)
from disting.evidence.conditions import Renaming
from disting.evidence.decision import GEARS, INTERLACING, REPLACEMENT, Theorem
from disting.evidence.general import OverDomain
from disting.evidence.kind import Carrier
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveFinding, Share
from disting.general import model_evidence
from disting.general.any_model import (
    LEFT,
    RIGHT,
    as_network,
    cells_of,
    is_renamed,
    is_writable,
    renamed_chain,
    same,
    with_names,
    without_names,
)
from disting.general.behaviour import GeneralModel
from disting.general.exponents import count_determined
from disting.general.forms import ADMISSIBLY
from disting.general.interlacing import sets_of
from disting.general.matrix_model import AnyModel
from disting.general.model_evidence import constants_finding
from disting.general.model_inclusions import (
    confirms_inclusion,
    inclusions_of,
    n_elements,
    numberings,
)
from disting.general.network_model import NetworkModel, behaviour_of
from disting.general.plain_maps import PLAIN_MAPS
from disting.general.readings import profile_text, readings
from disting.general.replacement import same_in_units
from disting.model.chain import Chain, Premise
from disting.model.presentation import GENERIC
from disting.model.question import Domain, Question, Relation
from disting.network.chains import RenamedChain
from disting.questions.same.exact import resting_on_ranks

NO_SHARES = "of general models it is not asked which positive ones have positive equivalents"
OTHER_ORDER = "the exponents can be matched in another order, for which it is not asked"
TOO_MANY_TERMS = "the transfer functions have too many terms"
EXACTLY = Question("exact decisions on general models", same, Finding.to_json, Finding.from_json)
ModelPair = tuple["ComparedModel", "ComparedModel"]


@dataclass(frozen=True)
class ComparedModel(Side[AnyModel]):
    """A model with one transfer function or with a matrix of them; `experiments`, in words: those
    that the functions are of, where there are several.
    """

    exactly = EXACTLY
    experiments: tuple[str, ...] = ()

    @property
    def content(self) -> tuple[str, ...]:
        """All that its verdicts depend on, as text."""
        return (*super().content, *self.experiments)

    @property
    def model(self) -> GeneralModel | NetworkModel:
        """The transfer functions, whatever they are called."""
        return behaviour_of(self.subject)

    @cached_property
    def renamed_chain(self) -> RenamedChain | None:
        """The chain that it is, in whatever names of its parameters, if it is one."""
        return renamed_chain(self.subject)

    @property
    def chain(self) -> Chain | None:
        """The chain that it is, if it is one."""
        return None if self.renamed_chain is None else self.renamed_chain.chain

    @property
    def chain_note(self) -> str:
        """Note on the names of the chain's parameters in this model."""
        return self.renamed_chain.note(self.name) if self.renamed_chain else ""

    @property
    def premise(self) -> Premise | None:
        """That of the chain that it is, if it is one; else how it is measured."""
        if self.experiments:
            return Premise(None, None, self.experiments)
        return None if self.chain is None else self.chain.premise

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on the variable that degrees count where it is not s, and on the exponents."""
        phrase = self.subject.powers.sentence(self.name)
        return ((phrase,) if phrase else ()) + ((GENERIC,) if self.subject.powers.weights else ())

    @property
    def in_s(self) -> bool:
        """True if powers of v are those of s, or of its root."""
        return not self.subject.powers.weights

    @cached_property
    def asked_about(self) -> tuple[AnyModel, AnyModel]:
        """The network that it is, on the left and on the right of a question."""
        return as_network(self.subject, LEFT), as_network(self.subject, RIGHT)

    @cached_property
    def other_orders(self) -> tuple[tuple[tuple[str, ...], Renaming | None], ...]:
        """The other orders of its exponents that profiles leave open, each with a renaming of its
        parameters that has the same effect, if there is one.
        """
        own = profile_text(self.transfer_profile)
        pairs = list[tuple[tuple[str, ...], Renaming | None]]()
        for model in readings(self.subject):
            other = replace(self, subject=model)
            if profile_text(other.transfer_profile) == own:
                evidence = condition_6(self, other, True).evidence
                renaming = evidence if isinstance(evidence, Renaming) else None
                pairs.append((model.powers.exponents, renaming))
        return tuple(pairs)

    @property
    def has_other_readings(self) -> bool:
        """True if its exponents can be matched in orders that are not symmetries of it."""
        return any(renaming is None for _, renaming in self.other_orders)

    @property
    def rank(self) -> int:
        """Number of determinable parameters, exponents too."""
        size, rank = len(self.subject.powers.weights), self.transfer_profile.rank
        return rank + count_determined(cells_of(self.subject), size)[0] if size else rank

    @property
    def n_elements(self) -> int | None:
        """Number of elements with an effect on the response, if it is a network."""
        return n_elements(self.subject.network)

    def part_of(self, other: "ComparedModel") -> dict[int, int] | None:
        """The numbering under which it is the other one with elements missing."""
        return next(numberings(self.subject, other.subject), None)

    def is_renamed(self, other: "ComparedModel", renaming: dict[str, str]) -> bool:
        """Return True if renaming the parameters turns this transfer function into the other:
        exact, by the terms.
        """
        written = self.is_writable and other.is_writable
        return written and is_renamed(self.subject, other.subject, renaming)

    @cached_property
    def gives(self) -> dict[str, object]:
        """Sets of functions that the model gives by theorems on networks: models with equal sets
        are equivalent.
        """
        return sets_of(self.subject) if self.is_writable else {}

    @cached_property
    def is_writable(self) -> bool:
        """True if the number of its terms, in which exact decisions are made, is not too large."""
        return is_writable(self.subject)

    def pair(self, other: "ComparedModel") -> tuple[AnyModel, AnyModel]:
        """Both, whatever they are called."""
        return without_names(self.subject), without_names(other.subject)

    def foreseen(self, other: "ComparedModel") -> Finding | None:
        """Not computed for unequal ranks or degrees, nor where a theorem decides."""
        finding: Finding | None = found_at_once(SAME_NETWORKS.at_once, self, other)
        return finding

    def grounded(self, other: "ComparedModel", found: Finding) -> Finding:
        """In every order of the exponents."""
        found = resting_on_ranks(found, self.transfer_profile, other.transfer_profile)
        return self._in_every_order(other, found)

    def found_again(self, other: "ComparedModel", evidence: Evidence) -> Finding | None:
        """Finding with evidence of this kind."""
        again: Finding | None = recheck(
            evidence, SAME_NETWORKS.rows, *self.pair(other), self.settings
        )
        return again

    def _in_every_order(self, other: "ComparedModel", finding: Finding) -> Finding:
        """Finding for all orders of the exponents, from that for one: a difference is inconclusive
        where another order is not a symmetry, and as certain as the profiles that exclude other
        orders.
        """
        if finding.outcome not in (Outcome.FAILS, Outcome.SOMETIMES) or not readings(self.subject):
            return finding
        if self.has_other_readings:
            return Finding(finding.rule, Outcome.ABANDONED, note=OTHER_ORDER)
        safeties = [s.transfer_profile.safety for s in (self, other)]
        safety = joint_safety([*safeties, *([finding.safety] if finding.safety else [])])
        return replace(finding, certainty=Certainty.BOUNDED, safety=safety)

    def confirms(self, other: "ComparedModel", evidence: Evidence, representation: str) -> bool:
        """Return True if the evidence of a verdict holds for both, in the representation that the
        decision uses: conditions know the elements of networks.
        """
        one_order = Carrier.CONDITION not in evidence.claim.carriers and self.has_other_readings
        if one_order and not any(evidence.shows(d) is Relation.INDISTINGUISHABLE for d in Domain):
            return False
        pair = self.subject, other.subject
        if isinstance(evidence, OverDomain):
            pair = _strip_names(self, other)
        return model_evidence.confirms_models(evidence, *pair, representation)

    def admissible(
        self, other: "ComparedModel", domain: Domain, why: Evidence | None = None
    ) -> Finding:
        """Over real or positive parameters: a renaming is a bijection there too; points with and
        without equivalents come next.
        """
        if isinstance(why, Renaming):
            return Finding(ADMISSIBLE, Outcome.ABANDONED, note="the renaming tells it")
        decided = _theorem(self, other, domain)
        if decided is not None and not _is_asked(self, other, domain):
            return decided
        if not (self.is_writable and other.is_writable):
            return Finding(ADMISSIBLE, Outcome.ABANDONED, note=TOO_MANY_TERMS)
        question, models = _question(self, other, domain)
        finding = self._in_every_order(other, self.answerer(question, models, self.settings))
        if decided is not None and finding.outcome is not Outcome.HOLDS:
            return decided
        return replace(finding, note=with_names(finding.note, self.name, other.name))

    def inclusions(self, other: "ComparedModel") -> Inclusions:
        """Both statements on two models of unequal rank."""
        profiles = tuple(s.profile(Representation.TF, 0) for s in (self, other))
        smaller = self.rank < other.rank
        return inclusions_of(self.subject, other.subject, (profiles[0], profiles[1]), smaller)

    def includes(self, other: "ComparedModel", evidence: InclusionEvidence) -> bool:
        """Return True if the evidence of an inclusion holds for both sides."""
        return confirms_inclusion(evidence, self.subject, other.subject, self.rank < other.rank)

    def positive(self, other: "ComparedModel") -> PositiveFinding:
        """Not decided."""
        return PositiveFinding(Share.UNKNOWN, reason=NO_SHARES)

    @classmethod
    def prepare_admissible(cls, pairs: Sequence[ModelPair], domain: Domain, ask: Ask) -> None:
        """Have equivalents looked for; those that a renaming gives cost little."""
        questions = [_question(a, b, domain) for a, b in pairs if _is_asked(a, b, domain)]
        for question in (PLAIN_MAPS, ADMISSIBLY[domain]):
            ask(question, [models for q, models in questions if q is question])


def positive_question(
    left: ComparedModel, right: ComparedModel
) -> tuple[Question[Finding], tuple[AnyModel, AnyModel]]:
    """Question of the search for positive equivalents, in the form in which an engine caches the
    answer.
    """
    return _question(left, right, Domain.POSITIVE)


def _question(
    left: ComparedModel, right: ComparedModel, domain: Domain
) -> tuple[Question[Finding], tuple[AnyModel, AnyModel]]:
    """For networks that are equivalent by a theorem only a map without exception adds
    information.
    """
    decided = _theorem(left, right, domain)
    question = ADMISSIBLY[domain] if decided is None else PLAIN_MAPS
    return question, _strip_names(left, right)


def _strip_names(left: ComparedModel, right: ComparedModel) -> tuple[AnyModel, AnyModel]:
    """Both in the form in which they are decided over real and positive parameters."""
    return left.asked_about[0], right.asked_about[1]


def _theorem(left: ComparedModel, right: ComparedModel, domain: Domain) -> Finding | None:
    """The theorem by which networks give the same functions over a domain."""
    table = POSITIVE_NETWORKS if domain is Domain.POSITIVE else REAL_NETWORKS
    finding: Finding | None = found_at_once(table.at_once, left, right)
    return finding


def _is_asked(left: ComparedModel, right: ComparedModel, domain: Domain) -> bool:
    renamed = left.colouring.fingerprint == right.colouring.fingerprint
    written = left.is_writable and right.is_writable
    decided = _theorem(left, right, domain)
    evidence = None if decided is None else decided.evidence
    settled = evidence is not None and evidence.without_exception(domain)
    return written and not renamed and not settled


def refuse_unequal(left: ComparedModel, right: ComparedModel) -> Finding | None:
    """Not decided for unequal ranks or degrees."""
    mine, theirs = left.transfer_profile, right.transfer_profile
    if mine.rank == theirs.rank and mine.degrees == theirs.degrees:
        return None
    note = "the ranks or degrees differ (conditions 2 and 4)"
    return Finding(EXACT, Outcome.INAPPLICABLE, note=note)


def by_constants(left: ComparedModel, right: ComparedModel) -> Finding | None:
    """Transfer functions without parameters, by their values."""
    return constants_finding(left.subject, right.subject) if left.rank == 0 else None


def refuse_large(left: ComparedModel, right: ComparedModel) -> Finding | None:
    """Not decided for functions that are too large to write down."""
    written = left.is_writable and right.is_writable
    return None if written else Finding(EXACT, Outcome.ABANDONED, note=TOO_MANY_TERMS)


def same_by_gears(left: ComparedModel, right: ComparedModel) -> Finding | None:
    """Machines that differ by gears alone, over complex parameters."""
    return _of_theorem(EXACT, GEARS, same_in_units(left.subject, right.subject))


def by_gears(left: ComparedModel, right: ComparedModel) -> Finding | None:
    """Machines that differ by gears alone: by rational maps of positive factors."""
    return _of_theorem(ADMISSIBLE, GEARS, same_in_units(left.subject, right.subject))


def by_replacement(left: ComparedModel, right: ComparedModel) -> Finding | None:
    """Networks with one simplest network."""
    return _of_theorem(ADMISSIBLE, REPLACEMENT, _gives_same(REPLACEMENT, left, right))


def by_interlacing(left: ComparedModel, right: ComparedModel) -> Finding | None:
    """Undamped trees with one spring to the ground."""
    return _of_theorem(ADMISSIBLE, INTERLACING, _gives_same(INTERLACING, left, right))


def _of_theorem(rule: Rule, name: str, applies: bool) -> Finding | None:
    evidence = Theorem(name)
    return Finding(rule, Outcome.HOLDS, Certainty.THEOREM, evidence=evidence) if applies else None


def _gives_same(name: str, left: ComparedModel, right: ComparedModel) -> bool:
    given_set = left.gives.get(name)
    return given_set is not None and given_set == right.gives.get(name)
