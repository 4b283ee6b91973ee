"""A selection as one HTML page that needs nothing else: the result first, then why, then how
sure.
"""

from collections.abc import Sequence

from disting.files import __version__
from disting.fit.judge.alternatives import Alternative
from disting.fit.judge.candidate import Candidate
from disting.fit.judge.exclusion import LEVEL
from disting.fit.judge.explanation import largest_cost, noise_limit
from disting.fit.judge.modes import Result, physical
from disting.fit.judge.readings import read_in_words
from disting.fit.results.selection import Selection
from disting.measurement import FrequencyResponse
from disting.report.environment import render
from disting.report.fit.answer import (
    ParameterRow,
    answer,
    list_lines,
    list_structures,
    parameter_rows,
    result_row,
    with_others,
)
from disting.report.fit.convergence import hits, hits_in_words
from disting.report.fit.criteria import HEADS, columns, limits, nearest, weakest
from disting.report.fit.doubts import hold
from disting.report.fit.links import Site, next_steps
from disting.report.fit.look_alikes import exchanged, look_alike_sentences
from disting.report.fit.responses import drawing, shown_responses, with_all_sensors
from disting.report.fit.sentences import first_lines, not_in, quantity_rows, suspicions
from disting.report.fit.style import FigureFiles
from disting.report.fit.words import (
    cost_in_words,
    name,
    percent,
    readable,
    values_in_words,
)
from disting.report.words import plural, with_and
from disting.verdict.result import Relation

FIRST = 30  # rows of candidates that are shown at once
FOLDED = 4  # equivalents of one structure that are shown at once
NEAREST = 5  # candidates that are named where none is admissible
SAME = (
    "Every positive model of the selected structure is a positive model of these, and the reverse."
    " No data with this force and sensor separate them; another place for the sensor may:"
)
SOME = (
    "These have the behaviour of the selected structure for some positive parameters and not for"
    " others:"
)
OPEN = (
    "Whether these have the behaviour of the selected structure with positive parameters, within"
    " the limits, is not known:"
)
INTRODUCTIONS = {
    Relation.INDISTINGUISHABLE: SAME,
    Relation.SOMETIMES: SOME,
    Relation.UNDECIDED: OPEN,
}
ALWAYS = {
    "heads": HEADS,
    "folded": FOLDED,
    "first": FIRST,
    "name": name,
    "read_in_words": read_in_words,
    "readable": readable,
    "percent": percent,
    "plural": plural,
    "values_in_words": values_in_words,
}  # what the template uses of every selection
CERTAIN = 2  # starts that reach the best cost, at least


def fit_page(
    selection: Selection,
    results: Sequence[Result],
    figures: Sequence[FigureFiles],
    train: FrequencyResponse,
    test: FrequencyResponse | None = None,
    site: Site | None = None,
) -> str:
    """HTML of a selection; `results` and `figures` are those of the described candidate, Bode
    diagram and residuals of each response first.

    `site`: where the pages of the catalogues and the guide lie, to which structures and bar are
    linked.
    """
    if selection.question:
        return _question_page(selection, train, test, site)
    candidate, rows = selection.described, _results(selection, results, train)
    members = list_structures(selection, train, site)
    shown = shown_responses(selection, train, test, figures)
    return render(
        "fit.html",
        selection=selection,
        candidate=candidate,
        **_machine(candidate, selection),
        answer=answer(selection, rows),
        results=rows,
        parameters=_parameters(selection, train),
        responses=shown,
        figures=figures[sum(len(shown_response.panels) for shown_response in shown) :],
        limits=limits(candidate, selection.thresholds),
        columns=columns(selection.thresholds),
        limits_of=lambda c: limits(c, selection.thresholds),
        weakest=weakest(candidate),
        nearest=nearest(selection)[:NEAREST],
        alternatives=alternatives(selection),
        look_alikes=list(look_alike_sentences(selection)),
        others=rivals(selection),
        reasoning=reasons(selection),
        measured="J cross-validated" if test is None else "J test",
        cost=cost_in_words(selection.task.cost),
        data=_data(selection, train, test),
        choices=choices(selection),
        first_lines=first_lines(selection),
        suspicions=suspicions(selection),
        only=hold(selection) and f", {hold(selection)}",
        steps=next_steps(selection),
        members=members,
        lines=list_lines(members),
        home=site.home if site else None,
        **ALWAYS,
    )


