"""Arguments of disting fit; nothing here loads numerical libraries."""

import argparse
from pathlib import Path

from disting.cli.arguments import (
    add_damped,
    add_json,
    add_notation,
    add_work,
    frequency_range,
    quantity_word,
)
from disting.cli.fit_values import (
    bound,
    known_value,
    masses,
    reader_option,
    signs,
    site_folder,
    thresholds,
    unit_of,
)
from disting.cli.output import written_folder
from disting.model.chain import Quantity

WEIGHTS = ("auto", "none", "std", "coherence")
RULES = ("not-excluded", "paper")
THRESHOLDS = (30.0, 1000.0, 20.0)

BRIEF = """\
usage: disting fit TRAIN [--test TEST] [options]

The structures that explain a measured frequency response.

what was measured
  TRAIN                   a frequency response, or force and motion in time
  --test TEST             an independent measurement of the same machine
  --demo                  simulated data of a small drive instead of files
  --sensor 1,2            masses that the sensors show (default: 1)
  --actuator 2            mass that the force acts on (default: 1)
  --experiment F:lock=2   another file of the machine, with a mass locked
  --quantity velocity     what the sensor shows (default: acceleration)
  --unit output=deg       a unit that the file does not state
  --column HEADER         which of several responses in the file
  --torque-constant K     Nm per A, where the input is a current
  --band 10..200          use only these frequencies, in Hz
  --hold 125e-6           time for which a digital drive holds its input, in s

candidates
  --masses 1-3            how many masses (default: 1-4); fewer are faster
  --undamped              springs without dampers beside them
  --base                  also on an elastic base, with the encoder fixed to it
  --fix m1=0.02           a known parameter; --bound k12=0..500 is its range
  --models NETWORK        circuits, compartments or branched machines instead;
                          with --masses 1-3 beside it, both compete

results
  --out DIR               a page with figures, tables and a .mat file
  --json FILE             the result for programs; 'disting next FILE' reads it
  --controller P=2,I=30   stability margins of this controller

--help-all shows all options. 'disting report 3' writes the guide: file formats,
units and signs, how to read the answer.
"""


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    data = p.add_argument_group("data")
    _responses(data)
    _reading(data)
    _quantities(data)
    _add_line_options(data)
    candidates = p.add_argument_group("candidates")
    _structures(candidates)
    add_damped(p)
    _add_knowledge_options(candidates)
    _choices(p.add_argument_group("cost and selection"))
    _control(p.add_argument_group("what it is for"))
    _output(p.add_argument_group("output"))
    add_work(p, jobs=(0, "one for each core if there are many candidates"))


def add_look_arguments(p: argparse.ArgumentParser) -> None:
    """Arguments of `disting look`: those by which a fit reads files."""
    p.add_argument(
        "train",
        nargs="*",
        type=Path,
        metavar="FILE",
        help="measured frequency response, or force and motion in time; several may be given",
    )
    p.set_defaults(test=[])
    data = p.add_argument_group("data")
    text = "places of the sensors, as in a fit: 1,2 shows two responses (default: 1)"
    data.add_argument("--sensor", default="1", metavar="PORT", help=text)
    text = "another response of the same machine, as in a fit; may be repeated"
    data.add_argument("--experiment", action="append", default=[], metavar="FILE:CHANGE", help=text)
    data.add_argument(
        "--demo", action="store_true", help="simulated data of a small drive instead of a file"
    )
    _reading(data)
    quantities = p.add_argument_group("quantities")
    _quantities(quantities)
    _add_line_options(quantities)
    group = p.add_argument_group("output")
    group.add_argument(
        "--out", type=written_folder, metavar="DIR", help="write a page with figures and JSON there"
    )
    add_json(group, "what was read")


