"""Look-alikes outside the candidates: their responses, computed here from mass, damping and
stiffness matrices, equal those of the fitted chain.
"""

import subprocess
import sys
from dataclasses import replace
from itertools import combinations, pairwise

import numpy as np
import pytest
from jsonschema import validate

from disting import identifiability
from disting.cli.fit_text import fit_text
from disting.equivalence import equivalents
from disting.errors import InputError
from disting.experiments.experiment import Experiment, MeasuredChain
from disting.files import Format, schema
from disting.fit.judge.alternatives import alternatives, representatives
from disting.fit.judge.look_alikes import LookAlikeKind, base_is_the_same, look_alikes
from disting.fit.judge.members import twins
from disting.fit.judge.modes import physical
from disting.fit.judge.outside import near_bases
from disting.fit.search.candidates import on_elastic_bases
from disting.fit.search.plant import Plant
from disting.fit.select import select
from disting.general.any_model import as_model
from disting.measurement import read
from disting.model.chain import Chain, Quantity
from disting.model.names import chain_of_whole_name, is_whole_name, name_of
from disting.network.chains import of_chain
from disting.network.network import Element, Network, Port
from disting.report.fit import fit_page
from disting.report.fit.answer import result_row
from disting.report.fit.selection_json import selection_to_dict
from disting.report.fit.sentences import first_lines
from disting.verdict.comparison import compare
from disting.verdict.engine import Engine
from disting.verdict.result import Query, Relation, View
from tests.fit.drives import response as noisy_response

OMEGA = 2 * np.pi * np.geomspace(1, 2000, 60)
VALUES = {
    "m1": 1.23e-3, "m2": 3.11e-3, "m3": 1.7e-3, "m4": 0.7e-3, "k12": 4123.7, "k23": 971.3,
    "k34": 2000.3, "d12": 0.03, "d23": 0.0123, "d34": 0.01, "b1": 0.02, "b2": 0.01, "b3": 0.03,
}  # fmt: skip


def response(values, joints, force, sensor, base=None):
    """Position per force by brute force. Joints {name: (i, j)}; ports (plus, minus), 0: ground;
    `base`: the number of its mass.
    """
    s, size = 1j * OMEGA, max(max(pair) for pair in (*joints.values(), force, sensor, (1, 0)))
    matrix = np.zeros((len(OMEGA), size + 1, size + 1), complex)
    for name, value in values.items():
        if name[0] == "m":
            i = base if name == "mb" else int(name[1:])
            matrix[:, i, i] += value * s**2
            continue
        if name in ("kb", "db"):
            i, j = base, 0
        else:
            i, j = joints[name[1:]] if name[1:] in joints else (int(name[1:]), 0)
        for a, b, sign in ((i, i, 1), (j, j, 1), (i, j, -1), (j, i, -1)):
            matrix[:, a, b] += sign * value * (1 if name[0] == "k" else s)
    push = np.zeros(size + 1)
    push[force[0]] += 1
    push[force[1]] -= 1
    moved = np.zeros((len(OMEGA), size + 1), complex)
    moved[:, 1:] = np.linalg.solve(
        matrix[:, 1:, 1:], np.broadcast_to(push[1:, None], (len(OMEGA), size, 1))
    )[..., 0]
    return moved[:, sensor[0]] - moved[:, sensor[1]]


def chain_response(chain):
    joints = {f"{i}{i + 1}": (i, i + 1) for i in range(1, chain.n_masses)}
    values = {name: VALUES[name] for name in chain.parameters}
    return response(values, joints, (1, 0), (chain.meas_plus, 0))


def look_alike_response(look_alike):
    if look_alike.kind is LookAlikeKind.BRANCH:
        edges, _, sensor = (part.strip() for part in look_alike.text.split(";")[:3])
        pairs = [part.strip().replace("=", "~").split("~") for part in edges.split(",")]
        joints = {i + j: (int(i), int(j)) for i, j in pairs}
        return response(look_alike.values, joints, (1, 0), (int(sensor[1:]), 0))
    n = sum(name[0] == "m" and name != "mb" for name in look_alike.values)
    joints = {f"{i}{j}": (i, j) for i, j in pairwise(range(1, n + 1))} | {"1b": (1, n + 1)}
    values = {"d1b" if name == "b1" else name: x for name, x in look_alike.values.items()}
    return response(values, joints, (1, n + 1), (1, n + 1), base=n + 1)


