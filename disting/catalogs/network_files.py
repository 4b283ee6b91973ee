"""Shipped results of long computations on families of networks: `disting catalog families`.

`networks-<family>.jsonl`: a header; a line a network with its parameters' identifiability and, as
`group`, the number of its class over complex parameters, 0 where it is alone; then a line a pair
that is the same there, with the verdicts over complex and over positive parameters, and `finding`
where positive equivalents were searched, which then holds the evidence. Other pairs are
distinguished by conditions or by an exact decision in milliseconds: they are decided again.

A command on a family takes the findings over, so it answers at once, and every statement has its
evidence. Families of thousands of such pairs are searched in brief: what is not decided within
small bounds is undecided in the file, and `disting compare` of the two alone goes on for longer. Of
networks that give the same functions only one is decided: a pair of others names in `as` the pair
from which it is derived, and what differs. Pairs that their parts decide are not searched (see
`disting.general.parts`).
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from itertools import chain, combinations, groupby
from pathlib import Path

from disting.catalogs.files import Record, lines
from disting.conditions.rule import ADMISSIBLE, Finding, Stage
from disting.errors import CatalogError
from disting.evidence.kind import Labels
from disting.evidence.positive import BothWays
from disting.files import intact_text, shipped_folder
from disting.general.any_model import without_names
from disting.general.forms import BRIEFLY, WAS_BRIEF, of_equals, of_part
from disting.general.identifiability import PARAMETERS
from disting.general.matrix_model import AnyModel
from disting.general.network_view import NetworkSide
from disting.general.over_domain import by_replacement, positive_question
from disting.general.parts import parts_of
from disting.general.plain_maps import PLAIN_MAPS
from disting.general.replacement import replaceable, simplest_network
from disting.model.question import Domain
from disting.network.families import FAMILIES, NetworkFamily, family_of
from disting.network.simplest import same_drawing
from disting.verdict.cascade import verdict_of
from disting.verdict.decisions import Decisions, Pair
from disting.verdict.engine import Engine, Progress, question_key, silent
from disting.verdict.result import Query, Relation, Step, Verdict, View

MOST = 9  # parameters of networks whose parts are looked at


def search_in_brief(
    engine: Engine,
    sides: list[NetworkSide],
    over_complex: Decisions,
    executor: Executor | None,
    progress: Progress,
) -> None:
    """Give the engine the results of a brief search of each pair, in place of a long one; of
    equivalent networks only one is decided.
    """
    own = representatives(sides)
    every = same_pairs(over_complex, len(sides))
    same = [(i, j) for i, j in every if _is_searched(sides, own[i], own[j])]
    pairs = sorted({in_order(own[i], own[j]) for i, j in same})
    questions = {(i, j): positive_question(sides[i], sides[j])[1] for i, j in pairs if i < j}
    parts = _representatives_of_parts(sides, own)
    answers, by_parts = dict[Pair, Finding](), dict[Pair, Finding]()

    def size(pair: Pair) -> int:
        """Parameters of both: parts have fewer, so they are decided before the whole."""
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
        finding = _order_finding(by_parts if in_order(a, b) in by_parts else answers, a, b)
        if (a, b) != (i, j):
            finding = of_equals(finding, sides[a].name, sides[b].name)
        question, models = positive_question(sides[i], sides[j])
        if question is not PLAIN_MAPS:  # a theorem tells it
            engine.remember(question, models, finding)


def _order_finding(answers: Mapping[Pair, Finding], i: int, j: int) -> Finding:
    return answers[i, j] if i < j else answers[j, i].turned


def _representatives_of_parts(
    sides: Sequence[NetworkSide], own: Sequence[int]
) -> dict[int, list[tuple[Labels, int]]]:
    """For each representative network: names of elements that can be omitted, and the network that
    represents the rest; for large ones, which have thousands of parts, none.
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
    sides: Sequence[NetworkSide],
    parts: Mapping[int, Sequence[tuple[Labels, int]]],
    answers: Mapping[Pair, Finding],
    i: int,
    j: int,
) -> Iterator[Finding]:
    """Yield the results for two networks that follow from those for their parts."""
    for left_is_part, whole in ((True, i), (False, j)):
        for missing, part in parts[whole]:
            a, b = (part, j) if left_is_part else (i, part)
            if in_order(a, b) in answers:
                inner = of_equals(_order_finding(answers, a, b), sides[a].name, sides[b].name)
                finding = of_part(inner, left_is_part, missing)
                if finding is not None:
                    yield finding


