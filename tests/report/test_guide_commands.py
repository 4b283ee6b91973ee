"""What guide and README show of commands is what the commands say."""

import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from disting import Chain
from disting.fit import predict
from disting.measurement import from_arrays, write_csv
from tests.cli.process import called
from tests.measurement.bench_data import measured_data, write_branched_drive
from tests.report.guide_blocks import TEXTS, blocks, commands_alone, transcripts

CHEAP = tuple(
    f"disting {command}"
    for command in (
        "compare 2:",
        "compare 3:",
        "compare 4:",
        'compare "',
        "fit cell.csv",
        "equivalents",
        "dampers 3:",
        "verdicts",
        "models 3",
        "models vessels",
        "models decay",
        "models mill",
        "compare mill",
        "next",
        'plan "',
        "schema",
        "simulate",
        "look",
    )
)
DEAR = ('disting compare "1~2, 1~3; F1; S2"', 'disting compare "#=1, 1=2, 1=3; F1; S2:1')
LEFT_OUT = re.compile(r"^\[\.\.\](?:\n|$)", re.MULTILINE)
NUMBER = r"\d+\.?\d*(?:e-?\d+)?"
# not a user's command: it rebuilds what is shipped
REBUILDS = "development.md"


def holds(said: str, shown: str) -> bool:
    """Whether it is what is shown, where `[..]` stands for any lines."""
    first, *others = LEFT_OUT.split(shown)
    if not others:
        return said.rstrip("\n") == shown.rstrip("\n")
    text, place = "\n" + said.rstrip("\n") + "\n", len(first)
    found = [text.startswith("\n" + first)]
    for part in filter(None, (part.rstrip("\n") for part in others)):
        at = text.find(f"\n{part}\n", place)
        found.append(at >= 0)
        place = at + len(part) + 1
    return all(found) and (not others[-1] or place == len(text) - 1)


def rough(text: str) -> str:
    """Numbers to two digits: the last ones of a fit differ between machines."""
    return re.sub(NUMBER, lambda match: f"{float(match[0]):.1e}", text)


def is_cheap(command: str) -> bool:
    return command.startswith(CHEAP) and not command.startswith(DEAR)


def test_what_holds() -> None:
    said = "a\nb\nc\nd\n"
    shown = ["a\nb\nc\nd\n", "a\n[..]\nd\n", "[..]\nc\n[..]\n", "a\nb\n[..]\n", "[..]\nd"]
    assert all(holds(said, one) for one in shown)
    wrong = ["a\nc\n", "b\n[..]\n", "a\n[..]\nc\n", "[..]\ne\n[..]\n", "[..]\nd\n[..]\nb\n[..]\n"]
    assert not any(holds(said, one) for one in wrong)


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """As a reader has one: pages show commands on the same models."""
    return tmp_path_factory.mktemp("cache") / "cache.sqlite3"


@pytest.mark.thin(1)
@pytest.mark.parametrize(
    ("page", "command", "output"), [t for t in transcripts() if is_cheap(t[1])]
)
def test_what_is_shown_is_what_is_said(
    page: str,
    command: str,
    output: str,
    cache: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    files = r"This is `(\w+\.(?:json|csv))`[^`]*^```\w+\n(.*?)^```"
    for name, content in re.findall(files, TEXTS[page], re.MULTILINE | re.DOTALL):
        (tmp_path / name).write_text(content, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    done = called(*shlex.split(command)[1:], cache=cache)
    said = done.stderr if done.returncode == 2 else done.stdout
    assert holds(said, output), (page, said)


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The simulated bench of the first steps, and a branched drive."""
    folder = tmp_path_factory.mktemp("bench")
    write_branched_drive(folder / "drive.csv")
    (command,) = {c for _, c, _ in transcripts() if c.startswith("disting simulate")}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        assert called(*shlex.split(command)[1:]).returncode == 0
    return folder


@pytest.mark.slow
@pytest.mark.parametrize(
    ("page", "command", "output"), [t for t in transcripts() if not is_cheap(t[1])]
)
def test_what_takes_long_says_what_is_shown(
    page: str, command: str, output: str, bench: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(bench)
    for name in re.findall(r"fditools\w+\.csv", command):
        (bench / name).write_bytes(measured_data(name).read_bytes())
    said = called(*shlex.split(command)[1:]).stdout
    assert holds(rough(said), rough(output)), (page, said)


@pytest.fixture(scope="module")
def responses(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Motor and load side of a bench, in one file and in two, with a locked mass and with an
    inertia added.
    """
    folder = tmp_path_factory.mktemp("responses")
    hertz = np.geomspace(5, 200, 60)
    values = {"m1": 0.0045, "m2": 0.005, "k12": 550.0, "d12": 0.08}
    scatter = 1 + 0.01 * np.random.default_rng(0).normal(size=(2, 60)).T @ [1, 1j]

    def response(sensor: int, force: int = 1, **changed: float) -> np.ndarray:
        brakes = tuple(int(name[1:]) for name in changed if name[0] == "b")
        chain = Chain(2, act_plus=force, meas_plus=sensor, ground_dampers=brakes)
        return np.asarray(predict(chain, values | changed, 2 * np.pi * hertz) * scatter)

    motor, load = response(1), response(2)
    for name, G in {
        "motor": motor,
        "load": load,
        "locked": response(1, m2=1e6),
        "disc": response(1, m1=0.5045),
        "braked": response(1, b2=0.3),
        "hammer": response(1, force=2),
        "turned": -load,
    }.items():
        write_csv(from_arrays(hertz, G), folder / f"{name}.csv")
    columns = np.column_stack([hertz, motor.real, motor.imag, load.real, load.imag])
    header = "frequency [Hz],ReG_motor,ImG_motor,ReG_load,ImG_load"
    np.savetxt(folder / "bench.csv", columns, delimiter=",", header=header, comments="")
    left = ("--masses", "2", "--json", folder / "fit.json")
    done = called("fit", folder / "motor.csv", *left)
    assert done.returncode == 0, done.stderr
    (folder / "page").mkdir()
    (folder / "page" / "fit.json").write_bytes((folder / "fit.json").read_bytes())
    return folder


@pytest.mark.slow
@pytest.mark.parametrize(
    ("page", "command"),
    [c for c in commands_alone() if c[0] != REBUILDS and "fditools" not in c[1]],
)
def test_commands_that_stand_alone_end_well(
    page: str, command: str, responses: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(responses)
    fits = command.startswith("disting fit") and "--left" not in command
    turned = command.replace("load.csv", "turned.csv") if "--sign=+,-" in command else command
    done = called(*shlex.split(turned)[1:], *["--masses", "2"] * fits)
    assert done.returncode == 0, (page, done.stderr)


def test_every_block_is_of_a_kind_that_is_run() -> None:
    """Python is run as doctests and commands by the tests above; the rest is data, a picture, or
    one of three blocks that quote.
    """
    quoted = ("A3: 7 parameters", "structure ──>", "read as ")
    for name, text in TEXTS.items():
        for kind, content in blocks(text):
            runs = re.search(r"^(>>> |\$ disting |disting |pip install )", content, re.MULTILINE)
            data = kind in ("json", "csv", "picture", "bibtex") or content.startswith(quoted)
            assert runs or data, (name, content)
