"""Machines outside the candidates that explain the data: found where they are as good as a chain,
left out where the data exclude them.
"""

import pytest

from disting.fit.judge.candidate import judge, observed_scatters
from disting.fit.judge.look_alikes import LookAlikeKind
from disting.fit.judge.outside import machines_outside
from disting.fit.search.cost import Cost
from disting.fit.search.estimate import Estimate, Task
from disting.model.chain import Chain
from disting.model.question import Settings
from tests.fit.drives import response

VALUES = {
    "m1": 1.0, "m2": 0.8, "m3": 0.5, "m4": 0.7, "k12": 6e4, "k23": 4e4, "k34": 9e4, "b1": 3.0,
}  # fmt: skip
BRANCHES = {
    3: {"1=2, 1=3, 1-#; F1; S1"},
    4: {
        "1=2, 1=3, 1=4, 1-#; F1; S1",
        "1=2, 2=3, 1=4, 1-#; F1; S1",
    },
}


def outside(n, share, noise, fixed=(), first=1.0):
    """Those of a chain of n masses with dampers d = share k, the first of them times `first`,
    judged at its true values.
    """
    chain = Chain(n, damped=True, ground_dampers=(1,))
    joints = [f"{i}{i + 1}" for i in range(1, n)]
    values = {name: VALUES[name] for name in chain.parameters if name in VALUES}
    values |= {f"d{name}": share * VALUES[f"k{name}"] for name in joints}
    values = {name: values[name] * (first if name == "d12" else 1) for name in chain.parameters}
    task = Task(Cost(response(chain, values, noise=noise, seed=n)), fixed=dict(fixed))
    fits = [Estimate(chain, values, task.cost.total(response(chain, values).G))]
    known = observed_scatters(fits, task, None)
    (candidate,) = judge(fits, task, None, known, Settings())
    return machines_outside(candidate, task, task.cost, known)


@pytest.mark.full
@pytest.mark.parametrize("n", [3, pytest.param(4, marks=pytest.mark.full)])
def test_where_hardly_anything_is_damped_other_machines_are_as_good(n):
    """Each mode may be that of the base, and the held modes may be shared out in any way."""
    found = outside(n, share=1e-5, noise=0.02)
    assert not any(machine.is_better for machine in found)
    kinds = {kind: [x for x in found if x.kind is kind] for kind in LookAlikeKind}
    assert len(kinds[LookAlikeKind.ELASTIC_BASE]) == n - 1
    assert {x.text for x in kinds[LookAlikeKind.BRANCH]} == BRANCHES[n]
    whole = sum(VALUES[f"m{i}"] for i in range(1, n + 1))
    for machine in kinds[LookAlikeKind.BRANCH]:
        masses = [v for name, v in machine.values.items() if name[0] == "m"]
        assert len(masses) == n and sum(masses) == pytest.approx(whole, rel=0.02)
        assert machine.apart < 0.3 and 0.7 < machine.chi2 < 1.4


@pytest.mark.full
def test_data_that_show_the_damping_exclude_them():
    """Where all joints have the same d / k, others have that too, with the same response."""
    assert len(outside(3, share=4e-4, noise=0.0005)) == 3
    assert outside(3, share=4e-4, noise=0.0005, first=0.1) == ()


@pytest.mark.full
def test_given_values_are_not_compared():
    assert outside(3, 1e-5, 0.02, {"m1": 1.0}) == ()
    assert len(outside(3, 1e-5, 0.02, {"b1": 0.0})) == 3
