"""Families of networks: all machines, circuits or graphs of compartments of a kind, each once, by
the text that a person would write for it.

A module here is a kind: its KIND defines it for commands, catalogues, pages and help. With -damped
after the name, machines have a damper in parallel with every spring. Machines are counted up to
their numbering and the exchange of force and sensor (reciprocity), circuits up to the order of what
commutes, compartments up to their numbering.
"""

from functools import cache
from importlib import import_module
from pkgutil import iter_modules

from disting.errors import InputError, enumeration, short
from disting.network.families.family import (
    DAMPED as DAMPED,
    Kind as Kind,
    NetworkFamily as NetworkFamily,
)
from disting.network.notation.member import FAMILY

_MODULES = (import_module(f"{__name__}.{module.name}") for module in iter_modules(__path__))
KINDS: dict[str, Kind] = {
    kind.name: kind
    for kind in sorted((m.KIND for m in _MODULES if hasattr(m, "KIND")), key=lambda k: k.place)
}
FAMILIES = {family.name: family for kind in KINDS.values() for family in kind.families()}


@cache
def family_of(name: str) -> NetworkFamily:
    """The family of that name, a listed one or one of another number; raises InputError.

    >>> family_of("trees-5").title
    'Machines of 5 masses, joined as a tree, undamped'
    """
    match = FAMILY.fullmatch(name)
    kind = KINDS.get(match[1]) if match else None
    if name in FAMILIES:
        return FAMILIES[name]
    if match and kind and kind.has(int(match[2]), match[3] or ""):
        return kind.family(int(match[2]), match[3] or "")
    raise InputError(f"families of networks are {enumeration(FAMILIES)}, not {short(name)}")


def family_with(masses: int, *, damped: bool, loops: bool) -> str:
    """Name of the listed family that has each machine of so many masses, with loops or without;
    "" where there is none.

    >>> family_with(4, damped=True, loops=False), family_with(4, damped=True, loops=True)
    ('trees-4-damped', '')
    """
    wide = (k for k in KINDS.values() if k.with_loops is True or k.with_loops is loops)
    names = (f"{kind.name}-{masses}{DAMPED if damped else ''}" for kind in wide)
    return next((name for name in names if name in FAMILIES), "")


def member(name: str, number: int) -> str:
    """The text of a network by its number in the family, from 1 on; raises InputError.

    >>> member("circuits-4", 2)
    'L1'
    """
    networks = family_of(name).networks
    if not 1 <= number <= len(networks):
        raise InputError(f"{name} has the networks 1 to {len(networks)}, not {number}")
    return networks[number - 1].name
