"""The command line as its users meet it: real processes, their output and their exit status."""

import csv
import io
import json
import os
import signal
import sqlite3
import subprocess
import sys
import time

import pytest


def disting(*arguments, cache="off", cwd=None):
    environment = os.environ | {"DISTING_CACHE": str(cache), "COLUMNS": "100"}
    command = [sys.executable, "-m", "disting", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=120, check=False, cwd=cwd)


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_models_lists_the_family():
    done = disting("models", 3, "--damped")
    assert done.returncode == 0
    lines = done.stdout.splitlines()
    assert len([line for line in lines if line.split()[0].isdigit() and "[" in line]) == 11
    assert "#=[1fs]   [2F]=[3S]" in done.stdout
    assert "parameters, gap 1: m1 m2 m3 k01 k23 d01 d23" in done.stdout


def test_compare_explains_one_pair():
    done = disting("compare", "3:1", "3:4", "--damped")
    assert done.returncode == 0
    assert done.stdout.startswith("DISTINGUISHABLE")
    assert "condition 5, Markov parameters" in done.stdout
    assert "2^-1" in done.stdout


def test_compare_as_json_of_shipped_computed_and_mixed_pairs():
    shipped = json.loads(disting("compare", "3:2", "3:5", "--json").stdout)
    assert (shipped["relation"], shipped["decided_by"], shipped["certainty"]) == ("indistinguishable", "6", "theorem")
    computed = json.loads(disting("compare", "3:2", "3:5", "--json", "--sensor", "velocity").stdout)
    assert computed["relation"] == "indistinguishable"
    mixed = json.loads(disting("compare", "2:1", "3:1", "--json").stdout)
    assert (mixed["left"], mixed["right"], mixed["relation"]) == ("2:1", "3:1", "distinguishable")


def test_verdicts_csv_contract_and_subsets():
    everything = rows(disting("verdicts", 3, "--damped", "--csv", "-").stdout)
    assert list(everything[0])[:6] == ["left", "right", "relation", "decided_by", "representation", "certainty"]
    assert [(int(r["left"]), int(r["right"])) for r in everything] == [(i, j) for i in range(1, 12) for j in range(i + 1, 12)]
    assert not [r for r in everything if r["relation"] == "undecided"]
    conditions = rows(disting("verdicts", 3, "--damped", "--conditions", "1-9", "--csv", "-").stdout)
    assert sum(r["relation"] == "undecided" and r["decided_by"] == "" for r in conditions) == 6
    paper = rows(disting("verdicts", 3, "--conditions", "1-5", "--representation", "tf", "--csv", "-").stdout)
    assert {r["decided_by"] for r in paper} == {"1", "4", "5", ""}
    eight = rows(disting("verdicts", 3, "--representation", "markov", "--markov", 8, "--csv", "-").stdout)
    assert {r["representation"] for r in eight} == {"markov", ""}


def test_verdicts_json_has_evidence(tmp_path):
    path = tmp_path / "v.json"
    done = disting("verdicts", 2, "--json", path)
    assert done.returncode == 0
    assert "3 models, 3 pairs" in done.stdout
    assert all(v["evidence"]["kind"] for v in json.loads(path.read_text())["verdicts"])


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((), "required"),
        (("compare", "3:12", "3:1"), "models 1 to 11"),
        (("compare", "3", "3:1"), "masses:number"),
        (("models", "0"), "at least 1"),
        (("verdicts", "3", "--conditions", "0-5"), "conditions are written like"),
        (("verdicts", "3", "--conditions", "5-3"), "conditions are written like"),
        (("verdicts", "3", "--sensor", "force"), "invalid choice"),
        (("verdicts", "3", "--csv", "/no/such/folder/v.csv"), "No such file"),
        (("verdicts", "3", "--scheduler", "tcp://127.0.0.1:9"), "no dask scheduler"),
        (("catalog", "verify", "3", "--catalog", "/no/such"), "disting catalog build"),
        (("report", "3", "--damped", "--undamped"), "not allowed with"),
    ],
)
def test_bad_usage_is_one_clear_sentence_and_status_2(arguments, says):
    done = disting(*arguments)
    assert done.returncode == 2
    assert says in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert "Traceback" not in done.stderr


