"""Checks a stored verdict again from its evidence alone: at fresh random points, without
profiles, matroids or searches.
"""

from dataclasses import dataclass, field, replace
from functools import partial

from disting.behaviour.expanded import is_renaming
from disting.behaviour.profile import samples
from disting.behaviour.sample import Representation, Sample
from disting.evidence.conditions import (
    ByConditions,
    Counts,
    Embedding,
    Forms,
    FreeChoice,
    Ranks,
    Renaming,
    Supermodel,
)
from disting.evidence.decision import DeadTime, FibreAt, FibreUnder, Theorem
from disting.evidence.general import Constants, Explicit, NoEquivalent, Witnesses
from disting.evidence.ideals import FullRows, Refuted, Shared, Solved
from disting.evidence.kinds import Evidence
from disting.evidence.positive import Share
from disting.evidence.real import BothWays, OddFibres, RealFactors, RealWitnesses
from disting.fibres.ideals import (
    chains_told_apart,
    coefficient_map,
    normalised,
    same_by_full_rows,
    seen_again,
)
from disting.fibres.synthesis.decide import Grounds
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.result import Status
from disting.fibres.synthesis.target import fraction, target
from disting.model.chain import Chain
from disting.model.minors import embeddings
from disting.model.settings import Settings
from disting.model.structure import Structure
from disting.model.symmetry import canonical
from disting.questions.identifiability import identifiability
from disting.questions.positive import confirms_real, proves
from disting.questions.same.exact import rational_part, theorem
from disting.questions.same.real_and_positive import real_factors
from disting.questions.same.summary_check import POINTS, Summary, confirms_summary


@dataclass
class Witness:
    """Fresh samples of structures, drawn with a seed of its own and kept for the next question."""

    seed: str = "verify"
    memo: dict[tuple[Structure, Representation, int], tuple[Sample, ...]] = field(
        default_factory=dict
    )

    def confirms(self, evidence: Evidence, representation: str, left: Chain, right: Chain) -> bool:
        """Whether the evidence is true of the two chains and decides them."""
        match evidence:
            case FibreAt():
                return self._fibre(evidence, left, right)
            case Theorem():
                return theorem(left, right) == evidence.name
            case DeadTime():
                return (left.dead_time, right.dead_time) == (
                    evidence.left_given,
                    not evidence.left_given,
                )
            case FullRows():
                return _full_rows(evidence, left, right)
            case Shared():
                return _shares(evidence, left, right)
            case Solved() | Refuted():
                return _ideal(evidence, left, right)
            case BothWays():
                return _both_ways(evidence, canonical(left).chain, canonical(right).chain)
            case OddFibres():
                return _odd(evidence, left, right)
            case RealFactors():
                return real_factors(canonical(left).chain, canonical(right).chain)
            case RealWitnesses():
                return _real_witnesses(evidence, canonical(left).chain, canonical(right).chain)
            case FibreUnder():
                return False  # of chains under several experiments
            case Witnesses() | Explicit() | NoEquivalent() | Constants():
                return False  # these speak of general models, see `general.confirms`
        return self._by_condition(evidence, representation, left.structure, right.structure)

    def _by_condition(
        self, evidence: ByConditions, representation: str, a: Structure, b: Structure
    ) -> bool:
        """Evidence of conditions 1 to 9."""
        match evidence:
            case Counts() | Forms() | Ranks() | FreeChoice():
                return confirms_summary(evidence, representation, *map(self._summary, (a, b)))
            case Renaming():
                return is_complete(evidence, a.parameters, b.parameters) and is_renaming(
                    a, b, dict(evidence.pairs)
                )
            case Embedding():
                return self._embeds(evidence, a, b)
            case Supermodel():
                return self._unites(evidence, a, b)

    def _embeds(self, evidence: Embedding, a: Structure, b: Structure) -> bool:
        """The numbering of the part's masses once more, and both ranks."""
        part, whole = (a, b) if evidence.left_is_submodel else (b, a)
        fits = dict(evidence.numbering) in list(embeddings(part, whole))
        return fits and all(self._rank(s) == evidence.rank for s in (a, b))

    def _unites(self, evidence: Supermodel, a: Structure, b: Structure) -> bool:
        """The third model once more, and all three ranks."""
        third = a.united(b)
        same_ports = (a.ports, a.sensor_order) == (b.ports, b.sensor_order)
        fits = same_ports and third.parameters == evidence.parameters
        return fits and all(self._rank(s) == evidence.rank for s in (a, b, third))

    def _fibre(self, evidence: FibreAt, a: Chain, b: Chain) -> bool:
        """The fibre over the stored point once more."""
        a, b = (canonical(replace(c, dead_time=False)).chain for c in (a, b))
        given, searched = (a, b) if evidence.left_given else (b, a)
        if sorted(name for name, _ in evidence.point) != sorted(given.structure.parameters):
            return False  # it speaks of another model
        try:
            point = {name: fraction(value) for name, value in evidence.point}
        except (ValueError, ZeroDivisionError):
            return False  # no numbers
        found = fibre(searched, target(given.structure, point))
        refuted = evidence.grounds == Grounds.REFUTED
        return (
            found.status is Status.EMPTY
            if refuted
            else len(found.solutions) == evidence.solutions > 0
        )

    def _rank(self, structure: Structure) -> int:
        """Number of determinable parameters."""
        return self._summary(structure).rank(Representation.TF, ())

    def _summary(self, structure: Structure) -> Summary:
        labels = self._samples(structure, Representation.TF, 0)[0].labels
        degrees = sum(x[0] == "b" for x in labels) - 1, sum(x[0] == "a" for x in labels)
        return Summary(partial(self._samples, structure), degrees)

    def _samples(
        self, structure: Structure, representation: Representation, count: int
    ) -> tuple[Sample, ...]:
        key = (structure, representation, count)
        if key not in self.memo:
            self.memo[key] = tuple(samples(structure, representation, count, POINTS, self.seed))
        return self.memo[key]


