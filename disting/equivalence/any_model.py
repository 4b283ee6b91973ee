"""Equivalents of any model: of chains by theorems and synthesis (`search`), of networks and of
models with formulas by their transfer functions (`model_equivalents`).
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import overload

from disting.equivalence.inputs import Value
from disting.equivalence.listing import Equivalents
from disting.equivalence.search import chain_equivalents
from disting.errors import InputError, of_type
from disting.experiments import Experiment
from disting.general.any_model import as_model
from disting.general.matrix_model import AnyModel
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.names import read_together
from disting.network.families import family_of
from disting.network.network import Network
from disting.network.notation import network_of, notations_of, values_in
from disting.verdict.model_equivalents import ModelEquivalent, model_equivalents
from disting.verdict.sides import Given

FAMILY = re.compile(r"[a-z]+-\d+")  # a family of networks, such as circuits-4
Target = Given | Family | Iterable[Given]
"""Structures to search: one, those of a family, or a list. A tuple is one state space."""
WANTED = (
    "a model is a chain, a name such as '3:4', a Model, a Network, or the matrices (A, B, C) of a"
    " state space; to may be a list of them"
)
NO_ALSO = "also is for chains: it is not supported with networks and models"


@overload
def equivalents(
    model: Chain,
    values: Mapping[str, Value],
    to: Chain | Family,
    *,
    damped: bool | None = None,
    also: Sequence[str | Experiment] = (),
) -> Equivalents: ...
@overload
def equivalents(
    model: Network | AnyModel | tuple[object, ...],
    values: Mapping[str, Value],
    to: Target,
    *,
    damped: bool | None = None,
    also: Sequence[str | Experiment] = (),
) -> tuple[ModelEquivalent, ...]: ...
@overload
def equivalents(
    model: Given,
    values: Mapping[str, Value],
    to: Target,
    *,
    damped: bool | None = None,
    also: Sequence[str | Experiment] = (),
) -> Equivalents | tuple[ModelEquivalent, ...]: ...
def equivalents(
    model: Given,
    values: Mapping[str, Value],
    to: Target,
    *,
    damped: bool | None = None,
    also: Sequence[str | Experiment] = (),
) -> Equivalents | tuple[ModelEquivalent, ...]:
    """All models of the structure `to`, or of all structures of a family, with the transfer
    function of the given model.

    Of chains: `model` and `to` are chains (or a family), or text: 3:11 is model 11 of the 3-mass
    family, 3 the family; `damped` applies to `model` if it is text (else it follows the chains of
    `to`), and `to` follows it, a lag and a dead time included; 3:11+b1+lag has a damper from mass 1
    to the ground and a lag, 3+b* are all structures with any such dampers. `values` by parameter
    name, numbers or text such as 3/4, positive, any consistent units; they are taken exactly,
    floats by their decimal text. The answer is an `Equivalents`. Raises InputError for wrong names
    and values.

    `also`: further experiments, as `Experiment` or as text such as "sensor=3", at masses of the
    given model; of the equivalents those are listed that keep all responses. Masses of another
    structure that are not named, as in "sensor=3/2", are tried in every place, a listing for each.

    Of a network, a `Model` or the matrices (A, B, C) of a state space: `to` is another one, a list
    of them, or the name of a family of networks such as "circuits-4"; networks are also texts, in
    which a circuit may state its values. The answer is a `ModelEquivalent` for each that is not
    distinguishable over positive values; the others, and those with other numbers of inputs and
    outputs, are omitted.

    >>> given = {"m1": 1, "m2": 2, "m3": 3, "k12": 100, "k23": 70, "d12": "0.1", "d23": "0.3"}
    >>> found = equivalents("3:1", given, "3:11", damped=True)
    >>> [(e.signs.value, e.exact["m1"], e.text["k12"]) for e in found]
    [('positive', Fraction(24, 5), '144')]
    >>> found.listings[0].sentence
    'all there are'
    >>> (found,) = equivalents("R0-p(R1,C1)", {"R0": 1, "R1": 2, "C1": "1/2"}, "p(R0,R1-C1)")
    >>> found.verdict.relation.value, str(found.values.equivalents[0])
    ('indistinguishable', 'C1 = 2/9, R0 = 3, R1 = 3/2')
    """
    of_type(values, Mapping, "values are a dict of numbers by the names of the parameters")
    if (
        isinstance(model, str | Chain)
        and isinstance(to, str | Chain | Family)
        and not (_is_network(model) or _is_network(to))
    ):
        return chain_equivalents(model, values, to, damped=damped, also=also)
    if also:
        raise InputError(NO_ALSO)
    given = _model(model, damped)
    inside = values_in(model) if isinstance(model, str) and notations_of(model) else {}
    others = [_model(other, damped) for other in _structures(to)]
    others = [other for other in others if other.name != given.name] or others
    numbers = {str(name): _exact(value) for name, value in values.items()}  # SymPy's symbols too
    return tuple(model_equivalents(given, others, {**inside, **numbers}))


def _exact(value: Value) -> Value:
    """A float by its decimal text, as of chains."""
    return repr(value) if isinstance(value, float) else value


def _is_network(source: object) -> bool:
    """Return True for the text of a network, and for the name of a family of networks."""
    return isinstance(source, str) and bool(FAMILY.fullmatch(source) or notations_of(source))


def _structures(to: Target) -> Iterable[Given]:
    """Yield the structures to search; raises InputError."""
    if isinstance(to, str) and FAMILY.fullmatch(to):
        return family_of(to).networks
    if isinstance(to, Chain | Network | AnyModel | str | tuple):
        return (to,)
    return of_type(to, Iterable, WANTED)


def _model(source: Given, damped: bool | None) -> AnyModel:
    """The general model of a chain, of a network or of a text; raises InputError."""
    if isinstance(source, str):
        if notations_of(source):
            source = network_of(source)
        else:
            (source,) = read_together([source], damped=damped)
    return as_model(of_type(source, Chain | Network | AnyModel | tuple, WANTED))
