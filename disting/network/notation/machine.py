"""Machines as masses and joints: `1=2=3, 2~4, 4-#; F1; S4`.

    1=2     spring with damper between masses 1 and 2        #   the ground, which does not move
    1~2     spring                                           F1  force on mass 1, F1:3 between two
    1-2     damper; 1-# is the damper b1 of a bearing        S4  sensor at 4, S4:1 between two
    1=2*i   through a gear: the joint feels x1 - i x2        position, velocity or acceleration:
    1=2*3/2 through a gear of a known ratio                  what the sensors show (acceleration)

Every number is a mass. Several forces and sensors are written with blanks between: `S1 S4`. Chains
can be given as they are drawn: `#=[1fs]   [2F]=[3S]`.
"""

import re
from collections import Counter
from collections.abc import Iterator

from disting.errors import InputError, enumeration, short
from disting.model.chain import Quantity
from disting.network.network import KINDS, Element, Network, Port

JOINTS = {"=": "kd", "~": "k", "-": "d"}
JOINT = re.compile(r"\s*([=~-])\s*(#|\d+)(?:\*([\w./]+))?", re.ASCII)
NODE = re.compile(r"\s*(#|\d+)", re.ASCII)
PORT = re.compile(r"([FS])(#|\d+)(?::(#|\d+))?", re.ASCII)
DRAWN = re.compile(r"\[(\d+)([FfSs]*)\](,?)", re.ASCII)
HELP = "write joints, then force and sensor, as in 1=2=3, 2~4; F1; S4"


def machine(text: str, name: str, quantity: Quantity = Quantity.ACCELERATION) -> Network:
    """The machine that a text describes; raises InputError.

    >>> print(*machine("1=2, 2~#; F1; S2", "axis").elements, sep=", ")
    m1 1, m2 2, k12 1 2, k02 2 0, d12 1 2
    """
    joints, ports = _joints_of_drawing(text) if DRAWN.search(text) else ([], [])
    quantities = []
    for part in [] if ports else filter(None, (p.strip() for p in text.split(";"))):
        if part in tuple(Quantity):
            quantities.append(Quantity(part))
        elif part[0] in "FS":
            ports += [_port(word) for word in re.split(r"[\s,]+", part)]
        else:
            joints += [joint for run in part.split(",") for joint in _joints(run)]
    if len(quantities) > 1:
        raise InputError(f"sensors show {enumeration(quantities)}: give one quantity")
    order = (*quantities, quantity)[0].order
    nodes = {i for a, b, *_ in joints for i in (a, b)} | {
        i for _, p in ports for i in (p.plus, p.minus)
    }
    _refuse_twice(joints)
    elements = [Element(f"m{i}", "m", (i,)) for i in sorted(nodes - {0})]
    for letter in "kd":
        elements += [_element(letter, joint) for joint in joints if letter in JOINTS[joint[2]]]
    sides = [tuple(p for side, p in ports if side == letter) for letter in "FS"]
    return Network(tuple(elements), sides[0], sides[1], order, name)


def _refuse_twice(joints: list["Joint"]) -> None:
    """Two springs side by side are one; so are two dampers."""
    count = Counter((x, min(a, b), max(a, b)) for a, b, sign, _ in joints for x in JOINTS[sign])
    for letter, a, b in sorted(joint for joint, times in count.items() if times > 1):
        what = "the ground" if a == 0 else f"mass {a}"
        raise InputError(
            f"mass {b} and {what} are joined by two {KINDS[letter].word}s, which act as one:"
            " remove one"
        )


def joint_name(letter: str, a: int, b: int) -> str:
    """The name of a joint, as in chains: k12, k01 at the ground, k9_10, and b1 of a damper that is
    alone at the ground.
    """
    low, high = sorted((a, b))
    return f"{letter}{low}{high}" if high < 10 else f"{letter}{low}_{high}"


Joint = tuple[int, int, str, str]
"""Both nodes, the sign, the ratio."""


def _element(letter: str, joint: Joint) -> Element:
    a, b, sign, ratio = joint
    if sign == "-" and 0 in (a, b):
        return Element(f"b{a or b}", "d", (a or b, 0), ratio)
    nodes = (a, b) if a else (b, a)
    return Element(joint_name(letter, a, b), letter, nodes, ratio)


def _joints(run: str) -> Iterator[Joint]:
    """Yield the joints of a run such as 1=2=3; a mass alone has none but itself."""
    start = NODE.match(run)
    if not start:
        raise InputError(f"{short(run.strip())} does not begin with a mass: {HELP}")
    at, node = start.end(), start[1]
    if not run[at:].strip():
        raise InputError(f"{short(run.strip())} is joined with nothing: {HELP}")
    while run[at:].strip():
        match = JOINT.match(run, at)
        if not match:
            raise InputError(f"{short(run[at:].strip())} after mass {node} is not a joint: {HELP}")
        yield _number(node), _number(match[2]), match[1], match[3] or ""
        at, node = match.end(), match[2]


def _number(node: str) -> int:
    if node != "#" and (not int(node[:9]) or len(node) > 4):
        raise InputError(f"masses are numbered from 1, and # is the ground, not {short(node)}")
    return 0 if node == "#" else int(node)


def _port(word: str) -> tuple[str, Port]:
    match = PORT.fullmatch(word)
    if not match:
        raise InputError(
            f"{short(word)} is not a force or sensor: write F1 or S4, or F1:3 between two"
        )
    return match[1], Port(_number(match[2]), _number(match[3] or "#"))


def _joints_of_drawing(text: str) -> tuple[list[Joint], list[tuple[str, Port]]]:
    """Those of a chain as it is drawn."""
    drawn = list(DRAWN.finditer(text))
    joints, at = list[Joint](), dict[str, int]()
    before, end = 0, 0
    for mark in drawn:
        number, sign = _number(mark[1]), text[end : mark.start()].strip()
        if sign == "#=" or sign == "#~":
            before, sign = 0, sign[1]
        elif sign and (sign not in ("=", "~") or not end):
            raise InputError(f"{short(sign)} is not a joint of a drawing: = ~ or blanks")
        if sign:
            joints.append((number, before, sign, ""))
        if mark[3]:
            joints.append((number, 0, "-", ""))
        at |= dict.fromkeys(mark[2], number)
        before, end = number, mark.end()
    letters = [letter for mark in drawn for letter in mark[2]]
    if text[end:].strip() or not {"F", "S"} <= at.keys() or len(letters) > len(at):
        raise InputError(
            "a drawing has F where the force acts and S where the sensor is, each once, no more"
        )
    if len({mark[1] for mark in drawn}) < len(drawn):
        raise InputError("a drawing has each mass once: number them from left to right")
    ports = [(side, Port(at[side], at.get(side.lower(), 0))) for side in "FS"]
    return joints, ports
