"""Margins of a given controller around a chain with numbers.

The controller acts on what the sensor's mass does, in the direction of the force:

    u = C(s) (r - y),    C(s) = P + I/s + D s / (1 + s Tf),

where y is the position x, the velocity or the acceleration there; in a cascade a position gain V
encloses a velocity loop, u = C(s) (V (r - x) - s x). With the receptance H(s) = x/u of the chain,
its lag and dead time included, the loop that is cut at the force has the gain

    L(s) = C(s) F(s) H(s),    F = 1, s, s^2;  s + V for a cascade.

Stability (Nyquist): H has no pole to the right of the imaginary axis and, with dampers, none on it
but at 0. If L grows as s^-q for s to 0, the closed loop has Z = q/2 - phi/pi poles on the right,
phi [rad] the change of arg(1 + L) from 0+ to infinity.
"""

from dataclasses import dataclass, fields
from math import inf, pi
from pathlib import Path

import numpy as np

from disting.errors import InputError, short
from disting.files import read_json
from disting.fit.judge.modes import poles, zeros
from disting.fit.search.plant import Plant
from disting.measurement.arrays import Complex, Real
from disting.model.chain import Chain

ZEROS = {"position": 0, "velocity": 1, "acceleration": 2, "cascade": 0}  # of F at 0
PLAIN = 3000  # frequencies of the grid, beside those near poles and zeros
NEAR = np.concatenate([[0.0], np.geomspace(1e-2, 1e2, 40)])  # half widths of a resonance
LIGHTEST = 1e-7  # damping ratio below which a resonance is on the imaginary axis
STILL = 1e-6  # of the fastest root: below, a root is at 0, that of the motion as one
BELOW, ABOVE = 30.0, 1e3  # how far beyond the slowest and the fastest feature L is looked at
LOWER = 12  # times that it is looked further down
LARGE, SMALL = 10.0, 0.5  # |L| above which it grows as for s to 0, below which it goes to its end
FORM = "a controller is written P=2,I=30,D=0.01,Tf=0.001,loop=velocity (or cascade with V=20)"


@dataclass(frozen=True, slots=True)
class Controller:
    """P, I [1/s], D [s] in units of force per unit of y, filter time `Tf` [s], position gain `V`
    [1/s] of a cascade. Raises InputError.

    >>> Controller(P=2.0, I=30.0).loop
    'velocity'
    """

    P: float = 0.0
    I: float = 0.0  # noqa: E741 - the term of the field
    D: float = 0.0
    Tf: float = 0.0
    V: float = 0.0
    loop: str = "velocity"

    def __post_init__(self) -> None:
        sizes = {f.name: getattr(self, f.name) for f in fields(self) if f.name != "loop"}
        wrong = [n for n, x in sizes.items() if isinstance(x, bool) or not 0 <= x < inf]
        if wrong:
            raise InputError(f"{wrong[0]} of a controller is a number, not below zero")
        if self.loop not in ZEROS:
            raise InputError(f"a loop is one of {', '.join(ZEROS)}, not {short(self.loop)}")
        if not (self.P or self.I or self.D):
            raise InputError(f"the controller does nothing; {FORM}")
        if bool(self.V) != (self.loop == "cascade"):
            raise InputError("a cascade has a position gain V=.., no other loop has one")

    def gain(self, s: Complex) -> Complex:
        """C(s)."""
        return np.asarray(self.P + self.I / s + self.D * s / (1 + s * self.Tf))

    def of_position(self, s: Complex) -> Complex:
        """F(s)."""
        return np.asarray(s + self.V if self.loop == "cascade" else s ** ZEROS[self.loop])

    def of_reference(self, s: Complex) -> Complex:
        """The factor of C H between the reference and the controlled quantity."""
        return np.asarray(self.V + 0 * s if self.loop == "cascade" else self.of_position(s))


def read_controller(text: str) -> Controller:
    """Parse a controller such as P=2,I=30,loop=velocity, or a JSON file with these names; raises
    InputError.

    >>> read_controller("P=2,V=10,loop=cascade").V
    10.0
    """
    try:
        pairs = _from_file(Path(text)) if text.endswith(".json") else _pairs(text)
        sizes = {n: v if n == "loop" else float(str(v)) for n, v in pairs.items()}
        return Controller(**sizes)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise InputError(f"{FORM}, not {short(text)}") from None


def _pairs(text: str) -> dict[str, object]:
    parts = [part.strip().partition("=")[::2] for part in text.split(",")]
    if len({name for name, _ in parts}) < len(parts):
        raise ValueError(text)
    return dict(parts)


def _from_file(path: Path) -> dict[str, object]:
    plain = read_json(path, "a controller")
    if not isinstance(plain, dict):
        raise ValueError(plain)
    return plain


@dataclass(frozen=True, slots=True)
class Margins:
    """`crossover` [Hz]: the lowest frequency where |L| falls below 1; `phase` [deg]: the smallest
    distance of arg L from -180 degrees where |L| = 1; `gain`: factor by which L may grow;
    `sensitivity`: largest 1/|1 + L|; `bandwidth` [Hz]: the lowest frequency where the way from the
    reference falls by 3 dB below 1. Infinite or not a number where there is none.
    """

    stable: bool
    crossover: float
    phase: float
    gain: float
    sensitivity: float
    bandwidth: float