def _responses(group: argparse._ArgumentGroup) -> None:
    """Measured responses of the drive, which are fitted together or tested against."""
    group.add_argument(
        "train",
        nargs="*",
        type=Path,
        metavar="TRAIN",
        help="measured frequency response, or time series; several: one for each --sensor",
    )
    text = "independent data of the drive, likewise; may be repeated (default: cross-validation)"
    group.add_argument("--test", type=Path, action="append", default=[], metavar="TEST", help=text)
    text = (
        "another response of the same machine, fitted together: FILE:lock=2 (mass 2 does not"
        " move), FILE:inertia=1:0.5, FILE:brake=1:0.5 or FILE:spring=1:0.5 (a known inertia, damper"
        " or spring to the ground added), FILE:sensor=3, FILE:force=2; may be repeated"
    )
    group.add_argument(
        "--experiment", action="append", default=[], metavar="FILE:CHANGE", help=text
    )
    text = "of several responses: one for all, or one for each (default: shared)"
    group.add_argument("--dead-time", choices=("shared", "own"), default="shared", help=text)
    group.add_argument(
        "--demo", action="store_true", help="simulated data of a small drive instead of files"
    )


def _reading(group: argparse._ArgumentGroup) -> None:
    """Add the options that select the columns and responses to read."""
    text = (
        "any column of the response, by header or number (default: the first response); a column"
        " without a partner is read as gain; all: the columns are repeats of one response"
    )
    group.add_argument("--column", metavar="HEADER", help=text)
    text = (
        "option of the reader, such as input=iq, output=angle, sampling_rate=2500, to=acceleration;"
        " may be repeated"
    )
    group.add_argument(
        "--read", type=reader_option, action="append", default=[], metavar="NAME=VALUE", help=text
    )
    text = "the same response measured again; mean and scatter of all are taken; may be repeated"
    group.add_argument(
        "--repeat", type=Path, action="append", default=[], metavar="FILE", help=text
    )
    text = (
        "outliers among three or more repeats or periods: named in any case; drop removes them"
        " from the mean (default: keep)"
    )
    group.add_argument("--outliers", choices=("keep", "drop"), default="keep", help=text)


def _quantities(group: argparse._ArgumentGroup) -> None:
    """Add the options that give the meaning and units of the numbers in the files."""
    text = (
        "what the sensor shows (default: as stated in the file, else acceleration; for a record"
        " in time position)"
    )
    group.add_argument(
        "--quantity", type=quantity_word, choices=[s.value for s in Quantity], help=text
    )
    text = (
        "unit of frequency, phase, magnitude, input or output, such as frequency=rad/s,"
        " magnitude=dB, input=A, output=deg;"
        " may be repeated"
    )
    group.add_argument(
        "--unit", type=unit_of, action="append", default=[], metavar="NAME=UNIT", help=text
    )
    group.add_argument(
        "--scale",
        type=float,
        metavar="X",
        help="multiply the response by X, such as the gain of the sensor",
    )
    text = (
        "torque per current [Nm/A], or force per current [N/A] where the output is in m: results in"
        " SI units"
    )
    group.add_argument("--torque-constant", type=float, metavar="K", help=text)
    text = (
        "time for which a digital drive holds its input, in s, such as 125e-6; record: the sampling"
        " time of a record (default: the input is not held)"
    )
    group.add_argument("--hold", metavar="T", help=text)
    text = (
        "sign of the sensor: +, - or auto (the one that fits better); for several sensors"
        " --sign=+,- (default: +)"
    )
    group.add_argument("--sign", type=signs, default="+", metavar="SIGN", help=text)


def _add_line_options(group: argparse._ArgumentGroup) -> None:
    """Add the options that select the lines of the files to use."""
    group.add_argument(
        "--band", type=frequency_range, metavar="LOW..HIGH", help="use only these frequencies [Hz]"
    )
    group.add_argument(
        "--lines",
        type=int,
        metavar="N",
        help="use only so many lines, evenly spaced on a logarithmic scale",
    )


