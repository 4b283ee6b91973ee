"""Distinguishability of servo-drive chain models: which structures one force and one sensor cannot
tell apart, with proof, and what else to measure then.

>>> from disting import Family, compare
>>> compare(Family(3)[9], Family(3)[10]).relation.value
'indistinguishable'
"""

from types import ModuleType as _ModuleType

from disting.algebra.certainty import Certainty as Certainty
from disting.behaviour.expanded import transfer_function as transfer_function
from disting.catalogs import Catalog as Catalog
from disting.catalogs import ModelRow as ModelRow
from disting.catalogs import catalog as catalog
from disting.conditions import CONDITIONS as CONDITIONS
from disting.conditions import Finding as Finding
from disting.conditions import Outcome as Outcome
from disting.equivalence import equivalents as equivalents
from disting.equivalence import explicit_map as explicit_map
from disting.errors import CatalogError as CatalogError
from disting.errors import ConstraintViolation as ConstraintViolation
from disting.errors import ContradictionError as ContradictionError
from disting.errors import DistingError as DistingError
from disting.errors import InputError as InputError
from disting.experiments import Experiment as Experiment
from disting.files import __version__ as __version__
from disting.general import Alternatives as Alternatives
from disting.general import MatrixModel as MatrixModel
from disting.general import Model as Model
from disting.general import ModelList as ModelList
from disting.general import alternatives as alternatives
from disting.general import global_identifiability as global_identifiability
from disting.general import local_identifiability as local_identifiability
from disting.general import read_models as read_models
from disting.general import write_models as write_models
from disting.model.chain import Chain as Chain
from disting.model.chain import Sensor as Sensor
from disting.model.domain import Domain as Domain
from disting.model.family import Family as Family
from disting.model.settings import Settings as Settings
from disting.model.shown import Presenter as _Presenter
from disting.model.shown import presented_by as _presented_by
from disting.model.symmetry import Symmetry as Symmetry
from disting.questions.identifiability import Identifiability as Identifiability
from disting.questions.identifiability import Level as Level
from disting.questions.identifiability import ParameterIdentifiability as ParameterIdentifiability
from disting.questions.inclusion import Inclusion as Inclusion
from disting.store import CacheWarning as CacheWarning
from disting.store import Store as Store
from disting.verdict import Decisions as Decisions
from disting.verdict import Engine as Engine
from disting.verdict import Query as Query
from disting.verdict import Relation as Relation
from disting.verdict import Step as Step
from disting.verdict import Verdict as Verdict
from disting.verdict import View as View
from disting.verdict.comparison import compare as compare
from disting.verdict.comparison import findings as findings
from disting.verdict.everywhere import compare_everywhere as compare_everywhere
from disting.verdict.everywhere_file import everywhere_file as everywhere_file
from disting.verdict.identifiable import identifiability as identifiability
from disting.verdict.proof import prove as prove
from disting.verdict.verdict_file import verdict_file as verdict_file
from disting.verdict.verification import Verification as Verification
from disting.verdict.verification import verify as verify


def _presenter() -> _Presenter:
    """What draws, imported when something is looked at: it stands above what it draws."""
    from disting.report.notebook import Notebook

    return Notebook()


_presented_by(_presenter)

_ROOMS = ("fit", "measurement", "report", "simulation")  # beside the names above
__all__ = sorted(
    name
    for name, value in globals().items()
    if not name.startswith("_") and not isinstance(value, _ModuleType)
)


def __dir__() -> list[str]:
    """What the Tab key offers: the public names, and the rooms that have names of their own."""
    return [*__all__, *_ROOMS, "__version__"]


def __getattr__(name: str) -> _ModuleType:
    """A room, imported when it is named: `disting.fit` after `import disting`."""
    if name not in _ROOMS:
        raise AttributeError(f"disting has no {name}; dir(disting) lists what it has")
    from importlib import import_module

    return import_module(f"disting.{name}")
