"""Content of the file of a fit: the selected structure, its rivals, and the measurement.

Rivals are the structures that the data do not exclude and those that may be equivalent. What
contains one of them is no rival: no experiment excludes it if the smaller one is true. Structures
that are equivalent for the fitted values are listed separately: no data with this force and sensor
distinguish them from the selected one.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from pathlib import Path
from typing import Any

import numpy as np

from disting.errors import InputError, enumeration
from disting.export import (
    FIT_FILE,
    chain_from_dict,
    model_from_dict,
    number_of,
    refuse_open_quantity,
)
from disting.files import Format, read_json
from disting.fit.judge.explanation import STATUS, Level
from disting.fit.results.networks import BAR
from disting.fit.search.candidates import listed_form, reference
from disting.fit.search.containment import contains
from disting.fit.search.plant import Plant
from disting.fit.search.starts import Parameters
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.names import chain_of
from disting.network.denotation import MisnamedError, Naming, naming_of, refuse_misnamed
from disting.network.network import Network
from disting.network.notation.entries import network_of_entry
from disting.verdict.result import Relation

ALIKE = 1e-3  # relative difference of responses of equal structures, computed in floats
BAND = (1.0, 1e4, 30)  # [rad/s], where structures with one response cannot differ either
MOST_COUNTED = 10**7  # such as the lines of a response
REASON = "the same responses for all positive values"


@dataclass(frozen=True, slots=True)
class Survivor:
    """A structure that the data leave, `fitted` or behaving as one that was: `like` names those
    whose response it has for their fitted values. `values`: all its parameter vectors that are
    known to do so, its own fit first; `free`: dimension of the family that some are taken from.
    """

    chain: Chain
    fitted: bool
    values: tuple[Parameters, ...]
    like: tuple[Chain, ...] = ()
    free: int = 0

    @property
    def name(self) -> str:
        """Such as 3:11+b1."""
        return reference(self.chain)


@dataclass(frozen=True, slots=True)
class FitRecord:
    """`explained`: whether the selected structure explains the data, or nearly; `same`: names of
    equivalent structures, with the reason; `rivals` with their fitted values, none of those that
    were not fitted; `left`: the structures that the data leave, the selected one first; `scatter`
    of a line; `low`, `high` [Hz] and number of the `lines`, 0 each where the file does not state
    them; `responses`: how many were fitted together; `command`: what fits the same data again, ""
    where it is not stated; `errors`: relative standard errors of the selected structure's
    parameters, infinite for one that is not determined; `larger`: the structures that contain one
    of these, with their fitted values, `determined`: those of which the data determine all
    parameters.
    """

    model: Chain
    values: Parameters
    explained: bool
    rivals: dict[Chain, Parameters]
    same: dict[str, str]
    left: tuple[Survivor, ...]
    scatter: float
    low: float
    high: float
    lines: int
    responses: int
    command: str = ""
    errors: Mapping[str, float] = field(default_factory=dict)
    larger: Mapping[Chain, Parameters] = field(default_factory=dict)
    determined: frozenset[Chain] = frozenset()

    @property
    def chains(self) -> tuple[Chain, ...]:
        """The structures that the data leave."""
        return tuple(survivor.chain for survivor in self.left)


def named_by(path: Path) -> FitRecord:
    """Content of a JSON file of `disting fit`; raises InputError."""
    plain = read_json(path, FIT_FILE)
    refuse_open_quantity(plain, path)
    if not isinstance(plain, dict) or not isinstance(plain.get("selected"), dict):
        raise InputError(f"{path} holds no selected model: name {FIT_FILE}")
    try:
        model, values = model_from_dict(plain["selected"])
        range_of = plain.get("frequencies", {"low": 0.0, "high": 0.0, "lines": 0})
        same = dict(_same(plain))
        return FitRecord(
            model,
            values,
            plain["explained"] is True or plain.get("status") == STATUS[Level.NEARLY],
            {c: v for c, v in _rivals(plain, model) if c != model and reference(c) not in same},
            same,
            tuple(_read_left(plain, model, values)),
            number_of(plain["scatter"], 0.0),
            number_of(range_of["low"], 0.0),
            number_of(range_of["high"], 0.0),
            _count(range_of["lines"]),
            len(plain.get("responses", [None])),
            str(plain.get("command", "")),
            dict(_errors(plain["selected"], values)),
            dict(model_from_dict(m) for m in plain["not_excluded"] if _is_larger(m, model)),
            frozenset(map(chain_from_dict, _select_determined(plain))),
        )
    except MisnamedError as reason:
        raise InputError(f"{path}: {reason}") from None
    except (KeyError, TypeError, ValueError, AttributeError) as reason:
        raise InputError(
            f"{path} is not a complete fit file: {reason} is missing or wrong; fit again"
        ) from None


def _errors(selected: dict[str, Any], values: Parameters) -> Iterator[tuple[str, float]]:
    for name, error in selected.get("standard_errors", {}).items():
        yield name, inf if error is None else number_of(error, 0.0) / values[name]


def _count(value: Any) -> int:
    return int(number_of(value, 0, MOST_COUNTED))


def _is_larger(entry: Mapping[str, Any], model: Chain) -> bool:
    """Return True if an entry of the file contains the selected structure, or another one as the
    file states.
    """
    return bool(entry.get("contains")) or contains(chain_from_dict(dict(entry)), model)


def _select_determined(plain: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the candidates of which the data determine all parameters."""
    return (c for c in plain.get("candidates", []) if c["admissible"])


