"""The guide: every page is in the site, leads somewhere, lets no markup through; what it and
the README show is true.
"""

import argparse
import re
import shlex
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from disting.cli.parser import parser
from disting.report.guide import GuidePage, guide_files, guide_page, guide_texts
from tests.cli.process import called
from tests.report.barriers import barriers
from tests.report.outline import Outline

ROOT = Path(__file__).parents[2]
FOLDER, README = ROOT / "disting" / "guide", ROOT / "README.md"
TEXTS = {
    **{path.name: path.read_text(encoding="utf-8") for path in sorted(FOLDER.glob("*.md"))},
    "README.md": README.read_text("utf-8"),
}
CHEAP = (
    "compare 3:",
    "compare 4:",
    'compare "leaks.json',
    "equivalents",
    "dampers 3:",
    "verdicts",
    "models 3",
)
PLACEHOLDER = re.compile(r"[\[\]|]|\.\.|\b[A-Z]+\b")
MARKUP = """<script>alert(1)</script> <b onclick="x()">bold</b> [a](javascript:alert(1)) ![i](http://a.b/c.png) {{ 7*7 }} &lt;"""


@cache
def written() -> dict[str, str]:
    return {name: content.decode() for name, content in guide_files()}


def fences(text: str) -> list[str]:
    return [
        token.content for token in MarkdownIt("commonmark").parse(text) if token.type == "fence"
    ]


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


def transcripts() -> list[tuple[str, str, str]]:
    """Command and its output, of what is shown with output."""
    found = []
    for name, text in TEXTS.items():
        for block in fences(text):
            parts = re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]
            found += [(name, *part.split("\n", 1)) for part in parts]
    return found


def test_the_readme_is_short() -> None:
    assert len(TEXTS["README.md"].splitlines()) <= 200


def test_every_page_is_in_the_site_with_its_title_and_headings() -> None:
    pages = {f"guide/{path.stem}.html" for path in FOLDER.glob("*.md")}
    assert len(pages) >= 10 and set(written()) == pages | {"guide/style.css"}
    for address in pages:
        text = TEXTS[Path(address).stem + ".md"]
        outline = Outline(written()[address])
        headings = [
            token for token in MarkdownIt("commonmark").parse(text) if token.type == "heading_open"
        ]
        assert outline.count("h1") == 1 and f"# {outline.texts['h1'][0]}\n" in text
        # "All pages"
        assert outline.count("h2") == sum(token.tag == "h2" for token in headings) + 1
        assert outline.count("h3") == sum(token.tag == "h3" for token in headings)
        assert outline.count("table") == len(re.findall(r"^\|[ :|-]*-[ :|-]*$", text, re.MULTILINE))
        assert outline.count("pre") == len(fences(text)) + len(re.findall(r"\n\n    \S", text))
        assert outline.count("a", **{"aria-current": "page"}) == 1


def test_no_link_and_no_anchor_is_dead() -> None:
    ids = {
        name: [a["id"] for _, a in Outline(text).elements if "id" in a]
        for name, text in written().items()
        if "html" in name
    }
    for name, text in written().items():
        if not name.endswith(".html"):
            continue
        assert len(ids[name]) == len(set(ids[name]))
        links = [str(a["href"]) for tag, a in Outline(text).elements if tag == "a"]
        assert len(links) > len(ids)
        for link in links:
            target, _, anchor = link.partition("#")
            page = f"guide/{target}" if target else name
            assert link == "../index.html" or (
                page in ids and (not anchor or anchor in ids[page])
            ), (name, link)


def test_the_readme_and_the_pages_lead_to_files_and_to_every_page() -> None:
    for name, text in TEXTS.items():
        folder = ROOT if name == "README.md" else FOLDER
        targets = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", text)
        assert all((folder / target).is_file() for target in targets), name
        if name in ("README.md", "index.md"):
            pages = {path.name for path in FOLDER.glob("*.md")} - {"index.md"}
            assert pages <= {Path(target).name for target in targets}


def test_the_order_is_that_of_the_listing() -> None:
    listed = re.findall(r"^\| \[[^]]+\]\(([\w-]+)\.md\)", TEXTS["index.md"], re.MULTILINE)
    assert list(guide_texts()) == ["index", *listed]
    assert f'rel="next" href="{listed[0]}.html"' in written()["guide/index.html"]
    assert 'rel="next"' not in written()[f"guide/{listed[-1]}.html"]


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
        key in ("id", "class", "tabindex", "role", "aria-label")
        for _, a in outline.elements
        for key in a
    )


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


def test_every_command_shown_is_accepted() -> None:
    assert len(shown()) > 40
    for name, command, whole in shown():
        _, *arguments = shlex.split(command)
        if whole or (re.search(r"\d", command) and not PLACEHOLDER.search(command)):
            parser().parse_args(arguments)
        elif arguments[0] != "COMMAND":
            words = command.replace("\\|", "|").split()[1:]
            assert set(re.findall(r"--[a-z-]+", command)) <= known_options(words, parser()), (
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
    for chosen in words[0].split("|") if commands and words else []:
        assert chosen in commands or chosen == "...", words
        found |= known_options(words[1:], commands[chosen]) if chosen in commands else set()
    return found


@pytest.mark.parametrize(
    ("page", "command", "output"),
    [t for t in transcripts() if t[1].startswith(tuple(f"disting {c}" for c in CHEAP))],
)
def test_what_is_shown_is_what_is_said(
    page: str, command: str, output: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = r"This is `(\w+\.json)`[^`]*^```json\n(.*?)^```"
    for name, block in re.findall(files, TEXTS[page], re.MULTILINE | re.DOTALL):
        (tmp_path / name).write_text(block, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    said = called(*shlex.split(command)[1:]).stdout
    assert said.rstrip("\n") == output.rstrip("\n"), page


def test_what_is_quoted_of_identifiability_is_what_is_said() -> None:
    quoted = re.findall(r"^A\d+: .*", TEXTS["models.md"], re.MULTILINE)
    said = called("models", "3", "--damped", "--identifiability").stdout.splitlines()
    also = called("models", "3", "--damped", "--also", "sensor=1").stdout.splitlines()
    assert len(quoted) == 4 and set(quoted[:2]) <= set(said) and set(quoted[2:]) <= set(also)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("guide")
    (folder / "guide").mkdir()
    for name, content in guide_files():
        (folder / name).write_bytes(content)
    return folder


@pytest.mark.parametrize(
    ("width", "scheme", "read"), [(390, "dark", "decisions"), (1280, "light", "fit")]
)
def test_pages_are_legible_and_only_boxes_scroll(visit, width: int, scheme: str, read: str) -> None:  # type: ignore[no-untyped-def]
    for name in guide_texts() if width < 500 else [read]:
        tab = visit(f"guide/{name}.html", width, scheme)
        assert tab.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0, name
    tab = visit(f"guide/{read}.html", width, scheme)
    assert barriers(tab) == []
