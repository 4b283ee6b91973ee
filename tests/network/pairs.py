"""Pairs of networks that degrees and ranks do not tell apart: of families, and of networks that
somebody has damaged: with redundant, parallel, hanging elements, ports turned or elsewhere, gears.
"""

import os
import random
from itertools import combinations

from disting import local_identifiability
from disting.errors import InputError
from disting.general.any_model import of_network
from disting.model.chain import Sort
from disting.network import Element, Network, Port
from disting.network.families import family_of

SHARE = int(os.environ.get("PAIRS", "10")) / 100  # of pairs that take a second or minutes each
LETTERS = {Sort.MACHINE: "mkkd", Sort.CIRCUIT: "RLC", Sort.COMPARTMENTS: "a"}


def some(pairs):
    """How many of so many dear pairs a long test looks at; PAIRS=100 in the environment makes it
    all.
    """
    return -int(-pairs * SHARE // 1)


def alike(models):
    """All pairs with the same coefficients there and the same rank."""
    classes = {}
    for model in models:
        classes.setdefault((pattern(model), local_identifiability(model).rank), []).append(model)
    return [pair for like in classes.values() for pair in combinations(like, 2)]


def pattern(model):
    """Which coefficients are there."""
    sides = model.numerator_terms, model.denominator_terms
    return model.powers.halves, *(tuple(map(bool, side)) for side in sides)


def of_family(name, most=10**6):
    """A sample of the pairs of a family, in a fixed order."""
    found = alike(map(of_network, family_of(name).networks))
    random.Random(name).shuffle(found)
    return found[:most]


def damaged(name, draw, count):
    """Pairs of so many networks that were made of those of a family by one to three changes."""
    models = []
    while len(models) < count:
        network = draw.choice(family_of(name).networks)
        try:
            for _ in range(draw.randint(1, 3)):
                network = changed(network, draw)
            models.append(of_network(network))
        except InputError:
            continue
    return alike(models)


def changed(network, draw):
    """Another element, one less, one elsewhere, a port elsewhere or turned, a gear."""
    elements, force, sensor = [*network.elements], network.inputs[0], network.outputs[0]
    nodes = [0, *network.nodes, max(network.nodes) + draw.randint(0, 1)]
    what = draw.randrange(6)
    at = draw.randrange(len(elements))
    if what < 2:
        elements.append(
            anywhere(f"{draw.choice(LETTERS[network.sort])}x{len(elements)}", nodes, draw)
        )
    elif what == 2 and elements[at].value:
        elements[at] = anywhere(elements[at].value, nodes, draw)
    elif what == 3 and elements[at].value:
        del elements[at]
    elif what == 4 and network.sort is not Sort.COMPARTMENTS:
        sensor = draw.choice([Port(sensor.minus, sensor.plus), Port(*draw.sample(nodes, 2))])
        force = sensor if network.sort is Sort.CIRCUIT else force
    elif (
        network.sort is Sort.MACHINE and elements[at].letter == "k" and 0 not in elements[at].nodes
    ):
        e = elements[at]
        elements[at] = Element(e.value, e.letter, e.nodes, draw.choice(["g", "2", "1"]))
    name = " ".join(f"{e};" for e in elements) + f" {force} {sensor}"
    return Network(tuple(elements), (force,), (sensor,), network.order, name)


def anywhere(value, nodes, draw):
    """An element of this name at random nodes."""
    letter = "d" if value[0] == "b" else value[0]
    return Element(value, letter, tuple(draw.sample(nodes, 1 if letter == "m" else 2)))
