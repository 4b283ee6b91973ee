"""A selection as plain data, ready for JSON. `disting.fit.read_model` reads its model back."""

from dataclasses import asdict
from math import isfinite
from typing import Any

import numpy as np

from disting.files import Format
from disting.fit.judge.candidate import Candidate
from disting.fit.judge.explanation import STATUS, Explanation, explanations
from disting.fit.judge.mechanics import Folded, fold
from disting.fit.judge.members import Member
from disting.fit.judge.outside import Outside
from disting.fit.judge.readings import QuantityReading
from disting.fit.results.reliance import Statement
from disting.fit.results.selection import Selection, fit_percent
from disting.fit.search.candidates import listed_form, reference
from disting.measurement import FrequencyResponse
from disting.measurement.assumptions import assumed_quantity
from disting.model.chain import Chain
from disting.report.fit.doubts import hold
from disting.report.fit.look_alikes import look_alikes_to_dict, one_set_of
from disting.report.fit.quality import quality_remarks
from disting.report.fit.sentences import first_lines, places, suspicions


def selection_to_dict(selection: Selection) -> dict[str, Any]:
    """Plain data of a selection: `selected` (null if none), whether it explains the data, what
    else is not excluded.
    """
    return {
        "format": Format.FIT.value,
        "selected": candidate_to_dict(selection.selected) if selection.selected else None,
        "candidates": [candidate_to_dict(c) for c in selection.candidates],
        "alternatives": [
            {**_chain_to_dict(a.chain), "relation": a.relation.value, "reason": a.sentence}
            for a in selection.alternatives
        ],
        "look_alikes": look_alikes_to_dict(selection),
        "outside": [_outside_to_dict(machine) for machine in selection.outside],
        "not_fitted": [
            {**_chain_to_dict(c), "same_as": _chain_to_dict(other)}
            for c, other in selection.same_as.items()
        ],
        "status": _status(selection),
        "answer": list(first_lines(selection)),
        "remarks": list(quality_remarks(selection)),
        "values_hold": " and ".join(filter(None, [hold(selection), one_set_of(selection)])),
        "mechanics": _mechanics_to_dict(fold(selection.members)) if selection.members else None,
        "question": selection.question,
        "quantities": [_quantity_to_dict(reading) for reading in selection.quantities],
        "explained": selection.explanation.explains and not selection.question,
        "misses": [miss.sentence for miss in selection.explanation.misses],
        "chi2_per_line": selection.explanation.chi2,
        "scatter": selection.explanation.scatter.typical,
        "scatter_source": selection.explanation.scatter.source,
        "frequencies": _frequencies(selection),
        "residual_correlation": selection.explanation.correlation,
        "fit_percent": _fit_percent(selection),
        "not_excluded": [member_to_dict(m) for m in (*selection.members, *selection.containing)],
        "relied_on": [_statement_to_dict(s) for s in selection.relied_on],
        "suspicions": list(suspicions(selection)),
        "data": [_data(response) for response in _all_responses(selection)],
        "rule": selection.rule.value,
        "validation": selection.validation,
        "sign": selection.task.sign,
        "command": selection.command,
    } | (
        _joint_to_dict(selection) if len(selection.task.cost.parts) > 1 or selection.silent else {}
    )


def _outside_to_dict(machine: Outside) -> dict[str, Any]:
    return {
        "kind": machine.kind.value,
        "name": machine.text,
        "values": dict(machine.values),
        "chi2_per_line": machine.chi2,
        "better": machine.is_better,
    }


def _status(selection: Selection) -> str:
    if selection.question:
        return "quantity not settled"
    explanation = selection.explanation
    if explanation.too_few:
        return "too few lines"
    return STATUS[explanation.level]


def _mechanics_to_dict(folded: Folded) -> dict[str, Any]:
    """The set folded to mechanics: what all structures share, what they do not decide, the lines
    with the names of their structures.
    """
    return {
        "masses": list(folded.sizes),
        "same_ports": folded.ports is not None,
        "dampers": list(folded.shared),
        "undecided_dampers": list(folded.undecided),
        "actuators": [list(parts) for parts in folded.actuators],
        "lines": [
            {
                "name": line.name,
                "actuators": [list(parts) for parts in line.actuators],
                "members": [member.name for member in line.members],
                "best": line.best.name,
                "j_test": line.best.candidate.j_test,
            }
            for line in folded.lines
        ],
    }


def _quantity_to_dict(reading: QuantityReading) -> dict[str, Any]:
    """The data read as one sensor quantity."""
    return {
        "quantity": reading.quantity.value,
        "assumed": reading.is_assumed,
        "structure": reading.name,
        "n_parameters": len(reading.found.parameters),
        "chi2_per_line": reading.chi2,
        "lag_integrates": reading.integrates,
    }


def _statement_to_dict(statement: Statement) -> dict[str, Any]:
    """A statement; an end that is not finite is null."""
    ends = {
        n: x if isfinite(x) else None for n, x in (("low", statement.low), ("high", statement.high))
    }
    return asdict(statement) | ends | {"kind": statement.kind.value, "text": statement.text}


