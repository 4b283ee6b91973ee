"""Table of the commands: the purpose of each and the module that runs it.

The arguments of a command are declared in its own module, which is imported when the command is
named: it takes longer than most commands run. Those of `fit` and `plan` are separate from the code
that runs them, which loads libraries that help does not need.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any


@dataclass(frozen=True, slots=True)
class Command:
    """`text` describes in a list of commands what `run` of its module does; `add` declares its
    arguments, in the same module if no other one is named. Of a command with many options `brief`
    names the few lines that `--help` shows in addition; `--help-all` shows the rest. `examples`:
    lines that work as they are, at the end of its help; FIT.json in them is a file of a fit.
    """

    name: str
    text: str
    module: str
    run: str = "run"
    add: str = "add_arguments"
    arguments: str = ""
    brief: str = ""
    examples: tuple[str, ...] = ()

    def work(self) -> Callable[[argparse.Namespace], int]:
        """Import the function that runs the command."""
        return self._of(self.module, self.run)

    def declare(self, parser: argparse.ArgumentParser) -> None:
        """Add its arguments to its parser."""
        if self.add:
            self._of(self.arguments or self.module, self.add)(parser)

    def brief_help(self) -> str:
        """Its help in brief; "" where there is none."""
        if not self.brief:
            return ""
        text: str = getattr(import_module(f"disting.cli.{self.arguments}"), self.brief)
        return text

    @staticmethod
    def _of(module: str, name: str) -> Callable[..., Any]:
        function: Callable[..., Any] = getattr(import_module(f"disting.cli.{module}"), name)
        return function


@dataclass(frozen=True, slots=True)
class Group:
    """Commands behind one name."""

    name: str
    text: str
    description: str
    commands: tuple[Command, ...]


CATALOG = Group(
    "catalog",
    "rebuild or verify the shipped verdicts (for maintainers)",
    "Precomputed catalogues.",
    (
        Command(
            "build",
            "compute catalogues, undamped and damped",
            "catalogs",
            "build",
            "add_build_arguments",
        ),
        Command(
            "candidates",
            "compute the verdicts on all pairs of a fit's 120 candidates",
            "catalogs",
            "candidates",
            "add_candidates_arguments",
        ),
        Command(
            "dampers",
            "compute whole families with all sets of dampers to the ground, by classes",
            "dampers",
            "build",
            "add_build_arguments",
        ),
        Command(
            "families",
            "compute the verdicts on families of networks",
            "catalogs",
            "families",
            "add_families_arguments",
        ),
        Command(
            "next",
            "compute what to measure next for all groups that one measurement cannot distinguish",
            "catalogs",
            "menus",
            "add_menus_arguments",
        ),
        Command(
            "sizes",
            "compute the verdicts on pairs of models of different sizes, 1 to 5 masses",
            "catalogs",
            "sizes",
            "add_sizes_arguments",
        ),
        Command(
            "settle",
            "decide pairs of classes with dampers to the ground that are open, to be shipped",
            "catalogs",
            "settle",
            "add_settle_arguments",
        ),
        Command(
            "verify",
            "rebuild catalogues, compare bytes, and check every evidence anew",
            "catalogs",
            "verify",
            "add_verify_arguments",
        ),
    ),
)
CACHE = Group(
    "cache",
    "show or empty the cache",
    "The cache of profiles and verdicts.",
    (
        Command("info", "where the cache is and what it holds", "upkeep", "cache_info", ""),
        Command("clear", "remove all entries", "upkeep", "cache_clear", ""),
    ),
)
LOOK = Command(
    "look",
    "show how a file is read; fit nothing",
    "look",
    add="add_look_arguments",
    arguments="fit_arguments",
    examples=("disting look --demo", "disting look bench.csv --quantity velocity"),
)
FIT = Command(
    "fit",
    "find the structures that explain a measured frequency response",
    "fit",
    arguments="fit_arguments",
    brief="BRIEF",
)
PLAN = Command(
    "plan",
    "compute how long to measure to distinguish two structures",
    "plan",
    arguments="plan_arguments",
    examples=(
        "disting plan 2:1+b1 2:1+b2 --set m1=0.01,m2=0.02,k12=500,d12=0.1,b1=0.05 --noise 0.02"
        " --band 5..300",
        "disting plan FIT.json",
    ),
)
SCHEMA = Command(
    "schema",
    "describe the JSON files that disting writes, as JSON Schema",
    "upkeep",
    "print_schema",
    "add_schema_arguments",
)
APP = Command(
    "app",
    "open a page in the browser: read a measured file, fit it",
    "app",
    examples=("disting app", "disting app bench --port 8000 --no-browser"),
)
SECTIONS: dict[str, tuple[Command | Group, ...]] = {
    "measure and fit": (
        APP,
        LOOK,
        FIT,
        Command(
            "next",
            "find the experiment that distinguishes structures with the same response",
            "next",
            examples=("disting next 3:1 3:11", "disting next FIT.json"),
        ),
        PLAN,
        Command(
            "simulate",
            "simulate a measurement of a model with known values",
            "simulate",
            examples=(
                "disting simulate 2:1+b1 --set m1=0.01,m2=0.02,k12=500,d12=0.1,b1=0.05"
                " --output-noise 1e-6 --csv bench.csv",
            ),
        ),
    ),
    "models": (
        Command(
            "models",
            "list the models of one size, or your own models in a file",
            "models",
            examples=("disting models 3", "disting models 'R0-p(R1,C1)'"),
        ),
        Command(
            "compare",
            "decide whether two models can be distinguished",
            "compare",
            examples=(
                "disting compare 3:1 3:11",
                "disting compare 3:1 3:11 --also sensor=2",
                "disting compare 'R0-p(R1,C1)' 'p(R0,R1-C1)'",
            ),
        ),
        Command(
            "equivalents",
            "find all parameters of other models with the same transfer function",
            "equivalents",
            examples=(
                "disting equivalents 3:1 --to 3:11 --undamped --set m1=1,m2=2,m3=3,k12=100,k23=70",
                "disting equivalents 3:1 --to 3:11 --formulas",
            ),
        ),
        Command(
            "verdicts",
            "decide all pairs of one size, several sizes, or a file",
            "verdicts",
            examples=("disting verdicts 3", "disting verdicts 3 --csv verdicts.csv"),
        ),
        Command(
            "verify",
            "check a verdict again from its evidence",
            "verify",
            examples=("disting verify 3:1 3:11",),
        ),
        Command(
            "dampers",
            "decide between sets of ground dampers of one model",
            "dampers",
            examples=("disting dampers 3:1",),
        ),
        Command(
            "draw",
            "draw a model as SVG or PNG",
            "draw",
            examples=("disting draw 3:4 --svg drawing.svg",),
        ),
        Command(
            "report",
            "write HTML pages, figures and tables",
            "report",
            examples=("disting report 3",),
        ),
    ),
    "maintenance": (
        CATALOG,
        CACHE,
        SCHEMA,
        Command("doctor", "show what is installed, and what is missing", "upkeep", "doctor", ""),
    ),
}
"""The commands as `disting --help` groups them."""
COMMANDS = tuple(command for section in SECTIONS.values() for command in section)
