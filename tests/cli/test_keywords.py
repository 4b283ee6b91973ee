"""Every option of the command line has a Python keyword of the same name: the public function that
takes it, or the reason why there is none.
"""

import argparse
import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from typing import get_type_hints

import pytest

from disting.cli.run import parser

# options of any command
WORK = "needed by the command line alone: Python takes engine=, executor= and progress="
FORM = "form of the output; an object in Python has them all"
WRITE = "writes what the function returns; in Python its to_dict(), to_csv() or a function write_.."
ANYWHERE = {
    "--no-cache": WORK,
    "--jobs": WORK,
    "--scheduler": WORK,
    "--json": WRITE,
    "--csv": WRITE,
    "--out": WRITE,
    "--help-all": FORM,
    "--version": FORM,
}
MAINTENANCE = "the data that are shipped, in a checkout"
READ = ("--column", "--quantity", "--unit", "--scale", "--torque-constant", "--hold", "--outliers")
ONE_BY_ONE = "NAME=VALUE of the reader, a keyword each, such as input= and sampling_rate="
DEMO = "disting.simulation.demo() gives these data"
SECOND = "a list of Setup(sensor=..) for FurtherResponse, each read from its file"
# of each command: the functions with the options that they take as keywords, and the exemptions
TABLE: dict[str, tuple[dict[str, tuple[str, ...]], dict[str, str]]] = {
    "compare": (
        {
            "disting.compare": ("--damped", "--quantity", "--conditions", "--domain", "--prove"),
            "disting.compare_everywhere": ("--also",),
            "disting.positive_shares": ("--bound",),
            "disting.network_of": ("--notation",),
        },
        {},
    ),
    "equivalents": (
        {
            "disting.equivalents": ("--damped", "--to", "--also"),
            "disting.network_of": ("--notation",),
        },
        {
            "--family": 'to="circuits-5"',
            "--set": "the argument values; set is a name of Python",
            "--formulas": "disting.explicit_map gives them",
            "--latex": FORM,
            "--sympy": FORM,
        },
    ),
    "verdicts": (
        {
            "disting.verdicts": (
                *("--damped", "--quantity", "--conditions", "--domain", "--prove"),
                *("--representation", "--markov"),
            )
        },
        {},
    ),
    "verify": (
        {
            "disting.verdict_file": (
                *("--damped", "--quantity", "--conditions", "--domain", "--prove"),
            ),
            "disting.everywhere_file": ("--also",),
            "disting.network_of": ("--notation",),
        },
        {},
    ),
    "models": (
        {
            "disting.identifiability": ("--damped", "--also", "--domain"),
            "disting.network_of": ("--notation",),
        },
        {
            "--identifiability": "the function disting.identifiability",
            "--ranks": "a column of the table; Identifiability.rank in Python",
        },
    ),
    "app": ({}, {"--port": WORK, "--no-browser": WORK}),
    "dampers": ({"disting.dampers": ("--damped", "--sets", "--domain")}, {}),
    "draw": (
        {"disting.Family": ("--damped", "--quantity"), "disting.network_of": ("--notation",)},
        {
            "--svg": "disting.report.chain_svg and network_svg",
            "--png": "disting.report.chain_png and network_png",
        },
    ),
    "report": (
        {"disting.catalog": ("--damped",)},
        {"--both": "catalogues of both kinds in the list of write_report"},
    ),
    "next": (
        {
            "disting.next_experiments": ("--damped", "--cost"),
            "disting.network_of": ("--notation",),
        },
        {},
    ),
    "plan": (
        {
            "disting.fit.plan": ("--noise", "--band", "--lines", "--repeats"),
            "disting.Family": ("--damped",),
            "disting.network_of": ("--notation",),
        },
        {"--set": "the argument values; set is a name of Python"},
    ),
    "simulate": (
        {
            "disting.simulation.simulate": ("--excitation",),
            "disting.simulation.Excitation": ("--low", "--high", "--rms", "--spectrum"),
            "disting.simulation.Bench": (
                *("--sampling-rate", "--samples", "--periods", "--seed"),
                *("--input-noise", "--output-noise", "--quantum", "--friction"),
            ),
            "disting.Family": ("--damped", "--quantity"),
            "disting.network_of": ("--notation",),
        },
        {
            "--set": "the argument values; set is a name of Python",
            "--response": "the method TimeSeries.response(quantity)",
        },
    ),
    "look": (
        {"disting.measurement.look": (*READ, "--repeat", "--sign")},
        {
            "--sensor": SECOND,
            "--experiment": SECOND,
            "--demo": DEMO,
            "--read": ONE_BY_ONE,
            "--band": "one of changes=, the method FrequencyResponse.masked(low, high)",
            "--lines": "one of changes=, the method FrequencyResponse.thinned(count)",
        },
    ),
    "fit": (
        {
            "disting.fit.select": (
                *("--test", "--quantity", "--band", "--lines", "--dead-time", "--sign", "--fix"),
                *("--bound", "--no-prune", "--case", "--weights", "--thresholds", "--rule"),
                *("--optimiser", "--seed", "--controller"),
            ),
            "disting.fit.candidates": (
                *("--masses", "--actuator", "--sensor", "--gap", "--family", "--base", "--damped"),
            ),
            "disting.fit.fit_networks": ("--models", "--notation", "--ground-damper"),
            "disting.measurement.read": (*(o for o in READ if o != "--quantity"), "--repeat"),
            "disting.report.fit.write_fit_report": ("--profiles", "--site"),
        },
        {
            "--experiment": SECOND,
            "--demo": DEMO,
            "--read": ONE_BY_ONE,
            "--left": "candidates= and home= from the members of the earlier Selection",
        },
    ),
    "schema": ({}, {}),
    "doctor": ({}, {}),
    "cache info": ({}, {}),
    "cache clear": ({}, {}),
    **{
        f"catalog {action}": (
            {},
            dict.fromkeys(["--catalog", "--search-open", "--resume"], MAINTENANCE),
        )
        for action in ("settle", "verify")
    },
    **{
        f"catalog {action}": ({}, {})
        for action in ("build", "candidates", "dampers", "families", "next", "sizes")
    },
    **{group: ({}, {}) for group in ("", "catalog", "cache")},
}
ONE_KEYWORD = {"--undamped": "--damped"}  # two options that are the values of one keyword
OPTIONLESS = {
    "catalog settle": {"--search-open", "--resume"}
}  # entries that only the other command has


