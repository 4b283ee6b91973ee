"""One-sided inclusion: whether the models of one chain are models, or limits of models, of another
one of larger rank.

`decide` compares chains of one size and sends those of different sizes to `across_sizes`;
`finding` holds what is found and its text form, `verify` checks it again.
"""

from disting.inclusion.decide import CLOSURE as CLOSURE
from disting.inclusion.decide import IDEALS as IDEALS
from disting.inclusion.decide import IMAGE as IMAGE
from disting.inclusion.decide import asked_closure as asked_closure
from disting.inclusion.decide import asked_image as asked_image
from disting.inclusion.decide import by_rank as by_rank
from disting.inclusion.decide import implied_image as implied_image
from disting.inclusion.decide import inclusions as inclusions
from disting.inclusion.decide import joined as joined
from disting.inclusion.decide import needs_ideals as needs_ideals
from disting.inclusion.decide import quick_closure as quick_closure
from disting.inclusion.decide import turned as turned
from disting.inclusion.finding import ONE_SIDED as ONE_SIDED
from disting.inclusion.finding import Inclusion as Inclusion
from disting.inclusion.finding import InclusionFinding as InclusionFinding
from disting.inclusion.finding import Inclusions as Inclusions
from disting.inclusion.finding import Sense as Sense
from disting.inclusion.finding import inclusions_from_dict as inclusions_from_dict
from disting.inclusion.finding import inclusions_to_dict as inclusions_to_dict
from disting.inclusion.verify import confirms as confirms
