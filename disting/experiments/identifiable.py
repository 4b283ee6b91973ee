"""Parameters of a chain that several experiments determine together, and the number of parameter
sets that fit.

The stacked Jacobian gives what is determined locally. Where one experiment alone leaves finitely
many parameter vectors, they are listed at a random point, and those that another experiment
certainly refutes are none of the stacked fibre. That there are no others at generic points follows
from the argument of `questions.identifiability.solutions`: a hypersurface that depends on the one
experiment alone bounds where solutions come or go, and what is refuted at the point is refuted all
around it. If one vector is left it is the point itself, and all parameters are globally
identifiable. Otherwise the ideal of the stacked fibre decides for each parameter whether it has one
value.

A dead time is the factor exp(-Td s) of every transfer function, so Td is globally identifiable
where one of them is not zero.
"""

from dataclasses import replace

from disting.algebra.certainty import enough
from disting.experiments.experiment import MeasuredChain
from disting.experiments.listing import ExperimentFibre, lists, without_dead_time
from disting.experiments.machine_model import MachineModel
from disting.experiments.maps import stacked_map
from disting.fibres.synthesis.decide import safety_of_point
from disting.fibres.synthesis.task import Confirmation
from disting.model.question import Question, Settings
from disting.questions.identifiability import (
    Level,
    Local,
    ParameterIdentifiability,
    by_parameter,
    decode,
    encode,
    joint,
    local,
)

SILENT = "no sensor moves, so nothing is determined"


def identifiability_under(measured: MeasuredChain, settings: Settings) -> ParameterIdentifiability:
    """Identifiability of each parameter from all transfer functions together.

    >>> from disting.experiments.experiment import Experiment
    >>> from disting.model.chain import Chain
    >>> one, two = Experiment(), Experiment(sensor=1)
    >>> seen = (MeasuredChain(Chain(2, meas_plus=2, damped=False), e) for e in ((one,), (one, two)))
    >>> for m in seen:
    ...     print(identifiability_under(m, Settings()).sentence)
    3 parameters, only 2 determinable; not: m1, m2, k12; 1 can be chosen freely.
    3 parameters, all globally identifiable.
    """
    names = measured.chain.parameters
    if len(measured.silent) == len(measured.experiments):
        return _nothing(names)
    ranked = _local(measured, settings)
    if ranked.rank == len(names):
        plain = without_dead_time(measured)
        listed = next(lists(plain, plain, settings.seed, confirm=True), None)
        if listed is not None and _bounds(listed):
            return _from_list(measured, ranked, listed, settings)
    return _by_ideal(measured, ranked, settings)


def _nothing(names: tuple[str, ...]) -> ParameterIdentifiability:
    certainty, bits = joint([])
    levels = dict.fromkeys(names, Level.NOT)
    return ParameterIdentifiability(levels, 0, 1, None, certainty, bits, SILENT)


def _local(measured: MeasuredChain, settings: Settings) -> Local:
    model = MachineModel(measured)
    ranked = local(model, settings)
    # several entries may have been special at a point that was drawn again: a bit for each
    lost = enough(model.minor_size(None), settings.points)
    return replace(ranked, safety=ranked.safety - lost) if ranked.safety else ranked


def _bounds(listed: ExperimentFibre) -> bool:
    """Return True if generic points have no more solutions than remain here: all are simple."""
    return all(s.confirmation is Confirmation.SUBSYSTEM for s in listed.fibre.solutions)


def _from_list(
    measured: MeasuredChain, ranked: Local, listed: ExperimentFibre, settings: Settings
) -> ParameterIdentifiability:
    """From a list: at most so many vectors fit, and one if it is the point alone."""
    most = len(listed.kept)
    bound = safety_of_point(measured.chain) - 1
    if most == 1:
        grade = joint([ranked.safety, bound])
        levels = dict.fromkeys(measured.chain.parameters, Level.GLOBAL)
        return ParameterIdentifiability(levels, ranked.rank, 1, 1, *grade)
    by_ideal = _by_ideal(measured, ranked, settings)
    certainty, bits = joint([by_ideal.safety, bound])
    return replace(
        by_ideal, most=min(most, by_ideal.most or most), certainty=certainty, safety=bits
    )


def _by_ideal(
    measured: MeasuredChain, ranked: Local, settings: Settings
) -> ParameterIdentifiability:
    sure = ("Td",) if measured.chain.dead_time else ()
    return by_parameter(
        measured.chain.parameters, ranked, stacked_map(without_dead_time(measured)), settings, sure
    )


IDENTIFIABLE = Question("identifiability under experiments", identifiability_under, encode, decode)
