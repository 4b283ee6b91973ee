"""Checks a stored verdict again from its evidence alone: at fresh random points, without
profiles, matroids or searches.
"""

from dataclasses import dataclass, field, replace
from math import comb

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
from disting.evidence.ideals import ByRow, FullRows, Refuted, Shared, Solved
from disting.evidence.kinds import Evidence
from disting.evidence.positive import Share
from disting.evidence.real import BothWays, OddFibres, RealFactors, RealWitnesses
from disting.fibres.ideals import (
    Limits,
    chains_told_apart,
    coefficient_map,
    confirms,
    confirms_row,
    decide,
    normalised,
    same_by_full_rows,
)
from disting.fibres.synthesis.decide import Grounds
from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.result import Status
from disting.fibres.synthesis.target import fraction, target
from disting.model.chain import Chain
from disting.model.question import Membership
from disting.model.settings import Settings
from disting.model.structure import Structure
from disting.model.symmetry import canonical
from disting.questions.identifiability import identifiability
from disting.questions.positive import confirms_real, proves
from disting.questions.same.exact import rational_part, theorem
from disting.questions.same.real_and_positive import real_factors

POINTS = 3
PLAIN_MONOMIALS = 3000  # that plain elimination can bear


@dataclass
class Witness:
    """Fresh samples of structures, drawn with a seed of its own and kept for the next question."""

    seed: str = "verify"
    memo: dict[tuple[Structure, str, int], tuple[Sample, ...]] = field(default_factory=dict)

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
            case ByRow():
                return confirms_row(
                    evidence, *(rational_part(canonical(chain).chain) for chain in (left, right))
                )
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
            case Counts():
                found = self._degrees(a), self._degrees(b)
                return found == (evidence.left, evidence.right) and evidence.left != evidence.right
            case Forms():
                return self._forms(evidence, representation, a, b)
            case Ranks():
                return self._ranks(evidence, representation, a, b)
            case Renaming():
                return _renames(evidence, a, b)
            case FreeChoice():
                return all(self._freely(evidence, representation, s) for s in (a, b))
            case Embedding():
                return self._embeds(evidence, a, b)
            case Supermodel():
                return self._unites(evidence, a, b)

    def _ranks(self, evidence: Ranks, representation: str, a: Structure, b: Structure) -> bool:
        """Both ranks once more, of rows that there are."""
        seen = [self._samples(s, representation, _count(evidence.rows))[0].labels for s in (a, b)]
        ranks = tuple(self._rank(s, representation, evidence.rows) for s in (a, b))
        known = set(evidence.rows) <= {label for labels in seen for label in labels}
        return (
            known and ranks == (evidence.left, evidence.right) and evidence.left != evidence.right
        )

    def _embeds(self, evidence: Embedding, a: Structure, b: Structure) -> bool:
        """The numbering of the part's masses once more, and both ranks."""
        part, whole = (a, b) if evidence.left_is_submodel else (b, a)
        fits = dict(evidence.numbering) in list(part.embeddings(whole))
        return fits and all(self._rank(s, "tf", ()) == evidence.rank for s in (a, b))

    def _unites(self, evidence: Supermodel, a: Structure, b: Structure) -> bool:
        """The third model once more, and all three ranks."""
        third = a.united(b)
        same_ports = (a.ports, a.sensor_order) == (b.ports, b.sensor_order)
        fits = same_ports and third.parameters == evidence.parameters
        return fits and all(self._rank(s, "tf", ()) == evidence.rank for s in (a, b, third))

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

    def _samples(self, structure: Structure, representation: str, count: int) -> tuple[Sample, ...]:
        key = (structure, representation, count)
        if key not in self.memo:
            self.memo[key] = tuple(
                samples(structure, Representation(representation), count, POINTS, self.seed)
            )
        return self.memo[key]

    def _degrees(self, structure: Structure) -> tuple[int, int]:
        labels = self._samples(structure, "tf", 0)[0].labels
        return sum(x[0] == "b" for x in labels) - 1, sum(x[0] == "a" for x in labels)

    def _rank(self, structure: Structure, representation: str, rows: tuple[str, ...]) -> int:
        """Rank of the named rows, or of all."""
        seen = self._samples(structure, representation, _count(rows))
        chosen = tuple(i for i, label in enumerate(seen[0].labels) if not rows or label in rows)
        return max(s.rank(chosen) for s in seen)

    def _free(self, structure: Structure, representation: str, count: int) -> set[str]:
        seen = self._samples(structure, representation, count)
        return {
            label for i, label in enumerate(seen[0].labels) if any(any(s.rows[i]) for s in seen)
        }

    def _forms(self, evidence: Forms, representation: str, a: Structure, b: Structure) -> bool:
        only = {*evidence.only_left, *evidence.only_right}
        here, there = (self._free(s, representation, _count(tuple(only))) for s in (a, b))
        return (
            bool(only)
            and set(evidence.only_left) <= here - there
            and set(evidence.only_right) <= there - here
        )

    def _freely(self, evidence: FreeChoice, representation: str, structure: Structure) -> bool:
        free = self._free(structure, representation, _count(evidence.free))
        return free == set(evidence.free) and self._rank(
            structure, representation, evidence.free
        ) == len(free)


def _renames(evidence: Renaming, a: Structure, b: Structure) -> bool:
    """The renaming put into both transfer functions, if it is one: every parameter once on
    either side.
    """
    complete = sorted(p for p, _ in evidence.pairs) == sorted(a.parameters)
    onto = sorted(q for _, q in evidence.pairs) == sorted(b.parameters)
    return complete and onto and is_renaming(a, b, dict(evidence.pairs))


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
    if (
        isinstance(evidence, Solved)
        or comb(len(a.parameters) + evidence.degree, evidence.degree) <= PLAIN_MONOMIALS
    ):
        return confirms(evidence, a, b)
    given, other = (a, b) if evidence.left_given else (b, a)
    again = decide(
        given,
        other,
        equal_rank=evidence.tangent,
        seed="verify",
        limits=Limits(seconds=1800, entries=10**9, safety=1),
    )
    return again.membership is Membership.EXCLUDED


def _count(labels: tuple[str, ...]) -> int:
    """Markov parameters needed to have all these labels."""
    return max((int(x[1:]) for x in labels if x[0] == "G" and x[1:].isdecimal()), default=0)
