"""Positive equivalents: which positive models of one chain have the behaviour of a positive
model of another one.
"""

from disting.questions.positive.confirmation import confirms as confirms
from disting.questions.positive.confirmation import proves as proves
from disting.questions.positive.ranges import Ranges as Ranges
from disting.questions.positive.ranges import confirms_within as confirms_within
from disting.questions.positive.ranges import ranges as ranges
from disting.questions.positive.ranges import renamings as renamings
from disting.questions.positive.ranges import within_ranges as within_ranges
from disting.questions.positive.real import always_real as always_real
from disting.questions.positive.real import confirms_real as confirms_real
from disting.questions.positive.real import real_witness as real_witness
from disting.questions.positive.shares import positive_finding as positive_finding
