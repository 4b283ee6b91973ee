"""The brief search of a large family: of networks that give the same functions one is asked about,
the others have it from that one; pairs of which parts tell something are not searched (see
`disting.general.parts`).
"""

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from itertools import combinations, groupby

from disting.conditions.finding import Finding
from disting.evidence.kind import Labels
from disting.general.forms import BRIEFLY, carried, of_part
from disting.general.model_side import ComparedModel, positive_question
from disting.general.parts import parts_of
from disting.general.replacement import simplest_network
from disting.network.simplest import same_drawing
from disting.verdict.decisions import Decisions, Pair
from disting.verdict.engine import Engine, Progress
from disting.verdict.result import Relation


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
    standing = standing_for(sides)
    same = [pair for pair in same_pairs(over_complex, len(sides)) if _is_searched(sides, *pair)]
    pairs = sorted({in_order(standing[i], standing[j]) for i, j in same})
    asked = {(i, j): positive_question(sides[i], sides[j])[1] for i, j in pairs if i < j}
    parts = _known_parts(sides, standing)
    answers, told = dict[Pair, Finding](), dict[Pair, Finding]()

    def size(pair: Pair) -> int:
        """Parameters of both: parts have fewer, so they are asked about before the whole."""
        return sum(len(sides[i].subject.parameters) for i in pair)

    for _, layer in groupby(sorted(asked, key=size), key=size):
        open_ = list[Pair]()
        for pair in layer:
            found = next(_of_parts(sides, parts, answers, *pair), None)
            if found is None:
                open_.append(pair)
            else:
                told[pair] = found
        engine.answer_all(BRIEFLY, [asked[p] for p in open_], executor=executor, progress=progress)
        answers |= {p: engine.answer(BRIEFLY, asked[p], engine.settings) for p in open_}
    for i, j in same:
        a, b = standing[i], standing[j]
        if a == b:
            continue  # a theorem tells it
        found = _ordered(told if in_order(a, b) in told else answers, a, b)
        if (a, b) != (i, j):
            found = carried(found, sides[a].name, sides[b].name)
        question, models = positive_question(sides[i], sides[j])
        engine.remember(question, models, found)


def _ordered(answers: Mapping[Pair, Finding], i: int, j: int) -> Finding:
    return answers[i, j] if i < j else answers[j, i].turned


def _known_parts(
    sides: Sequence[ComparedModel], standing: Sequence[int]
) -> dict[int, list[tuple[Labels, int]]]:
    """Of each network that stands for others: names of elements that can be left out, and the
    network that stands for the rest.
    """
    numbers = {form: i for i in standing if (form := simplest_network(sides[i].subject))}
    found = dict[int, list[tuple[Labels, int]]]()
    for i in {*standing}:
        every = [(names, simplest_network(p)) for names, p in parts_of(sides[i].subject)]
        found[i] = [(names, numbers[form]) for names, form in every if form in numbers]
    return found


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
                found = carried(_ordered(answers, a, b), sides[a].name, sides[b].name)
                told = of_part(found, left_is_part, missing)
                if told is not None:
                    yield told


def standing_for(sides: Sequence[ComparedModel]) -> list[int]:
    """For each the number of the network that stands for it: of those that give the same, one that
    is no chain and a simplest one, if there is one.
    """
    forms = [simplest_network(s.subject) for s in sides]

    def order(i: int) -> tuple[bool, bool, int]:
        """The smallest is the one that is asked about."""
        network, form = sides[i].subject.network, forms[i]
        plain = network is not None and form is not None and same_drawing(network, form)
        return sides[i].chain is not None, not plain, i

    found = dict[object, int]()
    for i in sorted(range(len(sides)), key=order):
        found.setdefault(forms[i] or i, i)
    return [found[form or i] for i, form in enumerate(forms)]


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
