"""Two networks by their representatives: the simplest ones that give the same transfer functions,
or, of one-ports of two kinds of elements, all functions of the set K(n, c, z) in which theirs are
(see `replacement`).

Values special to a network are of measure zero among its functions, which are those of the other
one but for such. So statements on generic functions of the simplest networks hold for the given
ones: all have equivalents, none has, or open sets of either kind exist. Of a network that gives
more functions, but no more of larger dimension (as many as the rank of the given one), one thing
follows only: where none of them has an equivalent, special ones aside, those of the given network
have none. What is special is of measure zero among functions of that dimension, so it is so among
those of the given network.
"""

from dataclasses import dataclass, replace
from functools import lru_cache, partial
from itertools import islice

from disting.behaviour.sample import Representation
from disting.conditions.rule import ADMISSIBLE, Finding, Outcome
from disting.decide import POSITIVE_NETWORKS, first_finding
from disting.errors import InputError
from disting.evidence.decision import Theorem
from disting.evidence.general import (
    BOTH,
    AtInverse,
    Explicit,
    Inequality,
    NoEquivalent,
    OfNetworks,
    OfPart,
    OfSubstitutes,
    Replacement,
    Witnesses,
)
from disting.evidence.kind import Labels, samples_of
from disting.general.admissible import admissible_finding
from disting.general.any_model import of_network, on_one_variable, with_names, without_names
from disting.general.matrix_model import AnyModel
from disting.general.model_evidence import confirms_models
from disting.general.network_model import behaviour_of
from disting.general.orthant import BRIEF, THOROUGH, Effort
from disting.general.parts import parts_of, without
from disting.general.plain_maps import stronger
from disting.general.replacement import replaceable, simplest_network
from disting.model.question import Domain, Question, Relation, Settings
from disting.network.inverse import at_inverse
from disting.network.network import Network
from disting.network.notation import network_of
from disting.network.simplest import same_drawing

WAS_BRIEF = "the search was brief, disting compare of the two alone goes on for longer"
REMEMBERED = 1024  # pairs of simplest networks: others of a family have the same ones


@dataclass(frozen=True, slots=True)
class Forms:
    """The networks that represent two others; those that are `larger` may give more."""

    models: tuple[AnyModel, AnyModel]
    larger: tuple[bool, bool]

    def are_drawn(self, *models: AnyModel) -> bool:
        """Return True if both are the given ones with other numbers: nothing is replaced."""
        pairs = [(m.network, form.network) for m, form in zip(models, self.models, strict=True)]
        return all(a and b and same_drawing(a, b) for a, b in pairs)

    def evidence(self, inner: OfNetworks) -> Replacement:
        """Evidence on the other models that follows from the evidence on these."""
        left, right = (model.name for model in self.models)
        return Replacement(left, right, *self.larger, inner)


def by_forms(
    left: AnyModel, right: AnyModel, seed: str, effort: Effort = THOROUGH
) -> Finding | None:
    """Finding from the simplest networks over positive parameters, ABANDONED if they leave it open;
    None where nothing is replaced.
    """
    finding = None
    for larger in (False, True):
        forms = forms_of(left, right, larger)
        if forms is None or forms.are_drawn(left, right):
            continue
        the_finding = _answer(*forms.models, seed, effort)
        if larger and the_finding.outcome is not Outcome.FAILS:
            continue
        if isinstance(
            the_finding.evidence, Explicit | NoEquivalent | Inequality | Witnesses | Theorem
        ):
            return replace(the_finding, evidence=forms.evidence(the_finding.evidence))
        finding = replace(
            the_finding,
            note=f"of the simplest networks with the same behaviour, {the_finding.note}",
        )
    return finding


