"""A task in a process of its own that can be killed: for computations that may take any time or memory.

Giving up is an ordinary outcome with its reason; it never becomes an answer.
"""

import resource
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any


class End(StrEnum):
    """How a task ended."""

    DONE = "done"
    OUT_OF_TIME = "out of time"
    OUT_OF_MEMORY = "out of memory"
    DIED = "died"
    FAILED = "failed"


@dataclass(frozen=True, slots=True)
class Ended:
    """`value` is the task's result where `end` is DONE, and nothing otherwise; `detail` says more, if there is more."""

    end: End
    value: Any = None
    detail: str = ""

    @property
    def reason(self) -> str:
        """Why there is no value."""
        return "" if self.end is End.DONE else f"{self.end.value}{self.detail and f' ({self.detail})'}"


def run_limited(task: Callable[..., Any], arguments: tuple[Any, ...], seconds: float, megabytes: int = 4096) -> Ended:
    """Result of task(*arguments) in a fresh process, killed after so many seconds; both must be picklable.

    `megabytes` bounds the address space, Python and its libraries (about 300) included. A library that aborts on a failed
    allocation makes the process DIE; so does a kill from outside.
    """
    context = get_context("spawn")
    here, there = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(there, task, arguments, megabytes), daemon=True)
    process.start()
    there.close()
    try:
        return here.recv() if here.poll(seconds) else Ended(End.OUT_OF_TIME, detail=f"{seconds:g} s")
    except EOFError:
        process.join()
        return Ended(End.DIED, detail=f"exit status {process.exitcode}")
    finally:
        _end(process)
        here.close()


def _end(process: BaseProcess) -> None:
    if process.is_alive():
        process.kill()
    process.join()


def _work(answer: Connection, task: Callable[..., Any], arguments: tuple[Any, ...], megabytes: int) -> None:
    limit = megabytes << 20
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        ended = Ended(End.DONE, task(*arguments))
    except MemoryError:
        ended = Ended(End.OUT_OF_MEMORY, detail=f"{megabytes} MB")
    except Exception as error:  # reported to the caller, who cannot see it otherwise
        ended = Ended(End.FAILED, detail=f"{type(error).__name__}: {error}")
    answer.send(ended)
