"""Two general models compared: the conditions of chains on the profiles of models, then the exact
decision.

Conditions 8 and 9 look at the elements of chains, which general models do not have. Verdicts are
over complex parameters; over real or positive ones a pair that is distinguishable stays so, one
that a renaming makes identical stays identical, and points with and without an admissible
equivalent are looked for otherwise (see `admissible`).
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from disting.algebra.settings import Settings
from disting.behaviour.profile import Profile
from disting.behaviour.sample import Representation
from disting.conditions.finding import Finding, Outcome
from disting.conditions.rule import ADMISSIBLE, EXACT
from disting.conditions.sufficient import FREE_CHOICE, INCOMPLETE, RENAMING, condition_7
from disting.conditions.table import NECESSARY, STRUCTURAL, STRUCTURE, SUFFICIENT, Sufficient
from disting.evidence.conditions import Renaming
from disting.evidence.domain import Domain
from disting.evidence.general import Constants
from disting.general.admissible import admissible_finding
from disting.general.exact import exact_finding
from disting.general.model import Model
from disting.general.profiles import profile, proven_constants
from disting.general.renaming import condition_6
from disting.questions.same.exact import resting_on_ranks
from disting.verdict import (
    FIBRE,
    PARAMETERS,
    Query,
    Relation,
    Step,
    Verdict,
    agreed,
    first,
    open_note,
    verdict_of,
)

NO_ELEMENTS = "general models have no elements to be left out"


@dataclass(frozen=True, slots=True)
class Pair:
    """Two models under one question; a pair of profiles in each representation."""

    left: Model
    right: Model
    query: Query = field(default_factory=Query)
    settings: Settings = field(default_factory=Settings)

    def profiles(self, representation: Representation) -> tuple[Profile, Profile]:
        """Profiles of both; so many Markov parameters as asked, or as are exhaustive."""
        exhaustive = self.left.n_states + self.right.n_states
        count = (self.query.markov or exhaustive) if representation is Representation.MARKOV else 0
        left, right = (
            profile(model, representation, count, self.settings)
            for model in (self.left, self.right)
        )
        return left, right

    @property
    def names(self) -> tuple[str, str]:
        """Names of both, numbered where they are the same."""
        one, other = self.left.name, self.right.name
        return (f"{one} 1", f"{other} 2") if one == other else (one, other)


def compare(
    left: Model,
    right: Model,
    *,
    query: Query | None = None,
    audit: bool = False,
    settings: Settings | None = None,
) -> Verdict:
    """Verdict on two models; `query`, `audit` and `settings` as for chains.

    >>> a = Model.from_transfer_function(["k"], ["m", "d", "k"], name="spring")
    >>> b = Model.from_transfer_function(["g*w**2"], ["1", "2*z*w", "w**2"], name="oscillator")
    >>> compare(a, b).relation.value
    'distinguishable'
    """
    pair = Pair(left, right, query or Query(), settings or Settings())
    if audit:
        agreed(*pair.names, steps(pair))
    found, domain = first(*pair.names, steps(pair)), pair.query.view.domain
    if domain is Domain.COMPLEX or found.relation is not Relation.INDISTINGUISHABLE:
        return replace(found, domain=domain)
    return _admissible(pair, found, domain)


def findings(
    left: Model, right: Model, *, query: Query | None = None, settings: Settings | None = None
) -> tuple[Step, ...]:
    """What every condition finds in every representation, in order, whether it decides or not."""
    return tuple(steps(Pair(left, right, query or Query(), settings or Settings())))


def steps(pair: Pair) -> Iterator[Step]:
    """Yield every condition's finding lazily, representation by representation."""
    for representation in pair.query.view.representations:
        if representation == FIBRE:
            yield Step(FIBRE, _exact(pair))
        elif representation == STRUCTURE:
            for condition in STRUCTURAL:
                if pair.query.asks(condition.rule):
                    yield Step(
                        STRUCTURE, Finding(condition.rule, Outcome.INAPPLICABLE, note=NO_ELEMENTS)
                    )
        else:
            yield from (
                Step(representation, found)
                for found in _conditions(pair, Representation(representation))
            )


def _conditions(pair: Pair, representation: Representation) -> Iterator[Finding]:
    for condition in NECESSARY:
        if pair.query.asks(condition.rule):
            yield condition.check(*pair.profiles(representation))
    for other in SUFFICIENT:
        if pair.query.asks(other.rule):
            yield _sufficient(other, pair, representation)


def _sufficient(condition: Sufficient, pair: Pair, representation: Representation) -> Finding:
    one, other = pair.profiles(representation)
    if condition.rule is FREE_CHOICE:
        return condition_7(one, other)
    if condition.rule is not RENAMING:
        return Finding(condition.rule, Outcome.INAPPLICABLE, note="it is asked of chains")
    whole = one.describes_all(other)
    return (
        condition_6(pair.left, pair.right)
        if whole
        else Finding(RENAMING, Outcome.INAPPLICABLE, note=INCOMPLETE)
    )


def _exact(pair: Pair) -> Finding:
    one, other = pair.profiles(Representation.TF)
    if one.rank != other.rank or one.degrees != other.degrees:
        return Finding(
            EXACT, Outcome.INAPPLICABLE, note="the ranks or degrees differ (conditions 2 and 4)"
        )
    if one.rank == 0:
        return _constants(pair)
    return resting_on_ranks(exact_finding(pair.left, pair.right, pair.settings.seed), one, other)


def _constants(pair: Pair) -> Finding:
    """Transfer functions without parameters: unequal numbers, known exactly, tell the models
    apart.
    """
    values = [proven_constants(model, Representation.TF, 0) for model in (pair.left, pair.right)]
    differing = tuple(
        label for label, x in values[0].items() if label in values[1] and x != values[1][label]
    )
    if not differing:
        return Finding(
            EXACT,
            Outcome.INAPPLICABLE,
            note="equal constant transfer functions are found by condition 7",
        )
    evidence = Constants(differing, *(tuple(str(v[x]) for x in differing) for v in values))
    return Finding(EXACT, Outcome.FAILS, evidence=evidence)


def _admissible(pair: Pair, found: Verdict, domain: Domain) -> Verdict:
    """Over real or positive parameters: a renaming is a bijection there too; points with and
    without equivalents come next.
    """
    if isinstance(found.evidence, Renaming) and found.certainty:
        finding = Finding(ADMISSIBLE, Outcome.HOLDS, found.certainty, found.safety, found.evidence)
    else:
        finding = admissible_finding(pair.left, pair.right, domain, pair.settings.seed)
    if finding.outcome is not Outcome.ABANDONED:
        return verdict_of(*pair.names, Step(PARAMETERS, finding), domain)
    return Verdict(*pair.names, Relation.UNDECIDED, domain=domain, notes=(open_note(finding.note),))
