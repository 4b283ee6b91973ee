"""Worker processes of the app: each answers one call at a time and can be ended at any time.

A pool cannot end one of its tasks, and a page needs that: a call that takes too long, a fit that
somebody stops. So a worker is one process behind a pipe. It shares nothing with the server, works
in the project folder, has a limit of memory, and ends with the server however that ends. A job
starts its own pool of processes below it, which ends with it.

Imports take seconds. On Linux they are done once, in a server of forks: a worker that takes the
place of one that was ended is ready at once.
"""

import os
import signal
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path
from time import monotonic, sleep
from traceback import format_exc
from typing import Any

from disting.app.interface import CALLS, Call, Json, Progress
from disting.errors import DistingError, brief
from disting.store.scheduling import deaf_to_interrupts, end_with_parent

MEMORY = 4 * 2**30  # bytes of address space of one process
START = (
    300.0  # seconds in which a worker starts and loads what a call needs, however busy the machine
)
GRACE = 2.0  # seconds in which a process may end by itself
ATTEMPTS = 5  # to start a process
TROUBLES = "app-errors.txt"  # in the project folder, what a defect of the program left
IDLE = 0.3  # seconds without a call after which a worker prepares for the next one
PRELOADED = "disting.app.preloaded"
CAN_FORK = sys.platform == "linux"  # elsewhere a fork of numerical libraries is not safe
EXAMPLE = {"text": "1=2=3; F1; S1"}  # which reads the catalogues of machines


class Failure(Exception):
    """A call that was not answered: status of HTTP and a sentence."""

    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        self.status = status
        self.message = message


@dataclass(frozen=True, slots=True)
class Setting:
    """Where workers work and how many processes a job may start."""

    folder: Path
    jobs: int = 1
    scheduler: str = ""
    loads: bool = True  # ahead what calls need; False: of a worker that only handles files


class Worker:
    """One process; `ask` blocks, and so does the start of the first one, until libraries are
    loaded; `end` may be called from any thread meanwhile.
    """

    def __init__(self, setting: Setting) -> None:
        context: Any = _forking() if CAN_FORK and setting.loads else get_context("spawn")
        self._pipe, there = context.Pipe()
        self._process = context.Process(target=_serve, args=(there, setting), name="disting app")
        self._is_killed = False
        _start(self._process)
        there.close()

    def ask(self, call: Call, request: Json, progress: Progress) -> Json:
        """Answer of a call. Raises Failure; the worker is ended where it was too slow."""
        until = monotonic() + START
        try:
            self._pipe.send((call.name, request))
            while self._pipe.poll(max(0.0, until - monotonic())):
                kind, *content = self._pipe.recv()
                if kind == "begun":
                    until = monotonic() + call.seconds
                elif kind == "progress":
                    progress(*content)
                elif kind == "answer":
                    answer: Json = content[0]
                    return answer
                else:
                    raise Failure(*content)
        except (EOFError, OSError):
            self.end()
            raise Failure(500, "the computation ended unexpectedly; ask for it again") from None
        self.end()
        raise Failure(504, f"not finished in {call.seconds:g} s, so it was stopped; ask for less")

    @property
    def is_alive(self) -> bool:
        """Return True while the process can be asked; one that was killed cannot, though it may
        live for a moment.
        """
        return not self._is_killed and bool(self._process.is_alive())

    @property
    def pid(self) -> int:
        """Number of the process."""
        return self._process.pid or 0

    def kill(self) -> None:
        """End the process at once; who waits for its answer hears of it."""
        self._is_killed = True
        self._process.kill()

    def end(self) -> None:
        """End the process, at the latest after a grace time by force."""
        self._process.terminate()
        self._process.join(GRACE)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()


def _start(process: Any) -> None:
    """Start a process of a context. A server of forks that was ended while it was asked gives no
    process; the next attempt starts another server.
    """
    for left in reversed(range(ATTEMPTS)):
        try:
            with deaf_to_interrupts():  # the server hears Ctrl-C and ends its workers
                process.start()
            return
        except (EOFError, ConnectionError):
            if not left:
                raise
            sleep(GRACE / ATTEMPTS)


def _forking() -> Any:  # ForkServerContext, which Windows does not have
    context = get_context("forkserver")
    context.set_forkserver_preload([PRELOADED])
    return context


def _serve(pipe: Connection, setting: Setting) -> None:
    """Answer calls until the server is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the server hears Ctrl-C and ends its workers
    threading.Thread(target=end_with_parent, daemon=True).start()
    _limit_memory()
    os.chdir(setting.folder)
    to_load = _list_loads() if setting.loads else []
    while True:
        try:
            while to_load and not pipe.poll(IDLE):
                to_load.pop(0)()
            name, request = pipe.recv()
        except (EOFError, OSError):
            return
        pipe.send(_answer(CALLS[name], request, lambda *word: pipe.send(word), setting))


def _answer(
    call: Call, request: Json, send: Callable[..., None], setting: Setting
) -> tuple[Any, ...]:
    """The message that answers a call; `send` takes what comes before it."""
    try:
        function = call.load()
        send("begun")
        more = (partial(send, "progress"), setting) if call.is_job else ()
        answer = function(request, *more)
    except DistingError as reason:
        return ("failure", 422, str(reason))
    except MemoryError:
        return ("failure", 507, "there is not enough memory for this; ask for less")
    except OSError as reason:
        where = f": {Path(str(reason.filename)).name}" if reason.filename else ""
        return ("failure", 507, brief(f"{reason.strerror or reason}{where}"))
    except Exception as reason:
        _keep(format_exc())
        sentence = f"the program made a mistake ({type(reason).__name__}); {TROUBLES} says more"
        return ("failure", 500, sentence)
    return ("answer", answer)


def _list_loads() -> list[Callable[[], object]]:
    """Work of a worker while it has nothing else to do, in small parts: imports, unless it has
    them, and what the first call of a page reads.
    """
    return [
        *(call.load for call in CALLS.values()),
        *(partial(_try, CALLS[name]) for name in ("machine", "determine", "alike")),
    ]


def _try(call: Call) -> None:
    """Answer an example; trouble is told when somebody calls."""
    with suppress(DistingError, OSError):
        call.load()(EXAMPLE)


def _keep(text: str) -> None:
    """Add a trace to the file of troubles, for a report of the defect."""
    try:
        with Path(TROUBLES).open("a", encoding="utf-8") as file:
            file.write(f"{text}\n")
    except OSError:
        sys.stderr.write(text)


def _limit_memory() -> None:
    """Limit the address space of this process and of those that it starts, where the system can."""
    try:
        import resource
    except ImportError:  # Windows
        return
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    limit = MEMORY if hard == resource.RLIM_INFINITY else min(MEMORY, hard)
    try:
        resource.setrlimit(resource.RLIMIT_AS, (limit, hard))
    except (ValueError, OSError):  # macOS knows the limit but does not set it
        return
