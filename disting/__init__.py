"""Distinguishability of servo-drive chain models: which structures no experiment can tell apart,
with proof.

>>> from disting import Family, compare
>>> compare(Family(3)[9], Family(3)[10]).relation.value
'indistinguishable'
"""

from disting.catalogs import Catalog as Catalog
from disting.catalogs import ModelRow as ModelRow
from disting.catalogs import catalog as catalog
from disting.certainty import Certainty as Certainty
from disting.comparison import compare as compare
from disting.comparison import findings as findings
from disting.conditions import CONDITIONS as CONDITIONS
from disting.conditions import Finding as Finding
from disting.conditions import Outcome as Outcome
from disting.domain import Domain as Domain
from disting.engine import CacheWarning as CacheWarning
from disting.engine import Decisions as Decisions
from disting.engine import Engine as Engine
from disting.engine import Store as Store
from disting.equivalence import equivalents as equivalents
from disting.equivalence import explicit_map as explicit_map
from disting.errors import CatalogError as CatalogError
from disting.errors import ConstraintViolation as ConstraintViolation
from disting.errors import ContradictionError as ContradictionError
from disting.errors import DistingError as DistingError
from disting.errors import InputError as InputError
from disting.identifiability import Identifiability as Identifiability
from disting.inclusion import Inclusion as Inclusion
from disting.invariants.expanded import transfer_function as transfer_function
from disting.model.chain import Chain as Chain
from disting.model.chain import Sensor as Sensor
from disting.model.family import Family as Family
from disting.model.symmetry import Symmetry as Symmetry
from disting.parametric import Alternatives as Alternatives
from disting.parametric import Model as Model
from disting.parametric import alternatives as alternatives
from disting.parametric import global_identifiability as global_identifiability
from disting.parametric import local_identifiability as local_identifiability
from disting.proof import prove as prove
from disting.settings import Settings as Settings
from disting.verdict import Query as Query
from disting.verdict import Relation as Relation
from disting.verdict import Step as Step
from disting.verdict import Verdict as Verdict
from disting.verdict import View as View

__version__ = "0.1.0"
