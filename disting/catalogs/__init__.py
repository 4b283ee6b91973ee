"""A whole family compared: built, stored, looked up, verified."""

from disting.catalogs.catalog import Catalog as Catalog, catalog as catalog
from disting.catalogs.pairs import ModelRow as ModelRow
