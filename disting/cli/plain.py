"""Text for terminals and files that cannot hold every character, such as the code pages of
Windows, or ASCII.

What has no place there is written with signs that have: formulas stay readable, and no output ends
in an error.
"""

import codecs
import sys
from collections.abc import Iterable
from unicodedata import normalize

from disting.errors import brief

HANDLER = "disting.plain"
PLAIN = {
    "≠": "!=", "≤": "<=", "≥": ">=", "≈": "~", "→": "->", "←": "<-", "↔": "<->", "·": "*", "×": "x",
    "−": "-", "–": "-", "—": "-", "±": "+-", "∞": "inf", "√": "sqrt", "∂": "d", "∃": "exists ",
    "∩": " and ", "∅": "{}", "⊂": "<", "⊆": "<=", "…": "...", "Φ": "Phi", "ω": "omega", "ρ": "rho",
    "γ": "gamma", "δ": "delta", "κ": "kappa", "σ": "sigma", "Δ": "Delta",
    "²": "^2", "³": "^3", "⁻": "^-", "¹": "1", "’": "'", "“": '"', "”": '"',
}  # fmt: skip


def say_what_can_be_said() -> None:
    """Make standard output and error write the characters that they lack as `in_ascii` does."""
    codecs.register_error(HANDLER, _replaced)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):  # else somebody's own stream, or none
            stream.reconfigure(errors=HANDLER)


def keep_apart(names: Iterable[str]) -> None:
    """Write what the streams lack so that no two of these names, of models or files, become one:
    as escapes where they would.
    """
    known = set(names)
    for stream in (sys.stdout, sys.stderr):
        ways = (HANDLER, "backslashreplace", "namereplace")
        if hasattr(stream, "reconfigure"):
            encoding = stream.encoding
            apart = (w for w in ways if len({n.encode(encoding, w) for n in known}) == len(known))
            stream.reconfigure(errors=next(apart, ways[-1]))


def in_ascii(text: str) -> str:
    """The text in ASCII: a sign's usual substitute, a letter without its accent, else an escape.

    >>> in_ascii("rank ∂(G₁)/∂p = 6 ≠ 7, Gröbner, ☂")
    'rank d(G1)/dp = 6 != 7, Grobner, \\\\u2602'
    """
    return "".join(c if c.isascii() else PLAIN.get(c) or _without_marks(c) for c in text)


def complain(message: object) -> None:
    """Write one line to standard error, printable, and shortened in its middle where somebody
    gave very much to quote.
    """
    print(f"disting: {brief(str(message))}".replace("\n", " "), file=sys.stderr)


def _without_marks(character: str) -> str:
    bare = normalize("NFKD", character).encode("ascii", "ignore").decode()
    return bare or character.encode("ascii", "backslashreplace").decode()


def _replaced(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return in_ascii(error.object[error.start : error.end]), error.end
