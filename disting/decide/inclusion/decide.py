"""One-sided inclusion of chains of unequal rank, in both senses (`disting.conditions.inclusion`):
the order in which statements are sought.

V1, V2: irreducible closures of the images, dim V1 = r1 < r2 = dim V2, so V2 inside V1 is
impossible. What is found first is kept. Chains of different sizes are compared in `across_sizes`:
there only CLOSURE is decided. A dead time of the one alone is a limit of the other's at most, never
finite. The order of the methods is that of `decide.CLOSURE_CHAINS`, then `decide.IMAGE_CHAINS`;
equivalents prove CLOSURE too. Where neither is known, the whole model is decided by the ideal of a
fibre (`decide.BOTH_CHAINS`), with the bounds of `disting.fibres.ideals.bounds`. An empty fibre
refutes IMAGE, a solution, whose elements may be zero, proves CLOSURE.
"""

from collections.abc import Sequence
from dataclasses import replace

from disting.algebra.certainty import Certainty
from disting.behaviour.sample import Representation
from disting.conditions.chain_view import ChainSide
from disting.conditions.inclusion import (
    Inclusion,
    InclusionFinding,
    Inclusions,
    inclusion_from_dict,
    inclusion_to_dict,
    inclusions_from_dict,
    inclusions_to_dict,
)
from disting.conditions.side import Ask
from disting.decide import (
    BOTH_CHAINS,
    CLOSURE_CHAINS,
    IMAGE_CHAINS,
    first_finding,
    found_at_once,
)
from disting.decide.inclusion.closures import of_closure
from disting.decide.inclusion.profiles import by_elements, by_profiles
from disting.decide.same.exact import rational_part
from disting.evidence.decision import DeadTime
from disting.evidence.kinds import InclusionEvidence
from disting.evidence.limits import RowsInside
from disting.fibres.ideals import (
    Limits,
    coefficient_map,
    decide as decide_ideal,
    included_by_rows,
    normalise,
)
from disting.model.chain import Chain
from disting.model.question import Membership, Question, Settings

# of one ideal; less than for a verdict
INCLUSION_LIMITS = Limits(seconds=240.0, entries=200_000, safety=100)
# of the ideal of one row, tried for every pair
CLOSURE_LIMITS = Limits(seconds=60.0, entries=30_000, safety=100)
NOT_ASKED = "chains of different sizes are compared by limits only"
ONE_SENSOR = "models of one sensor quantity are compared"


def inclusions(left: ChainSide, right: ChainSide) -> Inclusions:
    """Both statements on two chains of unequal rank: what is cheap first, then what the
    answerer has to compute.
    """
    if left.rank == right.rank:
        raise ValueError("the ranks are equal: the verdict decides the inclusions")
    closure = quick_closure(left, right)
    if closure is None:
        closure = asked_closure(left, right)
    image = implied_image(left, right, closure)
    if image is None:
        image = asked_image(left, right)
    return join(left, right, image, closure)


def all_inclusions(pairs: Sequence[tuple[ChainSide, ChainSide]], ask: Ask) -> list[Inclusions]:
    """Return `inclusions` of many pairs: what profiles settle at once, then what has to be asked;
    each pair of canonical forms is looked at once.
    """
    first = {_forms(*pair): pair for pair in reversed(pairs)}
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
    return [both[_forms(*pair)] for pair in pairs]


def _forms(left: ChainSide, right: ChainSide) -> tuple[Chain, Chain]:
    return left.view.form, right.view.form


def by_rank(left: ChainSide, right: ChainSide) -> tuple[Chain, Chain]:
    """The canonical forms of both, the smaller rank first."""
    first, second = (left, right) if left.rank < right.rank else (right, left)
    return _forms(first, second)


def quick_closure(left: ChainSide, right: ChainSide) -> InclusionFinding | None:
    """Finding on CLOSURE from elements and profiles, or for chains of different sizes from counts
    and limits; None if there is none.
    """
    finding: InclusionFinding | None = found_at_once(CLOSURE_CHAINS.at_once, left, right)
    return finding


def of_two_sensors(left: ChainSide, right: ChainSide) -> InclusionFinding | None:
    """Not decided for two sensor quantities."""
    if left.chain.quantity is right.chain.quantity:
        return None
    return InclusionFinding(Inclusion.UNKNOWN, reason=ONE_SENSOR)


