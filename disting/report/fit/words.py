"""Numbers, units and names of models as pages and figures of a fit write them."""

from collections.abc import Mapping
from math import floor, inf, isfinite, log10, pi

from disting.fit.judge.admissible import UNDETERMINED
from disting.fit.judge.candidate import Candidate
from disting.fit.judge.modes import Result
from disting.fit.results.selection import Selection, fit_percent
from disting.fit.search.cost import Case
from disting.fit.search.joint import AnyCost
from disting.measurement import FrequencyResponse
from disting.measurement.units import unit_as
from disting.model.chain import Chain, Damper, Quantity
from disting.report.words import plural

NOTHING = 1e-12  # of the largest value of a kind: rounding of a response hides what is smaller
NEGLIGIBLE = 1e-7  # relative standard error that is not worth printing
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MOTIONS = {
    "m": Quantity.ACCELERATION,
    "d": Quantity.VELOCITY,
    "b": Quantity.VELOCITY,
    "k": Quantity.POSITION,
}
SIMPLE = {  # what a quotient of units is usually called
    "N/(m/s²)": "kg",
    "N/(m/s)": "N s/m",
    "Nm/(rad/s²)": "kg m²",
    "Nm/(rad/s)": "N m s/rad",
    "N m/(rad/s²)": "kg m²",
    "N m/(rad/s)": "N m s/rad",
}
CASES = {
    Case.COMPLEX: "the squared distances in the complex plane",
    Case.AMPLITUDE: "the squares of the amplitude errors and of the phase errors [rad]",
    Case.LOGARITHM: "the squares of the amplitude errors [decades] and of the phase errors [rad]",
}


def readable(value: float, digits: int = 3, *, all_digits: bool = False) -> str:
    """A number as one writes it by hand; `all_digits` keeps zeros at the end, for columns of a
    table.

    >>> readable(0.63528), readable(12345.6), readable(1.0e-4), readable(inf), readable(30.0)
    ('0.635', '1.23·10⁴', '10⁻⁴', '∞', '30')
    """
    if not isfinite(value):
        return "∞" if value == inf else "–"
    if value == 0 or 1e-3 <= abs(value) < 1e4:
        text = plain(value, digits)
        return text if all_digits else _shorten(text)
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    mantissa = mantissa if all_digits else _shorten(mantissa)
    power = f"10{str(int(exponent)).translate(RAISED)}"
    return power if mantissa == "1" else f"{mantissa}·{power}"


def plain(value: float, digits: int) -> str:
    """Significant digits without an exponent."""
    if value == 0:
        return "0"
    decimals = digits - 1 - floor(log10(abs(value)))
    return f"{round(value, decimals):.{max(decimals, 0)}f}"


def _shorten(text: str) -> str:
    return text.rstrip("0").rstrip(".") if "." in text else text


def values_in_words(values: Mapping[str, float]) -> str:
    """Values of parameters; as zero what is nothing beside another one of its kind: a search that
    runs to the limit at which an element is missing ends at digits that mean nothing.

    >>> values_in_words({"m1": 0.25, "m2": 1.2e-31, "k12": 124860.0})
    'm1 = 0.25, m2 ≈ 0, k12 = 1.2486·10⁵'
    """
    largest = {name[0]: max(v for n, v in values.items() if n[0] == name[0]) for name in values}
    return ", ".join(
        f"{name} ≈ 0" if value < NOTHING * largest[name[0]] else f"{name} = {readable(value, 5)}"
        for name, value in values.items()
    )


def with_error(value: float, error: float) -> str:
    """Value and standard error, rounded to two digits of the error.

    >>> with_error(53.8927, 0.0448), with_error(0.00478339, 0.0000182), with_error(2.0, inf)
    ('53.893 ± 0.045', '(4.783 ± 0.018)·10⁻³', '2 (not determined)')
    """
    if not isfinite(error) or error > abs(value) * UNDETERMINED:
        return f"{readable(value)} (not determined)"
    if error <= NEGLIGIBLE * abs(value):
        return readable(value, 8)
    size = floor(log10(abs(value)))
    power = size if not -3 < size < 5 else 0
    decimals = max(1 - floor(log10(error / 10.0**power)), 0)
    both = f"{value / 10.0**power:.{decimals}f} ± {error / 10.0**power:.{decimals}f}"
    return f"({both})·10{str(power).translate(RAISED)}" if power else both


def between(low: float, high: float) -> str:
    """An interval, its ends with two digits of its width.

    >>> between(0.0099881, 0.0100433), between(0.0, 0.31), between(1.0, inf), between(2.0, 2.0)
    ('0.009988 to 0.010043', '0 to 0.31', '1 to ∞', '2 to 2')
    """
    width = high - low
    if not 0 < width < inf:
        return f"{readable(low)} to {readable(high)}"
    digits = [
        max(2 + floor(log10(abs(end) or width)) - floor(log10(width)), 2) for end in (low, high)
    ]
    return " to ".join(
        readable(end, n, all_digits=True) for end, n in zip((low, high), digits, strict=True)
    )


def percent(share: float) -> str:
    """A share in percent.

    >>> percent(0.0038), percent(0.0717), percent(1.0), percent(inf)
    ('0.38 %', '7.2 %', '100 %', '∞')
    """
    if 0 < share < NEGLIGIBLE:
        return f"< {readable(100 * NEGLIGIBLE)} %"
    return f"{readable(100 * share, 2)} %" if isfinite(share) else "∞"


