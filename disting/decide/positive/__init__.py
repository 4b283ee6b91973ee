"""Positive equivalents: which positive models of one chain have the behaviour of a positive
model of another one.
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.decide.positive.confirmation import confirms as confirms, proves as proves
    from disting.decide.positive.ranges import (
        Ranges as Ranges,
        confirms_within as confirms_within,
        ranges as ranges,
        renamings as renamings,
        within_ranges as within_ranges,
    )
    from disting.decide.positive.real import (
        always_real as always_real,
        confirms_real as confirms_real,
        real_witness as real_witness,
    )
    from disting.decide.positive.shares import positive_finding as positive_finding

offer(__name__)
