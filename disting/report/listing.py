"""A list of models that is shown: general models or networks with the verdicts on all pairs, how
each is called, drawn, and what it determines.
"""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, permutations

from disting.equivalence.reach import REACHED, Reach
from disting.errors import InputError
from disting.general import AnyModel, Model, ModelList, without_names
from disting.general.global_identifiability import IDENTIFIABILITY, GlobalIdentifiability
from disting.general.model_side import ComparedModel
from disting.general.special_values import SpecialValues, special_values
from disting.model.presentation import plural
from disting.model.question import Domain
from disting.network.notation import network_of, notations_of
from disting.questions.identifiability.parts import Level
from disting.report.drawing import Drawing
from disting.report.network_drawing import draw_network, scene_of
from disting.report.payload import VIEWS, Over, over
from disting.report.words import sets_in_words
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.identifiable import Identified, identify
from disting.verdict.result import Query, Relation, Verdict, View


@dataclass(frozen=True, slots=True)
class JudgedList:
    """Models with the decisions on all pairs, in each of VIEWS; models are counted from 1."""

    family: tuple[AnyModel, ...]
    decisions: Mapping[View, Decisions]
    identifiabilities: tuple[GlobalIdentifiability, ...]
    over_positive: tuple[Identified, ...]
    conditions: Mapping[tuple[int, int], Reach]

    def relation(self, left: int, right: int, view: View) -> Relation:
        """Relation of two models."""
        return self.decisions[view].relation(left - 1, right - 1)

    def verdict(self, left: int, right: int, view: View) -> Verdict:
        """The verdict with its evidence."""
        return self.decisions[view].verdict(left - 1, right - 1)

    def reached(self, number: int, other: int) -> Reach | None:
        """Positive values of the one model that have equivalents in the other one, where only some
        have, and the conditions are short.
        """
        return self.conditions.get((number, other))

    def at_special_values(self, left: int, right: int) -> SpecialValues | None:
        """Relation at special values of two models that are equivalent for almost all positive
        values; None where they are not, and where the verdict excludes none.
        """
        verdict = self.verdict(min(left, right), max(left, right), View.POSITIVE)
        if verdict.relation is not Relation.INDISTINGUISHABLE or not verdict.has_exceptions:
            return None
        return special_values(self.family[left - 1], self.family[right - 1])

    def said_of(self, low: int, high: int, view: View) -> str:
        """Sentence on the part of each of two models that the other one reaches, {L} being the
        first one.
        """
        if view is not View.POSITIVE:
            return ""
        special = self.at_special_values(low, high)
        if special:
            return special.sentence("{L}", "{R}")
        named = ((low, high), "{L}", "{R}"), ((high, low), "{R}", "{L}")
        sentences = (
            reach.sentence(*names) for pair, *names in named if (reach := self.reached(*pair))
        )
        return " ".join(filter(None, sentences))

    def pairs(self, view: View) -> Iterator[tuple[int, int, Verdict]]:
        """All pairs, left < right."""
        for left, right in combinations(range(1, len(self.family) + 1), 2):
            yield left, right, self.verdict(left, right, view)

    def classes(self, view: View) -> tuple[tuple[int, ...], ...]:
        """Groups of two or more mutually indistinguishable models."""
        return tuple(tuple(i + 1 for i in g) for g in self.decisions[view].classes())

    def depending(self, view: View) -> tuple[tuple[int, int], ...]:
        """The pairs that are indistinguishable for some parameters only."""
        pairs = combinations(range(1, len(self.family) + 1), 2)
        return tuple(p for p in pairs if self.relation(*p, view) is Relation.SOMETIMES)


@dataclass(frozen=True)
class NamedDrawing(Drawing):
    """The drawing of a model that is called otherwise than by its number."""

    name: str

    @property
    def label(self) -> str:
        """Description of the drawing in words."""
        return f"{self.name}: {self.scene.title}"