def representatives(sides: Sequence[NetworkSide]) -> list[int]:
    """For each the number of its representative: of those that give the same, one that is no chain
    and a simplest one, if there is one.
    """
    forms = [simplest_network(s.subject) for s in sides]

    def order(i: int) -> tuple[bool, bool, int]:
        """The smallest is the one that is decided."""
        network, form = sides[i].subject.network, forms[i]
        plain = network is not None and form is not None and same_drawing(network, form)
        return sides[i].chain is not None, not plain, i

    first = dict[object, int]()
    for i in sorted(range(len(sides)), key=order):
        first.setdefault(forms[i] or i, i)
    return [first[form or i] for i, form in enumerate(forms)]


def _is_searched(sides: Sequence[NetworkSide], i: int, j: int) -> bool:
    """Return True if at least one of them is not a chain: chains have deciders of their own."""
    return sides[i].chain is None or sides[j].chain is None


def in_order(i: int, j: int) -> Pair:
    """Both, the smaller one first."""
    return (i, j) if i < j else (j, i)


def same_pairs(over_complex: Decisions, count: int) -> Iterator[Pair]:
    """Yield the pairs that are not distinguished over complex parameters."""
    for i, j in combinations(range(count), 2):
        if over_complex.relation(i, j) is not Relation.DISTINGUISHABLE:
            yield i, j


SCHEMA = 1
COMMAND = "disting catalog families"
SHIPPED = tuple(name for name, family in FAMILIES.items() if family.is_shipped)
COMPLEX, POSITIVE = Query(View.EXACT, inclusion=False), Query(View.POSITIVE, inclusion=False)


def name_of(family: str) -> str:
    """Name of a file without its suffix.

    >>> name_of("circuits-4")
    'networks-circuits-4'
    """
    return f"networks-{family}"


def build_networks(
    family: NetworkFamily,
    engine: Engine,
    *,
    executor: Executor | None = None,
    progress: Progress = silent,
) -> str:
    """The text of the file of a family, computed; the bytes do not depend on the machine or the
    order of the work, but for the digits of rounded equivalents, and where what can be determined
    was not found in time (`reason`).
    """
    sides = engine.general_subjects(family.networks)
    over_complex = engine.decisions(sides, COMPLEX, executor=executor, progress=progress)
    if family.in_brief:
        search_in_brief(engine, sides, over_complex, executor, progress)
    over_positive = engine.decisions(sides, POSITIVE, executor=executor, progress=progress)
    group = {i: g for g, members in enumerate(over_complex.classes(), 1) for i in members}
    header: Record = {
        "schema": SCHEMA,
        "catalog": name_of(family.name),
        "family": family.name,
        "models": len(sides),
        "command": f"{COMMAND} {family.name}",
        "settings": engine.settings.to_dict(),
    }
    tasks = [(without_names(s.subject),) for s in sides]
    engine.answer_all(PARAMETERS, tasks, executor=executor, progress=progress)
    models = [
        {
            "model": number,
            "network": s.name,
            "group": group.get(number - 1, 0),
            "identifiability": engine.answer(PARAMETERS, model, engine.settings).to_dict(),
        }
        for number, (s, model) in enumerate(zip(sides, tasks, strict=True), 1)
    ]
    pairs = _pairs(engine, sides, over_complex, over_positive)
    if family.in_brief:
        pairs = _short(list(pairs), sides)
    return lines([header, *models, *pairs])


