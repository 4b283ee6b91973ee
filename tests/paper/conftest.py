"""What claims and the page are checked against, computed once for all tests that use it."""

import pytest

from tests.paper.claims import Findings


@pytest.fixture(scope="session")
def findings() -> Findings:
    """With the fit of the smaller candidates of Fig. 1 alone."""
    return Findings(sizes=(1, 2))
