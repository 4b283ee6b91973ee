"""Identifiability of each single parameter of any model that is a coefficient map: globally, up to
exchanges, locally or not at all; over a domain of parameters (see `domains`).

Parameter j is locally identifiable exactly if the unit vector e_j lies in the row space of the
Jacobian at a generic point, that is if the Jacobian without column j has a smaller rank. Whether it
has one value then is decided by the ideal of a generic fibre (`fibres.ideals.one_value`), unless a
list of the fibre has decided it.
"""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from math import ceil, log2
from typing import Any

from disting.algebra.certainty import Certainty, enough, grade_of, joint_safety, safety
from disting.behaviour.sample import Representation, Sample, samples
from disting.fibres.ideals import PolynomialMap, one_value
from disting.model.presentation import plural, summary
from disting.model.protocol import Model
from disting.model.question import Domain, Settings
from disting.questions.identifiability.domains import (
    count_in_words,
    fields_over_domain,
    plain_over_domain,
)
from disting.questions.identifiability.parts import Level, Renaming


@dataclass(frozen=True, slots=True)
class ParameterIdentifiability:
    """Identifiability of each parameter over a `domain` of parameters without zeros, for generic
    values.

    `levels` by parameter: GLOBAL: one value fits; EXCHANGES: those of the parameters that exchanges
    put in its place; LOCAL: several, finitely many, for some values at least; NOT: infinitely many;
    UNKNOWN: finitely many, whether more than one is not known (`reason` explains it). `rank`:
    number of determinable parameters. `least` and `most`: bounds of the number of parameter vectors
    with one generic behaviour (`most` None: infinite or not known). `sampled`: the different
    numbers found at random values of the domain; `varies`: whether the number is proven to depend
    on the values. `exchanges`: renamings of parameters that keep the response and generate all that
    are known. `over_complex`: the finding over complex parameters, where it is another one. All of
    it is wrong with a probability of at most 2**-safety where the certainty is BOUNDED.

    >>> from disting import identifiability
    >>> found = identifiability("1<>2, 1>0; in 1; out 1")  # a network
    >>> {name: level.value for name, level in found.levels.items()}
    {'a10': 'global', 'a12': 'global', 'a21': 'global'}
    """

    levels: dict[str, Level]
    rank: int
    least: int
    most: int | None
    certainty: Certainty
    safety: int
    reason: str = ""
    domain: Domain = Domain.COMPLEX
    sampled: tuple[int, ...] = ()
    varies: bool = False
    exchanges: tuple[Renaming, ...] = ()
    over_complex: "ParameterIdentifiability | None" = None

    def __repr__(self) -> str:
        return summary(self, self.sentence)

    @property
    def freedom(self) -> int:
        """Dimension of a generic fibre: so many parameters may be chosen freely."""
        return len(self.levels) - self.rank

    @property
    def level(self) -> Level:
        """Of all parameters together, as of a whole model."""
        order = (Level.NOT, Level.UNKNOWN, Level.LOCAL, Level.EXCHANGES, Level.GLOBAL)
        return next((level for level in order if self.named(level)), Level.GLOBAL)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the parameters."""
        return tuple(self.levels)

    def named(self, level: Level) -> tuple[str, ...]:
        """The parameters of this level."""
        return tuple(name for name, own in self.levels.items() if own == level)

    @property
    def sentence(self) -> str:
        """The finding in plain English.

        >>> levels = {"a": Level.LOCAL, "b": Level.LOCAL, "c": Level.GLOBAL}
        >>> ParameterIdentifiability(levels, 3, 2, 2, Certainty.BOUNDED, 100).sentence
        '3 parameters, all determinable; globally: c; locally: a, b; 2 sets of complex values fit.'
        """
        head = plural(len(self.levels), "parameter")
        if self.level is Level.GLOBAL:
            where = f" over {self.domain} values" if self._differs else ""
            return f"{head}, all globally identifiable{where}{self._beyond}."
        many = f"only {self.rank} determinable" if self.freedom else "all determinable"
        groups = {
            "globally": self.named(Level.GLOBAL),
            "up to exchange": self.named(Level.EXCHANGES),
            "locally": self.named(Level.LOCAL),
            "locally, perhaps globally": self.named(Level.UNKNOWN),
            "not": self.named(Level.NOT),
        }
        over = f" over {self.domain} values" if self.freedom and self._differs else ""
        lists = [f"; {what}: {', '.join(names)}" for what, names in groups.items() if names]
        free = f"; {self.freedom} can be chosen freely" if self.freedom else self._count
        why = f" ({self.reason})" if self.reason else ""
        return f"{head}, {many}{over}{''.join(lists)}{free}{self._exchanged}{self._beyond}{why}."

    @property
    def _differs(self) -> bool:
        return self.over_complex is not None

    @property
    def _count(self) -> str:
        phrase = count_in_words(self)
        return f"; {phrase}" if phrase else ""

    @property
    def _exchanged(self) -> str:
        texts = " and ".join(renaming.text for renaming in self.exchanges)
        if not texts:
            return ""
        if self.level is Level.EXCHANGES:
            return f": unique up to exchanging {texts}"
        return f"; exchanging {texts} changes nothing"

    @property
    def _beyond(self) -> str:
        """The number over complex parameters, where it is another one."""
        phrase = "" if self.over_complex is None else count_in_words(self.over_complex)
        return f"; {phrase}" if phrase and not self.freedom else ""

    def to_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON; domains are omitted where there is no statement."""
        return plain_over_domain(asdict(self))

    @staticmethod
    def from_dict(data: dict[str, Any]) -> "ParameterIdentifiability":
        """Inverse of `to_dict`; raises KeyError, TypeError or ValueError for what is none."""
        levels = {name: Level(level) for name, level in data["levels"].items()}
        grade = {"certainty": Certainty(data["certainty"]), "levels": levels}
        read = fields_over_domain(data, ParameterIdentifiability.from_dict)
        return ParameterIdentifiability(**(data | grade | read))

    def __bool__(self) -> bool:
        raise TypeError("identifiability is not true or false; look at its levels")


