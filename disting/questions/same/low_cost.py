"""The exact decision for classes of thousands of models: at little cost by theorems, then one fibre
by the synthesis; with patience by shares and ideals.

A synthesis that takes longer than SECONDS is abandoned, and the pair is left undecided; that is
many times what the dearest pair of the shipped families takes, so that runs repeat.
"""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from disting.behaviour.profile import (
    Profile,
    inverse_profile,
    profile_from_json,
    profile_to_json,
)
from disting.conditions.rule import EXACT, Finding, Outcome
from disting.decide import SAME_CHAINS_PATIENTLY, SAME_CHAINS_QUICKLY, first_finding
from disting.fibres.ideals import Limits
from disting.model.chain import Chain
from disting.model.question import Question, Settings
from disting.questions.same.exact import by_ideals, by_synthesis

SECONDS = 60.0
# the work is limited long before the time
LIMITS = Limits(seconds=600.0, entries=4_000_000, safety=100)


class _OutOfTime(Exception):
    pass


def quick_finding(a: Chain, b: Chain, settings: Settings) -> Finding:
    """Finding of the cheap parts of `exact.exact_finding`, for chains of equal rank and size
    without dead time; ABANDONED where they do not decide.
    """
    finding: Finding = first_finding(SAME_CHAINS_QUICKLY.rows, a, b, settings)
    return finding


def by_synthesis_in_time(a: Chain, b: Chain, settings: Settings) -> Finding:
    """The synthesis, given up after SECONDS."""
    try:
        with _limit_time(SECONDS):
            by_fibre = by_synthesis(a, b, settings)
    except _OutOfTime:
        return Finding(
            EXACT, Outcome.ABANDONED, note=f"the synthesis takes more than {SECONDS:g} s"
        )
    return (
        Finding(EXACT, Outcome.ABANDONED, note="the synthesis proves nothing")
        if by_fibre is None
        else by_fibre
    )


def patient_finding(a: Chain, b: Chain, settings: Settings) -> Finding:
    """Finding from shares and ideals where the synthesis has no method, in a second to some
    minutes.
    """
    finding: Finding = first_finding(SAME_CHAINS_PATIENTLY.rows, a, b, settings)
    return finding


def by_small_ideals(a: Chain, b: Chain, settings: Settings) -> Finding:
    """The ideals within the limits of a class."""
    return by_ideals(a, b, settings, LIMITS)


def quick_profile(chain: Chain, settings: Settings) -> Profile:
    """Profile of the Markov parameters of 1/G, as many as are used of G."""
    structure = chain.structure
    return inverse_profile(structure, 2 * structure.n_states, settings)


QUICKLY = Question("quick exact decisions", quick_finding, Finding.to_json, Finding.from_json)
PATIENTLY = Question("patient exact decisions", patient_finding, Finding.to_json, Finding.from_json)
INVERSELY = Question("inverse profiles", quick_profile, profile_to_json, profile_from_json)


@contextmanager
def _limit_time(seconds: float) -> Iterator[None]:
    """Raise _OutOfTime in the block after so many seconds of this process, whatever else the
    machine does.

    Without effect outside a main thread and where there is no timer.
    """
    if threading.current_thread() is not threading.main_thread() or not hasattr(
        signal, "setitimer"
    ):
        yield
        return

    def stop(*_: object) -> None:
        """Raised in the block by the timer."""
        raise _OutOfTime

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)
