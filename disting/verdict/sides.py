"""The two sides of a comparison: what a caller names, as models that can be compared, under the
experiments in which both are measured, and their names.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from disting.conditions.side import AnySide
from disting.errors import InputError, of_type, short
from disting.experiments.experiment import Experiment, MeasuredChain
from disting.experiments.measured_network import MeasuredNetwork, structure_of
from disting.general.any_model import as_model, of_network, renamed_chain
from disting.general.matrix_model import AnyModel, MatrixModel, Model
from disting.model.chain import Chain, Sensor, as_sensor
from disting.model.names import name_of, names_of, read_together
from disting.network import Network, network_of
from disting.network.chains import of_chain
from disting.network.notation import notations_of
from disting.verdict.engine import Engine

NAMED = "experiments are a list of Experiment, or of pairs of them, left and right"
SIDES = 2
STATE_SPACE = "state space"  # the name of a model that is given as matrices
Named = Chain | AnyModel | Network | str
Given = Named | tuple[object, ...]
"""A model to compare: a text is the name of a chain, or a network in a notation; a tuple holds the
matrices (A, B, C) or (A, B, C, D) of a state space.
"""
MATRICES = (3, 4)  # of a state space, without D and with it


def models_of_names(
    left: Given,
    right: Given,
    damped: bool | None,
    sensor: Sensor | str | None,
) -> tuple[Chain | AnyModel, Chain | AnyModel]:
    """Both models, names as the chains that they mean, texts as the networks; raises InputError."""
    wanted = (
        "a model is a chain, a name such as '3:4', a Model, a Network, or the matrices (A, B, C) of"
        " a state space"
    )
    for side in (left, right):
        of_type(side, Chain | str | AnyModel | Network | tuple, wanted)
    beside = next((m.sensor for m in (left, right) if isinstance(m, Chain)), Sensor.ACCELERATION)
    quantity = beside if sensor is None else as_sensor(sensor)
    read = [model_of(m, quantity) for m in (left, right)]
    names = [m for m in read if isinstance(m, Chain | str)]
    chains = iter(read_together(names, damped=damped, sensor=sensor))
    a, b = (next(chains) if isinstance(m, Chain | str) else m for m in read)
    return a, b


def model_of(source: Given, quantity: Sensor) -> Chain | AnyModel | str:
    """A network or a state space as its transfer functions; chains, models and names as they are;
    raises InputError.
    """
    if isinstance(source, tuple):
        return _of_state_space(source)
    if isinstance(source, str) and notations_of(source):
        source = network_of(source, quantity=quantity)
    return of_network(source) if isinstance(source, Network) else source


def _of_state_space(matrices: tuple[object, ...]) -> AnyModel:
    """The model x' = A x + B u, y = C x + D u, entries as for `Model.from_state_space`."""
    if len(matrices) not in MATRICES:
        raise InputError(
            f"a tuple is a state space, (A, B, C) or (A, B, C, D), not {len(matrices)} entries;"
            " transfer functions are a Model.from_transfer_function(numerator, denominator)"
        )
    model = MatrixModel.from_state_space(*matrices, name=STATE_SPACE)
    single = model.shape == (1, 1)
    return Model.from_state_space(*matrices, name=STATE_SPACE) if single else model


