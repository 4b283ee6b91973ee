"""Models of a chain modulo a prime at which all poles lie in the prime field, as functions of t
= s, or of s^2 undamped.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

from disting.algebra.certainty import prime, residues
from disting.algebra.determinants import Modular
from disting.algebra.quotient import constant, variable
from disting.behaviour.chain_model import degrees, quotient
from disting.model.chain import Chain, Quantity

ATTEMPTS = 1000  # points tried until one is found
REMEMBERED = 256


@dataclass(frozen=True, slots=True)
class Split:
    """A model n/(t^z d') modulo a prime: n, the linear factors of d', and the parameters in
    their order.
    """

    n: Modular
    factors: tuple[Modular, ...]
    point: tuple[int, ...]


@lru_cache(maxsize=REMEMBERED)
def split_model(chain: Chain, label: str) -> Split | None:
    """The first point of a sequence at which all poles lie in the prime field and are distinct."""
    modulus, count = prime(label), len(accelerate(chain).parameters)
    points = (tuple(residues(f"{label}:{k}:{chain}", count, modulus)) for k in range(ATTEMPTS))
    return next(
        (model for point in points if (model := model_at(chain, point, modulus)) is not None), None
    )


def model_at(chain: Chain, point: tuple[int, ...], modulus: int) -> Split | None:
    """The model at a point; None where poles coincide, lie elsewhere, or are fewer than they
    should be.
    """
    q = quotient(accelerate(chain).structure, list(point), modulus)
    n, d = (_in_steps(p, step_of(chain), modulus) for p in (q.num, q.den))
    factors = tuple(f for f, _ in d.factor()[1])
    distinct = len(factors) == d.degree() == poles_of(chain) and all(int(f[0]) for f in factors)
    return Split(n, factors, point) if distinct and int(n[0]) else None


def accelerate(chain: Chain) -> Chain:
    """With a sensor of acceleration, whose transfer function is n/d'; without dead time."""
    return replace(chain, quantity=Quantity.ACCELERATION, dead_time=False)


def _in_steps(polynomial: Modular, step: int, modulus: int) -> Modular:
    """The polynomial in s as one in s^step."""
    return polynomial_of([int(c) for c in polynomial.coeffs()[::step]], modulus)


def polynomial_of(coefficients: list[int], modulus: int) -> Modular:
    """The polynomial in t with these coefficients, the constant first."""
    t = variable(modulus)
    return sum((t**i * c for i, c in enumerate(coefficients)), constant(0, modulus))


def poles_of(chain: Chain) -> int:
    """Number of poles other than 0, as a function of t."""
    return degrees(accelerate(chain).structure)[1] // step_of(chain)


def step_of(chain: Chain) -> int:
    """1 for t = s, 2 for t = s^2."""
    return 1 if chain.damped else 2
