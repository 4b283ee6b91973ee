"""Closed loops in records without a reference, recognised from noise, and the bias that they cause.

A controller C turns noise v of the output into input: with S = 1/(1 + C G) the noise is

    U = -C S v + S w,    Y = S v + G S w,

where w acts in addition to the controller and is recorded. The noise of w moves input and output in
the ratio G, as the excitation does, and biases nothing. That of v moves them in the ratio -1/C.

Periodic excitation. Around their means over P periods, the spectra of the input and of the changes
of the output (a position that wanders would leak into all lines), these divided by their ratio,
leave residuals u, z with P - 1 degrees of freedom for each line; a group of lines has M of them
(P - 1 times its lines). In open loop z = b u + e, where e is independent of u and b is 0, or
positive where the recorded noise moves the machine or is partly noise of the sensor of the input.
Distortion turns b by an angle below `CONE`. With b' the complex regression of z on u, R its
residual sum of squares, and D the distance of b' from that cone,

    t = (M - 1) ln(1 + D^2 sum |u|^2 / R).

For b = 0, t is at most -(M - 1) ln(1 - gamma^2). The squared sample coherence gamma^2 of M
independent pairs is Beta(1, M - 1) distributed, so that this bound is exponential with mean 1;
other b shift the cone and leave the bound. The sum over K groups exceeds a Gamma(K, 1) variable by
chance only. It has to do so at the level `LEVEL` whichever period is left out: a disturbance of one
period, such as a soft start, moves input and output together without a controller.

Means over periods have noise of 1/P of the power in the input. For circular normal noise the ratio
of the means has, exactly, the relative bias

    (b' - 1) exp(-SNR),    SNR = |mean U|^2 P (P - 1) / sum |u|^2,

which is negligible but for lines where noise is as strong as the excitation (Pintelon and
Schoukens, System Identification, 2nd ed. 2012, section 2.6).
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from disting.measurement.arrays import Complex, Real, real
from disting.model.presentation import plural

LEVEL = 1e-3  # of the test
PERIODS = 3  # fewest, one of which is left out
PAIRS = 4  # least M
CONE = np.pi / 12  # rad
ROUNDING = 1e-9  # share of the input below which it repeats exactly
NEGLIGIBLE = 1e-4  # relative bias that is not worth a number
SMALL = "negligible"
CLOSED = "input and output were recorded in a closed loop"


@dataclass(frozen=True, slots=True, eq=False)
class Feedback:
    """A closed loop that a record shows: `evidence` in words, `bias` of each line and its standard
    deviation without that bias, `scatter`, as shares of the response that is shown, shape (n_f,)
    each, and the `remedy`.

    >>> loop = Feedback("their noise is coherent (0.8)", [0.0, 0.2], [0.01, 0.01], "record more")
    >>> loop.sentence([10.0, 20.0])  # doctest: +ELLIPSIS
    'input and output were recorded in a closed loop: ... by 20 % at 20 Hz; record more'
    """

    evidence: str
    bias: Real
    scatter: Real
    remedy: str

    def __post_init__(self) -> None:
        for name in ("bias", "scatter"):
            object.__setattr__(self, name, real(getattr(self, name), name))

    def of(self, lines: NDArray[np.bool_] | NDArray[np.integer]) -> "Feedback":
        """Return the same for some of the lines."""
        return replace(self, bias=self.bias[lines], scatter=self.scatter[lines])

    @property
    def harmed(self) -> NDArray[np.bool_]:
        """Return the lines, shape (n_f,), whose bias exceeds their scatter."""
        return np.asarray(self.bias > np.maximum(self.scatter, NEGLIGIBLE))

    def sentence(self, frequency: Real) -> str:
        """Return the loop, its bias and the remedy in a sentence; `frequency` [Hz] of the lines,
        shape (n_f,).
        """
        start = f"{CLOSED}: {self.evidence}"
        harmed, most = self.harmed, float(self.bias.max(initial=0.0))
        if not harmed.any():
            size = f"at most {_percent(most)}, below its scatter"
            return f"{start}; its bias of the response is {size if most > NEGLIGIBLE else SMALL}"
        worst = int(np.argmax(np.where(harmed, self.bias, 0.0)))
        count = plural(int(np.count_nonzero(harmed)), "line")
        return (
            f"{start}; at {count} the response is biased toward minus the inverse controller by"
            f" more than it scatters, by {_percent(float(self.bias[worst]))} at"
            f" {frequency[worst]:.4g} Hz; {self.remedy}"
        )


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share < 1 else f"{100 * share:.0f} %"


def feedback_in_periods(inputs: Complex, outputs: Complex, scatter: Real) -> Feedback | None:
    """Return the loop that the spectra of P periods show at n_f excited lines, shape (P, n_f) each,
    or None: there is none, or this record cannot show it. `scatter` = relative standard deviation
    of the ratio of their means, shape (n_f,).
    """
    periods = len(inputs)
    if periods < PERIODS:
        return None
    excited = inputs.mean(axis=0)
    u = inputs - excited
    if np.all(np.abs(u).max(axis=0) <= ROUNDING * np.abs(excited)):
        return None
    with np.errstate(divide="ignore", invalid="ignore"):
        z = outputs * (excited / outputs.mean(axis=0))
    z = z - z.mean(axis=0)
    usable = np.isfinite(z).all(axis=0) & (np.abs(u).max(axis=0) > 0)
    left = [np.arange(periods) != i for i in range(periods)]
    if not all(_is_closed(u[kept][:, usable], z[kept][:, usable]) for kept in left):
        return None
    return Feedback(
        evidence=f"their noise is coherent ({_mean_coherence(u[:, usable], z[:, usable]):.2g}), and"
        " not in the ratio of the response",
        bias=_bias_of_means(excited, u, z),
        scatter=scatter,
        remedy="record more periods or excite these lines more strongly",
    )


def _is_closed(u: Complex, z: Complex) -> bool:
    """Return True if the test of the module's text rejects an open loop; u, z: shape (P, n)."""
    from scipy.special import gammaincc

    u, z = u - u.mean(axis=0), z - z.mean(axis=0)
    pairs = len(u) - 1
    width = -(-PAIRS // pairs)
    power, other, crossed = _products(u, z)
    uu, zz, zu = _sum_groups(power, width), _sum_groups(other, width), _sum_groups(crossed, width)
    good = (uu > 0) & (zz > 0)
    uu, zz, zu = uu[good], zz[good], zu[good]
    count = len(uu)
    if not count:
        return False
    rest = np.maximum(zz - np.abs(zu) ** 2 / uu, ROUNDING * zz)
    # the distance of b' from the cone, times sum |u|^2
    beyond = np.clip(np.abs(np.angle(zu)) - CONE, 0.0, np.pi / 2)
    distance = np.abs(zu) * np.sin(beyond)
    t = (width * pairs - 1) * np.log1p(distance**2 / (uu * rest))
    return bool(gammaincc(count, t.sum()) < LEVEL)


def _products(u: Complex, z: Complex) -> tuple[Real, Real, Complex]:
    """Sums over periods of |u|^2, |z|^2 and z conj(u), shape (n,) each."""
    uu, zz = np.sum(np.abs(u) ** 2, axis=0), np.sum(np.abs(z) ** 2, axis=0)
    return uu, zz, np.asarray(np.sum(z * u.conj(), axis=0))


def _sum_groups(values: NDArray[Any], width: int) -> NDArray[Any]:
    """Sums over neighbouring lines; the last lines that fill no group are left out."""
    count = len(values) // width
    return np.asarray(values[: count * width].reshape(count, width).sum(axis=1))


def _mean_coherence(u: Complex, z: Complex) -> float:
    """Squared coherence, averaged over the lines, less what chance makes of P - 1 pairs."""
    uu, zz, zu = _products(u, z)
    chance = 1 / (len(u) - 1)
    power = uu * zz
    raw = float(np.mean(np.abs(zu) ** 2 / np.where(power > 0, power, 1.0)))
    return max((raw - chance) / (1 - chance), 0.0)


def _bias_of_means(excited: Complex, u: Complex, z: Complex) -> Real:
    """Bias of the ratio of means as a share of that ratio, shape (n_f,)."""
    periods = len(u)
    uu, _, zu = _products(u, z)
    power = np.maximum(uu, np.finfo(float).tiny)
    snr = np.abs(excited) ** 2 * periods * (periods - 1) / power
    return biased_share((zu / power - 1) * np.exp(-np.minimum(snr, 700.0)))


def biased_share(bias: Complex) -> Real:
    """Return |G_b - G| / |G_b| of responses G_b = (1 + bias) G, shape (n_f,); 0 where the bias is
    not a number.

    >>> biased_share(np.array([1.0, -0.5 + 0j])).tolist()
    [0.5, 1.0]
    """
    finite = np.where(np.isfinite(bias), bias, 0.0)
    return np.asarray(np.abs(finite) / np.maximum(np.abs(1 + finite), np.finfo(float).eps))
