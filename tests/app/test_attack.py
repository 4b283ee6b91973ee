"""More than 2,000 hostile requests: every one is answered or refused in one sentence, nothing
outside of the project is read or written, and the server serves on.
"""

import json
import random
import socket
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from disting.app.interface import CALLS
from tests.app.served import Served, bench_csv, serving

pytestmark = pytest.mark.full
SECRET = "the secret of another folder"
REFUSED = {400, 401, 403, 404, 405, 411, 413, 414, 415, 422, 431}
FINE = {200, 202, 503}
TEXTS = [
    "", " ", "\0", "../../etc/passwd", "/etc/passwd", "..\\..\\x", "a" * 5000, "é" * 300, "\ud800", "\u202e", "%00",
    "'; DROP TABLE fits; --", "<script>alert(1)</script>", "${jndi:ldap://x}", "{{7*7}}", "$(id)", "`id`", "|id", "data:,x",
    "file:///etc/passwd", "http://127.0.0.1/", "con", "nul", ".", "..", ".disting-app.lock", "a\nb", "bench.csv\0.png", "outside.csv",
]  # fmt: skip
VALUES = [
    *TEXTS,
    None,
    True,
    False,
    0,
    -1,
    1e308,
    -1e308,
    1e-320,
    10**400,
    2**63,
    [],
    {},
    [[]] * 50,
    {"": ""},
    ["x"] * 5000,
    {"__proto__": 1},
]
REQUESTS = {
    "look": {
        "file": "bench.csv",
        "reading": {
            "quantity": "velocity",
            "band": [5, 50],
            "units": {"output": "deg"},
            "column": 2,
            "hold": 1e-4,
            "scale": 2.0,
        },
    },
    "files": {},
    "fits": {},
    "open": {"page": "data"},
    "save": {"page": "data", "content": {"a": 1}},
    "fit": {
        "measurements": [{"file": "none.csv", "reading": {}}],
        "masses": [1],
        "models": ["R1"],
        "fix": {"m1": 0.1},
        "bound": {"k12": [0, 5]},
        "controller": "P=2",
    },
    "next": {"fit": 1},
    "plan": {"fit": 1},
    "two_fits": {"fits": [1, 2]},
    "fits_verdict": {"fits": [1, 2]},
    "figures": {"fit": 1},
}
BODIES = [
    b"", b"{", b"}", b"[]", b"null", b"1", b'"x"', b"{} {}", b"\xff\xfe", b'{"page": NaN}', b'{"page": Infinity}', b'{"page": "data", "page": "data"}',
    b"[" * 100_000, b'{"a":' * 50_000, b'{"page": 1e999999}', b'{"page": ' + b"9" * 5000 + b"}", b'{"page": "\\ud800"}', b"\0" * 1000,
    b"{" + b" " * 2**20 + b"}", b"a" * (2**20 + 1), b'{"page":"data"}\0', "{\u2028}".encode(),
]  # fmt: skip
PATHS = [
    "/..", "/../", "/%2e%2e/", "/static/..%2fserver.py", "/static/../server.py", "/static/%2e%2e%2fgate.py", "/static/.%2e/gate.py", "/static/server.py",
    "/static/%00", "/static/app.js%00.css", "/static/", "/static", "/site/..%2fpage.html", "/site/fit.html", "/site/../fit.html", "/site/%2fetc%2fpasswd",
    "/project/fits/1/..%2f..%2fdata.json", "/project/fits/1/../../../outside.csv", "/project/fits/-1/fit.html", "/project/fits/1e1/fit.html", "/project/fits/0/fit.html",
    "/project/fits/99999999999999999999999/fit.html", "/project/fits/1/%2e%2e", "/project/data/bench.csv", "/project/data.json", "/project/.disting-app.lock",
    "/project/fits/1/link.csv", "/project/fits/../data/bench.csv", "/api/", "/api/none", "/api/jobs/0", "/api/jobs/-1", "/api/jobs/x", "/api/jobs/99999999999999999999/stop", "/api/open/..",
    "/api/upload", "/api/upload?name=", "/api/upload?name=..%2fx.csv", "/api/upload?name=/etc/x", "/api/upload?name=.x", "/api/upload?name=a%00b", "/api/upload?name=%ff%fe",
    "/api/upload?name=" + "a" * 4000, "//evil.example/", "/?token=", "/?token=x&token=y", "/?" + "a=1&" * 500, "/" + "a" * 8000, "/%ff", "/\u00e9".encode().decode("latin-1"), "/#x", "/;x", "/~",
]  # fmt: skip
METHODS = [
    "GET",
    "HEAD",
    "POST",
    "PUT",
    "DELETE",
    "PATCH",
    "OPTIONS",
    "TRACE",
    "CONNECT",
    "PROPFIND",
    "X" * 30,
]


