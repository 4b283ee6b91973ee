"""Parameters of a general model that its transfer functions determine, for any number of inputs and
outputs: locally, from the Jacobian of its invariants at random points; each one globally, locally
or not at all.

Parameter j is locally identifiable (generically: finitely many values fit) exactly if the unit
vector e_j lies in the row space of the Jacobian J at a generic point, that is if J without column
j has a smaller rank. With full column rank all are.
"""

from dataclasses import dataclass, replace

from disting.algebra.certainty import Certainty, grade_of
from disting.conditions.side import Side
from disting.decide.identifiability.levels import (
    ParameterIdentifiability,
    by_parameter,
    decode,
    encode,
    local,
)
from disting.decide.identifiability.parts import Level
from disting.general.any_model import cells_of, given_model, map_of
from disting.general.exponents import count_determined, may_be_others
from disting.general.matrix_model import AnyModel
from disting.general.network_model import behaviour_of
from disting.general.network_view import OTHER_ORDER, NetworkView, other_orders
from disting.model.chain import Chain
from disting.model.presentation import summary
from disting.model.question import Question, Settings
from disting.network.network import Network

SETTINGS = Settings()
OTHER_EXPONENTS = "other exponents may give the same response"


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
        phrase = f"{self.rank} of {len(self.parameters)} determinable"
        names = f": {', '.join(self.identifiable)}" if self.identifiable else ""
        return summary(self, phrase + names)

    @property
    def unidentifiable(self) -> tuple[str, ...]:
        """The other parameters: infinitely many values fit."""
        return tuple(name for name in self.parameters if name not in self.identifiable)


def local_identifiability(
    model: AnyModel | Chain | Network | tuple[object, ...], settings: Settings = SETTINGS
) -> LocalIdentifiability:
    """Local identifiability of each parameter from the transfer functions of a model, a chain, a
    network or a state space (A, B, C). Raises InputError for anything else.

    >>> from disting.general.matrix_model import Model
    >>> m = Model.from_transfer_function(["k"], ["a*b", "c"])
    >>> local_identifiability(m).identifiable, local_identifiability(m).rank
    ((), 2)
    """
    model = given_model(model)
    the_local = local(behaviour_of(model), settings)
    return LocalIdentifiability(
        model.parameters,
        the_local.rank,
        the_local.names,
        *grade_of(not the_local.safety, the_local.safety),
    )


def parameter_identifiability(model: AnyModel, settings: Settings) -> ParameterIdentifiability:
    """Identifiability of each parameter from all transfer functions together.

    >>> from disting.general.matrix_model import MatrixModel
    >>> model = MatrixModel.from_state_space([["-a-b", 0], ["a", "-c"]], [1, 0], [[1, 0], [0, 1]])
    >>> parameter_identifiability(model, Settings()).sentence
    '3 parameters, all globally identifiable.'
    """
    own = tuple(f"p{i + 1}" for i in range(len(model.parameters)))
    own_local = local(behaviour_of(model), settings)
    names = tuple(own[model.parameters.index(name)] for name in own_local.names)
    identifiability = by_parameter(own, replace(own_local, names=names), map_of(model), settings)
    identifiability = replace(
        identifiability,
        levels=dict(zip(model.parameters, identifiability.levels.values(), strict=True)),
    )
    powers = model.powers
    return (
        _with_exponents(identifiability, model, settings)
        if powers.weights or powers.unseen
        else identifiability
    )


def _with_exponents(
    identifiability: ParameterIdentifiability, model: AnyModel, settings: Settings
) -> ParameterIdentifiability:
    """The same with exponents as parameters: those that enter are determined, but for exchanges
    that another order of the parameters does too.

    With exponents in one order it is known what is determined. All that fits is that in all orders
    that give the same functions, which differ in the exponents.
    """
    powers = model.powers
    names, size = powers.exponents, len(powers.weights)
    rank, single = count_determined(cells_of(model), size)
    levels = dict(identifiability.levels) | dict.fromkeys(
        sorted((*names, *powers.unseen)), Level.NOT
    )
    levels |= {names[j]: Level.GLOBAL for j in single}
    orders = other_orders(Side("", NetworkView(model), settings))
    for order, renaming in orders:
        pairs = [*zip(names, order, strict=True), *(renaming.pairs if renaming else ())]
        moved = {a for a, b in pairs if a != b} if renaming else levels.keys()
        weaker = Level.LOCAL if renaming else Level.UNKNOWN
        levels |= {name: weaker for name in moved if levels[name] is Level.GLOBAL}
    symmetries = [renaming for _, renaming in orders if renaming]
    many = 1 + len(symmetries)
    reason = OTHER_ORDER if len(symmetries) < len(orders) else ""
    if names and may_be_others(cells_of(model), powers):
        levels |= {name: Level.UNKNOWN for name in levels if levels[name] is Level.GLOBAL}
        reason = OTHER_EXPONENTS
    return replace(
        identifiability,
        levels=levels,
        rank=identifiability.rank + rank,
        least=identifiability.least * many,
        most=None if identifiability.most is None or reason else identifiability.most * many,
        reason=identifiability.reason or reason,
    )


PARAMETERS = Question("parameters of general models", parameter_identifiability, encode, decode)
