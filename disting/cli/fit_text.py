"""Printed output of disting fit: three lines, the structures that are not excluded, then criteria
and parameters.
"""

from collections.abc import Iterator, Sequence
from math import isfinite
from typing import Any

from disting.fit.judge.admissible import FROM_ZERO, UNDETERMINED
from disting.fit.judge.candidate import Candidate
from disting.fit.judge.exclusion import LEVEL
from disting.fit.judge.explanation import explanations
from disting.fit.judge.mechanics import Folded, Line, fold
from disting.fit.judge.members import Disagreement, Member
from disting.fit.judge.modes import Result, physical
from disting.fit.results.selection import Selection
from disting.measurement import FrequencyResponse
from disting.measurement.look_text import short_lines
from disting.model.chain import Chain, text_drawing
from disting.report.fit.criteria import HEADS, columns
from disting.report.fit.doubts import hold, limits_in_words, not_counted
from disting.report.fit.links import commands, new_names
from disting.report.fit.look_alikes import exchanged, is_other, look_alike_sentences
from disting.report.fit.mechanics_words import actuators_in_words, fold_names
from disting.report.fit.sentences import (
    first_lines,
    not_in,
    quantity_rows,
    suspicions,
    uninformative,
    which_mass,
)
from disting.report.fit.words import (
    cost_in_words,
    fit_in_words,
    fits_of,
    name as name_of,
    percent,
    result_unit,
    values_in_words,
    with_error,
)
from disting.verdict.result import Relation

SHOWN = 8  # candidates of the printed table
OTHERWISE = {
    Relation.SOMETIMES: "the same behaviour for some positive parameters only",
    Relation.UNDECIDED: (
        "whether these have positive parameters with the same behaviour is not known"
    ),
}


def fit_text(selection: Selection, train: FrequencyResponse) -> Iterator[str]:
    """The result for people: what they must know in three lines, the set, then the rest."""
    for part in selection.task.cost.parts:
        yield from short_lines(part.measured)
    answer = first_lines(selection)
    yield from ("", *answer, "")
    if selection.question:
        yield from _side_by_side(selection)
        return
    folded = fold(selection.members)
    yield from _set(selection, folded)
    yield from _criteria(selection, folded)
    yield ""
    yield from _describe_selected(selection, train)
    yield from _explain_exclusion(selection)
    yield from _relied_on(selection)
    if selection.selected and selection.explanation.is_near:
        yield ""
        yield from _alternatives(selection)
    yield from look_alike_sentences(selection)
    rest = not_in(answer, suspicions(selection))
    yield from ["", *(f"suspicious: {doubt}" for doubt in rest)] if rest else []
    yield from (
        ["", "next:", *(f"  {command}" for command in commands(selection))]
        if commands(selection)
        else []
    )


def _criteria(selection: Selection, folded: Folded) -> Iterator[str]:
    """Number of fitted candidates, and the figures of the best candidate of each line."""
    left = [line.best.candidate for line in folded.lines]
    yield (
        f"{len(selection.candidates)} candidates fitted to {_lines(selection)}{_count(selection)},"
        f" validated on {selection.validation}"
    )
    if not left:
        yield "none is left; the best ones:"
    elif len(selection.members) > len(left):
        yield "the best one of each line:"
    yield ""
    yield from _table((left or selection.candidates)[:SHOWN])
    cost = cost_in_words(selection.task.cost)
    yield f"misfit J: {cost}; on data not used for the fit (J test) and on its own data (J train)"
    yield f"badly determined (a higher number is worse): {columns(selection.thresholds)}"


def _side_by_side(selection: Selection) -> Iterator[str]:
    """The readings of data that do not settle the quantity, and the commands that do."""
    rows = quantity_rows(selection)
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(f"{cell:{n}}" for cell, n in zip(row, widths, strict=True)).rstrip()
    yield ""
    yield "no values are given: those of a wrong quantity are wrong by powers of the frequency"
    rest = not_in(first_lines(selection), suspicions(selection))
    yield from (f"suspicious: {doubt}" for doubt in rest)
    yield from ("", "next:", *(f"  {command}" for command in commands(selection)))


