"""No lie in a record of the shipped files is told as checked: each leaf changed, removed, exchanged
with another record's. What may be changed without a falsehood is listed in HARMLESS.
"""

import json
import re
from collections.abc import Callable, Iterator
from importlib.util import module_from_spec, spec_from_file_location
from random import Random
from typing import Any

import pytest

from disting.catalogs.files import shipped_folder
from tests.catalogs.lies import (
    Path,
    Record,
    kind_at,
    kinds_of,
    leaf,
    leaves,
    lies,
    records,
    sampled,
    spell,
)

# (kind of evidence around the leaf or "", path, why nothing false is said)
HARMLESS = [
    ("", r".*\.safety", "bits of the program's own bound; the checker has its own"),
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
    ("solved", r".*\.left_given", "the values fit with the models exchanged as well"),
]  # fmt: skip
# names of models and pairs: a file is whole only if each is there once (see test_check)
NAMES = {"left", "right", "model", "network", "group", "as"}
PLACES = {"identifiability": ("identifiability", "model"), "inclusions": ("closure", "image")}


@pytest.fixture(scope="module")
def check() -> Any:
    spec = spec_from_file_location("catalog_check", shipped_folder() / "check.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def checker_of(check: Any, name: str) -> Callable[[Record], Any]:
    """A function that checks one record of a file alone, and returns the table."""
    head, *others = records(name)
    kind = name.split("-")[1]
    chains = {
        r["model"]: check.chain(head["n_masses"], *r["indices"], head["damped"])
        for r in others
        if "indices" in r and "n_masses" in head
    }
    networks = {r["model"]: check.network(r["network"]) for r in others if "network" in r}
    sizes = {
        f"{n}:{k}": m
        for n in head.get("sizes", ())
        for k, m in enumerate(check.enumerated(n, "undamped" not in name), 1)
    }
    models = chains or networks or sizes

    def run(r: Record) -> Any:
        table = check.Table()
        try:
            fill(table, r)
        except check.UNREADABLE as why:
            table.wrong.append(f"unreadable: {why}")
        return table

    def fill(table: Any, r: Record) -> None:
        if name.startswith("settled"):
            pair = check.pair_of(check.chain_text(r["left"]), check.chain_text(r["right"]))
            check.finding(table, kind, "", r["finding"], pair)
        elif "left" in r:
            scale = check.SCALE.get(kind, 1)
            pair = check.pair_of(models[r["left"]], models[r["right"]], scale)
            if networks:
                check.network_pair(table, kind, "", r, pair)
            else:
                check.chain_pair(table, kind, "", r, pair, {})
        elif networks:
            check.network_record(table, kind, "", r)
        else:
            check.chain_record(table, kind, "", r, models[r["model"]])

    return run


def is_harmless(name: str, record: Record, path: Path) -> bool:
    """Return True for a leaf in the list, and for what follows the parameters in a solution: a
    factor that cancels. Compartments have none.
    """
    kind, text = kind_at(record, path), spell(path)
    if kind == "solved" and text.endswith("solutions.*.*") and "compartments" not in name:
        return path[-1] == len(leaf(record, path[:-1])) - 1
    return any(kind == of and re.fullmatch(pattern, text) for of, pattern, _ in HARMLESS)


def accepted(check: Any, name: str, each: int, share: float = 1.0) -> Iterator[str]:
    """Yield the lies that are told as checked, of a share of the leaves."""
    run, draw = checker_of(check, name), Random(name)
    chosen = list(sampled(name, kinds_of, each))
    for record in chosen:
        assert not run(record).wrong, record
        for path in leaves(record):
            if path[0] in NAMES or draw.random() > share:
                continue
            for how, lie in lies(record, path, draw.sample(chosen, min(4, len(chosen)))):
                table = run(lie)
                places = PLACES.get(path[0], (path[0], "model"))
                open_ = any(row[check.SEARCH] for (_, at, *_), row in table.counts.items()
                            if at in places)  # fmt: skip
                if not table.wrong and not open_ and not is_harmless(name, record, path):
                    yield f"{name} {kind_at(record, path)} {spell(path)}: {how} of {json.dumps(record):.300}"


@pytest.mark.parametrize("name", [
    "chains-1-undamped", "chains-2-damped", "networks-compartments-2",
])  # fmt: skip
def test_no_lie_is_told_as_checked(check, name):
    assert list(accepted(check, name, 1, 0.1))[:5] == []


LARGE = [
    ("networks-circuits-5", 3), ("networks-cells-4", 3), ("networks-machines-3-damped", 2),
    ("networks-trees-4", 2), ("networks-compartments-3", 2),
]  # fmt: skip


@pytest.mark.full
@pytest.mark.parametrize(("name", "each"), [
    ("chains-3-undamped", 10), ("chains-3-damped", 10), ("chains-4-undamped", 3),
    ("chains-4-damped", 3), ("sizes-damped", 5), ("sizes-undamped", 5), ("settled-dampers", 2),
    ("networks-machines-2", 5), ("networks-machines-2-damped", 5), ("networks-compartments-2", 10),
    ("networks-circuits-4", 5),
    *[pytest.param(name, each, marks=pytest.mark.slow) for name, each in LARGE],
])  # fmt: skip
def test_no_lie_in_any_kind_is_told_as_checked(check, name, each):
    assert list(accepted(check, name, each))[:5] == []
