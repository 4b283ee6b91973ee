"""The optimal spectrum: bounded from above by cuts, better than random ones, and what it says of
single lines.
"""

import numpy as np
import pytest

from disting.fit.search.descent import Box, fine
from disting.model.chain import Chain
from disting.network import network_of
from disting.planning.power import plan
from disting.planning.rival import relative_distance
from disting.planning.spectrum import (
    CLOSE,
    KEPT,
    Adversary,
    _loose,
    _programme,
    best_band,
    design,
    optimal,
    runnable,
)
from tests.planning.test_plan import MODEL, OMEGA, RIVAL, VALUES, alike

THREE = {"m1": 0.0045, "m2": 0.005, "m3": 0.003, "k12": 550.0, "k23": 800.0}
THREE |= {"d12": 0.08, "d23": 0.05, "b1": 0.1}


@pytest.fixture(scope="module")
def adversary():
    return Adversary(plan(MODEL, VALUES, RIVAL, OMEGA, alike(0.2)).rival)


@pytest.fixture(scope="module")
def best(adversary):
    return optimal(adversary)


def random_spectra(count, seed=3):
    """Smooth ones, those of few lines, and bands."""
    source, n = np.random.default_rng(seed), len(OMEGA)
    for k in range(count):
        if k % 2:
            yield source.dirichlet(np.full(n, 10.0 ** source.uniform(-2.5, 1.0)))
        else:
            few = source.choice(n, size=source.integers(2, 30), replace=False)
            shares = np.zeros(n)
            shares[few] = source.dirichlet(np.ones(len(few)))
            yield shares


def refitted(rival, shares, starts):
    """Noncentrality by a route of its own: a fit from each start, summed up here."""
    measured = rival.cost.measured
    weights = np.sqrt(len(shares) * shares) / (rival.rho * np.abs(measured.G))
    cost = type(rival.cost)(measured, rival.cost.case, rival.cost.weights, weights)
    box = Box(np.zeros(len(starts[0])), np.full(len(starts[0]), np.inf))
    found = []
    for start in starts:
        p, _ = fine(rival.plant, cost, box, start)
        found.append(len(shares) * np.sum(shares * (relative_distance(rival, p) / rival.rho) ** 2))
    return min(found)


@pytest.mark.full
def test_optimal_spectrum_meets_its_bound_and_beats_equal_lines(adversary, best):
    assert best.shares.sum() == pytest.approx(1.0) and best.shares.min() >= 0.0
    assert best.noncentrality <= best.bound <= best.noncentrality * (1 + 3 * CLOSE)
    assert best.noncentrality > 4 * adversary.rival.noncentrality
    assert refitted(adversary.rival, best.shares, adversary.points) == pytest.approx(
        best.noncentrality, rel=1e-4
    )


@pytest.mark.full
def test_equivalence_theorem_no_line_sees_more_than_the_optimum(adversary, best):
    """Atkinson and Fedorov 1975: psi_k <= lambda on all lines, = on those of the spectrum, for some
    mixture of the rival's best fits."""
    near = [cut for cut in adversary.cuts if cut @ best.shares <= best.noncentrality * 1.01]
    assert min(cut.max() for cut in near) <= best.noncentrality * 1.1
    chosen = best.shares > 0.02
    closest = min(near, key=lambda cut: cut.max())
    assert closest[chosen] == pytest.approx(best.noncentrality, rel=0.15)


@pytest.mark.full
def test_optimal_spectrum_beats_ten_thousand_random_ones(adversary, best):
    """Every fit of the rival bounds a spectrum's noncentrality from above; what the bound leaves
    open is fitted."""
    open_ones = [s for s in random_spectra(10_000) if adversary.bound(s) > best.noncentrality]
    reached = [refitted(adversary.rival, s, adversary.points[:3]) for s in open_ones]
    assert max(reached, default=0.0) <= best.noncentrality
    some = [refitted(adversary.rival, s, adversary.points[:2]) for s in random_spectra(40, seed=4)]
    assert 0 < max(some) < best.noncentrality


@pytest.mark.full
def test_best_band_is_no_worse_than_any_band_and_no_better_than_the_optimum(adversary, best):
    band = best_band(adversary)
    hertz = adversary.rival.hertz
    for low, high in ((5, 300), (5, 60), (20, 120), (40, 90), (100, 300), (5, 20)):
        inside = (hertz >= low) & (hertz <= high)
        found = refitted(adversary.rival, inside / inside.sum(), adversary.points[:4])
        # the edges that are tried lie a third of an octave apart
        assert found <= band.noncentrality * 1.1
    assert adversary.rival.noncentrality <= band.noncentrality <= best.bound


@pytest.mark.full
def test_spectrum_to_be_run_has_all_lines_and_loses_a_tenth_at_most(adversary, best):
    run = runnable(adversary, best)
    assert run.lines == len(OMEGA) and run.shares.sum() == pytest.approx(1.0)
    assert run.noncentrality >= (1 - KEPT) * best.noncentrality * (1 - CLOSE)


@pytest.mark.slow
def test_several_valleys_of_the_rival_do_not_lead_astray():
    """Three masses: local fits alone end in a spectrum whose true noncentrality is far lower."""
    model = Chain(3, damped=True, ground_dampers=(1,))
    rival = Chain(3, damped=True, ground_dampers=(2,))
    found = design(plan(model, THREE, rival, OMEGA, alike(0.2)))
    assert found.optimum.noncentrality <= found.optimum.bound
    assert found.optimum.bound <= found.optimum.noncentrality * (1 + 3 * CLOSE)
    assert found.run.noncentrality >= (1 - KEPT) * found.optimum.noncentrality * (1 - CLOSE)


@pytest.mark.full
def test_cuts_of_very_different_sizes_have_a_bound_that_holds():
    """Such cuts, of a rival whose elements run to limits, may stop the simplex method."""
    source = np.random.default_rng(0)
    cuts = np.exp(source.uniform(-30, 7, (90, 120)))
    shares, bound = _programme(cuts)
    assert shares.sum() == pytest.approx(1)
    assert (cuts @ shares).min() == pytest.approx(bound, rel=1e-3)
    given = source.dirichlet(np.ones(120), size=2000)
    reached = (given @ cuts.T).min(axis=1).max()
    corner, last = _loose(cuts)
    assert reached <= bound * (1 + 1e-9) and bound <= last and corner.sum() == 1


@pytest.mark.slow
def test_a_rival_that_runs_to_a_limit_has_a_spectrum():
    model, rival = network_of("1=2=3, 2=4; F1; S4"), network_of("1=2=3=4; F1; S4")
    sizes = {"m": 0.01, "k": 400.0, "d": 0.1}
    values = {n: sizes[n[0]] * (1 + 0.3 * i) for i, n in enumerate(model.parameters)}
    found = design(plan(model, values, rival, OMEGA, alike(0.02)))
    assert found.optimum.noncentrality <= found.optimum.bound < np.inf
