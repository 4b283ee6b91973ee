"""User input: the structures to examine as chains or text such as 3+b*, values as numbers or text,
converted exactly to fractions.

A lag and a dead time belong to the actuator and the bench: other structures inherit them from the
given model.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import chain as chained, combinations
from numbers import Number

from flint import fmpq

from disting.errors import InputError, short
from disting.model.chain import Chain
from disting.model.family import Family
from disting.model.names import (
    EXTRAS,
    MOST_DIGITS,
    chain_of,
    extend,
    is_too_long,
    name_of,
    with_masses,
)
from disting.network.network import Network

Value = Number | float | str  # type checkers do not take int and float for a Number


def chains_of(to: Chain | Family | str, chain: Chain) -> tuple[Chain, ...]:
    """The chains to look at: one, or all of a family; text such as 3:11, A11 or 3 means damping
    and sensor of the given chain.

    3+b1 denotes all structures of 3 masses with this damper to the ground, 3+b* for all with any
    set of them. Families and structures given as text have the lag and the dead time of the given
    chain too: without them none could be equivalent. A Chain is taken as it is.

    Raises InputError.

    >>> [chain.dead_time for chain in chains_of("2", Chain(2, dead_time=True, damped=False))]
    [True, True, True]
    """
    if isinstance(to, Chain):
        return (to,)
    return tuple(
        replace(c, lag=c.lag or chain.lag, dead_time=c.dead_time or chain.dead_time)
        for c in _chains_by_name(to, chain)
    )


def _chains_by_name(to: Family | str, like: Chain) -> tuple[Chain, ...]:
    """The chains as their text names them."""
    if isinstance(to, Family):
        return to.models
    family = Family(like.n_masses, like.damped, like.sensor)
    match = re.fullmatch(rf"(\d{{1,2}})(\+b\*)?({EXTRAS})", str(to).strip())
    if match is None:
        return (chain_of(to, family, masses=like.n_masses),)
    plain = [extend(chain, match[3]) for chain in with_masses(family, int(match[1])).models]
    return (
        tuple(c for chain in plain for c in _with_damper_sets(chain)) if match[2] else tuple(plain)
    )


def _with_damper_sets(chain: Chain) -> Iterator[Chain]:
    """The chain with every set of dampers to the ground."""
    masses = range(1, chain.n_masses + 1)
    for chosen in chained.from_iterable(
        combinations(masses, size) for size in range(chain.n_masses + 1)
    ):
        yield replace(chain, ground_dampers=chosen)


def point_of(model: Chain | Network, values: Mapping[str, Value]) -> dict[str, fmpq]:
    """All parameters of a model as exact positive fractions; a float counts as its decimal text.

    Raises InputError for missing and unknown names and for values that are not positive numbers.

    >>> point_of(Chain(1, damped=False), {"m1": 0.1})
    {'m1': 1/10}
    """
    if isinstance(model, Chain):
        called, wanted = name_of(model), model.parameters
    else:
        called, wanted = model.name, (*model.parameters, *model.exponents)
    names = ", ".join(wanted)
    unknown = [str(name) for name in values if name not in wanted]
    if unknown:
        raise InputError(
            f"{', '.join(unknown)}: no parameter of {called}; its parameters are {names}"
        )
    missing = [name for name in wanted if name not in values]
    if missing:
        raise InputError(
            f"the value of {', '.join(missing)} is missing; the parameters of {called} are {names}"
        )
    numbers = {name: _fraction(name, values[name]) for name in wanted}
    for name, value in numbers.items():
        if value <= 0:
            raise InputError(f"{name} = {values[name]}: {_why_positive(model, name, value == 0)}")
    return numbers


def assignments(texts: list[str]) -> dict[str, str]:
    """Values from texts such as m1=1,k12=3/4. Raises InputError.

    >>> assignments(["m1=1, m2=0.5", "k12=1e3"])
    {'m1': '1', 'm2': '0.5', 'k12': '1e3'}
    """
    the_texts: dict[str, str] = {}
    for part in (part.strip() for text in texts for part in text.split(",")):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not (name and equals and value):
            raise InputError(
                "values are written name=number, separated by commas, such as m1=1,k12=3/4, not"
                f" {short(part)}"
            )
        if name in the_texts:
            raise InputError(f"{name} is given twice")
        the_texts[name] = value
    return the_texts


def _fraction(name: str, value: Value) -> fmpq:
    text = str(value).strip()
    if is_too_long(text):
        limits = f"at most {MOST_DIGITS} characters, and at most {MOST_DIGITS} as its power of ten"
        raise InputError(f"{name} = {short(text)}: a value has {limits}; choose other units")
    exact = _number(text)
    if exact is None:
        raise InputError(f"{name} = {short(value)}: a number such as 2, 0.5, 3/4 or 1e-3 is needed")
    return fmpq(exact.numerator, exact.denominator)


def _why_positive(model: Chain | Network, name: str, is_zero: bool) -> str:
    """Why a value has to be, and what to use instead."""
    if isinstance(model, Chain):
        without = _without(name) if is_zero else ""
        return (
            "masses, springs, dampers and times are positive; a chain without an element is another"
            f" model{without}"
        )
    return "values of elements are positive; a network without an element is another one"


def _without(name: str) -> str:
    """Advice for a damper that is zero: the structure to use instead."""
    match name[0]:
        case "b":
            return f": leave +{name} and its value away"
        case "d":
            return (
                ": without dampers beside all springs say --undamped and leave their values away;"
                " beside one of several springs 1e-90 has no effect"
            )
    return ""


def _number(text: str) -> Fraction | None:
    try:
        return Fraction(text)
    except (ValueError, ZeroDivisionError):
        return None
