"""How much faster, and how much better, are structured starts than swarms and evolution? Measured
side by side, one core.

Third-party data of a motor bench where it is beside the checkout, else the simulated demonstration
drive.
"""

import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

from disting.fit.search.candidates import figure_1
from disting.fit.search.cost import Cost
from disting.fit.search.descent import WORTHLESS, fine, rough
from disting.fit.search.estimate import ITERATIONS, Task
from disting.fit.search.exchange import estimates
from disting.fit.search.swarm import by_swarm, search_box
from disting.fit.select import select
from disting.measurement import FrequencyResponse
from disting.model.chain import Chain
from disting.simulation import demo
from tests.bench.measure import alternating, seconds, table
from tests.fit.best_known import best_known, name
from tests.fit.drives import bench, response
from tests.measurement.bench_data import DATA

pytestmark = pytest.mark.bench
TRIED = [
    Chain(1, damped=True, ground_dampers=(1,), dead_time=True),
    Chain(2, damped=True, ground_dampers=(2,), dead_time=True),
    Chain(3, damped=True, dead_time=True),
]
# against evolution and CMA-ES only: a swarm takes too long
LARGER = Chain(4, damped=True, ground_dampers=(1,), dead_time=True)


def measured() -> tuple[FrequencyResponse, FrequencyResponse]:
    return (
        (bench("A"), bench("B"))
        if DATA.exists()
        else (demo(0).response("acceleration"), demo(1).response("acceleration"))
    )


def evolved(chain: Chain, task: Task) -> float:
    """scipy's differential evolution, polished, 15 individuals a parameter."""
    from scipy.optimize import differential_evolution

    low, high = search_box(chain, task)
    plant = task.plant(chain)

    def cost(x: np.ndarray) -> np.ndarray:
        return task.cost.total(plant.response(np.exp(x.T)))

    bounds = list(zip(low, high, strict=True))
    return float(
        differential_evolution(
            cost, bounds, seed=1, vectorized=True, updating="deferred", polish=False
        ).fun
    )


def adapted(chain: Chain, task: Task) -> float:
    """CMA-ES of the package cma, its defaults, three restarts."""
    import cma

    low, high = search_box(chain, task)
    plant = task.plant(chain)
    options = {"bounds": [low, high], "seed": 1, "verbose": -9}
    if len(low) < 2:
        return float("nan")
    found = cma.fmin2(
        lambda x: float(task.cost.total(plant.response(np.exp(x)))),
        (low + high) / 2,
        2.0,
        options,
        restarts=2,
    )
    return float(found[1].result.fbest)


def test_against_swarm_evolution_and_cma(benchmark) -> None:
    task = Task(Cost(measured()[0]))
    benchmark.pedantic(lambda: estimates(TRIED[1:2], task), rounds=3)
    rows, ratios = [], []
    for chain in TRIED:
        ours_time = seconds(lambda c=chain: estimates([c], task))
        ours = estimates([chain], task)[chain].j
        start = time.perf_counter()
        swarm = by_swarm(chain, task, {}).j
        swarm_time = time.perf_counter() - start
        others = {"evolution": evolved(chain, task), "CMA-ES": adapted(chain, task), "swarm": swarm}
        assert all(not ours > j * (1 + 1e-6) for j in others.values())
        ratios.append(swarm_time / ours_time)
        costs = [
            f"{ours:.4f}",
            *(f"{others[name]:.4f}" for name in ("swarm", "evolution", "CMA-ES")),
        ]
        name = f"{chain.n_masses} masses, {len(chain.parameters)} parameters"
        rows.append(
            (name, f"{ours_time:.2f} s", f"{swarm_time:.0f} s", f"{ratios[-1]:.0f}", *costs)
        )
    ours = estimates([LARGER], task)[LARGER].j
    others = [evolved(LARGER, task), adapted(LARGER, task)]
    assert ours <= min(others)
    rows.append(
        ("4 masses, 12 parameters", "", "", "", f"{ours:.4f}", "", *(f"{j:.4f}" for j in others))
    )
    heads = [
        "candidate",
        "starts",
        "swarm",
        "ratio",
        "J starts",
        "J swarm",
        "J evolution",
        "J CMA-ES",
    ]
    table("One candidate and what leads to it, one core", heads, rows)
    assert min(ratios) > 100


def test_all_candidates(benchmark) -> None:
    train, test = measured()
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        list(pool.map(abs, range(2)))
        start = time.perf_counter()
        found = benchmark.pedantic(
            lambda: select(train, figure_1(), test=test, executor=pool), rounds=1
        )
        taken = time.perf_counter() - start
    task = Task(Cost(train))
    swarm = {n: seconds(lambda n=n: by_swarm(Chain(n, damped=True), task, {})) for n in (1, 2)}
    rows = [
        ("120 candidates, train and test, 2 workers", f"{taken:.1f} s", str(found.selected.chain))
    ]
    rows.append(
        (
            "swarm, 1 and 2 masses without extras, one candidate each",
            f"{swarm[1]:.1f} s, {swarm[2]:.1f} s",
            "",
        )
    )
    table("Selection", ["what", "time", "selected"], rows)


