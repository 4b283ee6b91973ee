"""A name that is a notation is the model that it denotes, in every file that is read."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from disting import Experiment, Family, Model, everywhere_file, read_models, verify
from disting.errors import InputError
from disting.export import read_model
from disting.fit.search.candidates import reference
from disting.general.any_model import of_network
from disting.network import network_of
from disting.network.denotation import FREE_NAMES
from disting.network.notation.entries import entry_of
from disting.planning.fit_file import left_by, named_by
from disting.verdict.verdict_file import verdict_file
from disting.verdict.verification import Status
from tests.cli.process import called
from tests.fit.test_predictions import FREE, VALUES, fit_file, member, twin_values
from tests.verdict.lies import ENGINE, FREE as UNUSED, leaves, plain, put

A = Family(3, damped=True)
LEAK = Model.from_state_space(
    [["-k12-k01", 0], ["k12", "-k02"]], [1, 0], [0, 1], name="irreversible"
)
BACK = Model.from_state_space(
    [["-k12-k01", "k21"], ["k12", "-k21"]], [1, 0], [0, 1], name="reversible"
)
PLAIN = Model.from_transfer_function("a/(s + b)", name="plain")
GAIN = Model.from_transfer_function("p*q/(s + q)", name="gain")
BOTH = [Experiment(), (Experiment(sensor=2), Experiment(sensor=3))]
CASES: dict[str, tuple[Any, Any, dict[str, Any]]] = {
    "chains": ("3:1", "3:11", {}),
    "extras": ("3:1+b2+lag", "3:4", {}),
    "experiments": (A[2], A[5], {"experiments": BOTH}),
    "sizes": ("2:1", "3:4", {}),
    "circuits": ("R1-p(C1,R2)-p(C2,R3)", "R1-p(C1,R2-p(C2,R3))", {}),
    "boukamp": ("R(RC)", "R(RC)(RC)", {}),
    "netlists": ("R1 1 2; C1 2 0; port 1 0", "R1 1 0; C1 1 0; port 1 0", {}),
    "phase": ("R1-p(R2,P1)", "p(R1,R2-P1)", {}),
    "machines": ("1~2~3; F1; S2", "1~2, 1~3; F1; S2", {}),
    "machines that are chains": ("1=2; F1; S2", "1=2; F1; S1", {}),
    "compartments": ("1>2, 2>1, 1>0; in 1; out 1", "1>2, 2>1, 2>0; in 1; out 1", {}),
    "state space": (LEAK, BACK, {}),
    "transfer functions": (PLAIN, GAIN, {}),
}
NAMES = [
    *("3:1", "3:4", "3:11", "3:7", "2:1", "2:2", "3:1+b1", "3:1+b2", "3:4+lag", "3:999"),
    *("3:7 (damped, acceleration)", "3:7 1", "(3 masses, gap 0, force 3-0, sensor 3-0)"),
    *("R1-p(C1,R2)-R3", "R1-p(C1,R2)-p(C2,R3)", "R1-p(C1,R2-p(C2,R3))", "p(R1,C1)", "R1-C1"),
    *("R1-[C1,R2]", "R(RC)", "R(RC)(RC)", "R1-p(R2,P1)", "p(R1,R2-P1)", "R1 1 0; L1 1 0; port 1 0"),
    *("1~2~3; F1; S2", "1~2~3; F1; S3", "1~2, 1~3; F1; S2", "1=2; F1; S2", "1=2; F1; S1"),
    *("1>2, 2>1, 1>0; in 1; out 1", "1>2, 2>1, 2>0; in 1; out 1", "1<>2, 1>0; in 1; out 2"),
]
# what the stored model is, written otherwise
SAME = {
    "3:1": ("3=2=1; F3; S3",),
    "2:1": ("1=2; F1; S1",),
    "R1-p(C1,R2)-p(C2,R3)": ("R9-p(R3,C3)-p(R4,C4)", "R(RC)(RC)", "R1-[C1,R2]-[R3,C2]"),
    "R(RC)": ("R1-p(C1,R2)", "R1-[C1,R2]"),
    "R(RC)(RC)": ("R1-p(C1,R2)-p(C2,R3)",),
    "R1 1 2; C1 2 0; port 1 0": ("R1-C1",),
    "R1 1 0; C1 1 0; port 1 0": ("p(R1,C1)", "(CR)"),
    "R1-p(R2,P1)": ("R1-p(R3,CPE2)",),
    "1~2~3; F1; S2": ("3:2", "7~5~6; F7; S5"),
    "1~2, 1~3; F1; S2": ("2~1~3; F1; S3",),
    "1=2; F1; S2": ("2:2", "2=1; F2; S1"),
    "1=2; F1; S1": ("2:1",),
    "1>2, 2>1, 1>0; in 1; out 1": ("2>1, 1>2, 2>0; in 2; out 2",),
}
WORDS = ("drive", "RC", "P1", "Lead-Lag", "3:1 by hand", "α->")


def stored(case: str) -> dict[str, Any]:
    left, right, said = CASES[case]
    return plain(left, right, **said)


def renamed(value: Any, names: dict[str, str]) -> Any:
    """All texts with other names in them."""
    if isinstance(value, dict):
        return {key: renamed(part, names) for key, part in value.items()}
    if isinstance(value, list):
        return [renamed(part, names) for part in value]
    if not isinstance(value, str):
        return value
    every = "|".join(re.escape(name) for name in sorted(names, key=len, reverse=True))
    return re.sub(rf"(?<!\w)(?:{every})(?![\w+])", lambda found: names[found[0]], value)


def by_name(data: dict[str, Any]) -> list[str]:
    return [model["name"] for model in data["models"]]


def believed(data: dict[str, Any]) -> bool:
    try:
        return verify(data).status is not Status.FAILS
    except InputError:
        return False


@pytest.mark.full
@pytest.mark.parametrize("case", CASES)
def test_no_model_is_called_by_the_notation_of_another_one(case: str) -> None:
    data = stored(case)
    assert verify(data).status is Status.HOLDS
    for name in by_name(data):
        allowed = {name, *SAME.get(name, ())}
        for other in (text for text in NAMES if text not in allowed):
            assert not believed(renamed(data, {name: other})), (name, other)


@pytest.mark.full
@pytest.mark.parametrize("case", ["circuits", "machines", "compartments", "state space"])
def test_the_refusal_is_one_sentence(case: str) -> None:
    data = stored(case)
    lie = renamed(data, {by_name(data)[1]: "R1-p(C1,R2)-R3"})
    assert verify(lie).sentence == (
        "does not hold: 'R1-p(C1,R2)-R3' does not denote the model stored under this name; rename"
        " the model or write the file again"
    )


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    "case", [c for c in CASES if c not in ("state space", "transfer functions")]
)
def test_names_that_are_notations_cannot_change_places(case: str) -> None:
    data = stored(case)
    left, right = by_name(data)
    assert not believed(renamed(data, {left: right, right: left}))
    models = data["models"]
    names = put(put(data, ("models", 0, "name"), right), ("models", 1, "name"), left)
    assert not believed(names) and not believed(data | {"models": models[::-1]})


@pytest.mark.thin(2)
@pytest.mark.parametrize("case", ["chains", "circuits", "boukamp", "netlists", "machines"])
def test_another_notation_of_the_same_network_is_harmless(case: str) -> None:
    data = stored(case)
    for name in by_name(data):
        for other in SAME.get(name, ()):
            assert verify(renamed(data, {name: other})).status is Status.HOLDS, other


@pytest.mark.full
@pytest.mark.parametrize("case", ["chains", "circuits", "machines", "state space"])
def test_free_names_are_harmless_as_the_answer_says_that_they_are_free(case: str) -> None:
    data = stored(case)
    for word in WORDS:
        found = verify(renamed(data, {by_name(data)[0]: word}))
        assert found.status is Status.HOLDS and found.models.count(FREE_NAMES) == 1
    denoted = FREE_NAMES not in verify(data).models
    assert denoted is (case != "state space")


def texts(case: str) -> Iterator[tuple[tuple[Any, ...], Any, dict[str, Any]]]:
    """Yield every file in which one text is another one of the same file, or another name."""
    data = stored(case)
    own = {path: value(data, path) for path in leaves(data)}
    others = {v for v in own.values() if isinstance(v, str)}
    for path, text in own.items():
        if isinstance(text, str) and not UNUSED.intersection(path):
            more = NAMES if path[-1] in ("left", "right", "name", "sentence") else ()
            yield from ((path, x, put(data, path, x)) for x in {*others, *more} - {text})


def value(data: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        data = data[key]
    return data


def is_harmless(path: tuple[Any, ...]) -> bool:
    """A parameter that no evidence names may have any name that no other one has."""
    return path[:1] == ("models",) and path[2:3] == ("elements",) and path[-1] == 0


@pytest.mark.full
@pytest.mark.parametrize("case", ["netlists"])
def test_no_text_can_be_replaced_by_another_one_of_the_file(case: str) -> None:
    assert [(p, x) for p, x, lie in texts(case) if believed(lie) and not is_harmless(p)] == []


@pytest.mark.slow
@pytest.mark.parametrize("case", [case for case in CASES if case != "netlists"])
def test_no_text_can_be_replaced_by_another_one_of_any_file(case: str) -> None:
    test_no_text_can_be_replaced_by_another_one_of_the_file(case)


@pytest.mark.full
def test_a_file_for_every_place_is_looked_at_likewise() -> None:
    data = json.loads(json.dumps(everywhere_file(A[1], A[4], ["sensor=3"], engine=ENGINE)))
    assert verify(data).status is Status.HOLDS
    for names in ({"3:4": "3:7"}, {"3:1": "R1-C1"}, {"3:1": "3:4", "3:4": "3:1"}):
        assert not believed(renamed(data, names))


def test_no_file_is_written_that_would_be_refused() -> None:
    with pytest.raises(InputError, match="does not denote the model"):
        verdict_file(Model.from_transfer_function("a", "s + b", name="3:9"), PLAIN)


ENTRIES: dict[str, dict[str, Any]] = {
    "R1-p(C1,R2)": {"circuit": "R1-p(C1,R2)"},
    "1~2~3; F1; S2": {"machine": "1~2~3; F1; S2"},
    "1=2; F1; S1": {"machine": "1=2; F1; S1", "quantity": "velocity"},
    "1>2, 2>1, 1>0; in 1; out 1": {"flows": [[1, 2], [2, 1], [1, 0]], "input": 1, "output": 1},
    "3:1+b2": {"chain": "3:1+b2", "damped": False},
    "2:2+lag": {"chain": "2:2+lag"},
    "p(R1,C1)": {"G": "R1/(R1*C1*s + 1)"},
    "1:1": {"num": [1], "den": ["m1"]},
}


@pytest.mark.full
@pytest.mark.parametrize("name", ENTRIES)
def test_files_of_models_are_refused_likewise(name: str, tmp_path: Path) -> None:
    path = tmp_path / "f.json"

    def read(text: str) -> None:
        path.write_text(json.dumps({"models": [{"name": text, **ENTRIES[name]}]}))
        read_models(path)

    allowed = {name, *SAME.get(name, ()), *({"R(RC)", "R1-[C1,R2]"} if name[:2] == "R1" else ())}
    for text in (name, *WORDS, *SAME.get(name, ())):
        read(text)
    for text in {*NAMES, *ENTRIES} - allowed - ({"2:1"} if name == "1=2; F1; S1" else set()):
        with pytest.raises(InputError) as error:
            read(text)
        assert str(error.value).startswith(f"{path}: {text!r} does not denote"), text


@pytest.mark.full
def test_commands_on_files_of_models_say_that_names_are_free(tmp_path: Path) -> None:
    path = tmp_path / "f.json"
    entries = [{"name": "pump", "circuit": "R1-C1"}, {"name": "p(R1,C1)", "circuit": "p(R1,C1)"}]
    path.write_text(json.dumps({"models": entries}))
    done = called("compare", f"{path}:pump", f"{path}:p(R1,C1)")
    assert done.returncode == 0 and done.stdout.splitlines()[-1] == f"names      {FREE_NAMES}"
    assert called("verdicts", path).stdout.splitlines()[-1] == FREE_NAMES
    entries[0]["name"] = "R1-C1"
    path.write_text(json.dumps({"models": entries}))
    for command in (["compare", f"{path}:R1-C1", f"{path}:p(R1,C1)"], ["verdicts", path]):
        assert FREE_NAMES not in called(*command).stdout
    assert FREE_NAMES not in called("compare", "R1-C1", "p(R1,C1)").stdout
    entries[0]["name"] = "R1-C1-L1"
    path.write_text(json.dumps({"models": entries}))
    for command in (["models", path], ["verdicts", path], ["compare", f"{path}:R1-C1-L1", "R1-C1"]):
        done = called(*command)
        assert done.returncode == 2 and f"{path}: 'R1-C1-L1' does not denote" in done.stderr


@pytest.mark.parametrize("place", [("selected",), ("not_excluded", 0), ("not_excluded", 1)])
def test_fit_files_of_chains_are_refused_likewise(place: tuple[Any, ...], tmp_path: Path) -> None:
    mirrored = member(A[1], VALUES)
    mirrored |= {"contains": "3:1", "name": "3:1"}
    path = fit_file(tmp_path / "f.json", member(FREE, VALUES) | {"name": "3:1"}, mirrored)
    (larger,) = named_by(path).larger
    assert reference(larger) == "3:1" and read_model(path)[0] == FREE
    data = json.loads(path.read_text())
    path.write_text(json.dumps(put(data, (*place, "name"), "3:9")))
    with pytest.raises(InputError) as error:
        named_by(path)
    assert str(error.value).startswith(f"{path}: '3:9' does not denote the model stored")
    if place == ("selected",):
        with pytest.raises(InputError, match=r"f\.json: '3:9' does not denote"):
            read_model(path)
        assert "'3:9' does not denote" in called("next", path).stderr


def test_fit_files_of_networks_are_refused_likewise(tmp_path: Path) -> None:
    names = ("R0-p(R1,C1)", "p(R0,R1-C1)")
    networks = [{"name": name, **entry_of(network_of(name))} for name in names]
    values = {"R0": 1.0, "R1": 2.0, "C1": 0.01}
    fits = [{"name": names[0], "values": values, "same": [names[1]], "explains": True}]
    data = {
        "format": "disting fit of networks 1",
        "selected": names[0],
        "networks": networks,
        "fits": [fits[0] | {"excluded_by": []}],
        "scatter": 0.1,
        "frequencies": {"low": 1, "high": 10, "lines": 20},
    }
    path = tmp_path / "f.json"
    path.write_text(json.dumps(data))
    assert [n.network.name for n in left_by(path)] == [names[0]]
    for mapping in ({names[1]: "R0-C1"}, {names[0]: names[1], names[1]: names[0]}):
        path.write_text(json.dumps(renamed(data, mapping)))
        with pytest.raises(InputError, match=r"f\.json: .* does not denote the model stored"):
            left_by(path)
    for command in ("next", "plan"):
        done = called(command, path)
        assert done.returncode == 2 and "does not denote" in done.stderr


@pytest.mark.full
def test_a_network_that_is_read_back_keeps_its_notation() -> None:
    """Names that commands give are those of the texts."""
    for text in (*NAMES[13:], "R0-p(R1,C1)-W1", "1=2*i, 2=3; F1; S3", "1>2, 2>0; in 1; out 1, 2"):
        read = of_network(network_of(text))
        assert verify(plain(read, read)).status is not Status.FAILS


def test_what_a_fit_names_as_equivalent_has_the_fitted_response(tmp_path: Path) -> None:
    """Of an equivalent a file has the name and the values, and nothing else."""
    values = twin_values()
    path = fit_file(tmp_path / "f.json", member(FREE, VALUES, **{"3:11": values}))
    assert [s.name for s in named_by(path).left] == ["3:1", "3:11"]
    others = [f"3:{n}" for n in range(1, 12) if n != 11]
    assert any(set(A[int(name[2:])].parameters) == set(values) for name in others)
    for name in (*others, "3:1+b1", "3:11+b1", "2:1"):
        fit_file(path, member(FREE, VALUES, **{name: values}))
        with pytest.raises(InputError, match=rf"f\.json: '{re.escape(name)}' does not denote"):
            named_by(path)
