"""Equations of motion A(s) = M s^2 + D s + K, assembled from indices and parameter names alone,
over any numbers.

Each element adds parameter * s^power * v v' for a vector v of the masses. This shares no code with
disting.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

Vector = list[int]


@dataclass(frozen=True)
class Element:
    """A parameter, the power of s it enters with, and its vector of masses."""

    name: str
    power: int
    vector: tuple[int, ...]


def elements(chain: Any) -> list[Element]:
    """Masses, springs and dampers of a chain, by its indices and the order of its names: m1..,
    k.., d..
    """
    n = chain.n_masses
    joints = [unit(n, i + 1, i) for i in range(n) if i != chain.gap]
    masses = [unit(n, i, 0) for i in range(1, n + 1)]
    kinds = {"m": (2, iter(masses)), "k": (0, iter(joints)), "d": (1, iter(joints))}
    return [
        Element(name, kinds[name[0]][0], tuple(next(kinds[name[0]][1])))
        for name in chain.parameters
    ]


def ports(chain: Any) -> tuple[Vector, Vector]:
    """e_act and e_meas."""
    n = chain.n_masses
    return unit(n, chain.act_plus, chain.act_minus), unit(n, chain.meas_plus, chain.meas_minus)


def unit(n: int, plus: int, minus: int) -> Vector:
    """+1 at mass `plus`, -1 at mass `minus`; 0 is the ground."""
    return [int(i == plus) - int(i == minus) for i in range(1, n + 1)]


def response(chain: Any, values: Mapping[str, Fraction], s: Fraction) -> Fraction:
    """Receptance e_meas' A(s)^-1 e_act at one rational number s, by elimination."""
    n, (force, sensor) = chain.n_masses, ports(chain)
    rows = [[Fraction(0)] * n + [Fraction(f)] for f in force]
    for e in elements(chain):
        term, touched = values[e.name] * s**e.power, [i for i in range(n) if e.vector[i]]
        for i, j in product(touched, repeat=2):
            rows[i][j] += e.vector[i] * e.vector[j] * term
    solution = solved(rows)
    return sum((x * w for x, w in zip(solution, sensor, strict=True)), Fraction(0))


def solved(rows: Sequence[Sequence[Fraction]]) -> list[Fraction]:
    """Solution of the linear system [A | b]; A is positive definite for s > 0, so no pivot is
    zero.
    """
    work = [list(row) for row in rows]
    for i, pivot in enumerate(work):
        work[i] = [x / pivot[i] for x in pivot]
        for j, row in enumerate(work):
            if j != i and row[i]:
                work[j] = [x - row[i] * y for x, y in zip(row, work[i], strict=True)]
    return [row[-1] for row in work]
