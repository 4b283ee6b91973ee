"""The command line as somebody types it."""

import pytest

from disting.cli import main


def run_command(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """Output of a command that ends well."""
    capsys.readouterr()
    assert main([*words]) == 0
    return capsys.readouterr().out