def _rivals(plain: dict[str, Any], model: Chain) -> Iterator[tuple[Chain, Parameters]]:
    """In the order of the file, those with values last, which replace earlier ones."""
    for alternative in plain["alternatives"]:
        chain = chain_from_dict(alternative)
        if alternative["relation"] != Relation.INDISTINGUISHABLE and not contains(chain, model):
            yield chain, {}
    members = [m for m in plain["not_excluded"][1:] if not _is_larger(m, model)]
    yield from map(model_from_dict, members)


def _read_left(plain: dict[str, Any], model: Chain, values: Parameters) -> Iterator[Survivor]:
    """The selected structure, the others that were fitted, then what behaves as one of these;
    each once.
    """
    members = [m for m in plain["not_excluded"] if not _is_larger(m, model)]
    fitted = {model: values} | dict(map(model_from_dict, members))
    own = {chain: [its] for chain, its in fitted.items()}
    like = {chain: dict[Chain, None]() for chain in fitted}
    named = {reference(chain): chain for chain in fitted}
    free: dict[Chain, int] = {}

    def add(name: str, chain: Chain) -> Chain:
        """The structure of this name, which behaves as a fitted one."""
        other = named.setdefault(name, _structure_of(name, chain))
        own.setdefault(other, [])
        like.setdefault(other, {}).update({chain: None} if other != chain else {})
        return other

    for member in members:
        chain, fitted_values = model_from_dict(member)
        for twin in member["equivalents"]:
            other = add(twin["name"], chain)
            whole = list(_whole(twin["parameters"], other))
            if twin["parameters"] and not whole:
                refuse_misnamed(twin["name"], Naming.FALSE)
            if len(plain.get("responses", [None])) == 1:  # of several not each has this sensor
                _refuse_other_response(twin["name"], (chain, fitted_values), other, whole)
            own[other].extend(whole)
            free[other] = max(free.get(other, 0), _count(twin.get("free_choices", 0)))
    for value in plain["alternatives"]:
        if value["relation"] == Relation.INDISTINGUISHABLE:
            add(reference(chain_from_dict(value)), model)
    for chain, all_values in own.items():
        yield Survivor(
            chain, chain in fitted, tuple(all_values), tuple(like[chain]), free.get(chain, 0)
        )


def _refuse_other_response(
    name: str, fitted: tuple[Chain, Parameters], other: Chain, values: Sequence[Parameters]
) -> None:
    """Raises MisnamedError unless the structure of this name has the fitted response at its values:
    a file names it, and has nothing else of it.
    """
    omega = np.geomspace(*BAND)
    wanted = _response(*fitted, omega)
    for one in values:
        if not np.allclose(_response(other, one, omega), wanted, rtol=ALIKE, atol=0):
            refuse_misnamed(name, Naming.FALSE)


def _response(chain: Chain, values: Parameters, omega: Real) -> Complex:
    plant = Plant(chain.structure, omega)
    return plant.response(np.array([values[name] for name in plant.parameters]))


def _structure_of(name: str, chain: Chain) -> Chain:
    """The structure of a name, with the damping and the sensor of a chain."""
    return chain_of(name, Family(chain.n_masses, chain.damped, chain.quantity))


def _whole(entries: Parameters, chain: Chain) -> Iterator[Parameters]:
    """Values under the names of the listed form, under those of the chain; nothing where some are
    missing.
    """
    other_entries = listed_form(chain).renaming
    if all(other_entries[name] in entries for name in chain.parameters):
        yield {name: number_of(entries[other_entries[name]]) for name in chain.parameters}


