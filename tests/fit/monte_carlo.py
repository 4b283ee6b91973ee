"""Random drives on a simulated bench, and what a fit says of them.

Noise is that of time signals, on the measured current and on the measured speed or position, so
that the relative scatter of a line varies over the lines and is large at antiresonances, as on a
bench. `KINDS` are the ways in which a drive is excited and recorded.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from disting.fit import Selection, select
from disting.fit.search.candidates import reference
from disting.fit.search.plant import Plant
from disting.measurement import FrequencyResponse, TimeSeries
from disting.model.chain import Chain
from disting.simulation import Bench, Excitation, simulate

BENCH = Bench(sampling_rate=1000.0, samples=1000)
EXCITATION = Excitation(kind="random-phase", low=4.0, high=300.0, every=3)
LEVELS = (0.02, 0.06, 0.2)  # noise of the speed [its root mean square]; of the current a tenth
SEGMENT = 1000  # samples, of Welch's method
KINDS = {
    "white": EXCITATION,
    "coloured": EXCITATION,
    "quantised": EXCITATION,
    "swept": Excitation(kind="chirp", low=4.0, high=300.0),
    "random": Excitation(kind="random-phase", low=2.0, high=400.0),
}


@dataclass(frozen=True)
class Drive:
    """A machine with known values, its noise, the seed of its measurements, and the kind of these.

    white: noise of the speed, as all but quantised; coloured: of slope 1 or 2 above 3 to 100 Hz;
    quantised: an encoder whose steps are all the noise of its output; swept: a periodic chirp;
    random: an excitation that does not repeat.
    """

    chain: Chain
    values: dict[str, float]
    level: float
    seed: int
    kind: str = "white"

    @property
    def excitation(self) -> Excitation:
        """Its test signal."""
        return KINDS[self.kind]

    def bench(self, repeats: int, again: int = 0) -> Bench:
        """How so many periods, or a record of 60 s times them, are recorded, without noise."""
        seed = 2 * self.seed + again
        if self.kind == "random":
            return replace(BENCH, samples=60_000 * repeats, periods=1, seed=seed)
        return replace(BENCH, periods=repeats, seed=seed)


def drive(n_masses: int, seed: int, kind: str = "white") -> Drive:
    """Random drive: ground dampers, lag and dead time or none, 0.3 to 10 % damping."""
    source = np.random.default_rng([seed, n_masses])
    free = range(1, n_masses + 1)
    dampers = tuple(i for i in free if source.random() < 0.5)
    chain = Chain(
        n_masses,
        quantity="velocity",
        damped=True,
        ground_dampers=dampers,
        lag=bool(source.random() < 0.4),
        dead_time=bool(source.random() < 0.5),
    )
    zeta = np.exp(source.uniform(np.log(0.003), np.log(0.1)))
    values, mass = {}, 5e-3
    for name in chain.parameters:
        letter = name[0]
        if letter == "m":
            values[name] = mass * np.exp(source.uniform(-0.7, 0.7))
        elif letter == "k":
            values[name] = mass * (2 * np.pi * source.uniform(20, 100)) ** 2
        elif letter == "d":
            omega = np.sqrt(values["k" + name[1:]] / mass)
            values[name] = 2 * zeta * mass * omega * np.exp(source.uniform(-0.5, 0.5))
        elif letter == "b":
            values[name] = mass * 2 * np.pi * np.exp(source.uniform(np.log(2.0), np.log(20.0)))
        else:
            values[name] = float(np.exp(source.uniform(np.log(2e-4), np.log(2e-3))))
    return Drive(chain, {k: float(v) for k, v in values.items()}, LEVELS[seed % 3], seed, kind)


def recorded(machine: Drive, repeats: int, again: int = 0) -> TimeSeries:
    """Current and speed, or position, over so many periods; `again`: another measurement."""
    bench, excitation = machine.bench(repeats, again), machine.excitation
    quiet = simulate(machine.chain, machine.values, excitation, bench)
    size = machine.level * float(np.sqrt(np.mean(quiet.y**2)))
    noisy = replace(bench, input_noise=0.1 * machine.level, output_noise=size)
    if machine.kind == "coloured":
        corner = 3.0 * (100 / 3) ** np.random.default_rng([machine.seed, 7]).random()
        noisy = replace(noisy, noise_slope=1.0 + machine.seed % 2, noise_corner=corner)
    if machine.kind == "quantised":  # as much as the other kinds at 100 Hz
        seen = replace(machine.chain, quantity="position")
        noisy = replace(noisy, output_noise=0.0, quantum=np.sqrt(12) * size / (2 * np.pi * 100))
        return simulate(seen, machine.values, excitation, noisy)
    return simulate(machine.chain, machine.values, excitation, noisy)


def measured(
    machine: Drive, repeats: int, again: int = 0, trend: str = "remove"
) -> FrequencyResponse:
    """The acceleration response of what was recorded, by the reader of the package."""
    series = recorded(machine, repeats, again)
    if machine.kind == "random":
        return series.response("acceleration", segment=SEGMENT, band=(4.0, 300.0))
    lines = machine.excitation.lines(BENCH.samples, BENCH.sampling_rate)
    return series.response(
        "acceleration",
        period=BENCH.samples,
        transient=0,
        lines=lines * BENCH.sampling_rate / BENCH.samples,
        trend=trend,
    )


def by_hand(machine: Drive, repeats: int) -> tuple[np.ndarray, np.ndarray]:
    """omega and the acceleration response of what was recorded, by numpy alone."""
    series = recorded(machine, repeats)
    n, step = BENCH.samples, BENCH.samples
    lines = machine.excitation.lines(n, BENCH.sampling_rate)
    window = np.ones(n)
    if machine.kind == "random":
        n, step = SEGMENT, SEGMENT // 2
        lines = np.arange(4, 301, 2)
        window = np.sin(np.pi * np.arange(n) / n) ** 2
    starts = range(0, len(series) - n + 1, step)
    cut = [[x[i : i + n] for i in starts] for x in (series.u, series.y)]
    u, y = (
        np.array([np.fft.rfft((one - one.mean()) * window)[lines] for one in each]) for each in cut
    )
    against = u if machine.kind == "random" else np.ones_like(u)
    omega = 2 * np.pi * lines * BENCH.sampling_rate / n
    steps = 2 - series.quantity.order
    quotient = (y * against.conj()).sum(axis=0) / (u * against.conj()).sum(axis=0)
    return omega, (1j * omega) ** steps * quotient


def true_scatter(machine: Drive, omega: np.ndarray, repeats: int) -> np.ndarray:
    """The relative scatter rho of each line, by formula: white noise through Y/U."""
    quiet = simulate(machine.chain, machine.values, EXCITATION, replace(BENCH, periods=1))
    size = float(np.sqrt(np.mean(quiet.y**2)))
    n = BENCH.samples
    line = np.round(omega / 2 / np.pi * n / BENCH.sampling_rate).astype(int)
    u, y = np.fft.rfft(quiet.u)[line], np.fft.rfft(quiet.y)[line]
    power = (0.1 * machine.level) ** 2 * n / np.abs(u) ** 2
    power = power + (machine.level * size) ** 2 * n / np.abs(y) ** 2
    return np.sqrt(power / 2 / repeats)


def truth(machine: Drive) -> Chain:
    """The structure as it is offered to a fit."""
    return replace(machine.chain, quantity="acceleration")


def offered(machine: Drive) -> list[Chain]:
    """The true structure and its neighbours: fewer and more masses, dampers, lag and dead time."""
    true = truth(machine)
    n, sets = (
        true.n_masses,
        lambda n: [c for size in range(n + 1) for c in combinations(range(1, n + 1), size)],
    )
    every = [replace(true, ground_dampers=chosen) for chosen in sets(n)]
    every += [replace(true, lag=a, dead_time=b) for a in (False, True) for b in (False, True)]
    fewer = replace(true, n_masses=n - 1, ground_dampers=())
    for chosen in sets(n - 1):
        every += [
            replace(fewer, ground_dampers=chosen),
            replace(fewer, ground_dampers=chosen, lag=True, dead_time=True),
        ]
    every += [replace(true, n_masses=n + 1)]
    return list(dict.fromkeys(every))


def response_at(chain: Chain, values: dict[str, float], omega: np.ndarray) -> np.ndarray:
    """Exact response."""
    return Plant(chain.structure, omega).response(np.array([values[n] for n in chain.parameters]))


@dataclass(frozen=True)
class Outcome:
    """What was said of one drive."""

    kept: bool
    explained: bool
    size: int
    smaller_excluded: float
    inside: dict[str, tuple[int, int]]


def outcome(machine: Drive, found: Selection) -> Outcome:
    """Whether the truth is left, how many structures are, and which intervals hold the values."""
    true = truth(machine)
    stands = found.same_as.get(true, true)
    every = (*found.members, *found.containing)
    names = {m.name for m in every}
    twins = {t.name for m in found.members for t in m.twins}
    undecided = {name for m in found.members for name in m.open}
    left = {m.candidate.chain for m in every}
    kept = (
        stands in left
        or reference(true) in names | twins | undecided
        or any(a.chain == true for a in found.alternatives)
    )
    fewer = [c for c in found.candidates if c.chain.n_masses < true.n_masses]
    out = sum(c.chain not in left for c in fewer)
    member = next((m for m in found.members if m.candidate.chain == stands), None)
    inside: dict[str, tuple[int, int]] = {}
    if member is not None and stands == true:
        for name, (low, high) in member.intervals.items():
            hits, tries = inside.get(name[0], (0, 0))
            inside[name[0]] = (hits + (low <= machine.values[name] <= high), tries + 1)
    return Outcome(kept, found.explanation.explains, len(every), out / max(len(fewer), 1), inside)


def selected(machine: Drive, repeats: int, tested: bool = False, **options: object) -> Selection:
    """The fit of one drive."""
    train = measured(machine, repeats)
    test = measured(machine, repeats, 1) if tested else None
    return select(train, offered(machine), test=test, **options)


def table(outcomes: Sequence[Outcome]) -> str:
    """Figures of several drives in a line."""
    n = len(outcomes)
    inside: dict[str, list[int]] = {}
    for one in outcomes:
        for kind, (hits, tries) in one.inside.items():
            both = inside.setdefault(kind, [0, 0])
            both[0] += hits
            both[1] += tries
    said = ", ".join(f"{k} {h}/{t}={h / t:.2f}" for k, (h, t) in sorted(inside.items()))
    return (
        f"n {n}, kept {sum(o.kept for o in outcomes)}, explained"
        f" {sum(o.explained for o in outcomes)}, mean set {np.mean([o.size for o in outcomes]):.2f},"
        f" smaller excluded {np.mean([o.smaller_excluded for o in outcomes]):.3f}; {said}"
    )
