"""A plan in words: the answer first, then the numbers behind it."""

import shlex
from collections.abc import Iterator, Sequence
from math import ceil, floor, sqrt

import numpy as np

from disting.fit.judge.exclusion import LEVEL
from disting.fit.search.candidates import reference
from disting.model.chain import Chain, Sort, text_drawing
from disting.planning.effort import FEWEST
from disting.planning.fit_file import FitRecord, NamedNetworks
from disting.planning.power import POWER, Answer, Plan, is_trusted, typical
from disting.planning.rival import AnyStructure, Limit, Rival, name_of
from disting.planning.spectrum import Design
from disting.report.fit.links import next_command, plan_command
from disting.report.fit.words import percent, readable
from disting.verdict.result import Relation

LOUD = 0.3  # noise of a line beyond which the logarithm of a response is no longer linear in it
WORDS = {
    Sort.MACHINE: ("machine", "with this force and sensor"),
    Sort.CIRCUIT: ("circuit", "at these nodes"),
    Sort.COMPARTMENTS: ("system", "with this input and output"),
}
NAMED = 8  # structures in one sentence
SHOWN = 12  # lines of the optimal spectrum in the table


def chance(probability: float) -> str:
    """A probability in percent; what is below 1 is not rounded to certainty.

    >>> chance(0.95), chance(0.9962), chance(1 - 1e-9)
    ('95 %', '99.6 %', '> 99.9 %')
    """
    if probability > 0.999:
        return "> 99.9 %"
    return f"{floor(1000 * probability) / 10:.1f} %" if probability > 0.99 else percent(probability)


def plan_in_words(plan: Plan, best: Design | None, source: str) -> Iterator[str]:
    """The lines of the answer for one pair."""
    yield answer_in_words(plan)
    if plan.verdict is not None:
        yield f"verdict: {plan.verdict.sentence}"
    yield ""
    model, name = plan.names
    width = max(len(model), len(name))
    yield f"  {model:{width}}  {_draw_structure(plan.model)}true: {_values(plan.values)}"
    rival = plan.rival
    if rival is None:
        yield f"  {name:{width}}  {_draw_structure(plan.other)}".rstrip()
        return
    yield f"  {name:{width}}  {_draw_structure(plan.other)}best fit: {_values(rival.parameters)}"
    yield ""
    yield from _figures(plan, rival, source)
    if best is not None:
        yield ""
        yield from _spectra(plan, best)


def rivals_in_words(
    named: FitRecord | NamedNetworks,
    plans: Sequence[tuple[Plan, Plan | None]],
    reverse: Sequence[Plan],
    source: str,
    file: str,
) -> Iterator[str]:
    """The selected structure of a fit, of which `file` is the name, against each rival; then the
    structures that contain it, and the `reverse` against it, if one of these is true.
    """
    name = name_of(named.model)
    thing = _words(named.model)[0]
    yield f"assumed: the {thing} is {name} with {_values(named.values)}; noise {source}"
    for same, why in named.same.items():
        yield f"impossible: {same}: {why}"
    if named.same:
        yield f"for another experiment: disting next {shlex.quote(file)}"
    if not plans:
        yield "" if named.same else "the fit left no rival: there is nothing to distinguish"
    else:
        yield ""
        yield from _rows([plan for plan, _ in plans])
    yield from larger_in_words(list(named.larger), name)
    back = [*(plan for _, plan in plans if plan is not None), *reverse]
    if not plans and not back:
        return
    if back:
        yield ""
        yield f"the reverse: can data exclude {name} if a structure that contains it is true?"
        yield from _rows(back, true=True)
    yield ""
    yield (
        f"periods: how many times the present ones give power {percent(POWER)} at level"
        f" {percent(LEVEL)}, if all lines scatter alike; --noise FRF.csv takes the scatter of each"
        " line"
    )
    every = [p for p in (*(plan for plan, _ in plans), *back) if p.noncentrality > 0]
    if any(p.answer is Answer.ENOUGH for p in every):
        yield "enough: disting fit excludes structures by the same test"
    if every:
        yield f"one pair in full: {plan_command(max(every, key=lambda p: p.factor))}"


def larger_in_words(structures: Sequence[AnyStructure], name: str) -> Iterator[str]:
    """Yield a sentence on the structures that contain the selected one, `name`, or another one."""
    if structures:
        names = [name_of(structure) for structure in structures]
        more = len(names) - NAMED
        shown = ", ".join(names[:NAMED]) + (f" and {more} more" if more > 0 else "")
        contain = "contains" if len(names) == 1 else "contain"
        yield (
            f"not a rival: {shown} {contain} {name} or one of its rivals; no experiment excludes a"
            " structure that contains the true one"
        )


