"""What may be relied on whichever of the structures that a fit leaves is the machine: ranges over
all of them and their uncertainty.

Each structure is drawn many times (`samples`), its own fit among the draws; a range holds 95 % of
the draws of every structure. What behaves as a fitted structure does at the sensor (its twins) has
the same resonances, antiresonances and margins; masses and responses elsewhere differ, and are
those of the twin, of a family those of one of it. What only contains a structure of the set, and
what is not decided, is not looked at. Of what is known badly a note says whether the structures lie
apart, so that another experiment helps, or the uncertainty of one is as wide, so that more
measuring does.

The margins are those of a controller around the sensor of the data (`loop`).
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from math import inf, isfinite, log10, pi

import numpy as np

from disting.fit.judge.members import Member
from disting.fit.judge.modes import oscillations, poles, zeros
from disting.fit.results.loop import Controller, Margins, margins
from disting.fit.results.samples import ParameterSamples, draw_samples, with_twins
from disting.fit.search.estimate import Task
from disting.fit.search.plant import Plant
from disting.measurement.arrays import Complex, Real, spread
from disting.model.chain import Chain, Structure

LINES = 400  # of a response that is drawn, at most
WIDE, WIDE_LEVEL = 1.5, 3.0  # ratio of the ends of a range, and dB, from which on a note says why
FAMILY = "of many equivalents one was looked at"
BETWEEN = "the structures lie apart: disting next tells what to measure"
WITHIN = "known badly: more periods or lines help"
OUTER = 2.5  # percent of the draws on either side that a range leaves out
SAME = 1.25  # ratio of two frequencies up to which they are one resonance
ROOTS = {"antiresonance": zeros, "resonance": poles}


class Kind(StrEnum):
    """What a statement is of: a quantity, how far responses lie apart, whether a loop is stable."""

    RANGE = "range"
    APART = "apart"
    STABLE = "stable"


@dataclass(frozen=True, slots=True)
class Statement:
    """`name` lies between `low` and `high` [`unit`] in `holds` of `total` structures; an infinite
    end has no bound. `note` says what else has to be known.
    """

    kind: Kind
    name: str
    low: float
    high: float
    unit: str
    holds: int
    total: int
    note: str = ""

    @property
    def text(self) -> str:
        """In words.

        >>> Statement(Kind.RANGE, "phase margin", 41.2, 44.0, "deg", 7, 7).text
        'phase margin: 41.2 to 44 deg, whichever it is'
        """
        whose = (
            "whichever it is" if self.holds == self.total else f"in {self.holds} of {self.total}"
        )
        note = f" ({self.note})" if self.note else ""
        return f"{self.name}: {self.size}, {whose}{note}"

    @property
    def size(self) -> str:
        """The range, in words."""
        low, high = (f"{x + 0.0:.3g}" for x in (self.low, self.high))
        unit = f" {self.unit}" if self.unit else ""
        match self.kind:
            case Kind.STABLE:
                return "stable"
            case Kind.APART:
                return f"at most {high}{unit} apart"
        if not isfinite(self.high):
            return f"over {low}{unit}"
        return f"{low}{unit}" if low == high else f"{low} to {high}{unit}"


def statements(
    left: Sequence[Member], task: Task, controller: Controller | None = None
) -> tuple[Statement, ...]:
    """What holds for all structures that the data do not exclude; nothing where none is left.

    Raises InputError where no margins can be told.
    """
    fitted = draw_samples(left, task)
    if not fitted:
        return ()
    omega = np.unique(np.concatenate([part.measured.omega for part in task.cost.parts]))
    some = omega[spread(np.log(omega), min(len(omega), LINES))]
    every = list(with_twins(left, fitted, some))
    family = FAMILY if any(twin.free_choices for m in left for twin in m.twins) else ""
    both = (_at_the_sensor(fitted, some), _at_the_load(every, some, family))
    return (
        total_inertia(every, family),
        *_roots(fitted, (float(omega[0]) / (2 * pi), float(omega[-1]) / (2 * pi))),
        *(both if len(every) > 1 else ()),
        *(_margins(fitted, controller, omega) if controller else ()),
    )


def _spread(values: Iterable[float]) -> tuple[float, float]:
    """Range of the draws of one structure, the outer ones left out."""
    own_values = np.array(list(values))
    if not np.all(np.isfinite(own_values)):
        return (float(own_values.min()), inf)
    low, high = np.percentile(own_values, [OUTER, 100 - OUTER])
    return float(low), float(high)


def _joined(
    name: str,
    unit: str,
    ranges: Sequence[tuple[float, float]],
    numbers: tuple[int, int],
    note: str = "",
) -> Statement:
    low, high = min(low for low, _ in ranges), max(high for _, high in ranges)
    cause = ""
    if isfinite(high) and high > WIDE * low:
        cause = WITHIN if any(above > WIDE * below for below, above in ranges) else BETWEEN
    said = "; ".join(filter(None, [note, cause]))
    return Statement(Kind.RANGE, name, low, high, unit, *numbers, said)


def total_inertia(every: Sequence[ParameterSamples], family: str) -> Statement:
    """Of all masses."""
    ranges = []
    for sample in every:
        at = [i for i, name in enumerate(sample.chain.parameters) if name[0] == "m"]
        ranges.append(_spread(sample.p[:, at].sum(axis=1)))
    return _joined("total inertia", "", ranges, (len(ranges), len(ranges)), family)


def _roots(fitted: Sequence[ParameterSamples], band: tuple[float, float]) -> Iterator[Statement]:
    """Resonances and antiresonances within the band [Hz] of the first structure, and what the
    others have nearest.
    """
    total = sum(sample.alike for sample in fitted)
    for kind, roots_of in ROOTS.items():
        nominal = [oscillations(_roots_at(sample, roots_of, 0)) for sample in fitted]
        inside = [r for r in nominal[0] if band[0] <= abs(r) / (2 * pi) <= band[1]]
        for number, root in enumerate(inside, 1):
            near = [
                (sample, nearest(roots, root))
                for sample, roots in zip(fitted, nominal, strict=True)
            ]
            having = [(sample, own) for sample, own in near if own is not None]
            follow = [_followed(sample, roots_of, own) for sample, own in having]
            numbers = (sum(sample.alike for sample, _ in having), total)
            name = f"{kind} {number}"
            hertz = [_spread(abs(r) / (2 * pi) for r in roots) for roots in follow]
            damping = [_spread(-r.real / abs(r) for r in roots) for roots in follow]
            yield _joined(name, "Hz", hertz, numbers)
            yield _joined(f"damping ratio of {name}", "", damping, numbers)


def _roots_at(sample: ParameterSamples, roots_of: Callable[..., Complex], k: int) -> Complex:
    structure = sample.chain.structure
    return roots_of(structure, sample.p[k, : len(structure.parameters)])


def _followed(
    sample: ParameterSamples, roots_of: Callable[..., Complex], root: complex
) -> list[complex]:
    """The root in all draws in which it is still there."""
    nearest_roots = (
        nearest(oscillations(_roots_at(sample, roots_of, k)), root, inf)
        for k in range(len(sample.p))
    )
    return [r for r in nearest_roots if r is not None]


def nearest(roots: Sequence[complex], root: complex, ratio: float = SAME) -> complex | None:
    """The root of the nearest frequency, if their ratio is no larger; None if there is none."""
    apart = [(max(abs(r) / abs(root), abs(root) / abs(r)), r) for r in roots]
    size, nearest = min(apart, key=lambda x: x[0], default=(inf, root))
    return nearest if size <= ratio and isfinite(size) else None


def _at_the_sensor(fitted: Sequence[ParameterSamples], omega: Real) -> Statement:
    """How far the responses lie apart."""
    responses = (Plant(sample.chain.structure, omega).response(sample.p) for sample in fitted)
    total = sum(sample.alike for sample in fitted)
    return _apart("response at the sensor", responses, omega, total)


def _apart(
    name: str, responses: Iterable[Complex], omega: Real, total: int, note: str = ""
) -> Statement:
    """The largest ratio of two amplitudes at one frequency [dB]; `responses` of the draws of each
    structure, shape (n, n_f).
    """
    levels = [20 * np.log10(np.abs(own)) for own in responses]
    ends = np.array([np.percentile(own, [OUTER, 100 - OUTER], axis=0) for own in levels])
    size = ends[:, 1].max(axis=0) - ends[:, 0].min(axis=0)
    at = int(np.argmax(size))
    cause = ""
    if size[at] > WIDE_LEVEL:
        within = np.max(ends[:, 1, at] - ends[:, 0, at]) > WIDE_LEVEL
        cause = WITHIN if within else BETWEEN
    where = f"largest at {omega[at] / (2 * pi):.3g} Hz, between {_hertz(omega)} Hz"
    said = "; ".join(filter(None, [where, note, cause]))
    return Statement(Kind.APART, name, 0.0, float(size[at]), "dB", total, total, said)


def _hertz(omega: Real) -> str:
    return f"{omega[0] / (2 * pi):.3g} and {omega[-1] / (2 * pi):.3g}"


def _at_the_load(every: Sequence[ParameterSamples], omega: Real, family: str) -> Statement:
    """How far the positions of the loads per force lie apart, of fitted structures and twins."""
    responses = (position_of_load(sample.chain, sample.p, omega) for sample in every)
    return _apart("position of the load per force", responses, omega, len(every), family)


def position_of_load(chain: Chain, p: Real, omega: Real) -> Complex:
    """Position per force of the mass of the free row that is farthest from the force, shape
    (..., n_f), at angular frequencies [rad/s], for parameters of shape (..., n_p).
    """
    return Plant(_load(chain), omega).response(p)


def _load(chain: Chain) -> Structure:
    """The structure with the position of the mass of the free row that is farthest from the force
    for its sensor.
    """
    ports, first, last = chain.structure.ports, chain.gap + 1, chain.n_masses
    far = last if last - ports.act_plus >= ports.act_plus - first else first
    return replace(
        chain.structure, ports=ports._replace(meas_minus=0, meas_plus=far), sensor_order=0
    )


def _margins(
    fitted: Sequence[ParameterSamples], controller: Controller, omega: Real
) -> Iterator[Statement]:
    """Stability, then what `Margins` holds, over all draws of all structures."""
    total = sum(sample.alike for sample in fitted)
    own_margins = [[margins(sample.chain, p, controller) for p in sample.p] for sample in fitted]
    firm = [
        sample.alike
        for sample, own in zip(fitted, own_margins, strict=True)
        if all(m.stable for m in own)
    ]
    numbers = (total, total)
    yield Statement(Kind.STABLE, "closed loop", 1.0, 1.0, "", sum(firm), total)
    if sum(firm) < total:
        return  # margins of an unstable loop say nothing
    crossed = _ranged(own_margins, lambda m: m.crossover)
    low, high = omega[0] / (2 * pi), omega[-1] / (2 * pi)
    outside = any(not (low <= x <= high) for pair in crossed for x in pair)
    note = "the crossover may lie outside the measured band" if outside else ""
    yield _joined("crossover", "Hz", crossed, numbers, note)
    yield _joined("phase margin", "deg", _ranged(own_margins, lambda m: m.phase), numbers, note)
    gains = _ranged(own_margins, lambda m: 20 * log10(m.gain) if isfinite(m.gain) else inf)
    yield _joined("gain margin", "dB", gains, numbers)
    yield _joined(
        "peak of the sensitivity", "", _ranged(own_margins, lambda m: m.sensitivity), numbers
    )
    yield _joined("bandwidth", "Hz", _ranged(own_margins, lambda m: m.bandwidth), numbers)


def _ranged(
    own_margins: Sequence[Sequence[Margins]], value: Callable[[Margins], float]
) -> list[tuple[float, float]]:
    return [_spread(map(value, own)) for own in own_margins]
