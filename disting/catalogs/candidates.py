"""Verdicts on all pairs of a list of chains of any sizes, and the shipped ones on the candidates
of a fit (Fig. 1).

`candidates.jsonl`: a header, a line a model, then a line for each model but the last with one sign
for each later model: relation (. distinguishable, = indistinguishable, ? undecided), deciding
condition (e the exact decision), representation and certainty. The evidence is not kept: `compare`
gives it. A relation does not depend on the sensor quantity, so the
stored ones serve all three.
"""

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from string import ascii_letters
from typing import TYPE_CHECKING

from disting.algebra.certainty import Certainty
from disting.catalogs.files import Record, lines, shipped_folder, write_provenance
from disting.conditions.rule import RULES
from disting.errors import CatalogError, InputError
from disting.files import intact_text, write_whole
from disting.model.chain import Chain, Indices, Quantity
from disting.model.names import name_of
from disting.model.presentation import plural, summary
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.result import Query, Relation, View

if TYPE_CHECKING:  # a matrix that is looked up needs nothing of what decides
    from disting.verdict.decisions import Decisions

SCHEMA = 1
FILE = "candidates.jsonl"
COMMAND = "disting catalog candidates"
RELATIONS = {
    ".": Relation.DISTINGUISHABLE,
    "=": Relation.INDISTINGUISHABLE,
    "?": Relation.UNDECIDED,
}
SIGNS = {relation: sign for sign, relation in RELATIONS.items()}


def _letters(names: Iterable[str]) -> dict[str, str]:
    """A letter a rule: its first one, or, where another rule has that, one that none has."""
    texts = dict[str, str]()
    for name in names:
        texts[name] = next(x for x in name[0] + ascii_letters if x not in texts.values())
    return texts


LETTERS = _letters(RULES)


@dataclass(frozen=True)
class Matrix:
    """The verdicts on all pairs of `chains`; `records` is the file's content."""

    records: tuple[Record, ...]

    def __repr__(self) -> str:
        return summary(self, f"{self.records[0]['catalog']}, {plural(len(self.chains), 'model')}")

    @cached_property
    def chains(self) -> tuple[Chain, ...]:
        """The models in order."""
        return tuple(
            _chain(r, self.records[0]) for r in self.records[1 : 1 + int(self.records[0]["models"])]
        )

    def __contains__(self, chain: object) -> bool:
        return isinstance(chain, Chain) and self._plain(chain) in self._places

    def relation(self, left: Chain, right: Chain) -> Relation:
        """Relation of two different models of one sensor quantity; raises InputError for models
        that are not there.
        """
        return RELATIONS[self._sign("relation", left, right)]

    def decided_by(self, left: Chain, right: Chain) -> str:
        """The deciding rule for the stored sensor quantity, "" if undecided."""
        sign = self._sign("decided_by", left, right)
        return {letter: name for name, letter in LETTERS.items()}.get(sign, "")

    def certainty(self, left: Chain, right: Chain) -> Certainty | None:
        """Certainty of the verdict, None if undecided; the error bound of BOUNDED ones is in
        the header.
        """
        sign = self._sign("certainty", left, right)
        return next((c for c in Certainty if c.value[0] == sign), None)

    def counts(self) -> dict[Relation, int]:
        """Number of pairs by relation."""
        signs = "".join(str(r["relation"]) for r in self._rows)
        return {relation: signs.count(sign) for sign, relation in RELATIONS.items()}

    def text(self) -> str:
        """The file's text."""
        return lines(list(self.records))

    def _sign(self, column: str, left: Chain, right: Chain) -> str:
        own_place, other_place = (self._places.get(self._plain(c), -1) for c in (left, right))
        low, high = sorted((own_place, other_place))
        if low < 0 or low == high or left.quantity is not right.quantity:
            raise InputError(
                f"the matrix holds pairs of two of its models with one sensor, not {left} and"
                f" {right}"
            )
        return str(self._rows[low][column])[high - low - 1]

    @property
    def _rows(self) -> tuple[Record, ...]:
        return self.records[1 + int(self.records[0]["models"]) :]

    @cached_property
    def _places(self) -> dict[Chain, int]:
        return {chain: i for i, chain in enumerate(self.chains)}

    def _plain(self, chain: Chain) -> Chain:
        return replace(chain, quantity=Quantity(self.records[0]["sensor"]))


