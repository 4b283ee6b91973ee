"""disting fit --models: networks fitted to a measured response: circuits to an impedance, machines
to a motion; with --masses chains compete in the same list.
"""

import argparse
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from disting.cli.arguments import is_damped
from disting.cli.fit_data import data, sensors
from disting.cli.output import complain, emit, keep_apart
from disting.cli.verdicts import listed_models
from disting.cli.workers import engine_for
from disting.errors import InputError, enumeration
from disting.files import json_text
from disting.fit.networks import fit_networks
from disting.fit.results.networks import BAR, NetworkSelection
from disting.fit.search.candidates import candidates
from disting.fit.search.machines import as_machine, each_once, with_ground_damper
from disting.measurement import FrequencyResponse
from disting.measurement.impedance import TURNED, as_impedance
from disting.measurement.look_text import short_lines
from disting.model.chain import Quantity, Sort
from disting.network.network import Network
from disting.network.notation import network_of, notations_of
from disting.network.notation.member import FAMILY
from disting.report.fit.network_words import standing, value_lines

UNKNOWN = {
    "--test", "--experiment", "--family", "--left", "--fix", "--bound", "--weights", "--rule",
    "--thresholds", "--case", "--optimiser", "--no-prune", "--controller", "--site", "--profiles",
    "--demo",
}  # fmt: skip
OF_CHAINS = {"--sensor", "--actuator", "--gap", "--base", "--damped", "--undamped"}


def run(options: argparse.Namespace) -> int:
    """Fit networks, print what explains the data."""
    named = {word.partition("=")[0] for word in options.words}
    _refuse(named)
    options.models, files = _without_data_files(options.models)
    options.train = [*options.train, *files]
    networks = _networks(options.models, options.notation)
    if "--masses" in named:
        networks = _beside_chains(networks, options)
    elif options.ground_damper:
        networks = each_once(with_ground_damper(networks))
    keep_apart(network.name for network in networks)
    measured = _read_responses(options, networks)
    first = measured[0]
    with engine_for(options) as (engine, _, progress):
        selection = fit_networks(measured, networks, engine=engine, progress=progress)
    if options.json:
        emit(options.json, json_text(selection.to_dict(), indent=1) + "\n")
    if options.json != "-":
        print("\n".join(_describe(selection, first)))
    if options.out:
        from disting.report.fit.network_page import write_network_report

        write_network_report(selection, options.out)
        if options.json != "-":
            print(f"\nwritten to {options.out}; open {options.out / 'fit.html'}")
    return 0 if selection.left else 1


def _refuse(named: Collection[str]) -> None:
    """Raise InputError for options that a fit of networks has not."""
    foreign = sorted(UNKNOWN & {*named})
    if foreign:
        verb = "are" if len(foreign) > 1 else "is"
        raise InputError(f"{enumeration(foreign)} {verb} not supported with --models; remove it")
    of_chains = sorted(OF_CHAINS & {*named})
    if of_chains and "--masses" not in named:
        raise InputError(
            f"{enumeration(of_chains)} with --models: name the chains that compete too by their"
            " number of masses, as --masses 1-3"
        )


def _beside_chains(networks: Sequence[Network], options: argparse.Namespace) -> list[Network]:
    """Chains as machines, then the networks that are none of them; raises InputError."""
    if any(n.sort is not Sort.MACHINE or n.shape != (1, 1) for n in networks):
        raise InputError(
            "--masses adds chains; it is supported with machines of one force and one sensor,"
            " not with circuits, compartments or several responses"
        )
    if len(sensors(options)) > 1:
        raise InputError("chains and networks are compared by one response: name one --sensor")
    chains = candidates(
        options.masses,
        actuator=options.actuator,
        sensor=options.sensor,
        gap=options.gap,
        base=options.base,
        damped=is_damped(options),
    )
    bare = [c for c in chains if not (c.ground_dampers or c.lag or c.dead_time or c.gap_damper)]
    machines = [as_machine(chain) for chain in bare]
    whole = [*machines, *networks]
    return each_once(with_ground_damper(whole) if options.ground_damper else whole)


def _without_data_files(texts: Sequence[str]) -> tuple[list[str], list[Path]]:
    """Return the networks, and the files of data behind them: --models takes all words up to the
    next option.
    """
    files = [t for t in texts if not _is_models(t) and not notations_of(t) and Path(t).is_file()]
    return [text for text in texts if text not in files], [Path(file) for file in files]


def _is_models(text: str) -> bool:
    """Return True for a file of models and for a family."""
    return text.endswith(".json") or bool(FAMILY.fullmatch(text) and not Path(text).is_file())


def _networks(texts: Sequence[str], notation: str) -> list[Network]:
    """Those of texts, of files of models, of families; raises InputError."""
    networks = list[Network]()
    for text in texts:
        if _is_models(text):
            models = listed_models(Path(text) if text.endswith(".json") else text)
            unknown = [m.name for m in models if m.network is None]
            if unknown:
                raise InputError(f"{unknown[0]} is not a network: describe it by its elements")
            networks += [replace(m.network, name=m.name) for m in models if m.network is not None]
        else:
            networks.append(network_of(text, notation))
    names = [network.name for network in networks]
    doubled = sorted({name for name in names if names.count(name) > 1})
    if doubled:
        raise InputError(f"{doubled[0]} is named twice")
    return networks


def _read_responses(
    options: argparse.Namespace, networks: Sequence[Network]
) -> list[FrequencyResponse]:
    """The responses of all sensors to all inputs, row by row; of circuits impedances."""
    outputs, inputs = networks[0].shape
    options.sensor = ",".join(str(k) for k in range(1, outputs * inputs + 1))
    circuits = {network.sort is Sort.CIRCUIT for network in networks}
    if len(circuits) > 1:
        raise InputError("circuits show an impedance, machines a motion: fit them separately")
    is_circuit = circuits == {True}
    if is_circuit:
        options.quantity = options.quantity or Quantity.POSITION.value  # an impedance has none
    read = data(options)
    responses = [read.train, *(further.measured for further in read.further)]
    if not is_circuit:
        return responses
    turned = [as_impedance(response) for response in responses]
    if any(TURNED in response.notes for response in turned):
        complain(TURNED)
    return turned


def _describe(selection: NetworkSelection, measured: FrequencyResponse) -> Iterator[str]:
    """The answer, then a line a network, then values."""
    is_circuit = selection.fits[0].network.sort is Sort.CIRCUIT
    yield from short_lines(measured, "impedance" if is_circuit else "")
    scatter = selection.scatter
    yield f"scatter of a line: {100 * scatter.typical:.2g} %, from {scatter.source}"
    yield ""
    yield from selection.warnings
    yield selection.sentence
    yield ""
    width = max(len(f.network.name) for f in selection.fits)
    yield f"{'network':{width}}  values  determined  chi2 per line"
    for f in selection.fits:
        same = f"; always has the same response as {enumeration(f.same, BAR)}" if f.same else ""
        numbers = f"{len(f.values):6}  {f.rank:10}  {f.chi2:8.3g}"
        yield f"{f.network.name:{width}}  {numbers}  {standing(f)}{same}"
    best = selection.fits[0]
    for f in selection.left or [best]:
        yield ""
        yield from value_lines(f)
    if not best.explains:
        yield from (f"it misses the data at {miss.sentence}" for miss in best.misses)
