"""Evidence of general models: equivalents as formulas for all parameters, or none; points with and
without one; constants; networks that represent others and supply the findings of a pair.
"""

import re
from dataclasses import dataclass, replace
from typing import ClassVar, Self

from disting.errors import enumeration
from disting.evidence.decision import Theorem
from disting.evidence.kind import Carrier, Claim, Kind, Labels, PointText
from disting.model.question import Domain, Relation

Formula = tuple[bool, tuple[str, ...], tuple[tuple[str, str], ...], tuple[str, ...]]
"""Left given; polynomials in its parameters that are positive; values of the other model's
parameters; and, if a value contains a root, (its name, the equation's polynomial, two numbers or
fractions): the first root from the one to the other, or one where those polynomials are positive.
"""
SHOWN, LONGEST = 3, 160  # contradictions that are told, characters of each
ZERO = "0"  # the value of what is to be small
BOTH = (True, False)  # ways from one model to the other
MANY, UNCOUNTED = -1, -2  # solutions: infinitely many, and where they were not counted
_EQUIVALENT = re.compile(r'"equivalent": ?\[\[.*?\]\]')


def without_digits(text: str) -> str:
    """JSON of evidence without rounded equivalents of points: where there is a curve of them, a
    search in rounded numbers ends at another one on another processor.

    >>> without_digits('{"kind": "witnesses", "equivalent": [["k", "1.5"]], "solutions": 2}')
    '{"kind": "witnesses", , "solutions": 2}'
    """
    return _EQUIVALENT.sub("", text)


@dataclass(frozen=True, slots=True)
class OverDomain(Kind):
    """Statement on equivalents in one domain of parameters."""

    domain: str

    def shows(self, domain: Domain) -> Relation:
        """Relation that its kind claims, over the domain that it names."""
        return self.claim.relation if self.domain == domain else Relation.UNDECIDED


@dataclass(frozen=True, slots=True)
class Explicit(OverDomain):
    """All generic parameters of either model have an equivalent: those of the first formula
    that applies.

    Over positive parameters a value of `0` is that of one that is to be small: then there is an
    equivalent near these values. Positive ones have no exception where there is one formula each
    way, on no condition and without a root or a 0, and it has plus signs only: then its values are
    positive wherever the parameters are.
    """

    kind: ClassVar[str] = "explicit"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.INDISTINGUISHABLE)
    symbols: ClassVar[str] = "∀ p ∈ A ∃ q ∈ A: Φ₂(q) = Φ₁(p),  ∀ q ∈ A ∃ p ∈ A: Φ₁(p) = Φ₂(q)"
    formulas: tuple[Formula, ...]

    def small(self, formula: Formula) -> tuple[str, ...]:
        """Names of those that are to be small: over real parameters 0 is a value as any other."""
        zero = tuple(name for name, value in formula[2] if value == ZERO)
        return zero if self.domain == Domain.POSITIVE else ()

    @property
    def turned(self) -> Self:
        """The same of the pair in the other order: left given where right was."""
        return replace(self, formulas=tuple((not f[0], *f[1:]) for f in self.formulas))

    def without_exception(self, domain: Domain) -> bool:
        """Return True if the statement holds for special values too."""
        plain = all(
            not where and not root and not any("-" in v or v == ZERO for _, v in values)
            for _, where, values, root in self.formulas
        )
        return (
            self.domain == domain == Domain.POSITIVE and plain and len(self.formulas) == len(BOTH)
        )

    def sentence(self, left: str, right: str) -> str:
        """One formula each way, and how many there are."""
        parts = []
        for way, source, searched in zip(BOTH, (left, right), (right, left), strict=True):
            every = [f for f in self.formulas if f[0] is way]
            more = f" ({len(every)} formulas for different parameters)" if len(every) > 1 else ""
            parts.append(
                f"{source} is {searched} at {_describe(every[0], self.small(every[0]))}{more}"
            )
        values = "" if self.without_exception(Domain.POSITIVE) else " but special ones"
        return f"{'; '.join(parts)}: {self.domain} for all {self.domain} parameters{values}."


def primed(name: str) -> str:
    """Name of a parameter of the model that a map searches, to distinguish them from those of the
    given one.
    """
    return f"{name}'"


def _describe(formula: Formula, small: Labels) -> str:
    _, where, values, root = formula
    equations = ", ".join(
        f"{primed(name)} = {value}" for name, value in values if name not in small
    )
    vanishing = enumeration(map(primed, small))
    equations = f"values near {equations}, {vanishing} being small" if small else equations
    which = "a" if where else "the first"  # of several, where the inequalities name one
    equations += (
        f" with {root[0]} {which} root of {root[1]} from {root[2]} to {root[3]}" if root else ""
    )
    return equations + (f" where {' and '.join(f'{w} > 0' for w in where)}" if where else "")


