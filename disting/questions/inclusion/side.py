"""What inclusion asks of a chain that is compared."""

from typing import Protocol

from disting.behaviour.profile import Profile
from disting.behaviour.sample import Representation
from disting.model.chain import Chain
from disting.model.question import Answerer, Settings
from disting.model.symmetry import Form


class ChainSide(Protocol):
    """A chain with its canonical form, its rank, its profiles, and who answers about it."""

    @property
    def chain(self) -> Chain:
        """The chain as given."""

    @property
    def canonical(self) -> Form:
        """Its canonical form under the symmetries of the class."""

    @property
    def rank(self) -> int:
        """Number of determinable parameters."""

    @property
    def settings(self) -> Settings:
        """How many points are drawn, and by which seed."""

    @property
    def answerer(self) -> Answerer:
        """Who computes, or looks up."""

    def profile(self, representation: Representation, count: int) -> Profile:
        """What it reveals in a representation, with so many Markov parameters."""
