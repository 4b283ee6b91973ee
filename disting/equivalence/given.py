"""What a user gives: models as chains or text such as 3:1, values as numbers or text, taken exactly as fractions."""

import re
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from numbers import Number

from flint import fmpq

from disting.errors import InputError
from disting.model.chain import Chain
from disting.model.family import Family

MOST_DIGITS = 99  # of a value's decimal exponent, and of its text
Value = Number | str


def chain_of(model: Chain | str, family: Family) -> Chain:
    """A chain as it is; text such as 3:11 is model 11 of the 3-mass family, with damping and sensor of the given family.

    Raises InputError.
    """
    if isinstance(model, Chain):
        return model
    match = re.fullmatch(r"(\d{1,2}):(\d{1,6})", str(model).strip())
    if not match:
        raise InputError(f"a model is a Chain or written masses:number, for instance 3:4, not {model!r}")
    return replace(family, n_masses=int(match[1]))[int(match[2])]


def chains_of(to: Chain | Family | str, given: Chain) -> tuple[Chain, ...]:
    """The chains to look at: one, or all of a family; text such as 3:11 or 3 means damping and sensor of the given chain.

    Raises InputError.
    """
    if isinstance(to, Family):
        return to.models
    family = Family(given.n_masses, given.damped, given.sensor)
    if isinstance(to, str) and re.fullmatch(r"\s*\d{1,2}\s*", to):
        return replace(family, n_masses=int(to)).models
    return (chain_of(to, family),)


def point_of(chain: Chain, values: Mapping[str, Value]) -> dict[str, fmpq]:
    """All parameters of a chain as exact positive fractions; a float counts as its decimal text.

    Raises InputError for missing and unknown names and for values that are not positive numbers.

    >>> point_of(Chain(1), {"m1": 0.1})
    {'m1': 1/10}
    """
    names = ", ".join(chain.parameters)
    unknown = [str(name) for name in values if name not in chain.parameters]
    if unknown:
        raise InputError(f"{', '.join(unknown)}: no parameter of the chain with {chain}; its parameters are {names}")
    missing = [name for name in chain.parameters if name not in values]
    if missing:
        raise InputError(f"the value of {', '.join(missing)} is missing; the parameters of the chain with {chain} are {names}")
    return {name: _fraction(name, values[name]) for name in chain.parameters}


def assignments(texts: list[str]) -> dict[str, str]:
    """Values from texts such as m1=1,k12=3/4. Raises InputError.

    >>> assignments(["m1=1, m2=0.5", "k12=1e3"])
    {'m1': '1', 'm2': '0.5', 'k12': '1e3'}
    """
    found: dict[str, str] = {}
    for part in (part.strip() for text in texts for part in text.split(",")):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not (name and equals and value):
            raise InputError(f"values are written name=number, separated by commas, such as m1=1,k12=3/4, not {part!r}")
        if name in found:
            raise InputError(f"{name} is given twice")
        found[name] = value
    return found


def _fraction(name: str, value: Value) -> fmpq:
    exact = _number(str(value).strip())
    if exact is None:
        raise InputError(f"{name} = {str(value)[:40]!r}: a number such as 2, 0.5, 3/4 or 1e-3 is needed")
    if exact <= 0:
        reason = "masses, springs, dampers and times are positive; a chain without an element is another model"
        raise InputError(f"{name} = {value}: {reason}")
    return fmpq(exact.numerator, exact.denominator)


def _number(text: str) -> Fraction | None:
    exponent = re.search(r"[eE]([+-]?\d+)$", text)
    if len(text) > MOST_DIGITS or (exponent and (len(exponent[1]) > 4 or abs(int(exponent[1])) > MOST_DIGITS)):
        return None
    try:
        return Fraction(text)
    except (ValueError, ZeroDivisionError):
        return None
