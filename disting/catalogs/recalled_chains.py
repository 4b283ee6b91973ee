"""Identifiability of chains over complex parameters, recalled from a catalogue: passed to an
engine, and converted to positive parameters.
"""

from functools import lru_cache

from disting.catalogs.catalog import Catalog, ModelRow
from disting.decide.identifiability.analysis import IDENTIFIABILITY, rename
from disting.decide.identifiability.answer import Identifiability
from disting.model.chain import Chain
from disting.model.question import Domain
from disting.model.symmetry import canonical
from disting.verdict.engine import Engine
from disting.verdict.identifiable import identify_chain


def recall_chains(of: Catalog, engine: Engine) -> None:
    """Let the engine know the identifiability of all chains, over complex parameters; nothing if
    its settings are others.

    >>> from disting.catalogs import catalog
    >>> recall_chains(catalog(2, damped=True), Engine())
    """
    if of.record(0)["settings"] != engine.settings.to_dict():
        return
    for row in of.rows:
        _remember(row.chain, row.identifiability, engine)


def over_positive(row: ModelRow) -> Identifiability:
    """The identifiability of a chain of a catalogue over positive parameters.

    >>> from disting.catalogs import catalog
    >>> over_positive(catalog(3, damped=True).rows[3]).level.value
    'up to exchanges'
    """
    return _over_positive(row.chain, row.identifiability)


@lru_cache(maxsize=256)
def _over_positive(chain: Chain, found: Identifiability) -> Identifiability:
    engine = Engine()
    _remember(chain, found, engine)
    return identify_chain(chain, Domain.POSITIVE, engine)


def _remember(chain: Chain, found: Identifiability, engine: Engine) -> None:
    form = canonical(chain)
    engine.remember(IDENTIFIABILITY, (form.chain,), rename(found, form.renaming, form.chain))