@pytest.mark.thin(8)
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("masses", [1, 2, 3, 4])
@pytest.mark.parametrize("sensor", [1, 2, 3, 4])
@pytest.mark.parametrize("grounded", [(), (1,)])
def test_responses_of_look_alikes_are_those_of_the_chain(masses, sensor, damped, grounded):
    if sensor > masses:
        return
    chain = Chain(masses, 0, 0, 1, 0, sensor, damped=damped or masses == 1, ground_dampers=grounded)
    mine = chain_response(chain)
    for look_alike in look_alikes(chain, VALUES).found:
        assert look_alike.values is not None, look_alike
        assert all(value > 0 for value in look_alike.values.values()), look_alike
        error = np.abs(look_alike_response(look_alike) - mine) / np.abs(mine)
        assert error.max() < 1e-9, look_alike


def kinds(chain):
    return [(x.kind.value, x.text) for x in look_alikes(chain, VALUES).found]


@pytest.mark.full
def test_look_alikes_are_those_of_the_theorems():
    """All rooted trees of as many masses and both bases, undamped; damped ones only for two."""
    undamped = kinds(Chain(4, damped=False))
    assert undamped == [
        ("elastic base", "3 masses on an elastic base with its resonance at 122 Hz"),
        ("elastic base", "3 masses on an elastic base with its resonance at 326 Hz"),
        ("elastic base", "3 masses on an elastic base with its resonance at 349.2 Hz"),
        ("free base", "4 masses on a base that moves freely"),
        ("branch", "1~2, 1~3, 1~4; F1; S1"),
        ("branch", "1~2, 1~3, 2~4; F1; S1"),
        ("branch", "1~2, 2~3, 2~4; F1; S1"),
    ]
    assert kinds(Chain(2, damped=True)) == [
        ("elastic base", "1 mass on an elastic base with its resonance at 344.3 Hz"),
        ("free base", "2 masses on a base that moves freely"),
    ]
    assert kinds(Chain(3, damped=True)) == [("free base", "3 masses on a base that moves freely")]
    assert kinds(Chain(3, 0, 0, 1, 0, 2, damped=True)) == [("branch", "1=2, 1=3; F1; S2")]
    assert kinds(Chain(3, damped=True, ground_dampers=(3,))) == []


@pytest.mark.full
@pytest.mark.parametrize(("masses", "damped"), [(2, False), (3, False), (4, False), (2, True)])
def test_engine_confirms_the_theorem_of_the_free_base(masses, damped):
    """The general engine knows nothing of the theorem."""
    chain = Chain(masses, damped=damped)
    base = masses + 1
    elements = (*of_chain(chain).elements, Element("mb", "m", (base,)))
    ports = (Port(1, base),)
    free = Network(elements, ports, ports, chain.quantity.order)
    verdict = compare(as_model(chain), as_model(free), query=Query(View.POSITIVE, inclusion=False))
    assert verdict.relation is Relation.INDISTINGUISHABLE


def all_dampers(masses, damped, number):
    """Chains with so many ground dampers, and such drives on an elastic base."""
    sets = list(combinations(range(1, masses + 1), number))
    chains = [Chain(masses, damped=damped, ground_dampers=chosen) for chosen in sets]
    return chains, [
        Chain(masses, 1, 1, 2, 1, 2, damped=damped, ground_dampers=chosen) for chosen in sets
    ]


@pytest.mark.full
@pytest.mark.parametrize("damped", [False, True])
@pytest.mark.parametrize("masses", [2, 3, pytest.param(4, marks=pytest.mark.slow)])
def test_engine_confirms_what_is_said_of_the_elastic_base(masses, damped):
    """Of every chain: one base has its responses, or all have others, proven."""
    for number in range(masses + 1):
        chains, bases = all_dampers(masses, damped, number)
        for chain in chains:
            found = [x.relation for x in alternatives(chain, bases, Engine(), {})]
            assert found == [Relation.INDISTINGUISHABLE] * base_is_the_same(chain), chain


