"""The rules that may decide a pair: the conditions of the paper, and the questions that follow
them.
"""

from disting.conditions.finding import Finding as Finding
from disting.conditions.finding import Outcome as Outcome
from disting.conditions.rule import Role as Role
from disting.conditions.rule import Rule as Rule
from disting.conditions.side import Side as Side
from disting.conditions.table import CONDITIONS as CONDITIONS
