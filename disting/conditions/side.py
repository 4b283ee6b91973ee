"""One side of a comparison: a model under its name, with its profiles. Chains, chains under several
experiments and networks differ in their view, which says what the model is, and in the tables of
deciders that are asked about it (`disting.decide`).
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Generic, Self, TypeVar

from disting.algebra.certainty import full_text, prime
from disting.algebra.colouring import Colouring, colouring
from disting.behaviour.profile import Profile, profile
from disting.behaviour.sample import Representation
from disting.evidence.conditions import Renaming
from disting.model.chain import Chain, Premise, Structure
from disting.model.protocol import Columns, Model
from disting.model.question import Answerer, Models, Of, Question, Settings, compute

Ask = Callable[[Question[Any], Sequence[Models]], None]
"""Has a question answered for many models or pairs at once."""
T = TypeVar("T")
V = TypeVar("V", bound="View", covariant=True)


class View(ABC):
    """A model as it is compared. What a kind of models does not have stays as it is here."""

    of: ClassVar[Of]
    has_dear_dependences: ClassVar[bool] = False  # their search costs more than all else

    @property
    @abstractmethod
    def subject(self) -> Any:
        """The chain, the measured chain, or the general model."""

    @property
    @abstractmethod
    def model(self) -> Model:
        """Its transfer functions."""

    @property
    @abstractmethod
    def form(self) -> Any:
        """The model that stored questions are asked about; the same for all models that are
        equal up to names or symmetries.
        """

    @property
    def profiled(self) -> Model:
        """The model whose profiles are computed; models that share it share their profiles."""
        return self.model

    @property
    def content(self) -> tuple[str, ...]:
        """All that its verdicts depend on, as text."""
        return (full_text(self.subject),)

    @property
    def premise(self) -> Premise | None:
        """Premises that its name leaves open; None for models whose name says all."""
        return None

    def notes(self, name: str) -> tuple[str, ...]:
        """Notes that belong to every statement about it."""
        return ()

    @property
    def in_s(self) -> bool:
        """True for functions of s, which have Markov parameters."""
        return True

    @property
    def chain(self) -> Chain | None:
        """The chain that it is, if it is one and is measured in one way."""
        return None

    def chain_note(self, name: str) -> str:
        """Names of that chain's parameters in it, where they differ."""
        return ""

    @property
    def structure(self) -> Structure | None:
        """Its masses, springs and dampers, if it consists of such and is measured in one way."""
        return None

    @property
    def n_elements(self) -> int | None:
        """Number of its elements, if it is made of elements."""
        return None

    def rank_of_exponents(self) -> int:
        """Number of determinable exponents, which are no parameters of its profiles."""
        return 0

    @abstractmethod
    def is_renamed(self, other: Self, renaming: dict[str, str]) -> bool:
        """Return True if renaming the parameters gives the other's transfer functions: exact."""

    def symmetry_with(self, other: Self) -> Renaming | None:
        """Return the renaming by a symmetry of the class, None if there is none."""
        return None

    def part_of(self, other: Self) -> dict[int, int] | None:
        """Return a numbering of its masses under which it is the other one with elements missing
        and the same is measured; None if there is none.
        """
        return None

    def pair(self, other: Self) -> Models:
        """Return the forms of both, as the exact decision is asked about them."""
        return self.form, other.form


@dataclass(frozen=True)
class Side(Generic[V]):
    """A model under a name. `source` yields profiles, `answerer` answers about pairs; a cache may
    stand in for both.
    """

    name: str
    view: V
    settings: Settings = field(default_factory=Settings)
    source: Callable[[Model, Representation, int, Settings], Profile] = profile
    answerer: Answerer = compute
    _known: dict[object, Any] = field(default_factory=dict, init=False, repr=False, compare=False)

    @property
    def subject(self) -> Any:
        """The model."""
        return self.view.subject

    @property
    def chain(self) -> Any:
        """The chain that it is; None for other models."""
        return self.view.chain

    @property
    def content(self) -> tuple[str, ...]:
        """All that its verdicts depend on, as text."""
        return (self.name, *self.view.content)

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes that belong to every statement about it."""
        return self.view.notes(self.name)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return self.view.model.parameters

    @property
    def n_states(self) -> int:
        """Order of the transfer functions, at most."""
        return self.view.model.n_states

    def once(self, key: object, compute_it: Callable[[], T]) -> T:
        """Return what is computed once for this side under a key."""
        if key not in self._known:
            self._known[key] = compute_it()
        known: T = self._known[key]
        return known

    def profile(self, representation: Representation, count: int) -> Profile:
        """Return the profile in a representation, with so many Markov parameters."""
        ask = self.view.profiled, representation, count, self.settings
        return self.once((representation, count), lambda: self.source(*ask))

    def sketch(self, representation: Representation, count: int) -> Profile:
        """Return the profile without its dependences where those are dear and not known."""
        if not self.view.has_dear_dependences or (representation, count) in self._known:
            return self.profile(representation, count)
        settings = replace(self.settings, subset_limit=0)
        return self.source(self.view.profiled, representation, count, settings)

    @property
    def transfer_profile(self) -> Profile:
        """Profile of the transfer functions, perhaps without its dependences."""
        return self.sketch(Representation.TF, 0)

    @property
    def rank(self) -> int:
        """Number of determinable parameters, exponents included."""
        return self.transfer_profile.rank + self.view.rank_of_exponents()

    @cached_property
    def colouring(self) -> Colouring:
        """Stable colours of the parameters in the functions of `columns`."""
        return colouring(self.columns, ("",) * len(self.parameters))

    def columns(self, point: list[int]) -> Columns:
        """Values and Jacobian columns, at a point, of functions that a renaming carries into those
        of the other side, modulo one prime for all models.

        Colours of many models are compared, so they share it. Nothing rests on it: colours that
        differ prove that no renaming exists, modulo any prime, and a renaming that is found is
        proven exactly.
        """
        return self.view.model.columns(point, prime("renaming"))


AnySide = Side[Any]
"""A side of any kind."""


def notes_of(left: AnySide, right: AnySide) -> tuple[str, ...]:
    """Notes that belong to every statement about both."""
    return tuple(dict.fromkeys((*left.notes, *right.notes)))