def _structures(group: argparse._ArgumentGroup) -> None:
    """Add the options that select the structures to fit."""
    text = (
        "networks instead of chains: a text such as 'R0-p(R1,C1)' or '1=2, 2=3, 2=4; F1; S4', a"
        " file of models, or a family such as cells-4; several at once, and may be repeated; with"
        " --masses 1-3 beside it machines and chains compete"
    )
    group.add_argument(
        "--models", action="extend", nargs="+", default=[], metavar="NETWORK", help=text
    )
    text = (
        "with --models: each machine also with a damper from the mass with the force to the ground"
    )
    group.add_argument("--ground-damper", action="store_true", help=text)
    add_notation(group)
    group.add_argument(
        "--masses",
        type=masses,
        default=(1, 2, 3, 4),
        metavar="N",
        help="3, 1-4 or 1,3 (default: 1-4)",
    )
    _ports(group)
    text = (
        "fit only the structures that an earlier fit left, and their equivalents; places of"
        " further responses are masses of the structure that it selected, every place of the"
        " others is tried"
    )
    group.add_argument("--left", type=Path, metavar="FIT.json", help=text)
    group.add_argument(
        "--family",
        action="store_true",
        help="force, sensor and gap anywhere: every chain of these sizes",
    )
    text = (
        "also each chain on an elastic base, which is one more mass; force and encoder are"
        " between base and drive; without and with friction of the motor's bearings"
    )
    group.add_argument("--base", action="store_true", help=text)


def _ports(group: argparse._ArgumentGroup) -> None:
    """Where the force acts, what the sensor shows, and where a spring is missing."""
    group.add_argument(
        "--actuator",
        default="1",
        metavar="PORT",
        help="mass with the force: 2, last, or 1:3 (default: 1)",
    )
    group.add_argument(
        "--sensor",
        default="1",
        metavar="PORT",
        help="mass that the sensor shows; 1,2: two responses, fitted together (default: 1)",
    )
    group.add_argument(
        "--gap",
        type=int,
        default=0,
        metavar="I",
        help="no spring right of mass I (default: 0, the ground)",
    )


def _add_knowledge_options(group: argparse._ArgumentGroup) -> None:
    """Add the options for known parameters and verdicts."""
    group.add_argument(
        "--fix",
        type=known_value,
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="a known parameter; a damper may be 0",
    )
    text = "range of a parameter; may be repeated"
    group.add_argument(
        "--bound", type=bound, action="append", default=[], metavar="NAME=LOW..HIGH", help=text
    )
    group.add_argument(
        "--no-prune", action="store_true", help="fit indistinguishable candidates separately"
    )


def _choices(group: argparse._ArgumentGroup) -> None:
    """Add the options for the objective and for admissible results."""
    group.add_argument(
        "--case",
        type=int,
        choices=[1, 2, 3],
        help="cost function of the paper (default: likelihood from the scatter of the lines)",
    )
    text = (
        "of the frequency lines; auto: by the scatter of each, if known; none: all equal"
        " (default: auto)"
    )
    group.add_argument("--weights", choices=WEIGHTS, default="auto", help=text)
    text = "largest condition index, PII ratio and collinearity index (default: 30,1000,20)"
    group.add_argument(
        "--thresholds", type=thresholds, default=THRESHOLDS, metavar="C,P,G", help=text
    )
    text = (
        "what may be selected: structures that the data do not exclude, or only those of them"
        " that meet the paper's three criteria (default: not-excluded)"
    )
    group.add_argument("--rule", choices=RULES, default=RULES[0], help=text)
    text = (
        "how parameters are found; swarm is the paper's way, for comparison, and takes hours"
        " (default: starts)"
    )
    group.add_argument("--optimiser", choices=("starts", "swarm"), default="starts", help=text)
    group.add_argument("--seed", default="disting", help="seed of the random starts")


def _control(group: argparse._ArgumentGroup) -> None:
    """Add the options for the intended use of the model."""
    text = (
        "a controller around the sensor, such as P=2,I=30,D=0.01,Tf=0.001,loop=velocity (position,"
        " acceleration; cascade with a position gain V=20), or a JSON file with these names: its"
        " margins over all structures that are left"
    )
    group.add_argument("--controller", metavar="P=..|FILE", help=text)


def _output(group: argparse._ArgumentGroup) -> None:
    """Where results go."""
    group.add_argument(
        "--out",
        type=written_folder,
        metavar="DIR",
        help="write a page, figures, tables, JSON and a .mat file there",
    )
    group.add_argument(
        "--profiles",
        action="store_true",
        help="with --out: a profile of every parameter of the selected model",
    )
    text = (
        "with --out: folder written by 'disting report'; the page links its structures there"
        " (default: the folder beside it)"
    )
    group.add_argument("--site", type=site_folder, metavar="DIR", help=text)
    add_json(group, "the selection")