def test_rows_with_other_dampers_are_chains_and_no_branches():
    """Reciprocity: the damper may be at the sensor as well; such a chain is a candidate itself."""
    assert kinds(Chain(2, 0, 0, 1, 0, 2, ground_dampers=(1,))) == []
    assert kinds(Chain(3, 0, 0, 1, 0, 3, ground_dampers=(1,))) == []


@pytest.mark.parametrize("damped", [False, True])
def test_fitted_mass_is_the_reduced_mass(damped):
    for masses in (2, 3):
        for x in look_alikes(Chain(masses, damped=damped), VALUES).found:
            if x.kind is not LookAlikeKind.BRANCH:
                m1, mb = x.values["m1"], x.values["mb"]
                assert m1 * mb / (m1 + mb) == pytest.approx(VALUES["m1"], rel=1e-12)


def test_limits_are_named():
    assert look_alikes(Chain(5, damped=False), VALUES).not_looked_for
    assert look_alikes(Chain(3, 0, 0, 2, 0, 2), VALUES).not_looked_for
    assert look_alikes(Chain(3, damped=True), VALUES).base_differs
    assert not look_alikes(Chain(3, damped=False), VALUES).base_differs


def test_damping_alone_tells_a_damped_branch_from_a_chain():
    assert look_alikes(Chain(3, damped=True), VALUES).lossless == ("1~2, 1~3; F1; S1",)
    assert look_alikes(Chain(3, 0, 0, 1, 0, 2, damped=True), VALUES).lossless == ()
    assert look_alikes(Chain(3, damped=False), VALUES).lossless == ()


S = 2j * np.pi * np.geomspace(3, 500, 100)

UNDAMPED = [Chain(n, damped=False, lag=lag) for n in (2, 3) for lag in (False, True)]


def two_masses(m1, m2, k, d):
    return 1 / (m1 * S**2 + 1 / (1 / (k + d * S) + 1 / (m2 * S**2)))


def fitted(tmp_path, response, candidates, s=S):
    """The printed text and the plain data of a fit of an acceleration with 0.3 % noise."""
    rng = np.random.default_rng(3)
    noise = rng.standard_normal(len(s)) + 1j * rng.standard_normal(len(s))
    measured = response * s**2 * (1 + 0.003 * noise)
    file = tmp_path / "drive.csv"
    columns = np.c_[s.imag / (2 * np.pi), measured.real, measured.imag]
    head = "Frequency [Hz],Re [rad/s^2/Nm],Im [rad/s^2/Nm]"
    np.savetxt(file, columns, header=head, delimiter=",", comments="")
    train = read(file, quantity=Quantity.ACCELERATION)
    selection = select(train, candidates)
    return "\n".join(fit_text(selection, train)), selection_to_dict(selection)


@pytest.mark.full
def test_fit_of_a_drive_on_an_elastic_base_names_the_base(tmp_path):
    """The true base is among the named ones, with its values."""
    drive = two_masses(1e-3, 2e-3, 300, 0) + 1 / (5e-3 * S**2 + 3500)
    text, plain = fitted(tmp_path, drive, UNDAMPED)
    assert "2 masses on an elastic base with its resonance at 133" in text
    assert "m1 is then the reduced mass m1 mb/(m1 + mb)" in text
    bases = [x["values"] for x in plain["look_alikes"]["found"] if x["kind"] == "elastic base"]
    true = {"m1": 1e-3, "m2": 2e-3, "k12": 300, "mb": 5e-3, "kb": 3500}
    assert any(x == pytest.approx(true, rel=0.02) for x in bases)


@pytest.mark.full
def test_fit_of_a_branch_names_the_branch(tmp_path):
    s = 2j * np.pi * np.geomspace(3, 500, 60)
    load = sum(1 / (1 / k + 1 / (m * s**2)) for k, m in ((300, 1e-3), (900, 0.8e-3)))
    drive = 1 / (1e-3 * s**2 + load)
    text, plain = fitted(tmp_path, drive, [Chain(3, damped=False)], s)
    assert "a branch 1~2, 1~3; F1; S1 has the same responses" in text
    (branch,) = (x["values"] for x in plain["look_alikes"]["found"] if x["kind"] == "branch")
    ends = sorted((branch[f"m{i}"], branch[f"k1{i}"]) for i in (2, 3))
    assert np.array(ends) == pytest.approx(np.array([(0.8e-3, 900), (1e-3, 300)]), rel=0.02)


