"""Models as commands name and write them: numbered chains, networks in a notation, models of a
file; and the values of their parameters.
"""

import argparse
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from disting.cli.arguments import FILE, split_reference
from disting.cli.output import keep_apart
from disting.errors import InputError
from disting.general import AnyModel, MatrixModel, read_models
from disting.general.any_model import as_chain, of_network
from disting.model.chain import Chain, Sensor, Sort, text_drawing
from disting.model.names import NAME, damping_option, read_together
from disting.network.network import Network
from disting.network.notation import network_of, notations_of, values_in

if TYPE_CHECKING:
    from disting.equivalence.inputs import Value

MOST_TERMS = 30  # of a transfer function that is written out


def is_network(text: str, notation: str = "") -> bool:
    """Return True if a text denotes a network, not the name of a chain.

    >>> is_network("R0-p(R1,C1)"), is_network("3:1+b2")
    (True, False)
    """
    return bool(notations_of(text)) or bool(notation and not NAME.fullmatch(text))


def models_of(texts: Sequence[str], options: argparse.Namespace) -> list[Chain | AnyModel]:
    """Models that the texts name: a chain, a network in a notation, a model file.json:name."""
    if options.also and (options.prove or getattr(options, "bound", ())):
        raise InputError(
            "with --also the verdict is on several experiments: leave --prove and --bound away"
        )
    networks = {text: _network(text, options) for text in texts if FILE not in text}
    named = [text for text, network in networks.items() if network is None]
    if len(set(texts)) == len(set(named)):
        return [*read_together(texts, damped=options.damped, sensor=options.quantity)]
    if getattr(options, "bound", ()):
        raise InputError("--bound belongs to numbered chains: leave it away")
    if all(FILE in text for text in texts):
        from disting.cli.verdicts import refuse_chain_options

        refuse_chain_options(options)
    if not named:
        _refuse_damping(options)
    chains = dict(
        zip(
            named,
            read_together(named, damped=options.damped, sensor=options.quantity),
            strict=True,
        )
    )
    lists = {path: read_models(path) for path, _ in map(split_reference, texts) if path}
    keep_apart(model.name for models in lists.values() for model in models)
    return [
        lists[path][name] if path else networks[text] or chains[text]
        for text, (path, name) in zip(texts, map(split_reference, texts), strict=True)
    ]


def _network(text: str, options: argparse.Namespace) -> AnyModel | None:
    """The model of a network; None of the name of a chain."""
    if not is_network(text, options.notation):
        return None
    quantity = Sensor(options.quantity)
    return of_network(network_of(text, options.notation, quantity=quantity))


def structures(
    texts: Sequence[str], options: argparse.Namespace, quantity: Sensor = Sensor.ACCELERATION
) -> list[Chain | Network]:
    """Chains by their names, networks in a notation or file.json:name; raises InputError for both
    at once, and for options of chains with networks.
    """
    nets = [FILE in text or is_network(text, options.notation) for text in texts]
    if not any(nets):
        return [*read_together(texts, damped=options.damped, sensor=quantity)]
    _refuse_damping(options)
    if not all(nets):
        raise InputError(
            f"{texts[nets.index(False)]} is a numbered chain, {texts[nets.index(True)]} a network:"
            " write the chain as a network too, such as 1=2=3; F1; S3"
        )
    return [
        _of_file(text) if FILE in text else network_of(text, options.notation, quantity=quantity)
        for text in texts
    ]


def _of_file(text: str) -> Network:
    path, name = split_reference(text)
    network = read_models(path)[name].network
    if network is None:
        raise InputError(f"{text} is given by formulas, not by its elements: describe a network")
    return replace(network, name=name)


def stated_values(text: str, options: argparse.Namespace) -> "dict[str, Value]":
    """Return the values of --set, and those in braces of the text of a network that --set leaves
    open; raises InputError.
    """
    from disting.equivalence.inputs import assignments  # a look-up needs none of it

    has_braces = FILE not in text and is_network(text, options.notation)
    inside = values_in(text, options.notation) if has_braces else {}
    return {**inside, **assignments(options.values)}


def values_of(model: Chain | Network, text: str, options: argparse.Namespace) -> dict[str, float]:
    """Return the values of all parameters of the model that `text` names, from --set and from
    braces in the text; raises InputError.
    """
    from disting.equivalence.inputs import point_of

    exact = point_of(model, stated_values(text, options))
    return {name: int(value.p) / int(value.q) for name, value in exact.items()}


def _refuse_damping(options: argparse.Namespace) -> None:
    """Raises InputError for --damped and --undamped, with networks."""
    if options.damped is not None:
        raise InputError(
            f"{damping_option(options.damped)} belongs to numbered chains: a network says its"
            " dampers itself"
        )


def in_letters(
    side: Chain | AnyModel, most_terms: int = MOST_TERMS, longer: str = ", in --json"
) -> str:
    """A chain's drawing, or a transfer function of so many terms; where a longer one is."""
    if isinstance(side, Chain):
        return text_drawing(side)
    chain = as_chain(side)
    if chain is not None:
        return text_drawing(chain)
    entries = side.entries if isinstance(side, MatrixModel) else (side,)
    circuit = side.network is not None and side.network.sort is Sort.CIRCUIT
    letter = "Z" if circuit else "G"  # an impedance is called so
    if sum(e.n_terms for e in entries) <= most_terms:
        return letter + str(side).removeprefix("G")
    if isinstance(side, MatrixModel):
        return "{}(s) with {} outputs and {} inputs{}".format(letter, *side.shape, longer)
    powers = side.powers
    root = ", in powers of sqrt(s)" * powers.halves + "".join(f", s^{n}" for n in powers.exponents)
    return "{}(s) of degree {} over {}{}{}".format(letter, *side.degrees, root, longer)
