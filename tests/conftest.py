"""No test touches the user's cache, and examples are the same in every run; HYPOTHESIS_PROFILE=fresh draws new ones."""

import os

from hypothesis import settings

os.environ["DISTING_CACHE"] = "off"
settings.register_profile("repeatable", derandomize=True, deadline=None)  # a deadline is a time that a busy machine breaks
settings.register_profile("fresh", deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "repeatable"))


def pytest_terminal_summary(terminalreporter):
    """What the tests against independent programs compared is said whether they pass or fail."""
    reports = [report for kind in ("passed", "failed") for report in terminalreporter.stats.get(kind, [])]
    lines = [(r.nodeid, text) for r in reports if r.when == "call" for name, text in r.user_properties if name == "oracle"]
    if lines:
        terminalreporter.section("compared with independent programs")
    for nodeid, text in lines:
        terminalreporter.write_line(f"{nodeid}: {text}")
