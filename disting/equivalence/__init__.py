"""Equivalent models with their values: what else a measured system could be, as numbers and as
formulas.
"""

from disting.equivalence.duplicates import Gate as Gate
from disting.equivalence.duplicates import gate as gate
from disting.equivalence.inputs import assignments as assignments
from disting.equivalence.inputs import chains_of as chains_of
from disting.equivalence.listing import NONE as NONE
from disting.equivalence.listing import Equivalent as Equivalent
from disting.equivalence.listing import Equivalents as Equivalents
from disting.equivalence.listing import Listing as Listing
from disting.equivalence.listing import Origin as Origin
from disting.equivalence.listing import Signs as Signs
from disting.equivalence.listing import among as among
from disting.equivalence.maps import Map as Map
from disting.equivalence.maps import explicit_map as explicit_map
from disting.equivalence.search import equivalents as equivalents
