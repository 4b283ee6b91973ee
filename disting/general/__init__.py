"""General parametric models: any rational transfer functions with parameters, with one input and
one output or with several, compared as chains are.
"""

from disting.evidence.general import Witnesses as Witnesses
from disting.general.admissible import confirms as confirms
from disting.general.alternatives import Alternatives as Alternatives
from disting.general.alternatives import alternatives as alternatives
from disting.general.any_model import as_chain as as_chain
from disting.general.any_model import unnamed as unnamed
from disting.general.equivalent import Equivalent as Equivalent
from disting.general.fibre import Extent as Extent
from disting.general.formulas import is_explicit as is_explicit
from disting.general.formulas import is_without as is_without
from disting.general.global_identifiability import GlobalIdentifiability as GlobalIdentifiability
from disting.general.global_identifiability import global_identifiability as global_identifiability
from disting.general.identifiability import LocalIdentifiability as LocalIdentifiability
from disting.general.identifiability import local_identifiability as local_identifiability
from disting.general.identifiability import parameter_identifiability as parameter_identifiability
from disting.general.matrix_model import AnyModel as AnyModel
from disting.general.matrix_model import MatrixModel as MatrixModel
from disting.general.model import Model as Model
from disting.general.model_files import ModelList as ModelList
from disting.general.model_files import read_models as read_models
from disting.general.model_files import write_models as write_models
