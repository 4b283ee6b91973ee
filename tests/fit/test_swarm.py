"""The particle swarm finds what structured starts find, where the problem is small."""

import pytest

from disting.fit.search.cost import Cost
from disting.fit.search.estimate import Task
from disting.fit.search.exchange import estimates
from disting.fit.search.swarm import by_swarm, search_box
from disting.model.chain import Chain
from tests.fit.drives import response, truth


@pytest.mark.slow
def test_a_swarm_reaches_the_same_cost_on_one_mass():
    pytest.importorskip("pymoo", reason="pymoo is not installed")
    chain = Chain(1, damped=True, ground_dampers=(1,), dead_time=True)
    task = Task(Cost(response(chain, truth(chain, 1), noise=0.02)))
    found = estimates([chain], task, method=by_swarm)
    assert list(found) == [chain]
    assert found[chain].j == pytest.approx(estimates([chain], task)[chain].j, rel=1e-4)


def test_the_box_holds_natural_sizes_and_the_bounds_of_the_user():
    chain = Chain(2, damped=True)
    task = Task(Cost(response(chain, truth(chain, 1))), bounds={"k12": (10.0, 20.0)})
    low, high = search_box(chain, task)
    assert (
        all(low < high) and low[2] == pytest.approx(2.302585) and high[2] == pytest.approx(2.995732)
    )
