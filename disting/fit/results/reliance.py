"""Statements that hold for all structures that a fit leaves: ranges over all of them and their
uncertainty.

Each structure is drawn many times (`samples`), its own fit among the draws; a range holds 95 % of
the draws of every structure. What behaves as a fitted structure does at the sensor (its twins) has
the same resonances, antiresonances and margins; masses and responses elsewhere differ, and are
those of the twin, of a family those of one of it. Structures that only contain one of the set, and
undecided ones, are ignored. For badly known quantities a note states whether the structures lie
apart, so that another experiment helps, or the uncertainty of one is as wide, so that more
measuring does.

The margins are those of a controller around the sensor of the data (`loop`).

Parameters drawn from what a fit knows of them: normal in their logarithms, with their covariance
(`practical.covariance`). Where the data determine a direction badly a response is not as straight
as the covariance takes it. What a draw x does to the residuals is, to first order, S x; where it
does more the parameters are searched that do just this,

    min |r(p) - r(p_0) - S x|^2,    from p_0 exp(x),

and a draw that leads to none is left out.

What behaves as a fitted structure does (a twin) is drawn along with it: its parameters q are
searched that give the response of the draw at the lines of the data, G_twin(q) = G(p); a draw that
has no such twin near by is left out.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from math import inf, isfinite, log10, pi

import numpy as np

from disting.fit.judge.candidate import OUTSIDE, Candidate
from disting.fit.judge.exclusion import limit
from disting.fit.judge.members import Member, Twin
from disting.fit.judge.modes import oscillations, poles, zeros
from disting.fit.results.loop import Controller, Margins, margins
from disting.fit.search.cost import SquaredCost
from disting.fit.search.descent import rough
from disting.fit.search.estimate import Task
from disting.fit.search.joint import AnyCost
from disting.fit.search.plant import Plant
from disting.measurement.arrays import Complex, Real, spread
from disting.model.chain import Chain, Structure
from disting.statistics.practical import NoiseModel

DRAWS = 100  # of a structure
WIDEST = 1.0  # standard deviation of a logarithm, where the data do not determine it
STRAIGHT = 0.05  # standard deviation of a logarithm up to which a response is straight enough
BLIND = 1e-8  # of the largest singular value of S: what is less says nothing of its direction
BACK = 20  # steps of the search for what a draw stands for
NEAR = 0.05  # of the largest change of a response: so exactly a twin gives that of a draw
ROUNDED = 1e-9  # of a logarithm
STEPS = 20  # of the search for it, each of a factor e at most
FELT = 1e-12  # of the square of a twin's largest sensitivity: what is less has no effect


@dataclass(frozen=True, eq=False)
class ParameterSamples:
    """A structure with its parameters drawn, shape (n, n_p), its own first, and the number of
    structures that are equivalent at the sensor.
    """

    chain: Chain
    p: Real
    alike: int = 1


def draw_samples(left: Sequence[Member], task: Task) -> tuple[ParameterSamples, ...]:
    """The structures that were fitted."""
    return tuple(
        ParameterSamples(m.candidate.chain, draws(m.candidate, task), 1 + len(m.twins))
        for m in left
    )


def with_twins(
    left: Sequence[Member], fitted: Sequence[ParameterSamples], omega: Real
) -> Iterator[ParameterSamples]:
    """Each fitted structure, then its twins; `omega`: lines of the data [rad/s]."""
    for member, sample in zip(left, fitted, strict=True):
        yield sample
        yield from (_carry_draws(twin, sample, omega) for twin in member.twins)


def _carry_draws(twin: Twin, sample: ParameterSamples, omega: Real) -> ParameterSamples:
    """The twin, drawn along with the structure whose twin it is: Newton's steps from its own
    values, the smallest where there are several.
    """
    plant = Plant(twin.chain.structure, omega)
    aims = Plant(sample.chain.structure, omega).response(sample.p)
    own = np.array([twin.parameters[name] for name in twin.chain.parameters])
    x, near = np.tile(np.log(own), (len(aims), 1)), NEAR * np.abs(np.log(aims / aims[0])).max()
    active = np.arange(len(aims))
    for _ in range(STEPS):
        p = np.exp(x[active])
        response, gradient = plant.logarithmic_gradient(p)
        left = _halves(np.log(aims[active] / response))
        apart = np.abs(left).max(axis=-1) > near + ROUNDED
        active = active[apart]
        if not active.size:
            break
        rows = _halves(gradient[apart] * p[apart, :, None])
        squares, slope = rows @ rows.swapaxes(-1, -2), rows @ left[apart, :, None]
        step = (np.linalg.pinv(squares, rcond=FELT, hermitian=True) @ slope)[..., 0]
        x[active] += step / np.maximum(1.0, np.abs(step).max(axis=-1, keepdims=True))
    return ParameterSamples(twin.chain, np.exp(np.delete(x, active, axis=0)))


def _halves(values: Complex) -> Real:
    """Real parts first, shape (..., 2 n_f)."""
    return np.concatenate([values.real, values.imag], axis=-1)


def draws(candidate: Candidate, task: Task, count: int = DRAWS) -> Real:
    """Parameters of the chain, shape (n, n_p): the fit, then at most count - 1 draws near it.

    A direction that the data do not determine is drawn with a standard deviation of `WIDEST`, what
    is given not at all.
    """
    names = task.names(candidate.chain)
    p = np.array([candidate.estimate.parameters[name] for name in names])
    plant, box = task.plant(candidate.chain), task.box(names)
    free, whole = box.free, np.tile(p, (count, 1))
    if not free.any():
        return whole[:, : len(candidate.chain.parameters)]
    residual, columns = task.cost.of(plant, p)
    sizes, axes = _axes(columns[:, free], candidate.noise)
    steps = np.random.default_rng(0).normal(size=(count - 1, len(sizes))) * sizes @ axes
    whole[1:, free] *= np.exp(steps)
    if np.any(sizes > STRAIGHT):
        ends = [
            rough(
                plant, _Towards(task.cost, residual + columns[:, free] @ x), box, start[None], BACK
            )
            for x, start in zip(steps, whole[1:], strict=True)
        ]
        most = _excess(candidate, task.cost.n_residuals, len(sizes))
        whole = np.stack([p, *(points[0] for points, costs in ends if costs[0] <= most)])
    return whole[:, : len(candidate.chain.parameters)]


@dataclass(frozen=True, eq=False)
class _Towards(SquaredCost):
    """The distance from given residuals, shape (n_y,), instead of from none."""

    cost: AnyCost
    aim: Real

    @property
    def n_residuals(self) -> int:
        """Those of the cost."""
        return self.cost.n_residuals

    def residual(self, response: Complex) -> Real:
        """Residual relative to the aim, shape (..., n_y)."""
        return np.asarray(self.cost.residual(response) - self.aim)

    def sensitivity(self, response: Complex, gradient: Complex) -> Real:
        """That of the cost."""
        return self.cost.sensitivity(response, gradient)


def _excess(candidate: Candidate, n_y: int, n_p: int) -> float:
    """By how much J may exceed its minimum where parameters are not excluded, the noise as the
    residuals have it.
    """
    return candidate.estimate.j * limit(n_p, inf, level=OUTSIDE) / max(n_y - n_p, 1)


def _axes(columns: Real, noise: NoiseModel) -> tuple[Real, Real]:
    """Standard deviations of ln p along the axes of their covariance (`practical.covariance`),
    none above `WIDEST`, and these axes, shape (n_p, n_p), a row each: of a root of it, as squares
    lose the short ones.
    """
    left, values, right = np.linalg.svd(columns, full_matrices=False)
    half = noise.seen(left) / np.maximum(values, BLIND * values[0]) @ right
    _, sizes, axes = np.linalg.svd(np.linalg.qr(half, mode="r"))
    unseen = len(axes) - len(sizes)  # where the data are fewer than the parameters
    return np.minimum(np.pad(sizes, (0, unseen), constant_values=WIDEST), WIDEST), axes


LINES = 400  # of a response that is drawn, at most
WIDE, WIDE_LEVEL = 1.5, 3.0  # ratio of the ends of a range, and dB, from which on a note says why
FAMILY = "only one of many equivalents was examined"
BETWEEN = "the structures lie apart: disting next tells what to measure"
WITHIN = "poorly determined: more periods or lines help"
OUTER = 2.5  # percent of the draws on either side that a range leaves out
SAME = 1.25  # ratio of two frequencies up to which they are one resonance
ROOTS = {"antiresonance": zeros, "resonance": poles}


class Kind(StrEnum):
    """Subject of a statement: a quantity, the distance of responses, the stability of a loop."""

    RANGE = "range"
    APART = "apart"
    STABLE = "stable"


@dataclass(frozen=True, slots=True)
class Statement:
    """`name` lies between `low` and `high` [`unit`] in `holds` of `total` structures; an infinite
    end has no bound. `note` gives further information.
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
        'phase margin: 41.2 to 44 deg, in every structure'
        """
        whose = (
            "in every structure"
            if self.holds == self.total
            else f"in {self.holds} of {self.total} structures"
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
    """Statements that hold for all structures that the data do not exclude; none where no structure
    remains.

    Raises InputError where no margins can be computed.
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