def options(of: argparse.ArgumentParser, name: str = "") -> Iterator[tuple[str, set[str]]]:
    """Every command with its visible options by their long names."""
    own = set[str]()
    for action in of._actions:
        if isinstance(action, argparse._SubParsersAction):
            for word, inner in action.choices.items():
                yield from options(inner, f"{name} {word}".strip())
        elif action.option_strings and action.help != argparse.SUPPRESS:
            own.add(action.option_strings[-1])
    yield name, own - {"--help"}


COMMANDS = {name: {ONE_KEYWORD.get(o, o) for o in own} for name, own in options(parser())}


def keyword(option: str) -> str:
    """The keyword of an option: --no-prune is prune=False."""
    return option.removeprefix("--").removeprefix("no-").replace("-", "_")


def taken(command: str) -> Iterator[tuple[str, str]]:
    """The functions of a command, each with its options."""
    for path, own in TABLE.get(command, ({}, {}))[0].items():
        yield from ((path, option) for option in own)


@pytest.mark.parametrize("command", COMMANDS)
def test_an_option_is_a_keyword_or_says_why_not(command):
    exempt = set(TABLE[command][1]) - OPTIONLESS.get(command, set())
    named = [option for _, option in taken(command)]
    assert len(set(named)) == len(named) and not exempt & set(named), "named twice"
    assert COMMANDS[command] - ANYWHERE.keys() == exempt | set(named)


def test_a_new_option_is_missing_from_the_table():
    """The test above fails for an option without an entry."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(COMMANDS, "draw", COMMANDS["draw"] | {"--colour"})
        with pytest.raises(AssertionError, match="--colour"):
            test_an_option_is_a_keyword_or_says_why_not("draw")


@pytest.mark.thin(8)
@pytest.mark.parametrize(
    ("path", "option"), sorted({each for command in TABLE for each in taken(command)})
)
def test_the_public_function_takes_it_with_a_type_and_says_what_it_is(path, option):
    room, _, name = path.rpartition(".")
    module = import_module(room)
    assert name in dir(module), f"{path} is not public"
    function, word = getattr(module, name), keyword(option)
    parameters = inspect.signature(function).parameters
    rest = next((p for p in parameters.values() if p.kind is p.VAR_KEYWORD), None)
    if word in parameters:
        assert parameters[word].annotation is not inspect.Parameter.empty
    else:
        assert rest is not None and word in get_type_hints(rest.annotation.__args__[0])
    assert is_explained(function, word, module)


def is_explained(function, word, module):
    """The docstring names it, or says that arguments are those of another function that does."""
    doc = " ".join((function.__doc__ or "").split())
    others = re.findall(r"(?:those of|as of|as for) `(\w+)`", doc)
    return f"`{word}`" in doc or any(is_explained(getattr(module, o), word, module) for o in others)
