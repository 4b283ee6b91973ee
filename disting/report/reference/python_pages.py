"""The reference of the public Python names: a page a module."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import partial

from markupsafe import Markup

from disting.report.environment import render
from disting.report.markdown import GuidePage, Section
from disting.report.reference.docstring import Leads, linked, rendered
from disting.report.reference.entries import Argument, Entry, entries
from disting.report.reference.modules import Place, defined, parsed

MODULES = (
    "disting",
    "disting.equivalence",
    "disting.experiments",
    "disting.fit",
    "disting.general",
    "disting.measurement",
    "disting.questions.identifiability",
    "disting.report",
    "disting.simulation",
)
WIDEST = 88  # characters of a signature on one line


@dataclass(frozen=True, slots=True)
class Shown:
    """An entry as the page shows it; `elsewhere`: the address where it is explained, if that is
    another page.
    """

    entry: Entry
    anchor: str
    signature: Markup
    raises: tuple[Markup, ...]
    text: Markup
    members: tuple["Shown", ...] = ()
    elsewhere: str = ""


def python_pages() -> Iterator[GuidePage]:
    """A page for every public module; a name that two of them hand on is explained in the first."""
    offered = {name: sorted(entries(name), key=lambda e: e.name.lower()) for name in MODULES}
    addresses: dict[Place, str] = {}
    for name, found in offered.items():
        for entry in found:
            addresses.setdefault(entry.place, f"{page_name(name)}.html#{entry.name}")
    for name, found in offered.items():
        yield _page(name, found, addresses)


def page_name(module: str) -> str:
    """Name of a module's page.

    >>> page_name("disting.questions.identifiability")
    'python-identifiability'
    """
    return f"python-{module.split('.')[-1]}"


def _page(name: str, found: list[Entry], addresses: Mapping[Place, str]) -> GuidePage:
    shown = [_shown(name, entry, addresses) for entry in found]
    text = rendered(parsed(name).text, partial(_address, name, addresses))
    body = Markup(render("reference.html", module=name, text=text, entries=shown))
    sections = [Section("", f"Python: {name}", 1, parsed(name).text)]
    for one in shown:
        sections += _sections(one) if not one.elsewhere else []
    return GuidePage(page_name(name), f"Python: {name}", tuple(sections), body)


def _sections(one: Shown, level: int = 2) -> Iterator[Section]:
    """What the search finds: an entry and its members, by what their docstrings say first."""
    text = one.entry.text.split("\n\n")[0]
    yield Section(one.anchor, one.anchor, level, text)
    for member in one.members:
        yield from _sections(member, level + 1)


def _shown(module: str, entry: Entry, addresses: Mapping[Place, str], within: str = "") -> Shown:
    leads = partial(_address, entry.place.module, addresses)
    anchor = f"{within}.{entry.name}" if within else entry.name
    here = addresses.get(entry.place, "")
    elsewhere = "" if within or here.startswith(f"{page_name(module)}.html") else here
    members = [_shown(module, m, addresses, anchor) for m in entry.members] if not elsewhere else []
    return Shown(
        entry=entry,
        anchor=anchor,
        signature=_signature(entry, leads),
        raises=tuple(linked(name, leads) for name in entry.raises),
        text=rendered(entry.text, leads),
        members=tuple(members),
        elsewhere=elsewhere,
    )


def _address(module: str, addresses: Mapping[Place, str], name: str) -> str:
    """Where a name leads that stands in the source of a module: `Chain`, `Chain.parameters`,
    `View.EXACT` or `fit.select`.
    """
    head, _, rest = name.partition(".")
    at = defined(Place(module, head))
    if at and at in addresses:
        return addresses[at]
    return _address(f"disting.{head}", addresses, rest) if rest and "." not in rest else ""


def _signature(entry: Entry, leads: Leads) -> Markup:
    """Name, arguments with types and defaults, and what is returned; a line for each argument
    where one line is too short for all.
    """
    if entry.arguments is None:
        return _valued(entry, leads)
    written = [_written(argument, leads) for argument in entry.arguments]
    end = Markup(" -&gt; ") + linked(entry.returns, leads) if entry.returns else Markup()
    width = len(entry.name) + sum(len(w.striptags()) + 2 for w in written) + len(end.striptags())
    if width <= WIDEST:
        return Markup("{}({})").format(entry.name, Markup(", ").join(written)) + end
    lines = Markup("").join(Markup("    {},\n").format(argument) for argument in written)
    return Markup("{}(\n{})").format(entry.name, lines) + end


def _valued(entry: Entry, leads: Leads) -> Markup:
    """A property, a constant or a member of an enumeration; of a class its name."""
    parts = Markup(entry.name)
    if entry.returns:
        parts += Markup(": ") + linked(entry.returns, leads)
    return parts + (Markup(" = ") + linked(entry.value, leads) if entry.value else "")


def _written(argument: Argument, leads: Leads) -> Markup:
    found = Markup("{}{}").format(argument.star, argument.name)
    if argument.annotation:
        found += Markup(": ") + linked(argument.annotation, leads)
    if argument.default:
        space = " " if argument.annotation else ""
        found += Markup("{0}={0}").format(space) + linked(argument.default, leads)
    return found
