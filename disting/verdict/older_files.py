"""Verdict files of version 0.3.0: their evidence is that of today, their sentences are in other
words. To check such a sentence, the sentence of today is put into the older words.
"""

import re
from collections.abc import Callable
from typing import Any

OLDER = "disting verdict 1"
"""Format of version 0.3.0. Its explicit maps named the parameters of both models alike."""

_PHRASES = (
    # now, in version 0.3.0
    ("none of the available methods decides them", "nothing settles them"),
    (
        "are driving-point functions of the same order with two kinds of elements (or with parts"
        " like them): by Foster's and Cauer's theorems each realises all such functions with"
        " positive elements",
        "are driving-point functions of two kinds of elements (or of parts like them) and of one"
        " order: by Foster's and Cauer's theorems each gives all of them with positive elements",
    ),
    (
        "become the same model when ports are exchanged or a row is mirrored",
        "are one model after exchanging ports or mirroring a row",
    ),
    (
        "each parameter set of one has an equivalent set of the other, which is positive if the"
        " first is (",
        "each parameter set of one has one of the other with the same response, positive if it is"
        " (",
    ),
    (
        "each can have any alternating resonances and antiresonances",
        "each gives any resonances and antiresonances in turn",
    ),
    ("are the same except for", "are the same but for"),
    ("a gear changes only the units behind it", "a gear is a change of the units behind it"),
    (
        "are undamped machines with the same number of masses: each can have any resonances"
        " (the lowest is 0 if they are free), and any antiresonances that lie each between two"
        " neighbouring resonances",
        "are undamped trees of as many masses with one spring to the ground: each gives any"
        " resonances, and any antiresonances each of which is between two neighbouring ones of"
        " them",
    ),
    (
        "are undamped, and their rows on both sides of the gap can replace each other one by one",
        "are undamped and their rows at both sides of the gap can be exchanged one by one",
    ),
    ("has only positive ones", "has positive ones alone"),
    ("Wherever the zeros of", "However the zeros of"),
    ("can place them there too", "can do the same"),
    ("without separating two conjugates", "without parting two conjugates"),
    ("so no other element can compensate for it", "so it cannot be made up for"),
    ("parameters: that requires ", "parameters: that asks for "),
)
_NOT_SAID = re.compile(r" It is not decided whether all .+? have an equivalent in .+?\.")
"""Sentence on what witnesses leave open, which version 0.3.0 did not state."""


def in_older_words(verdict: dict[str, Any]) -> dict[str, Any]:
    """The plain data of a verdict, its sentences in the words of version 0.3.0, without primes.

    >>> in_older_words({"sentence": "A and B are the same except for k' = m."})
    {'sentence': 'A and B are the same but for k = m.'}
    """
    return _change_sentences(verdict, _to_older_words)


def without_primes(verdict: dict[str, Any]) -> dict[str, Any]:
    """The plain data of a verdict, its sentences without primes and apostrophes."""
    return _change_sentences(verdict, _omit_primes)


def _change_sentences(verdict: dict[str, Any], change: Callable[[str], str]) -> dict[str, Any]:
    """The verdict, and that over complex parameters beside it, with other sentences."""
    beside = verdict.get("over_complex")
    verdict = verdict | {"sentence": change(str(verdict.get("sentence", "")))}
    if beside and isinstance(beside, dict):
        verdict["over_complex"] = _change_sentences(beside, change)
    return verdict


def _to_older_words(sentence: str) -> str:
    for now, older in _PHRASES:
        sentence = sentence.replace(now, older)
    return _omit_primes(_NOT_SAID.sub("", sentence))


def _omit_primes(sentence: str) -> str:
    return sentence.replace("'", "")
