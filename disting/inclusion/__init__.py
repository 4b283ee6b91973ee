"""One-sided inclusion: whether the models of one chain are models, or limits of models, of another one of larger rank.

`decide` compares chains of one size and sends those of different sizes to `across_sizes`; `finding` holds what is found and its
text form, `verify` checks it again.
"""

from disting.inclusion.decide import INCLUDED as INCLUDED
from disting.inclusion.decide import by_rank as by_rank
from disting.inclusion.decide import inclusion_finding as inclusion_finding
from disting.inclusion.decide import quick_inclusion as quick_inclusion
from disting.inclusion.finding import Inclusion as Inclusion
from disting.inclusion.finding import InclusionFinding as InclusionFinding
from disting.inclusion.finding import Sense as Sense
from disting.inclusion.finding import inclusion_from_dict as inclusion_from_dict
from disting.inclusion.finding import inclusion_to_dict as inclusion_to_dict
from disting.inclusion.verify import confirms as confirms
