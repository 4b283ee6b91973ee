"""What a multisine's lines without excitation show: distortion by odd and even nonlinearities, and
noise.

A periodic input that excites some lines only leaves the others to what is not linear. Where all
excited lines are odd multiples of the fundamental, products of an even number of them fall on even
multiples, of an odd number on odd ones (Pintelon and Schoukens, System Identification, 2nd ed.
2012, chapter 4). With U, Y the means over P periods, G interpolated between the excited lines and
|U| that of the excited lines around,

    level = |Y - G U| / |U|,      noise = std_p(Y_p - G U_p) / (sqrt(P) |U|)

compare with |G|: Y - G U is the output without what the input, distorted itself, makes of it.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

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
        """What the lines show: in words, levels of all lines, shape (n,), and the lines that
        show it, shape (n,).
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
    return the_distortion, _said(the_distortion, np.abs(response))


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


def _said(the_distortion: Distortion, size: Real) -> str:
    """Medians in percent of the response; "" where there is nothing but rounding."""
    medians = shares(the_distortion, size)
    if not medians:
        return ""
    phrase = ", ".join(f"{name} {100 * share:.2g} %" for name, share in medians.items())
    return (
        f"{len(size)} lines without excitation show, in parts of the response (medians): {phrase}"
    )
