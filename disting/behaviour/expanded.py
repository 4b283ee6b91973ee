"""The transfer function of a chain written out in its parameters: where a person reads it or an
identity is proven.
"""

from flint import fmpz_mpoly

from disting.algebra.notation import Expr, quotient, symbol
from disting.algebra.symbols import coefficients, renamed, symbols
from disting.behaviour.transfer import plain_receptance
from disting.model.chain import Chain, Sensor
from disting.model.names import chains_named
from disting.model.structure import Structure


def expanded(structure: Structure) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Numerator and denominator of the transfer function (24) without dead time, in lowest terms
    for every chain of the class.

    They are polynomials in s and the parameters with integer coefficients; only powers of s had to
    be cancelled.

    >>> expanded(Chain(1, damped=False).structure)
    (1, m1)
    """
    num, den = written_out(structure)
    s = num.context().gens()[0]
    power = min(_valuation(num), _valuation(den))
    return num // s**power, den // s**power


def written_out(structure: Structure) -> tuple[fmpz_mpoly, fmpz_mpoly]:
    """Numerator (times s to the sensor's order) and denominator, common powers of s not
    cancelled; s is the first symbol.
    """
    ring = symbols(["s", *structure.parameters])
    num, den = plain_receptance(structure, ring, ring["s"], ring["s"] ** 0)
    return num * ring["s"] ** structure.sensor_order, den


def transfer_function(
    chain: Chain | str, *, damped: bool | None = None, sensor: Sensor | str | None = None
) -> Expr:
    """G(s) from force to sensor as a SymPy expression in s and positive symbols named as the
    parameters.

    The quotient of two polynomials in s, a lag among its poles, times exp(-s Td) where there is a
    dead time. A chain can be named, such as "3:1+b2": `damped` and `sensor` say then how it is
    meant.

    >>> transfer_function("2:1", damped=False)
    (k12 + m2*s**2)/(k12*m1 + k12*m2 + m1*m2*s**2)
    """
    from sympy import exp

    (chain,) = chains_named([chain], damped=damped, sensor=sensor)
    num, den = expanded(chain.structure)
    rational = quotient(coefficients(num, "s"), coefficients(den, "s"))
    return rational * exp(-symbol("s") * symbol("Td")) if chain.dead_time else rational


def is_renaming(left: Structure, right: Structure, renaming: dict[str, str]) -> bool:
    """Whether renaming the left parameters turns the left transfer function into the right one: an
    exact identity.

    A dead time is a factor of its own, so it can only become the other's dead time.
    """
    if left.dead_time != right.dead_time or (left.dead_time and renaming["Td"] != "Td"):
        return False
    a, b = expanded(left), expanded(right)
    ring = symbols([str(g) for g in b[1].context().gens()])
    num, den = (renamed(p, ring, renaming) for p in a)
    return bool(num * b[1] == b[0] * den) if (num, den) != b else True


def _valuation(polynomial: fmpz_mpoly) -> int:
    return min((powers[0] for powers in polynomial.monoms()), default=0)
