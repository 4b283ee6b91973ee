"""Sentences on a selection for an engineer: its limitations first, then suspicious findings. The
commands that lead on: `links`.

Structures are named as the commands read them, such as 2:1+b2+delay.
"""

from collections.abc import Iterator, Sequence

from disting.fit.judge.explanation import BESIDE, Explanation, Level, noise_limit
from disting.fit.judge.held import held
from disting.fit.judge.mechanics import actuator, fold, mechanics
from disting.fit.judge.readings import outside
from disting.fit.results.selection import Selection
from disting.fit.search.candidates import reference
from disting.report.fit.doubts import (
    APPROXIMATE,
    amplitude,
    bad,
    better,
    clear_band,
    closed_loops,
    correlated_residuals,
    differing_parameters,
    doubtful_deviations,
    same_data_twice,
    suspicious_data,
    unseen,
    weak,
)
from disting.report.fit.look_alikes import (
    better_in_words,
    better_outside,
    commands_for_outside,
    exchange_clause,
    look_alike_clause,
)
from disting.report.fit.mechanics_words import (
    actuators_in_words,
    fold_names,
    structure_in_words,
    with_or,
)
from disting.report.fit.quality import quality_line

FEW = 8  # names in one line
NEAREST = 2  # structures of which the third line names where they differ


def first_lines(selection: Selection) -> tuple[str, ...]:
    """Three lines: the quality of the data, the structure and whether it explains them, what would
    decide more. Where the sensor quantity is open, the question for it follows the first line.
    """
    data = f"data: {quality_line(selection)}"
    if selection.question:
        return (data, selection.question)
    is_near = selection.explanation.is_near
    structure = _structure(selection) if is_near else _report_misfit(selection)
    more = _to_decide(selection) if is_near else _suggest_explanations(selection)
    following = "; ".join([*held_input(selection), *more])
    return (data, f"structure: {'; '.join(structure)}", f"next: {following}")


def suspicions(selection: Selection) -> tuple[str, ...]:
    """Sentences on what looks wrong, each with what it means; the gravest first, empty where
    nothing does.
    """
    if selection.question:
        cost = selection.task.cost
        first = (*amplitude(selection), selection.question)
        return (*first, *same_data_twice(selection), *suspicious_data(cost))
    sentences = [
        *amplitude(selection),
        *_other_quantities(selection),
        *(
            []
            if selection.explanation.is_near
            else [*_report_misfit(selection), *_suggest_explanations(selection)]
        ),
        *better(selection),
        *(differing_parameters(m.disagreements) for m in selection.members[:1] if m.disagreements),
        *correlated_residuals(selection),
        *lone(selection),
        *weak(selection),
        *outside(selection.described, selection.task.cost.measured),
        *unseen(selection),
        *same_data_twice(selection),
        *bad(selection),
        *doubtful_deviations(selection),
        *closed_loops(selection),
        *suspicious_data(selection.task.cost),
        *uninformative(selection),
    ]
    return tuple(dict.fromkeys(sentences))


def not_in(answer: Sequence[str], sentences: Sequence[str]) -> list[str]:
    """Return the sentences that the first lines do not hold."""
    return [sentence for sentence in sentences if not any(sentence in line for line in answer)]


def quantity_rows(selection: Selection) -> list[tuple[str, ...]]:
    """A head and a row for each quantity under which the data are explained."""
    rows = [
        (
            f"{r.quantity.value}{' (assumed)' if r.is_assumed else ''}",
            r.name,
            str(len(r.found.parameters)),
            f"{r.chi2:.3g}",
            "its lag integrates over the whole band" if r.integrates else "",
        )
        for r in selection.quantities
    ]
    return [("read as", "structure", "parameters", "chi2 per line", ""), *rows]


def _other_quantities(selection: Selection) -> Iterator[str]:
    """Other quantities under which the data, which the assumed one does not explain, would be."""
    for reading in selection.quantities[1:]:
        wanted, assumed = reading.quantity.value, selection.quantities[0].quantity.value
        yield (
            f"read {reading.sentence}: that it is {assumed} is assumed; give"
            f" --quantity {wanted}, or --quantity {assumed}"
        )


def uninformative(selection: Selection) -> tuple[str, ...]:
    """Responses from which nothing is learned, in sentences."""
    return tuple(
        f"{what}: that response is zero whatever the parameters, so nothing is learned from it"
        for what in selection.silent
    )


def which_mass(selection: Selection) -> tuple[str, ...]:
    """Where further responses are in structures that have other places, in sentences."""
    return tuple(
        f"in {name} this is {other_name}: of all its masses these fit best"
        for name, other_name in places(selection)
    )


def places(selection: Selection) -> tuple[tuple[str, str], ...]:
    """Names of the structures that are left, or best, in which further responses have other places
    than they are named by, and these places.
    """
    cost, shown = (
        selection.task.cost,
        [m.candidate for m in (*selection.members, *selection.containing)],
    )
    chains = dict.fromkeys(c.chain for c in (selection.described, *shown))
    each = ((reference(chain), cost.setups_of(chain.structure)) for chain in chains)
    return tuple(
        (name, " and ".join(setup.text for setup in setups[1:]))
        for name, setups in each
        if setups != cost.setups
    )


