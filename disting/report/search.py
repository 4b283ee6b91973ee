"""The search over the whole site: an index and the code that asks it, in one script.

Pages load it when somebody begins to search, as a script and not as data, since a page that is
opened from a folder may load no data.
"""

import json
from collections.abc import Sequence

from disting.report.environment import source
from disting.report.families import Families
from disting.report.guide import Part

ADDRESS = "search.js"


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
    written = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    code = source("search.js") + source("site-search.js")
    return f'"use strict";\n(() => {{\nconst DATA = {written};\n{code}}})();\n'
