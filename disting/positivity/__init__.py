"""Positive equivalents: which positive models of one chain have the behaviour of a positive
model of another one.
"""

from disting.positivity.finding import positive_finding as positive_finding
from disting.positivity.ranges import Ranges as Ranges
from disting.positivity.ranges import confirms_within as confirms_within
from disting.positivity.ranges import ranges as ranges
from disting.positivity.ranges import renamings as renamings
from disting.positivity.ranges import within_ranges as within_ranges
from disting.positivity.real import always_real as always_real
from disting.positivity.real import confirms_real as confirms_real
from disting.positivity.real import real_witness as real_witness
from disting.positivity.verify import confirms as confirms
from disting.positivity.verify import proves as proves
