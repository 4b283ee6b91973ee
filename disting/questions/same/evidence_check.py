"""Checks a stored verdict again from its evidence alone: at fresh random points, without
profiles, matroids or searches.
"""

from dataclasses import dataclass, field, replace
from functools import partial

from disting.behaviour.chain_model import ChainModel
from disting.behaviour.transfer import is_renaming
from disting.conditions.rule import Finding
from disting.decide import SAME_CHAINS, Of, check, deciders_of, recheck
from disting.evidence.decision import DeadTime, FibreAt, Theorem
from disting.evidence.ideals import FullRows, NoShares, Refutation, Solutions
from disting.evidence.kind import Kind, ModelSamples, SampledPair, samples_of
from disting.evidence.positive import BothWays, OddFibres, RealFactors, RealWitnesses, Share
from disting.fibres.ideals import (
    MOST,
    coefficient_map,
    holds_for,
    match_maps,
    normalise,
    refuted_at,
    same_by_full_rows,
    tell_chains_apart,
)
from disting.fibres.synthesis.decide import Direction, member_at
from disting.fibres.synthesis.task import fraction
from disting.model.chain import Chain, Structure
from disting.model.minors import embeddings
from disting.model.question import Settings
from disting.model.symmetry import between, canonical
from disting.questions.identifiability.analysis import identifiability
from disting.questions.positive import confirms_real, proves
from disting.questions.same.exact import rational_part, theorem
from disting.questions.same.real_and_positive import real_factors


@dataclass
class Witness:
    """Fresh samples of structures, drawn with a seed of its own and kept for the next question."""

    seed: str = "verify"
    memo: dict[Structure, ModelSamples] = field(default_factory=dict)

    def confirms(self, evidence: Kind, representation: str, left: Chain, right: Chain) -> bool:
        """Return True if the evidence holds for the two chains and decides them."""
        a, b = left.structure, right.structure
        pair = SampledPair(
            left=self._sample_model(a),
            right=self._sample_model(b),
            renames=partial(is_renaming, a, b),
            found_again=partial(_found_again, left=left, right=right),
            numberings=lambda left_is_part: embeddings(*((a, b) if left_is_part else (b, a))),
            united=lambda: self._unite(a, b),
            by_symmetry=partial(between, left, right),
        )
        return evidence.holds(pair, representation)

    def _unite(self, a: Structure, b: Structure) -> ModelSamples | None:
        """The model with the elements of both, if force and sensor of both are at one place."""
        same_ports = (a.ports, a.sensor_order) == (b.ports, b.sensor_order)
        return self._sample_model(a.united(b)) if same_ports else None

    def _sample_model(self, structure: Structure) -> ModelSamples:
        if structure not in self.memo:
            self.memo[structure] = samples_of(ChainModel(structure), self.seed)
        return self.memo[structure]


def _found_again(evidence: Kind, left: Chain, right: Chain) -> bool:
    """Recompute the evidence of the exact decision, or of the decision over real and positive
    parameters.
    """
    return check(evidence, deciders_of(Of.CHAINS), left, right)


def check_theorem(evidence: Theorem, left: Chain, right: Chain) -> bool:
    """The theorem by its name."""
    return theorem(left, right) == evidence.name


def check_dead_time(evidence: DeadTime, left: Chain, right: Chain) -> bool:
    """Return True if exactly one of them, the stated one, has a dead time."""
    dead_times = (left.dead_time, right.dead_time)
    return dead_times == (evidence.left_given, not evidence.left_given)


def check_full_rows(evidence: FullRows, left: Chain, right: Chain) -> bool:
    """The rows of the canonical chains once more."""
    a, b = (chain.structure for chain in _canonical(left, right))
    return same_by_full_rows(a, b, "verify") == evidence


def check_ideal(evidence: Solutions | Refutation, left: Chain, right: Chain) -> bool:
    """Solutions put into both transfer functions, contradictions found again."""
    coordinates = normalise if evidence.is_normalised else coefficient_map
    first, second = (coordinates(rational_part(c)) for c in _canonical(left, right))
    return holds_for(evidence, first, second)


