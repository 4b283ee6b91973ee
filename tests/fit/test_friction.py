"""Fits of drives with Coulomb friction and backlash: no interval excludes the truth by more than
three standard errors unless the first lines warn.

Friction and backlash move the mean of a response, which no interval of one measurement holds: the
figures of the whole table (strengths of 2 to 40 % of the torque, play of 0.3 to 8 mrad) are
printed by its slow test. A single period of a response of all lines shows no difference between
distortion and noise; it is not in the table.
"""

from dataclasses import replace

import numpy as np
import pytest

from disting.cli.fit_text import fit_text
from disting.fit.judge.explanation import Level
from disting.fit.judge.modes import physical
from disting.fit.search.candidates import reference
from disting.fit.select import select
from disting.measurement.repeats import mean_of
from disting.model.chain import Chain
from disting.report.fit.selection_json import selection_to_dict
from disting.report.fit.selection_page import fit_page
from disting.report.fit.sentences import first_lines
from tests.fit.friction_drives import TRUTH, Machine, responses, run_of

pytestmark = pytest.mark.full

VELOCITY = Chain(1, damped=False, quantity="velocity")
CANDIDATES = [
    VELOCITY,
    replace(VELOCITY, ground_dampers=(1,)),
    *(Chain(2, damped=True, ground_dampers=b, quantity="velocity") for b in ((), (1,), (2,))),
]
TABLE = [
    *(Machine(masses, coulomb=size) for masses in (1, 2) for size in (0.02, 0.1, 0.4)),
    *(Machine(2, play=size) for size in (3e-4, 2e-3, 8e-3)),
]
WARNINGS = ("distortion", "neighbouring lines jump", "not linear", "changed", "none of the")
FAR = 3.0  # standard errors


def realisations(machine):
    return [run_of(machine, "all", realisation=i) for i in range(3)]


def odd(machine):
    return select(responses([run_of(machine)])[0], CANDIDATES)


def periods(machine):
    return select(*responses([run_of(machine, "all")]), CANDIDATES)


def repeats(machine):
    return select(mean_of(responses(realisations(machine))), CANDIDATES)


def amplitudes(machine):
    train, test = responses([run_of(machine, "all"), run_of(machine, "all", rms=0.5)])
    return select(train, CANDIDATES, test=test)


def files(machine):
    """Two amplitudes without standard deviations or levels, as of files of responses."""
    train, test = responses([run_of(machine, "all"), run_of(machine, "all", rms=0.5)])
    bare = {"deviation": None, "coherence": None, "method": None}
    return select(replace(train, **bare), CANDIDATES, test=replace(test, **bare))


def errors(found, machine):
    """Distances of inertias, stiffness and damping from the truth [standard errors]; those of a
    structure of other masses have no truth.
    """
    best = found.described
    if best.chain.n_masses != machine.masses:
        return {}
    spread = best.practical.relative_errors
    return {
        n: float(np.log(value / TRUTH[n]) / spread[n])
        for n, value in best.estimate.parameters.items()
        if n[0] in "mkd"
    }


def is_warned(found):
    return any(word in line for line in first_lines(found)[:3] for word in WARNINGS)


def test_distortion_is_reported_before_any_structure_and_widens_the_intervals():
    machine = Machine(2, coulomb=0.1)
    (measured,) = responses([run_of(machine)])
    with_it = select(measured, CANDIDATES)
    first = first_lines(with_it)[0]
    assert ", noise 0.0" in first and "distortion 4." in first
    assert any(said in first for said in selection_to_dict(with_it)["suspicions"])
    assert all(abs(z) < FAR for z in errors(with_it, machine).values())
    assert reference(with_it.described.chain) == "2:1+b1" and with_it.explanation.explains


def test_values_of_a_machine_that_is_not_linear_are_marked_wherever_they_stand():
    """Play makes k12 low by more than its interval says: no interval looks sure."""
    (measured,) = responses([run_of(Machine(2, play=2e-3))])
    found = select(measured, CANDIDATES[3:4])
    said = list(fit_text(found, measured))
    values = [line for line in said if line.startswith(("  m1", "  k12", "  resonance 1  "))]
    assert len(values) >= 3 and all(line.endswith("*") for line in values)
    assert any(line.startswith("  * for this amplitude only: ") for line in said)
    assert selection_to_dict(found)["values_hold"] == "for this amplitude only"
    page = fit_page(found, physical(found.described, found.task), (), measured)
    assert "Parameters of the model, for this amplitude only." in page
    (linear,) = responses([run_of(Machine(2))])
    found = select(linear, CANDIDATES[3:4])
    assert "amplitude only" not in "\n".join(fit_text(found, linear))
    assert selection_to_dict(found)["values_hold"] == ""


@pytest.mark.slow
def test_a_model_with_too_few_masses_is_not_explained_by_distortion():
    """A distortion of 1 % is no licence for a resonance that a model does not have."""
    (measured,) = responses([run_of(Machine(2, coulomb=0.02))])
    assert 0.003 < np.median(measured.nonlinear / np.abs(measured.G)) < 0.03
    found = select(measured, CANDIDATES[:2])
    assert found.explanation.level is Level.NOT and found.explanation.chi2 > 30


@pytest.mark.slow
def test_two_amplitudes_that_differ_are_reported_with_their_levels():
    found = amplitudes(Machine(1, coulomb=0.4))
    line = first_lines(found)[0]
    assert "at 1 Nm and 0.5 Nm (input, rms) differ by" in line and "not linear" in line
    same = Machine(1)
    assert not is_warned(select(*responses([run_of(same, "all")]), CANDIDATES[:2]))


def test_an_error_that_repeats_with_the_excitation_is_reported():
    found = select(*responses([run_of(Machine(1, coulomb=0.1), "all")]), CANDIDATES[:2])
    assert "neighbouring lines jump by" in first_lines(found)[0]


@pytest.mark.slow
@pytest.mark.parametrize("fit", [odd, periods, repeats, amplitudes, files])
def test_no_interval_excludes_the_truth_without_a_warning(fit):
    for machine in TABLE:
        found = fit(machine)
        far = errors(found, machine)
        print(fit.__name__, machine, reference(found.described.chain), far, first_lines(found)[0])
        assert is_warned(found) or all(abs(z) <= FAR for z in far.values())
