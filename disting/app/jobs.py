"""Quick calls and jobs of the server: who waits for which worker.

Quick calls share a few workers, which are warm. A job has a worker of its own; one runs at a time,
since it uses all processors, others wait in order. Both are bounded in number, time and memory.
"""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field, replace

from disting.app.interface import Call, Json
from disting.app.workers import Failure, Setting, Worker
from disting.files import json_text

Gone = Callable[[], Awaitable[None]]  # returns when a client is gone
WAITING = 64  # quick calls that may wait
QUEUED = 16  # jobs that may wait or run
KEPT = 50  # finished jobs whose answers are remembered
LEFT = Failure(499, "the client is gone")
BUSY = Failure(503, "the app has more to do than it can keep in mind; try again")


class Pool:
    """Workers of quick calls."""

    def __init__(self, setting: Setting, size: int) -> None:
        self._setting = setting
        self._size = size
        # the one that answered last has read the most
        self._idle: asyncio.LifoQueue[Worker] = asyncio.LifoQueue()
        self._every: set[Worker] = set()
        self._starting: set[asyncio.Future[None]] = set()
        self._waiting = 0

    def start(self) -> None:
        """Begin to start the workers."""
        for _ in range(self._size):
            self._begin_one()

    async def answer(self, call: Call, request: Json, gone: Gone | None = None) -> Json:
        """Answer of a quick call; one that is not ready when the client is `gone` is given up.
        Raises Failure.
        """
        if self._waiting >= WAITING:
            raise BUSY
        leaving = asyncio.ensure_future((gone or _never)())
        self._waiting += 1
        try:
            worker = await self._idle.get()
            while not worker.is_alive:  # the system ended it meanwhile
                self._replace(worker)
                worker = await self._idle.get()
        finally:
            self._waiting -= 1
        if leaving.done():
            self._idle.put_nowait(worker)
            raise LEFT
        # a client that goes away must not leave a worker with half an answer in its pipe
        answering = asyncio.ensure_future(self._by(worker, call, request))
        await asyncio.shield(asyncio.wait({answering, leaving}, return_when="FIRST_COMPLETED"))
        if answering.done():
            leaving.cancel()
        else:
            worker.kill()
        return await answering

    async def _by(self, worker: Worker, call: Call, request: Json) -> Json:
        try:
            return await asyncio.to_thread(worker.ask, call, request, _silent)
        finally:
            if worker.is_alive:
                self._idle.put_nowait(worker)
            else:
                self._replace(worker)

    def _replace(self, worker: Worker) -> None:
        self._every.discard(worker)
        self._begin_one()

    def _begin_one(self) -> None:
        task = asyncio.ensure_future(self._add())
        self._starting.add(task)
        task.add_done_callback(self._starting.discard)

    async def _add(self) -> None:
        worker = await asyncio.to_thread(Worker, self._setting)
        self._every.add(worker)
        self._idle.put_nowait(worker)

    async def end(self) -> None:
        """End all workers, those that are starting too."""
        await asyncio.gather(*self._starting, return_exceptions=True)
        await asyncio.gather(*(asyncio.to_thread(worker.end) for worker in self._every))


@dataclass(eq=False, slots=True)
class Job:
    """A job as the page sees it; `state`: waiting, running, done, stopped or failed."""

    number: int
    call: Call
    request: Json
    state: str = "waiting"
    progress: tuple[str, int, int] = ("", 0, 0)
    answer: Json | None = None
    message: str = ""
    worker: Worker | None = None
    changed: asyncio.Event = field(default_factory=asyncio.Event)

    @property
    def is_over(self) -> bool:
        """Return True if it is done, stopped or failed."""
        return self.state not in ("waiting", "running")

    def to_dict(self) -> Json:
        """Return its state as plain data."""
        what, done, total = self.progress
        return {
            "job": self.number,
            "name": self.call.name,
            "request": self.request,
            "state": self.state,
            "what": what,
            "done": done,
            "total": total,
            "message": self.message,
        }

    def tell(self, state: str) -> None:
        """Change the state and wake those who watch."""
        self.state = state
        woken, self.changed = self.changed, asyncio.Event()
        woken.set()

    def advance(self, what: str, done: int, total: int) -> None:
        """Change the progress of a job that runs."""
        if not self.is_over:
            self.progress = what, done, total
            self.tell(self.state)


class Jobs:
    """Jobs of a server, by number."""

    def __init__(self, setting: Setting) -> None:
        self._setting = setting
        self._one = asyncio.Semaphore(1)
        self._tasks: set[asyncio.Task[None]] = set()
        self.every: dict[int, Job] = {}

    def begin(self, call: Call, request: Json) -> Job:
        """Begin a job, or let it wait for the one before it. Raises Failure."""
        if sum(not job.is_over for job in self.every.values()) >= QUEUED:
            raise BUSY
        job = Job(max(self.every, default=0) + 1, call, request)
        self.every[job.number] = job
        task = asyncio.create_task(self._run(job))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        self._forget()
        return job

    def stop(self, job: Job) -> None:
        """Stop a job; one that is over stays as it is."""
        if job.is_over:
            return
        job.tell("stopped")
        if job.worker is not None:
            job.worker.kill()

    def end(self) -> None:
        """Stop all jobs."""
        for job in self.every.values():
            self.stop(job)

    async def _run(self, job: Job) -> None:
        async with self._one:
            if job.is_over:
                return
            loop = asyncio.get_running_loop()

            def hear(what: str, done: int, total: int) -> None:
                """From the thread that reads the worker's pipe."""
                loop.call_soon_threadsafe(job.advance, what, done, total)

            worker = await asyncio.to_thread(Worker, self._setting)
            if job.is_over:  # stopped meanwhile
                await asyncio.to_thread(worker.end)
                return
            job.worker = worker
            job.tell("running")
            try:
                job.answer = await asyncio.to_thread(worker.ask, job.call, job.request, hear)
                state, message = "done", ""
            except Failure as reason:
                state, message = "failed", reason.message
            finally:
                job.worker = None
                await asyncio.to_thread(worker.end)
            if not job.is_over:
                job.message = message
                job.tell(state)

    def _forget(self) -> None:
        over = [number for number, job in self.every.items() if job.is_over]
        for number in over[:-KEPT]:
            del self.every[number]


async def watch(job: Job) -> AsyncIterator[bytes]:
    """Server-sent events of a job: `progress` with every change, at the end `end`."""
    while True:
        changed = job.changed
        if job.is_over:
            yield _event("end", job.to_dict() | {"answer": job.answer})
            return
        yield _event("progress", job.to_dict())
        try:
            await asyncio.wait_for(changed.wait(), 15)
        except TimeoutError:
            yield b": still here\n\n"


def _event(name: str, content: Json) -> bytes:
    return f"event: {name}\ndata: {json_text(content)}\n\n".encode()


async def _never() -> None:
    """A client that stays."""
    await asyncio.Event().wait()


def _silent(*_: object) -> None:
    """Progress that nobody watches."""


@asynccontextmanager
async def working(setting: Setting, size: int) -> AsyncIterator[tuple[Pool, Pool, Jobs]]:
    """Workers while the server runs: one for files alone, which does not wait until the others
    have loaded numerical libraries, those for other quick calls, those for jobs.
    """
    files, pool = Pool(replace(setting, loads=False), 1), Pool(setting, size)
    jobs = Jobs(setting)
    try:
        files.start()
        pool.start()
        yield files, pool, jobs
    finally:
        jobs.end()
        await asyncio.gather(files.end(), pool.end())