def check_real_factors(evidence: RealFactors, left: Chain, right: Chain) -> bool:
    """Real factors of all degrees that are needed, both ways."""
    return real_factors(*_canonical(left, right))


def _canonical(left: Chain, right: Chain) -> tuple[Chain, Chain]:
    return canonical(left).chain, canonical(right).chain


def check_fibre(evidence: FibreAt, a: Chain, b: Chain) -> bool:
    """The fibre over the stored point once more."""
    a, b = (canonical(replace(c, dead_time=False)).chain for c in (a, b))
    way = Direction.LEFT_IN_RIGHT if evidence.left_given else Direction.RIGHT_IN_LEFT
    chain = a if evidence.left_given else b
    names = sorted(name for name, _ in evidence.point)
    comparable = (a.n_masses, a.sensor) == (b.n_masses, b.sensor)
    if names != sorted(chain.structure.parameters) or not comparable:
        return False  # it speaks of other models
    try:
        point = {name: fraction(value) for name, value in evidence.point}
    except (ValueError, ZeroDivisionError):
        return False  # no numbers
    finding = member_at(a, b, way, point)
    return finding.is_exact and finding.evidence == evidence


def check_both_ways(evidence: BothWays, left: Chain, right: Chain) -> bool:
    """Recompute the finding of either direction; at least one is known."""
    a, b = _canonical(left, right)
    ways = [
        (x, *pair) for x, pair in ((evidence.left, (a, b)), (evidence.right, (b, a))) if x.certainty
    ]
    return bool(ways) and all(proves(*way) for way in ways)


def check_real_witnesses(evidence: RealWitnesses, left: Chain, right: Chain) -> bool:
    """Both once more."""
    a, b = _canonical(left, right)
    chain, other = (a, b) if evidence.with_left_given else (b, a)
    witnessed = evidence.with_one.share in (Share.ALWAYS, Share.SOMETIMES) and proves(
        evidence.with_one, chain, other
    )
    return witnessed and confirms_real(
        evidence.without, *((a, b) if evidence.without_left_given else (b, a))
    )


def check_shares(evidence: NoShares, left: Chain, right: Chain) -> bool:
    """Every share refuted once more, at a fresh point, in the same direction."""
    a, b = _canonical(left, right)
    tries = [(evidence.left_given, MOST)]
    again = tell_chains_apart(rational_part(a), rational_part(b), "verify", tries)
    stated = (evidence.part, evidence.shares > 0)
    return again is not None and (again[0].part, again[0].shares > 0) == stated


def check_odd_fibres(evidence: OddFibres, left: Chain, right: Chain) -> bool:
    """Both numbers once more, at fresh points."""
    fresh = Settings(seed="verify")
    answers = [
        (identifiability(chain, fresh), n)
        for chain, n in ((left, evidence.left), (right, evidence.right))
    ]
    return all(n % 2 == 1 and x.least == x.most == n for x, n in answers)


def finding_holds(finding: Finding, first: Chain, second: Chain, settings: Settings) -> bool:
    """Return True if the evidence of a finding on two canonical chains of equal rank supports
    exactly that finding.

    Outcome, bound and labels are compared with those that the settings draw. At these labels shares
    are refuted once more, solutions are put into both transfer functions, and contradictions of
    ideals are found again: all that the bound counts, in the direction that the evidence names.
    Raises NotSeenError where that takes too long.
    """
    evidence = finding.evidence
    if evidence is None or finding != recheck(evidence, SAME_CHAINS.rows, first, second, settings):
        return False
    if isinstance(evidence, Solutions):  # of ideals, only the labels were drawn again
        return Witness().confirms(evidence, "fibre", first, second)
    if isinstance(evidence, Refutation):
        coordinates = normalise if evidence.is_normalised else coefficient_map
        maps = match_maps(*(coordinates(rational_part(chain)) for chain in (first, second)))
        return refuted_at(evidence.labels, evidence, *maps)
    return True
