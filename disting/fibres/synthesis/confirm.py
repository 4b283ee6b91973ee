"""Existence proven for a square subsystem: one Krawczyk step with as many coefficient equations as
parameters.

With f(x) = coefficients(x) - given ones (independent rows chosen at the midpoint m), C near
J(m)^-1 and a box X around m,

    K = m - C f(m) + (1 - C J(X)) (X - m)   inside X     implies    f has exactly one zero in X

(Krawczyk 1969; for complex boxes the mean value form holds, f being analytic and the box convex).
The remaining equations are not proven by this: that they hold rests on their balls, which can be
made as small as one likes but never zero.

Candidates multiplied out: the coefficients of the chain's receptance, and their derivatives,
as balls; and the solutions that they are: which are real, which are positive.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

from flint import acb, acb_mat, acb_poly, arb, ctx, fmpq

from disting.behaviour.transfer import Rational, plain_receptance, receptance
from disting.fibres.synthesis.branch import NONZERO, TOLERANCE, Ball, Dead, Imprecise
from disting.fibres.synthesis.task import Confirmation, Exact, Solution, Target
from disting.model.chain import Chain
from disting.model.question import Answer

Matrix = list[list[Ball]]
Balls = dict[str, Ball]


def confirmation(chain: Chain, values: dict[str, Ball], target: Target) -> Confirmation:
    """SUBSYSTEM if one Krawczyk step succeeds, BALLS otherwise."""
    mid = {name: v.mid() for name, v in values.items()}
    residual, jacobian = _system(chain, mid, target)
    rows = _independent(
        [[entry.mid() for entry in row] for row in jacobian], [v.abs_upper() for v in mid.values()]
    )
    if len(rows) < len(mid):
        return Confirmation.BALLS
    return _krawczyk(chain, values, target, rows, [residual[i] for i in rows])


def _krawczyk(
    chain: Chain, values: dict[str, Ball], target: Target, rows: list[int], residual: list[Ball]
) -> Confirmation:
    box = {name: _inflate_ball(v) for name, v in values.items()}
    mid = {name: v.mid() for name, v in values.items()}
    _, jacobian = _system(chain, box, target)
    wide = acb_mat([jacobian[i] for i in rows])
    try:
        inverse = wide.mid().inv().mid()
    except ZeroDivisionError:
        return Confirmation.BALLS
    size = len(rows)
    identity = acb_mat([[int(i == j) for j in range(size)] for i in range(size)])
    offset = acb_mat([[box[name] - mid[name]] for name in mid])
    step = (identity - inverse * wide) * offset - inverse * acb_mat([[r] for r in residual])
    inside = all(offset[i, 0].contains_interior(step[i, 0]) for i in range(size))
    return Confirmation.SUBSYSTEM if inside else Confirmation.BALLS


def _inflate_ball(value: Ball) -> Ball:
    """Box around a ball: at least twice as wide, and wide enough for a Krawczyk step at the
    present precision.
    """
    radius = 2 * value.rad() + value.abs_upper() * arb(2) ** (-ctx.prec // 3)
    spread = arb(0, radius.upper())
    return value.mid() + acb(spread, spread)


def _system(chain: Chain, values: dict[str, Ball], target: Target) -> tuple[list[Ball], Matrix]:
    """Residual and Jacobian of all coefficients, scaled by the given ones; rows that are zero
    by theory are left out.
    """
    raw = evaluate(chain, values)
    top = raw.den.degree()
    residual: list[Ball] = []
    jacobian: Matrix = []
    pairs = (
        (raw.num, raw.num_gradient, target.numerator),
        (raw.den, raw.den_gradient, target.denominator),
    )
    for ours, gradient, wanted in pairs:
        for i in range(wanted.degree() + 1):
            if wanted[i] and not (ours is raw.den and i == top):
                value = ours[i] / raw.den[top]
                residual.append(value / acb(wanted[i]) - 1)
                slopes = (
                    (gradient[n][i] - value * raw.den_gradient[n][top]) / raw.den[top]
                    for n in values
                )
                jacobian.append([slope / acb(wanted[i]) for slope in slopes])
    return residual, jacobian


def _independent(jacobian: Matrix, scales: Iterable[arb]) -> list[int]:
    """Rows chosen by elimination with complete pivoting on midpoints, parameters scaled to one:
    no proof, a good choice.
    """
    work = [[entry * s for entry, s in zip(row, scales, strict=True)] for row in jacobian]
    left = list(range(len(work)))
    chosen: list[int] = []
    for _ in range(len(work[0]) if work else 0):
        pivot, column = max(
            ((i, j) for i in left for j in range(len(work[i]))),
            key=lambda ij: float(work[ij[0]][ij[1]].abs_upper()),
        )
        if not float(work[pivot][column].abs_upper()) > 1e-30:
            return chosen
        chosen.append(pivot)
        left.remove(pivot)
        for i in left:
            factor = (work[i][column] / work[pivot][column]).mid()
            work[i] = [(a - factor * b).mid() for a, b in zip(work[i], work[pivot], strict=True)]
        if not left:
            break
    return sorted(chosen)


@dataclass(frozen=True, slots=True)
class CheckedValues:
    """Parameter values whose receptance agrees with the target within the balls; `width` as in
    Solution.
    """

    values: dict[str, Ball]
    gauges: int
    width: float


def evaluate(chain: Chain, values: dict[str, Ball]) -> Rational[acb_poly]:
    """Receptance and gradients over balls."""
    return receptance(chain.structure, _lift_values(values), acb_poly([0, 1]), acb_poly([1]))


def check(
    chain: Chain, values: dict[str, Ball], gauges: int, target: Target
) -> CheckedValues | Dead:
    """Compare every coefficient, the denominator made monic; a ball without the given
    coefficient refutes the candidate.
    """
    num, den = plain_receptance(
        chain.structure, _lift_values(values), acb_poly([0, 1]), acb_poly([1])
    )
    lead = den[den.degree()]
    width = 0.0
    for ours, wanted in ((num, target.numerator), (den, target.denominator)):
        largest = max(abs(c) for c in wanted.coeffs())
        for i, coefficient in enumerate(_pad_coefficients(wanted, ours.degree())):
            gap = ours[i] / lead - acb(coefficient)
            if not gap.is_finite():
                raise Imprecise("a coefficient is not finite")
            if not gap.contains(0):
                return NONZERO
            width = max(width, float(gap.abs_upper() / acb(coefficient or largest).abs_lower()))
    if width > TOLERANCE:
        raise Imprecise("a solution is not sharp enough")
    return CheckedValues(values, gauges, width)


def _pad_coefficients(polynomial: Exact, degree: int) -> list[fmpq]:
    return [polynomial[i] for i in range(max(degree, polynomial.degree()) + 1)]


def _lift_values(values: dict[str, Ball]) -> dict[str, acb_poly]:
    return {name: acb_poly([value]) for name, value in values.items()}


def list_solutions(
    chain: Chain, leaves: list[CheckedValues], target: Target, *, complete: bool, confirm: bool
) -> tuple[Solution, ...]:
    """Solutions with their properties. A complete list is closed under conjugation; otherwise
    nothing is known to be real.

    `confirm`: whether those that do not belong to a family are checked by `confirmation`.
    """
    solutions = (
        _solution(c, [x.values for x in leaves if x is not c or not complete]) for c in leaves
    )
    return tuple(
        (
            replace(s, confirmation=confirmation(chain, s.values, target))
            if confirm and not s.gauges
            else s
        )
        for s in solutions
    )


def _solution(c: CheckedValues, others: list[Balls]) -> Solution:
    """`others` are the candidates for its conjugate; with itself among them nothing is proven."""
    real = _real(c.values, others)
    return Solution(
        values=c.values,
        real=real,
        positive=_positive(c.values, real),
        gauges=c.gauges,
        width=c.width,
    )


def _real(values: Balls, others: list[Balls]) -> Answer:
    """NO if an imaginary part leaves zero out; YES if the conjugate, a solution too, can be
    none of the others.
    """
    if not all(v.imag.contains(0) for v in values.values()):
        return Answer.NO
    conjugate = {name: v.conjugate() for name, v in values.items()}
    return Answer.UNKNOWN if any(_meets(conjugate, other) for other in others) else Answer.YES


def _meets(left: Balls, right: Balls) -> bool:
    return all(left[name].overlaps(right[name]) for name in left)


def _positive(values: Balls, real: Answer) -> Answer:
    if real is Answer.NO or any(bool(v.real < arb(0)) for v in values.values()):
        return Answer.NO
    return real if all(bool(v.real > arb(0)) for v in values.values()) else Answer.UNKNOWN