def _rows(plans: Sequence[Plan], *, true: bool = False) -> Iterator[str]:
    """A row a plan, named by the rival, or by what is true."""
    names = [p.names[0 if true else 1] for p in plans]
    head = "true" if true else "rival"
    width = max(len(head), *map(len, names))
    yield f"{head:{width}}  {'lambda':>8}  {'power':>8}  {'periods':>8}  answer"
    for name, p in zip(names, plans, strict=True):
        periods = f"{readable(p.factor)}x" if p.noncentrality > 0 else "–"
        row = f"{readable(p.noncentrality):>8}  {chance(p.power):>8}  {periods:>8}  {_short(p)}"
        yield f"{name:{width}}  {row}"


def _draw_structure(structure: AnyStructure) -> str:
    """A chain as a drawing; a network is drawn by its name."""
    return f"{text_drawing(structure)}  " if isinstance(structure, Chain) else ""


def answer_in_words(plan: Plan) -> str:
    """Return whether more measuring distinguishes both, and how much, in a sentence."""
    model, name = plan.names
    if plan.rival is None:
        other = next_command(plan)
        return (
            f"impossible: however long you measure {_words(plan.model)[1]}, {model} and {name}"
            f" cannot be distinguished; for another experiment: {other}"
        )
    if plan.answer is Answer.SAME:
        return _same(plan, plan.rival)
    text = (
        f"if the {_words(plan.model)[0]} is {model}, the data exclude {name} with a probability of"
        f" {chance(plan.power)} (level {percent(LEVEL)})"
    )
    more = (
        f"enough: {text}"
        if plan.answer is Answer.ENOUGH
        else f"not enough: {text}; for {percent(POWER)} measure {readable(plan.factor)} times as"
        " many periods"
    )
    return more if is_trusted(plan) else f"{more}. {_doubt(plan.rival)}"


def _words(model: AnyStructure) -> tuple[str, str]:
    """Measured response and its source."""
    return WORDS[model.sort]


def _doubt(rival: Rival) -> str:
    text = "" if rival.recovered else ", and the search did not find the model's own values again"
    return (
        f"Doubtful: {rival.best.reached} of {len(rival.best.costs)} starting points led to the"
        f" rival's best fit{text}; a better fit may exist, and then the power is lower"
    )


def _same(plan: Plan, rival: Rival) -> str:
    """Why a rival that fits within rounding does so, although the verdict does not state it."""
    model, name = plan.names
    thing, where = _words(plan.model)
    if plan.is_contained:
        does = f" and gives the same response {_limits(rival)}" if rival.limits else ""
        return (
            f"impossible: {name} contains {model}{does}. No measurement of this {thing} {where} can"
            f" exclude it. Ask the reverse: if the {thing} is {name}, can data exclude {model}?"
        )
    if rival.limits:
        return (
            f"impossible on these lines: {name} gives the response of {model} there"
            f" {_limits(rival)}; if the structures differ, other frequencies show it: choose a"
            " wider range"
        )
    relation = plan.verdict.relation if plan.verdict is not None else Relation.UNDECIDED
    why = {
        Relation.SOMETIMES: "the verdict says that some values have an equivalent, and these are"
        " such values",
        Relation.DISTINGUISHABLE: "the verdict says that the structures differ, but these values,"
        f" or all of {model}, have an equivalent in {name}",
    }.get(relation, "whether that holds for other values too is not decided")
    more = "another sensor, or the force elsewhere, may separate them"
    if relation is Relation.SOMETIMES:
        other = next_command(plan)
        more = f"for another experiment: {other}"
    return f"impossible for these values: {name} fits them up to rounding ({why}); {more}"


def _limits(rival: Rival) -> str:
    """Limits of the elements without effect."""
    ends = [
        f"{name} -> {'0' if limit is Limit.ZERO else 'infinity'}"
        for name, limit in rival.limits.items()
        if limit is not Limit.ANY
    ]
    idle = [name for name, limit in rival.limits.items() if limit is Limit.ANY]
    words = [f"in the limit {', '.join(ends)}"] if ends else []
    return " and ".join([*words, *([f"with {', '.join(idle)} without effect"] if idle else [])])