@dataclass(frozen=True, slots=True)
class NoEquivalent(OverDomain):
    """No generic parameters of one model have an equivalent: in each case one of the
    `contradictions` would have to hold.

    They are equations polynomial = 0 or inequalities, in the given parameters p0, p1, .. and the
    unknown ones q0, q1, .. in the order of the models.
    """

    kind: ClassVar[str] = "no equivalent"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.DISTINGUISHABLE)
    symbols: ClassVar[str] = "Φ₁(A) ∩ Φ₂(A) = ∅"
    left_given: bool
    contradictions: tuple[str, ...]

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the conditions that an equivalent would have to satisfy."""
        source, searched = (left, right) if self.left_given else (right, left)
        whole = (c if set("<>=") & set(c) else f"{c} = 0" for c in self.contradictions[:SHOWN])
        first = (c if len(c) <= LONGEST else f"{c[:LONGEST]} .." for c in whole)
        some = " or ".join([*first, *([".."] if len(self.contradictions) > SHOWN else [])])
        return (
            f"{source} has no equivalent in {searched} with {self.domain} parameters: that requires"
            f" {some}, which is impossible (p0, p1, .. parameters of {source} by the alphabet, q0,"
            f" q1, .. those of {searched})."
        )


@dataclass(frozen=True, slots=True)
class Inequality(OverDomain):
    """A quadratic form in the coefficients, numbers with the names of both factors, that is
    negative at all positive parameters of one model and at none of the other one.
    """

    kind: ClassVar[str] = "inequality"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.DISTINGUISHABLE)
    words: ClassVar[str] = (
        "{0.spelled} is negative at all positive parameters of {given}, and at none of {searched}"
        " (a0, a1, .. coefficients of the denominator, b0, b1, .. those of the numerator; one"
        " factor of all of them changes no sign)."
    )
    symbols: ClassVar[str] = "{0.spelled}: < 0 ∀ p ∈ A, ≥ 0 ∀ q ∈ A"
    left_given: bool
    form: tuple[tuple[int, str, str], ...]

    @property
    def spelled(self) -> str:
        """The form.

        >>> Inequality("positive", True, ((2, "a0", "a0"), (-1, "b1", "a2"))).spelled
        '2*a0^2 - b1*a2'
        """
        text = ""
        for number, first, second in self.form:
            size = f"{abs(number)}*" if abs(number) != 1 else ""
            sign = " - " if number < 0 else " + "
            text += sign + size + (f"{first}^2" if first == second else f"{first}*{second}")
        return text.removeprefix(" + ") if text.startswith(" + ") else f"-{text[len(' - ') :]}"


@dataclass(frozen=True, slots=True)
class Constants(Kind):
    """Coefficients of the monic form that are constant in both models and have different values."""

    kind: ClassVar[str] = "constants"
    claim: ClassVar[Claim] = Claim(Carrier.EXACT, Relation.DISTINGUISHABLE, grounds="constants")
    words: ClassVar[str] = (
        "{0.labels[0]} is {0.left[0]} in {left} and {0.right[0]} in {right}, for all parameters."
    )
    symbols: ClassVar[str] = "{0.labels[0]} = {0.left[0]} ≠ {0.right[0]}"
    labels: tuple[str, ...]
    left: tuple[str, ...]
    right: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Witnesses(OverDomain):
    """At the rational `point_with` the other model has the `equivalent` (rounded), at
    `point_without` none in the domain.

    The same is true of all parameters near each point. `with_left_given`, `without_left_given`:
    the point is of the left model and the right one was searched. `solutions`: how many complex
    ones there are at the point without, MANY or UNCOUNTED.
    """

    kind: ClassVar[str] = "witnesses"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE, Relation.SOMETIMES)
    symbols: ClassVar[str] = "∃ p: Φ₂⁻¹(Φ₁(p)) ∩ A ≠ ∅,  ∃ p: Φ₂⁻¹(Φ₁(p)) ∩ A = ∅"
    with_left_given: bool
    point_with: PointText
    equivalent: PointText
    without_left_given: bool
    point_without: PointText
    solutions: int

    def sentence(self, left: str, right: str) -> str:
        """Both points in words, and what they leave open."""
        source, searched = (left, right) if self.with_left_given else (right, left)
        without, nowhere = (left, right) if self.without_left_given else (right, left)
        many = {MANY: " (infinitely many complex)", UNCOUNTED: ""}.get(
            self.solutions, f" ({self.solutions} complex)"
        )
        return (
            f"{source} at {_spell(self.point_with)} is {searched} at {_spell(self.equivalent)};"
            f" {without} at {_spell(self.point_without)} has no equivalent in {nowhere} with"
            f" {self.domain} parameters{many}; the same is true all around both points. It is"
            f" not decided whether all {self.domain} values of {nowhere} have an equivalent in"
            f" {without}."
        )


def _spell(point: PointText) -> str:
    return ", ".join(f"{name} = {value}" for name, value in point)


class OfSubstitutes(Kind):
    """Evidence on other networks, and what it shows of these."""

    __slots__ = ()
    inner: "OfNetworks"

    @property
    def title(self) -> str:
        """Title of the inner evidence."""
        return self.inner.title

    @property
    def formula(self) -> str:
        """That of the inner one."""
        return self.inner.formula


@dataclass(frozen=True, slots=True)
class Replacement(OfSubstitutes):
    """Statement on two networks that give the same transfer functions as these for all positive
    values, special ones excepted: `left` and `right` are those networks, the simplest ones or
    others given as text, `inner` is the evidence on them. One that is `larger` may give more: that
    shows only that there are no equivalents.
    """

    kind: ClassVar[str] = "replaced"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE)
    left: str
    right: str
    left_larger: bool
    right_larger: bool
    inner: "OfNetworks"

    def shows(self, domain: Domain) -> Relation:
        """Relation that the inner evidence proves, over positive values: those theorems cover no
        others.
        """
        relation = self.inner.shows(domain) if domain is Domain.POSITIVE else Relation.UNDECIDED
        larger = self.left_larger or self.right_larger
        return (
            Relation.UNDECIDED if larger and relation is not Relation.DISTINGUISHABLE else relation
        )

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the networks that replace these, and on the evidence for them."""
        words = ["all that", "the same as"]
        return (
            f"Special values aside, A = [{self.left}] gives {words[not self.left_larger]} {left}"
            f"{' gives' * self.left_larger}, B = [{self.right}] {words[not self.right_larger]}"
            f" {right}{' gives' * self.right_larger}. {self.inner.sentence('A', 'B')}"
        )


