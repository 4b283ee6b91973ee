"""What a page may do: its own scripts run, and no other one does."""

import re
from base64 import b64encode
from hashlib import sha256
from html import unescape
from pathlib import Path

import pytest
from markupsafe import Markup

from disting import Engine, report
from disting.report.environment import Policy, environment, source_of
from disting.report.listing import Listing, judge
from disting.report.model_list import write_model_list
from tests.report.conftest import heard
from tests.report.test_model_list import MODELS, of

TEMPLATES = Path(report.__file__).parent / "templates"
PAGES = [path for path in sorted(TEMPLATES.glob("*.html")) if "<head>" in path.read_text("utf-8")]
PUSHED_IN = (
    "<script>document.title = 'script'</script>",
    '<img src="data:," onerror="document.title = \'handler\'">',
    '<a id="go" href="javascript:document.title = \'address\'">go</a>',
    '<iframe srcdoc="<script>parent.document.title = 1</script>"></iframe>',
    "<style>body { color: rgb(1, 2, 3) }</style>",
    '<img src="http://localhost:9/i.png">',
    '<base href="http://localhost:9/">',
)


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("list")
    write_model_list(Listing(judge(of(MODELS), Engine()), "Two vessels", "list-vessels"), folder)
    return folder / "list-vessels.html"


def policy_of(text: str) -> dict[str, list[str]]:
    (content,) = re.findall(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', text)
    rules = (rule.split() for rule in unescape(content).split(";"))
    return {name: sources for name, *sources in rules}


@pytest.mark.parametrize("template", PAGES, ids=lambda path: path.name)
def test_every_template_of_a_page_has_a_policy_before_all_that_it_is_about(template: Path) -> None:
    text = template.read_text(encoding="utf-8")
    head = text[text.index("<head>") :]
    assert head.startswith(
        '<head>\n<meta charset="utf-8">\n<meta http-equiv="Content-Security-Policy"'
    )
    assert not re.search(r"<script>|<style>|\son\w+=|javascript:", text)


@pytest.mark.full
def test_scripts_are_allowed_by_their_bytes_and_nothing_else_is(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    policy = policy_of(text)
    assert policy["default-src"] == ["'none'"] and "'unsafe-inline'" not in str(policy)
    scripts = re.findall(r"<script>(.*?)</script>", text, re.DOTALL)
    allowed = {f"'sha256-{b64encode(sha256(s.encode()).digest()).decode()}'" for s in scripts}
    assert scripts and {s for s in policy["script-src"] if "sha256" in s} == allowed


def test_a_text_that_calls_itself_a_script_is_not_allowed() -> None:
    """Even one that came into the page as it is."""
    template = environment().from_string(
        '<meta content="{{ policy.mark }}">{% call policy.script() %}1{% endcall %}{{ text }}'
    )
    policy = Policy()
    text = policy.of(template.render(policy=policy, text=Markup("<script>2</script>")))
    assert source_of("1") in text and source_of("2") not in text


@pytest.mark.full
def test_what_is_pushed_into_a_page_neither_runs_nor_fetches(tab, page: Path) -> None:  # type: ignore[no-untyped-def]
    text = page.read_text(encoding="utf-8")
    damaged = page.with_name("damaged.html")
    damaged.write_text(text.replace("</main>", "".join(PUSHED_IN) + "</main>"), encoding="utf-8")
    failures = list[str]()
    tab.on("requestfailed", failed := lambda request: failures.append(request.failure))
    with heard(tab) as (said, asked):
        tab.goto(f"{damaged.as_uri()}#1-2")
        title = tab.title()
        tab.eval_on_selector("#go", "link => link.click()")
        tab.wait_for_timeout(100)
    tab.remove_listener("requestfailed", failed)
    assert tab.title() == title and title.startswith("Two vessels")
    assert any(url.startswith("http") for url in asked) and set(failures) == {"csp"}
    assert tab.evaluate("getComputedStyle(document.body).color") != "rgb(1, 2, 3)"
    assert len([text for text in said if "Content Security Policy" in text]) >= len(PUSHED_IN) - 1
