"""Chains as users write them: 3:1+b2 is model 1 of 3 masses, with a damper from mass 2 to the
ground; +lag stands for a first-order lag, +delay for a dead time.
"""

import re
from dataclasses import replace

from disting.errors import InputError, shown
from disting.model.chain import Chain
from disting.model.family import MOST_MASSES, Family

EXTRAS = r"(?:\+(?:b\d{1,2}|lag|delay))*"  # behind a model's number


def chain_of(model: Chain | str, family: Family) -> Chain:
    """A chain as it is; text such as 3:11 is model 11 of the 3-mass family, with damping and
    sensor of the given family.

    Raises InputError.

    >>> chain_of("3:1+b1+b3+lag", Family(3)).parameters
    ('m1', 'm2', 'm3', 'k12', 'k23', 'b1', 'b3', 'T1')
    """
    if isinstance(model, Chain):
        return model
    match = re.fullmatch(rf"(\d{{1,2}}):(\d{{1,6}})({EXTRAS})", str(model).strip())
    if not match:
        raise InputError(
            "a model is a Chain or written masses:number, for instance 3:4 or 3:4+b1+lag, not"
            f" {shown(model)}"
        )
    return extended(sized(family, match[1])[int(match[2])], match[3])


def sized(family: Family, masses: str) -> Family:
    """The family with as many masses as the text says; raises InputError."""
    if int(masses) > MOST_MASSES:
        raise InputError(f"models of at most {MOST_MASSES} masses are numbered, not of {masses}")
    return replace(family, n_masses=int(masses))


def extended(chain: Chain, extras: str) -> Chain:
    """The chain with +b1, +lag, +delay."""
    words = extras.split("+")[1:]
    dampers = tuple(int(word[1:]) for word in words if word[0] == "b")
    return replace(chain, ground_dampers=dampers, lag="lag" in words, dead_time="delay" in words)
