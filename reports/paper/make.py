"""The page "The paper, claim by claim" and the figures of the paper from our own data:
`python -m reports.paper.make`, from the top folder of the repository.

The page has every claim with what is found here, then the figures and the tables. It is written
beside this script, which takes minutes; the start page of the site links to it.
"""

import argparse
import re
from collections import Counter
from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from jinja2 import ChoiceLoader, FileSystemLoader
from markupsafe import Markup, escape

from disting import Engine, Family, ModelRow, Store
from disting.catalogs.files import damper_name, name_of
from disting.files import __version__, write_whole
from disting.report.drawing import draw
from disting.report.environment import Policy, environment
from disting.report.fit.responses import drawing
from disting.report.words import plural
from disting.store.scheduling import executor
from reports.paper.figures import Picture, paper_figures
from tests.paper.claim import Observation
from tests.paper.claims import SECTIONS, Claim, Findings, Observed, Outcome

HERE = Path(__file__).parent


def write_paper(findings: Findings, out: Path, beside: Container[str] = ()) -> list[Path]:
    """Write index.html and every figure as SVG, PNG and PDF; the paths written, in order.

    Claims link to the pages of the families that are named in `beside`, one folder above `out`.

    The same findings give the same bytes. `out` is made if it does not exist; other files in it
    stay as they are.
    """
    pictures = paper_figures(findings)
    page = paper_page(findings, pictures, beside)
    out.mkdir(parents=True, exist_ok=True)
    return [write_whole(out / name, content) for name, content in _files(page, pictures)]


def _files(page: str, pictures: Sequence[Picture]) -> Iterator[tuple[str, bytes]]:
    yield "index.html", page.encode()
    for picture in pictures:
        for ending, content in picture.files:
            yield picture.name + ending, content


LARGEST = 10  # masses, of Table 2 continued
PRINTED = (1, 3, 11, 29, 73)  # Table 2
SIGNS = {Outcome.AGREES: "=", Outcome.DIFFERS: "≠", Outcome.UNCHECKED: "?"}


@dataclass(frozen=True, slots=True)
class Line:
    """A claim, what its check found, and (words, address) of the pages that show its verdicts."""

    claim: Claim
    found: Observed | None
    links: tuple[tuple[str, str], ...] = ()
    commands: tuple[str, ...] = ()

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


def parts(findings: Findings, beside: Container[str] = ()) -> tuple[Part, ...]:
    """All claims, each checked now."""
    return tuple(
        Part(f"part-{number}", title, tuple(_line(c, findings, beside) for c in claims))
        for number, (title, claims) in enumerate(SECTIONS, 1)
    )


def _line(claim: Claim, findings: Findings, beside: Container[str]) -> Line:
    outcome = claim.check(findings) if claim.check else None
    seen = outcome.seen if outcome else ()
    return Line(
        claim,
        outcome,
        tuple((in_words(s), address(s)) for s in seen if page_of(s) in beside),
        tuple(command(s) for s in seen if not page_of(s)),
    )


def page_of(seen: Observation) -> str:
    """Name of the page of a family; none has models with a lag or a dead time.

    >>> page_of(Observation(3, True)), page_of(Observation(3, True, ("1", "1+lag")))
    ('chains-3-damped', '')
    """
    if any(name.endswith(("lag", "delay")) for name in seen.models):
        return ""
    return (damper_name if seen.dampers else name_of)(seen.n_masses, seen.damped)


def address(seen: Observation) -> str:
    """Where it can be seen, from the paper's folder.

    >>> address(Observation(3, True, ("1", "4"))), address(Observation(3, False, ("4",)))
    ('../chains-3-damped.html#1-4', '../models/3-undamped/4.html')
    >>> address(Observation(3, True, ("3", "3+b1"), dampers=True))
    '../dampers-3-damped.html#3/3+b1'
    """
    if len(seen.models) == 1 and not seen.dampers:
        kind = "damped" if seen.damped else "undamped"
        return f"../models/{seen.n_masses}-{kind}/{seen.models[0]}.html"
    hash_ = f"#A{seen.models[0]}" if len(seen.models) == 1 else ""
    if len(seen.models) == 2:
        hash_ = "#" + ("/" if seen.dampers else "-").join(seen.models)
    return f"../{page_of(seen)}.html{hash_}"


