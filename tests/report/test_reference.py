"""The reference says of every public name what the running code says of it."""

import importlib
import inspect

import pytest

from disting.cli.run import parser
from disting.report.reference.commands import command_page, commands
from disting.report.reference.entries import Entry, Kind, entries
from disting.report.reference.python_pages import MODULES, as_html, python_pages
from tests.report.outline import Outline


def offered(name: str) -> dict[str, object]:
    """What a module offers when it runs: all that is not private and no module."""
    module = importlib.import_module(name)
    found = {key: getattr(module, key) for key in dir(module)}
    return {
        key: value
        for key, value in found.items()
        if (not key.startswith("_") or key == "__version__") and not inspect.ismodule(value)
    }


@pytest.mark.full
@pytest.mark.parametrize("name", MODULES)
def test_every_public_name_is_there_with_its_arguments(name: str) -> None:
    found = {entry.name: entry for entry in entries(name)}
    assert set(found) == set(offered(name))
    for key, value in offered(name).items():
        entry = found[key]
        if inspect.isfunction(value):
            assert entry.kind is Kind.FUNCTION
        if inspect.isfunction(value) or (inspect.isclass(value) and entry.arguments is not None):
            written = [a.name for a in entry.arguments or () if a.name]
            assert written == list(inspect.signature(value).parameters), key
        if inspect.isclass(value) or inspect.isfunction(value):
            assert entry.text == (inspect.getdoc(value) if value.__doc__ else "")


@pytest.mark.full
def test_defaults_and_types_are_those_of_the_source() -> None:
    prove = next(entry for entry in entries("disting") if entry.name == "prove")
    last = next(a for a in prove.arguments if a.name == "seconds")  # type: ignore[union-attr]
    assert (last.name, last.annotation, last.default) == ("seconds", "float", "10.0")
    engine = next(entry for entry in entries("disting") if entry.name == "Engine")
    assert engine.arguments[0].default == "Settings()"  # type: ignore[index]


@pytest.mark.full
def test_exceptions_are_those_of_docstring_and_body() -> None:
    raised = {entry.name: entry.raises for entry in entries("disting")}
    assert raised["catalog"] == ("CatalogError",)
    assert set(raised["Chain"]) == {"ConstraintViolation", "InputError"}


@pytest.mark.full
def test_members_that_are_public_and_explained() -> None:
    sensor = next(entry for entry in entries("disting") if entry.name == "Quantity")
    kinds = {member.name: member.kind for member in sensor.members}
    assert kinds["POSITION"] is Kind.MEMBER and kinds["order"] is Kind.PROPERTY


def names(entry: Entry) -> list[str]:
    return [entry.name, *(f"{entry.name}.{member.name}" for member in entry.members)]


@pytest.mark.full
def test_every_name_has_one_place_and_every_link_leads_to_one() -> None:
    pages = {f"{page.name}.html": Outline(str(page.body)) for page in python_pages()}
    ids = {name: [a["id"] for _, a in o.elements if "id" in a] for name, o in pages.items()}
    links = 0
    for name, outline in pages.items():
        assert len(ids[name]) == len(set(ids[name]))
        for link in (str(a["href"]) for tag, a in outline.elements if tag == "a"):
            page, _, anchor = link.partition("#")
            assert anchor in ids[page], (name, link)
            links += 1
    assert links > 300
    for entry in entries("disting"):
        assert set(names(entry)) <= set(ids["python-disting.html"])


@pytest.mark.full
def test_two_runs_make_the_same_pages() -> None:
    assert python_pages() == python_pages.__wrapped__()  # made anew
    assert command_page(parser()) == command_page(parser())


@pytest.mark.parametrize(
    "text",
    ["m1*m2*m3 and *one*", "[1FS]=[2], `a`", "# [1]=[2fs]", "<b>&amp;</b>", "a_b_c \\n", "> 1"],
)
def test_signs_of_markdown_are_text_in_docstrings(text: str) -> None:
    shown = Outline(str(as_html(text, lambda name: "")))
    assert shown.text.strip() == text.replace("`", "")
    assert {tag for tag, _ in shown.elements} <= {"p", "code"}


@pytest.mark.full
def test_every_command_and_option_is_there() -> None:
    found = {command.words: command for command in commands(parser())}
    assert {"disting compare", "disting catalog verify", "disting cache info"} <= set(found)
    domain = next(o for o in found["disting compare"].options if "--domain" in o.written[0])
    assert domain.choices == ("complex", "real", "positive")
    shown = next(o for o in found["disting compare"].options if "--quantity" in o.written[0])
    assert "acceleration" in shown.default + shown.text
    assert not any("SUPPRESS" in o.text for c in found.values() for o in c.options)
    written = Outline(str(command_page(parser()).body))
    for command in found.values():
        assert written.count("details", id=command.anchor) == 1
        for option in command.options:
            assert written.count("dt", id=option.anchor) == 1, option
            assert "%(" not in option.text and "/tmp" not in option.default
