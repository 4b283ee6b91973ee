"""Runs scripts of the computer algebra system Singular, where it is installed: an independent
program for the tests.
"""

import shutil
import subprocess

PROGRAM = shutil.which("Singular")
# 2^31 - 1, the largest characteristic that Singular takes; no prime of the package has so few bits
PRIME = 2147483647


def answers(script: str, seconds: float) -> dict[str, str] | None:
    """Lines `@name value` of the output by name; None if the time is up. Raises RuntimeError
    where Singular complains.
    """
    assert PROGRAM, "Singular is not installed"
    try:
        done = subprocess.run(
            [PROGRAM, "-q", "--no-rc"],
            input=script + "\nquit;\n",
            capture_output=True,
            text=True,
            timeout=seconds,
        )
    except subprocess.TimeoutExpired:
        return None
    if "? " in done.stdout or done.returncode:
        raise RuntimeError(f"{done.stdout}\n{done.stderr}\n{script}")
    lines = (
        line[1:].split(maxsplit=1) for line in done.stdout.splitlines() if line.startswith("@")
    )
    return {line[0]: line[1].strip() if len(line) > 1 else "" for line in lines}


def printed(name: str, expression: str) -> str:
    """A statement that prints one answer."""
    return f'print("@{name} " + string({expression}));'
