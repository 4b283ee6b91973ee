"""The project folder: plain names, no way out of it, one server at a time."""

import json

import pytest

from disting.app.project import (
    check_name,
    fit_numbers,
    free_name,
    inside,
    list_files,
    measured,
    open_state,
    own_folder,
    save_state,
    summary,
)
from disting.errors import InputError

BAD = [
    "",
    ".",
    "..",
    "../a",
    "a/b",
    "a\\b",
    "/etc/passwd",
    "C:a",
    ".hidden",
    "a\0b",
    "a\nb",
    " a",
    "a ",
    "a.",
    "x" * 121,
    "é" * 61,
    "\ud800",
    "a?b",
    "a*",
    "\u202ea",
]


@pytest.mark.parametrize("name", BAD, ids=range(len(BAD)))
def test_a_name_is_one_plain_name(name):
    with pytest.raises(InputError):
        check_name(name)


@pytest.mark.parametrize("name", ["bench.csv", "Achse 1 (2).csv", "测量.csv", "a-b_c.mat", "FRF"])
def test_usual_names_are_taken(name):
    assert check_name(name) == name


def test_a_link_does_not_lead_out(tmp_path):
    project, outside = tmp_path / "project", tmp_path / "secret.csv"
    (project / "data").mkdir(parents=True)
    outside.write_text("1,2\n")
    (project / "data" / "a.csv").symlink_to(outside)
    with pytest.raises(InputError, match="leads out"):
        inside(project, "data", "a.csv")
    with pytest.raises(InputError, match="leads out"):
        measured("a.csv", project)


def test_a_linked_folder_does_not_lead_out(tmp_path):
    project = tmp_path / "project"
    project.mkdir()
    (tmp_path / "elsewhere").mkdir()
    (project / "data").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(InputError, match="leads out"):
        inside(project, "data", "a.csv")


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(InputError, match=r"no file 'b\.csv'"):
        measured("b.csv", tmp_path)


def test_a_name_that_is_taken_gets_a_number(tmp_path):
    for name in ("a.csv", "a-2.csv", "b"):
        (tmp_path / name).touch()
    assert [free_name(tmp_path, name) for name in ("a.csv", "b", "c.csv")] == [
        "a-3.csv",
        "b-2",
        "c.csv",
    ]


def test_what_a_page_saves_is_opened_again_and_can_be_read(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert open_state({"page": "machine"}) == {"content": None}
    save_state({"page": "machine", "content": {"text": "1=2; F1; S2"}})
    assert open_state({"page": "machine"}) == {"content": {"text": "1=2; F1; S2"}}
    assert json.loads((tmp_path / "machine.json").read_text()) == {"text": "1=2; F1; S2"}


def test_state_that_is_no_json_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "data.json").write_text("{")
    with pytest.raises(InputError, match="holds no JSON"):
        open_state({"page": "data"})


def test_only_whole_fits_are_listed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert list(fit_numbers(tmp_path)) == []
    for name in ("2", "10", "unfinished", "x", "03"):
        (tmp_path / "fits" / name).mkdir(parents=True)
        (tmp_path / "fits" / name / "fit.html").touch()
    (tmp_path / "fits" / "11").mkdir()
    assert list(fit_numbers(tmp_path)) == [2, 10]
    assert summary(2) == {"fit": 2, "files": ["fit.html"]}


def test_measured_files_are_listed_without_hidden_ones(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert list_files({}) == {"files": []}
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "b.csv").write_text("12")
    (tmp_path / "data" / ".a.partial").write_text("1")
    (tmp_path / "secret.csv").write_text("123")
    (tmp_path / "data" / "link.csv").symlink_to(tmp_path / "secret.csv")
    assert list_files({}) == {"files": [{"name": "b.csv", "size": 2}]}


def test_one_server_holds_a_folder(tmp_path):
    with own_folder(tmp_path / "p") as folder:
        assert folder == (tmp_path / "p").resolve()
        with pytest.raises(InputError, match="is open in another"), own_folder(tmp_path / "p"):
            pass
    with own_folder(tmp_path / "p"):
        pass
