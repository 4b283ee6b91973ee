"""Where tasks run: in this process, in worker processes, or on a dask.distributed cluster; all
by concurrent.futures.
"""

import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import (
    Executor,
    Future,
    InvalidStateError,
    ProcessPoolExecutor,
    as_completed,
)
from contextlib import contextmanager
from multiprocessing import active_children, get_context, parent_process
from typing import Any, TypeVar

from disting.errors import InputError

T = TypeVar("T")
HAS_MASKS = hasattr(signal, "pthread_sigmask")  # not on Windows


@contextmanager
def executor(jobs: int, scheduler: str = "") -> Iterator[Executor | None]:
    """An executor for `jobs` processes or for the cluster at `scheduler`; None where this
    process does the work.
    """
    if scheduler:
        yield from _cluster(scheduler)
    elif jobs > 1:
        with _processes(jobs) as pool:
            yield pool
    else:
        yield None


def map_tasks(
    function: Callable[..., T], tasks: Sequence[tuple[Any, ...]], executor: Executor | None
) -> Iterator[tuple[tuple[Any, ...], T]]:
    """Tasks with their results as they come, in any order, from the executor's workers or from
    this process.
    """
    if executor is None:
        yield from ((task, function(*task)) for task in tasks)
        return
    futures: dict[Future[T], tuple[Any, ...]] = {
        executor.submit(function, *task): task for task in tasks
    }
    try:
        yield from ((futures[future], future.result()) for future in as_completed(futures))
    finally:
        for future in futures:
            future.cancel()


@contextmanager
def _processes(jobs: int) -> Iterator[Executor]:
    """Spawned workers: they share nothing with this process, so no lock or connection can be
    inherited half-way.

    Ctrl-C ends them at once and silently; this process reports it. However this process ends, they
    end with it.
    """
    with (
        _quiet_about_cancelled_work(),
        _Pool(jobs, get_context("spawn"), _prepare_worker) as pool,
    ):
        try:
            yield pool
        except KeyboardInterrupt:
            for worker in active_children():
                worker.terminate()
            raise


class _Pool(ProcessPoolExecutor):
    """Starts workers that do not hear Ctrl-C before they are prepared for it: one that is still
    importing would report it with a traceback.
    """

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """As usual; a worker that this starts inherits what is held back. Nothing is lost: this
        process hears of it right after.
        """
        with deaf_to_interrupts():
            return super().submit(fn, *args, **kwargs)


@contextmanager
def deaf_to_interrupts() -> Iterator[None]:
    """Hold Ctrl-C back from this thread; a process that it starts meanwhile inherits that."""
    if not HAS_MASKS:
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _prepare_worker() -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    if HAS_MASKS:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    threading.Thread(target=end_with_parent, daemon=True).start()


def end_with_parent() -> None:
    """A killed parent cannot tell its workers to stop; they would wait for tasks for ever. Its end
    is detected on a pipe.
    """
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


@contextmanager
def _quiet_about_cancelled_work() -> Iterator[None]:
    """Until Python 3.12 a pool whose workers are gone complains in its thread of work that was
    cancelled before.
    """
    usual = threading.excepthook

    def hook(failed: threading.ExceptHookArgs) -> None:
        """Tells of anything else."""
        if failed.exc_type is not InvalidStateError:
            usual(failed)

    threading.excepthook = hook
    try:
        yield
    finally:
        threading.excepthook = usual


def _cluster(address: str) -> Iterator[Executor]:
    try:
        from distributed import Client
    except ImportError:
        raise InputError(
            "--scheduler needs dask.distributed: pip install 'disting[dask]'"
        ) from None
    try:
        client = Client(address, timeout="5s")
    except (OSError, ValueError) as reason:
        raise InputError(f"no dask scheduler answers at {address} ({reason})") from None
    with client, client.get_executor() as pool:
        yield pool
