"""The verdict on a pair: what may decide (`query`), what is found (`result`), and from findings
to it (`cascade`).
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
from disting.verdict.query import ALL_CONDITIONS as ALL_CONDITIONS
from disting.verdict.query import FIBRE as FIBRE
from disting.verdict.query import PARAMETERS as PARAMETERS
from disting.verdict.query import Query as Query
from disting.verdict.query import View as View
from disting.verdict.result import Relation as Relation
from disting.verdict.result import Verdict as Verdict
from disting.verdict.result import error_bound as error_bound
