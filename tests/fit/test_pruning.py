"""What the fit leaves out and what it says of it: positive parameters, those that are given or
bounded as they are given.
"""

import numpy as np
import pytest

from disting import Engine, Query, View, compare
from disting.cli.fit_text import fit_text
from disting.fit.judge.alternatives import alternatives, limits_of, representatives, stands_for
from disting.fit.judge.modes import physical
from disting.fit.search.candidates import figure_1
from disting.fit.select import select
from disting.model.chain import Chain
from disting.report.fit import collinearity_dots, fit_page, importance_bars, waterfall
from disting.report.fit.write import fit_figures
from disting.simulation import demo
from disting.verdict.result import Relation
from tests.fit.drives import response

REVERSED = [Chain(2, meas_plus=2, damped=True, ground_dampers=at) for at in ((1,), (2,))]


def reversed_drive(fixed, **more):
    """Force at mass 1, sensor at mass 2, damper at mass 2: with m1 given, the mirrored chain
    with b1 cannot be the same.
    """
    chain = Chain(2, meas_plus=2, damped=True, ground_dampers=(2,))
    values = {"m1": 0.01, "m2": 0.03, "k12": 900.0, "d12": 0.2, "b2": 0.5}
    data = response(chain, values, noise=0.01)
    return chain, select(data, REVERSED, test=data, fix=fixed, **more)


@pytest.mark.full
def test_a_given_mass_is_known_to_the_verdicts_that_prune():
    chain, found = reversed_drive({"m1": 0.01})
    assert found.saved == 0 and found.selected.chain == chain and len(found.candidates) == 2
    assert found.selected.estimate.parameters["d12"] == pytest.approx(0.2, rel=0.05)
    mirrored = next(c for c in found.candidates if c.chain != chain)
    assert mirrored.j_train > 10 * found.selected.j_train
    (other,) = found.alternatives
    assert other.relation is Relation.UNDECIDED and "m1 may not take every value" in other.sentence
    assert "tell it apart" not in "".join(fit_text(found, found.test))


@pytest.mark.full
def test_bounds_prune_only_where_they_cut_nothing():
    for bounds, saved in (
        ({"m1": (0.0, 1.0)}, 0),
        ({"m1": (0.0, float("inf"))}, 1),
        ({"m1": (1e-3, 1.0), "m2": (1e-3, 1.0)}, 1),
        ({"m1": (1e-3, 1.0), "m2": (1e-3, 2.0)}, 0),
        ({"k12": (1.0, 1e6)}, 1),
        ({"b2": (0.0, 9.0)}, 0),
        ({"b1": (0.0, 9.0), "b2": (0.0, 9.0)}, 1),
        ({"m9": (0.0, 9.0)}, 1),
    ):
        first = representatives(REVERSED, Engine(), limits_of(bounds, {}))
        assert sum(chain != other for chain, other in first.items()) == saved, bounds
    for most, saved in ((1.0, 0), (float("inf"), 1)):
        chain, found = reversed_drive(None, bound={"m1": (0.0, most)})
        assert found.saved == saved and (chain in found.same_as) == bool(saved)


def test_a_candidate_is_fitted_where_only_complex_parameters_are_known_to_agree():
    """Two dampers to the ground for one: the same set over complex parameters; over positive
    ones nobody has decided it.
    """
    one, both = (Chain(2, meas_plus=2, damped=True, ground_dampers=at) for at in ((1,), (1, 2)))
    assert compare(one, both, query=Query(View.COMBINED)).relation is Relation.INDISTINGUISHABLE
    assert representatives([one, both], Engine(), {}) == {one: one, both: both}
    (found,) = alternatives(one, [both], Engine(), {})
    assert found.relation is Relation.UNDECIDED and "positive" in found.sentence


def test_what_the_drives_share_does_not_keep_them_apart():
    """A lag and a dead time that both have are factors of their own: equivalents inherit T1 and
    Td, given or not.
    """
    pair = [
        Chain(2, damped=True, lag=True, dead_time=True),
        Chain(2, 1, 1, 2, 1, 2, damped=True, lag=True, dead_time=True),
    ]
    assert stands_for(*pair, Engine(), {})
    assert not stands_for(*pair, Engine(), {"m1": (1.0, 1.0)})
    mirrored = [Chain(2, 0, 0, 1, 0, 2, damped=True, ground_dampers=(i,), lag=True) for i in (1, 2)]
    assert stands_for(*mirrored, Engine(), {"T1": (1e-3, 1e-3)})


@pytest.mark.full
def test_a_candidate_with_nothing_left_to_estimate_is_evaluated():
    train, test = demo(0).response("acceleration"), demo(1).response("acceleration")
    candidates = [c for c in figure_1((1, 2)) if not c.lag and len(c.ground_dampers) < 2]
    found = select(train, candidates, test=test, fix={"m1": 0.0045})
    given = next(c for c in found.candidates if c.chain == Chain(1, damped=True))
    exact = np.array([0.0045])
    assert given.j_train == pytest.approx(
        float(found.task.cost.total(found.task.plant(given.chain).response(exact)))
    )
    assert (given.n_parameters, given.standard_errors, given.admissible) == (0, {}, True)
    assert found.selected.chain == Chain(2, damped=True, ground_dampers=(1,), dead_time=True)


@pytest.mark.full
def test_a_selection_of_given_values_alone():
    train = response(Chain(1, damped=True), {"m1": 2.0}, noise=0.01)
    found = select(train, [Chain(1, damped=True)], fix={"m1": 2.0})
    assert found.selected.j_test == pytest.approx(found.selected.j_train)
    assert "m1   = 2           given" in "\n".join(fit_text(found, train))
    (inertia,) = [r for r in physical(found.selected, found.task) if r.name == "total inertia"]
    assert (inertia.value, inertia.standard_error) == (2.0, 0.0)
    assert importance_bars(found.selected, found.thresholds) is None
    assert collinearity_dots(found.selected, found.task, found.thresholds) is None
    page = fit_page(found, [inertia], [waterfall(found.selected)], train)
    assert '<th scope="row">m1</th><td class="value">2</td>' in page
    assert '<td class="n">given</td>' in page


@pytest.mark.slow
def test_all_figures_of_a_selection_of_given_values_alone():
    """In the other test: those of parameters and of starts."""
    train = response(Chain(1, damped=True), {"m1": 2.0}, noise=0.01)
    found = select(train, [Chain(1, damped=True)], fix={"m1": 2.0})
    assert len(fit_figures(found, physical(found.selected, found.task), train)) > 3


@pytest.mark.full
def test_what_is_given_does_not_count_as_determined():
    """A dead time that is given leaves four parameters for the three combinations that the rest
    determines.
    """
    chain = Chain(2, meas_plus=2, damped=True, dead_time=True)
    values = {"m1": 1.0, "m2": 0.6, "k12": 3e4, "d12": 8.0, "Td": 1e-3}
    (found,) = select(response(chain, values, noise=0.01), [chain], fix={"Td": 1e-3}).candidates
    assert found.practical.rank == 3 and not found.admissible
    assert found.practical.unidentifiable.endswith("k12/(m1*m2) and what is given")
