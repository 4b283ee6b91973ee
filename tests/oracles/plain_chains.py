"""Chains as plain bordered matrices: mass, damping and stiffness put together element by element;
no code of the package.

A chain is read by its indices and flags alone: P = M s^2 + D s + K, force +1 on one mass and -1 on
another, sensor likewise,

    G(s) = s^order c^T P^-1 b / (1 + T1 s)
"""

from random import Random
from typing import Any

from tests.oracles.plain_models import Plain

ORDERS = {"position": 0, "velocity": 1, "acceleration": 2}


def plain_chain(chain: Any) -> Plain:
    """The model of a chain without its dead time, a factor of its own."""
    n = chain.n_masses
    entries = [[list[str]() for _ in range(n)] for _ in range(n)]
    names: list[str] = []

    def element(name: str, power: int, i: int, j: int) -> None:
        """A mass (power 2), damper (1) or spring (0) between i and j; 0 is the ground."""
        names.append(name)
        term = name + f"*s^{power}" * (power > 0)
        for a, b, sign in ((i, i, ""), (j, j, ""), (i, j, "-"), (j, i, "-")):
            if a and b:
                entries[a - 1][b - 1].append(sign + term)

    for i in range(1, n + 1):
        element(f"m{i}", 2, i, 0)
    for i in range(n):
        if i != chain.gap:
            element(f"k{i}", 0, i, i + 1)
            if chain.damped:
                element(f"d{i}", 1, i, i + 1)
    for i in chain.ground_dampers:
        element(f"b{i}", 1, i, 0)
    dynamics = tuple(
        tuple("+".join(f"({t})" for t in cell) or "0" for cell in row) for row in entries
    )
    port = lambda plus, minus: tuple(str((i == plus) - (i == minus)) for i in range(1, n + 1))  # noqa: E731
    order = ORDERS[str(chain.quantity)]
    lag = ["T1"] * chain.lag
    return Plain(
        (*names, *lag),
        dynamics,
        port(chain.act_plus, chain.act_minus),
        port(chain.meas_plus, chain.meas_minus),
        above=f"s^{order}" if order else "1",
        below="(1+T1*s)" if chain.lag else "1",
    )


def drawn_chain(draw: Random, masses: int, damped: bool) -> dict[str, Any]:
    """Arguments of a chain within (36) and (37) of the paper: any ports, some dampers to the
    ground, sometimes a lag.
    """
    gap = draw.randrange(masses)
    reference = (lambda: draw.randint(1, gap)) if gap else (lambda: 0)
    mass = lambda: draw.randint(gap + 1, masses)  # noqa: E731
    return {
        "n_masses": masses,
        "gap": gap,
        "act_minus": reference(),
        "act_plus": mass(),
        "meas_minus": reference(),
        "meas_plus": mass(),
        "quantity": draw.choice(list(ORDERS)),
        "damped": damped,
        "ground_dampers": tuple(i for i in range(1, masses + 1) if draw.random() < 0.35),
        "lag": draw.random() < 0.2,
        "dead_time": draw.random() < 0.1,
    }


def plain_state_space(chain: Any) -> tuple[list[list[str]], list[str], list[str], str]:
    """A, B, C, D of x'' = -M^-1 (K x + D x') + M^-1 b F with an acceleration sensor, as texts; the
    masses are on the diagonal of M.
    """
    n = chain.n_masses
    stiffness, damping = ([[list[str]() for _ in range(n)] for _ in range(n)] for _ in range(2))
    elements = [("k", i, i + 1, stiffness) for i in range(n) if i != chain.gap]
    elements += [("d", i, i + 1, damping) for i in range(n) if i != chain.gap and chain.damped]
    elements += [("b", i, 0, damping) for i in chain.ground_dampers]
    for letter, i, j, into in elements:
        name = f"{letter}{i}{j or ''}"
        for a, b, sign in ((i, i, "-"), (j, j, "-"), (i, j, "+"), (j, i, "+")):
            if a and b:
                into[a - 1][b - 1].append(sign + name)
    force, sensor = (
        [(i == plus) - (i == minus) for i in range(1, n + 1)]
        for plus, minus in ((chain.act_plus, chain.act_minus), (chain.meas_plus, chain.meas_minus))
    )
    lower = [
        [f"({''.join(cell) or '0'})/m{i}" for side in (stiffness, damping) for cell in side[i - 1]]
        for i in range(1, n + 1)
    ]
    upper = [[str(int(j == n + i)) for j in range(2 * n)] for i in range(n)]
    column = ["0"] * n + [f"{force[i]}/m{i + 1}" for i in range(n)]
    seen = ["+".join(f"({sensor[i]})*{lower[i][j]}" for i in range(n)) for j in range(2 * n)]
    through = "+".join(f"({sensor[i] * force[i]})/m{i + 1}" for i in range(n))
    return [*upper, *lower], column, seen, through
