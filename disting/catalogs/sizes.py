"""Families of several sizes in one matrix: models named N:I.

Models of different sizes differ in their degrees (conditions 1 and 2); but the smaller model may
lie inside the larger one, as a limit (see `questions.inclusion.across_sizes`).
"""

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from typing import Any

from disting.catalogs.catalog import Catalog
from disting.catalogs.files import INCLUSIONS, LEFT_POSITIVE, RIGHT_POSITIVE
from disting.conditions.inclusion import inclusions_from_dict
from disting.errors import InputError
from disting.evidence.positive import PositiveFinding
from disting.model.chain import Chain, Sensor
from disting.model.family import Family
from disting.model.question import Models, Question
from disting.model.symmetry import canonical
from disting.questions.inclusion.decide import CLOSURE, IMAGE, turn
from disting.questions.same.real_and_positive import POSITIVELY
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.query import Query


def combined_family(
    sizes: Sequence[int], *, damped: bool = True, sensor: Sensor = Sensor.ACCELERATION
) -> tuple[tuple[str, Chain], ...]:
    """All models of several sizes with their names, in the order of sizes and numbers; raises
    InputError for none.

    >>> [name for name, _ in combined_family((1, 2), damped=False)]
    ['1:1', '2:1', '2:2', '2:3']
    """
    if not sizes:
        raise InputError("a combined family needs at least one size")
    families = (Family(n, damped, sensor) for n in sorted(set(sizes)))
    return tuple(
        (f"{f.n_masses}:{number}", chain) for f in families for number, chain in enumerate(f, 1)
    )


def combine(
    sizes: Sequence[int],
    *,
    damped: bool = True,
    sensor: Sensor = Sensor.ACCELERATION,
    query: Query | None = None,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> Decisions:
    """The verdicts on all pairs, with the inclusion of smaller models in larger ones; the subjects
    are named N:I.

    Of the 482 pairs of different size of 1 to 4 masses, the smaller model lies in the larger one
    in 417 without dampers and in 441 with dampers; in the others it does not.

    >>> found = combine((1, 2), damped=False)
    >>> found.subjects[2].name, found.relation(0, 2).value, found.verdict(0, 2).closure.value
    ('2:2', 'distinguishable', 'left-in-right')
    """
    engine = engine or Engine()
    subjects = [
        engine.subject(*named) for named in combined_family(sizes, damped=damped, sensor=sensor)
    ]
    return engine.decisions(subjects, query or Query(), executor=executor, progress=progress)


def answers_in(catalog: Catalog) -> Iterator[tuple[Question[Any], Models, Any]]:
    """Yield what a catalogue answers about pairs of its models: which are limits or equivalents
    of others, and which positive ones have positive equivalents.

    The question, the canonical forms in its order, and the answer, as an engine remembers it.

    >>> from disting.catalogs import catalog
    >>> from collections import Counter
    >>> sorted(Counter(question.name for question, *_ in answers_in(catalog(2))).items())
    [('closures', 2), ('images', 2), ('positive equivalents', 4)]
    """
    n = len(catalog.family)
    forms = [canonical(chain).chain for chain in catalog.family]
    ranks = [catalog.record(number)["rank"] for number in range(1, 1 + n)]
    for record in catalog.records[1 + n :]:
        i, j = record["left"] - 1, record["right"] - 1
        for name, value, other in ((LEFT_POSITIVE, i, j), (RIGHT_POSITIVE, j, i)):
            if name in record:
                finding = PositiveFinding.from_dict(record[name])
                yield POSITIVELY, (forms[value], forms[other]), finding
        if INCLUSIONS in record:
            both = inclusions_from_dict(record[INCLUSIONS])
            small, large = (i, j) if ranks[i] < ranks[j] else (j, i)
            for question, said in ((IMAGE, both.image), (CLOSURE, both.closure)):
                yield question, (forms[small], forms[large]), said if small == i else turn(said)