def _pairs(
    engine: Engine, sides: list[NetworkSide], over_complex: Decisions, over_positive: Decisions
) -> Iterator[Record]:
    """Yield the lines of the pairs that are the same over complex parameters."""
    for i, j in same_pairs(over_complex, len(sides)):
        question, models = positive_question(sides[i], sides[j])
        finding = engine.answers.get(question_key(question, models, engine.settings))
        positive = _as_networks(over_positive.verdict(i, j), sides[i], sides[j], finding)
        record: Record = {
            "left": i + 1,
            "right": j + 1,
            "complex": _verdict_record(over_complex.verdict(i, j)),
            "positive": _verdict_record(positive),
        }
        if isinstance(finding, Finding):
            record["finding"] = json.loads(finding.to_json())
            if positive.evidence == finding.evidence:  # else by a theorem
                del record["positive"]["evidence"]
        yield record


def _as_networks(
    verdict: Verdict, left: NetworkSide, right: NetworkSide, finding: object
) -> Verdict:
    """A verdict on two chains, found both ways, as one on networks: by the theorem, or by what was
    found for the pair that gives the same. A small checker follows this by the names in the file.
    """
    theorem = by_replacement(left, right)
    told = finding if theorem is None else theorem
    if not isinstance(verdict.evidence, BothWays) or not isinstance(told, Finding):
        return verdict
    step = Step(Stage.PARAMETERS, told)
    found = verdict_of(left, right, step, Domain.POSITIVE)
    return found if found.relation is verdict.relation else verdict


def _short(records: Sequence[Record], sides: Sequence[NetworkSide]) -> Iterator[Record]:
    """Yield shorter records: a result derived from another pair names that pair and the
    differences.
    """
    at = {(r["left"], r["right"]): r for r in records}
    own, names = [i + 1 for i in representatives(sides)], [s.name for s in sides]
    for (i, j), record in at.items():
        origin = own[i - 1], own[j - 1]
        base = at.get(in_order(*origin), {})
        if origin == (i, j) or not {"finding"} <= record.keys() & base.keys():
            yield record
            continue
        from_it = _of_origin(_finding(base), origin, names)
        if json.loads(from_it.to_json()) != record["finding"]:
            yield record
            continue
        differs = {x: record[x] for x in ("complex", "positive") if record[x] != base[x]}
        yield {"left": i, "right": j, "as": [*origin], **differs}


def _of_origin(finding: Finding, origin: tuple[int, int], names: Sequence[str]) -> Finding:
    """The finding of a pair that has it from these two; `finding`: that of both in order."""
    a, b = origin
    return of_equals(finding if a < b else finding.turned, names[a - 1], names[b - 1])


def _finding(record: Record) -> Finding:
    return Finding.from_json(json.dumps(record["finding"]), rule=ADMISSIBLE)


def _verdict_record(verdict: Verdict) -> Record:
    """A verdict without its models."""
    return {
        "relation": verdict.relation.value,
        "decided_by": verdict.decided_by,
        "representation": verdict.representation,
        "certainty": verdict.certainty or "",
        "safety": verdict.safety,
        "evidence": None if verdict.evidence is None else verdict.evidence.to_dict(),
    }


def recall(family: str, engine: Engine, folder: Path | None = None) -> None:
    """Let the engine know what the shipped file, or that of another folder, holds on a family and
    on its networks; nothing where there is none. Raises CatalogError for a damaged file.

    >>> recall("circuits-4", Engine())
    """
    sides, rows, records = _load_known(family, engine, folder)
    for side, r in zip(sides, rows, strict=False):
        answer = PARAMETERS.decode(json.dumps(r["identifiability"]))
        engine.remember(PARAMETERS, (without_names(side.subject),), answer)
    for r in records:
        if "finding" in r:
            question, models = positive_question(sides[r["left"] - 1], sides[r["right"] - 1])
            engine.remember(question, models, r["finding"])


