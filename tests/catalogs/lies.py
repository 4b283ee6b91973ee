"""Lies in records of the shipped files: each leaf changed, removed, or exchanged with that of
another record, and which of them the small checker tells as checked.

    python -m tests.catalogs.lies --each 300                # each kind of evidence: hours
    python -m tests.catalogs.lies --each 30 ranks limit     # two kinds

prints a line for each kind and the lies that were accepted. The status is 0 if there are none.
"""

import argparse
import json
import re
import sys
import time
from collections.abc import Iterator
from copy import deepcopy
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from random import Random
from typing import Any

from disting.catalogs.files import shipped_folder

Record = dict[str, Any]
Path = tuple[str | int, ...]
# (kind of evidence around the leaf or "", path, why nothing false is said)
HARMLESS = [
    ("", r"(.*\.)?safety", "bits of the program's own bound; the checker has its own"),
    ("", r"inclusions\.\w+\.evidence", "none, or an empty one: still open"),
    ("", r"inclusions\.\w+\.reason", "words on what is open"),
    ("", r"finding\.\*", "words on what is open"),
    ("", r"\w+_positive\.empirical.*", "how often points had an equivalent"),
    ("forms", r".*\.only_(left|right)\.\*", "some of the coefficients that differ suffice"),
    ("ranks", r".*\.rows\.\*", "ranks of other rows, computed as well"),
    ("larger-projection", r".*\.rows\.\*", "ranks of other rows, computed as well"),
    ("inequality", r".*\.form\.\*\.\*", "the changed form was expanded: its signs are as stated"),
    ("limit", r".*\.parts\.\*\.\*\.\*\.\*", "the changed path was followed: it ends at the same row"),
    ("meeting", r".*\.same_mass", "the count suffices without it"),
    ("theorem", r"(positive\.evidence|finding\.\*)\.name", "the other theorem was derived as well"),
    ("solved", r".*\.left_given", "the values fit with the models exchanged as well"),
]  # fmt: skip
# names of models and pairs: a file is whole only if each is there once (see test_check)
NAMES = {"left", "right", "model", "indices", "network", "group", "as"}
# what of a field the checker leaves open by its own word
OPEN = {"identifiability": ("identifiability", "local or global", "rank")}
WORDS = {
    "relation": ["distinguishable", "indistinguishable", "sometimes", "undecided"],
    "inclusion": ["left-in-right", "right-in-left", "neither", "unknown", "equal"],
    "share": ["always", "sometimes", "never"],
    "certainty": ["theorem", "proven", "bounded", ""],
    "decided_by": ["1", "2", "3", "4", "5", "6", "7", "8", "9", "exact", "admissible", ""],
    "representation": ["tf", "markov", "structure", "fibre", "parameters", ""],
    "kind": ["counts", "renaming", "free-choice", "solved", "limit", "theorem", "too-large"],
    "finding": ["holds", "fails", "sometimes", "abandoned"],
}


@cache
def records(name: str) -> list[Record]:
    """All records of a shipped file, the header first."""
    text = (shipped_folder() / f"{name}.jsonl").read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]


def leaves(value: Any, path: Path = ()) -> Iterator[Path]:
    """Yield the paths of all leaves; empty lists and dictionaries are leaves."""
    if isinstance(value, dict | list) and value:
        parts = value.items() if isinstance(value, dict) else enumerate(value)
        for key, part in parts:
            yield from leaves(part, (*path, key))
    else:
        yield path


def leaf(record: Record, path: Path) -> Any:
    """The value at a path; raises LookupError or TypeError where there is none."""
    value: Any = record
    for key in path:
        value = value[key]
    return value


def with_leaf(record: Record, path: Path, value: Any) -> Record:
    """A copy with another value at a path."""
    found = deepcopy(record)
    leaf(found, path[:-1])[path[-1]] = value
    return found


def without_leaf(record: Record, path: Path) -> Record:
    """A copy without the leaf."""
    found = deepcopy(record)
    del leaf(found, path[:-1])[path[-1]]
    return found


