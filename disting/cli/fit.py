"""disting fit: a measured frequency response, the structures that explain it, and which have
the same positive models.
"""

import argparse
import shlex
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from disting.cli.arguments import is_damped
from disting.cli.fit_data import Data, data, sensors
from disting.cli.fit_text import fit_text
from disting.cli.output import emit
from disting.cli.workers import Work, announce, cores, engine_for
from disting.errors import InputError, enumeration, printable
from disting.files import json_text, write_whole
from disting.fit.judge.readings import read_in_words
from disting.fit.results.loop import Controller, read_controller
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import candidates
from disting.fit.select import MOST_LINES, select
from disting.measurement import FrequencyResponse
from disting.measurement.response import NO_MOTION
from disting.model.chain import Chain
from disting.model.family import Family
from disting.report.fit.selection_json import selection_to_dict

# what few runs need is imported where options name it: an earlier fit, files of models
if TYPE_CHECKING:
    from disting.planning.fit_file import FitRecord

# options that name candidates, and where results go, with the number of words that follow
CANDIDATES = {"--masses": 1, "--actuator": 1, "--gap": 1, "--family": 0, "--base": 0}
OUTPUTS = {"--out": 1, "--json": 1, "--site": 1, "--profiles": 0, "--left": 1, "--demo": 0}
CIRCUIT = "R0-p(R1,C1)"  # the simplest with a capacitor
FEW = 30  # candidates that are fitted sooner than workers start


def run(options: argparse.Namespace) -> int:
    """Fit, select, print and write."""
    if options.models:
        from disting.cli.fit_networks import run as run_networks

        return run_networks(options)
    if options.ground_damper:
        raise InputError(
            "--ground-damper is for --models: chains are fitted with every set of ground dampers"
        )
    controller = read_controller(options.controller) if options.controller else None
    measured = data(options)
    if any(response.is_impedance for response in measured.every):
        return _no_drive(options, measured)
    left = _read_left(options)
    if left is None:
        announce(Work.FITS, _count_candidates(options), options.jobs or cores())
    chains = _candidates(options, measured, left.chains if left else ())
    options.jobs = options.jobs or (cores() if len(chains) > FEW else 1)
    home = _like_measured(left.model, measured) if left else None
    selection = _select(options, measured, chains, home, controller)
    if options.json:
        plain = selection_to_dict(selection)
        text = json_text(plain, indent=1)
        emit(options.json, f"{text}\n")
    if options.json != "-":
        print(printable("\n".join(fit_text(selection, measured.train))))
    if options.out:
        _write(selection, measured.train, measured.test, options)
        if options.json != "-":
            print("\n".join(_onward(selection, options.out)))
    return 0 if selection.explanation.explains and not selection.question else 1


def _no_drive(options: argparse.Namespace, measured: Data) -> int:
    """Print what was read of an impedance and the command that fits it; return the status."""
    words = list[str]()
    for response in (r for r in measured.every if r.is_impedance):
        low, high = response.frequency[0], response.frequency[-1]
        words += [read_in_words(response), f"{len(response)} lines, {low:.4g} to {high:.4g} Hz"]
    command = shlex.join(["disting", "fit", *map(str, options.train[:1]), "--models", CIRCUIT])
    words += ["", f"{NO_MOTION.partition(';')[0]}; fit circuits instead:", f"  {command}"]
    print(printable("\n".join(words)), file=sys.stderr if options.json == "-" else sys.stdout)
    return 1


def _select(
    options: argparse.Namespace,
    measured: Data,
    chains: Sequence[Chain],
    home: Chain | None,
    controller: Controller | None,
) -> Selection:
    """Selection found with these options; `home` names the places of further responses."""
    with engine_for(options) as (engine, pool, progress):
        selection = select(
            measured.train,
            chains,
            test=measured.test,
            further=measured.further,
            home=home,
            dead_time=options.dead_time,
            weights=options.weights,
            thresholds=options.thresholds,
            rule=options.rule,
            case=options.case,
            sign=options.sign.split(",")[0],
            bound=dict(options.bound),
            fix=dict(options.fix),
            seed=options.seed,
            prune=not options.no_prune,
            lines=options.lines or MOST_LINES,
            controller=controller,
            optimiser=options.optimiser,
            engine=engine,
            executor=pool,
            progress=progress,
        )
    return replace(selection, command=_again(options.words))


def _onward(selection: Selection, out: Path) -> Iterator[str]:
    """Where the page is and, where several structures are left, how to go on."""
    from disting.report.fit.write import not_exported

    yield f"\nwritten to {out}; open {out / 'fit.html'}"
    if not_exported(selection):
        yield (
            f"model.mat and models.py leave out {enumeration(not_exported(selection))}: the data do"
            " not determine all of their parameters"
        )
    known = not any(m.candidate.chain.gap_damper for m in selection.members)
    if known and (len(selection.members) > 1 or any(m.twins for m in selection.members)):
        yield f"what to measure next: disting next {shlex.quote(str(out / 'fit.json'))}"


def _count_candidates(options: argparse.Namespace) -> dict[int, int]:
    """Candidates by number of masses, before they are made: each structure with any dampers to the
    ground, lag and dead time.
    """
    counts = {n: len(Family(n)) if options.family else 1 for n in options.masses}
    return {n: count * 2 ** (n + 2) for n, count in counts.items()}


def _read_left(options: argparse.Namespace) -> "FitRecord | None":
    """The earlier fit that names the candidates; raises InputError where options name others."""
    if options.left is None:
        return None
    own = {word.partition("=")[0] for word in options.words} & CANDIDATES.keys()
    if own or options.damped is not None:
        raise InputError(
            f"{options.left} names the candidates: remove"
            f" {enumeration(sorted(own)) or '--damped and --undamped'}"
        )
    from disting.planning.fit_file import named_by

    return named_by(options.left)


def _like_measured(chain: Chain, measured: Data) -> Chain:
    return replace(chain, quantity=measured.train.quantity)


def _again(words: Sequence[str]) -> str:
    """The command without its candidates and without where it writes."""
    kept, skipped = list[str](), 0
    for word in words:
        name, equals, _ = word.partition("=")
        taken = (CANDIDATES | OUTPUTS).get(name)
        if skipped:
            skipped -= 1
        elif taken is None:
            kept.append(word)
        else:
            skipped = 0 if equals else taken
    return shlex.join(["disting", *kept])


def _candidates(
    options: argparse.Namespace, measured: Data, left: Sequence[Chain] = ()
) -> tuple[Chain, ...]:
    """The structures to fit, or those that an earlier fit left."""
    quantity = measured.train.quantity
    if left:
        return tuple(_like_measured(chain, measured) for chain in left)
    return candidates(
        options.masses,
        actuator=options.actuator,
        sensor=sensors(options)[0],
        gap=options.gap,
        family=options.family,
        base=options.base,
        damped=is_damped(options),
        quantity=quantity,
    )


def _write(
    selection: Selection,
    train: FrequencyResponse,
    test: FrequencyResponse | None,
    options: argparse.Namespace,
) -> None:
    from disting.export import control_script, write_mat
    from disting.report.fit import export, write_fit_report

    names = selection.selected.practical.names if options.profiles and selection.selected else ()
    write_fit_report(selection, options.out, train, test, profiles=names, site=options.site)
    models = export(selection, train)
    if models:
        write_mat(options.out / "model.mat", models, selection.task.sign)
        script = control_script(models, selection.task.sign)
        write_whole(options.out / "models.py", script.encode())
