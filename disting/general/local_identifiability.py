"""Which single parameters of a model are locally identifiable, from the Jacobian of its invariants
at random points.

Parameter j is locally identifiable (generically: finitely many values fit) exactly if the unit
vector e_j lies in the row space of the Jacobian J at a generic point, that is if J without column
j has a smaller rank. With full column rank all are.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, log2

from disting.algebra.certainty import Certainty, graded
from disting.algebra.sampling import enough, safety
from disting.behaviour.sample import Representation, Sample
from disting.general.model import Model
from disting.general.samples import minor_size, samples
from disting.model.settings import Settings
from disting.model.shown import summary

SETTINGS = Settings()


@dataclass(frozen=True, slots=True)
class LocalIdentifiability:
    """`rank` = number of determinable parameters, `identifiable` = the names of the single ones
    that are.

    With certainty BOUNDED the probability of any error is at most 2**-safety.
    """

    parameters: tuple[str, ...]
    rank: int
    identifiable: tuple[str, ...]
    certainty: Certainty
    safety: int

    def __repr__(self) -> str:
        known = f"{self.rank} of {len(self.parameters)} determinable"
        names = f": {', '.join(self.identifiable)}" if self.identifiable else ""
        return summary(self, known + names)

    @property
    def unidentifiable(self) -> tuple[str, ...]:
        """The other parameters: infinitely many values fit."""
        return tuple(name for name in self.parameters if name not in self.identifiable)


def local_identifiability(model: Model, settings: Settings = SETTINGS) -> LocalIdentifiability:
    """Local identifiability of each parameter from the transfer function.

    >>> m = Model.from_transfer_function(["k"], ["a*b", "c"])
    >>> local_identifiability(m).identifiable, local_identifiability(m).rank
    ((), 2)
    """
    size = minor_size(model, Representation.TF, 0)
    seen = list(samples(model, Representation.TF, 0, enough(size, settings.points), settings.seed))
    rank, columns = identifiable_columns(seen)
    n = len(model.parameters)
    bits = safety(size, len(seen)) - len(seen) - ceil(log2(n + 1))
    names = tuple(model.parameters[j] for j in columns)
    return LocalIdentifiability(model.parameters, rank, names, *graded(rank == n, bits))


def identifiable_columns(seen: Sequence[Sample]) -> tuple[int, tuple[int, ...]]:
    """The rank of the Jacobian, and the columns whose removal lowers it, by the largest ranks
    seen at the points.
    """
    every = range(seen[0].n_parameters)
    rank = max(_rank(s, tuple(every)) for s in seen)
    return rank, tuple(
        j for j in every if max(_rank(s, tuple(i for i in every if i != j)) for s in seen) < rank
    )


def _rank(seen: Sample, columns: tuple[int, ...]) -> int:
    kept = tuple(tuple(row[j] for j in columns) for row in seen.rows)
    return Sample(seen.labels, seen.values, kept, len(columns), seen.modulus).rank(
        tuple(range(len(kept)))
    )
