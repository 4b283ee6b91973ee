"""What is asked of chains beyond conditions 1 to 9: computed by a pure function, kept as text
by whoever keeps it.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Generic, Protocol, TypeVar

from disting.algebra.settings import Settings
from disting.model.chain import Chain

T = TypeVar("T")
Chains = tuple[Chain, ...]


class Membership(StrEnum):
    """An answer: whether generic models of one structure are models of the other."""

    MEMBER = "member"
    EXCLUDED = "excluded"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Question(Generic[T]):
    """A question by its `name`, about one chain or an ordered pair.

    `answer` computes (of the chains and the settings), `encode` and `decode` turn an answer into
    text and back.
    """

    name: str
    answer: Callable[..., T]
    encode: Callable[[T], str]
    decode: Callable[[str], T]


class Answerer(Protocol):
    """Whoever answers questions: by computing, or from a store."""

    def __call__(self, question: Question[T], chains: Chains, settings: Settings) -> T:
        """The answer for these chains in this order."""


def computed(question: Question[T], chains: Chains, settings: Settings) -> T:
    """The answer, computed now."""
    return question.answer(*chains, settings)