@pytest.fixture(scope="module")
def attacked(tmp_path_factory) -> Iterator[Served]:
    pytest.importorskip("starlette", reason="the extra app is not installed")
    root = tmp_path_factory.mktemp("attack")
    (root / "outside.csv").write_text(SECRET)
    folder = root / "project"
    (folder / "fits" / "1").mkdir(parents=True)
    (folder / "fits" / "1" / "fit.html").write_text("<script>alert(1)</script>")
    (folder / "fits" / "1" / "link.csv").symlink_to(root / "outside.csv")
    (folder / "data").mkdir()
    (folder / "data" / "outside.csv").symlink_to(root / "outside.csv")
    with serving(folder, "--jobs", "1") as served:
        assert served.upload("bench.csv", bench_csv())[0] == 200
        assert served.call("look", {"file": "bench.csv", "reading": {}})[0] == 200
        before = snapshot(root)
        yield served
        after = snapshot(root)
        assert {name: text for name, text in after.items() if name in before} == before
        assert all(Path(name).is_relative_to("project") for name in after.keys() - before.keys())
        assert served.call("look", {"file": "bench.csv", "reading": {}})[0] == 200


def snapshot(root: Path) -> dict[str, bytes]:
    """Content of all files but those that a page may change."""
    return {
        str(path.relative_to(root)): path.read_bytes()
        for path in sorted(root.rglob("*"))
        if path.is_file()
        and path.name not in ("data.json", "machine.json", "compare.json", ".disting-app.lock")
    }


def check(
    served: Served,
    counts: Counter,
    method: str,
    path: str,
    body: object = None,
    allowed: set[int] = REFUSED | FINE,
    **headers: str,
) -> None:
    status, _, answer = served.ask(method, path, body, **headers)  # type: ignore[arg-type]
    counts[status] += 1
    where = method, path[:80], str(body)[:120], status, answer[:300]
    assert status in allowed, where
    assert b"Traceback" not in answer and SECRET.encode() not in answer, where
    if (
        status in REFUSED
        and path.startswith("/api")
        and method == "POST"
        and status not in (401, 403)
    ):
        assert set(json.loads(answer)) == {"error"} and len(answer) < 4000, where


def mutations(value: object, chance: random.Random) -> object:
    """A value with one part replaced, removed, doubled or added."""
    if isinstance(value, dict) and value and chance.random() < 0.8:
        name = chance.choice([*value])
        if chance.random() < 0.15:
            return {own: x for own, x in value.items() if own != name}
        if chance.random() < 0.15:
            return value | {str(chance.choice(TEXTS)): chance.choice(VALUES)}
        return value | {name: mutations(value[name], chance)}
    if isinstance(value, list) and value and chance.random() < 0.7:
        k = chance.randrange(len(value))
        return [*value[:k], mutations(value[k], chance), *value[k + 1 :]]
    return chance.choice(VALUES)


def test_wrong_requests_of_every_call(attacked):
    counts, chance = Counter[int](), random.Random(1)
    names = [name for name in CALLS if name in REQUESTS]
    for _ in range(1200):
        name = chance.choice(names)
        wrong = mutations(REQUESTS[name], chance)
        check(attacked, counts, "POST", f"/api/{name}", json.dumps(wrong))
    assert sum(counts.values()) == 1200 and counts[422] + counts[400] > 1000


def test_bodies_that_are_no_request(attacked):
    counts = Counter[int]()
    for name in [*CALLS, "none"]:
        for body in BODIES:
            check(attacked, counts, "POST", f"/api/{name}", body, REFUSED)
        for kind in (
            "text/plain",
            "application/x-www-form-urlencoded",
            "multipart/form-data; boundary=x",
            "",
            "application/json/x",
        ):
            check(attacked, counts, "POST", f"/api/{name}", b"{}", REFUSED, content_type=kind)
    assert sum(counts.values()) >= 180


def test_paths_and_methods(attacked):
    counts = Counter[int | str]()
    for method in METHODS:
        for path in PATHS:
            try:
                allowed = (
                    REFUSED | {200, 303}
                    if method in ("GET", "HEAD") or path.startswith(("/#", "/;", "/?"))
                    else REFUSED
                )
                check(attacked, counts, method, path, None, allowed)
            except (UnicodeEncodeError, ValueError):  # what the client cannot send
                counts["unsent"] += 1
    assert sum(counts.values()) - counts["unsent"] >= 500 and counts[200] < 40