def _join_ranges(
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
    remarks = "; ".join(filter(None, [note, cause]))
    return Statement(Kind.RANGE, name, low, high, unit, *numbers, remarks)


def total_inertia(every: Sequence[ParameterSamples], family: str) -> Statement:
    """Of all masses."""
    ranges = []
    for sample in every:
        at = [i for i, name in enumerate(sample.chain.parameters) if name[0] == "m"]
        ranges.append(_spread(sample.p[:, at].sum(axis=1)))
    return _join_ranges("total inertia", "", ranges, (len(ranges), len(ranges)), family)


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
            follow = [_follow_root(sample, roots_of, own) for sample, own in having]
            numbers = (sum(sample.alike for sample, _ in having), total)
            name = f"{kind} {number}"
            hertz = [_spread(abs(r) / (2 * pi) for r in roots) for roots in follow]
            damping = [_spread(-r.real / abs(r) for r in roots) for roots in follow]
            yield _join_ranges(name, "Hz", hertz, numbers)
            yield _join_ranges(f"damping ratio of {name}", "", damping, numbers)


def _roots_at(sample: ParameterSamples, roots_of: Callable[..., Complex], k: int) -> Complex:
    structure = sample.chain.structure
    return roots_of(structure, sample.p[k, : len(structure.parameters)])


def _follow_root(
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
    """Distance of the responses."""
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
    remarks = "; ".join(filter(None, [where, note, cause]))
    return Statement(Kind.APART, name, 0.0, float(size[at]), "dB", total, total, remarks)


def _hertz(omega: Real) -> str:
    return f"{omega[0] / (2 * pi):.3g} and {omega[-1] / (2 * pi):.3g}"


def _at_the_load(every: Sequence[ParameterSamples], omega: Real, family: str) -> Statement:
    """Distance of the positions of the loads per force, of fitted structures and twins."""
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
    crossed = _ranges_of(own_margins, lambda m: m.crossover)
    low, high = omega[0] / (2 * pi), omega[-1] / (2 * pi)
    outside = any(not (low <= x <= high) for pair in crossed for x in pair)
    note = "the crossover may lie outside the measured band" if outside else ""
    yield _join_ranges("crossover", "Hz", crossed, numbers, note)
    yield _join_ranges(
        "phase margin", "deg", _ranges_of(own_margins, lambda m: m.phase), numbers, note
    )
    gains = _ranges_of(own_margins, lambda m: 20 * log10(m.gain) if isfinite(m.gain) else inf)
    yield _join_ranges("gain margin", "dB", gains, numbers)
    yield _join_ranges(
        "peak of the sensitivity", "", _ranges_of(own_margins, lambda m: m.sensitivity), numbers
    )
    yield _join_ranges("bandwidth", "Hz", _ranges_of(own_margins, lambda m: m.bandwidth), numbers)


def _ranges_of(
    own_margins: Sequence[Sequence[Margins]], value: Callable[[Margins], float]
) -> list[tuple[float, float]]:
    return [_spread(map(value, own)) for own in own_margins]
