"""Chains and other machines that compete in one list."""

import json

import pytest

from disting.fit.search.machines import as_machine, each_once, with_ground_damper
from disting.model.chain import Chain
from disting.model.family import Family
from disting.network import network_of
from tests.cli.process import called
from tests.measurement.bench_data import write_branched_drive


@pytest.fixture
def branched(tmp_path):
    path = tmp_path / "drive.csv"
    write_branched_drive(path)
    return path


@pytest.mark.parametrize("damped", [False, True])
def test_the_text_of_a_chain_is_that_chain(damped):
    chains = [*Family(2, damped=damped), *Family(3, damped=damped)]
    chains += [Chain(n, damped=damped, ground_dampers=(n,)) for n in (1, 2)]
    for chain in chains:
        machine = as_machine(chain)
        read = network_of(machine.name)
        assert each_once([read, machine]) == [read], machine.name


@pytest.mark.full
def test_a_tree_and_chains_compete_in_one_list(branched):
    """The tree is found, and the chain is listed that does not explain the data."""
    tree = "1=2, 1=3, 1-#; F1; S1"
    words = ("--masses", "3", "--models", tree, "--json", "-")
    plain = json.loads(called("fit", branched, *words).stdout)
    assert plain["selected"] == tree
    stands = {fit["name"]: fit["explains"] for fit in plain["fits"]}
    assert stands == {tree: True, "1=2=3; F1; S1": False}


@pytest.mark.full
def test_a_tree_that_is_never_told_from_a_chain_is_told_with_it(branched):
    words = ("--undamped", "--masses", "3", "--models", "1~2, 1~3; F1; S1", "1~3, 3~2; F1; S1")
    plain = json.loads(called("fit", branched, *words, "--json", "-").stdout)
    (fit,) = plain["fits"]
    assert fit["name"] == "1~2~3; F1; S1" and fit["same"] == ["1~2, 1~3; F1; S1"]


def test_a_ground_damper_is_where_the_force_is():
    names = ("1=2, 1-#; F1; S2", "R1-C1", "1=2; F1 F2; S1", "#=1=2; F2; S1")
    found = [n.name for n in with_ground_damper(map(network_of, names))]
    assert found == [
        "1=2, 1-#; F1; S2",
        "R1-C1",
        "1=2; F1 F2; S1",
        "#=1=2; F2; S1",
        "#=1=2, 2-#; F2; S1",
    ]


@pytest.mark.full
@pytest.mark.parametrize(
    ("words", "reason"),
    [
        ("--models 1=2;F1;S1 --gap 1", "as --masses 1-3"),
        ("--models R1-C1 --masses 2", "not with circuits"),
        ("--models 1=2;F1;S1 --masses 2 --sensor 1,2", "name one --sensor"),
        ("--models 1=2;F1;S1 --masses 2 --controller P=1", "not supported with --models"),
        ("--ground-damper", "is for --models"),
    ],
)
def test_what_does_not_belong_together_is_refused(branched, words, reason):
    done = called("fit", branched, *words.split())
    assert done.returncode == 2 and reason in done.stderr
