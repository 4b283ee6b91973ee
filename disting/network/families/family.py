"""Interface of a family of networks, and of families of one kind, for commands, catalogues and
pages.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache

from disting.network.network import Network
from disting.network.notation import network_of

DAMPED = "-damped"


@dataclass(frozen=True, slots=True)
class NetworkFamily:
    """Networks by name, in order; `source` yields the texts. `is_shipped`: its verdicts are, and
    `in_brief`: after a brief search, as it is large.

    >>> from disting.network.families import family_of
    >>> family_of("circuits-4").networks[:2]
    (<Network: R1, circuit, 1 node, R1>, <Network: L1, circuit, 1 node, L1>)
    """

    name: str
    title: str
    source: Callable[[], Iterable[str]]
    is_shipped: bool = False
    in_brief: bool = False

    @property
    def networks(self) -> tuple[Network, ...]:
        """All of them."""
        return _read(self.source)


@cache
def _read(source: Callable[[], Iterable[str]]) -> tuple[Network, ...]:
    return tuple(network_of(text) for text in source())


@dataclass(frozen=True, slots=True)
class Kind:
    """Families of networks that differ in a number, such as machines-2 and machines-3.

    `place` is that in lists; `sizes` are listed, and numbers up to `largest` can be requested.
    `text` describes a family N; `title(N)` is that of its page. `texts(N, joint)` yields the
    networks, `joint` being that of springs: with dampers "=", or "~" without; `has_dampers`: there
    are both. `shipped` and `in_brief` name families as NetworkFamily has them. `with_loops`, of
    machines of N masses: whether all of them are in, those with loops too, or only those without;
    None where a machine that somebody describes may be in none.
    """

    name: str
    place: int
    sizes: tuple[int, ...]
    largest: int
    text: str
    title: Callable[[int], str]
    texts: Callable[[int, str], Iterable[str]]
    has_dampers: bool = False
    shipped: tuple[str, ...] = ()
    in_brief: tuple[str, ...] = ()
    with_loops: bool | None = None

    def family(self, size: int, behind: str = "") -> NetworkFamily:
        """The family of that number; `behind`: DAMPED or nothing."""
        name, joint = f"{self.name}-{size}{behind}", "=" if behind else "~"
        damping = f", {'' if behind else 'un'}damped" if self.has_dampers else ""
        return NetworkFamily(
            name,
            self.title(size) + damping,
            lambda: self.texts(size, joint),
            name in self.shipped,
            name in self.in_brief,
        )

    def families(self) -> Iterator[NetworkFamily]:
        """Yield those that are listed."""
        for size in self.sizes:
            for behind in ("", DAMPED) if self.has_dampers else ("",):
                yield self.family(size, behind)

    def has(self, size: int, behind: str) -> bool:
        """Return True if there is a family of that number and damping."""
        return self.sizes[0] <= size <= self.largest and (self.has_dampers or not behind)
