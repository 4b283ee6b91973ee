"""A whole family compared: built, stored, looked up, verified."""

from typing import TYPE_CHECKING

from disting.lazy import offer

if TYPE_CHECKING:
    from disting.catalogs.catalog import Catalog as Catalog, catalog as catalog
    from disting.catalogs.pairs import ModelRow as ModelRow

offer(__name__, {"catalog": "Catalog catalog", "pairs": "ModelRow"})
