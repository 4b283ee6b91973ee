"""Names that strangers give (headers, units, files) in pages, figures and tables: shown, never
obeyed.
"""

import csv
import html.parser
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from disting.cli import main
from disting.measurement import FrequencyResponse, Signal, csv_text, read, write_csv
from tests.attack.counts import chance, times

pytestmark = pytest.mark.attack
OMEGA = np.linspace(20.0, 600.0, 40)
HOSTILE = (
    "<script>alert(1)</script>", "<img src=x onerror=alert(1)>", '"><svg onload=alert(1)>', "</title><script>", "]]></style>",
    "javascript:alert(1)", "&lt;script&gt;", "{{7*7}}", "{%raw%}", "${7*7}", "$\\frac{1}{$", "$\\input{/etc/passwd}$",
    "\\undefined{", "%(x)s %n", "=1+1", "+cmd", "-2+3", "@SUM(A1)", "x,=cmd()", "x;=cmd()", "x\t=cmd()", "\x1b[2Jgone",
    "\x9b31m", "\u202eabc", "a\x00b", "'; DROP TABLE entry; --", "../../x", "\ud800", "\ufffe", "x" * 3000,
)  # fmt: skip
FORMULA = re.compile(r"[=+@\t\r]|-(?![\d.]|inf)")


class Tags(html.parser.HTMLParser):
    """Tags and attributes that a browser would obey."""

    def __init__(self, text):
        super().__init__()
        self.found = set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """Scripts by their words, everything else by its name, and what it would do."""
        self.found |= {tag} | {(tag, name) for name, _ in attrs if name.startswith("on")}
        self.found |= {
            (tag, name) for name, value in attrs if (value or "").startswith("javascript:")
        }


def fitted(folder, name, words):
    """The files of a fit of data whose signals and file bear hostile names."""
    folder.mkdir()
    signals = Signal(words[0], words[1]), Signal(words[2], words[3])
    response = FrequencyResponse(
        OMEGA, 5 - 0.4j / OMEGA, None, None, "acceleration", *signals, words[0], (words[1],)
    )
    data = folder / f"{name}.csv"
    data.write_bytes(csv_text(response).encode(errors="replace"))
    assert (
        main(
            [
                "fit",
                str(data),
                "--masses",
                "1",
                "--json",
                str(folder / "f.json"),
                "--out",
                str(folder / "out"),
            ]
        )
        == 0
    )
    return folder / "out"


def tags(folder):
    return Tags((folder / "fit.html").read_text(encoding="utf-8")).found


def test_pages_figures_and_tables_of_a_fit(tmp_path, counts, capsys):
    draw = chance("names")
    tame = tags(fitted(tmp_path / "tame", "tame", ["torque", "Nm", "angle", "rad/s²"]))
    for turn in range(times(8)):
        words = draw.sample([w for w in HOSTILE if "\0" not in w], 4)
        name = draw.choice(
            ["=cmd", "<b onclick=x>", "a$\\frac{$", "{{x}}", "\udcff", "\x1b[2J", "+1"]
        )
        folder = fitted(tmp_path / str(turn), name, words)
        counts["fits"] += 1
        assert tags(folder) <= tame, words
        for figure in folder.glob("*.svg"):
            assert not {e.tag.rpartition("}")[2] for e in ET.parse(figure).iter()} & {
                "script",
                "foreignObject",
                "image",
            }
        for table in folder.glob("*.csv"):
            assert not [
                c
                for row in csv.reader(table.open(encoding="utf-8"))
                for c in row
                if FORMULA.match(c)
            ]
        said = "".join(capsys.readouterr())
        assert not set(said) & set("\x1b\x9b\u202e\x00\ud800"), words
        counts["files"] += len(list(folder.iterdir()))


def test_written_responses_hold_no_formula_and_read_back(tmp_path, counts):
    draw = chance("written names")
    for _ in range(times(1000)):
        words = [" ".join("".join(draw.sample(HOSTILE, 2)).split()) for _ in range(6)]
        words = [re.sub("[\x00\ud800\x1c-\x1f\x85\u2028\u2029]", "", w).strip() for w in words]
        signals = Signal(words[0], words[1]), Signal(words[2], words[3])
        response = FrequencyResponse(
            OMEGA,
            5 - 4j / OMEGA,
            quantity="velocity",
            input=signals[0],
            output=signals[1],
            origin=words[4],
        )
        write_csv(response, tmp_path / "a.csv")
        found = read(tmp_path / "a.csv")
        counts["written"] += 1
        assert found == response, words
        lines = (tmp_path / "a.csv").read_text(encoding="utf-8").split("\n")
        cells = [cell.strip() for line in lines for cell in re.split("[,;\t]", line)]
        assert not [cell for cell in cells if FORMULA.match(cell)], words
