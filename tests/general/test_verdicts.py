"""General models compared: compartments, renamings, and chains turned into state spaces by
plain SymPy.
"""

from itertools import combinations

import pytest
import sympy as sp

from disting import (
    Certainty,
    Domain,
    Engine,
    Family,
    Query,
    Relation,
    Store,
    View,
    compare,
    compare as compare_chains,
    findings,
)
from disting.behaviour.profile import profile
from disting.behaviour.sample import Representation
from disting.conditions.rule import ADMISSIBLE, Finding, Outcome
from disting.conditions.side import Side
from disting.decide.asking import over_domain
from disting.evidence.conditions import Renaming
from disting.general.any_model import is_renamed
from disting.general.behaviour import GeneralModel
from disting.general.identifiability import local_identifiability
from disting.general.matrix_model import Model
from disting.general.network_view import NetworkView
from disting.model.question import Settings

COMPLEX = Query(View.EXACT)  # the paper's domain
SAME, DIFFERENT = Relation.INDISTINGUISHABLE, Relation.DISTINGUISHABLE
IRREVERSIBLE = Model.from_state_space(
    [["-k12-k01", 0], ["k12", "-k02"]], [1, 0], [0, 1], name="irreversible"
)
REVERSIBLE = Model.from_state_space(
    [["-k12-k01", "k21"], ["k12", "-k21"]], [1, 0], [0, 1], name="reversible"
)


def state_space(chain):
    """A, B, C, D of a chain with an acceleration sensor, from M x'' + D x' + K x = f."""
    n, symbol = chain.n_masses, {name: sp.Symbol(name) for name in chain.parameters}
    parts = {kind: sp.zeros(n) for kind in "mdk"}
    for e in chain.structure.elements:
        vector = sp.zeros(n, 1)
        for node, sign in ((e.at, 1), (e.at + 1, -1)) if e.kind in "kd" else ((e.at, 1),):
            if node:
                vector[node - 1] = sign
        parts[e.kind] += symbol[e.parameter] * vector * vector.T
    force, sensor = sp.zeros(n, 1), sp.zeros(1, n)
    for vector, plus, minus in (
        (force, chain.act_plus, chain.act_minus),
        (sensor, chain.meas_plus, chain.meas_minus),
    ):
        for node, sign in ((plus, 1), (minus, -1)):
            if node:
                vector[node - 1] += sign
    inverse = parts["m"].inv()
    lower = (-inverse * parts["k"]).row_join(-inverse * parts["d"])
    a = sp.zeros(n).row_join(sp.eye(n)).col_join(lower)
    return a, sp.zeros(n, 1).col_join(inverse * force), sensor * lower, sensor * inverse * force


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
def test_chains_as_state_spaces_give_the_verdicts_of_chains(damped):
    family = Family(3, damped=damped)
    models = [Model.from_state_space(*state_space(chain)) for chain in family]
    assert models == [Model.from_chain(chain) for chain in family]
    for i, j in combinations(range(len(models)), 2):
        assert compare(models[i], models[j], query=COMPLEX).relation is _of_chains(
            family[i + 1], family[j + 1]
        )


def _of_chains(left, right):
    return compare_chains(left, right, query=COMPLEX).relation


def test_two_compartments_are_complex_indistinguishable_by_condition_7():
    verdict = compare(IRREVERSIBLE, REVERSIBLE, query=COMPLEX, audit=True)
    assert (verdict.relation, verdict.decided_by, verdict.certainty) == (
        SAME,
        "7",
        Certainty.PROVEN,
    )


@pytest.mark.full
@pytest.mark.parametrize("view", [View.REAL, View.POSITIVE])
def test_two_compartments_are_not_said_to_be_the_same_over_the_reals(view):
    assert compare(IRREVERSIBLE, REVERSIBLE, query=Query(view=view)).relation is Relation.SOMETIMES


@pytest.mark.full
def test_over_positive_parameters_where_nothing_is_said():
    """As for chains: rate constants are positive too."""
    found = compare(IRREVERSIBLE, REVERSIBLE)
    assert (found.relation, found.domain.value) == (Relation.SOMETIMES, "positive")


def test_leak_in_the_other_compartment_changes_the_zero():
    """Input and output 1: (s + k12) against (s + k12 + k02) over two different quadratics; a
    closed system has a pole at 0.
    """
    closed = Model.from_state_space([["-k21", "k12"], ["k21", "-k12"]], [1, 0], [1, 0])
    leaks = [
        Model.from_state_space([[f"-k21-{one}", "k12"], ["k21", f"-k12-{two}"]], [1, 0], [1, 0])
        for one, two in (("k01", "0"), ("0", "k02"))
    ]
    assert compare(closed, leaks[0]).relation is DIFFERENT
    verdict = compare(*leaks, query=COMPLEX)
    assert (verdict.relation, verdict.decided_by) == (SAME, "7")


def test_parallel_paths_are_found_by_an_explicit_renaming():
    one = Model.from_transfer_function("b/(s + a) + c", "1", name="one")
    other = Model.from_transfer_function("z*s + z*x + y", "s + x", name="other")
    verdict = compare(one, other, query=COMPLEX)
    assert isinstance(verdict.evidence, Renaming) and verdict.certainty is Certainty.PROVEN
    assert dict(verdict.evidence.pairs) == {"a": "x", "b": "y", "c": "z"}
    assert compare(one, other, query=Query(view=View.POSITIVE)).relation is SAME


