"""Engine B of the exact decision: the fibre of one model over a generic point of another as a
polynomial ideal.

For any two models that are given as coefficient maps, not only chains; chains with a gap are taken
apart first (`by_two_rows`). Independent of `disting.fibres.synthesis`.
"""

from disting.fibres.decision import Decision as Decision
from disting.fibres.ideals.by_shares import chains_told_apart as chains_told_apart
from disting.fibres.ideals.by_two_rows import confirms_by_rows as confirms_by_rows
from disting.fibres.ideals.by_two_rows import included_by_rows as included_by_rows
from disting.fibres.ideals.by_two_rows import refuted_by_rows as refuted_by_rows
from disting.fibres.ideals.confirm import confirms as confirms
from disting.fibres.ideals.confirm import refuted_at as refuted_at
from disting.fibres.ideals.confirm import safety_of as safety_of
from disting.fibres.ideals.confirm import seen_again as seen_again
from disting.fibres.ideals.full_rows import same_by_full_rows as same_by_full_rows
from disting.fibres.ideals.membership import Limits as Limits
from disting.fibres.ideals.membership import decide as decide
from disting.fibres.ideals.membership import decide_matched as decide_matched
from disting.fibres.ideals.one_value import one_value as one_value
from disting.fibres.ideals.shares import MOST as MOST
from disting.fibres.ideals.shares import TRIES as TRIES
from disting.fibres.ideals.shares import Try as Try
from disting.fibres.ideals.stacked import Fraction as Fraction
from disting.fibres.ideals.stacked import StackedMap as StackedMap
from disting.fibres.ideals.stacked import stacked_maps as stacked_maps
from disting.fibres.ideals.system import CoefficientMap as CoefficientMap
from disting.fibres.ideals.system import PolynomialMap as PolynomialMap
from disting.fibres.ideals.system import Terms as Terms
from disting.fibres.ideals.system import coefficient_map as coefficient_map
from disting.fibres.ideals.system import matched as matched
from disting.fibres.ideals.system import normalised as normalised
