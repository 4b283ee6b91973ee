"""Distinguishability of models of servo drives and of any other linear network: which structures
a measurement cannot tell apart, with proof, and what else to measure then.

>>> from disting import Family, compare
>>> compare(Family(3)[9], Family(3)[10]).relation.value
'indistinguishable'
"""

TYPE_CHECKING = False  # as type checkers know it; the module typing would double the start
if TYPE_CHECKING:
    from disting import (
        fit as fit,
        measurement as measurement,
        report as report,
        simulation as simulation,
    )
    from disting.algebra.certainty import Certainty as Certainty
    from disting.behaviour.expansion import transfer_function as transfer_function
    from disting.catalogs import Catalog as Catalog, ModelRow as ModelRow, catalog as catalog
    from disting.conditions.finding import Finding as Finding, Outcome as Outcome
    from disting.conditions.inclusion import Inclusion as Inclusion
    from disting.conditions.table import CONDITIONS as CONDITIONS
    from disting.equivalence import (
        equivalents as equivalents,
        explicit_map as explicit_map,
        gate as gate,
    )
    from disting.errors import (
        CatalogError as CatalogError,
        ConstraintViolation as ConstraintViolation,
        ContradictionError as ContradictionError,
        DistingError as DistingError,
        InputError as InputError,
    )
    from disting.experiments.experiment import Experiment as Experiment
    from disting.files import __version__ as __version__
    from disting.general.alternatives import (
        Alternatives as Alternatives,
        alternatives as alternatives,
    )
    from disting.general.global_identifiability import (
        global_identifiability as global_identifiability,
    )
    from disting.general.identifiability import local_identifiability as local_identifiability
    from disting.general.matrix_model import MatrixModel as MatrixModel
    from disting.general.model import Model as Model
    from disting.general.model_files import (
        ModelList as ModelList,
        read_models as read_models,
        write_models as write_models,
    )
    from disting.model.chain import Chain as Chain
    from disting.model.family import Family as Family
    from disting.model.question import Domain as Domain, Settings as Settings
    from disting.model.symmetry import Symmetry as Symmetry
    from disting.network.element import Element as Element, Port as Port
    from disting.network.network import Network as Network
    from disting.network.notation import network_of as network_of, values_in as values_in
    from disting.quantities import Sensor as Sensor
    from disting.questions.identifiability.answer import Identifiability as Identifiability
    from disting.questions.identifiability.levels import (
        ParameterIdentifiability as ParameterIdentifiability,
    )
    from disting.questions.identifiability.parts import Level as Level
    from disting.store import CacheWarning as CacheWarning, Store as Store
    from disting.verdict.comparison import (
        compare as compare,
        findings as findings,
        identifiability as identifiability,
        prove as prove,
    )
    from disting.verdict.decisions import Decisions as Decisions
    from disting.verdict.engine import Engine as Engine
    from disting.verdict.placement_verdicts import (
        compare_everywhere as compare_everywhere,
        everywhere_file as everywhere_file,
    )
    from disting.verdict.query import Query as Query, View as View
    from disting.verdict.result import Relation as Relation, Step as Step, Verdict as Verdict
    from disting.verdict.verdict_file import verdict_file as verdict_file
    from disting.verdict.verification import Verification as Verification, verify as verify

# The same list, by which a name is found when it is used: to import all takes half a second.
_NAMES = {
    "disting.algebra.certainty": "Certainty",
    "disting.behaviour.expansion": "transfer_function",
    "disting.catalogs": "Catalog ModelRow catalog",
    "disting.conditions.finding": "Finding Outcome",
    "disting.conditions.inclusion": "Inclusion",
    "disting.conditions.table": "CONDITIONS",
    "disting.equivalence": "equivalents explicit_map gate",
    "disting.errors": "CatalogError ConstraintViolation ContradictionError DistingError InputError",
    "disting.experiments.experiment": "Experiment",
    "disting.files": "__version__",
    "disting.general.alternatives": "Alternatives alternatives",
    "disting.general.global_identifiability": "global_identifiability",
    "disting.general.identifiability": "local_identifiability",
    "disting.general.matrix_model": "MatrixModel",
    "disting.general.model": "Model",
    "disting.general.model_files": "ModelList read_models write_models",
    "disting.model.chain": "Chain",
    "disting.model.family": "Family",
    "disting.model.question": "Domain Settings",
    "disting.model.symmetry": "Symmetry",
    "disting.network.element": "Element Port",
    "disting.network.network": "Network",
    "disting.network.notation": "network_of values_in",
    "disting.quantities": "Sensor",
    "disting.questions.identifiability.answer": "Identifiability",
    "disting.questions.identifiability.levels": "ParameterIdentifiability",
    "disting.questions.identifiability.parts": "Level",
    "disting.store": "CacheWarning Store",
    "disting.verdict.comparison": "compare findings identifiability prove",
    "disting.verdict.decisions": "Decisions",
    "disting.verdict.engine": "Engine",
    "disting.verdict.placement_verdicts": "compare_everywhere everywhere_file",
    "disting.verdict.query": "Query View",
    "disting.verdict.result": "Relation Step Verdict",
    "disting.verdict.verdict_file": "verdict_file",
    "disting.verdict.verification": "Verification verify",
}
_HOME = {name: module for module, names in _NAMES.items() for name in names.split()}
_ROOMS = ("fit", "measurement", "report", "simulation")  # beside the names above
__all__ = sorted(_HOME.keys() - {"__version__"})


def __dir__() -> list[str]:
    """What the Tab key offers: the public names, and the rooms that have names of their own."""
    return [*__all__, *_ROOMS, "__version__"]


def _named(name: str) -> object:
    """A public name or a room, imported when it is used: `disting.fit` after `import disting`."""
    from importlib import import_module
    from importlib.util import find_spec

    if name in _HOME:
        attribute: object = getattr(import_module(_HOME[name]), name)
        globals()[name] = attribute
        return attribute
    if name.startswith("_") or find_spec(f"disting.{name}") is None:
        raise AttributeError(f"disting has no {name}; dir(disting) lists what it has")
    return import_module(f"disting.{name}")


if not TYPE_CHECKING:  # else any name would be right to a type checker
    __getattr__ = _named
