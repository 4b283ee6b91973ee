"""The page of the paper: all claims, all figures, closed in itself, byte-reproducible."""

import html
import re
import struct
from pathlib import Path

import numpy as np
import pytest

from disting.report.matrix import LETTER
from disting.report.scene import Text, svg
from disting.verdict.result import Relation, View
from reports.paper.figures import of_decisions, of_scene, paper_figures, triangles
from reports.paper.make import paper_page, with_scripts, write_paper
from tests.paper.claims import CLAIMS, Findings, Outcome
from tests.report.outline import Outline

pytestmark = pytest.mark.full

NAMES = [
    "figures-3-4",
    "figures-5-6",
    "figures-7-8",
    "figure-10",
    "figure-11",
    "figure-12",
    "figure-13",
    "figure-14",
]


@pytest.fixture(scope="module")
def folder(findings, tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("paper") / "new"
    write_paper(findings, out)
    return out


@pytest.fixture(scope="module")
def page(folder) -> str:
    return (folder / "index.html").read_text(encoding="utf-8")


def test_page_and_three_files_a_figure(folder):
    assert {p.name for p in folder.iterdir()} == {
        "index.html",
        *(n + e for n in NAMES for e in (".svg", ".png", ".pdf")),
    }
    for name in NAMES:
        assert (folder / f"{name}.pdf").read_bytes().startswith(b"%PDF")
        assert b"<svg" in (folder / f"{name}.svg").read_bytes()
        width, height = struct.unpack(">II", (folder / f"{name}.png").read_bytes()[16:24])
        assert min(width, height) > 500


def test_every_claim_stands_on_the_page_with_its_outcome(page):
    outline = Outline(page)
    said = re.sub(r"\s+", " ", outline.text)
    classes = [
        a["class"]
        for tag, a in outline.elements
        if tag == "span" and (a.get("class") or "").startswith("mark ")
    ]
    assert classes[len(Outcome) :] == [f"mark {c.outcome.name.lower()}" for c in CLAIMS]
    ids = [a["id"] for _, a in outline.elements if "id" in a]
    assert len(ids) == len(set(ids))
    for claim in CLAIMS:
        assert f"claim-{claim.key}" in ids
        for text in (claim.about, claim.place, claim.text, claim.printed, claim.reason):
            assert (
                re.sub(r"\s+", " ", html.unescape(re.sub("<[^>]*>", "", with_scripts(text))))
                in said
            )


def test_nothing_comes_from_elsewhere(page):
    outline = Outline(page)
    links = [
        a.get("href") or a.get("src") or ""
        for _, a in outline.elements
        if a.get("href") or a.get("src")
    ]
    ids = {"#" + (a.get("id") or "") for _, a in outline.elements}
    beside = {n + e for n in NAMES for e in (".svg", ".png", ".pdf")} | {"../index.html"}
    guide = {f"../guide/{name}.html" for name in ("start", "index", "glossary")}
    guide.add("../guide/glossary.html#port")
    assert {link for link in links if not link.startswith("data:")} <= ids | beside | guide
    assert not re.search(r"https?://(?!www\.w3\.org)|@import|<script[^>]", page)
    assert len(page) < 1_000_000


def test_claims_lead_to_their_verdicts(findings):
    """Where the pages of the families lie beside: every page is there, every pair in it."""
    site = Path(__file__).parents[2] / "reports"
    outline = Outline(paper_page(findings, [], {path.stem for path in site.glob("*.html")}))
    links = [a["href"] for _, a in outline.elements if (a.get("href") or "").startswith("../")]
    pairs = [link for link in links if "#" in link and "glossary" not in link]
    kept = [link for link in links if not link.startswith("../models/")]  # see reports/.gitignore
    assert all((site / "paper" / link.split("#")[0]).is_file() for link in kept)
    assert "../chains-4-undamped.html#11-13" in pairs and len(pairs) == 54
    sizes = {"3": 11, "4": 29, "5": 73}
    for link in pairs:
        if found := re.fullmatch(r"\.\./chains-(\d)-(?:un)?damped\.html#(\d+)-(\d+)", link):
            assert int(found[2]) < int(found[3]) <= sizes[found[1]]
        else:
            assert re.fullmatch(r"\.\./dampers-[34]-damped\.html#(A1|3/3\+b1|3\+b1/3\+b2)", link)
    claims = [c for c in CLAIMS if c.check and re.match("Section 5|Table [23]|Section 6", c.place)]
    unseen = [c.key for c in claims if not c.check(findings).seen]
    assert unseen == ["figure-9"]  # it violates the constraints: no family has it


def test_table_2_and_table_3(page):
    assert re.findall(
        r'<th scope="row" class="n">(\d+)</th><td class="n">(\d*)</td><td class="n">(\d+)</td>',
        page,
    )[3:6] == [
        ("4", "29", "29"),
        ("5", "73", "73"),
        ("6", "", "157"),
    ]
    rows = re.findall(r'<th scope="row">A(\d+)( \*)?</th>', page)
    assert [int(number) for number, _ in rows] == list(range(1, 12))
    assert [int(number) for number, star in rows if star] == [1, 4, 6, 8, 11]


def test_fields_of_figure_10(findings):
    panel = of_decisions("left", findings.picture(3, False, View.TF))
    assert panel.names[:2] == ("A1", "A2")
    assert panel.fields[0, 3] == (Relation.INDISTINGUISHABLE, "7")
    assert panel.fields[1, 4] == (Relation.INDISTINGUISHABLE, "6")
    assert panel.fields[0, 1] == (Relation.DISTINGUISHABLE, "1")
    drawn = svg(triangles("title", (panel,), 1, 24.0))
    assert drawn.count(">7</text>") == 10
    assert ">undecided</text>" not in drawn


def test_a_narrow_figure_has_its_legend_in_rows(findings):
    panel = of_decisions("left", findings.picture(3, True, View.TF))
    one, two = (
        triangles("title", (panel, panel), 1, 24.0),
        triangles("title", (panel, panel), 2, 24.0),
    )
    for scene, rows in ((one, 3), (two, 1)):
        entries = [layer for layer in scene.layers if layer.name.startswith("legend-")]
        words = [
            shape
            for layer in entries
            for shape in layer.shapes
            if isinstance(shape, Text) and len(shape.text) > 1
        ]
        assert len(words) == 3 and len({word.y for word in words}) == rows
        assert all(
            word.x + LETTER * len(word.text) < scene.width + 10 and word.y < scene.height
            for word in words
        )


def test_phones_get_drawings_of_their_own(page):
    shown = re.findall(r'<svg class="plot (?:triangles )?(\w+)"', page)
    assert shown.count("wide") == shown.count("narrow") == 7 and shown.count("both") == 1


@pytest.mark.slow
def test_the_same_findings_give_the_same_bytes(findings, folder):
    again = {p.name: p for p in paper_figures(findings)}
    assert list(again) == NAMES
    for picture in again.values():
        for ending, content in picture.files:
            assert content == (folder / (picture.name + ending)).read_bytes(), picture.name + ending
    assert paper_page(findings, list(again.values())) == (folder / "index.html").read_text(
        encoding="utf-8"
    )


def test_another_computation_gives_the_same(findings, folder):
    """The curves of a plot to the last digit, and the bytes of a drawing."""
    fresh = Findings()
    assert fresh.refit.fitted_parameters == findings.refit.fitted_parameters
    assert fresh.refit.modes == findings.refit.modes and fresh.refit.j == findings.refit.j
    np.testing.assert_array_equal(fresh.refit.measured.G, findings.refit.measured.G)
    panels = [of_decisions("Transfer function", fresh.picture(3, False, View.TF))]
    panels.append(of_decisions("8 Markov parameters", fresh.picture(3, False, View.MARKOV, 8)))
    title = re.search(
        "<title>(.*?)</title>", (folder / "figure-10.svg").read_text(encoding="utf-8")
    )
    assert title is not None
    scene = of_scene("figure-10", "", "", triangles(title[1], panels, 2, 24.0))
    assert len(scene.files) == 3
    for ending, content in scene.files:
        assert content == (folder / (scene.name + ending)).read_bytes(), ending


def test_subscripts_of_hostile_text():
    assert with_scripts("<b>_x^2") == "&lt;b&gt;<sub>x</sub><sup>2</sup>"
