"""What the file of a fit of networks names: the selected network, its rivals, and those that give
the same responses.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from disting.errors import InputError, listed
from disting.files import read_json
from disting.fit.plan.fit_file import MOST_COUNTED, Values
from disting.fit.results.model_file import FIT_FILE, number_of
from disting.fit.results.networks import BAR
from disting.network.network import Network
from disting.network.notation.entries import network_of_entry
from disting.schemas import Format

REASON = "the same responses for all positive values"


@dataclass(frozen=True, slots=True)
class LeftNetwork:
    """A network that the data do not exclude, with its fitted values, and those that give the
    `same` responses.
    """

    network: Network
    values: Values
    same: tuple[Network, ...]


@dataclass(frozen=True, slots=True)
class NamedNetworks:
    """What a plan needs: the selected network (`model`) with its values, `rivals` with theirs, the
    `same` by name with the reason; the typical `scatter` of the `lines` from `low` to `high` [Hz].
    """

    model: Network
    values: Values
    rivals: dict[Network, Values]
    same: dict[str, str]
    scatter: float
    low: float
    high: float
    lines: int
    explained: bool = True


def is_of_networks(path: Path) -> bool:
    """Whether a JSON file is that of a fit of networks; raises InputError."""
    plain = read_json(path, FIT_FILE)
    return isinstance(plain, dict) and plain.get("format") == Format.NETWORK_FIT


def left_by(path: Path) -> tuple[LeftNetwork, ...]:
    """The networks that a fit leaves, the selected one first; raises InputError."""
    return _left(_read(path), path)


def networks_named_by(path: Path) -> NamedNetworks:
    """What the file names; raises InputError where no network explains the data."""
    plain = _read(path)
    first, *others = _left(plain, path)
    try:
        lines = plain["frequencies"]
        return NamedNetworks(
            model=first.network,
            values=first.values,
            rivals={one.network: one.values for one in others},
            same={network.name: REASON for network in first.same},
            scatter=number_of(plain["scatter"], 0.0),
            low=number_of(lines["low"], 0.0),
            high=number_of(lines["high"], 0.0),
            lines=int(number_of(lines["lines"], 0, MOST_COUNTED)),
        )
    except (KeyError, TypeError, ValueError) as reason:
        raise _broken(path, reason) from None


def _read(path: Path) -> Mapping[str, Any]:
    plain = read_json(path, FIT_FILE)
    if not isinstance(plain, dict):
        raise InputError(f"{path} holds no networks: name {FIT_FILE}")
    return plain


def _left(plain: Mapping[str, Any], path: Path) -> tuple[LeftNetwork, ...]:
    try:
        entries = {str(entry["name"]): entry for entry in plain["networks"]}
        known = {name: network_of_entry(entry, name) for name, entry in entries.items()}
        found = tuple(
            LeftNetwork(
                known[fit["name"]],
                {name: number_of(fit["values"][name]) for name in fit["values"]},
                tuple(known[name] for name in fit["same"]),
            )
            for fit in plain["fits"]
            if fit["explains"] and not fit["excluded_by"]
        )
    except (KeyError, TypeError, ValueError, AttributeError) as reason:
        raise _broken(path, reason) from None
    if not found:
        tried = listed(entries, BAR)
        raise InputError(f"none of the networks of {path} explains its data ({tried}): try others")
    return tuple(sorted(found, key=lambda one: one.network.name != plain["selected"]))


def _broken(path: Path, reason: Exception) -> InputError:
    return InputError(f"{path} is no whole file of a fit: {reason} is missing or wrong; fit again")
