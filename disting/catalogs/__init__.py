"""A whole family compared: built, stored, looked up, verified."""

from disting.catalogs.catalog import Catalog as Catalog
from disting.catalogs.catalog import ModelRow as ModelRow
from disting.catalogs.catalog import catalog as catalog
