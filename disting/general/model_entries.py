"""One model as an entry of a JSON file: read without losing anything of it, and written."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any, NoReturn

from disting.errors import InputError, enumeration, of_type, short
from disting.files import unique_keys
from disting.general.any_model import as_chain, of_network
from disting.general.expression import polynomial_text
from disting.general.matrix_model import AnyModel, MatrixModel, Model
from disting.general.naming import LARGEST_CHAIN
from disting.model.chain import Chain, Sensor
from disting.model.family import Family
from disting.model.names import DAMPED, chain_of, name_of
from disting.network.notation.compartments import space_of_flows
from disting.network.notation.entries import FORMS as NETWORKS, entry_of, network_of_entry

Plain = Mapping[str, Any]
KINDS = {
    "A": ("A", "B", "C", "D", "x0", "known"),
    "num": ("num", "den"),
    "G": ("G",),
    "chain": ("chain", "damped", "sensor"),
    **NETWORKS,
    "flows": (*NETWORKS["flows"], "x0", "known"),
}  # by the key that a model of this kind always has: all its keys
FORMS = (
    'a state space "A", "B", "C", "D", a transfer function "num" and "den" or "G", a "chain"'
    ' such as "3:1+b2", or a "circuit", "machine", "network", "flows", "elements" or "components"'
)


class Number(str):
    """A number as written in the file."""

    __slots__ = ()


def plain_of(content: bytes) -> object:
    """Parse the bytes as JSON, numbers as their texts; raises InputError for other content."""
    try:
        return json.loads(
            content.decode("utf-8-sig"),
            object_pairs_hook=unique_keys,
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


def object_of(data: object, items: Iterable[str], what: str) -> Plain:
    """A JSON object with these keys only; raises InputError for anything else."""
    keys = enumeration(f'"{key}"' for key in items)
    if not isinstance(data, dict):
        raise InputError(f"{what} is one object in braces with the keys {keys}")
    unknown = [key for key in data if key not in items]
    if unknown:
        raise InputError(f"{short(unknown[0])} is no key of {what}; known are {keys}")
    return data


def text_of(entry: Plain, key: str, default: str) -> str:
    """The text at a key; raises InputError for anything else."""
    value = entry.get(key, default)
    if type(value) is not str:
        raise InputError(f'"{key}" is a text in quotation marks, not {short(value)}')
    return value


def as_entry(model: AnyModel) -> dict[str, object]:
    """A model as a file has it: a chain by its name, a network by its elements, another one by its
    transfer function in lowest terms; a matrix as its expressions, with the parameters that they
    lack. Raises InputError for a parameter s.
    """
    refuse_s(model)
    chain = as_chain(model)
    if chain is not None and _can_be_listed(chain):
        return {"name": model.name, **_list_entry(chain)}
    if model.network is not None:
        return {"name": model.name, **entry_of(model.network)}
    if isinstance(model, Model):
        return {"name": model.name, **_of_entry(model)}
    rows = [["0" if e is None else _ratio(_of_entry(e)) for e in row] for row in model.rows]
    return {"name": model.name, "G": rows}


def read_entry(entry: Mapping[str, object]) -> AnyModel:
    """Inverse of `as_entry`, whatever the model is called; raises InputError."""
    written = ("num", "G", "flows", "elements")
    name, kinds = entry.get("name"), [kind for kind in written if kind in entry]
    if type(name) is not str or len(kinds) != 1:
        raise InputError('a model has a name and "num" and "den", "G", "flows" or "elements"')
    return of_kind(entry, name, "s")


def of_kind(entry: Plain, name: str, variable: str) -> AnyModel:
    """The model of an entry, by the key for its kind; raises InputError."""
    kinds = [kind for kind in KINDS if kind in entry]
    if len(kinds) != 1:
        raise InputError(f"a model is {FORMS}; this one is {' and '.join(kinds) or 'none of them'}")
    names = KINDS[kinds[0]]
    plain = object_of(entry, ("name", *names), f'a model with "{kinds[0]}"')
    match kinds[0]:
        case "A":
            _refuse_missing(plain, ("C",) if "x0" in plain else ("B", "C"))
            space = (
                plain["A"],
                plain.get("B"),
                plain["C"],
                plain.get("D", 0),
            )
            return _single(_of_space(space, plain, variable, name))
        case "num":
            return Model.from_transfer_function(
                plain["num"], plain.get("den", 1), s=variable, name=name
            )
        case "G":
            if isinstance(plain["G"], list):
                return MatrixModel.from_transfer_functions(plain["G"], s=variable, name=name)
            return Model.from_transfer_function(plain["G"], s=variable, name=name)
        case "chain":
            return _of_chain(plain, name)
    if "x0" in plain or "known" in plain:
        return _single(_of_flows(plain, variable, name))
    return of_network(network_of_entry(plain, name))


def _of_space(space: tuple[Any, ...], entry: Plain, variable: str, name: str) -> MatrixModel:
    own_entry = of_type(entry.get("known", []), list, '"known" is a list of names of parameters')
    return MatrixModel.from_state_space(
        *space, x0=entry.get("x0"), known=own_entry, s=variable, name=name
    )


def _of_flows(entry: Plain, variable: str, name: str) -> MatrixModel:
    """Compartments that are not empty at first; x0 has their contents, by number."""
    start = of_type(entry.get("x0", {}), dict, '"x0" has contents by compartment: {"1": "c1"}')
    flows = of_type(entry["flows"], list, '"flows" is a list of pairs such as [1, 2]')
    nodes = {str(i) for flow in flows if isinstance(flow, list) for i in flow}
    lost = [i for i in start if i not in nodes - {"0"}]
    if lost:
        raise InputError(f'"x0" has compartment {short(lost[0])}, which none of the flows has')
    given = entry.get("input", [])
    inputs = given if isinstance(given, list) else [given]
    plain = {key: value for key, value in entry.items() if key not in ("x0", "known")}
    network = network_of_entry({**plain, "input": [*inputs, *start]}, name)
    a, b, c = space_of_flows(network)
    entering = [row[: len(inputs)] for row in b] if inputs else None
    contents = [start.get(str(i), 0) for i in network.nodes]
    made = {**entry, "x0": contents} if start else entry
    return _of_space((a, entering, c, 0), made, variable, name)


def _single(model: MatrixModel) -> AnyModel:
    """The transfer function of one input and one output, else the matrix."""
    (entry, *others) = model.cells
    return model if others or entry is None else replace(entry, name=model.name)


def _of_chain(entry: Plain, name: str) -> Model:
    damped = entry.get("damped", DAMPED)
    if not isinstance(damped, bool):
        raise InputError('"damped" is true or false')
    quantity = text_of(entry, "sensor", Sensor.ACCELERATION.value)
    if quantity not in tuple(Sensor):
        raise InputError(f'"sensor" is {", ".join(Sensor)}, not {short(quantity)}')
    reference = text_of(entry, "chain", "")
    masses = reference.partition(":")[0].strip()
    if masses.isdecimal() and int(masses[:9]) > LARGEST_CHAIN:
        raise InputError(
            f"a chain of more than {LARGEST_CHAIN} masses is too large for a list; compare chains"
            " with 'disting compare'"
        )
    chain = chain_of(reference, Family(1, damped, Sensor(quantity)))
    if chain.dead_time:
        raise InputError("a dead time is no rational function of s; leave +delay away")
    return Model.from_chain(chain, name=name)


def _can_be_listed(chain: Chain) -> bool:
    """Return True if a file can name it: it has a number, and not too many masses."""
    return chain.n_masses <= LARGEST_CHAIN and not name_of(chain).startswith("(")


def _list_entry(chain: Chain) -> dict[str, object]:
    return {"chain": name_of(chain), "damped": chain.damped, "sensor": chain.sensor.value}


def _ratio(sides: Mapping[str, list[str]]) -> str:
    """Numerator over denominator as one expression in s."""
    top, bottom = (
        " + ".join(f"({c})*s**{k}" for k, c in enumerate(reversed(sides[name])))
        for name in ("num", "den")
    )
    return f"({top})/({bottom})"


def _of_entry(model: Model) -> dict[str, list[str]]:
    """Coefficients of falling powers; parameters that they lack are written times zero."""
    num, den = (
        [polynomial_text(p, model.parameters) for p in reversed(side)]
        for side in (model.numerator, model.denominator)
    )
    used = {
        j
        for terms in (*model.numerator_terms, *model.denominator_terms)
        for exponents, _ in terms
        for j, e in enumerate(exponents)
        if e
    }
    for j, name in enumerate(model.parameters):
        if j not in used:
            den[-1] += f" + 0*{name}"
    return {"num": num, "den": den}


def _refuse_missing(entry: Plain, keys: Iterable[str]) -> None:
    for key in keys:
        if key not in entry:
            raise InputError(f'"{key}" is missing')


def refuse_s(model: AnyModel) -> None:
    """Refuse a parameter called s, the frequency variable of every result."""
    if "s" in model.parameters:
        raise InputError("s is a parameter, but stands for the frequency variable; rename it")
