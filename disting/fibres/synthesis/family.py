"""Parallel dampers: only d_01 + b_1 of the damper beside the first spring and that from mass 1
to the ground is determined.
"""

from dataclasses import replace

from disting.fibres.synthesis.result import Confirmation, Fibre, Solution, Status
from disting.model.chain import Chain


def shared(chain: Chain, found: Fibre) -> Fibre:
    """The fibre of the chain with both dampers from that of the chain without b_1: half and half
    of each solution.

    Where d_01 + b_1 = 0, d_01 is at the boundary there.
    """
    status = Status.INFINITE if found.status is Status.COMPLETE else found.status
    reason = (
        "a family of solutions: d_01 + b_1 alone is determined"
        if status is Status.INFINITE
        else found.reason
    )
    return replace(
        found,
        status=status,
        reason=reason,
        solutions=tuple(_halved(chain, s) for s in found.solutions),
    )


def _halved(chain: Chain, solution: Solution) -> Solution:
    half = solution.values["d01"] / 2
    known = solution.values | {"d01": half, "b1": half}
    values = {name: known[name] for name in chain.parameters}
    return replace(
        solution, values=values, gauges=solution.gauges + 1, confirmation=Confirmation.BALLS
    )
