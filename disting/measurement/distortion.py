"""Distortion from a multisine's lines without excitation: by odd and even nonlinearities, and
noise.

A periodic input that excites some lines only leaves the others to what is not linear. Where all
excited lines are odd multiples of the fundamental, products of an even number of them fall on even
multiples, of an odd number on odd ones (Pintelon and Schoukens, System Identification, 2nd ed.
2012, chapter 4). With U, Y the means over P periods, G interpolated between the excited lines and
|U| that of the excited lines around,

    level = |Y - G U| / |U|,      noise = std_p(Y_p - G U_p) / (sqrt(P) |U|)

compare with |G|: Y - G U is the output without what the input, distorted itself, makes of it.

Standard deviation of stochastic nonlinear contributions at the excited lines of a response.

A periodic input with random phases makes a nonlinear machine show its best linear approximation
and, in addition, contributions that repeat from period to period and look like noise from line to
line (Pintelon and Schoukens, System Identification, 2nd ed. 2012, chapters 3 and 4). Their variance
adds to that of the noise: with sigma_n^2 the variance of the mean by noise,

    sigma_k^2 = sigma_n,k^2 + sigma_s,k^2.

- Lines without excitation: where all excited lines are odd, the odd ones without excitation show
  what falls on the excited ones too; else all of them do. Each has level^2 - noise^2.
- Repeats with other phases (realisations): their mean scatters by sigma_k^2, the periods of each
  tell sigma_n,k^2.

Such a power q_j of single lines is averaged over the `NEAR` nearest of each excited line, as it is
or as a share of the response,

    sigma_s,k^2 = mean_j q_j    or    |G_k|^2 mean_j q_j / |G_j|^2,

whichever is more likely: the steps of an encoder are alike on all lines, friction distorts a force.
It counts only where the whole is larger than noise alone allows (F test over all lines).
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter1d
from scipy.special import fdtri

from disting.measurement.arrays import Complex, Real, apply
from disting.model.presentation import plural, summary

ROUNDING = 1e-9  # share of the response that is not worth a word
FEWEST = 4  # lines of a kind that are summed up


@dataclass(frozen=True, slots=True, eq=False)
class Distortion:
    """Lines without excitation, shape (n,): omega [rad/s], level and noise [unit of the response],
    whether they are even.

    `told_apart`: all excited lines are odd, so that odd and even lines show distortion of odd and
    of even order.
    """

    omega: Real
    level: Real
    noise: Real | None
    even: NDArray[np.bool_]
    told_apart: bool

    def __repr__(self) -> str:
        return summary(self, plural(len(self.omega), "line"))

    @property
    def kinds(self) -> tuple[tuple[str, Real, NDArray[np.bool_]], ...]:
        """Kinds of distortion: name, levels of all lines, shape (n,), and the lines that show it,
        shape (n,).
        """
        whole = np.ones(len(self.omega), dtype=bool)
        apart = (
            ("odd distortion", self.level, ~self.even),
            ("even distortion", self.level, self.even),
        )
        noise = () if self.noise is None else (("noise", self.noise, whole),)
        return (*(apart if self.told_apart else [("distortion", self.level, whole)]), *noise)

    def times(self, factor: Real | float) -> "Distortion":
        """The same in another unit."""
        return replace(
            self, level=self.level * factor, noise=apply(lambda noise: noise * factor, self.noise)
        )


def distortion(
    inputs: Complex, outputs: Complex, excited: NDArray[np.intp], spacing: float
) -> tuple[Distortion | None, str]:
    """Distortion between the excited lines of spectra of shape (P, n), lines `spacing` [rad/s]
    apart, and a note.

    None and "" where too few lines lie between the excited ones.
    """
    between = (
        np.setdiff1d(np.arange(excited[0], excited[-1]), excited)
        if len(excited) > 1
        else excited[:0]
    )
    if len(between) < FEWEST:
        return None, ""
    mean, size = (
        outputs[:, excited].mean(axis=0) / inputs[:, excited].mean(axis=0),
        np.abs(inputs[:, excited].mean(axis=0)),
    )
    response = np.interp(between, excited, mean.real) + 1j * np.interp(between, excited, mean.imag)
    rest = (outputs[:, between] - response * inputs[:, between]) / np.interp(between, excited, size)
    noise = np.std(rest, axis=0, ddof=1) / np.sqrt(len(rest)) if len(rest) > 1 else None
    omega = np.multiply(between, spacing, dtype=np.float64)
    the_distortion = Distortion(
        omega=omega,
        level=np.abs(rest.mean(axis=0)),
        noise=noise,
        even=between % 2 == 0,
        told_apart=bool(np.all(excited % 2)),
    )
    return the_distortion, _medians_in_words(the_distortion, np.abs(response))


def shares(the_distortion: Distortion, size: Real) -> dict[str, float]:
    """Return the median of each kind of distortion, and of the noise, as a share of the response;
    `size` = |G| at the lines of the distortion, shape (n,). Empty where it is rounding.
    """
    medians = {
        name: float(np.median(values[lines] / size[lines]))
        for name, values, lines in the_distortion.kinds
        if np.count_nonzero(lines) >= FEWEST
    }
    return medians if max(medians.values(), default=0.0) >= ROUNDING else {}


def _medians_in_words(the_distortion: Distortion, size: Real) -> str:
    """Medians in percent of the response; "" where there is nothing but rounding."""
    medians = shares(the_distortion, size)
    if not medians:
        return ""
    phrase = ", ".join(f"{name} {100 * share:.2g} %" for name, share in medians.items())
    return (
        f"{len(size)} lines without excitation show, in parts of the response (medians): {phrase}"
    )


NEAR = 11  # lines whose mean is taken
SURE = 1e-3  # chance of a distortion where there is noise alone
LEAST = 1e-6  # share of the response below which a distortion is rounding
SMALLEST = 0.1  # of the mean of all lines: a few lines may show nothing by chance


def from_unexcited(
    between: Distortion | None, omega: Real, response: Complex, periods: int
) -> Real | None:
    """Return sigma_s at the excited lines, shape (n_f,), from those between them; None where these
    show noise alone, where their noise is unknown, or where too few are of the kind that counts.
    """
    if between is None or between.noise is None:
        return None
    kind = ~between.even if between.told_apart else np.ones(len(between.omega), dtype=bool)
    total, noise, at = between.level[kind], between.noise[kind], between.omega[kind]
    size = np.abs(response)
    if not _is_larger(total, noise, np.interp(at, omega, size), (1.0, periods - 1.0)):
        return None
    return _average_power(total**2 - noise**2, at, omega, size)


def is_even_beyond_noise(between: Distortion, omega: Real, response: Complex, periods: int) -> bool:
    """Return True if even lines without excitation show more than noise, as those of a machine do
    that is not the same in both directions.
    """
    if between.noise is None:
        return False
    size = np.interp(between.omega, omega, np.abs(response))
    total, noise, size = (x[between.even] for x in (between.level, between.noise, size))
    return _is_larger(total, noise, size, (1.0, periods - 1.0))


def from_realisations(
    total: Real, noise: Real, omega: Real, response: Complex, freedom: tuple[float, float]
) -> Real | None:
    """Return sigma_s of a mean, shape (n_f,): `total` = its standard deviation by the scatter of
    n repeats, `noise` = that by the scatter of their periods; `freedom` = degrees of freedom of
    both at each line. None where noise is all.
    """
    size = np.abs(response)
    if not _is_larger(total, noise, size, (freedom[0] / 2, freedom[1] / 2)):
        return None
    return _average_power(total**2 - noise**2, omega, omega, size)


def _is_larger(total: Real, noise: Real, size: Real, repeats: tuple[float, float]) -> bool:
    """Return True if deviations of a response of this `size` are larger than those of the noise;
    `repeats`: of which each of both comes, beyond the first.
    """
    if len(total) < FEWEST:
        return False
    near = uniform_filter1d((noise / size) ** 2, NEAR, mode="nearest")
    ratio = float(np.mean((total / size) ** 2 / np.maximum(near, LEAST**2)))
    return ratio > float(fdtri(*(2 * len(total) * n for n in repeats), 1 - SURE))


def _average_power(power: Real, at: Real, omega: Real, size: Real) -> Real:
    """sigma_s at lines `omega` of a response of this `size` from powers of the lines `at`: as
    they are or as shares of the response, whichever describes them better.
    """
    other_size = np.interp(at, omega, size)
    ways = [(np.ones_like(other_size), np.ones_like(size)), (other_size, size)]

    def deviance(of: Real) -> float:
        """Mean of ln mu + q / mu, twice the negative logarithm of the likelihood."""
        expected = _means(power / of**2, at, at) * of**2
        return float(np.mean(np.log(expected) + power / expected))

    of, shown = min(ways, key=lambda way: deviance(way[0]))
    count = min(NEAR, len(at))
    unsure = count / (count - 1)  # the mean of q / sigma_s^2 is to be 1
    return np.asarray(np.sqrt(unsure * _means(power / of**2, at, omega)) * shown)


def _means(power: Real, at: Real, omega: Real) -> Real:
    """Means of powers of lines `at` over those near each line of `omega`, none of them far below
    that of all.
    """
    nearest = np.argsort(np.abs(np.log(omega[:, None] / at)), axis=1, kind="stable")[:, :NEAR]
    least = SMALLEST * max(float(power.mean()), np.finfo(float).tiny)
    return np.asarray(np.maximum(power[nearest].mean(axis=1), least))
