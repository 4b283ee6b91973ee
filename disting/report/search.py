"""The search over the whole site: an index and the code that queries it, in one script.

Pages load it when somebody begins to search, as a script and not as data, since a page that is
opened from a folder may load no data.

The pages of pairs of a site: what a search needs of each, by its name.
"""

from collections.abc import Mapping, Sequence

from disting.catalogs import Catalog
from disting.catalogs.dampers import DamperFamily
from disting.catalogs.files import damper_name
from disting.catalogs.sizes import SizesCatalog
from disting.files import json_text
from disting.report.environment import source
from disting.report.guide import Part
from disting.report.model import folder_of

Families = Mapping[str, Mapping[str, object]]
"""By the name of a page: number of `models`, of structures where there are sets of dampers to the
ground; the `folder` of their pages, where there are any; of a page of several sizes instead its
`sizes`, (masses, number of models) each.
"""
ADDRESS = "search.js"


def families(
    catalogs: Sequence[Catalog],
    dampers: Sequence[DamperFamily] = (),
    across: Sequence[SizesCatalog] = (),
) -> dict[str, dict[str, object]]:
    """Of the pages of these catalogues, families with ground dampers, and catalogues of several
    sizes.

    >>> from disting.catalogs import catalog
    >>> families([catalog(3, damped=False)])
    {'chains-3-undamped': {'models': 11, 'folder': 'models/3-undamped'}}
    """
    entries: dict[str, dict[str, object]] = {
        c.name: {"models": len(c.family), "folder": folder_of(c)} for c in catalogs
    }
    entries |= {
        damper_name(f.family.n_masses, f.family.damped): {"models": len(f.family)} for f in dampers
    }
    return entries | {
        s.name: {"sizes": [(c.n_masses, len(c.family)) for c in s.catalogs]} for s in across
    }


def search_script(
    parts: Sequence[Part],
    families: Families,
    links: Sequence[tuple[str, str, str]] = (),
) -> str:
    """The script, for a site of these guide pages, of these pages of pairs and of these further
    pages.
    """
    guide = [page for part in parts for page in part.pages]
    pages = [[f"guide/{page.name}.html", page.title] for page in guide]
    sections = [
        [place, section.anchor, section.title, " ".join(section.words.split())]
        for place, page in enumerate(guide)
        for section in page.sections
    ]
    for address, title, text in links:
        sections.append([len(pages), "", title, text])
        pages.append([address, title])
    data = {"pages": pages, "sections": sections, "families": families}
    written = json_text(data)
    code = source("search.js") + source("site-search.js")
    return f'"use strict";\n(() => {{\nconst DATA = {written};\n{code}}})();\n'
