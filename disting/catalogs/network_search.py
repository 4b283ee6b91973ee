"""The brief search of a large family: of networks that give the same functions one is asked about,
the others have it from that one; pairs of which parts tell something are not searched (see
`disting.general.parts`).
"""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from itertools import combinations, groupby

from disting.conditions.finding import Finding
from disting.evidence.kind import Labels
from disting.general.forms import BRIEFLY, of_equals, of_part
from disting.general.model_side import ComparedModel, positive_question
from disting.general.parts import parts_of
from disting.general.plain_maps import PLAIN_MAPS
from disting.general.replacement import simplest_network
from disting.network.simplest import same_drawing
from disting.verdict.decisions import Decisions, Pair
from disting.verdict.engine import Engine, Progress
from disting.verdict.result import Relation

MOST = 9  # parameters of networks whose parts are looked at


def search_in_brief(
    engine: Engine,
    sides: list[ComparedModel],
    over_complex: Decisions,
    executor: Executor | None,
    progress: Progress,
) -> None:
    """Let the engine know what a brief search tells of each pair, in place of a long one; of
    networks that give the same one is asked about.
    """
    own = representatives(sides)
    same = [pair for pair in same_pairs(over_complex, len(sides)) if _is_searched(sides, *pair)]
    pairs = sorted({in_order(own[i], own[j]) for i, j in same})
    questions = {(i, j): positive_question(sides[i], sides[j])[1] for i, j in pairs if i < j}
    parts = _representatives_of_parts(sides, own)
    answers, by_parts = dict[Pair, Finding](), dict[Pair, Finding]()

    def size(pair: Pair) -> int:
        """Parameters of both: parts have fewer, so they are asked about before the whole."""
        return sum(len(sides[i].subject.parameters) for i in pair)

    for _, layer in groupby(sorted(questions, key=size), key=size):
        whole = list[Pair]()
        for pair in layer:
            finding = next(_of_parts(sides, parts, answers, *pair), None)
            if finding is None:
                whole.append(pair)
            else:
                by_parts[pair] = finding
        engine.answer_all(
            BRIEFLY, [questions[p] for p in whole], executor=executor, progress=progress
        )
        answers |= {p: engine.answer(BRIEFLY, questions[p], engine.settings) for p in whole}
    for i, j in same:
        a, b = own[i], own[j]
        if a == b:
            continue  # a theorem tells it
        finding = _ordered(by_parts if in_order(a, b) in by_parts else answers, a, b)
        if (a, b) != (i, j):
            finding = of_equals(finding, sides[a].name, sides[b].name)
        question, models = positive_question(sides[i], sides[j])
        if question is not PLAIN_MAPS:  # a theorem tells it
            engine.remember(question, models, finding)


def _ordered(answers: Mapping[Pair, Finding], i: int, j: int) -> Finding:
    return answers[i, j] if i < j else answers[j, i].turned


def _representatives_of_parts(
    sides: Sequence[ComparedModel], own: Sequence[int]
) -> dict[int, list[tuple[Labels, int]]]:
    """Of each network that stands for others: names of elements that can be left out, and the
    network that stands for the rest; of large ones, which have thousands of parts, none.
    """
    numbers = {form: i for i in own if (form := simplest_network(sides[i].subject))}
    parts = dict[int, list[tuple[Labels, int]]]()
    for i in {*own}:
        whole = sides[i].subject
        tried = parts_of(whole) if len(whole.parameters) <= MOST else ()
        every = [(names, simplest_network(part)) for names, part in tried]
        parts[i] = [(names, numbers[form]) for names, form in every if form in numbers]
    return parts


def _of_parts(
    sides: Sequence[ComparedModel],
    parts: Mapping[int, Sequence[tuple[Labels, int]]],
    answers: Mapping[Pair, Finding],
    i: int,
    j: int,
) -> Iterator[Finding]:
    """Yield what answers on parts of two networks tell of both."""
    for left_is_part, whole in ((True, i), (False, j)):
        for missing, part in parts[whole]:
            a, b = (part, j) if left_is_part else (i, part)
            if in_order(a, b) in answers:
                inner = of_equals(_ordered(answers, a, b), sides[a].name, sides[b].name)
                finding = of_part(inner, left_is_part, missing)
                if finding is not None:
                    yield finding


def representatives(sides: Sequence[ComparedModel]) -> list[int]:
    """For each the number of the network that stands for it: of those that give the same, one that
    is no chain and a simplest one, if there is one.
    """
    forms = [simplest_network(s.subject) for s in sides]

    def order(i: int) -> tuple[bool, bool, int]:
        """The smallest is the one that is asked about."""
        network, form = sides[i].subject.network, forms[i]
        plain = network is not None and form is not None and same_drawing(network, form)
        return sides[i].chain is not None, not plain, i

    first = dict[object, int]()
    for i in sorted(range(len(sides)), key=order):
        first.setdefault(forms[i] or i, i)
    return [first[form or i] for i, form in enumerate(forms)]


def _is_searched(sides: Sequence[ComparedModel], i: int, j: int) -> bool:
    """Whether one of them is no chain: chains have their own ways."""
    return sides[i].chain is None or sides[j].chain is None


def in_order(i: int, j: int) -> Pair:
    """Both, the smaller one first."""
    return (i, j) if i < j else (j, i)


def same_pairs(over_complex: Decisions, count: int) -> Iterator[Pair]:
    """Yield the pairs that are not told apart over complex parameters."""
    for i, j in combinations(range(count), 2):
        if over_complex.relation(i, j) is not Relation.DISTINGUISHABLE:
            yield i, j
