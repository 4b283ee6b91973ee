"""Settings and cache around the pure comparison."""

from disting.engine.decisions import Decisions as Decisions
from disting.engine.engine import Engine as Engine
from disting.engine.engine import Progress as Progress
from disting.engine.engine import silent as silent
from disting.engine.joint import classes_safety as classes_safety
from disting.engine.joint import family_safety as family_safety
from disting.engine.store import CacheWarning as CacheWarning
from disting.engine.store import Store as Store