def _joint_to_dict(selection: Selection) -> dict[str, Any]:
    """Each response with its own results, and those without information."""
    judging, described = selection.judging, selection.described
    each = explanations(
        judging, described.residual, described.missed, selection.explanation.scatter
    )
    by_setup = dict(zip(judging.setups, each, strict=True))
    cost, p = selection.task.cost, described.estimate.parameters
    names = selection.task.names(described.chain)
    response = selection.task.plant(described.chain).response(np.array([p[n] for n in names]))
    residuals = cost.by_residual(cost.residual(response))
    rows = zip(cost.parts, cost.setups, residuals, strict=True)
    return {
        "responses": [
            {
                "measured": setup.text,
                "origin": part.measured.origin,
                "quantity": part.measured.sensor.value,
                "lines": len(part.measured),
                "sign": selection.task.sign * setup.sign,
                "dead_time": setup.delay or "Td",
                "j_train": float(residual @ residual),
                "fit_percent": _finite(fit_percent(described, selection.task, part.measured, at)),
            }
            | (_explanation_to_dict(by_setup[setup]) if setup in by_setup else {})
            for at, (part, setup, residual) in enumerate(rows)
        ],
        "nothing_learned": list(selection.silent),
        "places": [
            {"name": name, "measured": other_name} for name, other_name in places(selection)
        ],
    }


def _explanation_to_dict(said: Explanation) -> dict[str, Any]:
    """Plain data of the explanation of one response's judged data."""
    return {
        "chi2_per_line": said.chi2,
        "scatter": said.scatter.typical,
        "residual_correlation": said.correlation,
    }


def _all_responses(selection: Selection) -> list[FrequencyResponse]:
    """All responses: those that are fitted, then those that they are tested on."""
    train = [part.measured for part in selection.task.cost.parts]
    tests = [part.measured for part in selection.judging.parts]
    return [
        *train,
        *(response for response in tests if all(response is not other for other in train)),
    ]


def _data(measured: FrequencyResponse) -> dict[str, Any]:
    """Plain data on the reading of a response, with assumptions and changes."""
    return {
        "origin": measured.origin,
        "reading": measured.reading,
        "quantity": measured.sensor.value,
        "quantity_assumed": assumed_quantity(measured) is not None,
        "notes": list(measured.notes),
    }


def _frequencies(selection: Selection) -> dict[str, float]:
    """Range [Hz] and number of the lines of the training data."""
    hertz = selection.task.cost.measured.frequency
    return {"low": float(hertz[0]), "high": float(hertz[-1]), "lines": len(hertz)}


def _fit_percent(selection: Selection) -> dict[str, float | None]:
    """Of the described candidate on training and test data; null where there are none or where
    it is not defined.
    """
    train = selection.task.cost.measured
    sizes = {"train": train, "test": None if selection.test is train else selection.test}
    return {
        key: None
        if data is None
        else _finite(fit_percent(selection.described, selection.task, data))
        for key, data in sizes.items()
    }


def member_to_dict(member: Member) -> dict[str, Any]:
    """Plain data of a structure that the data do not exclude: name, values, intervals of 95 %,
    and what behaves the same.
    """
    return {
        "name": member.name,
        **_chain_to_dict(member.candidate.chain),
        "parameters": member.candidate.estimate.parameters,
        "intervals": {n: [_finite(end) for end in both] for n, both in member.intervals.items()},
        "contains": reference(member.contains) if member.contains else None,
        "j_test": member.candidate.j_test,
        "chi2_per_line": member.candidate.chi2,
        "equivalents": [
            {"name": t.name, "parameters": t.parameters, "free_choices": t.free_choices}
            for t in member.twins
        ],
        "other_values": [
            {
                "parameters": c.estimate.parameters,
                "standard_errors": {n: _finite(e) for n, e in c.standard_errors.items()},
            }
            for c in member.exchanged
        ],
        "not_decided": list(member.open),
        "disagreements": [
            {
                "parameter": d.name,
                "train": d.train,
                "test": d.test,
                "standard_errors_apart": d.distance,
            }
            for d in member.disagreements
        ],
        "differs_at": [{"frequency": hertz, "by": size} for hertz, size in member.differs],
    }


def candidate_to_dict(c: Candidate) -> dict[str, Any]:
    """Plain data of one candidate; a number that is not finite is null, and so is
    `unidentifiable` where nothing is.
    """
    return {
        "name": reference(c.chain),
        **_chain_to_dict(c.chain),
        "n_parameters": c.n_parameters,
        "parameters": c.estimate.parameters,
        "standard_errors": {name: _finite(value) for name, value in c.standard_errors.items()},
        "j_train": c.j_train,
        "j_test": c.j_test,
        "chi2_per_line": c.chi2,
        "pii_ratio": _finite(c.practical.importance_ratio),
        "collinearity": _finite(c.practical.collinearity),
        "condition_index": _finite(c.practical.condition_index),
        "unidentifiable": c.practical.unidentifiable or None,
        "akaike_weight": c.akaike_weight,
        "hit_rate": c.estimate.hit_rate,
        "admissible": c.admissible,
        "reasons": list(c.reasons),
        "excluded_by": None
        if c.excluded is None
        else {
            "name": reference(c.excluded.by),
            "statistic": c.excluded.statistic,
            "limit": c.excluded.limit,
        },
    }


def _chain_to_dict(chain: Chain) -> dict[str, Any]:
    """A chain in the words of the fit: lag, delay, ground dampers; gap, force and sensor as
    indices.

    `renamed`: where the chain is named after another form of it, what its parameters are called
    there.
    """
    form = listed_form(chain)
    _, gap, act_minus, act_plus, meas_minus, meas_plus = chain.indices
    return {
        "n_masses": chain.n_masses,
        "ground_dampers": list(chain.ground_dampers),
        "lag": chain.lag,
        "delay": chain.dead_time,
        "gap": gap,
        "actuator": [act_minus, act_plus],
        "sensor": [meas_minus, meas_plus],
        "quantity": chain.sensor.value,
        "damped": chain.damped,
        **({"gap_damper": True} if chain.gap_damper else {}),
    } | ({"renamed": form.renaming} if form.chain != chain else {})


def _finite(value: float) -> float | None:
    return value if isfinite(value) else None
