"""Exact numbers that users write: how long they may be. A power of ten is a short text and a
number without end.
"""

import re

MOST_DIGITS = 99  # of a value's decimal exponent, and of its text


def is_too_long(text: str) -> bool:
    """Whether the text, or the power of ten that it is written with, is too large to be computed
    with exactly.

    >>> is_too_long("1e-99"), is_too_long("1e999999999"), is_too_long("1" * 100)
    (False, True, True)
    """
    exponent = re.search(r"[\d_]\.?[eE]([+-]?[\d_]+)\s*$", text)
    return len(text) > MOST_DIGITS or bool(
        exponent and (len(exponent[1]) > 4 or abs(int(exponent[1])) > MOST_DIGITS)
    )
