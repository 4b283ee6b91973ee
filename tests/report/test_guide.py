"""The guide: every page is in the site, leads somewhere, lets no markup through; every command
that it and the README show is one.
"""

import argparse
import json
import re
import shlex
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given, strategies as st
from markdown_it import MarkdownIt

from disting.catalogs import catalog
from disting.cli.run import parser
from disting.errors import InputError
from disting.model.chain import text_drawing
from disting.model.family import Family
from disting.model.names import chain_of
from disting.network.notation import network_of, notations_of
from disting.report import write_report
from disting.report.guide import (
    Part,
    guide,
    guide_files,
    guide_parts,
    guide_pictures,
    guide_texts,
    notebook_page,
)
from disting.report.index import GUIDE, index
from disting.report.markdown import GuidePage, guide_page
from disting.report.search import search_script
from tests.cli.process import called
from tests.report.barriers import barriers
from tests.report.guide_blocks import FOLDER, ROOT, TEXTS, blocks, fences
from tests.report.outline import Outline

PLACEHOLDER = re.compile(r"[\[\]|]|\.\.|\b[A-Z]+\b")
MARKUP = """<script>alert(1)</script> <b onclick="x()">bold</b> [a](javascript:alert(1)) ![i](http://a.b/c.png) {{ 7*7 }} &lt;"""


@cache
def parts() -> tuple[Part, ...]:
    return guide(parser())


@cache
def written() -> dict[str, str]:
    return {name: content.decode() for name, content in guide_files(parts())}


def shown() -> list[tuple[str, str, bool]]:
    """Every command that README or guide show, and whether it is whole: in blocks yes, within
    the text maybe not.
    """
    lines = [
        (name, line.strip())
        for name, text in TEXTS.items()
        for block in fences(text)
        for line in block.splitlines()
    ]
    found = [
        (name, line.removeprefix("$ ").removeprefix("pip install . && "), True)
        for name, line in lines
    ]
    found += [
        (name, code, False)
        for name, text in TEXTS.items()
        for code in re.findall(r"`(disting [^`]+)`", text)
    ]
    return [(name, line, whole) for name, line, whole in found if line.startswith("disting ")]


def test_the_picture_of_the_app_is_small_and_where_it_is_named() -> None:
    pictures = dict(guide_pictures())
    assert 'src="app.webp"' in written()["guide/app.html"]
    assert 0 < len(pictures["guide/app.webp"]) < 60_000
    start = index([catalog(2, damped=True)], [(GUIDE, "Guide", "all of it")])
    assert 'src="guide/app.webp"' in start
    assert "app.webp" not in index([catalog(2, damped=True)])
    assert "(disting/guide/app.webp)" in (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_readme_is_short() -> None:
    assert len(TEXTS["README.md"]) <= 7500


@pytest.mark.full
def test_every_page_is_in_the_site_with_its_title_and_headings() -> None:
    pages = {f"guide/{path.stem}.html" for path in FOLDER.glob("*.md")}
    made = {name for name in written() if re.match("guide/(python-|commands)", name)}
    assert len(pages) >= 20 and len(made) >= 8
    assert set(written()) == pages | made | {"guide/style.css"}
    for address in pages:
        text = TEXTS[Path(address).stem + ".md"]
        outline = Outline(written()[address])
        headings = [
            token for token in MarkdownIt("commonmark").parse(text) if token.type == "heading_open"
        ]
        assert outline.count("h1") == 1 and f"# {outline.texts['h1'][0]}\n" in text
        assert outline.count("h2") == sum(token.tag == "h2" for token in headings)
        assert outline.count("h3") == sum(token.tag == "h3" for token in headings)
        assert outline.count("table") == len(re.findall(r"^\|[ :|-]*-[ :|-]*$", text, re.MULTILINE))
        drawn = [content for kind, content in blocks(text) if kind == "picture"]
        indented = len(re.findall(r"\n\n    \S", text))
        assert outline.count("pre") == len(fences(text)) - len(drawn) + indented
        images = len(re.findall(r"^!\[", text, re.MULTILINE))
        assert outline.count("figure") == images + sum(len(d.splitlines()) for d in drawn)
        assert outline.count("a", **{"aria-current": "page"}) == 1


def test_links_lead_to_files_and_the_listing_to_every_page() -> None:
    for name, text in TEXTS.items():
        folder = ROOT if name == "README.md" else FOLDER
        targets = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text)
        assert all((folder / target).is_file() for target in targets), name
    listed = set(re.findall(r"\]\(([\w-]+\.md)", TEXTS["index.md"]))
    assert {path.name for path in FOLDER.glob("*.md")} - {"index.md"} == listed
    assert "disting/guide/index.md" in TEXTS["README.md"]