def matrix(
    chains: Sequence[Chain],
    *,
    engine: Engine | None = None,
    executor: Executor | None = None,
    progress: Progress = silent,
    name: str = "candidates",
) -> Matrix:
    """The verdicts on all pairs of chains of one sensor quantity, of any sizes; inclusions are not
    decided.
    """
    if len({c.quantity for c in chains}) != 1:
        raise InputError("a matrix of verdicts holds models of one sensor quantity")
    engine = engine or Engine()
    subjects = [engine.subject(name_of(c), c) for c in chains]
    decided = engine.decisions(
        subjects, Query(View.EXACT, inclusion=False), executor=executor, progress=progress
    )
    models: list[Record] = [_model(number, s.chain, s.rank) for number, s in enumerate(subjects, 1)]
    rows, safety = _rows(decided)
    header: Record = {
        "schema": SCHEMA,
        "catalog": name,
        "models": len(chains),
        "sensor": chains[0].quantity.value,
    }
    header |= {"command": COMMAND, "settings": engine.settings.to_dict(), "safety": safety}
    return Matrix((header, *models, *rows))


def read(folder: Path) -> Matrix:
    """The matrix in a folder; raises CatalogError where it is missing, damaged or of another
    schema.
    """
    import json

    path = folder / FILE
    remedy = f"make it with '{COMMAND}'"
    try:
        records = tuple(json.loads(line) for line in intact_text(path).splitlines())
        n = records[0]["models"]
        whole = records[0]["schema"] == SCHEMA and [
            len(r["relation"]) for r in records[1 + n :]
        ] == list(range(n - 1, 0, -1))
    except FileNotFoundError:
        raise CatalogError(f"there is no {path}; {remedy}") from None
    except (OSError, ValueError, LookupError, TypeError) as reason:
        raise CatalogError(f"{path} cannot be read ({reason}); {remedy}") from None
    if not whole:
        raise CatalogError(f"{path} is incomplete or of another schema; {remedy}")
    return Matrix(records)


@cache
def shipped_matrix() -> Matrix:
    """The shipped verdicts on the 120 candidates of Fig. 1."""
    return read(shipped_folder())


def write(the_matrix: Matrix, folder: Path) -> Path:
    """Write the file; returns its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = write_whole(folder / FILE, [the_matrix.text()])
    write_provenance(folder)
    return path


def _model(number: int, chain: Chain, rank: int) -> Record:
    ports = {"model": number, "indices": list(chain.indices), "damped": chain.damped, "rank": rank}
    return ports | {
        "ground_dampers": list(chain.ground_dampers),
        "lag": chain.lag,
        "dead_time": chain.dead_time,
    }


def _chain(r: Record, header: Record) -> Chain:
    plain = Chain(*Indices(*r["indices"]), quantity=Quantity(header["sensor"]), damped=r["damped"])
    return replace(
        plain, ground_dampers=tuple(r["ground_dampers"]), lag=r["lag"], dead_time=r["dead_time"]
    )


def _rows(decided: "Decisions") -> tuple[list[Record], int]:
    """A record for each model but the last, and the error bits of the weakest bounded verdict."""
    grades = {
        (i, j): (where, certainty, bits) for i, j, _, where, certainty, bits in decided.grades()
    }
    n = len(decided.subjects)

    def signs(of: Callable[[int, int], str], i: int) -> str:
        """One letter for each later model: the initial of its relation, ? where none is known."""
        return "".join((of(i, j) or "?")[0] for j in range(i + 1, n))

    rows: list[Record] = [
        {
            "left": i + 1,
            "relation": signs(lambda a, b: SIGNS[decided.relation(a, b)], i),
            "decided_by": signs(lambda a, b: LETTERS.get(decided.rule(a, b), ""), i),
            "representation": signs(lambda a, b: grades[a, b][0], i),
            "certainty": signs(lambda a, b: grades[a, b][1], i),
        }
        for i in range(n - 1)
    ]
    return rows, min((bits for *_, bits in grades.values() if bits), default=0)
