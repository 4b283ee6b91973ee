"""Engine B of the exact decision: the fibre of one model over a generic point of another as a
polynomial ideal.

For any two models that are given as coefficient maps, not only chains; chains with a gap are taken
apart first (`by_two_rows`). Independent of `disting.fibres.synthesis`.
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.evidence.kinds import Decision as Decision
    from disting.fibres.ideals.by_shares import tell_chains_apart as tell_chains_apart
    from disting.fibres.ideals.by_two_rows import (
        confirms_by_rows as confirms_by_rows,
        included_by_rows as included_by_rows,
        refuted_by_rows as refuted_by_rows,
    )
    from disting.fibres.ideals.confirm import (
        confirms as confirms,
        find_again as find_again,
        holds_for as holds_for,
        refuted_at as refuted_at,
        safety_of as safety_of,
    )
    from disting.fibres.ideals.full_rows import same_by_full_rows as same_by_full_rows
    from disting.fibres.ideals.membership import (
        Limits as Limits,
        decide as decide,
        decide_matched as decide_matched,
    )
    from disting.fibres.ideals.one_value import one_value as one_value
    from disting.fibres.ideals.shares import MOST as MOST, TRIES as TRIES, Try as Try
    from disting.fibres.ideals.stacked_map import (
        Fraction as Fraction,
        StackedMap as StackedMap,
        stacked_maps as stacked_maps,
    )
    from disting.fibres.ideals.system import (
        CoefficientMap as CoefficientMap,
        PolynomialMap as PolynomialMap,
        Terms as Terms,
        coefficient_map as coefficient_map,
        match_maps as match_maps,
        normalise as normalise,
    )

offer(__name__)
