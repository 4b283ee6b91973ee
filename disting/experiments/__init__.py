"""Chains under several experiments with one parameter vector: what to measure next.

`experiment` says how is measured, `profiles` what it reveals, `exact` decides what conditions leave
open, `compared` makes a measured chain a side of a comparison, `places` tells which mass of one
model is which of the other.
"""

from disting.experiments.experiment import GENERIC as GENERIC
from disting.experiments.experiment import Experiment as Experiment
from disting.experiments.experiment import MeasuredChain as MeasuredChain
from disting.experiments.machine_side import ComparedMachine as ComparedMachine
from disting.experiments.measured_evidence import confirms as confirms
from disting.experiments.places import Named as Named
from disting.experiments.places import Places as Places
from disting.experiments.places import moved as moved
from disting.experiments.places import named as named
from disting.experiments.places import ways as ways
