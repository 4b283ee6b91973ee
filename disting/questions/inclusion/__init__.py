"""One-sided inclusion: whether the models of one chain are models, or limits of models, of another
one of larger rank.

`decide` compares chains of one size and sends those of different sizes to `across_sizes`;
`finding` holds what is found and its text form, `confirmation` checks it again.
"""

from disting.conditions.inclusion import ONE_SIDED as ONE_SIDED
from disting.conditions.inclusion import Inclusion as Inclusion
from disting.conditions.inclusion import InclusionFinding as InclusionFinding
from disting.conditions.inclusion import Inclusions as Inclusions
from disting.conditions.inclusion import Sense as Sense
from disting.conditions.inclusion import inclusions_from_dict as inclusions_from_dict
from disting.conditions.inclusion import inclusions_to_dict as inclusions_to_dict
from disting.questions.inclusion.confirmation import confirms as confirms
from disting.questions.inclusion.decide import CLOSURE as CLOSURE
from disting.questions.inclusion.decide import IMAGE as IMAGE
from disting.questions.inclusion.decide import inclusions as inclusions
from disting.questions.inclusion.decide import turned as turned