@pytest.mark.full
def test_parts_in_the_order_of_the_listing() -> None:
    listed = re.findall(r"^\| \[[^]]+\]\(([\w-]+)\.md\)", TEXTS["index.md"], re.MULTILINE)
    listing = guide_parts(guide_texts())
    assert [title for title, _ in listing] == [
        "Tutorials",
        "How-to guides: measurements",
        "How-to guides: models",
        "Explanation",
        "For developers",
        "Reference",
    ]
    assert [name for _, names in listing for name in names] == listed
    assert f'rel="next" href="{listed[0]}.html"' in written()["guide/index.html"]
    last = parts()[-1].pages[-1].name
    assert last == "commands" and 'rel="next"' not in written()["guide/commands.html"]


def test_pictures_are_the_chains_that_stand_beside_them() -> None:
    named = [
        re.split(r"\s{2,}", line.strip())
        for text in TEXTS.values()
        for kind, content in blocks(text)
        for line in content.splitlines()
        if kind == "picture"
    ]
    networks = [(model, said) for model, *said in named if notations_of(model)]
    assert len(networks) > 8 and all(
        len(said) == 1 and network_of(model) for model, said in networks
    )
    for model, *drawing in named:
        if notations_of(model):
            continue
        name, _, option = model.partition(" ")
        chain = chain_of(name, Family(1, damped=option == "--damped"))
        assert "   ".join(drawing) == text_drawing(chain)


def test_an_image_is_a_drawing_of_the_guide_or_words() -> None:
    text = "# T\n\n![two](a.svg)\n\n![far](https://a.b/c.png)\n"
    page = guide_page("a", text, ["a"], {"a.svg": "<svg></svg>"})
    assert re.sub("</?p>|\n", "", page.body) == (
        '<figure class="picture"><svg></svg><figcaption>two</figcaption></figure>far'
    )


COPY = ("data-copy", "data-text")


def rendered(text: str) -> GuidePage:
    return guide_page("here", f"# Title\n\n{text}", ["here", "there"])


def test_links_out_of_the_guide_stay_as_words() -> None:
    page = rendered(
        "[a](there.md#x) [b](../cli/fit.py) [**c**](nowhere.md) [d](https://a.b) <https://e.f>"
        " [g](#h)\n\n## H\n"
    )
    assert (
        page.body.splitlines()[0]
        == '<p><a href="there.html#x">a</a> b <strong>c</strong> d https://e.f <a'
        ' href="#h">g</a></p>'
    )


@pytest.mark.parametrize(
    "frame",
    ["{}", "## {}", "- {}", "| a |\n| --- |\n| {} |", "```\n{}\n```", "    {}", "> {}", "`{}`"],
)
def test_markup_is_text(frame: str) -> None:
    outline = Outline(str(rendered(frame.format(MARKUP)).body))
    assert {tag for tag, _ in outline.elements}.isdisjoint({"script", "b", "a", "img", "iframe"})
    assert "<script>alert(1)</script>" in outline.text and "{{ 7*7 }}" in outline.text
    assert all(
        key in ("id", "class", "tabindex", "role", "aria-label", "type", *COPY)
        for _, a in outline.elements
        for key in a
    )


@pytest.mark.full
@given(st.text(st.sampled_from("<>&\"'`[]()#|-*_!\\ \nab:/."), max_size=60))
def test_any_text_gives_whole_elements_and_known_links(text: str) -> None:
    outline = Outline(str(rendered(text).body).replace("<hr />", "").replace("<br />", ""))
    assert all(str(a["href"]).startswith("#") for tag, a in outline.elements if tag == "a")


def test_equal_headings_have_anchors_of_their_own_and_a_page_has_a_title() -> None:
    page = rendered("## A, *b*?\n\n## A b\n\n### A b\n")
    assert page.contents == (("a-b", "A, b?"), ("a-b-1", "A b"))
    assert re.findall(r'id="([^"]*)"', page.body) == ["a-b", "a-b-1", "a-b-2"]
    with pytest.raises(ValueError, match="title"):
        guide_page("here", "No title.", [])


