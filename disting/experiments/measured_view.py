"""A chain under several experiments as it is compared.

Conditions 1 to 7 apply to the stacked summary without change, and so is condition 8: where one
model is the other with elements missing and all experiments are at the same masses, missing
elements that go to zero carry one tuple of transfer functions into the other, so the closure of its
image lies in that of the other, and of equal rank they are equal. Condition 9 would be as true, but
its third model, with the elements of both, is no chain of the class: it has no gap where theirs
differ, so it cannot be measured as chains are, and the exact decision finds its result.
"""

from dataclasses import dataclass, replace
from typing import ClassVar

from disting.conditions.side import Side, View
from disting.experiments.experiment import MeasuredChain
from disting.experiments.inclusion import numbering
from disting.experiments.machine_model import MachineModel, is_renaming
from disting.model.chain import Premise
from disting.model.question import Of


@dataclass(frozen=True)
class MeasuredView(View):
    """A chain under several experiments. A stacked summary has many more rows than parameters, so
    the search for its dependences costs more than all else.
    """

    of: ClassVar[Of] = Of.MEASURED
    has_dear_dependences: ClassVar[bool] = True
    measured: MeasuredChain

    @property
    def subject(self) -> MeasuredChain:
        """The chain and its experiments."""
        return self.measured

    @property
    def form(self) -> MeasuredChain:
        """The chain and its experiments."""
        return self.measured

    @property
    def model(self) -> MachineModel:
        """All transfer functions."""
        return MachineModel(self.measured)

    @property
    def premise(self) -> Premise:
        """Damping, sensor quantity, and all experiments."""
        return replace(self.measured.chain.premise, experiments=self.measured.text)

    @property
    def n_elements(self) -> int:
        """Number of masses, springs and dampers."""
        return len(self.measured.chain.structure.elements)

    def part_of(self, other: "MeasuredView") -> dict[int, int] | None:
        """Return the numbering under which it is the other one with elements missing, all
        experiments at the same masses.
        """
        return numbering(self.measured, other.measured)

    def is_renamed(self, other: "MeasuredView", renaming: dict[str, str]) -> bool:
        """Return True if renaming the parameters gives all the other transfer functions: exact."""
        return is_renaming(self.measured, other.measured, renaming)


MeasuredSide = Side[MeasuredView]
