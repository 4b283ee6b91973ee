"""A whole family with every set of ground dampers: 88, 464, 2336 models of 3, 4, 5 masses, all
against all by classes.
"""

from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from disting.catalogs.damper_settled import read_settled
from disting.catalogs.dampers import DamperSets, Masses
from disting.catalogs.export import premise_text
from disting.errors import InputError
from disting.model.family import Family
from disting.model.presentation import plural, summary
from disting.model.symmetry import canonical
from disting.questions.same.low_cost import PATIENTLY
from disting.verdict.classes import Classes
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.grouping import classes
from disting.verdict.result import Relation

# masses: there shares and ideals are asked where the synthesis is silent; for 5 they take up to
# hours, and `disting catalog settle` asks them once
PATIENT_UP_TO = 4
Name = tuple[int, Masses]
"""A model: its number in the family and the masses with a damper to the ground."""


@dataclass(frozen=True)
class DamperFamily:
    """All pairs of a family's models with `sets` of ground dampers; no pair is stored."""

    family: Family
    sets: tuple[Masses, ...]
    found: Classes

    def __repr__(self) -> str:
        return summary(self, f"{self.family!r}, {plural(len(self), 'model')}")

    def __len__(self) -> int:
        return len(self.found)

    def look_up(self, left: Name, right: Name) -> tuple[Relation, str]:
        """Relation and deciding rule ("" if undecided) of two models, in microseconds; raises
        InputError.
        """
        return self.found.look_up(self.place(left), self.place(right))

    def place(self, name: Name) -> int:
        """Place of a model, counted from 0; raises InputError for one that is not there."""
        number, masses = name
        if not 1 <= number <= len(self.family) or masses not in self._order:
            raise InputError(
                f"the family has models 1 to {len(self.family)} with sets of {self.family.n_masses}"
                f" masses, not {name}"
            )
        return (number - 1) * len(self.sets) + self._order[masses]

    def name(self, place: int) -> Name:
        """The model at a place."""
        return place // len(self.sets) + 1, self.sets[place % len(self.sets)]

    def classes(self) -> tuple[tuple[Name, ...], ...]:
        """Classes of two or more indistinguishable models."""
        return tuple(tuple(map(self.name, members)) for members in self.found.classes())

    def csv_lines(self) -> Iterator[str]:
        """Yield left, right, relation, decided_by, domain, damped, quantity of all pairs, models
        written 3:4+b1+b3, a line at a time.

        The domain is complex: over positive parameters, families are not asked.
        """
        yield "left,right,relation,decided_by,domain,damped,quantity\n"
        premise = ",".join(premise_text(*[self.family[1].premise] * 2))
        names = [self.text(i) for i in range(len(self))]
        for i, j, relation, rule in self.found.pairs():
            yield f"{names[i]},{names[j]},{relation.value},{rule},complex,{premise}\n"

    def text(self, place: int) -> str:
        """A model as `compare` names it."""
        number, masses = self.name(place)
        return "+".join([f"{self.family.n_masses}:{number}", *(f"b{m}" for m in masses)])

    def pair_text(self, left: int, right: int) -> str:
        """Two models in a sentence, with what their names leave out."""
        kind = "damped" if self.family.damped else "undamped"
        return f"{self.text(left)} and {self.text(right)}, {kind}"

    @cached_property
    def _order(self) -> dict[Masses, int]:
        return {masses: k for k, masses in enumerate(self.sets)}


def damper_family(
    n_masses: int,
    *,
    damped: bool = True,
    which: DamperSets = DamperSets.ALL,
    folder: Path | None = None,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> DamperFamily:
    """The classes of a family with sets of ground dampers; what is finished is in the engine's
    store, so that a run resumes.

    What was settled once is taken over: it is shipped, and may be in a `folder` of one's own.

    >>> found = damper_family(2, damped=True)
    >>> len(found), found.look_up((2, (1,)), (2, (2,)))[0].value
    (12, 'indistinguishable')
    """
    family, sets = Family(n_masses, damped), which.of(n_masses)
    chains = [replace(chain, ground_dampers=masses) for chain in family for masses in sets]
    found = classes(
        chains,
        engine or Engine(),
        settled=read_settled((canonical(chain).chain for chain in chains), folder),
        more=[PATIENTLY] if n_masses <= PATIENT_UP_TO else [],
        executor=executor,
        progress=progress,
    )
    return DamperFamily(family, sets, found)
