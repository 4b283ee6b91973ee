"""`compare` and `findings`: any two chains, named as the paper names them, or general models;
`identifiability`: which parameters of one model can be determined, from one experiment or from
several together.
"""

from collections.abc import Sequence
from dataclasses import replace

from disting.errors import InputError, of_type
from disting.experiments import Experiment, MeasuredChain
from disting.experiments.identifiable import IDENTIFIABLE
from disting.general.any_model import unnamed
from disting.general.identifiability import PARAMETERS
from disting.general.matrix_model import MatrixModel
from disting.general.model import Model
from disting.model.chain import Chain, Sensor, as_sensor
from disting.model.names import chains_named
from disting.questions.identifiability import Identifiability, ParameterIdentifiability
from disting.verdict.cascade import Step, steps
from disting.verdict.engine import Engine
from disting.verdict.query import Query
from disting.verdict.result import Verdict
from disting.verdict.sides import (
    NOT_CHAINS,
    Given,
    both_places,
    model_of,
    models_named,
    plain_sides,
    sides_of,
)


def compare(
    left: Given,
    right: Given,
    *,
    damped: bool | None = None,
    sensor: Sensor | str | None = None,
    experiments: Sequence[Experiment | tuple[Experiment, Experiment]] = (),
    query: Query | None = None,
    audit: bool = False,
    engine: Engine | None = None,
) -> Verdict:
    """Verdict on two chains of any size (about 0.1 s for 5 masses; a look-up in the engine's store
    once it is there).

    Chains are also named: "3:1+b2", "A4" of as many masses as the other one has; `damped` and
    `sensor` say how names are meant, else they are taken from the chain beside them (see
    `model.names`). General models (`Model`, `MatrixModel`) and networks (`Network`, or a text such
    as "R0-p(R1,C1)" or "1=2, 2=3, 2=4; F1; S4") are compared likewise, with each other or with
    chains.

    `query` limits views, conditions and Markov parameters; `audit` runs every condition in every
    representation and raises ContradictionError where two decide differently; `engine` brings
    settings and a store (default: none). Raises InputError for what names no model.

    `experiments`: all ways in which both machines are measured, with one parameter vector for all;
    `Experiment()` is that of the chains as they are. A pair of experiments names the places of the
    left and of the right chain; a single one means the same places in both.

    >>> from disting import Experiment, Family
    >>> a = Family(3, damped=True)
    >>> compare(a[2], a[5]).relation.value, compare(a[1], a[4]).relation.value
    ('indistinguishable', 'distinguishable')
    >>> compare(a[1], a[11]).relation.value
    'indistinguishable'
    >>> compare("3:1", "A11").sentence[:52]
    '3:1 and 3:11, damped, acceleration, are indistinguis'
    >>> compare(a[1], a[11], experiments=[Experiment(), Experiment(sensor=3)]).relation.value
    'distinguishable'
    """
    query, engine = asked_of(query, engine)
    a, b = models_named(left, right, damped, sensor)
    sides = sides_of(a, b, both_places(experiments), engine)
    verdict = engine.verdict(sides.left, sides.right, query, audited=audit)
    return replace(verdict, notes=(*verdict.notes, *sides.notes))


def findings(
    left: Given,
    right: Given,
    *,
    damped: bool | None = None,
    sensor: Sensor | str | None = None,
    query: Query | None = None,
    engine: Engine | None = None,
) -> tuple[Step, ...]:
    """What every condition finds in every representation, in order, whether it decides or not; of
    models as `compare` takes them. Raises InputError as that does.

    >>> steps = findings(Chain(2), Chain(2, meas_plus=2))
    >>> [(s.representation.value, s.finding.rule.name, s.finding.outcome.value) for s in steps][:3]
    [('tf', '1', 'fails'), ('tf', '2', 'fails'), ('tf', '3', 'fails')]
    """
    a, b = models_named(left, right, damped, sensor)
    query, engine = asked_of(query, engine)
    return tuple(steps(*plain_sides(a, b, engine), query))


def asked_of(query: Query | None, engine: Engine | None) -> tuple[Query, Engine]:
    """Both, the usual ones where nothing is said; raises InputError for anything else."""
    query = Query() if query is None else of_type(query, Query, "query is a Query")
    return query, Engine() if engine is None else of_type(engine, Engine, "engine is an Engine")


def identifiability(
    model: Given,
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
    model = model_of(model, Sensor.ACCELERATION if sensor is None else as_sensor(sensor))
    if isinstance(model, Model | MatrixModel):
        if experiments:
            raise InputError(NOT_CHAINS)
        return engine.answer(PARAMETERS, (unnamed(model),), engine.settings)
    if isinstance(model, str):
        (model,) = chains_named([model], damped=damped, sensor=sensor)
    if not isinstance(model, Chain):
        raise InputError(
            "identifiability is asked of a chain, such as Family(3)[4], a Model or a Network"
        )
    if not experiments:
        return engine.identifiabilities([model])[0]
    wrong = [e for e in experiments if not isinstance(e, Experiment)]
    if wrong:
        raise InputError("of one chain each experiment is one, such as Experiment(sensor=2)")
    measured = MeasuredChain(model, tuple(dict.fromkeys(experiments)))
    return engine.answer(IDENTIFIABLE, (measured,), engine.settings)
