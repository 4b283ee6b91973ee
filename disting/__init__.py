"""Distinguishability of models of servo drives and of any other linear network: which structures a
measurement cannot distinguish, with proof, and what else to measure then.

>>> from disting import Family, compare
>>> compare(Family(3)[9], Family(3)[10]).relation.value
'indistinguishable'

The names by subject; `help(disting.compare)` explains one of them.

Compare, and verdicts:

    compare                  verdict on two models
    compare_everywhere       verdicts for all places of a further sensor, force or lock
    verdicts                 verdicts on all pairs of a size, of a list or of a family of networks
    findings                 what each condition finds on two models
    positive_shares          how many values of a chain have an equivalent, within ranges
    prove                    proof of a verdict that rests on random points
    Verdict, Relation        a verdict; distinguishable, indistinguishable, sometimes, undecided
    Certainty, Inclusion     how sure it is; which model has responses that the other cannot produce
    Domain                   complex, real or positive parameters
    Query, View              which representations and conditions may decide
    CONDITIONS               the conditions of the paper, in order
    Step, Finding, Outcome   a condition in one representation, and what it found
    Engine, Settings         decides all pairs of a list; seeds and limits of a computation
    Decisions                its answer: matrix and classes
    Experiment               a further way to measure: sensor, force, locked mass, added inertia

One model, and what has the same response:

    identifiability          which parameters data determine
    Identifiability, ParameterIdentifiability, Level   its answer; global, local, ..
    local_identifiability, global_identifiability      the same of a model with formulas
    equivalents              all parameters of other models with the same transfer function
    explicit_map             formulas for these parameters
    alternatives             parameters of one model with the response of another, at given values
    Alternatives             its answer
    gate                     which of many models are worth a fit
    next_experiments         which experiments distinguish structures with the same response
    dampers                  which sets of ground dampers of a chain can be distinguished

Models and networks:

    Chain, Family, Symmetry  masses in a row; all of one size; symmetries of a chain
    Quantity                 what a sensor shows: position, velocity or acceleration
    Network, Element, Port   machines that branch, circuits, compartments
    network_of, values_in    a network, and its values, from a text such as "R0-p(R1,C1)"
    Model, MatrixModel       state spaces and transfer functions with parameters
    ModelList, read_models, write_models               lists of models in files
    transfer_function        G(s) of a chain as a SymPy expression

Catalogues:

    catalog                  the shipped verdicts on all chains of a size
    Catalog, ModelRow        its matrix, classes and rows

Measurements and fit:

    measurement              frequency responses and records from files and arrays
    fit                      the structures that explain a measured response
    simulation               what a bench would measure
    report                   pages and figures

Evidence and files:

    verdict_file, everywhere_file   a verdict with all that its check needs, for JSON
    verify, Verification     check such a file
    Store, CacheWarning      the cache of finished work

Errors:

    DistingError             base of all errors that disting raises
    InputError               an argument or a file that cannot be understood
    ConstraintViolation      a chain that is no model of the class
    CatalogError             a catalogue file that is missing or damaged
    ContradictionError       a defect of disting: two conditions contradict each other
"""

TYPE_CHECKING = False  # the name that type checkers know; the module typing would double the start
if TYPE_CHECKING:
    from disting import (
        fit as fit,
        measurement as measurement,
        report as report,
        simulation as simulation,
    )
    from disting.algebra.certainty import Certainty as Certainty
    from disting.behaviour.transfer import transfer_function as transfer_function
    from disting.catalogs import Catalog as Catalog, ModelRow as ModelRow, catalog as catalog
    from disting.catalogs.dampers import dampers as dampers
    from disting.conditions.inclusion import Inclusion as Inclusion
    from disting.conditions.rule import Finding as Finding, Outcome as Outcome
    from disting.conditions.table import CONDITIONS as CONDITIONS
    from disting.decide.identifiability.answer import Identifiability as Identifiability
    from disting.decide.identifiability.levels import (
        ParameterIdentifiability as ParameterIdentifiability,
    )
    from disting.decide.identifiability.parts import Level as Level
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
    from disting.general.matrix_model import MatrixModel as MatrixModel, Model as Model
    from disting.general.model_files import (
        ModelList as ModelList,
        read_models as read_models,
        write_models as write_models,
    )
    from disting.model.chain import Chain as Chain
    from disting.model.family import Family as Family
    from disting.model.question import Domain as Domain, Settings as Settings
    from disting.model.symmetry import Symmetry as Symmetry
    from disting.network.network import Element as Element, Network as Network, Port as Port
    from disting.network.notation import network_of as network_of, values_in as values_in
    from disting.quantities import Quantity as Quantity
    from disting.store import CacheWarning as CacheWarning, Store as Store
    from disting.verdict.comparison import (
        compare as compare,
        findings as findings,
        identifiability as identifiability,
        positive_shares as positive_shares,
        prove as prove,
    )
    from disting.verdict.decisions import Decisions as Decisions
    from disting.verdict.engine import Engine as Engine
    from disting.verdict.next_experiments import next_experiments as next_experiments
    from disting.verdict.placement_verdicts import (
        compare_everywhere as compare_everywhere,
        everywhere_file as everywhere_file,
    )
    from disting.verdict.result import (
        Query as Query,
        Relation as Relation,
        Step as Step,
        Verdict as Verdict,
        View as View,
    )
    from disting.verdict.verdict_file import verdict_file as verdict_file
    from disting.verdict.verdict_list import verdicts as verdicts
    from disting.verdict.verification import Verification as Verification, verify as verify

if not TYPE_CHECKING:  # else any name would be right to a type checker

    def _with_public_names():
        """This package, from now on with its public names, which are imported when they are used.

        Called when the first of them is: `import disting` alone loads no other module.
        """
        from disting.lazy import offer

        for shim in ("__getattr__", "__dir__"):
            globals().pop(shim, None)
        return offer(__name__)

    def __getattr__(name):
        return getattr(_with_public_names(), name)

    def __dir__():
        return dir(_with_public_names())
