"""The two rows of masses that a chain consists of: the free one, and the grounded one if there is
a gap.

Force and sensor cross the gap in the same sense, so the receptance of a chain is the sum of the
receptances of its rows.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from disting.model.chain import Chain
from disting.model.structure import Damper, GroundDamper, Mass, Ports, Spring, Structure

FREE, GROUNDED = "free", "grounded"


@dataclass(frozen=True, slots=True)
class Row:
    """Masses 1..`n_masses` with springs (if `damped`, dampers too) between neighbours and, if
    `walled`, from mass 1 to a wall.

    The force acts on mass `act`, the sensor shows the position of mass `meas`.
    """

    n_masses: int
    walled: bool
    act: int
    meas: int
    damped: bool = False
    ground_dampers: tuple[int, ...] = ()

    @property
    def joints(self) -> range:
        """Left ends of the springs; 0 is the wall."""
        return range(0 if self.walled else 1, self.n_masses)

    @property
    def structure(self) -> Structure:
        """Elements and ports, with a sensor of position."""
        elements: list[Mass | Spring | Damper | GroundDamper] = [
            Mass(i) for i in range(1, self.n_masses + 1)
        ]
        elements += [Spring(i) for i in self.joints]
        elements += [Damper(i) for i in self.joints if self.damped]
        elements += [GroundDamper(i) for i in self.ground_dampers]
        return Structure(self.n_masses, tuple(elements), Ports(0, self.act, 0, self.meas), 0)

    @property
    def canonical(self) -> "Row":
        """The equivalent row with the smallest numbers: force and sensor exchanged, or mirrored
        if there is no wall.
        """
        return min(self._forms(), key=lambda r: (r.act, r.meas, r.ground_dampers))

    def _forms(self) -> Iterator["Row"]:
        for row in (self,) if self.walled else (self, self._mirrored()):
            yield row
            yield replace(row, act=row.meas, meas=row.act)

    def _mirrored(self) -> "Row":
        last = self.n_masses + 1
        dampers = tuple(sorted(last - i for i in self.ground_dampers))
        return replace(self, act=last - self.act, meas=last - self.meas, ground_dampers=dampers)


def rows_of(chain: Chain) -> dict[str, Row]:
    """The rows of a chain by name, each in its canonical form, masses numbered from 1 in each.

    >>> rows_of(Chain(3, 1, 1, 2, 1, 3))["free"]
    Row(n_masses=2, walled=False, act=1, meas=2, damped=False, ground_dampers=())
    """
    gap, dampers = chain.gap, chain.ground_dampers
    behind = tuple(i - gap for i in dampers if i > gap)
    free = Row(
        chain.n_masses - gap,
        False,
        chain.act_plus - gap,
        chain.meas_plus - gap,
        chain.damped,
        behind,
    )
    before = tuple(i for i in dampers if i <= gap)
    grounded = (
        [Row(gap, True, chain.act_minus, chain.meas_minus, chain.damped, before)] if gap else []
    )
    return {
        name: row.canonical for name, row in zip((FREE, GROUNDED), (free, *grounded), strict=False)
    }
