"""Correspondence of masses between two models: on the bench a mass is one physical part.

An experiment names masses of the left chain. A mass of the right chain that is the same thing may
be known, written 3/2; where it is not, every mass that is left over may be it. Different things
stay different, the ground stays the ground, and one thing is one mass in all experiments.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import permutations
from math import perm
from typing import Any

from disting.errors import InputError, enumeration, short
from disting.experiments.changes import Change, read_changes
from disting.experiments.experiment import AnyStructure, Experiment, places_of, range_of
from disting.model.kinds import BY_NAME, EXAMPLES

Places = tuple[tuple[int, int], ...]
"""(mass of the left chain, the same thing in the right one), sorted."""
MOST_WAYS = 200  # to place what is not known: each is a verdict
FORM = (
    f"an experiment is written {EXAMPLES}, one or several of them, joined by commas; 3/2 is mass 3"
    " of the left model and 2 of the right one"
)


@dataclass(frozen=True, slots=True)
class PlacedExperiment:
    """An experiment in masses of the left chain, and what is known of the right one."""

    experiment: Experiment
    places: Places = ()


def parse_experiment(text: str) -> PlacedExperiment:
    """Parse an experiment such as `sensor=3/2,lock=1`; raises InputError.

    >>> parse_experiment("sensor=3/2-1,lock=1").places
    ((3, 2),)
    >>> parse_experiment("inertia=1:0.5").experiment.text
    'inertia 1/2 at mass 1'
    """
    ports: dict[str, Any] = {}
    changes: list[Change[int]] = []
    places: list[tuple[int, int]] = []

    def mass(text: str) -> int:
        """A mass of the left chain; one of the right that is the same is kept."""
        return _mass(text, places)

    for part in text.split(","):
        key, _, value = part.strip().partition("=")
        kind = BY_NAME.get(key)
        if not value or (kind is None and key != "quantity"):
            raise InputError(f"{FORM}, not {short(text)}")
        if kind is not None and not kind.is_port:
            changes += read_changes(kind, value, mass)
            continue
        if key in ports:
            raise InputError(
                f"an experiment has one {key}: repeat the whole option for another one"
            )
        ports[key] = value
        if kind is not None:
            ends = tuple(map(mass, value.split("-")))
            ports[key] = ends if len(ends) > 1 else ends[0]
    agreed = _merge_pairs(places)
    return PlacedExperiment(Experiment(**ports, changes=changes), agreed)


def ways(
    left: AnyStructure,
    right: AnyStructure,
    asked: Sequence[PlacedExperiment],
    fixed_places: Places = (),
) -> list[Places]:
    """Every assignment of which masses of the right model the named ones of the left model are;
    raises InputError.
    """
    for item in asked:
        item.experiment.refuse(left)
    fixed = dict(_merge_pairs([*fixed_places, *(pair for item in asked for pair in item.places)]))
    used = sorted({i for item in asked for i in item.experiment.masses})
    open_ones = [i for i in used if i not in fixed]
    masses = places_of(right)
    wrong = [r for r in fixed.values() if r not in masses]
    if wrong:
        raise InputError(f"there is no mass {wrong[0]} in the right model with {range_of(masses)}")
    free = [r for r in masses if r not in fixed.values()]
    count = perm(len(free), len(open_ones))
    if not count:
        raise InputError(
            f"the right model has {len(masses)} masses, so masses {enumeration(map(str, used))}"
            " of the left one cannot all be different ones of it"
        )
    if count > MOST_WAYS:
        raise InputError(
            f"the places are not known in {count} ways, {MOST_WAYS} at most are asked for: name"
            f" some, for instance {open_ones[0]}/{free[0]}"
        )
    numberings = (
        dict(zip(open_ones, chosen, strict=True)) for chosen in permutations(free, len(open_ones))
    )
    return [tuple(sorted((fixed | item).items())) for item in numberings]


def move(experiment: Experiment, places: Places) -> Experiment:
    """The experiment at the places of the right chain; raises KeyError for a mass without one."""
    return experiment.moved(dict(places).__getitem__)


def _mass(text: str, places: list[tuple[int, int]]) -> int:
    match = re.fullmatch(r"(\d{1,3})(?:/(\d{1,3}))?", text.strip())
    if not match:
        raise InputError(f"a place is a mass such as 3, or 3/2 for left/right, not {short(text)}")
    left = int(match[1])
    if match[2] is not None:
        places.append((left, int(match[2])))
    return left


def _merge_pairs(pairs: Iterable[tuple[int, int]]) -> Places:
    """The pairs, each once; raises InputError where one thing would be two, or two would be one."""
    agreed = tuple(sorted(set(pairs)))
    for side, name, other in ((0, "left", "right"), (1, "right", "left")):
        met: dict[int, tuple[int, int]] = {}
        for pair in agreed:
            if pair[side] in met:
                both = sorted((met[pair[side]][1 - side], pair[1 - side]))
                raise InputError(
                    f"mass {pair[side]} of the {name} model is both {both[0]} and {both[1]} of the"
                    f" {other} one: a thing is one mass in each model"
                )
            met[pair[side]] = pair
    zero = next((p for p in agreed if 0 in p and p != (0, 0)), None)
    if zero:
        raise InputError(f"0 is the ground, in both models: {zero[0]}/{zero[1]} is not possible")
    return tuple(p for p in agreed if p != (0, 0))
