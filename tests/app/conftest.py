"""One server for all tests of a process that only ask it; those that change it start their own."""

from collections.abc import Iterator

import pytest

from tests.app.served import Served, bench_csv, serving


@pytest.fixture(scope="session")
def app(tmp_path_factory) -> Iterator[Served]:
    pytest.importorskip("starlette", reason="the extra app is not installed")
    with serving(tmp_path_factory.mktemp("app") / "project") as served:
        assert served.upload("bench.csv", bench_csv())[0] == 200
        yield served