def loop_gain(chain: Chain, p: Real, controller: Controller, omega: Real) -> Complex:
    """L(j omega), shape (n_f,), at angular frequencies [rad/s]."""
    s: Complex = np.asarray(1j * omega, dtype=complex)
    receptance = Plant(chain.structure, omega).response(p) / s**chain.sensor.order
    return np.asarray(controller.gain(s) * controller.of_position(s) * receptance)


def margins(chain: Chain, p: Real, controller: Controller) -> Margins:
    """Of the closed loop around a chain with the parameters `p`, shape (n_p,). Raises InputError
    for a chain with a resonance that nothing damps, and where L does not end below 1.
    """
    omega = _grid(chain, p, controller)
    s: Complex = np.asarray(1j * omega, dtype=complex)
    gain = loop_gain(chain, p, controller, omega)
    if abs(gain[-1]) > SMALL:
        raise InputError("the loop gain does not fall below 1: give the differentiator a filter Tf")
    size, turned = np.abs(gain), np.abs(np.angle(-gain))
    crossings = np.flatnonzero((size[1:] < 1) != (size[:-1] < 1))
    falling = crossings[size[crossings] >= 1]
    tracked = np.abs(controller.of_reference(s) / controller.of_position(s) * gain / (1 + gain))
    lost = np.flatnonzero(tracked < 10 ** (-3 / 20))
    return Margins(
        stable=_unstable_poles(gain, _growth(chain, controller)) == 0,
        crossover=_find_crossing(omega, size, int(falling[0])) / (2 * pi)
        if len(falling)
        else float("nan"),
        phase=min((_between(size, turned, int(k)) for k in crossings), default=inf) * 180 / pi,
        gain=_gain_margin(gain),
        sensitivity=float(np.max(1 / np.abs(1 + gain))),
        bandwidth=float(omega[lost[0]]) / (2 * pi) if len(lost) else inf,
    )


def _find_crossing(omega: Real, size: Real, k: int) -> float:
    """omega where |L| = 1 between two lines, by logarithms."""
    share = np.log(size[k]) / np.log(size[k] / size[k + 1])
    return float(omega[k] * (omega[k + 1] / omega[k]) ** share)


def _between(size: Real, turned: Real, k: int) -> float:
    share = np.log(size[k]) / np.log(size[k] / size[k + 1])
    return float(turned[k] + share * (turned[k + 1] - turned[k]))


def _gain_margin(gain: Complex) -> float:
    """1/|L| at the largest |L| < 1 on the negative real axis."""
    x, y = gain.real, gain.imag
    k = np.flatnonzero((np.sign(y[1:]) != np.sign(y[:-1])) & (x[1:] < 0))
    at = x[k] - y[k] * (x[k + 1] - x[k]) / (y[k + 1] - y[k])
    inside = at[(at > -1) & (at < 0)]
    return float(1 / -inside.min()) if len(inside) else inf


def _unstable_poles(gain: Complex, q: int) -> int:
    """Z of the module's formula."""
    angle = np.unwrap(np.angle(1 + gain))
    phi = angle[-1] - angle[0] - np.angle(1 + gain[-1])
    return round(max(q, 0) / 2 - float(phi) / pi)


def _growth(chain: Chain, controller: Controller) -> int:
    """q: L grows as s^-q for s to 0. Both ports are on the free row, which moves as one."""
    held = any(i > chain.gap for i in chain.ground_dampers)
    return (1 if held else 2) + bool(controller.I) - ZEROS[controller.loop]


def _grid(chain: Chain, p: Real, controller: Controller) -> Real:
    """Angular frequencies, rising: from below to above poles, zeros and corners, from where L is
    large if it grows for s to 0, and close to every resonance.
    """
    plain = p[: len(chain.structure.parameters)]
    own = poles(chain.structure, plain)
    roots = np.concatenate([own, zeros(chain.structure, plain)])
    own, roots = (x[np.abs(x) > STILL * np.abs(own).max(initial=0.0)] for x in (own, roots))
    if np.any(-own.real < LIGHTEST * np.abs(own)):
        raise InputError("margins need a machine whose resonances are damped")
    values = np.array([*np.abs(roots), *_corners(chain, p, controller)])
    low = values.min() / BELOW
    grows = _growth(chain, controller) > 0
    for _ in range(LOWER if grows else 0):
        if abs(loop_gain(chain, p, controller, np.array([low]))[0]) > LARGE:
            break
        low /= BELOW
    wide = np.geomspace(low, values.max() * ABOVE, PLAIN)
    pairs = roots[roots.imag > 0]
    steps = np.concatenate([-NEAR, NEAR])
    close = (np.abs(pairs.imag)[:, None] + np.abs(pairs.real)[:, None] * steps).ravel()
    return np.unique(np.concatenate([wide, close[close > low]]))


def _corners(chain: Chain, p: Real, c: Controller) -> list[float]:
    """Frequencies at which times, and the gains against all masses as one, show [rad/s]."""
    named = dict(zip(chain.parameters, map(float, p), strict=True))
    mass = sum(value for name, value in named.items() if name[0] == "m")
    values = [1 / value for name, value in named.items() if name[0] == "T" and value > 0]
    values += [c.P / mass, (c.P / mass) ** 0.5, (c.I / mass) ** 0.5, c.V, 1 / c.Tf if c.Tf else 0.0]
    return [x for x in (*values, c.I / c.P if c.P else 0.0) if x]
