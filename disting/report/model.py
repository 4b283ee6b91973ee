"""A page about one model: its drawing, the models that its force and sensor cannot distinguish from
it, its transfer function, what can be determined.

It covers positive parameters, those of a machine; results over complex ones, as in the paper,
follow.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from disting.catalogs import Catalog, ModelRow
from disting.catalogs.recalled_chains import over_positive
from disting.conditions.inclusion import Inclusion
from disting.conditions.rule import RULES
from disting.decide.identifiability.answer import Identifiability
from disting.errors import InputError
from disting.evidence.positive import PositiveFinding, Share
from disting.model.chain import Chain
from disting.report.drawing import Drawing, additions, draw, share
from disting.report.environment import render
from disting.report.formulas import (
    Correspondence,
    combinations,
    correspondence,
    transfer_function_parts,
)
from disting.report.next_steps import advice, drawings_of, found_for, page_of
from disting.report.words import plural, sets_in_words, short_title
from disting.verdict.result import Relation, Verdict, View


@dataclass(frozen=True, slots=True)
class Model:
    """Content of the pages on a model."""

    row: ModelRow
    drawing: Drawing

    @property
    def sets(self) -> str:
        """Number of positive parameter vectors with the same behaviour."""
        return sets_in_words(self.known)

    @property
    def known(self) -> Identifiability:
        """Identifiability over positive parameters."""
        return over_positive(self.row)

    @property
    def ports(self) -> tuple[str, str]:
        """Force and sensor in words."""
        c = self.row.chain
        return _port(c.act_plus, c.act_minus), _port(c.meas_plus, c.meas_minus)


@dataclass(frozen=True, slots=True)
class Twin:
    """A model that some positive parameters, at least, do not distinguish from this one.

    The pair's deep link, its relation as seen from this one, which of them have equivalents on the
    other side, and the explicit map to it.
    """

    model: Model
    pair: str
    relation: Relation
    positive: str
    map: Correspondence | None

    @property
    def title(self) -> str:
        """The relation in words."""
        words = {
            Relation.INDISTINGUISHABLE: "Indistinguishable",
            Relation.UNDECIDED: "Undecided over positive parameters",
        }
        return words.get(self.relation, "It depends on the values")


@dataclass(frozen=True, slots=True)
class Limits:
    """The models whose closure holds this one, those that this one's closure holds, and those
    of which neither is known.
    """

    inside: tuple[int, ...]
    holds: tuple[int, ...]
    unknown: tuple[int, ...]


def model_of(catalog: Catalog, number: int) -> Model:
    """A model of a catalogue, with its drawing; raises InputError for a number that is none."""
    if not 0 < number <= len(catalog.rows):
        raise InputError(f"there is no model A{number}: they are A1 to A{len(catalog.rows)}")
    row = catalog.rows[number - 1]
    return Model(row, _drawing(number, row.chain))


@cache
def _drawing(number: int, chain: Chain) -> Drawing:
    """Drawn once: the pages of a model, of its twins and of the family show it."""
    return Drawing(number, draw(chain))


def folder_of(catalog: Catalog) -> str:
    """Where the pages of a catalogue's models are, as seen from the catalogue's page.

    >>> from disting.catalogs import catalog
    >>> folder_of(catalog(3, damped=True))
    'models/3-damped'
    """
    return f"models/{catalog.name.removeprefix('chains-')}"


def motion_of(catalog: Catalog) -> str:
    """Name of the page where a catalogue's models move, as seen from the catalogue's page; none
    of a catalogue of one model.

    >>> from disting.catalogs import catalog
    >>> motion_of(catalog(3, damped=True)), motion_of(catalog(1, damped=False))
    ('motion-3-damped.html', '')
    """
    if len(catalog.family) < 2:
        return ""
    return f"motion-{catalog.name.removeprefix('chains-')}.html"


def model_page(catalog: Catalog, number: int) -> str:
    """HTML of one model; in the same folder the style sheet of `write_report` is expected. Raises
    InputError for a number that is no model's.

    >>> from disting.catalogs import catalog
    >>> "Model A2" in model_page(catalog(2, damped=True), 2)
    True
    """
    model, verdicts = model_of(catalog, number), dict(_verdicts(catalog, number))
    relations = {other: relation_from(number, other, v) for other, v in verdicts.items()}
    twins = [
        _twin(catalog, model, other, v)
        for other, v in verdicts.items()
        if relations[other] is not Relation.DISTINGUISHABLE
    ]
    apart = [other for other, r in relations.items() if r is Relation.DISTINGUISHABLE]
    shown = [number, *(t.model.row.number for t in twins)]
    own_advice = advice(found_for(catalog), number)
    return render(
        "model.html",
        catalog=catalog,
        family=short_title(catalog),
        model=model,
        row=model.row,
        twins=twins,
        always=[t for t in twins if t.relation is Relation.INDISTINGUISHABLE],
        aside=any(v.has_exceptions for v in verdicts.values()),
        sometimes=[t for t in twins if t.relation is Relation.SOMETIMES],
        open=[t for t in twins if t.relation is Relation.UNDECIDED],
        complex_same=_over_complex(catalog, number, Relation.INDISTINGUISHABLE),
        complex_open=_over_complex(catalog, number, Relation.UNDECIDED),
        held=share(
            (model_of(catalog, n).drawing for n in shown),
            additions(drawings_of([own_advice] if own_advice else [])),
        ),
        transfer=transfer_function_parts(model.row.chain),
        free=catalog.record(number)["free"],
        basis=combinations(model.row.identifiability.basis),
        told_apart=reasons_apart({other: verdicts[other] for other in apart}),
        limits=limits(number, verdicts),
        advice=own_advice,
        next_name=page_of(catalog),
        motion=motion_of(catalog),
        last=len(catalog.family),
        plural=plural,
    )


def _over_complex(catalog: Catalog, number: int, relation: Relation) -> list[int]:
    """The models with this relation to this one over complex parameters."""
    others = (n for n in range(1, len(catalog.family) + 1) if n != number)
    return [n for n in others if catalog.relation(number, n, View.EXACT) is relation]


def reasons_apart(verdicts: dict[int, Verdict]) -> tuple[tuple[str, int], ...]:
    """Reasons that distinguish the model from others, with the number of others, the most frequent
    first.
    """
    counter = Counter(
        v.decided_by for v in verdicts.values() if v.relation is Relation.DISTINGUISHABLE
    )
    return tuple((rule_in_words(rule), count) for rule, count in counter.most_common())


def limits(number: int, verdicts: dict[int, Verdict]) -> Limits:
    """Models that become this one in a limit of their parameters, and the reverse."""

    def others(larger: bool) -> Iterator[int]:
        """Models that this one lies in (`larger`), or that lie in it."""
        for other, v in verdicts.items():
            inside = (
                Inclusion.LEFT_IN_RIGHT if (number < other) == larger else Inclusion.RIGHT_IN_LEFT
            )
            if v.closure is inside:
                yield other

    unknown = (
        o
        for o, v in verdicts.items()
        if v.closure is Inclusion.UNKNOWN and v.relation is Relation.DISTINGUISHABLE
    )
    return Limits(tuple(others(True)), tuple(others(False)), tuple(unknown))


def relation_from(number: int, other: int, verdict: Verdict) -> Relation:
    """The relation as seen from one model; of a distinguishable pair, some positive models of
    one side may have equivalents.
    """
    finding = ways(number, other, verdict)[0]
    if (
        verdict.relation is not Relation.DISTINGUISHABLE
        or finding is None
        or finding.share is Share.NEVER
    ):
        return verdict.relation
    return Relation.UNDECIDED if finding.share is Share.UNKNOWN else Relation.SOMETIMES


def ways(
    number: int, other: int, verdict: Verdict
) -> tuple[PositiveFinding | None, PositiveFinding | None]:
    """Positive models with positive equivalents: from this one to the other one, and back."""
    ways = (verdict.left_positive, verdict.right_positive)
    return ways if number < other else ways[::-1]


def _verdicts(catalog: Catalog, number: int) -> Iterator[tuple[int, Verdict]]:
    for other in range(1, len(catalog.family) + 1):
        if other != number:
            yield other, catalog.verdict(number, other, View.POSITIVE)


def _twin(catalog: Catalog, model: Model, other: int, verdict: Verdict) -> Twin:
    place = model.row.number
    low, high = sorted((place, other))
    twin, both = model_of(catalog, other), ways(place, other, verdict)
    sentence = _positive(both, other, one_sided=verdict.relation is Relation.DISTINGUISHABLE)
    relation = relation_from(place, other, verdict)
    return Twin(
        twin, f"{low}-{high}", relation, sentence, correspondence(model.row.chain, twin.row.chain)
    )


def _positive(
    ways: tuple[PositiveFinding | None, PositiveFinding | None], other: int, *, one_sided: bool
) -> str:
    """Positive parameters of this model that have positive ones of the other, and the reverse where
    it differs.
    """
    own_share, other_share = (
        Share.UNKNOWN if finding is None else finding.share for finding in ways
    )
    sentences = {
        Share.ALWAYS: (
            f"for all positive parameters here, A{other} has positive ones with the same response"
        ),
        Share.SOMETIMES: (
            f"only for some positive parameters here, A{other} has positive ones with the same"
            " response"
        ),
        Share.NEVER: f"A{other} needs parameters that are not positive",
        Share.UNKNOWN: f"it is not known whether A{other} has positive parameters with the same"
        " response",
    }
    if one_sided:
        return f"{sentences[own_share]}; generic ones of A{other} have none here"
    back = {Share.ALWAYS: "for all", Share.SOMETIMES: "for some only", Share.UNKNOWN: "not known"}
    return sentences[own_share] + (
        f"; the reverse {back[other_share]}"
        if other_share is not own_share and other_share in back
        else ""
    )


def _port(plus: int, minus: int) -> str:
    return f"{plus} against {minus or 'ground'}"


def rule_in_words(decided_by: str) -> str:
    """Name of the deciding rule in words.

    >>> rule_in_words("4"), rule_in_words("exact")
    ('condition 4', 'the exact decision')
    """
    return RULES[decided_by].in_words()
