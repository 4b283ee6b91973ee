"""The receptance of a row that is to be realised, as balls."""

from dataclasses import dataclass

from flint import acb_poly

from disting.fibres.synthesis.ball import Ball, Poly
from disting.model.row import Row


@dataclass(frozen=True, slots=True)
class Receptance:
    """Numerator over monic denominator, in s, or in x = s^2 where there is no damper.

    `exact`: the numerator as fmpq_poly, if the coefficients of both are rational and known.
    """

    numerator: Poly
    denominator: Poly
    exact: Poly | None = None

    def gain(self, row: Row) -> Ball:
        """Leading coefficient of the numerator, in the row's own variable."""
        return self.numerator[row.numerator_degree]

    def own(self, row: Row, q: int) -> "Receptance":
        """In the row's own variable, from that of q: in x for a row without any damper."""
        if row.q == q:
            return self
        return Receptance(
            acb_poly(self.numerator.coeffs()[::2]), acb_poly(self.denominator.coeffs()[::2])
        )
