"""External programs for Gröbner bases, used where they are found and never needed: msolve and
Singular.

They are called as programs, on text files, in a process group that is killed at the time limit.
Both compute modulo primes of up to 31 bits. Of their answers only "the basis is [1]" is believed,
and only as far as one prime of that size goes (`bounds.safety_of_empty` with its bits); everything
else, failures included, counts as not empty or unknown.
"""

import os
import re
import shutil
import signal
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from disting.algebra.groebner.modular import Sparse
from disting.fibres.ideals.fibre_ideal import FibreIdeal
from tests.oracles.rational import Emptiness

PROGRAM_BITS = 31


@dataclass(frozen=True, slots=True)
class Program:
    """An external program: its `name` on the PATH, what it `brings`, its command line, input,
    and reading of its output.
    """

    name: str
    brings: str
    version: tuple[str, ...]
    command: Callable[[str, Path, Path], list[str]]
    text: Callable[[FibreIdeal], str]
    is_one: Callable[[str], bool]

    @property
    def path(self) -> str | None:
        """Where it is, if it is."""
        return shutil.which(self.name)


def msolve_text(ideal: FibreIdeal) -> str:
    """Variables, characteristic, polynomials."""
    names = _names(ideal)
    body = ",\n".join(_written(g, names) for g in ideal.generators)
    return f"{','.join(names)}\n{ideal.modulus}\n{body}\n"


def singular_text(ideal: FibreIdeal) -> str:
    """A script that prints [1] exactly if the reduced basis is 1."""
    names = _names(ideal)
    body = ",\n".join(_written(g, names) for g in ideal.generators)
    return (
        f"ring r = {ideal.modulus}, ({','.join(names)}), dp;\noption(redSB);\nideal i ="
        f' {body};\nideal g = slimgb(i);\nif (size(g) == 1 and g[1] == 1) {{ print("[1]"); }}'
        ' else { print("[0]"); }\nquit;\n'
    )


MSOLVE = Program(
    "msolve",
    "fibres of 5 and more masses, faster; an indication, as 31-bit primes give no error bound"
    " there",
    ("-V",),
    lambda path, source, target: [path, "-g", "2", "-f", str(source), "-o", str(target)],
    msolve_text,
    lambda text: re.sub(r"\s|#[^\n]*\n", "", text).startswith("[1]"),
)
SINGULAR = Program(
    "Singular",
    "a second opinion on fibres modulo small primes",
    ("--version",),
    lambda path, source, target: [path, "-q", str(source)],
    singular_text,
    lambda text: text.lstrip().startswith("[1]"),
)
PROGRAMS: tuple[Program, ...] = (MSOLVE, SINGULAR)


def installed() -> list[tuple[str, str, str]]:
    """(name, version or "" where it is not found, what it would bring) of each program."""
    return [(p.name, _version(p), p.brings) for p in PROGRAMS]


def emptiness(program: Program, ideal: FibreIdeal, seconds: float) -> tuple[Emptiness, str]:
    """What the program says about the ideal, and why it is not known."""
    path = program.path
    if path is None:
        return Emptiness.UNKNOWN, f"{program.name} is not installed"
    if ideal.modulus.bit_length() > PROGRAM_BITS:
        return Emptiness.UNKNOWN, f"{program.name} takes primes of up to {PROGRAM_BITS} bits"
    with TemporaryDirectory() as folder:
        source, target = Path(folder, "in"), Path(folder, "out")
        source.write_text(program.text(ideal))
        status, printed = _called(program.command(path, source, target), seconds)
        answer = target.read_text() if target.exists() else printed
    if status != 0:
        return (
            Emptiness.UNKNOWN,
            f"{program.name}: {'out of time' if status is None else f'exit status {status}'}",
        )
    return (Emptiness.EMPTY, "") if program.is_one(answer) else (Emptiness.NOT_EMPTY, "")


def _called(command: Sequence[str], seconds: float) -> tuple[int | None, str]:
    """Exit status (None: killed at the limit) and standard output."""
    process = subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    )
    try:
        out, _ = process.communicate(timeout=seconds)
        return process.returncode, out
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, ""


def _version(program: Program) -> str:
    if program.path is None:
        return ""
    status, out = _called([program.path, *program.version], 10.0)
    numbers = re.findall(r"\d+(?:\.\d+)+", out)
    return numbers[0] if numbers else ("found" if status is not None else "")


def _names(ideal: FibreIdeal) -> list[str]:
    return [f"x{i}" for i in range(len(ideal.unknowns))]


def _written(polynomial: Sparse, names: Sequence[str]) -> str:
    terms = []
    for exponents, number in polynomial.items():
        powers = [f"{n}^{e}" if e > 1 else n for n, e in zip(names, exponents, strict=True) if e]
        terms.append("*".join([str(number), *powers]))
    return "+".join(terms)