def _describe_selected(selection: Selection, train: FrequencyResponse) -> Iterator[str]:
    """The selected structure, or the best one, with its values."""
    chain, explanation = selection.described.chain, selection.explanation
    short = "the best one, which does not explain the data"
    what = "selected" if explanation.explains else f"{short}{' fully' * explanation.is_near}"
    yield (
        f"{what if selection.selected else 'the best one'}: {name_of(chain)}"
        f"   {text_drawing(chain)}"
    )
    yield from [f"  {new_names(selection)}"] if new_names(selection) else []
    yield from ["  or: another set of values, with the same response"] * bool(exchanged(selection))
    yield f"  {fit_in_words(selection, train, None if selection.test is train else selection.test)}"
    yield from (f"  {line}" for line in _each(selection))
    yield from (f"  {line}" for line in _parameters(selection))
    yield ""
    only = hold(selection)
    first, *others = (
        physical(c, selection.task) for c in (selection.described, *exchanged(selection))
    )
    yield from (f"  {line}{' *' * bool(only)}" for line in _results(first, others, train))
    yield from [f"  * {only}: {not_counted(selection)}"] * bool(only)


def _lines(selection: Selection) -> str:
    """Amount of data."""
    sizes = [str(len(part.measured)) for part in selection.task.cost.parts]
    several = f" of {len(sizes)} responses" if len(sizes) > 1 else ""
    return f"{' + '.join(sizes)} frequency lines{several}"


def _each(selection: Selection) -> Iterator[str]:
    """Lines on the judged data of each of several responses, and on responses without
    information.
    """
    judging, c = selection.judging, selection.described
    each = explanations(judging, c.residual, c.missed, selection.explanation.scatter)
    by_setup = dict(zip((setup.text for setup in judging.setups), each, strict=True))
    for name, fit in fits_of(selection, c):
        explanation = by_setup.get(name)
        judged = (
            f"chi2 per line {explanation.chi2:.3g}, its lines scatter by"
            f" {percent(explanation.scatter.typical)}; "
            if explanation
            else ""
        )
        yield f"{name}: {judged}fit {fit} of its training data"
    yield from uninformative(selection)
    yield from which_mass(selection)


def _explain_exclusion(selection: Selection) -> Iterator[str]:
    """Where none may be selected, why, and what helps."""
    if selection.selected:
        return
    yield ""
    yield from (
        f"  {text_drawing(c.chain)}: {'; '.join(c.reasons)}" for c in selection.candidates[:SHOWN]
    )
    yield "more excitation or wider --thresholds may help"
    if any(c.practical.unidentifiable for c in selection.candidates[:SHOWN]):
        yield (
            "not identifiable: only known parameters (--fix NAME=VALUE) or another place of force"
            " and sensor help"
        )


def _set(selection: Selection, folded: Folded) -> Iterator[str]:
    """The structures that the data do not exclude: a line for each mechanics, with what behaves
    the same.
    """
    if not folded.lines:
        return
    yield f"not excluded by this data (each tested against each other at level {100 * LEVEL:g} %):"
    width = max(len(line.name) for line in folded.lines)
    adds = [actuators_in_words(line.actuators) for line in folded.lines]
    wide = max(map(len, adds))
    for line, words in zip(folded.lines, adds, strict=True):
        best = line.best
        yield (
            f"  {line.name:{width}}  {words:{wide}}  J {best.candidate.j_test:.4g} "
            f" {text_drawing(line.chain)}{_differing(best)}"
        )
        yield from (f"    {text}" for text in _beside(selection, line))
    more = len(selection.containing)
    if more:
        yield (
            f"{more} more contain{'s' * (more == 1)} one of these: no experiment excludes"
            f" {'it' if more == 1 else 'them'} if the smaller one is true"
        )
    yield ""


def _beside(selection: Selection, line: Line) -> Iterator[str]:
    """Structures equivalent to one of the line, possibly equivalent ones, and those that contain
    one.
    """
    for twin in line.best.twins:
        values = values_in_words(twin.parameters)
        free = f" (one of many sets of values, {twin.free_choices} free)" * (twin.free_choices > 0)
        yield f"equivalent to {twin.name}  {text_drawing(twin.chain)}  {values}{free}"
    rest = [m for m in line.members if m is not line.best]
    same = fold_names(twin.name for m in rest for twin in m.twins)
    if same:
        yield f"{', '.join(m.name for m in rest)}, equivalent to {_join_names(same)}"
    more = {m.name for m in selection.containing}  # they are left whatever behaves the same
    unknown = fold_names(name for m in line.members for name in m.open if name not in more)
    if unknown:
        yield f"not decided: {_join_names(unknown)}"
    own = [m.candidate.chain for m in line.members]
    larger = fold_names(m.name for m in selection.containing if m.contains in own)
    if larger:
        yield f"or a larger one that contains it: {_join_names(larger)}"


