"""A verdict as a file of its own: the models and the experiments wholly, the question, the
settings, and all evidence, so that `verification.verify` needs nothing else.

A verdict over real or positive parameters may rest on equality over complex ones, or report it:
then that verdict is stored with it, with evidence of its own. What somebody else wrote is read
without trust: the type of every field is checked, and requests for too much work are refused.
"""

import json
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from fractions import Fraction
from typing import Any

from disting.conditions.inclusion import Inclusion, Inclusions
from disting.errors import DistingError, InputError, short
from disting.evidence.kind import is_well_typed
from disting.experiments.experiment import Experiment
from disting.files import Format, __version__
from disting.general import AnyModel, Model, as_chain
from disting.general.model_entries import as_entry, read_entry
from disting.general.naming import LARGEST_CHAIN, refuse_misnamed_models
from disting.model.chain import Chain, Quantity
from disting.model.family import MOST_MASSES
from disting.model.kinds import CHANGES
from disting.model.names import name_of
from disting.model.question import Domain, Settings
from disting.network.denotation import MisnamedError, naming_of, refuse_misnamed
from disting.renamed import renamed
from disting.verdict.comparison import asked_of, compare
from disting.verdict.engine import Engine
from disting.verdict.older_files import OLDER, in_older_words, without_primes
from disting.verdict.result import Conditions, Query, Relation, Verdict, View
from disting.verdict.sides import Given, Sides, both_places, models_of_names, sides_of

FORMAT = Format.VERDICT.value
PLAIN = ("left", "right", "relation")  # by which a verdict without its models is known
MOST_POINTS, MOST_SUBSETS, MOST_MARKOV, LONGEST_SEED = 100, 10**9, 1000, 1000
MOST_EXPERIMENTS = 50
VERSION = re.compile(r"\d{1,4}(\.\d{1,4}){1,3}[a-z0-9.+]{0,12}")  # of the program that wrote it
DAMAGED = (KeyError, TypeError, ValueError, AttributeError, LookupError, ArithmeticError)
Places = Sequence[Experiment | tuple[Experiment, Experiment]]


@dataclass(frozen=True, slots=True)
class StoredVerdict:
    """Content of a file: two models, the experiments on the left and on the right one (none: as
    given), the query and settings, the verdict, and that over complex parameters where it is
    separate.
    """

    models: tuple[Chain | AnyModel, Chain | AnyModel]
    experiments: tuple[tuple[Experiment, Experiment], ...]
    query: Query
    settings: Settings
    verdict: Verdict
    over_complex: Verdict | None

    def sides(self, engine: Engine) -> Sides:
        """Two compared sides of the file."""
        return sides_of(*self.models, self.experiments, engine)


@renamed(sensor="quantity")
def verdict_file(
    left: Given,
    right: Given,
    *,
    damped: bool | None = None,
    quantity: Quantity | str | None = None,
    experiments: Places = (),
    domain: Domain | str | None = None,
    conditions: Conditions | None = None,
    prove: bool = False,
    query: Query | None = None,
    engine: Engine | None = None,
) -> dict[str, object]:
    """The verdict on two models as plain data, ready for JSON, which `verify` checks alone; the
    arguments are those of `compare`. Raises InputError as that does, and for a name that denotes
    another model.

    >>> data = verdict_file("3:1", "A4", damped=True)
    >>> data["left"], data["models"][1]["name"], data["relation"], data["settings"]["seed"]
    ('3:1', '3:4', 'distinguishable', 'disting')
    """
    models = models_of_names(left, right, damped, quantity)
    refuse_misnamed_models(model for model in models if not isinstance(model, Chain))
    (query, engine), both = asked_of(query, engine, domain, conditions), both_places(experiments)
    verdict = compare(*models, experiments=both, prove=prove, query=query, engine=engine)
    beside = (
        compare(*models, experiments=both, prove=prove, query=exact(query), engine=engine)
        if has_more(verdict)
        else None
    )
    return as_file(StoredVerdict(models, both, query, engine.settings, verdict, beside))


