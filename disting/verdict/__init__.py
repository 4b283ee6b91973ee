"""The verdict on a pair, on all pairs of a list, and on families of thousands of models.

`query` says what may decide, `cascade` folds findings into the verdict on a pair, `deciding` those
of all pairs at once, `grouping` those of classes; `engine` keeps what was computed in a store.
"""

from disting.verdict.cascade import PROVES as PROVES
from disting.verdict.cascade import Step as Step
from disting.verdict.cascade import agreed as agreed
from disting.verdict.cascade import audit as audit
from disting.verdict.cascade import decide as decide
from disting.verdict.cascade import first as first
from disting.verdict.cascade import open_note as open_note
from disting.verdict.cascade import steps as steps
from disting.verdict.cascade import verdict_of as verdict_of
from disting.verdict.cascade import with_inclusion as with_inclusion
from disting.verdict.comparison import compare as compare
from disting.verdict.comparison import findings as findings
from disting.verdict.decisions import Decisions as Decisions
from disting.verdict.engine import Engine as Engine
from disting.verdict.engine import Progress as Progress
from disting.verdict.engine import silent as silent
from disting.verdict.joint import classes_safety as classes_safety
from disting.verdict.joint import family_safety as family_safety
from disting.verdict.joint import joint_in_words as joint_in_words
from disting.verdict.query import ALL_CONDITIONS as ALL_CONDITIONS
from disting.verdict.query import Query as Query
from disting.verdict.query import View as View
from disting.verdict.result import Relation as Relation
from disting.verdict.result import Verdict as Verdict
from disting.verdict.result import error_bound as error_bound
