"""From a measured frequency response to the structures that explain it (sections 2 and 3 of the
paper).

>>> import numpy as np
>>> from disting import Chain
>>> from disting.fit import figure_1, predicted, select
>>> from disting.measurement import FrequencyResponse
>>> drive, omega = Chain(2, damped=True, ground_dampers=(1,)), 2 * np.pi * np.geomspace(5, 200, 100)
>>> values = {"m1": 0.02, "m2": 0.01, "k12": 500.0, "d12": 0.1, "b1": 0.3}
>>> data = FrequencyResponse(omega, predicted(drive, values, omega))
>>> found = select(data, figure_1([1, 2]))
>>> print(found.selected.chain, round(found.selected.estimate.parameters["k12"], 6))
2 masses, gap 0, force 1-0, sensor 1-0, damped, ground dampers 1 500.0
"""

from disting.fit.admissible import Rule as Rule
from disting.fit.alternatives import Alternative as Alternative
from disting.fit.candidates import chosen_ports as chosen_ports
from disting.fit.candidates import figure_1 as figure_1
from disting.fit.candidates import variants as variants
from disting.fit.candidates import whole_family as whole_family
from disting.fit.cost import Case as Case
from disting.fit.cost import Cost as Cost
from disting.fit.cost import lines_by_coherence as lines_by_coherence
from disting.fit.cost import lines_by_deviation as lines_by_deviation
from disting.fit.designed import Designed as Designed
from disting.fit.designed import designed as designed
from disting.fit.estimate import Estimate as Estimate
from disting.fit.estimate import Task as Task
from disting.fit.exchange import estimates as estimates
from disting.fit.explained import Explanation as Explanation
from disting.fit.explained import Miss as Miss
from disting.fit.export import Exported as Exported
from disting.fit.export import control_script as control_script
from disting.fit.export import predicted as predicted
from disting.fit.export import state_space as state_space
from disting.fit.export import to_control as to_control
from disting.fit.export import to_control_transfer_function as to_control_transfer_function
from disting.fit.export import write_mat as write_mat
from disting.fit.export import zero_pole as zero_pole
from disting.fit.fitted import Confidence as Confidence
from disting.fit.fitted import confidence as confidence
from disting.fit.fitted import fit_percent as fit_percent
from disting.fit.joint import Further as Further
from disting.fit.joint import JointCost as JointCost
from disting.fit.joint import JointPlant as JointPlant
from disting.fit.judged import Candidate as Candidate
from disting.fit.loop import Controller as Controller
from disting.fit.loop import Margins as Margins
from disting.fit.loop import margins as margins
from disting.fit.members import Disagreement as Disagreement
from disting.fit.members import Member as Member
from disting.fit.members import Twin as Twin
from disting.fit.modes import Result as Result
from disting.fit.modes import physical as physical
from disting.fit.modes import poles as poles
from disting.fit.modes import zeros as zeros
from disting.fit.noise import Noise as Noise
from disting.fit.plan import Plan as Plan
from disting.fit.plan import plan as plan
from disting.fit.plant import Plant as Plant
from disting.fit.practical import Practical as Practical
from disting.fit.practical import Thresholds as Thresholds
from disting.fit.practical import collinearity_index as collinearity_index
from disting.fit.practical import condition_indices as condition_indices
from disting.fit.practical import importance as importance
from disting.fit.practical import practical as practical
from disting.fit.readings import Reading as Reading
from disting.fit.reliance import Statement as Statement
from disting.fit.rival import Rival as Rival
from disting.fit.rival import gain as gain
from disting.fit.scatter import Scatter as Scatter
from disting.fit.select import Selection as Selection
from disting.fit.select import select as select
from disting.fit.selection_json import read_model as read_model
from disting.fit.selection_json import selection_to_dict as selection_to_dict
from disting.fit.setup import Setup as Setup
from disting.fit.sweep import Profile as Profile
from disting.fit.sweep import Sweep as Sweep
from disting.fit.sweep import profile as profile
from disting.fit.sweep import sweep as sweep
