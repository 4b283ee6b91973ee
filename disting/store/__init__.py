"""Settings and cache around the pure comparison."""

from disting.store.engine import Engine as Engine
from disting.store.engine import Progress as Progress
from disting.store.engine import silent as silent
from disting.store.joint import classes_safety as classes_safety
from disting.store.joint import family_safety as family_safety
from disting.store.store import CacheWarning as CacheWarning
from disting.store.store import Store as Store
from disting.verdict.decisions import Decisions as Decisions
