"""The digest of the code behind cached results: it names all code that a module runs, and
changes with any of it.
"""

import ast
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from disting.store.store import digest, modules_of

ROOT = Path(find_spec("disting").origin).parents[1]


def source(name):
    spec = find_spec(name)
    return Path(spec.origin).read_text(encoding="utf-8")


def exists(name):
    try:
        return find_spec(name) is not None
    except ModuleNotFoundError:
        return False


def imported(name):
    """Slow and obviously right: modules named in any import statement of a module's syntax tree, or
    by a text alone, with or without a function, as tables name them.
    """
    for node in ast.walk(ast.parse(source(name))):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith("disting"):
            assert not node.level
            names = {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)} - {
                "disting"
            }
            yield from (each for each in names if exists(each))
        elif isinstance(node, ast.Import):
            yield from (a.name for a in node.names if a.name.startswith("disting."))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            module = f"disting.{node.value.partition(':')[0]}"
            if re.fullmatch(r"(\w+\.)+\w+", module) and "." in node.value and exists(module):
                yield module


def closure(name):
    found, new = set(), {name}
    while new:
        found |= new
        new = {each for old in new for each in imported(old)} - found
    return found


@pytest.mark.full
@pytest.mark.parametrize(
    "name", ["disting.verdict.engine", "disting.fit.search.exchange", "disting.algebra.matroid"]
)
def test_the_modules_are_those_of_the_syntax_trees(name):
    assert set(modules_of(name)) == closure(name)


def test_an_estimate_depends_on_the_chain_model_and_a_verdict_on_the_conditions():
    assert {
        "disting.model.chain",
        "disting.fit.search.plant",
        "disting.measurement.response",
    } <= set(modules_of("disting.fit.search.exchange"))
    assert {
        "disting.model.chain",
        "disting.conditions.table",
        "disting.fibres.synthesis.decide",
        "disting.general.parts",
        "disting.network.outflows",
        "disting.decide.identifiability.analysis",
        "disting.decide.same.exact",  # named as text
        "disting.decide.positive.shares",
        "disting.experiments.exact",
        "disting.general.forms",
    } <= set(modules_of("disting.verdict.engine"))
    assert not any(
        name.startswith(("disting.report", "disting.cli"))
        for name in modules_of("disting.fit.search.exchange")
    )


@pytest.mark.full
def test_a_change_of_the_ports_in_the_chain_model_changes_the_key_of_estimates(tmp_path):
    """Estimates were kept under a digest of the folder `fit` alone, and served after a change
    elsewhere.
    """
    copy = tmp_path / "disting"
    shutil.copytree(ROOT / "disting", copy, ignore=shutil.ignore_patterns("__pycache__", "shipped"))
    shutil.copytree(ROOT / "catalog", tmp_path / "catalog")
    before = digest_of(tmp_path)
    assert before == digest("disting.fit.search.exchange")
    chain = copy / "model" / "chain.py"
    chain.write_text(chain.read_text(encoding="utf-8") + "\n# changed\n", encoding="utf-8")
    assert digest_of(tmp_path) != before


def digest_of(folder):
    command = "from disting.store.store import digest; print(digest('disting.fit.search.exchange'))"
    done = subprocess.run(
        [sys.executable, "-c", command],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
        timeout=600,
    )
    return done.stdout.strip()
