"""Workers of quick calls: who is gone needs no answer."""

import asyncio
import os
import signal
from functools import partial
from multiprocessing.forkserver import _forkserver
from pathlib import Path

import pytest

from disting.app.interface import CALLS
from disting.app.jobs import Jobs, Pool
from disting.app.workers import CAN_FORK, Failure, Setting
from tests.app.loops import run

pytestmark = pytest.mark.full
STAR = {"text": "1=2, 2=3, 2=4, 2=5; F1; S1"}  # takes a minute


async def leave_and_ask(folder: Path) -> tuple[int, dict]:
    """Status of a call whose client goes when its answer has begun, and the answer of the next call
    by the only worker.
    """
    pool = Pool(Setting(folder), 1)
    try:
        pool.start()
        await pool.answer(CALLS["machine"], STAR)
        gone = asyncio.Event()
        asking = asyncio.ensure_future(pool.answer(CALLS["determine"], STAR, gone.wait))
        await asyncio.sleep(0.1)
        gone.set()
        with pytest.raises(Failure) as left:
            await asking
        return left.value.status, await pool.answer(CALLS["machine"], STAR)
    finally:
        await pool.end()


def test_a_call_whose_client_is_gone_is_ended_and_the_next_one_answered(tmp_path: Path) -> None:
    status, answer = run(leave_and_ask(tmp_path))
    assert status == 500  # ended; one that was too slow has 504
    assert answer["count"].startswith("13 parameters")


async def leave_before(folder: Path) -> int:
    """Status of a call whose client has gone while it waited for a worker."""
    pool = Pool(Setting(folder, loads=False), 1)
    pool.start()
    try:
        with pytest.raises(Failure) as left:
            await pool.answer(CALLS["open"], {"page": "data"}, partial(asyncio.sleep, 0))
        return left.value.status
    finally:
        await pool.end()


def test_a_call_whose_client_goes_before_a_worker_is_free_is_not_begun(tmp_path: Path) -> None:
    assert run(leave_before(tmp_path)) == 499


async def ask_after_a_kill(folder: Path) -> dict:
    """Answer of a call when the only worker died while it had nothing to do."""
    pool = Pool(Setting(folder, loads=False), 1)
    pool.start()
    try:
        await pool.answer(CALLS["open"], {"page": "data"})
        (worker,) = pool._every
        worker.kill()
        assert not worker.is_alive  # at once, though the process may live for a moment
        return await pool.answer(CALLS["open"], {"page": "data"})
    finally:
        await pool.end()


def test_a_worker_that_died_meanwhile_is_not_asked(tmp_path: Path) -> None:
    assert run(ask_after_a_kill(tmp_path)) == {"content": None}


async def ask_after_the_forks_ended(folder: Path) -> dict:
    """Answer of a call when the server of forks was ended while it started the workers."""
    pool = Pool(Setting(folder), 2)
    pool.start()
    try:
        while _forkserver._forkserver_pid is None:
            await asyncio.sleep(0.01)
        os.kill(_forkserver._forkserver_pid, signal.SIGKILL)
        return await asyncio.wait_for(pool.answer(CALLS["open"], {"page": "data"}), 300)
    finally:
        await pool.end()


@pytest.mark.skipif(not CAN_FORK, reason="no server of forks here")
def test_workers_start_though_the_server_of_forks_is_ended_meanwhile(tmp_path: Path) -> None:
    assert run(ask_after_the_forks_ended(tmp_path)) == {"content": None}


async def stop_while_it_starts(folder: Path) -> str:
    """State of a job that was stopped before its worker was there."""
    jobs = Jobs(Setting(folder, loads=False))
    job = jobs.begin(CALLS["next"], {"fit": 1})
    await asyncio.sleep(0)  # a thread starts its worker
    jobs.stop(job)
    await asyncio.gather(*jobs._tasks)
    return job.state


def test_a_job_that_is_stopped_while_its_worker_starts_does_not_run(tmp_path: Path) -> None:
    assert run(stop_while_it_starts(tmp_path)) == "stopped"
