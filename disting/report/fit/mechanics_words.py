"""The folded set of structures in words: what all share, and what this data does not decide."""

from collections.abc import Callable, Iterable, Iterator, Sequence

from disting.fit.judge.mechanics import ACTUATOR, Folded, Parts
from disting.report.words import plural, with_and

NOT_DECIDED = "not decided by this data"
FEW = 4  # dampers that are named in one sentence


def structure_in_words(folded: Folded) -> str:
    """Return what all structures share, then what they do not decide.

    >>> structure_in_words(Folded((), (2,), (0, 0, 1, 0, 1), ("b1",), (), (("lag",), ())))
    '2 masses, force and sensor at mass 1, friction at the motor (b1); lag or none: not decided by \
this data'
    """
    parts = [sizes_in_words(folded.sizes)]
    parts += [_ports(folded.ports)] if folded.ports else []
    parts += _dampers(folded, folded.shared, with_and)
    parts += [with_and(adds)] if (adds := _shared_elements(folded.actuators)) else []
    undecided = ", ".join(undecided_in_words(folded))
    return ", ".join(parts) + (f"; {undecided}: {NOT_DECIDED}" if undecided else "")


def headline(folded: Folded) -> str:
    """Return the number of masses, and where the friction is that all structures share.

    >>> headline(Folded((), (3, 4), (0, 0, 1, 0, 1), ("d12", "b1"), ("b2",), ((),)))
    '3 or 4 masses, friction at the motor (b1)'
    """
    friction = [name for name in folded.shared if name[0] == "b"]
    return ", ".join([sizes_in_words(folded.sizes), *_dampers(folded, friction, with_and)])


def undecided_in_words(folded: Folded) -> Iterator[str]:
    """Yield what differs from one structure to another, apart from the number of masses."""
    if folded.ports is None:
        yield "places of force, sensor and dampers"
    if folded.undecided:
        joined = " or " if len(folded.undecided) == 2 else ", "
        yield joined.join(_dampers(folded, folded.undecided, with_or))
    if len(folded.actuators) > 1:
        known = _shared_elements(folded.actuators)
        yield actuators_in_words(
            [tuple(part for part in adds if part not in known) for adds in folded.actuators]
        )


def actuators_in_words(actuators: Sequence[Parts]) -> str:
    """Return what the actuator may add.

    >>> actuators_in_words([("dead time",), ("lag",)])
    'dead time or lag'
    >>> actuators_in_words([("dead time",), ("lag",), ("lag", "dead time"), ()])
    'dead time, lag, both or none'
    >>> actuators_in_words([()])
    'no lag or dead time'
    """
    if not any(actuators):
        return f"no {with_or([*ACTUATOR.values()])}"
    alone = {parts[0] for parts in actuators if len(parts) == 1}
    words = [
        "both" if alone == set(parts) and len(parts) == 2 else with_and(list(parts)) or "none"
        for parts in sorted(actuators, key=lambda parts: (not parts, len(parts)))
    ]
    return with_or(words)


def fold_names(names: Iterable[str]) -> list[str]:
    """Return names of structures, each mechanics once, with its actuators.

    >>> fold_names(["3:1+b1+delay", "2:1", "3:1+b1+lag", "3:1+b1"])
    ['3:1+b1 (alone, +delay, +lag)', '2:1']
    """
    each = dict[str, list[str]]()
    for name in names:
        plain = name.removesuffix("+delay").removesuffix("+lag")
        each.setdefault(plain, []).append(name.removeprefix(plain))
    return [
        f"{plain}{ends[0]}"
        if len(ends) == 1
        else f"{plain} ({', '.join(end or 'alone' for end in sorted(ends))})"
        for plain, ends in each.items()
    ]


def sizes_in_words(sizes: Sequence[int]) -> str:
    """Return how many masses there are.

    >>> sizes_in_words([1]), sizes_in_words([2, 4]), sizes_in_words([2, 3, 4])
    ('1 mass', '2 or 4 masses', '2 to 4 masses')
    """
    *_, most = sizes
    if len(sizes) == 1:
        return plural(most, "mass", "masses")
    if len(sizes) > 2 and sizes[0] + len(sizes) - 1 == most:
        return f"{sizes[0]} to {most} masses"
    return f"{with_or([str(size) for size in sizes])} masses"


def with_or(words: Sequence[str]) -> str:
    """Return words as a choice.

    >>> with_or(["lag", "dead time", "none"])
    'lag, dead time or none'
    """
    return " or ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def _shared_elements(actuators: Sequence[Parts]) -> list[str]:
    """Elements that every actuator adds."""
    return [part for part in ACTUATOR.values() if all(part in adds for adds in actuators)]


def _ports(ports: Sequence[int]) -> str:
    """Places of force and sensor."""
    _, *ends = ports
    force, sensor = (
        f"mass {plus}" if not minus else f"masses {minus} and {plus}"
        for minus, plus in (ends[:2], ends[2:])
    )
    if force == sensor:
        return f"force and sensor {'between' if ends[0] else 'at'} {force}"
    at = ["between" if minus else "at" for minus in (ends[0], ends[2])]
    return f"force {at[0]} {force}, sensor {at[1]} {sensor}"


def _dampers(folded: Folded, names: Sequence[str], joined: Callable[[list[str]], str]) -> list[str]:
    """Dampers between masses by their names, friction by its place."""
    between = [name for name in names if name[0] == "d"]
    ground = [name for name in names if name[0] == "b"]
    words = [f"damper{'s' * (len(between) > 1)} {joined(between)}"] * bool(between)
    if len(ground) > FEW:
        return [*words, f"friction at {len(ground)} masses"]
    places = [f"{_place(folded, name)} ({name})" for name in ground]
    return [*words, *[f"friction at {joined(places)}"] * bool(places)]


def _place(folded: Folded, name: str) -> str:
    """The mass of a damper to the ground: the motor is that on which the force acts."""
    at, (_, minus, plus, *_) = int(name[1:]), folded.ports or (0, 0, 0)
    if minus == 0 and folded.sizes != (1,):
        if at == plus:
            return "the motor"
        if folded.sizes == (2,):
            return "the load"
    return f"mass {at}"
