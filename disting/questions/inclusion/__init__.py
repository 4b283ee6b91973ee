"""One-sided inclusion: whether the models of one chain are models, or limits of models, of another
one of larger rank.

`decide` compares chains of one size and sends those of different sizes to `across_sizes`;
`finding` holds what is found and its text form, `confirmation` checks it again.
"""

from disting.conditions.inclusion import (
    ONE_SIDED as ONE_SIDED,
    Inclusion as Inclusion,
    InclusionFinding as InclusionFinding,
    Inclusions as Inclusions,
    Sense as Sense,
    inclusions_from_dict as inclusions_from_dict,
    inclusions_to_dict as inclusions_to_dict,
)
from disting.questions.inclusion.confirmation import confirms as confirms
from disting.questions.inclusion.decide import (
    CLOSURE as CLOSURE,
    IMAGE as IMAGE,
    inclusions as inclusions,
    turned as turned,
)
