"""Lists of models as JSON files: state spaces, transfer functions, and chains by their names.

    {"title": "Two compartments", "s": "s", "models": [
      {"name": "two leaks", "A": [["-k12-k01", 0], ["k12", "-k02"]], "B": [1, 0], "C": [0, 1]},
      {"name": "low pass", "num": ["k"], "den": ["T", 1]},
      {"name": "notch", "G": "(s**2 + w**2)/(s**2 + 2*z*w*s + w**2)"},
      {"name": "two sensors", "G": [["1/(m*s**2 + k)"], ["s/(m*s**2 + k)"]]},
      {"name": "drive", "chain": "3:1+b2", "damped": true},
      {"name": "cell", "circuit": "R0-p(R1,C1)"},
      {"name": "branched", "machine": "1=2=3, 2=4; F1; S4"}]}

Networks have more forms: see `disting.network.notation.entries`.

Numbers are read as they are written: 0.1 is 1/10 and never a float. What is not understood is
refused in one sentence that names the model: an unknown key or a doubled name would otherwise be a
model that nobody meant.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from disting.errors import InputError, listed, of_type, printable, shown
from disting.files import Format, as_path, read_bounded, write_whole
from disting.general.any_model import as_chain, of_network
from disting.general.expression import polynomial_text
from disting.general.matrix_model import AnyModel, MatrixModel
from disting.general.model import Model
from disting.general.strict_json import Plain, object_of, plain_of, text_of
from disting.model.chain import Chain, Sensor
from disting.model.family import Family
from disting.model.names import DAMPED, chain_of, name_of
from disting.model.presentation import Shown, plural, summary
from disting.network.notation.compartments import space_of_flows
from disting.network.notation.entries import FORMS as NETWORKS, entry_of, network_of_entry

LARGEST = 5_000_000  # bytes of a file
MOST_MODELS = 300  # 44,850 pairs
LARGEST_CHAIN = 6  # masses: coefficients of some hundred terms
LONGEST_NAME = 60  # characters, of a name that stands at the edge of a figure
LONGEST_TITLE = 200
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


@dataclass(frozen=True, slots=True)
class ModelList(Shown):
    """Models with different names, in order.

    >>> from disting import Model
    >>> found = ModelList((Model.from_transfer_function("k", "T*s + 1", name="lag"),), "Mine")
    >>> found["lag"].parameters, len(found.models)
    (('T', 'k'), 1)
    """

    models: tuple[AnyModel, ...]
    title: str = ""

    def __post_init__(self) -> None:
        names = [model.name for model in self.models]
        for name in names:
            _refuse_name(name, "the name of a model", LONGEST_NAME)
        doubled = sorted({name for name in names if names.count(name) > 1})
        if doubled:
            raise InputError(
                f"{shown(doubled[0])} names {names.count(doubled[0])} models; give each its own"
                " name"
            )
        if self.title:
            _refuse_name(self.title, "the title", LONGEST_TITLE)

    def __repr__(self) -> str:
        title = f"{self.title}, " if self.title else ""
        return summary(
            self, f"{title}{plural(len(self), 'model')}: {', '.join(m.name for m in self)}"
        )

    def __len__(self) -> int:
        return len(self.models)

    def __iter__(self) -> Iterator[AnyModel]:
        return iter(self.models)

    def __getitem__(self, name: str) -> AnyModel:
        """The model of this name; raises InputError."""
        for model in self.models:
            if model.name == name:
                return model
        raise InputError(
            f"no model is called {shown(name)}; there are {listed(m.name for m in self.models)}"
        )


def read_models(path: Path | str) -> ModelList:
    """The models of a file, see `disting/guide/general-models.md`; raises InputError.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder, "a.json")
    ...     _ = file.write_text('{"models": [{"name": "lag", "num": ["k"], "den": ["T", 1]}]}')
    ...     str(read_models(file)["lag"])
    'G(s) = k/(1 + T*s)'
    """
    wanted = f"a file of models of at most {LARGEST // 10**6} MB"
    content = read_bounded(as_path(path), wanted, LARGEST)
    try:
        return models_of(plain_of(content))
    except InputError as reason:
        raise InputError(f"{printable(str(path))}: {reason}") from None


def write_models(path: Path | str, found: ModelList) -> Path:
    """Write chains by their names and other models as transfer functions in lowest terms, which
    `read_models` reads back as they were; returns the path. Raises InputError for a parameter named
    s, OSError where the file cannot be written.

    >>> from tempfile import TemporaryDirectory
    >>> lag = Model.from_transfer_function("k", "T*s + 1", name="lag")
    >>> with TemporaryDirectory() as folder:
    ...     read_models(write_models(Path(folder, "mine.json"), ModelList((lag,)))).models[0] == lag
    True
    """
    return write_whole(as_path(path), [models_text(found)])


def models_text(found: ModelList) -> str:
    """The text of a file, a line a model.

    >>> lag = Model.from_transfer_function(["k"], ["T", 1], name="lag")
    >>> print(models_text(ModelList((lag,))), end="")
    {"format": "disting models 1", "title": "", "models": [
      {"name": "lag", "num": ["k"], "den": ["T", "1"]}
    ]}
    """
    lines = [f"  {json.dumps(as_entry(model), ensure_ascii=False)}" for model in found.models]
    title = json.dumps(found.title, ensure_ascii=False)
    head = f'{{"format": "{Format.MODELS}", "title": {title}, "models": [\n'
    return head + ",\n".join(lines) + "\n]}\n"


def as_entry(model: AnyModel) -> dict[str, object]:
    """A model as a file has it: a chain by its name, a network by its elements, another one by its
    transfer function in lowest terms; a matrix as its expressions, parameters that they lack beside
    them. Raises InputError for a parameter s.
    """
    _refuse_s(model)
    chain = as_chain(model)
    if chain is not None and _can_be_listed(chain):
        return {"name": model.name, **_of_listed(chain)}
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
    return _of_kind(entry, name, "s")


def models_of(data: object) -> ModelList:
    """The models of what a file holds: a drive train of openTorsion alone, or a list; raises
    InputError.
    """
    if isinstance(data, dict) and "components" in data:
        data = {"models": [data]}
    whole = object_of(data, ("format", "title", "s", "models"), "the file")
    _refuse_format(text_of(whole, "format", Format.MODELS.value))
    entries = whole.get("models")
    if not isinstance(entries, list) or not entries:
        raise InputError('"models" is a list of models, each in braces, at least one')
    if len(entries) > MOST_MODELS:
        raise InputError(
            f"{len(entries)} models are more than {MOST_MODELS}; split them into several lists"
        )
    variable = text_of(whole, "s", "s")
    if not variable.isidentifier() or not variable.isascii():
        raise InputError(
            f'"s" is the name of the frequency variable, such as "s", not {shown(variable)}'
        )
    models = tuple(_model(entry, place, variable) for place, entry in enumerate(entries, 1))
    return ModelList(models, text_of(whole, "title", ""))


def _refuse_format(said: str) -> None:
    if said != Format.MODELS:
        raise InputError(f'"format" is "{Format.MODELS}" or missing, not {shown(said)}')


def _model(entry: object, place: int, variable: str) -> AnyModel:
    if not isinstance(entry, dict):
        raise InputError(f"model {place} is no object; write it in braces, with a name and {FORMS}")
    name = entry.get("name")
    if type(name) is not str:
        raise InputError(f'model {place} has no name; give it one, such as "name": "two leaks"')
    try:
        _refuse_name(name, "its name", LONGEST_NAME)
        found = _of_kind(entry, name, variable)
        _refuse_s(found)
    except InputError as reason:
        raise InputError(f"model {shown(name)}: {reason}") from None
    return found


def _of_kind(entry: Plain, name: str, variable: str) -> AnyModel:
    kinds = [kind for kind in KINDS if kind in entry]
    if len(kinds) != 1:
        raise InputError(f"a model is {FORMS}; this one is {' and '.join(kinds) or 'none of them'}")
    known = KINDS[kinds[0]]
    given = object_of(entry, ("name", *known), f'a model with "{kinds[0]}"')
    match kinds[0]:
        case "A":
            _refuse_missing(given, ("C",) if "x0" in given else ("B", "C"))
            space = (given["A"], given.get("B"), given["C"], given.get("D", 0))
            return _single(_of_space(space, given, variable, name))
        case "num":
            return Model.from_transfer_function(
                given["num"], given.get("den", 1), s=variable, name=name
            )
        case "G":
            if isinstance(given["G"], list):
                return MatrixModel.from_transfer_functions(given["G"], s=variable, name=name)
            return Model.from_transfer_function(given["G"], s=variable, name=name)
        case "chain":
            return _of_chain(given, name)
    if "x0" in given or "known" in given:
        return _single(_of_flows(given, variable, name))
    return of_network(network_of_entry(given, name))


def _of_space(space: tuple[Any, ...], given: Plain, variable: str, name: str) -> MatrixModel:
    known = of_type(given.get("known", []), list, '"known" is a list of names of parameters')
    return MatrixModel.from_state_space(
        *space, x0=given.get("x0"), known=known, s=variable, name=name
    )


def _of_flows(given: Plain, variable: str, name: str) -> MatrixModel:
    """Compartments that are not empty at first; x0 has their contents, by number."""
    start = of_type(given.get("x0", {}), dict, '"x0" has contents by compartment: {"1": "c1"}')
    flows = of_type(given["flows"], list, '"flows" is a list of pairs such as [1, 2]')
    nodes = {str(i) for flow in flows if isinstance(flow, list) for i in flow}
    lost = [i for i in start if i not in nodes - {"0"}]
    if lost:
        raise InputError(f'"x0" has compartment {shown(lost[0])}, which none of the flows has')
    asked = given.get("input", [])
    inputs = asked if isinstance(asked, list) else [asked]
    plain = {key: value for key, value in given.items() if key not in ("x0", "known")}
    network = network_of_entry({**plain, "input": [*inputs, *start]}, name)
    a, b, c = space_of_flows(network)
    entering = [row[: len(inputs)] for row in b] if inputs else None
    contents = [start.get(str(i), 0) for i in network.nodes]
    made = {**given, "x0": contents} if start else given
    return _of_space((a, entering, c, 0), made, variable, name)


def _single(model: MatrixModel) -> AnyModel:
    """The transfer function of one input and one output, else the matrix."""
    (entry, *others) = model.cells
    return model if others or entry is None else replace(entry, name=model.name)


def _of_chain(given: Plain, name: str) -> Model:
    damped = given.get("damped", DAMPED)
    if not isinstance(damped, bool):
        raise InputError('"damped" is true or false')
    quantity = text_of(given, "sensor", Sensor.ACCELERATION.value)
    if quantity not in tuple(Sensor):
        raise InputError(f'"sensor" is {", ".join(Sensor)}, not {shown(quantity)}')
    reference = text_of(given, "chain", "")
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
    """Whether a file can name it: it has a number, and not too many masses."""
    return chain.n_masses <= LARGEST_CHAIN and not name_of(chain).startswith("(")


def _of_listed(chain: Chain) -> dict[str, object]:
    return {"chain": name_of(chain), "damped": chain.damped, "sensor": chain.sensor.value}


def _ratio(sides: Mapping[str, list[str]]) -> str:
    """Numerator over denominator as one expression in s."""
    top, bottom = (
        " + ".join(f"({c})*s**{k}" for k, c in enumerate(reversed(sides[name])))
        for name in ("num", "den")
    )
    return f"({top})/({bottom})"


def _of_entry(model: Model) -> dict[str, list[str]]:
    """Coefficients of falling powers; parameters that they lack stand there times zero."""
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


def _refuse_s(model: AnyModel) -> None:
    """What is told of a model is written in s, whatever the file calls it."""
    if "s" in model.parameters:
        raise InputError("s is a parameter, but stands for the frequency variable; rename it")


def _refuse_missing(given: Plain, keys: Iterable[str]) -> None:
    for key in keys:
        if key not in given:
            raise InputError(f'"{key}" is missing')


def _refuse_name(name: str, what: str, most: int) -> None:
    """Names stand in one line of tables and pages, and are typed on a command line."""
    if not name.strip() or name != name.strip() or not name.isprintable() or len(name) > most:
        raise InputError(
            f"{what} has 1 to {most} printable characters, with no spaces around them, not"
            f" {shown(name)}"
        )
