"""A chain with numbers as a state space, which `Chain.state_space` returns."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from disting.model.presentation import plural, summary

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class StateSpace:
    """x' = A x + B u, y = C x + D u of a chain; states: positions, velocities, the lag's force;
    `delay` of the input [s]; `states` by name, `units` of states, of the input u and the output y
    where the parameters are in SI units of translation.
    """

    A: "Real"
    B: "Real"
    C: "Real"
    D: "Real"
    delay: float
    states: tuple[str, ...]
    units: dict[str, str]

    def __repr__(self) -> str:
        return summary(
            self,
            plural(len(self.A), "state") + (f", dead time {self.delay:g} s" if self.delay else ""),
        )
