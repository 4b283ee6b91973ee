"""disting plan: how much measuring distinguishes two structures."""

import argparse
from dataclasses import replace
from pathlib import Path
from typing import Any

from disting.cli.arguments import is_damped
from disting.cli.model_names import structures, values_of
from disting.cli.output import complain, emit
from disting.cli.workers import engine_for
from disting.errors import InputError, printable
from disting.files import json_text
from disting.fit.search.starts import Parameters
from disting.measurement import read
from disting.model.names import damping_option
from disting.planning.effort import Effort, effort_of
from disting.planning.fit_file import FitRecord, NamedNetworks, record_of
from disting.planning.power import Plan, plan
from disting.planning.rival import AnyStructure
from disting.planning.spectrum import Design, design, designed_to_dict
from disting.report.fit.plan_words import plan_in_words
from disting.report.fit.plans_of_fit import doubts_of, effort_like, loud, plan_rivals
from disting.report.fit.write import write_plan


def run(options: argparse.Namespace) -> int:
    """Plan for one pair, or for all rivals that a fit names."""
    if options.model.lower().endswith(".json"):
        return _from_fit(Path(options.model), options)
    if options.rival is None:
        raise InputError("name the structure to exclude too, such as: disting plan 2:1+b1 2:1+b2")
    model, rival = structures([options.model, options.rival], options)
    values = values_of(model, options.model, options)
    effort = _effort(options, model, values, None)
    for doubt in loud(effort):
        complain(doubt)
    with engine_for(options) as (engine, pool, progress):
        the_plan = plan(
            model,
            values,
            rival,
            effort.omega,
            effort.rho,
            repeats=effort.repeats,
            engine=engine,
            executor=pool,
            progress=progress,
        )
        progress("spectrum", 0, 1)
        best = design(the_plan)
    _emit(options, designed_to_dict(the_plan, best))
    if options.json != "-":
        print(printable("\n".join(plan_in_words(the_plan, best, effort.source))))
    if options.out:
        _write(options, the_plan, best)
    return 0


def _write(options: argparse.Namespace, the_plan: Plan, best: Design | None) -> None:
    if best is None:
        raise InputError("there is nothing to measure, so nothing is written: remove --out")
    command = write_plan(the_plan, best, options.out)
    if options.json != "-":
        print(f"\nwritten to {options.out}; the spectrum is run by\n  {command}")


def _from_fit(path: Path, options: argparse.Namespace) -> int:
    """The selected structure of a fit against each rival that it names."""
    if options.rival or options.values or options.damped is not None:
        raise InputError(
            f"{path} names structures and values itself: remove the rival, --set and"
            f" {damping_option(is_damped(options))}"
        )
    named = record_of(path)
    effort = _effort(options, named.model, named.values, named)
    for doubt in doubts_of(path, named, effort):
        complain(doubt)
    with engine_for(options) as (engine, pool, progress):
        plans = plan_rivals(path, named, effort, engine=engine, executor=pool, progress=progress)
    _emit(options, plans.to_dict())
    if options.json != "-":
        print(printable("\n".join(plans.in_words())))
    if options.out:
        plans.write(options.out)
        if options.json != "-":
            print(f"\nwritten to {options.out}; open {options.out / 'plan.html'}")
    return 0


def _emit(options: argparse.Namespace, plain: dict[str, Any]) -> None:
    if options.json:
        text = json_text(plain, indent=1) + "\n"
        emit(options.json, text)


def _effort(
    options: argparse.Namespace,
    model: AnyStructure,
    values: Parameters,
    named: FitRecord | NamedNetworks | None,
) -> Effort:
    """From a number, a measured response, or the file of a fit."""
    number = _number(options.noise)
    if (options.noise or "").endswith("%"):
        raise InputError("noise is written as a share: --noise 0.02 for 2 %")
    if options.noise is not None and number is None:
        return _read_effort(options, model, values)
    if number is None and named is None:
        raise InputError("give the scatter of a line: --noise 0.02, or --noise FRF.csv")
    if named is not None:
        return effort_like(
            named, number, band=options.band, lines=options.lines, repeats=options.repeats
        )
    return effort_of(
        model,
        values,
        number or 0.0,
        band=options.band,
        lines=options.lines,
        repeats=options.repeats or 1,
    )


def _number(text: str | None) -> float | None:
    try:
        return float(text or "")
    except ValueError:
        return None


def _read_effort(options: argparse.Namespace, model: AnyStructure, values: Parameters) -> Effort:
    """Lines and scatter of a measured response."""
    response = read(Path(options.noise))
    effort = effort_of(
        model, values, response, band=options.band, lines=options.lines, repeats=options.repeats
    )
    for note in effort.notes:
        complain(note)
    return replace(effort, source=f"of {options.noise}, {effort.source}")
