"""A network as a model of the one kind that samples, profiles and comparisons know: its transfer
function at points, without polynomials in its values.

What has to be known exactly is known of networks whose coefficients are sums of terms of one sign
(`disting.network.at_points`), where a point shows that both sides are in lowest terms:

LEMMA. Every value enters N and D to the first power. If G at a point, in lowest terms, has the
degrees of N and D less the power of s that they share everywhere, and depends there on every value
that is seen, then that power is all that N and D have in common. Proof: any other common factor
that holds s would keep its degree at the point, as the leading coefficients do not vanish, and
would be cancelled there. One without s holds some value p; N and D being linear in p, what is left
of both is free of p, and so is G.

LEMMA. A coefficient of N and of D over the leading one of D is the constant 0 or not constant, that
leading one itself aside. Proof: times a number, all admittances take G over that number, so b_i/a_m
is homogeneous of degree -1 in them; p_e -> p_e h^-r_e takes G(s) to G(s/h), so a_i/a_m is
homogeneous of degree m - i in h.

The same numbers, so the same bounds of errors, follow as from the polynomials written out. Where a
lemma does not apply, they are written out (`disting.general.behaviour`).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from typing import ClassVar

from flint import nmod_poly

from disting.algebra.quotient import Quotient, coefficient_rows, lowest_terms
from disting.algebra.sampling import Size, about, prime, residues
from disting.behaviour.chain_model import UNBOUNDED
from disting.general.any_model import unnamed
from disting.general.behaviour import GeneralModel, Known, known_invariants, summary_size
from disting.general.matrix_model import AnyModel
from disting.model.protocol import Columns, Degrees
from disting.network.at_points import Assembly, Counts, Sides, assembly, counts, sides_at
from disting.network.network import Network

REMEMBERED = 1024  # networks


@dataclass(frozen=True, slots=True)
class NetworkModel:
    """The transfer function of a network of which both lemmas are true, in powers of s or of
    s^(1/2).
    """

    network: Network
    halves: bool
    dead_time: ClassVar[bool] = False
    is_numbered: ClassVar[bool] = False
    most_subsets: ClassVar[int] = UNBOUNDED
    lost_bits: ClassVar[int] = 1

    @property
    def parameters(self) -> tuple[str, ...]:
        """Those of the network."""
        return self.network.parameters

    @property
    def n_states(self) -> int:
        """The larger degree of numerator and denominator."""
        return max(self.degrees[0])

    @property
    def content(self) -> tuple[object, ...]:
        """The network, whatever it is called."""
        return self.network, self.halves

    @property
    def degrees(self) -> tuple[Degrees, ...]:
        """Those of the transfer function."""
        return (degrees_of(self._counts),)

    def quotients(self, point: Sequence[int], modulus: int) -> tuple[Quotient, ...]:
        """The transfer function, at a point without zeros."""
        return (_quotient(self._assembly, point, modulus),)

    def columns(self, point: Sequence[int], modulus: int) -> Columns:
        """Those of the functions c_i a_m, at a point without zeros; none at one of the few where
        too few numbers s show them.
        """
        found = sides_at(self._assembly, point, modulus)
        if found is None:
            return (), [()] * len(point)
        rows = _products(found, self._counts, modulus)
        return tuple(value for value, _ in rows), list(zip(*(g for _, g in rows), strict=True))

    def minor_size(self, markov: int | None) -> Size:
        """Bounds for the cleared minors of the Jacobian: the sizes of a coefficient's numbers, all
        1, sum to the number of its terms.
        """
        known = self._counts
        bits = max(*known.num, *known.den).bit_length()
        return summary_size(self.degrees, [(known.degree, bits)], len(self.parameters), markov)

    def constants(self, markov: int | None) -> Mapping[str, str]:
        """Those that are the constant 0."""
        return {
            name: str(x) for name, x in known_invariants(*_ratios(self._counts), markov).items()
        }

    @property
    def _assembly(self) -> Assembly:
        found = assembly(self.network, self.halves)
        assert found is not None
        return found

    @property
    def _counts(self) -> Counts:
        return counts(self._assembly)


def behaviour_of(model: AnyModel) -> GeneralModel | NetworkModel:
    """What a model reveals, whatever it is called: of a network at points, if both lemmas are true
    of it, of others by its polynomials.
    """
    network, halves = model.network, model.powers.halves
    if network is not None and network.parameters == model.parameters:
        plain = replace(network, name="network")
        if _is_known_at_points(plain, halves):
            return NetworkModel(plain, halves)
    return GeneralModel(unnamed(model))


def degrees_of(known: Counts) -> Degrees:
    """Degrees of both sides, common powers of s cancelled."""
    lost = _common_power(known)
    return len(known.num) - 1 - lost, len(known.den) - 1 - lost


@lru_cache(maxsize=REMEMBERED)
def _is_known_at_points(network: Network, halves: bool) -> bool:
    """Whether both lemmas are true of it, as seen at one random point."""
    of = assembly(network, halves)
    if of is None or not of.sign:
        return False
    known = counts(of)
    if not known.num or not any(known.den):
        return False
    label = about("lowest terms", network, halves)
    modulus = prime(label)
    point = residues(f"point:{label}", of.n_values, modulus)
    q = _quotient(of, point, modulus)
    slopes = [(q.num_derivatives[e.place], q.den_derivatives[e.place]) for e in of.entries]
    kept = (q.num.degree(), q.den.degree()) == degrees_of(known)
    return kept and all(a or b for a, b in slopes)


def _common_power(known: Counts) -> int:
    return min(next(i for i, c in enumerate(side) if c) for side in (known.num, known.den))


def _quotient(of: Assembly, point: Sequence[int], modulus: int) -> Quotient:
    found = sides_at(of, point, modulus)
    if found is None or not found.den:
        zero = nmod_poly([0], modulus)
        return Quotient(zero, zero, (), ())
    return lowest_terms(found.num, found.den, found.num_derivatives, found.den_derivatives)


def _products(found: Sides, known: Counts, modulus: int) -> list[tuple[int, list[int]]]:
    """Values and gradients of the functions c_i a_m."""
    lost = _common_power(known)
    rows = [
        row
        for side, slopes, size in (
            (found.num, found.num_derivatives, len(known.num)),
            (found.den, found.den_derivatives, len(known.den)),
        )
        for row in list(zip(*coefficient_rows(side, slopes, size), strict=True))[lost:]
    ]
    lead, steps = rows[-1]
    return [
        (
            value * lead % modulus,
            [(g * lead + value * h) % modulus for g, h in zip(gradient, steps, strict=True)],
        )
        for value, gradient in rows
    ]


def _ratios(known: Counts) -> tuple[list[Known], list[Known]]:
    """What is known of the coefficients over the leading one."""
    lost = _common_power(known)
    top, bottom = (
        [None if c else Fraction(0) for c in side[lost:]] for side in (known.num, known.den)
    )
    return top, [*bottom[:-1], Fraction(1)]
