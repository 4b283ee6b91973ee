"""Simulated measurements of machines: what a bench would record, with noise, quantisation,
friction, dead time and lag.

The names:

    simulate, simulate_all         a record of one force and one sensor; of all of a network
    Bench, Friction                sampling, noise, quantisation; friction of a mass
    Excitation, Kind               the excitation signal
    frequency_response             G(j omega) of a model with values
    matrices, Matrices, port_vectors   M, D, K of a machine; vectors of force and sensor
    demo, DEMO_MODEL, DEMO_PARAMETERS, DEMO_BENCH   the record of the demonstration
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.simulation.bench import (
        DEMO_BENCH as DEMO_BENCH,
        DEMO_MODEL as DEMO_MODEL,
        DEMO_PARAMETERS as DEMO_PARAMETERS,
        Bench as Bench,
        Excitation as Excitation,
        Kind as Kind,
        demo as demo,
        simulate as simulate,
        simulate_all as simulate_all,
    )
    from disting.simulation.mechanics import (
        Friction as Friction,
        Matrices as Matrices,
        frequency_response as frequency_response,
        matrices as matrices,
        port_vectors as port_vectors,
    )

offer(__name__)
