"""Linear networks: machines that branch, loop and have gears, circuits, compartments."""

from disting.model.structure import Sort as Sort
from disting.network.element import Element as Element, Port as Port
from disting.network.network import Network as Network
from disting.network.notation import network_of as network_of, values_in as values_in
