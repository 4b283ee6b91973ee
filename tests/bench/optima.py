"""How often the search of a candidate ends beside its best optimum; not run by pytest.

    python optima.py OUT.jsonl [COUNT]              # fit COUNT problems (200) with the version on PYTHONPATH
    python optima.py --table OUT.jsonl OTHER.jsonl  # count what either missed

A problem is a simulated drive of 2 to 4 masses, 1 % noise, 100 lines, and two candidates: its structure, and
the same with a damper to the ground more. Cost J in units of the noise; the best known of a candidate is the least of both
versions and of a local search from the true values. Missed: J above the best by more than 1 % and 2.
"""

import json
import sys
from dataclasses import replace
from pathlib import Path
from time import process_time

import numpy as np

from disting import Chain
from disting.fit import Case, Task, estimates, predict
from disting.fit.search.cost import Cost
from disting.fit.search.descent import fine
from disting.measurement import FrequencyResponse

NOISE, LINES = 0.01, 100
SHARE, UNITS = 0.01, 2.0  # of the best cost, beyond which it is missed


def drive(number: int) -> tuple[Chain, dict[str, float]]:
    """Structure and values of a drawn drive: resonances of 10 to 150 Hz, damping 0.3 to 5 %."""
    draw = np.random.default_rng(number)
    n = int(draw.integers(2, 5))
    dampers = tuple(i for i in range(1, n + 1) if draw.random() < 0.3)
    chain = Chain(
        n,
        meas_plus=int(draw.choice([1, 1, n])),
        damped=True,
        ground_dampers=dampers,
        lag=bool(draw.random() < 0.2),
        dead_time=bool(draw.random() < 0.4),
    )
    size = 10 ** draw.uniform(-3.5, -2)
    values = {}
    for name in chain.parameters:
        if name[0] == "m":
            values[name] = size * 10 ** draw.uniform(-0.5, 0.5)
        elif name[0] == "k":
            values[name] = 0.5 * size * (2 * np.pi * draw.uniform(10, 100)) ** 2
        elif name[0] == "d":
            stiffness = values["k" + name[1:]]
            values[name] = 2 * draw.uniform(0.003, 0.05) * np.sqrt(stiffness * size)
        elif name[0] == "b":
            values[name] = size * draw.uniform(1, 15)
        else:
            values[name] = 10 ** draw.uniform(-4, -3)
    return chain, values


def larger(chain: Chain) -> Chain | None:
    """With one damper to the ground more; None where every mass has one."""
    free = [i for i in range(1, chain.n_masses + 1) if i not in chain.ground_dampers]
    return replace(chain, ground_dampers=(*chain.ground_dampers, free[0])) if free else None


def run(number: int) -> list[dict[str, object]]:
    """One row for each candidate."""
    chain, values = drive(number)
    omega = 2 * np.pi * np.geomspace(4, 300, LINES)
    true = predict(chain, values, omega)
    draw = np.random.default_rng(10_000 + number)
    noise = (draw.normal(size=LINES) + 1j * draw.normal(size=LINES)) * NOISE
    data = FrequencyResponse(omega, true * (1 + noise))
    cost = Cost(data, Case.COMPLEX, lines=1 / (NOISE * np.abs(data.G)))
    task = Task(cost)
    both = [c for c in (chain, larger(chain)) if c is not None]
    begun = process_time()
    found = estimates(both, task)
    spent = process_time() - begun
    start = np.array([values[name] for name in task.names(chain)])
    _, near = fine(task.plant(chain), cost, task.box(task.names(chain)), start)
    return [
        {"problem": number, "candidate": str(c), "j": found[c].j, "near": near, "cpu": spent}
        for c in both
    ]


def table(paths: list[Path]) -> None:
    """Print what each version missed, and CPU seconds."""
    rows = [
        {(r["problem"], r["candidate"]): r for r in map(json.loads, p.read_text().splitlines())}
        for p in paths
    ]
    common = set.intersection(*map(set, rows))
    best = {key: min(x for r in rows for x in (r[key]["j"], r[key]["near"])) for key in common}
    for path, each in zip(paths, rows, strict=True):
        missed = [k for k in common if each[k]["j"] > best[k] * (1 + SHARE) + UNITS]
        spent = sum({k[0]: each[k]["cpu"] for k in common}.values())
        print(f"{path.name}: missed {len(missed)} of {len(common)}, {spent:.0f} s CPU")
        for key in sorted(missed)[:20]:
            print(f"  {key[0]} {key[1]}: J {each[key]['j']:.1f}, best {best[key]:.1f}")


if __name__ == "__main__":
    if sys.argv[1] == "--table":
        table([Path(name) for name in sys.argv[2:]])
    else:
        out = Path(sys.argv[1])
        done = (
            len({json.loads(x)["problem"] for x in out.read_text().splitlines()})
            if out.is_file()
            else 0
        )
        for number in range(done, int(sys.argv[2]) if len(sys.argv) > 2 else 200):
            with out.open("a") as file:
                file.writelines(json.dumps(row) + "\n" for row in run(number))
