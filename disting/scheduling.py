"""Where tasks run: in this process, in worker processes, or on a dask.distributed cluster; all by concurrent.futures."""

import multiprocessing
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager

from disting.errors import InputError


@contextmanager
def executor(jobs: int, scheduler: str = "") -> Iterator[Executor | None]:
    """An executor for `jobs` processes or for the cluster at `scheduler`; None where this process does the work."""
    if scheduler:
        yield from _cluster(scheduler)
    elif jobs > 1:
        # Spawned workers share nothing with this process, so no lock or connection can be inherited half-way.
        with ProcessPoolExecutor(jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
            yield pool
    else:
        yield None


def _cluster(address: str) -> Iterator[Executor]:
    try:
        from distributed import Client
    except ImportError:
        raise InputError("--scheduler needs dask.distributed: pip install 'disting[dask]'") from None
    try:
        client = Client(address, timeout="5s")
    except (OSError, ValueError) as reason:
        raise InputError(f"no dask scheduler answers at {address} ({reason})") from None
    with client, client.get_executor() as pool:
        yield pool
