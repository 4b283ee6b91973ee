"""One side of a comparison: a named chain, its profiles on demand, and its colouring for
renamings, each computed once.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

from disting.algebra.colouring import Colouring, colouring
from disting.algebra.sampling import prime
from disting.algebra.settings import Settings
from disting.behaviour.profile import Profile, profile
from disting.behaviour.sample import Representation, sample
from disting.conditions.finding import Finding, Outcome
from disting.conditions.finding_json import finding_from_json, finding_to_json
from disting.conditions.rule import EXACT
from disting.evidence.domain import Domain
from disting.evidence.positive import PositiveFinding, Values
from disting.model.chain import Chain
from disting.model.question import Answerer, Question, computed
from disting.model.structure import Structure
from disting.model.symmetry import Form, canonical
from disting.questions.identifiability import IDENTIFIABILITY, Identifiability
from disting.questions.same.exact import exact_finding, mirrored, resting_on_ranks
from disting.questions.same.real_and_positive import (
    LACKING,
    POSITIVELY,
    Asked,
    positive_ways,
    real_finding,
)

ProfileSource = Callable[[Structure, Representation, int, Settings], Profile]
EXACTLY = Question("exact decisions", exact_finding, finding_to_json, finding_from_json)


@dataclass(frozen=True)
class Subject:
    """`source` yields profiles, `answerer` answers about pairs; a cache may stand in for both
    computations.
    """

    name: str
    chain: Chain
    settings: Settings = field(default_factory=Settings)
    source: ProfileSource = profile
    answerer: Answerer = computed
    _known: dict[tuple[Representation, int], Profile] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def profile(self, representation: Representation, count: int) -> Profile:
        """Profile of the canonical form, which all symmetric chains share."""
        if (representation, count) not in self._known:
            found = self.source(
                self.canonical.chain.structure, representation, count, self.settings
            )
            self._known[representation, count] = found
        return self._known[representation, count]

    @property
    def rank(self) -> int:
        """Number of determinable parameters."""
        return self.profile(Representation.TF, 0).rank

    def exact(self, other: "Subject") -> Finding:
        """The exact decision on the canonical forms of both, for equal ranks; the pair's order
        does not matter.
        """
        if self.rank != other.rank:
            return Finding(EXACT, Outcome.INAPPLICABLE, note="the ranks differ (condition 4)")
        profiles = (s.profile(Representation.TF, 0) for s in (self, other))
        return resting_on_ranks(self._asked(EXACTLY, other), *profiles)

    def admissible(self, other: "Subject", domain: Domain) -> Finding:
        """Whether two models that are indistinguishable over complex parameters are so over
        this domain.
        """
        if domain is Domain.POSITIVE:
            return positive_ways(self.positive(other), other.positive(self))
        asked = Asked(self._positive, self._lacking, self._identifiability)
        return real_finding(self.canonical.chain, other.canonical.chain, asked)

    def positive(self, other: "Subject") -> PositiveFinding:
        """Which positive models of the one have a positive equivalent in the other; evidence in
        canonical names.
        """
        return self._positive(self.canonical.chain, other.canonical.chain)

    def _positive(self, given: Chain, other: Chain) -> PositiveFinding:
        return self.answerer(POSITIVELY, (given, other), self.settings)

    def _lacking(self, given: Chain, other: Chain) -> Values:
        return self.answerer(LACKING, (given, other), self.settings)

    def _identifiability(self, canonical_chain: Chain) -> Identifiability:
        return self.answerer(IDENTIFIABILITY, (canonical_chain,), self.settings)

    def _asked(self, question: Question[Finding], other: "Subject") -> Finding:
        first, second = self.in_order(other)
        found = self.answerer(question, (first, second), self.settings)
        return found if first == self.canonical.chain else mirrored(found)

    def in_order(self, other: "Subject") -> tuple[Chain, Chain]:
        """The canonical forms of both, in an order of their own, so that a pair is asked about
        once.
        """
        here, there = sorted(
            (self.canonical.chain, other.canonical.chain),
            key=lambda c: (c.indices, c.ground_dampers, c.lag),
        )
        return here, there

    @cached_property
    def canonical(self) -> Form:
        """Canonical form under the symmetries of the class."""
        return canonical(self.chain)

    @cached_property
    def colouring(self) -> Colouring:
        """Stable colours of the parameters in the transfer-function coefficients."""
        return colouring(self.columns, ("",) * len(self.chain.parameters))

    def columns(self, point: list[int]) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
        """Values and Jacobian columns of the transfer-function coefficients at a point, modulo one
        prime for all chains.

        Colours of many chains are compared, so they share it. Nothing rests on it: colours that
        differ prove that no renaming exists, modulo any prime, and a renaming that is found is
        proven exactly.
        """
        seen = sample(self.chain.structure, Representation.TF, 0, point, prime("renaming"))
        return seen.values, list(zip(*seen.rows, strict=True))