def is_complete(evidence: Renaming, parameters: tuple[str, ...], others: tuple[str, ...]) -> bool:
    """Whether it is a renaming at all: every parameter once on either side."""
    here = sorted(p for p, _ in evidence.pairs) == sorted(parameters)
    return here and sorted(q for _, q in evidence.pairs) == sorted(others)


def _both_ways(evidence: BothWays, a: Chain, b: Chain) -> bool:
    """What is known of either way, once more; something is."""
    ways = [
        (x, *pair) for x, pair in ((evidence.left, (a, b)), (evidence.right, (b, a))) if x.certainty
    ]
    return bool(ways) and all(proves(*way) for way in ways)


def _real_witnesses(evidence: RealWitnesses, a: Chain, b: Chain) -> bool:
    """Both once more."""
    given, other = (a, b) if evidence.with_left_given else (b, a)
    known = evidence.with_one.share in (Share.ALWAYS, Share.SOMETIMES) and proves(
        evidence.with_one, given, other
    )
    return known and confirms_real(
        evidence.without, *((a, b) if evidence.without_left_given else (b, a))
    )


def _full_rows(evidence: FullRows, left: Chain, right: Chain) -> bool:
    """Both ranks once more, at fresh points."""
    a, b = (canonical(chain).chain.structure for chain in (left, right))
    return same_by_full_rows(a, b, "verify") == evidence


def _shares(evidence: Shared, left: Chain, right: Chain) -> bool:
    """Every share refuted once more, at a fresh point."""
    a, b = (rational_part(canonical(chain).chain) for chain in (left, right))
    again = chains_told_apart(a, b, "verify")
    return again is not None and (again[0].part, again[0].shares > 0) == (
        evidence.part,
        evidence.shares > 0,
    )


def _odd(evidence: OddFibres, left: Chain, right: Chain) -> bool:
    """Both numbers once more, at fresh points."""
    fresh = Settings(seed="verify")
    found = [
        (identifiability(chain, fresh), n)
        for chain, n in ((left, evidence.left), (right, evidence.right))
    ]
    return all(n % 2 == 1 and x.least == x.most == n for x, n in found)


def _ideal(evidence: Solved | Refuted, left: Chain, right: Chain) -> bool:
    """A solution put into both models; a contradiction found again by plain elimination or, where
    that is too large, at a fresh point by the fast one.
    """
    coordinates = normalised if evidence.is_normalised else coefficient_map
    a, b = (coordinates(rational_part(canonical(chain).chain)) for chain in (left, right))
    return seen_again(evidence, a, b)
