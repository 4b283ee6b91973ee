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

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from disting.errors import InputError, enumeration, printable, short
from disting.files import Format, as_path, json_text, read_bounded, write_whole
from disting.general.matrix_model import AnyModel
from disting.general.model_entries import (
    FORMS,
    as_entry,
    object_of,
    of_kind,
    plain_of,
    refuse_s,
    text_of,
)
from disting.general.naming import refuse_misnamed_models
from disting.model.presentation import NotebookTable, plural, summary
from disting.network.denotation import MisnamedError

LARGEST = 5_000_000  # bytes of a file
MOST_MODELS = 300  # 44,850 pairs
LONGEST_NAME = 60  # characters, of a name that stands at the edge of a figure
LONGEST_TITLE = 200


@dataclass(frozen=True, slots=True)
class ModelList(NotebookTable):
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
                f"{short(doubled[0])} names {names.count(doubled[0])} models; give each its own"
                " name"
            )
        refuse_misnamed_models(self.models)
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
            f"no model is called {short(name)}; the models are"
            f" {enumeration(m.name for m in self.models)}"
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


def write_models(path: Path | str, models: ModelList) -> Path:
    """Write chains by their names and other models as transfer functions in lowest terms, which
    `read_models` reads back as they were; returns the path. Raises InputError for a parameter named
    s, OSError where the file cannot be written.

    >>> from tempfile import TemporaryDirectory
    >>> from disting.general.matrix_model import Model
    >>> lag = Model.from_transfer_function("k", "T*s + 1", name="lag")
    >>> with TemporaryDirectory() as folder:
    ...     read_models(write_models(Path(folder, "mine.json"), ModelList((lag,)))).models[0] == lag
    True
    """
    return write_whole(as_path(path), [models_text(models)])


def models_text(models: ModelList) -> str:
    """The text of a file, a line a model.

    >>> from disting.general.matrix_model import Model
    >>> lag = Model.from_transfer_function(["k"], ["T", 1], name="lag")
    >>> print(models_text(ModelList((lag,))), end="")
    {"format": "disting models 1", "title": "", "models": [
      {"name": "lag", "num": ["k"], "den": ["T", "1"]}
    ]}
    """
    lines = [f"  {json_text(as_entry(model), spaced=True)}" for model in models.models]
    title = json_text(models.title)
    head = f'{{"format": "{Format.MODELS}", "title": {title}, "models": [\n'
    return head + ",\n".join(lines) + "\n]}\n"


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
            f'"s" is the name of the frequency variable, such as "s", not {short(variable)}'
        )
    models = tuple(_model(entry, place, variable) for place, entry in enumerate(entries, 1))
    return ModelList(models, text_of(whole, "title", ""))


def _refuse_format(said: str) -> None:
    if said != Format.MODELS:
        raise InputError(f'"format" is "{Format.MODELS}" or missing, not {short(said)}')


def _model(entry: object, place: int, variable: str) -> AnyModel:
    if not isinstance(entry, dict):
        raise InputError(
            f"model {place} is not an object; write it in braces, with a name and {FORMS}"
        )
    name = entry.get("name")
    if type(name) is not str:
        raise InputError(f'model {place} has no name; give it one, such as "name": "two leaks"')
    try:
        _refuse_name(name, "its name", LONGEST_NAME)
        model = of_kind(entry, name, variable)
        refuse_s(model)
    except MisnamedError:
        raise
    except InputError as reason:
        raise InputError(f"model {short(name)}: {reason}") from None
    return model


def _refuse_name(name: str, what: str, most: int) -> None:
    """Names are written in one line of tables and pages, and are typed on a command line."""
    if not name.strip() or name != name.strip() or not name.isprintable() or len(name) > most:
        raise InputError(
            f"{what} has 1 to {most} printable characters, with no spaces around them, not"
            f" {short(name)}"
        )
