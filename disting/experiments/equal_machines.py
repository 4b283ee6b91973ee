"""Measured chains that are one and the same machine: numbered from the other end, or with force and
sensor exchanged.

* Reciprocity. A(s) is symmetric whatever is locked or added, and so is its inverse: a force at one
  place shows at another one what a force there shows here. So force and sensor may be exchanged, in
  all experiments at once; the sensor's power of s and a lag are factors of their own. The force
  moved to a mass becomes a sensor moved there.
* Reflection. The free row, masses gap + 1 to n, may be numbered from its other end, with all that
  is measured and done there; no spring joins it to the masses before.

Both change names of parameters only, so all transfer functions remain what they are: equal measured
chains in the form below are the same for all parameters. `model.symmetry` knows more forms of one
transfer function: those that exchange force and sensor in one row alone do not carry over a
further experiment.
"""

from dataclasses import replace
from functools import lru_cache, partial

from disting.experiments.experiment import MeasuredChain
from disting.model.chain import Chain

REMEMBERED = 4096


@lru_cache(maxsize=REMEMBERED)
def standard(measured: MeasuredChain) -> MeasuredChain:
    """The form of the machine with the fewest moved forces and the smallest numbers.

    >>> from disting.experiments.experiment import Experiment
    >>> last = MeasuredChain(Chain(3, damped=False), (Experiment(), Experiment(force=3)))
    >>> standard(last).text
    ('as it is', 'sensor 3')
    """
    return min(_forms(measured), key=_order)


def _forms(measured: MeasuredChain) -> list[MeasuredChain]:
    both = (measured, _exchanged(measured))
    return [*both, *map(_reflected, both)]


def _order(measured: MeasuredChain) -> tuple[object, ...]:
    """What the standard form has least of."""
    chain = measured.chain
    told = [
        (e.force or (), e.sensor or (), [(c.kind, c.place, c.size) for c in e.changes])
        for e in measured.experiments
    ]
    forces = sum(e.force is not None for e in measured.experiments)
    return forces, chain.indices, chain.ground_dampers, told


def _exchanged(measured: MeasuredChain) -> MeasuredChain:
    given = measured.chain
    chain = replace(
        given,
        act_minus=given.meas_minus,
        act_plus=given.meas_plus,
        meas_minus=given.act_minus,
        meas_plus=given.act_plus,
    )
    moved = (replace(e, force=e.sensor, sensor=e.force) for e in measured.experiments)
    return MeasuredChain(chain, tuple(moved))


def _reflected(measured: MeasuredChain) -> MeasuredChain:
    given = measured.chain
    chain = replace(
        given,
        act_plus=_fold(given, given.act_plus),
        meas_plus=_fold(given, given.meas_plus),
        ground_dampers=tuple(_fold(given, i) for i in given.ground_dampers),
    )
    folded = (e.moved(partial(_fold, given)) for e in measured.experiments)
    return MeasuredChain(chain, tuple(folded))


def _fold(chain: Chain, mass: int) -> int:
    """Where a mass is after the reflection of the free row."""
    return chain.gap + 1 + chain.n_masses - mass if mass > chain.gap else mass