def by_inverse(
    left: AnyModel, right: AnyModel, settings: Settings, effort: Effort = THOROUGH
) -> Finding | None:
    """Finding from the same networks with 1/s for s, over positive parameters; None if there is
    none.
    """
    models = inverse_of(left, right)
    if models is None:
        return None
    finding = by_forms(*models, settings.seed, effort)
    if finding is None:
        finding = _answer(*models, settings.seed, effort)
    if isinstance(
        finding.evidence, Explicit | NoEquivalent | Inequality | Witnesses | Theorem | Replacement
    ):
        evidence = AtInverse(models[0].name, models[1].name, finding.evidence)
        return replace(finding, evidence=evidence)
    return None


def inverse_of(left: AnyModel, right: AnyModel) -> tuple[AnyModel, AnyModel] | None:
    """Both with 1/s for s; None where an element has no counterpart."""
    networks = [m.network and at_inverse(m.network) for m in (left, right)]
    turned = [n for n in networks if n is not None]
    if len(turned) < len(networks) or len({(n.sort, n.order) for n in turned}) > 1:
        return None
    try:
        models = [_with_network(of_network(n), n) for n in turned]
    except InputError:
        return None
    model, other = on_one_variable(models)
    return model, other


@lru_cache(maxsize=REMEMBERED)
def _answer(left: AnyModel, right: AnyModel, seed: str, effort: Effort) -> Finding:
    return admissible_finding(left, right, Domain.POSITIVE, seed, effort)


def forms_of(left: AnyModel, right: AnyModel, larger: bool) -> Forms | None:
    """None where none is known, or none that is larger; exponents are not matched here."""
    if any(m.powers.weights for m in (left, right)):
        return None
    networks = [
        (m.network, simplest_network(m), simplest_network(m, larger)) for m in (left, right)
    ]
    more = [whole != same for _, same, whole in networks]
    wholes = [whole for own, _, whole in networks if own is not None and whole is not None]
    if len(wholes) < len(networks) or any(more) != larger:
        return None
    spread = zip((left, right), wholes, more, strict=True)
    if any(larger_ and _rank(m) < len(whole.parameters) for m, whole, larger_ in spread):
        return None
    try:
        models = [_with_network(of_network(whole), whole) for whole in wholes]
    except InputError:
        return None
    model, other = on_one_variable(models)
    return Forms((model, other), (more[0], more[1]))


def _rank(model: AnyModel) -> int:
    """At least so large is the dimension of its functions: a rank modulo a prime."""
    return samples_of(behaviour_of(model)).rank(Representation.TF)


def _with_network(model: AnyModel, network: Network) -> AnyModel:
    """Its transfer functions alone, also where they are those of a chain."""
    plain = without_names(model, network.name)
    object.__setattr__(plain, "network", network)
    return plain


def confirms_forms(
    evidence: OfSubstitutes, left: AnyModel, right: AnyModel, representation: str = "tf"
) -> bool:
    """Return True if these networks may replace both, and the inner evidence holds for them."""
    inner = evidence.inner
    if isinstance(evidence, Replacement):
        models = _stand_for(evidence, left, right)
    elif isinstance(evidence, OfPart):
        part = without(left if evidence.left_is_part else right, evidence.missing)
        pair = (part or left, right) if evidence.left_is_part else (left, part or right)
        models = pair if part else None
    else:
        assert isinstance(evidence, AtInverse)
        models = inverse_of(left, right)
        if models and (evidence.left, evidence.right) != tuple(m.name for m in models):
            return False
    if models is None:
        return False
    if isinstance(inner, OfSubstitutes):
        return confirms_forms(inner, *models, representation)
    return confirms_models(inner, *models, representation)


def _stand_for(
    evidence: Replacement, left: AnyModel, right: AnyModel
) -> tuple[AnyModel, AnyModel] | None:
    """The networks that it names, if they represent both: the simplest ones, or such as texts have
    them.
    """
    forms = forms_of(left, right, evidence.left_larger or evidence.right_larger)
    if forms and evidence == forms.evidence(evidence.inner):
        return forms.models
    exponents = any(m.powers.weights for m in (left, right))
    if exponents or evidence.left_larger or evidence.right_larger:
        return None
    try:
        named = [network_of(text) for text in (evidence.left, evidence.right)]
        model, other = on_one_variable([_with_network(of_network(n), n) for n in named])
    except InputError:
        return None
    return (model, other) if replaceable(model, left) and replaceable(other, right) else None


