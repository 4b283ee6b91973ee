"""disting verify: whether a verdict holds, recomputed from its evidence alone."""

import argparse
from pathlib import Path

from disting.cli.arguments import (
    add_also,
    add_damped,
    add_deciding,
    add_no_cache,
    add_notation,
    add_quantity,
)
from disting.cli.decision import verdict_file
from disting.errors import InputError
from disting.verdict.verification import Status, verify

STATUS = {Status.HOLDS: 0, Status.FAILS: 1, Status.OPEN: 3}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    text = (
        "a file that 'disting compare N:I M:J --json FILE' wrote; or two models, as compare takes"
        " them: their verdict is decided, or looked up, and checked"
    )
    parser.add_argument("what", nargs="+", metavar="FILE.json|N:I M:J", help=text)
    add_damped(parser)
    add_quantity(parser)
    add_deciding(parser)
    add_also(parser)
    add_notation(parser)
    add_no_cache(parser)


def run(options: argparse.Namespace) -> int:
    """Check one verdict; status 1 if it does not hold, 3 if that cannot be decided."""
    is_file = len(options.what) == 1
    if len(options.what) > 2:
        raise InputError("name one file of a verdict, or two models such as 3:1 3:4")
    if is_file and ":" in options.what[0] and not Path(options.what[0]).exists():
        raise InputError(f"name the other model too, such as: disting verify {options.what[0]} 3:4")
    if is_file and options.also:
        raise InputError("the file names its experiments: remove --also")
    verification = verify(options.what[0] if is_file else verdict_file(options.what, options))
    print(f"{' and '.join(options.what)}: {verification.text}")
    return STATUS[verification.status]
