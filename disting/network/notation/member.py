"""Networks by their number in a family, such as trees-4:17."""

import re

FAMILY = re.compile(r"([a-z]+)-(\d{1,3})(-damped)?")
MEMBER = re.compile(rf"\s*({FAMILY.pattern}):(\d{{1,9}})\s*")


def is_member(text: str) -> bool:
    """Return True for FAMILY:NUMBER.

    >>> is_member("trees-4:17"), is_member("3:1")
    (True, False)
    """
    return MEMBER.fullmatch(text) is not None


def text_of_member(text: str) -> str:
    """The text of the network that FAMILY:NUMBER names; another text as it is. Raises InputError
    for a family or a number that does not exist.

    >>> text_of_member("circuits-4:2"), text_of_member("R1-C1")
    ('L1', 'R1-C1')
    """
    match = MEMBER.fullmatch(text)
    if match is None:
        return text
    from disting.network.families import member  # families are read from texts themselves

    return member(match[1], int(match[5]))
