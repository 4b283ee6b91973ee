"""Which commands there are, what each is for, and which module runs it.

The arguments of a command are declared in its own module, which is imported when the command is
named: it takes longer than most commands run. Those of `fit` and `plan` stand apart from what runs
them, which loads libraries that help needs not.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any


@dataclass(frozen=True, slots=True)
class Command:
    """`text` says in a list of commands what `run` of its module does with the options; `add`
    declares its arguments, in the same module if no other one is named. Of a command with many
    options `brief` names the few lines that `--help` shows, beside them; the rest is behind
    `--help-all`.
    """

    name: str
    text: str
    module: str
    run: str = "run"
    add: str = "add_arguments"
    arguments: str = ""
    brief: str = ""

    def work(self) -> Callable[[argparse.Namespace], int]:
        """What runs it, imported."""
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
    "build, settle or verify them",
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
            "compute what to measure next for all groups that one measurement cannot tell apart",
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
    "look at or empty the cache",
    "The cache of profiles and verdicts.",
    (
        Command("info", "where the cache is and what it holds", "upkeep", "cache_info", ""),
        Command("clear", "remove all entries", "upkeep", "cache_clear", ""),
    ),
)
COMMANDS = (
    Command(
        "models",
        "the numbered list of all models of one size, or your own models in a file",
        "models",
    ),
    Command("compare", "one verdict, explained", "compare"),
    Command(
        "verify",
        "whether one verdict holds, checked anew from its evidence alone",
        "verify",
    ),
    Command(
        "verdicts",
        "all pairs of one size, of several sizes together, or of your own models in a file",
        "verdicts",
    ),
    Command(
        "equivalents",
        "all parameters of other models with the same transfer function",
        "equivalents",
    ),
    Command(
        "next",
        "what to measure next to tell structures apart that look the same",
        "next",
    ),
    Command(
        "fit",
        "the structures that explain a measured frequency response",
        "fit",
        arguments="fit_arguments",
        brief="BRIEF",
    ),
    Command(
        "look",
        "what is read from a measured file, and what is assumed of it; fits nothing",
        "look",
        add="add_look_arguments",
        arguments="fit_arguments",
    ),
    Command(
        "plan",
        "how much measuring tells two structures apart",
        "plan",
        arguments="plan_arguments",
    ),
    Command(
        "report",
        "HTML pages, figures and tables of whole catalogues, or of your own models in a file",
        "report",
    ),
    Command("draw", "the drawing of a model, as SVG or PNG", "draw"),
    CATALOG,
    Command(
        "simulate",
        "what a bench would measure on a chain with known parameters",
        "simulate",
    ),
    Command(
        "dampers",
        "which sets of dampers to the ground of one model can be told apart",
        "dampers",
    ),
    Command(
        "schema",
        "what is in the JSON files that disting writes, as JSON Schema",
        "upkeep",
        "print_schema",
        "add_schema_arguments",
    ),
    CACHE,
    Command("doctor", "what is installed, and what else would help", "upkeep", "doctor", ""),
)
