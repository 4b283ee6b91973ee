"""Names of models that are notations, and the check that a model is what its name denotes.

A name such as 3:1+b2, R0-p(R1,C1), 1=2=3; F1; S3 or 1>2, 2>0; in 1; out 2 states which model it
is, so a file that stores another model under it would make every sentence on that name false. Any
other name is free text.
"""

import re
from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum
from functools import lru_cache

from disting.errors import ConstraintViolation, InputError, short
from disting.model.chain import Chain, Quantity
from disting.model.names import chain_of_whole_name, is_whole_name
from disting.network.chains import of_chain
from disting.network.isomorphism import is_same_network
from disting.network.network import Network
from disting.network.notation import network_of, notations_of

REMEMBERED = 4096  # names
# a word such as RC, P1 or Lead-Lag may be meant as a word, though it can be read as a circuit
WORD = re.compile(r"(?:\w+|[^\W\d_]{2,}(?:-[^\W\d_]{2,})+)(?: [12])?")
ADDED = re.compile(r"(.*\S) (?:[12]|\(((?:un)?damped, \w+)\))")  # such as (damped, velocity)
FREE_NAMES = "model names are free text; the answer is about the models in the file"


class MisnamedError(InputError):
    """A model of a file whose name denotes another model: the message names it, and the remedy."""


class Naming(StrEnum):
    """The relation between a model and its name: the name denotes it, is free text, or denotes
    another model.
    """

    DENOTED = "denoted"
    FREE = "free"
    FALSE = "false"


def naming_of(name: str, model: Chain | Network) -> Naming:
    """Compare a model with what its name denotes, up to numbers of nodes and names of parameters.

    A name leaves the sensor quantity open unless it states it, and that of a chain leaves open
    whether the springs are damped.

    >>> from disting.network.notation import network_of
    >>> cell = network_of("R0-p(R1,C1)")
    >>> [str(naming_of(name, cell)) for name in ("my cell", "R5-p(C7,R2)", "p(R0,R1-C1)")]
    ['free', 'denoted', 'false']
    """
    order = model.quantity.order if isinstance(model, Chain) else model.order
    return compare_name(name, lambda denoted: is_same(denoted, model), list(Quantity)[order])


def compare_name(
    name: str, is_model: Callable[[Chain | Network], bool], quantity: Quantity
) -> Naming:
    """Compare a model with what its name denotes; `is_model`: the test of one of the readings."""
    found = readings(name, quantity)
    if found is None:
        return Naming.FREE
    if any(map(is_model, found)):
        return Naming.DENOTED
    return Naming.FREE if WORD.fullmatch(name) else Naming.FALSE


def refuse_misnamed(name: str, naming: Naming) -> None:
    """Raises MisnamedError if the name denotes another model.

    >>> refuse_misnamed("R1-C1", Naming.FALSE)
    Traceback (most recent call last):
    disting.network.denotation.MisnamedError: ...
    """
    if naming is Naming.FALSE:
        raise MisnamedError(
            f"{short(name)} does not denote the model stored under this name; rename the model or"
            " write the file again"
        )


@lru_cache(maxsize=REMEMBERED)
def readings(name: str, quantity: Quantity) -> tuple[Chain | Network, ...] | None:
    """The models that a name can denote, with sensors of this quantity unless it states another
    one; none for a name of a chain that does not exist, None for free text. What verdicts add to a
    name, to distinguish two models of one name, may follow it.
    """
    if is_whole_name(name):
        chains = (chain_of_whole_name(name, damped, quantity) for damped in (True, False))
        return tuple(chain for chain in chains if chain is not None)
    networks = (_read(name, notation, quantity) for notation in notations_of(name))
    found = tuple(network for network in networks if network is not None)
    more = ADDED.fullmatch(name)
    if found or more is None:
        return found or None
    found_of_name = readings(more[1], quantity)
    return found_of_name and tuple(m for m in found_of_name if _has_premise(m, more[2]))


def _has_premise(model: Chain | Network, text: str) -> bool:
    """Return True unless the text states another damping or quantity."""
    return not (text and isinstance(model, Chain)) or text == str(model.premise)


def is_same(one: Chain | Network, other: Chain | Network) -> bool:
    """Return True if both are one model up to numbers of nodes and names of parameters."""
    if one == other:
        return True
    if _extras(one) != _extras(other):
        return False
    try:
        return is_same_network(*map(_elements, (one, other)))
    except (InputError, ConstraintViolation):  # a chain of more masses than a network has nodes
        return False


def _extras(model: Chain | Network) -> tuple[bool, bool]:
    """Lag and dead time, which no network has."""
    return (model.lag, model.dead_time) if isinstance(model, Chain) else (False, False)


def _elements(model: Chain | Network) -> Network:
    """The network, without the lag and the dead time behind it."""
    if isinstance(model, Network):
        return model
    return of_chain(replace(model, lag=False, dead_time=False))


def _read(name: str, notation: str, quantity: Quantity) -> Network | None:
    try:
        return network_of(name, notation, quantity=quantity)
    except InputError:
        return None
