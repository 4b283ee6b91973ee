"""Equivalent models with their values: what else a measured system could be, as numbers and as
formulas.
"""

from disting.equivalents.completeness import NONE as NONE
from disting.equivalents.completeness import among as among
from disting.equivalents.given import assignments as assignments
from disting.equivalents.given import chain_of as chain_of
from disting.equivalents.given import chains_of as chains_of
from disting.equivalents.listing import Equivalent as Equivalent
from disting.equivalents.listing import Equivalents as Equivalents
from disting.equivalents.listing import Listing as Listing
from disting.equivalents.listing import Origin as Origin
from disting.equivalents.listing import Signs as Signs
from disting.equivalents.maps import Map as Map
from disting.equivalents.maps import explicit_map as explicit_map
from disting.equivalents.search import equivalents as equivalents
