"""Simulated measurements of chains: what a bench would record, with noise, quantisation,
friction, dead time and lag.
"""

from disting.model.presentation import offered as _offered
from disting.simulation.bench import DEMO_BENCH as DEMO_BENCH
from disting.simulation.bench import DEMO_MODEL as DEMO_MODEL
from disting.simulation.bench import DEMO_PARAMETERS as DEMO_PARAMETERS
from disting.simulation.bench import Bench as Bench
from disting.simulation.bench import demo as demo
from disting.simulation.bench import simulate as simulate
from disting.simulation.bench import simulate_all as simulate_all
from disting.simulation.excitation import Excitation as Excitation
from disting.simulation.excitation import Kind as Kind
from disting.simulation.mechanics import Matrices as Matrices
from disting.simulation.mechanics import frequency_response as frequency_response
from disting.simulation.mechanics import matrices as matrices
from disting.simulation.mechanics import port_vectors as port_vectors
from disting.simulation.stepping import Friction as Friction


def __dir__() -> list[str]:
    """What the Tab key offers."""
    return _offered(globals())
