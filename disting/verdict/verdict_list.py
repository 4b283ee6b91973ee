"""`verdicts`: all pairs of a list of models, of a size, or of a family of networks."""

from collections.abc import Iterable, Sequence
from concurrent.futures import Executor

from disting.conditions.side import AnySide
from disting.errors import InputError, of_type
from disting.general import AnyModel
from disting.general.any_model import given_model, of_network
from disting.model.chain import Chain, Quantity, as_quantity
from disting.model.family import Family
from disting.model.names import name_of, read_together
from disting.model.question import Domain
from disting.network.families import family_of
from disting.verdict.comparison import asked_of, prove_all
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.result import Conditions, Query, query_of
from disting.verdict.sides import Given, model_of, refuse_ports


def verdicts(
    models: Iterable[Given] | int | str,
    *,
    damped: bool | None = None,
    quantity: Quantity | str | None = None,
    conditions: Conditions | None = None,
    domain: Domain | str | None = None,
    representation: str = "all",
    markov: int = 0,
    prove: bool = False,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Decisions:
    """Verdicts on all pairs of models, with their classes.

    `models`: a number of masses (all chains of that size), the name of a family of networks such as
    "circuits-4", or a list of what `compare` takes; `damped` and `quantity` apply to chains that
    are numbered or named. `conditions` and `domain` as of `compare`; `representation`: "tf" or
    "markov" for conditions on that one alone (default "all"); `markov`: use the Markov parameters
    G_0 and G_1 to G_markov (0: all that are needed); `prove`: by exact elimination, where it ends
    in 10 s. The executor's workers compute what is needed. Raises InputError.

    >>> found = verdicts(3, conditions="1-5")
    >>> len(found.subjects), found.verdict(0, 3).sentence[:55]
    (11, '3:1 and 3:4, damped, acceleration, are distinguishable ')
    >>> [found.classes()[0] for found in [verdicts(["R0-p(R1,C1)", "p(R0,R1-C1)"])]]
    [(0, 1)]
    """
    _, engine = asked_of(None, engine)
    query = query_of(conditions, domain, representation, markov)
    if isinstance(models, int):
        shown = Quantity.ACCELERATION if quantity is None else as_quantity(quantity)
        models = list(Family(models, damped is not False, shown))
    elif isinstance(models, str):
        models = [of_network(network) for network in family_of(models).networks]
    subjects = subjects_of(_models_of(models, damped, quantity), engine)
    return decide_all(subjects, query, engine, prove=prove, executor=executor, progress=progress)


def decide_all(
    subjects: Sequence[AnySide],
    query: Query,
    engine: Engine,
    *,
    prove: bool = False,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Decisions:
    """All pairs of models as they are compared, proven where that is requested and ends in time."""
    decided = engine.decisions(subjects, query, executor=executor, progress=progress)
    return prove_all(decided, progress=progress) if prove else decided


def subjects_of(models: Sequence[Chain | AnyModel], engine: Engine) -> Sequence[AnySide]:
    """Models as they are compared with each other; raises InputError for different numbers of
    inputs or outputs.
    """
    chains = [model for model in models if isinstance(model, Chain)]
    if len(chains) == len(models):
        return [engine.subject(name_of(chain), chain) for chain in chains]
    general = [given_model(model) for model in models]
    refuse_ports(general)
    return engine.general_subjects(general)


def _models_of(
    models: Iterable[Given], damped: bool | None, quantity: Quantity | str | None
) -> list[Chain | AnyModel]:
    """Models as `compare` takes them, names as the chains that they mean."""
    listed = list(of_type(models, Iterable, "the models are a list of models"))
    shown = Quantity.ACCELERATION if quantity is None else as_quantity(quantity)
    if len(listed) < 2:
        raise InputError("there is nothing to compare: give two models at least")
    read = [model_of(model, shown) for model in listed]
    names = [model for model in read if isinstance(model, str)]
    chains = iter(read_together(names, damped=damped, quantity=quantity))
    return [next(chains) if isinstance(model, str) else model for model in read]