def _short(plan: Plan) -> str:
    """The answer in a table."""
    if plan.rival is None:
        return f"impossible: {next_command(plan)}"
    if plan.answer is Answer.SAME:
        ends = f" ({', '.join(plan.rival.limits)} without effect)" if plan.rival.limits else ""
        does = "contains the model" if plan.is_contained else "gives the same on these lines"
        return f"impossible: it {does}{ends}"
    return plan.answer.value + ("" if is_trusted(plan) else ", doubtful: few starts agree")


def _figures(plan: Plan, rival: Rival, source: str) -> Iterator[str]:
    """Numbers behind the answer."""
    hertz, both = rival.hertz, plan.joint
    larger = f" ({reference(both)} contains both)" if both and both != plan.model else ""
    plural = "s" if plan.surplus > 1 else ""
    yield (
        f"lines           {len(hertz)} from {hertz[0]:.4g} to {hertz[-1]:.4g} Hz, noise of a line"
        f" {percent(typical(rival.rho))} ({source})"
    )
    yield (
        f"search          {rival.best.reached} of {len(rival.best.costs)} starting points led to"
        f" the rival's best fit: {rival.trust}"
    )
    if plan.answer is Answer.SAME:
        return
    at = int(rival.apart.argmax())
    yield (
        f"difference      most at {hertz[at]:.3g} Hz, by {percent(float(rival.apart[at]))}; sum of"
        f" squares over the lines {readable(float(np.sum(rival.apart**2)))}"
    )
    yield (
        f"test            {plan.surplus} degree{plural} of freedom{larger}, level"
        f" {percent(LEVEL)}{_estimate_source(plan)}"
    )
    yield (
        f"noncentrality   {readable(plan.noncentrality)} squared units of noise between both"
        f" (lambda); power {percent(POWER)} needs {readable(plan.needed)}"
    )
    yield f"power           {chance(plan.power)}"
    lines = max(FEWEST, ceil(plan.factor * len(hertz)))
    yield f"needed for power {percent(POWER)}, one of:"
    yield f"  noise of a line at most {percent(typical(rival.rho) / sqrt(plan.factor))}"
    yield f"  {readable(plan.factor)} times the periods"
    yield f"  {readable(sqrt(plan.factor))} times the amplitude"
    yield f"  {lines} lines in the same range"


def _estimate_source(plan: Plan) -> str:
    """From what a fit finds the scatter."""
    if plan.repeats is None:
        return ""
    own = "one measurement" if plan.repeats == 1 else f"{plan.repeats} repeats"
    return f", with the scatter that a fit finds in {own}"


def _spectra(plan: Plan, best: Design) -> Iterator[str]:
    """Band and spectra of the same power, and the lines of the optimal one."""
    before, after = best.crests
    rows = [
        ("equal power on all lines", plan.noncentrality),
        (f"best band, {best.band.low:.3g} to {best.band.high:.3g} Hz", best.band.noncentrality),
        (f"optimal, {best.optimum.lines} lines", best.optimum.noncentrality),
        ("to be run: 90 % of the optimal, 10 % on all lines", best.run.noncentrality),
        (f"  with crest {after:.2g}, at the peak of the first, {before:.2g}", best.at_equal_peak),
    ]
    width = max(len(name) for name, _ in rows)
    yield f"{'excitation of the same power':{width}}  {'lambda':>8}  {'power':>8}  {'periods':>8}"
    for name, size in rows:
        periods = f"{readable(plan.needed / size)}x"
        reached = chance(plan.power_at(size))
        yield f"{name:{width}}  {readable(size):>8}  {reached:>8}  {periods:>8}"
    gap = best.optimum.bound / best.optimum.noncentrality - 1
    above = f"{percent(gap)} above the optimal one"
    yield f"no spectrum of the same power has a lambda more than {above}"
    yield ""
    yield "lines of the optimal spectrum, with their shares of the power:"
    chosen = np.argsort(-best.optimum.shares, kind="stable")[: min(SHOWN, best.optimum.lines)]
    for k in np.sort(chosen):
        yield f"  {best.hertz[k]:8.4g} Hz  {percent(float(best.optimum.shares[k])):>7}"
    more = best.optimum.lines - len(chosen)
    yield from [f"  and {more} more"] if more else []


def _values(values: object) -> str:
    return ", ".join(f"{n} = {v:.4g}" for n, v in dict(values).items())  # type: ignore[call-overload]
