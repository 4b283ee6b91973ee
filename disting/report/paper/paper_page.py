"""The page "The paper, claim by claim": every claim with what is found here, then the figures
and the tables.
"""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup, escape

from disting.catalogs import ModelRow
from disting.files import __version__
from disting.model.family import Family
from disting.paper import Claim, Findings, Found, Outcome
from disting.paper.claims import SECTIONS
from disting.report.drawing import draw
from disting.report.environment import render
from disting.report.fit.responses import drawing
from disting.report.paper.picture import Picture
from disting.report.words import plural

LARGEST = 10  # masses, of Table 2 continued
PRINTED = (1, 3, 11, 29, 73)  # Table 2
SIGNS = {Outcome.AGREES: "=", Outcome.DIFFERS: "≠", Outcome.UNCHECKED: "?"}


@dataclass(frozen=True, slots=True)
class Line:
    """A claim and what its check found."""

    claim: Claim
    found: Found | None

    @property
    def outcome(self) -> Outcome:
        """What the check found now."""
        return self.found.outcome if self.found else Outcome.UNCHECKED

    @property
    def kind(self) -> str:
        """Class of the outcome in the style sheet."""
        return self.outcome.name.lower()

    @property
    def sign(self) -> str:
        """A sign beside the word."""
        return SIGNS[self.outcome]


@dataclass(frozen=True, slots=True)
class Part:
    """Some claims under a title."""

    key: str
    title: str
    lines: tuple[Line, ...]


def parts(findings: Findings) -> tuple[Part, ...]:
    """All claims, each checked now."""
    return tuple(
        Part(
            f"part-{number}",
            title,
            tuple(Line(c, c.check(findings) if c.check else None) for c in claims),
        )
        for number, (title, claims) in enumerate(SECTIONS, 1)
    )


def paper_page(findings: Findings, pictures: Sequence[Picture]) -> str:
    """HTML of the page; the pictures' files lie beside it."""
    listed = parts(findings)
    lines = [line for part in listed for line in part.lines]
    counts = Counter(line.outcome for line in lines)
    return render(
        "paper.html",
        parts=listed,
        counts=[
            (outcome, outcome.name.lower(), SIGNS[outcome], counts[outcome]) for outcome in Outcome
        ],
        total=len(lines),
        differing=[line for line in lines if line.outcome is Outcome.DIFFERS],
        pictures=pictures,
        sizes=[
            (n, PRINTED[n - 1] if n <= len(PRINTED) else "", len(Family(n)))
            for n in range(1, LARGEST + 1)
        ],
        models=model_rows(findings),
        drawing=lambda chain: drawing(draw(chain)),
        raised=raised,
        plural=plural,
        version=__version__,
    )


def model_rows(findings: Findings) -> list[tuple[ModelRow, int]]:
    """Table 3: the 3-mass models without damping, and how many parameters of each are
    determinable with damping.
    """
    rows = zip(findings.catalog(3).rows, findings.catalog(3, damped=True).rows, strict=True)
    return [(row, damped.rank) for row, damped in rows]


def raised(text: str) -> Markup:
    """Text with its _ and ^ as subscripts and superscripts.

    >>> print(raised("n_act+ < 2^N"))
    n<sub>act+</sub> &lt; 2<sup>N</sup>
    """
    subscripts = re.sub(r"(?<=\S)_(\w+[+−]?)", r"<sub>\1</sub>", str(escape(text)))
    return Markup(re.sub(r"\^(\w+)", r"<sup>\1</sup>", subscripts))
