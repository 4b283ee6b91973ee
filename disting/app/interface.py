"""Calls of the page: one table, JSON in and JSON out.

A call is a function of this package that runs in a worker process whose working directory is the
project folder. A quick call takes the request and returns the answer. A job may take minutes; it
takes two more arguments, `progress(what, done, total)` and the `Setting` of the workers (processes,
scheduler). Both raise DistingError for a request that cannot be answered; its message is shown to
the user.

The request and the answer of a call are described in `disting/schemas/app/NAME.json`; a request
that its schema refuses reaches no function.
"""

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

Json = dict[str, Any]
Progress = Callable[[str, int, int], None]
SCHEMAS = Path(__file__).parents[1] / "schemas" / "app"
QUICK = 20.0  # seconds that a quick call may take
LONG = 6 * 3600.0  # seconds that a job may take


@dataclass(frozen=True, slots=True)
class Call:
    """A call by its name in the address, with the module of this package and the function that
    answers it; `seconds`: the time after which it is ended.
    """

    name: str
    module: str
    function: str
    is_job: bool = False
    seconds: float = QUICK

    @property
    def is_light(self) -> bool:
        """Return True for a call that only handles files of the project."""
        return self.module == "project"

    def load(self) -> Callable[..., Json]:
        """Import the function, which loads numerical libraries."""
        function: Callable[..., Json] = getattr(
            import_module(f"disting.app.{self.module}"), self.function
        )
        return function

    @property
    def schema(self) -> Json:
        """JSON Schemas with the properties `request` and `answer`."""
        return _read_schema(self.name)


CALLS = {
    call.name: call
    for call in (
        Call("files", "project", "list_files"),
        Call("look", "reading", "look_at_file", seconds=120.0),
        Call("fit", "fitting", "fit", is_job=True, seconds=LONG),
        Call("fits", "project", "list_fits"),
        Call("figures", "project", "show_figures"),
        Call("next", "onward", "advise", is_job=True, seconds=LONG),
        Call("plan", "onward", "plan", is_job=True, seconds=LONG),
        Call("two_fits", "two_fits", "set_beside"),
        Call("fits_verdict", "two_fits", "decide_fits", is_job=True, seconds=LONG),
        Call("machine", "machine", "draw_machine", seconds=60.0),
        Call("determine", "machine", "determine", seconds=60.0),
        Call("alike", "machine", "find_alike", seconds=60.0),
        Call("separate", "machine", "separate", seconds=60.0),
        Call("sensor", "machine", "add_sensor", seconds=30.0),
        Call("compare", "pair", "compare_two"),
        Call("decide", "pair", "decide_two", is_job=True, seconds=LONG),
        Call("formulas", "pair", "find_formulas", seconds=60.0),
        Call("values", "pair", "find_values", seconds=30.0),
        Call("motion", "pair", "show_motion", seconds=30.0),
        Call("evidence", "pair", "write_evidence", seconds=60.0),
        Call("open", "project", "open_state"),
        Call("save", "project", "save_state"),
    )
}
"""The calls by name, in the order of the pages that use them."""


@cache
def _read_schema(name: str) -> Json:
    content: Json = json.loads((SCHEMAS / f"{name}.json").read_text(encoding="utf-8"))
    return content
