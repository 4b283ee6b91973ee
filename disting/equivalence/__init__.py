"""Equivalent models with their values: what else a measured system could be, as numbers and as
formulas.
"""

from disting.equivalence.given import assignments as assignments
from disting.equivalence.given import chain_of as chain_of
from disting.equivalence.given import chains_of as chains_of
from disting.equivalence.maps import Map as Map
from disting.equivalence.maps import explicit_map as explicit_map
from disting.equivalence.result import Equivalent as Equivalent
from disting.equivalence.result import Equivalents as Equivalents
from disting.equivalence.result import Listing as Listing
from disting.equivalence.result import Origin as Origin
from disting.equivalence.result import Signs as Signs
from disting.equivalence.search import equivalents as equivalents
from disting.equivalence.words import NONE as NONE
from disting.equivalence.words import among as among
