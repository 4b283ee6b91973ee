"""All chains of one size under (36), (37) and (38), numbered from 1 as in Tables 2 and 3, by
counting: nothing is listed.

The indices that are admissible are, gap by gap: n_act- and n_meas- each any low index (0 where the
gap is 0, else 1..gap), n_act+ one of the nearer half of the free row, n_meas+ one from n_act+ to
N_B. Models are in the order of (n_gap, n_act-, n_act+, n_meas-, n_meas+), so the number of models
before one is a sum of products.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache, cached_property

from disting.errors import InputError, short
from disting.model.chain import Chain, Indices, violations
from disting.model.presentation import NotebookTable
from disting.quantities import Quantity, quantity_of_model
from disting.renamed import renamed_attributes


@cache  # asked for at every look-up of a pair
def count(n: int) -> int:
    """Number of models with n masses.

    >>> [count(n) for n in range(1, 9)]
    [1, 3, 11, 29, 73, 157, 314, 574]
    """
    return sum(_with_gap(n, gap) for gap in range(n))


def before(indices: Indices) -> int:
    """Number of models of the same size that precede this one, which is admissible.

    >>> before(Indices(3, 0, 0, 2, 0, 2))
    3
    """
    n, gap, act_minus, act_plus, meas_minus, meas_plus = indices
    low = _low(gap)
    return (
        sum(_with_gap(n, smaller) for smaller in range(gap))
        + low.index(act_minus) * len(low) * _free_ends(n, gap)
        + len(low) * sum(n - end + 1 for end in range(gap + 1, act_plus))
        + low.index(meas_minus) * (n - act_plus + 1)
        + meas_plus
        - act_plus
    )


def after(n: int, place: int) -> Indices:
    """The model preceded by this number of others: the inverse of `before`, for 0 <= place <
    count(n).
    """
    gap = 0
    while place >= _with_gap(n, gap):
        place -= _with_gap(n, gap)
        gap += 1
    low, act_plus = _low(gap), gap + 1
    act_minus, place = divmod(place, len(low) * _free_ends(n, gap))
    while place >= len(low) * (n - act_plus + 1):
        place -= len(low) * (n - act_plus + 1)
        act_plus += 1
    meas_minus, place = divmod(place, n - act_plus + 1)
    return Indices(n, gap, low[act_minus], act_plus, low[meas_minus], act_plus + place)


def _low(gap: int) -> range:
    """Where n_act- and n_meas- may be: (36) and (37)."""
    return range(min(gap, 1), gap + 1)


def _free_ends(n: int, gap: int) -> int:
    """Pairs of n_act+ and n_meas+: (36) and (38)."""
    return sum(n - act_plus + 1 for act_plus in range(gap + 1, gap + (n - gap + 1) // 2 + 1))


def _with_gap(n: int, gap: int) -> int:
    return len(_low(gap)) ** 2 * _free_ends(n, gap)


# of a family that a command or a text may ask for: it has 1.4 million models, listed in half a
# minute
MOST_MASSES = 40


@renamed_attributes(sensor="quantity")
@dataclass(frozen=True)
class Family(NotebookTable):
    """The chains with `n_masses` masses, in the order of (n_gap, n_act-, n_act+, n_meas-, n_meas+).

    The sizes for N_B = 1..8 are 1, 3, 11, 29, 73, 157, 314, 574 (Table 2 and its continuation). As
    where a model is named, springs have dampers in parallel unless `damped` is False. The sensor
    shows `quantity`.

    >>> len(Family(3)), Family(3)[4].parameters
    (11, ('m1', 'm2', 'm3', 'k12', 'k23', 'd12', 'd23'))
    """

    n_masses: int
    damped: bool = True
    quantity: Quantity = Quantity.ACCELERATION

    def __post_init__(self) -> None:
        if (
            isinstance(self.n_masses, bool)
            or not isinstance(self.n_masses, int)
            or self.n_masses < 1
        ):
            raise InputError(f"a family has at least one mass, not {short(self.n_masses)}")
        if not isinstance(self.damped, bool):
            raise InputError(f"damped is True or False, not {short(self.damped)}")
        object.__setattr__(self, "quantity", quantity_of_model(self.quantity))

    def __repr__(self) -> str:
        return f"Family({self.n_masses}, damped={self.damped}, quantity={self.quantity.value!r})"

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
            and chain == Chain(*chain.indices, quantity=self.quantity, damped=self.damped)
            and not any(violations(chain.indices, (38,)))  # no chain breaks (36) or (37)
        )

    def __getitem__(self, number: int) -> Chain:
        if isinstance(number, bool) or not isinstance(number, int) or not 1 <= number <= len(self):
            raise InputError(
                f"the {self.n_masses}-mass family has models 1 to {len(self)}, not {short(number)};"
                f" 'disting models {self.n_masses}' lists them"
            )
        return self._model(number - 1)

    def number(self, chain: Chain) -> int:
        """Number of a chain in this family; raises InputError for a chain outside it."""
        if replace(chain, quantity=self.quantity, damped=self.damped) not in self:
            raise InputError(f"the chain with {chain} is not in the {self.n_masses}-mass family")
        return before(chain.indices) + 1

    def _model(self, place: int) -> Chain:
        return Chain(*after(self.n_masses, place), quantity=self.quantity, damped=self.damped)