@dataclass(frozen=True, slots=True)
class Card:
    """Card of a model: its name, its drawing if any, the parameters determined over complex and
    over positive parameters, and in each of VIEWS the number of its group, or 0.
    """

    number: int
    label: str
    model: AnyModel
    drawing: NamedDrawing | None
    known: GlobalIdentifiability
    over_positive: Identified
    groups: tuple[int, ...]

    @property
    def name(self) -> str:
        """Its own name, where it is called by a number."""
        return self.model.name if self.label != self.model.name else ""

    @property
    def sets(self) -> str:
        """Number of positive parameter vectors with the same behaviour."""
        return sets_in_words(self.over_positive)

    @property
    def is_same_over_complex(self) -> bool:
        """True if all parameters have one value, over complex parameters as well."""
        found = self.over_positive
        return found.level is Level.GLOBAL and found.over_complex is None

    @property
    def degrees(self) -> str:
        """Of its transfer function, or how many it has."""
        if isinstance(self.model, Model):
            above, below = self.model.degrees
            return f"{above} over {below}"
        outputs, inputs = self.model.shape
        return f"{plural(outputs, 'output')}, {plural(inputs, 'input')}"


@dataclass(frozen=True)
class Listing:
    """Content of a page: models and verdicts, the title, the name of the page without its
    suffix.
    """

    found: JudgedList
    title: str
    name: str

    @cached_property
    def numbered(self) -> bool:
        """True if models are called A1, A2, ..: where their names are texts of networks, which are
        long and which commands read.
        """
        return all(map(_is_named_by_its_text, self.found.family))

    @property
    def folder(self) -> str:
        """Where the pages of the models are, as seen from the page of the list."""
        return f"models/{self.name}"

    def label(self, number: int) -> str:
        """Name of a model on the page."""
        return f"A{number}" if self.numbered else self.found.family[number - 1].name

    @cached_property
    def domains(self) -> tuple[Over, ...]:
        """Content of the page over each domain."""
        return tuple(over(self.found, view) for view in VIEWS)

    @cached_property
    def cards(self) -> tuple[Card, ...]:
        """The models."""
        return tuple(map(self._card, range(1, len(self.found.family) + 1)))

    def _card(self, number: int) -> Card:
        model, label = self.found.family[number - 1], self.label(number)
        # drawings of a family are of one style, whichever of its networks are chains
        scene = draw_network(model.network) if self.numbered and model.network else scene_of(model)
        groups = tuple(
            next((k for k, g in enumerate(of.groups, 1) if number in g), 0) for of in self.domains
        )
        return Card(
            number=number,
            label=label,
            model=model,
            drawing=NamedDrawing(number, scene, label) if scene else None,
            known=self.found.identifiabilities[number - 1],
            over_positive=self.found.over_positive[number - 1],
            groups=groups,
        )


def judge(
    the_models: ModelList,
    engine: Engine,
    *,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> JudgedList:
    """Decide all pairs over positive and over complex parameters, and what is identifiable."""
    subjects = engine.general_subjects(the_models.models)
    decided = {
        view: engine.decisions(
            subjects, Query(view, inclusion=False), executor=executor, progress=progress
        )
        for view in VIEWS
    }
    tasks = [(without_names(subject.subject),) for subject in subjects]
    engine.answer_all(IDENTIFIABILITY, tasks, executor=executor, progress=progress)
    global_identifiabilities = tuple(
        engine.answer(IDENTIFIABILITY, models, engine.settings) for models in tasks
    )
    over_positive = identify(
        [s.subject for s in subjects], Domain.POSITIVE, engine, executor=executor, progress=progress
    )
    conditions = _conditions(subjects, decided[View.POSITIVE], engine, executor, progress)
    return JudgedList(
        the_models.models, decided, global_identifiabilities, tuple(over_positive), conditions
    )


def _conditions(
    subjects: Sequence[ComparedModel],
    over_positive: Decisions,
    engine: Engine,
    executor: Executor | None,
    progress: Progress,
) -> dict[tuple[int, int], Reach]:
    """Of the pairs that are the same for some positive values, both ways."""
    needed = {
        (i + 1, j + 1): (without_names(subjects[i].subject), without_names(subjects[j].subject))
        for i, j in permutations(range(len(subjects)), 2)
        if over_positive.relation(*sorted((i, j))) is Relation.SOMETIMES
    }
    engine.answer_all(REACHED, list(needed.values()), executor=executor, progress=progress)
    reaches = {pair: engine.answer(REACHED, m, engine.settings) for pair, m in needed.items()}
    return {pair: reach for pair, reach in reaches.items() if reach}


def _is_named_by_its_text(model: AnyModel) -> bool:
    if model.network is None or not notations_of(model.name):
        return False
    try:
        return network_of(model.name) == model.network
    except InputError:
        return False
