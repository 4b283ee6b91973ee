"""A verdict as a file of its own: the models wholly, what was asked, with which settings, and all
evidence, so that `verification.verify` needs nothing else.

A verdict over real or positive parameters may rest on equality over complex ones, or tell it: then
that verdict stands beside it, with evidence of its own.
"""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from disting.errors import InputError
from disting.files import __version__
from disting.model.chain import Chain, Sensor
from disting.model.domain import Domain
from disting.model.names import chains_named, name_of
from disting.model.settings import Settings
from disting.questions.inclusion import Inclusion
from disting.verdict.comparison import compare, names_of
from disting.verdict.engine import Engine
from disting.verdict.query import Query, View
from disting.verdict.result import Relation, Verdict

FORMAT = "disting verdict 1"
PLAIN = ("left", "right", "relation")  # by which a verdict without its models is known


@dataclass(frozen=True, slots=True)
class Stored:
    """What a file says: two chains, what was asked with which settings, the verdict, and that over
    complex parameters where it is told apart.
    """

    chains: tuple[Chain, Chain]
    query: Query
    settings: Settings
    verdict: Verdict
    over_complex: Verdict | None


def verdict_file(
    left: Chain | str,
    right: Chain | str,
    *,
    damped: bool | None = None,
    sensor: Sensor | str | None = None,
    query: Query | None = None,
    engine: Engine | None = None,
) -> dict[str, Any]:
    """The verdict on two chains as plain data, ready for JSON, which `verify` checks alone; the
    arguments are those of `compare`.

    >>> data = verdict_file("3:1", "A4", damped=True)
    >>> data["left"], data["models"][1]["name"], data["relation"], data["settings"]["seed"]
    ('3:1', '3:4', 'distinguishable', 'disting')
    """
    chains = chains_named([left, right], damped=damped, sensor=sensor)
    engine, query = engine or Engine(), query or Query()
    verdict = compare(*chains, query=query, engine=engine)
    beside = compare(*chains, query=exact(query), engine=engine) if has_more(verdict) else None
    return as_file(chains, query, engine.settings, verdict, beside)


def as_file(
    chains: Sequence[Chain],
    query: Query,
    settings: Settings,
    verdict: Verdict,
    over_complex: Verdict | None,
) -> dict[str, Any]:
    """The file of a verdict that is there."""
    asked = asdict(query) | {"view": query.view.value, "conditions": list(query.conditions)}
    return {
        "format": FORMAT,
        "program": __version__,
        "models": [{"name": name_of(chain), **asdict(chain)} for chain in chains],
        "query": asked,
        "settings": settings.to_dict(),
        **verdict.to_dict(),
        "over_complex": {} if over_complex is None else over_complex.to_dict(),
    }


def has_more(verdict: Verdict) -> bool:
    """Whether equality over complex parameters belongs to what a verdict over others says."""
    told = verdict.closure is Inclusion.EQUAL or verdict.relation is not Relation.DISTINGUISHABLE
    return verdict.domain is not Domain.COMPLEX and told


def exact(query: Query) -> Query:
    """The same over complex parameters."""
    return Query(View.EXACT, query.conditions, query.markov, query.inclusion)


def read_file(data: object) -> Stored:
    """Inverse of `verdict_file`. Raises InputError for what is no such file, ValueError, KeyError,
    TypeError or AttributeError for one that is damaged.
    """
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        known = isinstance(data, dict) and (set(PLAIN) <= data.keys() or "verdicts" in data)
        what = "holds a verdict without its models" if known else "is no file of a verdict"
        raise InputError(f"it {what}; 'disting compare N:I M:J --json' writes one")
    a, b = (_chain(model) for model in data["models"])
    asked = data["query"]
    query = Query(
        View(asked["view"]), tuple(asked["conditions"]), asked["markov"], asked["inclusion"]
    )
    beside = data["over_complex"]
    return Stored(
        chains=(a, b),
        query=query,
        settings=Settings(**data["settings"]),
        verdict=Verdict.from_dict(data),
        over_complex=Verdict.from_dict(beside) if beside else None,
    )


def differing(data: dict[str, Any], stored: Stored) -> str:
    """What a file tells otherwise than what it tells follows from, such as its sentence; "" if
    nothing.
    """
    again = as_file(
        stored.chains, stored.query, stored.settings, stored.verdict, stored.over_complex
    )
    found = [name for name in again if name != "program" and not _same(data[name], again[name])]
    names = names_of(*stored.chains)
    told = [v for v in (stored.verdict, stored.over_complex) if v is not None]
    wrong = [name for v in told for name in (v.left, v.right) if name not in names]
    if wrong or any((v.left, v.right) != names for v in told):
        found.append("names")
    return ", ".join(found)


def _chain(model: dict[str, Any]) -> Chain:
    rest = {name: value for name, value in model.items() if name != "name"}
    return Chain(**rest | {"ground_dampers": tuple(rest["ground_dampers"])})


def _same(given: object, again: object) -> bool:
    """Whether both are the same plain data: tuples are lists, names of enumerations texts."""
    if isinstance(again, dict):
        return (
            isinstance(given, dict)
            and given.keys() == again.keys()
            and all(_same(given[name], value) for name, value in again.items())
        )
    if isinstance(again, list | tuple):
        return (
            isinstance(given, list | tuple)
            and len(given) == len(again)
            and all(map(_same, given, again))
        )
    return given == again and isinstance(given, bool) == isinstance(again, bool)
