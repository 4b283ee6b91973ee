"""disting plan: how much measuring distinguishes two structures."""

import argparse
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from disting.cli.arguments import is_damped
from disting.cli.model_names import structures, values_of
from disting.cli.output import complain, emit
from disting.cli.workers import engine_for
from disting.errors import InputError, printable
from disting.files import Format, json_text
from disting.fit.search.containment import contains
from disting.fit.search.starts import Parameters
from disting.measurement import read
from disting.model.names import damping_option
from disting.planning.effort import Effort, effort_of
from disting.planning.fit_file import (
    FitRecord,
    NamedNetworks,
    is_of_networks,
    named_by,
    networks_named_by,
)
from disting.planning.power import Answer, Plan, plan, plan_to_dict
from disting.planning.rival import AnyStructure, name_of
from disting.planning.spectrum import Design, design, designed_to_dict
from disting.report.fit.plan_page import write_plans
from disting.report.fit.plan_words import LOUD, plan_in_words, rivals_in_words
from disting.report.fit.write import write_plan

AnyNamed = FitRecord | NamedNetworks


def run(options: argparse.Namespace) -> int:
    """Plan for one pair, or for all rivals that a fit names."""
    if options.model.lower().endswith(".json"):
        return _from_fit(Path(options.model), options)
    if options.rival is None:
        raise InputError("name the structure to exclude too, such as: disting plan 2:1+b1 2:1+b2")
    model, rival = structures([options.model, options.rival], options)
    values = values_of(model, options.model, options)
    effort = _effort(options, model, values, None)
    _warn(effort)
    with engine_for(options) as (engine, pool, progress):
        the_plan = _plan_with(
            effort, model, values, rival, engine=engine, executor=pool, progress=progress
        )
        progress("spectrum", 0, 1)
        best = design(the_plan)
    _emit(options, designed_to_dict(the_plan, best))
    if options.json != "-":
        print(printable("\n".join(plan_in_words(the_plan, best, effort.source))))
    if options.out:
        _write(options, the_plan, best)
    return 0


def _plan_with(
    effort: Effort, model: AnyStructure, values: Parameters, rival: AnyStructure, **work: Any
) -> Plan:
    """One plan with this effort; `work`: engine, executor and progress of `plan`."""
    return plan(model, values, rival, effort.omega, effort.rho, repeats=effort.repeats, **work)


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
    named: AnyNamed = networks_named_by(path) if is_of_networks(path) else named_by(path)
    if not named.explained:
        complain(
            f"warning: none of the structures of {path} explains its data, so no rival is named;"
            " name the structures to plan for"
        )
    effort = _effort(options, named.model, named.values, named)
    _warn(effort)
    plans, reverse = _plans(named, effort, options)
    rows = [plan_to_dict(own_plan) | _reverse(back) for own_plan, back in plans]
    larger = [{"name": name_of(x), **_reverse(reverse.get(x))} for x in named.larger]
    plain = {"same": named.same, "rivals": rows, "larger": larger}
    whole = {"format": Format.PLANS_OF_FIT.value, **plain}
    _emit(options, whole)
    if options.json != "-":
        back = list(reverse.values())
        print(printable("\n".join(rivals_in_words(named, plans, back, effort.source, str(path)))))
    if options.out:
        designed = [(own_plan, design(own_plan)) for own_plan, _ in plans]
        back = [*(other for _, other in plans if other is not None), *reverse.values()]
        write_plans(named, designed, back, effort.source, path, whole, options.out)
        if options.json != "-":
            print(f"\nwritten to {options.out}; open {options.out / 'plan.html'}")
    return 0


def _plans(
    named: AnyNamed, effort: Effort, options: argparse.Namespace
) -> tuple[list[tuple[Plan, Plan | None]], dict[Any, Plan]]:
    """The selected structure against each rival, and back where the rival cannot be excluded; and
    each larger structure, with values that the data determine, against the selected one.
    """
    plans = list[tuple[Plan, Plan | None]]()
    with engine_for(options) as (engine, pool, progress):
        planned = partial(_plan_with, effort, engine=engine, executor=pool)
        for rival, values in named.rivals.items():
            progress("rival", len(plans), len(named.rivals))
            other_plan = planned(named.model, named.values, rival)
            is_same = other_plan.answer is Answer.SAME and values
            plans.append((other_plan, planned(rival, values, named.model) if is_same else None))
        reverse = {
            structure: planned(structure, values, named.model)
            for structure, values in named.larger.items()
            if structure in named.determined and contains(structure, named.model)
        }
    return plans, reverse


def _reverse(the_plan: Plan | None) -> dict[str, Any]:
    """The plan against the model, were a structure true that gives the model's response too."""
    return {"reverse": plan_to_dict(the_plan)} if the_plan else {}


def _emit(options: argparse.Namespace, plain: dict[str, Any]) -> None:
    if options.json:
        text = json_text(plain, indent=1) + "\n"
        emit(options.json, text)


def _effort(
    options: argparse.Namespace,
    model: AnyStructure,
    values: Parameters,
    named: AnyNamed | None,
) -> Effort:
    """From a number, a measured response, or the file of a fit."""
    number = _number(options.noise)
    if (options.noise or "").endswith("%"):
        raise InputError("noise is written as a share: --noise 0.02 for 2 %")
    if options.noise is not None and number is None:
        return _read_effort(options, model, values)
    if number is None and named is None:
        raise InputError("give the scatter of a line: --noise 0.02, or --noise FRF.csv")
    band, lines, size = options.band, options.lines, number
    if named is not None:
        band, size = band or (named.low, named.high), named.scatter if size is None else size
        lines = named.lines or None if lines is None else lines
    effort = effort_of(
        model, values, size or 0.0, band=band, lines=lines, repeats=options.repeats or 1
    )
    return effort if number is not None else replace(effort, source="of the fitted data")


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


def _warn(effort: Effort) -> None:
    if np.median(effort.rho) > LOUD:
        complain(
            f"warning: lines scatter by more than {100 * LOUD:.0f} %, so the power is a rough"
            " estimate: the test assumes small differences"
        )
