"""Engine B of the exact decision: the fibre of one model over a generic point of another as a
polynomial ideal.

For any two models that are given as coefficient maps, not only chains; chains with a gap are taken
apart first (`row_by_row`). Independent of `disting.synthesis`.
"""

from disting.ideals.by_one_row import confirms_row as confirms_row
from disting.ideals.by_one_row import differ_by_row as differ_by_row
from disting.ideals.by_shares import chains_told_apart as chains_told_apart
from disting.ideals.decide import Decision as Decision
from disting.ideals.decide import Limits as Limits
from disting.ideals.decide import decide as decide
from disting.ideals.fibre_ideal import generic_rank as generic_rank
from disting.ideals.full_rows import same_by_full_rows as same_by_full_rows
from disting.ideals.row_by_row import RowsDecision as RowsDecision
from disting.ideals.row_by_row import confirms_by_rows as confirms_by_rows
from disting.ideals.row_by_row import decide_by_rows as decide_by_rows
from disting.ideals.row_by_row import included_by_rows as included_by_rows
from disting.ideals.row_by_row import refuted_by_rows as refuted_by_rows
from disting.ideals.system import CoefficientMap as CoefficientMap
from disting.ideals.system import coefficient_map as coefficient_map
from disting.ideals.system import normalised as normalised
from disting.ideals.verify import confirms as confirms
