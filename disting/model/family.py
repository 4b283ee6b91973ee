"""All chains of one size under (36), (37) and (38), numbered from 1 as in Tables 2 and 3."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

from disting.errors import InputError, shown
from disting.model.chain import Chain, Sensor
from disting.model.constraints import Indices, violated
from disting.model.shown import Shown

# of a family that a command or a text may ask for: it has 1.4 million models, listed in half a
# minute
MOST_MASSES = 40
# masses; larger families are long to list, so their chains are named by their indices
NUMBERED_UP_TO = 8


@dataclass(frozen=True)
class Family(Shown):
    """The chains with `n_masses` masses, in the order of (n_gap, n_act-, n_act+, n_meas-, n_meas+).

    The sizes for N_B = 1..8 are 1, 3, 11, 29, 73, 157, 314, 574 (Table 2 and its continuation).

    >>> len(Family(3)), Family(3, damped=True)[4].indices[1:]
    (11, (0, 0, 2, 0, 2))
    """

    n_masses: int
    damped: bool = False
    sensor: Sensor = Sensor.ACCELERATION

    def __post_init__(self) -> None:
        if (
            isinstance(self.n_masses, bool)
            or not isinstance(self.n_masses, int)
            or self.n_masses < 1
        ):
            raise InputError(f"a family has at least one mass, not {shown(self.n_masses)}")

    def __repr__(self) -> str:
        damped = ", damped=True" * self.damped
        sensor = "" if self.sensor is Sensor.ACCELERATION else f", sensor={str(self.sensor)!r}"
        return f"Family({self.n_masses}{damped}{sensor})"

    @cached_property
    def models(self) -> tuple[Chain, ...]:
        """All models; `models[0]` is model 1."""
        return tuple(
            Chain(*i, sensor=self.sensor, damped=self.damped) for i in _admissible(self.n_masses)
        )

    def __len__(self) -> int:
        return len(self.models)

    def __iter__(self) -> Iterator[Chain]:
        return iter(self.models)

    def __getitem__(self, number: int) -> Chain:
        if isinstance(number, bool) or not isinstance(number, int) or not 1 <= number <= len(self):
            raise InputError(
                f"the {self.n_masses}-mass family has models 1 to {len(self)}, not {shown(number)}"
            )
        return self.models[number - 1]

    def number(self, chain: Chain) -> int:
        """Number of a chain in this family; raises InputError for a chain outside it."""
        try:
            return self.models.index(replace(chain, sensor=self.sensor, damped=self.damped)) + 1
        except ValueError:
            raise InputError(
                f"the chain with {chain} is not in the {self.n_masses}-mass family"
            ) from None


def _admissible(n: int) -> Iterator[Indices]:
    for gap in range(n):
        low, high = range(gap + 1), range(gap + 1, n + 1)
        for act_minus, act_plus, meas_minus, meas_plus in product(low, high, low, high):
            indices = Indices(n, gap, act_minus, act_plus, meas_minus, meas_plus)
            if not any(violated(indices, (36, 37, 38))):
                yield indices
