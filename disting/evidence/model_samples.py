"""Two models looked at anew, at fresh points: what evidence is checked on."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from itertools import chain
from typing import Any

from disting.behaviour.sample import Representation, Sample, samples
from disting.evidence.kind import Labels
from disting.model.protocol import Model

POINTS = 3

MOST_MARKOV = 1000  # of a file that somebody else wrote: each costs a row


@dataclass(frozen=True, slots=True)
class ModelSamples:
    """What one model reveals: `draw` gives samples of so many Markov parameters after G_0;
    `degrees` of numerator and denominator, of several transfer functions one pair after the other.
    """

    parameters: Labels
    degrees: tuple[int, ...]
    draw: Callable[[Representation, int], tuple[Sample, ...]]

    def rank(self, representation: str, rows: Labels = ()) -> int:
        """Rank of the named rows, or of all: the largest that is seen."""
        seen = self._samples(representation, rows)
        at = tuple(i for i, label in enumerate(seen[0].labels) if not rows or label in rows)
        return max(s.rank(at) for s in seen)

    def labels(self, representation: str, rows: Labels = ()) -> set[str]:
        """All invariants, with as many Markov parameters as these rows need."""
        return set(self._samples(representation, rows)[0].labels)

    def free(self, representation: str, rows: Labels) -> set[str]:
        """Those of them that vary."""
        first, *more = self._samples(representation, rows)
        labels = enumerate(first.labels)
        return {label for i, label in labels if any(any(s.rows[i]) for s in (first, *more))}

    def _samples(self, representation: str, rows: Labels) -> tuple[Sample, ...]:
        return self.draw(Representation(representation), markov_count(rows))


@dataclass(frozen=True, slots=True)
class SampledPair:
    """Both models: whether a renaming `renames` the left one to the right one, and evidence is
    `found_again` by the method that finds such. Of chains and networks also the `numberings` of
    the nodes of a part, which the left one is or the right one, in the whole; of chains the model
    with the elements of both, and the renaming that symmetries give, with their names.
    """

    left: ModelSamples
    right: ModelSamples
    renames: Callable[[dict[str, str]], bool]
    found_again: Callable[[Any], bool]
    numberings: Callable[[bool], Iterable[dict[int, int]]] = lambda left_is_part: ()
    united: Callable[[], ModelSamples | None] = lambda: None
    by_symmetry: Callable[[], tuple[dict[str, str], Labels] | None] = lambda: None

    @property
    def sides(self) -> tuple[ModelSamples, ModelSamples]:
        """Left and right."""
        return self.left, self.right


def samples_of(model: Model, seed: str = "verify") -> ModelSamples:
    """A model at fresh points, the same for all questions."""

    @cache
    def draw(representation: Representation, count: int) -> tuple[Sample, ...]:
        """Samples in this representation."""
        return tuple(samples(model, representation, count, POINTS, seed))

    return ModelSamples(model.parameters, tuple(chain.from_iterable(model.degrees)), draw)


def markov_count(labels: Labels) -> int:
    """Markov parameters needed to have all these labels, such as G3 or G3[2]; raises ValueError for
    more than are looked at.
    """
    matches = (re.fullmatch(r"G(\d{1,9})(?:\[\d+\])?", label) for label in labels)
    most = max((int(x[1]) for x in matches if x), default=0)
    if most > MOST_MARKOV:
        raise ValueError(f"G{most} is beyond the first {MOST_MARKOV} Markov parameters")
    return most