def error_in_percent(share: float) -> str:
    """A relative standard error in percent, where the value is determined at all.

    >>> error_in_percent(0.0038), error_in_percent(inf)
    ('0.38 %', '–')
    """
    return "–" if not share <= UNDETERMINED else percent(share)


def name(chain: Chain) -> str:
    """A candidate in a few words; ports are named unless force and sensor sit at mass 1.

    >>> name(Chain(2, ground_dampers=(2,), dead_time=True)), name(Chain(1))
    ('2 masses, damper b2, dead time', '1 mass')
    """
    words = [plural(chain.n_masses, "mass", "masses")]
    if chain.indices[1:] != Chain(chain.n_masses, damped=False).indices[1:]:
        words += [f"gap {chain.gap}–{chain.gap + 1}"] if chain.gap else []
        words.append(f"force {_port(chain.act_minus, chain.act_plus)}")
        words.append(f"sensor {_port(chain.meas_minus, chain.meas_plus)}")
    names = [f"b{i}" for i in chain.ground_dampers]
    names += [Damper(chain.gap).parameter] if chain.gap_damper else []
    words += [f"damper{'s' if len(names) > 1 else ''} {', '.join(names)}"] if names else []
    return ", ".join(
        words + (["lag"] if chain.lag else []) + (["dead time"] if chain.dead_time else [])
    )


def _port(minus: int, plus: int) -> str:
    return f"{minus}–{plus}" if minus else f"{plus}"


def unit_of(kind: str, measured: FrequencyResponse) -> str:
    """Unit of a mass, spring or damper, m, k, d or b, that the units of the data give, in words
    where they give none; else s.

    >>> import numpy as np
    >>> units = {"input": ("", "Nm"), "output": ("", "rad/s^2")}
    >>> drive = FrequencyResponse(np.arange(1.0, 9.0), np.ones(8, complex), **units)
    >>> unit_of("m", drive), unit_of("k", drive), unit_of("d", drive), unit_of("T", drive)
    ('kg m²', 'Nm/rad', 'N m s/rad', 's')
    """
    if kind not in MOTIONS:
        return "s"
    motion = unit_as(measured.output.unit, measured.quantity, MOTIONS[kind])
    if not measured.input.unit or not motion:
        return f"input per {MOTIONS[kind]}"
    quotient = (
        f"{measured.input.unit}/({typeset(motion)})"
        if "/" in motion
        else f"{measured.input.unit}/{motion}"
    )
    return SIMPLE.get(quotient, quotient)


def result_unit(result: Result, measured: FrequencyResponse) -> str:
    """Unit of a physical result."""
    if result.name.endswith("inertia"):
        return unit_of("m", measured)
    return unit_of("k", measured) if result.name.startswith("stiffness") else result.unit


def response_unit(measured: FrequencyResponse) -> str:
    """Unit of G, "" where the data do not give it."""
    force, motion = measured.input.unit, measured.output.unit
    return f"{typeset(motion)} per {force}" if force and motion else ""


def typeset(text: str) -> str:
    """A unit with raised powers.

    >>> typeset("rad/s^2")
    'rad/s²'
    """
    return text.replace("^2", "²").replace("^3", "³")


def cost_in_words(cost: AnyCost) -> str:
    """Terms of the cost J in words.

    >>> import numpy as np
    >>> from disting.fit.search.cost import Cost
    >>> cost_in_words(Cost(FrequencyResponse(np.arange(1.0, 9.0), np.ones(8, complex))))
    'the squares of the amplitude errors [decades] and of the phase errors [rad], weighted π : 1'
    """
    alone = cost.parts[0]
    if cost.case is Case.COMPLEX and alone.lines is not None:
        return f"{CASES[cost.case]}, each in units of the scatter of its line"
    first, second = alone.weights or ((pi, 1.0) if cost.case is Case.LOGARITHM else (1.0, 1.0))
    if first == second:
        return CASES[cost.case]
    return (
        f"{CASES[cost.case]}, weighted {'π' if first == pi else readable(first)} :"
        f" {readable(second)}"
    )


def fit_in_words(
    selection: Selection,
    train: FrequencyResponse,
    test: FrequencyResponse | None = None,
    at: int = 0,
) -> str:
    """Share of the data that the described candidate reproduces, see `fit_percent`; `at` = index of
    the response among several.
    """
    candidate, task = selection.described, selection.task
    setups = task.cost.setups
    of = f" of {setups[at].text}" if len(setups) > 1 else ""
    named = [("training", train), *([("test", test)] if test is not None else [])]
    sizes = [(label, fit_percent(candidate, task, data, at)) for label, data in named]
    each = [
        f"{size:.4g} % of the {label} data{of}" if isfinite(size) else f"{label} data are constant"
        for label, size in sizes
    ]
    return (
        f"fit: {', '.join(each)} (normalised root mean square of the complex response, 100 % is"
        " perfect)"
    )


def fits_of(selection: Selection, candidate: Candidate) -> list[tuple[str, str]]:
    """Description of each response, and the share of its training data that a candidate reproduces,
    see `fit_percent`; empty where there is one response.
    """
    cost = selection.task.cost
    if len(cost.parts) == 1:
        return []
    pairs = []
    for at, (setup, part) in enumerate(zip(cost.setups, cost.parts, strict=True)):
        size = fit_percent(candidate, selection.task, part.measured, at)
        pairs.append((setup.text, f"{size:.4g} %" if isfinite(size) else "–"))
    return pairs
