"""Text for terminals and files that cannot hold every character, such as the code pages of
Windows, or ASCII.

What has no place there is written with signs that have: formulas stay readable, and no output ends
in an error.
"""

import codecs
import sys
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


def in_ascii(text: str) -> str:
    """The text in ASCII: a sign's usual substitute, a letter without its accent, else a question
    mark.

    >>> in_ascii("rank ∂(G₁)/∂p = 6 ≠ 7, Gröbner, ☂")
    'rank d(G1)/dp = 6 != 7, Grobner, ?'
    """
    return "".join(c if c.isascii() else PLAIN.get(c) or _without_marks(c) or "?" for c in text)


def complain(message: object) -> None:
    """Write one line to standard error, printable, and shortened in its middle where somebody
    gave very much to quote.
    """
    print(f"disting: {brief(str(message))}".replace("\n", " "), file=sys.stderr)


def _without_marks(character: str) -> str:
    return normalize("NFKD", character).encode("ascii", "ignore").decode()


def _replaced(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return in_ascii(error.object[error.start : error.end]), error.end
