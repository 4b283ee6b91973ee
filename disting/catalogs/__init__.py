"""A whole family compared: built, stored, looked up, verified."""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.catalogs.catalog import Catalog as Catalog, catalog as catalog
    from disting.catalogs.pairs import ModelRow as ModelRow

offer(__name__, {"catalog": "Catalog catalog", "pairs": "ModelRow"})
