"""Which single parameters of a model are locally identifiable, from the Jacobian of its invariants
at random points.

Parameter j is locally identifiable (generically: finitely many values fit) exactly if the unit
vector e_j lies in the row space of the Jacobian J at a generic point, that is if J without column
j has a smaller rank. With full column rank all are.
"""

from dataclasses import dataclass

from disting.algebra.certainty import Certainty, graded
from disting.errors import of_type
from disting.general.behaviour import GeneralModel
from disting.general.matrix_model import AnyModel
from disting.model.settings import Settings
from disting.model.shown import summary
from disting.questions.identifiability import local

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


def local_identifiability(model: AnyModel, settings: Settings = SETTINGS) -> LocalIdentifiability:
    """Local identifiability of each parameter from the transfer functions.

    >>> from disting.general.model import Model
    >>> m = Model.from_transfer_function(["k"], ["a*b", "c"])
    >>> local_identifiability(m).identifiable, local_identifiability(m).rank
    ((), 2)
    """
    of_type(model, AnyModel, "of transfer functions it is asked of a Model or a MatrixModel")
    found = local(GeneralModel(model), settings)
    return LocalIdentifiability(
        model.parameters, found.rank, found.names, *graded(not found.safety, found.safety)
    )
