"""The finding on a canonical form in the parameters of the chain as given."""

from collections.abc import Mapping
from dataclasses import replace

from disting.model.chain import Chain
from disting.questions.identifiability.answer import Identifiability
from disting.questions.identifiability.formula import Formula, monomial
from disting.questions.identifiability.parts import Combination, Renaming, Scaling


def renamed(found: Identifiability, names: Mapping[str, str], chain: Chain) -> Identifiability:
    """`names` leads from the canonical parameters to those of `chain`, whose order is kept
    everywhere.
    """
    place = {name: i for i, name in enumerate(chain.parameters)}
    order = [monomial(**{name: 1}) for name in chain.parameters]
    singles = sorted(
        (_combination(c, names, place) for c in found.singles), key=lambda c: order.index(c.formula)
    )
    return replace(
        found,
        parameters=chain.parameters,
        singles=tuple(singles),
        basis=tuple(_combination(c, names, place) for c in found.basis),
        scalings=tuple(_scaling(s, names, place) for s in found.scalings),
        renamings=tuple(_renaming(r, names, place) for r in found.renamings),
        point=tuple(
            sorted(((names[n], v) for n, v in found.point), key=lambda pair: place[pair[0]])
        ),
    )


def _combination(c: Combination, names: Mapping[str, str], place: Mapping[str, int]) -> Combination:
    terms = (
        (k, tuple(sorted(((names[n], e) for n, e in powers), key=lambda pair: place[pair[0]])))
        for k, powers in c.formula.terms
    )
    return replace(
        c, formula=Formula(tuple(sorted(terms, key=lambda t: [place[n] for n, _ in t[1]])))
    )


def _scaling(s: Scaling, names: Mapping[str, str], place: Mapping[str, int]) -> Scaling:
    return Scaling(
        tuple(sorted(((names[n], w) for n, w in s.weights), key=lambda pair: place[pair[0]]))
    )


def _renaming(r: Renaming, names: Mapping[str, str], place: Mapping[str, int]) -> Renaming:
    moved = sorted(((names[a], names[b]) for a, b in r.moved), key=lambda pair: place[pair[0]])
    return Renaming(tuple(moved), r.symmetries)
