"""Verdicts on two machines under further experiments, chains or networks, where the correspondence
of masses is unknown: every correspondence is decided. A file of it holds a verdict for every way,
each a whole file of its own.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from disting.errors import DistingError, InputError, of_type, short
from disting.experiments import Experiment, PlacedExperiment, Places, move, parse_experiment, ways
from disting.experiments.measured_network import structure_of
from disting.files import Format, __version__
from disting.general import AnyModel
from disting.model.chain import Chain, Quantity
from disting.model.presentation import plural, summary
from disting.model.question import Domain
from disting.renamed import renamed
from disting.verdict.comparison import asked_of, compare
from disting.verdict.engine import Engine
from disting.verdict.result import Conditions, Query, Relation, Verdict
from disting.verdict.sides import Given, both_places, models_of_names
from disting.verdict.verdict_file import (
    DAMAGED,
    MOST_EXPERIMENTS,
    VERSION,
    StoredVerdict,
    plain_experiment,
    read_experiment,
    read_file,
    same_plain,
    verdict_file,
)

Pairs = tuple[tuple[Experiment, Experiment], ...]
"""All experiments, on the left and on the right model."""


class Answer(StrEnum):
    """Answer for all placements: the experiments distinguish the models for all, for none, or for
    some of them; UNKNOWN where an undecided one could make a difference.
    """

    SURELY = "surely"
    NEVER = "never"
    DEPENDS = "depends on the places"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class AllPlacements:
    """The verdict of every way to place the experiments, the models as they are included."""

    verdicts: tuple[tuple[Places, Verdict], ...]

    def __repr__(self) -> str:
        return summary(
            self, f"{self.answer}, {plural(len(self.verdicts), 'way')} to place the experiments"
        )

    @property
    def answer(self) -> Answer:
        """Combined answer of all placements."""
        relations = {verdict.relation for _, verdict in self.verdicts}
        if relations == {Relation.DISTINGUISHABLE}:
            return Answer.SURELY
        if Relation.DISTINGUISHABLE in relations and len(relations - {Relation.UNDECIDED}) > 1:
            return Answer.DEPENDS
        return Answer.UNKNOWN if Relation.UNDECIDED in relations else Answer.NEVER


@renamed(sensor="quantity")
def compare_everywhere(
    left: Given,
    right: Given,
    also: Sequence[str | Experiment],
    *,
    damped: bool | None = None,
    quantity: Quantity | str | None = None,
    places: Places = (),
    domain: Domain | str | None = None,
    conditions: Conditions | None = None,
    query: Query | None = None,
    engine: Engine | None = None,
) -> AllPlacements:
    """Verdicts on two machines, chains or networks, as they are and under the experiments `also`,
    for every way to place those on the right. Other arguments are those of `compare`.

    Experiments name masses of the left model, as `Experiment` or as text such as "sensor=3/2,
    lock=1", where 3/2 is mass 3 of the left model and 2 of the right one; `places` names more such
    pairs. Masses of the right model that are not named are tried, each in every place that is
    left over. Models are named as for `compare`. Raises InputError.

    >>> from disting import Family
    >>> a = Family(3, damped=True)
    >>> compare_everywhere(a[1], a[11], ["sensor=2"]).answer.value
    'surely'
    >>> compare_everywhere("1~2,2~3; F1; S1", "1~2,1~3; F1; S1", ["lock=2"]).answer.value
    'surely'
    """
    a, b = models_of_names(left, right, damped, quantity)
    query, engine = asked_of(query, engine, domain, conditions)
    verdicts = []
    for way, pairs in placements(a, b, named_all(also), places):
        verdict = compare(a, b, experiments=pairs, query=query, engine=engine)
        verdicts.append((way, verdict))
    return AllPlacements(tuple(verdicts))


def named_all(also: Sequence[str | Experiment]) -> tuple[PlacedExperiment, ...]:
    """Experiments that are given as text or as such; raises InputError."""
    of_type(also, Iterable, "experiments are a list of texts or of Experiment")
    return tuple(parse_experiment(e) if isinstance(e, str) else PlacedExperiment(e) for e in also)


def placements(
    left: Chain | AnyModel,
    right: Chain | AnyModel,
    asked: Sequence[PlacedExperiment],
    places: Places = (),
) -> Iterator[tuple[Places, Pairs]]:
    """Yield every way to place experiments on the right model, with all that is measured then, the
    models as they are first; raises InputError.
    """
    for way in ways(structure_of(left), structure_of(right), asked, places):
        further = [(pair.experiment, move(pair.experiment, way)) for pair in asked]
        yield way, both_places([Experiment(), *further])


FORMAT = Format.EVERYWHERE.value
COMMON = ("models", "query", "settings")


@renamed(sensor="quantity")
def everywhere_file(
    left: Given,
    right: Given,
    also: Sequence[str | Experiment],
    *,
    damped: bool | None = None,
    quantity: Quantity | str | None = None,
    domain: Domain | str | None = None,
    conditions: Conditions | None = None,
    query: Query | None = None,
    engine: Engine | None = None,
) -> dict[str, object]:
    """The verdicts of `compare_everywhere` as plain data, ready for JSON, which `verify` checks
    alone; the arguments are those of `compare_everywhere`. Raises InputError as that does.

    >>> data = everywhere_file("3:1", "3:11", ["sensor=2"], damped=True)
    >>> data["answer"], [one["places"] for one in data["verdicts"]]
    ('surely', [{'2': 1}, {'2': 2}, {'2': 3}])
    """
    a, b = models_of_names(left, right, damped, quantity)
    experiments, (query, engine) = named_all(also), asked_of(query, engine, domain, conditions)
    files = [
        {"places": {str(left_place): right_place for left_place, right_place in way}}
        | verdict_file(a, b, experiments=pairs, query=query, engine=engine)
        for way, pairs in placements(a, b, experiments)
    ]
    return _whole(experiments, files)


def read_everywhere(data: Mapping[str, Any]) -> tuple[StoredVerdict, ...]:
    """All verdicts of such a file; raises InputError for what is damaged."""
    try:
        return tuple(read_file(plain, ("places",)) for plain in data["verdicts"])
    except DAMAGED as reason:
        raise InputError(f"the file of the verdicts is damaged ({reason})") from None


def difference_everywhere(data: Mapping[str, Any], stored: Sequence[StoredVerdict]) -> str:
    """First statement of such a file that does not follow from its evidence; "" if there is none.

    All verdicts are on the same models, with the same query, and there is one for every way to
    place the experiments.
    """
    try:
        experiments = [_read_experiment(each) for each in data["also"][: MOST_EXPERIMENTS + 1]]
        a, b = stored[0].models
        if len(experiments) > MOST_EXPERIMENTS:
            return "also"
        ways = list(placements(a, b, experiments))
    except (*DAMAGED, DistingError) as reason:
        return f"the experiments: {reason}"
    files = data["verdicts"]
    for name in COMMON:
        if any(not same_plain(each[name], files[0][name]) for each in files):
            return name
    if [each.experiments for each in stored] != [pairs for _, pairs in ways]:
        return "the ways to place the experiments"
    places = [{str(left_place): right_place for left_place, right_place in way} for way, _ in ways]
    if [each["places"] for each in files] != places:
        return "places"
    again = _whole(experiments, files)
    if not VERSION.fullmatch(str(data.get("program"))):
        return "program"
    unknown = [name for name in data if name not in again]
    if unknown:
        return f"{short(unknown[0])} is not a key of it"
    kept = [name for name in again if name not in ("program", "verdicts")]
    return next((name for name in kept if not same_plain(data.get(name), again[name])), "")


def _whole(asked: Sequence[PlacedExperiment], files: Sequence[dict[str, Any]]) -> dict[str, Any]:
    whole = AllPlacements(tuple(((), read_file(each, ("places",)).verdict) for each in files))
    return {
        "format": FORMAT,
        "program": __version__,
        "answer": whole.answer.value,
        "experiments": ["as it is", *dict.fromkeys(each.experiment.text for each in asked)],
        "also": [
            {
                "experiment": plain_experiment(each.experiment),
                "places": list(map(list, each.places)),
            }
            for each in asked
        ],
        "verdicts": list(files),
    }


def _read_experiment(data: Mapping[str, Any]) -> PlacedExperiment:
    places = tuple(
        (int(left_place), int(right_place)) for left_place, right_place in data["places"]
    )
    return PlacedExperiment(read_experiment(data["experiment"]), places)
