"""The process of the command line: the console script and `python -m disting` begin here.

Python turns Ctrl-C into an exception, which is a traceback wherever nobody catches it: while half a
second of modules is imported, and while the process ends. There the signal ends the process itself,
in silence, as it ends any program (a shell reports status 130); while a command works it is an
exception again, `disting.cli.run`. Nothing is imported before: `_signal`, beneath `signal`, is part
of the interpreter, and the package imports its names when they are used.
"""

import _signal  # type: ignore[import-not-found]


def main() -> int:
    """Run the command that the process was started with; returns its exit status."""
    if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:  # else it is ignored
        _signal.signal(_signal.SIGINT, _signal.SIG_DFL)
    from disting.cli.run import main as run

    return run()


if __name__ == "__main__":
    raise SystemExit(main())
