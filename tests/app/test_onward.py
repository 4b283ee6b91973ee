"""After a fit: advice, plan and two fits side by side are what the commands say of the same files."""

import json
import shlex

import numpy as np
import pytest
from jsonschema import validate

from disting.app.interface import CALLS
from disting.app.onward import advise, plan
from disting.app.project import summary
from disting.app.two_fits import decide_fits, set_beside
from disting.app.workers import Setting
from disting.cli.run import main
from disting.errors import InputError
from disting.files import json_text
from disting.fit import fit_networks
from disting.measurement import FrequencyResponse
from disting.network.notation import network_of

FITS = (("R0-p(R1,C1)", "p(R1,C1-R0)", "R1-C1"), ("R0-p(R1,C1)",))


def spectrum() -> FrequencyResponse:
    """Impedance of R0-p(R1,C1) with noise of 0.3 %."""
    f = np.geomspace(0.1, 1e4, 40)
    Z = 10 + 100 / (1 + 2j * np.pi * f * 100 * 1e-4)
    noise = np.random.default_rng(2).normal(size=(40, 2)) @ [1, 1j]
    return FrequencyResponse(2 * np.pi * f, Z * (1 + 0.003 * noise), quantity="position")


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """A folder with a fit of three circuits and one of one circuit."""
    folder = tmp_path_factory.mktemp("onward")
    for number, names in enumerate(FITS, 1):
        own = folder / "fits" / str(number)
        own.mkdir(parents=True)
        selection = fit_networks(spectrum(), [network_of(name) for name in names])
        (own / "fit.json").write_text(json_text(selection.to_dict()))
        (own / "fit.html").touch()
        request = {"measurements": [{"file": "eis.csv", "reading": {}}]}
        (own / "about.json").write_text(json.dumps({"request": request, "explains": True}))
    return folder


@pytest.fixture
def inside(project, monkeypatch):
    monkeypatch.chdir(project)
    return Setting(project)


def silent(*_: object) -> None:
    """Progress that nobody watches."""


def said(capsys, command: str) -> str:
    """Standard output of a command."""
    assert main(shlex.split(command)[1:]) == 0
    return capsys.readouterr().out


@pytest.mark.full
def test_the_advice_is_that_of_the_command_and_stays_with_the_fit(inside, capsys):
    answer = advise({"fit": 1}, silent, inside)
    validate(answer, CALLS["next"].schema["properties"]["answer"])
    assert answer["next"]["command"] == "disting next fits/1/fit.json"
    assert said(capsys, answer["next"]["command"]) == answer["next"]["text"] + "\n"
    cannot, _, separates = answer["next"]["first"].partition("; ")
    assert cannot.startswith("this measurement cannot distinguish ")
    assert separates.startswith("what separates all of them: the voltage at any further node")
    assert separates in answer["next"]["text"]
    assert summary(1) == answer


@pytest.mark.full
def test_the_plan_is_that_of_the_command_and_its_page_is_beside_the_fit(inside, capsys):
    answer = plan({"fit": 1}, silent, inside)
    validate(answer, CALLS["plan"].schema["properties"]["answer"])
    assert said(capsys, answer["plan"]["command"]) == answer["plan"]["text"] + "\n"
    assert "plan.html" in answer["files"]
    assert answer["plan"]["first"] in (inside.folder / "fits/1/plan.html").read_text()


def test_two_fits_are_set_beside_each_other(inside):
    answer = set_beside({"fits": [1, 2]})
    validate(answer, CALLS["two_fits"].schema["properties"]["answer"])
    rows = {name: texts for name, *texts in answer["rows"]}
    assert rows["Data"] == ["eis.csv", "eis.csv"]
    assert rows["Lines"] == ["40 from 0.1 to 1e+04 Hz"] * 2
    parameters = {name: texts for name, *texts in answer["parameters"]}
    assert [*parameters] == ["C1", "R0", "R1"]
    plain = json.loads((inside.folder / "fits/2/fit.json").read_text())
    low, high = plain["fits"][0]["intervals"]["R0"]
    assert low < 10 < high and f"{low:.4g}" in parameters["R0"][1]


def test_the_verdict_on_both_structures_is_that_of_the_command(inside, capsys):
    plain = json.loads((inside.folder / "fits/1/fit.json").read_text())
    selected = plain["selected"]
    other = "p(R1,C1-R0)" if selected == "R0-p(R1,C1)" else "R0-p(R1,C1)"
    own = inside.folder / "fits" / "3"
    own.mkdir(exist_ok=True)
    selection = fit_networks(spectrum(), [network_of(other)])
    (own / "fit.json").write_text(json_text(selection.to_dict()))
    answer = decide_fits({"fits": [1, 3]}, silent, inside)
    validate(answer, CALLS["fits_verdict"].schema["properties"]["answer"])
    assert answer["command"] == shlex.join(["disting", "compare", selected, other])
    assert answer["verdict"] in said(capsys, answer["command"])
    same = decide_fits({"fits": [1, 1]}, silent, inside)
    assert same["verdict"] == f"Both select the same structure, {selected}."


def test_a_fit_that_is_not_there_is_refused(inside):
    for ask in (advise, plan):
        with pytest.raises(InputError, match="the project has no fit 9"):
            ask({"fit": 9}, silent, inside)
