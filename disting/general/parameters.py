"""Which parameters of a general model its transfer functions determine: globally, locally or not at
all, for any number of inputs and outputs.
"""

from dataclasses import replace

from disting.general.any_model import map_of
from disting.general.behaviour import GeneralModel
from disting.general.matrix_model import AnyModel
from disting.model.question import Question
from disting.model.settings import Settings
from disting.questions.identifiability import (
    ParameterIdentifiability,
    by_parameter,
    decoded,
    encoded,
    local,
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
