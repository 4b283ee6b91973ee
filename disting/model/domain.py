"""Which parameter values a statement is about."""

from enum import StrEnum


class Domain(StrEnum):
    """Admissible parameter values. What is said of complex values is said of generic ones."""

    COMPLEX = "complex"
    REAL = "real"
    POSITIVE = "positive"
