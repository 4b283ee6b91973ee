"""Candidates before they are fitted: which of them are the same, with the values of the one as
formulas in those of the other, which parameters no data determine, what to measure next.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from disting.algebra.symbols import text
from disting.equivalence.closed_forms import MOST_SOLVED, by_name
from disting.errors import ContradictionError, InputError, enumeration, of_type
from disting.evidence.general import Explicit
from disting.experiments.menu import Costs, as_costs
from disting.files import Format
from disting.general import AnyModel
from disting.general.any_model import as_chain, given_model, on_one_variable
from disting.general.closed_form import ClosedForm, confirm
from disting.general.formulas import fit, of_way
from disting.general.synthesis import NoFormulas
from disting.general.values_of_parts import by_parts
from disting.general.which_models import way
from disting.model.names import read_together
from disting.model.presentation import NotebookTable, plural, summary
from disting.model.question import Domain
from disting.network.notation import network_of, notations_of
from disting.renamed import renamed
from disting.verdict.comparison import asked_of
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine
from disting.verdict.identifiable import Identified, identify
from disting.verdict.next_experiments import menu_for
from disting.verdict.next_words import AnyMenu, to_dict
from disting.verdict.result import Query, Relation, Verdict
from disting.verdict.sides import Given, refuse_ports


class Assignment(NamedTuple):
    """`values` of a duplicate in those of the kept model, the given one, and in `steps`, values
    that have a name, in order; where all polynomials of `where` are positive. `root`: a symbol that
    denotes the root of a polynomial, the polynomial, from where to where.
    """

    given: bool
    where: tuple[str, ...]
    values: tuple[tuple[str, str], ...]
    root: tuple[str, ...]
    steps: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True)
class Duplicate(NotebookTable):
    """`name` shows what `kept` shows, for all values of the verdict's domain but special ones where
    the verdict leaves such out.

    `formulas`: values of the duplicate in those of the kept model, one piece for each set of
    conditions on these; none where no formula is known. Then there are values all the same.
    """

    kept: str
    name: str
    verdict: Verdict
    formulas: tuple[Assignment, ...]

    def __repr__(self) -> str:
        return summary(self, f"{self.name} is {self.kept}, {plural(len(self.formulas), 'formula')}")

    def to_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON."""
        return {
            "name": self.name,
            "sentence": self.verdict.sentence,
            "certainty": self.verdict.certainty,
            "formulas": [
                {
                    "steps": list(map(list, f.steps)),
                    "where": list(f.where),
                    "values": dict(f.values),
                    "root": dict(zip(ROOT, f.root, strict=True)) if f.root else None,
                }
                for f in self.formulas
            ],
        }


ROOT = ("name", "of", "from", "to")


@dataclass(frozen=True)
class Gate(NotebookTable):
    """Pre-fit candidate filter.

    `groups`: names of equivalent models, the one to be kept first; `duplicates`: the others of
    them; `parameters`: by name of a kept model, which of its parameters are determined over the
    domain of the decisions; `next`: by name of the kept model of a group, what to measure to
    distinguish the group.
    """

    decisions: Decisions
    groups: tuple[tuple[str, ...], ...]
    duplicates: tuple[Duplicate, ...]
    parameters: Mapping[str, Identified]
    next: Mapping[str, AnyMenu]

    def __repr__(self) -> str:
        the_text = f"{plural(len(self.decisions.subjects), 'model')}, {len(self.kept)} kept"
        return summary(self, the_text)

    @property
    def kept(self) -> tuple[str, ...]:
        """Models that are to be fitted, in the order given: one of each group, and the others."""
        return tuple(self.parameters)

    @property
    def not_separate(self) -> tuple[tuple[str, str], ...]:
        """Pairs of kept models that are the same for some values, or undecided."""
        names = [s.name for s in self.decisions.subjects]
        places = [names.index(name) for name in self.kept]
        apart = Relation.DISTINGUISHABLE
        return tuple(
            (names[i], names[j])
            for at, i in enumerate(places)
            for j in places[at + 1 :]
            if self.decisions.relation(i, j) is not apart
        )

    def to_dict(self) -> dict[str, Any]:
        """Plain data, ready for JSON."""
        names = [s.name for s in self.decisions.subjects]
        same = {
            group[0]: [d.to_dict() for d in self.duplicates if d.kept == group[0]]
            for group in self.groups
        }
        pairs = [(names.index(a), names.index(b)) for a, b in self.not_separate]
        return {
            "format": Format.GATE.value,
            "domain": self.decisions.query.view.domain.value,
            "models": names,
            "kept": [
                {
                    "name": name,
                    "parameters": {p: level.value for p, level in identifiability.levels.items()},
                    "sentence": identifiability.sentence,
                    "same": same.get(name, []),
                    "next": to_dict(self.next[name]) if name in self.next else None,
                }
                for name, identifiability in self.parameters.items()
            ],
            "not_separate": [
                {
                    "left": names[i],
                    "right": names[j],
                    "relation": self.decisions.relation(i, j).value,
                    "sentence": self.decisions.verdict(i, j).sentence,
                }
                for i, j in pairs
            ],
        }


