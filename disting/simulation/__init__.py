"""Simulated measurements of machines: what a bench would record, with noise, quantisation,
friction, dead time and lag.
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.simulation.bench import (
        DEMO_BENCH as DEMO_BENCH,
        DEMO_MODEL as DEMO_MODEL,
        DEMO_PARAMETERS as DEMO_PARAMETERS,
        Bench as Bench,
        demo as demo,
        simulate as simulate,
        simulate_all as simulate_all,
    )
    from disting.simulation.excitation import Excitation as Excitation, Kind as Kind
    from disting.simulation.mechanics import (
        Matrices as Matrices,
        frequency_response as frequency_response,
        matrices as matrices,
        port_vectors as port_vectors,
    )
    from disting.simulation.stepping import Friction as Friction

offer(
    __name__,
    {
        "bench": "DEMO_BENCH DEMO_MODEL DEMO_PARAMETERS Bench demo simulate simulate_all",
        "excitation": "Excitation Kind",
        "mechanics": "Matrices frequency_response matrices port_vectors",
        "stepping": "Friction",
    },
)
