"""Engine B of the exact decision: the fibre of one model over a generic point of another as a
polynomial ideal.

For any two models that are given as coefficient maps, not only chains; chains with a gap are taken
apart first (`by_parts`). Independent of `disting.synthesis`.
"""

from disting.ideals.by_parts import PartsDecision as PartsDecision
from disting.ideals.by_parts import confirms_by_parts as confirms_by_parts
from disting.ideals.by_parts import decide_by_parts as decide_by_parts
from disting.ideals.by_parts import included_by_parts as included_by_parts
from disting.ideals.by_parts import refuted_by_parts as refuted_by_parts
from disting.ideals.by_rows import confirms_row as confirms_row
from disting.ideals.by_rows import differ_by_row as differ_by_row
from disting.ideals.by_shares import chains_told_apart as chains_told_apart
from disting.ideals.decide import Decision as Decision
from disting.ideals.decide import Limits as Limits
from disting.ideals.decide import decide as decide
from disting.ideals.fibre_ideal import generic_rank as generic_rank
from disting.ideals.full_parts import same_by_full_parts as same_by_full_parts
from disting.ideals.system import CoefficientMap as CoefficientMap
from disting.ideals.system import coefficient_map as coefficient_map
from disting.ideals.system import normalised as normalised
from disting.ideals.verify import confirms as confirms
