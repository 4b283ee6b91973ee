"""disting schema, cache and doctor: what is in the files, what is stored, what is installed."""

import argparse

from disting.cli.output import emit
from disting.files import RECORDS, Format, __version__, json_text, record_schema, schema
from disting.store import Store

NAMES = {known.short: known for known in Format}


def add_schema_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `schema`."""
    text = "a format, whose JSON Schema is printed (default: all formats are listed)"
    parser.add_argument("name", nargs="?", choices=(*NAMES, RECORDS), metavar="NAME", help=text)


def print_schema(options: argparse.Namespace) -> int:
    """Print a schema, or what there is."""
    if options.name:
        of_lines = options.name == RECORDS
        found = record_schema() if of_lines else schema(NAMES[options.name])
        emit("-", json_text(found, indent=1) + "\n")
        return 0
    for name, file_format in NAMES.items():
        print(f"{name}: {file_format.description}")
    print(f"{RECORDS}: {record_schema()['description']}")
    return 0


def cache_info(options: argparse.Namespace) -> int:
    """Say where the cache is and what it holds."""
    with Store.open(None) as store:
        info = store.info()
    print(f"path     {info.path or 'no cache'}\nentries  {info.entries}")
    print(f"size     {info.bytes} bytes\nschema   {info.schema_version}")
    return 0


def cache_clear(options: argparse.Namespace) -> int:
    """Remove all entries."""
    with Store.open(None) as store:
        print(f"{store.clear()} entries removed")
    return 0


def doctor(options: argparse.Namespace) -> int:
    """Say what works here, and what else could."""
    from importlib.metadata import version
    from importlib.util import find_spec

    print(f"{'disting':14}{__version__}")
    for name in ("python-flint", "numpy", "sympy"):
        print(f"{name:14}{version(name)}")
    text = version("distributed") if find_spec("distributed") else "not found"
    print(f"{'distributed':14}{text}; optional, for work on a cluster (--scheduler)")
    with Store.open(None) as store:
        print(f"{'cache':14}{store.info().path or 'off'}")
    return 0