def _results(
    selection: Selection, results: Sequence[Result], train: FrequencyResponse
) -> list[ParameterRow]:
    """Rows of results on the machine, with those of other sets of values."""
    others = [physical(c, selection.task) for c in exchanged(selection)] if results else []
    return [
        with_others(result_row(r, train), r.value, [(x.value, result_row(x, train)) for x in rest])
        for r, *rest in zip(results, *others, strict=True)
    ]


def _parameters(selection: Selection, train: FrequencyResponse) -> list[ParameterRow]:
    """Parameters with those of other sets of values that give the same response."""
    each = [
        zip(c.estimate.parameters.values(), parameter_rows(c, selection.task, train), strict=True)
        for c in (selection.described, *exchanged(selection))
    ]
    return [with_others(row, value, rest) for (value, row), *rest in zip(*each, strict=True)]


def _question_page(
    selection: Selection,
    train: FrequencyResponse,
    test: FrequencyResponse | None,
    site: Site | None,
) -> str:
    """The page of data that do not settle the sensor quantity: the question, the readings side by
    side, the commands that settle it.
    """
    head, *rows = quantity_rows(selection)
    return render(
        "fit-question.html",
        first_lines=first_lines(selection),
        readings=selection.quantities,
        rows_head=head,
        rows=rows,
        suspicions=not_in(first_lines(selection), suspicions(selection)),
        steps=next_steps(selection),
        data=_data(selection, train, test),
        choices=choices(selection),
        home=site.home if site else None,
        **ALWAYS,
    )


def _machine(candidate: Candidate, selection: Selection) -> dict[str, str]:
    """Texts and drawing of the structure on the page."""
    machine = with_all_sensors(candidate.chain, selection)
    return {
        "title": name(candidate.chain),
        "drawing": drawing(machine),
        "description": machine.title,
    }


def _data(
    selection: Selection, train: FrequencyResponse, test: FrequencyResponse | None
) -> list[tuple[str, FrequencyResponse]]:
    measured = [("Training", train), *([] if test is None else [("Test", test)])]
    return measured + further_data(selection)


def further_data(selection: Selection) -> list[tuple[str, FrequencyResponse]]:
    """The data of further responses."""
    each = zip(selection.task.cost.setups, selection.task.cost.parts, strict=True)
    return [(f"Training ({setup.text})", part.measured) for setup, part in list(each)[1:]]


def reasons(selection: Selection) -> list[tuple[str, str]]:
    """Keyword and one sentence each: how the cost was validated, what noise may do, why this
    one, how safe the optimum is.
    """
    rows = [
        ("Validation", _validation(selection)),
        ("Choice", _choice(selection)),
        ("Akaike weights", _akaike(selection)),
        ("Starts", _starts(selection.described)),
        ("Scatter", _scatter(selection)),
        (
            "Standard errors",
            (
                "They follow from the scatter of the lines; where residuals are larger, or those of"
                " neighbouring lines hang together, that counts as an error of the model and widens"
                " them."
            ),
        ),
    ]
    return [(keyword, sentence) for keyword, sentence in rows if sentence]


def alternatives(selection: Selection) -> list[tuple[str, list[tuple[str, str]]]]:
    """Other possible origins of the same data, and open questions: an introduction, then names and
    reasons.
    """
    return [
        (
            introduction,
            [
                (name(a.chain), _reason(a, selection))
                for a in selection.alternatives
                if a.relation is relation
            ],
        )
        for relation, introduction in INTRODUCTIONS.items()
    ]