def _is_joint(selection: Selection) -> bool:
    return len(selection.task.cost.parts) > 1


def _verdict(selection: Selection) -> str:
    """Does the selected structure, or the best one, explain the data?"""
    found, best = selection.explanation, reference(selection.described.chain)
    size = f"chi2 per line {found.chi2:.3g}, 1 is noise alone"
    if found.level is Level.EXPLAINS:
        return f"{best} explains this data ({size})"
    if found.explains:
        return f"{best} explains this data apart from {misfit_in_words(found)} ({size})"
    if found.too_few:
        return (
            f"{found.lines} lines are too few to judge {best}, the best candidate: at least"
            f" {found.needed} are needed, two for each of its parameters and {BESIDE} more: do not"
            " use its values"
        )
    if found.noisy:
        return (
            f"none of the candidates explains this data: it is mostly noise, only"
            f" {100 * found.scatter.clear:.0f} % of the lines scatter by less than 20 %"
            f" ({found.scatter.source}); the best one is {best}: do not use its values"
        )
    which = "none of the candidates"
    if any(c.explains(found.scatter) for c in selection.candidates):
        which = "none of the candidates that may be selected"
    return f"{which} explains this data; the best one is {best} ({size}): do not use its values"


def _nearly(selection: Selection) -> str:
    """That the described structure comes near the data, and what else the machine may be."""
    explanation, best = selection.explanation, reference(selection.described.chain)
    where = (
        f", most at {'; '.join(m.sentence for m in explanation.misses)}"
        if explanation.misses
        else ""
    )
    size = f"chi2 per line {explanation.chi2:.3g}, 1 is noise alone"
    if explanation.systematic:
        size += f"; residuals of neighbouring lines are correlated by {explanation.systematic:.2f}"
    found = better_in_words(selection)
    other = f"the machine may be {with_or(list(_outside(selection)))}"
    return (
        f"none of the candidates explains this data fully: {best} comes near, but misses it by more"
        f" than noise{where} ({size}); {_explained_by(found) if found else other}; values hold"
        f" {APPROXIMATE}, and may lie outside their intervals"
    )


def _explained_by(found: str) -> str:
    return f"outside the candidates this machine explains it: {found}"


def _outside(selection: Selection) -> Iterator[str]:
    """Machines outside the candidates."""
    if amplitude(selection):
        yield "one that is not linear"
    yield "a branch"
    if not any(c.chain.gap for c in selection.candidates):
        yield "a drive on an elastic base"
    yield "one with more masses"
    yield "another one outside the candidates"


def misfit_in_words(said: Explanation) -> str:
    """Misfit of a structure that explains the data otherwise."""
    if said.misses:
        return "; ".join(m.sentence for m in said.misses)
    most = noise_limit(said.scatter)
    return f"small differences over the band: noise alone stays below a chi2 of {most:.2g}"


def _structure(selection: Selection) -> Iterator[str]:
    """The structures that the data do not exclude, what explains them, and what forbids to use its
    values.
    """
    if selection.explanation.level is Level.NEARLY:
        best = reference(selection.described.chain)
        yield f"{_nearly(selection)}{_standing(selection, f'; {best} is')}"
        yield from _common(selection)
    else:
        yield from _common(selection)
        yield f"{_verdict(selection)}{_standing(selection, ',')}"
    yield from exchange_clause(selection)
    twins = len({twin.name for m in selection.members for twin in m.twins if twin.name != m.name})
    if twins:
        yield f"{twins} more behave{'s' * (twins == 1)} exactly as one of these"
    yield from look_alike_clause(selection)
    if selection.selected is None:
        yield (
            "no candidate is selected: by the criteria that you asked for, this data leaves some"
            " parameters of each candidate undetermined; all values are printed"
        )
    yield from better(selection)
    yield from (
        differing_parameters(m.disagreements) for m in selection.members[:1] if m.disagreements
    )
    yield from correlated_residuals(selection)


def _common(selection: Selection) -> Iterator[str]:
    """Common features of all structures that are left."""
    if selection.members:
        yield structure_in_words(fold(selection.members))
        yield from ["force and sensor are those of the first response"] * _is_joint(selection)


def _standing(selection: Selection, first: str) -> str:
    """The first structure, which the words `first` introduce, among those that the data do not
    exclude.
    """
    count, more = len(selection.members), len(selection.containing)
    if count > 1:
        return f"{first} the simplest of {count} structures that it does not exclude"
    apart = f", apart from {more} that contain{'s' * (more == 1)} it" if more else ""
    return f"; this data excludes every other candidate{apart}" if count else ""