def recall_open(family: NetworkFamily, records: Sequence[Record], engine: Engine) -> int:
    """Let the engine know which pairs of a file a brief search left open, so that it does not
    search them again; their number.
    """
    sides = engine.general_subjects(family.networks)
    own, count = representatives(sides), 0
    for r in records[1 + len(sides) :] if family.in_brief else ():
        i, j, finding = r["left"] - 1, r["right"] - 1, r.get("finding")
        if not isinstance(finding, Finding) or (own[i], own[j]) != (i, j):
            continue
        if finding.note.endswith(WAS_BRIEF):
            engine.remember(BRIEFLY, positive_question(sides[i], sides[j])[1], finding)
            count += 1
    return count


def recall_of(model: AnyModel, family: str, engine: Engine, folder: Path | None = None) -> None:
    """The same of one model that gives the same as a network of the family, such as that network
    with other numbers, and all others of the family.
    """
    sides, _, records = _load_known(family, engine, folder)
    (given,) = engine.general_subjects([model])
    form = given.view.asked_about[0]
    itself = (i for i, s in enumerate(sides, 1) if s.view.asked_about[0] == form)
    like = (i for i, s in enumerate(sides, 1) if replaceable(model, s.subject))
    own = next(chain(itself, like), 0) if records else 0
    for r in records:
        if "finding" not in r or own not in (r["left"], r["right"]):
            continue
        other = sides[r["right" if own == r["left"] else "left"] - 1]
        finding = r["finding"] if own == r["left"] else r["finding"].turned
        pair = engine.general_subjects([model, other.subject])
        question, models = positive_question(pair[0], pair[1])
        if models[0] != sides[own - 1].view.asked_about[0]:
            if question is PLAIN_MAPS:
                continue  # the map is one of the other networks
            finding = of_equals(finding, sides[own - 1].name, other.name)
        engine.remember(question, models, finding)


def _load_known(
    family: str, engine: Engine, folder: Path | None
) -> tuple[list[NetworkSide], list[Record], list[Record]]:
    """The networks of a family, and the lines of its file on them and on their pairs; none where
    there is none, or where it has other random points: results at these points do not answer the
    question.
    """
    path = (folder or shipped_folder()) / f"{name_of(family)}.jsonl"
    if not path.is_file():
        return [], [], []
    sides, records = engine.general_subjects(family_of(family).networks), read(path)
    is_asked = records[0]["settings"] == engine.settings.to_dict()
    at = 1 + len(sides)
    return (sides, records[1:at], records[at:]) if is_asked else (sides, [], [])


def _whole(records: Sequence[Record], names: Sequence[str]) -> Iterator[Record]:
    """Yield the records of pairs, what they have from others written out, findings as such."""
    at = {(r["left"], r["right"]): r for r in records}
    findings = {pair: _finding(r) for pair, r in at.items() if "finding" in r}
    for pair, r in at.items():
        if "as" not in r:
            yield r | ({"finding": findings[pair]} if pair in findings else {})
            continue
        a, b = r["as"]
        finding = _of_origin(findings[in_order(a, b)], (a, b), names)
        yield at[in_order(a, b)] | r | {"finding": finding}


def read(path: Path) -> list[Record]:
    """The records of a file, findings as such; raises CatalogError where it is damaged, of another
    schema, or of other networks than the family has.
    """
    try:
        records = [json.loads(line) for line in intact_text(path).splitlines()]
        header = records[0]
        names = [network.name for network in family_of(header["family"]).networks]
        networks = [r["network"] for r in records[1 : 1 + header["models"]]]
        if header["schema"] != SCHEMA or networks != names:
            raise ValueError("another schema, or other networks")
        for r in records[1 + len(names) :]:
            if not 0 < r["left"] < r["right"] <= len(names):
                raise ValueError(f"no pair: {r['left']}, {r['right']}")
        pairs = _whole(records[1 + len(names) :], names)
        return [*records[: 1 + len(names)], *pairs]
    except (OSError, ValueError, LookupError, TypeError) as reason:
        raise CatalogError(f"{path} cannot be read ({reason}); make it with '{COMMAND}'") from None