def as_file(stored: StoredVerdict) -> dict[str, Any]:
    """The file of a verdict that is there: lists, texts, numbers, as they are read again.

    Words that no check compares are omitted: what was abandoned, and why something is not known.
    """
    query, beside = stored.query, stored.over_complex
    question = asdict(query) | {"view": query.view.value, "conditions": list(query.conditions)}
    pairs = [
        {"left": plain_experiment(left), "right": plain_experiment(right)}
        for left, right in stored.experiments
    ]
    data = {
        "format": FORMAT,
        "program": __version__,
        "models": [_plain_model(model) for model in stored.models],
        **({"experiments": pairs} if pairs else {}),  # older files of chains as they are have none
        "query": question,
        "settings": stored.settings.to_dict(),
        **_strip_words(stored.verdict).to_dict(),
        "over_complex": {} if beside is None else _strip_words(beside).to_dict(),
    }
    plain: dict[str, Any] = json.loads(json.dumps(data))
    return plain


def _strip_words(verdict: Verdict) -> Verdict:
    """The verdict without words that nothing compares."""
    both = verdict.inclusions
    if both is not None:
        both = Inclusions(replace(both.image, reason=""), replace(both.closure, reason=""))
    notes = () if verdict.evidence is None else verdict.notes
    return replace(verdict, notes=notes, inclusions=both)


def has_more(verdict: Verdict) -> bool:
    """Return True if a verdict over other parameters includes the equivalence over complex ones."""
    is_open = verdict.closure is Inclusion.EQUAL or verdict.relation is not Relation.DISTINGUISHABLE
    return verdict.domain is not Domain.COMPLEX and is_open


def exact(query: Query) -> Query:
    """The same over complex parameters."""
    return Query(View.EXACT, query.conditions, query.markov, query.inclusion)


def read_file(data: object, beside: Collection[str] = ()) -> StoredVerdict:
    """Inverse of `verdict_file`. Raises InputError for what is no such file, or is damaged, and for
    keys that it has not, MisnamedError for a name that denotes another model; `beside` = keys that
    are allowed for another reason.
    """
    if not isinstance(data, dict) or data.get("format") not in (FORMAT, OLDER):
        is_verdict = isinstance(data, dict) and (set(PLAIN) <= data.keys() or "verdicts" in data)
        what = "holds a verdict without its models" if is_verdict else "is no file of a verdict"
        raise InputError(f"it {what}; 'disting compare N:I M:J --json' writes one")
    try:
        stored = _read_stored(data)
        unknown = [key for key in data if key not in (*as_file(stored), *beside)]
        if unknown:
            raise InputError(f"{short(unknown[0])} is not a key of it")
        return stored
    except MisnamedError:
        raise
    except (*DAMAGED, DistingError, RecursionError) as reason:
        why = f"{short(str(reason))} is missing" if isinstance(reason, KeyError) else reason
        raise InputError(
            f"the file of the verdict is damaged ({why}); write it again with 'disting compare N:I"
            " M:J --json'"
        ) from None


def difference(data: dict[str, Any], stored: StoredVerdict, sides: Sides) -> str:
    """First statement of a file that does not follow from its evidence, such as its sentence; "" if
    there is none. `sides` are its models as they are compared.
    """
    again = as_file(stored)
    if data.get("format") == OLDER:
        again, data = in_older_words(again) | {"format": OLDER}, without_primes(data)
    missing = object()
    fields = [
        name
        for name in again
        if name != "program" and not same_plain(data.get(name, missing), again[name])
    ]
    verdicts = [v for v in (stored.verdict, stored.over_complex) if v is not None]
    if any((v.left, v.right) != (sides.left.name, sides.right.name) for v in verdicts):
        fields.append("names")
    if any(v.premises != (sides.left.view.premise, sides.right.view.premise) for v in verdicts):
        fields.append("damping, quantity and experiments")
    return ", ".join(fields)


def plain_experiment(experiment: Experiment) -> dict[str, object]:
    """An experiment as plain data, sizes as exact text."""
    return {name: _plain_field(value) for name, value in experiment.written_fields.items()}


def read_experiment(data: Mapping[str, Any]) -> Experiment:
    """Inverse of `plain_experiment`; raises InputError, TypeError or ValueError."""
    sized = [data.get(kind.argument, ()) for kind in CHANGES if kind.takes_size]
    if any(type(size) is not str for listed in sized for _, size in listed):
        raise InputError("a known size is a fraction as text")
    return Experiment(**data)


def _plain_field(value: object) -> object:
    if isinstance(value, tuple):
        return [_plain_field(item) for item in value]
    return str(value) if isinstance(value, Fraction | Quantity) else value


