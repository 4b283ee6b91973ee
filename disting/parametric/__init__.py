"""General parametric models: any rational transfer function with parameters, compared as chains
are.
"""

from disting.evidence.general import Witnesses as Witnesses
from disting.parametric.admissible import confirms as confirms
from disting.parametric.alternatives import Alternatives as Alternatives
from disting.parametric.alternatives import alternatives as alternatives
from disting.parametric.equivalent import Equivalent as Equivalent
from disting.parametric.fibre import Extent as Extent
from disting.parametric.formulas import is_explicit as is_explicit
from disting.parametric.formulas import is_without as is_without
from disting.parametric.identifiability import LocalIdentifiability as LocalIdentifiability
from disting.parametric.identifiability import local_identifiability as local_identifiability
from disting.parametric.model import Model as Model
from disting.parametric.solutions import GlobalIdentifiability as GlobalIdentifiability
from disting.parametric.solutions import global_identifiability as global_identifiability
from disting.parametric.verdicts import compare as compare
from disting.parametric.verdicts import findings as findings