def _same(plain: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Names and reasons."""
    for value in plain["alternatives"]:
        if value["relation"] == Relation.INDISTINGUISHABLE:
            yield reference(chain_from_dict(value)), value["reason"]
    for member in plain["not_excluded"][:1]:
        for twin in member["equivalents"]:
            yield twin["name"], "the same response for the fitted values"


@dataclass(frozen=True, slots=True)
class LeftNetwork:
    """A network that the data do not exclude, with its fitted values, and those that give the
    `same` responses; `contains`: the name of another one that it contains, "" of a rival;
    `is_determined`: whether the data determine all of its values.
    """

    network: Network
    values: Parameters
    same: tuple[Network, ...]
    contains: str = ""
    is_determined: bool = True


@dataclass(frozen=True, slots=True)
class NamedNetworks:
    """Input of a plan: the selected network (`model`) with its values, `rivals` with theirs, the
    `same` by name with the reason, `larger` ones and which of them are `determined` as in
    `FitRecord`; the typical `scatter` of the `lines` from `low` to `high` [Hz].
    """

    model: Network
    values: Parameters
    rivals: dict[Network, Parameters]
    same: dict[str, str]
    scatter: float
    low: float
    high: float
    lines: int
    explained: bool = True
    larger: Mapping[Network, Parameters] = field(default_factory=dict)
    determined: frozenset[Network] = frozenset()


def record_of(path: Path) -> FitRecord | NamedNetworks:
    """Content of a file of a fit, of chains or of networks; raises InputError."""
    return networks_named_by(path) if is_of_networks(path) else named_by(path)


def is_of_networks(path: Path) -> bool:
    """Return True if a JSON file is that of a fit of networks; raises InputError."""
    plain = read_json(path, FIT_FILE)
    return isinstance(plain, dict) and plain.get("format") == Format.NETWORK_FIT


def left_by(path: Path) -> tuple[LeftNetwork, ...]:
    """The networks that a fit leaves, the selected one first, those that contain another one last;
    raises InputError.
    """
    return _left_networks(_read_plain(path), path)


def networks_named_by(path: Path) -> NamedNetworks:
    """Content of the file; raises InputError where no network explains the data."""
    plain = _read_plain(path)
    first, *others = _left_networks(plain, path)
    try:
        lines = plain["frequencies"]
        return NamedNetworks(
            model=first.network,
            values=first.values,
            rivals={s.network: s.values for s in others if not s.contains},
            same={network.name: REASON for network in first.same},
            scatter=number_of(plain["scatter"], 0.0),
            low=number_of(lines["low"], 0.0),
            high=number_of(lines["high"], 0.0),
            lines=int(number_of(lines["lines"], 0, MOST_COUNTED)),
            larger={s.network: s.values for s in others if s.contains},
            determined=frozenset(s.network for s in others if s.is_determined),
        )
    except (KeyError, TypeError, ValueError) as reason:
        raise _file_error(path, reason) from None


def _read_plain(path: Path) -> Mapping[str, Any]:
    plain = read_json(path, FIT_FILE)
    if not isinstance(plain, dict):
        raise InputError(f"{path} holds no networks: name {FIT_FILE}")
    return plain


def _left_networks(plain: Mapping[str, Any], path: Path) -> tuple[LeftNetwork, ...]:
    try:
        entries = {str(entry["name"]): entry for entry in plain["networks"]}
        networks = {name: network_of_entry(entry, name) for name, entry in entries.items()}
        for name, network in networks.items():
            refuse_misnamed(name, naming_of(name, network))
        survivors = tuple(
            LeftNetwork(
                networks[fit["name"]],
                {name: number_of(fit["values"][name]) for name in fit["values"]},
                tuple(networks[name] for name in fit["same"]),
                str(fit.get("contains") or ""),
                None not in fit.get("relative_deviations", {}).values(),
            )
            for fit in plain["fits"]
            if fit["explains"] and not fit["excluded_by"]
        )
    except MisnamedError as reason:
        raise InputError(f"{path}: {reason}") from None
    except (KeyError, TypeError, ValueError, AttributeError) as reason:
        raise _file_error(path, reason) from None
    if not survivors:
        tried = enumeration(entries, BAR)
        raise InputError(f"none of the networks of {path} explains its data ({tried}): try others")
    chosen = next((s.network for s in survivors if s.network.name == plain["selected"]), None)
    survivors = tuple(_with_containment(s, chosen) for s in survivors)
    return tuple(sorted(survivors, key=lambda s: (s.network != chosen, bool(s.contains))))


def _with_containment(survivor: LeftNetwork, selected: Network | None) -> LeftNetwork:
    """The network, which contains the selected one even where the file does not state it."""
    if selected is None or survivor.contains or not contains(survivor.network, selected):
        return survivor
    return replace(survivor, contains=selected.name)


def _file_error(path: Path, reason: Exception) -> InputError:
    return InputError(f"{path} is not a complete fit file: {reason} is missing or wrong; fit again")
