"""The public names, literally: adding or removing one is a decision that shows here."""

import ast
import pydoc
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import numpy as np
import pytest

import disting
from disting import Chain, InputError
from disting.cli import main

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
        "Element",
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
        "Network",
        "Outcome",
        "ParameterIdentifiability",
        "Port",
        "Quantity",
        "Query",
        "Relation",
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
        "dampers",
        "equivalents",
        "explicit_map",
        "gate",
        "findings",
        "global_identifiability",
        "identifiability",
        "local_identifiability",
        "network_of",
        "next_experiments",
        "positive_shares",
        "prove",
        "read_models",
        "transfer_function",
        "everywhere_file",
        "values_in",
        "verdict_file",
        "verdicts",
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


ROOMS = ["fit", "measurement", "report", "simulation"]


def test_public_names():
    assert sorted(disting.__all__) == sorted(NAMES)
    assert sorted(dir(disting)) == sorted([*NAMES, *ROOMS, "__version__"])


LONGEST_HELP = 400  # lines; with all members of all names it would be 7,400
HELPFUL = (
    "", ".catalogs", ".equivalence", ".experiments", ".fit", ".general", ".measurement", ".network",
    ".decide.identifiability", ".report", ".report.fit", ".simulation",
)  # fmt: skip


@pytest.mark.thin(8)
@pytest.mark.parametrize("room", HELPFUL)
def test_help_is_short_and_has_every_public_name(room):
    module = import_module(f"disting{room}")
    text = pydoc.render_doc(module, renderer=pydoc.plaintext)
    listed = "\n".join(line for line in text.splitlines() if line.startswith(" " * 8))
    assert [name for name in module.__all__ if not re.search(rf"\b{name}\b", listed)] == []
    assert len(text.splitlines()) < LONGEST_HELP and "CLASSES" not in text


@pytest.mark.full
def test_help_of_a_fresh_process_is_as_short():
    """The public names of `disting` are offered when the first of them is used, here by pydoc."""
    code = "import pydoc, disting; print(len(pydoc.render_doc(disting).splitlines()))"
    assert int(*fresh(code)) < LONGEST_HELP


def fresh(code):
    """Words that a new process prints."""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=600
    )
    return done.stdout.split()


def test_importing_the_package_imports_none_of_its_modules():
    loaded = fresh("import sys, disting; print(*sys.modules)")
    assert [name for name in loaded if name.startswith("disting")] == ["disting"]
    assert "flint" not in loaded and "numpy" not in loaded


@pytest.mark.full
def test_the_names_leave_heavy_libraries_alone():
    loaded = fresh("import sys; from disting import *; print(*sys.modules)")
    assert "disting.verdict" in loaded
    assert not HEAVY & set(loaded)


def test_modules_are_found_below_the_package_and_other_names_are_not():
    assert fresh("import disting; print(disting.fit.__name__, disting.errors.__name__)") == [
        "disting.fit",
        "disting.errors",
    ]
    for name in ("nonsense", "_nonsense"):
        with pytest.raises(AttributeError, match=r"dir\(disting\) lists what it has"):
            getattr(disting, name)


@pytest.mark.full
def test_the_list_of_commands_is_told_without_the_libraries_of_any():
    """As are the version and a mistyped command."""
    code = "import sys; from disting.cli import main\ntry: main(['--version'])\nfinally: print(*sys.modules)"
    assert not {"numpy", "flint", "disting.verdict"} & set(fresh(code.replace("\n", "\n")))


def test_a_verdict_is_looked_up_without_what_decides_it():
    """A pair of a shipped catalogue: records of evidence are read without what checks them."""
    code = "import sys; from disting.cli import main; main(['compare', '3:1', '3:11']); print(*sys.modules)"
    loaded = fresh(code)
    assert "disting.evidence.kinds" in loaded
    decides = ("engine", "cascade", "verification")
    assert not {"numpy", *(f"disting.verdict.{name}" for name in decides)} & {*loaded}
    assert not [name for name in loaded if name.startswith(("disting.fibres.", "disting.general"))]


MOST_OF_A_FIT = 213  # modules of the package
MOST_LINES_OF_A_FIT = 41_500
NOT_FOR_A_FIT = (
    "planning", "fit.networks", "general", "experiments.measured_view", "report.page",
    "report.drawing", "catalogs.catalog", "measurement.matlab", "measurement.uff", "simulation.bench",
    "verdict.cascade", "decide.asking", "decide.same", "decide.inclusion", "fibres.ideals",
    "algebra.groebner", "measurement.welch",
)  # fmt: skip


