"""The few errors that a user can meet. Not knowing is no error: it is the relation UNDECIDED."""

from collections.abc import Iterable


class DistingError(Exception):
    """Base of every error that this package raises on purpose; the message names the cause and the remedy."""


class ConstraintViolation(DistingError):
    """A chain that breaks one of the constraints (36) or (37): no model of the class."""


class InputError(DistingError):
    """An argument that cannot be understood, such as a model reference that does not exist."""


class CatalogError(DistingError):
    """A catalogue file that is missing, damaged or written by another schema."""


class ContradictionError(DistingError):
    """Two conditions decided one pair differently: a defect of the program, never of the input."""


def listed(names: Iterable[str], most: int = 40) -> str:
    """Names for a message, as many as a person reads.

    >>> listed(["f", "Re", "Im", "x" * 99], most=2), listed([])
    ('f, Re and 2 more', 'none')
    """
    found = [name if len(name) <= 60 else f"{name[:57]}..." for name in names]
    more = f" and {len(found) - most} more" if len(found) > most else ""
    return (", ".join(found[:most]) or "none") + more
