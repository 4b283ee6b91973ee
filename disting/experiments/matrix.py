"""A chain under several experiments as a matrix of transfer functions, one row for each."""

from disting.algebra.symbols import RationalFunction
from disting.experiments.experiment import MeasuredChain
from disting.experiments.listing import without_dead_time
from disting.experiments.machine_model import expand, shape
from disting.general.matrix_model import MatrixModel, of_ratios


def matrix_of(measured: MeasuredChain) -> MatrixModel:
    """The transfer functions that are not zero, without a dead time, in the chain's parameters.

    >>> from disting.experiments.experiment import Experiment
    >>> from disting.model.chain import Chain
    >>> two = MeasuredChain(Chain(2, damped=False), (Experiment(), Experiment(sensor=1)))
    >>> matrix_of(two).shape
    (2, 1)
    """
    plain = without_dead_time(measured)
    entries = [entry for entry in plain.entries if shape(entry).numerator]
    ratios = [[RationalFunction(*expand(entry))] for entry in entries]
    return of_ratios(ratios, plain.chain.parameters, "measured")
