"""`compare` and `findings`: any two chains, named as the paper names them, or general models;
`identifiability`: which parameters of one model can be determined, from one experiment or from
several together.

Raises bounded verdicts to proven ones where exact elimination ends in time.

A verdict by condition 4 or 5 states that a set of invariants has rank k in one model and more in
the other. The larger rank is proven already (a minor that is not zero somewhere is not zero); that
the smaller one is k at most is proven by elimination over the polynomials.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations

from disting.algebra.certainty import Certainty
from disting.algebra.determinants import OutOfTimeError
from disting.behaviour.transfer import coefficients_have_rank, rank_is_at_most
from disting.conditions.rule import DEPENDENCES, RANK
from disting.conditions.side import AnySide
from disting.decide.identifiability import Identifiability, ParameterIdentifiability
from disting.decide.positive import ranges, within_ranges
from disting.errors import InputError, enumeration, of_type
from disting.evidence.conditions import Ranks
from disting.evidence.positive import PositiveFinding
from disting.experiments.experiment import Experiment
from disting.experiments.measured_network import measure
from disting.experiments.places import parse_experiment
from disting.general import AnyModel, MatrixModel, Model
from disting.model.chain import Chain, Quantity, Structure, as_quantity
from disting.model.names import read_together
from disting.model.question import Domain, Of
from disting.renamed import renamed
from disting.verdict.cascade import steps
from disting.verdict.decisions import Decisions
from disting.verdict.engine import Engine, Progress, silent
from disting.verdict.identifiable import identify, identify_measured
from disting.verdict.result import Conditions, Query, Step, Verdict, as_domain, query_of
from disting.verdict.sides import (
    Given,
    both_places,
    model_of,
    models_of_names,
    plain_sides,
    sides_of,
)

SECONDS = 10.0  # for one proof
# these invariants of this model have this rank at most
Claim = tuple[Structure | AnyModel, tuple[str, ...], int]


@renamed(sensor="quantity")
def prove(
    verdict: Verdict,
    left: Given,
    right: Given,
    seconds: float = SECONDS,
    *,
    damped: bool | None = None,
    quantity: Quantity | str | None = None,
) -> Verdict:
    """The verdict with certainty PROVEN if it rests on a rank that can be proven in time, else as
    it is; the models as `compare` takes them. Raises InputError for texts that name no models.

    >>> from disting import Family, compare
    >>> a = Family(3, damped=True)
    >>> compare(a[1], a[7]).certainty.value, prove(compare(a[1], a[7]), a[1], a[7]).certainty.value
    ('bounded', 'proven')
    """
    sides = sides_of(*models_of_names(left, right, damped, quantity), (), Engine())
    return prove_again(verdict, sides.left, sides.right, seconds)


def prove_again(verdict: Verdict, left: AnySide, right: AnySide, seconds: float) -> Verdict:
    """The same of two models as they are compared."""
    claim = _claim(verdict, left, right)
    holds = claim is not None and _holds(claim, seconds)
    return replace(verdict, certainty=Certainty.PROVEN, safety=0) if holds else verdict


def prove_all(
    decided: Decisions, seconds: float = SECONDS, progress: Progress = silent
) -> Decisions:
    """The decisions, with those marked that can be proven in time; each claim is checked once."""
    claims = dict(_claims(decided))
    different = list(dict.fromkeys(claims.values()))
    holds: dict[Claim, bool] = {}
    for done, claim in enumerate(different, 1):
        holds[claim] = _holds(claim, seconds)
        progress("proofs", done, len(different))
    return replace(
        decided, proven=frozenset(pair for pair, claim in claims.items() if holds[claim])
    )


def _claims(decided: Decisions) -> Iterator[tuple[tuple[int, int], Claim]]:
    for i, j in combinations(range(len(decided.subjects)), 2):
        if decided.rule(i, j) in (RANK.name, DEPENDENCES.name):
            claim = _claim(decided.verdict(i, j), decided.subjects[i], decided.subjects[j])
            if claim:
                yield (i, j), claim


def _claim(verdict: Verdict, left: AnySide, right: AnySide) -> Claim | None:
    """Claim of a verdict bounded by ranks that is not proven."""
    evidence = verdict.evidence
    if verdict.certainty is not Certainty.BOUNDED or not isinstance(evidence, Ranks):
        return None
    smaller = left if evidence.left < evidence.right else right
    rows = () if evidence.all_rows else evidence.rows
    if smaller.view.of is Of.CHAINS:
        # of several experiments, not of these chains
        several = any("[" in row for row in evidence.rows)
        model: Structure | AnyModel = smaller.view.form.structure
    elif smaller.view.of is Of.NETWORKS:
        # single invariants of several transfer functions, or before G0
        several = any("[" in row or "-" in row for row in rows)
        several = several or bool(smaller.subject.powers.weights)  # exponents were drawn at random
        model = smaller.subject
    else:
        return None
    return None if several else (model, rows, min(evidence.left, evidence.right))


def _holds(claim: Claim, seconds: float) -> bool:
    model, rows, most = claim
    try:
        if isinstance(model, Structure):
            return rank_is_at_most(model, rows, most, seconds)
        entries = [(e.numerator, e.denominator) for e in model.entries]
        return coefficients_have_rank(entries, model.parameters, rows, most, seconds)
    except OutOfTimeError:
        return False


@renamed(sensor="quantity")
def compare(
    left: Given,
    right: Given,
    *,
    damped: bool | None = None,
    quantity: Quantity | str | None = None,
    experiments: Sequence[Experiment | tuple[Experiment, Experiment]] = (),
    domain: Domain | str | None = None,
    conditions: Conditions | None = None,
    prove: bool = False,
    query: Query | None = None,
    audit: bool = False,
    engine: Engine | None = None,
) -> Verdict:
    """Verdict on two chains of any size (about 0.1 s for 5 masses; a look-up in the engine's store
    once it is there).

    Chains are also named: "3:1+b2", "A4" of as many masses as the other one has; `damped` and
    `quantity` (of the sensor: "position", "velocity", "acceleration") apply to names, else they are
    taken from the other chain (see `model.names`). General models (`Model`, `MatrixModel`) and
    networks (`Network`, or a text such as "R0-p(R1,C1)" or "1=2, 2=3, 2=4; F1; S4") are compared
    likewise, with each other or with chains; so are the matrices (A, B, C) or (A, B, C, D) of a
    state space, with entries as for `Model.from_state_space`.

    `domain`: "complex", "real" or "positive" parameters (default), those of a machine;
    `conditions`: decide by these alone, over complex parameters, such as "1-5,8"; `prove` raises
    what was computed at random points to a proof, if exact elimination ends in 10 s (`prove`);
    `query` limits views, conditions and Markov parameters, and has a domain of its own; `audit`
    runs every condition in every representation and raises ContradictionError where two decide
    differently; `engine` brings settings and a store (default: none). Raises InputError for what
    names no model, no condition or no domain.

    `experiments`: all ways in which both machines, chains or networks, are measured, with one
    parameter vector for all; `Experiment()` is that of both as they are. A pair of experiments
    names the places of the left and of the right model; a single one means the same places in both.

    >>> from disting import Experiment, Family
    >>> a = Family(3, damped=True)
    >>> compare(a[2], a[5]).relation.value, compare(a[1], a[4]).relation.value
    ('indistinguishable', 'distinguishable')
    >>> compare(a[1], a[11]).relation.value
    'indistinguishable'
    >>> compare("3:1", "A11").sentence[:52]
    '3:1 and 3:11, damped, acceleration, are indistinguis'
    >>> compare(([["-a"]], [1], ["b"]), ([["-c"]], ["d"], [1]), domain="complex").relation.value
    'indistinguishable'
    >>> compare(a[1], a[11], experiments=[Experiment(), Experiment(sensor=3)]).relation.value
    'distinguishable'
    >>> compare(a[1], a[7], conditions="1-5", prove=True).certainty.value
    'proven'
    """
    query, engine = asked_of(query, engine, domain, conditions)
    a, b = models_of_names(left, right, damped, quantity)
    sides = sides_of(a, b, both_places(experiments), engine)
    verdict = engine.verdict(sides.left, sides.right, query, audited=audit)
    verdict = prove_again(verdict, sides.left, sides.right, SECONDS) if prove else verdict
    return replace(verdict, notes=(*verdict.notes, *sides.notes))


def positive_shares(
    left: Given,
    right: Given,
    *,
    bound: Mapping[str, tuple[float | str, float | str]],
    damped: bool | None = None,
) -> tuple[PositiveFinding, PositiveFinding]:
    """Shares of the positive models of each of two chains that have an equivalent in the other one,
    within ranges of their parameters; chains as `compare` takes them.

    `bound`: lowest and highest value of parameters of either chain by name, numbers or text such as
    "2/3", taken exactly, in any one system of units; a parameter that is not named is any positive
    number. Raises InputError for networks, for names that are parameters of neither chain, and for
    ranges that are none.

    >>> [share.share.value for share in positive_shares("3:1", "3:11", bound={"k12": (0, 1000)})]
    ['sometimes', 'unknown']
    """
    a, b = models_of_names(left, right, damped, None)
    if not (isinstance(a, Chain) and isinstance(b, Chain)):
        raise InputError("ranges are supported for numbered chains only")
    names = dict.fromkeys((*a.parameters, *b.parameters))
    unknown = sorted(bound.keys() - names.keys())
    if unknown:
        raise InputError(
            f"no parameter of the two models is called {enumeration(unknown)}; their parameters"
            f" are {enumeration(names)}"
        )
    of_a, of_b = ({n: bound[n] for n in c.parameters if n in bound} for c in (a, b))
    return within_ranges(a, b, ranges(of_a, of_b)), within_ranges(b, a, ranges(of_b, of_a))


@renamed(sensor="quantity")
def findings(
    left: Given,
    right: Given,
    *,
    damped: bool | None = None,
    quantity: Quantity | str | None = None,
    query: Query | None = None,
    engine: Engine | None = None,
) -> tuple[Step, ...]:
    """List the findings of every condition in every representation, in order, whether it decides or
    not; of models as `compare` takes them. Raises InputError as that does.

    >>> steps = findings(Chain(2), Chain(2, meas_plus=2))
    >>> [(s.representation.value, s.finding.rule.name, s.finding.outcome.value) for s in steps][:3]
    [('tf', '1', 'fails'), ('tf', '2', 'fails'), ('tf', '3', 'fails')]
    """
    a, b = models_of_names(left, right, damped, quantity)
    query, engine = asked_of(query, engine)
    return tuple(steps(*plain_sides(a, b, engine), query))


def asked_of(
    query: Query | None,
    engine: Engine | None,
    domain: Domain | str | None = None,
    conditions: Conditions | None = None,
) -> tuple[Query, Engine]:
    """Return a query over the domain, by these conditions, and an engine, the usual ones by
    default; raises InputError for anything else, and for a query that says something else.
    """
    over = None if domain is None else as_domain(domain)
    if query is None:
        query = query_of(conditions, over)
    elif of_type(query, Query, "query is a Query") and over not in (None, query.view.domain):
        raise InputError(
            f"the query is over {query.view.domain} parameters, domain is {over}; give one of them"
        )
    elif conditions is not None:
        raise InputError("a query has conditions of its own: give query or conditions, not both")
    return query, Engine() if engine is None else of_type(engine, Engine, "engine is an Engine")


@renamed(sensor="quantity")
def identifiability(
    model: Given,
    *,
    damped: bool | None = None,
    quantity: Quantity | str | None = None,
    experiments: Sequence[Experiment] = (),
    also: Sequence[Experiment | str] = (),
    domain: Domain | str = Domain.POSITIVE,
    engine: Engine | None = None,
) -> Identifiability | ParameterIdentifiability:
    """Identifiability of a chain or a general model over a domain of parameters: each parameter
    globally, up to exchanges, locally or not at all (`levels`), the number of determinable ones
    (`rank`), the dimension of a generic fibre (`freedom`), and bounds of the number of parameter
    vectors that fit (`least`, `most`).

    `domain`: "complex", "real" or "positive" parameters, the last ones being those of a machine.
    `also`: experiments on the chain, or the network of masses, in addition to it as it is, each an
    `Experiment` or text such as "sensor=2, lock=1"; `experiments`: all ways in which it is
    measured, `Experiment()` being that of it as it is; with one parameter vector for all. Without
    them more is reported
    on the unmodified chain: which combinations are determined, and all parameter vectors at a
    random point. A chain can be named, such as "3:1+b2": `damped` and `quantity` then apply to it;
    a network that is a chain in the chain's own parameters is that chain. `engine` brings settings
    and a store. Raises InputError.

    >>> from disting import Experiment, Family
    >>> a = Family(3, damped=True)
    >>> identifiability(a[3]).freedom
    1
    >>> identifiability(a[3], experiments=[Experiment(), Experiment(locked=2)]).levels["m1"].value
    'not identifiable'
    >>> identifiability(a[3], also=["sensor=2"]).sentence
    '7 parameters, all globally identifiable.'
    >>> identifiability("R0-p(L1,R2)-p(R1,C1)").most, identifiability("R0-p(R1,C1)").level.value
    (1, 'global')
    """
    engine, over = engine or Engine(), as_domain(domain)
    model = model_of(model, Quantity.ACCELERATION if quantity is None else as_quantity(quantity))
    if isinstance(model, str):
        (model,) = read_together([model], damped=damped, quantity=quantity)
    if not isinstance(model, Chain | Model | MatrixModel):
        raise InputError(
            "identifiability takes a chain, such as Family(3)[4], a Model or a Network"
        )
    experiments = [*experiments, *with_unmodified(also)]
    if not experiments:
        return identify([model], over, engine)[0]
    if not all(isinstance(experiment, Experiment) for experiment in experiments):
        raise InputError(
            "experiments on one model are single ones, such as Experiment(sensor=2), not pairs"
        )
    return identify_measured(measure(model, tuple(dict.fromkeys(experiments))), over, engine)


def with_unmodified(also: Sequence[Experiment | str]) -> list[Experiment]:
    """The model as it is, and further experiments on it; none where there are no further ones.
    Raises InputError for text that names masses of two models.
    """
    further = [_one_model(e) if isinstance(e, str) else e for e in also]
    return [Experiment(), *further] if further else []


def _one_model(text: str) -> Experiment:
    parsed = parse_experiment(text)
    if parsed.places:
        raise InputError(f"{text} names masses of two models: write only {text.partition('/')[0]}")
    return parsed.experiment