@dataclass(frozen=True, slots=True)
class AtInverse(OfSubstitutes):
    """Statement on two networks at 1/s: `left` and `right` are those, `inner` is the evidence on
    them.
    """

    kind: ClassVar[str] = "at-inverse"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE)
    left: str
    right: str
    inner: "OfNetworks"

    def shows(self, domain: Domain) -> Relation:
        """Relation that the inner evidence proves, over positive values."""
        return self.inner.shows(domain) if domain is Domain.POSITIVE else Relation.UNDECIDED

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the networks that replace these, and on the evidence for them."""
        return (
            f"With 1/s for s (springs and inerters, inductors and capacitors exchanged) {left} is"
            f" C = [{self.left}], {right} is D = [{self.right}]. {self.inner.sentence('C', 'D')}"
        )


@dataclass(frozen=True, slots=True)
class OfPart(OfSubstitutes):
    """Statement on a network without the `missing` elements, the left one or the right one, and on
    the other network: if it holds for some values of the part, it holds for some values of the
    whole network, near that part. Both give as many independent coefficients as there are.
    """

    kind: ClassVar[str] = "of-part"
    claim: ClassVar[Claim] = Claim(Carrier.ADMISSIBLE)
    left_is_part: bool
    missing: Labels
    inner: "OfNetworks"

    def shows(self, domain: Domain) -> Relation:
        """SOMETIMES where the inner one shows that, by a point of the part without an equivalent:
        the whole may give what the part does not.
        """
        is_sometimes = domain is Domain.POSITIVE and self.inner.shows(domain) is Relation.SOMETIMES
        witnesses = witnesses_in(self.inner)
        is_of_part = witnesses is not None and witnesses.without_left_given is self.left_is_part
        return Relation.SOMETIMES if is_sometimes and is_of_part else Relation.UNDECIDED

    def sentence(self, left: str, right: str) -> str:
        """Sentence on the omitted elements, and on the evidence for the rest."""
        whole, names = (left, ("E", right)) if self.left_is_part else (right, (left, "E"))
        return (
            f"E is {whole} without {enumeration(self.missing)}, which gives an open set of"
            f" functions: {whole} gives those around them, with small values of these elements."
            f" {self.inner.sentence(*names)}"
        )


def witnesses_in(evidence: "OfNetworks") -> Witnesses | None:
    """The points that evidence rests on, of whatever networks, if it does."""
    while isinstance(evidence, OfSubstitutes):
        evidence = evidence.inner
    return evidence if isinstance(evidence, Witnesses) else None


OfNetworks = (
    Explicit | NoEquivalent | Inequality | Witnesses | Theorem | Replacement | AtInverse | OfPart
)
OfGeneralModels = (
    Witnesses | Explicit | NoEquivalent | Inequality | Constants | Replacement | AtInverse | OfPart
)