def of_equals(finding: Finding, left: str, right: str) -> Finding:
    """Finding for two other networks that give the same functions, from that for two networks with
    these texts.
    """
    evidence = finding.evidence
    if not isinstance(evidence, OfNetworks):
        note = with_names(finding.note, left, right)
        return replace(
            finding, note=f"of {left} and {right}, which have the same behaviour, {note}"
        )
    if isinstance(evidence, Replacement) and not (evidence.left_larger or evidence.right_larger):
        return finding  # their simplest networks are those of the others
    return replace(finding, evidence=Replacement(left, right, False, False, evidence))


def by_parts(
    left: AnyModel, right: AnyModel, settings: Settings, effort: Effort = THOROUGH
) -> Finding | None:
    """Finding from a brief search of parts of either network over positive values, if any."""
    for left_is_part in BOTH:
        for missing, part in islice(parts_of(left if left_is_part else right), effort.parts):
            pair = (part, right) if left_is_part else (left, part)
            finding = of_part(over_positive(*pair, settings, BRIEF), left_is_part, missing)
            if finding is not None:
                return finding
    return None


def of_part(finding: Finding, left_is_part: bool, missing: Labels) -> Finding | None:
    """Finding for the whole network, from that for a network without these elements and another
    one.
    """
    if not isinstance(finding.evidence, OfNetworks):
        return None
    evidence = OfPart(left_is_part, missing, finding.evidence)
    tells = evidence.shows(Domain.POSITIVE) is not Relation.UNDECIDED
    return replace(finding, evidence=evidence) if tells else None


def _over_real(left: AnyModel, right: AnyModel, settings: Settings) -> Finding:
    return admissible_finding(left, right, Domain.REAL, settings.seed)


def over_positive(
    left: AnyModel, right: AnyModel, settings: Settings, effort: Effort = THOROUGH
) -> Finding:
    """The finding over positive values, as far as this effort goes."""
    finding: Finding = first_finding(POSITIVE_NETWORKS.rows, left, right, settings, effort)
    return finding


def by_values(left: AnyModel, right: AnyModel, settings: Settings, effort: Effort) -> Finding:
    """Maps, points and inequalities of the simplest networks with the same behaviour, or of the two
    as they are where nothing is replaced; a map without exception is stronger than a theorem.
    """
    finding = by_forms(left, right, settings.seed, effort)
    if finding is None:
        finding = admissible_finding(left, right, Domain.POSITIVE, settings.seed, effort)
    rests_on_others = isinstance(finding.evidence, OfSubstitutes | Theorem)
    is_same = finding.outcome is Outcome.HOLDS and rests_on_others
    return stronger(finding, left, right) if is_same else finding


def _in_brief(left: AnyModel, right: AnyModel, settings: Settings) -> Finding:
    finding = over_positive(left, right, settings, BRIEF)
    if finding.outcome is not Outcome.ABANDONED:
        return finding
    return replace(finding, note=f"{finding.note}; {WAS_BRIEF}")


_admissible_from_json = partial(Finding.from_json, rule=ADMISSIBLE)
ADMISSIBLY = {
    Domain.REAL: Question(
        "real equivalents of general models", _over_real, Finding.to_json, _admissible_from_json
    ),
    Domain.POSITIVE: Question(
        "positive equivalents of general models",
        over_positive,
        Finding.to_json,
        _admissible_from_json,
    ),
}
BRIEFLY = Question(
    "positive equivalents of general models, in brief",
    _in_brief,
    Finding.to_json,
    _admissible_from_json,
)
"""Small search bounds, for the pairs of a large family."""
