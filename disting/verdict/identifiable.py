"""`identifiability`: which parameters of one model can be determined, from one experiment or from
several together.
"""

from collections.abc import Sequence

from disting.errors import InputError
from disting.experiments import Experiment, MeasuredChain
from disting.experiments.identifiable import IDENTIFIABLE
from disting.general import AnyModel, MatrixModel, Model, unnamed
from disting.general.parameters import PARAMETERS
from disting.model.chain import Chain, Sensor
from disting.model.names import chains_named
from disting.questions.identifiability import Identifiability, ParameterIdentifiability
from disting.verdict.comparison import NOT_CHAINS
from disting.verdict.engine import Engine


def identifiability(
    model: Chain | AnyModel | str,
    *,
    damped: bool | None = None,
    sensor: Sensor | str | None = None,
    experiments: Sequence[Experiment] = (),
    engine: Engine | None = None,
) -> Identifiability | ParameterIdentifiability:
    """What is determined of a chain or a general model: each parameter globally, locally or not at
    all (`levels`), the number of determinable ones (`rank`) and the dimension of a generic fibre
    (`freedom`).

    `experiments`: all ways in which the chain is measured, with one parameter vector for all;
    `Experiment()` is that of the chain as it is. Without them more is told of the chain as it is:
    which combinations are determined, and all parameter vectors at a random point. A chain can be
    named, such as "3:1+b2": `damped` and `sensor` say then how it is meant. `engine` brings
    settings and a store. Raises InputError.

    >>> from disting import Experiment, Family
    >>> a = Family(3, damped=True)
    >>> identifiability(a[3]).freedom
    1
    >>> identifiability(a[3], experiments=[Experiment(), Experiment(locked=2)]).levels["m1"].value
    'not identifiable'
    >>> identifiability(a[3], experiments=[Experiment(), Experiment(sensor=2)]).sentence
    '7 parameters, all globally identifiable.'
    """
    engine = engine or Engine()
    if isinstance(model, Model | MatrixModel):
        if experiments:
            raise InputError(NOT_CHAINS)
        return engine.answer(PARAMETERS, (unnamed(model),), engine.settings)
    if isinstance(model, str):
        (model,) = chains_named([model], damped=damped, sensor=sensor)
    if not isinstance(model, Chain):
        raise InputError("identifiability is asked of a chain, such as Family(3)[4], or a Model")
    if not experiments:
        return engine.identifiabilities([model])[0]
    wrong = [e for e in experiments if not isinstance(e, Experiment)]
    if wrong:
        raise InputError("of one chain each experiment is one, such as Experiment(sensor=2)")
    measured = MeasuredChain(model, tuple(dict.fromkeys(experiments)))
    return engine.answer(IDENTIFIABLE, (measured,), engine.settings)
