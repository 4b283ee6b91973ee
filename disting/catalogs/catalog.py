"""A catalogue in memory: look-ups without computation, and the same content as tables, groups,
CSV and JSON. Of a pair it holds which step decides in which view, and the verdict; of a model, its
row.
"""

import json
from ast import literal_eval
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from itertools import combinations
from pathlib import Path
from typing import TYPE_CHECKING, Any

from disting.algebra.certainty import Certainty
from disting.catalogs.export import csv_row, csv_text
from disting.catalogs.files import (
    INCLUSIONS,
    LEFT_POSITIVE,
    PROVENANCE,
    RIGHT_POSITIVE,
    SHIPPED_SIZES,
    Record,
    Records,
    line,
    name_of,
    read_records,
    shipped_folder,
)
from disting.conditions.inclusion import Inclusion, Inclusions, inclusions_from_dict
from disting.conditions.rule import NOT_REAL, RULES, Finding, Stage, positive_ways
from disting.decide.identifiability.answer import Identifiability
from disting.errors import CatalogError, ContradictionError, InputError, of_type
from disting.evidence.kinds import evidence_from
from disting.evidence.positive import PositiveFinding
from disting.files import Format, json_text
from disting.model.chain import Chain, Premise
from disting.model.family import Family
from disting.model.presentation import NotebookTable, plural, summary
from disting.model.question import Domain
from disting.verdict.forest import classes_of
from disting.verdict.result import PROVES, Relation, Step, Verdict, View, open_note

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

DIFFERENT = 4096  # pieces of evidence that are kept: a catalogue has far fewer than pairs
INDEX_NAMES = ("gap", "act_minus", "act_plus", "meas_minus", "meas_plus")


@dataclass(frozen=True)
class StoredPair:
    """A pair as its record has it: over positive parameters nothing is stored but the shares of
    both sides, from which the verdict follows.
    """

    record: Record

    def verdict(
        self, view: View, names: tuple[str, str], premises: tuple[Premise, Premise]
    ) -> Verdict:
        """The verdict of a view with everything that the record holds on the pair, under these
        names.
        """
        step = self.step(view)
        looks_at_parameters = Stage.FIBRE in view.representations
        relations = self._both_ways if looks_at_parameters else {}
        if step is None:
            return Verdict(
                *names,
                Relation.UNDECIDED,
                domain=view.domain,
                notes=self._notes(view),
                premises=premises,
                **relations,
            )
        finding = step.finding
        return Verdict(
            *names,
            step.relation,
            finding.rule.name,
            step.representation,
            finding.certainty,
            finding.safety,
            finding.evidence,
            view.domain,
            premises=premises,
            **relations,
        )

    def step(self, view: View) -> Step | None:
        """The step that decides in a view: the first of its representations that does; None if
        none does.
        """
        if view is View.POSITIVE and self._positively is not None:
            return self._positively if self._positively.finding.evidence else None
        if view is View.REAL and view.value in self.record:
            return _step(Stage.PARAMETERS, repr(self.record[view.value]))
        steps = (self._steps[s] for s in view.representations if s in self._steps)
        step = next(steps, None)
        if view.domain is Domain.COMPLEX or step is None:
            return step
        # what distinguishes over complex parameters does so over all
        return step if step.relation is Relation.DISTINGUISHABLE else None

    @cached_property
    def _steps(self) -> dict[Stage, Step]:
        """Deciding step of each stage over complex parameters."""
        stages = (stage for stage in View.EXACT.representations if stage in self.record)
        return {stage: _step(stage, repr(self.record[stage])) for stage in stages}

    @cached_property
    def _both_ways(self) -> dict[str, Any]:
        """Record of inclusions and shares, where the pair is decided over complex parameters."""
        settled = self.step(View.EXACT)
        if settled is None:
            return {}
        both = None
        same = settled.relation is Relation.INDISTINGUISHABLE
        image = closure = Inclusion.EQUAL if same else Inclusion.NEITHER
        if INCLUSIONS in self.record:
            both = _inclusions(repr(self.record[INCLUSIONS]))
            image, closure = both.image.inclusion, both.closure.inclusion
        own_finding, other_finding = self._shares
        return {
            "left_positive": own_finding,
            "right_positive": other_finding,
            "image": image,
            "closure": closure,
            "inclusions": both,
        }

    @cached_property
    def _shares(self) -> tuple[PositiveFinding | None, PositiveFinding | None]:
        """Positive equivalents of the left and of the right model, where they are requested."""
        own_value, other_value = (self.record.get(name) for name in (LEFT_POSITIVE, RIGHT_POSITIVE))
        return _share(repr(own_value)) if own_value else None, _share(
            repr(other_value)
        ) if other_value else None

    @cached_property
    def _positively(self) -> Step | None:
        """Result of the shares of both sides, if they are needed: for models that are
        indistinguishable over complex parameters.
        """
        own_finding, other_finding = self._shares
        if own_finding is None or other_finding is None:
            return None
        return Step(Stage.PARAMETERS, _positive_ways(own_finding, other_finding))

    def _notes(self, view: View) -> tuple[str, ...]:
        """Why a pair is undecided."""
        if view.domain is Domain.COMPLEX:
            return ("the exact decision has no method for them",) if view is View.EXACT else ()
        if view is View.POSITIVE and self._positively is not None:
            return (open_note(self._positively.finding.note),)
        return (open_note(NOT_REAL),) if self.step(View.EXACT) else ()


