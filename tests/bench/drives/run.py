"""Fit every drive of the bench with one tree of disting; one line of JSON a run is appended to OUT.

Usage: python run.py OUT.jsonl [KIND ...]; PYTHONPATH names the tree. Environment: PROCESSES (1),
DRIVES (such as 0,3,4; default all), RUNS (such as one,ab), AGAIN=1 (not: skip what OUT has).
"""

import json
import os
import re
import resource
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).parent
LIMIT = 300  # s of CPU
FIRST = (4, 6, 2, 3, 1)  # of each kind, run first: of all sizes and strengths
FIRST_BASES = (0, 6, 1, 2, 4)  # with and without friction of the bearing
KEEP = 14000  # characters of standard output


def options(g, run, new):
    """Words behind `fit`, and the files relative to the bench's folder."""
    name, kind, n, i = g["name"], g["kind"], g["n"], g["drive"]
    words = [f"data/{name}-A.csv"]
    if run.startswith("ab"):
        words += ["--test", f"data/{name}-B.csv"]
    words += [
        "--quantity",
        "position",
        "--read",
        "input=torque [Nm]",
        "--read",
        "output=angle [rad]",
        "--read",
        "period=8000",
    ]
    if kind == "loopref":
        words += ["--read", "reference=excitation [Nm]"]
    if g["hold"] and new and not run.endswith("nohold"):
        words += ["--hold", "record"]
    only_motor = ["--fix", "b2=0", "--fix", "b3=0"]  # fewer candidates
    if kind == "branch":
        words += ["--masses", "3"]
    elif kind == "base":
        words += ["--masses", str(n), "--base"] if run.endswith("base") else ["--masses", "3"]
        words += only_motor if n == 3 and run.endswith("base") else []
    elif n == 3:
        words += ["--masses", "3", *only_motor]
    elif i % 6 == 1:
        words += ["--masses", "2-3", *only_motor]
    else:
        words += ["--masses", "2"]
    return [*words, "--jobs", "1"]


def runs_of(g, new):
    if g["kind"] == "base":
        return ["one"] + (["one-base", "ab-base"] if new else ["ab"])
    if g["kind"] == "hold" and new and g["drive"] % 4 == 0:
        return ["one", "ab", "one-nohold"]
    return ["one", "ab"]


def turn(g):
    first = FIRST_BASES if g["kind"] == "base" else FIRST
    return first.index(g["drive"]) if g["drive"] in first else 9


def worker(words, out):
    """In the child: run the command, as `python -m disting` does."""
    os.chdir(HERE)
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 5))
    for number, path in ((1, out + ".out"), (2, out + ".err")):
        os.dup2(os.open(path, os.O_CREAT | os.O_TRUNC | os.O_WRONLY), number)
    sys.stdout = os.fdopen(1, "w", closefd=False)
    sys.stderr = os.fdopen(2, "w", closefd=False, buffering=1)
    from disting.cli.run import main

    status = 70
    try:
        status = main(["fit", *words, "--json", out + ".json"])
    except BaseException:
        import traceback

        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)


def slim(found):
    """What the table needs of a fit's JSON."""
    if not found:
        return None
    slim = {
        k: found.get(k)
        for k in (
            "status",
            "explained",
            "chi2_per_line",
            "scatter",
            "scatter_source",
            "answer",
            "remarks",
            "suspicions",
            "misses",
            "question",
            "residual_correlation",
            "look_alikes",
            "not_excluded",
            "frequencies",
            "data",
        )
    }
    slim["selected"] = found.get("selected")
    slim["candidates"] = [
        {
            k: c.get(k)
            for k in (
                "name",
                "n_masses",
                "ground_dampers",
                "lag",
                "delay",
                "gap",
                "chi2_per_line",
                "excluded_by",
                "j_test",
                "j_train",
            )
        }
        for c in found.get("candidates", [])
    ]
    return slim


