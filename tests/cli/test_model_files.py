"""Files of models on the command line: verdicts and comparisons by name."""

import csv
import io
import json

import pytest

from disting import View
from tests.cli.process import called, disting, rows

LEAKS = {"A": [["-k12-k01", 0], ["k12", "-k02"]], "B": [1, 0], "C": [0, 1]}
EXCHANGE = {"A": [["-k12-k01", "k21"], ["k12", "-k21"]], "B": [1, 0], "C": [0, 1]}
MODELS = [
    {"name": "two leaks", **LEAKS},
    {"name": "exchange", **EXCHANGE},
    {"name": "swapped", "num": ["b"], "den": [1, "a + b + c", "a*(b + c)"]},
    {"name": "drive", "chain": "2:1", "damped": True},
    {"name": "by hand", "num": ["m", "d", "k"], "den": ["M*m", "d*(m + M)", "k*(m + M)"]},
]  # fmt: skip
SAME, APART, SOMETIMES = "indistinguishable", "distinguishable", "sometimes"


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    path = tmp_path_factory.mktemp("models") / "models.json"
    path.write_text(json.dumps({"models": MODELS}))
    return path


def told(table):
    return {(r["left"], r["right"]): r["relation"] for r in table}


@pytest.mark.full
def test_verdicts_on_a_file_name_its_models(models):
    found = told(rows(called("verdicts", models, "--csv", "-").stdout))
    assert len(found) == 10
    assert found.pop(("drive", "by hand")) == SAME
    assert found.pop(("two leaks", "swapped")) == SAME
    assert found.pop(("two leaks", "exchange")) == SOMETIMES
    assert found.pop(("exchange", "swapped")) == SOMETIMES
    assert set(found.values()) == {APART}


@pytest.mark.full
def test_the_summary_tells_which_are_the_same_and_which_sometimes(models):
    lines = called("verdicts", models).stdout.splitlines()
    assert lines[0] == (
        "5 models, 10 pairs, over positive parameters: 6 distinguishable, 2 indistinguishable, 2"
        " sometimes, 0 undecided"
    )
    assert "these are the same: two leaks, swapped" in lines
    assert "these are the same: drive, by hand" in lines
    assert sum(line.startswith("two leaks and exchange are sometimes") for line in lines) == 1
    over_complex = called("verdicts", models, "--domain", "complex").stdout
    assert "these are the same: two leaks, exchange, swapped\n" in over_complex


def test_a_pair_that_is_left_open_is_told_with_its_reason(tmp_path):
    path = tmp_path / "models.json"
    drives = [{"name": f"b{i}", "chain": f"3:1+b{i}", "damped": True} for i in (1, 3)]
    path.write_text(json.dumps({"models": drives}))
    told = called("verdicts", path, "--conditions", "8-9").stdout
    assert (
        "b1 and b3, damped, acceleration, are undecided over complex parameters: none of the available methods decides them"
        in told
    )


@pytest.mark.full
def test_conditions_and_json_are_those_of_chains(models, tmp_path):
    found = told(rows(called("verdicts", models, "--conditions", "1-5", "--csv", "-").stdout))
    assert found["drive", "by hand"] == "undecided" and found["two leaks", "drive"] == APART
    path = tmp_path / "verdicts.json"
    called("verdicts", models, "--json", path, "--domain", "complex")
    data = json.loads(path.read_text())
    assert data["joint_error_bound"] == "0" and len(data["verdicts"]) == 10
    assert all(v["evidence"]["kind"] for v in data["verdicts"])
    assert {v["domain"] for v in data["verdicts"]} == {View.EXACT.domain.value}


@pytest.mark.full
def test_a_warm_cache_gives_the_same_verdicts(models, tmp_path):
    cache = tmp_path / "cache.sqlite3"
    first = called("verdicts", models, "--json", "-", cache=cache).stdout
    assert called("verdicts", models, "--json", "-", cache=cache).stdout == first


@pytest.mark.slow
def test_workers_give_the_same_verdicts(models):
    alone = called("verdicts", models, "--json", "-").stdout
    assert disting("verdicts", models, "--json", "-", "--jobs", 2).stdout == alone


