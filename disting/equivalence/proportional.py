"""Proportional damping: all springs have the same ratio d/k = tau. What holds without dampers then
holds with them.

With K the stiffness matrix and D = tau K, A(s) = M s^2 + (1 + tau s) K = (1 + tau s)(M u + K), u =
s^2/(1 + tau s). So the receptance is H(s) = H0(u)/(1 + tau s), with u in place of s^2 in H0, the
receptance without dampers: two undamped chains have the same receptance exactly if they have with
D = tau K, for every tau. Equivalents of other damping are not found this way.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from flint import fmpq

from disting.fibres.synthesis.fibre import fibre
from disting.fibres.synthesis.result import Solution
from disting.fibres.synthesis.target import target
from disting.model.chain import Chain


def common_ratio(chain: Chain, point: Mapping[str, fmpq]) -> Any | None:
    """tau = d/k if it is the same for all springs of a damped chain without other dampers."""
    if not chain.damped or chain.ground_dampers or chain.lag or chain.dead_time:
        return None
    ratios = {point[f"d{name[1:]}"] / point[name] for name in chain.parameters if name[0] == "k"}
    return ratios.pop() if len(ratios) == 1 else None


def proportional_solutions(
    given: Chain, point: Mapping[str, fmpq], other: Chain
) -> tuple[Solution, ...]:
    """The solutions of `other` with proportional damping too, where the given damping is
    proportional.
    """
    tau = common_ratio(given, point)
    if tau is None or not other.damped or other.ground_dampers or other.lag or other.dead_time:
        return ()
    plain, bare = replace(given, damped=False), replace(other, damped=False)
    found = fibre(bare, target(plain.structure, {name: point[name] for name in plain.parameters}))
    return tuple(replace(s, values=_with_dampers(other, s.values, tau)) for s in found.solutions)


def _with_dampers(chain: Chain, values: dict[str, Any], tau: Any) -> dict[str, Any]:
    return {
        name: values[f"k{name[1:]}"] * tau if name[0] == "d" else values[name]
        for name in chain.parameters
    }
