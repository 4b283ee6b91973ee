"""The wording that pages and figures share, and what it needs of models that were compared in
pairs: a Protocol that a catalogue and a list of general models implement, models counted from 1.
"""

import re
from collections.abc import Iterator, Sized
from typing import TYPE_CHECKING, Protocol

from disting.model.presentation import plural as plural
from disting.model.question import Domain
from disting.questions.identifiability.parts import Level
from disting.verdict.meaning import undetermined_sentence
from disting.verdict.result import Relation, Verdict, View

if TYPE_CHECKING:  # words on catalogues are used by pages that need none
    from disting.catalogs import Catalog, ModelRow
    from disting.verdict.identifiable import Identified

VIEW_TITLES = {
    View.POSITIVE: "Positive parameters",
    View.EXACT: "Complex parameters",
    View.TF: "Transfer function",
    View.MARKOV: "Markov parameters",
    View.COMBINED: "Conditions 1 to 9",
}
SAID = {relation: relation.value for relation in Relation} | {
    Relation.SOMETIMES: "sometimes indistinguishable",
}
"""Relations as pages name them."""


def unknown_parameters(row: "ModelRow") -> str:
    """Parameters of a model that cannot be determined, which pages name in the place of {0}; ""
    where there are none.
    """
    return undetermined_sentence("{0}", row.rank, row.n_parameters)


class DecidedModels(Protocol):
    """Models and the verdicts on their pairs, in some views."""

    @property
    def family(self) -> Sized:
        """The models."""

    def relation(self, left: int, right: int, view: View) -> Relation:
        """Relation of two models."""

    def verdict(self, left: int, right: int, view: View) -> Verdict:
        """The verdict with its evidence."""

    def pairs(self, view: View) -> Iterator[tuple[int, int, Verdict]]:
        """All pairs, left < right."""

    def classes(self, view: View) -> tuple[tuple[int, ...], ...]:
        """Groups of two or more mutually indistinguishable models."""

    def depending(self, view: View) -> tuple[tuple[int, int], ...]:
        """The pairs that are indistinguishable for some parameters only."""


def title(catalog: "Catalog") -> str:
    """Such as "Chains of 3 masses, damped"."""
    return f"Chains of {short_title(catalog)}"


def short_title(catalog: "Catalog") -> str:
    """Such as "3 masses, damped"."""
    return (
        f"{plural(catalog.n_masses, 'mass', 'masses')},"
        f" {'damped' if catalog.damped else 'undamped'}"
    )


def headline(catalog: "Catalog") -> str:
    """Models, pairs and relations over positive parameters in one sentence.

    >>> from disting.catalogs import catalog
    >>> domain, counts = headline(catalog(3, damped=False)).split(": ")
    >>> domain
    '11 models, 55 pairs, over positive parameters'
    >>> counts
    '43 distinguishable, 12 indistinguishable, 0 undecided'
    """
    counts = totals(catalog)
    head = (
        f"{plural(len(catalog.family), 'model')}, {plural(sum(counts.values()), 'pair')}, over"
        " positive parameters"
    )
    words = (
        f"{n} {SAID[relation]}"
        for relation, n in counts.items()
        if n or relation is not Relation.SOMETIMES
    )
    return f"{head}: {', '.join(words)}"


def totals(decided: DecidedModels, view: View = View.POSITIVE) -> dict[Relation, int]:
    """Number of pairs by relation; SOMETIMES only where it can occur."""
    numbers = range(1, len(decided.family) + 1)
    relations = [decided.relation(low, high, view) for high in numbers for low in range(1, high)]
    shown = [
        r for r in Relation if r is not Relation.SOMETIMES or view.domain is not Domain.COMPLEX
    ]
    return {relation: relations.count(relation) for relation in shown}


def with_and(parts: list[str]) -> str:
    """Parts with commas and a final "and".

    >>> with_and(["a", "b", "c"]), with_and(["a"])
    ('a, b and c', 'a')
    """
    return " and ".join([", ".join(parts[:-1]), parts[-1]] if len(parts) > 1 else parts)


def raise_exponents(text: str) -> str:
    """Words with raised exponents of 2, as error bounds have them.

    >>> raise_exponents("probability of error at most 2^-131")
    'probability of error at most 2⁻¹³¹'
    """
    up = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
    return re.sub(r"\b2\^(-\d+)", lambda match: f"2{match[1].translate(up)}", text)


def sets_in_words(found: "Identified") -> str:
    """Number of parameter vectors over the domain with the same behaviour: the numbers found at
    random values, where they are known to depend on the values.
    """
    if found.level is Level.NOT:
        return "infinitely many"
    if found.most is None:
        return "not known"
    low, high = (found.sampled[0], found.sampled[-1]) if found.varies else (found.least, found.most)
    return str(low) if low == high else f"{low} {'or' if high == low + 1 else 'to'} {high}"
