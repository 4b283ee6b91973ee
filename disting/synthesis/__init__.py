"""Inverse network synthesis: every chain with a given transfer function, listed in ball arithmetic.

It decides what the conditions leave open: one rational model of one chain, and all models of the
other chain that equal it.
"""

from disting.synthesis.decide import Direction as Direction
from disting.synthesis.decide import Exact as Exact
from disting.synthesis.decide import Grounds as Grounds
from disting.synthesis.decide import decide as decide
from disting.synthesis.decide import member as member
from disting.synthesis.duality import are_dual as are_dual
from disting.synthesis.duality import dual as dual
from disting.synthesis.fibre import fibre as fibre
from disting.synthesis.result import Answer as Answer
from disting.synthesis.result import Confirmation as Confirmation
from disting.synthesis.result import Exclusions as Exclusions
from disting.synthesis.result import Fibre as Fibre
from disting.synthesis.result import Solution as Solution
from disting.synthesis.result import Status as Status
from disting.synthesis.target import Target as Target
from disting.synthesis.target import target as target
