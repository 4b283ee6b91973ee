"""disting draw: the drawing of a model as a picture."""

import argparse
from pathlib import Path

from disting.cli.arguments import MODEL, add_damped, add_notation, add_quantity
from disting.cli.model_names import models_of
from disting.cli.output import emit, written_file
from disting.errors import InputError, short
from disting.files import write_whole


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of the command."""
    parser.add_argument("model", metavar="MODEL", help=MODEL)
    text = "write the drawing as SVG; - is standard output"
    parser.add_argument("--svg", type=written_file, metavar="FILE", help=text)
    text = "write the drawing as PNG"
    parser.add_argument("--png", type=written_file, metavar="FILE", help=text)
    add_damped(parser)
    add_quantity(parser)
    add_notation(parser)
    parser.set_defaults(also=())


def run(options: argparse.Namespace) -> int:
    """Draw one model."""
    from disting.report.network_drawing import scene_of
    from disting.report.png import png
    from disting.report.scene import svg

    if not (options.svg or options.png):
        raise InputError("give a file for the drawing: --svg FILE or --png FILE")
    if options.png == "-":
        raise InputError("a picture as PNG goes to a file: name one")
    (model,) = models_of([options.model], options)
    scene = scene_of(model)
    if scene is None:
        raise InputError(
            f"{short(options.model)} is a transfer function or a state space: chains, machines,"
            " circuits and compartments have a drawing"
        )
    if options.png:
        write_whole(Path(options.png), png(scene, scale=3))
    if options.svg:
        emit(options.svg, svg(scene))
    files = [file for file in (options.svg, options.png) if file and file != "-"]
    if options.svg != "-":
        print(f"{scene.title}\n{' and '.join(files)} written")
    return 0
