"""What the conditions ask of a model: the Protocol that chains and general models implement."""

from typing import Protocol, Self

from disting.algebra.colouring import Colouring
from disting.behaviour.profile import Profile
from disting.behaviour.sample import Representation
from disting.evidence.conditions import Renaming
from disting.model.settings import Settings
from disting.model.structure import Structure


class Side(Protocol):
    """One side of a comparison, by its name; both sides of a comparison are of one kind."""

    @property
    def name(self) -> str:
        """What the verdict calls it."""

    @property
    def settings(self) -> Settings:
        """How many points are drawn, and by which seed."""

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""

    @property
    def structure(self) -> Structure | None:
        """Its masses, springs and dampers, if it is made of such and measured in one way."""

    @property
    def n_elements(self) -> int | None:
        """Number of its masses, springs and dampers, if it is made of such elements."""

    def part_of(self, other: Self) -> dict[int, int] | None:
        """A numbering of its masses under which it is the other side with elements missing, what is
        measured being the same; None if there is none.
        """

    def profile(self, representation: Representation, count: int) -> Profile:
        """What it reveals in a representation, with so many Markov parameters."""

    def sketch(self, representation: Representation, count: int) -> Profile:
        """The same, perhaps without its dependences, which are the dear part of it."""

    def columns(self, point: list[int]) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
        """Values and Jacobian columns, at a point, of functions that a renaming carries into those
        of the other side, modulo one prime for all models.

        Colours of many models are compared, so they share it. Nothing rests on it: colours that
        differ prove that no renaming exists, modulo any prime, and a renaming that is found is
        proven exactly.
        """

    @property
    def colouring(self) -> Colouring:
        """Stable colours of the parameters in these functions."""

    def symmetry_with(self, other: Self) -> Renaming | None:
        """The renaming by which a symmetry of the class connects both sides, if there is one."""

    def is_renamed(self, other: Self, renaming: dict[str, str]) -> bool:
        """Whether renaming the parameters turns this transfer function into the other: exact."""
