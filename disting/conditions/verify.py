"""Checks a stored verdict again from its evidence alone: at fresh random points, without profiles, matroids or searches."""

from dataclasses import dataclass, field, replace
from math import comb

from disting.conditions.evidence import (
    ByProgram,
    Counts,
    DeadTime,
    Embedding,
    Evidence,
    FibreAt,
    Forms,
    FreeChoice,
    Ranks,
    Renaming,
    Supermodel,
    Theorem,
)
from disting.conditions.exact import program_refutes, rational_part, theorem
from disting.conditions.ways import BothWays, OddFibres
from disting.conditions.witnesses import Witnesses
from disting.ideals import Limits, Membership, Refuted, Solved, coefficient_map, confirms, decide, normalised
from disting.identifiability import identifiability
from disting.invariants.expanded import is_renaming
from disting.invariants.profile import samples
from disting.invariants.sample import Representation, Sample
from disting.model.chain import Chain
from disting.model.structure import Structure
from disting.model.symmetry import canonical
from disting.positivity import proves
from disting.settings import Settings
from disting.synthesis.decide import Grounds
from disting.synthesis.fibre import fibre
from disting.synthesis.result import Status
from disting.synthesis.target import fraction, target

POINTS = 3
PLAIN_MONOMIALS = 3000  # that plain elimination can bear


@dataclass
class Witness:
    """Fresh samples of structures, drawn with a seed of its own and kept for the next question."""

    seed: str = "verify"
    memo: dict[tuple[Structure, str, int], tuple[Sample, ...]] = field(default_factory=dict)

    def confirms(self, evidence: Evidence, representation: str, left: Chain, right: Chain) -> bool:
        """Whether the evidence is true of the two chains and decides them."""
        a, b = left.structure, right.structure
        match evidence:
            case Counts():
                return (
                    self._degrees(a) == evidence.left and self._degrees(b) == evidence.right and evidence.left != evidence.right
                )
            case Forms():
                return self._forms(evidence, representation, a, b)
            case Ranks():
                ranks = tuple(self._rank(s, representation, evidence.rows) for s in (a, b))
                return ranks == (evidence.left, evidence.right) and evidence.left != evidence.right
            case Renaming():
                complete = sorted(p for p, _ in evidence.pairs) == sorted(a.parameters)
                onto = sorted(q for _, q in evidence.pairs) == sorted(b.parameters)
                return complete and onto and is_renaming(a, b, dict(evidence.pairs))
            case FreeChoice():
                return all(self._freely(evidence, representation, s) for s in (a, b))
            case Embedding():
                part, whole = (a, b) if evidence.left_is_submodel else (b, a)
                fits = dict(evidence.numbering) in list(part.embeddings(whole))
                return fits and all(self._rank(s, "tf", ()) == evidence.rank for s in (a, b))
            case Solved() | Refuted():
                return _ideal(evidence, left, right)
            case Witnesses():
                return False  # it speaks of general models, see `parametric.confirms`
            case BothWays():
                return _both_ways(evidence, canonical(left).chain, canonical(right).chain)
            case OddFibres():
                return _odd(evidence, left, right)
            case ByProgram():
                return program_refutes(evidence, canonical(left).chain, canonical(right).chain)
            case Theorem():
                return theorem(left, right) == evidence.name
            case DeadTime():
                return (left.dead_time, right.dead_time) == (evidence.left_given, not evidence.left_given)
            case FibreAt():
                return self._fibre(evidence, left, right)
            case Supermodel():
                third = a.united(b)
                same = (a.ports, a.sensor_order) == (
                    b.ports,
                    b.sensor_order,
                ) and third.parameters == evidence.parameters
                return same and all(self._rank(s, "tf", ()) == evidence.rank for s in (a, b, third))

    def _fibre(self, evidence: FibreAt, a: Chain, b: Chain) -> bool:
        """The fibre over the stored point once more."""
        a, b = (canonical(replace(c, dead_time=False)).chain for c in (a, b))
        given, searched = (a, b) if evidence.left_given else (b, a)
        found = fibre(searched, target(given.structure, {name: fraction(value) for name, value in evidence.point}))
        refuted = evidence.grounds == Grounds.REFUTED
        return found.status is Status.EMPTY if refuted else len(found.solutions) == evidence.solutions > 0

    def _samples(self, structure: Structure, representation: str, count: int) -> tuple[Sample, ...]:
        key = (structure, representation, count)
        if key not in self.memo:
            self.memo[key] = tuple(samples(structure, Representation(representation), count, POINTS, self.seed))
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
        return {label for i, label in enumerate(seen[0].labels) if any(any(s.rows[i]) for s in seen)}

    def _forms(self, evidence: Forms, representation: str, a: Structure, b: Structure) -> bool:
        only = {*evidence.only_left, *evidence.only_right}
        here, there = (self._free(s, representation, _count(tuple(only))) for s in (a, b))
        return bool(only) and set(evidence.only_left) <= here - there and set(evidence.only_right) <= there - here

    def _freely(self, evidence: FreeChoice, representation: str, structure: Structure) -> bool:
        free = self._free(structure, representation, _count(evidence.free))
        return free == set(evidence.free) and self._rank(structure, representation, evidence.free) == len(free)


def _both_ways(evidence: BothWays, a: Chain, b: Chain) -> bool:
    """What is known of either way, once more; something is."""
    ways = [(x, *pair) for x, pair in ((evidence.left, (a, b)), (evidence.right, (b, a))) if x.certainty]
    return bool(ways) and all(proves(*way) for way in ways)


def _odd(evidence: OddFibres, left: Chain, right: Chain) -> bool:
    """Both numbers once more, at fresh points."""
    fresh = Settings(seed="verify")
    found = [(identifiability(chain, fresh), n) for chain, n in ((left, evidence.left), (right, evidence.right))]
    return all(n % 2 == 1 and x.least == x.most == n for x, n in found)


def _ideal(evidence: Solved | Refuted, left: Chain, right: Chain) -> bool:
    """A solution put into both models; a contradiction found again by plain elimination or, where that is too large, at a fresh
    point by the fast one.
    """
    coordinates = normalised if evidence.is_normalised else coefficient_map
    a, b = (coordinates(rational_part(canonical(chain).chain)) for chain in (left, right))
    if isinstance(evidence, Solved) or comb(len(a.parameters) + evidence.degree, evidence.degree) <= PLAIN_MONOMIALS:
        return confirms(evidence, a, b)
    given, other = (a, b) if evidence.left_given else (b, a)
    again = decide(
        given, other, equal_rank=evidence.tangent, seed="verify", limits=Limits(seconds=1800, entries=10**9, safety=1)
    )
    return again.membership is Membership.EXCLUDED


def _count(labels: tuple[str, ...]) -> int:
    """Markov parameters needed to have all these labels."""
    return max((int(x[1:]) for x in labels if x[0] == "G"), default=0)
