"""All parameter vectors of a chain that realise a given receptance exactly: inverse network
synthesis in ball arithmetic.

The receptance H of a chain with a gap is R + F: the grounded row between the minus ports, the free
row between the plus ports:

1. every subset of the poles for R (`poles`);
2. every chain with receptance R and every chain with F (`methods`);
3. every pair is multiplied out and compared.

Where a ball leaves out a zero that every solution has, a branch is refuted; if all are, no
solution exists (masses, springs and dampers all non-zero, complex ones included). Too wide balls
double the precision; what stays undecided at the last one is a special point.

Dampers to the ground: `friction`, `ground_dampers_only`, `driving_point`, `damped_next_to_end`,
`damped_neighbours`. A damper b_1 in parallel with the damped spring from mass 1 to the ground is
merged with it: only d_01 + b_1 is determined, a family of which half and half is listed. The pole
of a lag 1/(1 + T1 s) is one of the poles of H, each is tried; without any damper it is the one that
makes H even. A dead time is no rational function, and H exp(-Td s) determines both factors: it is
left out on both sides.

Lag: H = H0/(1 + T1 s), so -1/T1 is one of the poles of H, and H0 = H (1 + T1 s).

Without any damper H0 is a function of s^2, and the denominator of H, monic, is (s + 1/T1) E(s^2):
its odd part is s E, its even part E/T1, which gives T1 as a fraction.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from flint import acb, ctx, fmpq, fmpq_poly

from disting.fibres.synthesis.branch import (
    BOUNDARY,
    Ball,
    Dead,
    Imprecise,
    Leaf,
    Reason,
    Receptance,
    RowValues,
    combine,
    poly,
    product,
    roots,
    shift,
)
from disting.fibres.synthesis.confirm import CheckedValues, check, list_solutions
from disting.fibres.synthesis.methods import synthesise
from disting.fibres.synthesis.poles import Split, pole_splits
from disting.fibres.synthesis.task import (
    Confirmation,
    Exclusions,
    Fibre,
    Solution,
    Status,
    Target,
    degrees_differ,
    is_regular,
    poles_at_zero,
    rests_differently,
)
from disting.model.chain import Chain, Damper, GroundDamper, Mass, Spring
from disting.model.question import Answer
from disting.model.row import Row, grounded_and_free
from disting.model.symmetry import canonical

PRECISIONS = (192, 384, 768, 1536, 3072, 5000)


def fibre(chain: Chain, target: Target, *, confirm: bool = True) -> Fibre:
    """All parameter vectors of `chain` with this receptance. Completeness and emptiness are
    proven, see `Status`.

    `confirm`: search a proof that each solution solves a square subsystem, which takes longer than
    all the rest; without it solutions are reported to hold within their balls.
    """
    if chain.dead_time:
        return Fibre(Status.NOT_COVERED, reason="a dead time is no rational function; leave it out")
    form = canonical(chain)
    canonical_fibre = _canonical_fibre(form.chain, target, confirm)
    back = {image: name for name, image in form.renaming.items()}
    return replace(
        canonical_fibre,
        solutions=tuple(_rename_solution(s, back, chain) for s in canonical_fibre.solutions),
    )


def _canonical_fibre(chain: Chain, target: Target, confirm: bool) -> Fibre:
    if chain.damped and chain.gap and 1 in chain.ground_dampers:
        single = replace(chain, ground_dampers=chain.ground_dampers[1:])
        return share_dampers(chain, _canonical_fibre(single, target, confirm))
    if chain.lag and not chain.damped and not chain.ground_dampers:
        factors = without_lag(target)
        if factors is None:
            return _without_lag_pole(chain, target)
        return with_lag(
            chain, _canonical_fibre(replace(chain, lag=False), factors[0], confirm), factors[1]
        )
    ruled_out = _ruled_out(chain, target)
    return _search_branches(chain, target, confirm) if ruled_out is None else ruled_out


def _without_lag_pole(chain: Chain, target: Target) -> Fibre:
    """Of full degree, no pole cancels."""
    if target.denominator.degree() > 2 * chain.n_masses:
        return Fibre(Status.EMPTY, reason="no pole is that of a lag before an undamped chain")
    return Fibre(Status.DEGENERATE, reason="missing poles")


def _ruled_out(chain: Chain, target: Target) -> Fibre | None:
    """Fibre that follows from the degrees and multiplicities of the target alone."""
    grounded, free = grounded_and_free(chain.structure)
    q, n, lag = _q(chain), chain.n_masses, int(chain.lag)
    whole = free if grounded is None else None
    if q == 1 and not target.is_even:
        return Fibre(Status.EMPTY, reason="a damped receptance has no undamped chain")
    folded = target.folded(q)
    if degrees_differ(folded, q, n, whole, lag):
        return Fibre(Status.EMPTY, reason="the degrees of numerator and denominator differ")
    if folded.denominator.degree() == q * n + lag and rests_differently(folded, q, free):
        return Fibre(Status.EMPTY, reason="the multiplicities of the pole at zero differ")
    if not is_regular(folded, q, n, whole, lag) or (q == 2 and target.is_even):
        return Fibre(Status.DEGENERATE, reason="multiple or missing poles or zeros")
    return None


def _search_branches(chain: Chain, target: Target, confirm: bool) -> Fibre:
    """Every branch, with as many bits as it takes."""
    for bits in PRECISIONS:
        with ctx.workprec(bits):
            try:
                leaves = list(_solutions(chain, target))
                return replace(_judge_branches(chain, target, leaves, confirm), precision_bits=bits)
            except Imprecise as failure:
                reason = str(failure)
    return Fibre(Status.DEGENERATE, precision_bits=PRECISIONS[-1], reason=reason)


def _solutions(chain: Chain, target: Target) -> Iterator[CheckedValues | Dead]:
    """Every leaf, both rows multiplied out."""
    folded = target.folded(_q(chain))
    low = poles_at_zero(folded)
    whole = replace(folded.balls, exact=None if chain.gap else folded.numerator)
    for data, time in lag_poles(folded.balls, low) if chain.lag else [(whole, {})]:
        for leaf in _leaves(chain, data, low):
            yield (
                _multiply_checked(chain, leaf, time, target)
                if isinstance(leaf, RowValues)
                else leaf
            )


def _multiply_checked(
    chain: Chain, rows: RowValues, time: dict[str, Ball], target: Target
) -> CheckedValues | Dead:
    """The numbers checked; a member of a family that fails refutes nothing but itself."""
    result = check(chain, _name_values(rows, chain) | time, rows.gauges, target)
    return BOUNDARY if rows.gauges and isinstance(result, Dead) else result


def _q(chain: Chain) -> int:
    """2: all is done in s; 1: without any damper, in x = s^2."""
    return 2 if chain.damped or chain.ground_dampers else 1


def _leaves(chain: Chain, data: Receptance, low: int) -> Iterator[Leaf]:
    grounded, free = grounded_and_free(chain.structure)
    if grounded is None:
        yield from synthesise(free, data.own(free, _q(chain)))
        return
    for split in pole_splits(data, grounded, free, low):
        yield from [split] if isinstance(split, Dead) else _both(split, grounded, free, _q(chain))


def _both(split: Split, grounded: Row, free: Row, q: int) -> Iterator[Leaf]:
    """Every grounded row with every free one."""
    return combine(
        synthesise(grounded, split.grounded.own(grounded, q)),
        lambda: synthesise(free, split.free.own(free, q)),
        _join_values,
    )


def _join_values(a: RowValues, b: RowValues) -> RowValues:
    return RowValues(
        a.masses + b.masses,
        a.springs + b.springs,
        a.gauges + b.gauges,
        a.all_dampers + b.all_dampers,
    )


def _name_values(rows: RowValues, chain: Chain) -> dict[str, Ball]:
    """Values by parameter name, in the structure's order."""
    joints = [i for i in range(chain.n_masses) if i != chain.gap]
    values = {Mass(i).parameter: m for i, m in enumerate(rows.masses, 1)}
    values |= {Spring(i).parameter: k[0] for i, k in zip(joints, rows.springs, strict=True)}
    if chain.damped:
        values |= {Damper(i).parameter: k[1] for i, k in zip(joints, rows.springs, strict=True)}
    return values | {
        GroundDamper(i).parameter: rows.all_dampers[i - 1] for i in chain.ground_dampers
    }