@pytest.mark.slow
def test_damped_elastic_base_is_fitted_as_a_candidate(tmp_path):
    """A chain does not explain it; the base does, with its values, and the text names the option; on
    the base it is selected.
    """
    drive = two_masses(1e-3, 2e-3, 300, 0.02) + 1 / (5e-3 * S**2 + 0.3 * S + 2000)
    plain_chains = [Chain(2), Chain(3)]
    text, plain = fitted(tmp_path, drive, plain_chains)
    assert not plain["explained"]
    assert "outside the candidates this machine explains it: 2 masses on an elastic base" in text
    assert "next: fit drives on an elastic base too (--base)" in text
    found = [x["values"] for x in plain["outside"] if x["better"]]  # either resonance is the base's
    true = {"m1": 1e-3, "m2": 2e-3, "k12": 300, "mb": 5e-3, "kb": 2000}
    assert any(all(v[n] == pytest.approx(x, rel=0.05) for n, x in true.items()) for v in found)
    text, plain = fitted(tmp_path, drive, [*plain_chains, *on_elastic_bases([Chain(2)])])
    assert plain["explained"]
    assert (plain["selected"]["gap"], plain["selected"]["actuator"]) == (1, [1, 2])
    assert "mass 1 is the base" in text


@pytest.mark.full
def test_damped_base_of_as_many_masses_is_no_duplicate_and_an_undamped_one_is():
    for damped in (True, False):
        chain, (base,) = Chain(3, damped=damped), on_elastic_bases([Chain(2, damped=damped)])
        first = representatives([chain, base], Engine(), {})
        assert first[base] == (base if damped else chain)


@pytest.mark.full
def test_base_refuses_what_it_is_not_for():
    words = [sys.executable, "-m", "disting", "fit", "--demo", "--base", "--gap", "1"]
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 2
    assert "--base needs one response" in done.stderr
    with pytest.raises(InputError, match="--base"):
        on_elastic_bases([Chain(3, 1, 1, 2, 1, 2)])


@pytest.mark.parametrize("masses", [1, 2, 3])
def test_friction_at_the_motor_is_between_motor_and_base(masses):
    """A term of force per velocity where force and sensor are: the bases of the chain without it
    have it too.
    """
    chain = Chain(masses, damped=masses > 1, ground_dampers=(1,))
    without = look_alikes(replace(chain, ground_dampers=()), VALUES)
    found = [x for x in look_alikes(chain, VALUES).found if x.kind is not LookAlikeKind.BRANCH]
    assert [x.kind for x in found] == [x.kind for x in without.found]
    assert all("friction b1 between base and motor" in x.text for x in found)


@pytest.mark.parametrize("grounded", [(), (1,), (3,)])
def test_base_within_the_scatter_is_found_and_no_other(grounded):
    chain = Chain(3, ground_dampers=grounded, lag=True)
    values = VALUES | {"d12": 0.01, "b3": 0.002, "T1": 1e-4}
    none, found = (
        near_bases(chain, values, OMEGA, np.full(len(OMEGA), rho)) for rho in (1e-5, 0.05)
    )
    assert not none
    assert {x.kind for x in found} == {LookAlikeKind.ELASTIC_BASE}
    plain = {name: values[name] for name in replace(chain, lag=False).parameters}
    mine = response(plain, {"12": (1, 2), "23": (2, 3)}, (1, 0), (1, 0))
    for x in found:
        assert 0 < x.apart < 0.1
        error = np.abs(look_alike_response(x) / mine - 1).max()
        assert error == pytest.approx(x.apart, rel=0.02)


@pytest.mark.full
def test_structure_line_tells_of_another_base_with_other_values(tmp_path):
    s = S[::3]
    drive = 1 / (1 / two_masses(1e-3, 2e-3, 300, 0.01)[::3] + 0.01 * s)
    candidates = [Chain(2), Chain(2, ground_dampers=(1,))]
    text, plain = fitted(tmp_path, drive, candidates, s)
    structure = next(line for line in text.splitlines() if line.startswith("structure: "))
    clause = "would give the same response, with other values (see look-alikes)"
    assert f"an elastic base or a base that moves freely {clause}" in structure
    assert any(clause in line for line in plain["answer"])
    assert "look-alike: 1 mass on an elastic base" in text


