"""Of which fitted candidates the data determine all parameters.

The paper selects among these only, by the three criteria of section 2.4, which ignore the noise: a
model whose every parameter is known within 1 % may exceed a condition index of 30. By default a
candidate with badly known parameters stays but is marked unless the criteria hold or the data
determine it well in spite of them, every parameter differing from zero by three standard errors and
every inertia, stiffness, resonance and antiresonance known to 10 %. A parameter at its bound is
marked too. What no data determine is left out by both rules.
"""

from enum import StrEnum

from disting.fit.judge.candidate import Candidate
from disting.fit.judge.modes import Result, physical
from disting.fit.search.estimate import Task
from disting.statistics.practical import Thresholds

UNDETERMINED = 10.0  # relative standard error above which a value is called not determined
FROM_ZERO = 1 / 3  # largest relative standard error of a parameter that is known not to be zero
KNOWN = 0.1  # and of a quantity that a machine is designed with
DESIGNED = ("inertia", "stiffness", "resonance", "antiresonance")


class Rule(StrEnum):
    """Rule of selection: all candidates that the data do not exclude, or only those that satisfy
    the paper's criteria.

    >>> Rule("paper") is Rule.PAPER
    True
    """

    NOT_EXCLUDED = "not-excluded"
    PAPER = "paper"


def reasons(candidate: Candidate, task: Task, limits: Thresholds, rule: Rule) -> tuple[str, ...]:
    """Sentences on what the data do not determine of a candidate; empty if it is admissible."""
    bound = tuple(f"{n} is at its bound" for n in candidate.at_bound)
    exceeded = limits.reasons(candidate.practical)
    if rule is Rule.PAPER or not exceeded or candidate.practical.unidentifiable:
        return exceeded + bound
    unknown = undetermined_sentence(candidate, task)
    return (*exceeded, unknown, *bound) if unknown else bound


def undetermined(candidate: Candidate) -> tuple[str, ...]:
    """Names of the parameters that the data do not determine, not even their order of magnitude."""
    errors = candidate.practical.relative_errors
    return tuple(name for name, error in errors.items() if not error <= UNDETERMINED)


def undetermined_sentence(candidate: Candidate, task: Task) -> str:
    """One sentence on the parameters that the data do not determine well; "" where they determine
    all.
    """
    loose = {n: e for n, e in candidate.practical.relative_errors.items() if not e <= FROM_ZERO}
    if not loose:
        loose = {
            r.name: _share(r)
            for r in physical(candidate, task)
            if _is_designed(r) and not _share(r) <= KNOWN
        }
    if not loose:
        return ""
    name, error = max(loose.items(), key=lambda row: row[1])
    more = f" and {len(loose) - 1} more" if len(loose) > 1 else ""
    return (
        f"{name}{more} known to ± {100 * error:.0f} % only"
        if error < 10
        else f"{name}{more} not determined"
    )


def _is_designed(result: Result) -> bool:
    return any(word in DESIGNED for word in result.name.split()) and not result.name.startswith(
        "damping"
    )


def _share(result: Result) -> float:
    return result.standard_error / abs(result.value) if result.value else float("inf")
