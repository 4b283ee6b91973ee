"""No test touches the user's cache, and examples are the same in every run; HYPOTHESIS_PROFILE=fresh draws new ones."""

import os

from hypothesis import settings

os.environ["DISTING_CACHE"] = "off"
settings.register_profile("repeatable", derandomize=True, deadline=None)  # a deadline is a time that a busy machine breaks
settings.register_profile("fresh", deadline=None)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "repeatable"))
