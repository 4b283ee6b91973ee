"""Rows of the tables of deciders, and the engine that runs them.

A row names its functions by module, so that a command loads only what it runs. Methods that are
interchangeable have the same arguments; a table lists them.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from importlib import import_module
from typing import Any, Protocol, TypeVar

from disting.evidence.decision import Theorem
from disting.model.presentation import summary
from disting.model.question import Of as Of


class Asked(StrEnum):
    """A question about a pair of models."""

    SAME = "same over complex parameters"
    REAL = "same over real parameters"
    POSITIVE = "same over positive parameters"
    SHARE = "share of positive models with a positive equivalent, one way"
    CLOSURE = "limits: generic models of the smaller rank are limits of the other's"
    IMAGE = "equivalents: generic models of the smaller rank have an equivalent in the other"
    BOTH = "limits and equivalents together, where nothing is known of either"


class Cost(StrEnum):
    """The order of magnitude of a method's work for models of 3 or 4 masses."""

    CLOSED_FORM = "closed form"  # microseconds: structure alone
    RANKS = "ranks"  # milliseconds: ranks, degrees and profiles
    FIBRE = "fibre"  # milliseconds: one fibre by network synthesis, or a list of equivalents
    IDEALS = "ideals"  # up to minutes: Groebner bases of one fibre
    SEARCH = "search"  # up to minutes: a search for maps, points or parts


class Known(Protocol):
    """A finding of whichever question."""

    @property
    def is_known(self) -> bool:
        """True if it decides; otherwise its note gives the reason."""


F = TypeVar("F", bound=Known)


@dataclass(frozen=True, slots=True, repr=False)
class Decider:
    """A method that may decide a pair.

    `decide`, `applies`, `check` and `recheck` name functions as "package.module:function", below
    `disting`. `decide` and `applies` have the arguments of their table; `decide` returns None where
    the method does not decide. `yields`: types of evidence, or one theorem by name.
    `check(evidence, left, right)` returns True if evidence that was read from a file holds, found
    again from itself alone. `recheck(evidence, left, right, settings)` returns the finding that the
    settings make with such evidence; without it, `decide` is called again.
    """

    name: str
    cost: Cost
    decide: str
    yields: tuple[type[Any] | Theorem, ...] = ()
    check: str = ""
    applies: str = ""
    recheck: str = ""

    def __repr__(self) -> str:
        return summary(self, f"{self.name} ({self.cost})")

    @property
    def cells(self) -> tuple[str, str]:
        """Cost and evidence, as tables show them."""
        kinds = (k.__name__ if isinstance(k, type) else f"{k.name} theorem" for k in self.yields)
        return self.cost, ", ".join(kinds) or "–"

    def has_evidence(self, evidence: object) -> bool:
        """Return True if the method yields evidence of this kind."""
        return any(
            isinstance(evidence, kind) if isinstance(kind, type) else evidence == kind
            for kind in self.yields
        )

    def finding(self, *given: Any) -> Any:
        """Return the finding on these arguments, None where the method does not decide."""
        is_apt = not self.applies or function(self.applies)(*given)
        return function(self.decide)(*given) if is_apt else None

    def finding_again(self, evidence: Any, *given: Any) -> Any:
        """Return the finding that the settings make with evidence of this kind, None if none."""
        if not self.recheck:
            return self.finding(*given)
        return function(self.recheck)(evidence, *given)


@dataclass(frozen=True, slots=True, repr=False)
class Table:
    """The deciders of one question about models of one kind, in the order in which they are tried.

    `at_once` are tried before a stored answer is looked up, of two sides, and what the first one
    finds is the answer; `rows` make the answer that is stored. `note`: what a reader should know of
    the whole.

    The other fields name functions of two sides (see `decide.asking`). `question`: the stored
    question; or `answer`: the whole answer, `answer_all`: those of many pairs. `ground(left, right,
    finding)`: the stored finding on this pair. `prepare(pairs, domain, ask)`: what `answer` needs,
    computed for many pairs. `confirms`: the check of evidence from a file. `is_stated(left,
    right)`: True if verdicts state the answer.
    """

    asked: Asked
    of: Of
    rows: tuple[Decider, ...]
    at_once: tuple[Decider, ...] = ()
    note: str = ""
    question: str = ""
    ground: str = ""
    answer: str = ""
    answer_all: str = ""
    prepare: str = ""
    confirms: str = ""
    is_stated: str = ""

    def __repr__(self) -> str:
        return summary(self, f"{self.asked}, of {self.of}: {len(self.deciders)} deciders")

    @property
    def deciders(self) -> tuple[Decider, ...]:
        """All rows in order."""
        return (*self.at_once, *self.rows)

    @property
    def is_asked(self) -> bool:
        """True for a table that two sides are asked by; others are parts of one."""
        return bool(self.question or self.answer or self.at_once)

    def as_text(self) -> str:
        """Return the table for a terminal, a row a line."""
        rows = (f"{n}. {row.name}: {'; '.join(row.cells)}" for n, row in self._numbered)
        return "\n".join([f"{self.asked} ({self.of})", *rows])

    def as_markdown(self) -> str:
        """Return the table as Markdown."""
        head = f"**{self.asked}, {self.of}.** {self.note}".rstrip()
        lines = ["| | decider | cost | evidence |", "|---|---|---|---|"]
        rows = (f"| {n} | {row.name} | {' | '.join(row.cells)} |" for n, row in self._numbered)
        return "\n".join([head, "", *lines, *rows])

    @property
    def _numbered(self) -> enumerate[Decider]:
        return enumerate(self.deciders, 1)


def function(name: str) -> Any:
    """Return the function that a row names."""
    module, _, attribute = name.partition(":")
    return getattr(import_module(f"disting.{module}"), attribute)


def first_finding(rows: Iterable[Decider], *given: Any) -> Any:
    """Return the first finding that decides; else the first that gives a reason for not deciding;
    else None.
    """
    left_open = None
    for row in rows:
        finding = row.finding(*given)
        if finding is not None and finding.is_known:
            return finding
        left_open = finding if left_open is None else left_open
    return left_open


def found_at_once(rows: Iterable[Decider], *given: Any) -> Any:
    """Return the first finding, whether it decides or not; None if no row has one."""
    findings = (row.finding(*given) for row in rows)
    return next((finding for finding in findings if finding is not None), None)


def row_of(evidence: object, rows: Iterable[Decider]) -> Decider | None:
    """Return the first row that yields such evidence, None if none does."""
    return next((row for row in rows if row.has_evidence(evidence)), None)


def check(evidence: object, rows: Iterable[Decider], *given: Any) -> bool:
    """Return True if evidence of one of these rows holds for both models, found again from scratch.

    Evidence that no row yields speaks of other models, and does not hold. Raises NotSeenError where
    the check takes too long.
    """
    row = row_of(evidence, rows)
    return row is not None and bool(row.check) and function(row.check)(evidence, *given)


def recheck(evidence: object, rows: Iterable[Decider], *given: Any) -> Any:
    """Return the finding that the settings make with evidence of this kind, None if no row yields
    it: evidence that is true can have been chosen, and then bounds nothing.
    """
    row = row_of(evidence, rows)
    return None if row is None else row.finding_again(evidence, *given)