@dataclass(frozen=True, slots=True)
class Sides:
    """Two compared sides: both models with the names used in this comparison, and notes on
    experiments without information.
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
    """Two models as they are, or under all experiments, each named for the left and for the right
    one; raises InputError.
    """
    plain = plain_sides(left, right, engine)
    if not experiments:
        return Sides(*plain)
    a, b = measured = _measure_both(left, right, experiments)
    silent = [i for i in a.silent if i in b.silent]
    telling = [i for i in range(len(experiments)) if i not in silent]
    notes = [f"nothing is learned from experiment {i + 1}: its sensor never moves" for i in silent]
    # as they are: what a verdict's evidence says is then of the models that were given
    if len(telling) == 1 and all(m.is_plain(telling[0]) for m in measured):
        return Sides(*plain, tuple(notes))
    names = names_under(plain[0].name, plain[1].name, experiments)
    first, second = _sides_under(measured, names, engine)
    return Sides(first, second, tuple(notes))


def _sides_under(
    measured: Sequence[MeasuredChain | MeasuredNetwork], names: Sequence[str], engine: Engine
) -> Sequence[AnySide]:
    chains = [m for m in measured if isinstance(m, MeasuredChain)]
    if chains:
        return [engine.measured_subject(n, m) for n, m in zip(names, chains, strict=True)]
    models = [m.model for m in measured if isinstance(m, MeasuredNetwork)]
    refuse_ports(models)
    return engine.general_subjects(models, names, [m.text for m in measured])


def _measure_both(
    left: Chain | AnyModel,
    right: Chain | AnyModel,
    experiments: Sequence[tuple[Experiment, Experiment]],
) -> tuple[MeasuredChain | MeasuredNetwork, ...]:
    """Both under their experiments: as chains if both are chains, else as networks."""
    both = [(structure_of(model), name_of_model(model)) for model in (left, right)]
    chains = [structure for structure, _ in both if isinstance(structure, Chain)]
    ways = tuple(zip(*experiments, strict=True))
    if len(chains) == SIDES:
        return tuple(map(MeasuredChain, chains, ways))
    networks = (of_chain(s, name) if isinstance(s, Chain) else s for s, name in both)
    return tuple(map(MeasuredNetwork, networks, ways))


def determinable(
    left: Chain | AnyModel, right: Chain | AnyModel, engine: Engine
) -> tuple[tuple[str, int, int], ...]:
    """Of both models, as `compare` names them: how many functions of the parameters are determined,
    and how many parameters there are, exponents among them.

    >>> from disting import Family
    >>> determinable(*(Family(2)[i] for i in (1, 2)), Engine())
    (('2:1', 4, 4), ('2:2', 3, 4))
    """
    sides = plain_sides(left, right, engine)
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
    pairs = [e if isinstance(e, tuple) else (e, e) for e in of_type(experiments, Iterable, NAMED)]
    for pair in pairs:
        if len(pair) != SIDES or not all(isinstance(e, Experiment) for e in pair):
            raise InputError(f"{NAMED}, not {short(pair)}")
    return tuple(dict.fromkeys(pairs))


def plain_sides(
    left: Chain | AnyModel, right: Chain | AnyModel, engine: Engine
) -> tuple[AnySide, AnySide]:
    """Two chains as chains, whoever names them, whatever else as two general models; by two
    names.
    """
    left_name, right_name = names_beside(left, right)
    a, b = renamed_chain(left), renamed_chain(right)
    if a is not None and b is not None:
        return (
            engine.subject(left_name, a.chain, a.note(left_name)),
            engine.subject(right_name, b.chain, b.note(right_name)),
        )
    models = [as_model(left), as_model(right)]
    refuse_ports(models)
    first, second = engine.general_subjects(models, (left_name, right_name))
    return first, second


def names_beside(left: Chain | AnyModel, right: Chain | AnyModel) -> tuple[str, str]:
    """Names of two models in a comparison."""
    if isinstance(left, Chain) and isinstance(right, Chain):
        return names_of(left, right)
    left_name, right_name = map(name_of_model, (left, right))
    return (
        (f"{left_name} 1", f"{right_name} 2")
        if left_name == right_name
        else (left_name, right_name)
    )


def name_of_model(model: Chain | AnyModel) -> str:
    """Name of a single model."""
    return name_of(model) if isinstance(model, Chain) else model.name


def names_under(
    left: str, right: str, experiments: Sequence[tuple[Experiment, Experiment]]
) -> tuple[str, str]:
    """Names of two chains under experiments: the same chain gets the names of experiments that
    differ.

    >>> names_under("3:1", "3:1", [(Experiment(sensor=2), Experiment(sensor=3))])
    ('3:1 with sensor 2', '3:1 with sensor 3')
    """
    differing = [pair for pair in experiments if pair[0] != pair[1]]
    if left != right or not differing:
        return left, right
    a, b = (
        " and with ".join(map(_describe_changes, side)) for side in zip(*differing, strict=True)
    )
    return f"{left} with {a}", f"{right} with {b}"


def _describe_changes(experiment: Experiment) -> str:
    """Changes of the experiment in words."""
    return experiment.text if experiment != Experiment() else "nothing done"


def refuse_ports(models: Sequence[AnyModel]) -> None:
    """Raises InputError for models of which not all have the same inputs and outputs."""
    shapes = {m.shape: m.name for m in models}
    if len(shapes) > 1:
        sizes = [f"{name} has {p} x {m}" for (p, m), name in list(shapes.items())[:2]]
        raise InputError(
            f"models are compared that have the same outputs and inputs: {' and '.join(sizes)}"
        )
