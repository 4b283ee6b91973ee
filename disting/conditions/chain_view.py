"""A chain as it is compared."""

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from disting.algebra.certainty import full_text
from disting.behaviour.chain_model import ChainModel
from disting.behaviour.transfer import is_renaming
from disting.conditions.side import Side, View
from disting.evidence.conditions import Renaming
from disting.model.chain import Chain, Premise, Structure
from disting.model.minors import embeddings
from disting.model.question import Of
from disting.model.symmetry import Form, between, canonical


@dataclass(frozen=True)
class ChainView(View):
    """A chain; its profiles are those of the canonical form, which all symmetric chains share.
    `note`: names of its parameters in the network that it was given as.
    """

    of: ClassVar[Of] = Of.CHAINS
    given: Chain
    note: str = ""

    @property
    def subject(self) -> Chain:
        """The chain."""
        return self.given

    @property
    def chain(self) -> Chain:
        """The chain."""
        return self.given

    @property
    def model(self) -> ChainModel:
        """The chain as it is."""
        return ChainModel(self.structure)

    @cached_property
    def canonical(self) -> Form:
        """Canonical form under the symmetries of the class."""
        return canonical(self.given)

    @property
    def form(self) -> Chain:
        """The canonical chain."""
        return self.canonical.chain

    @property
    def profiled(self) -> ChainModel:
        """The canonical structure."""
        return ChainModel(self.form.structure)

    @property
    def content(self) -> tuple[str, ...]:
        """All that its verdicts depend on, as text."""
        return (full_text(self.given), *self.notes(""))

    @property
    def premise(self) -> Premise:
        """Damping and sensor quantity."""
        return self.given.premise

    def notes(self, name: str) -> tuple[str, ...]:
        """The names of its parameters where they are others."""
        return (self.note,) if self.note else ()

    @property
    def structure(self) -> Structure:
        """Masses, springs and dampers."""
        return self.given.structure

    @property
    def n_elements(self) -> int:
        """Number of masses, springs and dampers."""
        return len(self.structure.elements)

    def is_renamed(self, other: "ChainView", renaming: dict[str, str]) -> bool:
        """Return True if renaming the parameters gives the other transfer function: exact."""
        return is_renaming(self.structure, other.structure, renaming)

    def symmetry_with(self, other: "ChainView") -> Renaming | None:
        """Return the renaming by the common canonical form, None if there is none."""
        way = between(self.given, other.given)
        return way and Renaming(tuple(way[0].items()), way[1])

    def part_of(self, other: "ChainView") -> dict[int, int] | None:
        """Return the numbering under which it is the other one with elements missing."""
        return next(embeddings(self.structure, other.structure), None)

    def pair(self, other: "ChainView") -> tuple[Chain, Chain]:
        """Return the canonical forms in an order of their own, so that a pair is asked about
        once.
        """
        low, high = sorted(
            (self.form, other.form), key=lambda c: (c.indices, c.ground_dampers, c.lag)
        )
        return low, high


ChainSide = Side[ChainView]
