"""A task in a process of its own that can be killed: for computations that may take any time or
memory.

Giving up is an ordinary outcome with its reason; it never becomes an answer. The process is an
interpreter with a command line of its own, that reads its task from its input: a fork would share
locks, and multiprocessing's spawn runs the caller's script again.
"""

import contextlib
import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Generic, TypeVar

COMMAND = "from disting.algebra.groebner.own_process import serve; serve()"


class End(StrEnum):
    """Outcome of a task."""

    DONE = "done"
    OUT_OF_TIME = "out of time"
    OUT_OF_MEMORY = "out of memory"
    DIED = "died"
    FAILED = "failed"


Value = TypeVar("Value")


@dataclass(frozen=True, slots=True)
class ProcessResult(Generic[Value]):
    """`value` is the task's result where `end` is DONE, and None otherwise; `detail` gives details,
    if any.
    """

    end: End
    value: Value | None = None
    detail: str = ""

    @property
    def reason(self) -> str:
        """Why there is no value."""
        return (
            "" if self.end is End.DONE else f"{self.end.value}{self.detail and f' ({self.detail})'}"
        )


def run_limited(
    task: Callable[..., Value],
    arguments: tuple[object, ...],
    seconds: float,
    megabytes: int = 4096,
) -> ProcessResult[Value]:
    """Result of task(*arguments) in a fresh process, killed after so many seconds; both must be
    picklable.

    The task is a function of a module that can be imported, not of the caller's script.
    `megabytes` bounds the address space, Python and its libraries (about 300) included, where the
    system can bound it (not on Windows). A library that aborts on a failed allocation makes the
    process DIE; so does a kill from outside.
    """
    question = b"".join(map(pickle.dumps, ((seconds, megabytes), (task, arguments))))
    command = [sys.executable, "-P", "-c", COMMAND]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    try:
        done = subprocess.run(
            command,
            input=question,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=seconds,
            env=environment,
        )
    except subprocess.TimeoutExpired:
        return ProcessResult(End.OUT_OF_TIME, detail=f"{seconds:g} s")
    except OSError as reason:
        return ProcessResult(End.FAILED, detail=f"no process can be started: {reason.strerror}")
    if done.returncode or not done.stdout:
        return ProcessResult(End.DIED, detail=f"exit status {done.returncode}")
    ended: ProcessResult[Value] = pickle.loads(done.stdout)
    return ended


def serve() -> None:
    """Run in the fresh process: read a task from the input, write its outcome to the output."""
    with os.fdopen(os.dup(sys.stdout.fileno()), "wb") as answer:
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # what a task prints is no answer
        seconds, megabytes = pickle.load(sys.stdin.buffer)
        _limit(seconds, megabytes)
        answer.write(pickle.dumps(_run_within(megabytes)))


def _run_within(megabytes: int) -> ProcessResult[object]:
    try:
        task, arguments = pickle.load(sys.stdin.buffer)
        return ProcessResult(End.DONE, task(*arguments))
    except MemoryError:
        return ProcessResult(End.OUT_OF_MEMORY, detail=f"{megabytes} MB")
    except Exception as error:  # reported to the caller, who cannot see it otherwise
        return ProcessResult(End.FAILED, detail=f"{type(error).__name__}: {error}")


def _limit(seconds: float, megabytes: int) -> None:
    """Limits that hold even if the caller is gone; Windows has none, there the caller's clock
    alone ends the task.
    """
    with contextlib.suppress(ImportError):
        import resource

        time = int(seconds) + 2
        for what, most in (
            (resource.RLIMIT_AS, megabytes << 20),
            (resource.RLIMIT_CPU, time),
            (resource.RLIMIT_CORE, 0),
        ):
            resource.setrlimit(what, (most, most))