def test_keys_hosts_and_origins(attacked):
    counts = Counter[int]()
    name = attacked.cookie.partition("=")[0]
    cookies = ["x", f"{name}=", f"{name}=x", f"{name}={'a' * 4000}", attacked.cookie[:-1], attacked.cookie + "x", attacked.cookie.upper(), f"{name}=;{name}=x", "\x80=\xff", f"x{attacked.cookie}"]  # fmt: skip
    for path in ("/", "/static/app.js", "/site/style.css", "/api/jobs", "/project/fits/1/fit.html"):
        for cookie in cookies:
            check(attacked, counts, "GET", path, None, {401}, cookie=cookie)
    for call in CALLS:
        for cookie in cookies:
            check(attacked, counts, "POST", f"/api/{call}", "{}", {401}, cookie=cookie)
        for host in (
            "localhost",
            "evil.example",
            "127.0.0.1",
            "[::1]",
            "0.0.0.0",
            attacked.netloc + ".evil",
            "127.1",
        ):
            check(attacked, counts, "POST", f"/api/{call}", "{}", {400, 403}, Host=host)
        for origin in (
            "null",
            "http://evil.example",
            "https://" + attacked.netloc,
            attacked.base + "/",
            attacked.base + ".evil",
            "file://",
            "x",
        ):
            check(attacked, counts, "POST", f"/api/{call}", "{}", {403}, Origin=origin)
    assert sum(counts.values()) >= 150 and not counts[200]


def test_bytes_that_are_no_http(attacked):
    host, port = attacked.netloc.split(":")
    chance = random.Random(2)
    head = f"POST /api/open HTTP/1.1\r\nHost: {attacked.netloc}\r\nOrigin: {attacked.base}\r\nCookie: {attacked.cookie}\r\n"
    wrong = [
        b"\0" * 100, b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"GET / HTTP/1.1\r\n\r\n", b"\x16\x03\x01" * 50, b"GET " + b"/a" * 60_000 + b" HTTP/1.1\r\n\r\n",
        (head + "Content-Length: -1\r\n\r\n").encode(), (head + "Content-Length: 10\r\nContent-Length: 20\r\n\r\n").encode(),
        (head + "Transfer-Encoding: chunked\r\nContent-Length: 3\r\n\r\nxyz").encode(), (head + "Transfer-Encoding: chunked\r\n\r\nZZ\r\n").encode(),
        (head + "Content-Length: 100\r\n\r\n{").encode(), (head + f"Host: {attacked.netloc}\r\nContent-Length: 2\r\n\r\n{{}}").encode(), (head + "X: " + "y" * 100_000 + "\r\n\r\n").encode(),
        *(bytes(chance.randrange(256) for _ in range(chance.randrange(1, 400))) for _ in range(100)),
    ]  # fmt: skip
    for content in wrong:
        with socket.create_connection((host, int(port)), timeout=10) as connection:
            connection.sendall(content)
            connection.shutdown(socket.SHUT_WR)
            answer = b""
            try:
                while part := connection.recv(65536):
                    answer += part
            except ConnectionResetError:
                pass
            assert b"Traceback" not in answer and b"HTTP/1.1 500" not in answer
            assert not answer.startswith(b"HTTP/1.1 200")


def test_a_file_that_is_too_large_is_refused_and_nothing_of_it_stays(attacked):
    parts = (b"0" * 10**6 for _ in range(201))
    try:
        status, _, answer = attacked.ask("POST", "/api/upload?name=large.csv", parts)  # type: ignore[arg-type]
        assert status == 413 and b"200 MB" in answer
    except (BrokenPipeError, ConnectionResetError):  # the answer came before all was sent
        pass
    assert not [path for path in (attacked.folder / "data").iterdir() if "large" in path.name]


def test_a_link_out_of_the_project_is_not_listed(attacked):
    assert [found["name"] for found in attacked.call("files", {})[1]["files"]] == ["bench.csv"]


def test_a_page_that_somebody_else_wrote_runs_no_script(attacked):
    _, headers, _ = attacked.ask("GET", "/project/fits/1/fit.html")
    scripts = headers["content-security-policy"].partition("script-src ")[2].partition(";")[0]
    assert all(part.startswith("'sha256-") for part in scripts.split())
