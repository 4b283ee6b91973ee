"""Models with the transfer function of a given one, networks or a user's own: among some, or in a
family, and with which values.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from disting.errors import InputError, short
from disting.general import Alternatives, AnyModel, Extent, alternatives
from disting.general.any_model import as_model, on_one_variable
from disting.general.balls import Synthesis, positive_sets
from disting.general.synthesis import NoFormulas
from disting.general.target import rational_values
from disting.model.presentation import NotebookTable, summary
from disting.model.question import Domain
from disting.network.network import Network, as_number
from disting.verdict.comparison import compare
from disting.verdict.engine import Engine
from disting.verdict.result import Query, Relation, Verdict

MOST_SOLVED = 6  # parameters of models of which all values are looked for at once


@dataclass(frozen=True, slots=True)
class ModelEquivalent(NotebookTable):
    """Another model, what is known of the pair, and its values where those of the given one are
    given: all of them, or of larger networks the positive ones by `synthesis`.

    `exponents`: those of its constant phase elements, each with the one of the given network that
    it equals, or with the value of that.

    >>> from disting.equivalence import equivalents
    >>> values = {"R0": 1, "R1": 2, "C1": "1/2"}
    >>> (found,) = equivalents("R0-p(R1,C1)", values, to="p(R0,R1-C1)")
    >>> found.model.name, found.verdict.relation.value, len(found.to_dict()["values"])
    ('p(R0,R1-C1)', 'indistinguishable', 1)
    """

    model: AnyModel
    verdict: Verdict
    values: Alternatives | None = None
    synthesis: Synthesis | None = None
    exponents: tuple[tuple[str, str], ...] = ()

    def __repr__(self) -> str:
        return summary(self, f"{self.model.name}, {self.verdict.in_words}")

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; values rounded to 15 digits where they are irrational."""
        extent, sets = self.sets
        return {
            "name": self.model.name,
            "relation": self.verdict.relation.value,
            "sentence": self.verdict.sentence,
            **({"exponents": dict(self.exponents)} if self.exponents else {}),
            "extent": extent,
            "values": [
                {"domain": domain.value, "parameters": {n: str(x) for n, x in values.items()}}
                for domain, values in sets
            ],
        }

    @property
    def sets(self) -> tuple[str, list[tuple[Domain, Mapping[str, object]]]]:
        """Number of sets of values, and the known sets, each with its domain."""
        if self.synthesis is not None:
            return self.synthesis.extent, [(Domain.POSITIVE, x) for x in self.synthesis.sets]
        if self.values is None:
            return "", []
        return self.values.extent.value, [(x.domain, x.values) for x in self.values.equivalents]


def model_equivalents(
    source: Network | AnyModel,
    others: Sequence[Network | AnyModel],
    values: Mapping[str, object] | None = None,
    *,
    query: Query | None = None,
    engine: Engine | None = None,
) -> list[ModelEquivalent]:
    """Those of the other models that are not distinguishable from the given one over positive
    values (or in the domain of the query), with all their values that give its transfer function at
    `values`, exactly. Values of exponents may be given, and have no effect. Models of other numbers
    of inputs and outputs are passed over. Raises InputError.

    >>> from disting.network import network_of
    >>> given, other = network_of("R0-p(R1,C1)"), network_of("p(R0,R1-C1)")
    >>> (found,) = model_equivalents(given, [other], {"R0": 1, "R1": 2, "C1": "1/2"})
    >>> found.verdict.relation.value, str(found.values.equivalents[0])
    ('indistinguishable', 'C1 = 2/9, R0 = 3, R1 = 3/2')
    """
    model = as_model(source)
    engine = Engine() if engine is None else engine
    exponents = model.network.exponents if model.network is not None else ()
    phases = {n: _phase(n, (values or {}).get(n, n)) for n in exponents}
    numbers = None if values is None else {n: x for n, x in values.items() if n not in phases}
    equivalents = []
    for other in map(as_model, others):
        if other.shape != model.shape:
            continue
        verdict = compare(model, other, query=query, engine=engine)
        if verdict.relation is not Relation.DISTINGUISHABLE:
            mine, others_form = (s.subject for s in engine.general_subjects([model, other]))
            at, lots = (None, None) if numbers is None else _sets(mine, numbers, others_form)
            named = zip(others_form.powers.exponents, mine.powers.exponents, strict=False)
            equal = tuple((name, phases[given_name]) for name, given_name in named)
            equivalents.append(ModelEquivalent(other, verdict, at, lots, equal))
    return equivalents


def _sets(
    model: AnyModel, values: Mapping[str, object], other: AnyModel
) -> tuple[Alternatives | None, Synthesis | None]:
    """All values of small models, those by synthesis first; of larger ones the positive ones by
    synthesis, where these are all, or nothing else is found.
    """
    synthesized = _synthesize_values(model, values, other)
    is_large = len(other.parameters) > MOST_SOLVED
    if is_large and synthesized is not None and synthesized.complete:
        return None, synthesized
    names, sets = set(other.parameters), synthesized.sets if synthesized is not None else ()
    plain = [
        x for x in sets if x.keys() == names and not any(isinstance(v, float) for v in x.values())
    ]
    solved = alternatives(model, values, other, plain=plain)
    is_open = is_large and synthesized is not None and solved.extent is Extent.UNKNOWN
    return (None, synthesized) if is_open else (solved, None)


def _synthesize_values(
    model: AnyModel, values: Mapping[str, object], other: AnyModel
) -> Synthesis | None:
    first, second = on_one_variable([model, other])
    try:
        return positive_sets(first, dict(rational_values(model, values)), second)
    except NoFormulas:
        return None


def _phase(name: str, value: object) -> str:
    """An exponent by its name, or its value as it is given; raises InputError."""
    number = as_number(str(value))
    if value != name and (number is None or not 0 < number <= 1):
        raise InputError(f"{name} is an exponent: a number up to 1, not {short(value)}")
    return str(value)