def test_renaming_with_the_opposite_sign_of_all_coefficients():
    one = Model.from_transfer_function("a", "(a - b)*s + c")
    other = Model.from_transfer_function("z", "(z - y)*s + x")
    assert is_renamed(one, other, {"a": "z", "b": "y", "c": "x"})
    assert not is_renamed(one, other, {"a": "z", "b": "x", "c": "y"})
    assert compare(one, other, query=COMPLEX).decided_by == "6"


def test_different_constants_are_found_by_the_exact_decision():
    one, other = (Model.from_transfer_function("k", f"s**2 + k*s + {number}") for number in (2, 3))
    verdict = compare(one, other, query=COMPLEX)
    assert (verdict.relation, verdict.decided_by) == (DIFFERENT, "exact")
    assert compare(one, other, query=Query(view=View.COMBINED)).relation is Relation.UNDECIDED


def test_a_curve_that_is_not_the_other_curve():
    """b = k, a = k^2 against b = k, a = k^3: both of rank 1 in two invariants, so conditions 1
    to 7 are silent.
    """
    square, cube = (Model.from_transfer_function("k", f"s + k**{power}") for power in (2, 3))
    assert compare(square, cube).relation is DIFFERENT
    again = Model.from_transfer_function("k + 1", "s + (k + 1)**2")
    assert compare(square, again, query=COMPLEX).relation is SAME


def test_constants_are_proven_exactly():
    model = Model.from_transfer_function("m*s**2 + k", "2*m*s**2 + 6*k")
    assert GeneralModel(model).constants(None) == {"b1": "0", "b2": "1/2", "a1": "0"}
    markov = GeneralModel(model).constants(5)
    assert markov == {"G0": "1/2", "G1": "0", "G3": "0", "G5": "0"}
    seen = profile(GeneralModel(model), Representation.MARKOV, 5, Settings())
    assert seen.form == {"G2", "G4"} and seen.rank == 1


def test_findings_come_in_order():
    steps = findings(IRREVERSIBLE, REVERSIBLE)
    assert [s.finding.rule.name for s in steps] == [*"1234567", *"1234567", "8", "9", "exact"]


def test_names_are_told_apart():
    assert (
        "model 1 and model 2"
        in compare(*(Model.from_transfer_function("k", f"s + k**{n}") for n in (2, 3))).sentence
    )


def test_local_identifiability():
    found = local_identifiability(Model.from_transfer_function(["c*a"], ["1", "c"]))
    assert (found.rank, found.identifiable, found.certainty) == (2, ("a", "c"), Certainty.PROVEN)
    found = local_identifiability(
        Model.from_state_space([["-a-b", 0], ["b", "-c"]], ["u", 0], [0, 1])
    )
    assert (found.rank, found.identifiable, found.unidentifiable) == (3, ("c",), ("a", "b", "u"))
    assert found.certainty is Certainty.BOUNDED and found.safety > 100


def test_constant_transfer_functions_are_compared_exactly():
    one, same, other = (
        Model.from_transfer_function(f"{n}*k", f"{d}*k") for n, d in ((2, 1), (4, 2), (3, 1))
    )
    assert compare(one, same, query=COMPLEX).relation is SAME
    verdict = compare(one, other, query=COMPLEX)
    assert (verdict.relation, verdict.certainty, verdict.decided_by) == (
        DIFFERENT,
        Certainty.PROVEN,
        "exact",
    )
    one, other = (
        Model.from_transfer_function(["2*a"], ["a", "3*a"]),
        Model.from_transfer_function(["5*b"], ["b", "3*b"]),
    )
    assert (
        "b0 is 2 in model 1 and 5 in model 2"
        in compare(one, other, query=COMPLEX, audit=True).sentence
    )


def test_any_name_may_be_a_parameter():
    one, other = (
        Model.from_transfer_function("scale", "s + scale**2"),
        Model.from_transfer_function("p1**3", "s + p1"),
    )
    assert compare(one, other, audit=True).relation is DIFFERENT


@pytest.mark.full
def test_what_a_store_kept_names_the_rule_that_decided():
    with Store.open(":memory:") as store:
        told = [
            compare(IRREVERSIBLE, REVERSIBLE, engine=Engine(store=store)).decided_by
            for _ in range(2)
        ]
        engine = Engine(store=store)
        sides = engine.general_subjects((IRREVERSIBLE, REVERSIBLE))
        told.append(engine.decisions(sides, Query()).rule(0, 1))
    assert told == ["admissible"] * 3


def test_names_that_look_like_places_for_names_stay_as_they_are():
    def answerer(question, models, settings):
        return Finding(ADMISSIBLE, Outcome.ABANDONED, note="at no points of {left} and of {right}")

    sides = [
        Side(name, NetworkView(model), answerer=answerer)
        for name, model in (("{right}", IRREVERSIBLE), ("{left}", REVERSIBLE))
    ]
    found = over_domain(sides[0], sides[1], Domain.REAL)
    assert found.note == "at no points of {right} and of {left}"
