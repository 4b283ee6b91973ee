"""What pages need of many models that were compared in pairs: the Protocol that a catalogue and a
list of general models implement. Models are counted from 1.
"""

from collections.abc import Iterator, Sized
from typing import Protocol

from disting.verdict import Relation, Verdict, View


class Decided(Protocol):
    """Models and the verdicts on their pairs, in some views."""

    @property
    def family(self) -> Sized:
        """The models."""

    def relation(self, left: int, right: int, view: View) -> Relation:
        """Relation of two models."""

    def verdict(self, left: int, right: int, view: View) -> Verdict:
        """The verdict with its evidence."""

    def pairs(self, view: View) -> Iterator[tuple[int, int, Verdict]]:
        """All pairs, left < right."""

    def classes(self, view: View) -> tuple[tuple[int, ...], ...]:
        """Groups of two or more mutually indistinguishable models."""

    def depending(self, view: View) -> tuple[tuple[int, int], ...]:
        """The pairs that are indistinguishable for some parameters only."""
