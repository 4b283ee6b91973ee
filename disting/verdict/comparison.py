"""`compare` and `findings`: any two chains, named as the paper names them, or general models;
`identifiability`: which parameters of one model can be determined, from one experiment or from
several together.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from disting.conditions.side import AnySide
from disting.errors import InputError, of_type, shown
from disting.experiments import Experiment, MeasuredChain
from disting.experiments.identifiable import IDENTIFIABLE
from disting.general.any_model import as_chain, of_network, unnamed
from disting.general.identifiability import PARAMETERS
from disting.general.matrix_model import AnyModel, MatrixModel
from disting.general.model import Model
from disting.model.chain import Chain, Sensor, as_sensor
from disting.model.names import chains_named, name_of
from disting.network import Network, network_of
from disting.network.notation import notations_of
from disting.questions.identifiability import Identifiability, ParameterIdentifiability
from disting.verdict.cascade import Step, steps
from disting.verdict.engine import Engine
from disting.verdict.query import Query
from disting.verdict.result import Verdict

NAMED = "experiments are a list of Experiment, or of pairs of them, left and right"
SIDES = 2
Given = Chain | AnyModel | Network | str
"""What can be compared: a text is the name of a chain, or a network in a notation."""
NOT_CHAINS = "experiments are on chains: a general model has no masses to measure at"


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
    settings and a store (default: none).

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
    return tuple(steps(*_sides(a, b, engine), query))


def asked_of(query: Query | None, engine: Engine | None) -> tuple[Query, Engine]:
    """Both, the usual ones where nothing is said; raises InputError for anything else."""
    query = Query() if query is None else of_type(query, Query, "query is a Query")
    return query, Engine() if engine is None else of_type(engine, Engine, "engine is an Engine")


def models_named(
    left: Given,
    right: Given,
    damped: bool | None,
    sensor: Sensor | str | None,
) -> tuple[Chain | AnyModel, Chain | AnyModel]:
    """Both models, names as the chains that they mean, texts as the networks; raises InputError."""
    wanted = "a model is a chain, a name such as '3:4', a Model or a Network"
    for side in (left, right):
        of_type(side, Chain | str | AnyModel | Network, wanted)
    beside = next((m.sensor for m in (left, right) if isinstance(m, Chain)), Sensor.ACCELERATION)
    quantity = beside if sensor is None else as_sensor(sensor)
    read = [_as_model(m, quantity) for m in (left, right)]
    given = [m for m in read if isinstance(m, Chain | str)]
    chains = iter(chains_named(given, damped=damped, sensor=sensor))
    a, b = (next(chains) if isinstance(m, Chain | str) else m for m in read)
    return a, b


def _as_model(given: Given, quantity: Sensor) -> Chain | AnyModel | str:
    """A network as its transfer functions; chains, models and names as they are."""
    if isinstance(given, str) and notations_of(given):
        given = network_of(given, quantity=quantity)
    return of_network(given) if isinstance(given, Network) else given


@dataclass(frozen=True, slots=True)
class Sides:
    """What is compared: both models by the names that they have beside each other, and what is to
    be known of experiments that tell nothing.
    """

    left: AnySide
    right: AnySide
    notes: tuple[str, ...] = ()


def sides_of(
    left: Chain | AnyModel,
    right: Chain | AnyModel,
    experiments: Sequence[tuple[Experiment, Experiment]],
    engine: Engine,
) -> Sides:
    """Two models as they are, or two chains under all experiments, each named for the left and for
    the right one; raises InputError.
    """
    if not experiments:
        return Sides(*_sides(left, right, engine))
    if not (isinstance(left, Chain) and isinstance(right, Chain)):
        raise InputError(NOT_CHAINS)
    chains = zip((left, right), zip(*experiments, strict=True), strict=True)
    a, b = (MeasuredChain(chain, side) for chain, side in chains)
    plain = _sides(left, right, engine)
    silent = [i for i in a.silent if i in b.silent]
    telling = [i for i in range(len(experiments)) if i not in silent]
    notes = [f"nothing is learned from experiment {i + 1}: its sensor never moves" for i in silent]
    # as they are: what a verdict's evidence says is then of the chains that were given
    if len(telling) == 1 and all(m.alone(telling[0]) == m.chain for m in (a, b)):
        return Sides(*plain, tuple(notes))
    left_name, right_name = names_under(plain[0].name, plain[1].name, experiments)
    return Sides(
        engine.measured_subject(left_name, a), engine.measured_subject(right_name, b), tuple(notes)
    )


def determinable(
    left: Chain | AnyModel, right: Chain | AnyModel, engine: Engine
) -> tuple[tuple[str, int, int], ...]:
    """Of both models, as `compare` names them: how many functions of the parameters are determined,
    and how many parameters there are, exponents among them.

    >>> from disting import Family
    >>> determinable(*(Family(2)[i] for i in (1, 2)), Engine())
    (('2:1', 4, 4), ('2:2', 3, 4))
    """
    sides = _sides(left, right, engine)
    return tuple((side.name, side.rank, _n_parameters(side.subject)) for side in sides)


def _n_parameters(model: Chain | AnyModel | MeasuredChain) -> int:
    if isinstance(model, MeasuredChain):
        return len(model.chain.parameters)
    exponents = () if isinstance(model, Chain) else model.powers.weights
    return len(model.parameters) + len(exponents)


def both_places(
    experiments: Sequence[Experiment | tuple[Experiment, Experiment]],
) -> tuple[tuple[Experiment, Experiment], ...]:
    """Each once, for the left and for the right model."""
    asked = [e if isinstance(e, tuple) else (e, e) for e in of_type(experiments, Iterable, NAMED)]
    for pair in asked:
        if len(pair) != SIDES or not all(isinstance(e, Experiment) for e in pair):
            raise InputError(f"{NAMED}, not {shown(pair)}")
    return tuple(dict.fromkeys(asked))


def _sides(
    left: Chain | AnyModel, right: Chain | AnyModel, engine: Engine
) -> tuple[AnySide, AnySide]:
    """Two chains as chains, whoever names them, whatever else as two general models; by two
    names.
    """
    left_name, right_name = names_beside(left, right)
    a, b = as_chain(left), as_chain(right)
    if a is not None and b is not None:
        return engine.subject(left_name, a), engine.subject(right_name, b)
    models = [_model(left), _model(right)]
    refuse_ports(models)
    one, other = engine.general_subjects(models, (left_name, right_name))
    return one, other


def names_beside(left: Chain | AnyModel, right: Chain | AnyModel) -> tuple[str, str]:
    """What two models are called beside each other."""
    if isinstance(left, Chain) and isinstance(right, Chain):
        return names_of(left, right)
    left_name, right_name = (name_of(m) if isinstance(m, Chain) else m.name for m in (left, right))
    return (
        (f"{left_name} 1", f"{right_name} 2")
        if left_name == right_name
        else (left_name, right_name)
    )


def names_of(left: Chain, right: Chain) -> tuple[str, str]:
    """What two chains are called beside each other: by their names, those that have one name, of
    which one is damped, with damping and quantity.

    >>> names_of(Chain(9), Chain(9, damped=False))
    ('9:1 (damped, acceleration)', '9:1 (undamped, acceleration)')
    """
    names = name_of(left), name_of(right)
    if names[0] == names[1] and left != right:
        return f"{names[0]} ({left.premise})", f"{names[1]} ({right.premise})"
    return names


def names_under(
    left: str, right: str, experiments: Sequence[tuple[Experiment, Experiment]]
) -> tuple[str, str]:
    """What two chains are called under experiments: one and the same chain by those that differ.

    >>> names_under("3:1", "3:1", [(Experiment(sensor=2), Experiment(sensor=3))])
    ('3:1 with sensor 2', '3:1 with sensor 3')
    """
    differing = [pair for pair in experiments if pair[0] != pair[1]]
    if left != right or not differing:
        return left, right
    a, b = (" and with ".join(map(_done, side)) for side in zip(*differing, strict=True))
    return f"{left} with {a}", f"{right} with {b}"


def _done(experiment: Experiment) -> str:
    """What is done in it."""
    return experiment.text if experiment != Experiment() else "nothing done"


def refuse_ports(models: Sequence[AnyModel]) -> None:
    """Raises InputError for models of which not all have the same inputs and outputs."""
    shapes = {m.shape: m.name for m in models}
    if len(shapes) > 1:
        told = [f"{name} has {p} x {m}" for (p, m), name in list(shapes.items())[:2]]
        raise InputError(
            f"models are compared that have the same outputs and inputs: {' and '.join(told)}"
        )


def _model(model: Chain | AnyModel) -> AnyModel:
    if not isinstance(model, Chain):
        return model
    return Model.from_chain(model, name=name_of(model))


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
    model = _as_model(model, Sensor.ACCELERATION if sensor is None else as_sensor(sensor))
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
