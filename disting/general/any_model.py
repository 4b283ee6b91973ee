"""What is asked of pairs of general models: whether a renaming connects them, their polynomial
maps, and the exact decision where conditions 1 to 7 stay silent: one fibre as a polynomial ideal.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from disting.conditions.finding import Finding
from disting.fibres.ideals import (
    CoefficientMap,
    Limits,
    PolynomialMap,
    StackedMap,
    decide_matched,
    matched,
    stacked_maps,
)
from disting.fibres.ideals import Fraction as Ratio
from disting.general.matrix_model import AnyModel, MatrixModel
from disting.general.model import Model, Terms
from disting.model.chain import Chain
from disting.model.question import Settings
from disting.network.element import Sort
from disting.network.network import Network
from disting.questions.same.exact import SAFETY, decided

LIMITS = Limits(safety=SAFETY)


def measured(models: Iterable[Chain | AnyModel]) -> str:
    """What is measured of them: of circuits an impedance, of anything else a response."""
    networks = [None if isinstance(m, Chain) else m.network for m in models]
    return "impedance" if all(map(_has_impedance, networks)) else "response"


def _has_impedance(network: Network | None) -> bool:
    """Whether it is a circuit whose voltage is measured where the current flows."""
    if network is None:
        return False
    return network.sort is Sort.CIRCUIT and network.inputs == network.outputs


def as_chain(model: Chain | AnyModel) -> Chain | None:
    """The chain that it is, if it is one."""
    if isinstance(model, Chain):
        return model
    return model.chain if isinstance(model, Model) else None


def of_network(network: Network) -> AnyModel:
    """The transfer function of a network, or the matrix of all; raises InputError."""
    single = network.shape == (1, 1)
    return Model.from_network(network) if single else MatrixModel.from_network(network)


def on_one_variable(models: Sequence[AnyModel]) -> list[AnyModel]:
    """The same models, all in powers of s^(1/2) where one of them has such."""
    if not any(model.halves for model in models):
        return list(models)
    return [model if model.halves else _in_halves(model) for model in models]


def _in_halves(model: AnyModel) -> AnyModel:
    """The model written in powers of s^(1/2): every other coefficient is zero."""
    if isinstance(model, Model):
        lifted: AnyModel = replace(
            model,
            numerator_terms=_spread(model.numerator_terms),
            denominator_terms=_spread(model.denominator_terms),
            halves=True,
        )
    else:
        entries = (tuple(None if e is None else _in_halves(e) for e in row) for row in model.rows)
        lifted = replace(model, rows=tuple(entries))  # type: ignore[arg-type]
    object.__setattr__(lifted, "network", model.network)
    return lifted


def _spread(side: tuple[Terms, ...]) -> tuple[Terms, ...]:
    return tuple(c for terms in side for c in (terms, ()))[:-1]


def unnamed(model: AnyModel, name: str = "model") -> AnyModel:
    """The transfer functions alone, whatever they are called and however they were made."""
    return replace(model, name=name)


def same(left: AnyModel, right: AnyModel, settings: Settings) -> Finding:
    """The exact decision, for equal ranks and degrees."""
    maps = maps_of(left, right)
    return decided(decide_matched(*maps, equal_rank=True, seed=settings.seed, limits=LIMITS))


def maps_of(left: AnyModel, right: AnyModel) -> tuple[PolynomialMap, PolynomialMap]:
    """The polynomial maps of two models of equal degrees, in a form in which equal transfer
    functions are equal coordinates; their parameters are p1, p2, ..
    """
    (here, *more), (there, *others) = left.entries, right.entries
    if not more and not others:
        return matched(coefficient_map(here), coefficient_map(there))
    one, other = _stacked(left, right)
    return one, other


def map_of(model: AnyModel) -> StackedMap:
    """The polynomial map of its coefficients, for its fibre in itself."""
    return _stacked(model)[0]


def coefficient_map(model: Model) -> CoefficientMap:
    """One transfer function as the ideals know it."""
    names = _names(model)
    plain = replace(model, parameters=names)
    return CoefficientMap(names, plain.numerator, plain.denominator)


def is_renamed(left: AnyModel, right: AnyModel, renaming: dict[str, str]) -> bool:
    """Whether renaming the left parameters, one to one, turns all left transfer functions into the
    right ones: exact.
    """
    if left.shape != right.shape or sorted(renaming) != sorted(left.parameters):
        return False
    if sorted(renaming.values()) != sorted(right.parameters):
        return False
    place = {renaming[name]: i for i, name in enumerate(left.parameters)}
    sources = [place[name] for name in right.parameters]
    return all(
        a is b is None or (a and b and _carried(a, b, sources))
        for a, b in zip(left.cells, right.cells, strict=True)
    )


def _carried(left: Model, right: Model, sources: list[int]) -> bool:
    """Whether the coefficients become those of the other one, all or none with the sign changed."""
    sides = [(*m.numerator_terms, *m.denominator_terms) for m in (left, right)]
    moved = [{tuple(e[i] for i in sources): c for e, c in terms} for terms in sides[0]]
    there = [dict(terms) for terms in sides[1]]
    negated = [{e: -c for e, c in terms.items()} for terms in there]
    return left.degrees == right.degrees and moved in (there, negated)


def _stacked(*models: AnyModel) -> tuple[StackedMap, ...]:
    sides = [[_monic((e.numerator_terms, e.denominator_terms)) for e in m.entries] for m in models]
    return stacked_maps([_names(m) for m in models], sides)


def _names(model: AnyModel) -> tuple[str, ...]:
    return tuple(f"p{i + 1}" for i in range(len(model.parameters)))


def _monic(sides: Ratio) -> Ratio:
    """Both sides with the sign that makes a leading -1 a leading 1."""
    lead = sides[1][-1]
    return (_negated(sides[0]), _negated(sides[1])) if lead[0][1] == -1 else sides


def _negated(side: tuple[Terms, ...]) -> tuple[Terms, ...]:
    return tuple(tuple((e, -c) for e, c in terms) for terms in side)