def encode(answer: ParameterIdentifiability) -> str:
    """As text, for a cache."""
    return json.dumps(answer.to_dict(), separators=(",", ":"))


def decode(text: str) -> ParameterIdentifiability:
    """Inverse of `encode`; raises KeyError, TypeError or ValueError for what is none."""
    return ParameterIdentifiability.from_dict(json.loads(text))


@dataclass(frozen=True, slots=True)
class Local:
    """`rank` of the Jacobian and the locally identifiable parameters; wrong with a probability of
    at most 2**-safety, 0: proven.
    """

    rank: int
    names: tuple[str, ...]
    safety: int


def local(model: Model, settings: Settings) -> Local:
    """Local identifiability from the coefficients, at as many independent points as a bound
    needs.
    """
    names, size = model.parameters, model.minor_size(None)
    points = enough(size, settings.points)
    drawn = list(samples(model, Representation.TF, 0, points, settings.seed))
    rank, columns = identifiable_columns(drawn)
    bits = safety(size, len(drawn)) - len(drawn) - ceil(log2(len(names) + 1))
    _, left = grade_of(rank == len(names), bits)
    return Local(rank, tuple(names[j] for j in columns), left)


def identifiable_columns(seen: Sequence[Sample]) -> tuple[int, tuple[int, ...]]:
    """The rank of the Jacobian, and the columns whose removal lowers it, by the largest ranks found
    at the points.
    """
    every = range(seen[0].n_parameters)
    rank = max(_rank(s, tuple(every)) for s in seen)
    if rank == len(every):
        return rank, tuple(every)
    return rank, tuple(
        j for j in every if max(_rank(s, tuple(i for i in every if i != j)) for s in seen) < rank
    )


def by_parameter(
    parameters: Sequence[str],
    local: Local,
    model: PolynomialMap,
    settings: Settings,
    sure: Sequence[str] = (),
) -> ParameterIdentifiability:
    """Levels from the Jacobian and the ideal of a generic fibre; `sure` are known to be global and
    are none of the map's.
    """
    open_ones = [name for name in local.names if name not in sure]
    values = one_value(model, open_ones, seed=settings.seed)
    levels = dict.fromkeys(open_ones, Level.UNKNOWN) | dict.fromkeys(sure, Level.GLOBAL)
    levels |= dict.fromkeys(values.unique, Level.GLOBAL) | dict.fromkeys(
        values.several, Level.LOCAL
    )
    full = local.rank == len(parameters)
    unique = full and set(levels.values()) <= {Level.GLOBAL}
    certainty, bits = joint([local.safety, values.safety])
    return ParameterIdentifiability(
        levels={name: levels.get(name, Level.NOT) for name in parameters},
        rank=local.rank,
        least=2 if values.several else 1,
        most=1 if unique else None,
        certainty=certainty,
        safety=bits,
        reason=values.reason,
    )


def joint(safeties: Sequence[int]) -> tuple[Certainty, int]:
    """Grade of what rests on statements of these safeties, 0: proven."""
    bits = joint_safety(s for s in safeties if s)
    return grade_of(not any(safeties), bits)


def _rank(seen: Sample, columns: tuple[int, ...]) -> int:
    kept = tuple(tuple(row[j] for j in columns) for row in seen.rows)
    return Sample(seen.labels, seen.values, kept, len(columns), seen.modulus).rank(
        tuple(range(len(kept)))
    )
