"""A real server of the app in a process of its own, and a client of the standard library."""

import http.client
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import quote

STARTS = 300.0  # seconds that a client waits for an answer at most


class Served:
    """Address and keys of a server; `ask` sends one request on a connection of its own."""

    def __init__(self, process: subprocess.Popen, folder: Path, first_address: str) -> None:
        self.process = process
        self.folder = folder
        self.first_address = first_address
        self.base = first_address.partition("/?")[0]
        self.netloc = self.base.removeprefix("http://")
        self.cookie = ""
        status, headers, _ = self.ask("GET", first_address.removeprefix(self.base), cookie="")
        assert status == 303
        self.cookie = headers["set-cookie"].partition(";")[0]

    def ask(
        self,
        method: str,
        path: str,
        body: bytes | str | None = None,
        *,
        cookie: str | None = None,
        **headers: str,
    ) -> tuple[int, dict[str, str], bytes]:
        own = {
            "Origin": self.base,
            "Content-Type": "application/json",
            "Cookie": self.cookie if cookie is None else cookie,
        }
        own |= {name.replace("_", "-").title(): value for name, value in headers.items()}
        connection = http.client.HTTPConnection(self.netloc, timeout=STARTS)
        try:
            connection.request(
                method, path, body, {name: value for name, value in own.items() if value}
            )
            answer = connection.getresponse()
            return (
                answer.status,
                {name.lower(): value for name, value in answer.getheaders()},
                answer.read(),
            )
        finally:
            connection.close()

    def call(self, name: str, request: object) -> tuple[int, dict]:
        status, _, body = self.ask("POST", f"/api/{name}", json.dumps(request))
        return status, json.loads(body)

    def upload(self, name: str, content: bytes) -> tuple[int, dict]:
        status, _, body = self.ask("POST", f"/api/upload?name={quote(name)}", content)
        return status, json.loads(body)

    def events(self, number: int) -> Iterator[tuple[str, dict]]:
        """Events of a job until it is over."""
        connection = http.client.HTTPConnection(self.netloc, timeout=600)
        connection.request("GET", f"/api/jobs/{number}", headers={"Cookie": self.cookie})
        answer, name = connection.getresponse(), ""
        for line in map(bytes.decode, answer):
            if line.startswith("event: "):
                name = line[7:].strip()
            elif line.startswith("data: "):
                yield name, json.loads(line[6:])
        connection.close()

    def run(self, name: str, request: object) -> dict:
        """The last event of a job."""
        status, begun = self.call(name, request)
        assert status == 202, begun
        return [content for _, content in self.events(begun["job"])][-1]


@contextmanager
def serving(
    folder: Path, *words: str, before: Callable[[], None] | None = None
) -> Iterator[Served]:
    """A server of a folder until the block ends; `before` runs first in its process. Its fits start
    no processes, which import for seconds each, unless `words` say otherwise.
    """
    jobs = () if "--jobs" in words else ("--jobs", "1")
    process = subprocess.Popen(
        [sys.executable, "-m", "disting", "app", str(folder), "--no-browser", *jobs, *words],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=folder.parent,
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])},
        start_new_session=True, preexec_fn=before,
    )  # fmt: skip
    assert process.stdout is not None
    try:
        lines = [process.stdout.readline() for _ in range(3)]
        found = re.search(r"open (http\S+)", "".join(lines))
        assert found, lines
        yield Served(process, folder, found[1])
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(60)
        process.stdout.close()


def bench_csv(lines: int = 80) -> bytes:
    """A measured speed response of a drive of two masses, without a word on what it shows."""
    import numpy as np

    m1, m2, k, d, b, Td = 0.002, 0.005, 300.0, 0.06, 0.01, 3e-4
    f = np.geomspace(5, 300, lines)
    s = 2j * np.pi * f
    left, right, link = m1 * s + b, m2 * s, d + k / s
    G = (right + link) / ((left + link) * (right + link) - link**2) * np.exp(-s * Td)
    noise = np.random.default_rng(1).normal(size=(lines, 2)) @ [1, 1j]
    G = G * (1 + 0.01 * noise / np.sqrt(2))
    rows = [f"{x:.6g},{g.real:.6g},{g.imag:.6g}" for x, g in zip(f, G, strict=True)]
    return "\n".join(["f [Hz],Re,Im", *rows, ""]).encode()


def spectrum_csv(lines: int = 50) -> bytes:
    """Impedance of R0-p(R1,C1) with noise of 0.3 %, as instruments of chemists write it."""
    import numpy as np

    f = np.geomspace(0.1, 1e4, lines)
    Z = 10 + 100 / (1 + 2j * np.pi * f * 100 * 1e-4)
    Z = Z * (1 + 0.003 * np.random.default_rng(2).normal(size=(lines, 2)) @ [1, 1j])
    rows = [f"{x:.6g},{z.real:.6g},{-z.imag:.6g}" for x, z in zip(f, Z, strict=True)]
    return "\n".join(["freq/Hz,Re(Z)/Ohm,-Im(Z)/Ohm", *rows, ""]).encode()
