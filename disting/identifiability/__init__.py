"""Structural identifiability of one chain: which of its parameters an experiment can determine,
and how many sets of them fit.

Distinguishability compares two structures; this compares one with itself (E. Walter, L. Pronzato
1997, chapter 2). A fibre of the coefficient map at a rational point counts the parameter vectors
with one behaviour; the row space of its Jacobian tells which functions of the parameters are
determined at all.
"""

from disting.identifiability.analysis import IDENTIFIABILITY as IDENTIFIABILITY
from disting.identifiability.analysis import as_given as as_given
from disting.identifiability.analysis import identifiabilities as identifiabilities
from disting.identifiability.analysis import identifiability as identifiability
from disting.identifiability.formula import Formula as Formula
from disting.identifiability.parts import Alternative as Alternative
from disting.identifiability.parts import Combination as Combination
from disting.identifiability.parts import Level as Level
from disting.identifiability.parts import Origin as Origin
from disting.identifiability.parts import Renaming as Renaming
from disting.identifiability.parts import Scaling as Scaling
from disting.identifiability.result import Identifiability as Identifiability
from disting.identifiability.verify import confirms as confirms