@pytest.mark.full
def test_every_command_shown_is_accepted() -> None:
    assert len(shown()) > 40
    known = parser()
    for name, command, whole in shown():
        _, *arguments = shlex.split(command)
        if whole or (re.search(r"\d", command) and not PLACEHOLDER.search(command)):
            known.parse_args(arguments)
        elif arguments[0] != "COMMAND":
            words = command.replace("\\|", "|").split()[1:]
            assert set(re.findall(r"--[a-z-]+", command)) <= known_options(words, known), (
                name,
                command,
            )


def known_options(words: list[str], of: argparse.ArgumentParser) -> set[str]:
    """Options of a command that is only mentioned, or shown with placeholders; of all that it
    names, as build|verify.
    """
    found = {option for action in of._actions for option in action.option_strings}
    commands = next(
        (
            action.choices
            for action in of._actions
            if isinstance(action, argparse._SubParsersAction)
        ),
        {},
    )
    named = words[0].split("|") if commands and words and words[0][0] != "-" else []
    for chosen in named:
        assert chosen in commands or chosen == "...", words
        found |= known_options(words[1:], commands[chosen]) if chosen in commands else set()
    return found


@pytest.mark.full
def test_what_is_quoted_of_identifiability_is_what_is_said() -> None:
    quoted = re.findall(r"^A\d+: .*", TEXTS["models.md"], re.MULTILINE)
    said = called("models", "3", "--damped", "--identifiability").stdout.splitlines()
    also = called("models", "3", "--damped", "--also", "sensor=1").stdout.splitlines()
    assert len(quoted) == 4 and set(quoted[:2]) <= set(said) and set(quoted[2:]) <= set(also)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("guide")
    write_report([catalog(2, damped=False), catalog(3, damped=True)], folder, commands=parser())
    return folder


def found(tab, text: str) -> list[str]:  # type: ignore[no-untyped-def]
    """Titles of what is found."""
    tab.fill("#finder", text)
    return [item.inner_text() for item in tab.locator("#finds li .what").all()]


def where(tab, text: str) -> list[str]:  # type: ignore[no-untyped-def]
    """Pages on which something is found."""
    tab.fill("#finder", text)
    return [item.inner_text() for item in tab.locator("#finds li .where").all()]


WORDS = {
    "install": "start",
    "rpm": "quantities",
    "simulink": "fit-details",
    "belt": "gallery",
    "backlash": "not-for",
    "encoder": "gallery",
    "unit": "quantities",
}
"""Words that people search for, and a page that has the answer."""


@pytest.mark.full
@pytest.mark.parametrize(("word", "page"), WORDS.items())
def test_the_search_knows_the_words_of_engineers(word: str, page: str) -> None:
    data = json.loads(re.search(r"const DATA = (.*);\n", search_script(parts(), {}))[1])  # type: ignore[index]
    found = {
        data["pages"][place][0]
        for place, _, title, words in data["sections"]
        if word in f"{title} {words}".lower()
    }
    assert f"guide/{page}.html" in found


