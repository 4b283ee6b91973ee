"""One name for a model, read and written here: 3:1+b2+lag+delay is model 1 of 3 masses, with a
damper from mass 2 to the ground, a first-order lag and a dead time.

Where the number of masses is known, A1+b2 does. Damping of the springs and the sensor quantity are
no part of a name; they are given once for all models that are named together.

Exact numbers that users write: how long they may be. A power of ten is a short text and a
number without end.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from disting.errors import ConstraintViolation, InputError, short
from disting.model.chain import Chain, Damper, Sensor, as_sensor
from disting.model.family import MOST_MASSES, Family

MOST_DIGITS = 99  # of a value's decimal exponent, and of its text
EXTRAS = r"(?:\+(?:b\d{1,2}|lag|delay))*"  # behind a model's number
NAME = re.compile(rf"(?:(\d{{1,3}}):[Aa]?|[Aa])(\d{{1,7}})({EXTRAS})")
# the name of a chain without a number
INDICES = re.compile(
    r"\((\d{1,4}) masses, gap (\d{1,4}), force (\d{1,4})-(\d{1,4}), sensor (\d{1,4})-(\d{1,4})"
    rf"[a-z, ]*\)({EXTRAS})"
)
WORDS = ("lag", "delay")
ACROSS = r"\+d\d{1,2}_?\d{1,2}"  # a damper across the gap, which only files and fits name
# what a name means where nothing else is said: springs of machines are damped, and so are the
# structures that a fit names
DAMPED = True
LONGEST = 60  # characters of a text that is looked at for what it may mean


def is_too_long(text: str) -> bool:
    """Return True if the text, or its power of ten, is too large for exact computation.

    >>> is_too_long("1e-99"), is_too_long("1e999999999"), is_too_long("1" * 100)
    (False, True, True)
    """
    exponent = re.search(r"[\d_]\.?[eE]([+-]?[\d_]+)\s*$", text)
    return len(text) > MOST_DIGITS or bool(
        exponent and (len(exponent[1]) > 4 or abs(int(exponent[1])) > MOST_DIGITS)
    )


@dataclass(frozen=True, slots=True)
class Name:
    """Parts of a name: `masses`, 0 where the number is to be inferred; `extras` such as +b2+lag."""

    masses: int
    number: int
    extras: str

    def __str__(self) -> str:
        masses = f"{self.masses}:" if self.masses else "A"
        return f"{masses}{self.number}{self.extras}"

    @property
    def is_plain(self) -> bool:
        """True if it is a model of the numbered list itself."""
        return not self.extras

    def chain(self, family: Family) -> Chain:
        """The model, with the family's damping and sensor, and its size if none is given."""
        return extend(with_masses(family, self.masses or family.n_masses)[self.number], self.extras)


def read(text: str) -> Name:
    """Parse a name; raises InputError with a suggestion.

    >>> read("3:1+b2+lag"), read("A4").masses
    (Name(masses=3, number=1, extras='+b2+lag'), 0)
    """
    match = NAME.fullmatch(_strip_blanks(text))
    if match is None:
        meant = _suggest_name(text)
        raise InputError(
            "a model is written masses:number, for instance 3:4 or 3:4+b1+lag, or A4 where the"
            f" number of masses is known, not {short(text)}"
            + (f"; did you mean {meant}?" if meant else "")
        )
    if match[1] and not int(match[1]):
        raise InputError(f"{short(text)}: a chain has one mass or more, for instance 3:{match[2]}")
    return Name(int(match[1] or 0), int(match[2]), match[3])


def chain_of(model: Chain | str, family: Family, *, masses: int = 0) -> Chain:
    """A chain as it is; text such as 3:11 is model 11 of the 3-mass family, with damping and
    sensor of the given family.

    A11 is model 11 of `masses` masses; 0: it is not known of how many. Raises InputError.

    >>> chain_of("3:1+b1+b3+lag", Family(3, damped=False)).parameters
    ('m1', 'm2', 'm3', 'k12', 'k23', 'b1', 'b3', 'T1')
    """
    if isinstance(model, Chain):
        return model
    name = read(str(model))
    if not (name.masses or masses):
        raise InputError(
            f"A{name.number}: the number of masses is not known here; write it before the number,"
            f" for instance 3:{name.number}{name.extras}"
        )
    return name.chain(replace(family, n_masses=masses or 1))


def read_together(
    models: Sequence[Chain | str], *, damped: bool | None = None, sensor: Sensor | str | None = None
) -> list[Chain]:
    """Models that are named together: missing parts of one are taken from the others.

    A4 has as many masses as those that state it. `damped` and `sensor` are of those given as text;
    where they are not given (None), they are those of the first `Chain`, or damped chains whose
    acceleration is measured. Raises InputError.

    >>> [name_of(chain) for chain in read_together(["3:1", "A4+b2"])]
    ['3:1', '3:4+b2']
    >>> read_together([Family(3, damped=False)[1], "A4"])[1].damped
    False
    """
    pattern = next((m for m in models if isinstance(m, Chain)), Chain(1, damped=DAMPED))
    family = Family(
        1,
        pattern.damped if damped is None else damped,
        pattern.sensor if sensor is None else as_sensor(sensor),
    )
    sizes = {m.n_masses if isinstance(m, Chain) else read(str(m)).masses for m in models} - {0}
    if len(sizes) == 1:
        return [chain_of(m, family, masses=min(sizes)) for m in models]
    return [chain_of(m, family) for m in models]