def same_plain(stored: object, again: object) -> bool:
    """Return True if both are the same plain data: tuples are lists, names of enumerations
    texts.
    """
    if isinstance(again, dict):
        return (
            isinstance(stored, dict)
            and stored.keys() == again.keys()
            and all(same_plain(stored[name], value) for name, value in again.items())
        )
    if isinstance(again, list | tuple):
        return (
            isinstance(stored, list | tuple)
            and len(stored) == len(again)
            and all(map(same_plain, stored, again))
        )
    return stored == again and isinstance(stored, bool) == isinstance(again, bool)


def _read_stored(data: dict[str, Any]) -> StoredVerdict:
    a, b = map(_model, data["models"])
    pairs = data.get("experiments", [])
    if len(pairs) > MOST_EXPERIMENTS:
        raise InputError(f"{len(pairs)} experiments are more than {MOST_EXPERIMENTS}")
    experiments = tuple(
        (read_experiment(pair["left"]), read_experiment(pair["right"])) for pair in pairs
    )
    if not VERSION.fullmatch(data["program"]):
        raise InputError(f"{short(data['program'])} is not a version")
    beside = data["over_complex"]
    return StoredVerdict(
        models=(a, b),
        experiments=experiments,
        query=_query(data["query"]),
        settings=_settings(data["settings"]),
        verdict=_verdict(data),
        over_complex=_verdict(beside) if beside else None,
    )


def _query(asked: Mapping[str, Any]) -> Query:
    query = Query(
        View(asked["view"]), tuple(asked["conditions"]), asked["markov"], asked["inclusion"]
    )
    whole = type(query.markov) is int and type(query.inclusion) is bool
    if not whole or query.markov > MOST_MARKOV:
        raise InputError(f"a query asks for at most {MOST_MARKOV} Markov parameters")
    return query


def _settings(data: Mapping[str, Any]) -> Settings:
    settings = Settings(**data)
    types = (type(settings.seed), type(settings.points), type(settings.subset_limit))
    if types != (str, int, int) or len(settings.seed) > LONGEST_SEED:
        raise InputError("settings are a seed and two whole numbers")
    if not (1 <= settings.points <= MOST_POINTS and 0 <= settings.subset_limit <= MOST_SUBSETS):
        raise InputError(
            f"a verdict is checked with 1 to {MOST_POINTS} points and {MOST_SUBSETS} subsets at"
            " most"
        )
    return settings


def _verdict(data: dict[str, Any]) -> Verdict:
    """The verdict; raises InputError where a field of its evidence is of another type."""
    verdict = Verdict.from_dict(data)
    both = (
        () if verdict.inclusions is None else (verdict.inclusions.image, verdict.inclusions.closure)
    )
    shares = [x for x in (verdict.left_positive, verdict.right_positive) if x is not None]
    if not all(is_well_typed(x.evidence) for x in (verdict, *both, *shares)):
        raise InputError("the evidence has a field of another type")
    return verdict


def _plain_model(model: Chain | AnyModel) -> dict[str, object]:
    if isinstance(model, Chain):
        return {"name": name_of(model), **model.written_fields}
    chain = as_chain(model)
    return as_entry(model) if chain is None else {"name": model.name, **chain.written_fields}


def _model(data: Mapping[str, Any]) -> Chain | AnyModel:
    if "n_masses" not in data:
        model = read_entry(data)
        refuse_misnamed_models([model])
        return model
    rest = {name: value for name, value in data.items() if name != "name"}
    flags = [rest[name] for name in ("damped", "lag", "dead_time")]
    if not all(type(flag) is bool for flag in flags):
        raise InputError("whether a chain has dampers, lag or dead time is true or false")
    if type(rest["n_masses"]) is int and rest["n_masses"] > MOST_MASSES:
        raise InputError(f"a chain has {MOST_MASSES} masses at most")
    rest["ground_dampers"] = tuple(rest["ground_dampers"])
    chain, name = Chain.from_written_fields(rest), data["name"]
    if type(name) is not str:
        raise InputError("the name of a model is a text")
    refuse_misnamed(name, naming_of(name, chain))
    if name == name_of(chain):
        return chain
    if chain.n_masses > LARGEST_CHAIN:
        raise InputError(f"a chain with a name of its own has {LARGEST_CHAIN} masses at most")
    return Model.from_chain(chain, name=name)
