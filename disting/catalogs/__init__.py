"""A whole family compared: built, stored, looked up, verified."""

from disting.catalogs.catalog import Catalog as Catalog, ModelRow as ModelRow, catalog as catalog
