"""The templates, always escaping."""

from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined

from disting.files import __version__
from disting.report.policy import Policy


def render(template: str, **values: object) -> str:
    """Text of a template; a whole page says what it may do."""
    policy = Policy()
    return policy.of(environment().get_template(template).render(policy=policy, **values))


def source(template: str) -> str:
    """Text of a file among the templates, as it is."""
    loader = environment().loader
    assert loader is not None
    return loader.get_source(environment(), template)[0]


@cache
def environment() -> Environment:
    """Templates of this package: a missing value is an error, a text is never taken for markup."""
    loader = PackageLoader("disting.report")
    found = Environment(
        loader=loader,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    found.globals["version"] = __version__  # every page names it
    return found
