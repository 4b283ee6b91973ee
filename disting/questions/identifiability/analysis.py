"""From a chain to its identifiability: rank and row space, then the fibre, then what both say
together.
"""

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from disting.algebra.certainty import Certainty, Grade
from disting.algebra.sampling import enough
from disting.behaviour.profile import minor_size
from disting.behaviour.sample import Representation
from disting.errors import ContradictionError
from disting.fibres.synthesis.result import Status
from disting.model.chain import Chain, Sensor
from disting.model.names import chains_named
from disting.model.question import Question
from disting.model.settings import Settings
from disting.model.structure import Structure
from disting.model.symmetry import Form, canonical
from disting.questions.identifiability.answer import Identifiability
from disting.questions.identifiability.basis import Basis, basis
from disting.questions.identifiability.naming import renamed
from disting.questions.identifiability.parts import Level, Scaling
from disting.questions.identifiability.scaling import scalings
from disting.questions.identifiability.solutions import Listing, is_self_dual, listing, renamings
from disting.questions.identifiability.tangent import Tangent, most_invariants, proof_tangents
from disting.questions.identifiability.uniqueness import combination


def identifiability(
    chain: Chain | str,
    settings: Settings | None = None,
    *,
    damped: bool | None = None,
    sensor: Sensor | str | None = None,
) -> Identifiability:
    """Which parameters of the chain its behaviour determines, and how many parameter vectors have
    the same behaviour.

    It is the same for all chains of one canonical form, up to names. A chain can be named, such as
    "3:1+b2": `damped` and `sensor` say then how it is meant. Raises ContradictionError for
    a defect of the program.

    >>> identifiability(Chain(2, meas_plus=2, damped=False)).sentence
    '3 parameters, only 2 determinable: m1 + m2, k12/(m1*m2).'
    """
    (chain,) = chains_named([chain], damped=damped, sensor=sensor)
    form = canonical(chain)
    return as_given(_canonically(form.chain, settings or Settings()), form, chain)


def identifiabilities(
    chains: Iterable[Chain], settings: Settings | None = None
) -> list[Identifiability]:
    """The same for many chains, in order; each canonical form is looked at once."""
    formed = [(chain, canonical(chain)) for chain in chains]
    known = {
        form: _canonically(form, settings or Settings())
        for form in dict.fromkeys(form.chain for _, form in formed)
    }
    return [as_given(known[form.chain], form, chain) for chain, form in formed]


@dataclass(frozen=True, slots=True)
class _Rank:
    """Number of determinable parameters and the exact scalings."""

    value: int
    grade: Grade
    scalings: tuple[Scaling, ...]


def as_given(found: Identifiability, form: Form, chain: Chain) -> Identifiability:
    """The finding on a canonical form in the names of a chain that has this form."""
    return renamed(found, {here: given for given, here in form.renaming.items()}, chain)


def _canonically(chain: Chain, settings: Settings) -> Identifiability:
    structure = chain.structure
    points = enough(minor_size(structure, Representation.TF, 0), settings.points)
    proof = proof_tangents(structure, settings.seed, points)
    rank = max(t.rank for t in proof)
    seen = basis(structure, proof, rank, settings.seed)
    determined = _rank(structure, proof, rank, seen)
    known = listing(chain, max(len(t.rows) for t in proof), settings.seed)
    _refuse_contradictions(chain, rank, known)
    level, grade = judged(len(chain.parameters), rank, determined.grade, known)
    return Identifiability(
        parameters=chain.parameters,
        rank=rank,
        rank_grade=determined.grade,
        level=level,
        level_grade=grade,
        least=known.least,
        most=known.most,
        count_grade=known.grade,
        alternatives=tuple(m.said for m in known.members),
        singles=tuple(combination(c, known) for c in seen.singles),
        basis=tuple(combination(c, known) for c in seen.chosen),
        safety=seen.safety,
        scalings=determined.scalings,
        renamings=renamings(chain),
        self_dual=is_self_dual(chain),
        point=tuple((name, str(value)) for name, value in known.point.items()),
        reason=_reason(level, known),
    )


def _rank(structure: Structure, proof: Sequence[Tangent], rank: int, seen: Basis) -> _Rank:
    """Proven if full, if so many scalings are proven as are lacking, or if no more coefficients
    than that are not constant.
    """
    parameters = len(structure.parameters)
    if rank == parameters:
        return _Rank(rank, (Certainty.PROVEN, 0), ())
    found = scalings(structure)
    proven = rank in (parameters - len(found), most_invariants(structure))
    return _Rank(rank, (Certainty.PROVEN, 0) if proven else (Certainty.BOUNDED, seen.safety), found)


def judged(parameters: int, rank: int, rank_grade: Grade, known: Listing) -> tuple[Level, Grade]:
    """Level from rank and listing; GLOBAL only where it is sure that a single solution is the
    only one.
    """
    if rank < parameters:
        return Level.NOT, rank_grade
    if sum(m.said.certainty is Certainty.THEOREM for m in known.members) > 1:
        return Level.LOCAL, (Certainty.THEOREM, 0)
    if known.most is None or (known.most == 1 and known.grade[0] is Certainty.NUMERICAL):
        return Level.UNKNOWN, rank_grade
    if known.most == 1:
        return Level.GLOBAL, known.grade
    return Level.LOCAL, known.grade if known.least > 1 else (Certainty.NUMERICAL, 0)


def _reason(level: Level, known: Listing) -> str:
    """Why the number of solutions is not known."""
    if level is Level.UNKNOWN and known.most == 1:
        return "one solution is found, and not proven to be the only one"
    return known.reason if level is Level.UNKNOWN or known.status is Status.NOT_COVERED else ""


def _refuse_contradictions(chain: Chain, rank: int, known: Listing) -> None:
    """A family of solutions and a full rank, or a finite fibre and a smaller one, cannot both
    be.
    """
    full = rank == len(chain.parameters)
    if known.status is (Status.INFINITE if full else Status.COMPLETE):
        raise ContradictionError(
            f"rank {rank} of {len(chain.parameters)} parameters and a fibre that is {known.status}:"
            f" {chain}"
        )


def _to_json(found: Identifiability) -> str:
    return json.dumps(found.to_dict(), separators=(",", ":"))


def _from_json(text: str) -> Identifiability:
    return Identifiability.from_dict(json.loads(text))


IDENTIFIABILITY = Question("identifiability", _canonically, _to_json, _from_json)