def _to_decide(selection: Selection) -> Iterator[str]:
    """Measures that would distinguish more of the structures that are left."""
    if not selection.members:
        yield "more lines, a wider band or known parameters (--fix) may determine all parameters"
        return
    same = list(_alike(selection))
    differing = list(_differing(selection))
    if differing:
        yield (
            f"measure again where others differ from {selection.members[0].name}:"
            f" {', '.join(differing)}; disting plan tells how long"
        )
    if same:
        name, others = same[0]
        others = [f"{x} with other values" if x == name else x for x in others]
        states = "these sensors and states" if _is_joint(selection) else "sensor"
        yield (
            f"{name} and {_join(others)} give identical responses here: no experiment with"
            f" this force and {states} can separate them; disting next searches for one that can"
        )
    if selection.explanation.level is Level.NEARLY:
        yield from commands_for_outside(selection)
    elif not (differing or same):
        yield (
            "nothing is left to decide between the candidates; machines outside them, such as a"
            " branch or an elastic base, are not excluded"
        )
        larger = {m.name for m in selection.containing}
        unknown = fold_names(n for m in selection.members for n in m.open if n not in larger)
        if unknown:
            yield f"unknown if these behave the same: {_join(unknown)}"
        yield from weak(selection)


def _alike(selection: Selection) -> Iterator[tuple[str, list[str]]]:
    """The structures that have equivalents, and these; by mechanics where all actuators agree."""
    for line in fold(selection.members).lines:
        each = {tuple(reference(mechanics(t.chain)) for t in m.twins) for m in line.members}
        if len(each) == 1 and any(each):
            yield line.name, list(dict.fromkeys(*each))
        elif any(each):
            member = next(m for m in line.members if m.twins)
            yield member.name, list(dict.fromkeys(t.name for t in member.twins))


def _differing(selection: Selection) -> Iterator[str]:
    """Where the lines of the folded set, and another actuator, differ most from the first one."""
    first, *others = fold(selection.members).lines
    shown = [(line.name, line.best) for line in others]
    shown += [(actuators_in_words([actuator(m.candidate.chain)]), m) for m in first.members[1:]]
    for name, member in [(n, m) for n, m in shown if m.differs][:NEAREST]:
        hertz, size = member.differs[0]
        yield f"{name} at {hertz:.3g} Hz (by {100 * size:.2g} %)"
    if len(shown) > NEAREST:
        yield f"{len(shown) - NEAREST} more"


def held_input(selection: Selection) -> Iterator[str]:
    """That a record's input may have been held, where this explains the actuator as well."""
    of, chain = selection.described, selection.described.chain
    found = held(of.estimate, selection.task)
    if found is None:
        return
    name, own = reference(found.chain), reference(chain)
    how = "better than" if found.is_better else "as well as"
    adds = f" with a dead time of {found.dead_time:.2g} s" if found.dead_time else ""
    yield (
        f"if the drive holds its input for the {found.period:.3g} s between samples, give --hold"
        f" record: so {name}{adds} fits this data {how} {own} does without it"
    )


def lone(selection: Selection) -> Iterator[str]:
    """Structures whose gain rests on single lines, in a sentence."""
    resting = [(c, c.rests_on) for c in selection.candidates if c.rests_on is not None]
    for c, lines in resting[:1]:
        more = f", likewise of {len(resting) - 1} more" if len(resting) > 1 else ""
        yield (
            f"what {reference(c.chain)} adds {lines.sentence}{more}: one or two lines are no"
            " evidence of an element, so it excludes no other structure"
        )


def _report_misfit(selection: Selection) -> Iterator[str]:
    """That nothing explains the data, and where the best structure misses most."""
    yield _verdict(selection)
    if selection.explanation.misses:
        yield f"missed most at {', at '.join(m.sentence for m in selection.explanation.misses)}"
    if found := better_in_words(selection):
        yield _explained_by(found)


def _suggest_explanations(selection: Selection) -> Iterator[str]:
    """Possible explanations of the data."""
    yield from _other_quantities(selection)
    if selection.explanation.too_few:
        yield f"measure at least {selection.explanation.needed} lines"
        return
    if selection.explanation.noisy:
        yield "more excitation or more periods lower the noise"
    if better_outside(selection):
        yield from commands_for_outside(selection)
    elif bad(selection):
        yield from bad(selection)
    elif selection.readings:
        yield f"what would fit better: {'; '.join(r.sentence for r in selection.readings)}"
    elif _is_joint(selection):
        yield (
            "fit each response alone: where a structure explains one but not all, a place or a sign"
            " is wrong, or the machine changed between the measurements"
        )
    elif not selection.explanation.noisy and not selection.quantities:
        yield (
            "no other sensor quantity or sign, no other place of force and sensor and no further"
            " mass explains it: is the machine a chain, are other forces at work?"
        )
    yield from clear_band(selection)
    yield from better(selection)


def _join(names: list[str]) -> str:
    more = len(names) - FEW
    return ", ".join(names[:FEW]) + (f" and {more} more" if more > 0 else "")
