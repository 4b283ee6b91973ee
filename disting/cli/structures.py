"""What a command line names where chains and networks do alike: structures and their values."""

import argparse
from collections.abc import Sequence

from disting.equivalence.inputs import assignments, point_of
from disting.errors import InputError
from disting.model.chain import Chain, Sensor
from disting.model.names import NAME, chains_named, damping_option
from disting.network.network import Network
from disting.network.notation import network_of, notations_of


def is_network(text: str, notation: str = "") -> bool:
    """Whether a text is that of a network, not the name of a chain.

    >>> is_network("R0-p(R1,C1)"), is_network("3:1+b2")
    (True, False)
    """
    return bool(notations_of(text)) or bool(notation and not NAME.fullmatch(text))


def structures(
    texts: Sequence[str], options: argparse.Namespace, quantity: Sensor = Sensor.ACCELERATION
) -> list[Chain | Network]:
    """Chains by their names or networks in a notation; raises InputError for both at once, and for
    options of chains with networks.
    """
    said = [is_network(text, options.notation) for text in texts]
    if not any(said):
        return [*chains_named(texts, damped=options.damped, sensor=quantity)]
    if options.damped is not None:
        raise InputError(
            f"{damping_option(options.damped)} belongs to numbered chains: a network says its"
            " dampers itself"
        )
    if not all(said):
        raise InputError(
            f"{texts[said.index(False)]} is a numbered chain, {texts[said.index(True)]} a network:"
            " write the chain as a network too, such as 1=2=3; F1; S3"
        )
    return [network_of(text, options.notation, quantity=quantity) for text in texts]


def values_of(model: Chain | Network, texts: Sequence[str]) -> dict[str, float]:
    """The values of all its parameters from texts such as m1=1,k12=3/4; raises InputError."""
    exact = point_of(model, assignments([*texts]))
    return {name: int(value.p) / int(value.q) for name, value in exact.items()}
