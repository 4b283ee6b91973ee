"""The duality theorem: chains whose ports sit at the two sides of the gap, g and N - 1 - g masses
before it, are the same.

Let F = 1/(m s^2 + W) be the driving-point receptance of a free chain of total mass M at its end, m
its first mass, k its first spring (any law k(s)), F1 the receptance of the rest, of mass M1 = M -
m. Then 1/W = 1/k + F1, and with R1 = F1 - 1/(M1 s^2)

    1/(F - 1/(M s^2)) = (M m/M1) s^2 + (M/M1)^2 / (1/k + R1)

By induction F - 1/(M s^2) is the receptance of a grounded chain at its free end: mass M m/M1 at
the port, behind it the spring (M/M1)^2 k and (M/M1)^2 times the grounded chain of R1 (no mass,
hence the wall, if there is no R1). The map is a bijection of positive parameters, for given M; so
H = R + F = (F - 1/(M s^2)) + (R + 1/(M s^2)) is the receptance of both chains: they are
indistinguishable over complex, real and positive parameters. Springs and dampers are multiplied by
the same factors.
"""

from collections.abc import Mapping
from typing import Any

from disting.model.chain import Chain

Number = Any  # an element of a field
Law = tuple[Number, ...]  # (c, d) of a spring and its damper, (c,) undamped
Outwards = tuple[list[Number], list[Law]]  # masses and springs from the port outwards


def are_dual(left: Chain, right: Chain) -> bool:
    """Whether the theorem applies.

    >>> are_dual(Chain(3, 0, 0, 1, 0, 1, damped=True), Chain(3, 2, 2, 3, 2, 3, damped=True))
    True
    """
    plain = all(_at_gap(c) for c in (left, right)) and (left.damped, left.sensor) == (
        right.damped,
        right.sensor,
    )
    return plain and left.n_masses == right.n_masses == left.gap + right.gap + 1


def dual(chain: Chain, values: Mapping[str, Number]) -> dict[str, Number]:
    """Parameters of the dual chain with the same transfer function; exact for exact values."""
    n, g = chain.n_masses, chain.gap
    masses = [values[f"m{i}"] for i in range(1, n + 1)]
    names = [name for name in chain.parameters if name[0] == "k"]
    laws = [(values[k], values[f"d{k[1:]}"]) if chain.damped else (values[k],) for k in names]
    total = sum(masses[g + 1 :], masses[g])
    inner, springs = _grounded(masses[g:], laws[g:], total)
    outer, others = _free(masses[:g][::-1], laws[:g][::-1], total)
    target = _mirror_gap(chain)
    return dict(
        zip(
            target.parameters,
            _in_order(target, inner[::-1] + outer, springs[::-1] + others),
            strict=True,
        )
    )


def _at_gap(chain: Chain) -> bool:
    plain = not (chain.ground_dampers or chain.lag or chain.dead_time)
    return (
        plain
        and chain.collocated
        and (chain.act_minus, chain.act_plus) == (chain.gap, chain.gap + 1)
    )


def _mirror_gap(chain: Chain) -> Chain:
    h = chain.n_masses - 1 - chain.gap
    return Chain(chain.n_masses, h, h, h + 1, h, h + 1, sensor=chain.sensor, damped=chain.damped)


def _grounded(masses: list[Number], springs: list[Law], total: Number) -> Outwards:
    """The row of F - 1/(M s^2)."""
    if not springs:
        return [], []
    rest = total - masses[0]
    inner, laws = _grounded(masses[1:], springs[1:], rest)
    factor = (total / rest) ** 2
    return [total * masses[0] / rest, *(factor * m for m in inner)], [
        _scaled(law, factor) for law in (springs[0], *laws)
    ]


def _free(masses: list[Number], springs: list[Law], total: Number) -> Outwards:
    """The row of R + 1/(M s^2), the inverse: M1 = M^2/(M + mu)."""
    if not masses:
        return [total], []
    rest = total**2 / (total + masses[0])
    factor = (rest / total) ** 2
    inner, laws = _free(
        [factor * m for m in masses[1:]], [_scaled(law, factor) for law in springs[1:]], rest
    )
    return [total - rest, *inner], [_scaled(springs[0], factor), *laws]


def _scaled(law: Law, factor: Number) -> Law:
    return tuple(factor * x for x in law)


def _in_order(chain: Chain, masses: list[Number], laws: list[Law]) -> list[Number]:
    """Masses, springs, dampers: the order of a chain's parameters."""
    return [*masses, *(law[0] for law in laws), *(law[1] for law in laws if chain.damped)]
