"""disting app: the local page, until Ctrl-C."""

import argparse
import webbrowser
from pathlib import Path

from disting.cli.arguments import whole
from disting.cli.workers import cores
from disting.errors import InputError

MISSING = "'disting app' needs more packages: pip install 'disting[app]'"


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    p.add_argument(
        "folder",
        nargs="?",
        type=Path,
        default=Path("disting-project"),
        metavar="FOLDER",
        help="project folder: measured files and results (default: disting-project)",
    )
    text = "port of 127.0.0.1 (default: any that is free)"
    p.add_argument("--port", type=whole(1), default=0, metavar="N", help=text)
    p.add_argument("--no-browser", action="store_true", help="print the address, open nothing")
    text = "worker processes of a fit (default: one for each core)"
    p.add_argument("--jobs", type=whole(1), default=0, metavar="K", help=text)
    text = "compute fits on a dask.distributed cluster"
    p.add_argument("--scheduler", default="", metavar="ADDRESS", help=text)


def run(options: argparse.Namespace) -> int:
    """Serve the page."""
    try:
        from disting.app.gate import Keys
        from disting.app.server import listen, serve
        from disting.app.workers import Setting
    except ImportError as reason:
        if (reason.name or "").partition(".")[0] in ("starlette", "uvicorn", "jsonschema"):
            raise InputError(MISSING) from None
        raise
    from disting.app.project import own_folder

    with own_folder(options.folder) as folder, listen(options.port) as listener:
        keys = Keys(listener.getsockname()[1])
        print(f"project: {folder}\nopen {keys.first_address}\nCtrl-C stops it", flush=True)
        if not options.no_browser:
            webbrowser.open(keys.first_address)
        try:
            serve(Setting(folder, options.jobs or cores(), options.scheduler), listener, keys)
        except KeyboardInterrupt:
            print("stopped; what was finished is in the project folder")
    return 0
