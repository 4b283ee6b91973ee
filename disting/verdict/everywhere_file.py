"""Verdicts under experiments whose places in the right model are not known, as one file: a verdict
for every way to place them, each a whole file of its own.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from disting.errors import DistingError, InputError, shown
from disting.experiments import Experiment, Named
from disting.files import __version__
from disting.model.chain import Chain, Sensor
from disting.model.names import chains_named
from disting.schemas import Format
from disting.verdict.engine import Engine
from disting.verdict.everywhere import Everywhere, named_all, placements
from disting.verdict.query import Query
from disting.verdict.verdict_file import (
    DAMAGED,
    MOST_EXPERIMENTS,
    VERSION,
    Stored,
    plain_experiment,
    read_experiment,
    read_file,
    same_plain,
    verdict_file,
)

FORMAT = Format.EVERYWHERE.value
COMMON = ("models", "query", "settings")


def everywhere_file(
    left: Chain | str,
    right: Chain | str,
    also: Sequence[str | Experiment],
    *,
    damped: bool | None = None,
    sensor: Sensor | str | None = None,
    query: Query | None = None,
    engine: Engine | None = None,
) -> dict[str, Any]:
    """The verdicts of `compare_everywhere` as plain data, ready for JSON, which `verify` checks
    alone.

    >>> data = everywhere_file("3:1", "3:11", ["sensor=2"], damped=True)
    >>> data["answer"], [one["places"] for one in data["verdicts"]]
    ('surely', [{'2': 1}, {'2': 2}, {'2': 3}])
    """
    a, b = chains_named([left, right], damped=damped, sensor=sensor)
    asked, engine = named_all(also), engine or Engine()
    files = [
        {"places": {str(here): there for here, there in way}}
        | verdict_file(a, b, experiments=pairs, query=query, engine=engine)
        for way, pairs in placements(a, b, asked)
    ]
    return _whole(asked, files)


def read_everywhere(data: Mapping[str, Any]) -> tuple[Stored, ...]:
    """All verdicts of such a file; raises InputError for what is damaged."""
    try:
        return tuple(read_file(one, ("places",)) for one in data["verdicts"])
    except DAMAGED as reason:
        raise InputError(f"the file of the verdicts is damaged ({reason})") from None


def differing_everywhere(data: Mapping[str, Any], stored: Sequence[Stored]) -> str:
    """What such a file tells otherwise than what it tells follows from; "" if nothing.

    All verdicts are on the same chains, asked in the same way, and there is one for every way to
    place the experiments.
    """
    try:
        asked = [_named(one) for one in data["also"][: MOST_EXPERIMENTS + 1]]
        a, b = stored[0].models
        if len(asked) > MOST_EXPERIMENTS or not (isinstance(a, Chain) and isinstance(b, Chain)):
            return "also"
        ways = list(placements(a, b, asked))
    except (*DAMAGED, DistingError) as reason:
        return f"the experiments: {reason}"
    files = data["verdicts"]
    for name in COMMON:
        if any(not same_plain(one[name], files[0][name]) for one in files):
            return name
    if [one.experiments for one in stored] != [pairs for _, pairs in ways]:
        return "the ways to place the experiments"
    places = [{str(here): there for here, there in way} for way, _ in ways]
    if [one["places"] for one in files] != places:
        return "places"
    again = _whole(asked, files)
    if not VERSION.fullmatch(str(data.get("program"))):
        return "program"
    unknown = [name for name in data if name not in again]
    if unknown:
        return f"{shown(unknown[0])} is no key of it"
    kept = [name for name in again if name not in ("program", "verdicts")]
    return next((name for name in kept if not same_plain(data.get(name), again[name])), "")


def _whole(asked: Sequence[Named], files: Sequence[dict[str, Any]]) -> dict[str, Any]:
    found = Everywhere(tuple(((), read_file(one, ("places",)).verdict) for one in files))
    return {
        "format": FORMAT,
        "program": __version__,
        "answer": found.answer.value,
        "experiments": ["as it is", *dict.fromkeys(one.experiment.text for one in asked)],
        "also": [
            {"experiment": plain_experiment(one.experiment), "places": list(map(list, one.places))}
            for one in asked
        ],
        "verdicts": list(files),
    }


def _named(data: Mapping[str, Any]) -> Named:
    places = tuple((int(here), int(there)) for here, there in data["places"])
    return Named(read_experiment(data["experiment"]), places)
