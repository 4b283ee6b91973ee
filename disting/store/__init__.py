"""Persistence between runs: the store, the digest of the code that its answers depend on, and
workers.
"""

from disting.store.store import CacheWarning as CacheWarning, Store as Store
