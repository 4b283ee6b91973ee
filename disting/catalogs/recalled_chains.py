"""What a catalogue of chains holds on their identifiability, made known to an engine."""

from disting.catalogs.catalog import Catalog
from disting.model.symmetry import canonical
from disting.questions.identifiability.analysis import IDENTIFIABILITY, rename
from disting.verdict.engine import Engine


def recall_chains(of: Catalog, engine: Engine) -> None:
    """Let the engine know the identifiability of all chains, over complex parameters; nothing if
    its settings are others.

    >>> from disting.catalogs import catalog
    >>> recall_chains(catalog(2, damped=True), Engine())
    """
    if of.record(0)["settings"] != engine.settings.to_dict():
        return
    for row in of.rows:
        form = canonical(of.family[row.number])
        found = rename(row.identifiability, form.renaming, form.chain)
        engine.remember(IDENTIFIABILITY, (form.chain,), found)
