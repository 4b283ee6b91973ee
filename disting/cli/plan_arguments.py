"""Arguments of disting plan; nothing here loads numerical libraries."""

import argparse

from disting.cli.arguments import (
    add_damped,
    add_json,
    add_notation,
    add_work,
    frequency_range,
    refuse,
    whole,
)
from disting.cli.output import written_folder


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    text = (
        "the true structure, such as 2:1+b1 or a network such as 'R0-p(R1,C1)', or a file of"
        " 'disting fit --json': its selected structure"
    )
    p.add_argument("model", metavar="N:I|NETWORK|FIT.json", help=text)
    text = "the structure to exclude (with FIT.json: each one that it names)"
    p.add_argument("rival", nargs="?", metavar="M:J|NETWORK", help=text)
    _data(p)
    text = (
        "write figure, spectrum to run, lines and JSON there; of FIT.json a page with those of each"
        " rival"
    )
    p.add_argument("--out", type=written_folder, metavar="DIR", help=text)
    add_json(p, "the plan")
    add_damped(p)
    add_notation(p)
    add_work(p)


def _data(p: argparse.ArgumentParser) -> None:
    """Values of the true structure, and the data to plan for."""
    text = (
        "values of all parameters of the true structure, such as m1=0.01,k12=500; for a circuit"
        " they may be given in braces, such as R{R=20}"
    )
    p.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE,...", dest="values", help=text
    )
    text = (
        "relative noise of a line, such as 0.02 (2 %% in amplitude, 0.02 rad in phase), or a"
        " measured response whose lines and scatter are taken"
    )
    p.add_argument("--noise", metavar="X|FRF.csv", help=text)
    text = "frequencies of the lines [Hz], such as 5..300"
    p.add_argument("--band", type=frequency_range, metavar="LOW..HIGH", help=text)
    refuse(p, "--range", "a range of frequencies is --band, such as --band 5..300")
    p.add_argument(
        "--lines",
        type=int,
        metavar="K",
        help="number of lines, evenly spaced on a logarithmic scale (default: 120)",
    )
    text = (
        "number of repeats or periods from which a fit finds the scatter (default: 1, or those"
        " of FRF.csv): fewer exclude less"
    )
    p.add_argument("--repeats", type=whole(1, 1000), metavar="R", help=text)