def name_of(chain: Chain) -> str:
    """The name of a chain, wholly; its indices instead of a number for chains without one: those
    of another numbering (38), and of more masses than names have.

    >>> name_of(Chain(3, 0, 0, 2, 0, 2, ground_dampers=(1,), damped=False))
    '3:4+b1'
    >>> name_of(Chain(40))
    '40:1'
    """
    plain = Chain(*chain.indices, sensor=chain.sensor, damped=chain.damped)
    family = Family(chain.n_masses, chain.damped, chain.sensor)
    numbered = chain.n_masses <= MOST_MASSES and plain in family
    name = f"{chain.n_masses}:{family.number(plain)}" if numbered else f"({plain})"
    return name + extras_of(chain)


def is_whole_name(text: str) -> bool:
    """Return True for the name of a chain that states its number of masses, or its indices.

    >>> [is_whole_name(text) for text in ("3:9", "A9", "drive")]
    [True, False, False]
    """
    match = NAME.fullmatch(_strip_blanks(text))
    if re.search(ACROSS, text):
        return is_whole_name(re.sub(ACROSS, "", text, count=1))
    return (match is not None and bool(match[1])) or INDICES.fullmatch(text) is not None


def chain_of_whole_name(text: str, damped: bool, sensor: Sensor) -> Chain | None:
    """The chain of such a name, with this damping and sensor; None where there is none.

    >>> chain_of_whole_name("2:1+lag", False, Sensor.VELOCITY).parameters
    ('m1', 'm2', 'k12', 'T1')
    >>> chain_of_whole_name("3:999", False, Sensor.VELOCITY) is None
    True
    """
    across = re.search(ACROSS, text)
    if across:
        plain_chain = chain_of_whole_name(text.replace(across[0], "", 1), damped, sensor)
        if plain_chain is None or not plain_chain.gap:
            return None
        chain = replace(plain_chain, gap_damper=True)
        return chain if name_of(chain) == text else None
    indices = INDICES.fullmatch(text)
    try:
        if indices is None:
            return read(text).chain(Family(1, damped, sensor))
        n, gap, plus, minus, shown_plus, shown_minus = map(int, indices.groups()[:6])
        plain = Chain(n, gap, minus, plus, shown_minus, shown_plus, sensor, damped)
        chain = extend(plain, indices[7])
    except (ConstraintViolation, InputError):
        return None
    return chain if name_of(chain) == text else None


def extras_of(chain: Chain) -> str:
    """Part of the name after the number: +b1+lag."""
    words = [Damper(chain.gap).parameter] if chain.gap_damper else []
    words += [*(f"b{i}" for i in chain.ground_dampers), *(["lag"] if chain.lag else [])]
    return "".join(f"+{word}" for word in [*words, *(["delay"] if chain.dead_time else [])])


def damping_option(damped: bool) -> str:
    """Option of the command line for it."""
    return "--damped" if damped else "--undamped"


def with_masses(family: Family, masses: int) -> Family:
    """The family with as many masses; raises InputError where they are too many to be numbered."""
    if masses > MOST_MASSES:
        raise InputError(f"models of at most {MOST_MASSES} masses are numbered, not of {masses}")
    return replace(family, n_masses=masses)


def extend(chain: Chain, extras: str) -> Chain:
    """The chain with +b1, +lag, +delay."""
    words = extras.split("+")[1:]
    dampers = tuple(int(word[1:]) for word in words if word[0] == "b")
    return replace(chain, ground_dampers=dampers, lag="lag" in words, dead_time="delay" in words)


def _strip_blanks(text: str) -> str:
    """Without blanks at the ends and around + and the colon."""
    return re.sub(r"\s*([:+])\s*", r"\1", text.strip())


def _suggest_name(text: str) -> str:
    """The name that a text may have been meant for; "" if none is near."""
    if len(text) > LONGEST:
        return ""
    head, *words = _strip_blanks(text.replace("_", " ")).lower().split("+")
    head = re.sub(r"^a?(\d{1,2})\s*[.;,/\- ]\s*a?(\d{1,6})$", r"\1:\2", head)
    near = [_word(word.replace(" ", "")) for word in words]
    mended = "+".join([head, *near])
    return mended if NAME.fullmatch(mended) and mended != text else ""


def _word(word: str) -> str:
    """The extra that a word is near to."""
    from difflib import get_close_matches  # where something is wrong, and nowhere else

    damper = re.fullmatch(r"[bd]?0*([1-9]\d?)", word)
    near = get_close_matches(word, (*WORDS, "deadtime", "dead-time"), 1, 0.6)
    nearest = f"b{damper[1]}" if damper else near[0] if near else word
    return "delay" if nearest.startswith("dead") else nearest


def names_of(left: Chain, right: Chain) -> tuple[str, str]:
    """Names of two chains in one context: their plain names or, if these are equal but the damping
    differs, with damping and quantity.

    >>> names_of(Chain(9), Chain(9, damped=False))
    ('9:1 (damped, acceleration)', '9:1 (undamped, acceleration)')
    """
    names = name_of(left), name_of(right)
    if names[0] == names[1] and left != right:
        return f"{names[0]} ({left.premise})", f"{names[1]} ({right.premise})"
    return names
