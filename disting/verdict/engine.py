"""Settings and cache around the pure functions: chain -> profile, pair -> verdict, list ->
decisions.

Keys are SHA-256 of the content: the question, the structure, with which settings, by which code. So
nothing is ever invalidated; what changes has another key. Every finished profile is stored at once,
so a run that is killed resumes there.

An engine is passed to much code that does not use it: a fit whose candidates have shipped verdicts,
a command that looks one up. So what decides on chains, general models and machines, two hundred
modules, is imported by the method that needs it.

All that leaves the engine is read from the text that is stored, whether it was there or has just
been written: an answer does not depend on earlier questions.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeVar

from disting.algebra.certainty import full_text
from disting.behaviour.profile import Profile, profile, profile_from_json, profile_to_json
from disting.behaviour.sample import Representation
from disting.model.chain import Chain
from disting.model.presentation import summary
from disting.model.protocol import Model
from disting.model.question import Models, Question, Settings
from disting.model.symmetry import canonical, refuse_gap_damper
from disting.store.scheduling import map_tasks as map_tasks
from disting.store.store import Store, digest
from disting.verdict.result import Query, Verdict

if TYPE_CHECKING:
    from disting.conditions.side import AnySide
    from disting.experiments.experiment import MeasuredChain
    from disting.experiments.machine_side import ComparedMachine
    from disting.general.matrix_model import AnyModel
    from disting.general.model_side import ComparedModel
    from disting.network.network import Network
    from disting.questions.identifiability.answer import Identifiability
    from disting.verdict.chain_side import ComparedChain
    from disting.verdict.decisions import Decisions

T = TypeVar("T")
Progress = Callable[[str, int, int], None]
"""Told what is done, how much of it is finished, and how much there is."""
# structures a task: large enough to be worth a message, small enough that a kill loses little
BATCH = 8


def silent(what: str, done: int, total: int) -> None:
    """Progress that nobody watches."""


@dataclass
class Engine:
    """Compares models with a store behind it; what is computed once in a process is kept in
    `memo` and `answers`.

    >>> from disting import Store, compare
    >>> with Store.open(":memory:") as store:
    ...     engine = Engine(store=store)
    ...     [compare("3:1", other, engine=engine).relation.value for other in ("A4", "A11")]
    ['distinguishable', 'indistinguishable']
    """

    settings: Settings = field(default_factory=Settings)
    store: Store = field(default_factory=lambda: Store.open(""))
    memo: dict[str, Profile] = field(default_factory=dict)
    answers: dict[str, Any] = field(default_factory=dict)

    def __repr__(self) -> str:
        return summary(self, f"seed {self.settings.seed!r}, {self.store!r}")

    def subject(self, name: str, chain: Chain, note: str = "") -> ComparedChain:
        """A side of a comparison whose profiles come from this engine; `note` gives the names of
        its parameters in the equal network.
        """
        from disting.verdict.chain_side import ComparedChain

        return ComparedChain(name, chain, self.settings, self.profile, self.answer, note)

    def general_subjects(
        self,
        models: Sequence[AnyModel | Network],
        names: Sequence[str] = (),
        experiments: Sequence[tuple[str, ...]] = (),
    ) -> list[ComparedModel]:
        """The same for general models and networks that are compared with each other, all in one
        variable; `experiments` in words that each is the transfer functions of, none: as it is.
        """
        from disting.general.any_model import as_model, on_one_variable
        from disting.general.model_side import ComparedModel
        from disting.general.network_model import behaviour_of
        from disting.general.readings import normalise

        def profile_of(model: AnyModel) -> Profile:
            """That of its transfer functions."""
            return self.profile(behaviour_of(model), Representation.TF, 0, self.settings)

        plain = list(map(as_model, models))
        matched = [normalise(model, profile_of) for model in on_one_variable(plain)]
        ways = experiments or [()] * len(matched)
        named = zip(names or [m.name for m in models], matched, ways, strict=True)
        return [
            ComparedModel(name, model, self.settings, self.profile, self.answer, way)
            for name, model, way in named
        ]

    def measured_subject(self, name: str, measured: MeasuredChain) -> ComparedMachine:
        """The same for a chain under several experiments. Raises InputError for one with a damper
        across the gap.
        """
        from disting.experiments.machine_side import ComparedMachine

        refuse_gap_damper(measured.chain)
        return ComparedMachine(name, measured, self.settings, self.profile, self.answer)

    def profile(
        self, what: Model, representation: Representation, count: int, settings: Settings
    ) -> Profile:
        """The profile, from memory, from the store, or computed and stored."""
        key = profile_key(what, representation, count, settings)
        if key not in self.memo:
            texts = self.store.get_many([key])
            if key not in texts:
                made = profile(what, representation, count, settings)
                texts = {key: profile_to_json(made)}
                self.store.put_many(texts)
            self.memo[key] = profile_from_json(texts[key])
        return self.memo[key]

    def answer(self, question: Question[T], models: Models, settings: Settings) -> T:
        """The answer, from memory, from the store, or computed and stored."""
        key = question_key(question, models, settings)
        if key not in self.answers:
            self.answer_all(question, [models])
        remembered: T = self.answers[key]
        return remembered

    def remember(self, question: Question[T], models: Models, answer: T) -> None:
        """Take over an answer that is known already, such as a catalogue's; it is not stored."""
        self.answers[question_key(question, models, self.settings)] = answer

    def verdict(
        self, left: AnySide, right: AnySide, query: Query, *, audited: bool = False
    ) -> Verdict:
        """The verdict on a pair, from the store or decided and stored; an audited one is always
        computed.
        """
        from disting.verdict.cascade import audit, decide

        if audited:
            return _read_back(json.dumps(audit(left, right, query).to_dict()))
        content = [*left.content, *right.content, full_text(query), self.settings.to_dict()]
        key = _key("verdict", *map(str, content))
        texts = self.store.get_many([key])
        if key not in texts:
            texts = {key: json.dumps(decide(left, right, query).to_dict())}
            self.store.put_many(texts)
        return _read_back(texts[key])

    def decisions(
        self,
        subjects: Sequence[AnySide],
        query: Query,
        *,
        executor: Executor | None = None,
        progress: Progress = silent,
    ) -> Decisions:
        """All pairs of models, of one size or several; the executor's workers compute what is
        needed. Models that are chains are compared as chains with each other.
        """
        from disting.verdict.all_pairs import decisions
        from disting.verdict.decisions import Part

        def prefetch(wanted: Sequence[AnySide], r: Representation, count: int) -> None:
            """Have the profiles of these models computed, many at a time."""
            self.prefetch({s.profiled for s in wanted}, r, count, executor, progress)

        def ask(question: Question[Any], pairs: Sequence[Models]) -> None:
            """Have the question answered for these pairs, many at a time."""
            self.answer_all(question, pairs, executor=executor, progress=progress)

        chains = {
            place: self.subject(s.name, s.chain, s.chain_note)
            for place, s in enumerate(subjects)
            if s.chain is not None and s.chain is not s.subject
        }
        if len(chains) < 2:
            return decisions(subjects, query, prefetch, ask)
        part = decisions(list(chains.values()), query, prefetch, ask)
        if len(chains) == len(subjects):
            return part
        whole = decisions(subjects, query, prefetch, ask, apart=list(chains))
        return whole.with_part(Part(part, tuple(chains)))

    def profiles_of(
        self,
        chains: Iterable[Chain],
        *,
        markov: int = 0,
        executor: Executor | None = None,
        progress: Progress = silent,
    ) -> list[Profile]:
        """Profiles of chains, in order: of the transfer functions, or of the `markov` Markov
        parameters after G_0.
        """
        r = Representation.MARKOV if markov else Representation.TF
        subjects = [self.subject("", chain) for chain in chains]
        profiled: set[Model] = {s.profiled for s in subjects}
        self.prefetch(profiled, r, markov, executor, progress)
        return [s.profile(r, markov) for s in subjects]

    def identifiabilities(
        self,
        chains: Sequence[Chain],
        *,
        executor: Executor | None = None,
        progress: Progress = silent,
    ) -> list[Identifiability]:
        """Identifiability of chains, in order; each canonical form is computed once."""
        from disting.questions.identifiability.analysis import IDENTIFIABILITY, in_names_of

        formed = [(chain, canonical(chain)) for chain in chains]
        self.answer_all(
            IDENTIFIABILITY,
            [(form.chain,) for _, form in formed],
            executor=executor,
            progress=progress,
        )
        return [
            in_names_of(self.answer(IDENTIFIABILITY, (form.chain,), self.settings), form, chain)
            for chain, form in formed
        ]

    def prefetch(
        self,
        what: set[Model],
        r: Representation,
        count: int,
        executor: Executor | None,
        progress: Progress,
    ) -> None:
        """Bring the profiles of these models into memory: from the store, the rest computed,
        each batch stored at once.
        """
        keys = {profile_key(s, r, count, self.settings): s for s in sorted(what, key=full_text)}
        self.memo |= self._load_profiles([key for key in keys if key not in self.memo])
        missing = [key for key in keys if key not in self.memo]
        done = len(keys) - len(missing)
        absent = [keys[k] for k in missing]
        batches = [
            (absent[i : i + BATCH], r, count, self.settings) for i in range(0, len(absent), BATCH)
        ]
        for _, batch in map_tasks(compute, batches, executor):
            texts = {profile_key(s, r, count, self.settings): text for s, text in batch}
            self.store.put_many(texts)
            self.memo |= {key: profile_from_json(text) for key, text in texts.items()}
            done += len(batch)
            progress(f"{r.value} profiles", done, len(keys))

    def answer_all(
        self,
        question: Question[Any],
        asked: Sequence[Models],
        *,
        executor: Executor | None = None,
        progress: Progress = silent,
    ) -> None:
        """Bring answers into memory, as `prefetch` does with profiles."""
        keys = {question_key(question, models, self.settings): models for models in asked}
        stored = self.store.get_many([key for key in keys if key not in self.answers])
        self.answers |= {key: question.decode(text) for key, text in stored.items()}
        missing = {key: models for key, models in keys.items() if key not in self.answers}
        done = len(keys) - len(missing)
        asked_for = {models: key for key, models in missing.items()}
        tasks = [(question, models, self.settings) for models in asked_for]
        for (_, models, _), text in map_tasks(compute_answer, tasks, executor):
            key = asked_for[models]
            self.store.put_many({key: text})
            self.answers[key] = question.decode(text)
            done += 1
            progress(question.name, done, len(keys))

    def _load_profiles(self, keys: list[str]) -> dict[str, Profile]:
        return {key: profile_from_json(text) for key, text in self.store.get_many(keys).items()}


def profile_key(what: Model, r: Representation, count: int, settings: Settings) -> str:
    """Content address of a profile."""
    return _key("profile", full_text(what), r.value, str(count), full_text(settings))


def question_key(question: Question[Any], models: Models, settings: Settings) -> str:
    """Content address of an answer."""
    return _key(question.name, *map(full_text, models), full_text(settings))


def compute(
    batch: Sequence[Model], r: Representation, count: int, settings: Settings
) -> list[tuple[Model, str]]:
    """A task for a worker: profiles as JSON text."""
    return [(what, profile_to_json(profile(what, r, count, settings))) for what in batch]


def compute_answer(question: Question[Any], models: Models, settings: Settings) -> str:
    """A task for a worker: one answer as text."""
    return question.encode(question.answer(*models, settings))


def _read_back(text: str) -> Verdict:
    return Verdict.from_dict(json.loads(text))


def _key(*content: str) -> str:
    return hashlib.sha256("\0".join((digest(__name__), *content)).encode()).hexdigest()
