"""A format of measured data is a module and a row of its table, a page of the site a module, a
template and a row, a unit and a family of networks a row: written into a copy of the package, they
are at work.
"""

import json

import numpy as np

from tests.house.package_copy import copied, said

MODULE = """
import json

import numpy as np

from disting.measurement.response import FrequencyResponse


def read_json(file, *, quantity="acceleration"):
    data = json.loads(file.content)
    G = np.array(data["re"]) + 1j * np.array(data["im"])
    return FrequencyResponse(np.array(data["omega"]), G, sensor=quantity, origin=file.name)
"""
ROW = """FORMATS = (
    Format(
        name="JSON",
        fits=lambda file, head: head.lstrip().startswith(b"{"),
        response=lambda file, options: check(read_json, options, file)(file, **options),
    ),
"""
USE = """
from disting import InputError
from disting.measurement import read

found = read("response.json", quantity="velocity")
print(found.sensor, found.G[0], len(found))
for options in ({"column": 2}, {"input": "u", "output": "y"}):
    try:
        read("response.json", **options)
    except InputError as error:
        print(error)
"""
IMPORT = "from disting.measurement.table import Table, is_time, signal_columns, time_series\n"


def test_a_format_is_a_module_and_a_row(tmp_path):
    use = "from disting.measurement.json_file import read_json\n"
    folder = copied(
        tmp_path,
        {"measurement/formats.py": [("FORMATS = (\n", ROW), (IMPORT, IMPORT + use)]},
        {"measurement/json_file.py": MODULE},
    )
    omega = np.linspace(1.0, 100.0, 30)
    data = {"omega": omega.tolist(), "re": omega.tolist(), "im": (-omega).tolist()}
    (folder / "response.json").write_text(json.dumps(data), encoding="utf-8")
    assert said(folder, "-c", USE).splitlines() == [
        "velocity (1-1j) 30",
        "response.json: unknown option column; known for this format: quantity",
        "response.json: time series are read from MATLAB and text files",
    ]


PAGE_MODULE = """
from disting.report.environment import render


def largest_page(site):
    largest = max(site.catalogs, key=lambda c: len(c.family))
    yield "largest.html", render("largest.html", name=largest.name).encode()
"""
PAGE_ROW = """PAGES: tuple[SitePage, ...] = (
    SitePage(link=("largest.html", "The largest catalogue", "most models"), files=largest_page),
"""


def test_a_page_is_a_module_a_template_and_a_row(tmp_path):
    first = "from disting.report.damper_page import damper_page\n"
    use = "from disting.report.largest_page import largest_page\n"
    folder = copied(
        tmp_path,
        {
            "report/write.py": [
                ("PAGES: tuple[SitePage, ...] = (\n", PAGE_ROW),
                (first, first + use),
            ]
        },
        {
            "report/largest_page.py": PAGE_MODULE,
            "report/templates/largest.html": "<title>Largest</title><p>{{ name }}</p>",
        },
    )
    said(folder, "-m", "disting", "report", "1", "--undamped", "--out", "site")
    page = (folder / "site" / "largest.html").read_text(encoding="utf-8")
    assert page == "<title>Largest</title><p>chains-1-undamped</p>"
    start = (folder / "site" / "index.html").read_text(encoding="utf-8")
    assert '<a href="largest.html">The largest catalogue</a>' in start
    assert "The largest catalogue" in (folder / "site" / "search.js").read_text(encoding="utf-8")


def test_a_unit_is_a_row(tmp_path):
    row = '    "N": ("N", 1.0), "kp": ("N", 9.80665),'
    folder = copied(tmp_path, {"measurement/units.py": [('    "N": ("N", 1.0),', row)]})
    lines = ["f [Hz],Re [mm/s^2/kp],Im [mm/s^2/kp]"]
    lines += [f"{i},{9.80665 * i},{-9.80665 * i}" for i in range(1, 30)]
    (folder / "press.csv").write_text("\n".join(lines), encoding="utf-8")
    script = "from disting.measurement import read; from disting.measurement.scaling import in_si; "
    script += "found = in_si(read('press.csv')); print(found.sensor, found.G[0].round(12))"
    assert said(folder, "-c", script) == "acceleration (0.001-0.001j)\n"


def test_a_family_of_networks_is_a_row(tmp_path):
    """Two motors with one load each, the second through a gear: listed, judged, on pages."""
    start = "def _families() -> Iterator[NetworkFamily]:\n"
    row = """    texts = ("1=2; F1; S1", "1=2*i; F1; S1")
    yield NetworkFamily("motors-2", "Motors with a load", lambda: texts)
"""
    folder = copied(tmp_path, {"network/families.py": [(start, start + row)]})
    listed = said(folder, "-m", "disting", "models", "motors-2").splitlines()
    assert [line.split(": ")[0] for line in listed] == ["1=2; F1; S1", "1=2*i; F1; S1"]
    verdicts = said(folder, "-m", "disting", "verdicts", "motors-2")
    assert verdicts.startswith(
        "2 models, 1 pair, over positive parameters: 0 distinguishable, 1 ind"
    )
    said(folder, "-m", "disting", "report", "motors-2", "--out", "site")
    page = (folder / "site" / "list-motors-2.html").read_text(encoding="utf-8")
    assert "Motors with a load" in page and "1=2*i; F1; S1" in page
