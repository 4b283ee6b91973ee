"""A row of masses with two ports: what a chain consists of.

A chain without a gap is one free row. A gap makes two of it: a grounded row, tied to the wall by
the spring and damper of its first mass, and a free one. Force and sensor cross the gap in the same
sense, so the receptance of a chain is the sum of the receptances of its rows, each between its own
two ports; by reciprocity it does not matter which of them is the force's.

With theta_i, phi_i the determinants of the masses left and right of i and k_i the joint between
the masses i and i + 1, the receptance between the ports a <= b of a row of n masses is

    H = theta_(a-1) k_a .. k_(b-1) phi_(b+1) / D,    deg D = 2 n,

of degree 2 (n - 1) in the numerator, less one (damped) or two (undamped) a joint between the ports.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from disting.errors import InputError
from disting.model.chain import Damper, Element, GroundDamper, Mass, Ports, Spring, Structure

FREE, GROUNDED = "free", "grounded"


@dataclass(frozen=True, slots=True, order=True)
class Row:
    """Masses 1..`n_masses` with springs (if `damped`, dampers too) between neighbours and, if
    `grounded`, from mass 1 to the wall; ports at the masses a <= b.

    `ground_dampers`: the masses with a damper to the ground; `before`: how many masses of the chain
    come before its first. One free mass alone has no springs, so it is not `damped` either. Raises
    InputError for ports or dampers that are not at its masses.
    """

    n_masses: int
    grounded: bool
    a: int
    b: int
    damped: bool = False
    ground_dampers: tuple[int, ...] = ()
    before: int = 0

    def __post_init__(self) -> None:
        if not 1 <= self.a <= self.b <= self.n_masses:
            raise InputError(
                f"the ports a <= b of a row are among its {self.n_masses} masses, not at {self.a}"
                f" and {self.b}"
            )
        if any(not 1 <= i <= self.n_masses for i in self.ground_dampers):
            raise InputError(
                f"ground dampers of a row sit at masses 1 to {self.n_masses}, not at"
                f" {self.ground_dampers}"
            )
        object.__setattr__(self, "damped", self.damped and bool(self.joints))

    @property
    def name(self) -> str:
        """Name of the row of a chain: "grounded" or "free"."""
        return GROUNDED if self.grounded else FREE

    @property
    def ports(self) -> tuple[int, int]:
        """Both ports, a and b."""
        return self.a, self.b

    @property
    def distance(self) -> int:
        """Springs between the ports."""
        return self.b - self.a

    @property
    def joints(self) -> range:
        """Left ends of the springs; 0 is the wall."""
        return range(0 if self.grounded else 1, self.n_masses)

    @property
    def is_whole(self) -> bool:
        """True if it is all of a chain without a gap."""
        return not self.grounded and self.before == 0

    @property
    def q(self) -> int:
        """2: its receptance is a function of s; 1: without any damper, of x = s^2."""
        return 2 if self.damped or self.ground_dampers else 1

    @property
    def relative_degree(self) -> int:
        """Relative degree of the receptance: it falls as s to the power minus this, for s to
        infinity.
        """
        return 2 + self.distance * (1 if self.damped else 2)

    @property
    def numerator_degree(self) -> int:
        """Degree of the receptance's numerator, as a function of s or x (see `q`).

        >>> [Row(4, True, 1, 2, damped).numerator_degree for damped in (True, False)]
        [5, 2]
        """
        return self.numerator_degree_in(self.q)

    def numerator_degree_in(self, q: int) -> int:
        """The same in s (q = 2), or in x = s^2 (q = 1) for a row without any damper."""
        return (2 * self.n_masses - self.relative_degree) * q // 2

    def poles_at_zero(self, q: int) -> int:
        """Multiplicity of the pole at 0 of a free row in s (q = 2) or in x = s^2 (q = 1): a motion
        of the whole, stopped by dampers to the ground.
        """
        return 1 if self.ground_dampers else q

    @property
    def structure(self) -> Structure:
        """Elements and ports of the row alone, with a sensor of position."""
        elements: list[Element] = [Mass(i) for i in range(1, self.n_masses + 1)]
        elements += [Spring(i) for i in self.joints]
        elements += [Damper(i) for i in self.joints if self.damped]
        elements += [GroundDamper(i) for i in self.ground_dampers]
        return Structure(self.n_masses, tuple(elements), Ports(0, self.a, 0, self.b), 0)

    @property
    def mirrored(self) -> "Row":
        """The same masses counted from the other end."""
        last = self.n_masses + 1
        dampers = tuple(last - i for i in reversed(self.ground_dampers))
        return replace(self, a=last - self.b, b=last - self.a, ground_dampers=dampers)

    @property
    def canonical(self) -> "Row":
        """The equivalent row with the smallest numbers, wherever it is in a chain: itself, or
        mirrored if it is free.

        >>> Row(5, False, 3, 5).canonical
        Row(n_masses=5, grounded=False, a=1, b=3, damped=False, ground_dampers=(), before=0)
        """
        return replace(self if self.grounded else min(self, self.mirrored), before=0)

    def __str__(self) -> str:
        where = "at a wall" if self.grounded else "free"
        dampers = "+".join(map(str, self.ground_dampers))
        words = [f"{self.n_masses} masses {where}, ports {self.a} and {self.b}"]
        words += [] if self.damped else ["undamped"]
        words += [f"ground dampers {dampers}"] if dampers else []
        return ", ".join(words)


def rows_of(structure: Structure) -> tuple[Row, ...]:
    """The rows that have ports, from the wall outwards; masses numbered from 1 in each.

    Raises InputError for a structure that no chain has: with more than two ports in a row, or
    dampers in parallel with some of a row's springs only.

    >>> from disting.model.chain import Chain
    >>> print(*rows_of(Chain(3, 1, 1, 2, 1, 3, damped=False).structure), sep="; ")
    1 masses at a wall, ports 1 and 1, undamped; 2 masses free, ports 1 and 2, undamped
    """
    return tuple(_rows(structure))


def grounded_and_free(structure: Structure) -> tuple[Row | None, Row]:
    """Both rows of a chain, the grounded one None if there is no gap."""
    *grounded, free = rows_of(structure)
    return (grounded[0] if grounded else None), free


def canonical_rows(structure: Structure) -> dict[str, Row]:
    """The rows by name, each in its canonical form; the free one first, which every chain has.

    >>> from disting.model.chain import Chain
    >>> chain = Chain(5, 2, 1, 4, 2, 5, damped=False)
    >>> [str(row) for row in canonical_rows(chain.structure).values()]
    ['3 masses free, ports 1 and 2, undamped', '2 masses at a wall, ports 1 and 2, undamped']
    """
    return {row.name: row.canonical for row in reversed(rows_of(structure))}


def _rows(structure: Structure) -> Iterator[Row]:
    p = structure.ports
    pairs = [(p.act_plus, p.meas_plus), (p.act_minus, p.meas_minus)]
    for first, last in structure.row_ends:
        inside = [pair for pair in pairs if all(first <= port <= last for port in pair)]
        if len(inside) > 1:
            raise InputError("the receptance of a row with four ports is not that of a chain's row")
        for pair in inside:
            yield _row(structure, first, last, pair)


def _row(structure: Structure, first: int, last: int, ports: tuple[int, int]) -> Row:
    """The row of these masses, renumbered."""
    before, n = first - 1, last - first + 1
    springs, dampers, ground_dampers = (
        {e.at - before for e in structure.elements if e.kind == kind} for kind in "kdb"
    )
    a, b = sorted(port - before for port in ports)
    inside = tuple(sorted(ground_dampers & set(range(1, n + 1))))
    row = Row(n, 0 in springs, a, b, bool(dampers & set(range(n))), inside, before)
    joints, possible = set(row.joints), set(range(n))
    if springs & possible != joints or dampers & possible != (joints if row.damped else set()):
        raise InputError("a row has springs between all neighbours, and dampers beside all or none")
    return row
