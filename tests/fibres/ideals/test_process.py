"""Tasks in killable processes: real kills, real limits."""

import os
import signal
import time

import pytest

from disting.algebra.groebner.own_process import End, run_limited


def double(x):
    return 2 * x


def fail():
    raise ValueError("no such thing")


def die():
    os.kill(os.getpid(), signal.SIGKILL)


def fill():
    return len(bytearray(3 << 30))


def sleep():
    time.sleep(60)


def test_a_result():
    ended = run_limited(double, (21,), 600)
    assert (ended.end, ended.value, ended.reason) == (End.DONE, 42, "")


@pytest.mark.full
@pytest.mark.parametrize(
    ("task", "seconds", "end", "detail"),
    [
        (sleep, 0.5, End.OUT_OF_TIME, "0.5 s"),
        (die, 600, End.DIED, "exit status -9"),
        (fill, 600, End.OUT_OF_MEMORY, "1024 MB"),
        (fail, 600, End.FAILED, "ValueError: no such thing"),
    ],
)
def test_every_other_end_has_a_reason(task, seconds, end, detail):
    ended = run_limited(task, (), seconds, megabytes=1024)
    assert (ended.end, ended.value) == (end, None)
    assert ended.reason == f"{end.value} ({detail})"
