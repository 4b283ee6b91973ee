"""No test touches the user's cache."""

import os

os.environ["DISTING_CACHE"] = "off"
