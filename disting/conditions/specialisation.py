"""A smaller chain as a limit of a larger one: a spring without bound makes one mass of two, a spring of zero lets an end go.

The transfer function of a chain is N/D with N and D affine in the stiffness w = k + d s of one joint, because w enters A(s) as
w v v^T: N/D = (N_0 + w N_1)/(D_0 + w D_1). For k without bound the limit is N_1/D_1, the transfer function of the chain in
which that joint is rigid: its two masses, and their dampers to the ground, are added; at the wall, the first mass rests. For
k = d = 0 it is N_0/D_0, in which a piece without force and sensor drops out. Either way every model of the smaller chain, for
all values of its parameters, is a limit of models of the larger one; step by step also of chains of several masses more.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache

from disting.algebra.sampling import residues
from disting.errors import ConstraintViolation
from disting.invariants.transfer import receptance
from disting.model.chain import Chain
from disting.model.structure import Damper, Spring
from disting.model.symmetry import canonical

RIGID, CUT = "∞", "0"
POINTS = 3  # at which a limit is checked
Step = tuple[str, str]
"""A spring of the canonical form at hand, and what it tends to: RIGID, or CUT together with the damper beside it."""


@dataclass(frozen=True, slots=True)
class Specialised:
    """One limit of a chain: the joint left of which mass it was, what its spring tends to, and the `chain` that results."""

    joint: int
    limit: str
    chain: Chain

    @property
    def step(self) -> Step:
        """The spring by name, and its limit."""
        return Spring(self.joint).parameter, self.limit


def specialised(chain: Chain) -> Iterator[Specialised]:
    """Yield every chain with one mass less that is a limit of this one.

    >>> [(s.step, s.chain.meas_plus) for s in specialised(Chain(2, meas_plus=2))]
    [(('k12', '∞'), 1)]
    """
    for joint in range(chain.n_masses):
        if joint != chain.gap:
            for limit, smaller in ((RIGID, _rigid(chain, joint)), (CUT, _cut(chain, joint))):
                if smaller is not None:
                    yield Specialised(joint, limit, smaller)


def limit_path(small: Chain, large: Chain) -> tuple[Step, ...]:
    """A shortest way from the larger chain to the smaller one; () if there is none by such limits.

    >>> limit_path(Chain(1), Chain(3))
    (('k12', '∞'), ('k12', '∞'))
    """
    return _reached(canonical(large).chain, small.n_masses).get(canonical(small).chain, ())


def follows(large: Chain, small: Chain, steps: tuple[Step, ...]) -> bool:
    """Whether these steps lead from the larger to the smaller canonical chain, each limit seen in exact numbers."""
    chains = {large}
    for step in steps:
        ends = [(chain, s) for chain in chains for s in specialised(chain) if s.step == step]
        chains = {canonical(s.chain).chain for chain, s in ends if _is_limit(chain, s)}
    return small in chains


def _is_limit(chain: Chain, s: Specialised) -> bool:
    """N_1/D_1 or N_0/D_0 against the smaller chain's transfer function, at points with fractions for s and the parameters."""
    return all(_agree(chain, s, seed) for seed in range(POINTS))


def _agree(chain: Chain, s: Specialised, seed: int) -> bool:
    numbers = residues(f"specialisation:{seed}:{chain}", len(chain.parameters) + 1, 10**6)
    values = {name: Fraction(n, 1000) for name, n in zip(chain.parameters, numbers, strict=False)}
    name, damper, at = s.step[0], Damper(s.joint).parameter, Fraction(numbers[-1], 777)
    values |= dict.fromkeys({name, damper} & values.keys(), Fraction(0))
    (n0, d0), (n1, d1) = (_value(chain, values | {name: Fraction(w)}, at) for w in (0, 1))
    num, den = (n1 - n0, d1 - d0) if s.limit == RIGID else (n0, d0)
    small_num, small_den = _value(s.chain, _merged(chain, s, values), at)
    return num * small_den == small_num * den and den != 0


def _value(chain: Chain, values: dict[str, Fraction], at: Fraction) -> tuple[Fraction, Fraction]:
    """Numerator and denominator of the receptance at s = `at`."""
    found = receptance(chain.structure, values, at, Fraction(1))
    return found.num, found.den


def _merged(chain: Chain, s: Specialised, values: dict[str, Fraction]) -> dict[str, Fraction]:
    """Parameters of the smaller chain: elements that come together are added, those that drop out are left out."""
    merged = dict.fromkeys(s.chain.parameters, Fraction(0))
    for e in chain.structure.elements:
        dropped = s.limit == CUT and e.kind in "mb" and e.at == s.joint + 1
        at = e.at - (e.at > s.joint)
        name = e._replace(at=at).parameter
        if not dropped and name in merged and (at > 0 or e.kind in "kd") and not (e.kind in "kd" and e.at == s.joint):
            merged[name] += values[e.parameter]
    return merged | {name: values[name] for name in ("T1",) if name in merged}


@cache
def _reached(large: Chain, n_masses: int) -> dict[Chain, tuple[Step, ...]]:
    """All canonical chains of so many masses that are limits, each with the first way there."""
    found: dict[Chain, tuple[Step, ...]] = {large: ()}
    for _ in range(large.n_masses - n_masses):
        below: dict[Chain, tuple[Step, ...]] = {}
        for chain, steps in found.items():
            for s in specialised(chain):
                below.setdefault(canonical(s.chain).chain, (*steps, s.step))
        found = below
    return found


def _rigid(chain: Chain, joint: int) -> Chain | None:
    """The masses at both ends of a joint are one; those to the right are numbered anew."""
    if chain.n_masses == 1:
        return None

    def moved(i: int) -> int:
        return i - 1 if i > joint else i

    dampers = tuple({moved(i) for i in chain.ground_dampers} - {0})
    return _made(
        chain,
        gap=chain.gap - (joint < chain.gap),
        act_minus=moved(chain.act_minus),
        act_plus=moved(chain.act_plus),
        meas_minus=moved(chain.meas_minus),
        meas_plus=moved(chain.meas_plus),
        ground_dampers=dampers,
    )


def _cut(chain: Chain, joint: int) -> Chain | None:
    """The last mass of the free or of the grounded part drops out, if it has neither force nor sensor."""
    last = joint + 1
    if joint == 0 or last not in (chain.n_masses, chain.gap) or last in chain.indices[2:]:
        return None
    return _rigid(replace(chain, ground_dampers=tuple(i for i in chain.ground_dampers if i != last)), joint)


def _made(chain: Chain, **indices: object) -> Chain | None:
    """The chain with one mass less; None if it would be none (its force or sensor would act on the ground alone)."""
    try:
        return replace(chain, n_masses=chain.n_masses - 1, **indices)  # type: ignore[arg-type]
    except ConstraintViolation:
        return None
