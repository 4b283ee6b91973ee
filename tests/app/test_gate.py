"""Who may ask: every wrong key, host and origin is refused before anything is answered."""

import pytest

from disting.app.gate import Gate, Keys, page_policy
from tests.app.loops import run

KEYS = Keys(8000, "token", "secret")
OWN = {"host": "127.0.0.1:8000", "origin": "http://127.0.0.1:8000", "cookie": "disting-8000=secret"}


async def _inner(scope, receive, send):
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": b"inside"})


def answered(headers: dict | list, method="POST", path="/api/x", query=""):
    """Status, headers and body of a request; `headers` may be a list with one name twice."""
    sent = []

    async def send(message):
        sent.append(message)

    pairs = headers.items() if isinstance(headers, dict) else headers
    raw = [(name.encode(), value.encode("latin-1")) for name, value in pairs]
    scope = {
        "type": "http",
        "method": method,
        "path": path,
        "query_string": query.encode(),
        "headers": raw,
    }
    run(Gate(_inner, KEYS)(scope, None, send))
    start, body = sent
    return start["status"], {n.decode(): v.decode() for n, v in start["headers"]}, body["body"]


def test_the_cookie_lets_a_page_of_this_server_in():
    status, headers, body = answered(OWN)
    assert (status, body) == (200, b"inside")
    assert headers["content-security-policy"].startswith("default-src 'none'; script-src 'self';")
    assert headers["x-content-type-options"] == "nosniff"


def test_the_first_address_sets_the_cookie_and_leads_on():
    status, headers, _ = answered({"host": "127.0.0.1:8000"}, "GET", "/", "token=token")
    assert (status, headers["location"]) == (303, "/")
    assert headers["set-cookie"] == "disting-8000=secret; HttpOnly; SameSite=Strict; Path=/"


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("change", "method", "status"),
    [
        ({"cookie": ""}, "GET", 401),
        ({"cookie": "disting-8000=wrong"}, "POST", 401),
        ({"cookie": "disting-8000=secretx"}, "POST", 401),
        ({"cookie": "disting-8001=secret"}, "POST", 401),
        ({"cookie": "disting-8000=\u00e9"}, "POST", 401),
        ({"cookie": "disting-8000=secret"}, "GET", 200),
        ({"host": "localhost:8000"}, "GET", 403),
        ({"host": "127.0.0.1"}, "GET", 403),
        ({"host": "127.0.0.1:8001"}, "GET", 403),
        ({"host": "evil.example"}, "GET", 403),
        ({"host": "127.0.0.1:8000.evil.example"}, "GET", 403),
        ({"origin": "http://evil.example"}, "GET", 403),
        ({"origin": "null"}, "POST", 403),
        ({"origin": "http://127.0.0.1:8001"}, "POST", 403),
        ({"origin": "https://127.0.0.1:8000"}, "POST", 403),
        ({"origin": ""}, "POST", 403),
        ({"sec-fetch-site": "cross-site"}, "GET", 403),
        ({"sec-fetch-site": "same-site"}, "POST", 403),
        ({"sec-fetch-site": "same-origin"}, "POST", 200),
    ],
)  # fmt: skip
def test_one_wrong_header_is_enough(change, method, status):
    assert answered(OWN | change, method)[0] == status


def test_a_changing_request_names_its_origin():
    without = {name: value for name, value in OWN.items() if name != "origin"}
    assert answered(without, "POST")[0] == 403
    assert answered(without, "GET")[0] == 200


@pytest.mark.parametrize("doubled", ["host", "origin", "cookie", "content-type"])
def test_a_header_that_decides_is_given_once(doubled):
    own = OWN | {"content-type": "application/json"}
    assert answered([*own.items(), (doubled, own[doubled])])[0] == 400


@pytest.mark.parametrize("query", ["token=", "token=wrong", "Token=token", "&".join(["a=1"] * 30)])
def test_another_token_does_not(query):
    assert answered({"host": "127.0.0.1:8000"}, "GET", "/", query)[0] in (400, 401)


def test_the_token_opens_the_first_address_only():
    assert answered({"host": "127.0.0.1:8000"}, "GET", "/static/app.js", "token=token")[0] == 401
    assert answered({"host": "127.0.0.1:8000"}, "POST", "/", "token=token")[0] == 403


def test_two_servers_have_other_keys():
    one, other = Keys(1), Keys(1)
    assert one.token != other.token and one.cookie != other.cookie
    assert len(one.token) > 40


def test_pages_of_a_project_run_the_scripts_of_this_version_alone():
    policy = page_policy()
    assert "'unsafe-inline'" not in policy.partition("style-src")[0]
    assert policy.count("'sha256-") >= 3
    assert "connect-src" not in policy and policy.startswith("default-src 'none'")
