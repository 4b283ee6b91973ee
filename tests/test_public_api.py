"""The public names, literally: adding or removing one is a decision that shows here."""

import subprocess
import sys

import disting

NAMES = [
    *(
        "Alternatives",
        "CONDITIONS",
        "CacheWarning",
        "Catalog",
        "CatalogError",
        "Certainty",
        "Chain",
        "ConstraintViolation",
    ),
    *(
        "ContradictionError",
        "Decisions",
        "DistingError",
        "Domain",
        "Engine",
        "Experiment",
        "Family",
        "Finding",
        "Identifiability",
        "Inclusion",
    ),
    *(
        "InputError",
        "Level",
        "MatrixModel",
        "Model",
        "ModelList",
        "ModelRow",
        "Outcome",
        "ParameterIdentifiability",
        "Query",
        "Relation",
        "Sensor",
        "Settings",
        "Step",
        "Store",
        "Symmetry",
    ),
    *(
        "Verdict",
        "Verification",
        "View",
        "alternatives",
        "catalog",
        "compare",
        "compare_everywhere",
        "equivalents",
        "explicit_map",
        "findings",
        "global_identifiability",
        "identifiability",
        "local_identifiability",
        "prove",
        "read_models",
        "transfer_function",
        "everywhere_file",
        "verdict_file",
        "verify",
        "write_models",
    ),
]
HEAVY = {
    "pandas",
    "networkx",
    "sympy",
    "PIL",
    "jinja2",
    "distributed",
    "rich",
    "scipy",
    "matplotlib",
}


def test_public_names():
    modules = {
        "algebra",
        "behaviour",
        "catalogs",
        "conditions",
        "equivalence",
        "errors",
        "evidence",
        "experiments",
        "fibres",
        "files",
        "general",
        "model",
        "questions",
        "store",
        "verdict",
    }
    seen = {name for name in vars(disting) if not name.startswith("_")} - modules
    optional = {
        "cli",
        "fit",
        "measurement",
        "paper",
        "report",
        "simulation",
    }  # imported by other tests of this process
    assert sorted(seen - optional) == sorted(NAMES)


def test_importing_the_package_leaves_heavy_libraries_alone():
    code = "import sys, disting; print(*sys.modules)"
    loaded = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout.split()
    assert "disting" in loaded
    assert not HEAVY & set(loaded)


def test_commands_load_sympy_only_where_they_write_an_expression():
    """One after the other in one process, whose last one writes one."""
    commands = ("compare 3:2 3:5", "models 3", "equivalents 3:4 --to 3:1 --undamped --formulas")
    code = (
        "import sys; from disting.cli import main\n"
        f"for command in {commands}: main(command.split()); print('loaded', 'sympy' in sys.modules)"
    )
    said = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    ).stdout
    loaded = [line for line in said.splitlines() if line.startswith("loaded ")]
    assert loaded == ["loaded False", "loaded False", "loaded True"]
