"""General parametric models: any rational transfer function with parameters, compared as chains are."""

from disting.parametric.identifiability import LocalIdentifiability as LocalIdentifiability
from disting.parametric.identifiability import local_identifiability as local_identifiability
from disting.parametric.model import Model as Model
from disting.parametric.verdicts import compare as compare
from disting.parametric.verdicts import findings as findings
