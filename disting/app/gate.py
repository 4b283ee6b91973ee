"""Gate of the server: who may ask, and what a page may do.

A request passes with the cookie that the first address sets, for this host and port only, and where
it changes something only from a page of this server. So no other page of the browser (by a link, a
form, a script, or a name that leads to 127.0.0.1) and no other user of the machine is answered.
"""

import hmac
from collections.abc import Awaitable, Callable, MutableMapping
from dataclasses import dataclass, field
from functools import cache
from http.cookies import CookieError, SimpleCookie
from secrets import token_urlsafe
from typing import Any
from urllib.parse import parse_qs

from disting.report.environment import scripts_of

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Asgi = Callable[[Scope, Receive, Send], Awaitable[None]]
HOST = "127.0.0.1"
ONCE = ("host", "origin", "cookie", "sec-fetch-site", "content-type")
UNCHANGING = ("GET", "HEAD")
SHELL_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:;"
    " connect-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'none';"
    " frame-ancestors 'none'"
)
EVERY = {
    "cache-control": "no-store",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "referrer-policy": "no-referrer",
    "x-content-type-options": "nosniff",
}
WRITTEN = ("site.html", "fit.html", "fit-networks.html", "fit-question.html", "plan.html")


@dataclass(frozen=True, slots=True)
class Keys:
    """Token of the first address, value of the cookie, port."""

    port: int
    token: str = field(default_factory=lambda: token_urlsafe(32))
    cookie: str = field(default_factory=lambda: token_urlsafe(32))

    @property
    def name(self) -> str:
        """Name of the cookie: two servers have two."""
        return f"disting-{self.port}"

    @property
    def origin(self) -> str:
        """Origin of the pages."""
        return f"http://{HOST}:{self.port}"

    @property
    def first_address(self) -> str:
        """Address that lets a browser in."""
        return f"{self.origin}/?token={self.token}"


@cache
def page_policy() -> str:
    """Policy of the pages in the project folder: of all scripts only those run that the templates
    of this version write, whoever wrote the page.
    """
    hashes = sorted({script for name in WRITTEN for script in scripts_of(name)})
    return (
        f"default-src 'none'; script-src {' '.join(hashes)}; style-src 'unsafe-inline';"
        " img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'self'"
    )


class Gate:
    """Answers what may not pass, and states to the browser what pages may do."""

    def __init__(self, app: Asgi, keys: Keys) -> None:
        self._app = app
        self._keys = keys

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        if scope["type"] != "http":  # no web sockets
            return

        async def send_with_headers(message: Message) -> None:
            """With the headers of every answer."""
            if message["type"] == "http.response.start":
                headers = list(message.get("headers", []))
                present = {name.lower() for name, _ in headers}
                own = EVERY | {"content-security-policy": SHELL_POLICY}
                headers += [
                    (name.encode(), value.encode())
                    for name, value in own.items()
                    if name.encode() not in present
                ]
                message = {**message, "headers": headers}
            await send(message)

        refusal = self._refuse(scope)
        if refusal is not None:
            await _say(send_with_headers, *refusal)
        elif self._enters(scope):
            cookie = f"{self._keys.name}={self._keys.cookie}; HttpOnly; SameSite=Strict; Path=/"
            await _say(send_with_headers, 303, "", location="/", **{"set-cookie": cookie})
        else:
            await self._app(scope, receive, send_with_headers)

    def _enters(self, scope: Scope) -> bool:
        """Return True for the first address with its token."""
        if scope["path"] != "/" or scope["method"] != "GET":
            return False
        query = parse_qs(scope["query_string"].decode("latin-1"), max_num_fields=20)
        return _same(query.get("token", [""])[0], self._keys.token)

    def _refuse(self, scope: Scope) -> tuple[int, str] | None:
        """Status and sentence where a request may not pass."""
        headers = _headers(scope)
        if headers is None:
            return 400, "a header is given twice"
        if headers.get("host") != f"{HOST}:{self._keys.port}":
            return 403, "this host is not served"
        origin = headers.get("origin")
        if origin not in (None, self._keys.origin):
            return 403, "pages of another origin are not answered"
        if origin is None and scope["method"] not in UNCHANGING:
            return 403, "the origin of the request is missing"
        if headers.get("sec-fetch-site", "none") not in ("none", "same-origin"):
            return 403, "pages of another origin are not answered"
        try:
            enters = self._enters(scope)
        except ValueError:
            return 400, "the address has too many fields"
        if enters or _same(_cookie(headers.get("cookie", ""), self._keys.name), self._keys.cookie):
            return None
        return 401, "open the address that 'disting app' printed"


def _headers(scope: Scope) -> dict[str, str] | None:
    """Headers by name; None where one that decides is given twice."""
    names = [name.decode("latin-1").lower() for name, _ in scope["headers"]]
    if any(names.count(name) > 1 for name in ONCE):
        return None
    return dict(zip(names, (v.decode("latin-1") for _, v in scope["headers"]), strict=True))


def _cookie(header: str, name: str) -> str:
    try:
        cookies = SimpleCookie(header)
    except CookieError:
        return ""
    return cookies[name].value if name in cookies else ""


def _same(given: str, wanted: str) -> bool:
    """Compare in a time that tells nothing."""
    return hmac.compare_digest(given.encode(errors="replace"), wanted.encode())


async def _say(send: Send, status: int, sentence: str, **headers: str) -> None:
    """Answer with one sentence."""
    body = f"{sentence}\n".encode() if sentence else b""
    own = {"content-type": "text/plain; charset=utf-8", "content-length": str(len(body))} | headers
    raw = [(name.encode(), value.encode()) for name, value in own.items()]
    await send({"type": "http.response.start", "status": status, "headers": raw})
    await send({"type": "http.response.body", "body": body})
