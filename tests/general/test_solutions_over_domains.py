"""Numbers of solutions over complex, real and positive parameters, their exchanges and levels,
beside all solutions by plain SymPy at random points.
"""

import json
import random
from fractions import Fraction

import pytest
import sympy as sp

from disting import (
    Engine,
    Experiment,
    Family,
    InputError,
    Level,
    Model,
    identifiability,
    network_of,
)
from disting.catalogs.files import shipped_folder
from disting.catalogs.network_files import name_of
from disting.decide.identifiability.levels import ParameterIdentifiability
from disting.general.symmetries import generators_of, symmetries_of
from disting.model.question import Domain
from tests.oracles import solutions as oracle
from tests.oracles.plain_network import response

ENGINE = Engine()
SIGNED = "R0-p(L1,R2)-p(R1,C1)"  # its second set has a negative resistance
TWINS = "R0-p(R1,C1)-p(R2,C2)"
FEW = [
    SIGNED,
    TWINS,
    "R1-p(R2-L1,R3-C1)",
    "p(R1,L1)-p(R2,R3-C1)",
    "p(R1-L1,R2-p(R3,C1))",
    "p(R1,L1)-p(R2,R3-L2)",
    "#~1, #~2; F2:1; S2:1",
    "1~2, 1~3; F1; S1",
    "1>0, 1>2, 2>0; in 1; out 2",
    "1>0, 1>2, 2>1, 3>2; in 3; out 1",
    "1>0, 1>2, 2>3, 3>0; in 1; out 3",
    "1>2, 1>3, 2>1, 3>2; in 1; out 2",
]  # fmt: skip


def agree(text, points):
    """Compare the answers over each domain with all solutions at random points."""
    network = network_of(text)
    function = oracle.response(network)
    names = network.parameters
    for point in oracle.points(names, random.Random(text), points):
        exact = {name: sp.Rational(x.numerator, x.denominator) for name, x in point.items()}
        seen = oracle.solutions(function, names, exact)
        numbers = {"complex": seen.complex, "real": seen.real, "positive": seen.positive}
        for domain, number in numbers.items():
            found = identifiability(text, domain=domain, engine=ENGINE)
            assert found.least <= number, (text, domain, number)
            assert found.most is None or number <= found.most, (text, domain, number)
        one = identifiability(text, engine=ENGINE)
        unique = {n for n, level in one.levels.items() if level is Level.GLOBAL}
        assert unique <= {n for n, is_one in seen.one_positive.items() if is_one}, text
        for exchange in one.exchanges:
            symbols = {sp.Symbol(a): sp.Symbol(b) for a, b in exchange.moved}
            ratio = function[0] / function[1]
            assert sp.cancel(ratio.subs(symbols, simultaneous=True) - ratio) == 0


@pytest.mark.full
@pytest.mark.sampled(4)
@pytest.mark.parametrize("text", FEW)
def test_numbers_against_sympy(text):
    agree(text, 2)


def local_networks(family):
    """The networks of a shipped family that have finitely many sets and no single one."""
    lines = (shipped_folder() / f"{name_of(family)}.jsonl").read_text(encoding="utf-8").splitlines()
    records = [r for r in map(json.loads, lines) if "network" in r]
    levels = {r["network"]: set(r["identifiability"]["levels"].values()) for r in records}
    return [n for n, of in levels.items() if "local" in of and not of & {"not identifiable"}]


@pytest.mark.slow
@pytest.mark.parametrize("family", ["circuits-4", "circuits-5", "machines-3", "compartments-3"])
def test_families_against_sympy(family):
    for text in local_networks(family):
        if "1 2;" not in text:  # bridges take SymPy minutes
            agree(text, 1)


@pytest.mark.full
def test_a_negative_resistance_is_no_second_set():
    found = identifiability(SIGNED, engine=ENGINE)
    assert (found.level, found.least, found.most) == (Level.GLOBAL, 1, 1)
    assert found.sentence == (
        "5 parameters, all globally identifiable over positive values; 2 sets of complex values"
        " fit."
    )
    real = identifiability(SIGNED, domain="real", engine=ENGINE)
    assert (real.level, real.least, real.most) == (Level.LOCAL, 2, 2)


@pytest.mark.full
def test_equal_branches_are_unique_up_to_their_exchange():
    found = identifiability(TWINS, engine=ENGINE)
    assert (found.level, found.least, found.most) == (Level.EXCHANGES, 2, 2)
    assert [dict(e.moved) for e in found.exchanges] == [
        {"C1": "C2", "C2": "C1", "R1": "R2", "R2": "R1"}
    ]
    assert found.sentence == (
        "5 parameters, all determinable; globally: R0; up to exchange: C1, C2, R1, R2; 2 sets of"
        " positive values fit: unique up to exchanging C1 ↔ C2, R1 ↔ R2."
    )


@pytest.mark.full
def test_a_number_that_depends_on_the_values():
    """R1-p(R2-L1,R3-C1) has one positive set at one point, and two at another one, by SymPy."""
    text = "R1-p(R2-L1,R3-C1)"
    found = identifiability(text, engine=ENGINE)
    assert (found.least, found.most, found.sampled, found.varies) == (1, 2, (1, 2), True)
    function, names = oracle.response(network_of(text)), ("C1", "L1", "R1", "R2", "R3")
    for values, number in (((1, 1, 3, 2, 1), 1), ((21, 9239, 7462, 1, 717), 2)):
        point = dict(zip(names, map(sp.Integer, values), strict=True))
        assert oracle.solutions(function, names, point).positive == number