@pytest.mark.full
def test_a_fit_loads_what_it_needs(tmp_path):
    """Of two simulated measurements, printed as text: neither a plan nor a simulation, no engine
    for networks, no page, no reader of another format, none of the parts of SciPy that take a second
    to import.
    """
    for seed in ("1", "2"):
        command = (
            *("simulate", "--samples", "1024", "--periods", "3"),
            *("--seed", seed, "--csv", str(tmp_path / f"{seed}.csv")),
        )
        assert main([*command]) == 0
    words = ["fit", str(tmp_path / "1.csv"), "--test", str(tmp_path / "2.csv"), "--masses", "2"]
    code = (
        f"import sys; from disting.cli import main; status = main({words})\n"
        "loaded = {n: m.__file__ for n, m in sys.modules.items() if n.startswith('disting')}\n"
        "lines = sum(len(open(f, encoding='utf-8').readlines()) for f in loaded.values())\n"
        "print('loaded', status, lines, *loaded, *({'scipy.signal', 'scipy.stats'} & {*sys.modules}))"
    )
    said = fresh(code)
    status, lines, *loaded = said[said.index("loaded") + 1 :]
    assert status == "0" and "disting.fit.select" in loaded
    assert len(loaded) <= MOST_OF_A_FIT and int(lines) <= MOST_LINES_OF_A_FIT
    needless = "scipy.", *(f"disting.{name}." for name in NOT_FOR_A_FIT)
    assert [name for name in loaded if f"{name}.".startswith(needless)] == []


@pytest.mark.full
def test_sympy_is_loaded_for_its_expressions_alone(tmp_path):
    """Not where formulas are written; all in one process, whose last line asks for an expression."""
    maps = "equivalents 3:4 --to 3:1 --undamped --"
    commands = (
        "models 3",
        f"{maps}formulas",
        f"{maps}latex",
        f"report 1 --undamped --out {tmp_path}",
    )
    code = (
        "import sys, disting; from disting.cli import main\n"
        f"for command in {commands}: main(command.split()); print('loaded', 'sympy' in sys.modules)\n"
        "disting.transfer_function('2:1'); print('loaded', 'sympy' in sys.modules)"
    )
    said = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=600
    ).stdout
    loaded = [line for line in said.splitlines() if line.startswith("loaded ")]
    assert loaded == ["loaded False"] * len(commands) + ["loaded True"]


def callables(room):
    """Public classes and functions of a room by name."""
    module = import_module(f"disting{room}")
    named = {name: getattr(module, name) for name in dir(module) if name[0] != "_"}
    return {n: x for n, x in named.items() if isinstance(x, (type, FunctionType))}


DOCUMENTED = (
    "", ".measurement", ".report", ".simulation", ".fit", ".equivalence", ".experiments", ".general",
    ".decide.identifiability",
)  # fmt: skip


@pytest.mark.parametrize("room", DOCUMENTED)
def test_every_public_name_has_an_example(room):
    """In its own docstring, or in that of its room, which shows them at work one after the other."""
    found, lines = callables(room), import_module(f"disting{room}").__doc__.splitlines()
    shown = "\n".join(line for line in lines if not line.startswith("    "))  # no list of names
    assert len(found) > 7
    without = [
        name
        for name, x in found.items()
        if ">>> " not in (x.__doc__ or "") and not re.search(rf"\b{name}\b", shown)
    ]
    assert without == []


def methods(kind):
    """Public functions, properties and methods that a class defines itself."""
    for name, member in vars(kind).items():
        function = getattr(member, "fget", None) or getattr(member, "__func__", member)
        if name[0] != "_" and isinstance(function, FunctionType):
            yield f"{kind.__name__}.{name}", function


@pytest.mark.thin(8)
@pytest.mark.parametrize("room", HELPFUL)
def test_no_public_function_returns_just_anything(room):
    found = callables(room)
    every = [(n, x) for n, x in found.items() if isinstance(x, FunctionType)]
    every += [pair for x in found.values() if isinstance(x, type) for pair in methods(x)]
    results = {name: f.__annotations__.get("return", Any) for name, f in every if not is_foreign(f)}
    assert [name for name, result in results.items() if result in (Any, "Any")] == []