def are_of_two_sizes(left: ChainSide, right: ChainSide) -> bool:
    """Return True for sides with different numbers of masses."""
    return left.view.given.n_masses != right.view.given.n_masses


def are_of_one_size(left: ChainSide, right: ChainSide) -> bool:
    """Return True for sides with as many masses."""
    return left.view.given.n_masses == right.view.given.n_masses


def of_elements(left: ChainSide, right: ChainSide) -> InclusionFinding | None:
    """Elements that vanish or grow without bound."""
    return by_elements(*by_rank(left, right), left.rank < right.rank)


def of_profiles(left: ChainSide, right: ChainSide) -> InclusionFinding | None:
    """Degrees and projections refute, a full image proves."""
    first = left.rank < right.rank
    small, large = (left, right) if first else (right, left)
    profiles = (s.profile(Representation.TF, 0) for s in (small, large))
    return by_profiles(*profiles, left_is_smaller=first)


def implied_image(
    left: ChainSide, right: ChainSide, closure: InclusionFinding
) -> InclusionFinding | None:
    """IMAGE where it follows from CLOSURE or is not needed; None where it must be decided."""
    finding: InclusionFinding | None = found_at_once(IMAGE_CHAINS.at_once, left, right, closure)
    return finding


def of_limits(
    left: ChainSide, right: ChainSide, closure: InclusionFinding
) -> InclusionFinding | None:
    """Finding on equivalents from the finding on limits, since a model that is not a limit has no
    equivalent; limits for two sensor quantities are not considered.
    """
    two_sensors = left.chain.quantity is not right.chain.quantity
    return closure if closure.inclusion is Inclusion.NEITHER or two_sensors else None


def of_dead_time(
    left: ChainSide, right: ChainSide, closure: InclusionFinding
) -> InclusionFinding | None:
    """A dead time of one alone is a limit of the other's at most, never finite."""
    if left.chain.dead_time == right.chain.dead_time:
        return None
    time = DeadTime(left.chain.dead_time)
    return InclusionFinding(Inclusion.NEITHER, Certainty.THEOREM, evidence=time)


def of_two_sizes(
    left: ChainSide, right: ChainSide, closure: InclusionFinding
) -> InclusionFinding | None:
    """Not decided for chains of different sizes."""
    if left.chain.n_masses == right.chain.n_masses:
        return None
    return InclusionFinding(Inclusion.UNKNOWN, reason=NOT_ASKED)


def needs_ideals(image: InclusionFinding, closure: InclusionFinding) -> bool:
    """Return True if nothing at all is known of two chains that are compared in both senses."""
    return (
        not image.is_known
        and not closure.is_known
        and image.reason != NOT_ASKED
        and image != closure
    )


def join(
    left: ChainSide, right: ChainSide, image: InclusionFinding, closure: InclusionFinding
) -> Inclusions:
    """Both statements: by ideals where nothing is known; equivalents are limits."""
    if needs_ideals(image, closure):
        decided = left.answerer(IDEALS, by_rank(left, right), left.settings)
        image, closure = (
            f if left.rank < right.rank else turn(f) for f in (decided.image, decided.closure)
        )
    follows = not closure.is_known and image.is_known and image.inclusion is not Inclusion.NEITHER
    return Inclusions(image, image if follows else closure)


def turn(finding: InclusionFinding) -> InclusionFinding:
    """The finding on the pair in the other order; for findings whose left model is the smaller
    one.
    """
    evidence = None if finding.evidence is None else finding.evidence.turned
    return replace(finding, inclusion=finding.inclusion.turned, evidence=evidence)


def closure_of(small: Chain, large: Chain, settings: Settings) -> InclusionFinding:
    """CLOSURE of the model of the smaller rank in the other, by rows; by more for chains of
    different sizes.
    """
    finding: InclusionFinding = first_finding(CLOSURE_CHAINS.rows, small, large, settings)
    return finding


def differ_in_size(small: Chain, large: Chain, settings: Settings) -> bool:
    """Return True for different numbers of masses."""
    return small.n_masses != large.n_masses


def are_equal_in_size(small: Chain, large: Chain, settings: Settings) -> bool:
    """Return True for as many masses."""
    return small.n_masses == large.n_masses


