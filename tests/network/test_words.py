"""What commands say of networks, in the words of those who made them."""

import shlex

import numpy as np
import pytest

from disting.measurement import FrequencyResponse, write_csv
from tests.cli.process import called


def said(command: str, status: int = 0) -> str:
    done = called(*shlex.split(command))
    assert done.returncode == status, done.stderr
    return done.stdout


@pytest.mark.full
def test_a_circuit_has_an_impedance_and_no_nodes_or_machines():
    told = said("compare 'R0-p(R1,C1)-W1' 'R0-p(R1,C1)'")
    assert "Z(s) = " in told and "with a direct connection in place of W1" in told
    assert "The impedance of R0-p(R1,C1)-W1 has more coefficients" in told
    same = said("compare 'R0-p(R1,C1)' 'p(R0,R1-C1)'")
    assert "exactly the same impedance, and vice versa" in same and "response" not in same
    assert "exactly the same response" in said(
        "compare '1<>2, 1>0; in 1; out 1' '1<>2, 2>0; in 1; out 1'"
    )
    assert not {"node", "machine", "chain", "G(s)", "force", "sensor"} & set(told.split())
    told = said("compare 'R0-p(R1,C1)-p(R2,C2,C3-W1)-p(R3,C4)' R0-C1")
    assert "in powers of sqrt(s), in --json" in told


def test_a_limit_names_the_elements_that_are_missing():
    told = said("compare '1=2=3=1; F1; S1' '1=2=3; F1; S1' --domain complex")
    assert "1=2=3=1; F1; S1 without d13, k13 is 1=2=3; F1; S1" in told


@pytest.mark.full
def test_names_with_commas_are_parted_by_bars():
    assert "these are the same: 1>0, 1>2; in 1; out 2 | 1>2, 2>1; in 1; out 2\n" in said(
        "verdicts compartments-2"
    )
    assert "R1-p(R2,L1) | p(R1,R2-L1) | " in said("verdicts circuits-4")


@pytest.mark.full
def test_of_infinitely_many_values_some_are_told_as_such():
    told = said("equivalents 'R0-p(R1,C1)' --to 'R0-p(R1,C1)-R2' --set R0=1,R1=2,C1=1/2")
    assert told.endswith("and infinitely many more\n")
    told = said("equivalents 'R0-p(R1,C1)' --to 'p(R0,R1-C1)' --set R0=1,R1=2,C1=1/2")
    assert told.endswith("  C1 = 2/9, R0 = 3, R1 = 3/2\n") and "1 of 1 other network" in told


@pytest.mark.full
@pytest.mark.parametrize(("network", "is_circuit"), [("R0-p(R1,C1)", True), ("1=2; F1; S2", False)])
def test_values_of_circuits_have_units(tmp_path, network, is_circuit):
    s = 1j * np.logspace(0, 4, 60)
    noise = 1 + 1e-3 * np.random.default_rng(1).normal(size=(60, 2)) @ [1, 1j]
    write_csv(FrequencyResponse(s.imag, (1 + 2 / (1 + 0.02 * s)) * noise), tmp_path / "z.csv")
    told = said(f"fit {tmp_path / 'z.csv'} --models '{network}'", status=0 if is_circuit else 1)
    assert (" ohm " in told, " F " in told) == (is_circuit, is_circuit)


@pytest.mark.full
def test_an_undecided_pair_of_one_group_is_told_as_the_same():
    lines = said("verdicts machines-2").splitlines()
    groups = [
        set(line.removeprefix("these are the same: ").split(" | "))
        for line in lines
        if line.startswith("these")
    ]
    open_pairs = [
        line.partition(" are undecided")[0].split(" and ")
        for line in lines
        if " are undecided over" in line
    ]
    assert groups and not [p for p in open_pairs for g in groups if set(p) <= g]