def _rename_solution(solution: Solution, names: dict[str, str], chain: Chain) -> Solution:
    """The solution in the parameters of the chain as given."""
    values = {names[name]: value for name, value in solution.values.items()}
    return replace(solution, values={name: values[name] for name in chain.parameters})


def _judge_branches(
    chain: Chain, target: Target, leaves: list[CheckedValues | Dead], confirm: bool
) -> Fibre:
    """Status from what the branches ended in."""
    count = Counter(leaf.reason for leaf in leaves if isinstance(leaf, Dead))
    tests = Exclusions(count[Reason.NONZERO], count[Reason.BOUNDARY], count[Reason.OPEN])
    solved = [leaf for leaf in leaves if isinstance(leaf, CheckedValues)]
    solutions = list_solutions(chain, solved, target, complete=not tests.uncovered, confirm=confirm)
    status, reason = _status(solutions, tests)
    return Fibre(status, solutions, tests=tests, reason=reason)


def _status(solutions: tuple[Solution, ...], tests: Exclusions) -> tuple[Status, str]:
    if tests.uncovered:
        return (
            Status.NOT_COVERED,
            "a branch needs a method for non-collocated chains that is not provided",
        )
    if any(s.gauges for s in solutions):
        return Status.INFINITE, "a family of solutions; one member per branch is listed"
    if solutions:
        return Status.COMPLETE, (
            "all other branches are refuted"
            if not tests.boundary
            else "except for elements near zero"
        )
    if tests.boundary:
        return Status.DEGENERATE, "an element cannot be distinguished from zero"
    return Status.EMPTY, "every branch is refuted"