@pytest.mark.full
def test_structure_line_tells_of_a_base_within_the_scatter(tmp_path):
    drive = two_masses(1e-3, 2e-3, 300, 0.01) + 1 / (5e-3 * S**2 + 0.12 * S + 3500)
    text, plain = fitted(tmp_path, drive[::3], [Chain(3)], S[::3])
    clause = "an elastic base within the scatter, with other values"
    assert clause in next(line for line in text.splitlines() if line.startswith("structure: "))
    near = plain["look_alikes"]["near"]
    assert any(x["values"]["mb"] == pytest.approx(5e-3, rel=0.2) for x in near)
    assert "within the scatter of this data (they differ by up to" in near[0]["sentence"]


BASE = Chain(3, 1, 1, 2, 1, 2, gap_damper=True)
ON_BASE = {
    "m1": 5e-3, "m2": 1e-3, "m3": 2e-3, "k01": 3500.0, "k23": 300.0, "d01": 0.3, "d12": 0.05,
    "d23": 0.02,
}  # fmt: skip


def at(chain: Chain, values: dict[str, float]) -> np.ndarray:
    w = np.geomspace(10, 3000, 9)
    return Plant(chain.structure, w).response(np.array([values[n] for n in chain.parameters]))


def test_a_base_is_offered_without_and_with_bearing_friction():
    chains = [Chain(2, ground_dampers=chosen) for chosen in ((), (1,), (2,), (1, 2))]
    assert on_elastic_bases(chains) == (Chain(3, 1, 1, 2, 1, 2), BASE)
    assert on_elastic_bases([Chain(2, meas_plus=2, ground_dampers=(1,))])[0].gap_damper
    assert on_elastic_bases([Chain(2, 0, 0, 2, 0, 2, ground_dampers=(1,))]) == ()


def test_friction_between_motor_and_base_is_a_term_in_s_of_the_inverse_response():
    bare = replace(BASE, gap_damper=False)
    s = 1j * np.geomspace(10, 3000, 9)
    expected = 1 / (1 / (at(bare, ON_BASE) / s**2) + ON_BASE["d12"] * s) * s**2
    assert at(BASE, ON_BASE) == pytest.approx(expected)


@pytest.mark.full
@pytest.mark.parametrize("damped", [True, False])
def test_a_base_with_friction_is_fitted_once_where_a_chain_with_friction_is_the_same(damped):
    for n in (1, 2):
        chain = Chain(n + 1, damped=damped, ground_dampers=(1,))
        (base,) = on_elastic_bases([Chain(n, damped=damped, ground_dampers=(1,))])
        first = representatives([chain, base], Engine(), {})
        assert first[base] == (base if damped and n == 2 else chain)


@pytest.mark.parametrize("chain", [Chain(3, damped=False), Chain(2)])
def test_look_alikes_on_a_base_have_the_friction_of_the_motor(chain):
    """The response of the base that is named is that of the chain, with the values that are
    named.
    """
    chain = replace(chain, ground_dampers=(1,))
    values = {n: {"m": 1e-3, "k": 300.0, "d": 0.02, "b": 0.05}[n[0]] for n in chain.parameters}
    bases = [x for x in look_alikes(chain, values).found if x.kind is LookAlikeKind.ELASTIC_BASE]
    named = [x for x in bases if "friction b1 between base and motor" in x.text]
    assert len(named) == chain.n_masses - 1
    (base,) = on_elastic_bases([replace(chain, n_masses=chain.n_masses - 1)])
    for found in named:
        v = dict(found.values)
        there = {"m1": v["mb"], "k01": v["kb"], "d01": v.get("db", 0.0), "d12": v["b1"]}
        there |= {"m2": v["m1"], "m3": v.get("m2", 0.0), "k23": v.get("k12", 0.0)}
        assert at(base, there) == pytest.approx(at(chain, values))


