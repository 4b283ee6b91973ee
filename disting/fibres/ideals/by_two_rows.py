"""Inclusion of generic models of one chain in another one that has a gap, row by row.

The theorem of `splits` leaves three splits at most. In each of them both rows of the second chain
have to be given receptances:

* generic models of the first have an equivalent with finite elements other than zero only if in
  some split both rows do;
* if in some split both receptances lie in the closures of what the rows can be, the models of the
  first lie in the closure of those of the second, because a sum of fractions is a continuous
  function of its terms.

A row is refuted by a Markov parameter, h_i in sum h_i s^-i, that is a product of unknowns there
(so not zero) and zero in the receptance to be met, or the reverse: an identity of polynomials,
without any chance. That both can be met goes to `decide`, which has to do with much smaller maps
than those of whole chains.
"""

from dataclasses import replace

from flint import fmpz_mpoly

from disting.evidence.ideals import ByRows, FibreEvidence, RowStep, Solutions, Vanishing
from disting.evidence.kinds import Decision
from disting.fibres.ideals.confirm import holds_for
from disting.fibres.ideals.fibre_ideal import generic_rank
from disting.fibres.ideals.membership import Limits, decide
from disting.fibres.ideals.splits import (
    Receptances,
    Split,
    gap,
    has_relation,
    is_plain,
    poles_are_inseparable,
    power,
    receptances,
    relative_degree,
    splits,
)
from disting.fibres.ideals.system import CoefficientMap
from disting.model.chain import Structure
from disting.model.question import Membership

# for up to eight statements: at most two rows in three splits, and the ranks that they rest on
SPARE_BITS = 3
RowPair = tuple[str, CoefficientMap, CoefficientMap]  # a row's name, what is wanted, what is there
RANK_POINTS = 3  # one misses a rank with less than 2^-50, so that three are surer than the ideals


def refuted_by_rows(structure: Structure, other: Structure, seed: str) -> ByRows | None:
    """A proof, without any chance, that generic models of `structure` have no equivalent in
    `other`; None if there is none.
    """
    if obstacle(structure, other, f"{seed}:poles"):
        return None
    steps = [vanishing_step(split, receptances(other)) for split in splits(structure, gap(other))]
    differing = tuple(step for step in steps if step is not None)
    return ByRows(True, differing) if len(differing) == len(steps) else None


def included_by_rows(
    structure: Structure, other: Structure, seed: str, limits: Limits
) -> Decision[ByRows]:
    """Decide whether, in some split, the closures of both rows contain the wanted receptances;
    elements may be zero. Else UNKNOWN.
    """
    wanted = replace(limits, safety=limits.safety + SPARE_BITS)
    for split in splits(structure, gap(other)) if _are_alike(structure, other) else ():
        steps = _members(split, receptances(other), seed, wanted)
        if steps is not None:
            return Decision(Membership.MEMBER, limits.safety, ByRows(True, steps))
    return Decision(Membership.UNKNOWN, reason="no split was found in which both rows can be met")


def _members(
    split: Split, searched: Receptances, seed: str, limits: Limits
) -> tuple[RowStep, ...] | None:
    steps = list[RowStep]()
    for name, wanted, reached in _by_size(split, searched):
        rank, most = _ranks(wanted, reached, f"rank:{seed}")
        short = reached.degrees[0] - wanted.degrees[0]
        if rank > most or short < 0 or (rank == most and short):
            return None
        decided = decide(wanted, reached, equal_rank=rank == most, seed=seed, limits=limits)
        if not isinstance(decided.evidence, Solutions) or decided.safety < limits.safety:
            return None
        steps.append(RowStep(split.name, name, replace(decided.evidence, is_normalised=True)))
    return tuple(steps)


def confirms_by_rows(evidence: ByRows, left: Structure, right: Structure) -> bool:
    """Return True if the evidence holds: poles and splits are recomputed, each step is checked
    without the search that found it.
    """
    structure, other = (left, right) if evidence.left_given else (right, left)
    if not _are_alike(structure, other) or (
        not evidence.is_member and obstacle(structure, other, "verify:poles")
    ):
        return False
    searched, possible = (
        dict(receptances(other).named),
        {s.name: dict(s.receptances.named) for s in splits(structure, gap(other))},
    )
    if any(s.split not in possible or s.part not in possible[s.split] for s in evidence.steps):
        return False
    covered_splits = {s.split for s in evidence.steps}
    if evidence.is_member:
        complete = len(covered_splits) == 1 and {s.part for s in evidence.steps} == set(searched)
    else:
        complete = covered_splits == set(possible) and not any(
            isinstance(s.shown, Solutions) for s in evidence.steps
        )
    return complete and all(
        _confirms(s.shown, possible[s.split][s.part], searched[s.part]) for s in evidence.steps
    )


