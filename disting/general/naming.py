"""The check that models of any kind are what their names denote (see `disting.network.denotation`).

A model that is given by formulas is what a notation denotes if its transfer functions are, in the
same names of parameters.
"""

from collections.abc import Iterable

from disting.errors import InputError
from disting.general.any_model import of_network
from disting.general.matrix_model import AnyModel, Model
from disting.model.chain import Chain
from disting.network.denotation import Naming, compare_name, naming_of, refuse_misnamed
from disting.network.network import Network
from disting.quantities import MODELLED

LARGEST_CHAIN = 6  # masses: coefficients of some hundred terms


def naming_of_model(model: AnyModel) -> Naming:
    """Compare a model with what its name denotes.

    >>> lag = Model.from_transfer_function("R1", "C1*R1*s + 1", name="p(R1,C1)")
    >>> sum_of_two = Model.from_transfer_function("R1*C1*s + 1", "C1*s", name="p(R1,C1)")
    >>> str(naming_of_model(lag)), str(naming_of_model(sum_of_two))
    ('denoted', 'false')
    """
    source = (model.chain if isinstance(model, Model) else None) or model.network
    if source is not None:
        return naming_of(model.name, source)
    found = [
        compare_name(model.name, lambda denoted: _has_formulas(model, denoted), quantity)
        for quantity in MODELLED
    ]
    return Naming.DENOTED if Naming.DENOTED in found else found[0]


def refuse_misnamed_models(models: Iterable[AnyModel]) -> None:
    """Raises MisnamedError if the name of one of the models denotes another model."""
    for model in models:
        refuse_misnamed(model.name, naming_of_model(model))


def has_free_name(models: Iterable[AnyModel]) -> bool:
    """Return True if one of the names is free text."""
    return any(naming_of_model(model) is Naming.FREE for model in models)


def _has_formulas(model: AnyModel, denoted: Chain | Network) -> bool:
    """Return True if these are the transfer functions of the denoted model."""
    if tuple(sorted(denoted.parameters)) != model.parameters:
        return False
    try:
        if isinstance(denoted, Network):
            made = of_network(denoted)
        elif denoted.dead_time or denoted.n_masses > LARGEST_CHAIN:
            return False
        else:
            made = Model.from_chain(denoted)
        return _sizes(made) == _sizes(model) and made == model
    except InputError:  # too many terms
        return False


def _sizes(model: AnyModel) -> list[tuple[tuple[int, int], int]]:
    """Degrees and number of terms of each transfer function, known before terms are written out."""
    return [(entry.degrees, entry.n_terms) for entry in model.entries]
