"""Server of the app: addresses of the page, of its calls, and of the files of the project.

    GET  /                        the page
    GET  /static/NAME             its modules and styles; /site/NAME those of the site's pages
    POST /api/NAME                a call of `interface`: its answer, or {"job": N}
    GET  /api/jobs                jobs and their states
    GET  /api/jobs/N              events of a job
    POST /api/jobs/N/stop         stop it
    POST /api/upload?name=NAME    keep a measured file, the body as it is
    GET  /project/fits/N/NAME     a file of a finished fit

Every refusal is {"error": "one sentence"}.
"""

import asyncio
import json
import mimetypes
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from filecmp import cmp
from functools import cache, partial
from pathlib import Path
from typing import Any

import uvicorn
from jsonschema import Draft202012Validator
from jsonschema.exceptions import best_match
from starlette.applications import Starlette
from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, Response, StreamingResponse
from starlette.routing import Route

from disting.app.gate import HOST, Asgi, Gate, Keys, page_policy
from disting.app.interface import CALLS, Json
from disting.app.jobs import Job, Jobs, Pool, watch, working
from disting.app.project import check_name, free_name, inside
from disting.app.workers import Failure, Setting
from disting.errors import DistingError, InputError, brief, short
from disting.files import json_text, unique_keys
from disting.report.environment import source

STATIC = Path(__file__).parent / "static"
SITE = (
    "style.css",
    "fit.css",
    "axes.css",
    "axes.js",
    "motion-machine.js",
    "motion-run.js",
    "motion-graph.js",
    "motion-plots.js",
    "motion-maps.js",
    "motion-imitate.js",
    "motion-second.js",
    "motion.css",
    "copy.js",
)
LARGEST_REQUEST = 2**20  # bytes of a JSON request
LARGEST_FILE = 200 * 10**6  # bytes of a measured file
PATIENCE = 0.5  # seconds between two looks whether a client still waits
MOST_FILES = 1000  # of a project
WORKERS = 3  # that answer quick calls: a page keeps two at most with slow ones
MEDIA = {".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml"}
SHOWN = (".html", ".svg", ".png", ".pdf")  # files that a browser shows; others are saved


@dataclass(frozen=True, slots=True)
class State:
    """Folder and workers that the addresses share."""

    folder: Path
    files: Pool
    pool: Pool
    jobs: Jobs


def make_app(setting: Setting, keys: Keys) -> Asgi:
    """Return the application, gate included."""

    @asynccontextmanager
    async def lifespan(app: Starlette) -> AsyncIterator[None]:
        """Workers while the server runs."""
        async with working(setting, WORKERS) as (files, pool, jobs):
            app.state.own = State(setting.folder, files, pool, jobs)
            yield

    routes = [
        Route("/", page),
        Route("/static/{name}", static),
        Route("/site/{name}", site),
        Route("/api/jobs", jobs_list),
        Route("/api/jobs/{number:int}", job_events),
        Route("/api/jobs/{number:int}/stop", job_stop, methods=["POST"]),
        Route("/api/upload", upload, methods=["POST"]),
        Route("/api/{name}", call, methods=["POST"]),
        Route("/project/fits/{number:int}/{name}", fit_file),
    ]
    handlers: dict[Any, Any] = {
        Failure: _on_failure,
        DistingError: _on_refusal,
        OSError: _on_system_error,
        HTTPException: _on_http_error,
        ClientDisconnect: _on_disconnect,
        Exception: _on_mistake,
    }
    return Gate(Starlette(routes=routes, exception_handlers=handlers, lifespan=lifespan), keys)


def serve(setting: Setting, listener: socket.socket, keys: Keys) -> None:
    """Serve until Ctrl-C."""
    config = uvicorn.Config(
        make_app(setting, keys),
        host=HOST,
        log_level="critical",
        access_log=False,
        server_header=False,
        date_header=False,
        ws="none",
        limit_concurrency=256,
        timeout_graceful_shutdown=1,
    )
    uvicorn.Server(config).run(sockets=[listener])


def listen(port: int) -> socket.socket:
    """Return a socket of this machine alone, at any free port for 0; raises InputError."""
    listener = socket.socket()
    try:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((HOST, port))
    except OSError as reason:
        listener.close()
        why = reason.strerror or reason
        raise InputError(f"port {port} cannot be used ({why}); name another with --port") from None
    listener.listen(128)
    return listener


async def page(request: Request) -> Response:
    """The shell of the page."""
    return FileResponse(STATIC / "index.html", media_type="text/html")


async def static(request: Request) -> Response:
    """A module or a style of the app."""
    name = check_name(request.path_params["name"])
    path = STATIC / name
    if path.suffix not in MEDIA or not path.is_file():
        raise HTTPException(404)
    return FileResponse(path, media_type=MEDIA[path.suffix])


async def site(request: Request) -> Response:
    """A script or a style that the pages of the site have too."""
    name = request.path_params["name"]
    if name not in SITE:
        raise HTTPException(404)
    return Response(source(name), media_type=MEDIA[Path(name).suffix])


async def call(request: Request) -> Response:
    """Answer a call, or begin a job."""
    own: State = request.app.state.own
    wanted = CALLS.get(request.path_params["name"])
    if wanted is None:
        raise HTTPException(404)
    content = await _json(request)
    _check(content, wanted.name)
    if wanted.is_job:
        return _answer({"job": own.jobs.begin(wanted, content).number}, 202)
    pool = own.files if wanted.is_light else own.pool
    return _answer(await pool.answer(wanted, content, partial(_until_gone, request)))


