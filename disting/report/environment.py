"""The templates, always escaping, and what a page may do, stated to the browser
(Content-Security-Policy, https://www.w3.org/TR/CSP3): run the scripts that its template has, be
drawn by its styles, show pictures in the same folder. Nothing is fetched from elsewhere, no form is
sent, and what somebody put into a name does not run.

A script is allowed by the hash of what the template wrote between its tags, which a text that came
through an escape is not. Styles inside of tags are those of figures and tables and come with their
libraries; they are allowed by the hashes of the text in the finished page.
"""

import re
from base64 import b64encode
from collections.abc import Callable, Iterable
from functools import cache
from hashlib import sha256
from html import unescape

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from disting.files import __version__
from disting.report.scene import FILE_PALETTE

BESIDE = "'self' file:"  # of a page that is opened from a disk not every browser knows 'self'
SCRIPT = re.compile(r"\{% call policy\.script\(\) %\}.*?\{% endcall %\}", re.DOTALL)
ATTRIBUTE = re.compile(r' style="([^"]*)"')


class Policy:
    """The policy of one page while its template is rendered; `mark` marks its place."""

    mark = "the policy of this page"

    def __init__(self) -> None:
        self._scripts: dict[str, None] = {}
        self._styles: dict[str, None] = {}

    @property
    def scripts(self) -> tuple[str, ...]:
        """Source expressions of the scripts so far."""
        return tuple(self._scripts)

    def script(self, caller: Callable[[], str]) -> Markup:
        """A script of the template."""
        return _element("script", caller(), self._scripts)

    def style(self, caller: Callable[[], str]) -> Markup:
        """A style sheet of the template."""
        return _element("style", caller(), self._styles)

    def of(self, page: str) -> str:
        """The page with its policy."""
        attributes = sorted({unescape(text) for text in ATTRIBUTE.findall(page)})
        inside = ["'unsafe-hashes'", *map(source_of, attributes)] if attributes else []
        rules = (
            "default-src 'none'",
            _rule("script-src", [BESIDE, *self._scripts]),
            _rule("style-src", [BESIDE, *self._styles, *inside]),
            f"img-src {BESIDE} data:",
            "base-uri 'none'",
            "form-action 'none'",
        )
        return page.replace(self.mark, "; ".join(rules), 1)


def source_of(text: str) -> str:
    """Source expression by which a policy allows a text.

    >>> source_of("")
    "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='"
    """
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def _element(name: str, text: str, entries: dict[str, None]) -> Markup:
    entries[source_of(text)] = None
    return Markup(f"<{name}>{text}</{name}>")


def _rule(name: str, sources: Iterable[str]) -> str:
    return " ".join((name, *sources))


def render(template: str, **values: object) -> str:
    """Text of a template; a whole page states what it may do."""
    policy = Policy()
    return policy.of(environment().get_template(template).render(policy=policy, **values))


def scripts_of(template: str) -> tuple[str, ...]:
    """Source expressions of the scripts that a template writes, whatever the page.

    >>> len(scripts_of("fit.html"))
    1
    """
    policy = Policy()
    for block in SCRIPT.findall(source(template)):
        environment().from_string(block).render(policy=policy)
    return policy.scripts


def source(template: str) -> str:
    """Text of a file among the templates, as it is."""
    loader = environment().loader
    assert loader is not None
    return loader.get_source(environment(), template)[0]


@cache
def environment() -> Environment:
    """Templates of this package: a missing value is an error, a text is never interpreted as
    markup.
    """
    loader = PackageLoader("disting.report")
    the_environment = Environment(
        loader=loader,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    the_environment.globals["version"] = __version__  # every page names it
    the_environment.globals["file_palette"] = dict(FILE_PALETTE)  # of pictures that a page saves
    return the_environment
