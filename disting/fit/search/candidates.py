"""Candidate models of a fit: Fig. 1 of the paper, and wider classes."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, product

from disting.errors import ConstraintViolation, InputError
from disting.fit.search.setup import port
from disting.model.chain import Chain, Quantity, as_quantity
from disting.model.family import Family
from disting.model.names import name_of
from disting.model.symmetry import Form, forms
from disting.renamed import renamed


@renamed(sensor="quantity")
def figure_1(
    sizes: Sequence[int] = (1, 2, 3, 4), quantity: Quantity = Quantity.ACCELERATION
) -> tuple[Chain, ...]:
    """Chains driven and measured at mass 1, every set of ground dampers, with and without lag and
    dead time. Raises InputError for a size below 1.

    >>> len(figure_1())
    120
    """
    return tuple(
        variant for n in sizes for variant in variants(Chain(n, quantity=quantity, damped=True))
    )


def variants(chain: Chain) -> Iterator[Chain]:
    """Yield a chain with every set of ground dampers, with and without lag and dead time: 4
    times 2^N models.

    >>> len(list(variants(Chain(2))))
    16
    """
    masses = range(1, chain.n_masses + 1)
    sets = [chosen for size in range(chain.n_masses + 1) for chosen in combinations(masses, size)]
    for chosen, lag, dead_time in product(sets, (False, True), (False, True)):
        yield replace(chain, ground_dampers=chosen, lag=lag, dead_time=dead_time)


@renamed(sensor="quantity")
def whole_family(
    sizes: Sequence[int], quantity: Quantity = Quantity.ACCELERATION
) -> tuple[Chain, ...]:
    """Every chain under (36)-(38) of these sizes, with its variants. Raises InputError for a size
    below 1.

    >>> len(whole_family([2]))  # three models, each with 16 variants
    48
    """
    return tuple(
        v
        for n in sizes
        for chain in Family(n, damped=True, quantity=quantity)
        for v in variants(chain)
    )


@renamed(sensor="quantity")
def chosen_ports(
    sizes: Sequence[int],
    actuator: str,
    shown: str,
    gap: int = 0,
    quantity: Quantity = Quantity.ACCELERATION,
) -> tuple[Chain, ...]:
    """Chains of several sizes with force and sensor at the same ports, with their variants.

    A port is the number of a mass, the word last, or minus:plus such as 1:3; sizes in which it does
    not exist are omitted, and those in which the last mass is that of the other port: with one
    mass, force 1 and sensor last are not the two ends that were requested. Raises InputError where
    none is left.

    >>> [str(c) for c in chosen_ports([2], "1", "last")][:1]
    ['2 masses, gap 0, force 1-0, sensor 2-0, damped']
    """
    chains, refused = list[Chain](), ""
    for n in sizes:
        (act_minus, act_plus), (meas_minus, meas_plus) = ports = tuple(
            port(text, n) for text in (actuator, shown)
        )
        if (actuator == "last") != (shown == "last") and ports[0] == ports[1]:
            refused = f"force {actuator} and sensor {shown} are the same mass"
            continue
        try:
            chains.append(
                Chain(n, gap, act_minus, act_plus, meas_minus, meas_plus, quantity, damped=True)
            )
        except ConstraintViolation as reason:
            refused = str(reason)
    if not chains:
        raise InputError(
            f"no chain of {', '.join(map(str, sizes))} masses has these ports: {refused}"
        )
    return tuple(variant for chain in chains for variant in variants(chain))


def candidates(
    masses: Sequence[int] = (1, 2, 3, 4),
    *,
    actuator: str = "1",
    sensor: str = "1",
    gap: int = 0,
    family: bool = False,
    base: bool = False,
    damped: bool = True,
    quantity: Quantity | str = Quantity.ACCELERATION,
) -> tuple[Chain, ...]:
    """Chains to fit, each with every set of ground dampers, with and without lag and dead time.

    `masses`: their numbers; `actuator` and `sensor`: masses where the force acts and the sensor
    is, as `chosen_ports` reads them; `gap`: no spring right of that mass; `family`: force, sensor
    and gap anywhere instead; `base`: also each chain on an elastic base (`on_elastic_bases`);
    `damped`: with a damper beside every spring; `quantity`: what the sensor shows. Raises
    InputError where none is left.

    >>> len(candidates()), len(candidates([2, 3], base=True)), len(candidates([2], family=True))
    (120, 64, 48)
    """
    shown = as_quantity(quantity)
    if family:
        chains = whole_family(masses, shown)
    else:
        chains = chosen_ports(masses, actuator, sensor, gap, shown)
        chains += on_elastic_bases(chains) if base else ()
    return tuple(replace(chain, damped=damped) for chain in chains)


def on_elastic_bases(chains: Sequence[Chain]) -> tuple[Chain, ...]:
    """The chains without ground dampers, and those with one where the force acts, each on an
    elastic base that is mass 1 of the new chain; force and sensor act between the base and the
    masses at which they were. The damper is then the friction of the motor's bearings, which sit in
    the base. Dampers elsewhere, which no base holds, are left out. Raises InputError for chains
    with a gap and for ports between two masses.

    >>> bases = on_elastic_bases([Chain(2), Chain(2, ground_dampers=(1,))])
    >>> [c.parameters for c in bases]  # doctest: +NORMALIZE_WHITESPACE
    [('m1', 'm2', 'm3', 'k01', 'k23', 'd01', 'd23'),
     ('m1', 'm2', 'm3', 'k01', 'k23', 'd01', 'd12', 'd23')]
    """
    if any(c.gap or c.act_minus or c.meas_minus for c in chains):
        raise InputError(
            "--base is for chains without a gap, their force and sensor at one mass each:"
            " remove --gap, or name single masses"
        )
    return tuple(
        replace(
            c, n_masses=c.n_masses + 1, gap=1, act_minus=1, act_plus=c.act_plus + 1,
            meas_minus=1, meas_plus=c.meas_plus + 1, ground_dampers=(),
            gap_damper=bool(c.ground_dampers),
        )
        for c in chains
        if c.ground_dampers in ((), (1,)) and (c.act_plus == 1 or not c.ground_dampers)
    )  # fmt: skip


def listed_form(chain: Chain) -> Form:
    """The form of a chain that is in the family of its size, with the names that its parameters
    have there.

    A chain with masses counted from the other end, or with force and sensor exchanged, is no model
    under (38): the model that behaves as it does for renamed parameters is. The chain itself where
    no form is in the family.

    >>> form = listed_form(Chain(2, 0, 0, 2, 0, 2, damped=True, ground_dampers=(1,)))
    >>> reference(form.chain), form.renaming["m1"]
    ('2:1+b2', 'm2')
    """
    if chain.gap_damper:  # no other form behaves as it does
        return Form(chain, (), {name: name for name in chain.parameters})
    family = Family(chain.n_masses, chain.damped, chain.quantity)
    both = list(forms(chain))
    return next((form for form in both if _is_in(family, form.chain)), both[0])


def reference(chain: Chain) -> str:
    """Such as 2:1+b2+delay, as the commands read it; of the form that is listed."""
    return name_of(listed_form(chain).chain)


def _is_in(family: Family, chain: Chain) -> bool:
    plain = replace(chain, ground_dampers=(), lag=False, dead_time=False)
    return plain in family
