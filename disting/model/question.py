"""Questions on models and their answers: parameter domain, settings, relation; questions beyond
conditions 1 to 9 are answered by a pure function, and the caller caches the answers as text.
"""

import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from enum import StrEnum
from functools import partial
from typing import Any, Generic, Protocol, Self, TypeVar


class Of(StrEnum):
    """The kind of models that a table of deciders is for."""

    CHAINS = "chains"
    MEASURED = "chains under several experiments"
    NETWORKS = "networks and other models"


class Domain(StrEnum):
    """Admissible parameter values. Statements on complex values are on generic ones.

    >>> from disting import Query, View, compare
    >>> compare("3:1", "3:2").domain is Domain.POSITIVE
    True
    """

    COMPLEX = "complex"
    REAL = "real"
    POSITIVE = "positive"


class Relation(StrEnum):
    """Relation of a pair over a domain of parameters.

    INDISTINGUISHABLE: generic parameters of either model have an equivalent in the other.
    DISTINGUISHABLE: those of one of them, at least, have none; the verdict's inclusion and its two
    shares describe the other one. SOMETIMES: some parameters have an equivalent and others have
    none, of two models that are indistinguishable over complex parameters.

    >>> from disting import compare
    >>> compare("3:1", "3:11").relation is Relation.INDISTINGUISHABLE
    True
    """

    DISTINGUISHABLE = "distinguishable"
    INDISTINGUISHABLE = "indistinguishable"
    SOMETIMES = "sometimes"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True)
class Settings:
    """All choices that steer a computation, made once and passed down.

    `seed` names the random points, `points` counts the independent ones behind every rank (error
    bounds multiply; more are taken where the least accepted bound needs them), `subset_limit`
    bounds the subsets of rows that a matroid search may visit (about 10 ns each).

    >>> from disting import Engine, compare
    >>> compare("3:1", "3:4", engine=Engine(Settings(seed="mine", points=4))).relation.value
    'distinguishable'
    """

    seed: str = "disting"
    points: int = 3
    subset_limit: int = 30_000_000

    def to_dict(self) -> dict[str, object]:
        """Plain data for keys and provenance."""
        return asdict(self)


T = TypeVar("T")
Models = tuple[Any, ...]
"""One chain or general model, or an ordered pair of them: frozen dataclasses, whose fields define
them completely.
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

    @classmethod
    def plain(
        cls,
        name: str,
        answer: Callable[..., T],
        to_dict: Callable[[T], object],
        from_dict: Callable[[Any], T],
    ) -> Self:
        """One whose answers become plain data and come from such: their text is JSON."""
        return cls(name, answer, partial(_as_json, to_dict), partial(_of_json, from_dict))


def _as_json(to_dict: Callable[[T], object], answer: T) -> str:
    return json.dumps(to_dict(answer), separators=(",", ":"), ensure_ascii=False)


def _of_json(from_dict: Callable[[Any], T], text: str) -> T:
    return from_dict(json.loads(text))


class Answerer(Protocol):
    """Whoever answers questions: by computing, or from a store."""

    def __call__(self, question: Question[T], models: Models, settings: Settings) -> T:
        """The answer for these models in this order."""


def compute(question: Question[T], models: Models, settings: Settings) -> T:
    """The answer, computed now."""
    return question.answer(*models, settings)


class Answer(StrEnum):
    """Three-valued."""

    YES = "yes"
    NO = "no"
    UNKNOWN = "unknown"
