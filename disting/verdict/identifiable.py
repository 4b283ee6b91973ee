"""Identifiability over a domain of parameters, of chains, networks and general models alike: a
network that is a chain in the chain's own parameters is treated as that chain.
"""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import replace

from disting.algebra.symbols import RationalFunction
from disting.experiments.experiment import MeasuredChain
from disting.experiments.identifiable import IDENTIFIABLE
from disting.experiments.listing import without_dead_time
from disting.experiments.machine_model import expand, shape
from disting.experiments.measured_network import MeasuredNetwork
from disting.general import Model, as_chain, without_names
from disting.general.identifiability import PARAMETERS
from disting.general.matrix_model import AnyModel, MatrixModel, of_ratios
from disting.general.solutions import CHEAP_UP_TO, SOLUTIONS
from disting.model.chain import Chain
from disting.model.question import Domain
from disting.model.symmetry import canonical
from disting.questions.identifiability import (
    IDENTIFIABILITY,
    Identifiability,
    Level,
    ParameterIdentifiability,
    in_names_of,
)
from disting.questions.identifiability.chain_domains import find_chain_over_domain, is_settled
from disting.questions.identifiability.domains import find_over_domain
from disting.verdict.engine import Engine, Progress, silent

Identified = Identifiability | ParameterIdentifiability


def identify(
    subjects: Sequence[Chain | AnyModel],
    domain: Domain,
    engine: Engine,
    *,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> list[Identified]:
    """Identifiability of each chain or model over a domain, in order."""
    chains = [s if isinstance(s, Chain) else as_chain(s) for s in subjects]
    forms = [canonical(chain).chain for chain in chains if chain]
    models = {
        i: without_names(s)
        for i, s in enumerate(subjects)
        if chains[i] is None and not isinstance(s, Chain)
    }
    for question, tasks in (
        (IDENTIFIABILITY, [(form,) for form in forms]),
        (PARAMETERS, [(model,) for model in models.values()]),
    ):
        engine.answer_all(question, tasks, executor=executor, progress=progress)
    looked_for = [_asked_of_chain(form, engine) for form in forms]
    looked_for += [
        model
        for model in models.values()
        if _is_open(engine.answer(PARAMETERS, (model,), engine.settings))
    ]
    asked_models = [(model,) for model in looked_for if model is not None]
    engine.answer_all(SOLUTIONS, asked_models, executor=executor, progress=progress)
    return [
        _of_model(models[i], domain, engine)
        if chain is None
        else identify_chain(chain, domain, engine)
        for i, chain in enumerate(chains)
    ]


def identify_chain(chain: Chain, domain: Domain, engine: Engine) -> Identifiability:
    """Identifiability of one chain over a domain."""
    form = canonical(chain)
    found = engine.answer(IDENTIFIABILITY, (form.chain,), engine.settings)
    model = _asked_of_chain(form.chain, engine)
    solutions = engine.answer(SOLUTIONS, (model,), engine.settings) if model else None
    return in_names_of(find_chain_over_domain(found, solutions, domain), form, chain)


def identify_measured(
    measured: MeasuredChain | MeasuredNetwork, domain: Domain, engine: Engine
) -> ParameterIdentifiability:
    """Identifiability of the parameters of a chain or a network over a domain by several
    experiments together; raises InputError for transfer functions that are too large.
    """
    if isinstance(measured, MeasuredNetwork):
        return _of_model(without_names(measured.model), domain, engine)
    found = engine.answer(IDENTIFIABLE, (measured,), engine.settings)
    small = len(measured.chain.parameters) <= CHEAP_UP_TO
    model = matrix_of(measured) if _is_open(found) and small else None
    return _over(found, model, domain, engine)


def matrix_of(measured: MeasuredChain) -> MatrixModel:
    """The transfer functions of all experiments that are not zero, one row for each, without a dead
    time, in the chain's parameters.

    >>> from disting.experiments.experiment import Experiment
    >>> two = MeasuredChain(Chain(2, damped=False), (Experiment(), Experiment(sensor=1)))
    >>> matrix_of(two).shape
    (2, 1)
    """
    plain = without_dead_time(measured)
    entries = [entry for entry in plain.entries if shape(entry).numerator]
    ratios = [[RationalFunction(*expand(entry))] for entry in entries]
    return of_ratios(ratios, plain.chain.parameters, "measured")


def _is_open(found: ParameterIdentifiability) -> bool:
    """Return True if the solutions may differ from one domain to another."""
    return bool(found.named(Level.LOCAL) or found.named(Level.UNKNOWN))


def _of_model(model: AnyModel, domain: Domain, engine: Engine) -> ParameterIdentifiability:
    found = engine.answer(PARAMETERS, (model,), engine.settings)
    return _over(found, model if _is_open(found) else None, domain, engine)


def _over(
    found: ParameterIdentifiability, model: AnyModel | None, domain: Domain, engine: Engine
) -> ParameterIdentifiability:
    if model is None:
        return replace(found, domain=domain)
    return find_over_domain(found, engine.answer(SOLUTIONS, (model,), engine.settings), domain)


def _asked_of_chain(chain: Chain, engine: Engine) -> AnyModel | None:
    """The model whose solutions are searched; None where theorems give them, or where there are too
    many parameters. A dead time follows from the response alone.
    """
    if is_settled(engine.answer(IDENTIFIABILITY, (chain,), engine.settings)):
        return None
    plain = replace(chain, dead_time=False)
    if len(plain.parameters) > CHEAP_UP_TO:
        return None
    return without_names(Model.from_chain(plain))
