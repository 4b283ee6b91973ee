"""Linear networks: machines that branch, loop and have gears, circuits, compartments."""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.model.structure import Sort as Sort
    from disting.network.element import Element as Element, Port as Port
    from disting.network.network import Network as Network
    from disting.network.notation import network_of as network_of, values_in as values_in

offer(
    __name__,
    {
        "disting.model.structure": "Sort",
        "element": "Element Port",
        "network": "Network",
        "notation": "network_of values_in",
    },
)
