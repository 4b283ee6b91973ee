"""An oracle: frequency responses of chains by a linear solve, with the matrices written down
from the picture alone.
"""

from fractions import Fraction

import numpy as np

PLACES = (0.3 + 1.1j, 2.5 - 0.7j, 7.0 + 3.0j, -1.2 + 5.0j)


def response(chain, values, s):
    """Of the chain at the complex frequency s, with dampers to the ground, lag and dead time."""
    n = chain.n_masses
    a, factor = np.zeros((n, n), dtype=complex), 1.0
    for name, value in values.items():
        if name == "T1":
            factor /= 1 + value * s
        elif name == "Td":
            factor *= np.exp(-value * s)
        elif name[0] in "mb":
            a[int(name[1:]) - 1, int(name[1:]) - 1] += value * (s**2 if name[0] == "m" else s)
        else:
            i, j = (int(digit) for digit in name[1:3])
            v = np.array([(node == j) - float(node == i) for node in range(1, n + 1)])
            a += value * (s if name[0] == "d" else 1) * np.outer(v, v)
    force, sensor = np.zeros(n + 1), np.zeros(n + 1)
    force[chain.act_plus] += 1
    force[chain.act_minus] -= 1
    sensor[chain.meas_plus] += 1
    sensor[chain.meas_minus] -= 1
    return factor * (sensor[1:] @ np.linalg.solve(a, force[1:]))


def agree(chain, values, member, tolerance=1e-8):
    """Whether a member of a list has the frequency response of the given model."""
    given = {name: float(Fraction(str(v))) for name, v in values.items()}
    return all(
        abs(response(member.chain, member.values, s) / response(chain, given, s) - 1) < tolerance
        for s in PLACES
    )
