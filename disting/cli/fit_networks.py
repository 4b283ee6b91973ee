"""disting fit --models: networks fitted to a measured response: circuits to an impedance."""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import isfinite
from pathlib import Path

from disting.cli.fit_data import data
from disting.cli.output import complain, emit, keep_apart
from disting.cli.verdicts import listed_models
from disting.cli.workers import engine_for
from disting.errors import InputError, enumeration
from disting.files import json_text
from disting.fit.networks import fit_networks
from disting.fit.results.networks import BAR, FittedNetwork, NetworkSelection
from disting.measurement import FrequencyResponse
from disting.measurement.impedance import TURNED, as_impedance
from disting.measurement.look_text import short_lines
from disting.model.chain import Sensor
from disting.model.structure import Sort
from disting.network.families import FAMILIES
from disting.network.network import Network
from disting.network.notation import network_of

UNITS = {
    "R": "ohm",
    "L": "H",
    "C": "F",
    "W": "ohm/sqrt(s)",
    "P": "s^n/ohm",
}  # of an impedance in ohm
UNKNOWN = {
    "--test", "--experiment", "--sensor", "--masses", "--actuator", "--gap", "--family", "--left",
    "--base",
    "--damped", "--undamped", "--fix", "--bound", "--weights", "--rule", "--thresholds", "--case",
    "--optimiser", "--no-prune", "--controller", "--out", "--site", "--profiles", "--demo",
}  # fmt: skip


def run(options: argparse.Namespace) -> int:
    """Fit networks, print what explains the data."""
    foreign = sorted({word.partition("=")[0] for word in options.words} & UNKNOWN)
    if foreign:
        raise InputError(f"of networks --models knows no {enumeration(foreign)}: leave them away")
    networks = _networks(options.models, options.notation)
    keep_apart(network.name for network in networks)
    measured = _measured(options, networks)
    first = measured[0]
    with engine_for(options) as (engine, _, progress):
        selection = fit_networks(measured, networks, engine=engine, progress=progress)
    if options.json:
        emit(options.json, json_text(selection.to_dict(), indent=1) + "\n")
    if options.json != "-":
        print("\n".join(_told(selection, first)))
    return 0 if selection.left else 1


def _networks(texts: Sequence[str], notation: str) -> list[Network]:
    """Those of texts, of files of models, of families; raises InputError."""
    networks = list[Network]()
    for text in texts:
        if text in FAMILIES or text.endswith(".json"):
            models = listed_models(Path(text) if text.endswith(".json") else text)
            unknown = [m.name for m in models if m.network is None]
            if unknown:
                raise InputError(f"{unknown[0]} is no network: describe it by its elements")
            networks += [replace(m.network, name=m.name) for m in models if m.network is not None]
        else:
            networks.append(network_of(text, notation))
    names = [network.name for network in networks]
    doubled = sorted({name for name in names if names.count(name) > 1})
    if doubled:
        raise InputError(f"{doubled[0]} is named twice")
    return networks


def _measured(options: argparse.Namespace, networks: Sequence[Network]) -> list[FrequencyResponse]:
    """The responses of all sensors to all inputs, row by row; of circuits impedances."""
    outputs, inputs = networks[0].shape
    options.sensor = ",".join(str(k) for k in range(1, outputs * inputs + 1))
    circuits = {network.sort is Sort.CIRCUIT for network in networks}
    if len(circuits) > 1:
        raise InputError("circuits show an impedance, machines a motion: fit them apart")
    is_circuit = circuits == {True}
    if is_circuit:
        options.quantity = options.quantity or Sensor.POSITION.value  # an impedance has none
    read = data(options)
    responses = [read.train, *(further.measured for further in read.further)]
    if not is_circuit:
        return responses
    turned = [as_impedance(response) for response in responses]
    if any(TURNED in response.notes for response in turned):
        complain(TURNED)
    return turned


def _told(selection: NetworkSelection, measured: FrequencyResponse) -> Iterator[str]:
    """The answer, then a line a network, then values."""
    is_circuit = selection.fits[0].network.sort is Sort.CIRCUIT
    yield from short_lines(measured, "impedance" if is_circuit else "")
    scatter = selection.scatter
    yield f"scatter of a line: {100 * scatter.typical:.2g} %, from {scatter.source}"
    yield ""
    yield selection.sentence
    yield ""
    width = max(len(f.network.name) for f in selection.fits)
    yield f"{'network':{width}}  values  determined  chi2 per line"
    for f in selection.fits:
        said = _standing(f)
        yield f"{f.network.name:{width}}  {len(f.values):6}  {f.rank:10}  {f.chi2:8.3g}  {said}"
    best = selection.fits[0]
    yield ""
    yield f"{best.network.name}:"
    units = UNITS if best.network.sort is Sort.CIRCUIT else {}
    width = max((len(units.get(name[0], "")) for name in best.values), default=0)
    width += bool(width)
    for name, value in best.values.items():
        spread = best.relative[name]
        error = f"+- {100 * spread:.2g} %" if isfinite(spread) and spread < 1 else "not determined"
        yield f"  {name:6} {value:<12.5g} {units.get(name[0], ''):{width}}{error}"
    if not best.explains:
        yield from (f"it misses the data at {miss.sentence}" for miss in best.misses)


def _standing(f: FittedNetwork) -> str:
    same = f"; never told from {enumeration(f.same, BAR)}" if f.same else ""
    if not f.explains:
        return f"does not explain the data{same}"
    if f.contains:
        return f"contains {f.contains}{same}"
    return (f"excluded by {f.excluded_by}" if f.excluded_by else "not excluded") + same
