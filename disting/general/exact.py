"""The exact decision for general models, where conditions 1 to 7 stay silent: one fibre as a
polynomial ideal.
"""

from dataclasses import replace

from disting.conditions.finding import Finding
from disting.fibres.ideals import CoefficientMap, Limits, decide
from disting.general.model import Model
from disting.questions.same.exact import SAFETY, decided

LIMITS = Limits(safety=SAFETY)


def exact_finding(left: Model, right: Model, seed: str, limits: Limits = LIMITS) -> Finding:
    """The finding for two models of equal rank and degrees."""
    found = decide(
        coefficient_map(left), coefficient_map(right), equal_rank=True, seed=seed, limits=limits
    )
    return decided(found)


def coefficient_map(model: Model) -> CoefficientMap:
    """The model as the ideals know it, with names of its own: p1, p2, .. in the order of the
    parameters.
    """
    names = tuple(f"p{i + 1}" for i in range(len(model.parameters)))
    plain = replace(model, parameters=names)
    return CoefficientMap(names, plain.numerator, plain.denominator)
