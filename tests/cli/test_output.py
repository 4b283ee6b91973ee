"""Data are the same bytes wherever they go; words are written as the place can hold them; and what
cannot be written is named.
"""

import json
import os
import subprocess
from pathlib import Path

import pytest

from tests.cli.process import COMMAND, called

POSIX = pytest.mark.skipif(os.name != "posix", reason="devices of another system")
PAIR = "compare 3:1 3:4"
MODELS = {
    "models": [
        {"name": "α→", "num": ["k"], "den": ["T", 1]},
        {"name": "α->", "num": ["k"], "den": [1, "T"]},
        {"name": "a", "num": ["q"], "den": ["T", 1]},
    ]
}


def shell(command: str, folder: Path, **variables: str) -> subprocess.CompletedProcess[bytes]:
    """A line of a shell in which $D is the program."""
    environment = os.environ | {"DISTING_CACHE": "off", "D": " ".join(COMMAND)} | variables
    line = ["bash", "-c", f"set -o pipefail; {command}"]
    return subprocess.run(
        line, capture_output=True, env=environment, cwd=folder, check=False, timeout=600
    )


@pytest.fixture
def models(tmp_path: Path) -> Path:
    path = tmp_path / "models.json"
    path.write_text(json.dumps(MODELS), encoding="utf-8")
    return path


@pytest.mark.sampled(2)
@pytest.mark.full
@POSIX
@pytest.mark.parametrize(
    ("asked", "encoding"),
    [
        (f"{PAIR} --json", "ascii"),
        ("verdicts models.json --json", "cp1252"),
        ("verdicts models.json --csv", "ascii"),
        pytest.param(f"{PAIR} --json", "cp1252", marks=pytest.mark.slow),
        pytest.param("verdicts models.json --json", "ascii", marks=pytest.mark.slow),
        pytest.param("verdicts models.json --csv", "cp1252", marks=pytest.mark.slow),
    ],
)
def test_data_are_the_same_bytes_in_a_file_and_on_any_standard_output(
    models: Path, monkeypatch: pytest.MonkeyPatch, asked: str, encoding: str
) -> None:
    monkeypatch.chdir(models.parent)
    assert called(*asked.split(), "FILE").returncode == 0
    content = (models.parent / "FILE").read_bytes()
    done = shell(f"$D {asked} -", models.parent, PYTHONIOENCODING=encoding)
    assert (done.returncode, done.stderr) == (0, b"") and done.stdout.endswith(content)
    assert not content.isascii() and content.decode("utf-8")


@pytest.mark.sampled(2)
@pytest.mark.full
@POSIX
@pytest.mark.parametrize(
    "command",
    [
        pytest.param("$D {} --json - > out", marks=pytest.mark.slow),
        pytest.param("$D {} --json /dev/stdout > out", marks=pytest.mark.slow),
        "$D {} --json /dev/stdout | cat > out",
        "$D {} --json >(cat > out); wait $!",
        "$D {} --json /dev/fd/3 3> out",
    ],
)
def test_pipes_and_streams_are_written_to(tmp_path: Path, command: str) -> None:
    done = shell(command.format(PAIR), tmp_path, PYTHONIOENCODING="ascii")
    assert (done.returncode, done.stderr) == (0, b"")
    data = json.loads((tmp_path / "out").read_text(encoding="utf-8"))
    assert (data["left"], data["right"]) == ("3:1", "3:4")
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


@pytest.mark.full
@POSIX
def test_a_stream_that_is_a_file_keeps_what_stands_in_it(tmp_path: Path) -> None:
    """It is written to at its end, and is still the file that the shell opened."""
    done = shell(
        f"echo before > log; $D {PAIR} --json /dev/fd/3 3>> log > words; cat log", tmp_path
    )
    first, _, rest = done.stdout.partition(b"\n")
    assert first == b"before" and json.loads(rest)["left"] == "3:1"


@pytest.mark.full
@POSIX
def test_a_verdict_from_a_standard_output_of_any_encoding_is_verified(tmp_path: Path) -> None:
    done = shell(
        f"$D {PAIR} --json - > v.json && $D verify v.json", tmp_path, PYTHONIOENCODING="cp1252"
    )
    assert done.returncode == 0 and b"holds" in done.stdout


@pytest.mark.full
@POSIX
@pytest.mark.parametrize("encoding", ["cp1252", "ascii"])
def test_names_that_differ_are_written_differently(models: Path, encoding: str) -> None:
    """In signs of ASCII two of them would read the same."""
    done = shell("$D models models.json", models.parent, PYTHONIOENCODING=encoding)
    lines = done.stdout.decode(encoding).splitlines()
    names = [line.partition(": ")[0] for line in lines]
    assert done.returncode == 0 and len(set(names)) == 3
    assert names[0] == r"\u03b1\u2192" and names[1] == r"\u03b1->"


@pytest.mark.full
@POSIX
def test_signs_of_words_stay_readable_where_no_name_needs_them(tmp_path: Path) -> None:
    done = shell("$D compare 3:10 3:11", tmp_path, PYTHONIOENCODING="ascii")
    assert done.returncode == 0 and b"\\u" not in done.stdout and done.stdout.isascii()


@pytest.mark.sampled(2)
@pytest.mark.full
@POSIX
@pytest.mark.parametrize(
    ("asked", "unbuffered"),
    [("models 2", ""), ("--help", ""), ("--help", "1"), (f"{PAIR} --json -", "")],
)
def test_a_full_standard_output_is_named(tmp_path: Path, asked: str, unbuffered: str) -> None:
    done = shell(f"$D {asked} > /dev/full", tmp_path, PYTHONUNBUFFERED=unbuffered)
    said = b"disting: No space left on device: standard output\n"
    assert (done.returncode, done.stderr) == (2, said)


@pytest.mark.full
@POSIX
def test_a_full_device_is_named(tmp_path: Path) -> None:
    done = shell(f"$D {PAIR} --json /dev/full", tmp_path)
    assert done.returncode == 2 and b"/dev/full cannot be written (No space left" in done.stderr


def test_a_cache_that_is_none_of_the_three_choices_is_refused() -> None:
    done = called("verdicts", "2", cache="no")
    assert (done.returncode, done.stdout) == (2, "")
    assert "off, :memory:, or a file in an existing folder, such as cache.sqlite3" in done.stderr
