"""Two finished fits side by side: what each selected, how well it explains its data, and the
parameters with their intervals; as a job, since it may take minutes, the verdict on both
structures.
"""

import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from disting.app.interface import Json, Progress
from disting.app.project import fit_file, read_object, summary
from disting.app.workers import Setting
from disting.errors import DistingError
from disting.files import Format
from disting.model.chain import Chain
from disting.planning.fit_file import record_of
from disting.planning.rival import AnyStructure, name_of
from disting.report.fit.words import percent, readable
from disting.store import Store
from disting.verdict.comparison import compare
from disting.verdict.engine import Engine

DIGITS = 4
NOTHING = "–"
NOT_KNOWN = "not known"


@dataclass(frozen=True, slots=True)
class Side:
    """A fit: its file and the structure that it selected, None with the reason where there is none;
    `values` and `intervals` by parameter.
    """

    number: int
    plain: Mapping[str, Any]
    structure: AnyStructure | None
    reason: str = ""

    @property
    def entry(self) -> Mapping[str, Any]:
        """The selected candidate as the file has it, with its intervals."""
        if self.plain.get("format") == Format.NETWORK_FIT:
            fits = self.plain["fits"]
            return next((f for f in fits if f["name"] == self.plain["selected"]), {})
        first = self.plain.get("not_excluded", [])[:1]
        selected = self.plain.get("selected") or {}
        return selected | {"intervals": first[0]["intervals"] if first else {}}


def set_beside(request: Json) -> Json:
    """Return two fits side by side."""
    sides = [_side(number) for number in request["fits"]]
    return {
        "rows": [[name, *texts] for name, *texts in _rows(sides)],
        "parameters": [[name, *texts] for name, *texts in _parameters(sides)],
    }


def decide_fits(request: Json, progress: Progress, _: Setting) -> Json:
    """Return the verdict on the structures that two fits selected, with its command."""
    left, right = (_side(number) for number in request["fits"])
    progress("deciding", 0, 1)
    sentence, command = _verdict(left, right)
    return {"verdict": sentence, "command": command}


def _side(number: int) -> Side:
    path = fit_file(number)
    plain = read_object(path)
    try:
        return Side(number, plain, record_of(path).model)
    except DistingError as reason:
        return Side(number, plain, None, str(reason))


def _verdict(left: Side, right: Side) -> tuple[str, str]:
    """Sentence on both structures, and the command that gives it."""
    for side in (left, right):
        if side.structure is None:
            return f"Fit {side.number} selects no structure: {side.reason}.", ""
    one, two = left.structure, right.structure
    assert one is not None and two is not None
    if one == two:
        return f"Both select the same structure, {name_of(one)}.", ""
    try:
        with Store.open(None) as store:
            verdict = compare(one, two, engine=Engine(store=store))
    except DistingError as reason:
        return f"The two structures are not compared: {reason}.", ""
    damping = ["--undamped"] if isinstance(one, Chain) and not one.damped else []
    words = ["disting", "compare", name_of(one), name_of(two), *damping]
    return verdict.sentence, shlex.join(words)


def _rows(sides: Sequence[Side]) -> Iterator[tuple[str, ...]]:
    """Each row that one of the two has, with the text of both."""
    both = [dict(_facts(side)) for side in sides]
    for name in dict.fromkeys(name for facts in both for name in facts):
        yield name, *(facts.get(name, NOTHING) for facts in both)


def _facts(side: Side) -> Iterator[tuple[str, str]]:
    """Facts of a fit by name."""
    about, plain, entry = summary(side.number), side.plain, side.entry
    yield "Data", ", ".join(m["file"] for m in about.get("request", {}).get("measurements", []))
    if about.get("request", {}).get("test"):
        yield "Test data", about["request"]["test"]
    yield "Structure", name_of(side.structure) if side.structure else "none is selected"
    explains = plain.get("status") or ("explained" if about.get("explains") else "not explained")
    yield "Data explained", str(explains)
    for name, value in (
        ("χ² per line", entry.get("chi2_per_line", entry.get("chi2"))),
        ("J of the fitted data", entry.get("j_train")),
        ("J of the test data", entry.get("j_test")),
    ):
        if isinstance(value, int | float):
            yield name, readable(value, DIGITS)
    band = plain.get("frequencies")
    if isinstance(band, Mapping):
        yield "Lines", f"{band['lines']} from {band['low']:.4g} to {band['high']:.4g} Hz"
    if isinstance(plain.get("scatter"), int | float):
        yield "Scatter of a line", percent(plain["scatter"])


def _parameters(sides: Sequence[Side]) -> Iterator[tuple[str, ...]]:
    """Each parameter with value and interval of both."""
    both = [dict(_values(side)) for side in sides]
    for name in dict.fromkeys(name for values in both for name in values):
        yield name, *(values.get(name, NOTHING) for values in both)


def _values(side: Side) -> Iterator[tuple[str, str]]:
    entry = side.entry
    for name, value in entry.get("parameters", entry.get("values", {})).items():
        interval = entry.get("intervals", {}).get(name)
        text = "no interval"
        if interval:
            low, high = (NOT_KNOWN if x is None else readable(x, DIGITS) for x in interval)
            text = f"{low} to {high}"
        yield name, f"{readable(value, DIGITS)} ({text})"
