"""Which signals of a record are input and output, from their names."""

import re
from collections.abc import Iterable

from disting.errors import InputError, listed

WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])")
INPUTS = {
    "u",
    "input",
    "torque",
    "force",
    "current",
    "iq",
    "i",
    "tau",
    "trq",
    "moment",
    "strom",
    "kraft",
    "drehmoment",
    "eingang",
}
OUTPUTS = {
    "y", "output", "position", "pos", "theta", "phi", "angle", "q", "x", "speed", "velocity", "vel",
    "omega", "acceleration", "acc", "weg", "lage", "winkel", "drehzahl", "geschwindigkeit",
    "beschleunigung", "ausgang",
}  # fmt: skip
# not what was measured
ASKED_FOR = {"ref", "reference", "set", "setpoint", "cmd", "command", "desired", "soll", "target"}
CLOCKS = {"t", "time", "zeit", "timestamp"}


def guessed(names: Iterable[str], origin: str) -> tuple[str, str, str]:
    """Names of input and output, and a note that says so; raises InputError listing the names
    where more or fewer fit.

    >>> guessed(["t", "iq [A]", "iq_ref", "theta"], "a.csv")[:2]
    ('iq [A]', 'theta')
    """
    known = list(names)
    words = {
        name: {word.lower() for word in WORD.findall(name.partition("[")[0])} for name in known
    }
    measured = [name for name in known if not words[name] & (ASKED_FOR | CLOCKS)]
    inputs, outputs = (
        [name for name in measured if words[name] & kind] for kind in (INPUTS, OUTPUTS)
    )
    if len(inputs) != 1 or len(outputs) != 1 or inputs == outputs:
        raise InputError(
            f"{origin}: which signal is the input, which the output? give --read"
            f" input=NAME --read output=NAME; there are {listed(sorted(known))}"
        )
    return (
        inputs[0],
        outputs[0],
        (
            f"input taken as {inputs[0]}, output as {outputs[0]}, by their names; if not, give"
            " --read input=NAME --read output=NAME"
        ),
    )
