"""Which parameters of a general model its transfer functions determine, for any number of inputs
and outputs: locally, from the Jacobian of its invariants at random points; each one globally,
locally or not at all.

Parameter j is locally identifiable (generically: finitely many values fit) exactly if the unit
vector e_j lies in the row space of the Jacobian J at a generic point, that is if J without column
j has a smaller rank. With full column rank all are.
"""

from dataclasses import dataclass, replace

from disting.algebra.certainty import Certainty, graded
from disting.errors import of_type
from disting.general.any_model import map_of
from disting.general.behaviour import GeneralModel
from disting.general.matrix_model import AnyModel
from disting.model.presentation import summary
from disting.model.question import Question, Settings
from disting.questions.identifiability import (
    ParameterIdentifiability,
    by_parameter,
    decoded,
    encoded,
    local,
)

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


def parameter_identifiability(model: AnyModel, settings: Settings) -> ParameterIdentifiability:
    """Identifiability of each parameter from all transfer functions together.

    >>> from disting.general.matrix_model import MatrixModel
    >>> model = MatrixModel.from_state_space([["-a-b", 0], ["a", "-c"]], [1, 0], [[1, 0], [0, 1]])
    >>> parameter_identifiability(model, Settings()).sentence
    '3 parameters, all globally identifiable.'
    """
    own = tuple(f"p{i + 1}" for i in range(len(model.parameters)))
    known = local(GeneralModel(model), settings)
    names = tuple(own[model.parameters.index(name)] for name in known.names)
    found = by_parameter(own, replace(known, names=names), map_of(model), settings)
    return replace(found, levels=dict(zip(model.parameters, found.levels.values(), strict=True)))


PARAMETERS = Question("parameters of general models", parameter_identifiability, encoded, decoded)
