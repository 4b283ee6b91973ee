"""Conditions 1 to 9 of the paper; they know nothing of each other, of caches or of verdicts."""

from disting.conditions.finding import Finding as Finding
from disting.conditions.finding import Outcome as Outcome
from disting.conditions.subject import Subject as Subject
from disting.conditions.table import CONDITIONS as CONDITIONS
