"""A whole family compared: built, stored, looked up, verified.

The names:

    catalog    the shipped verdicts on all chains of a size
    Catalog    its matrix, classes and verdicts
    ModelRow   a model with its rank and its group
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.catalogs.catalog import (
        Catalog as Catalog,
        ModelRow as ModelRow,
        catalog as catalog,
    )

offer(__name__)