def test_help_on_everything():
    names = [
        "models",
        "compare",
        "verdicts",
        "report",
        "catalog",
        "catalog build",
        "catalog verify",
        "cache info",
        "cache clear",
    ]
    for command in names:
        done = disting(*command.split(), "--help")
        assert done.returncode == 0
        assert "usage: disting" in done.stdout
    assert "9  supermodel" in disting("--help").stdout


def test_catalog_build_and_verify(tmp_path):
    assert disting("catalog", "build", 2, "--out", tmp_path).returncode == 0
    good = disting("catalog", "verify", 2, "--catalog", tmp_path)
    assert (good.returncode, good.stdout.count("every evidence holds")) == (0, 2)
    path = tmp_path / "chains-2-damped.jsonl"
    path.write_text(path.read_text().replace('"decided_by":"1"', '"decided_by":"2"'))
    bad = disting("catalog", "verify", 2, "--catalog", tmp_path)
    assert bad.returncode == 1
    assert "line 5 is not what is computed now" in bad.stdout


def test_cache_is_filled_reported_and_cleared(tmp_path):
    cache = tmp_path / "deep" / "cache.sqlite3"
    paper = ("verdicts", 3, "--conditions", "1-9", "--csv", "-")
    assert disting(*paper, cache=cache).stdout == disting(*paper, cache=cache).stdout
    info = disting("cache", "info", cache=cache).stdout
    assert "entries  9" in info  # nine canonical models; transfer functions settle all pairs
    assert disting("verdicts", 4, "--no-cache", cache=cache).returncode == 0
    assert "entries  9" in disting("cache", "info", cache=cache).stdout
    assert "9 entries removed" in disting("cache", "clear", cache=cache).stdout


@pytest.mark.parametrize("content", [b"", b"\x00" * 5000, b"SQLite format 3\x00 but no more", os.urandom(3000)])
def test_a_damaged_cache_is_set_aside_with_a_warning(tmp_path, content):
    cache = tmp_path / "cache.sqlite3"
    cache.write_bytes(content)
    done = disting("verdicts", 3, "--csv", "-", cache=cache)
    assert done.returncode == 0
    assert len(rows(done.stdout)) == 55
    assert "Traceback" not in done.stderr
    assert done.stderr.startswith("disting: warning:")
    assert list(tmp_path.glob("cache.sqlite3.damaged-*"))


def test_many_processes_share_one_cache(tmp_path):
    cache = tmp_path / "cache.sqlite3"
    environment = os.environ | {"DISTING_CACHE": str(cache)}
    command = [sys.executable, "-m", "disting", "verdicts", "4", "--damped", "--csv", "-"]
    running = [
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment) for _ in range(4)
    ]
    outputs = [process.communicate(timeout=120) for process in running]
    assert [process.returncode for process in running] == [0] * 4
    assert {error for _, error in outputs} == {""}
    assert len({text for text, _ in outputs}) == 1


def test_a_run_killed_at_any_moment_resumes(tmp_path):
    """Kill the run again and again; what it had stored stays, grows, and the last run gives the true result."""
    cache = tmp_path / "cache.sqlite3"
    environment = os.environ | {"DISTING_CACHE": str(cache)}
    command = [sys.executable, "-m", "disting", "verdicts", "5", "--damped", "--conditions", "1-9", "--csv", "-"]
    stored, delay = [], 0.5
    while len(stored) < 8 or (stored[-1] == 0 and delay < 60):  # a busy machine needs longer to store anything
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
        time.sleep(delay)
        delay = delay + 0.15 if len(stored) < 8 else 2 * delay
        process.send_signal(signal.SIGKILL)
        process.wait()
        stored.append(entries(cache))
    assert stored == sorted(stored)
    assert stored[-1] > 0
    paper = ("verdicts", 5, "--damped", "--conditions", "1-9", "--csv", "-")
    assert disting(*paper, cache=cache).stdout == disting(*paper).stdout
    assert entries(cache) == 90  # 49 canonical models, of which 41 need Markov parameters too