def is_foreign(function):
    """Return True for what Python adds to classes."""
    return not (function.__module__ or "").startswith("disting")


TOTAL = {
    "": set(),
    ".measurement": {"are_opposite", "csv_text"},
    ".report": {
        "chain_svg", "damper_page", "describe", "index", "matrix_png", "matrix_svg", "network_svg",
        "page",
    },
    ".simulation": {"port_vectors"},
    ".fit": {
        "confidence", "design", "estimates", "fit_percent", "physical", "variants",
    },
    ".equivalence": {"among"},
    ".experiments": set(),
    ".general": {"as_chain", "is_explicit", "is_without", "parameter_identifiability", "without_names"},
    ".decide.identifiability": {
        "by_parameter", "confirms", "encode", "identifiabilities", "in_names_of", "joint", "local",
    },
}  # fmt: skip
"""Functions that take whatever their types allow."""


@pytest.mark.parametrize("room", DOCUMENTED)
def test_every_other_public_function_says_what_it_raises(room):
    functions = {n: x for n, x in callables(room).items() if isinstance(x, FunctionType)}
    silent = {n for n, x in functions.items() if not re.search(r"[Rr]aises|refus", x.__doc__ or "")}
    assert silent == TOTAL[room]


def test_what_they_raise_has_cause_and_remedy():
    """Of those that broke off with an error of Python before."""
    from disting.catalogs import catalog
    from disting.fit import predict, state_space, write_mat, zero_pole
    from disting.report import model_page

    chain, omega, whole = Chain(2, damped=False), np.ones(1), {"m1": 1.0, "m2": 1.0, "k12": 1.0}
    for call in (
        lambda some: predict(chain, some, omega),
        lambda some: zero_pole(chain, some),
        lambda some: state_space(chain, some),
    ):
        with pytest.raises(InputError, match="parameters m1, m2, k12 are needed, given are m1"):
            call({"m1": 1.0})
    for export in (state_space, zero_pole):
        with pytest.raises(InputError, match="sign of a sensor is 1 or -1"):
            export(chain, whole, 3)
    with pytest.raises(InputError, match="none is given"):
        write_mat(Path("model.mat"), [])
    for number in (0, 12):
        with pytest.raises(InputError, match="they are A1 to A11"):
            model_page(catalog(3, damped=True), number)


@pytest.mark.parametrize("room", ROOMS)
def test_tab_offers_no_modules(room):
    module = import_module(f"disting.{room}")
    assert not [name for name in dir(module) if isinstance(getattr(module, name), ModuleType)]
    assert dir(module) == sorted(dir(module)) and "select" in dir(disting.fit)


def offering():
    """Sources of the packages that list their public names as imports for type checkers."""
    package = Path(disting.__file__).parent
    texts = {path: path.read_text(encoding="utf-8") for path in package.rglob("__init__.py")}
    return {
        ".".join(path.relative_to(package.parent).parent.parts): text
        for path, text in texts.items()
        if "offer(__name__)" in text
    }


@pytest.mark.thin(8)
@pytest.mark.parametrize("package", sorted(offering()))
def test_names_of_a_package_are_those_that_type_checkers_see(package):
    tree = ast.parse(offering()[package])
    typed = next(node for node in tree.body if isinstance(node, ast.If))
    expected = {
        alias.asname: getattr(import_module(node.module), alias.name)
        for node in typed.body
        for alias in node.names
    }
    module = import_module(package)
    assert {name: getattr(module, name) for name in dir(module)} == expected
    rooms = ROOMS if package == "disting" else []
    assert sorted([*module.__all__, *rooms]) == sorted(expected.keys() - {"__version__"})


@pytest.mark.full
def test_a_package_offers_functions_that_are_called_as_their_modules():
    """Whichever is imported first; and its modules, but no other names."""
    code = (
        "import disting.fit.select, disting.report.fit.bode, disting.general.alternatives\n"
        "from disting.fit import select, search; from disting.general import *\n"
        "from disting.report.fit import bode\n"
        "print(*(type(x).__name__ for x in (select, alternatives, bode, search)))"
    )
    assert fresh(code) == ["function", "function", "function", "module"]
    for name in ("nonsense", "_nonsense"):
        with pytest.raises(
            AttributeError, match=r"disting\.fit has no _?nonsense; dir\(disting\.fit\)"
        ):
            getattr(disting.fit, name)
