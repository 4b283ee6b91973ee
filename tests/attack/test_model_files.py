"""Files of models, torn and forged: models, or one sentence."""

import json

import pytest

from disting import InputError, read_models
from tests.attack.counts import chance, times

pytestmark = pytest.mark.attack
WHOLE = {
    "title": "T",
    "s": "s",
    "models": [
        {"name": "a", "A": [["-a", 0], ["b", "-c"]], "B": [1, 0], "C": [0, 1], "D": 0},
        {"name": "b", "num": ["k"], "den": ["T", 1]},
        {"name": "c", "G": "(s + a)/(s**2 + b*s + c)"},
        {"name": "d", "chain": "2:1+b2", "damped": True, "quantity": "velocity"},
    ],
}
FORGED = (
    None, True, 0, -1, 1e308, 10**40, "", " ", "s", "a/0", "a**999999", "__import__('os')", "9" * 4000, "\0", "\u202e", "\ud800",
    [], {}, [[]], [None], [["a"]] * 3, {"a": 1}, "a" * 10_000, "40:1", "3:1+delay", "(" * 500, ["s"], "<b>", "+".join("a" * 500),
)  # fmt: skip


def forged(draw, of):
    """The same with one part replaced, removed or doubled."""
    if draw.random() < 0.25 or not isinstance(of, (dict, list)) or not of:
        return draw.choice(FORGED)
    if isinstance(of, dict):
        key = draw.choice(list(of))
        if draw.random() < 0.2:
            return {k: v for k, v in of.items() if k != key}
        name = draw.choice([key, key, key, "A", "G", "num", "names", ""])
        return of | {name: forged(draw, of[key])}
    at = draw.randrange(len(of))
    return [*of[:at], forged(draw, of[at]), *of[at + draw.randrange(2) :]]


def test_forged_and_torn_files(tmp_path, counts):
    draw, path = chance("model files"), tmp_path / "a.json"
    for turn in range(times(3000)):
        text = json.dumps(forged(draw, WHOLE)).encode("utf-8", "surrogatepass")
        if turn % 3 == 0:
            at = draw.randrange(len(text) + 1)
            text = text[:at] + bytes([draw.randrange(256)]) * draw.randrange(3) + text[at + 1 :]
        path.write_bytes(text)
        try:
            found = read_models(path)
        except InputError as reason:
            said = str(reason)
            assert said.isprintable() and said.startswith(str(path)) and len(said) < 2000
            counts["refused"] += 1
        else:
            assert len({m.name for m in found}) == len(found) > 0
            assert all(m.parameters and m.name.isprintable() for m in found)
            counts["read"] += 1