def by_rows(small: Chain, large: Chain, settings: Settings) -> InclusionFinding | None:
    """Rows that lie inside those of the other, or equations against it."""
    proof = of_closure(small, large, settings.seed)
    if proof is None:
        return None
    evidence, safety = proof
    inclusion = Inclusion.LEFT_IN_RIGHT if isinstance(evidence, RowsInside) else Inclusion.NEITHER
    return InclusionFinding(
        inclusion, Certainty.BOUNDED if safety else Certainty.PROVEN, safety, evidence
    )


def by_two_rows(small: Chain, large: Chain, settings: Settings) -> InclusionFinding:
    """Small ideals of both rows."""
    closed = included_by_rows(
        rational_part(small), rational_part(large), settings.seed, CLOSURE_LIMITS
    )
    if closed.evidence is None:
        return InclusionFinding(
            Inclusion.UNKNOWN, reason="no limit is known, and no equation excludes one"
        )
    return InclusionFinding(
        Inclusion.LEFT_IN_RIGHT, Certainty.BOUNDED, closed.safety, closed.evidence
    )


def by_ideals(small: Chain, large: Chain, settings: Settings) -> Inclusions:
    """The model of the smaller rank searched in the other by the ideal of one fibre."""
    structures = (rational_part(small), rational_part(large))
    reason = ""
    for coordinates in (normalise, coefficient_map):
        whole = decide_ideal(
            *map(coordinates, structures),
            equal_rank=False,
            seed=settings.seed,
            limits=INCLUSION_LIMITS,
        )
        if whole.evidence is not None and whole.safety >= INCLUSION_LIMITS.safety:
            evidence = replace(whole.evidence, is_normalised=coordinates is normalise)
            return _read(whole.membership, whole.safety, evidence)
        reason = whole.reason
    unknown = InclusionFinding(
        Inclusion.UNKNOWN, reason=f"the ideal of the fibre does not decide ({reason})"
    )
    return Inclusions(unknown, unknown)


def asked_closure(left: ChainSide, right: ChainSide) -> InclusionFinding:
    """CLOSURE as the answerer computes it."""
    return _ask_question(CLOSURE, left, right)


def asked_image(left: ChainSide, right: ChainSide) -> InclusionFinding:
    """IMAGE as the answerer computes it."""
    return _ask_question(IMAGE, left, right)


def _ask_question(
    question: Question[InclusionFinding], left: ChainSide, right: ChainSide
) -> InclusionFinding:
    answer = left.answerer(question, by_rank(left, right), left.settings)
    return answer if left.rank < right.rank else turn(answer)


def _read(membership: Membership, safety: int, evidence: InclusionEvidence) -> Inclusions:
    """Inclusions that the fibre of an ideal proves: a solution proves limits, none refutes
    equivalents.
    """
    grade = Certainty.BOUNDED if safety else Certainty.PROVEN
    if membership is Membership.MEMBER:
        zeros = InclusionFinding(
            Inclusion.UNKNOWN, reason="elements of the solutions found may be zero"
        )
        return Inclusions(zeros, InclusionFinding(Inclusion.LEFT_IN_RIGHT, grade, safety, evidence))
    limits = InclusionFinding(
        Inclusion.UNKNOWN, reason="no limit is known, and no equation excludes one"
    )
    return Inclusions(InclusionFinding(Inclusion.NEITHER, grade, safety, evidence), limits)


CLOSURE = Question.plain("closures", closure_of, inclusion_to_dict, inclusion_from_dict)


def image_of(small: Chain, large: Chain, settings: Settings) -> InclusionFinding:
    """IMAGE of the model of the smaller rank in the other: what is exact first, then one fibre."""
    finding: InclusionFinding = first_finding(IMAGE_CHAINS.rows, small, large, settings)
    return finding


def both_of(small: Chain, large: Chain, settings: Settings) -> Inclusions:
    """Both statements, where nothing else is known of either."""
    both: Inclusions = found_at_once(BOTH_CHAINS.rows, small, large, settings)
    return both


IMAGE = Question.plain("images", image_of, inclusion_to_dict, inclusion_from_dict)
IDEALS = Question.plain("inclusions by ideals", both_of, inclusions_to_dict, inclusions_from_dict)
