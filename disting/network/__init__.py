"""Linear networks: machines that branch, loop and have gears, circuits, compartments.

The names:

    network_of, values_in   a network, and its values, from a text such as "R0-p(R1,C1)"
    Network                 elements between nodes, and ports
    Element, Port           a spring, resistor, ..; where a force acts or a sensor is
    Sort                    what a network is of: machine, circuit or compartments
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.model.chain import Sort as Sort
    from disting.network.network import Element as Element, Network as Network, Port as Port
    from disting.network.notation import network_of as network_of, values_in as values_in

offer(__name__)