@pytest.mark.full
def test_one_search_finds_sections_names_commands_terms_and_models(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("models/3-damped/4.html")
    tab.keyboard.press("/")
    tab.wait_for_function(
        "document.querySelectorAll('#finds').length && document.activeElement.id === 'finder'"
    )
    tab.wait_for_selector('script[src$="search.js"]', state="attached")
    tab.keyboard.type("closur")
    tab.wait_for_selector("#finds li")
    assert "closure" in found(tab, "closur")
    assert found(tab, "gap")[0] == "gap"
    assert "disting compare" in found(tab, "compare") and "compare" in found(tab, "compare")
    assert found(tab, "Chain.parameters")[0] == "Chain.parameters"
    assert any("disting fit --band" in title for title in found(tab, "--band"))
    assert found(tab, "2:3") == ["A3 of 2 masses, undamped"]
    assert found(tab, "A3")[:2] == ["A3 of 3 masses, damped", "A3 of 2 masses, undamped"]
    assert found(tab, "zzyzx") == []
    assert tab.locator(".finder .nothing").inner_text() == "Nothing found"
    first = {
        "belt": "Belt axis: where does it rub?",
        "backlash": "backlash",
        "encoder": "Two encoders",
        "install": "Install",
        "simulink": "In MATLAB and Simulink",
        "unit": "Units",
    }
    assert {word: found(tab, word)[0] for word in first} == first
    for word in ("friction", "noise", "sensor", "unit"):  # names of the reference too
        assert not [p for p in where(tab, word)[:4] if p.startswith(("Python: ", "All commands"))]
    assert "Quantities, units and signs" in where(tab, "rpm")[:4]
    assert "disting plan" in found(tab, "plan")[:3]
    assert where(tab, "Friction")[0] == "Python: disting.simulation"
    assert "When not to use it" in where(tab, "backlash") and "Read measured data" in where(
        tab, "frequency response"
    )
    places = where(tab, "frequency response")
    assert len(places) > 5 and not [p for p in places[:5] if p.startswith(("disting.", "All "))]


@pytest.mark.full
def test_the_keyboard_searches_and_goes(visit) -> None:  # type: ignore[no-untyped-def]
    tab = visit("index.html", 320, "dark")
    tab.keyboard.press("/")
    tab.keyboard.type("3:2 3:5")
    tab.wait_for_selector("#finds li")
    assert tab.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0
    assert barriers(tab, context=".site") == []
    tab.keyboard.press("ArrowDown")
    assert tab.get_attribute("#finder", "aria-activedescendant") == "find-0"
    assert tab.get_attribute("#find-0", "aria-selected") == "true"
    tab.keyboard.press("Escape")
    assert tab.get_attribute("#finder", "aria-expanded") == "false"
    tab.keyboard.press("ArrowUp")
    tab.keyboard.press("ArrowDown")
    with tab.expect_navigation():
        tab.keyboard.press("Enter")
    assert tab.url.endswith("chains-3-damped.html#2-5")


@pytest.mark.full
def test_every_address_that_the_search_knows_is_there(site: Path) -> None:
    text = (site / "search.js").read_text(encoding="utf-8")
    data = json.loads(re.search(r"const DATA = (.*);\n", text)[1])  # type: ignore[index]
    ids = {}
    for address, _ in data["pages"]:
        outline = Outline((site / address).read_text(encoding="utf-8"))
        ids[address] = {a["id"] for _, a in outline.elements if "id" in a} | {""}
    assert len(data["sections"]) > 500
    for place, anchor, title, _ in data["sections"]:
        assert title and anchor in ids[data["pages"][place][0]], (place, anchor)


@pytest.mark.full
def test_executed_notebooks_are_pages_with_their_outputs(tmp_path: Path) -> None:
    folder = ROOT / "reports" / "notebooks"
    shipped = {path.stem: path.read_text("utf-8") for path in sorted(folder.glob("*.ipynb"))}
    found = {part.title: part for part in guide(notebooks=shipped)}["Notebooks"]
    assert [page.name for page in found.pages] == [f"notebook-{name}" for name in shipped]
    for page, text in zip(found.pages, shipped.values(), strict=True):
        outputs = sum(bool(cell.get("outputs")) for cell in json.loads(text)["cells"])
        assert page.body.count('<div class="output"') == outputs > 5
        assert page.body.count("<pre") >= outputs and "<svg" in page.body
        assert not re.search(r"(?:src|href)=\"https?:|<script", page.body)


@pytest.mark.parametrize(
    "text", ["", "[]", "{}", '{"cells": 3}', '{"cells": [{"cell_type": "code"}]}']
)
def test_what_is_no_notebook_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="notebook"):
        notebook_page("a", text, ())


def test_the_text_of_an_output_is_text() -> None:
    cells = [
        {"cell_type": "markdown", "source": "# T"},
        {
            "cell_type": "code",
            "source": ["a = 1\n", "```"],
            "outputs": [{"output_type": "stream", "name": "stdout", "text": ["<b>&\n"]}],
        },
    ]
    assert notebook_page("a", json.dumps({"cells": cells[1:]}), ()).title == "a"
    page = notebook_page("a", json.dumps({"cells": cells}), ())
    assert "<pre>&lt;b&gt;&amp;</pre>" in page.body and "a = 1\n```</code>" in page.body
