"""Whether further experiments tell two chains apart, where it is not known which mass of the one is
which of the other: every way to place them is asked.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum

from disting.errors import InputError, of_type
from disting.experiments import Experiment, Named, Places, moved, named, ways
from disting.general import MatrixModel, Model
from disting.model.chain import Chain, Sensor
from disting.model.names import chains_named
from disting.model.shown import plural, summary
from disting.verdict.comparison import NOT_CHAINS, both_places, compare
from disting.verdict.engine import Engine
from disting.verdict.query import Query
from disting.verdict.result import Relation, Verdict

Pairs = tuple[tuple[Experiment, Experiment], ...]
"""All experiments, on the left and on the right chain."""


class Answer(StrEnum):
    """Whether the experiments tell the models apart: wherever the places are, nowhere, or
    depending on them; UNKNOWN where what is undecided could make a difference.
    """

    SURELY = "surely"
    NEVER = "never"
    DEPENDS = "depends on the places"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Everywhere:
    """The verdict of every way to place the experiments, the chains as they are included."""

    verdicts: tuple[tuple[Places, Verdict], ...]

    def __repr__(self) -> str:
        return summary(
            self, f"{self.answer}, {plural(len(self.verdicts), 'way')} to place the experiments"
        )

    @property
    def answer(self) -> Answer:
        """Whether they tell the models apart."""
        found = {verdict.relation for _, verdict in self.verdicts}
        if found == {Relation.DISTINGUISHABLE}:
            return Answer.SURELY
        if Relation.DISTINGUISHABLE in found and len(found - {Relation.UNDECIDED}) > 1:
            return Answer.DEPENDS
        return Answer.UNKNOWN if Relation.UNDECIDED in found else Answer.NEVER


def compare_everywhere(
    left: Chain | str,
    right: Chain | str,
    also: Sequence[str | Experiment],
    *,
    damped: bool | None = None,
    sensor: Sensor | str | None = None,
    places: Places = (),
    query: Query | None = None,
    engine: Engine | None = None,
) -> Everywhere:
    """Verdicts on two chains as they are and under the experiments `also`, for every way to place
    those on the right.

    Experiments name masses of the left chain, as `Experiment` or as text such as "sensor=3/2,
    lock=1", where 3/2 is mass 3 of the left chain and 2 of the right one; `places` names more such
    pairs. Masses of the right chain that are not named are tried, each in every place that is
    left over. Chains are named as for `compare`. Raises InputError.

    >>> from disting import Family
    >>> a = Family(3, damped=True)
    >>> compare_everywhere(a[1], a[11], ["sensor=2"]).answer.value
    'surely'
    """
    if isinstance(left, Model | MatrixModel) or isinstance(right, Model | MatrixModel):
        raise InputError(NOT_CHAINS)
    left, right = chains_named([left, right], damped=damped, sensor=sensor)
    engine = engine or Engine()
    found = []
    for way, pairs in placements(left, right, named_all(also), places):
        verdict = compare(left, right, experiments=pairs, query=query, engine=engine)
        found.append((way, verdict))
    return Everywhere(tuple(found))


def named_all(also: Sequence[str | Experiment]) -> tuple[Named, ...]:
    """Experiments that are given as text or as such; raises InputError."""
    of_type(also, Iterable, "experiments are a list of texts or of Experiment")
    return tuple(named(e) if isinstance(e, str) else Named(e) for e in also)


def placements(
    left: Chain, right: Chain, asked: Sequence[Named], known: Places = ()
) -> Iterator[tuple[Places, Pairs]]:
    """Yield every way to place experiments on the right chain, with all that is measured then, the
    chains as they are first; raises InputError.
    """
    for way in ways(left, right, asked, known):
        further = [(one.experiment, moved(one.experiment, way)) for one in asked]
        yield way, both_places([Experiment(), *further])
