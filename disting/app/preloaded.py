"""Imports of all workers of calls: a server of forks imports this module once and forks the workers
from itself, so that none of them imports again (Linux; elsewhere each imports for itself).
"""

from importlib import import_module

from disting.app.interface import CALLS

LIBRARIES = ("numpy", "networkx", "scipy.optimize")  # loaded late

for name in LIBRARIES:
    import_module(name)
for call in CALLS.values():
    call.load()
