"""The record of an attack."""

import pytest

from tests.attack.counts import Counts


@pytest.fixture
def counts(record_property):
    """Numbers of this attack, told in the summary as they are when the test ends."""
    found = Counts()
    record_property("attack", found)
    return found
