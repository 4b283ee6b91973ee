"""What is asked of models beyond conditions 1 to 9: computed by a pure function, kept as text
by whoever keeps it.
"""

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Generic, Protocol, TypeVar

from disting.model.settings import Settings

T = TypeVar("T")
Models = tuple[Any, ...]
"""One chain or general model, or an ordered pair of them: frozen dataclasses, whose fields tell all
of them.
"""


class Membership(StrEnum):
    """An answer: whether generic models of one structure are models of the other."""

    MEMBER = "member"
    EXCLUDED = "excluded"
    UNKNOWN = "unknown"


@dataclass(frozen=True)
class Question(Generic[T]):
    """A question by its `name`, about one model or an ordered pair.

    `answer` computes (of the models and the settings), `encode` and `decode` turn an answer into
    text and back.
    """

    name: str
    answer: Callable[..., T]
    encode: Callable[[T], str]
    decode: Callable[[str], T]


class Answerer(Protocol):
    """Whoever answers questions: by computing, or from a store."""

    def __call__(self, question: Question[T], models: Models, settings: Settings) -> T:
        """The answer for these models in this order."""


def computed(question: Question[T], models: Models, settings: Settings) -> T:
    """The answer, computed now."""
    return question.answer(*models, settings)
