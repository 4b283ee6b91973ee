"""Chains and networks under several experiments with one parameter vector: what to measure next.

`changes` of a machine are of the kinds of one table, `experiment` describes the measurement,
`machine_model` the behaviour, `measured_network` the same of a network, `exact` decides what
conditions leave open, `machine_side` makes a measured chain a side of a comparison, `places` maps
the masses of one model to those of the other.

>>> from disting import Chain
>>> from disting.experiments import move, parse_experiment, ways
>>> asked = parse_experiment("sensor=2")  # a PlacedExperiment
>>> ways(Chain(2), Chain(2), [asked])  # each of them Places
[((2, 1),), ((2, 2),)]
>>> move(asked.experiment, ((2, 1),))
Experiment(sensor=1)

`confirms` finds evidence of a verdict under experiments again, as `disting.verify` does.

The names:

    Experiment, Change             a way to measure; a change of the machine at one mass
    MeasuredChain                  a chain under several experiments
    parse_experiment               an experiment from a text such as "sensor=2"
    PlacedExperiment, Places, ways   experiments on two chains; which mass is which
    move                           an experiment at the places of the other chain
    confirms                       check evidence of a verdict again
    GENERIC                        a size that is drawn once, the same for all models
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.experiments.changes import GENERIC as GENERIC, Change as Change
    from disting.experiments.experiment import (
        Experiment as Experiment,
        MeasuredChain as MeasuredChain,
    )
    from disting.experiments.measured_evidence import confirms as confirms
    from disting.experiments.places import (
        PlacedExperiment as PlacedExperiment,
        Places as Places,
        move as move,
        parse_experiment as parse_experiment,
        ways as ways,
    )

offer(__name__)