def _relied_on(selection: Selection) -> Iterator[str]:
    """Assumptions that hold for all of them."""
    if selection.relied_on:
        yield ""
        only = hold(selection) and f", {hold(selection)},"
        yield (
            f"conclusions{only} that hold for every structure listed above and its equivalents"
            " (95 %; not examined: larger structures that contain one, and undecided ones):"
        )
        yield from (f"  {statement.text}" for statement in selection.relied_on)


def _differing(member: Member) -> str:
    if not member.differs:
        return ""
    hertz, size = member.differs[0]
    return f"  differs most at {hertz:.3g} Hz, by {100 * size:.2g} %"


def _count(selection: Selection) -> str:
    return (
        f" ({selection.saved} more have the same positive models as one of them)"
        if selection.saved
        else ""
    )


def _join_names(names: list[str]) -> str:
    more = len(names) - SHOWN
    return ", ".join(names[:SHOWN]) + (f" and {more} more" if more > 0 else "")


def _table(candidates: Any) -> Iterator[str]:
    jointly, weakest, alike = (head for head, _ in HEADS)
    yield f"{'misfit J of lines':>19} {'':>10}   {'badly determined':>17}"
    yield (
        f"{'unseen':>9} {'fitted':>9} {'parameters':>10} {jointly:>8} {weakest:>8} {alike:>8}"
        "  structure"
    )
    for c in candidates:
        p = c.practical
        indices = (
            f"{_index(p.condition_index):>8} {_index(p.importance_ratio):>8}"
            f" {_index(p.collinearity):>8}"
        )
        mark = "" if c.admissible else "  (not all determined)"
        yield (
            f"{c.j_test:9.4g} {c.j_train:9.4g} {c.n_parameters:10d} {indices}  {name_of(c.chain)}"
            f"{mark}"
        )


def _index(value: float) -> str:
    """A criterion; nothing where it is infinite, since the reasons below the table state what is
    not determined.
    """
    return f"{value:.3g}" if isfinite(value) else "–"


def _parameters(selection: Selection) -> Iterator[str]:
    c, others = selection.described, exchanged(selection)
    apart = {d.name: d for m in selection.members[:1] for d in m.disagreements}
    wide = selection.members[0].intervals if selection.members else {}
    mark = " *" * bool(hold(selection))
    for name, value in c.estimate.parameters.items():
        error = c.practical.relative_errors.get(name)
        if error is None:
            origin = "given"
        elif name in wide and not error <= FROM_ZERO:
            origin = f"{limits_in_words(*wide[name])}{mark}"
        else:
            origin = "not determined" if not error <= UNDETERMINED else f"± {percent(error)}{mark}"
            origin += "".join(_or(other, name, value) for other in others)
        yield f"{name:4} = {value:<11.6g} {origin}{_flag(apart[name]) if name in apart else ''}"


def _flag(disagreement: Disagreement) -> str:
    return (
        f"   test data: {disagreement.test:.3g}, {disagreement.distance:.2g} standard errors apart"
    )


def _or(other: Candidate, name: str, value: float) -> str:
    """The value of a parameter in another set of values."""
    there, error = other.estimate.parameters[name], other.practical.relative_errors[name]
    return f" or {there:.6g} ± {percent(error)}" if is_other(there, value) else ""


def _results(
    results: tuple[Result, ...],
    others: Sequence[tuple[Result, ...]],
    measured: FrequencyResponse,
) -> Iterator[str]:
    """Physical results, with those of other sets of values where they differ."""
    width = max(len(r.name) for r in results)
    for r, *rest in zip(results, *others, strict=True):
        values = [with_error(r.value, r.standard_error)]
        values += [
            with_error(x.value, x.standard_error) for x in rest if is_other(x.value, r.value)
        ]
        yield f"{r.name:{width}}  {' or '.join(values)} {result_unit(r, measured)}".rstrip()


def _alternatives(selection: Selection) -> Iterator[str]:
    """Structures with the same positive models, those with some of them, and open cases; always
    with the domain.
    """
    by_relation: dict[Relation, list[Chain]] = {}
    for a in selection.alternatives:
        by_relation.setdefault(a.relation, []).append(a.chain)
    same = by_relation.get(Relation.INDISTINGUISHABLE, [])
    if same:
        yield (
            "each of these gives the same response with other positive values, so no data with"
            " this force and sensor can distinguish them:"
        )
        yield from (f"  {name_of(chain)}" for chain in same)
    elif not selection.alternatives and not any(m.twins for m in selection.members[:1]):
        yield (
            "no other candidate with as many masses gives the same response, special values"
            " aside: better data can distinguish them"
        )
    for relation, heading in OTHERWISE.items():
        if relation in by_relation:
            yield f"{heading}: " + "; ".join(map(name_of, by_relation[relation]))
