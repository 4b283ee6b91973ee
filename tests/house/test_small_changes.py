"""A format of measured data is a module and a row of its table, a page of the site a module, a
template and a row, a unit and a sensor quantity a row, a family of networks a module: written into a copy of the package,
they are at work.
"""

import json

import numpy as np
import pytest

from tests.house.package_copy import copied, said

pytestmark = pytest.mark.full

MODULE = """
import json

import numpy as np

from disting.measurement.response import FrequencyResponse


def read_json(file, *, quantity="acceleration"):
    data = json.loads(file.content)
    G = np.array(data["re"]) + 1j * np.array(data["im"])
    return FrequencyResponse(np.array(data["omega"]), G, quantity=quantity, origin=file.name)
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
print(found.quantity, found.G[0], len(found))
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
    script += "found = in_si(read('press.csv')); print(found.quantity, found.G[0].round(12))"
    assert said(folder, "-c", script) == "acceleration (0.001-0.001j)\n"


RINGS = """
from disting.network.families.family import Kind
from disting.network.families.machines import machines


def rings(masses):
    yield tuple(sorted(tuple(sorted((i, i % masses + 1))) for i in range(1, masses + 1)))


KIND = Kind(
    name="rings",
    place=9,
    sizes=(3,),
    largest=6,
    text="N masses in a ring",
    title=lambda n: f"Rings of {n} masses",
    texts=lambda n, joint: machines(n, joint, rings),
    has_dampers=True,
)
"""
RING = """
import io, json
from contextlib import redirect_stderr, redirect_stdout
import disting
from disting.cli import main
from disting.network.families import family_of

told = {}
for command in COMMANDS:
    with redirect_stdout(io.StringIO()) as out, redirect_stderr(io.StringIO()) as error:
        try:
            status = main(command.split())
        except SystemExit as end:
            status = end.code or 0
    told[command] = status, out.getvalue(), error.getvalue()
told["names"] = [n.name for n in family_of("rings-3").networks]
told["python"] = disting.compare("rings-3:1", "rings-3:2").relation
told["sizes"] = [len(family_of(f"rings-{n}-damped").networks) for n in (3, 4)]
print(json.dumps(told))
"""
VALUES = "m1=1,m2=2,m3=3,k12=40,k13=50,k23=60"
ONE = {
    "models rings-3:1": "F1",
    "compare rings-3:1 rings-3:2": "DISTINGUISHABLE",
    "verify rings-3:1 rings-3:2": "holds",
    "next rings-3:1 rings-3:2": "",
    "draw rings-3:1 --svg ring.svg": "ring.svg written",
    f"equivalents rings-3:1 --family rings-3 --set {VALUES}": "of 1 other network",
    f"equivalents rings-3:1 --to rings-3:2 --set {VALUES}": "of 1 other network",
    f"simulate rings-3:1 --set {VALUES} --samples 256 --periods 2 --csv frf.csv": "frf.csv",
}
WHOLE = {
    "models rings-3": "F1",
    "models --help": "rings-3..6: N masses in a ring",
    "verdicts rings-3": "2 models, 1 pair",
    "report rings-3 --out site": "Rings of 3 masses, undamped",
    "catalog families rings-3 --out .": "networks-rings-3.jsonl",
    "catalog verify rings-3 --catalog .": "all is as it is computed now",
}


def test_a_family_of_networks_is_a_file(tmp_path):
    """Masses in a ring: in all commands, on pages, in help, as a catalogue, each by its number."""
    folder = copied(tmp_path, {}, {"network/families/rings.py": RINGS})
    commands = {**ONE, **WHOLE}
    told = json.loads(said(folder, "-c", RING.replace("COMMANDS", repr([*commands]))))
    for command, words in commands.items():
        status, out, error = told[command]
        assert status == 0, (command, error)
        assert words in " ".join(out.split()), (command, out)
    assert told["python"] == "distinguishable" and told["sizes"] == [2, 3]
    assert all(name in told["models rings-3"][1] for name in told["names"])
    page = (folder / "site" / "list-rings-3.html").read_text(encoding="utf-8")
    assert "Rings of 3 masses" in page and told["names"][0] in page


JERK = """
import io, json
from contextlib import redirect_stderr, redirect_stdout
from disting import Chain, Experiment, Family, InputError, Network, network_of
from disting.cli import main
from disting.files import Format, schema
from disting.measurement import from_arrays

told = {}
for command in COMMANDS:
    with redirect_stdout(io.StringIO()) as out, redirect_stderr(io.StringIO()) as error:
        try:
            status = main(command.split())
        except SystemExit as end:
            status = end.code or 0
    told[command] = status, out.getvalue() + error.getvalue()
mass = from_arrays(range(1, 9), [1.0] * 8, quantity="ruck")
drive = network_of("1=2; F1; S2")
doors = (
    lambda: Chain(2, quantity="jerk"),
    lambda: Family(2, quantity="jerk"),
    lambda: network_of("1=2; F1; S2", quantity="jerk"),
    lambda: network_of("1=2; F1; S2; jerk"),
    lambda: network_of("machines-2:1", quantity="jerk"),
    lambda: Network(drive.elements, drive.inputs, drive.outputs, 3),
    lambda: Experiment(quantity="jerk"),
)
told["refused"] = []
for door in doors:
    try:
        door()
        told["refused"].append("")
    except InputError as error:
        told["refused"].append(str(error))
told["gain"] = abs(mass.to_quantity("acceleration").G[0] * mass.omega[0])
told["word"] = schema(Format.FIT)["$defs"]["quantity"]["enum"]
print(json.dumps(told))
"""
SHOWN = {
    "simulate 2:1 --set m1=1,m2=2,k12=50,d12=1 --samples 256 --periods 2 --response jerk": "# quantity: jerk",
    "simulate --help": "{position,velocity,acceleration,jerk}",
    "fit --help-all": "{position,velocity,acceleration,jerk}",
}
REFUSED = "a sensor of a machine shows position, velocity or acceleration, not jerk: beyond the"
REFUSING = (
    "compare 2:1 2:2 --quantity jerk",
    "verdicts 2 --quantity jerk",
    "draw 2:1 --quantity jerk --svg a.svg",
)


def test_a_quantity_is_a_row(tmp_path):
    """Jerk: of data, in help and schemas; models, of which it would not be proper, refuse it."""
    last = '"acc accel accelerance inertance beschleunigung",\n    )\n'
    row = '    JERK = ("jerk", "m/s^3", "ruck")\n'
    folder = copied(tmp_path, {"quantities.py": [(last, last + row)]})
    told = json.loads(said(folder, "-c", JERK.replace("COMMANDS", repr([*SHOWN, *REFUSING]))))
    for command, words in SHOWN.items():
        status, text = told[command]
        assert status == 0 and words in text, (command, text)
    for command in REFUSING:
        status, text = told[command]
        assert status == 2 and "jerk" in text and "acceleration" in text, (command, text)
    assert all(REFUSED in text for text in told["refused"]), told["refused"]
    assert told["gain"] == 1.0 and told["word"][-1] == "jerk"