def _reason(alternative: Alternative, selection: Selection) -> str:
    """The verdict's sentence with short names; the longer one first, of which the other may be
    the beginning.
    """
    sentence, chains = alternative.sentence, [alternative.chain, selection.described.chain]
    for chain in sorted(chains, key=lambda c: -len(str(c))):
        sentence = sentence.replace(str(chain), name(chain))
    return sentence


def rivals(selection: Selection) -> int:
    """Number of other candidates with as many masses, fitted or not."""
    chains = [*(c.chain for c in selection.candidates), *selection.same_as]
    return sum(c.n_masses == selection.described.chain.n_masses for c in chains) - 1


def _validation(selection: Selection) -> str:
    if selection.test is not selection.task.cost.measured:
        return "The cost that decides is computed on test data, which no fit used."
    return (
        f"The cost that decides comes from {selection.validation}: each line is predicted by a fit"
        " without it."
    )


def _choice(selection: Selection) -> str:
    """Why the selected candidate and not the one with the lowest cost."""
    if selection.selected is None:
        return ""
    if not selection.explanation.is_near:
        return "No candidate explains the data; the selected one has the lowest cost."
    out = sum(c.excluded is not None for c in selection.candidates)
    left, more = plural(len(selection.members), "candidate"), len(selection.containing)
    which = "one of these" if len(selection.members) > 1 else "it"
    beside = f" ({more} more contain{'s' if more == 1 else ''} {which})" if more else ""
    return (
        f"{left} the data do not exclude{beside}, the selected one"
        " is the simplest of them, of equally simple ones that with the lowest cost."
        f" {plural(out, 'candidate')} that would explain the data alone"
        f" {'is' if out == 1 else 'are'} excluded by another one at the level"
        f" {percent(LEVEL)}; the others miss more than the data scatter."
    )


def _scatter(selection: Selection) -> str:
    """Scatter used in the absolute check."""
    found = selection.explanation
    return (
        f"A line scatters by {percent(found.scatter.typical)}, known from {found.scatter.source}."
        f" Measured by it, chi2 per line is {readable(found.chi2)}: 1 is noise alone, which stays"
        f" below {readable(noise_limit(found.scatter), 2)}; above"
        f" {readable(largest_cost(found.scatter), 2)} the data are not explained."
    )


def _akaike(selection: Selection) -> str:
    if selection.selected is None:
        return ""
    heaviest = max(selection.candidates, key=lambda c: c.akaike_weight)
    note = (
        "They compare the admissible candidates on the training data alone, as if the residuals"
        " were independent noise"
    )
    if heaviest is selection.selected:
        return f"{note}; the selected candidate has the largest."
    largest = readable(heaviest.akaike_weight, 2)
    return (
        f"{note}; {name(heaviest.chain)} has the largest ({largest}), but the validation decides."
    )


def _starts(candidate: Candidate) -> str:
    """Hit rate, with a warning where the optimum was reached from hardly any start."""
    rare = " Reached so rarely, it may not be the lowest." if hits(candidate) < CERTAIN else ""
    return f"{hits_in_words(candidate)} after the rough search.{rare}"


def choices(selection: Selection) -> list[tuple[str, str]]:
    """Settings, for the foot of the page."""
    task = selection.task
    bounds = [
        f"{n} {readable(low)}..{readable(high)}" for n, (low, high) in sorted(task.bounds.items())
    ]
    fixed = [f"{n} = {readable(value, 6)}" for n, value in sorted(task.fixed.items())]
    rows = [
        ("Cost", f"J adds {cost_in_words(task.cost)}"),
        ("Weights of lines", "equal" if task.cost.parts[0].lines is None else "one for each line"),
        ("Sign of the sensor", f"{task.sign:+d}".replace("-", "−")),
        ("Bounds", with_and(bounds) or "none"),
        ("Fixed", with_and(fixed) or "none"),
        ("Seed", task.seed),
        ("disting", __version__),
    ]
    return rows
