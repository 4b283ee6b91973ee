"""The small checker as a second opinion beside `disting verify`."""

import json
import shutil

import pytest

from disting import verdict_file, verify
from disting.cli.run import main
from disting.files import shipped_folder
from disting.verdict.small_checker import opinion_on_files, opinion_on_verdict
from disting.verdict.verification import Status


@pytest.mark.parametrize(
    ("pair", "checked"),
    [
        (("3:1", "3:2"), "counts"),
        (("3:2", "3:5"), "renaming"),
        (("R0-p(R1,C1)", "p(R0,C1-R1)"), "explicit"),
    ],
)
def test_what_holds_is_computed_again_by_both(pair, checked):
    data = verdict_file(*pair)
    opinion = opinion_on_verdict(data)
    assert checked in opinion.checked and not opinion.wrong and opinion.n_checked
    assert f"{checked}" in verify(data).text.partition("check.py")[2]


def test_the_small_checker_finds_a_lie_by_itself():
    data = verdict_file("3:2", "3:11")
    evidence = data["evidence"]
    lie = data | {"evidence": evidence | {"left": evidence["right"], "right": evidence["left"]}}
    (wrong,) = opinion_on_verdict(lie).wrong
    assert wrong.startswith("verdict counts")
    assert verify(lie).status is Status.FAILS


def test_what_it_does_not_repeat_is_named():
    opinion = opinion_on_verdict(verdict_file("3:1", "3:11"))
    assert any(reason.startswith("both ways (") for reason in opinion.searched)


@pytest.mark.full
def test_a_catalogue_is_checked_by_it_first(tmp_path, capsys):
    for file in shipped_folder().glob("*-2-*damped.jsonl"):
        shutil.copy(file, tmp_path)
    path = tmp_path / "chains-2-damped.jsonl"
    head, *rows = path.read_text().splitlines()
    first = json.loads(rows[0]) | {"rank": 99}
    path.write_text("\n".join([head, json.dumps(first), *rows[1:]]) + "\n")
    assert opinion_on_files([path]).wrong
    assert main(["catalog", "verify", "2", "--catalog", str(tmp_path)])  # 2: it cannot be read
    assert "2, by check.py: chains-2-damped" in capsys.readouterr().out
