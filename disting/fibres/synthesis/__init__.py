"""Inverse network synthesis: every chain with a given transfer function, listed in ball arithmetic.

It decides what the conditions leave open: one rational model of one chain, and all models of the
other chain that equal it.
"""

from disting.fibres.synthesis.decide import Direction as Direction
from disting.fibres.synthesis.decide import Exact as Exact
from disting.fibres.synthesis.decide import Grounds as Grounds
from disting.fibres.synthesis.decide import decide as decide
from disting.fibres.synthesis.decide import member as member
from disting.fibres.synthesis.duality import are_dual as are_dual
from disting.fibres.synthesis.duality import dual as dual
from disting.fibres.synthesis.fibre import fibre as fibre
from disting.fibres.synthesis.result import Answer as Answer
from disting.fibres.synthesis.result import Confirmation as Confirmation
from disting.fibres.synthesis.result import Exclusions as Exclusions
from disting.fibres.synthesis.result import Fibre as Fibre
from disting.fibres.synthesis.result import Solution as Solution
from disting.fibres.synthesis.result import Status as Status
from disting.fibres.synthesis.target import Target as Target
from disting.fibres.synthesis.target import target as target
