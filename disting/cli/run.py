"""Runs one command and turns every expected failure into one sentence and an exit status."""

import sys
import warnings
from collections.abc import Sequence

from disting.cli.parser import parser
from disting.errors import DistingError


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit status."""
    warnings.showwarning = _warned
    try:
        options = parser().parse_args(arguments)
        status: int = options.run(options)
        return status
    except DistingError as reason:
        print(f"disting: {reason}", file=sys.stderr)
        return 2
    except OSError as reason:
        print(f"disting: {reason.strerror or reason}: {reason.filename or ''}".rstrip(": "), file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("disting: interrupted; what was finished is kept in the cache", file=sys.stderr)
        return 130


def _warned(message: Warning | str, *_: object, **__: object) -> None:
    print(f"disting: warning: {message}", file=sys.stderr)
