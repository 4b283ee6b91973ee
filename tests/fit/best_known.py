"""The best known costs of the 120 candidates on the bench, from 20 independent searches: made
once, kept beside this module.

    python -m tests.fit.best_known

A search shares the response and its derivatives with `disting.fit`, not its starts: random chains
over wide ranges, random splits of masses of smaller fits down to very small ones, and random steps
from the fits of neighbours, all brought to the end without dropping any, until nothing moves. The
best of all searches go through one more exchange. Takes half an hour.
"""

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from disting.fit.search.candidates import figure_1
from disting.fit.search.cost import Cost
from disting.fit.search.descent import fine, rough
from disting.fit.search.estimate import Task
from disting.fit.search.neighbours import neighbours
from disting.fit.search.starts import Parameters, Scale, merge, scale, split, stack
from disting.model.chain import Chain
from tests.fit.drives import bench

FILE = Path(__file__).with_name("best_known_bench.json")
SEARCHES, RANDOM, SPLITS = 20, 6, 6
ITERATIONS = 40
GAIN = 1e-4  # relative: what a search calls better
Found = dict[Chain, tuple[float, Parameters]]


def name(chain: Chain) -> str:
    """Key of a candidate in the file."""
    extras = [f"b{i}" for i in chain.ground_dampers] + ["T1"] * chain.lag + ["Td"] * chain.dead_time
    return " ".join([str(chain.n_masses), *extras])


def best_known() -> dict[str, tuple[float, dict[str, float]]]:
    """Cost and parameters by `name`."""
    return {key: (j, values) for key, (j, values) in json.loads(FILE.read_text()).items()}


def drawn(names: tuple[str, ...], size: Scale, source: np.random.Generator) -> Parameters:
    """A chain with masses, resonances and damping over wide ranges."""
    n = sum(x[0] == "m" for x in names)
    masses = size.mass * source.dirichlet(np.full(n, 0.7)) * np.exp(0.2 * source.normal())
    values = {}
    for x in names:
        spread = 10.0 ** source.uniform(-3, 0.5)
        match x[0]:
            case "m":
                values[x] = max(float(masses[int(x[1]) - 1]), 1e-6 * size.mass)
            case "k":
                i = int(x[1])
                omega = np.exp(source.uniform(np.log(0.5 * size.low), np.log(1.5 * size.high)))
                values[x] = (
                    values[f"m{i}"]
                    * values[f"m{i + 1}"]
                    / (values[f"m{i}"] + values[f"m{i + 1}"])
                    * omega**2
                )
            case "d":
                values[x] = spread * values["k" + x[1:]] / np.sqrt(size.low * size.high)
            case "b":
                values[x] = spread * size.mass * size.low
            case _:
                values[x] = spread / size.high
    return values


def stepped(chain: Chain, fit: Parameters, size: Scale, source: np.random.Generator) -> Parameters:
    """A neighbour's fit, what it lacks drawn anew, every other time shaken."""
    shake = 0.3 * source.integers(2)
    fresh = drawn(chain.parameters, size, source)
    return {
        x: fit.get(x, fresh[x]) * float(np.exp(shake * source.normal())) for x in chain.parameters
    }


def splits(
    chain: Chain, found: Found, size: Scale, source: np.random.Generator
) -> Iterator[Parameters]:
    """Random masses of smaller fits split, the part from a ten-thousandth on, tuned to a random
    frequency.
    """
    choices = [(joint, fewer) for joint, fewer in merge(chain) if fewer in found]
    for _ in range(SPLITS if choices else 0):
        joint, fewer = choices[source.integers(len(choices))]
        start = dict(next(split(chain, joint, found[fewer][1], size)))
        whole, share = found[fewer][1][f"m{joint}"], 10.0 ** source.uniform(-4, -0.3)
        parts = [share * whole, (1 - share) * whole][:: 1 if source.integers(2) else -1]
        omega = np.exp(source.uniform(np.log(0.7 * size.low), np.log(1.3 * size.high)))
        key = f"{joint}{joint + 1}"
        start |= {f"m{joint}": parts[0], f"m{joint + 1}": parts[1]}
        start |= {f"k{key}": parts[0] * parts[1] / whole * omega**2}
        start |= {f"d{key}": 10.0 ** source.uniform(-3, 0) * start[f"k{key}"] / omega}
        yield start


def descended(chain: Chain, task: Task, starts: list[Parameters], found: Found) -> bool:
    """Whether the best of the starts is better than what is known; then it is known."""
    at = stack(starts, chain.parameters)
    points, costs = rough(task.plant(chain), task.cost, task.box(chain.parameters), at, ITERATIONS)
    i = int(np.nanargmin(costs))
    better = chain not in found or costs[i] < found[chain][0] * (1 - GAIN)
    if better:
        found[chain] = (
            float(costs[i]),
            dict(zip(chain.parameters, map(float, points[i]), strict=True)),
        )
    return better


def exchanged(task: Task, found: Found, size: Scale, source: np.random.Generator) -> None:
    """Fits of neighbours as starts, until no candidate gets better."""
    offered = {chain: {n for n in neighbours(chain) if n in found} for chain in found}
    while any(offered.values()):
        for chain in sorted(found, key=repr):
            starts = [
                stepped(chain, found[n][1], size, source) for n in sorted(offered[chain], key=repr)
            ]
            offered[chain] = set()
            if starts and descended(chain, task, starts, found):
                for n in neighbours(chain):
                    if n in found:
                        offered[n].add(chain)


def search(seed: int, task: Task, candidates: tuple[Chain, ...]) -> Found:
    """One independent search over all candidates."""
    source, size, found = np.random.default_rng(seed), scale(task.cost.measured), Found()
    for n in sorted({c.n_masses for c in candidates}):
        new = Found()
        for chain in (c for c in candidates if c.n_masses == n):
            starts = [drawn(chain.parameters, size, source) for _ in range(RANDOM)]
            descended(chain, task, [*starts, *splits(chain, found, size, source)], new)
        exchanged(task, new, size, source)
        found |= new
    return found


def pooled(task: Task, searches: list[Found]) -> Found:
    """The best of all searches, exchanged once more, to the last digit."""
    best = {chain: min((s[chain] for s in searches), key=lambda f: f[0]) for chain in searches[0]}
    for n in sorted({c.n_masses for c in best}):
        part = {c: f for c, f in best.items() if c.n_masses == n}
        exchanged(task, part, scale(task.cost.measured), np.random.default_rng(n))
        best |= part
    for chain, (_, values) in best.items():
        p, j = fine(
            task.plant(chain),
            task.cost,
            task.box(chain.parameters),
            np.array(list(values.values())),
        )
        best[chain] = j, dict(zip(chain.parameters, map(float, p), strict=True))
    return best


def main() -> None:
    """Write the file."""
    task, searches = Task(Cost(bench("A"))), []
    with threadpool_limits(1):
        for seed in range(SEARCHES):
            searches.append(search(seed, task, figure_1()))
            lowest = {c: min(s[c][0] for s in searches) for c in searches[0]}
            missed = sum(searches[-1][c][0] > j * 1.001 for c, j in lowest.items())
            print(
                f"search {seed}: {missed} above the best so far, sum of the best"
                f" {sum(lowest.values()):.4f}",
                flush=True,
            )
        best = pooled(task, searches)
    FILE.write_text(json.dumps({name(c): best[c] for c in sorted(best, key=name)}, indent=1) + "\n")


if __name__ == "__main__":
    main()