def entries(cache):
    if not cache.exists():
        return 0
    with sqlite3.connect(cache) as connection:
        count = connection.execute("SELECT count(*) FROM entry").fetchone()[0]
    connection.close()
    return count


def test_worker_processes_and_a_dask_cluster_give_the_same_verdicts(tmp_path):
    alone = disting("verdicts", 3, "--damped", "--csv", "-").stdout
    assert disting("verdicts", 3, "--damped", "--csv", "-", "--jobs", 2).stdout == alone
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster:
        done = disting("verdicts", 3, "--damped", "--csv", "-", "--scheduler", cluster.scheduler_address)
    assert done.stdout == alone


def test_interrupt_leaves_no_traceback(tmp_path):
    environment = os.environ | {"DISTING_CACHE": str(tmp_path / "c.sqlite3")}
    process = subprocess.Popen(
        [sys.executable, "-m", "disting", "verdicts", "7", "--damped"],
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a shell's background jobs inherit SIG_IGN
    )
    time.sleep(2.0)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    assert process.returncode == 130
    assert error.strip() == "disting: interrupted; what was finished is kept in the cache"


def test_a_closed_pipe_is_no_error():
    command = f"{sys.executable} -m disting verdicts 4 --csv - --no-cache | head -1"
    done = subprocess.run(["bash", "-c", f"set -o pipefail; {command}"], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("left,right")


def test_the_exact_decision_settles_what_conditions_leave_open():
    table = rows(disting("verdicts", 3, "--damped", "--csv", "-").stdout)
    exact = {(int(r["left"]), int(r["right"])): r["relation"] for r in table if r["decided_by"] == "exact"}
    assert len(exact) == 6
    assert [pair for pair, relation in exact.items() if relation == "indistinguishable"] == [(1, 11)]
    assert not any(r["relation"] == "undecided" for r in table)
    shipped = json.loads(disting("compare", "3:1", "3:6", "--damped", "--json").stdout)
    assert (shipped["relation"], shipped["decided_by"]) == ("distinguishable", "exact")
    paper = json.loads(disting("compare", "3:1", "3:6", "--damped", "--conditions", "1-9", "--json").stdout)
    assert (paper["relation"], paper["decided_by"]) == ("undecided", "")


def test_ranges_and_positive_parameters_are_told_both_ways():
    done = disting("compare", "4:2", "4:6", "--domain", "positive").stdout.splitlines()
    assert done[0] == "SOMETIMES"
    assert any("77 of 100 random points have one: empirically 68% to 84%" in line for line in done)
    apart = disting("compare", "3:6", "3:7", "--damped").stdout.splitlines()
    assert apart[-1].startswith("positive: A7 in A6 never. No generic positive parameters of A7")
    inside = disting("compare", "3:1", "3:4", "--range", "k12=0..1000", "--range", "m1=0.5..2").stdout.splitlines()
    for line, start in zip(inside[-2:], ("A1 in A4", "A4 in A1"), strict=True):
        assert line.startswith(f"within the ranges: {start} sometimes")
    for wrong, says in (("k12=5", "written like"), ("x9=1..2", "no parameter"), ("k12=3..1", "not empty")):
        refused = disting("compare", "3:1", "3:4", "--range", wrong)
        assert refused.returncode == 2 and says in refused.stderr


def test_the_doctor_names_what_is_there():
    done = disting("doctor")
    assert done.returncode == 0
    assert {"disting", "python-flint", "msolve", "Singular", "cache"} <= {line.split()[0] for line in done.stdout.splitlines()}


def test_proofs_on_request():
    table = rows(disting("verdicts", 3, "--damped", "--prove", "--csv", "-").stdout)
    assert {r["certainty"] for r in table if r["decided_by"] in ("4", "5")} == {"proven"}
