"""Sets of dampers to the ground of one model, all against each other (Fig. 14 of the paper).

The paper compares one at a time: no damper, then one at mass 1, 2, .., N. `DamperSets.ALL` takes
all 2^N sets. Where two sets are indistinguishable over positive parameters, no experiment with
this force and sensor can tell where the friction is.
"""

import csv
import io
from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import combinations

from disting.catalogs.export import premise_text
from disting.errors import InputError
from disting.model.chain import Chain
from disting.model.presentation import plural, summary
from disting.model.question import Domain
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.forest import classes_of
from disting.verdict.query import Query, View
from disting.verdict.result import Relation, Verdict

Masses = tuple[int, ...]
COLUMNS = ("left", "right", "relation", "decided_by", "domain", "damped", "quantity")


class DamperSets(StrEnum):
    """Which sets of ground dampers: none or a single one, as in Fig. 14, or all 2^N."""

    SINGLE = "single"
    ALL = "all"

    def of(self, n_masses: int) -> tuple[Masses, ...]:
        """The sets in the order of size, then of masses.

        >>> [spell(masses) for masses in DamperSets.ALL.of(2)]
        ['0', '1', '2', '1+2']
        """
        most = n_masses if self is DamperSets.ALL else 1
        return tuple(
            chosen
            for size in range(most + 1)
            for chosen in combinations(range(1, n_masses + 1), size)
        )


def spell(masses: Masses) -> str:
    """A set as text: 0 for no damper, else the masses such as 1+3.

    >>> spell(()), spell((1, 3))
    ('0', '1+3')
    """
    return "+".join(map(str, masses)) or "0"


@dataclass(frozen=True)
class DamperTable:
    """All pairs of `sets` of ground dampers of one `chain`; the subjects of `decided` are in
    their order.
    """

    chain: Chain
    sets: tuple[Masses, ...]
    decided: Decisions

    def __repr__(self) -> str:
        return summary(self, f"{self.chain}, {plural(len(self.sets), 'set')} of ground dampers")

    @property
    def domain(self) -> Domain:
        """Which parameters the verdicts are about."""
        return self.decided.query.view.domain

    def relation(self, left: Masses, right: Masses) -> Relation:
        """Relation of two different sets; raises InputError for a set that is not in the table."""
        return self.decided.relation(*self._places(left, right))

    def verdict(self, left: Masses, right: Masses) -> Verdict:
        """The verdict with its evidence, the sets in the table's order."""
        return self.decided.verdict(*self._places(left, right))

    def rows(self) -> Iterator[tuple[Masses, Masses, Relation, str]]:
        """Yield (left, right, relation, deciding rule) of all pairs, left before right."""
        for i, j in combinations(range(len(self.sets)), 2):
            yield self.sets[i], self.sets[j], self.decided.relation(i, j), self.decided.rule(i, j)

    def classes(self) -> tuple[tuple[Masses, ...], ...]:
        """The sets grouped by indistinguishability, in the order of their first members; an
        undecided pair joins no groups.
        """
        classes = classes_of([spell(s) for s in self.sets], self.decided.relation)
        return tuple(tuple(self.sets[i] for i in members) for members in classes)

    def to_csv(self) -> str:
        """All pairs as CSV text: left, right, relation, decided_by ("" if undecided), domain,
        and the premise of the chain.
        """
        premise = premise_text(self.chain.premise, self.chain.premise)
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(COLUMNS)
        rows = self.rows()
        writer.writerows(
            (spell(a), spell(b), relation.value, rule, self.domain.value, *premise)
            for a, b, relation, rule in rows
        )
        return out.getvalue()

    def _places(self, left: Masses, right: Masses) -> tuple[int, int]:
        if left == right or not {left, right} <= set(self.sets):
            raise InputError(
                f"the table holds pairs of two different sets of ground dampers, not {left} and"
                f" {right}"
            )
        return self.sets.index(left), self.sets.index(right)


def dampers(
    chain: Chain,
    which: DamperSets = DamperSets.SINGLE,
    *,
    domain: Domain = Domain.POSITIVE,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> DamperTable:
    """The table of a chain over a domain of parameters; ground dampers that it has already are
    replaced by each set in turn.

    Over positive parameters sets are undecided where they are indistinguishable over complex ones
    and no theorem says more.

    >>> from disting.model.family import Family
    >>> dampers(Family(3, damped=True)[3], domain=Domain.COMPLEX).classes()
    (((),), ((1,), (2,), (3,)))
    """
    engine = engine or Engine()
    sets = which.of(chain.n_masses)
    subjects = [engine.subject(spell(s), replace(chain, ground_dampers=s)) for s in sets]
    view = View.EXACT if domain is Domain.COMPLEX else View(domain.value)
    decided = engine.decisions(
        subjects, Query(view, inclusion=False), executor=executor, progress=progress
    )
    return DamperTable(chain, sets, decided)
