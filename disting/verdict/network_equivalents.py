"""Networks with the transfer function of a given one: among some, or in a family, and with which
values.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from disting.errors import InputError, shown
from disting.general.alternatives import Alternatives, alternatives
from disting.general.any_model import of_network
from disting.general.model import Model
from disting.model.presentation import Shown, summary
from disting.network.element import as_number
from disting.network.network import Network
from disting.verdict.comparison import compare
from disting.verdict.engine import Engine
from disting.verdict.query import Query
from disting.verdict.result import Relation, Verdict


@dataclass(frozen=True, slots=True)
class NetworkEquivalent(Shown):
    """Another network, what is known of the pair, and its values where those of the given one are
    said; `exponents`: those of its constant phase elements, each with the one of the given network
    that it equals, or with the value of that.
    """

    network: Network
    verdict: Verdict
    values: Alternatives | None = None
    exponents: tuple[tuple[str, str], ...] = ()

    def __repr__(self) -> str:
        return summary(self, f"{self.network.name}, {self.verdict.told}")

    def to_dict(self) -> dict[str, object]:
        """Plain data, ready for JSON; values rounded to 15 digits where they are irrational."""
        found = () if self.values is None else self.values.equivalents
        return {
            "name": self.network.name,
            "relation": self.verdict.relation.value,
            "sentence": self.verdict.sentence,
            **({"exponents": dict(self.exponents)} if self.exponents else {}),
            "extent": "" if self.values is None else self.values.extent.value,
            "values": [
                {
                    "domain": x.domain.value,
                    "parameters": {name: str(value) for name, value in x.values.items()},
                }
                for x in found
            ],
        }


def network_equivalents(
    given: Network,
    others: Sequence[Network],
    values: Mapping[str, object] | None = None,
    *,
    query: Query | None = None,
    engine: Engine | None = None,
) -> list[NetworkEquivalent]:
    """Those of the other networks that are not told apart from the given one over positive values
    (or in the domain of the query), with all their values that give its transfer function at
    `values`, exactly. Values of exponents may be said, and change nothing. Raises InputError.

    >>> from disting.network import network_of
    >>> given, other = network_of("R0-p(R1,C1)"), network_of("p(R0,R1-C1)")
    >>> (found,) = network_equivalents(given, [other], {"R0": 1, "R1": 2, "C1": "1/2"})
    >>> found.verdict.relation.value, str(found.values.equivalents[0])
    ('indistinguishable', 'C1 = 2/9, R0 = 3, R1 = 3/2')
    """
    model = of_network(given)
    if values is not None and not isinstance(model, Model):
        raise InputError("values are found of networks with one input and one output")
    engine = Engine() if engine is None else engine
    phases = {n: _phase(n, (values or {}).get(n, n)) for n in given.exponents}
    known = None if values is None else {n: x for n, x in values.items() if n not in phases}
    found = []
    for other in others:
        if other == given or other.shape != given.shape:
            continue
        verdict = compare(given, other, query=query, engine=engine)
        if verdict.relation is not Relation.DISTINGUISHABLE:
            here, there = (s.subject for s in engine.general_subjects([model, of_network(other)]))
            at = None
            if known is not None and isinstance(here, Model) and isinstance(there, Model):
                at = alternatives(here, known, there)
            named = zip(there.powers.exponents, here.powers.exponents, strict=False)
            equal = tuple((mine, phases[theirs]) for mine, theirs in named)
            found.append(NetworkEquivalent(other, verdict, at, equal))
    return found


def _phase(name: str, value: object) -> str:
    """An exponent by its name, or its value as it is given; raises InputError."""
    number = as_number(str(value))
    if value != name and (number is None or not 0 < number <= 1):
        raise InputError(f"{name} is an exponent: a number up to 1, not {shown(value)}")
    return str(value)
