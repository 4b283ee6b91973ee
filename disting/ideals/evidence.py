"""What one or more fibres show, small enough to be stored, and its check without the search that found it.

A label stands for a random prime and a random point (`fibre_ideal.drawn`), so the evidence holds labels, not numbers.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from flint import fmpz_mpoly, nmod_poly

from disting.ideals.fibre_ideal import drawn, fibre_ideal
from disting.ideals.macaulay import reaches_one
from disting.ideals.system import CoefficientMap, matched


@dataclass(frozen=True, slots=True)
class Solved:
    """At the prime and point of each label the searched model has the parameters `solutions` with the same transfer function.

    `left_given`: the points are of the left model and the right one was searched. A scale factor, where needed, comes last.
    `is_normalised`: in the coordinates of `system.normalised`, for chains.
    """

    kind: ClassVar[str] = "solved"
    left_given: bool
    labels: tuple[str, ...]
    solutions: tuple[tuple[int, ...], ...]
    is_normalised: bool = False

    def sentence(self, left: str, right: str) -> str:
        """What was found."""
        given, searched = (left, right) if self.left_given else (right, left)
        return (
            f"For {_times(len(self.labels), 'choice')} of random parameters of {given} modulo a random prime, "
            f"parameters of {searched} with exactly the same transfer function were computed."
        )

    @property
    def formula(self) -> str:
        """The fibre has a point."""
        return "Φ₂(q₀) ≡ Φ₁(p₀)"


@dataclass(frozen=True, slots=True)
class Refuted:
    """At the prime and point of each label the equations of the fibre have no solution: 1 is a combination of degree `degree`.

    `tangent`: the tangent equations belong to them, which is right for models of equal rank only. `is_normalised`: in the
    coordinates of `system.normalised`, for chains.
    """

    kind: ClassVar[str] = "refuted"
    left_given: bool
    labels: tuple[str, ...]
    degree: int
    tangent: bool
    is_normalised: bool = False

    def sentence(self, left: str, right: str) -> str:
        """What was found."""
        given, searched = (left, right) if self.left_given else (right, left)
        return (
            f"For {_times(len(self.labels), 'choice')} of random parameters of {given} modulo a random prime, no parameters of "
            f"{searched}, in any extension, have the same transfer function: the equations contradict each other in degree "
            f"{self.degree}."
        )

    @property
    def formula(self) -> str:
        """The ideal is everything."""
        return "1 ∈ ⟨Φ₂(q) − Φ₁(p₀)⟩"


Evidence = Solved | Refuted


def confirms(evidence: Evidence, left: CoefficientMap, right: CoefficientMap) -> bool:
    """Whether the evidence holds for these models, seen anew.

    A solution is put into both transfer functions. A refutation is found again by plain Macaulay matrices, which takes long and
    much memory for many unknowns and high degrees (10 unknowns, degree 5: minutes).
    """
    given, other = (left, right) if evidence.left_given else (right, left)
    if isinstance(evidence, Solved):
        runs = zip(evidence.labels, evidence.solutions, strict=True)
        return bool(evidence.labels) and all(_agree(given, other, label, q) for label, q in runs)
    return bool(evidence.labels) and all(_refuted(evidence, given, other, label) for label in evidence.labels)


def _agree(given: CoefficientMap, other: CoefficientMap, label: str, solution: Sequence[int]) -> bool:
    if not len(other.parameters) <= len(solution) <= len(other.parameters) + 1:
        return False
    modulus, point = drawn(given, label)
    num1, den1 = _at(given, point, modulus)
    num2, den2 = _at(other, solution[: len(other.parameters)], modulus)
    return den2.degree() == den1.degree() >= 0 and num1 * den2 == num2 * den1


def _at(model: CoefficientMap, point: Sequence[int], modulus: int) -> tuple[nmod_poly, nmod_poly]:
    def value(polynomial: fmpz_mpoly) -> int:
        """Its value at the point, modulo the prime."""
        return int(polynomial(*point)) % modulus

    num, den = ([value(p) for p in polynomials] for polynomials in (model.numerator, model.denominator))
    return nmod_poly(num, modulus), nmod_poly(den, modulus)


def _refuted(evidence: Refuted, given: CoefficientMap, other: CoefficientMap, label: str) -> bool:
    ideal = fibre_ideal(*matched(given, other), label, evidence.tangent)
    return reaches_one(ideal.generators, len(ideal.unknowns), ideal.modulus, evidence.degree)


def _times(count: int, what: str) -> str:
    return f"one {what}" if count == 1 else f"{count} {what}s"
