"""Readers that go away, places that may not be written, locks left behind, disks that are full:
a result or one sentence.
"""

import os
import shutil
import subprocess

import pytest

from tests.attack.counts import times
from tests.cli.process import COMMAND, disting

pytestmark = [
    pytest.mark.attack,
    pytest.mark.skipif(os.name != "posix", reason="pipes, mounts and limits are of POSIX"),
]
ASK = ("verdicts", "2", "--damped", "--json", "-")
LONG = (
    "verdicts 3 --csv -",
    "models 3",
    "dampers 3:1 --sets all --csv -",
    "simulate",
    "verdicts 3 --json -",
    "fit --demo --masses 1",
)
REDIRECTED = ("| head -1", "| head -c 1", "| true", ">&-", "2>&-", ">&- 2>&-", "<&-", "| sleep 0.1")


@pytest.mark.parametrize("arguments", LONG)
def test_readers_that_go_away(tmp_path, counts, arguments):
    for redirected in REDIRECTED:
        command = f"set -o pipefail; {' '.join(COMMAND)} {arguments} {redirected}"
        environment = os.environ | {"DISTING_CACHE": str(tmp_path / "cache.sqlite3")}
        for _ in range(times(1)):
            done = subprocess.run(
                ["bash", "-c", command],
                capture_output=True,
                text=True,
                check=False,
                env=environment,
                timeout=600,
            )
            counts["tried"] += 1
            odd = done.returncode != 0 or "Traceback" in done.stderr or "Exception" in done.stderr
            counts["wrong"] += odd
            assert not odd, (redirected, done)


@pytest.fixture
def frozen():
    """A function that makes paths unchangeable, even for root; undone at the end."""
    kept = []

    def freeze(path):
        done = (
            subprocess.run(
                ["chattr", "+i", str(path)], capture_output=True, check=False, timeout=600
            )
            if shutil.which("chattr")
            else None
        )
        if done is None or done.returncode:
            pytest.skip("this file system has no unchangeable files, or not for this user")
        kept.append(path)

    yield freeze
    for path in kept:
        subprocess.run(["chattr", "-i", str(path)], check=True, timeout=600)


@pytest.mark.parametrize("which", ["file", "folder", "both"])
def test_caches_that_may_not_be_written(tmp_path, counts, frozen, which):
    place = tmp_path / "place"
    place.mkdir()
    cache = place / "cache.sqlite3"
    reference = disting(*ASK, cache=cache).stdout
    before = cache.read_bytes()
    for path in {"file": [cache], "folder": [place], "both": [cache, place]}[which]:
        frozen(path)
    done = disting(*ASK, cache=cache)
    counts["tried"] += 1
    assert (done.returncode, done.stdout) == (0, reference) and "Traceback" not in done.stderr
    assert (
        cache.read_bytes() == before
        and sorted(p.name for p in place.iterdir() if "damaged" in p.name) == []
    )


@pytest.mark.parametrize("content", [b"", b"12345\n", b"\xff" * 9000])
def test_locks_left_behind(tmp_path, counts, content):
    cache = tmp_path / "cache.sqlite3"
    for name in (".lock", "-journal", "-shm"):
        cache.with_name(cache.name + name).write_bytes(content)
    done = disting(*ASK, cache=cache)
    counts["tried"] += 1
    assert (done.returncode, done.stdout) == (
        0,
        disting(*ASK).stdout,
    ) and "Traceback" not in done.stderr


@pytest.fixture
def small(tmp_path):
    """A function that mounts a disk of so many kilobytes."""
    mounted = []

    def mount(size):
        folder = tmp_path / f"disk{size}"
        folder.mkdir()
        how = ["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", str(folder)]
        if subprocess.run(how, capture_output=True, check=False, timeout=600).returncode:
            pytest.skip("only root can mount")
        mounted.append(folder)
        return folder

    yield mount
    for folder in mounted:
        subprocess.run(["umount", str(folder)], check=True, timeout=600)


@pytest.mark.parametrize("size", [4, 16, 64, 256])
def test_full_disks(tmp_path, counts, small, size):
    """A cache, a table, a catalogue and pages on a disk too small for them."""
    disk = small(size)
    reference = disting(*ASK).stdout
    commands = (
        ASK,
        ("verdicts", "3", "--json", disk / "v.json"),
        ("catalog", "build", "2", "--out", disk / "catalog"),
        ("report", "2", "--out", disk / "pages"),
        ("fit", "--demo", "--masses", "1", "--json", disk / "f.json"),
    )
    for command in commands:
        done = disting(*command, cache=disk / "cache.sqlite3")
        counts["tried"] += 1
        counts["refused rightly" if done.returncode else "accepted rightly"] += 1
        assert done.returncode in (0, 2) and "Traceback" not in done.stderr, done.stderr
        if done.returncode:
            assert str(disk) in done.stderr, done.stderr
        if command == ASK:
            assert done.stdout == reference
        assert not list(disk.rglob("*.partial"))