async def jobs_list(request: Request) -> Response:
    """States of the jobs."""
    own: State = request.app.state.own
    return _answer({"jobs": [job.to_dict() for job in own.jobs.every.values()]})


async def job_events(request: Request) -> Response:
    """Events of a job until it is over."""
    return StreamingResponse(watch(_job(request)), media_type="text/event-stream")


async def job_stop(request: Request) -> Response:
    """Stop a job."""
    own: State = request.app.state.own
    job = _job(request)
    own.jobs.stop(job)
    return _answer(job.to_dict())


async def upload(request: Request) -> Response:
    """Keep a file in the project; a name that is taken gets a number, unless the content is the
    same.
    """
    own: State = request.app.state.own
    name = check_name(request.query_params.get("name", ""))
    folder = inside(own.folder, "data")
    folder.mkdir(exist_ok=True)
    if sum(1 for _ in folder.iterdir()) >= MOST_FILES:
        raise InputError(f"the project holds {MOST_FILES} files; remove some from its data folder")
    beside = folder / f".{free_name(folder, name)}.{id(request)}.partial"
    try:
        size = await _receive(request, beside)
        kept = _place(folder, beside, name)
    finally:
        beside.unlink(missing_ok=True)
    return _answer({"name": kept, "size": size})


async def fit_file(request: Request) -> Response:
    """A file of a finished fit."""
    own: State = request.app.state.own
    number, name = str(request.path_params["number"]), request.path_params["name"]
    path = inside(own.folder, "fits", number, name)
    if not path.is_file():
        raise HTTPException(404)
    media = mimetypes.guess_type(path.name)[0] or "application/octet-stream"
    headers = {"content-security-policy": page_policy()}
    show = path.suffix in SHOWN
    return FileResponse(
        path,
        media_type=media,
        headers=headers,
        filename=path.name,
        content_disposition_type="inline" if show else "attachment",
    )


async def _receive(request: Request, path: Path) -> int:
    """Write the body of a request to a file; the number of bytes. Raises Failure."""
    size = 0
    with path.open("xb") as file:
        async for part in request.stream():
            size += len(part)
            if size > LARGEST_FILE:
                raise Failure(
                    413, f"a file may have {LARGEST_FILE // 10**6} MB; choose a smaller one"
                )
            file.write(part)
    if not size:
        raise InputError("the file is empty; choose another one")
    return size


def _place(folder: Path, beside: Path, name: str) -> str:
    """Give a received file its name; returns it."""
    own = inside(folder, name)
    if own.is_file() and cmp(own, beside, shallow=False):
        return name
    free = free_name(folder, name)
    beside.replace(inside(folder, free))
    return free


async def _until_gone(request: Request) -> None:
    """Return when the client has closed its connection."""
    while not await request.is_disconnected():
        await asyncio.sleep(PATIENCE)


async def _json(request: Request) -> Json:
    """The JSON object of a request. Raises Failure."""
    if request.headers.get("content-type", "").partition(";")[0].strip() != "application/json":
        raise Failure(415, "a request is JSON: content-type application/json")
    parts, size = list[bytes](), 0
    async for part in request.stream():
        size += len(part)
        if size > LARGEST_REQUEST:
            raise Failure(413, f"a request may have {LARGEST_REQUEST} bytes")
        parts.append(part)
    try:
        content = json.loads(
            b"".join(parts).decode(), object_pairs_hook=unique_keys, parse_constant=_no_number
        )
    except InputError:
        raise
    except (ValueError, RecursionError):
        raise Failure(400, "the request is no JSON") from None
    if not isinstance(content, dict):
        raise Failure(400, "the request is no JSON object")
    return content


def _no_number(word: str) -> None:
    raise ValueError(word)


def _check(content: Json, name: str) -> None:
    """Raise InputError where the schema of a call refuses a request."""
    error = best_match(_validator(name).iter_errors(content))
    if error is not None:
        where = ".".join(map(str, error.absolute_path)) or "the request"
        raise InputError(f"{where}: {short(error.instance)} is refused ({error.validator})")


@cache
def _validator(name: str) -> Draft202012Validator:
    return Draft202012Validator(CALLS[name].schema["properties"]["request"])


def _job(request: Request) -> Job:
    own: State = request.app.state.own
    job = own.jobs.every.get(request.path_params["number"])
    if job is None:
        raise HTTPException(404)
    return job


def _answer(content: Json, status: int = 200) -> Response:
    return Response(json_text(content), status, media_type="application/json")


def _error(status: int, sentence: str) -> Response:
    return _answer({"error": brief(sentence)}, status)


async def _on_failure(request: Request, reason: Failure) -> Response:
    return _error(reason.status, reason.message)


async def _on_refusal(request: Request, reason: DistingError) -> Response:
    return _error(422, str(reason))


async def _on_system_error(request: Request, reason: OSError) -> Response:
    return _error(507, str(reason.strerror or reason))


async def _on_http_error(request: Request, reason: HTTPException) -> Response:
    words = {404: "there is nothing at this address", 405: "this method is not supported here"}
    return _error(reason.status_code, words.get(reason.status_code, reason.detail))


async def _on_mistake(request: Request, reason: Exception) -> Response:
    return _error(500, f"the program made a mistake ({type(reason).__name__})")


async def _on_disconnect(request: Request, reason: ClientDisconnect) -> Response:
    return _error(400, "the request ended early")