@renamed(costs="cost")
def gate(
    models: Sequence[Given],
    *,
    domain: Domain | str | None = None,
    query: Query | None = None,
    cost: Costs | Mapping[str, float] | str | None = None,
    engine: Engine | None = None,
) -> Gate:
    """Select the models that are worth a fit: chains, networks or texts for them, models.

    Of models that are the same over positive values (or in the domain of the query) the one with
    the fewest parameters is kept, among those the first. Two models that are no chains have one
    number of inputs and outputs. `domain`: "complex", "real" or "positive" parameters; `cost` of
    experiments, as of `next_experiments`. The next measurement is given where a group consists of
    networks of one kind, or of chains of one size. Raises InputError.

    >>> found = gate(["R0-p(R1,C1)", "p(R0,R1-C1)", "R0-p(R1,C1)-p(R2,C2)"])
    >>> found.kept
    ('R0-p(R1,C1)', 'R0-p(R1,C1)-p(R2,C2)')
    >>> dict(found.duplicates[0].formulas[0].values)["R1"]
    '(R0**2 + R0*R1)/R1'
    """
    asked, engine = asked_of(query, engine, domain)
    listed = of_type(models, Iterable, "the models are a list of models")
    made = [_number(model_of(m), m, i) for i, m in enumerate(listed, 1)]
    again = [m.name for i, m in enumerate(made) if m.name in {x.name for x in made[:i]}]
    if again or not made:
        raise InputError(
            f"two models are called {enumeration(again[:1])}: give each its own name"
            if again
            else "there are no models"
        )
    refuse_ports(made)
    wanted, costs = asked if query else replace(asked, inclusion=False), as_costs(cost)
    subjects = engine.general_subjects(made)
    decided, matched = engine.decisions(subjects, wanted), [s.subject for s in subjects]
    sizes = [len(m.parameters) for m in made]
    groups = [tuple(sorted(g, key=lambda i: (sizes[i], i))) for g in decided.classes()]
    dropped = {i for group in groups for i in group[1:]}
    kept, domain = [m for i, m in enumerate(made) if i not in dropped], wanted.view.domain
    menus = {made[g[0]].name: _menu([made[i] for i in g], engine, costs) for g in groups}
    return Gate(
        decided,
        tuple(tuple(made[i].name for i in group) for group in groups),
        tuple(duplicate(decided, matched, g[0], i) for g in groups for i in g[1:]),
        {m.name: f for m, f in zip(kept, identify(kept, domain, engine), strict=True)},
        {name: menu for name, menu in menus.items() if menu},
    )


def _number(model: AnyModel, given: Given, number: int) -> AnyModel:
    """A state space that is given as matrices with its number in the list; others as they are."""
    return replace(model, name=f"{model.name} {number}") if isinstance(given, tuple) else model


def model_of(model: Given) -> AnyModel:
    """The model that a chain, a network or a text for them is, or the model itself; raises
    InputError.
    """
    if isinstance(model, str):
        model = network_of(model) if notations_of(model) else read_together([model])[0]
    return given_model(model)


def duplicate(decided: Decisions, made: Sequence[AnyModel], kept: int, other: int) -> Duplicate:
    """One of some models as another one that it is the same as, both by their places, with the
    formulas that are known.
    """
    verdict = decided.verdict(kept, other)
    domain = decided.query.view.domain
    left, right = made[kept], made[other]
    formulas = _formulas(left, right, verdict, domain)
    return Duplicate(left.name, right.name, verdict, formulas)


def _formulas(
    left: AnyModel, right: AnyModel, verdict: Verdict, domain: Domain
) -> tuple[Assignment, ...]:
    """By names; of small models by their equations; of others by the parts they are made of."""
    named = _assignments(by_name(left, right, verdict))
    if named or len(right.parameters) > MOST_SOLVED:
        return named or _by_parts(left, right)
    the_way = way(left, right, domain)
    formulas = tuple(of_way(True, the_way)) if the_way else ()
    if not fit(Explicit(domain.value, formulas), left, right):
        raise ContradictionError(f"the formulas from {left.name} to {right.name} are wrong")
    return tuple(Assignment(*f) for f in formulas) or _by_parts(left, right)


def _by_parts(left: AnyModel, right: AnyModel) -> tuple[Assignment, ...]:
    model, two = on_one_variable([left, right])
    try:
        first = by_parts(model, two)[0]
    except NoFormulas:
        return ()
    return _assignments([confirm(first, model, two)])


def _assignments(forms: Iterable[ClosedForm]) -> tuple[Assignment, ...]:
    return tuple(
        Assignment(True, (), tuple((n, text(x)) for n, x in f.values), (), f.named) for f in forms
    )


def _menu(models: Sequence[AnyModel], engine: Engine, costs: Costs) -> AnyMenu | None:
    """Menu of further measurements, where all are networks of one kind or chains of one size."""
    chains = [as_chain(m) for m in models]
    pairs = list(zip(models, chains, strict=True))
    structures = chains if all(chains) else [m.network or chain for m, chain in pairs]
    named = [(m.name, s) for m, s in zip(models, structures, strict=True) if s]
    try:
        return menu_for(named, engine, costs=costs) if len(named) == len(models) else None
    except InputError:  # no menu in common
        return None
