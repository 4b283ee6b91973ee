"""Values that pyimpspec writes in braces behind the elements of a circuit.

    R{R=20}   C{C=25e-6}   L{L=1e-3}   Q{Y=2e-5,n=0.9}   W{Y=0.1}       Z = 1/(Y sqrt(s))
    R{R=20f}              - f or F: the value is fixed in a fit
    R{R=20/10/50:ct}      - lower and upper limit of a fit, then a label
    C{C=25e-6//1e-3}      - a limit can be missing, be inf, or be a percentage of the value

Limits, f and labels belong to a fit; the value is the same without them.
"""

import re
from collections.abc import Mapping
from fractions import Fraction

from disting.errors import InputError, enumeration, short
from disting.model.names import MOST_DIGITS, is_too_long
from disting.network.network import Element

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
LIMIT = rf"(?:{NUMBER}\s*%?|[-+]?inf)?"
VALUE = re.compile(
    rf"\s*(\w+)\s*=\s*({NUMBER})\s*[fF]?\s*(?:/\s*{LIMIT}\s*){{0,2}}", re.ASCII | re.IGNORECASE
)
EXAMPLES = {
    "R": "R{R=20}",
    "C": "C{C=25e-6}",
    "L": "L{L=1e-3}",
    "P": "Q{Y=2e-5,n=0.9}",
    "W": "W{Y=0.1}",
}


def values_of_braces(inside: Mapping[Element, str]) -> dict[str, Fraction]:
    """Return the values by parameter, from the text in the braces of each element; raises
    InputError.
    """
    return {
        name: value for element, text in inside.items() for name, value in _values(element, text)
    }


def _values(element: Element, text: str) -> list[tuple[str, Fraction]]:
    """Return the values of one element, each with the name of its parameter."""
    stated, _, _ = text.partition(":")
    parts = stated.split(",") if stated.strip() else []
    names = _names(element)
    found = dict[str, Fraction]()
    for part in parts:
        match = VALUE.fullmatch(part)
        if match is None or match[1] not in names or names[match[1]] in found:
            raise InputError(
                f"{element.value}: cannot read {short(part.strip())} in braces; write"
                f" {EXAMPLES[element.letter]}, with {enumeration(names)} once at most; limits and a"
                " label may follow, as in R{R=20/10/50:ct}"
            )
        found[names[match[1]]] = _value(element, match[1], match[2])
    return [*found.items()]


def _names(element: Element) -> dict[str, str]:
    """Return our names of parameters by pyimpspec's."""
    if element.exponent:
        return {"Y": element.value, "n": element.exponent}
    return {"Y" if element.letter == "W" else element.letter: element.value}


def _value(element: Element, name: str, text: str) -> Fraction:
    """Return the value of a parameter: of a Warburg element 1/Y."""
    if is_too_long(text):
        raise InputError(
            f"{element.value}: {name} = {short(text)}: a value has at most {MOST_DIGITS}"
            f" characters, and at most {MOST_DIGITS} as its power of ten"
        )
    number = Fraction(text)
    if element.letter != "W":
        return number
    if not number:
        raise InputError(f"{element.value}: Y = 0 is an open end, write Y > 0")
    return 1 / number