@pytest.mark.full
def test_the_other_values_of_a_base_with_friction_are_named():
    """Any of the two resonances may be that of the base."""
    found, unknown = twins(BASE, {n: ON_BASE[n] for n in BASE.parameters}, {})
    assert any(twin.chain == BASE for twin in found)
    for twin in found:
        assert list(twin.parameters) == list(twin.chain.parameters)
        assert at(twin.chain, twin.parameters) == pytest.approx(at(BASE, ON_BASE))
    assert all("+d" in name for name in unknown)


def test_a_base_with_friction_in_commands_and_files():
    assert name_of(BASE) == "3:6+d12" and is_whole_name("3:6+d12")
    assert chain_of_whole_name("3:6+d12", True, BASE.quantity) == BASE
    assert chain_of_whole_name("3:6+d23", True, BASE.quantity) is None
    assert chain_of_whole_name("3:1+d12", True, BASE.quantity) is None


@pytest.mark.parametrize(
    "door",
    [
        lambda: compare("3:1", BASE),
        lambda: equivalents(BASE, ON_BASE, Chain(3)),
        lambda: identifiability(BASE),
        lambda: Engine().measured_subject("", MeasuredChain(BASE, (Experiment(),))),
    ],
)
def test_what_holds_of_chains_is_not_said_of_one_with_a_damper_across_the_gap(door):
    with pytest.raises(InputError, match="damper across the gap"):
        door()


@pytest.mark.slow
def test_a_drive_with_bearing_friction_on_a_base_is_found(tmp_path):
    """A chain does not explain it; the true structure is selected, and the true values are its own
    or named as others with the same response.
    """
    inverse = 1 / (two_masses(1e-3, 2e-3, 300, 0.02) + 1 / (5e-3 * S**2 + 0.3 * S + 2000))
    chains = [Chain(n, ground_dampers=g) for n in (2, 3) for g in ((), (1,))]
    bases = on_elastic_bases([c for c in chains if c.n_masses == 2])
    text, plain = fitted(tmp_path, 1 / (inverse + 0.05 * S), [*chains, *bases])
    assert plain["explained"] and plain["selected"]["gap_damper"]
    assert "d12 is the friction between them" in text


TWO_ON_BASE = Chain(3, 1, 1, 2, 1, 2, Quantity.POSITION, damped=True)
HOUSED = {
    "m1": 4.0, "m2": 1.0, "m3": 0.6, "k01": 6e4, "k23": 3e4, "d01": 20.0, "d23": 4.0,
}  # fmt: skip


@pytest.mark.slow
def test_which_resonance_is_that_of_the_base_is_not_decided():
    """Both sets of values have exactly the same response: none is given alone."""
    measured = noisy_response(TWO_ON_BASE, HOUSED, noise=0.003, seed=1)
    found = select(measured, [TWO_ON_BASE])
    first = found.members[0]
    (other,) = first.exchanged
    both = [first.candidate.estimate.parameters, other.estimate.parameters]
    plant = Plant(TWO_ON_BASE.structure, measured.omega, 1)
    one, two = (plant.response(np.array(list(values.values()))) for values in both)
    assert two == pytest.approx(one, rel=1e-6) and abs(both[0]["m1"] / both[1]["m1"] - 1) > 0.5
    errors = [c.standard_errors for c in (first.candidate, other)]
    off = [
        max(abs(at[n] - v) / error[n] for n, v in HOUSED.items())
        for at, error in zip(both, errors, strict=True)
    ]
    assert min(off) < 4 < max(off)
    assert all(first.intervals[n][0] <= v <= first.intervals[n][1] for n, v in HOUSED.items())
    said, text = first_lines(found)[1], "\n".join(fit_text(found, measured))
    hertz = [f"{np.sqrt(at['k01'] / at['m1']) / 2 / np.pi:.4g}" for at in both]
    assert f"with its resonance at {hertz[0]} or {hertz[1]} Hz: which one is" in said
    assert f"{both[0]['m1']:<11.6g} ± " in text and f" or {both[1]['m1']:.6g} ± " in text
    plain = selection_to_dict(found)
    assert plain["values_hold"] == "for one of 2 sets with the same response"
    assert plain["not_excluded"][0]["other_values"][0]["parameters"] == both[1]
    validate(plain, schema(Format.FIT))
    rows = [result_row(r, measured).value for r in physical(other, found.task)]
    page = fit_page(found, physical(found.described, found.task), [], measured)
    assert f"or {rows[0]}" in page
