"""Changes of a machine of which an experiment lists several: a kind, a place, and a size that is
known.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from disting.algebra.certainty import residues
from disting.errors import InputError, short
from disting.model.kinds import CHANGES, Kind
from disting.model.names import is_too_long

P = TypeVar("P", int, str)  # a place
Q = TypeVar("Q", int, str)
GENERIC = "generic"  # in place of a number: one that is drawn once, the same for all models
GENERIC_BITS = 64


@dataclass(frozen=True, slots=True)
class Change(Generic[P]):
    """One thing that is done to the machine at a mass, of an exact positive size, None of what
    holds it still; a place is a number, or text where the chain is not known yet. Raises
    InputError.

    >>> from disting.model.kinds import BRAKE, LOCK
    >>> Change(LOCK, 2).text, Change(BRAKE, 1, "0.5").text
    ('mass 2 locked', 'brake 1/2 at mass 1')
    """

    kind: Kind
    place: P
    size: Fraction | None = None

    if TYPE_CHECKING:  # what may be given for a size, and what it becomes

        def __init__(self, kind: Kind, place: P, size: object = None) -> None:
            """See the class."""

    def __post_init__(self) -> None:
        if self.kind.is_port:
            raise InputError(f"moving a {self.kind.name} is not a change of the machine")
        if self.kind.takes_size:
            object.__setattr__(self, "size", number(self.kind.name, self.size))
        elif self.size is not None:
            raise InputError(f"a {self.kind.name} has no size: remove {short(self.size)}")

    @property
    def text(self) -> str:
        """In an experiment's words."""
        return self.kind.text.format(at=self.place, size=self.size)

    def moved(self, place: Callable[[P], Q]) -> "Change[Q]":
        """The same at the place that this one becomes."""
        return Change(self.kind, place(self.place), self.size)


def changes_of(arguments: Mapping[str, object]) -> Iterator[Change[Any]]:
    """Yield the changes that arguments of `Experiment` describe: masses of what takes no size,
    {mass: size} of what does; the caller checks the place. Raises InputError; TypeError for an
    argument of no kind.
    """
    names = [kind.argument for kind in CHANGES]
    unknown = sorted(arguments.keys() - set(names))
    if unknown:
        raise TypeError(f"an experiment has no {unknown[0]!r}; what it changes: {', '.join(names)}")
    for kind in CHANGES:
        value = arguments.get(kind.argument, ())
        if kind.takes_size:
            yield from (Change(kind, mass, size) for mass, size in _sizes(value))
        else:
            yield from (Change(kind, mass) for mass in _masses(value))


def in_order(changes: Iterable[Change[P]]) -> tuple[Change[P], ...]:
    """By kind and place; what is held twice is held once. Raises InputError for two sizes at one
    mass.
    """
    listed, places = list(changes), dict[tuple[Kind, P], Change[P]]()
    for change in listed:
        if change.kind.takes_size and (change.kind, change.place) in places:
            raise InputError(f"two known {change.kind.name}s at one mass: give their sum")
        places[change.kind, change.place] = change
    return tuple(sorted(places.values(), key=lambda c: (CHANGES.index(c.kind), c.place)))


def read_changes(kind: Kind, value: str, place: Callable[[str], P]) -> Iterator[Change[P]]:
    """Parse the value of a command for a kind: lock=2+3, inertia=1:0.5; `place` reads where. Raises
    InputError.

    >>> from disting.model.kinds import LOCK
    >>> [change.text for change in read_changes(LOCK, "2+3", int)]
    ['mass 2 locked', 'mass 3 locked']
    """
    if not kind.takes_size:
        yield from (Change(kind, place(at)) for at in value.split("+"))
        return
    at, colon, size = value.partition(":")
    if not colon:
        raise InputError(f"the size of a known {kind.name} is missing: write {kind.name}={at}:1")
    yield Change(kind, place(at), size)


def number(what: str, size_given: object) -> Fraction:
    """A known size, exact; GENERIC is one that is drawn once and for all, between 1 and 2.

    >>> number("inertia", 0.5), 1 < number("inertia", "generic") < 2
    (Fraction(1, 2), True)
    """
    if size_given == GENERIC:
        low = 1 << (GENERIC_BITS - 1)
        return Fraction(low + residues(f"generic {what}", 1, low)[0], low)
    try:
        size = Fraction(size_given if isinstance(size_given, Fraction) else _plain(size_given))
    except (ValueError, ZeroDivisionError):
        raise InputError(
            f"a known {what} is a positive number or {GENERIC}, not {short(size_given)}"
        ) from None
    if size <= 0:
        raise InputError(f"a known {what} is positive, not {short(str(size_given))}")
    return size


def _masses(masses: object) -> list[Any]:
    listed = [masses] if isinstance(masses, int) else masses
    if not isinstance(listed, Iterable):
        raise InputError(f"a locked mass is a whole number, not {short(masses)}")
    return list(listed)


def _sizes(sizes: object) -> list[tuple[Any, object]]:
    listed = sizes.items() if isinstance(sizes, Mapping) else sizes
    try:
        return [(mass, size) for mass, size in listed]  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        raise InputError(f"known sizes are written {{mass: size}}, not {short(sizes)}") from None


def _plain(size_given: object) -> str:
    text = str(size_given)
    if isinstance(size_given, bool) or is_too_long(text):
        raise ValueError(text)
    return text