def in_words(seen: Observation) -> str:
    """What a link leads to.

    >>> in_words(Observation(3, True, ("1", "4"))), in_words(Observation(4))
    ('3:1 and 3:4, damped', 'all pairs of 4 masses, undamped')
    """
    kind = "damped" if seen.damped else "undamped"
    size = plural(seen.n_masses, "mass", "masses")
    names = [f"{seen.n_masses}:{name}" for name in seen.models]
    if seen.dampers and len(names) < 2:
        return f"dampers to the ground of {names[0] if names else size}, {kind}"
    return f"{' and '.join(names) or f'all pairs of {size}'}, {kind}"


def command(seen: Observation) -> str:
    """The command that decides a pair.

    >>> command(Observation(3, True, ("1", "1+lag")))
    'disting compare 3:1 3:1+lag'
    """
    names = " ".join(f"{seen.n_masses}:{name}" for name in seen.models)
    return f"disting compare {names}{'' if seen.damped else ' --undamped'}"


def paper_page(findings: Findings, pictures: Sequence[Picture], beside: Container[str] = ()) -> str:
    """HTML of the page; the pictures' files lie beside it, the pages of the families that are
    named in `beside` one folder up.
    """
    listed = parts(findings, beside)
    lines = [line for part in listed for line in part.lines]
    counts = Counter(line.outcome for line in lines)
    policy = Policy()
    templates = environment().overlay(
        loader=ChoiceLoader([environment().loader, FileSystemLoader(HERE)])
    )
    text = templates.get_template("page.jinja").render(
        policy=policy,
        parts=listed,
        counts=[
            (outcome, outcome.name.lower(), SIGNS[outcome], counts[outcome]) for outcome in Outcome
        ],
        total=len(lines),
        differing=[line for line in lines if line.outcome is Outcome.DIFFERS],
        pictures=pictures,
        figure=lambda place: figure_of(place, pictures),
        sizes=[
            (n, PRINTED[n - 1] if n <= len(PRINTED) else "", len(Family(n, damped=False)))
            for n in range(1, LARGEST + 1)
        ],
        models=model_rows(findings),
        pages="../models/3-undamped" if name_of(3, False) in beside else "",
        drawing=lambda chain: drawing(draw(chain)),
        raised=with_scripts,
        plural=plural,
        version=__version__,
    )
    return policy.of(text)


def figure_of(place: str, pictures: Sequence[Picture]) -> str:
    """Name of the picture of which a claim's place speaks, "" where there is none."""
    names = (p.name for p in pictures if re.search(rf"{re.escape(p.printed)}(?!\d)", place))
    return next(names, "")


def model_rows(findings: Findings) -> list[tuple[ModelRow, int]]:
    """Table 3: the 3-mass models without damping, and how many parameters of each are
    determinable with damping.
    """
    rows = zip(
        findings.catalog(3, damped=False).rows, findings.catalog(3, damped=True).rows, strict=True
    )
    return [(row, damped.rank) for row, damped in rows]


def with_scripts(text: str) -> Markup:
    """Text with its _ and ^ as subscripts and superscripts.

    >>> print(with_scripts("n_act+ < 2^N"))
    n<sub>act+</sub> &lt; 2<sup>N</sup>
    """
    subscripts = re.sub(r"(?<=\S)_(\w+[+−]?)", r"<sub>\1</sub>", str(escape(text)))
    return Markup(re.sub(r"\^(\w+)", r"<sup>\1</sup>", subscripts))


def main() -> None:
    """Write the page and the figures; tell how many claims agree."""
    parser = argparse.ArgumentParser(description="The paper's figures and claims from our own data")
    parser.add_argument("--out", type=Path, default=HERE, help="folder (default: beside this)")
    parser.add_argument("--jobs", type=int, default=1, help="processes (default: 1)")
    options = parser.parse_args()
    beside = {path.stem for path in options.out.resolve().parent.glob("*.html")}
    with Store.open() as store, executor(options.jobs) as pool:
        paths = write_paper(Findings(Engine(store=store), pool), options.out, beside)
    counts = Counter(claim.outcome for _, claims in SECTIONS for claim in claims)
    told = ", ".join(f"{counts[outcome]}: {outcome.value}" for outcome in Outcome)
    print(f"{counts.total()} claims of the paper; {told}")
    print(f"{len(paths)} files in {options.out}; open {paths[0]}")


if __name__ == "__main__":
    main()
