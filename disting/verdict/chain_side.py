"""A chain as one side of a comparison: its profiles on demand, its colouring for renamings, and the
questions about pairs, each computed once.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from disting.algebra.certainty import full_text
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.transfer import is_renaming
from disting.conditions.inclusion import Inclusions
from disting.conditions.rule import EXACT, Finding, Outcome
from disting.conditions.side import Ask, Side
from disting.decide import POSITIVE_CHAINS, SAME_CHAINS, found_at_once, recheck
from disting.evidence.conditions import Renaming
from disting.evidence.kind import PointText
from disting.evidence.kinds import Evidence, InclusionEvidence
from disting.evidence.positive import PositiveFinding, Share
from disting.model.chain import Chain, Premise, Structure
from disting.model.minors import embeddings
from disting.model.question import Domain, Question
from disting.model.symmetry import Form, between, canonical
from disting.questions.identifiability import IDENTIFIABILITY, Identifiability
from disting.questions.inclusion.confirmation import confirms as confirms_inclusion
from disting.questions.inclusion.decide import (
    CLOSURE,
    IDEALS,
    IMAGE,
    asked_closure,
    asked_image,
    by_rank,
    implied_image,
    inclusions,
    join,
    needs_ideals,
    quick_closure,
)
from disting.questions.positive import proves
from disting.questions.same.evidence_check import Witness
from disting.questions.same.exact import exact_finding, resting_on_ranks
from disting.questions.same.real_and_positive import (
    LACKING,
    POSITIVELY,
    Answerers,
    needs_counts,
    real_finding,
    witness_ways,
)

EXACTLY = Question("exact decisions", exact_finding, Finding.to_json, Finding.from_json)
ChainPair = tuple["ComparedChain", "ComparedChain"]


@dataclass(frozen=True)
class ComparedChain(Side[Chain]):
    """A chain; profiles are those of the canonical form, which all symmetric chains share. `note`
    gives the names of its parameters in the equal network.
    """

    note: str = ""

    @property
    def notes(self) -> tuple[str, ...]:
        """The names of its parameters where they are others."""
        return (self.note,) if self.note else ()

    @property
    def content(self) -> tuple[str, ...]:
        """All that its verdicts depend on, as text."""
        return (self.name, full_text(self.subject), *self.notes)

    exactly = EXACTLY

    @property
    def model(self) -> ChainModel:
        """The chain as it is."""
        return ChainModel(self.chain.structure)

    @property
    def profiled(self) -> ChainModel:
        """The canonical structure."""
        return ChainModel(self.canonical.chain.structure)

    @property
    def chain(self) -> Chain:
        """The chain."""
        return self.subject

    @property
    def structure(self) -> Structure:
        """Masses, springs and dampers."""
        return self.chain.structure

    @property
    def n_elements(self) -> int:
        """Number of masses, springs and dampers."""
        return len(self.chain.structure.elements)

    def part_of(self, other: "ComparedChain") -> dict[int, int] | None:
        """The numbering under which it is the other one with elements missing."""
        return next(embeddings(self.chain.structure, other.chain.structure), None)

    @property
    def premise(self) -> Premise:
        """Damping and sensor quantity."""
        return self.chain.premise

    @cached_property
    def canonical(self) -> Form:
        """Canonical form under the symmetries of the class."""
        return canonical(self.chain)

    def symmetry_with(self, other: "ComparedChain") -> Renaming | None:
        """By the common canonical form, if there is one."""
        way = between(self.chain, other.chain)
        return way and Renaming(tuple(way[0].items()), way[1])

    def is_renamed(self, other: "ComparedChain", renaming: dict[str, str]) -> bool:
        """Return True if renaming the parameters turns this transfer function into the other:
        exact.
        """
        return is_renaming(self.chain.structure, other.chain.structure, renaming)

    def pair(self, other: "ComparedChain") -> tuple[Chain, Chain]:
        """The canonical forms of both, in an order of their own, so that a pair is decided once."""
        low, high = sorted(
            (self.canonical.chain, other.canonical.chain),
            key=lambda c: (c.indices, c.ground_dampers, c.lag),
        )
        return low, high

    def foreseen(self, other: "ComparedChain") -> Finding | None:
        """Not computed for unequal ranks."""
        finding: Finding | None = found_at_once(SAME_CHAINS.at_once, self, other)
        return finding

    def grounded(self, other: "ComparedChain", found: Finding) -> Finding:
        """In the order of both."""
        found = found.turned if self._is_turned(other) else found
        return resting_on_ranks(found, self.transfer_profile, other.transfer_profile)

    def found_again(self, other: "ComparedChain", evidence: Evidence) -> Finding | None:
        """Finding with evidence of this kind."""
        evidence = evidence.turned if self._is_turned(other) else evidence
        again: Finding | None = recheck(
            evidence, SAME_CHAINS.rows, *self.pair(other), self.settings
        )
        return again

    def _is_turned(self, other: "ComparedChain") -> bool:
        """Return True if `pair` has the other one first."""
        return self.pair(other)[0] != self.canonical.chain

    def confirms(self, other: "ComparedChain", evidence: Evidence, representation: str) -> bool:
        """Return True if the evidence of a verdict holds for both chains."""
        return Witness().confirms(evidence, representation, self.chain, other.chain)

    def includes(self, other: "ComparedChain", evidence: InclusionEvidence) -> bool:
        """Return True if the evidence of an inclusion holds for both chains."""
        return confirms_inclusion(evidence, self, other)

    def proves(self, other: "ComparedChain", share: PositiveFinding) -> bool:
        """Return True if the evidence on positive equivalents in the other is correct."""
        return proves(share, *_canonical(self, other))

    def admissible(
        self, other: "ComparedChain", domain: Domain, why: Evidence | None = None
    ) -> Finding:
        """Decide whether two models that are equivalent over complex parameters are so over this
        domain.
        """
        if domain is Domain.POSITIVE:
            finding: Finding = found_at_once(POSITIVE_CHAINS.at_once, self, other)
            return finding
        answerers = Answerers(self._positive, self._lacking, self._identifiability)
        return real_finding(self.canonical.chain, other.canonical.chain, answerers)

    def inclusions(self, other: "ComparedChain") -> Inclusions:
        """Both statements on two chains of unequal rank."""
        return inclusions(self, other)

    def tells_shares(self, other: "ComparedChain") -> bool:
        """Return True if both have the same number of masses."""
        return self.chain.n_masses == other.chain.n_masses

    def positive(self, other: "ComparedChain") -> PositiveFinding:
        """Positive models of this chain that have a positive equivalent in the other; evidence in
        canonical names.
        """
        return self._positive(self.canonical.chain, other.canonical.chain)

    def has_same_positive(self, other: "ComparedChain") -> bool:
        """Return True if every positive model of either is known to have a positive equivalent in
        the other.
        """
        return self.positive(other).share is other.positive(self).share is Share.ALWAYS

    @classmethod
    def prepare_positive(cls, ways: Sequence[ChainPair], ask: Ask) -> None:
        """Have the positive equivalents of the first ones of each pair looked for."""
        ask(POSITIVELY, [_canonical(*way) for way in ways])

    @classmethod
    def prepare_admissible(cls, pairs: Sequence[ChainPair], domain: Domain, ask: Ask) -> None:
        """Over real parameters: counts of solutions, and real models without real equivalents,
        the second way where the first finds none.
        """
        if domain is not Domain.REAL:
            return
        counted = [pair for pair in pairs if needs_counts(*_canonical(*pair))]
        ask(IDENTIFIABILITY, [(chain,) for pair in counted for chain in _canonical(*pair)])
        ways = [(pair[0], witness_ways(*_canonical(*pair))) for pair in pairs]
        for k in range(2):
            tasks = [(s, way[k]) for s, way in ways if len(way) > k]
            ask(LACKING, [chains for _, chains in tasks])
            none = {chains for s, chains in tasks if not s.answerer(LACKING, chains, s.settings)}
            ways = [(s, way) for s, way in ways if len(way) > k and way[k] in none]

    @classmethod
    def all_inclusions(cls, pairs: Sequence[ChainPair], ask: Ask) -> list[Inclusions]:
        """Inclusions of all pairs: first those that profiles decide, then those that need a search;
        each pair of canonical forms is computed once.
        """
        first = {_canonical(*pair): pair for pair in reversed(pairs)}
        quick = {key: quick_closure(*pair) for key, pair in first.items()}
        ask(CLOSURE, [by_rank(*first[key]) for key, finding in quick.items() if finding is None])
        closures = {
            key: asked_closure(*first[key]) if finding is None else finding
            for key, finding in quick.items()
        }
        implied = {key: implied_image(*first[key], closures[key]) for key in first}
        ask(IMAGE, [by_rank(*first[key]) for key, finding in implied.items() if finding is None])
        images = {
            key: asked_image(*first[key]) if finding is None else finding
            for key, finding in implied.items()
        }
        ask(
            IDEALS,
            [by_rank(*first[key]) for key in first if needs_ideals(images[key], closures[key])],
        )
        both = {key: join(*first[key], images[key], closures[key]) for key in first}
        return [both[_canonical(*pair)] for pair in pairs]

    def _positive(self, form: Chain, other: Chain) -> PositiveFinding:
        return self.answerer(POSITIVELY, (form, other), self.settings)

    def _lacking(self, form: Chain, other: Chain) -> PointText:
        return self.answerer(LACKING, (form, other), self.settings)

    def _identifiability(self, canonical_chain: Chain) -> Identifiability:
        return self.answerer(IDENTIFIABILITY, (canonical_chain,), self.settings)


def _canonical(left: ComparedChain, right: ComparedChain) -> tuple[Chain, Chain]:
    return left.canonical.chain, right.canonical.chain


def refuse_unequal(left: ComparedChain, right: ComparedChain) -> Finding | None:
    """Not computed for unequal ranks."""
    if left.rank == right.rank:
        return None
    return Finding(EXACT, Outcome.INAPPLICABLE, note="the ranks differ (condition 4)")
