"""The constraints (36), (37) and (38) of the paper, each a named predicate with its equation
number.

(36) says where a port may be, (37) that every mass is excited and measured, (38) breaks the
symmetry between models that differ in the numbering only. A chain that breaks (36) or (37) is no
model; one that breaks (38) is a model with another numbering, so it can be made and compared but
is not listed in a family.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import NamedTuple


class Indices(NamedTuple):
    """Size and the five indices of section 5.1; index 0 is the ground."""

    n_masses: int
    gap: int
    act_minus: int
    act_plus: int
    meas_minus: int
    meas_plus: int


@dataclass(frozen=True, slots=True)
class Constraint:
    """One line of an equation: its number, its text in the paper's symbols, the predicate itself,
    and, of what a chain may break, what is wrong and possible instead.
    """

    equation: int
    name: str
    text: str
    holds: Callable[[Indices], bool]
    words: str = ""

    def refusal(self, i: Indices) -> str:
        """What is said of a chain that breaks it: in words, then in the paper's symbols."""
        said = self.words.format(**i._asdict(), low=i.gap + 1, highest_gap=i.n_masses - 1)
        return (
            f"{said} (constraint ({self.equation}) {self.text} is violated by N_B={i.n_masses},"
            f" n_gap={i.gap}, n_act-={i.act_minus}, n_act+={i.act_plus}, n_meas-={i.meas_minus},"
            f" n_meas+={i.meas_plus})"
        )


CONSTRAINTS: tuple[Constraint, ...] = (
    Constraint(
        36,
        "gap-range",
        "0 <= n_gap <= N_B - 1",
        lambda i: 0 <= i.gap <= i.n_masses - 1,
        "the gap lies above mass 0 (the ground) to {highest_gap}, not {gap}",
    ),
    Constraint(
        36,
        "force-reference",
        "0 <= n_act- <= n_gap",
        lambda i: 0 <= i.act_minus <= i.gap,
        "the force acts across the gap, against mass 0 (the ground) to {gap}, not {act_minus}",
    ),
    Constraint(
        36,
        "force",
        "n_gap + 1 <= n_act+ <= N_B",
        lambda i: i.gap + 1 <= i.act_plus <= i.n_masses,
        "the force acts on a mass from {low} to {n_masses}, not {act_plus}",
    ),
    Constraint(
        36,
        "sensor-reference",
        "0 <= n_meas- <= n_gap",
        lambda i: 0 <= i.meas_minus <= i.gap,
        "the sensor looks across the gap, from mass 0 (the ground) to {gap}, not {meas_minus}",
    ),
    Constraint(
        36,
        "sensor",
        "n_gap + 1 <= n_meas+ <= N_B",
        lambda i: i.gap + 1 <= i.meas_plus <= i.n_masses,
        "the sensor is at a mass from {low} to {n_masses}, not {meas_plus}",
    ),
    Constraint(
        37,
        "excitability",
        "n_gap = 0 or n_act- > 0",
        lambda i: i.gap == 0 or i.act_minus > 0,
        "nothing moves the masses below the gap: the force acts against one of 1 to {gap}, not the"
        " ground",
    ),
    Constraint(
        37,
        "sensitivity",
        "n_gap = 0 or n_meas- > 0",
        lambda i: i.gap == 0 or i.meas_minus > 0,
        "nothing shows the masses below the gap: the sensor looks from one of 1 to {gap}, not the"
        " ground",
    ),
    Constraint(
        38, "reciprocity-breaking", "n_act+ <= n_meas+", lambda i: i.act_plus <= i.meas_plus
    ),
    Constraint(
        38,
        "reflection-breaking",
        "n_act+ <= n_gap + ceil((N_B - n_gap)/2)",
        lambda i: i.act_plus <= i.gap + (i.n_masses - i.gap + 1) // 2,
    ),
)


def violated(indices: Indices, equations: tuple[int, ...]) -> Iterator[Constraint]:
    """Yield the constraints of the given equations that the indices break, in the paper's order."""
    return (c for c in CONSTRAINTS if c.equation in equations and not c.holds(indices))
