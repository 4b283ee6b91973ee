"""General parametric models: any rational transfer functions with parameters, with one input and
one output or with several, compared as chains are.

>>> from disting.general import Model, alternatives, as_chain, without_names
>>> lag = Model.from_transfer_function("k", "T*s + 1", name="lag")
>>> other = Model.from_transfer_function("a", "b*s + c", name="other")
>>> found = alternatives(lag, {"k": 2, "T": 3}, other)
>>> found.extent.value, len(found.equivalents)  # of Extent, each an Equivalent
('family', 3)
>>> without_names(lag) == without_names(Model.from_transfer_function("k", "1 + T*s")), as_chain(lag)
(True, None)

What data determine of one of them, a GlobalIdentifiability and a LocalIdentifiability:

>>> from disting.general import global_identifiability, local_identifiability
>>> global_identifiability(other).sentence
'3 parameters, only 2 determinable: a/b, c/b.'
>>> local_identifiability(other).rank
2

Evidence of a verdict is found again, as `disting.verify` does: Witnesses by `confirms`, formulas by
`is_explicit`, that there are none by `is_without`:

>>> from disting import compare
>>> from disting.general import is_explicit
>>> is_explicit(compare(lag, other).evidence, lag, other)
True

The names:

    Model, MatrixModel, AnyModel      one input and output; several; either of them
    ModelList, read_models, write_models   lists of models in files
    as_chain, without_names           the chain that a model is; a model with plain names
    alternatives, Alternatives        parameters with the response of another model
    Equivalent, Extent                one set of them; none, finitely many or a family
    local_identifiability, LocalIdentifiability     which parameters are locally determined
    global_identifiability, GlobalIdentifiability   how many parameter vectors fit
    parameter_identifiability         the level of each parameter
    Witnesses, confirms, is_explicit, is_without    evidence of verdicts, and its checks
"""

from disting.lazy import TYPE_CHECKING, offer

if TYPE_CHECKING:
    from disting.evidence.general import Witnesses as Witnesses
    from disting.general.alternatives import (
        Alternatives as Alternatives,
        alternatives as alternatives,
    )
    from disting.general.any_model import as_chain as as_chain, without_names as without_names
    from disting.general.equivalent import Equivalent as Equivalent
    from disting.general.fibre import Extent as Extent
    from disting.general.formulas import is_explicit as is_explicit, is_without as is_without
    from disting.general.global_identifiability import (
        GlobalIdentifiability as GlobalIdentifiability,
        global_identifiability as global_identifiability,
    )
    from disting.general.identifiability import (
        LocalIdentifiability as LocalIdentifiability,
        local_identifiability as local_identifiability,
        parameter_identifiability as parameter_identifiability,
    )
    from disting.general.matrix_model import (
        AnyModel as AnyModel,
        MatrixModel as MatrixModel,
        Model as Model,
    )
    from disting.general.model_evidence import confirms as confirms
    from disting.general.model_files import (
        ModelList as ModelList,
        read_models as read_models,
        write_models as write_models,
    )

offer(__name__)