def others(value: Any, path: Path) -> list[Any]:
    """Other values of a leaf: other words of its kind, neighbours of a number."""
    names = [key for key in path if isinstance(key, str)]
    words = next((WORDS[n] for n in names[-1:] if n in WORDS and isinstance(value, str)), None)
    if words is not None:
        return [w for w in words if w != value]
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, -value - 1]
    if isinstance(value, str):
        return [value + "7", "x", ""]
    return [1, ["x"], {"kind": "x"}]


def lies(record: Record, path: Path, strangers: list[Record]) -> Iterator[tuple[str, Record]]:
    """Yield (how, record with one lie at the path)."""
    value = leaf(record, path)
    for other in others(value, path):
        if other != value:
            yield f"{value!r:.40} -> {other!r:.40}", with_leaf(record, path, other)
    yield f"{value!r:.40} removed", without_leaf(record, path)
    for stranger in strangers:
        try:
            other = leaf(stranger, path)
        except (LookupError, TypeError):
            continue
        if other != value and not isinstance(other, dict | list):
            yield f"{value!r:.40} <-> {other!r:.40}", with_leaf(record, path, other)
            break


def kinds_in(value: Any) -> Iterator[str]:
    """Yield the kind of evidence at each depth."""
    if isinstance(value, dict):
        yield from [value["kind"]] if isinstance(value.get("kind"), str) else []
        value = list(value.values())
    for part in value if isinstance(value, list) else ():
        yield from kinds_in(part)


def kind_at(record: Record, path: Path) -> str:
    """Kind of the innermost evidence around a leaf, "" outside of evidence."""
    around = [leaf(record, path[:i]) for i in range(len(path))]
    return next((e["kind"] for e in reversed(around) if isinstance(e, dict) and "kind" in e), "")


def spell(path: Path) -> str:
    """A path as text, places in lists as *.

    >>> spell(("tf", "evidence", "rows", 3))
    'tf.evidence.rows.*'
    """
    return ".".join("*" if isinstance(key, int) else key for key in path)


Piece = tuple[str, Record, str]
"""File, record, and the field of the record about which lies are told."""


def pieces(name: str) -> Iterator[tuple[str, Piece]]:
    """Yield each field of each record of a file by each kind of evidence in it; what has no
    evidence by its kind of line and its name.
    """
    for record in records(name)[not name.startswith("settled") :]:
        line = f"{name.split('-')[0]} {'pair' if 'left' in record else 'model'}"
        for key in record.keys() - NAMES:
            kinds = {*kinds_in(record[key])}
            for kind in sorted(kinds) or [f"{line} {key}"]:
                yield kind, (name, record, key)


@cache
def checker() -> Any:
    """The small checker as a module."""
    spec = spec_from_file_location("catalog_check", shipped_folder() / "check.py")
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@cache
def models_of(name: str) -> dict[Any, Any]:
    """The models of a file by their names in its records."""
    check, (head, *lines) = checker(), records(name)
    if name.startswith("sizes"):
        damped = "undamped" not in name
        listed = {n: enumerate(check.enumerated(n, damped), 1) for n in head["sizes"]}
        return {f"{n}:{k}": m for n, every in listed.items() for k, m in every}
    if name.startswith("networks"):
        return {r["model"]: check.network(r["network"]) for r in lines if "network" in r}
    rows = (r for r in lines if "indices" in r)
    return {r["model"]: check.chain(head["n_masses"], *r["indices"], head["damped"]) for r in rows}


def checked(name: str, r: Record) -> Any:
    """The table of one record that is checked alone."""
    check = checker()
    table = check.Table()
    try:
        _check(check, table, name, r)
    except check.UNREADABLE as why:
        table.wrong.append(f"unreadable: {why}")
    return table


