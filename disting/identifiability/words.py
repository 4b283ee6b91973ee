"""The finding in plain English."""

from typing import TYPE_CHECKING

from disting.certainty import Certainty
from disting.identifiability.parts import Combination, Level

if TYPE_CHECKING:
    from disting.identifiability.result import Identifiability

NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")


def sentence(found: "Identifiability") -> str:
    """One sentence: how many parameters are determinable, and what else has the same behaviour."""
    many = len(found.parameters)
    head = f"{many} parameter{'s' * (many > 1)}"
    if found.level is Level.NOT:
        return f"{head}, only {found.rank} determinable: {_listed(found.basis)}."
    return f"{head}, all determinable; {_rest(found)}."


def number(count: int) -> str:
    """A small number as a word.

    >>> number(2), number(13)
    ('two', '13')
    """
    return NUMBERS[count] if count < len(NUMBERS) else str(count)


def _listed(basis: tuple[Combination, ...]) -> str:
    """Formulas, then the coefficients that are only named."""
    formulas = [c.text for c in basis if not c.is_named]
    named = sorted(c.name for c in basis if c.is_named)
    what = "transfer-function coefficient" + "s" * (len(named) > 1)
    return ", ".join([*formulas, f"{what} {', '.join(named)}"] if named else formulas)


def _rest(found: "Identifiability") -> str:
    if found.level is Level.GLOBAL:
        return "no other non-zero parameters, real or complex, give the same behaviour"
    if found.level is Level.UNKNOWN:
        return f"finitely many parameter vectors give the same behaviour, how many is not known ({found.reason})"
    return f"{_count(found)} give the same behaviour{_known(found)}{_point(found)}"


def _count(found: "Identifiability") -> str:
    """How many vectors, complex ones included unless all are positive."""
    if found.most is None:
        return f"at least {number(found.least)} positive parameter vectors"
    if found.most > found.least:
        return f"{number(found.most)} parameter vectors (not all proven to exist)"
    kind = "positive" if all(a.certainty is Certainty.THEOREM for a in found.alternatives) else "complex"
    return f"{number(found.most)} {kind} parameter vectors"


def _known(found: "Identifiability") -> str:
    exchanges = [f"exchanging {r.text} changes nothing" for r in found.renamings]
    dual = ["each is the dual (mirror image at the gap) of another"] * found.self_dual
    return f": {' and '.join([*exchanges, *dual])}" if exchanges or dual else ""


def _point(found: "Identifiability") -> str:
    """Real and positive ones, which depend on the point, unless theorems name all."""
    if found.most is None or all(a.certainty is Certainty.THEOREM for a in found.alternatives):
        return ""
    return f"; with random values {number(found.real)} of them real, {number(found.positive)} positive"