def share_dampers(chain: Chain, whole: Fibre) -> Fibre:
    """The fibre of the chain with both dampers from that of the chain without b_1: half and half
    of each solution.

    Where d_01 + b_1 = 0, d_01 is at the boundary there.
    """
    status = Status.INFINITE if whole.status is Status.COMPLETE else whole.status
    reason = (
        "a family of solutions: d_01 + b_1 alone is determined"
        if status is Status.INFINITE
        else whole.reason
    )
    return replace(
        whole,
        status=status,
        reason=reason,
        solutions=tuple(_halve_damper(chain, s) for s in whole.solutions),
    )


def _halve_damper(chain: Chain, solution: Solution) -> Solution:
    half = solution.values["d01"] / 2
    shared_values = solution.values | {"d01": half, "b1": half}
    values = {name: shared_values[name] for name in chain.parameters}
    return replace(
        solution, values=values, gauges=solution.gauges + 1, confirmation=Confirmation.BALLS
    )


def lag_poles(data: Receptance, low: int) -> Iterator[tuple[Receptance, dict[str, Ball]]]:
    """Yield H0 and T1 for every pole but that at 0, of multiplicity `low`."""
    poles = roots(shift(data.denominator, -low), data.denominator.degree() - low)
    for i, p in enumerate(poles):
        rest = shift(product(poles[:i] + poles[i + 1 :]), low)
        yield Receptance(data.numerator * poly([-1 / p]), rest), {"T1": -1 / p}


def without_lag(t: Target) -> tuple[Target, fmpq] | None:
    """H0 = H (1 + T1 s) as a function of s^2, and T1; None if there is no such T1."""
    odd = fmpq_poly([0 if i % 2 == 0 else c for i, c in enumerate(t.denominator.coeffs())])
    even = t.denominator - odd
    if not odd.degree() > even.degree() >= 0 or any(t.numerator.coeffs()[1::2]):
        return None
    time = 1 / even[even.degree()]
    denominator = even * time
    if denominator * fmpq_poly([0, 1]) != odd:
        return None
    return Target(t.numerator * time, denominator), time


def with_lag(chain: Chain, whole: Fibre, time: fmpq) -> Fibre:
    """The fibre of the undamped chain with its lag."""
    with ctx.workprec(max(whole.precision_bits, ctx.prec)):
        return replace(whole, solutions=tuple(_with(chain, s, acb(time)) for s in whole.solutions))


def _with(chain: Chain, solution: Solution, time: Ball) -> Solution:
    """T1 is known exactly; an undamped solution that a Krawczyk step proves stays one."""
    values = {name: time if name == "T1" else solution.values[name] for name in chain.parameters}
    positive = solution.positive if time.real > 0 else Answer.NO
    return replace(solution, values=values, positive=positive)