def _check(check: Any, table: Any, name: str, r: Record) -> None:
    kind = name.split("-")[1]
    if name.startswith("settled"):
        pair = check.pair_of(check.chain_text(r["left"]), check.chain_text(r["right"]))
        return check.finding(table, kind, "", r["finding"], pair, "complex")  # type: ignore[no-any-return]
    models, networks = models_of(name), name.startswith("networks")
    if "left" not in r:
        args = (r,) if networks else (r, models[r["model"]])
        record = check.network_record if networks else check.chain_record
        return record(table, kind, "", *args)  # type: ignore[no-any-return]
    pair = check.pair_of(models[r["left"]], models[r["right"]], check.SCALE.get(kind, 1))
    if networks:
        return check.network_pair(table, kind, "", r, pair)  # type: ignore[no-any-return]
    return check.chain_pair(table, kind, "", r, pair, {})  # type: ignore[no-any-return]


def is_harmless(name: str, record: Record, path: Path) -> bool:
    """Return True for a leaf in the list, and for what follows the parameters in a solution: a
    factor that cancels. Compartments have none.
    """
    kind, text = kind_at(record, path), spell(path)
    if kind == "solved" and text.endswith("solutions.*.*") and "compartments" not in name:
        return path[-1] == len(leaf(record, path[:-1])) - 1
    return any(kind == of and re.fullmatch(pattern, text) for of, pattern, _ in HARMLESS)


def accepted(piece: Piece, strangers: list[Record], share: float = 1.0) -> Iterator[str]:
    """Yield "" for each lie about a piece that is refused or harmless, else the lie."""
    name, record, key = piece
    draw = Random(f"{name} {json.dumps(record)}")
    assert not checked(name, record).wrong, record
    for number, path in enumerate(leaves(record[key], (key,))):
        if number and draw.random() > share:
            continue
        for how, lie in lies(record, path, strangers):
            yield (
                ""
                if is_refused(name, lie, path) or is_harmless(name, record, path)
                else (
                    f"{name} {kind_at(record, path)} {spell(path)}: {how} of {json.dumps(record):.300}"
                )
            )


def is_refused(name: str, lie: Record, path: Path) -> bool:
    """Return True if the checker says that a record is wrong, or that it did not repeat the part
    in which the lie is.
    """
    table, key = checked(name, lie), str(path[0])
    of_part = ("closure", "image") if key == "inclusions" else (key, *OPEN.get(key, ()))
    rows = (row for (_, *at, _), row in table.counts.items() if {*at} & {*of_part})
    return bool(table.wrong) or any(row[checker().SEARCH] for row in rows)


CHECKED_ALONE = ("chains", "sizes", "settled", "networks")


def every_piece() -> dict[str, list[Piece]]:
    """All pieces of the files whose records can be checked alone, by kind, in a random order."""
    found: dict[str, list[Piece]] = {}
    for path in sorted(shipped_folder().glob("*.jsonl")):
        if path.stem.startswith(CHECKED_ALONE):
            for kind, piece in pieces(path.stem):
                found.setdefault(kind, []).append(piece)
    for kind, some in found.items():
        Random(kind).shuffle(some)
    return found


def strangers_of(some: list[Piece], number: int) -> list[Record]:
    """Other records of the kind, from which leaves are taken."""
    return [some[(number + step) % len(some)][1] for step in (1, 2, 3, 5)]


def main(arguments: list[str]) -> int:
    """Tell lies about so many records of each kind."""
    parser = argparse.ArgumentParser(description=__doc__, add_help=True)
    parser.add_argument("--each", type=int, default=300, help="records of each kind")
    parser.add_argument("--share", type=float, default=1.0, help="share of their leaves")
    parser.add_argument("kinds", nargs="*", help="kinds of evidence; all if none is named")
    options = parser.parse_args(arguments)
    found: list[str] = []
    for kind, some in sorted(every_piece().items()):
        if options.kinds and kind not in options.kinds:
            continue
        start, chosen = time.monotonic(), some[: options.each]
        told: list[str] = []
        for number, piece in enumerate(chosen):
            told += accepted(piece, strangers_of(some, number), options.share)
        false = [*filter(None, told)]
        seconds = time.monotonic() - start
        print(f"{kind:28}{len(chosen):5} records{len(told):9} lies{len(false):5} accepted"
              f"{seconds:8.0f} s", *false[:5], sep="\n  ", flush=True)  # fmt: skip
        found += false
    return int(bool(found))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
