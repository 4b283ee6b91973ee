"""disting schema: what is in the JSON files that disting writes."""

import argparse
import json

from disting.cli.output import emitted
from disting.schemas import Format, schema

NAMES = {known.short: known for known in Format}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    text = "a format, whose JSON Schema is printed (default: all formats are listed)"
    parser.add_argument("name", nargs="?", choices=tuple(NAMES), metavar="NAME", help=text)


def run(options: argparse.Namespace) -> int:
    """Print a schema, or what there is."""
    if options.name:
        emitted("-", json.dumps(schema(NAMES[options.name]), indent=1, ensure_ascii=False) + "\n")
        return 0
    for name, known in NAMES.items():
        print(f"{name}: {known.description}")
    return 0