@lru_cache(DIFFERENT)
def _step(stage: Stage, text: str) -> Step:
    """A step from its text as Python writes it: pairs that are decided alike share it."""
    plain = literal_eval(text)
    rule = RULES[plain["decided_by"]]
    proves = {relation: outcome for outcome, relation in PROVES[rule.role].items()}
    outcome = proves[Relation(plain.get("relation", next(iter(proves))))]
    evidence = evidence_from(plain["evidence"])
    finding = Finding(rule, outcome, Certainty(plain["certainty"]), plain["safety"], evidence)
    return Step(stage, finding)


@lru_cache(DIFFERENT)
def _inclusions(text: str) -> Inclusions:
    return inclusions_from_dict(literal_eval(text))


@lru_cache(DIFFERENT)
def _share(text: str) -> PositiveFinding:
    return PositiveFinding.from_dict(literal_eval(text))


_positive_ways = lru_cache(DIFFERENT)(positive_ways)


@dataclass(frozen=True, slots=True)
class ModelRow:
    """A model as Table 3 lists it; `rank` = determinable parameters, `group` = its group in
    `classes()` or 0.

    >>> from disting.catalogs import catalog
    >>> row = catalog(2, damped=True).rows[1]
    >>> row.number, row.rank, row.n_parameters
    (2, 3, 4)
    """

    number: int
    chain: Chain
    numerator_degree: int
    denominator_degree: int
    n_parameters: int
    rank: int
    group: int
    identifiability: Identifiability

    def __repr__(self) -> str:
        phrase = f"{self.rank} of {self.n_parameters} parameters determinable"
        return summary(
            self, f"model {self.number}, {phrase}" + (f", group {self.group}" if self.group else "")
        )


def model_row(record: Record, family: Family, group: int) -> ModelRow:
    """The row of a model from its record, in this group."""
    number, (numerator, denominator) = record["model"], record["degrees"]
    return ModelRow(
        number=number,
        chain=family[number],
        numerator_degree=numerator,
        denominator_degree=denominator,
        n_parameters=len(record["parameters"]),
        rank=record["rank"],
        group=group,
        identifiability=Identifiability.from_dict(record["identifiability"]),
    )


