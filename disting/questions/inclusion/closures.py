"""Limits of chains of as many masses, row by row: whether generic models of one chain are limits
of models of another one.

Notation of `disting.fibres.ideals.splits`: x, q, a chain with a gap h is a sum H = R + F, R =
N_R/D_R, F = N_F/D_F, deg D_R = A = q h, x^q divides D_F, deg D_F = B. Let the generic receptance
n/d of the smaller chain, in lowest terms, be a limit of models of the larger one: pairs (N_k :
D_k) of these converge to (n : d), D_k = D_Rk D_Fk, N_k = N_Rk D_Fk + N_Fk D_Rk. (The closure of
the image of a polynomial map is the same in the topologies of Zariski and of the complex numbers.)

Theorem. Then n/d = R + F, where (N_R : D_R) and (N_F : D_F) are limits of the rows' pairs and deg
D_R = A, deg D_F = B.

Proof. Scale D_Rk and D_Fk so that their largest coefficients have the modulus 1, and go over to a
subsequence for which they converge, to D_R and D_F, which are not zero. Then D_k converges to D_R
D_F, not zero, which thus is d up to a factor, and N_k, in the same scale, to n times this factor.
d has the degree A + B: so deg D_R = A, deg D_F = B. d has 0 as a root of order q and simple roots
else, and x^q divides every D_Fk and so D_F: D_R and D_F are coprime. So (u, v) -> u D_F + v D_R is
injective where deg u < A, deg v < B, and so are the maps with D_Fk and D_Rk, with inverses that
converge: N_Rk and N_Fk converge too.

The theorem of `splits` uses nothing of the larger chain but that numerators have at most certain
degrees, which limits keep. So if it applies, the summands of n/d are among its three splits.
Conversely, where in a split both are limits of what the larger chain's rows can be, their sum is a
limit of its models. `row_closures` decides the possible limits of a row.
"""

from collections.abc import Sequence
from dataclasses import replace

from disting.algebra.certainty import about, joint_safety
from disting.evidence.limits import SUPPORTS, WHOLE, Outside, RowsInside
from disting.fibres.ideals import normalise
from disting.fibres.ideals.splits import (
    SAME,
    gap,
    has_relation,
    is_plain,
    poles_are_inseparable,
    power,
    receptances,
    splits,
)
from disting.model.chain import Chain, Sensor, Structure
from disting.model.row import FREE, canonical_rows
from disting.questions.inclusion.row_closures import (
    Proof,
    Task,
    as_large,
    by_dimension,
    holds,
    show,
)

ClosureProof = tuple[Task, Proof | None]
"""A row, and what settles it at little cost."""


def of_closure(small: Chain, large: Chain, seed: str) -> tuple[Outside | RowsInside, int] | None:
    """Result of the rows on limits, with the bits of its error bound (0: proven); None if there is
    none.

    >>> end, next_to_end = (Chain(3, 0, 0, 1, 0, mass, damped=True) for mass in (3, 2))
    >>> of_closure(end, next_to_end, "doc")[0].steps[0].why
    <Why.MOMENTUM: 'momentum'>
    """
    structure, other = (
        replace(c, sensor=Sensor.POSITION, dead_time=False).structure for c in (small, large)
    )
    if not _alike(structure, other):
        return None
    label = about(seed, small)
    splits = [
        [(wanted, show(wanted, label)) for wanted in some]
        for some in _by_split(structure, other, large).values()
    ]
    for rows in splits:
        steps = [proof.step for _, proof in rows if proof is not None]
        if steps and len(steps) == len(rows) and all(step.why in SUPPORTS for step in steps):
            return RowsInside(True, tuple(steps)), 0
    if not _covers_splits(structure, other, f"{seed}:{small}:poles"):
        return None
    against = _against(splits, seed)
    if against is None:
        return None
    bits = joint_safety(proof.safety for proof in against if proof.safety)
    return Outside(True, tuple(proof.step for proof in against)), bits


def _against(splits: Sequence[Sequence[ClosureProof]], seed: str) -> list[Proof] | None:
    """Refutations of one row of every split, by ideals only where nothing else refutes it; None if
    a split has no such row.
    """
    refuted = [
        next(
            (proof for _, proof in rows if proof is not None and proof.step.why not in SUPPORTS),
            None,
        )
        for rows in splits
    ]
    open_rows = [[wanted for wanted, proof in rows if proof is None] for rows in splits]
    missing = [rows for proof, rows in zip(refuted, open_rows, strict=True) if proof is None]
    if not all(any(map(as_large, rows)) for rows in missing):
        return None  # of one split nothing will be found
    dear = []
    for rows in missing:
        proof = next(filter(None, (by_dimension(wanted, seed) for wanted in rows)), None)
        if proof is None:
            return None
        dear.append(proof)
    rest = iter(dear)
    return [next(rest) if proof is None else proof for proof in refuted]


def confirms_rows(evidence: Outside | RowsInside, small: Chain, large: Chain) -> bool:
    """Return True if the steps are those of all rows of one split, or of one row of every split,
    and each of them holds again.
    """
    structure, other = (
        replace(c, sensor=Sensor.POSITION, dead_time=False).structure for c in (small, large)
    )
    if not _alike(structure, other):
        return False
    possible = {
        (w.split, w.name): w for some in _by_split(structure, other, large).values() for w in some
    }
    named = [(step.split, step.part) for step in evidence.steps]
    if len(set(named)) < len(named) or not set(named) <= possible.keys():
        return False
    named_splits, ways = {split for split, _ in named}, [split for split, _ in possible]
    if isinstance(evidence, RowsInside):
        complete = len(named_splits) == 1 and len(named) == sum(
            split in named_splits for split in ways
        )
    else:
        complete = named_splits == set(ways) and _covers_splits(structure, other, "verify:poles")
    sides = all(
        (step.why in SUPPORTS) == isinstance(evidence, RowsInside) for step in evidence.steps
    )
    return (
        complete
        and sides
        and all(holds(step, possible[step.split, step.part]) for step in evidence.steps)
    )


def _alike(structure: Structure, other: Structure) -> bool:
    """Return True if both are plain and have the same size and damping."""
    kinds = [(s.n_masses, power(s)) for s in (structure, other)]
    return is_plain(structure) and is_plain(other) and kinds[0] == kinds[1]


def _covers_splits(structure: Structure, other: Structure, label: str) -> bool:
    """Return True if no other splits are possible: the theorem of `splits` applies, or the larger
    chain is one row.
    """
    return gap(other) == 0 or (
        has_relation(receptances(other), power(other)) and poles_are_inseparable(structure, label)
    )


def _by_split(structure: Structure, other: Structure, large: Chain) -> dict[str, list[Task]]:
    rows, own_rows = canonical_rows(large.structure), canonical_rows(structure)
    if gap(other) == 0:
        wanted, searched = normalise(structure), normalise(other)
        return {
            WHOLE: (
                [
                    Task(
                        split=WHOLE,
                        name=WHOLE,
                        receptance=wanted,
                        searched=searched,
                        row=rows[FREE],
                    )
                ]
                if wanted.degrees[1] == searched.degrees[1]
                else []
            )
        }
    ways = {}
    for split in splits(structure, gap(other)):
        pairs = zip(split.receptances.named, receptances(other).named, strict=True)
        ways[split.name] = [
            Task(
                split=split.name,
                name=name,
                receptance=wanted,
                searched=searched,
                row=rows[name],
                own=own_rows[name] if split.name == SAME else None,
            )
            for (name, wanted), (_, searched) in pairs
        ]
    return ways
