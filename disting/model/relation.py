"""What is known of a pair of models."""

from enum import StrEnum


class Relation(StrEnum):
    """What is known of a pair over a domain of parameters.

    INDISTINGUISHABLE: generic parameters of either model have an equivalent in the other.
    DISTINGUISHABLE: those of one of them, at least, have none; the verdict's inclusion and its two
    shares tell of the other one. SOMETIMES: some parameters have an equivalent and others have
    none, of two models that are indistinguishable over complex parameters.
    """

    DISTINGUISHABLE = "distinguishable"
    INDISTINGUISHABLE = "indistinguishable"
    SOMETIMES = "sometimes"
    UNDECIDED = "undecided"
