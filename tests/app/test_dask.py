"""A fit of the page on a cluster, and on one that is not there."""

import pytest

from tests.app.served import bench_csv, serving

pytestmark = pytest.mark.full
REQUEST = {
    "measurements": [{"file": "bench.csv", "reading": {"quantity": "velocity"}}],
    "masses": [1],
}


@pytest.mark.slow
def test_a_fit_runs_on_the_cluster_and_says_the_same(tmp_path) -> None:
    pytest.importorskip("starlette", reason="the extra app is not installed")
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        with serving(tmp_path / "far", "--scheduler", cluster.scheduler_address) as served:
            assert served.upload("bench.csv", bench_csv())[0] == 200
            far = served.run("fit", REQUEST)
        done = client.run_on_scheduler(lambda dask_scheduler: dask_scheduler.transition_counter)
    assert far["state"] == "done", far["message"]
    assert done > 0  # tasks went through the scheduler
    with serving(tmp_path / "near", "--jobs", "1") as served:
        served.upload("bench.csv", bench_csv())
        near = served.run("fit", REQUEST)
    assert far["answer"]["answer"] == near["answer"]["answer"]


def test_no_cluster_is_said_and_the_page_goes_on(tmp_path) -> None:
    pytest.importorskip("starlette", reason="the extra app is not installed")
    pytest.importorskip("distributed")
    with serving(tmp_path / "none", "--scheduler", "tcp://127.0.0.1:9") as served:
        served.upload("bench.csv", bench_csv())
        end = served.run("fit", REQUEST)
        assert end["state"] == "failed"
        assert "no dask scheduler answers at tcp://127.0.0.1:9" in end["message"]
        assert served.call("machine", {"text": "1=2; F1; S1"})[0] == 200
