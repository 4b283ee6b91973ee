"""Measured chains with the same behaviour for an obvious reason: because they are one machine, or
because each of their rows has the same.

One machine is numbered from the other end, or force and sensor are exchanged.

* Reciprocity. A(s) is symmetric whatever is locked or added, and so is its inverse: a force at one
  place shows at another one what a force there shows here. So force and sensor may be exchanged, in
  all experiments at once; the sensor's power of s and a lag are factors of their own. The force
  moved to a mass becomes a sensor moved there.
* Reflection. The free row, masses gap + 1 to n, may be numbered from its other end, with all that
  is measured and done there; no spring joins it to the masses before.

Both change names of parameters only, so all transfer functions are unchanged: equal measured chains
in the form below are the same for all parameters. `model.symmetry` knows more forms of one transfer
function: those that exchange force and sensor in one row alone do not carry over a further
experiment.

Two chains with a gap may show the same because each row does. The receptance of a chain with a gap
is R + F, R of the grounded and F of the free row, each between its own ports and with parameters of
its own. What is done at one mass of a row changes this row only: the further experiment shows R' +
F or R + F' (a mass locked or something known added), or a motion of this row alone, which the force
causes in it (a sensor there). So all that is measured is the same algebraic image of two
independent things: the functions of that row, (R, R') say, and F. If the closures of both are equal
on both sides, so are those of the images.

* A row whose ports and mass are the same as on the other side, maybe numbered from its other end,
  shows the same there.
* What is implied by the row's receptance alone has equal closures where the receptances have: a
  sensor at the row's other port shows the receptance; a mass locked at a port or between the ports
  makes it 0; what adds h(s), such as J s^2, at the one mass that is both ports makes it R/(1 + h R)
  (A + h e e' has the inverse A^-1 - h A^-1 e e' A^-1/(1 + h e' A^-1 e)).
* Receptances have equal closures where the rows are the same, or both full with the same constant
  coefficients (`fibres.ideals.full_rows`).

Nothing of this is left to chance.
"""

from dataclasses import dataclass, replace
from functools import lru_cache, partial

from disting.experiments.experiment import Experiment, MeasuredChain
from disting.fibres.ideals.full_rows import same_receptances
from disting.model.chain import Chain
from disting.model.row import Row, rows_of

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
    both = (measured, _exchange_ends(measured))
    return [*both, *map(_reflect_free_row, both)]


def _order(measured: MeasuredChain) -> tuple[object, ...]:
    """Sort key whose minimum is the standard form."""
    chain = measured.chain
    experiments = [
        (e.force or (), e.sensor or (), [(c.kind, c.place, c.size) for c in e.changes])
        for e in measured.experiments
    ]
    forces = sum(e.force is not None for e in measured.experiments)
    return forces, chain.indices, chain.ground_dampers, experiments


def _exchange_ends(measured: MeasuredChain) -> MeasuredChain:
    own = measured.chain
    chain = replace(
        own,
        act_minus=own.meas_minus,
        act_plus=own.meas_plus,
        meas_minus=own.act_minus,
        meas_plus=own.act_plus,
    )
    moved = (replace(e, force=e.sensor, sensor=e.force) for e in measured.experiments)
    return MeasuredChain(chain, tuple(moved))


def _reflect_free_row(measured: MeasuredChain) -> MeasuredChain:
    own = measured.chain
    chain = replace(
        own,
        act_plus=_fold(own, own.act_plus),
        meas_plus=_fold(own, own.meas_plus),
        ground_dampers=tuple(_fold(own, i) for i in own.ground_dampers),
    )
    folded = (e.moved(partial(_fold, own)) for e in measured.experiments)
    return MeasuredChain(chain, tuple(folded))


def _fold(chain: Chain, mass: int) -> int:
    """Where a mass is after the reflection of the free row."""
    return chain.gap + 1 + chain.n_masses - mass if mass > chain.gap else mass


Content = tuple[int, bool, bool, tuple[int, ...]]
"""Number of masses, whether at the wall, whether damped, dampers to the ground."""
Form = tuple[Content, int, int, int]
"""A row, its two ports and a mass."""


@dataclass(frozen=True, slots=True)
class _Done:
    """Change of a row: `kind` with its size, whether it applies to the free row, both rows, whether
    the row's receptance implies the measured function, and if not, the row with ports and mass.
    """

    kind: str
    in_free: bool
    row: Row
    elsewhere: Row
    implied: bool
    form: Form


def same_by_rows(left: MeasuredChain, right: MeasuredChain) -> bool:
    """Return True if two measured chains have equal closures row by row; False where this is
    unknown.
    """
    if _factors(left.chain) != _factors(right.chain):
        return False
    mine, theirs = _change_of(left), _change_of(right)
    if mine is None or theirs is None or (mine.kind, mine.in_free) != (theirs.kind, theirs.in_free):
        return False
    if not same_receptances(mine.elsewhere, theirs.elsewhere):
        return False
    if mine.implied and theirs.implied:
        return same_receptances(mine.row, theirs.row)
    return not (mine.implied or theirs.implied) and mine.form == theirs.form


def _factors(chain: Chain) -> tuple[object, ...]:
    """Factors that both share apart from their rows."""
    return chain.n_masses, chain.gap, chain.sensor, chain.lag, chain.dead_time


def _change_of(measured: MeasuredChain) -> _Done | None:
    """None unless a single change is made at one mass of a chain with a gap."""
    chain = measured.chain
    if not chain.gap or len(measured.experiments) != 2 or measured.experiments[0] != Experiment():
        return None
    further = measured.experiments[1]
    if len(further.masses) != 1:
        return None
    (mass,) = further.masses
    in_free = mass > chain.gap
    rows = rows_of(chain.structure)
    touched, elsewhere = (rows[1], rows[0]) if in_free else (rows[0], rows[1])
    at = mass - touched.before
    first, last = touched.ports
    if further == Experiment(sensor=mass):
        force = (chain.act_plus if in_free else chain.act_minus) - touched.before
        first, last = force, first + last - force
        kind, implied = "sensor", at == last
    elif further == Experiment(changes=further.changes):
        (change,) = further.changes
        kind = f"{change.kind.name} {change.size}"
        implied = first == at == last if change.kind.takes_size else first <= at <= last
    else:
        return None
    return _Done(kind, in_free, touched, elsewhere, implied, _form(touched, first, last, at))


def _form(row: Row, first: int, last: int, at: int) -> Form:
    """The row with its ports and the mass, the free row from the end with the smaller numbers."""
    turned = row.n_masses + 1
    ways = [(_content(row), first, last, at)]
    if not row.grounded:
        ways.append((_content(row.mirrored), turned - first, turned - last, turned - at))
    return min(ways)


def _content(row: Row) -> Content:
    return row.n_masses, row.grounded, row.damped, row.ground_dampers
