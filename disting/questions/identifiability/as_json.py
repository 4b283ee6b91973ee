"""Findings from plain data, as a cache or a file keeps them."""

from collections.abc import Callable, Iterable
from typing import Any

from disting.algebra.certainty import Certainty, Grade
from disting.fibres.synthesis.result import Answer
from disting.questions.identifiability.formula import Formula
from disting.questions.identifiability.parts import (
    Alternative,
    Combination,
    Level,
    Origin,
    Renaming,
    Scaling,
)


def decoded(data: dict[str, Any]) -> dict[str, Any]:
    """Fields of an Identifiability; lists become tuples. Raises KeyError, TypeError or
    ValueError for what is none.
    """
    return data | {name: _READ[name](data[name]) for name in _READ}


def _each(
    read: Callable[[dict[str, Any]], Any],
) -> Callable[[Iterable[dict[str, Any]]], tuple[Any, ...]]:
    return lambda items: tuple(read(item) for item in items)


def _pairs(items: Iterable[Iterable[Any]]) -> tuple[tuple[Any, ...], ...]:
    return tuple(tuple(pair) for pair in items)


def _grade(items: Iterable[Any]) -> Grade:
    certainty, bits = items
    return Certainty(certainty), int(bits)


def _alternative(d: dict[str, Any]) -> Alternative:
    return Alternative(
        Origin(d["origin"]),
        Answer(d["real"]),
        Answer(d["positive"]),
        Certainty(d["certainty"]),
        d["note"],
    )


def _combination(d: dict[str, Any]) -> Combination:
    terms = tuple((int(c), _pairs(exponents)) for c, exponents in d["formula"]["terms"])
    return Combination(Formula(terms), d["name"], Answer(d["unique"]), Certainty(d["certainty"]))


def _renaming(d: dict[str, Any]) -> Renaming:
    return Renaming(_pairs(d["moved"]), tuple(d["symmetries"]))


_READ: dict[str, Callable[[Any], Any]] = {
    "parameters": tuple,
    "rank_grade": _grade,
    "level": Level,
    "level_grade": _grade,
    "count_grade": _grade,
    "alternatives": _each(_alternative),
    "singles": _each(_combination),
    "basis": _each(_combination),
    "scalings": _each(lambda d: Scaling(_pairs(d["weights"]))),
    "renamings": _each(_renaming),
    "point": _pairs,
}
