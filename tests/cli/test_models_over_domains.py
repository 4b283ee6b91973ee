"""disting models says what is determined over the domain that is named, positive values else."""

import pytest

from disting import Engine, Experiment, Family, identifiability
from tests.cli.process import called

SIGNED = "R0-p(L1,R2)-p(R1,C1)"


@pytest.mark.full
@pytest.mark.parametrize("domain", ["complex", "real", "positive"])
def test_a_network_over_a_domain(domain):
    said = called("models", SIGNED, "--domain", domain).stdout.splitlines()
    assert said[-1] == identifiability(SIGNED, domain=domain).sentence
    if domain == "positive":
        assert called("models", SIGNED).stdout.splitlines() == said


def test_chains_under_experiments_over_a_domain():
    said = called(
        "models", "2", "--undamped", "--also", "sensor=1", "--domain", "real"
    ).stdout.splitlines()
    chain, engine = Family(2, damped=False)[2], Engine()
    experiments = [Experiment(), Experiment(sensor=1)]
    found = identifiability(chain, experiments=experiments, domain="real", engine=engine)
    assert f"A2: {found.sentence}" in said
    assert any("sets real parameter sets" in line for line in said)


def test_another_domain_is_refused():
    done = called("models", SIGNED, "--domain", "rational")
    assert done.returncode == 2 and "not one of complex, real, positive" in done.stderr
