"""A real server: what it answers, what it keeps, how it ends."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from resource import RLIMIT_FSIZE, setrlimit
from shutil import copytree

import pytest
from jsonschema import validate

from disting.app.interface import CALLS
from tests.app.served import bench_csv, serving, spectrum_csv
from tests.cli.process import called

pytestmark = pytest.mark.full
PLAIN = {"file": "bench.csv", "reading": {}}
VELOCITY = {"file": "bench.csv", "reading": {"quantity": "velocity"}}
SMALL = {"measurements": [VELOCITY], "masses": [1, 2]}
CIRCUITS = {  # a third of the work of a fit of chains, most of which is its figures
    "measurements": [{"file": "eis.csv", "reading": {}}],
    "masses": [1],
    "models": ["R1-C1", "R0-p(R1,C1)"],
}


def children(pid: int) -> set[int]:
    """Processes below one."""
    listed = subprocess.run(["ps", "-eo", "pid=,ppid="], capture_output=True, text=True, check=True)
    pairs = [tuple(map(int, line.split())) for line in listed.stdout.splitlines()]
    found, new = set(), {pid}
    while new:
        new = {child for child, parent in pairs if parent in new}
        found |= new
    return found


def is_there(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def all_end(pids: set[int]) -> bool:
    """Return True once none of the processes is there; they have half a minute."""
    until = time.monotonic() + 30
    while time.monotonic() < until and any(map(is_there, pids)):
        time.sleep(0.1)
    return not any(map(is_there, pids))


def test_the_page_and_its_parts_are_served_with_their_policy(app):
    status, headers, body = app.ask("GET", "/")
    assert status == 200 and b'role="tablist"' in body
    assert headers["content-security-policy"].startswith("default-src 'none'; script-src 'self';")
    for path in re.findall(rb'(?:src|href)="(/[^"]+)"', body):
        assert app.ask("GET", path.decode())[0] == 200
    assert app.ask("GET", "/", cookie="")[0] == 401


def test_what_is_read_follows_its_schema_and_its_fields(app):
    status, plain = app.call("look", PLAIN)
    assert status == 200
    validate(plain, CALLS["look"].schema["properties"]["answer"])
    assert plain["look"]["quantity"] == "acceleration"
    assert plain["look"]["assumed"][0]["what"] == "quantity acceleration"
    assert plain["diagram"]["kind"] == "bode" and len(plain["diagram"]["gain"]) == 80
    _, other = app.call("look", VELOCITY)
    assert (other["look"]["quantity"], other["look"]["assumed"]) == ("velocity", [])
    assert other["command"] == "disting look data/bench.csv --quantity velocity"
    _, band = app.call("look", {"file": "bench.csv", "reading": {"band": [10, 100]}})
    assert 10 <= band["diagram"]["frequency"][0] < band["diagram"]["frequency"][-1] <= 100


@pytest.mark.parametrize(
    ("reading", "words"),
    [
        ({"column": "torque"}, "torque"),
        ({"band": [200, 10]}, "swap them"),
        ({"units": {"frequency": "furlong"}}, "furlong"),
        ({"quantity": "speed"}, "reading.quantity"),
        ({"colour": "red"}, "additionalProperties"),
    ],
)
def test_a_reading_that_cannot_be_is_refused_in_one_sentence(app, reading, words):
    status, answer = app.call("look", {"file": "bench.csv", "reading": reading})
    sentence = answer["error"] if status == 422 else " ".join(answer["look"]["doubts"])
    assert words in sentence and "\n" not in sentence and "Traceback" not in sentence


def test_a_file_that_is_no_measurement_is_refused(app):
    assert app.upload("letter.csv", b"Dear Sir,\nthank you.\n")[0] == 200
    status, answer = app.call("look", {"file": "letter.csv", "reading": {}})
    assert status == 422 and "letter.csv" in answer["error"]


def test_the_same_file_is_kept_once_and_another_one_beside_it(app):
    assert app.upload("twice.csv", b"a,b\n1,2\n")[1]["name"] == "twice.csv"
    assert app.upload("twice.csv", b"a,b\n1,2\n")[1]["name"] == "twice.csv"
    assert app.upload("twice.csv", b"a,b\n1,3\n")[1]["name"] == "twice-2.csv"
    assert (app.folder / "data" / "twice.csv").read_bytes() == b"a,b\n1,2\n"
    assert app.upload("empty.csv", b"")[0] == 422
    assert not [path for path in (app.folder / "data").iterdir() if path.name.startswith(".")]


@pytest.fixture(scope="module")
def fitted(app) -> list[tuple[str, dict]]:
    """Events of a fit of one and two masses: most of its time are its figures."""
    status, begun = app.call("fit", SMALL)
    assert status == 202
    return [*app.events(begun["job"])]


@pytest.fixture(scope="module")
def circuits(app) -> dict:
    """The last event of a fit of circuits."""
    app.upload("eis.csv", spectrum_csv())
    return app.run("fit", CIRCUITS)


def test_a_fit_reports_every_candidate_and_leaves_a_readable_folder(app, fitted):
    events = fitted
    assert {content["what"] for name, content in events if name == "progress"} >= {"fit"}
    end = events[-1][1]
    assert (events[-1][0], end["state"]) == ("end", "done"), end
    answer = end["answer"]
    validate(answer, CALLS["fit"].schema["properties"]["answer"])
    assert answer["explains"] and "2:1+b1+delay" in answer["answer"][1]
    folder = app.folder / "fits" / str(answer["fit"])
    assert json.loads((folder / "fit.json").read_text())["format"] == "disting fit 1"
    assert json.loads((folder / "about.json").read_text())["request"] == SMALL
    status, headers, page = app.ask("GET", f"/project/fits/{answer['fit']}/fit.html")
    assert status == 200 and page == (folder / "fit.html").read_bytes()
    assert "frame-ancestors 'self'" in headers["content-security-policy"]
    status, headers, _ = app.ask("GET", f"/project/fits/{answer['fit']}/model.mat")
    assert status == 200 and headers["content-disposition"].startswith("attachment")
    assert answer["fit"] in [found["fit"] for found in app.call("fits", {})[1]["fits"]]


@pytest.mark.slow
def test_the_command_that_the_page_shows_gives_the_same_fit(app):
    app.upload("again.csv", bench_csv(81))
    more = {"masses": [1], "test": "again.csv", "fix": {"Td": 3e-4}, "bound": {"m1": [0.001, 1.0]}}
    answer = app.run("fit", SMALL | more | {"controller": "P=0.01"})["answer"]
    words = answer["command"].split()
    assert {"--test", "--fix", "--bound", "--controller"} <= {*words}
    assert words[:2] == ["disting", "fit"]
    done = subprocess.run([sys.executable, "-m", "disting", *words[1:], "--json", "-"], cwd=app.folder, capture_output=True, text=True, check=False)  # fmt: skip
    assert json.loads(done.stdout)["answer"] == answer["answer"]


def test_what_a_stopped_plan_leaves_is_the_fit_alone(app, fitted):
    first = fitted[-1][1]["answer"]["fit"]
    folder = app.folder / "fits" / str(first)
    before = sorted(path.name for path in folder.iterdir())
    job = app.call("plan", {"fit": first})[1]["job"]
    app.ask("POST", f"/api/jobs/{job}/stop")
    assert [*app.events(job)][-1][1]["state"] == "stopped"
    assert sorted(path.name for path in folder.iterdir()) == before


def test_after_a_fit_its_advice_its_plan_and_another_fit_beside_it(
    app, fitted, circuits, monkeypatch
):
    first, second = fitted[-1][1]["answer"]["fit"], circuits["answer"]["fit"]
    monkeypatch.chdir(app.folder)
    for name in ("next", "plan"):
        end = app.run(name, {"fit": first})
        assert end["state"] == "done", end
        validate(end["answer"], CALLS[name].schema["properties"]["answer"])
        words = end["answer"][name]["command"].split()
        done = called(*words[1:])
        assert done.stdout == end["answer"][name]["text"] + "\n"
    kept = next(x for x in app.call("fits", {})[1]["fits"] if x["fit"] == first)
    assert "next" in kept and "plan.html" in kept["files"]
    validate(app.call("fits", {})[1], CALLS["fits"].schema["properties"]["answer"])
    status, both = app.call("two_fits", {"fits": [first, second]})
    assert status == 200, both
    rows = {name: texts for name, *texts in both["rows"]}
    assert rows["Data"] == ["bench.csv", "eis.csv"] and rows["Structure"][0] == "2:1+b1+delay"
    end = app.run("fits_verdict", {"fits": [first, second]})
    assert end["state"] == "done" and "a dead time" in end["answer"]["verdict"], end
    assert app.call("two_fits", {"fits": [first, 999]})[1]["error"] == "the project has no fit 999"


@pytest.mark.slow
def test_a_fit_of_what_an_earlier_one_left_is_that_of_the_command(app):
    first = app.run("fit", SMALL | {"masses": [2]})["answer"]["fit"]
    app.upload("again.csv", bench_csv(81))
    second = {"file": "again.csv", "reading": VELOCITY["reading"], "sensor": "1"}
    end = app.run("fit", {"measurements": [VELOCITY, second], "masses": [1], "left": first})
    assert end["state"] == "done", end
    words = end["answer"]["command"].split()
    assert words[-2:] == ["--left", f"fits/{first}/fit.json"]
    done = subprocess.run([sys.executable, "-m", "disting", *words[1:], "--json", "-"], cwd=app.folder, capture_output=True, text=True, check=False)  # fmt: skip
    assert json.loads(done.stdout)["answer"] == end["answer"]["answer"]


@pytest.mark.slow
def test_a_fit_that_assumes_the_wrong_quantity_explains_nothing(app):
    answer = app.run("fit", {"measurements": [PLAIN], "masses": [1]})["answer"]
    assert not answer["explains"]


def test_circuits_are_fitted_to_a_spectrum(app, circuits):
    seen = app.call("look", CIRCUITS["measurements"][0])[1]
    assert (seen["diagram"]["kind"], seen["look"]["impedance"]) == ("nyquist", True)
    assert circuits["state"] == "done", circuits
    answer = circuits["answer"]
    assert "R0-p(R1,C1)" in " ".join(answer["answer"]) and answer["explains"]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"models": ["R0-p(R1"]}, "R0-p(R1"),
        ({"measurements": [{"file": "none.csv", "reading": {}}]}, "no file"),
        ({"measurements": [VELOCITY, VELOCITY]}, "what is different"),
        ({"measurements": [VELOCITY, VELOCITY | {"change": "paint=2"}]}, "a change is written"),
        ({"fix": {"m9": 1.0}}, "m9"),
        ({"controller": "P=2,loop=round"}, "loop"),
        ({"base": True, "measurements": [VELOCITY | {"sensor": "2"}]}, "elastic base"),
    ],
)
def test_a_fit_that_cannot_be_fails_with_a_sentence(app, change, words):
    end = app.run("fit", SMALL | change)
    assert end["state"] == "failed" and words in end["message"], end
    assert "\n" not in end["message"]


def test_a_stopped_fit_leaves_nothing_and_the_next_job_runs(app, fitted):
    before = len(app.call("fits", {})[1]["fits"])
    begun = app.call("fit", SMALL | {"masses": [1, 2, 3, 4]})[1]["job"]
    events = app.events(begun)
    while next(events)[1]["what"] != "fit":
        pass
    assert app.ask("POST", f"/api/jobs/{begun}/stop")[0] == 200
    assert [*events][-1][1]["state"] == "stopped"
    assert len(app.call("fits", {})[1]["fits"]) == before
    assert app.run("next", {"fit": fitted[-1][1]["answer"]["fit"]})["state"] == "done"


def test_eight_clients_at_once_get_their_own_answers(app):
    bands = [[5 + k, 100 + 10 * k] for k in range(8)]

    def ask(band):
        return [
            app.call("look", {"file": "bench.csv", "reading": {"band": band}}) for _ in range(6)
        ]

    with ThreadPoolExecutor(8) as pool:
        for band, answers in zip(bands, pool.map(ask, bands), strict=True):
            for status, answer in answers:
                assert status == 200
                frequency = answer["diagram"]["frequency"]
                assert band[0] <= frequency[0] < band[0] * 1.1 and frequency[-1] <= band[1]


def test_a_killed_worker_is_replaced_and_nothing_stays_behind(tmp_path):
    with serving(tmp_path / "project") as own:
        own.upload("bench.csv", bench_csv())
        assert own.call("look", PLAIN)[0] == 200
        pid = own.process.pid
        for worker in children(pid):
            os.kill(worker, signal.SIGKILL)
        answers = [own.call("look", PLAIN)[0] for _ in range(6)]
        assert answers[-1] == 200 and set(answers) <= {200, 500}
        left = children(pid)
        with pytest.raises(AssertionError, match="open in another"), serving(tmp_path / "project"):
            pass
    assert own.process.returncode == 0
    assert all_end(left)


def test_workers_that_are_killed_while_they_start_are_replaced(tmp_path):
    with serving(tmp_path / "project") as own:
        own.upload("bench.csv", bench_csv())
        for worker in children(own.process.pid):  # what starts the others is among them
            os.kill(worker, signal.SIGKILL)
        assert own.call("look", PLAIN)[0] in (200, 500)
        assert own.call("look", PLAIN)[0] == 200
    assert own.process.returncode == 0


def test_a_killed_server_loses_no_finished_fit_and_no_worker_outlives_it(app, circuits, tmp_path):
    finished = app.folder / "fits" / str(circuits["answer"]["fit"])
    with serving(tmp_path / "project") as own:
        own.upload("bench.csv", bench_csv())
        copytree(finished, own.folder / "fits" / "1")
        own.call("save", {"page": "data", "content": {"measurements": [VELOCITY]}})
        own.call("fit", SMALL | {"masses": [1, 2, 3, 4]})
        while not (tmp_path / "project" / "fits" / "unfinished").is_dir():
            time.sleep(0.05)
        below = children(own.process.pid)
        own.process.kill()
        own.process.wait()
    assert all_end(below)
    with serving(tmp_path / "project") as again:
        assert [found["fit"] for found in again.call("fits", {})[1]["fits"]] == [1]
        content = again.call("open", {"page": "data"})[1]["content"]
        assert content == {"measurements": [VELOCITY]}


def test_a_full_disk_is_one_sentence_and_leaves_what_was_there(tmp_path):
    """No file may grow beyond ten kilobytes, as on a full disk."""
    with serving(
        tmp_path / "project", before=lambda: setrlimit(RLIMIT_FSIZE, (10_000,) * 2)
    ) as own:
        assert own.upload("bench.csv", bench_csv())[0] == 200
        status, answer = own.upload("large.csv", b"1,2\n" * 10_000)
        assert status == 507 and answer == {"error": "File too large"}
        assert own.call("save", {"page": "data", "content": {"a": 1}})[0] == 200
        status, answer = own.call("save", {"page": "data", "content": {"a": "x" * 20_000}})
        assert status == 507 and "File too large" in answer["error"]
        assert own.call("open", {"page": "data"})[1] == {"content": {"a": 1}}
        assert [path.name for path in (tmp_path / "project" / "data").iterdir()] == ["bench.csv"]


def test_without_the_extra_one_sentence_names_it():
    code = "import sys; sys.modules['starlette'] = None; from disting.cli.run import main; sys.exit(main(['app', 'p']))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert (
        done.stderr.strip()
        == "disting: 'disting app' needs more packages: pip install 'disting[app]'"
    )


def test_a_port_that_is_taken_is_one_sentence(app, tmp_path):
    port = app.netloc.partition(":")[2]
    done = subprocess.run([sys.executable, "-m", "disting", "app", str(tmp_path / "p"), "--port", port], capture_output=True, text=True, check=False)  # fmt: skip
    assert done.returncode == 2 and f"port {port} cannot be used" in done.stderr
