"""Networks that are limits of others, as evidence: which elements vanish or become rigid."""

from disting.evidence.limits import Minor
from disting.network.branches import remainder
from disting.network.minors import Places, minors, omitted_values
from disting.network.network import Network


def minor_of(small: Network, large: Network, left_is_part: bool = True) -> Minor | None:
    """Return the elements of the large network in the limit that is the small one; None if no such
    limit is found with bounded work.

    >>> from disting.network import network_of
    >>> minor_of(network_of("R0-C1"), network_of("R0-p(C1,R1)")).missing
    ('R1',)
    """
    part, whole = small.grounded, large.grounded
    places = next(minors(part, whole), None)
    if places is not None:
        return minor_at(part, whole, places, left_is_part)
    gone = remainder(part, whole)
    return None if gone is None else Minor(left_is_part, (), *gone)


def minor_at(part: Network, whole: Network, places: Places, left_is_part: bool) -> Minor:
    """Return the elements of the whole in the limit that is the part, at these places."""
    return Minor(left_is_part, tuple(sorted(places.items())), *omitted_values(part, whole, places))
