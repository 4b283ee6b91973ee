"""From a measured frequency response to the structures that explain it (sections 2 and 3 of the
paper).

>>> import numpy as np
>>> from disting import Chain
>>> from disting.fit import figure_1, predict, select
>>> from disting.measurement import FrequencyResponse
>>> drive, omega = Chain(2, damped=True, ground_dampers=(1,)), 2 * np.pi * np.geomspace(5, 200, 100)
>>> values = {"m1": 0.02, "m2": 0.01, "k12": 500.0, "d12": 0.1, "b1": 0.3}
>>> data = FrequencyResponse(omega, predict(drive, values, omega))
>>> found = select(data, figure_1([1, 2]))
>>> print(found.selected.chain, round(found.selected.estimate.parameters["k12"], 6))
2 masses, gap 0, force 1-0, sensor 1-0, damped, ground dampers 1 500.0

What is in a `Selection`, with the records that it holds:

>>> best, task = found.selected, found.task  # a Candidate with its Estimate, the Task with its Cost
>>> found.explanation.explains, best.practical.rank  # of Explanation, Practical
(True, 5)
>>> found.members[0].name, found.members[0].disagreements  # of Member, Disagreement
('2:1+b1', ())
>>> found.members[0].twins, found.alternatives, found.readings  # of Twin, Alternative, Reading
((), (), ())
>>> found.quantities, found.question  # each a QuantityReading, where nothing settles it
((), '')
>>> found.relied_on[0].name, found.explanation.misses  # of Statement, Miss
('total inertia', ())
>>> type(best.practical).__name__, type(found.explanation.scatter).__name__
('Practical', 'Scatter')

It goes to a file for programs, and comes back:

>>> import json
>>> from pathlib import Path
>>> from tempfile import TemporaryDirectory
>>> from disting.fit import read_model
>>> from disting.report.fit import selection_to_dict
>>> with TemporaryDirectory() as folder:
...     file = Path(folder, "fit.json")
...     _ = file.write_text(json.dumps(selection_to_dict(found)))
...     read_model(file)[0] == drive
True

What follows from it, as Results, a Confidence, a Profile and a Sweep:

>>> from disting.fit import confidence, fit_percent, physical, profile, sweep
>>> [result.name for result in physical(best, task)][:3]  # each a Result
['total inertia', 'motor inertia', 'load inertia']
>>> round(fit_percent(best, task, data)), confidence(best, task, omega).amplitude.shape
(100, (100,))
>>> profile(best, task, "k12").name, sweep(found.candidates, "collinearity").criterion
('k12', 'collinearity')

What a search does for one structure; several responses have a JointCost, and a JointPlant:

>>> from disting.fit import JointCost, Setup, estimates
>>> estimates([drive], task)[drive].j < 1e-9
True
>>> both = JointCost((task.cost, task.cost), (Setup(), Setup(sensor="2")))
>>> type(both.plant(drive.structure, 1)).__name__, both.measured is data
('JointPlant', True)

Margins of a controller around it, and how much measuring excludes a Rival, and the Design of that:

>>> from disting.fit import Controller, design, gain, margins, plan
>>> p = np.array([best.estimate.parameters[name] for name in drive.parameters])
>>> margins(drive, p, Controller(P=0.5, loop="velocity")).stable
True
>>> asked = plan(drive, values, Chain(2, damped=True), omega, np.full(100, 0.05))  # a Plan
>>> measured = FrequencyResponse(asked.rival.cost.measured.omega, predict(drive, values, omega))
>>> asked.power > 0.5, gain(asked.rival, measured) > 100, design(asked).rate
(True, True, 1000.0)

The names by subject. Candidates, and the fit:

    candidates                    chains to fit, as the options of disting fit name them
    figure_1, whole_family        candidate structures by size
    chosen_ports, variants        those with given ports; dampers, lag, dead time of one structure
    select                        fit candidates to measured responses
    fit_networks                  fit circuits, compartments or machines that branch
    FurtherResponse, Setup        a further response of the machine; how one was measured
    Case, Thresholds, Rule        which residuals; limits of the criteria; who may be selected
    lines_by_coherence, lines_by_deviation   weights of the lines
    Task, Cost, JointCost         what is minimised, for one and for several responses
    Plant, JointPlant             the model's responses at the measured frequencies
    estimates, Estimate           best parameters of each structure

What a fit finds:

    Selection, Candidate, Member  the answer; a fitted candidate; a structure that is not excluded
    Explanation, Miss             does it explain the data; where it misses them
    Practical, practical, importance, collinearity_index, condition_indices
                                  which parameters the data determine
    Noise, Scatter                scatter of the lines
    Alternative, Twin, Disagreement, Reading, QuantityReading, Statement
                                  structures that behave the same; what else the answer rests on

Results:

    Result, physical, poles, zeros   resonances, inertias; poles and zeros of a structure
    predict, fit_percent          response of a chain with values; share of the response explained
    confidence, Confidence        standard errors of the response
    profile, Profile              smallest cost at each value of one parameter
    sweep, Sweep                  the best candidate at each threshold of one criterion
    Controller, margins, Margins  a controller, and the stability of its loop
    state_space, zero_pole, to_control, to_control_transfer_function
                                  the model for other programs
    control_script, write_mat, NumberedStructure   the same as files
    read_model                    structure and values from fit.json

What to measure next:

    plan, Plan, Rival, gain       how much measuring tells a rival from the model
    design, Design                the best band and spectrum for that
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.export import (
        NumberedStructure as NumberedStructure,
        control_script as control_script,
        predict as predict,
        read_model as read_model,
        state_space as state_space,
        to_control as to_control,
        to_control_transfer_function as to_control_transfer_function,
        write_mat as write_mat,
        zero_pole as zero_pole,
    )
    from disting.fit.judge.admissible import Rule as Rule
    from disting.fit.judge.alternatives import Alternative as Alternative
    from disting.fit.judge.candidate import Candidate as Candidate
    from disting.fit.judge.explanation import Explanation as Explanation, Miss as Miss
    from disting.fit.judge.members import (
        Disagreement as Disagreement,
        Member as Member,
        Twin as Twin,
    )
    from disting.fit.judge.modes import (
        Result as Result,
        physical as physical,
        poles as poles,
        zeros as zeros,
    )
    from disting.fit.judge.readings import QuantityReading as QuantityReading, Reading as Reading
    from disting.fit.networks import fit_networks as fit_networks
    from disting.fit.results.loop import (
        Controller as Controller,
        Margins as Margins,
        margins as margins,
    )
    from disting.fit.results.reliance import Statement as Statement
    from disting.fit.results.selection import (
        Confidence as Confidence,
        Profile as Profile,
        Selection as Selection,
        Sweep as Sweep,
        confidence as confidence,
        fit_percent as fit_percent,
        profile as profile,
        sweep as sweep,
    )
    from disting.fit.search.candidates import (
        candidates as candidates,
        chosen_ports as chosen_ports,
        figure_1 as figure_1,
        variants as variants,
        whole_family as whole_family,
    )
    from disting.fit.search.cost import (
        Case as Case,
        Cost as Cost,
        lines_by_coherence as lines_by_coherence,
        lines_by_deviation as lines_by_deviation,
    )
    from disting.fit.search.estimate import Estimate as Estimate, Task as Task
    from disting.fit.search.exchange import estimates as estimates
    from disting.fit.search.joint import (
        FurtherResponse as FurtherResponse,
        JointCost as JointCost,
        JointPlant as JointPlant,
    )
    from disting.fit.search.plant import Plant as Plant
    from disting.fit.search.setup import Setup as Setup
    from disting.fit.select import select as select
    from disting.planning.power import Plan as Plan, plan as plan
    from disting.planning.rival import Rival as Rival, gain as gain
    from disting.planning.spectrum import Design as Design, design as design
    from disting.statistics.covariance import Noise as Noise
    from disting.statistics.practical import (
        Practical as Practical,
        Thresholds as Thresholds,
        collinearity_index as collinearity_index,
        condition_indices as condition_indices,
        importance as importance,
        practical as practical,
    )
    from disting.statistics.scatter import Scatter as Scatter

offer(__name__)
