"""Where tasks run: in this process, in worker processes, or on a dask.distributed cluster; all
by concurrent.futures.
"""

import os
import threading
from collections.abc import Iterator
from concurrent.futures import Executor, InvalidStateError, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context, parent_process
from signal import SIG_DFL, SIGINT, signal

from disting.errors import InputError


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


@contextmanager
def _processes(jobs: int) -> Iterator[Executor]:
    """Spawned workers: they share nothing with this process, so no lock or connection can be
    inherited half-way.

    Ctrl-C ends them at once and without a word; this process tells of it. However this process
    ends, they end with it.
    """
    with (
        _quiet_about_cancelled_work(),
        ProcessPoolExecutor(jobs, get_context("spawn"), _prepare_worker) as pool,
    ):
        try:
            yield pool
        except KeyboardInterrupt:
            for worker in active_children():
                worker.terminate()
            raise


def _prepare_worker() -> None:
    signal(SIGINT, SIG_DFL)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """A killed parent cannot tell its workers to stop; they would wait for tasks for ever. Its
    end is seen on a pipe.
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
