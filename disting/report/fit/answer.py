"""What a fit says to somebody who reads one paragraph: a plain answer, three numbers, the rule by
which the structure was chosen.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from disting.evidence.conditions import capital
from disting.fit.judge.admissible import Rule
from disting.fit.judge.exclusion import LEVEL
from disting.fit.judge.explanation import allowed
from disting.fit.results.selection import Selection
from disting.report.fit.table_rows import Row
from disting.report.fit.words import name, percent, readable
from disting.report.words import plural


@dataclass(frozen=True, slots=True)
class Number:
    """A number that matters, and what it means."""

    what: str
    value: str
    meaning: str


@dataclass(frozen=True, slots=True)
class Answer:
    """`title` and `plain`: what was found, in one line and in one paragraph."""

    title: str
    plain: str
    numbers: tuple[Number, ...]
    rule: str


def answer(selection: Selection, results: Sequence[Row]) -> Answer:
    """The answer of a selection; `results`: what the described model says about the machine."""
    numbers = (_misfit(selection), _left(selection), _third(selection, results))
    return Answer(_title(selection), _plain(selection), numbers, _rule(selection))


def _title(selection: Selection) -> str:
    if selection.selected is None:
        return "No model is admissible"
    if selection.explanation.explains:
        return f"{capital(name(selection.described.chain))}: this explains the measurement"
    if selection.explanation.noisy:
        return "The measurement is mostly noise"
    return "No fitted structure explains the measurement"


def _plain(selection: Selection) -> str:
    count, best = len(selection.candidates), name(selection.described.chain)
    fitted = plural(count, "fitted structure")
    if selection.selected is None:
        each = (
            f"Each of the {count} fitted candidates" if count > 1 else "The only fitted candidate"
        )
        return (
            f"{each} exceeds a threshold, is not identifiable or has a parameter at its bound, so"
            f" none is selected. The best fit is {best}; what follows describes it, and why it is"
            " excluded. More lines, a wider band or known parameters help, and so do thresholds"
            " chosen less strict on purpose."
        )
    if not selection.explanation.explains:
        return (
            f"The best of {fitted} is {best}, and it misses more than the measurement"
            " scatters: do not use its values. What is missed, and what may be wrong, stands below."
        )
    return " ".join((f"Of {fitted} it is the simplest that the data allow.", *_beside(selection)))


def _beside(selection: Selection) -> Iterator[str]:
    """What else it may be."""
    others, more = len(selection.members) - 1, len(selection.containing)
    twins = sum(len(m.twins) for m in selection.members)
    if others:
        yield (
            f"{plural(others, 'other structure')} {'is' if others == 1 else 'are'} not"
            " excluded by the data either."
        )
    if more:
        yield (
            f"{plural(more, 'larger one')} {'contains' if more == 1 else 'contain'}"
            f" {'one of these' if others else 'it'}, with parts that these data do not show."
        )
    if twins:
        yield (
            f"{twins} more cannot be told from one of these by any measurement"
            " with this force and sensor."
        )
    if not (others or more or twins):
        yield "The data exclude every other one."


def _misfit(selection: Selection) -> Number:
    said = selection.explanation
    meaning = (
        f"chi2 per line: 1 is noise alone, above {readable(allowed(said.scatter), 2)} a structure"
        " does not explain the data"
    )
    return Number("misfit", readable(said.chi2), meaning)


def _left(selection: Selection) -> Number:
    count, of = len(selection.members) + len(selection.containing), len(selection.candidates)
    return Number("structures left", f"{count} of {of}", "fitted, and not excluded by the data")


def _third(selection: Selection, results: Sequence[Row]) -> Number:
    """The first resonance; of a model without one how far a line scatters."""
    for row in results:
        if row.name.startswith("resonance"):
            return Number(row.name, f"{row.value} {row.unit}", "value ± standard error")
    scatter = selection.explanation.scatter
    return Number("scatter", percent(scatter.typical), f"of a line, known from {scatter.source}")


def _rule(selection: Selection) -> str:
    """How the structure was chosen."""
    left = f"the data do not exclude (level {percent(LEVEL)})"
    if selection.rule is Rule.PAPER:
        left = f"the paper's three criteria admit and {left}"
    return (
        f"Of the structures that {left}, the one with the fewest parameters is taken; of several"
        " with as few, the one with the lowest cost on "
        + (
            "the test data."
            if selection.test is not selection.task.cost.measured
            else "lines that were left out of the fit."
        )
    )
