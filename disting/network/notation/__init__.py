"""Networks as people write them, each notation recognised by its signs or named."""

import re
from fractions import Fraction

from disting.errors import InputError, enumeration, of_type, short
from disting.model.chain import Quantity, as_quantity
from disting.network.network import Network
from disting.network.notation.circuit import (
    AUTOEIS,
    BOUKAMP,
    FITTER,
    IMPEDANCE,
    LINE,
    VALUES,
    braces,
    circuit,
    dialects_of,
    netlist,
)
from disting.network.notation.compartments import CALL, compartments
from disting.network.notation.machine import DRAWN, machine
from disting.network.notation.member import is_member, text_of_member
from disting.network.notation.values import values_of_braces

DIALECTS = {d.name: d for d in (IMPEDANCE, AUTOEIS, BOUKAMP, FITTER)}
NOTATIONS = (*DIALECTS, "spice", "machine", "compartments")
LONGEST = 5_000  # characters


def notations_of(text: str) -> list[str]:
    """The notations in which a text may be written, by its signs alone; "member" for the number of
    a network in a family, such as trees-4:17; none for what is no network, such as the name 3:1 of
    a chain.

    >>> notations_of("R0-[R1,C1]"), notations_of("1>2; in 1; out 2"), notations_of("3:1+b2")
    (['autoeis'], ['compartments'], [])
    """
    text = VALUES.sub("", text) if len(text) <= LONGEST else text
    if len(text) > LONGEST or re.fullmatch(r"\s*(A|\d+:)\d+(\+\w+)*\s*", text):
        return []
    if is_member(text):
        return ["member"]
    if any(LINE.fullmatch(part.strip()) for part in re.split(r"[;\n]", text)):
        return ["spice"]
    if ">" in text or CALL.fullmatch(text):
        return ["compartments"]
    if re.search(r"[=~#]|;\s*[FS]\d", text) or DRAWN.search(text):
        return ["machine"]
    if re.match(r"(?:\s|\[|(?:p|parallel)?\()*[A-Z]", text) and not re.search(r"[.:/\\]", text):
        return [d.name for d in dialects_of(text)]
    return []


def network_of(
    text: str,
    notation: str = "",
    *,
    name: str = "",
    quantity: Quantity | str = Quantity.ACCELERATION,
) -> Network:
    """The network that a text describes, in the `notation` that is named or that its signs show:
    "impedance", "autoeis", "boukamp", "impedancefitter", "spice", "machine", "compartments"; or
    that of a number in a family, such as trees-4:17. `quantity`: what the sensors of a machine show
    unless the text states it. `name`: the text, unless another one is given. Raises InputError with
    the place and what to write instead.

    >>> network_of("R(RC)").parameters, network_of("1=2, 2=3, 2=4; F1; S4").shape
    (('C1', 'R1', 'R2'), (1, 1))
    """
    of_type(text, str, "a network is described by a text such as R0-p(R1,C1)")
    if notation and notation not in NOTATIONS:
        raise InputError(f"notations are {enumeration(NOTATIONS)}, not {short(notation)}")
    if len(text) > LONGEST:
        raise InputError(f"a network is written in {LONGEST} characters at most; use a file")
    if is_member(text):
        text, notation = text_of_member(text), ""
    texts = [notation] if notation else notations_of(text)
    if not texts:
        raise InputError(
            f"{short(text)} is not a network: write a circuit as R0-p(R1,C1), a machine as 1=2=3;"
            " F1;"
            " S3, or compartments as 1>2, 2>0; in 1; out 2"
        )
    lines = filter(None, map(str.strip, text.split("\n")))
    called = name or ("; " if texts == ["spice"] else " ").join(lines)
    read = {what: _read(text, what, called, as_quantity(quantity)) for what in texts}
    good = {what: made for what, made in read.items() if isinstance(made, Network)}
    if len(set(good.values())) > 1:
        raise InputError(
            f"{short(text)} means one circuit in {' and another one in '.join(good)} notation;"
            f" choose with --notation {next(iter(good))}, or notation= in Python"
        )
    if not good:
        raise next(made for made in read.values() if isinstance(made, InputError))
    return next(iter(good.values()))


def _read(text: str, notation: str, name: str, quantity: Quantity) -> Network | InputError:
    try:
        if notation in DIALECTS:
            return circuit(text, DIALECTS[notation], name)
        if notation == "spice":
            return netlist(text, name)
        if notation == "machine":
            return machine(text, name, quantity)
        return compartments(text, name)
    except InputError as problem:
        return InputError(f"{short(text)}: {problem}")


def values_in(text: str, notation: str = "") -> dict[str, Fraction]:
    """Return the values that a circuit states in braces behind its elements, exactly, by the names
    of the parameters of `network_of(text, notation)`, in ohm, H, F, ohm/sqrt(s) and s^n/ohm.

    Braces are those of pyimpspec: `R{R=20}`, `C{C=25e-6}`, `L{L=1e-3}`, `Q{Y=2e-5,n=0.9}`, and
    `W{Y=0.1}` for Z = 1/(Y sqrt(s)), so W1 = 10. A mark f (fixed), limits and a label, as in
    `R{R=20f}` or `R{R=20/0/100:ct}`, change no value. Other notations have no values, nor have
    elements without braces. Raises InputError for braces of another form.

    >>> values_in("R{R=20}(Q{Y=25e-6,n=0.9}[R{R=100/50/200:ct}W{Y=0.1}])")["R2"]
    Fraction(100, 1)
    >>> {name: float(value) for name, value in values_in("Q{Y=25e-6,n=0.9}W{Y=0.1}").items()}
    {'P1': 2.5e-05, 'n1': 0.9, 'W1': 10.0}
    """
    network = network_of(text, notation)
    if is_member(text):
        return {}
    for each in [notation] if notation else notations_of(text):
        if each in DIALECTS and isinstance(
            _read(text, each, network.name, Quantity.ACCELERATION), Network
        ):
            letters = {e.value: e for e in network.elements}
            inside = braces(text, DIALECTS[each])
            return values_of_braces({letters[name]: value for name, value in inside.items()})
    return {}