def collect(job, status, usage, wall, out):
    stdout, stderr = (
        Path(out + s).read_text(errors="replace") if Path(out + s).exists() else ""
        for s in (".out", ".err")
    )
    stderr = "\n".join(
        x for x in stderr.splitlines() if not re.match(r"disting: [\w ]+: \d+ of \d+, ", x)
    )
    found = None
    if Path(out + ".json").exists():
        try:
            found = json.loads(Path(out + ".json").read_text())
        except ValueError:
            stderr += "\nJSON not readable"
    for s in (".out", ".err", ".json"):
        Path(out + s).unlink(missing_ok=True)
    return {
        **job,
        "status": status,
        "cpu": round(usage.ru_utime + usage.ru_stime, 2),
        "wall": round(wall, 1),
        "mb": usage.ru_maxrss // 1024,
        "at": time.strftime("%H:%M:%S", time.gmtime()),
        "stdout": stdout[:KEEP],
        "stderr": stderr[:6000],
        "fit": slim(found),
    }


def modules(out):
    """Names of modules that a fit loads, so that they are loaded once for all."""
    code = "import sys\nfrom disting.cli.run import main\nmain(['fit', '--demo', '--masses', '1', '--json', '-'])\nprint('\\n@' + ' '.join(sys.modules))"
    text = subprocess.run(
        [sys.executable, "-c", code], cwd=HERE, capture_output=True, text=True
    ).stdout
    return text.rpartition("@")[2].split()


def main():
    out = sys.argv[1]
    drives = json.loads((HERE / "drives.json").read_text())
    kinds = sys.argv[2:] or list(dict.fromkeys(g["kind"] for g in drives.values()))
    some = [int(x) for x in os.environ.get("DRIVES", "").split(",") if x]
    third = os.environ.get("THIRD")
    only = [x for x in os.environ.get("RUNS", "").split(",") if x]
    import importlib

    import disting

    help_text = subprocess.run(
        [sys.executable, "-m", "disting", "fit", "--help-all"],
        cwd=HERE,
        capture_output=True,
        text=True,
    ).stdout
    new = "--hold" in help_text
    loaded = 0
    for name in modules(out):
        try:
            importlib.import_module(name)
            loaded += 1
        except Exception:
            pass
    print(
        disting.__file__, "with --hold" if new else "without --hold", loaded, "modules", flush=True
    )
    done = set()
    if os.path.exists(out):
        for line in Path(out).read_text().splitlines():
            try:
                r = json.loads(line)
                done.add((r["drive"], r["run"]))
            except ValueError:
                pass
    jobs = []
    for g in sorted(
        (g for g in drives.values() if g["kind"] in kinds),
        key=lambda g: (turn(g), g["drive"], kinds.index(g["kind"])),
    ):
        if (some and g["drive"] not in some) or (third and turn(g) > 3):
            continue
        for run in runs_of(g, new):
            if (g["name"], run) not in done and (not only or run in only):
                jobs.append(
                    {
                        "drive": g["name"],
                        "kind": g["kind"],
                        "run": run,
                        "words": options(g, run, new),
                    }
                )
    print(len(jobs), "runs", flush=True)
    places, running = int(os.environ.get("PROCESSES", "1")), {}
    while jobs or running:
        while jobs and len(running) < places:
            job = jobs.pop(0)
            place = os.path.abspath(f"{out}.tmp-{job['drive']}-{job['run']}")
            pid = os.fork()
            if pid == 0:
                worker(job["words"], place)
            running[pid] = (job, time.time(), place)
        pid, status, usage = os.wait4(-1, 0)
        if pid in running:
            job, began, place = running.pop(pid)
            code = os.waitstatus_to_exitcode(status)
            row = collect(job, code, usage, time.time() - began, place)
            with open(out, "a") as f:
                f.write(json.dumps(row) + "\n")
            first = next(
                (
                    x
                    for x in row["stdout"].splitlines()
                    if x.startswith("structure:") or "explains" in x
                ),
                row["stderr"][-100:].strip(),
            )
            print(
                time.strftime("%H:%M:%S", time.gmtime()),
                job["drive"],
                job["run"],
                code,
                f"{row['cpu']:.0f} s CPU",
                f"{row['wall']:.0f} s",
                first[:150],
                flush=True,
            )


if __name__ == "__main__":
    main()