def test_optima_of_all_candidates() -> None:
    """Processor time of the 120 fits, and how far they are above the best of 20 independent
    searches.
    """
    task = Task(Cost(bench("A")))
    start = time.process_time()
    found = estimates(figure_1(), task)
    taken = time.process_time() - start
    known = best_known()
    excess = [fit.j / known[name(chain)][0] - 1 for chain, fit in found.items()]
    starts = sum(len(fit.costs) for fit in found.values())
    row = (
        f"{taken:.1f} s",
        str(starts),
        str(sum(e > 1e-3 for e in excess)),
        f"{max(excess):.1e}",
        f"{min(excess):.1e}",
    )
    heads = [
        "processor time",
        "starts",
        "above the best known by 0.1 %",
        "largest excess",
        "smallest excess",
    ]
    table("120 candidates on the bench", heads, [row])
    assert max(excess) < 1e-3


def test_one_residual_and_jacobian(benchmark) -> None:
    """A 4-mass model at 240 lines, against the same by a dense solve and central differences."""
    omega = 2 * np.pi * np.linspace(11, 250, 240)
    chain = Chain(4, damped=True, ground_dampers=(1, 2, 3, 4), lag=True, dead_time=True)
    p = np.array(
        [{"m": 1.0, "k": 1e5, "d": 5.0, "b": 5.0, "T": 1e-3}[name[0]] for name in chain.parameters]
    )
    task = Task(Cost(FrequencyResponse(omega, np.ones(240, complex))))
    plant = task.plant(chain)

    def differences() -> None:
        for i in range(len(p)):
            step = 1e-6 * p[i] * (np.arange(len(p)) == i)
            task.cost.residual(plant.response(p + step)) - task.cost.residual(
                plant.response(p - step)
            )

    benchmark(lambda: task.cost.of(plant, p))
    taken = alternating(
        {"analytic": lambda: task.cost.of(plant, p), "differences": differences}, 200
    )
    micro = {name: f"{1e6 * t:.0f} µs" for name, t in taken.items()}
    ratio = f"{taken['differences'] / taken['analytic']:.1f}"
    table(
        "Residual and Jacobian, 16 parameters, 240 lines",
        ["analytic", "central differences", "ratio"],
        [(*micro.values(), ratio)],
    )


def test_rough_search_beside_least_squares() -> None:
    """From the same starts, to the same relative gain: many at once against one after the other."""
    task = Task(Cost(measured()[0]))
    source, rows, ratios = np.random.default_rng(1), [], []
    for chain in (*TRIED[1:], LARGER):
        best = estimates([chain], task)[chain]
        plant, box = task.plant(chain), task.box(task.names(chain))
        there = np.array(list(best.parameters.values()))
        starts = there * np.exp(source.uniform(-1.0, 1.0, (40, len(there))))
        costs = dict[str, np.ndarray]()

        def ours(plant=plant, box=box, starts=starts, costs=costs) -> None:
            costs["ours"] = rough(plant, task.cost, box, starts, ITERATIONS)[1]

        def scipys(plant=plant, box=box, starts=starts, costs=costs) -> None:
            ends = [fine(plant, task.cost, box, start, WORTHLESS)[1] for start in starts]
            costs["scipy"] = np.array(ends)

        taken = alternating({"ours": ours, "scipy": scipys}, 3)
        ratios.append(taken["scipy"] / taken["ours"])
        near = {name: f"{np.mean(j <= 1.001 * best.j):.0%}" for name, j in costs.items()}
        each = [f"{1e3 * taken[name] / len(starts):.1f} ms" for name in ("ours", "scipy")]
        rows.append((f"{len(there)}", *each, f"{ratios[-1]:.1f}", near["ours"], near["scipy"]))
    heads = ["parameters", "a start", "by scipy", "ratio", "reach the optimum", "by scipy"]
    table("40 starts within a factor e of the optimum", heads, rows)
    assert min(ratios) > 2


def test_many_lines() -> None:
    """Processor time of 24 candidates by the number of lines, a ratio to that of 1000."""
    values = {"m1": 4.5e-3, "m2": 5e-3, "k12": 550.0, "d12": 0.08, "b1": 0.1, "Td": 3e-4}
    chain = Chain(2, damped=True, ground_dampers=(1,), dead_time=True)
    taken, rows = [], []
    for count in (1000, 10_000):
        measured = response(chain, values, 2 * np.pi * np.linspace(5.0, 250.0, count), noise=0.02)
        start = time.process_time()
        found = select(measured, figure_1([1, 2]))
        taken.append(time.process_time() - start)
        assert found.selected.chain == chain
        rows.append((str(count), f"{taken[-1]:.1f} s", f"{taken[-1] / taken[0]:.1f}"))
    table("24 candidates, one process", ["lines", "processor time", "ratio"], rows)
    assert taken[1] < 10 * taken[0]
