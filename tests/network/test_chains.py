"""Chains are networks: the same transfer functions, recognised by their names, drawn and read."""

from itertools import combinations

import pytest

from disting import Chain, Family, Inclusion, Quantity, Query, View, compare, verify
from disting.general.any_model import of_network
from disting.general.matrix_model import Model
from disting.model.chain import text_drawing
from disting.network.chains import as_chain, as_renamed_chain, of_chain
from disting.network.network import Network
from disting.network.notation import network_of
from disting.verdict.verdict_file import verdict_file

COMPLEX = Query(View.EXACT)
UNKNOWN = Inclusion.UNKNOWN
SIZES = [(n, damped) for n in (1, 2, 3, 4) for damped in (False, True)]


@pytest.mark.parametrize(("n_masses", "damped"), SIZES)
def test_every_chain_is_a_network_and_is_recognised(n_masses, damped):
    for chain in Family(n_masses, damped):
        network = of_chain(chain)
        found = as_chain(network)
        assert found is not None and found.structure == chain.structure
        drawn = as_chain(network_of(text_drawing(chain)))
        assert drawn is not None and drawn.structure == chain.structure


@pytest.mark.parametrize(("n_masses", "damped"), [s for s in SIZES if s[0] < 4])
def test_both_ways_to_the_transfer_function_agree(n_masses, damped):
    for chain in Family(n_masses, damped):
        bearing = Chain(**{f: getattr(chain, f) for f in FIELDS}, ground_dampers=(n_masses,))
        for each in (chain, bearing):
            assert Model.from_network(of_chain(each)).content == Model.from_chain(each).content


FIELDS = (
    "n_masses",
    "gap",
    "act_minus",
    "act_plus",
    "meas_minus",
    "meas_plus",
    "quantity",
    "damped",
)


def anonymous(network: Network) -> Network:
    """The same network with other names of its values: no chain is recognised."""
    elements = tuple(
        type(e)(f"{e.letter}_{i}", e.letter, e.nodes) for i, e in enumerate(network.elements)
    )
    return Network(elements, network.inputs, network.outputs, network.order, network.name)


def agree(family: Family) -> int:
    """All pairs as chains and as networks over complex parameters; counts them."""
    networks = [anonymous(of_chain(chain, f"N{i}")) for i, chain in enumerate(family, 1)]
    assert all(as_chain(network) is None for network in networks)
    count = 0
    for i, j in combinations(range(len(family)), 2):
        chains, found = (
            compare(family[i + 1], family[j + 1], query=COMPLEX),
            compare(networks[i], networks[j], query=COMPLEX),
        )
        assert found.relation is chains.relation, (i, j, found.sentence)
        assert found.closure in (chains.closure, UNKNOWN), (i, j, found.sentence)
        count += 1
    return count


@pytest.mark.full
def test_networks_have_the_verdicts_of_chains_for_2_and_3_undamped_masses():
    assert agree(Family(2, damped=False)) + agree(Family(3, damped=False)) == 58


@pytest.mark.slow
def test_networks_have_the_verdicts_of_chains_for_3_damped_and_4_masses():
    for family in (Family(2), Family(3), Family(4, damped=False)):
        agree(family)


def test_a_chain_in_its_own_names_is_compared_as_that_chain():
    found = compare("1=2=3; F1; S1", "3:11")
    assert found.evidence is not None and found.sure == "proven (duality theorem)"
    assert found.premises[0] is not None


@pytest.mark.parametrize(
    ("text", "chain", "own"),
    [
        ("3=1=2; F3; S3", "1=2=3; F1; S1", {"m1": "m3", "m2": "m1", "k12": "k13", "k23": "k12"}),
        ("2~1~3; F2; S2", "1~2~3; F1; S1", {"m1": "m2", "m2": "m1", "k12": "k12", "k23": "k13"}),
        ("#~2, 1~3; F1:2; S1:2", "#~1, 2~3; F2:1; S2:1", {"m1": "m2", "k01": "k02"}),
    ],
)
def test_a_chain_in_other_names_is_compared_as_that_chain(text, chain, own):
    found = as_renamed_chain(network_of(text))
    assert found is not None and own.items() <= found.names.items()
    assert compare(text, chain).relation.value == "indistinguishable"
    assert found.chain.structure == as_chain(network_of(chain)).structure


@pytest.mark.parametrize("text", ["1~2, 1~3, 1~4; F1; S1", "1~2, 2~3, 1~3; F1; S1"])
def test_no_chain_is_made_of_another_network(text):
    assert as_renamed_chain(network_of(text)) is None


def test_a_verdict_on_a_chain_in_other_names_tells_them():
    found = compare("2~1~3; F2; S2", "1~2~3; F1; S3")
    assert found.sentence.endswith(
        " Compared as the chain 3:1: m2 is m1, m1 is m2, k23 is k13 of 2~1~3; F2; S2."
    )


def test_the_file_of_a_verdict_on_networks_holds_and_a_changed_element_does_not():
    data = verdict_file("R0-p(R1,C1)", "R0-p(R1,C1)-p(R2,C2)")
    assert verify(data).sentence == "holds"
    elements = data["models"][0]["elements"]
    assert elements[0] == ["R0", 1, 2]
    elements[0] = ["L0", 1, 2]
    assert verify(data).status.value == "does not hold"


def test_one_model_has_as_many_parameters_as_named_even_if_some_do_not_enter():
    model = of_network(network_of("1~2, 2~#, 3~#; F1; S1"))
    assert model.parameters == ("k02", "k03", "k12", "m1", "m2", "m3")
    assert model.network is not None and model.network.unseen == ("k03", "m3")


def test_masses_alone_have_a_response_in_positions():
    assert str(of_network(network_of("1~2; F1; S1; position", name="free"))).endswith("s**4)")
    alone = network_of("1~2, 3~#; F3; S3; position")
    assert str(of_network(alone)) == "G(s) = 1/(k03 + m3*s**2)"
    single = of_network(network_of("[1FS]", quantity=Quantity.POSITION))
    assert str(single) == "G(s) = 1/(m1*s**2)"


@pytest.mark.full
def test_improper_transfer_functions_are_compared_over_positive_parameters():
    found = compare("p(R1-L1,L2)", "L1-p(R1,L2)")
    assert found.relation.value == "indistinguishable"
    assert compare("R1-L1-p(R2,C1)", "L1-p(R1,C1)-R2").relation.value == "indistinguishable"
