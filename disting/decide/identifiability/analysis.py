"""From a chain to its identifiability: rank and row space, then the fibre, then their combination.

It is found on a canonical form and reported in the parameters of the given chain.

Whether an identifiable function has one value for all parameters with the same behaviour, or
several, is decided at one random point. A difference there is one for generic points, where the
solutions vary continuously; agreement at exactly known solutions, which are rational functions of
the point, is generic but for a probability like that of their number.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace

from flint import acb, fmpq

from disting.algebra.certainty import Certainty, Grade, enough
from disting.behaviour.chain_model import ChainModel
from disting.decide.identifiability.answer import Identifiability
from disting.decide.identifiability.functions import Basis, Candidate, basis
from disting.decide.identifiability.parts import (
    Combination,
    Formula,
    Level,
    Origin,
    Renaming,
    monomial,
)
from disting.decide.identifiability.solutions import (
    Listing,
    Member,
    is_self_dual,
    listing,
    renamings,
)
from disting.decide.identifiability.tangent import (
    most_invariants,
    proof_tangents,
)
from disting.errors import ContradictionError
from disting.fibres.synthesis.task import Status
from disting.model.chain import Chain, Quantity, Structure
from disting.model.names import read_together
from disting.model.question import Answer, Question, Settings
from disting.model.symmetry import Form, canonical
from disting.renamed import renamed


@renamed(sensor="quantity")
def identifiability(
    chain: Chain | str,
    settings: Settings | None = None,
    *,
    damped: bool | None = None,
    quantity: Quantity | str | None = None,
) -> Identifiability:
    """Find which parameters of the chain its behaviour determines over complex parameters, and how
    many parameter vectors have the same behaviour. `disting.identifiability` has other domains.

    It is the same for all chains of one canonical form, up to names. A chain can be named, such as
    "3:1+b2": `damped` and `quantity` then state how to read it. Raises InputError for a text that
    names no chain, ContradictionError for a defect of the program.

    >>> identifiability(Chain(2, meas_plus=2, damped=False)).sentence
    '3 parameters, only 2 determinable: m1 + m2, k12/(m1*m2).'
    """
    (chain,) = read_together([chain], damped=damped, quantity=quantity)
    form = canonical(chain)
    return in_names_of(_canonically(form.chain, settings or Settings()), form, chain)


def identifiabilities(
    chains: Iterable[Chain], settings: Settings | None = None
) -> list[Identifiability]:
    """The same for many chains, in order; each canonical form is computed once."""
    formed = [(chain, canonical(chain)) for chain in chains]
    answers = {
        form: _canonically(form, settings or Settings())
        for form in dict.fromkeys(form.chain for _, form in formed)
    }
    return [in_names_of(answers[form.chain], form, chain) for chain, form in formed]


def in_names_of(answer: Identifiability, form: Form, chain: Chain) -> Identifiability:
    """The finding on a canonical form in the names of a chain that has this form."""
    return rename(answer, {new: old for old, new in form.renaming.items()}, chain)


def _canonically(chain: Chain, settings: Settings) -> Identifiability:
    structure = chain.structure
    points = enough(ChainModel(structure).minor_size(None), settings.points)
    proof = proof_tangents(structure, settings.seed, points)
    rank = max(t.rank for t in proof)
    rows = basis(structure, proof, rank, settings.seed)
    rank_grade = _rank_grade(structure, rank, rows)
    solutions = listing(chain, max(len(t.rows) for t in proof), settings.seed)
    _refuse_contradictions(chain, rank, solutions)
    level, grade = judge(len(chain.parameters), rank, rank_grade, solutions)
    return Identifiability(
        parameters=chain.parameters,
        rank=rank,
        rank_grade=rank_grade,
        level=level,
        level_grade=grade,
        least=solutions.least,
        most=solutions.most,
        count_grade=solutions.grade,
        alternatives=tuple(m.said for m in solutions.members),
        singles=tuple(combination(c, solutions) for c in rows.singles),
        basis=tuple(combination(c, solutions) for c in rows.chosen),
        safety=rows.safety,
        renamings=renamings(chain),
        self_dual=is_self_dual(chain),
        point=tuple((name, str(value)) for name, value in solutions.point.items()),
        reason=_reason(level, solutions),
    )


def _rank_grade(structure: Structure, rank: int, seen: Basis) -> Grade:
    """Proven if full, or if no more coefficients than that are not constant."""
    if rank in (len(structure.parameters), most_invariants(structure)):
        return Certainty.PROVEN, 0
    return Certainty.BOUNDED, seen.safety


def judge(parameters: int, rank: int, rank_grade: Grade, solutions: Listing) -> tuple[Level, Grade]:
    """Level from rank and listing; GLOBAL only where it is sure that a single solution is the
    only one.
    """
    if rank < parameters:
        return Level.NOT, rank_grade
    if sum(m.said.certainty is Certainty.THEOREM for m in solutions.members) > 1:
        return Level.LOCAL, (Certainty.THEOREM, 0)
    if solutions.most is None or (
        solutions.most == 1 and solutions.grade[0] is Certainty.NUMERICAL
    ):
        return Level.UNKNOWN, rank_grade
    if solutions.most == 1:
        return Level.GLOBAL, solutions.grade
    return Level.LOCAL, solutions.grade if solutions.least > 1 else (Certainty.NUMERICAL, 0)


def _reason(level: Level, solutions: Listing) -> str:
    """Why the number of solutions is not known."""
    if level is Level.UNKNOWN and solutions.most == 1:
        return "one solution was found; it is not proven to be the only one"
    return (
        solutions.reason if level is Level.UNKNOWN or solutions.status is Status.NOT_COVERED else ""
    )


def _refuse_contradictions(chain: Chain, rank: int, solutions: Listing) -> None:
    """A family of solutions and a full rank, or a finite fibre and a smaller one, cannot both
    be.
    """
    full = rank == len(chain.parameters)
    if solutions.status is (Status.INFINITE if full else Status.COMPLETE):
        raise ContradictionError(
            f"rank {rank} of {len(chain.parameters)} parameters and a fibre that is"
            f" {solutions.status}: {chain}"
        )


IDENTIFIABILITY = Question.plain(
    "identifiability", _canonically, Identifiability.to_dict, Identifiability.from_dict
)


def rename(answer: Identifiability, names: Mapping[str, str], chain: Chain) -> Identifiability:
    """`names` leads from the canonical parameters to those of `chain`, whose order is kept
    everywhere.
    """
    place, whole = {name: i for i, name in enumerate(chain.parameters)}, answer.over_complex
    order = [monomial(**{name: 1}) for name in chain.parameters]
    singles = sorted(
        (_combination(c, names, place) for c in answer.singles),
        key=lambda c: order.index(c.formula),
    )
    return replace(
        answer,
        parameters=chain.parameters,
        singles=tuple(singles),
        basis=tuple(_combination(c, names, place) for c in answer.basis),
        renamings=tuple(_renaming(r, names, place) for r in answer.renamings),
        exchanges=tuple(_renaming(r, names, place) for r in answer.exchanges),
        over_complex=None if whole is None else rename(whole, names, chain),
        point=tuple(
            sorted(((names[n], v) for n, v in answer.point), key=lambda pair: place[pair[0]])
        ),
    )


def _combination(c: Combination, names: Mapping[str, str], place: Mapping[str, int]) -> Combination:
    terms = (
        (k, tuple(sorted(((names[n], e) for n, e in powers), key=lambda pair: place[pair[0]])))
        for k, powers in c.formula.terms
    )
    return replace(
        c, formula=Formula(tuple(sorted(terms, key=lambda t: [place[n] for n, _ in t[1]])))
    )


def _renaming(r: Renaming, names: Mapping[str, str], place: Mapping[str, int]) -> Renaming:
    moved = sorted(((names[a], names[b]) for a, b in r.moved), key=lambda pair: place[pair[0]])
    return Renaming(tuple(moved), r.symmetries)


Judgement = tuple[Answer, Certainty]


def combination(candidate: Candidate, solutions: Listing) -> Combination:
    """The candidate with the answer that the listed solutions give."""
    return Combination(candidate.formula, candidate.name, *_judge_candidate(candidate, solutions))


def _judge_candidate(candidate: Candidate, solutions: Listing) -> Judgement:
    """Different at a solution that exists: NO. Equal at all exact ones, none other: YES. The
    rest rests on balls or is open.
    """
    if candidate.name:
        return Answer.YES, Certainty.THEOREM  # a coefficient is what an experiment shows
    own = candidate.formula.value(solutions.point)
    apart = [
        m.said.certainty
        for m in solutions.members
        if not _same(own, candidate.formula.value(m.values))
    ]
    for certainty in (Certainty.THEOREM, Certainty.PROVEN, Certainty.NUMERICAL):
        if certainty in apart:
            return Answer.NO, certainty
    if solutions.status not in (Status.COMPLETE, Status.INFINITE):
        return Answer.UNKNOWN, Certainty.NUMERICAL
    return Answer.YES, (
        solutions.grade[0] if solutions.most == _exact(solutions.members) else Certainty.NUMERICAL
    )


def _exact(members: tuple[Member, ...]) -> int:
    return sum(m.said.origin is not Origin.OTHER for m in members)


def _same(left: fmpq, right: fmpq | acb) -> bool:
    return left == right if isinstance(right, fmpq) else bool(right.overlaps(acb(left)))
