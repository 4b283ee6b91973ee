"""The suite in a fresh environment with the lowest versions that pyproject.toml promises, or with
the newest.

    python tests/attack/lowest_versions.py [--python PYTHON] [--newest] [--keep FOLDER] [PYTEST
    ARGUMENTS]

Every lower bound is pinned with ==, so a bound that cannot be installed together with the others
fails here. Without arguments for pytest all default tests run. PYTHON is an interpreter; the
lowest versions need one that their wheels were built for.
"""

import argparse
import re
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
REQUIREMENT = re.compile(r"([\w.-]+)(?:\[[\w,]+\])?>=([\w.]+)")


def pins() -> list[str]:
    """Every requirement of the package, of its extras and of its tests, at its lower bound.

    Raises ValueError for a requirement without a lower bound.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = [
        r
        for name, group in project["optional-dependencies"].items()
        if name != "dev"
        for r in group
    ]
    return sorted(set(map(_pinned, (*project["dependencies"], *extras))))


def _pinned(requirement: str) -> str:
    match = REQUIREMENT.fullmatch(requirement)
    if not match:
        raise ValueError(f"{requirement} has no lower bound, or more than that")
    return f"{match[1]}=={match[2]}"


def environment(folder: Path, python: str, newest: bool) -> Path:
    """Make an environment in `folder`, install the package as a wheel, and give its interpreter.

    Raises CalledProcessError where the versions cannot be had together.
    """
    subprocess.run([python, "-m", "venv", folder], check=True, timeout=600)
    inside = folder / ("Scripts" if sys.platform == "win32" else "bin") / "python"
    chosen = [] if newest else pins()
    package = f"{ROOT}[control,dask,hdf5,swarm,uff,test]"
    subprocess.run(
        [inside, "-m", "pip", "install", "-q", "--prefer-binary", package, *chosen],
        check=True,
        timeout=600,
    )
    # away from the checkout: the wheel's own files
    alone = {"DISTING_CACHE": str(folder / "cache.sqlite3")}
    subprocess.run(
        [inside, "-m", "disting", "compare", "3:2", "3:5"],
        check=True,
        cwd=folder,
        env=alone,
        timeout=600,
    )
    return inside


def run(python: str, newest: bool, keep: Path | None, arguments: list[str]) -> int:
    """The exit status of pytest in a fresh environment."""
    with tempfile.TemporaryDirectory() as name:
        inside = environment(keep or Path(name) / "venv", python, newest)
        command = [inside, "-m", "pytest", "-q", "-n", "0", "-p", "no:cacheprovider", *arguments]
        return subprocess.run(command, cwd=ROOT, check=False, timeout=600).returncode


def main() -> int:
    """Install, run, and give pytest's exit status."""
    parser = argparse.ArgumentParser(
        description="Run the tests with the lowest versions that are promised."
    )
    parser.add_argument("--python", default=sys.executable, help="interpreter (default: this one)")
    parser.add_argument(
        "--newest", action="store_true", help="newest versions instead of the lowest"
    )
    parser.add_argument(
        "--keep", type=Path, help="folder for the environment (default: one that is removed)"
    )
    options, arguments = parser.parse_known_args()
    return run(options.python, options.newest, options.keep, arguments)


if __name__ == "__main__":
    sys.exit(main())