@dataclass(frozen=True)
class Catalog(NotebookTable):
    """All verdicts of one family; `records` is its file's content (see `files`).

    >>> catalog(3, damped=True).verdict(2, 5, View.EXACT).decided_by
    '6'
    """

    records: Sequence[Record]

    def __repr__(self) -> str:
        size = len(self.family)
        return summary(
            self,
            f"{self.name}, {plural(size, 'model')}, {plural(size * (size - 1) // 2, 'pair')}",
        )

    @staticmethod
    def from_records(records: Iterable[Record]) -> "Catalog":
        """Catalogue from the records of a file, as the file has them."""
        return Catalog(Records(tuple(map(line, records))))

    def record(self, at: int) -> Record:
        """A record of the file: 0 is the header, then models by their numbers, then pairs."""
        entry: Record = self._once(at, lambda: self.records[at])
        return entry

    @property
    def name(self) -> str:
        """Such as chains-3-damped."""
        return str(self.record(0)["catalog"])

    @property
    def n_masses(self) -> int:
        """Number of masses N_B."""
        return int(self.record(0)["n_masses"])

    @property
    def damped(self) -> bool:
        """True if every spring has a damper in parallel."""
        return bool(self.record(0)["damped"])

    @cached_property
    def premise(self) -> Premise:
        """Damping and sensor quantity of all models."""
        return Premise(self.damped, self.family.quantity)

    @cached_property
    def family(self) -> Family:
        """The models."""
        return Family(self.n_masses, self.damped)

    @property
    def provenance(self) -> dict[str, str]:
        """Schema, settings and, for shipped catalogues, software versions."""
        header = {k: v if isinstance(v, str) else json.dumps(v) for k, v in self.record(0).items()}
        return header | {f"software {k}": v for k, v in _software().items()}

    def verdict(self, left: int, right: int, view: View = View.POSITIVE) -> Verdict:
        """The stored verdict on two different models, numbered from 1; `left` and `right` as given,
        evidence in order.

        Raises InputError for other numbers, CatalogError for a damaged record.
        """
        low, high = sorted((left, right))
        if low == high or not 1 <= low <= high <= len(self.family):
            raise InputError(
                f"{self.name} holds pairs of two different models 1 to {len(self.family)}, not"
                f" {left}:{right}"
            )
        return self._verdicts(low, high)[view]

    def pairs(self, view: View = View.POSITIVE) -> Iterator[tuple[int, int, Verdict]]:
        """Yield (left, right, verdict) for all pairs left < right."""
        for low, high in self._pairs:
            yield low, high, self._verdicts(low, high)[view]

    def relation(self, left: int, right: int, view: View = View.POSITIVE) -> Relation:
        """Relation of two models."""
        low, high = sorted((left, right))
        return self._verdicts(low, high)[view].relation

    @cached_property
    def rows(self) -> tuple[ModelRow, ...]:
        """The models with their properties."""
        group = {m: number for number, members in enumerate(self.classes(), 1) for m in members}
        return tuple(
            model_row(r, self.family, group.get(r["model"], 0))
            for r in map(self.record, range(1, 1 + len(self.family)))
        )

    def classes(self, view: View = View.POSITIVE) -> tuple[tuple[int, ...], ...]:
        """Groups of two or more mutually indistinguishable models, for all parameters of the
        view's domain.

        Raises CatalogError where the verdicts contradict each other. Pairs that agree for some
        parameters only belong to no group for that (see `depending`).
        """
        groups: tuple[tuple[int, ...], ...] = self._once(view, partial(self._classes_of, view))
        return groups

    def _classes_of(self, view: View) -> tuple[tuple[int, ...], ...]:
        names = [str(number) for number in range(1, 1 + len(self.family))]
        try:
            classes = classes_of(names, lambda i, j: self.relation(i + 1, j + 1, view))
        except ContradictionError as reason:
            raise CatalogError(f"{self.name} is inconsistent: {reason}") from None
        return tuple(tuple(i + 1 for i in members) for members in classes if len(members) > 1)

    def depending(self, view: View = View.POSITIVE) -> tuple[tuple[int, int], ...]:
        """The pairs that are indistinguishable for some parameters only; over complex parameters
        there are none.

        >>> catalog(4, damped=False).depending()
        ((2, 6),)
        """
        return tuple(p for p in self._pairs if self.relation(*p, view) is Relation.SOMETIMES)

    def counts(self, view: View = View.POSITIVE) -> dict[str, int]:
        """Number of pairs by deciding condition, "exact" for the exact decision, "" for the
        undecided ones.
        """
        counter = Counter(verdict.decided_by for *_, verdict in self.pairs(view))
        return {name: counter[name] for name in ("", *RULES) if counter[name] or not name}

    def matrix(self, view: View = View.POSITIVE) -> "pd.DataFrame":
        """Symmetric matrix of the relations' names, models 1..n as index and columns; "" on the
        diagonal.
        """
        import pandas as pd

        numbers = range(1, len(self.family) + 1)
        table = [
            ["" if i == j else self.relation(i, j, view).value for j in numbers] for i in numbers
        ]
        return pd.DataFrame(
            table, index=pd.Index(numbers, name="model"), columns=pd.Index(numbers, name="model")
        )

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """The matrix over positive parameters as a picture, with matplotlib; in a new figure where
        no axes are given. Returns the axes. Raises DistingError where matplotlib is missing.
        """
        axes: Axes = self._presenter.plot(self, ax, {})
        return axes

    def models(self) -> "pd.DataFrame":
        """One row a model: indices, parameters, degrees, determinable parameters, group."""
        import pandas as pd

        rows = [
            {"model": r.number, **dict(zip(INDEX_NAMES, r.chain.indices[1:], strict=True))}
            | {"parameters": " ".join(r.chain.parameters), "numerator_degree": r.numerator_degree}
            | {"denominator_degree": r.denominator_degree, "n_parameters": r.n_parameters}
            | {
                "rank": r.rank,
                "collocated": r.chain.collocated,
                "group": r.group,
                "identifiable": r.identifiability.level.value,
            }
            for r in self.rows
        ]
        return pd.DataFrame(rows).set_index("model")

    def to_csv(self, view: View = View.POSITIVE) -> str:
        """All verdicts as CSV text."""
        return csv_text(csv_row(i, j, v) for i, j, v in self.pairs(view))

    def to_json(self, view: View = View.POSITIVE) -> str:
        """All verdicts with evidence and sentences as JSON text."""
        plain = {
            "format": Format.CATALOGUE.value,
            "header": self.record(0),
            "view": view.value,
            "verdicts": [],
        }
        # one after the other: together they take more memory than their text
        verdicts = (v.to_dict() | {"left": i, "right": j} for i, j, v in self.pairs(view))
        return f"{json_text(plain).removesuffix(']}')}{','.join(map(json_text, verdicts))}]}}\n"

    @cached_property
    def _known(self) -> dict[object, Any]:
        """Cache of verdicts and groups: pages request each of them several times."""
        return {}

    def forget(self) -> None:
        """Drop the cached verdicts: they are read again on the next request."""
        self._known.clear()

    def _once(self, key: object, made: Callable[[], Any]) -> Any:
        if key not in self._known:
            self._known[key] = made()
        return self._known[key]

    @property
    def _pairs(self) -> Iterator[tuple[int, int]]:
        return combinations(range(1, 1 + len(self.family)), 2)

    def _verdicts(self, low: int, high: int) -> dict[View, Verdict]:
        verdicts: dict[View, Verdict] = self._once((low, high), partial(self._read, low, high))
        return verdicts

    def _read(self, low: int, high: int) -> dict[View, Verdict]:
        """The verdicts of all views: a request for one is followed by others, and to read the
        record is most of the work.
        """
        try:
            pair = StoredPair(self._pair(low, high))
            names = (f"{self.n_masses}:{low}", f"{self.n_masses}:{high}")
            return {v: pair.verdict(v, names, (self.premise, self.premise)) for v in View}
        except (KeyError, TypeError, ValueError, AttributeError) as reason:
            raise CatalogError(
                f"{self.name}, {low}:{high} cannot be read ({reason!r}); rebuild it with 'disting"
                " catalog build'"
            ) from None

    def _pair(self, low: int, high: int) -> Record:
        n = len(self.family)
        before = (low - 1) * n - low * (low - 1) // 2  # pairs whose left model comes earlier
        return self.records[1 + n + before + high - low - 1]


