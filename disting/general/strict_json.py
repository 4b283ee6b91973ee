"""JSON that a person wrote, read without losing anything: numbers as they stand, no key twice."""

import json
from collections.abc import Iterable, Mapping
from typing import Any, NoReturn

from disting.errors import InputError, listed, shown
from disting.files import once

Plain = Mapping[str, Any]


class Number(str):
    """A number as it stands in the file."""

    __slots__ = ()


def plain_of(content: bytes) -> object:
    """What the bytes hold, numbers as their texts; raises InputError for what is no such JSON."""
    try:
        return json.loads(
            content.decode("utf-8-sig"),
            object_pairs_hook=once,
            parse_float=Number,
            parse_int=Number,
            parse_constant=_refuse_constant,
        )
    except UnicodeDecodeError:
        raise InputError("this is no text in UTF-8; save it so") from None
    except json.JSONDecodeError as reason:
        raise InputError(
            f"this is no JSON: {reason.msg}, line {reason.lineno}, column {reason.colno}; the guide"
            " shows a whole file"
        ) from None
    except RecursionError:
        raise InputError("brackets are nested too deeply; the guide shows a whole file") from None


def _refuse_constant(text: str) -> NoReturn:
    raise InputError(f"{text} is no number of a model; write a number or an expression")


def object_of(data: object, known: Iterable[str], what: str) -> Plain:
    """A JSON object with these keys only; raises InputError for anything else."""
    keys = listed(f'"{key}"' for key in known)
    if not isinstance(data, dict):
        raise InputError(f"{what} is one object in braces with the keys {keys}")
    unknown = [key for key in data if key not in known]
    if unknown:
        raise InputError(f"{shown(unknown[0])} is no key of {what}; known are {keys}")
    return data


def text_of(given: Plain, key: str, default: str) -> str:
    """The text at a key; raises InputError for anything else."""
    value = given.get(key, default)
    if type(value) is not str:
        raise InputError(f'"{key}" is a text in quotation marks, not {shown(value)}')
    return value
