"""Questions on pairs of general models: whether a renaming connects them, their polynomial maps,
and the exact decision where conditions 1 to 7 do not decide: one fibre as a polynomial ideal.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TypeVar, overload

from disting.conditions.rule import Finding
from disting.decide import SAME_NETWORKS, first_finding
from disting.fibres.ideals import (
    CoefficientMap,
    Fraction as Ratio,
    Limits,
    PolynomialMap,
    StackedMap,
    decide_matched,
    match_maps,
    stacked_maps,
)
from disting.general.expansion import TooLargeError
from disting.general.matrix_model import AnyModel, MatrixModel, Model, Terms
from disting.general.powers import Cell, Powers, in_v, out_of_v, separating_weights
from disting.model.chain import Chain, Sort
from disting.model.question import Settings
from disting.network.chains import RenamedChain, as_renamed_chain
from disting.network.denotation import Naming, naming_of
from disting.network.network import Network
from disting.questions.same.exact import SAFETY, as_finding

LIMITS = Limits(safety=SAFETY, long=True)
M = TypeVar("M", Model, AnyModel)
LEFT, RIGHT = "{left}", "{right}"  # stand for the names of both while an answer is kept


def is_writable(model: AnyModel) -> bool:
    """Return True if its terms, in which exact decisions are made, are not too many."""
    try:
        return all(e.numerator_terms is not None for e in model.entries)
    except TooLargeError:
        return False


def measurand(models: Iterable[Chain | AnyModel]) -> str:
    """Measured quantity of the models: an impedance for circuits, a response otherwise."""
    networks = [None if isinstance(m, Chain) else m.network for m in models]
    return "impedance" if all(map(_has_impedance, networks)) else "response"


def _has_impedance(network: Network | None) -> bool:
    """Return True if it is a circuit whose voltage is measured where the current flows."""
    if network is None:
        return False
    return network.sort is Sort.CIRCUIT and network.inputs == network.outputs


def as_chain(model: Chain | AnyModel) -> Chain | None:
    """The chain that it is, if it is one."""
    if isinstance(model, Chain):
        return model
    return model.chain if isinstance(model, Model) else None


def renamed_chain(model: Chain | AnyModel) -> RenamedChain | None:
    """The chain as which a model is compared, if it is one in whatever names of its parameters."""
    chain = as_chain(model)
    if chain is not None:
        return RenamedChain(chain, {name: name for name in chain.parameters})
    if isinstance(model, Chain) or model.network is None:
        return None
    found = as_renamed_chain(model.network)
    is_misnamed = found and naming_of(model.name, found.chain) is Naming.FALSE
    return None if is_misnamed else found


def of_network(network: Network) -> AnyModel:
    """The transfer function of a network, or the matrix of all; raises InputError."""
    single = network.shape == (1, 1)
    return Model.from_network(network) if single else MatrixModel.from_network(network)


def as_model(source: Chain | Network | AnyModel) -> AnyModel:
    """The general model of a chain or of a network; a model as it is. Raises InputError."""
    if isinstance(source, Chain):
        return Model.from_chain(source)
    return of_network(source) if isinstance(source, Network) else source


def on_one_variable(models: Sequence[M]) -> list[M]:
    """The same models, all in powers of one variable v: s^(1/2) where one of them has such, and
    v^w for the first exponent of each, another weight for the second one, and so on.

    So the exponents of two models are matched by the powers with which they occur; `readings` has
    the other ways.
    """
    halves = any(m.powers.halves for m in models)
    wide = max(models, key=lambda m: len(m.powers.weights), default=None)
    if wide is None or not wide.powers.weights:
        return [m if m.powers.halves == halves else in_powers(m, Powers(halves)) for m in models]
    cells = [_double_powers(cell, m.powers.halves < halves) for m in models for cell in cells_of(m)]
    size = len(wide.powers.weights)
    powers = separating_weights(
        [_pad_cell(cell, size) for cell in cells], halves, wide.powers.exponents
    )
    return [in_powers(m, powers) for m in models]


@overload
def in_powers(model: Model, powers: Powers, places: Sequence[int] = ()) -> Model: ...
@overload
def in_powers(model: AnyModel, powers: Powers, places: Sequence[int] = ()) -> AnyModel: ...
def in_powers(model: AnyModel, powers: Powers, places: Sequence[int] = ()) -> AnyModel:
    """The model in these powers of v; its exponents have the weights at these places, else the
    first ones.
    """
    places = places or range(len(model.powers.weights))
    if isinstance(model, MatrixModel):
        rows = (
            tuple(None if e is None else _lift_exponents(e, powers, places) for e in row)
            for row in model.rows
        )
        the_model: AnyModel = replace(model, rows=tuple(rows))
    else:
        the_model = _lift_exponents(model, powers, places)
    object.__setattr__(the_model, "network", model.network)
    return the_model


def _lift_exponents(model: Model, powers: Powers, places: Sequence[int]) -> Model:
    own, size = model.powers, max(places, default=-1) + 1
    (cell,) = (_double_powers(c, own.halves < powers.halves) for c in cells_of(model))
    top, bottom = ({_at(parts, places, size): c for parts, c in side.items()} for side in cell)
    names = dict(zip(places, own.exponents, strict=True))
    weights = tuple((names.get(i, n), w) for i, (n, w) in enumerate(powers.weights[:size]))
    other_powers = replace(powers, weights=weights, lost=0, unseen=own.unseen)
    numerator, denominator, other_powers = in_v((top, bottom), other_powers)
    return replace(
        model, numerator_terms=numerator, denominator_terms=denominator, powers=other_powers
    )


def _at(parts: tuple[int, ...], places: Sequence[int], size: int) -> tuple[int, ...]:
    exponents = [0] * size
    for at, power in zip(places, parts[1:], strict=True):
        exponents[at] = power
    return parts[0], *exponents


def cells_of(model: AnyModel) -> list[Cell]:
    """Its transfer functions by the powers of s and of every s^n."""
    return [out_of_v((e.numerator_terms, e.denominator_terms), e.powers) for e in model.entries]


def _double_powers(cell: Cell, is_doubled: bool) -> Cell:
    """With powers of s^(1/2) in place of those of s."""
    by = 1 + is_doubled
    top, bottom = ({(i * by, *more): c for (i, *more), c in side.items()} for side in cell)
    return top, bottom


def _pad_cell(cell: Cell, size: int) -> Cell:
    top, bottom = ({(*p, *[0] * (size + 1 - len(p))): c for p, c in side.items()} for side in cell)
    return top, bottom


def without_names(model: AnyModel, name: str = "model") -> AnyModel:
    """The transfer functions alone, whatever they are called and however they were made."""
    return replace(model, name=name)


def as_network(model: AnyModel, name: str) -> AnyModel:
    """The same as the network that it is, whatever that is called."""
    the_model = without_names(model, name)
    if model.network is not None:
        object.__setattr__(the_model, "network", replace(model.network, name="network"))
    return the_model


def with_names(note: str, left: str, right: str) -> str:
    """A note of an answer that was kept, with the names of both in it."""
    names = {LEFT: left, RIGHT: right}
    return re.sub(f"{LEFT}|{RIGHT}", lambda seen: names[seen[0]], note)


def same(left: AnyModel, right: AnyModel, settings: Settings) -> Finding:
    """The exact decision, for equal ranks and degrees."""
    finding: Finding = first_finding(SAME_NETWORKS.rows, left, right, settings)
    return finding


def by_ideals(left: AnyModel, right: AnyModel, settings: Settings) -> Finding:
    """The ideal of one fibre of the stacked map."""
    maps = maps_of(left, right)
    return as_finding(decide_matched(*maps, equal_rank=True, seed=settings.seed, limits=LIMITS))


def maps_of(left: AnyModel, right: AnyModel) -> tuple[PolynomialMap, PolynomialMap]:
    """The polynomial maps of two models of equal degrees, in a form in which equal transfer
    functions are equal coordinates; their parameters are p1, p2, ..
    """
    (own_model, *more), (other_model, *others) = left.entries, right.entries
    if not more and not others:
        return match_maps(coefficient_map(own_model), coefficient_map(other_model))
    own_stacked_map, other = _stack_maps(left, right)
    return own_stacked_map, other


def map_of(model: AnyModel) -> StackedMap:
    """The polynomial map of its coefficients, for its fibre in itself."""
    return _stack_maps(model)[0]


def coefficient_map(model: Model) -> CoefficientMap:
    """One transfer function as the ideals know it."""
    names = _names(model)
    plain = replace(model, parameters=names)
    return CoefficientMap(names, plain.numerator, plain.denominator)


def is_renamed(left: AnyModel, right: AnyModel, renaming: dict[str, str]) -> bool:
    """Return True if renaming the left parameters, one to one, turns all left transfer functions
    into the right ones: exact.
    """
    if left.shape != right.shape or sorted(renaming) != sorted(left.parameters):
        return False
    if sorted(renaming.values()) != sorted(right.parameters):
        return False
    place = {renaming[name]: i for i, name in enumerate(left.parameters)}
    sources = [place[name] for name in right.parameters]
    return all(
        a is b is None or (a and b and _carries_over(a, b, sources))
        for a, b in zip(left.cells, right.cells, strict=True)
    )


def _carries_over(left: Model, right: Model, sources: list[int]) -> bool:
    """Return True if the coefficients become those of the other one, with the sign of all or none
    changed.
    """
    sides = [(*m.numerator_terms, *m.denominator_terms) for m in (left, right)]
    moved = [{tuple(e[i] for i in sources): c for e, c in terms} for terms in sides[0]]
    wanted = [dict(terms) for terms in sides[1]]
    negated = [{e: -c for e, c in terms.items()} for terms in wanted]
    return left.degrees == right.degrees and moved in (wanted, negated)


def _stack_maps(*models: AnyModel) -> tuple[StackedMap, ...]:
    sides = [[_monic((e.numerator_terms, e.denominator_terms)) for e in m.entries] for m in models]
    return stacked_maps([_names(m) for m in models], sides)


def _names(model: AnyModel) -> tuple[str, ...]:
    return tuple(f"p{i + 1}" for i in range(len(model.parameters)))


def _monic(sides: Ratio) -> Ratio:
    """Both sides with the sign that makes a leading -1 a leading 1."""
    lead = sides[1][-1]
    return (_negate_side(sides[0]), _negate_side(sides[1])) if lead[0][1] == -1 else sides


def _negate_side(side: tuple[Terms, ...]) -> tuple[Terms, ...]:
    return tuple(tuple((e, -c) for e, c in terms) for terms in side)