def obstacle(structure: Structure, other: Structure, label: str) -> str:
    """Why the theorem does not apply; empty if it does."""
    if not _are_alike(structure, other):
        return (
            "chains of one size and sensor are taken apart, without ground dampers and lag, and the"
            " searched one has a gap"
        )
    if not has_relation(receptances(other), power(other)):
        return "force and sensor at one place in both rows leave all sets of poles possible"
    return (
        ""
        if poles_are_inseparable(structure, label)
        else "the poles of a row were not proven to be inseparable"
    )


def _are_alike(structure: Structure, other: Structure) -> bool:
    """Return True if both are plain, have the same size, sensor and damping, and the searched one
    has a gap.
    """
    kinds = [(s.n_masses, s.sensor_order, power(s)) for s in (structure, other)]
    return is_plain(structure) and is_plain(other) and kinds[0] == kinds[1] and gap(other) > 0


def _ranks(wanted: CoefficientMap, reached: CoefficientMap, label: str) -> tuple[int, int]:
    """Generic ranks of both, the largest found at some points."""
    labels = (label, *(f"{label}:{k}" for k in range(1, RANK_POINTS)))
    rank, most = (max(generic_rank(m, x) for x in labels) for m in (wanted, reached))
    return rank, most


def _pairs(split: Split, searched: Receptances) -> list[RowPair]:
    """Name of a row, the receptance wanted and the map that is there."""
    return [
        (name, wanted, reached)
        for (name, wanted), (_, reached) in zip(
            split.receptances.named, searched.named, strict=True
        )
    ]


def _by_size(
    split: Split, searched: Receptances
) -> list[tuple[str, CoefficientMap, CoefficientMap]]:
    """The row with the fewest unknowns first."""
    return sorted(_pairs(split, searched), key=lambda pair: len(pair[2].parameters))


def vanishing_step(split: Split, searched: Receptances) -> RowStep | None:
    """A row that a Markov parameter refutes in this split, without any chance; None if there
    is none.
    """
    constants = (
        (name, refuting_index(wanted, reached)) for name, wanted, reached in _pairs(split, searched)
    )
    return next(
        (
            RowStep(split.name, name, Vanishing(index))
            for name, index in constants
            if index is not None
        ),
        None,
    )


def refuting_index(wanted: CoefficientMap, reached: CoefficientMap) -> int | None:
    """Index of a Markov parameter that refutes the row, among its first two; None if there is
    none.

    >>> from disting.model.chain import Chain
    >>> chains = (Chain(2, 0, 0, 1, 0, port, damped=True) for port in (2, 1))
    >>> refuting_index(*(receptances(c.structure).free for c in chains))
    2
    """
    first = relative_degree(reached)
    return next((i for i in range(1, first + 2) if _refutes(i, wanted, reached)), None)


def _refutes(index: int, wanted: CoefficientMap, reached: CoefficientMap) -> bool:
    met, own = (_markov(m, index) for m in (wanted, reached))
    return bool((len(own) == 1 and met.is_zero()) or (own.is_zero() and not met.is_zero()))


def _markov(model: CoefficientMap, index: int) -> fmpz_mpoly:
    """a_n^i h_i for a denominator of degree n: a_n h_i = b_(n-i) - sum_(j < i) a_(n-i+j) h_j."""
    n, lead = len(model.denominator) - 1, model.denominator[-1]
    zero = lead - lead
    scaled = [zero]
    for i in range(1, index + 1):
        top = model.numerator[n - i] if 0 <= n - i < len(model.numerator) else zero
        tail = (
            model.denominator[n - i + j] * lead ** (i - 1 - j) * scaled[j]
            for j in range(max(1, i - n), i)
        )
        scaled.append(top * lead ** (i - 1) - sum(tail, zero))
    return scaled[index]


def _confirms(shown: FibreEvidence, wanted: CoefficientMap, reached: CoefficientMap) -> bool:
    if isinstance(shown, Vanishing):
        return shown.index > 0 and _refutes(shown.index, wanted, reached)
    ranks = _ranks(wanted, reached, "rank:verify")
    in_order = ranks[0] == ranks[1] or (ranks[0] < ranks[1] and shown.left_given)
    return in_order and holds_for(shown, wanted, reached)
