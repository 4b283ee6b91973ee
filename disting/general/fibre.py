"""The zeros of the equations of a fibre: none, finitely many, all of them found, or a family with
some members.

Finitely many are found with certified signs (see `groebner` and `equivalent`). In a family free
parameters are fixed at random positive rational values, and the members found there are named.
That no member at all is real or positive is proven only where one polynomial of the basis shows
it: one whose coefficients all have the same sign has no positive zero, one in a single unknown
without real roots no real one.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from flint import fmpz_mpoly, fmpz_poly

from disting.algebra.certainty import residues
from disting.algebra.groebner.modular import Sparse
from disting.algebra.groebner.rational import (
    Basis,
    Bounds,
    basis,
    shape,
)
from disting.general.equivalent import Equivalent, equivalents
from disting.model.question import Domain

DRAWS = 8  # of the free parameters of a family
MEMBERS = 3  # draws with members after which the search ends, if one of them is positive
CHOICES = 5  # values for one free parameter: finitely many are no good


class Extent(StrEnum):
    """Number of parameter vectors."""

    NONE = "none"
    FINITE = "finite"
    FAMILY = "family"
    UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Fibre:
    """All solutions if finitely many, else some; fields as in `alternatives.Alternatives`."""

    extent: Extent
    equivalents: tuple[Equivalent, ...] = ()
    free: tuple[str, ...] = ()
    excluded: tuple[Domain, ...] = ()
    reason: str = ""


def solve(
    equations: tuple[Sparse, ...], parameters: tuple[str, ...], seed: str, bounds: Bounds
) -> Fibre:
    """The solutions of the equations in t and the parameters; raises TooLarge."""
    ideal = basis(equations, len(parameters) + 1, bounds)
    if ideal.is_one:
        return Fibre(Extent.NONE)
    if ideal.free:
        return _family(equations, ideal, parameters, seed, bounds)
    listed = _list_solutions(equations, parameters, seed, bounds)
    if listed is None:
        return Fibre(Extent.UNKNOWN, reason="no linear form separates the finitely many solutions")
    return Fibre(Extent.FINITE, listed)


def _list_solutions(
    equations: tuple[Sparse, ...], parameters: tuple[str, ...], seed: str, bounds: Bounds
) -> tuple[Equivalent, ...] | None:
    """Finitely many solutions, ordered by their values."""
    the_shape = shape(equations, len(parameters) + 1, bounds, seed)
    if the_shape is None:
        return None
    return tuple(
        sorted(
            equivalents(the_shape, parameters), key=lambda x: [(z.real, z.imag) for z in x.numbers]
        )
    )


def _family(
    equations: tuple[Sparse, ...],
    ideal: Basis,
    parameters: tuple[str, ...],
    seed: str,
    bounds: Bounds,
) -> Fibre:
    members, names, successes = list[Equivalent](), dict[str, None](), 0
    for draw in range(DRAWS):
        cut, fixed = _cut(equations, ideal, f"{seed}:{draw}", bounds)
        the_equivalents = _list_solutions(cut, parameters, seed, bounds) if fixed else None
        if the_equivalents:
            successes += 1
            members += [equivalent for equivalent in the_equivalents if equivalent not in members]
            names |= {parameters[i - 1]: None for i in fixed}
        if successes >= MEMBERS and any(x.domain is Domain.POSITIVE for x in members):
            break
    return Fibre(Extent.FAMILY, tuple(members), tuple(names), _excluded_domains(ideal))


def _cut(
    equations: tuple[Sparse, ...], ideal: Basis, label: str, bounds: Bounds
) -> tuple[tuple[Sparse, ...], tuple[int, ...]]:
    """The equations with free parameters at random values until the solutions are finite;
    nothing fixed if that failed.
    """
    fixed: tuple[int, ...] = ()
    while ideal.free:
        # t is no parameter; where it is free, a parameter is
        candidates = [i for i in ideal.free if i]
        at = candidates[residues(f"which:{label}:{len(fixed)}", 1, len(candidates) + 1)[0] - 1]
        for choice in range(CHOICES):
            tried = (*equations, _fix_unknown(at, ideal.size, f"{label}:{at}:{choice}"))
            smaller = basis(tried, ideal.size, bounds)
            if not smaller.is_one:
                break
        else:
            return equations, ()
        equations, ideal, fixed = tried, smaller, (*fixed, at)
    return equations, fixed


def _fix_unknown(at: int, size: int, label: str) -> Sparse:
    """x - p/q with p, q of 1..12."""
    p, q = residues(label, 2, 13)
    return {tuple(int(i == at) for i in range(size)): q, (0,) * size: -p}


def _excluded_domains(ideal: Basis) -> tuple[Domain, ...]:
    """Domains in which one polynomial of the basis alone has no zero."""
    plain = [p for p in ideal.polynomials if not int(p.degrees()[0])]
    if any(_has_no_real_zero(p) for p in plain):
        return Domain.REAL, Domain.POSITIVE
    one_signed = any(min(p.coeffs()) > 0 or max(p.coeffs()) < 0 for p in plain)
    return (Domain.POSITIVE,) if one_signed else ()


def _has_no_real_zero(polynomial: fmpz_mpoly) -> bool:
    """Return True if it has one unknown and no real root."""
    used = [i for i, degree in enumerate(polynomial.degrees()) if degree]
    if len(used) != 1:
        return False
    terms = {e[used[0]]: c for e, c in polynomial.to_dict().items()}
    roots: list[Any] = fmpz_poly(
        [int(terms.get(k, 0)) for k in range(max(terms) + 1)]
    ).complex_roots()
    return not any(root.imag.is_zero() for root, _ in roots)