@pytest.mark.full
def test_compare_names_a_model_of_a_file_or_a_chain(models):
    done = called("compare", f"{models}:two leaks", f"{models}:exchange")
    assert done.stdout.startswith("SOMETIMES\n\n  two leaks  G(s) = k12/(")
    found = json.loads(called("compare", f"{models}:by hand", "2:1", "--damped", "--json").stdout)
    assert (found["left"], found["right"], found["relation"]) == ("by hand", "2:1", SAME)
    assert "[1FS]=[2]" in called("compare", "2:1", f"{models}:by hand", "--damped").stdout


HOSTILE = ["=1+1", "+cmd", "-2+3", "@SUM(A1)", "x,=cmd()", "x; =cmd()", '"<b>', "a'b", "{R}"]


@pytest.mark.full
def test_names_are_no_formulas_of_a_spreadsheet(tmp_path):
    path = tmp_path / "models.json"
    entries = [
        {"name": name, "num": ["k"] * (i + 1), "den": ["T", *[1] * (i + 1)]}
        for i, name in enumerate(HOSTILE)
    ]
    path.write_text(json.dumps({"models": entries}))
    text = called("verdicts", path, "--csv", "-", "--domain", "complex").stdout
    names = {row[0] for row in csv.reader(io.StringIO(text))}
    parts = [part.strip() for name in names for part in name.replace(",", ";").split(";")]
    assert not [part for part in parts if part[:1] in "=+-@"]
    assert "\\u003d1+1" in names and '"<b>' in names
    data = json.loads(called("verdicts", path, "--json", "-", "--domain", "complex").stdout)
    assert {v["left"] for v in data["verdicts"]} == set(HOSTILE[:-1])


BAD = [
    (("verdicts", "MODELS", "--damped"), "is supported for numbered chains"),
    (("verdicts", "MODELS", "--quantity", "velocity"), '"quantity" at the chains'),
    (("verdicts", "no.json"), "no.json cannot be read (No such file or directory)"),
    (("verdicts", "ONE"), "has one model: there is nothing to compare"),
    (("compare", "MODELS:nobody", "3:1"), "no model is called 'nobody'"),
    (("compare", "MODELS:", "3:1"), "no model is called ''"),
    (("equivalents", "MODELS:nobody", "--to", "MODELS"), "no model is called 'nobody'"),
    (("compare", "MODELS:drive", "3:1", "--bound", "m1=1..2"), "is supported for numbered chains"),
    (("compare", "MODELS:drive", "MODELS:by hand", "--damped"), "is supported for numbered chains"),
    (("compare", "MODELS:two leaks", "3:1+delay"), "not a rational function"),
]  # fmt: skip


@pytest.mark.parametrize(("command", "cause"), BAD)
def test_bad_usage_is_one_sentence(command, cause, models, tmp_path):
    one = tmp_path / "one.json"
    one.write_text(json.dumps({"models": MODELS[:1]}))
    done = called(*[x.replace("MODELS", str(models)).replace("ONE", str(one)) for x in command])
    assert (done.returncode, done.stdout) == (2, "")
    assert cause in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.full
def test_equivalents_of_a_model_in_a_file(models):
    """Two vessels are two low passes for some values: k = k12 and both poles, in either order."""
    values = "k12=1,k01=2,k02=5"
    done = called("equivalents", f"{models}:two leaks", "--to", models, "--set", values)
    assert (
        done.returncode == 0 and "two leaks: 1 of " in done.stdout and "other model" in done.stdout
    )
    data = json.loads(
        called(
            "equivalents",
            f"{models}:by hand",
            "--to",
            "2:1",
            "--set",
            "M=1,m=2,d=1/5,k=3",
            "--json",
        ).stdout
    )
    (found,) = data["equivalents"]
    assert found["name"] == "2:1" and found["relation"] == SAME
    assert found["values"] == [
        {"domain": "positive", "parameters": {"m1": "1", "m2": "2", "k12": "3", "d12": "1/5"}}
    ]