def catalog(n_masses: int, *, damped: bool = True, folder: Path | None = None) -> Catalog:
    """The shipped catalogue of all chains with 1 to 5 masses (or one from another folder), with
    a damper beside every spring or, if not `damped`, without; no computation. Raises CatalogError
    if there is none, or if its file is not what was written.

    >>> len(catalog(3, damped=False).family), catalog(3, damped=False).verdict(1, 2).relation.value
    (11, 'distinguishable')
    """
    of_type(n_masses, int, "a catalogue is of so many masses")
    if folder is None and n_masses not in SHIPPED_SIZES:
        raise CatalogError(
            f"catalogues of 1 to 5 masses are shipped, not of {n_masses}; make it with 'disting"
            " catalog build'"
        )
    return _load_shipped(n_masses, damped) if folder is None else _read(folder, n_masses, damped)


@lru_cache(maxsize=2)  # a look-up asks for the verdict, then for what is known of each model
def _load_shipped(n_masses: int, damped: bool) -> Catalog:
    return _read(shipped_folder(), n_masses, damped)


def _read(folder: Path, n_masses: int, damped: bool) -> Catalog:
    return Catalog(read_records(folder / f"{name_of(n_masses, damped)}.jsonl"))


def _software() -> dict[str, str]:
    path = shipped_folder() / PROVENANCE
    return dict(json.loads(path.read_text(encoding="utf-8"))["software"]) if path.is_file() else {}