@pytest.mark.full
def test_a_row_with_one_or_two_positive_sets():
    """3:2 has a second positive set for some values: both give one response by Newton's laws."""
    found = identifiability("3:2", damped=True, engine=ENGINE)
    assert (found.least, found.most, found.sampled, found.varies) == (1, 3, (1, 2), True)
    assert found.over_complex is not None and found.over_complex.most == 3
    names = ("d12", "d23", "k12", "k23", "m1", "m2", "m3")
    first = (4, 502, 82, 149, 4, 186, 14)
    second = (
        *(9.048483911266457, 159.19603152620834, 321.7444676999332, 46.9634624876357),
        *(187.36345354927667, 8.982637625501104, 7.653908825222214),
    )
    network = network_of("1=2, 2=3; F1; S2")
    for root in (Fraction(1), Fraction(1, 2), Fraction(3)):
        own, other = (
            response(network, dict(zip(names, map(Fraction, values), strict=True)), root)[0][0]
            for values in (first, second)
        )
        assert float(own) == pytest.approx(float(other), rel=1e-9)


@pytest.mark.full
def test_three_equal_branches_have_six_orders():
    text = "p(R1,C1)-p(R2,C2)-p(R3,C3)"
    found = identifiability(text, engine=ENGINE)
    assert (found.least, found.most, len(found.exchanges)) == (6, 6, 2)
    assert found.level is Level.EXCHANGES
    group = symmetries_of(Model.from_network(network_of(text)))
    assert len(group) == 6 and len(generators_of(group)) == 2


@pytest.mark.full
def test_complex_answers_are_those_of_before():
    """Levels over complex parameters, from ideals, and those over positive ones are ordered."""
    order = [Level.GLOBAL, Level.EXCHANGES, Level.LOCAL, Level.NOT]
    for text in FEW:
        plain, positive = (
            identifiability(text, domain=d, engine=ENGINE) for d in ("complex", "positive")
        )
        for name, level in positive.levels.items():
            if level is not Level.UNKNOWN:
                assert order.index(level) <= order.index(plain.levels[name]), (text, name)


@pytest.mark.parametrize("domain", list(Domain))
def test_a_chain_is_one_by_every_door(domain):
    for number in (2, 4, 6):
        chain = Family(3, damped=False)[number]
        name = f"3:{number}"
        model = Model.from_chain(chain)
        found = identifiability(chain, domain=domain, engine=ENGINE)
        assert found == identifiability(model, domain=domain, engine=ENGINE)
        assert model.network is not None
        assert found == identifiability(model.network, domain=domain, engine=ENGINE)
        assert found == identifiability(name, damped=False, domain=domain, engine=Engine())


@pytest.mark.full
def test_chains_under_experiments_have_a_domain():
    chain = Family(3, damped=False)[2]
    experiments = [Experiment(), Experiment(sensor=1)]
    found = identifiability(chain, experiments=experiments, engine=ENGINE)
    assert found.domain is Domain.POSITIVE and found.level is Level.GLOBAL
    alone = identifiability(Family(3, damped=False)[4], experiments=[Experiment()], engine=ENGINE)
    assert (alone.level, alone.least, alone.most) == (Level.EXCHANGES, 2, 2)


@pytest.mark.full
def test_what_is_not_known_is_not_claimed():
    """A bridge whose equations are not solved: exchanges are proven, other sets are not excluded."""
    found = identifiability("C1 1 2; R1 1 3; R2 2 3; R3 2 0; C2 3 0", engine=ENGINE)
    assert (found.least, found.most, found.varies) == (2, None, False)
    assert found.levels["R2"] is Level.UNKNOWN and found.levels["C1"] is Level.LOCAL
    assert "more are not excluded" in found.sentence


def test_an_exponent_is_exchanged_with_its_element():
    found = identifiability("R0-p(R1,P1)-p(R2,P2)", engine=ENGINE)
    assert (found.level, found.most) == (Level.EXCHANGES, 2)
    assert ("n1", "n2") in found.exchanges[0].moved


@pytest.mark.full
def test_plain_data_and_back():
    for text in (SIGNED, TWINS, "R1-p(R2-L1,R3-C1)", "3:2"):
        found = identifiability(text, damped=True if text == "3:2" else None, engine=ENGINE)
        again = type(found).from_dict(json.loads(json.dumps(found.to_dict())))
        assert again == found


def test_old_records_say_nothing_of_domains():
    record = {"levels": {"a": "local"}, "rank": 1, "least": 2, "most": None}
    record |= {"certainty": "bounded", "safety": 120, "reason": ""}
    found = ParameterIdentifiability.from_dict(record)
    assert found.domain is Domain.COMPLEX and found.to_dict() == record


def test_an_unknown_domain_is_an_input_error():
    with pytest.raises(InputError, match="domain is one of complex, real, positive"):
        identifiability(SIGNED, domain="rational")
