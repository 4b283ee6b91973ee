"""All chains of one size under (36), (37) and (38), numbered from 1 as in Tables 2 and 3."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

from disting.errors import InputError, shown
from disting.model.chain import Chain, Sensor, as_sensor
from disting.model.constraints import violated
from disting.model.numbering import after, before, count
from disting.model.shown import Shown

# of a family that a command or a text may ask for: it has 1.4 million models, listed in half a
# minute
MOST_MASSES = 40


@dataclass(frozen=True)
class Family(Shown):
    """The chains with `n_masses` masses, in the order of (n_gap, n_act-, n_act+, n_meas-, n_meas+).

    The sizes for N_B = 1..8 are 1, 3, 11, 29, 73, 157, 314, 574 (Table 2 and its continuation).
    As where a model is named, springs have dampers beside them unless `damped` is False.

    >>> len(Family(3)), Family(3)[4].parameters
    (11, ('m1', 'm2', 'm3', 'k12', 'k23', 'd12', 'd23'))
    """

    n_masses: int
    damped: bool = True
    sensor: Sensor = Sensor.ACCELERATION

    def __post_init__(self) -> None:
        if (
            isinstance(self.n_masses, bool)
            or not isinstance(self.n_masses, int)
            or self.n_masses < 1
        ):
            raise InputError(f"a family has at least one mass, not {shown(self.n_masses)}")
        if not isinstance(self.damped, bool):
            raise InputError(f"damped is True or False, not {shown(self.damped)}")
        object.__setattr__(self, "sensor", as_sensor(self.sensor))

    def __repr__(self) -> str:
        return f"Family({self.n_masses}, damped={self.damped}, sensor={self.sensor.value!r})"

    @cached_property
    def models(self) -> tuple[Chain, ...]:
        """All models; `models[0]` is model 1."""
        return tuple(map(self._model, range(len(self))))

    def __len__(self) -> int:
        return count(self.n_masses)

    def __iter__(self) -> Iterator[Chain]:
        return iter(self.models)

    def __contains__(self, chain: object) -> bool:
        return (
            isinstance(chain, Chain)
            and chain.n_masses == self.n_masses
            and chain == Chain(*chain.indices, sensor=self.sensor, damped=self.damped)
            and not any(violated(chain.indices, (38,)))  # no chain breaks (36) or (37)
        )

    def __getitem__(self, number: int) -> Chain:
        if isinstance(number, bool) or not isinstance(number, int) or not 1 <= number <= len(self):
            raise InputError(
                f"the {self.n_masses}-mass family has models 1 to {len(self)}, not {shown(number)}"
            )
        return self._model(number - 1)

    def number(self, chain: Chain) -> int:
        """Number of a chain in this family; raises InputError for a chain outside it."""
        if replace(chain, sensor=self.sensor, damped=self.damped) not in self:
            raise InputError(f"the chain with {chain} is not in the {self.n_masses}-mass family")
        return before(chain.indices) + 1

    def _model(self, place: int) -> Chain:
        return Chain(*after(self.n_masses, place), sensor=self.sensor, damped=self.damped)
