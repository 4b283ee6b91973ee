"""disting simulate: what a bench would measure on a model with known parameters."""

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from disting.cli.arguments import (
    add_damped,
    add_notation,
    add_old_option,
    add_quantity,
    quantity_word,
    refuse,
)
from disting.cli.output import emit, written_file
from disting.errors import InputError, short
from disting.model.chain import Chain, Quantity, Sort
from disting.network.network import Network

if TYPE_CHECKING:
    from disting.measurement import TimeSeries
    from disting.simulation import Bench, Excitation

KINDS = ("schroeder", "random-phase", "chirp")
QUANTITIES = [s.value for s in Quantity]


NUMBERS = (
    ("low", 10.0, "lowest excited frequency [Hz]"),
    ("high", 250.0, "highest excited frequency [Hz]"),
    ("rms", 1.0, "root mean square of the input"),
    ("sampling-rate", 2500.0, "sampling rate [Hz]"),
    ("input-noise", 0.0, "standard deviation of noise on the recorded input"),
    ("output-noise", 0.0, "standard deviation of noise on the recorded output"),
    ("quantum", 0.0, "step of the sensor"),
)
COUNTS = (
    ("samples", 2500, "samples of a period"),
    ("periods", 20, "periods"),
    ("seed", 0, "seed of noise and phases"),
)


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    _drive(p)
    _bench(p)
    p.add_argument(
        "--csv",
        type=written_file,
        metavar="FILE",
        default="-",
        help="file for the response (default: standard output); of several responses, the one of"
        " sensor 1 and input 2 is written to FILE-1-2",
    )
    add_damped(p)
    add_notation(p)


def _drive(p: argparse.ArgumentParser) -> None:
    """The model, its parameters, and the observed quantities."""
    text = (
        "masses:number of a model, as 'disting models' lists it; +b2: damper from mass 2 to the"
        " ground; +lag; +delay; or a network such as 'R0-p(R1,C1)' or '1=2, 2=3, 2=4; F1; S4',"
        " or one of a file, as FILE.json:NAME"
    )
    p.add_argument(
        "model", nargs="?", metavar="N:I|NETWORK", help=f"{text} (default: a small two-mass drive)"
    )
    text = (
        "values of all parameters of the model, such as m1=0.01,k12=500; for a circuit they may"
        " be given in braces, such as R{R=20}"
    )
    p.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE,...", dest="values", help=text
    )
    add_quantity(p, Quantity.POSITION)
    p.set_defaults(quantity=None)
    text = "quantity in the response that is written (default: acceleration)"
    p.add_argument("--response", type=quantity_word, choices=QUANTITIES, help=text)
    refuse(p, "--to", "the quantity of the response is --response, such as --response position")


def _bench(p: argparse.ArgumentParser) -> None:
    """Excitation, record, noise, friction."""
    text = "test signal (default: a Schroeder multisine)"
    p.add_argument("--excitation", choices=KINDS, default="schroeder", help=text)
    text = (
        "CSV with the columns frequency_hz and amplitude, as 'disting plan' writes it: the lines of"
        " the multisine, instead of --low and --high"
    )
    p.add_argument("--spectrum", type=Path, metavar="FILE", help=text)
    for name, value, text in NUMBERS:
        text = f"{text} (default: {value:g})"
        p.add_argument(f"--{name}", type=float, default=value, metavar="X", help=text)
    add_old_option(p, "--rate", "--sampling-rate", float)
    for name, count, text in COUNTS:
        text = f"{text} (default: {count})"
        p.add_argument(f"--{name}", type=int, default=count, metavar="K", help=text)
    text = "Coulomb friction of a mass or node, such as 1=0.3; may be repeated (default: none)"
    p.add_argument(
        "--friction", type=_friction, action="append", default=[], metavar="MASS=FORCE", help=text
    )


def run(options: argparse.Namespace) -> int:
    """Simulate, estimate the response, write it."""
    from disting.measurement import csv_text
    from disting.measurement.impedance import as_impedance
    from disting.simulation import Bench, Excitation, Friction
    from disting.simulation.bench import read_spectrum

    model, values = _model(options)
    quantity = _response(model, options)
    spectrum = read_spectrum(options.spectrum) if options.spectrum else ()
    excitation = Excitation(
        options.excitation, options.low, options.high, options.rms, spectrum=spectrum
    )
    bench = Bench(
        sampling_rate=options.sampling_rate,
        samples=options.samples,
        periods=options.periods,
        input_noise=options.input_noise,
        output_noise=options.output_noise,
        quantum=options.quantum,
        friction={mass: Friction(coulomb=force) for mass, force in options.friction},
        seed=options.seed,
    )
    rate = options.sampling_rate
    lines = excitation.lines(options.samples, rate) * rate / options.samples
    for name, series in _records(model, values, excitation, bench, options.csv):
        response = series.response(
            quantity, period=options.samples, lines=lines if spectrum else None
        )
        is_circuit = model.sort is Sort.CIRCUIT
        emit(name, csv_text(as_impedance(response) if is_circuit else response))
        if name != "-":
            low, high = response.frequency[0], response.frequency[-1]
            print(f"{len(response)} lines from {low:g} to {high:g} Hz in {name}")
    return 0


def _records(
    model: Chain | Network,
    values: dict[str, float],
    excitation: "Excitation",
    bench: "Bench",
    name: str,
) -> Iterator[tuple[str, "TimeSeries"]]:
    """Yield the records with the files of their responses: of several FILE-1-2.csv that of the
    first sensor and the second input.
    """
    from disting.simulation import simulate, simulate_all

    if isinstance(model, Chain) or model.shape == (1, 1):
        yield name, simulate(model, values, excitation, bench)
        return
    if name == "-":
        raise InputError(
            f"{model.name} has {' x '.join(map(str, model.shape))} outputs and inputs: give a"
            f" file for the responses, such as --csv frf.csv for frf-1-1.csv, .."
        )
    path = Path(name)
    for i, row in enumerate(simulate_all(model, values, excitation, bench), 1):
        for j, series in enumerate(row, 1):
            yield str(path.with_stem(f"{path.stem}-{i}-{j}")), series


def _model(options: argparse.Namespace) -> tuple[Chain | Network, dict[str, float]]:
    """The model and its parameters; of the demonstration drive if none is named."""
    from disting.cli.model_names import structures, values_of
    from disting.simulation import DEMO_MODEL, DEMO_PARAMETERS

    if options.model is None:
        if options.values or options.damped is not None or options.notation:
            raise InputError("--set needs a model, such as 2:1")
        return DEMO_MODEL, {**DEMO_PARAMETERS}
    (model,) = structures([options.model], options, Quantity(options.quantity or Quantity.POSITION))
    return model, values_of(model, options.model, options)


def _response(model: Chain | Network, options: argparse.Namespace) -> str:
    """The quantity of the response: of a circuit or compartments there is none to choose, and what
    they show counts as a position.
    """
    if model.sort is Sort.MACHINE:
        return str(options.response or Quantity.ACCELERATION)
    for name in ("quantity", "response"):
        if getattr(options, name):
            raise InputError(f"--{name} is supported for machines only; remove it")
    return str(Quantity.POSITION)


def _friction(text: str) -> tuple[int, float]:
    mass, _, force = text.partition("=")
    try:
        return int(mass), float(force)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"friction is written like 1=0.3, not {short(text)}"
        ) from None
