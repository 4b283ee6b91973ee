"""Smaller chains as limits of larger ones: the list, its check in exact numbers, and SymPy's own limits."""

import pytest
import sympy as sp

from disting import Chain, Engine, Family, Inclusion, compare
from disting.conditions.inclusion import confirms
from disting.conditions.inclusion_finding import Limit, inclusion_from_json, inclusion_to_json
from disting.conditions.specialisation import CUT, RIGID, follows, limit_path, specialised
from disting.conditions.subject import Subject
from disting.model.symmetry import canonical

ENGINE = Engine()


def receptance(chain, p):
    """Receptance in SymPy, from the equation of motion written down entry by entry."""
    s, n = sp.Symbol("s"), chain.n_masses
    a = sp.zeros(n, n)
    for i in range(1, n + 1):
        a[i - 1, i - 1] += p[f"m{i}"] * s**2 + p.get(f"b{i}", 0) * s
    for i in range(n):
        w = p.get(f"k{i}{i + 1}", 0) + p.get(f"d{i}{i + 1}", 0) * s
        for r, c, sign in ((i, i, 1), (i - 1, i - 1, 1), (i, i - 1, -1), (i - 1, i, -1)):
            if r >= 0 and c >= 0:
                a[r, c] += sign * w
    act, meas = sp.zeros(n, 1), sp.zeros(1, n)
    for vector, plus, minus in ((act, chain.act_plus, chain.act_minus), (meas, chain.meas_plus, chain.meas_minus)):
        vector[plus - 1] += 1
        if minus:
            vector[minus - 1] -= 1
    return sp.cancel((meas * a.adjugate() * act)[0] / a.det(method="berkowitz"))


@pytest.mark.parametrize(
    "chain",
    [
        Chain(2),
        Chain(3, meas_plus=2, damped=True),
        Chain(3, 1, 1, 2, 1, 3),
        Chain(3, 2, 1, 3, 1, 3),
        Chain(2, ground_dampers=(1, 2)),
    ],
)
def test_limits_against_sympy(chain):
    """The limit of the larger chain's transfer function is of the form of the smaller one's, for chosen parameters."""
    numbers = {name: sp.Integer(2 + i * i) for i, name in enumerate(chain.parameters)}
    for s in specialised(chain):
        free = sp.Symbol("w", positive=True)
        names = [n for n in (f"k{s.joint}{s.joint + 1}", f"d{s.joint}{s.joint + 1}") if n in numbers]
        limit = 0 if s.limit == CUT else sp.oo
        values = numbers | {name: (free if name == names[0] else 0) for name in names}
        found = sp.limit(receptance(chain, values), free, limit)
        assert sp.simplify(found - receptance(s.chain, merged(chain, s, numbers))) == 0


def merged(chain, s, numbers):
    """The smaller chain's parameters, by hand: what meets is added."""
    out = dict.fromkeys(s.chain.parameters, 0)
    for name, value in numbers.items():
        kind, at = name[0], int(name[1])
        if (kind in "kd" and at == s.joint) or (s.limit == CUT and kind in "mb" and at == s.joint + 1):
            continue
        at -= at > s.joint
        new = f"{kind}{at}{at + 1}" if kind in "kd" else f"{kind}{at}"
        if new in out:
            out[new] += value
    return out


def test_the_limits_of_a_row_of_three():
    found = {(s.step, s.chain.act_plus, s.chain.meas_plus) for s in specialised(Chain(3, meas_plus=2))}
    assert found == {(("k12", RIGID), 1, 1), (("k23", RIGID), 1, 2), (("k23", CUT), 1, 2)}


def test_a_rigid_base_is_the_ground():
    """The grounded part of one mass at rest leaves the free row; a grounded part whose port rests leaves no model."""
    assert [s.chain for s in specialised(Chain(2, 1, 1, 2, 1, 2)) if s.joint == 0] == [Chain(1)]
    assert [s for s in specialised(Chain(3, 2, 1, 3, 2, 3)) if s.joint == 0] == []


@pytest.mark.parametrize("damped", [False, True])
def test_every_path_of_the_families_checks_again(damped):
    count = 0
    for n, m in ((1, 2), (1, 3), (2, 3), (3, 4)):
        for small in Family(n, damped):
            for large in Family(m, damped):
                steps = limit_path(small, large)
                if steps:
                    count += 1
                    assert len(steps) == m - n
                    assert follows(canonical(large).chain, canonical(small).chain, steps)
    assert count == 3 + 11 + 15 + 70


def test_wrong_paths_do_not_check():
    large, small = (canonical(c).chain for c in (Chain(3), Chain(2)))
    assert follows(large, small, (("k12", RIGID),))
    for steps in ((), (("k01", RIGID),), (("k12", CUT),), (("k12", RIGID), ("k12", RIGID))):
        assert not follows(large, small, steps)
    assert not follows(large, canonical(Chain(2, meas_plus=2)).chain, (("k12", RIGID),))


def test_one_mass_is_a_limit_of_every_model():
    for damped in (False, True):
        assert all(limit_path(Chain(1, damped=damped), chain) for n in (2, 3, 4) for chain in Family(n, damped))


def test_no_way_leads_up_or_sideways():
    assert limit_path(Chain(3), Chain(2)) == ()
    assert limit_path(Chain(2), Chain(2)) == ()
    assert limit_path(Chain(2, meas_plus=2), Chain(2)) == ()


def test_compare_shows_the_inclusion_and_its_evidence():
    small, large = Family(2, damped=True)[1], Family(3, damped=True)[4]
    verdict, turned = compare(small, large, engine=ENGINE), compare(large, small, engine=ENGINE)
    assert verdict.inclusion is Inclusion.LEFT_IN_RIGHT and turned.inclusion is Inclusion.RIGHT_IN_LEFT
    finding = verdict.inclusion_finding
    assert finding.sense == "closure" and finding.certainty == "proven"
    assert isinstance(finding.evidence, Limit) and not finding.evidence.left_is_larger
    assert "3:4 becomes 2:1" in finding.evidence.sentence("2:1", "3:4")
    assert confirms(finding.evidence, Subject("2:1", small), Subject("3:4", large))
    assert not confirms(finding.evidence, Subject("3:4", large), Subject("2:1", small))
    assert inclusion_from_json(inclusion_to_json(finding)) == finding


def test_what_is_not_shown_is_not_known():
    verdict = compare(Family(3)[8], Family(4)[1], engine=ENGINE)
    assert verdict.inclusion is Inclusion.UNKNOWN
    assert "no limit" in verdict.inclusion_finding.reason
